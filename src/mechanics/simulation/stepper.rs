//! Ways to advance a state: fixed steps, controlled steps, or a solution in closed form.

use super::fixed_steps::FixedSteps;
use crate::Error;
use crate::mechanics::integrators::Pair;
use crate::mechanics::integrators::runge_kutta::LocalCoordinates;
use crate::mechanics::{Adaptive, CotangentSystem, Integrator, State, System, stopped};
use std::sync::Arc;

/// The way in which a motion advances. It contains all data, in addition to the state, on which the
/// next step depends.
pub enum Stepper<S: System> {
    /// Steps of equal length.
    Fixed {
        /// The method.
        integrator: Arc<dyn Integrator<S> + Send + Sync>,
        /// The steps to the next output time.
        steps: FixedSteps,
    },
    /// Steps whose lengths are controlled by a tolerance.
    Adaptive {
        /// The function that makes a step: [`Adaptive::step`](crate::mechanics::Adaptive::step).
        control: Arc<Control<S>>,
        /// The largest number of steps from one output time to the next.
        max_steps: usize,
        /// The step size to try next.
        next: f64,
        /// The number of steps since the last output time.
        taken: usize,
    },
    /// A solution in closed form, which yields the state at any time.
    Exact {
        /// The function that returns the state at a time.
        at: Arc<At<S>>,
        /// A bound of the angular velocity, in radians per unit of time.
        rate: f64,
    },
}

/// The largest rotation between two checks for events, in radians.
const TURN: f64 = 0.25;
const EXACT_TURN: f64 = 0.0625;

/// A function that makes a controlled step of a system and its state towards a time. It updates the
/// step size to try next.
type Control<S> =
    dyn Fn(&S, &mut <S as System>::State, &mut f64, f64) -> Result<(), Error> + Send + Sync;

/// A function that returns the state at a time.
type At<S> = dyn Fn(f64) -> Result<<S as System>::State, Error> + Send + Sync;

// implemented by hand, because a derived implementation would require `S: Clone`
impl<S: System> Clone for Stepper<S> {
    fn clone(&self) -> Self {
        match self {
            Stepper::Fixed { integrator, steps } => {
                Stepper::Fixed { integrator: integrator.clone(), steps: *steps }
            }
            &Stepper::Adaptive { ref control, max_steps, next, taken } => {
                Stepper::Adaptive { control: control.clone(), max_steps, next, taken }
            }
            Stepper::Exact { at, rate } => Stepper::Exact { at: at.clone(), rate: *rate },
        }
    }
}

impl<S: System> Stepper<S> {
    /// Steps whose length is at most `step`.
    pub(super) fn fixed(integrator: impl Integrator<S> + Send + Sync + 'static, step: f64) -> Self {
        Stepper::Fixed { integrator: Arc::new(integrator), steps: FixedSteps::new(step) }
    }

    /// A solution in closed form: `at` returns the state at any time.
    pub(super) fn exact(
        at: impl Fn(f64) -> Result<S::State, Error> + Send + Sync + 'static,
        rate: f64,
    ) -> Self {
        Stepper::Exact { at: Arc::new(at), rate }
    }

    /// Steps that the function `control` makes, which chooses their lengths; `next` is the first
    /// step size to try.
    pub(super) fn by(
        control: impl Fn(&S, &mut S::State, &mut f64, f64) -> Result<(), Error> + Send + Sync + 'static,
        max_steps: usize,
        next: f64,
    ) -> Self {
        Stepper::Adaptive { control: Arc::new(control), max_steps, next, taken: 0 }
    }

    /// The same steps, each followed by a change of the state.
    pub(super) fn followed_by(
        self,
        after: impl Fn(&S, &mut S::State) -> Result<(), Error> + Send + Sync + 'static,
    ) -> Self
    where
        S: 'static,
    {
        match self {
            Stepper::Fixed { integrator, steps } => {
                Stepper::Fixed { integrator: Arc::new(Followed { integrator, after }), steps }
            }
            Stepper::Adaptive { control, max_steps, next, taken } => {
                let control = move |system: &S, state: &mut S::State, next: &mut f64, end| {
                    control(system, state, next, end)?;
                    after(system, state)
                };
                Stepper::Adaptive { control: Arc::new(control), max_steps, next, taken }
            }
            Stepper::Exact { at, rate } => Stepper::Exact { at, rate },
        }
    }

    /// Makes one step towards the time `until`. Returns the time that has been reached. Steps of
    /// free length end no later than `end`, a time on the way to `until`.
    pub(super) fn step(
        &mut self,
        system: &S,
        state: &mut S::State,
        until: f64,
        end: f64,
    ) -> Result<f64, Error> {
        let time = system.time(state);
        match self {
            Stepper::Fixed { integrator, steps } => {
                steps.step(time, until, |h| integrator.step(system, state, h))
            }
            Stepper::Adaptive { control, max_steps, next, taken } => {
                if *taken == *max_steps {
                    return Err(stopped(
                        time,
                        format!(
                            "{taken} steps did not reach t = {until}: the problem is stiff, or output times are far apart"
                        ),
                    ));
                }
                control(system, state, next, end)?;
                let reached = system.time(state);
                *taken = if reached == until { 0 } else { *taken + 1 };
                Ok(reached)
            }
            Stepper::Exact { at, .. } => {
                *state = at(end)?;
                Ok(end)
            }
        }
    }

    /// The longest step between two checks for events, where `rate` returns the angular velocity.
    /// The result is infinite for fixed steps.
    pub(super) fn longest(&self, rate: impl FnOnce() -> f64) -> f64 {
        match self {
            Stepper::Fixed { .. } => f64::INFINITY,
            Stepper::Exact { rate, .. } => EXACT_TURN / rate,
            Stepper::Adaptive { .. } => TURN / rate(),
        }
    }
}

/// A method whose steps are followed by a change of the state.
struct Followed<S: System, F> {
    integrator: Arc<dyn Integrator<S> + Send + Sync>,
    after: F,
}

impl<S: System, F: Fn(&S, &mut S::State) -> Result<(), Error>> Integrator<S> for Followed<S, F> {
    fn step(&self, system: &S, state: &mut S::State, h: f64) -> Result<(), Error> {
        let mut next = state.clone();
        self.integrator.step(system, &mut next, h)?;
        (self.after)(system, &mut next)?;
        *state = next;
        Ok(())
    }
}

impl<S: CotangentSystem + 'static> Stepper<S> {
    /// Steps of an embedded pair with step-size control, in the local coordinates `C`.
    pub(super) fn controlled<C: LocalCoordinates<S::Group> + Copy + Send + Sync + 'static>(
        pair: Pair,
        control: Adaptive,
        coordinates: impl FnOnce(Adaptive) -> Adaptive<C>,
    ) -> Self {
        let control = coordinates(Adaptive { pair, ..control });
        let (max_steps, next) = (control.max_steps, control.first_step());
        let step = move |system: &S, state: &mut State<S::Group>, next: &mut f64, end: f64| {
            control.step(system, state, next, end)
        };
        Stepper::by(step, max_steps, next)
    }
}
