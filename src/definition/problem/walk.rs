//! The way of a motion through its times and events.

use super::{Problem, Ready};
use crate::Error;
use crate::simulation::{Crossing, Crossings, Snapshot};

/// A motion on the way through the times of its problem: what rows it leaves, and which events happen.
pub struct Walk<'p> {
    problem: &'p Problem,
    ready: Ready,
    crossings: Crossings,
    /// The next of the times.
    next: usize,
}

/// What a step of a [`Walk`] leaves.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Left {
    /// Rows, without the values of events.
    pub rows: Vec<Vec<f64>>,
    /// Events by name, with their times.
    pub events: Vec<(String, f64)>,
    /// Whether the end is reached.
    pub done: bool,
}

impl<'p> Walk<'p> {
    /// From the start of a motion.
    pub fn new(problem: &'p Problem, ready: Ready) -> Self {
        let width = ready.columns.len();
        let watched = width..width + ready.events.len();
        let crossings = Crossings::new(ready.motion.as_ref(), watched);
        Walk { problem, ready, crossings, next: 0 }
    }

    /// How many of the times lie behind.
    pub fn position(&self) -> usize {
        self.next
    }

    /// How much of the whole time lies behind, from 0 to 1.
    pub fn share(&self) -> f64 {
        let (Some(first), Some(last)) = (self.ready.times.first(), self.ready.times.last()) else {
            return 1.0;
        };
        let share = (self.ready.motion.time() - first) / (last - first);
        if share.is_nan() { 1.0 } else { share.clamp(0.0, 1.0) }
    }

    /// What all that follows depends on, besides the position.
    ///
    /// # Errors
    /// As [`Motion::save`](crate::simulation::Motion::save).
    pub fn save(&self) -> Result<Snapshot, Error> {
        self.ready.motion.save()
    }

    /// Goes back to what was saved at a position.
    ///
    /// # Errors
    /// As [`Motion::restore`](crate::simulation::Motion::restore).
    pub fn restore(&mut self, position: usize, snapshot: &Snapshot) -> Result<(), Error> {
        self.ready.motion.restore(snapshot)?;
        let width = self.ready.columns.len();
        let watched = width..width + self.ready.events.len();
        self.crossings = Crossings::new(self.ready.motion.as_ref(), watched);
        self.next = position;
        Ok(())
    }

    /// One step of the motion.
    ///
    /// # Errors
    /// What stops the motion; all before stays.
    pub fn step(&mut self) -> Result<Left, Error> {
        let mut left = Left::default();
        let Some(&time) = self.ready.times.get(self.next) else {
            left.done = true;
            return Ok(left);
        };
        let (reached, crossings) = self.crossings.step(self.ready.motion.as_mut(), time)?;
        for Crossing { event, row, time } in crossings {
            let name = Some(&self.ready.events[event]);
            let stops = name == self.problem.stop.as_ref();
            if stops || name == self.problem.section.as_ref() {
                left.rows.push(self.visible(row));
            }
            left.events.push((self.ready.events[event].clone(), time));
            if stops {
                self.next = self.ready.times.len();
                left.done = true;
                return Ok(left);
            }
        }
        if reached {
            if self.problem.section.is_none() {
                left.rows.push(self.visible(self.ready.motion.row()));
            }
            self.next += 1;
            left.done = self.next == self.ready.times.len();
        }
        Ok(left)
    }

    fn visible(&self, mut row: Vec<f64>) -> Vec<f64> {
        row.truncate(self.ready.columns.len());
        row
    }
}
