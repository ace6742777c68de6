//! Vectors over time, interpolated from a table.

use crate::Error;

/// The relative rounding error of times within a step.
const ROUNDING: f64 = 4.0 * f64::EPSILON;

/// Vectors over time, interpolated linearly between rows, or [held](Self::held). Two rows at the
/// same time are a discontinuity, from the values of the first row to those of the second.
#[derive(Clone, Debug, PartialEq)]
pub struct ForceTable {
    times: Vec<f64>,
    values: Vec<Vec<f64>>,
    /// Whether the values of a row are constant up to the next row.
    is_held: bool,
}

/// An interval between two rows of a [`ForceTable`], or before the first or after the last row. It
/// is given by the number of rows before it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Interval(usize);

impl ForceTable {
    /// The table with these rows, each a time and the values at that time.
    ///
    /// # Errors
    /// [`Error::Shape`] without rows, for rows of different lengths, for times that decrease, and for three rows at one time.
    pub fn new(rows: Vec<Vec<f64>>) -> Result<Self, Error> {
        let shape =
            |expected: String, found: String| Error::Shape { what: "the table", expected, found };
        let Some(width) = rows.first().map(Vec::len) else {
            return Err(shape("rows".into(), "none".into()));
        };
        for (at, row) in rows.iter().enumerate() {
            if row.len() != width || width < 2 {
                let expected = format!("rows of a time and {} values", width.max(2) - 1);
                return Err(shape(expected, format!("row {} of {} numbers", at + 1, row.len())));
            }
            let ordered = row[0].is_finite() && (at == 0 || rows[at - 1][0] <= row[0]);
            if !ordered {
                let found = format!("{} in row {}", row[0], at + 1);
                return Err(shape("increasing times".into(), found));
            }
            if at > 1 && rows[at - 2][0] == row[0] {
                let found = format!("{} in the rows {} to {}", row[0], at - 1, at + 1);
                return Err(shape("at most two rows at one time".into(), found));
            }
        }
        let times = rows.iter().map(|row| row[0]).collect();
        let values = rows.into_iter().map(|row| row[1..].to_vec()).collect();
        Ok(ForceTable { times, values, is_held: false })
    }

    /// The same table with piecewise constant values: each row is valid up to the next one.
    #[must_use]
    pub fn held(self) -> Self {
        ForceTable { is_held: true, ..self }
    }

    /// The same table with zeros appended to the values, up to `width` values.
    #[must_use]
    pub fn padded(mut self, width: usize) -> Self {
        let short = self.values.iter_mut().filter(|row| row.len() < width);
        short.for_each(|row| row.resize(width, 0.0));
        self
    }

    /// The number of values at a time.
    pub fn width(&self) -> usize {
        self.values[0].len()
    }

    /// The first and the last time.
    pub fn span(&self) -> [f64; 2] {
        [self.times[0], self.times[self.times.len() - 1]]
    }

    /// The first time of a row strictly between two times, as seen from the first of them. The
    /// values have a kink there.
    pub fn corner(&self, from: f64, until: f64) -> Option<f64> {
        let forwards = from < until;
        let next = if forwards {
            self.times.get(self.times.partition_point(|t| *t <= from))
        } else {
            self.times[..self.times.partition_point(|t| *t < from)].last()
        };
        next.copied().filter(|t| (*t < until) == forwards)
    }

    /// The interval in which a step from one time towards another begins.
    pub fn interval(&self, from: f64, until: f64) -> Interval {
        let forwards = from <= until;
        // because of rounding errors, the previous step may end slightly off the time of a row
        let slack = ROUNDING * from.abs();
        let begun = |t: &f64| if forwards { *t <= from + slack } else { *t < from - slack };
        Interval(self.times.partition_point(begun))
    }

    /// Adds the values at a time to `sum`; before the first and after the last row they are
    /// constant. At an end of `inside` the limit from within is used, at any other discontinuity
    /// the value after it.
    pub fn add(&self, time: f64, inside: Option<Interval>, sum: &mut [f64]) {
        let Interval(behind) = inside
            .filter(|interval| self.holds(*interval, time))
            .unwrap_or_else(|| self.interval(time, time));
        let (a, b) = (behind.saturating_sub(1), behind.min(self.times.len() - 1));
        let share = match self.times[b] - self.times[a] {
            length if length > 0.0 && !self.is_held => {
                ((time - self.times[a]) / length).clamp(0.0, 1.0)
            }
            _ => 0.0,
        };
        for ((sum, a), b) in sum.iter_mut().zip(&self.values[a]).zip(&self.values[b]) {
            *sum += a + share * (b - a);
        }
    }

    /// Whether a time is in an interval, or at its ends up to rounding errors.
    fn holds(&self, Interval(behind): Interval, time: f64) -> bool {
        let slack = ROUNDING * time.abs();
        let begun = behind == 0 || self.times[behind - 1] <= time + slack;
        begun && self.times.get(behind).is_none_or(|end| time - slack <= *end)
    }
}
