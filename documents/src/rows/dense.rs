//! Rows that are dense enough to draw curves, even if the rows of the problem are far apart.

use affinor::Error;
use affinor::mechanics::simulation::Motion;

/// The largest distance of a curve from its chords, as a fraction of the width of the picture.
const FLAT: f64 = 5e-4;
/// The largest number of halvings of a step.
const HALVINGS: u32 = 6;
/// The largest number of intervals of a curve.
const INTERVALS: f64 = 1e4;
/// The smallest width of a picture relative to the values. Smaller changes are rounding errors.
const RELATIVE: f64 = 1e-9;

/// The curve of chosen columns along a motion.
pub struct DenseRows<'m> {
    motion: &'m mut dyn Motion,
    columns: &'m [usize],
    /// The smallest and the largest value of each column so far.
    ranges: Vec<[f64; 2]>,
    /// The smallest time between rows.
    least: f64,
    rows: Vec<Vec<f64>>,
}

impl<'m> DenseRows<'m> {
    /// Computes rows of the time and of `columns`, through the given times. Long steps are halved
    /// with dense output until each chord is close to the curve.
    ///
    /// # Errors
    /// The error that prevents the motion from continuing.
    pub fn along(
        motion: &'m mut dyn Motion,
        times: &[f64],
        columns: &'m [usize],
    ) -> Result<Vec<Vec<f64>>, Error> {
        let span = times.last().map_or(0.0, |last| (last - times[0]).abs());
        let least = span / INTERVALS;
        let mut curve = DenseRows { motion, columns, ranges: vec![], least, rows: vec![] };
        let first = curve.row();
        curve.ranges = first[1..].iter().map(|value| [*value, *value]).collect();
        curve.rows.push(first);
        for &time in times {
            while !curve.step(time)? {}
        }
        Ok(curve.rows)
    }

    /// The current row: the time and the columns.
    fn row(&self) -> Vec<f64> {
        let all = self.motion.row();
        let values = self.columns.iter().map(|column| all[*column]);
        [self.motion.time()].into_iter().chain(values).collect()
    }

    /// Makes one step towards the time `until`, and adds the rows within it.
    fn step(&mut self, until: f64) -> Result<bool, Error> {
        let from = self.row();
        self.motion.store();
        let reached = self.motion.step_for_events(until)?;
        let to = self.row();
        for (range, value) in self.ranges.iter_mut().zip(&to[1..]) {
            *range = [range[0].min(*value), range[1].max(*value)];
        }
        if self.halve(&from, &to, HALVINGS)? {
            self.motion.roll_back();
            self.motion.step_for_events(until)?;
        }
        let passed = self.rows.last().map_or(f64::INFINITY, |last| (to[0] - last[0]).abs());
        if passed >= self.least || reached && passed > 0.0 {
            self.rows.push(to);
        }
        Ok(reached)
    }

    /// Adds rows between the ends `from` and `to` of a part of the step. Returns whether this
    /// changed the state of the motion.
    fn halve(&mut self, from: &[f64], to: &[f64], halvings: u32) -> Result<bool, Error> {
        let half = 0.5 * (to[0] - from[0]);
        if halvings == 0 || half.abs() < self.least {
            return Ok(false);
        }
        self.motion.roll_back();
        while !self.motion.step(from[0] + half)? {}
        let middle = self.row();
        let bends = (0..self.ranges.len()).any(|k| {
            let [low, high] = self.ranges[k];
            let size = (high - low).max(RELATIVE * high.abs().max(low.abs()));
            (middle[k + 1] - 0.5 * (from[k + 1] + to[k + 1])).abs() > FLAT * size
        });
        if bends {
            self.halve(from, &middle, halvings - 1)?;
            self.rows.push(middle.clone());
            self.halve(&middle, to, halvings - 1)?;
        }
        Ok(true)
    }
}
