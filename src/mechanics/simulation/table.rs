//! Vectors as functions of time, interpolated from a table.

use crate::Error;

/// The relative rounding error of times within a step.
const ROUNDING: f64 = 4.0 * f64::EPSILON;

/// A vector as a function of time. It is interpolated linearly between rows, or [held](Self::held)
/// constant. Two rows at the same time define a discontinuity, from the values of the first row to
/// the values of the second.
#[derive(Clone, Debug, PartialEq)]
pub struct ForceTable {
    times: Vec<f64>,
    values: Vec<Vec<f64>>,
    /// Whether the values of a row are constant up to the next row.
    is_held: bool,
}

/// An interval between two rows of a [`ForceTable`], before the first row or after the last row. It
/// is represented by the number of rows before it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Interval(usize);

impl ForceTable {
    /// A table with these rows. Each row consists of a time and the values at this time.
    ///
    /// # Errors
    /// [`Error::Shape`] if there are no rows, if rows have different lengths, if times decrease, or
    /// if three rows have the same time.
    pub fn new(rows: Vec<Vec<f64>>) -> Result<Self, Error> {
        let shape =
            |expected: String, found: String| Error::Shape { what: "the table", expected, found };
        let Some(width) = rows.first().map(Vec::len) else {
            return Err(shape("rows".into(), "none".into()));
        };
        for (at, row) in rows.iter().enumerate() {
            if row.len() != width || width < 2 {
                let expected = format!("rows of a time and {} values", width.max(2) - 1);
                return Err(shape(expected, format!("row {} with {} numbers", at + 1, row.len())));
            }
            let ordered = row[0].is_finite() && (at == 0 || rows[at - 1][0] <= row[0]);
            if !ordered {
                let found = format!("the time {} in row {}", row[0], at + 1);
                return Err(shape("increasing times".into(), found));
            }
            if at > 1 && rows[at - 2][0] == row[0] {
                let found = format!("the time {} in the rows {} to {}", row[0], at - 1, at + 1);
                return Err(shape("at most two rows at one time".into(), found));
            }
        }
        let times = rows.iter().map(|row| row[0]).collect();
        let values = rows.into_iter().map(|row| row[1..].to_vec()).collect();
        Ok(ForceTable { times, values, is_held: false })
    }

    /// The same table with piecewise constant values. The values of each row are valid up to the
    /// next row.
    #[must_use]
    pub fn held(self) -> Self {
        ForceTable { is_held: true, ..self }
    }

    /// The same table, with zeros appended to the values of each row up to `width` values.
    #[must_use]
    pub fn padded(mut self, width: usize) -> Self {
        let short = self.values.iter_mut().filter(|row| row.len() < width);
        short.for_each(|row| row.resize(width, 0.0));
        self
    }

    /// The number of values in each row.
    pub fn width(&self) -> usize {
        self.values[0].len()
    }

    /// The first and the last time.
    pub fn span(&self) -> [f64; 2] {
        [self.times[0], self.times[self.times.len() - 1]]
    }

    /// The first row time strictly between `from` and `until`, as seen from `from`. The values have
    /// a kink at this time.
    pub fn corner(&self, from: f64, until: f64) -> Option<f64> {
        let forwards = from < until;
        let next = if forwards {
            self.times.get(self.times.partition_point(|t| *t <= from))
        } else {
            self.times[..self.times.partition_point(|t| *t < from)].last()
        };
        next.copied().filter(|t| (*t < until) == forwards)
    }

    /// The interval in which a step from the time `from` towards `until` begins.
    pub fn interval(&self, from: f64, until: f64) -> Interval {
        let forwards = from <= until;
        // allows a tolerance, because rounding errors may move the end of the previous step
        // slightly off the time of a row
        let slack = ROUNDING * from.abs();
        let begun = |t: &f64| if forwards { *t <= from + slack } else { *t < from - slack };
        Interval(self.times.partition_point(begun))
    }

    /// Adds the values at a time to `sum`. Before the first row and after the last row, the values
    /// are constant. At an end of the interval `inside`, the limit from within the interval is
    /// used; at any other discontinuity, the value after it is used.
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

    /// Whether an interval contains a time. The ends of the interval are included, up to rounding
    /// errors.
    fn holds(&self, Interval(behind): Interval, time: f64) -> bool {
        let slack = ROUNDING * time.abs();
        let begun = behind == 0 || self.times[behind - 1] <= time + slack;
        begun && self.times.get(behind).is_none_or(|end| time - slack <= *end)
    }
}
