//! Integration of a motion through its times and events.

use super::ready::Ready;
use affinor::Error;
use affinor::mechanics::simulation::{Crossings, RecordedCrossing};

/// Integrates a motion through the times of its problem, and returns rows and events.
pub struct Integration {
    ready: Ready,
    /// The terminal event.
    stop: Option<String>,
    /// The event at which rows are written, if rows are not written at given times.
    section: Option<String>,
    crossings: Crossings,
    /// The index of the next output time.
    next: usize,
}

/// The rows and events of one step of an [`Integration`].
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Progress {
    /// The rows, without the values of the event functions.
    pub rows: Vec<Vec<f64>>,
    /// The events that occurred: their names and times.
    pub events: Vec<(String, f64)>,
    /// Whether the integration has ended.
    pub done: bool,
}

impl Integration {
    /// Starts an integration at the initial condition.
    pub(super) fn new(ready: Ready, stop: Option<String>, section: Option<String>) -> Self {
        let crossings = crossings(&ready);
        Integration { ready, stop, section, crossings, next: 0 }
    }

    /// The fraction of the total time that has passed, from 0 to 1.
    pub fn progress(&self) -> f64 {
        let (Some(first), Some(last)) = (self.ready.times.first(), self.ready.times.last()) else {
            return 1.0;
        };
        let share = (self.ready.motion.time() - first) / (last - first);
        if share.is_nan() { 1.0 } else { share.clamp(0.0, 1.0) }
    }

    /// Makes one step of the motion.
    ///
    /// # Errors
    /// The error that prevents the motion from continuing. Earlier rows remain valid.
    pub fn step(&mut self) -> Result<Progress, Error> {
        let mut progress = Progress::default();
        let Some(&time) = self.ready.times.get(self.next) else {
            progress.done = true;
            return Ok(progress);
        };
        let (reached, crossings) = self.crossings.step(self.ready.motion.as_mut(), time)?;
        for RecordedCrossing { event, row, time } in crossings {
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

/// The event functions of a motion. In a row, their values follow the values of the columns.
fn crossings(ready: &Ready) -> Crossings {
    let width = ready.columns.len();
    Crossings::new(ready.motion.as_ref(), width..width + ready.events.len())
}
