//! The one implementation of motions: a system, its state, and a drive.

use super::Motion;
use super::drive::{Drive, Memory};
use super::snapshot::{Saved, Snapshot, saved};
use crate::Error;
use crate::mechanics::System;
use std::ops::Range;

/// A system with the values that are recorded along its motion.
pub(super) trait Recorded: Send {
    /// The equations of motion.
    type System: System<State: Saved + Send>;

    /// The equations of motion.
    fn system(&self) -> &Self::System;

    /// Sets the time of a state.
    fn set_time(state: &mut <Self::System as System>::State, time: f64);

    /// Whether a state that was read has the sizes of the present one.
    fn fits(
        &self,
        state: &<Self::System as System>::State,
        now: &<Self::System as System>::State,
    ) -> bool;

    /// How many columns there are.
    fn width(&self) -> usize;

    /// Appends the values of some columns at a state.
    fn values(
        &self,
        state: &<Self::System as System>::State,
        columns: Range<usize>,
        list: &mut Vec<f64>,
    );

    /// The angular velocity of a state, or what is like it.
    fn rate(&self, state: &<Self::System as System>::State) -> f64 {
        let _ = state;
        0.0
    }

    /// The time at which a controlled step from one time towards another has to end at the latest.
    fn pause(&self, from: f64, until: f64) -> f64 {
        let _ = from;
        until
    }

    /// Takes away the reason for which a force was not a number.
    fn trouble(&self) -> Option<String> {
        None
    }
}

/// The motion of a recorded system.
pub(super) struct Run<R: Recorded> {
    recorded: R,
    drive: Drive<R::System>,
    now: Progress<<R::System as System>::State>,
    kept: Option<Progress<<R::System as System>::State>>,
}

/// All that the continuation of a motion depends on.
#[derive(Clone)]
struct Progress<T> {
    state: T,
    memory: Memory,
    steps: u64,
}

saved! { [T: Saved] Progress<T>: state, memory, steps; }

impl<R: Recorded + 'static> Run<R> {
    /// The motion from a state.
    pub(super) fn boxed(
        recorded: R,
        state: <R::System as System>::State,
        drive: Drive<R::System>,
    ) -> Box<dyn Motion> {
        let now = Progress { state, memory: drive.memory(), steps: 0 };
        Box::new(Run { recorded, drive, now, kept: None })
    }
}

impl<R: Recorded> Run<R> {
    /// A step towards a time; where its length is free, no longer than `longest`.
    fn advance(&mut self, until: f64, longest: f64) -> Result<bool, Error> {
        let time = self.time();
        if time == until {
            return Ok(true);
        }
        let Progress { state, memory, steps } = &mut self.now;
        *steps = steps.saturating_add(1);
        // forget that of an earlier step
        let _ = self.recorded.trouble();
        let mut pause = self.recorded.pause(time, until);
        if (pause - time).abs() > longest {
            pause = time + longest.copysign(until - time);
        }
        let reached = self.drive.step(self.recorded.system(), (state, memory), until, pause);
        let reached = reached.map_err(|error| match (error, self.recorded.trouble()) {
            (_, Some(reason)) => Error::Integration { t: time, reason },
            (error @ Error::Integration { .. }, None) => error,
            (error, None) => {
                let reason = format!("the step is too long: {error}");
                Error::Integration { t: time, reason }
            }
        })?;
        R::set_time(state, reached);
        Ok(reached == until)
    }
}

impl<R: Recorded> Motion for Run<R> {
    fn time(&self) -> f64 {
        self.recorded.system().time(&self.now.state)
    }

    fn step(&mut self, until: f64) -> Result<bool, Error> {
        self.advance(until, f64::INFINITY)
    }

    fn short_step(&mut self, until: f64) -> Result<bool, Error> {
        let longest = self.drive.longest(|| self.recorded.rate(&self.now.state));
        self.advance(until, longest)
    }

    fn width(&self) -> usize {
        self.recorded.width()
    }

    fn values(&self, columns: Range<usize>, list: &mut Vec<f64>) {
        self.recorded.values(&self.now.state, columns, list);
    }

    fn steps(&self) -> u64 {
        self.now.steps
    }

    fn keep(&mut self) {
        self.kept = Some(self.now.clone());
    }

    fn back(&mut self) {
        if let Some(kept) = &self.kept {
            self.now = kept.clone();
        }
    }

    fn save(&self) -> Result<Snapshot, Error> {
        Snapshot::of(&self.now)
    }

    fn restore(&mut self, snapshot: &Snapshot) -> Result<(), Error> {
        let read = snapshot.read::<Progress<_>>();
        let fits = |read: &Progress<_>| {
            self.recorded.fits(&read.state, &self.now.state) && self.drive.fits(&read.memory)
        };
        let other = || Error::Snapshot { reason: "it is of another motion".into() };
        self.now = read.filter(fits).ok_or_else(other)?;
        Ok(())
    }
}
