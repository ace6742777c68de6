//! Mechanical systems with constraints on a group.

use super::System;
use super::bilinear::Bilinear;
use super::constraint::{Constraint, VelocityConstraints};
use super::euler_poincare::{Free, Torque, expect_on_group};
use super::saddle::{saddle, solve, stacked};
use crate::group::{Coordinates, LieGroup, TranslationSplit};
use crate::{Connection, Error, Metric};
use nalgebra::{DMatrix, DVector};

/// The system of a connection, a metric `J`, external forces `M` and constraints on a group:
///
/// ```text
/// q' = q v,   J_ij v'^j = Lambda^j_ki v^k J_jl v^l + M_i(t, q, v) - B^a_i lambda_a - A^b_i lambda_b
/// Phi^a(t, q) = 0,   A^b_i(t, q) v^i = b^b(t, q)
/// ```
///
/// in left (body) components. These are the equations of motion (104) of
/// [`EulerPoincare`](super::EulerPoincare), with Lagrange multipliers `lambda`; `q` and `v` replace
/// `g` and `Omega`. With the connection `plus`, they are the Euler-Poincare equations.
/// `B^a_i = e_i(Phi^a)` is the [gradient](Constraint::gradient). By the principle of Lagrange and
/// d'Alembert, the constraint forces do no work on velocities with `B v = 0` and `A v = 0`. The
/// multipliers of the holonomic constraints come first. The constraints must be independent, which
/// means that the rows of `B` and `A` are linearly independent where `Phi = 0`.
///
/// A. M. Bloch, *Nonholonomic Mechanics and Control* (2015), chapter 5.
///
/// ```
/// use affinor::mechanics::{Constrained, Constraint, GeneralisedAlpha, Integrator};
/// use affinor::group::{LieGroup, Translations};
/// use affinor::{CanonicalConnection, Connection, Metric};
/// use affinor::tensors::{Down, Tensor};
/// use nalgebra::{Const, DMatrix, DVector, Vector2, dvector};
/// // a pendulum of length 1 and mass 1 in the plane, gravity 1
/// struct Rod;
/// impl Constraint<Translations<Const<2>>> for Rod {
///     fn value(&self, _: f64, x: &Vector2<f64>) -> DVector<f64> {
///         dvector![0.5 * (x.norm_squared() - 1.0)]
///     }
///     fn gradient(&self, _: f64, x: &Vector2<f64>) -> DMatrix<f64> {
///         DMatrix::from_row_slice(1, 2, &[x.x, x.y])
///     }
/// }
/// let plane = Translations(Const::<2>);
/// let unit = Tensor::from_components(2, &[Down, Down], [([0, 0], 1.0), ([1, 1], 1.0)])?;
/// let mass = Metric::new(plane.algebra()?.labels(), unit)?;
/// let plus = Connection::canonical(&plane.algebra()?, CanonicalConnection::Plus);
/// let gravity = |_: f64, _: &Vector2<f64>, _: &Vector2<f64>| Vector2::new(0.0, -1.0);
/// let pendulum = Constrained::new(plane, &plus, &mass, gravity, Rod)?;
/// let mut state = pendulum.state(0.0, Vector2::new(1.0, 0.0), &Vector2::zeros())?;
/// for _ in 0..100 {
///     GeneralisedAlpha::default().step(&pendulum, &mut state, 0.01)?;
/// }
/// // v^2 = -2 y; the rod carries v^2 - y
/// assert!((state.velocity.norm_squared() + 2.0 * state.element.y).abs() < 1e-4);
/// assert!((state.multipliers[0] + 3.0 * state.element.y).abs() < 1e-3);
/// # Ok::<(), affinor::Error>(())
/// ```
#[derive(Clone, Debug)]
pub struct Constrained<G, C, M = Free> {
    group: G,
    mass: DMatrix<f64>,
    /// The bilinear map `Lambda^j_ki v^k H_j`.
    inertial: Bilinear,
    force: M,
    constraint: C,
}

/// A state of a constrained system.
#[derive(Debug)]
pub struct ConstrainedState<G: LieGroup> {
    /// The time.
    pub time: f64,
    /// The element `q`.
    pub element: G::Element,
    /// The velocity `v`, in left components.
    pub velocity: G::Vector,
    /// The acceleration `v'`.
    pub acceleration: G::Vector,
    /// The multipliers `lambda`.
    pub multipliers: DVector<f64>,
    /// The difference between the algorithmic and the true acceleration, per unit step. Only
    /// multistep methods use this value.
    pub(crate) lead: Option<G::Vector>,
}

// implemented by hand, because derived implementations would require `G: Clone` and `G: PartialEq`
impl<G: LieGroup<Element: PartialEq>> PartialEq for ConstrainedState<G> {
    fn eq(&self, other: &Self) -> bool {
        let all = |state: &Self| {
            let velocities = (state.velocity.clone(), state.acceleration.clone());
            (state.time, velocities, state.multipliers.clone(), state.lead.clone())
        };
        self.element == other.element && all(self) == all(other)
    }
}

impl<G: LieGroup> Clone for ConstrainedState<G> {
    fn clone(&self) -> Self {
        ConstrainedState {
            time: self.time,
            element: self.element.clone(),
            velocity: self.velocity.clone(),
            acceleration: self.acceleration.clone(),
            multipliers: self.multipliers.clone(),
            lead: self.lead.clone(),
        }
    }
}

/// The relative tolerance of the constraints at the initial condition.
const OFF: f64 = 1e-8;
/// If the relative size of the independent part of a gradient is at most this value, the gradient
/// counts as dependent on others.
const DEPENDENT: f64 = 1e-10;
/// The relative tolerance between a gradient and its difference quotients.
const ROUGH: f64 = 1e-4;
/// The relative change of a gradient over the step of its difference quotients.
const BEND: f64 = 1e-3;
/// A gradient without change up to this displacement counts as constant.
const STRAIGHT: f64 = 1e12;
/// Rounding errors may cause this relative change of a gradient.
const NOISE: f64 = 1e-12;
/// The largest number of trial steps in the search for a step of difference quotients.
const STEPS: usize = 60;

impl<G: TranslationSplit, C: Constraint<G>, M: Torque<G>> Constrained<G, C, M> {
    /// The system of a connection and a metric on the algebra of the group, in the basis of the
    /// group, with forces and constraints.
    ///
    /// # Errors
    /// [`Error::Shape`] unless the connection refers to the left-invariant frame of the group, and
    /// the metric has the dimension of the group.
    pub fn new(
        group: G,
        connection: &Connection<f64>,
        metric: &Metric<f64>,
        force: M,
        constraint: C,
    ) -> Result<Self, Error> {
        expect_on_group(&group, connection, metric)?;
        let inertial = Bilinear::of_momentum(connection.affinities());
        let mass = metric.components().to_dmatrix()?;
        Ok(Constrained { group, mass, inertial, force, constraint })
    }

    /// The group.
    pub fn group(&self) -> &G {
        &self.group
    }

    /// The forces.
    pub fn force(&self) -> &M {
        &self.force
    }

    /// The constraints.
    pub fn constraint(&self) -> &C {
        &self.constraint
    }

    /// The state with this element and velocity. The acceleration and the multipliers are computed
    /// from them.
    ///
    /// # Errors
    /// [`Error::Shape`] unless the gradient has one row for each constraint, and one column for
    /// each component of a vector. [`Error::Invalid`] if a value is not finite, if the element or
    /// the velocity violates a constraint, if a gradient differs from the difference quotients, or
    /// if the constraints are dependent. If the velocity violates a constraint, the message contains
    /// the [nearest velocity](Self::nearest_velocity) that does not.
    pub fn state(
        &self,
        time: f64,
        element: G::Element,
        velocity: &G::Vector,
    ) -> Result<ConstrainedState<G>, Error> {
        let value = self.constraint.value(time, &element);
        let gradient = self.constraint.gradient(time, &element);
        expect_shape("the gradient of the constraints", value.len(), &gradient, &self.group)?;
        if let Some((matrix, right)) = self.constraint.affine(time, &element) {
            expect_shape("the matrix of the constraints", right.len(), &matrix, &self.group)?;
        }
        let constraints = self.velocity_constraints(time, &element);
        let gradient = &constraints.rows;
        let finite = velocity.is_finite() && gradient.iter().all(|b| b.is_finite());
        if !finite || !time.is_finite() {
            return Err(invalid("the time, the velocity or a gradient is not finite".into()));
        }
        for a in 0..gradient.nrows() {
            let row = gradient.row(a).transpose();
            if a < value.len() {
                self.expect_value(a, value[a], &row, (time, &element))?;
            }
            self.expect_velocity(a, &constraints, (time, &element), velocity)?;
            if a < value.len() {
                self.expect_derivative(a, &row, (time, &element))?;
            }
        }
        if let Some(force) = self.forces(time, &element, velocity).iter().find(|m| !m.is_finite()) {
            return Err(invalid(format!("a force is {force}")));
        }
        if let Some(a) = first_dependent(gradient) {
            let why = if gradient.row(a).norm() == 0.0 {
                "has a zero gradient here"
            } else {
                "is dependent: its gradient is a combination of the gradients of earlier constraints"
            };
            return Err(invalid(format!("constraint {} {why}", a + 1)));
        }
        let (acceleration, multipliers) = self
            .accelerated(time, &element, velocity)
            .ok_or_else(|| invalid("the constraints do not determine the acceleration".into()))?;
        let velocity = velocity.clone();
        Ok(ConstrainedState { time, element, velocity, acceleration, multipliers, lead: None })
    }

    /// The kinetic energy `J_ij v^i v^j/2` (98).
    pub fn kinetic_energy(&self, state: &ConstrainedState<G>) -> f64 {
        let velocity = column(&state.velocity);
        0.5 * velocity.dot(&(&self.mass * &velocity))
    }

    /// The largest violation of a constraint: `|Phi^a(t, q)|` of a holonomic constraint, and
    /// `|A^b_i v^i - b^b|` of a constraint on the velocity.
    pub fn violation(&self, state: &ConstrainedState<G>) -> f64 {
        self.violation_at(state.time, &state.element, &state.velocity)
    }

    /// The largest violation of a constraint at a time, an element and a velocity.
    pub(in crate::mechanics) fn violation_at(
        &self,
        time: f64,
        element: &G::Element,
        velocity: &G::Vector,
    ) -> f64 {
        let holonomic = self.constraint.value(time, element).amax();
        match self.constraint.affine(time, element) {
            Some((matrix, right)) => holonomic.max((matrix * column(velocity) - right).amax()),
            None => holonomic,
        }
    }

    /// The largest violation of a constraint by the velocity: `|B^a_i v^i + dPhi^a/dt|` for a
    /// holonomic constraint, and `|A^b_i v^i - b^b|` for a constraint on the velocity.
    pub fn velocity_violation(&self, state: &ConstrainedState<G>) -> f64 {
        let constraints = self.velocity_constraints(state.time, &state.element);
        constraints.residual(&column(&state.velocity)).amax()
    }

    /// The velocity nearest to `velocity` that satisfies all constraints at an element, where
    /// distances are measured by the kinetic energy. Returns `None` if it is not unique or not
    /// finite.
    pub fn nearest_velocity(
        &self,
        time: f64,
        element: &G::Element,
        velocity: &G::Vector,
    ) -> Option<G::Vector> {
        let constraints = self.velocity_constraints(time, element);
        let residual = constraints.residual(&column(velocity));
        Some(velocity.clone() - self.normal(&constraints.rows, &residual)?)
    }

    /// The smallest vector `x` with `rows x = right`, measured by the kinetic energy.
    pub(in crate::mechanics) fn normal(
        &self,
        rows: &DMatrix<f64>,
        right: &DVector<f64>,
    ) -> Option<G::Vector> {
        let n = self.group.dimension();
        let right = stacked(&DVector::zeros(n), right);
        let solution = solve(saddle(&self.mass, rows, rows), &right)?;
        Some(G::Vector::from_components(&solution.as_slice()[..n]))
    }

    /// All constraints on the velocity.
    pub(in crate::mechanics) fn velocity_constraints(
        &self,
        time: f64,
        element: &G::Element,
    ) -> VelocityConstraints {
        VelocityConstraints::at(&self.constraint, time, element)
    }

    /// The bilinear map `Lambda^j_ki v^k H_j`.
    pub(super) fn inertial(&self) -> &Bilinear {
        &self.inertial
    }

    pub(in crate::mechanics) fn mass(&self) -> &DMatrix<f64> {
        &self.mass
    }

    /// The element `q exp(x)`.
    pub(in crate::mechanics) fn moved(&self, element: &G::Element, x: &G::Vector) -> G::Element {
        self.group.compose(element, &self.group.exp(x))
    }

    /// The forces `Lambda^j_ki v^k J_jl v^l + M_i`.
    pub(in crate::mechanics) fn forces(
        &self,
        time: f64,
        element: &G::Element,
        velocity: &G::Vector,
    ) -> DVector<f64> {
        let momentum = G::Vector::from_components((&self.mass * column(velocity)).as_slice());
        let mut force = self.inertial.apply(velocity, &momentum);
        self.force.add(time, element, velocity, &mut force);
        column(&force)
    }

    /// The acceleration `v'` and the multipliers `lambda`, computed from the time derivatives of all
    /// constraints on the velocity. Returns `None` if the solution is not unique or not finite.
    pub(in crate::mechanics) fn accelerated(
        &self,
        time: f64,
        element: &G::Element,
        velocity: &G::Vector,
    ) -> Option<(G::Vector, DVector<f64>)> {
        let constraints = self.velocity_constraints(time, element);
        let drift = self.drift(&constraints, time, element, velocity);
        let right = stacked(&self.forces(time, element, velocity), &-drift);
        let rows = &constraints.rows;
        let solution = solve(saddle(&self.mass, rows, rows), &right)?;
        let n = self.group.dimension();
        let acceleration = G::Vector::from_components(&solution.as_slice()[..n]);
        Some((acceleration, solution.rows_range(n..).into_owned()))
    }

    /// The time derivatives of `rows v - right` at constant `v`.
    fn drift(
        &self,
        constraints: &VelocityConstraints,
        time: f64,
        element: &G::Element,
        velocity: &G::Vector,
    ) -> DVector<f64> {
        let given = self.constraint.second_rate(time, element, velocity);
        let holonomic = given.unwrap_or_else(|| {
            DVector::from_fn(constraints.holonomic, |a, _| {
                let is_timed = self.constraint.rate(time, element).is_some();
                let rate = |s: f64| {
                    let moved = self.moved(element, &(velocity.clone() * s));
                    let slope =
                        self.constraint.single(time + s, &moved, a).1.dot(&column(velocity));
                    slope + self.constraint.rate(time + s, &moved).map_or(0.0, |rates| rates[a])
                };
                let step = self.bend((time, element), velocity, a);
                step.or(is_timed.then_some(BEND)).map_or(0.0, |step| slope(rate, step))
            })
        });
        if constraints.rows.nrows() == constraints.holonomic {
            return holonomic;
        }
        stacked(&holonomic, &self.constraint.affine_rate(time, element, velocity))
    }
}

/// Checks of an initial condition. They do not depend on the units of length, time and mass.
impl<G: TranslationSplit, C: Constraint<G>, M: Torque<G>> Constrained<G, C, M> {
    /// Checks that an element satisfies a holonomic constraint. The check uses the value and the
    /// gradient of the constraint at the element.
    fn expect_value(
        &self,
        a: usize,
        value: f64,
        gradient: &DVector<f64>,
        at: (f64, &G::Element),
    ) -> Result<(), Error> {
        let normal = G::Vector::from_components(gradient.as_slice()) * (1.0 / gradient.norm());
        // estimates the change of the constraint over the length scale of its gradient
        let change = match self.bend(at, &normal, a) {
            Some(step) => gradient.norm() * step / BEND,
            None => 1.0 + gradient.norm(),
        };
        if value.is_nan() || value.abs() > OFF * change {
            return Err(invalid(format!("constraint {} is {value}, not 0", a + 1)));
        }
        Ok(())
    }

    /// Checks that a velocity satisfies a constraint.
    fn expect_velocity(
        &self,
        a: usize,
        constraints: &VelocityConstraints,
        (time, element): (f64, &G::Element),
        velocity: &G::Vector,
    ) -> Result<(), Error> {
        let row = constraints.rows.row(a).transpose();
        let (value, right) = (row.dot(&column(velocity)), constraints.right[a]);
        let rate = value - right;
        let terms = row.iter().enumerate().map(|(i, b)| b.abs() * self.largest_like(i, velocity));
        // adds a tolerance, because a body at rest may have a velocity such as sin(pi), which is
        // not exactly zero
        let rest = f64::EPSILON * row.norm();
        if rate.abs() <= rest + OFF * (terms.sum::<f64>() + right.abs()) {
            return Ok(());
        }
        let nearest = self.nearest_velocity(time, element, velocity).map_or(String::new(), |v| {
            let components: Vec<_> = v.components().iter().map(f64::to_string).collect();
            format!("; the nearest velocity that satisfies all is [{}]", components.join(", "))
        });
        let a = a + 1;
        Err(invalid(if a > constraints.holonomic {
            format!("constraint {a} on the velocity has the value {value}, not {right}{nearest}")
        } else {
            format!("constraint {a} changes at the rate {rate}, not 0{nearest}")
        }))
    }

    /// Checks the gradient of a constraint against difference quotients.
    fn expect_derivative(
        &self,
        a: usize,
        gradient: &DVector<f64>,
        (time, element): (f64, &G::Element),
    ) -> Result<(), Error> {
        let components = G::Vector::from_components(gradient.as_slice());
        for (i, &given) in gradient.iter().enumerate() {
            let unit = self.group.basis_vector(i);
            let step = self.bend((time, element), &unit, a).unwrap_or(STRAIGHT);
            let value = |s: f64| {
                let moved = self.moved(element, &(unit.clone() * s));
                self.constraint.single(time, &moved, a).0
            };
            let slope = slope(value, step);
            let like = self.largest_like(i, &components);
            let size = if like > 0.0 { like } else { gradient.amax() };
            if (given - slope).abs() > ROUGH * (size + slope.abs()) {
                let (a, i) = (a + 1, i + 1);
                let reason = format!(
                    "B^{a}_{i} is {given}, but the derivative of the constraint is {slope}"
                );
                return Err(invalid(reason));
            }
        }
        Ok(())
    }

    /// The largest component of a vector among the components with the same unit as component `i`:
    /// those of rotations, or those of translations.
    fn largest_like(&self, i: usize, x: &G::Vector) -> f64 {
        let is_place = |i: usize| {
            let translation = self.group.translational_part(&self.group.basis_vector(i));
            translation.is_some_and(|part| part.largest() > 0.0)
        };
        let like = x.components().iter().enumerate().filter(|(k, _)| is_place(*k) == is_place(i));
        like.map(|(_, x)| x.abs()).fold(0.0, f64::max)
    }

    /// The step `s` for which the gradient of a constraint changes by about the fraction [`BEND`]
    /// of its size between `q` and `q exp(s x)`. The result does not depend on the units of length
    /// and time. Returns `None` if the gradient does not change.
    fn bend(&self, (time, element): (f64, &G::Element), x: &G::Vector, a: usize) -> Option<f64> {
        let row = |s: f64| {
            let moved = self.moved(element, &(x.clone() * s));
            self.constraint.single(time, &moved, a).1
        };
        let (here, size) = (row(0.0), x.largest());
        let is_usual = size > 0.0 && size.is_finite() && here.norm() > 0.0;
        let (mut s, mut before) = if is_usual { (BEND / size, 0.0) } else { return None };
        let mut was_inside = false;
        for _ in 0..STEPS {
            let change = ((row(s) - &here).norm() + (row(-s) - &here).norm()) / (2.0 * here.norm());
            if change.is_nan() {
                // the constraint is not defined at the end of the trial step
                if was_inside {
                    return Some(0.05 * s);
                }
                s *= 0.1;
                continue;
            }
            was_inside = true;
            let factor = BEND / change;
            if (0.25..4.0).contains(&factor) {
                return Some(s);
            }
            // a small change that hardly increases with the step is bounded: returns a shorter
            // step, at which the change still increases
            if before > NOISE && change < 7.0 * before {
                return Some(1e-2 * s);
            }
            before = if factor > 10.0 { change } else { 0.0 };
            s *= factor.clamp(1e-2, 10.0);
            if s * size > STRAIGHT {
                return None;
            }
        }
        Some(s)
    }
}

/// Checks the shape of a matrix with `count` rows that act on vectors of a group.
fn expect_shape<G: LieGroup>(
    what: &'static str,
    count: usize,
    matrix: &DMatrix<f64>,
    group: &G,
) -> Result<(), Error> {
    let n = group.dimension();
    if matrix.shape() == (count, n) {
        return Ok(());
    }
    Err(Error::Shape {
        what,
        expected: format!("{count} rows and {n} columns"),
        found: format!("{} and {}", matrix.nrows(), matrix.ncols()),
    })
}

fn invalid(reason: String) -> Error {
    Error::Invalid { what: "state", reason }
}

/// The derivative of a function at 0, computed by a difference quotient of order 4.
fn slope(f: impl Fn(f64) -> f64, step: f64) -> f64 {
    let [near, far] = [step, 2.0 * step].map(|s| f(s) - f(-s));
    (8.0 * near - far) / (12.0 * step)
}

/// The index of the first row of a matrix that is a linear combination of earlier rows, up to
/// rounding errors.
fn first_dependent(matrix: &DMatrix<f64>) -> Option<usize> {
    let mut basis: Vec<DVector<f64>> = Vec::new();
    matrix.row_iter().position(|row| {
        let mut rest = row.transpose();
        // orthogonalizes twice, because rounding errors destroy orthogonality
        for direction in basis.iter().chain(&basis) {
            rest.axpy(-direction.dot(&rest), direction, 1.0);
        }
        let is_dependent = rest.norm() <= DEPENDENT * row.norm();
        basis.push(rest.normalize());
        is_dependent
    })
}

pub(in crate::mechanics) fn column<V: Coordinates>(x: &V) -> DVector<f64> {
    DVector::from_column_slice(x.components())
}

impl<G: TranslationSplit, C: Constraint<G>, M: Torque<G>> System for Constrained<G, C, M> {
    type State = ConstrainedState<G>;

    fn time(&self, state: &ConstrainedState<G>) -> f64 {
        state.time
    }
}
