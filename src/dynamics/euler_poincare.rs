//! The equations of motion that a connection and a metric make on a group.

use super::System;
use crate::frame::formula;
use crate::group::{Coordinates, LieGroup, expect_left_frame};
use crate::{Connection, Error, Metric};
use affinor_tensors::Tensor;

/// `DH/Dt = M` (104) on a group, for the covector `H = J Omega` (103) and `g' = g Omega`:
/// `dH_i/dt = Lambda^j_ki Omega^k H_j + M_i`, which with `plus` is Euler-Poincare (106), (108).
///
/// The unknowns are `g` and the spatial momentum `h`, with `H = Ad*_g h`, that is
/// `H_i = h_j (Ad_g e_i)^j`:
///
/// ```text
/// g' = g Omega,   Omega = J^-1 H,   h' = Ad*_{g^-1} F,   F_i = M_i + (Lambda - c)^j_ki Omega^k H_j
/// ```
///
/// so that with `plus` and without a torque `h` stays what it is, to the last bit.
///
/// ```
/// use affinor::dynamics::{EulerPoincare, Integrator, MuntheKaas};
/// use affinor::group::{LieGroup, So3};
/// use affinor::{Canonical, Connection, Metric};
/// use affinor_tensors::{Down, Tensor};
/// use nalgebra::Vector3;
/// let so3 = So3.algebra()?;
/// let moments = (0..3).map(|i| ([i, i], 1.0 + i as f64));
/// let inertia = Metric::new(so3.labels(), Tensor::from_components(3, &[Down, Down], moments)?)?;
/// let plus = Connection::canonical(&so3, Canonical::Plus);
/// let body = EulerPoincare::free(So3, &plus, &inertia)?;
/// let mut state = body.state(0.0, So3.identity(), &Vector3::new(0.3, 1.0, 0.1));
/// let energy = body.energy(&state);
/// for _ in 0..100 {
///     MuntheKaas::RK4.step(&body, &mut state, 0.05)?;
/// }
/// assert!((body.energy(&state) - energy).abs() < 1e-7);
/// # Ok::<(), affinor::Error>(())
/// ```
#[derive(Clone, Debug)]
pub struct EulerPoincare<G, M> {
    group: G,
    metric: Bilinear,
    inverse: Bilinear,
    /// `(i, k, j)` and the component `(Lambda - c)^j_ki`, where it is not zero.
    excess: Vec<([usize; 3], f64)>,
    torque: M,
}

/// The nonzero components of a matrix.
type Bilinear = Vec<([usize; 2], f64)>;

/// No torque.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Free;

/// A torque: an external covector in body (left) components, as a function of time, element and
/// velocity.
pub trait Torque<G: LieGroup> {
    /// `M_i`, which is added to `force`.
    fn add(&self, time: f64, element: &G::Element, velocity: &G::Vector, force: &mut G::Vector);
}

impl<G: LieGroup> Torque<G> for Free {
    fn add(&self, _: f64, _: &G::Element, _: &G::Vector, _: &mut G::Vector) {}
}

impl<G: LieGroup, F: Fn(f64, &G::Element, &G::Vector) -> G::Vector> Torque<G> for F {
    fn add(&self, time: f64, element: &G::Element, velocity: &G::Vector, force: &mut G::Vector) {
        *force = force.clone() + self(time, element, velocity);
    }
}

/// A state of a motion.
#[derive(Debug)]
pub struct State<G: LieGroup> {
    /// The time.
    pub time: f64,
    /// The element: of a body the attitude, or the pose.
    pub element: G::Element,
    /// The spatial momentum `h`, a covector.
    pub spatial: G::Vector,
}

// derived, it would ask the group to be `Clone` as well
impl<G: LieGroup> Clone for State<G> {
    fn clone(&self) -> Self {
        let (element, spatial) = (self.element.clone(), self.spatial.clone());
        State { time: self.time, element, spatial }
    }
}

/// The rates of change of a state: `Omega` in body components, and `h'`.
#[derive(Clone, Debug)]
pub struct Rates<V> {
    /// `Omega`.
    pub velocity: V,
    /// `h'`.
    pub spatial: V,
}

impl<G: LieGroup, M: Torque<G>> System for EulerPoincare<G, M> {
    type State = State<G>;

    fn time(&self, state: &State<G>) -> f64 {
        state.time
    }
}

impl<G: LieGroup> EulerPoincare<G, Free> {
    /// The system without a torque.
    ///
    /// # Errors
    /// As [`EulerPoincare::new`].
    pub fn free(
        group: G,
        connection: &Connection<f64>,
        metric: &Metric<f64>,
    ) -> Result<Self, Error> {
        Self::new(group, connection, metric, Free)
    }
}

impl<G: LieGroup, M: Torque<G>> EulerPoincare<G, M> {
    /// The system of a connection and a metric on the algebra of the group, in its basis.
    ///
    /// # Errors
    /// [`Error::Shape`] unless the connection is over the left-invariant frame of the group, and the metric of its
    /// dimension.
    pub fn new(
        group: G,
        connection: &Connection<f64>,
        metric: &Metric<f64>,
        torque: M,
    ) -> Result<Self, Error> {
        let (frame, n) = (connection.frame(), group.dimension());
        expect_left_frame(&group, frame)?;
        if metric.components().dimension() != n {
            let found = format!("dimension {}", metric.components().dimension());
            return Err(Error::Shape {
                what: "the metric",
                expected: format!("dimension {n}"),
                found,
            });
        }
        let operands = [("L", connection.gamma()), ("c", frame.structure())];
        let excess = formula("L^j_ki - c^j_ki -> ^j_ki", &operands);
        let excess = excess.components();
        let excess = excess.map(|(at, value)| ([at[2], at[1], at[0]], *value)).collect();
        let bilinear = |tensor: &Tensor<f64>| -> Bilinear {
            tensor.components().map(|(at, value)| ([at[0], at[1]], *value)).collect()
        };
        let (metric, inverse) = (bilinear(metric.components()), bilinear(metric.inverse()));
        Ok(EulerPoincare { group, metric, inverse, excess, torque })
    }

    /// The group.
    pub fn group(&self) -> &G {
        &self.group
    }

    /// The torque.
    pub fn torque(&self) -> &M {
        &self.torque
    }

    /// The state of an element with a velocity `Omega` in body components.
    pub fn state(&self, time: f64, element: G::Element, velocity: &G::Vector) -> State<G> {
        let momentum = applied::<G>(&self.metric, velocity, self.group.dimension());
        self.state_with_momentum(time, element, &momentum)
    }

    /// The state of an element with a momentum `H` in body components.
    pub fn state_with_momentum(
        &self,
        time: f64,
        element: G::Element,
        momentum: &G::Vector,
    ) -> State<G> {
        let back = self.group.inverse(&element);
        State { time, spatial: self.group.coadjoint(&back, momentum), element }
    }

    /// `H`, the momentum in body components (103).
    pub fn momentum(&self, state: &State<G>) -> G::Vector {
        self.group.coadjoint(&state.element, &state.spatial)
    }

    /// `Omega = J^-1 H`, in body components.
    pub fn velocity(&self, state: &State<G>) -> G::Vector {
        applied::<G>(&self.inverse, &self.momentum(state), self.group.dimension())
    }

    /// `T = H(Omega)/2` (98).
    pub fn energy(&self, state: &State<G>) -> f64 {
        let momentum = self.momentum(state);
        let velocity = applied::<G>(&self.inverse, &momentum, self.group.dimension());
        let products = momentum.components().iter().zip(velocity.components());
        0.5 * products.map(|(h, omega)| h * omega).sum::<f64>()
    }

    /// The rates of change of a state.
    pub fn rates(&self, state: &State<G>) -> Rates<G::Vector> {
        let n = self.group.dimension();
        let momentum = self.momentum(state);
        let velocity = applied::<G>(&self.inverse, &momentum, n);
        let (omega, h) = (velocity.components(), momentum.components());
        let term = |i: usize, (at, value): &([usize; 3], f64)| {
            if at[0] == i { value * omega[at[1]] * h[at[2]] } else { 0.0 }
        };
        let mut force =
            G::Vector::from_fn(n, |i| self.excess.iter().map(|entry| term(i, entry)).sum());
        self.torque.add(state.time, &state.element, &velocity, &mut force);
        let back = self.group.inverse(&state.element);
        Rates { spatial: self.group.coadjoint(&back, &force), velocity }
    }
}

/// `b_ij x^j`.
fn applied<G: LieGroup>(b: &Bilinear, x: &G::Vector, n: usize) -> G::Vector {
    let x = x.components();
    let row = |i: usize| b.iter().filter(move |(at, _)| at[0] == i);
    G::Vector::from_fn(n, |i| row(i).map(|(at, value)| value * x[at[1]]).sum())
}
