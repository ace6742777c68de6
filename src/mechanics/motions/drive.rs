//! Ways to advance a state: fixed steps, controlled steps, or a solution in closed form.

use super::pace::Pace;
use super::snapshot::{Reader, Saved, Snapshot};
use super::{Method, SimulationGroup};
use crate::Error;
use crate::mechanics::integrators::Pair;
use crate::mechanics::integrators::runge_kutta::LocalCoordinates;
use crate::mechanics::stopped;
use crate::mechanics::{
    Adaptive, CommutatorFree, CotangentSystem, CrouchGrossman, Integrator, MuntheKaas, State,
    System,
};

/// How a motion advances: fixed steps, controlled steps or an exact solution.
pub enum Drive<S: System> {
    /// Steps of one length.
    Fixed {
        /// The method.
        integrator: Box<dyn Integrator<S> + Send>,
        /// The longest step.
        step: f64,
    },
    /// Steps whose length follows from a tolerance.
    Adaptive {
        /// [`Adaptive::step`](crate::mechanics::Adaptive::step).
        control: Box<Control<S>>,
        /// The largest number of steps from one output time to the next.
        max_steps: usize,
        /// The first step to try.
        first: f64,
    },
    /// The state at any time, in closed form.
    Exact {
        /// The state at a time.
        at: Box<At<S>>,
        /// A bound of the angular velocity, in radians per unit of time.
        rate: f64,
    },
}

/// The largest rotation between checks for events, in radians: where a check costs a step, and where it costs an evaluation.
const TURN: f64 = 0.25;
const EXACT_TURN: f64 = 0.0625;

/// A controlled step of a system and its state, with the length to try, towards a time.
type Control<S> = dyn Fn(&S, &mut <S as System>::State, &mut f64, f64) -> Result<(), Error> + Send;

/// The state at a time.
type At<S> = dyn Fn(f64) -> Result<<S as System>::State, Error> + Send;

/// The groups with projection methods, for messages.
const NO_PROJECTION: &str =
    "it is for so(2), so(3), se(2), se(3), sl(2) and other groups in closed form, left-invariant";

/// What the next step depends on beside the state.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Memory {
    /// Fixed steps: those to the next output time.
    Pace(Pace),
    /// Controlled steps: the next length to try, and the number of steps since the last output time.
    Control(f64, usize),
    /// Nothing.
    None,
}

impl Saved for Memory {
    fn save(&self, snapshot: &mut Snapshot) {
        match self {
            Memory::Pace(pace) => (0_u64, *pace).save(snapshot),
            Memory::Control(next, taken) => (1_u64, (*next, *taken)).save(snapshot),
            Memory::None => 2_u64.save(snapshot),
        }
    }

    fn read(reader: &mut Reader) -> Option<Self> {
        match u64::read(reader)? {
            0 => Pace::read(reader).map(Memory::Pace),
            1 => Some(Memory::Control(f64::read(reader)?, usize::read(reader)?)),
            2 => Some(Memory::None),
            _ => None,
        }
    }
}

impl<S: System> Drive<S> {
    /// Steps of one length.
    pub fn fixed(integrator: impl Integrator<S> + Send + 'static, step: f64) -> Self {
        Drive::Fixed { integrator: Box::new(integrator), step }
    }

    /// The memory before the first step.
    pub fn memory(&self) -> Memory {
        match self {
            Drive::Fixed { step, .. } => Memory::Pace(Pace::new(*step)),
            Drive::Adaptive { first, .. } => Memory::Control(*first, 0),
            Drive::Exact { .. } => Memory::None,
        }
    }

    /// Whether a memory fits this drive.
    pub fn fits(&self, memory: &Memory) -> bool {
        match (self, memory) {
            (Drive::Fixed { step, .. }, Memory::Pace(pace)) => Pace::new(*step).fits(pace),
            (Drive::Adaptive { max_steps, .. }, Memory::Control(_, taken)) => taken <= max_steps,
            (Drive::Exact { .. }, Memory::None) => true,
            _ => false,
        }
    }

    /// One step towards a time; returns the time that is reached. Steps of free length end at `pause`, a time on the way,
    /// at the latest.
    pub fn step(
        &self,
        system: &S,
        (state, memory): (&mut S::State, &mut Memory),
        until: f64,
        pause: f64,
    ) -> Result<f64, Error> {
        let time = system.time(state);
        match (self, memory) {
            (Drive::Fixed { integrator, .. }, Memory::Pace(pace)) => {
                pace.step(time, until, |h| integrator.step(system, state, h))
            }
            (Drive::Adaptive { control, max_steps, .. }, Memory::Control(next, taken)) => {
                if *taken == *max_steps {
                    return Err(stopped(
                        time,
                        format!(
                            "{taken} steps did not reach t = {until}: the problem is stiff, or times of output far apart"
                        ),
                    ));
                }
                control(system, state, next, pause)?;
                let reached = system.time(state);
                *taken = if reached == until { 0 } else { *taken + 1 };
                Ok(reached)
            }
            (Drive::Exact { at, .. }, _) => {
                *state = at(pause)?;
                Ok(pause)
            }
            // no memory is of another drive: they are made together, and checked when they are read
            _ => Ok(time),
        }
    }

    /// The longest step between checks for events, where `rate` gives the angular velocity; infinite for fixed steps.
    pub fn longest(&self, rate: impl FnOnce() -> f64) -> f64 {
        match self {
            Drive::Fixed { .. } => f64::INFINITY,
            Drive::Exact { rate, .. } => EXACT_TURN / rate,
            Drive::Adaptive { .. } => TURN / rate(),
        }
    }
}

/// A method that a problem does not have.
pub fn refused(method: Method, reason: &str) -> Error {
    Error::NoMethod { method: method.name(), reason: reason.into() }
}

impl<S: CotangentSystem<Group: SimulationGroup> + 'static> Drive<S> {
    /// The drive of a method for all groups and forces, and the step size; the drive is `None` for methods that are for bodies.
    ///
    /// # Errors
    /// [`Error::NoMethod`] for fixed steps without a step size, a tolerance that is too small, and a projection method on a
    /// group that has none.
    pub fn of_any_system(
        group: &S::Group,
        method: Method,
        step: Option<f64>,
        control: Adaptive,
    ) -> Result<(Option<Self>, f64), Error> {
        method.expect_resolved(control.tolerance)?;
        let step = match step {
            Some(step) => step,
            None if method.has_steps() => return Err(refused(method, "it needs a step")),
            None => 0.0,
        };
        let drive = match method {
            Method::MuntheKaas => Self::fixed(MuntheKaas::RK4, step),
            Method::CommutatorFree => Self::fixed(CommutatorFree, step),
            Method::CrouchGrossman => Self::fixed(CrouchGrossman, step),
            Method::Adaptive(pair) => Self::controlled(pair, control, |control| control),
            Method::Projected | Method::ProjectedAdaptive(_) => {
                let drive = group.projected(method, step, control);
                drive.ok_or_else(|| refused(method, NO_PROJECTION))?
            }
            _ => return Ok((None, step)),
        };
        Ok((Some(drive), step))
    }

    /// Steps of a pair with step-size control.
    pub fn controlled<C: LocalCoordinates<S::Group> + Copy + Send + 'static>(
        pair: Pair,
        control: Adaptive,
        of: impl FnOnce(Adaptive) -> Adaptive<C>,
    ) -> Self {
        let control = of(Adaptive { pair, ..control });
        let (max_steps, first) = (control.max_steps, control.first_step());
        let step = move |system: &S, state: &mut State<S::Group>, next: &mut f64, end: f64| {
            control.step(system, state, next, end)
        };
        Drive::Adaptive { control: Box::new(step), max_steps, first }
    }
}
