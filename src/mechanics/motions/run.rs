//! The one implementation of motions: a system, its state, and a drive.

use super::Motion;
use super::drive::{Drive, Memory};
use super::snapshot::{Saved, Snapshot, saved};
use crate::Error;
use crate::mechanics::{System, stopped};
use std::ops::Range;

/// A system with the values that are recorded along its motion.
pub(super) struct Recorded<S: System> {
    system: S,
    /// The time of a state.
    time: fn(&mut S::State) -> &mut f64,
    /// Whether a state that was read has the sizes of the present one.
    fits: fn(&S, &S::State, &S::State) -> bool,
    /// The number of columns, and the function that appends the values of some columns at a state.
    width: usize,
    values: Box<Values<S>>,
    /// The angular velocity of a state, or a rate like it.
    pub(super) rate: Box<Rate<S>>,
    /// Begins a step from one time towards another, and returns the time at which it has to end at the latest, if its size is
    /// controlled. A step from a time to the same time is none.
    pub(super) pause: fn(&S, f64, f64) -> f64,
    /// Takes away the reason for which a force was not a number.
    pub(super) trouble: fn(&S) -> Option<String>,
}

type Values<S> = dyn Fn(&S, &<S as System>::State, Range<usize>, &mut Vec<f64>) + Send;
type Rate<S> = dyn Fn(&S, &<S as System>::State) -> f64 + Send;

impl<S: System> Recorded<S> {
    /// A system with these columns, on which no force acts.
    pub(super) fn new(
        system: S,
        time: fn(&mut S::State) -> &mut f64,
        fits: fn(&S, &S::State, &S::State) -> bool,
        width: usize,
        values: impl Fn(&S, &S::State, Range<usize>, &mut Vec<f64>) + Send + 'static,
    ) -> Self {
        let (values, rate) = (Box::new(values), Box::new(|_: &S, _: &S::State| 0.0));
        let (pause, trouble) = (|_: &S, _, until| until, |_: &S| None);
        Recorded { system, time, fits, width, values, rate, pause, trouble }
    }
}

/// The motion of a recorded system.
pub(super) struct Run<S: System> {
    recorded: Recorded<S>,
    drive: Drive<S>,
    now: Progress<S::State>,
    kept: Option<Progress<S::State>>,
}

/// All that the continuation of a motion depends on.
#[derive(Clone)]
struct Progress<T> {
    state: T,
    memory: Memory,
    steps: u64,
}

saved! { [T: Saved] Progress<T>: state, memory, steps; }

impl<S: System<State: Saved + Send> + Send + 'static> Run<S> {
    /// The motion from a state.
    pub(super) fn boxed(
        recorded: Recorded<S>,
        state: S::State,
        drive: Drive<S>,
    ) -> Box<dyn Motion> {
        let now = Progress { state, memory: drive.memory(), steps: 0 };
        Box::new(Run { recorded, drive, now, kept: None })
    }
}

impl<S: System<State: Saved + Send> + Send> Run<S> {
    /// The longest step between checks for events, by the present angular velocity.
    fn longest(&self) -> f64 {
        let Recorded { system, rate, .. } = &self.recorded;
        self.drive.longest(|| rate(system, &self.now.state))
    }

    /// A step towards a time; where its length is free, no longer than `longest`.
    fn advance(&mut self, until: f64, longest: f64) -> Result<bool, Error> {
        let time = self.time();
        if time == until {
            return Ok(true);
        }
        if !until.is_finite() {
            return Err(stopped(time, format!("the end is {until}, no finite time")));
        }
        let Progress { state, memory, steps } = &mut self.now;
        *steps = steps.saturating_add(1);
        let Recorded { system, trouble, .. } = &self.recorded;
        // forget that of an earlier step
        let _ = trouble(system);
        let mut pause = (self.recorded.pause)(system, time, until);
        if (pause - time).abs() > longest {
            pause = time + longest.copysign(until - time);
        }
        let reached = self.drive.step(system, (state, memory), until, pause);
        // the step is over
        (self.recorded.pause)(system, until, until);
        let reached = reached.map_err(|error| match (error, trouble(system)) {
            (_, Some(reason)) => stopped(time, reason),
            (error @ Error::Integration { .. }, None) => error,
            (error, None) => stopped(time, format!("the step is too long: {error}")),
        })?;
        *(self.recorded.time)(state) = reached;
        Ok(reached == until)
    }
}

impl<S: System<State: Saved + Send> + Send> Motion for Run<S> {
    fn time(&self) -> f64 {
        self.recorded.system.time(&self.now.state)
    }

    fn step(&mut self, until: f64) -> Result<bool, Error> {
        self.advance(until, f64::INFINITY)
    }

    fn short_step(&mut self, until: f64) -> Result<bool, Error> {
        let from = self.time();
        let mut reached = self.advance(until, self.longest())?;
        // a body that began slower, perhaps at rest, may have turned too far
        while let (longest, length) = (self.longest(), (self.time() - from).abs())
            && length > 2.0 * longest
            && self.kept.as_ref().is_some_and(|kept| self.recorded.system.time(&kept.state) == from)
        {
            self.back();
            // where the rate grows with time, this turns as far as is allowed
            reached = self.advance(until, (longest * length).sqrt())?;
        }
        Ok(reached)
    }

    fn width(&self) -> usize {
        self.recorded.width
    }

    fn values(&self, columns: Range<usize>, list: &mut Vec<f64>) {
        (self.recorded.values)(&self.recorded.system, &self.now.state, columns, list);
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
            let Recorded { system, fits, .. } = &self.recorded;
            fits(system, &read.state, &self.now.state) && self.drive.fits(&read.memory)
        };
        let other = || Error::Snapshot { reason: "it is of another motion".into() };
        self.now = read.filter(fits).ok_or_else(other)?;
        Ok(())
    }
}
