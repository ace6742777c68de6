//! Ways to go on: steps of one length, steps under control, or all at once.

use super::pace::Pace;
use super::{Method, Simulated};
use crate::Error;
use crate::dynamics::integrators::{Controlled, Pair};
use crate::dynamics::{
    Adaptive, CommutatorFree, CotangentSystem, CrouchGrossman, Integrator, MuntheKaas, Projected,
    State,
};
use crate::group::Stored;
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
        control: Box<dyn Controlled<S> + Send>,
        /// The most steps from one wanted time to the next.
        max_steps: usize,
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
    /// Steps of one length.
    pub fn fixed(integrator: impl Integrator<S> + Send + 'static, step: f64) -> Self {
        Drive::Fixed { integrator: Box::new(integrator), pace: Pace::new(step) }
    }

    /// By a method for all groups and forces; none if it is not one of these, or not on this group.
    pub fn of_any_system(method: Method, step: f64, control: Adaptive) -> Option<Self>
    where
        S: 'static,
        S::Group: Simulated,
    {
        Some(match method {
            Method::MuntheKaas => Self::fixed(MuntheKaas::RK4, step),
            Method::CommutatorFree => Self::fixed(CommutatorFree, step),
            Method::CrouchGrossman => Self::fixed(CrouchGrossman, step),
            Method::Adaptive(pair) => Self::controlled(pair, control, |control| control),
            Method::Projected | Method::ProjectedAdaptive(_) => {
                return S::Group::projected(method, step, control);
            }
            _ => return None,
        })
    }

    /// By a method in stored numbers.
    pub fn projected(method: Method, step: f64, control: Adaptive) -> Option<Self>
    where
        S: 'static,
        S::Group: Stored,
    {
        match method {
            Method::Projected => Some(Self::fixed(Projected::RK4, step)),
            Method::ProjectedAdaptive(pair) => {
                Some(Self::controlled(pair, control, Adaptive::projected))
            }
            _ => None,
        }
    }

    fn controlled<C: Controlled<S> + Send + 'static>(
        pair: Pair,
        control: Adaptive,
        of: impl FnOnce(Adaptive) -> C,
    ) -> Self {
        let control = Adaptive { pair, ..control };
        let (max_steps, next) = (control.max_steps, control.first_step());
        Drive::Adaptive { control: Box::new(of(control)), max_steps, next, taken: 0 }
    }

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
            Drive::Adaptive { control, max_steps, next, taken } => {
                if *taken == *max_steps {
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
            (Drive::Adaptive { max_steps, next, taken, .. }, Memory::Next(saved, count))
                if count <= *max_steps =>
            {
                (*next, *taken) = (saved, count);
            }
            (Drive::Exact(_), Memory::None) => {}
            _ => return false,
        }
        true
    }
}
