//! The eigenvalues of small deviations from an equilibrium or a steady motion.

use super::grid::{Cell, Grid};
use super::head::printable;
use super::{Format, Report};
use crate::input::InputError;
use crate::problem::{LinearProblem, Problem};
use serde_json::json;
use std::io::{self, Write};

/// The name of the schema.
const SCHEMA: &str = "affinor.linearization/1";
/// Rates take part in a mode if their displacements are at least this multiple of the largest one.
const SMALL: f64 = 0.05;

/// The linear equations of a problem at its initial state, ready for output.
#[derive(Clone, Debug)]
pub struct LinearizationReport {
    grid: Grid,
    notes: Vec<String>,
}

impl LinearizationReport {
    /// Computes the linear equations.
    ///
    /// # Errors
    /// Those of [`Problem::linearized`].
    pub fn of(problem: &Problem) -> Result<Self, InputError> {
        let found = problem.linearized()?;
        Ok(LinearizationReport { grid: grid(&problem.name, &found), notes: found.notes })
    }

    /// Notes on the initial state.
    pub fn notes(&self) -> &[String] {
        &self.notes
    }
}

/// A number with the digits that are certain.
fn rounded(x: f64) -> String {
    let shown = format!("{x:.9}");
    let shown = shown.trim_end_matches('0').trim_end_matches('.');
    if shown == "-0" { "0".into() } else { shown.into() }
}

fn grid(name: &str, found: &LinearProblem) -> Grid {
    let linear = &found.linear;
    let mut rows: Vec<Vec<Cell>> = vec![];
    for (value, shape) in linear.eigenvalues.iter().zip(&linear.shapes) {
        // a pair is one row
        if value.im < 0.0 {
            continue;
        }
        let size = value.norm();
        let (text, period) = match value.im {
            0.0 => (rounded(value.re), String::new()),
            im => {
                let text = format!("{} ± {} i", rounded(value.re), rounded(im));
                (text, rounded(std::f64::consts::TAU / im))
            }
        };
        let damping = if value.im == 0.0 { String::new() } else { rounded(-value.re / size) };
        let mut of_mode: Vec<(&String, &f64)> =
            found.rates.iter().zip(shape).filter(|(_, size)| **size >= SMALL).collect();
        of_mode.sort_by(|a, b| b.1.total_cmp(a.1));
        let of_mode: Vec<&str> = of_mode.iter().map(|(name, _)| name.as_str()).collect();
        rows.push(vec![text.into(), period.into(), damping.into(), of_mode.join(", ").into()]);
    }
    let dimension = linear.matrix.nrows();
    let stability = match linear.eigenvalues.first() {
        Some(value) if value.re > 1e-9 * value.norm() => "unstable",
        Some(value) if value.re < -1e-9 * value.norm() && linear.zeros > 0 => {
            "asymptotically stable, up to zeros"
        }
        Some(value) if value.re < -1e-9 * value.norm() => "asymptotically stable",
        _ => "no growth to first order",
    };
    let kind = if found.is_at_rest { "equilibrium" } else { "steady motion" };
    let values = found.coordinates.iter().chain(&found.rates).zip(&found.state);
    let values = values.map(|(name, value)| (name, rounded(*value)));
    let values = values.filter(|(_, value)| value != "0");
    let values: Vec<String> = values.map(|(name, value)| format!("{name} = {value}")).collect();
    let values = if values.is_empty() { "all 0".into() } else { values.join(", ") };
    let head: Vec<(&'static str, Cell)> = vec![
        ("state", format!("{kind}: {values}").into()),
        ("equations", format!("{dimension} of first order, {} eigenvalues 0", linear.zeros).into()),
        ("stability", stability.into()),
    ];
    let list = |rows: &nalgebra::DMatrix<f64>| {
        let rows = rows.row_iter().map(|row| row.iter().copied().collect::<Vec<_>>());
        rows.collect::<Vec<_>>()
    };
    let eigenvalues = linear.eigenvalues.iter().map(|value| [value.re, value.im]);
    let json = json!({
        "schema": SCHEMA,
        "name": name,
        "equilibrium": found.is_at_rest,
        "coordinates": found.coordinates,
        "rates": found.rates,
        "state": found.state,
        "matrix": list(&linear.matrix),
        "basis": list(&linear.basis),
        "zeros": linear.zeros,
        "eigenvalues": eigenvalues.collect::<Vec<_>>(),
        "shapes": linear.shapes,
    });
    let title = format!("Linearization of {}", printable(name));
    let header = ["eigenvalue", "period", "damping", "rates"];
    Grid::new(title, &header, rows, json).with_head(head)
}

impl Report for LinearizationReport {
    fn write(&self, format: Format, out: &mut dyn Write) -> io::Result<()> {
        self.grid.write(format, out)
    }
}
