//! The generalized-alpha method on groups, with constraints.

use super::Integrator;
use crate::Error;
use crate::group::{Coordinates, LieGroup, TranslationSplit};
use crate::mechanics::systems::constrained::{Constrained, ConstrainedState, column};
use crate::mechanics::systems::constraint::{Constraint, VelocityConstraints};
use crate::mechanics::systems::euler_poincare::Torque;
use crate::mechanics::systems::saddle::{saddle, solve, stacked};

/// The generalized-alpha method for constrained systems, in the index-3 formulation. After each
/// step, the constraints are satisfied, and their time derivatives vanish up to the order of the
/// method.
///
/// ```text
/// q_(n+1) = q_n exp(h x),   x = v_n + h (1/2 - beta) a_n + h beta a_(n+1)
/// v_(n+1) = v_n + h (1 - gamma) a_n + h gamma a_(n+1)
/// (1 - alpha_m) a_(n+1) + alpha_m a_n = (1 - alpha_f) v'_(n+1) + alpha_f v'_n
/// ```
///
/// The equations of motion, the constraints `Phi = 0` and the constraints `A v = b` at `n + 1` are
/// solved for `v'_(n+1)` and `lambda_(n+1)` by Newton's method. The coefficients depend on the spectral radius `rho` of a
/// step at infinite frequency: `alpha_m = (2 rho - 1)/(rho + 1)`, `alpha_f = rho/(rho + 1)`,
/// `gamma = 1/2 + alpha_f - alpha_m`, `beta = (gamma + 1/2)^2/4`. The method has order 2 in `q`,
/// `v` and `lambda`; fast oscillations are damped.
///
/// The algorithmic acceleration `a` approximates `v'(t + D h)` with `D = alpha_m - alpha_f`, and
/// the first step starts with this value. The initial velocity of the first step is corrected along
/// `J^-1 B^T`, by the normal part of `h^2 ((1/6 - D/2 - beta) v'' + [v, v']/12)`. With this start,
/// the error of `lambda` is of order 2 from the first step on. All steps should have equal lengths:
/// a change of the step size causes an error of order 1 in `lambda`, which is damped.
///
/// O. Bruels, A. Cardona and M. Arnold, *Mechanism and Machine Theory* 48 (2012) 121-137. For the
/// start, see M. Arnold, O. Bruels and A. Cardona, *Numer. Math.* 129 (2015) 149-179.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GeneralisedAlpha {
    /// The spectral radius `rho`, in `[0, 1]`.
    pub spectral_radius: f64,
}

impl Default for GeneralisedAlpha {
    /// The method with `rho = 0.9`.
    fn default() -> Self {
        GeneralisedAlpha { spectral_radius: 0.9 }
    }
}

/// The coefficients of the method.
struct Coefficients {
    alpha_m: f64,
    alpha_f: f64,
    beta: f64,
    gamma: f64,
}

/// The end of a step, for a given acceleration at the end.
struct End<G: LieGroup> {
    /// The increment `h x` of the element.
    increment: G::Vector,
    element: G::Element,
    velocity: G::Vector,
    /// The algorithmic acceleration `a`.
    filtered: G::Vector,
}

impl GeneralisedAlpha {
    /// The largest number of Newton iterations in a step.
    pub const ITERATIONS: usize = 20;

    /// The order of convergence.
    pub fn order(&self) -> u32 {
        2
    }

    fn coefficients(&self) -> Coefficients {
        let rho = self.spectral_radius;
        let (alpha_m, alpha_f) = ((2.0 * rho - 1.0) / (rho + 1.0), rho / (rho + 1.0));
        let gamma = 0.5 + alpha_f - alpha_m;
        Coefficients { alpha_m, alpha_f, gamma, beta: 0.25 * (gamma + 0.5).powi(2) }
    }
}

impl Coefficients {
    /// The offset `D`, which is the difference in time between the algorithmic and the true
    /// acceleration, per unit step.
    fn lead(&self) -> f64 {
        self.alpha_m - self.alpha_f
    }

    /// The coefficient of `v'_(n+1)` in `a_(n+1)`.
    fn share(&self) -> f64 {
        (1.0 - self.alpha_f) / (1.0 - self.alpha_m)
    }

    /// The initial condition, with its algorithmic acceleration.
    fn started<G: TranslationSplit, C: Constraint<G>, M: Torque<G>>(
        &self,
        system: &Constrained<G, C, M>,
        state: &ConstrainedState<G>,
        h: f64,
    ) -> Option<ConstrainedState<G>> {
        let (v, a) = (&state.velocity, &state.acceleration);
        // computes v'' only from differences at later times, because a force may jump at the start
        let s = h / 8.0;
        let after = |s: f64| {
            let x = v.clone() * s + a.clone() * (0.5 * s * s);
            let velocity = v.clone() + a.clone() * s;
            system.accelerated(state.time + s, &system.moved(&state.element, &x), &velocity)
        };
        let [near, far] = [after(s)?.0 - a.clone(), after(2.0 * s)?.0 - a.clone()];
        let jerk = (near * 4.0 - far) * (0.5 / s);
        let defect = jerk.clone() * (1.0 / 6.0 - 0.5 * self.lead() - self.beta)
            + system.group().bracket(v, a) * (1.0 / 12.0);
        let constraints = system.velocity_constraints(state.time, &state.element);
        // constraints on the velocity remain satisfied
        let mut normal = &constraints.rows * column(&defect);
        normal.rows_range_mut(constraints.holonomic..).fill(0.0);
        let moved = system.normal(&constraints.rows, &normal)?;
        let velocity = v.clone() + moved * (h * h);
        Some(ConstrainedState { velocity, lead: Some(jerk * self.lead()), ..state.clone() })
    }

    fn end<G: TranslationSplit, C: Constraint<G>, M: Torque<G>>(
        &self,
        system: &Constrained<G, C, M>,
        state: &ConstrainedState<G>,
        acceleration: &G::Vector,
        h: f64,
    ) -> End<G> {
        let before = match &state.lead {
            Some(lead) => state.acceleration.clone() + lead.clone() * h,
            None => state.acceleration.clone(),
        };
        let old = state.acceleration.clone() * self.alpha_f - before.clone() * self.alpha_m;
        let filtered = acceleration.clone() * self.share() + old * (1.0 / (1.0 - self.alpha_m));
        let part = |first: f64, second: f64| before.clone() * first + filtered.clone() * second;
        let x = state.velocity.clone() + part(0.5 - self.beta, self.beta) * h;
        let increment = x * h;
        let velocity = state.velocity.clone() + part(1.0 - self.gamma, self.gamma) * h;
        End { element: system.moved(&state.element, &increment), increment, velocity, filtered }
    }
}

impl<G: TranslationSplit, C: Constraint<G>, M: Torque<G>> Integrator<Constrained<G, C, M>>
    for GeneralisedAlpha
{
    fn step(
        &self,
        system: &Constrained<G, C, M>,
        state: &mut ConstrainedState<G>,
        h: f64,
    ) -> Result<(), Error> {
        let stopped = |reason: String| Error::Integration { t: state.time, reason };
        let rho = self.spectral_radius;
        if !(0.0..=1.0).contains(&rho) {
            return Err(stopped(format!("the spectral radius {rho} is not in [0, 1]")));
        }
        if !h.is_finite() || h == 0.0 {
            return Err(stopped(format!("the step size {h} is zero or not finite")));
        }
        let method = self.coefficients();
        let singular = || stopped("the equations of a step are singular or not finite".into());
        let start = match &state.lead {
            Some(_) => state.clone(),
            None => method.started(system, state, h).ok_or_else(singular)?,
        };
        let (n, time) = (system.group().dimension(), state.time + h);
        // the derivatives of the velocity and of the increment with respect to v'_(n+1)
        let (in_velocity, in_increment) =
            (method.gamma * method.share() * h, method.beta * method.share() * h * h);
        let mut acceleration = start.acceleration.clone();
        let mut multipliers = start.multipliers.clone();
        let mut last = f64::INFINITY;
        for _ in 0..Self::ITERATIONS {
            let end = method.end(system, &start, &acceleration, h);
            let constraints = system.velocity_constraints(time, &end.element);
            let (gradient, holonomic) = (&constraints.rows, constraints.holonomic);
            // the constraint force minus all other forces, and the violation of the constraints on
            // the velocity
            let pull = |end: &End<G>, constraints: &VelocityConstraints| {
                let force = constraints.rows.tr_mul(&multipliers)
                    - system.forces(time, &end.element, &end.velocity);
                let off = constraints.residual(&column(&end.velocity));
                (force, off.rows_range(holonomic..) / in_velocity)
            };
            let (here, off) = pull(&end, &constraints);
            let residual = system.mass() * column(&acceleration) + &here;
            let value = system.constraint().value(time, &end.element) / in_increment;
            let value = stacked(&value, &off);
            let speed = end.velocity.largest() + h.abs() * acceleration.largest();
            let nudge = if speed > 0.0 { 1e-7 * speed } else { 1e-7 } / in_velocity;
            let mut tangent = system.mass().clone();
            let inner =
                system.group().operator_matrix(|x| system.group().tangent_left(&end.increment, x));
            let mut rows = gradient * inner;
            for i in 0..n {
                let other = acceleration.clone() + system.group().basis_vector(i) * nudge;
                let other = method.end(system, &start, &other, h);
                let there = system.velocity_constraints(time, &other.element);
                let (force, other_off) = pull(&other, &there);
                let mut column = tangent.column_mut(i);
                column += (force - &here) / nudge;
                let mut column = rows.view_mut((holonomic, i), (off.len(), 1));
                column.copy_from(&((other_off - &off) / nudge));
            }
            let matrix = saddle(&tangent, gradient, &rows);
            let change = solve(matrix, &-stacked(&residual, &value)).ok_or_else(singular)?;
            let by = G::Vector::from_components(&change.as_slice()[..n]);
            acceleration = acceleration + by.clone();
            multipliers += change.rows_range(n..);
            let (size, motion) = (by.largest(), by.largest() * in_increment.abs());
            // stops Newton's method at the rounding error of the element, which corresponds to a
            // large change of the acceleration
            let entries = || system.group().matrix(&end.element).amax();
            let still = size > 0.1 * last && motion < 1e-11 * (entries() + end.increment.largest());
            if still || size <= f64::EPSILON * acceleration.largest() {
                let End { element, velocity, filtered, .. } =
                    method.end(system, &start, &acceleration, h);
                let lead = Some((filtered - acceleration.clone()) * (1.0 / h));
                *state =
                    ConstrainedState { time, element, velocity, acceleration, multipliers, lead };
                return Ok(());
            }
            last = size;
        }
        let limit = Self::ITERATIONS;
        Err(stopped(format!(
            "Newton's method does not converge in {limit} iterations for a step of {h}"
        )))
    }
}
