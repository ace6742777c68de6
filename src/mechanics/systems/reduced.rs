//! Constrained systems without multipliers, for methods without constraints.

use super::bilinear::Bilinear;
use super::constrained::{Constrained, column};
use super::constraint::Constraint;
use super::cotangent::State;
use super::euler_poincare::{EulerPoincare, Torque};
use crate::group::{Coordinates, TranslationSplit};
use crate::mechanics::stopped;
use crate::{Connection, Error, Metric};
use nalgebra::{DMatrix, DVector};

/// A [`Constrained`] system in which the time derivatives of the constraints determine the
/// multipliers `lambda(t, q, v)`:
///
/// ```text
/// q' = q v,   J v' = Lambda(v) J v + M(t, q, v) - B^T lambda - A^T lambda
/// ```
///
/// These are [`EulerPoincare`] equations, so that all methods for equations on groups apply to
/// them. Rounding errors and errors of the method violate the constraints. After each step,
/// [`projected`](Self::projected) removes the violation, which preserves the order of the method.
///
/// If all constraints are left-invariant, `A v = 0` with a constant matrix `A`, no linear equations
/// are solved. Let `P` be the orthogonal projector onto the subspace `A v = 0`. The equations are
/// the Euler-Poincare-Suslov equations `J v' = P^T (Lambda(v) J v + M)`. Without forces, they are a
/// quadratic field on the subspace.
///
/// E. Hairer and G. Wanner, *Solving Ordinary Differential Equations II* (1996), section VII.2, for
/// the projection. Y. N. Fedorov and V. V. Kozlov, *Amer. Math. Soc. Transl.* 168 (1995) 141-171,
/// for the Euler-Poincare-Suslov equations.
///
/// ```
/// use affinor::group::{LieGroup, So3};
/// use affinor::mechanics::systems::euler_poincare::Free;
/// use affinor::mechanics::systems::reduced::Reduced;
/// use affinor::mechanics::{Constrained, Constraint, Integrator, MuntheKaas};
/// use affinor::tensors::{Down, Tensor};
/// use affinor::{CanonicalConnection, Connection, Metric};
/// use nalgebra::{DMatrix, DVector, UnitQuaternion, Vector3};
/// // a body that cannot rotate about its axis 3 (Suslov)
/// struct Suslov;
/// impl Constraint<So3> for Suslov {
///     fn value(&self, _: f64, _: &UnitQuaternion<f64>) -> DVector<f64> {
///         DVector::zeros(0)
///     }
///     fn gradient(&self, _: f64, _: &UnitQuaternion<f64>) -> DMatrix<f64> {
///         DMatrix::zeros(0, 3)
///     }
///     fn affine(&self, _: f64, _: &UnitQuaternion<f64>) -> Option<(DMatrix<f64>, DVector<f64>)> {
///         Some((DMatrix::from_row_slice(1, 3, &[0.0, 0.0, 1.0]), DVector::zeros(1)))
///     }
/// }
/// let so3 = So3.algebra()?;
/// let entries = [([0, 0], 1.0), ([1, 1], 2.0), ([2, 2], 3.0), ([0, 2], 0.5), ([2, 0], 0.5)];
/// let inertia = Metric::new(so3.labels(), Tensor::from_components(3, &[Down, Down], entries)?)?;
/// let plus = Connection::canonical(&so3, CanonicalConnection::Plus);
/// let body = Constrained::new(So3, &plus, &inertia, Free, Suslov)?;
/// let body = Reduced::reduced(body, &plus, &inertia)?;
/// let mut state = body.state(0.0, So3.identity(), &Vector3::new(0.0, 1.0, 0.0));
/// let energy = body.energy(&state);
/// for _ in 0..100 {
///     MuntheKaas::RK4.step(&body, &mut state, 0.05)?;
///     state = body.projected(&state)?;
/// }
/// assert!(body.velocity(&state).z.abs() < 1e-14);
/// assert!((body.energy(&state) - energy).abs() < 1e-6);
/// # Ok::<(), affinor::Error>(())
/// ```
pub type Reduced<G, C, M> = EulerPoincare<G, ConstraintForce<G, C, M>>;

/// The forces of a constrained system, including the forces of its constraints.
#[derive(Clone, Debug)]
pub struct ConstraintForce<G, C, M> {
    system: Constrained<G, C, M>,
    invariant: Option<Invariant>,
}

/// The forces of left-invariant constraints.
#[derive(Clone, Debug)]
struct Invariant {
    /// The transpose of the orthogonal projector `P`.
    projector: DMatrix<f64>,
    /// The bilinear map `(P - 1)^l_i Lambda^j_kl v^k H_j`.
    inertial: Bilinear,
}

impl<G, C, M> ConstraintForce<G, C, M> {
    /// The system with multipliers.
    pub fn system(&self) -> &Constrained<G, C, M> {
        &self.system
    }

    /// Whether all constraints are left-invariant, so that the equations are the
    /// Euler-Poincare-Suslov equations.
    pub fn is_invariant(&self) -> bool {
        self.invariant.is_some()
    }
}

impl<G: TranslationSplit + Clone, C: Constraint<G>, M: Torque<G>> Reduced<G, C, M> {
    /// The equations of a constrained system without multipliers. The connection and the metric are
    /// those of the constrained system.
    ///
    /// # Errors
    /// The errors of [`EulerPoincare::new`]; [`Error::Invalid`] if left-invariant constraints are
    /// dependent.
    pub fn reduced(
        system: Constrained<G, C, M>,
        connection: &Connection<f64>,
        metric: &Metric<f64>,
    ) -> Result<Self, Error> {
        let group = system.group().clone();
        let rows = system.constraint().invariant();
        let invariant = rows.map(|rows| Invariant::new(&system, &rows)).transpose()?;
        EulerPoincare::new(group, connection, metric, ConstraintForce { system, invariant })
    }
}

impl<G: TranslationSplit, C: Constraint<G>, M: Torque<G>> Reduced<G, C, M> {
    /// The state with a nearby element that satisfies the holonomic constraints, and with the
    /// [nearest velocity](Constrained::nearest_velocity) that satisfies all constraints.
    ///
    /// # Errors
    /// [`Error::Integration`] if the constraints are dependent, or if they are not satisfied near
    /// the element.
    pub fn projected(&self, state: &State<G>) -> Result<State<G>, Error> {
        let (system, time) = (&self.torque().system, state.time);
        let failed = || stopped(time, "the constraints cannot be satisfied near the end of a step");
        let mut element = state.element.clone();
        let mut last = f64::INFINITY;
        for _ in 0..ITERATIONS {
            let value = system.constraint().value(time, &element);
            if value.iter().all(|phi| *phi == 0.0) {
                last = 0.0;
                break;
            }
            let gradient = system.constraint().gradient(time, &element);
            let change = system.normal(&gradient, &-value).ok_or_else(failed)?;
            let size = change.largest();
            // stops at the rounding error of the element, where changes no longer decrease
            if size > 0.1 * last && last < NEAR {
                break;
            }
            element = system.moved(&element, &change);
            last = size;
        }
        if last >= NEAR || last.is_nan() {
            return Err(failed());
        }
        let velocity = self.velocity(state);
        let velocity = system.nearest_velocity(time, &element, &velocity).ok_or_else(failed)?;
        Ok(self.state(time, element, &velocity))
    }

    /// The multipliers of the constraints at a state, in the order of
    /// [`ConstrainedState::multipliers`](super::ConstrainedState::multipliers). Returns `None` if
    /// they are not unique or not finite.
    pub fn multipliers(&self, state: &State<G>) -> Option<DVector<f64>> {
        let velocity = self.velocity(state);
        let found = self.torque().system.accelerated(state.time, &state.element, &velocity);
        found.map(|(_, multipliers)| multipliers)
    }
}

/// The largest number of iterations of a projection onto the constraints.
const ITERATIONS: usize = 20;
/// The largest change by the last iteration of a successful projection.
const NEAR: f64 = 1e-6;

impl Invariant {
    fn new<G: TranslationSplit, C: Constraint<G>, M: Torque<G>>(
        system: &Constrained<G, C, M>,
        rows: &DMatrix<f64>,
    ) -> Result<Self, Error> {
        let n = system.group().dimension();
        let mut projector = DMatrix::identity(n, n);
        for i in 0..n {
            let vector = rows.column(i).into_owned();
            let normal = system.normal(rows, &vector).ok_or_else(|| {
                let reason = "the constraints on the velocity are dependent".into();
                Error::Invalid { what: "constraints", reason }
            })?;
            let mut column = projector.column_mut(i);
            column -= self::column(&normal);
        }
        let removed = &projector - DMatrix::identity(n, n);
        let inertial = system.inertial().combined(&removed);
        Ok(Invariant { projector: projector.transpose(), inertial })
    }
}

impl<G: TranslationSplit, C: Constraint<G>, M: Torque<G>> Torque<G> for ConstraintForce<G, C, M> {
    fn add(&self, time: f64, element: &G::Element, velocity: &G::Vector, force: &mut G::Vector) {
        let system = &self.system;
        let mut moment = G::Vector::zeros(system.group().dimension());
        system.force().add(time, element, velocity, &mut moment);
        if let Some(Invariant { projector, inertial }) = &self.invariant {
            let momentum =
                G::Vector::from_components((system.mass() * column(velocity)).as_slice());
            let moment = projector * column(&moment);
            *force = force.clone()
                + inertial.apply(velocity, &momentum)
                + G::Vector::from_components(moment.as_slice());
            return;
        }
        let rows = system.velocity_constraints(time, element).rows;
        let reaction = match system.accelerated(time, element, velocity) {
            Some((_, multipliers)) => rows.tr_mul(&multipliers),
            // a step with such a stage fails
            None => DVector::repeat(rows.ncols(), f64::NAN),
        };
        *force = force.clone() + moment - G::Vector::from_components(reaction.as_slice());
    }
}
