//! Events along a motion: sign changes of columns of its rows.

use super::motion::Motion;
use crate::Error;
use crate::mechanics::events::{changes_of_sign, expect_number};
use std::ops::Range;

/// Detects sign changes of the watched columns of a motion.
#[derive(Clone, Debug)]
pub struct Crossings {
    columns: Range<usize>,
    /// The values of the columns at the current state.
    last: Vec<f64>,
    /// The values of the columns at the end of a step.
    now: Vec<f64>,
}

/// An event that occurred.
#[derive(Clone, Debug, PartialEq)]
pub struct RecordedCrossing {
    /// The index of the event among the watched columns, from 0.
    pub event: usize,
    /// The row at the event: the first row after the sign change, up to the resolution of time.
    pub row: Vec<f64>,
    /// The time of the event.
    pub time: f64,
}

impl Crossings {
    /// Watches these columns of a motion from its current state on.
    pub fn new(motion: &dyn Motion, columns: Range<usize>) -> Self {
        let mut last = Vec::with_capacity(columns.len());
        motion.values(columns.clone(), &mut last);
        Crossings { columns, now: last.clone(), last }
    }

    /// Makes one step of the motion towards the time `until`. Returns whether this time has been
    /// reached, and the events of the step in the order of time.
    ///
    /// If a column is zero at the end of a step, the event belongs to this step, and not to the
    /// next one. Two sign changes of one column within a step are missed, but steps of free length
    /// are short compared with the time scale of the motion.
    ///
    /// # Errors
    /// The errors of [`Motion::step`]; [`Error::Integration`] if a column is NaN.
    pub fn step(
        &mut self,
        motion: &mut dyn Motion,
        until: f64,
    ) -> Result<(bool, Vec<RecordedCrossing>), Error> {
        if self.columns.is_empty() {
            return Ok((motion.step(until)?, vec![]));
        }
        motion.store();
        let from = motion.time();
        let reached = motion.step_for_events(until)?;
        let end = motion.time();
        self.now.clear();
        motion.values(self.columns.clone(), &mut self.now);
        if let Some(value) = self.now.iter().find(|value| value.is_nan()) {
            expect_number(end, *value)?;
        }
        let same =
            |(before, after): (&f64, &f64)| *after != 0.0 && (*before < 0.0) == (*after < 0.0);
        if self.last.iter().zip(&self.now).all(same) {
            std::mem::swap(&mut self.last, &mut self.now);
            return Ok((reached, vec![]));
        }
        // moves the motion to a time within the step
        let length = end - from;
        let go = |motion: &mut dyn Motion, elapsed: f64| {
            let time = if elapsed == length { end } else { from + elapsed };
            motion.roll_back();
            while !motion.step(time)? {}
            Ok::<_, Error>(time)
        };
        let mut value = Vec::new();
        let value = |event: usize, elapsed: f64| {
            let time = go(motion, elapsed)?;
            let column = self.columns.start + event;
            value.clear();
            motion.values(column..column + 1, &mut value);
            expect_number(time, value[0])
        };
        let found = changes_of_sign([&self.last, &self.now], (from, length), |_, _| true, value)?;
        let mut crossings = Vec::with_capacity(found.len());
        for (elapsed, event) in found {
            let time = go(motion, elapsed)?;
            crossings.push(RecordedCrossing { event, row: motion.row(), time });
        }
        if motion.time() != end || !crossings.is_empty() {
            motion.roll_back();
            motion.step_for_events(until)?;
        }
        std::mem::swap(&mut self.last, &mut self.now);
        Ok((reached, crossings))
    }
}
