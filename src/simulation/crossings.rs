//! Events along a motion: where a column of its rows changes its sign.

use super::Motion;
use crate::Error;
use crate::dynamics::events::{change_of_sign, expect_number, is_crossed};

/// Columns whose changes of sign are looked for.
#[derive(Clone, Debug)]
pub struct Crossings {
    columns: std::ops::Range<usize>,
    /// The values where the motion is.
    last: Vec<f64>,
}

/// An event that happened.
#[derive(Clone, Debug, PartialEq)]
pub struct Crossing {
    /// Its number among the columns that are watched.
    pub event: usize,
    /// The row there: the first, to the rounding of time, beyond the change of sign.
    pub row: Vec<f64>,
    /// The time.
    pub time: f64,
}

impl Crossings {
    /// Watches these columns of a motion from where it is.
    pub fn new(motion: &dyn Motion, columns: std::ops::Range<usize>) -> Self {
        let last = motion.row()[columns.clone()].to_vec();
        Crossings { columns, last }
    }

    /// One step of the motion towards a time, whether it is reached, and the events on the way, in the order of time.
    ///
    /// A zero at the end of a step counts in that step and not in the next. Of two changes of sign in one step neither is
    /// seen; steps are short beside the motion, where their length is free.
    ///
    /// # Errors
    /// As [`Motion::step`]; [`Error::Integration`] where a column is not a number.
    pub fn step(
        &mut self,
        motion: &mut dyn Motion,
        until: f64,
    ) -> Result<(bool, Vec<Crossing>), Error> {
        if self.columns.is_empty() {
            return Ok((motion.step(until)?, vec![]));
        }
        let (before, from) = (motion.save()?, motion.time());
        let reached = motion.short_step(until)?;
        let end = motion.time();
        let now = motion.row()[self.columns.clone()].to_vec();
        now.iter().try_for_each(|value| expect_number(end, *value).map(drop))?;
        let found = (0..now.len()).filter(|k| is_crossed(self.last[*k], now[*k]));
        let found: Vec<usize> = found.collect();
        let mut crossings = Vec::new();
        if !found.is_empty() {
            let after = motion.save()?;
            for event in found {
                let mut row_at = |elapsed: f64| {
                    let time = if elapsed == end - from { end } else { from + elapsed };
                    motion.restore(&before)?;
                    while !motion.step(time)? {}
                    Ok::<_, Error>((time, motion.row()))
                };
                let column = self.columns.start + event;
                let value = |elapsed: f64| {
                    let (time, row) = row_at(elapsed)?;
                    expect_number(time, row[column])
                };
                let values = [self.last[event], now[event]];
                if let Some(elapsed) = change_of_sign(value, from, end - from, values)? {
                    let (time, row) = row_at(elapsed)?;
                    crossings.push(Crossing { event, row, time });
                }
            }
            motion.restore(&after)?;
            crossings.sort_by(|a, b| (a.time - from).abs().total_cmp(&(b.time - from).abs()));
        }
        self.last = now;
        Ok((reached, crossings))
    }
}
