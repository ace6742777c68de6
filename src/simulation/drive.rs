//! Ways to go on: steps of one length, steps under control, or all at once.

use super::{Forces, Simulated};
use crate::Error;
use crate::dynamics::{Adaptive, EulerPoincare, Integrator, State};
use serde::{Deserialize, Serialize};

/// The most steps on the way to one time.
const MAX_STEPS: f64 = 1e12;

/// How a motion goes on.
pub enum Drive<G: Simulated> {
    /// Steps of one length, as many as make it at most this.
    Fixed {
        /// The method.
        integrator: Box<dyn Integrator<EulerPoincare<G, Forces<G>>> + Send>,
        /// The most that a step may be.
        step: f64,
        /// The way that was begun.
        leg: Option<Leg>,
    },
    /// Steps as long as a tolerance allows.
    Adaptive {
        /// The control.
        control: Adaptive,
        /// The next step to try.
        next: f64,
    },
    /// The state at any time.
    Exact(Box<dyn Fn(f64) -> State<G> + Send>),
}

/// Equal steps from one time to another.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Leg {
    from: f64,
    until: f64,
    count: u64,
    taken: u64,
}

/// What a drive remembers.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub enum Memory {
    /// The way that was begun.
    Leg(Option<Leg>),
    /// The next step to try.
    Next(f64),
    /// Nothing.
    None,
}

impl<G: Simulated> Drive<G> {
    /// One step towards a time, and whether it is reached.
    pub fn step(
        &mut self,
        system: &EulerPoincare<G, Forces<G>>,
        state: &mut State<G>,
        until: f64,
    ) -> Result<bool, Error> {
        if state.time == until {
            return Ok(true);
        }
        match self {
            Drive::Exact(at) => *state = at(until),
            Drive::Adaptive { control, next } => control.step(system, state, next, until)?,
            Drive::Fixed { integrator, step, leg } => {
                let way = match leg.filter(|leg| leg.until == until) {
                    Some(leg) => leg,
                    None => Leg::new(state.time, until, *step)?,
                };
                let h = (way.until - way.from) / way.count as f64;
                integrator.step(system, state, h)?;
                let taken = way.taken + 1;
                state.time = if taken == way.count { until } else { way.from + h * taken as f64 };
                *leg = (taken < way.count).then_some(Leg { taken, ..way });
            }
        }
        Ok(state.time == until)
    }

    /// What it remembers.
    pub fn memory(&self) -> Memory {
        match self {
            Drive::Fixed { leg, .. } => Memory::Leg(*leg),
            Drive::Adaptive { next, .. } => Memory::Next(*next),
            Drive::Exact(_) => Memory::None,
        }
    }

    /// Takes back what it remembered; whether that was of its kind.
    pub fn remember(&mut self, memory: Memory) -> bool {
        match (self, memory) {
            (Drive::Fixed { leg, .. }, Memory::Leg(saved)) => *leg = saved,
            (Drive::Adaptive { next, .. }, Memory::Next(saved)) => *next = saved,
            (Drive::Exact(_), Memory::None) => {}
            _ => return false,
        }
        true
    }
}

impl Leg {
    fn new(from: f64, until: f64, step: f64) -> Result<Self, Error> {
        // a whole number of steps is not spoilt by rounding
        let count = ((until - from).abs() / step - 1e-9).ceil().max(1.0);
        if !(count <= MAX_STEPS) {
            let reason = format!("{count:e} steps are too many to t = {until}");
            return Err(Error::Integration { t: from, reason });
        }
        Ok(Leg { from, until, count: count as u64, taken: 0 })
    }
}
