//! Vectors over time, by linear interpolation of a table.

use crate::Error;

/// Vectors at increasing times, interpolated linearly between them.
#[derive(Clone, Debug, PartialEq)]
pub struct Table {
    times: Vec<f64>,
    values: Vec<Vec<f64>>,
}

impl Table {
    /// The table of rows, each a time and the values at that time.
    ///
    /// # Errors
    /// [`Error::Shape`] without rows, for rows of different lengths, and for times that do not increase.
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
            let ordered = row[0].is_finite() && (at == 0 || rows[at - 1][0] < row[0]);
            if !ordered {
                let found = format!("{} in row {}", row[0], at + 1);
                return Err(shape("increasing times".into(), found));
            }
        }
        let times = rows.iter().map(|row| row[0]).collect();
        Ok(Table { times, values: rows.into_iter().map(|row| row[1..].to_vec()).collect() })
    }

    /// The number of values at a time.
    pub fn width(&self) -> usize {
        self.values[0].len()
    }

    /// The first and the last time.
    pub fn span(&self) -> [f64; 2] {
        [self.times[0], self.times[self.times.len() - 1]]
    }

    /// The first time of a row strictly between two times, as seen from the first of them: the values have a corner there.
    pub fn corner(&self, from: f64, until: f64) -> Option<f64> {
        let forwards = from < until;
        let next = if forwards {
            self.times.get(self.times.partition_point(|t| *t <= from))
        } else {
            self.times[..self.times.partition_point(|t| *t < from)].last()
        };
        next.copied().filter(|t| (*t < until) == forwards)
    }

    /// Adds the values at a time to `sum`; before the first and after the last row they are constant.
    pub fn add(&self, time: f64, sum: &mut [f64]) {
        let behind = self.times.partition_point(|t| *t <= time);
        let (a, b) = (behind.saturating_sub(1), behind.min(self.times.len() - 1));
        let share = match self.times[b] - self.times[a] {
            0.0 => 0.0,
            length => ((time - self.times[a]) / length).clamp(0.0, 1.0),
        };
        for ((sum, a), b) in sum.iter_mut().zip(&self.values[a]).zip(&self.values[b]) {
            *sum += a + share * (b - a);
        }
    }
}
