//! Euler-Poincare systems. These are the equations of motion of a connection and a metric on a
//! group.

use super::System;
use super::bilinear::Bilinear;
use super::centred::Centred;
use super::cotangent::{CotangentSystem, Sizes, State};
use super::matrix::Matrix;
use crate::algebra::frame::formula;
use crate::group::{Coordinates, LieGroup, So3, TranslationSplit, expect_left_frame};
use crate::mechanics::invalid_inertia;
use crate::{Connection, Error, Metric};
use nalgebra::Matrix3;

/// The relative tolerance within which two metrics count as equal.
const SAME: f64 = 1e-12;

/// The equations `DH/Dt = M` (104) on a group, for the covector `H = J Omega` (103) and
/// `g' = g Omega`: `dH_i/dt = Lambda^j_ki Omega^k H_j + M_i`. With the connection `plus`, these are
/// the Euler-Poincare equations (106), (108).
///
/// The unknowns are `g` and [`State::spatial`], which is the momentum about the origin of the body
/// frame in spatial axes. For rotations, it is the spatial momentum `h`, with
/// `H_i = (Ad*_g h)_i = h_j (Ad_g e_i)^j`:
///
/// ```text
/// g' = g Omega,   Omega = J^-1 H,   h' = Ad*_{g^-1} F,   F_i = M_i + (Lambda - c)^j_ki Omega^k H_j
/// ```
///
/// With `plus` and without a torque, `h` is conserved exactly for rotations. On groups with
/// translations, the linear momentum is conserved exactly, and `h` is conserved up to rounding
/// errors.
///
/// ```
/// use affinor::mechanics::{EulerPoincare, Integrator, MuntheKaas};
/// use affinor::group::{LieGroup, So3};
/// use affinor::{CanonicalConnection, Connection, Metric};
/// use affinor::tensors::{Down, Tensor};
/// use nalgebra::Vector3;
/// let so3 = So3.algebra()?;
/// let moments = (0..3).map(|i| ([i, i], 1.0 + i as f64));
/// let inertia = Metric::new(so3.labels(), Tensor::from_components(3, &[Down, Down], moments)?)?;
/// let plus = Connection::canonical(&so3, CanonicalConnection::Plus);
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
pub struct EulerPoincare<G: LieGroup, M> {
    group: G,
    metric: Matrix<G::Vector>,
    inverse: Matrix<G::Vector>,
    /// The bilinear map `(Lambda - c)^j_ki x^k y_j`. It is zero for the connection `plus`.
    excess: Bilinear,
    /// The inertia about the centre.
    centred: Centred<G::Vector, G::Element>,
    torque: M,
}

/// The torque of a free system, which is zero.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Free;

/// A torque, which is an external covector in body (left) components. It is a function of time,
/// element and velocity.
pub trait Torque<G: LieGroup> {
    /// Adds the components `M_i` to `force`.
    fn add(&self, time: f64, element: &G::Element, velocity: &G::Vector, force: &mut G::Vector);

    /// Whether the torque is zero at all times.
    fn is_absent(&self) -> bool {
        false
    }
}

impl<G: LieGroup> Torque<G> for Free {
    fn add(&self, _: f64, _: &G::Element, _: &G::Vector, _: &mut G::Vector) {}

    fn is_absent(&self) -> bool {
        true
    }
}

impl<G: LieGroup, F: Fn(f64, &G::Element, &G::Vector) -> G::Vector> Torque<G> for F {
    #[inline]
    fn add(&self, time: f64, element: &G::Element, velocity: &G::Vector, force: &mut G::Vector) {
        *force = force.clone() + self(time, element, velocity);
    }
}

impl<G: TranslationSplit, M: Torque<G>> System for EulerPoincare<G, M> {
    type State = State<G>;

    fn time(&self, state: &State<G>) -> f64 {
        state.time
    }
}

impl<G: TranslationSplit, M: Torque<G>> CotangentSystem for EulerPoincare<G, M> {
    type Group = G;

    fn group(&self) -> &G {
        &self.group
    }

    #[inline]
    fn velocity_of(&self, momentum: &G::Vector) -> G::Vector {
        self.inverse.apply(momentum)
    }

    #[inline]
    fn is_free(&self) -> bool {
        self.excess.is_zero() && self.torque.is_absent()
    }

    #[inline(always)]
    fn force(
        &self,
        time: f64,
        element: &G::Element,
        velocity: &G::Vector,
        momentum: &G::Vector,
    ) -> G::Vector {
        let mut force = self.excess.apply(velocity, momentum);
        self.torque.add(time, element, velocity, &mut force);
        force
    }

    #[inline]
    fn centre(&self) -> Option<&G::Element> {
        self.centred.centre().filter(|_| self.group.has_translations())
    }

    #[inline]
    fn velocity_at_centre(&self, momentum: &G::Vector) -> G::Vector {
        let inverse = self.centred.inverse().filter(|_| self.group.has_translations());
        inverse.unwrap_or(&self.inverse).apply(momentum)
    }

    #[inline]
    fn transfers(&self) -> bool {
        self.centred.transfers() && self.group.has_translations()
    }

    #[inline]
    fn transfer(&self, _: &G::Vector, momentum: &G::Vector) -> G::Vector {
        self.centred.transfer(momentum)
    }

    fn sizes(&self) -> Option<Sizes> {
        Some(self.centred.sizes())
    }
}

impl<G: TranslationSplit> EulerPoincare<G, Free> {
    /// The system of a connection and a metric, without a torque.
    ///
    /// # Errors
    /// The errors of [`EulerPoincare::new`].
    pub fn free(
        group: G,
        connection: &Connection<f64>,
        metric: &Metric<f64>,
    ) -> Result<Self, Error> {
        Self::new(group, connection, metric, Free)
    }
}

impl<G: TranslationSplit, M: Torque<G>> EulerPoincare<G, M> {
    /// The system of a connection and a metric on the algebra of the group, in the basis of the
    /// group.
    ///
    /// # Errors
    /// [`Error::Shape`] unless the connection refers to the left-invariant frame of the group, and
    /// the metric has the dimension of the group.
    pub fn new(
        group: G,
        connection: &Connection<f64>,
        metric: &Metric<f64>,
        torque: M,
    ) -> Result<Self, Error> {
        expect_on_group(&group, connection, metric)?;
        let structure = connection.frame().structure_functions();
        let operands = [("L", connection.affinities()), ("c", structure)];
        let excess = Bilinear::of_momentum(&formula("L^j_ki - c^j_ki -> ^j_ki", &operands));
        let (metric, inverse) = (Matrix::new(metric.components()), Matrix::new(metric.inverse()));
        let centred = Centred::new(&group, &metric, &inverse, structure);
        Ok(EulerPoincare { group, metric, inverse, excess, centred, torque })
    }

    /// The group.
    pub fn group(&self) -> &G {
        &self.group
    }

    /// The torque.
    pub fn torque(&self) -> &M {
        &self.torque
    }

    /// The state with this element, and with the velocity `Omega` in body components.
    pub fn state(&self, time: f64, element: G::Element, velocity: &G::Vector) -> State<G> {
        let momentum = self.metric.apply(velocity);
        self.state_with_momentum(time, element, &momentum)
    }

    /// The state with this element, and with the momentum `H` in body components.
    pub fn state_with_momentum(
        &self,
        time: f64,
        element: G::Element,
        momentum: &G::Vector,
    ) -> State<G> {
        State::with_momentum(&self.group, time, element, momentum)
    }

    /// The momentum `H` in body components (103).
    pub fn momentum(&self, state: &State<G>) -> G::Vector {
        state.momentum(&self.group)
    }

    /// The velocity `Omega = J^-1 H` in body components.
    pub fn velocity(&self, state: &State<G>) -> G::Vector {
        self.inverse.apply(&self.momentum(state))
    }

    /// The kinetic energy `T = H(Omega)/2` (98).
    pub fn energy(&self, state: &State<G>) -> f64 {
        let momentum = self.momentum(state);
        let velocity = self.inverse.apply(&momentum);
        let products = momentum.components().iter().zip(velocity.components());
        0.5 * products.map(|(h, omega)| h * omega).sum::<f64>()
    }

    /// The torque at a state, in body components.
    pub(in crate::mechanics) fn moment(
        &self,
        time: f64,
        element: &G::Element,
        velocity: &G::Vector,
    ) -> G::Vector {
        let mut moment = G::Vector::zeros(self.group.dimension());
        self.torque.add(time, element, velocity, &mut moment);
        moment
    }
}

/// Checks that a connection and a metric refer to the algebra of a group, in the basis of the
/// group.
///
/// # Errors
/// [`Error::Shape`] if the connection or the metric does not refer to this algebra.
pub(super) fn expect_on_group<G: LieGroup>(
    group: &G,
    connection: &Connection<f64>,
    metric: &Metric<f64>,
) -> Result<(), Error> {
    expect_left_frame(group, connection.frame())?;
    let (n, found) = (group.dimension(), metric.components().dimension());
    if n == found {
        return Ok(());
    }
    let [expected, found] = [n, found].map(|n| format!("dimension {n}"));
    Err(Error::Shape { what: "the metric", expected, found })
}

impl<M> EulerPoincare<So3, M> {
    /// Checks that these equations are the equations of a body with this inertia matrix.
    ///
    /// # Errors
    /// [`Error::Invalid`] if the metric differs, or if the connection is not `plus`.
    #[inline]
    pub(in crate::mechanics) fn expect_body(&self, inertia: &Matrix3<f64>) -> Result<(), Error> {
        // uses a cheap bound, because each step checks it: no entry of a positive definite matrix
        // exceeds the trace
        let bound = SAME * inertia.trace();
        let same = |i: usize, j: usize| (self.metric.entry(i, j) - inertia[(i, j)]).abs() <= bound;
        if (0..9).all(|at| same(at / 3, at % 3)) && self.excess.is_zero() {
            return Ok(());
        }
        Err(invalid_inertia("the system has another inertia, or a connection other than plus"))
    }
}
