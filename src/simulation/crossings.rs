//! Events along a motion: where a column of its rows changes its sign.

use super::Motion;
use crate::Error;

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
    /// seen.
    ///
    /// # Errors
    /// As [`Motion::step`].
    pub fn step(
        &mut self,
        motion: &mut dyn Motion,
        until: f64,
    ) -> Result<(bool, Vec<Crossing>), Error> {
        if self.columns.is_empty() {
            return Ok((motion.step(until)?, vec![]));
        }
        let (before, from) = (motion.save()?, motion.time());
        let reached = motion.step(until)?;
        let now = motion.row()[self.columns.clone()].to_vec();
        let crossed = |(old, new): (&f64, &f64)| *old != 0.0 && (*new == 0.0 || old * new < 0.0);
        let found: Vec<usize> =
            (0..now.len()).filter(|k| crossed((&self.last[*k], &now[*k]))).collect();
        let mut crossings = Vec::new();
        if !found.is_empty() {
            let (after, end) = (motion.save()?, motion.time());
            for event in found {
                let (column, old) = (self.columns.start + event, self.last[event]);
                let (mut low, mut high) = (from, end);
                loop {
                    let middle = low + 0.5 * (high - low);
                    if middle == low || middle == high {
                        break;
                    }
                    motion.restore(&before)?;
                    while !motion.step(middle)? {}
                    if motion.row()[column] * old > 0.0 { low = middle } else { high = middle }
                }
                motion.restore(&before)?;
                while !motion.step(high)? {}
                crossings.push(Crossing { event, row: motion.row(), time: high });
            }
            motion.restore(&after)?;
            crossings.sort_by(|a, b| (a.time - from).abs().total_cmp(&(b.time - from).abs()));
        }
        self.last = now;
        Ok((reached, crossings))
    }
}
