//! Ways to go on: steps of one length, steps under control, or all at once.

use super::pace::Pace;
use super::{Method, Simulated};
use crate::Error;
use crate::dynamics::integrators::Pair;
use crate::dynamics::integrators::projected::Projection;
use crate::dynamics::integrators::runge_kutta::LocalCoordinates;
use crate::dynamics::{
    Adaptive, CommutatorFree, CotangentSystem, CrouchGrossman, Integrator, MuntheKaas, Projected,
    State,
};
use crate::group::{LieGroup, Stored};
use nalgebra::DMatrix;
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
        /// [`Adaptive::step`](crate::dynamics::Adaptive::step).
        control: Box<Control<S>>,
        /// The most steps from one wanted time to the next.
        max_steps: usize,
        /// The next step to try.
        next: f64,
        /// Steps since a wanted time was reached.
        taken: usize,
    },
    /// The state at any time.
    Exact {
        /// The state at a time.
        at: Box<At<S>>,
        /// What a unit of time turns it by at most, in radians.
        rate: f64,
    },
}

/// Between looks for events a motion turns by at most this, in radians: where a look costs a step, and where it costs no more
/// than a row.
const TURN: f64 = 0.25;
const EXACT_TURN: f64 = 0.0625;

/// A step under control: of a system and its state, with the length to try, towards a time.
type Control<S> = dyn Fn(&S, &mut State<<S as CotangentSystem>::Group>, &mut f64, f64) -> Result<(), Error>
    + Send;

/// The state at a time.
type At<S> = dyn Fn(f64) -> Result<State<<S as CotangentSystem>::Group>, Error> + Send;

/// Why a group may have no projected methods.
pub const NO_NUMBERS: &str = "it is for so(2), so(3), se(2), se(3) and sl(2), left-invariant";

/// The numbers in which a group has its projected methods: [`Projection`], or none, `()`.
pub trait Numbers<G: LieGroup> {
    /// By a projected method.
    fn drive<S: CotangentSystem<Group = G> + 'static>(
        method: Method,
        step: f64,
        control: Adaptive,
    ) -> Option<Drive<S>>;
}

impl<G: Stored> Numbers<G> for Projection {
    fn drive<S: CotangentSystem<Group = G> + 'static>(
        method: Method,
        step: f64,
        control: Adaptive,
    ) -> Option<Drive<S>> {
        match method {
            Method::Projected => Some(Drive::fixed(Projected::RK4, step)),
            Method::ProjectedAdaptive(pair) => {
                Some(Drive::controlled(pair, control, Adaptive::projected))
            }
            _ => None,
        }
    }
}

impl<G: LieGroup> Numbers<G> for () {
    fn drive<S: CotangentSystem<Group = G> + 'static>(
        _: Method,
        _: f64,
        _: Adaptive,
    ) -> Option<Drive<S>> {
        None
    }
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
                return <S::Group as Simulated>::Numbers::drive(method, step, control);
            }
            _ => return None,
        })
    }

    fn controlled<C: LocalCoordinates<S::Group> + Copy + Send + 'static>(
        pair: Pair,
        control: Adaptive,
        of: impl FnOnce(Adaptive) -> Adaptive<C>,
    ) -> Self {
        let control = of(Adaptive { pair, ..control });
        let (max_steps, next) = (control.max_steps, control.first_step());
        let step = move |system: &S, state: &mut State<S::Group>, next: &mut f64, end: f64| {
            control.step(system, state, next, end)
        };
        Drive::Adaptive { control: Box::new(step), max_steps, next, taken: 0 }
    }

    /// One step towards a time, and whether it is reached. Where the length of steps is free, it does not go beyond `pause`,
    /// a time on the way.
    pub fn step(
        &mut self,
        system: &S,
        state: &mut State<S::Group>,
        until: f64,
        pause: f64,
    ) -> Result<bool, Error> {
        if state.time == until {
            return Ok(true);
        }
        match self {
            Drive::Exact { at, .. } => *state = at(pause)?,
            Drive::Adaptive { control, max_steps, next, taken } => {
                if *taken == *max_steps {
                    let reason = format!(
                        "{taken} steps did not reach t = {until}: the problem is stiff, or times of output far apart"
                    );
                    return Err(Error::Integration { t: state.time, reason });
                }
                control(system, state, next, pause)?;
                *taken = if state.time == until { 0 } else { *taken + 1 };
            }
            Drive::Fixed { integrator, pace } => {
                state.time = pace.step(state.time, until, |h| integrator.step(system, state, h))?;
            }
        }
        Ok(state.time == until)
    }

    /// How long a step may be in which nothing turns far; infinite where steps have their length.
    pub fn look(&self, system: &S, state: &State<S::Group>) -> f64 {
        match self {
            Drive::Fixed { .. } => f64::INFINITY,
            Drive::Exact { rate, .. } => EXACT_TURN / rate,
            Drive::Adaptive { .. } => {
                let group = system.group();
                let velocity = system.velocity_of(&state.momentum(group));
                TURN / spectral_radius(group.operator(|x| group.bracket(&velocity, x)))
            }
        }
    }

    /// What it remembers.
    pub fn memory(&self) -> Memory {
        match self {
            Drive::Fixed { pace, .. } => Memory::Pace(*pace),
            Drive::Adaptive { next, taken, .. } => Memory::Next(*next, *taken),
            Drive::Exact { .. } => Memory::None,
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
            (Drive::Exact { .. }, Memory::None) => {}
            _ => return false,
        }
        true
    }
}

/// The largest `|lambda|` of an eigenvalue, by Gelfand's `|A^k|^(1/k)`: not much above, and 0 for a nilpotent matrix.
fn spectral_radius(matrix: DMatrix<f64>) -> f64 {
    let size = matrix.norm();
    if size == 0.0 || !size.is_finite() {
        return 0.0;
    }
    let power = (0..4).fold(matrix / size, |power, _| &power * &power);
    size * power.norm().powf(1.0 / 16.0)
}
