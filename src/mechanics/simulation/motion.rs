//! Motions: a system, its state and a method that advances it, with the values of columns.

use super::methods::Method;
use super::stepper::Stepper;
use crate::Error;
use crate::mechanics::{System, stopped};
use std::ops::Range;

/// A motion that is computed step by step.
pub trait Motion: Send {
    /// The time of the current state.
    fn time(&self) -> f64;

    /// Makes one step towards the time `until`. Returns whether this time has been reached.
    ///
    /// # Errors
    /// [`Error::Integration`]. In this case, the state is the state after the last successful step.
    fn step(&mut self, until: f64) -> Result<bool, Error>;

    /// Makes one step as in [`step`](Self::step), but a step that is short enough to check for
    /// events: it rotates a body by at most a quarter radian. The length of fixed steps is not
    /// changed.
    ///
    /// # Errors
    /// The errors of [`step`](Self::step).
    fn step_for_events(&mut self, until: f64) -> Result<bool, Error>;

    /// The number of columns.
    fn column_count(&self) -> usize;

    /// Appends the values of the columns in the range `columns` to `list`. The method does not
    /// allocate memory if the list is long enough.
    fn values(&self, columns: Range<usize>, list: &mut Vec<f64>);

    /// The values of all columns.
    fn row(&self) -> Vec<f64> {
        let mut row = Vec::with_capacity(self.column_count());
        self.values(0..self.column_count(), &mut row);
        row
    }

    /// The number of steps so far.
    fn steps(&self) -> u64;

    /// Stores a copy of the state in memory. It replaces an earlier copy.
    fn store(&mut self);

    /// Restores the state that was stored last. Does nothing if no state is stored.
    fn roll_back(&mut self);
}

/// A motion at its start, together with its method.
pub struct Started {
    /// The motion.
    pub motion: Box<dyn Motion>,
    /// The requested method, or the default method of the class of problems.
    pub method: Method,
}

/// A system with the columns of its motion. Each class of problems implements this trait.
pub(super) trait ObservedMotion: Send + 'static {
    /// The type of the system.
    type System: System<State: Send>;

    /// The system.
    fn system(&self) -> &Self::System;

    /// Replaces the time of a state.
    fn set_time(&self, state: &mut <Self::System as System>::State, time: f64);

    /// The number of columns.
    fn column_count(&self) -> usize;

    /// Appends the values at a state of the columns in the range `columns` to `list`.
    fn values(
        &self,
        state: &<Self::System as System>::State,
        columns: Range<usize>,
        list: &mut Vec<f64>,
    );

    /// The angular velocity of a state, or a similar measure of its time scale.
    fn rate(&self, state: &<Self::System as System>::State) -> f64 {
        let _ = state;
        0.0
    }

    /// Begins a step from the time `from` towards `until`. Returns the latest time at which a step
    /// of controlled size must end. If the two times are equal, no step is in progress.
    fn begin_step(&self, from: f64, until: f64) -> f64 {
        let _ = from;
        until
    }

    /// Removes and returns the reason why a force was not a number.
    fn take_trouble(&self) -> Option<String> {
        None
    }
}

/// A simulation of a system. This type is the only implementation of [`Motion`].
struct Simulation<R: ObservedMotion> {
    recorded: R,
    now: Progress<R::System>,
    stored: Option<Progress<R::System>>,
}

/// All data on which the rest of a motion depends.
struct Progress<S: System> {
    state: S::State,
    stepper: Stepper<S>,
    steps: u64,
}

// implemented by hand, because a derived implementation would require `S: Clone`
impl<S: System> Clone for Progress<S> {
    fn clone(&self) -> Self {
        Progress { state: self.state.clone(), stepper: self.stepper.clone(), steps: self.steps }
    }
}

/// The motion of a system that starts at a state.
pub(super) fn simulation<R: ObservedMotion>(
    recorded: R,
    state: <R::System as System>::State,
    stepper: Stepper<R::System>,
) -> Box<dyn Motion> {
    let now = Progress { state, stepper, steps: 0 };
    Box::new(Simulation { recorded, now, stored: None })
}

impl<R: ObservedMotion> Simulation<R> {
    /// The longest step between checks for events, at the current angular velocity.
    fn longest(&self) -> f64 {
        self.now.stepper.longest(|| self.recorded.rate(&self.now.state))
    }

    /// Makes a step towards the time `until`. If the length of steps is free, it is at most
    /// `longest`.
    fn advance(&mut self, until: f64, longest: f64) -> Result<bool, Error> {
        let time = self.time();
        if time == until {
            return Ok(true);
        }
        if !until.is_finite() {
            return Err(stopped(time, format!("the end is {until}, which is not finite")));
        }
        let (recorded, Progress { state, stepper, steps }) = (&self.recorded, &mut self.now);
        *steps = steps.saturating_add(1);
        // discards the reason for a failure that an earlier step recorded
        let _ = recorded.take_trouble();
        let mut end = recorded.begin_step(time, until);
        if (end - time).abs() > longest {
            end = time + longest.copysign(until - time);
        }
        let reached = stepper.step(recorded.system(), state, until, end);
        // marks that no step is in progress
        recorded.begin_step(until, until);
        let reached = reached.map_err(|error| match (error, recorded.take_trouble()) {
            (_, Some(reason)) => stopped(time, reason),
            (error @ (Error::Integration { .. } | Error::CurveEnds { .. }), None) => error,
            (error, None) => stopped(time, format!("the step is too long: {error}")),
        })?;
        recorded.set_time(state, reached);
        Ok(reached == until)
    }
}

impl<R: ObservedMotion> Motion for Simulation<R> {
    fn time(&self) -> f64 {
        self.recorded.system().time(&self.now.state)
    }

    fn step(&mut self, until: f64) -> Result<bool, Error> {
        self.advance(until, f64::INFINITY)
    }

    fn step_for_events(&mut self, until: f64) -> Result<bool, Error> {
        let from = self.time();
        let mut reached = self.advance(until, self.longest())?;
        // repeats the step if the body has rotated too far, because it was slower at the start,
        // perhaps at rest
        while let (longest, length) = (self.longest(), (self.time() - from).abs())
            && length > 2.0 * longest
            && let Some(stored) = &self.stored
            && self.recorded.system().time(&stored.state) == from
        {
            self.roll_back();
            // if the angular velocity grows linearly, this step rotates the body by exactly the
            // allowed angle
            reached = self.advance(until, (longest * length).sqrt())?;
        }
        Ok(reached)
    }

    fn column_count(&self) -> usize {
        self.recorded.column_count()
    }

    fn values(&self, columns: Range<usize>, list: &mut Vec<f64>) {
        self.recorded.values(&self.now.state, columns, list);
    }

    fn steps(&self) -> u64 {
        self.now.steps
    }

    fn store(&mut self) {
        self.stored = Some(self.now.clone());
    }

    fn roll_back(&mut self) {
        if let Some(stored) = &self.stored {
            self.now = stored.clone();
        }
    }
}
