//! The integration of a motion through its times and events.

use super::ready::Ready;
use affinor::Error;
use affinor::mechanics::motions::{Crossing, Crossings, Snapshot};

/// A motion that is integrated through the times of its problem, with the rows and events on its way.
pub struct Walk {
    ready: Ready,
    /// The terminal event.
    stop: Option<String>,
    /// The event that rows are written at, instead of times.
    section: Option<String>,
    crossings: Crossings,
    /// The index of the next time.
    next: usize,
}

/// The rows and events of one step of a [`Walk`].
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Progress {
    /// Rows, without the values of events.
    pub rows: Vec<Vec<f64>>,
    /// Events by name, with their times.
    pub events: Vec<(String, f64)>,
    /// Whether the walk has ended.
    pub done: bool,
}

impl Walk {
    /// A walk from the initial condition.
    pub(super) fn new(ready: Ready, stop: Option<String>, section: Option<String>) -> Self {
        let crossings = crossings(&ready);
        Walk { ready, stop, section, crossings, next: 0 }
    }

    /// The number of times that are passed.
    pub fn position(&self) -> usize {
        self.next
    }

    /// The share of the whole time that is passed, from 0 to 1.
    pub fn share(&self) -> f64 {
        let (Some(first), Some(last)) = (self.ready.times.first(), self.ready.times.last()) else {
            return 1.0;
        };
        let share = (self.ready.motion.time() - first) / (last - first);
        if share.is_nan() { 1.0 } else { share.clamp(0.0, 1.0) }
    }

    /// The state of the motion: with the position, all that the rest of the walk depends on.
    ///
    /// # Errors
    /// As [`Motion::save`](affinor::mechanics::motions::Motion::save).
    pub fn save(&self) -> Result<Snapshot, Error> {
        self.ready.motion.save()
    }

    /// Restores the state that was saved at a position.
    ///
    /// # Errors
    /// As [`Motion::restore`](affinor::mechanics::motions::Motion::restore).
    pub fn restore(&mut self, position: usize, snapshot: &Snapshot) -> Result<(), Error> {
        self.ready.motion.restore(snapshot)?;
        self.crossings = crossings(&self.ready);
        self.next = position;
        Ok(())
    }

    /// One step of the motion.
    ///
    /// # Errors
    /// The reason why the motion cannot go on. Earlier rows stay valid.
    pub fn step(&mut self) -> Result<Progress, Error> {
        let mut progress = Progress::default();
        let Some(&time) = self.ready.times.get(self.next) else {
            progress.done = true;
            return Ok(progress);
        };
        let (reached, crossings) = self.crossings.step(self.ready.motion.as_mut(), time)?;
        for Crossing { event, row, time } in crossings {
            let name = Some(&self.ready.events[event]);
            let stops = name == self.stop.as_ref();
            if stops || name == self.section.as_ref() {
                progress.rows.push(self.visible(row));
            }
            progress.events.push((self.ready.events[event].clone(), time));
            if stops {
                self.next = self.ready.times.len();
                progress.done = true;
                return Ok(progress);
            }
        }
        if reached {
            if self.section.is_none() {
                progress.rows.push(self.visible(self.ready.motion.row()));
            }
            self.next += 1;
            progress.done = self.next == self.ready.times.len();
        }
        Ok(progress)
    }

    fn visible(&self, mut row: Vec<f64>) -> Vec<f64> {
        row.truncate(self.ready.columns.len());
        row
    }
}

/// The events of a motion: their values follow those of the columns.
fn crossings(ready: &Ready) -> Crossings {
    let width = ready.columns.len();
    Crossings::new(ready.motion.as_ref(), width..width + ready.events.len())
}
