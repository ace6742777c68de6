//! Ways to go on: steps of one length, steps under control, or all at once.

use super::pace::Pace;
use crate::Error;
use crate::dynamics::{Adaptive, CotangentSystem, Integrator, State};
use serde::{Deserialize, Serialize};

/// How a motion goes on.
pub enum Drive<S: CotangentSystem> {
    /// Steps of one length, as many as make it at most this.
    Fixed {
        /// The method.
        integrator: Box<dyn Integrator<S> + Send>,
        /// The lengths of steps.
        pace: Pace,
    },
    /// Steps as long as a tolerance allows.
    Adaptive {
        /// The control.
        control: Adaptive,
        /// The next step to try.
        next: f64,
        /// Steps since a wanted time was reached.
        taken: usize,
    },
    /// The state at any time.
    Exact(Box<dyn Fn(f64) -> State<S::Group> + Send>),
}

/// What a drive remembers.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub enum Memory {
    /// The way that was begun.
    Pace(Pace),
    /// The next step to try, and how many there were.
    Next(f64, usize),
    /// Nothing.
    None,
}

impl<S: CotangentSystem> Drive<S> {
    /// One step towards a time, and whether it is reached.
    pub fn step(
        &mut self,
        system: &S,
        state: &mut State<S::Group>,
        until: f64,
    ) -> Result<bool, Error> {
        if state.time == until {
            return Ok(true);
        }
        match self {
            Drive::Exact(at) => *state = at(until),
            Drive::Adaptive { control, next, taken } => {
                if *taken == control.max_steps {
                    let reason = format!(
                        "{taken} steps did not reach t = {until}: the problem is stiff, or times of output far apart"
                    );
                    return Err(Error::Integration { t: state.time, reason });
                }
                control.step(system, state, next, until)?;
                *taken = if state.time == until { 0 } else { *taken + 1 };
            }
            Drive::Fixed { integrator, pace } => {
                state.time = pace.step(state.time, until, |h| integrator.step(system, state, h))?;
            }
        }
        Ok(state.time == until)
    }

    /// What it remembers.
    pub fn memory(&self) -> Memory {
        match self {
            Drive::Fixed { pace, .. } => Memory::Pace(*pace),
            Drive::Adaptive { next, taken, .. } => Memory::Next(*next, *taken),
            Drive::Exact(_) => Memory::None,
        }
    }

    /// Takes back what it remembered; whether that was of its kind.
    pub fn remember(&mut self, memory: Memory) -> bool {
        match (self, memory) {
            (Drive::Fixed { pace, .. }, Memory::Pace(saved)) if pace.fits(&saved) => *pace = saved,
            (Drive::Adaptive { control, next, taken }, Memory::Next(saved, count))
                if count <= control.max_steps =>
            {
                (*next, *taken) = (saved, count);
            }
            (Drive::Exact(_), Memory::None) => {}
            _ => return false,
        }
        true
    }
}
