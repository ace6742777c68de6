//! Drift of conserved quantities along a motion.

use super::diagram::{Diagram, Drawn, Graph, Line, Scale};
use crate::rows::RunRows;
use affinor::Error;

/// The smallest change that is shown. Smaller changes, including zero, are shown as this value.
const ROUNDING: f64 = 1e-17;
/// The largest number of points of a line.
const POINTS: f64 = 2000.0;

/// How a change is measured.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Change {
    /// The absolute change `|q(t) - q(0)|`.
    Absolute,
    /// The relative change `|q(t) - q(0)| / |q(0)|`. For a quantity that starts at zero, the
    /// absolute change.
    Relative,
}

/// The drift of quantities: at each time, their largest changes up to this time.
#[derive(Clone, Debug)]
pub struct Drift {
    names: Vec<String>,
    /// The method, which is added to captions; may be empty.
    method: String,
    /// The smallest time between two points of a line.
    least: f64,
    first: Vec<f64>,
    largest: Vec<f64>,
    /// The time of the last values, if no point contains them yet.
    pending: Option<f64>,
    points: Vec<(f64, Vec<f64>)>,
}

impl Drift {
    /// Creates an empty record of the drift of quantities over a time span.
    pub fn new(names: Vec<String>, method: String, span: f64) -> Self {
        let (first, largest, points) = (vec![], vec![0.0; names.len()], vec![]);
        Drift { names, method, least: span.abs() / POINTS, first, largest, pending: None, points }
    }

    /// The drift of columns of a run; `parameter` is the column of the time.
    ///
    /// # Errors
    /// [`Error::Name`] if the run has no column with one of the names.
    pub fn of_rows(run: &RunRows, names: &[String], parameter: &str) -> Result<Self, Error> {
        let times = run.column(parameter)?;
        let columns = names.iter().map(|name| run.column(name));
        let columns = columns.collect::<Result<Vec<_>, _>>()?;
        let mut drift = Drift::new(names.to_vec(), String::new(), 0.0);
        for (k, time) in times.iter().enumerate() {
            drift.add(*time, &columns.iter().map(|column| column[k]).collect::<Vec<_>>());
        }
        Ok(drift)
    }

    /// Adds the values at the next time. Changes are measured from the first values.
    pub fn add(&mut self, time: f64, values: &[f64]) {
        if self.first.is_empty() {
            self.first = values.to_vec();
            self.points.push((time, self.largest.clone()));
            return;
        }
        for (largest, (value, first)) in self.largest.iter_mut().zip(values.iter().zip(&self.first))
        {
            *largest = (value - first).abs().max(*largest);
        }
        let before = self.points.last().map_or(time, |(before, _)| *before);
        self.pending = Some(time);
        if (time - before).abs() >= self.least {
            self.end();
        }
    }

    /// Adds a point for the last values, unless there is one.
    pub fn end(&mut self) {
        if let Some(time) = self.pending.take() {
            self.points.push((time, self.largest.clone()));
        }
    }

    fn lines(&self, change: Change) -> impl Iterator<Item = Line> {
        self.names.iter().enumerate().map(move |(k, name)| {
            let size = self.first.get(k).map_or(0.0, |first| first.abs());
            let is_relative = change == Change::Relative && size > 0.0;
            let unit = if is_relative { size } else { 1.0 };
            let method = if self.method.is_empty() { "" } else { &format!(", {}", self.method) };
            let kind = if change == Change::Relative && !is_relative { " (absolute)" } else { "" };
            let at = |(time, largest): &(f64, Vec<f64>)| [*time, (largest[k] / unit).max(ROUNDING)];
            // omits the first point, which has no changes
            let points = self.points.iter().skip(1).map(at).collect();
            Line { caption: format!("{name}{method}{kind}"), points, drawn: Drawn::Line }
        })
    }
}

/// The diagram of the largest changes over time, for one or several methods.
pub fn diagram(name: &str, drifts: &[Drift], change: Change) -> Diagram {
    let lines = drifts.iter().flat_map(|drift| drift.lines(change)).collect();
    let label = match change {
        Change::Absolute => "largest absolute change |q(t) − q(0)|",
        Change::Relative => "largest relative change |q(t) − q(0)| / |q(0)|",
    };
    let (x, y) = (Scale::linear("time t"), Scale::logarithmic(label));
    let title = format!("{name}: conserved quantities");
    Diagram { title, graphs: vec![Graph { x, y, equal: false, lines }] }
}
