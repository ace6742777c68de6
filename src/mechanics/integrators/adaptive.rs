//! Step-size control by embedded Runge-Kutta pairs.

use super::munthe_kaas::ExponentialCoordinates;
use super::projected::Projection;
use super::runge_kutta::{LocalCoordinates, RungeKutta, expect_coordinates};
use super::step_start::StepStart;
use super::tolerance::Allowed;
use crate::Error;
use crate::mechanics::stopped;
use crate::mechanics::systems::cotangent::{CotangentSystem, State};
use crate::numerics::ode::LEAST_STEP;
use crate::numerics::tableaux::{DormandPrince, DormandPrince8, Tabulated};

/// The embedded Runge-Kutta pairs of Dormand and Prince.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Pair {
    /// The pair of order 5.
    #[default]
    Five,
    /// The pair of order 8, which is faster for small tolerances.
    Eight,
}

impl Pair {
    /// The order of convergence.
    pub fn order(self) -> u32 {
        match self {
            Pair::Five => DormandPrince::TABLEAU.order,
            Pair::Eight => DormandPrince8::TABLEAU.order,
        }
    }
}

/// A pair of Dormand and Prince with step-size control.
///
/// A step is accepted if its estimated error is within the tolerance. Rotations and
/// [translations](crate::group::TranslationSplit::translational_part) have separate scales. Let `r`
/// be the relative tolerance. The error may be as large as the larger of the absolute and the
/// relative part:
///
/// | error of | absolute part | relative part |
/// |---|---|---|
/// | rotations (radians) | `a_1`, by default `r` | `r/10` of the rotation in the step |
/// | translations | `a_2`, by default `r` times the radius of gyration | `r/10` of the path in the step |
/// | momentum of rotations | the momentum that rotates the body by `a_1` in the time `span` | `r` of the larger momentum at both ends |
/// | momentum of translations | the momentum that moves the body by `a_2` in the time `span` | `r` of the larger momentum at both ends |
///
/// The radius of gyration is the square root of the largest moment of inertia over the largest
/// mass, or 1 if there are no rotations or no translations. If a system has no inertia, the error
/// of the momentum is relative to its largest component. In free motions with
/// [`projected`](Adaptive::projected) steps, the momentum is a function of the element, so only the
/// errors of the element count.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Adaptive<C = ExponentialCoordinates> {
    /// The pair.
    pub pair: Pair,
    /// The relative tolerance `r` per step.
    pub tolerance: f64,
    /// The absolute tolerances: `a_1` of rotations, and `a_2` of translations. If the value is
    /// `None`, the defaults of the table apply.
    pub absolute: Option<[f64; 2]>,
    /// The time during which an error of a velocity accumulates, such as the length of the run. If
    /// it is infinite, the tolerance of momenta has no absolute part.
    pub span: f64,
    /// The largest number of steps between two output times.
    pub max_steps: usize,
    /// The longest step. A force that acts for a shorter time may be missed.
    pub max_step: f64,
    /// The local coordinates of steps.
    pub coordinates: C,
}

impl Adaptive {
    /// The pair of order 5 with this relative tolerance. It makes at most a million steps of any
    /// length, and has no absolute tolerance of momenta.
    pub fn new(tolerance: f64) -> Self {
        Adaptive {
            pair: Pair::Five,
            tolerance,
            absolute: None,
            span: f64::INFINITY,
            max_steps: 1_000_000,
            max_step: f64::INFINITY,
            coordinates: ExponentialCoordinates,
        }
    }

    /// The method as in [`new`](Self::new), with the pair of order 8.
    pub fn of_order_8(tolerance: f64) -> Self {
        Adaptive { pair: Pair::Eight, ..Self::new(tolerance) }
    }

    /// The same method with steps of [`Projected`](super::Projected).
    pub fn projected(self) -> Adaptive<Projection> {
        let Adaptive { pair, tolerance, absolute, span, max_steps, max_step, .. } = self;
        let coordinates = Projection;
        Adaptive { pair, tolerance, absolute, span, max_steps, max_step, coordinates }
    }
}

impl<C: Copy> Adaptive<C> {
    /// The first step size to try. It is at most 0.1 units of time; the step-size control corrects
    /// it immediately.
    pub fn first_step(&self) -> f64 {
        self.tolerance.powf(self.exponent()).min(0.1).min(self.max_step)
    }

    /// The first step size to try from a state. It is a fraction of the shortest time scale: of the
    /// rotation, or of the relative changes of the momenta of rotations and of translations. It
    /// equals [`first_step`](Self::first_step) at rest, or if nothing changes.
    pub fn first_step_from<S: CotangentSystem>(&self, system: &S, state: &State<S::Group>) -> f64 {
        let fastest = StepStart::new(system, state).fastest();
        let guess = self.tolerance.powf(self.exponent()) / fastest;
        let is_guess = guess.is_finite() && guess > 0.0;
        if is_guess { guess.min(self.max_step) } else { self.first_step() }
    }

    /// The exponent `1/order` in the dependence of the step size on the error.
    fn exponent(&self) -> f64 {
        1.0 / f64::from(self.pair.order())
    }

    /// Makes one accepted step from a state towards `end`. The step does not exceed `end`. The
    /// parameter `next` is the step size to try; it becomes the proposed size of the next step. A
    /// step depends only on `end`, `next` and the state.
    ///
    /// # Errors
    /// [`Error::Integration`] if steps become too small: at a pole, at a value that is not finite,
    /// or in a stiff problem. The same error is returned if a tolerance or a step is not positive,
    /// or if the end is not finite.
    pub fn step<S: CotangentSystem>(
        &self,
        system: &S,
        state: &mut State<S::Group>,
        next: &mut f64,
        end: f64,
    ) -> Result<(), Error>
    where
        C: LocalCoordinates<S::Group>,
    {
        expect_coordinates::<_, C>(system.group(), state.time)?;
        if [self.tolerance, self.max_step, *next].iter().any(|x| x.is_nan() || *x <= 0.0) {
            let reason = "the tolerance, the longest step and the step to try are positive";
            return Err(stopped(state.time, reason));
        }
        if !end.is_finite() {
            return Err(stopped(state.time, format!("the end is {end}, which is not finite")));
        }
        let allowed = Allowed::new(self.tolerance, self.absolute, self.span, system.sizes());
        loop {
            let left = end - state.time;
            *next = next.min(self.max_step);
            let last = *next >= left.abs();
            let h = if last { left } else { next.copysign(left) };
            let is_lost = state.time + h == state.time;
            let is_rounding = !last && h.abs() < LEAST_STEP * state.time.abs();
            if !h.is_finite() || is_lost || is_rounding {
                return Err(stopped(state.time, "the steps become too small"));
            }
            let (five, eight) =
                (RungeKutta::<_, _, C>::DORMAND_PRINCE, RungeKutta::<_, _, C>::DORMAND_PRINCE_8);
            let advanced = match self.pair {
                Pair::Five => five.advanced(system, state, h, &allowed),
                Pair::Eight => eight.advanced(system, state, h, &allowed),
            };
            let (reached, error) = match advanced {
                Ok((reached, error)) if error.is_finite() => (reached, error),
                // tries a shorter step, which may still succeed
                _ => {
                    *next = 0.2 * h.abs();
                    continue;
                }
            };
            if !last || error > 1.0 {
                *next = h.abs() * (0.9 * error.powf(-self.exponent())).clamp(0.2, 5.0);
            }
            if error <= 1.0 {
                *state = State { time: if last { end } else { reached.time }, ..reached };
                return Ok(());
            }
        }
    }

    /// The states at the given times, in the same order. A step ends at each of these times.
    ///
    /// # Errors
    /// [`Error::Integration`] with the time that has been reached.
    pub fn states<S: CotangentSystem>(
        &self,
        system: &S,
        start: &State<S::Group>,
        times: &[f64],
    ) -> Result<Vec<State<S::Group>>, Error>
    where
        C: LocalCoordinates<S::Group>,
    {
        let mut state = start.clone();
        let mut next = self.first_step();
        let mut states = Vec::with_capacity(times.len());
        for &end in times {
            let mut steps = 0;
            while state.time != end {
                if steps == self.max_steps {
                    return Err(stopped(state.time, "too many steps"));
                }
                steps += 1;
                self.step(system, &mut state, &mut next, end)?;
            }
            states.push(state.clone());
        }
        Ok(states)
    }
}
