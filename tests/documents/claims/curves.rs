//! Curves on charts agree with closed forms, elliptic integrals and conserved quantities, in any
//! coordinates and units.
//!
//! Guards `documents::problem::on_chart`, `mechanics::systems::chart` and
//! `mechanics::simulation::classes::chart`.

mod charges;
mod edges;
mod laws;
mod relativity;
mod surfaces;

use affinor_documents::problem::Problem;

/// A problem on a chart with the parts of its file.
pub struct Curve<'c> {
    pub coordinates: &'c str,
    /// The metric, and further keys of the definition.
    pub geometry: &'c str,
    pub position: &'c str,
    pub velocity: &'c str,
    /// Further tables and keys of the file, in the table `[initial]` at first.
    pub more: &'c str,
    pub end: f64,
    pub every: f64,
}

/// A great circle of the unit sphere.
const SPHERE: Curve = Curve {
    coordinates: "\"theta\", \"phi\"",
    geometry: "metric = [1, \"sin(theta)^2\"]",
    position: "theta = 1.1, phi = 0.4",
    velocity: "theta = -0.5, phi = 0.9",
    more: "",
    end: 6.0,
    every: 0.5,
};

impl Curve<'_> {
    pub fn text(&self) -> String {
        let Curve { coordinates, geometry, position, velocity, more, end, every } = self;
        format!(
            "[definition]\nchart = {{ coordinates = [{coordinates}] }}\n{geometry}\n\
             [output]\nend = {end}\nevery = {every}\n[integrator]\ntolerance = 1e-12\n\
             [initial]\nposition = {{ {position} }}\nvelocity = {{ {velocity} }}\n{more}\n"
        )
    }

    pub fn rows(&self) -> Rows {
        rows(&self.text())
    }
}

/// The rows of a curve, up to its end.
#[derive(Debug)]
pub struct Rows {
    pub names: Vec<String>,
    pub rows: Vec<Vec<f64>>,
    /// The error that ends the curve early.
    pub end: Option<String>,
    /// The names of the conserved columns.
    pub conserved: Vec<String>,
    pub notes: Vec<String>,
}

impl Rows {
    pub fn column(&self, name: &str) -> Vec<f64> {
        let at = self.names.iter().position(|own| own == name);
        let at = at.unwrap_or_else(|| panic!("no column {name}: {:?}", self.names));
        self.rows.iter().map(|row| row[at]).collect()
    }

    pub fn last(&self, name: &str) -> f64 {
        *self.column(name).last().unwrap()
    }

    /// Asserts that all conserved columns keep their values.
    pub fn keeps_all(&self, bound: f64) {
        for name in &self.conserved {
            let values = self.column(name);
            let size = values[0].abs().max(1.0);
            let drift = values.iter().map(|value| (value - values[0]).abs() / size);
            let drift = drift.fold(0.0, f64::max);
            assert!(drift < bound, "{name} drifts by {drift:e}");
        }
    }
}

pub fn rows(text: &str) -> Rows {
    let problem =
        Problem::parse("curve.toml", text).unwrap_or_else(|error| panic!("{error}\n{text}"));
    let ready = problem.motion(0).unwrap_or_else(|error| panic!("{error}\n{text}"));
    let names = ready.columns.iter().map(|column| column.name.clone()).collect();
    let conserved = ready.columns.iter().filter(|column| column.conserved);
    let conserved = conserved.map(|column| column.name.clone()).collect();
    let notes = ready.notes.clone();
    let mut found = Rows { names, rows: vec![], end: None, conserved, notes };
    let mut integration = problem.integrate(ready);
    loop {
        match integration.step() {
            Ok(step) => {
                found.rows.extend(step.rows);
                if step.done {
                    return found;
                }
            }
            Err(error) => {
                found.end = Some(error.to_string());
                return found;
            }
        }
    }
}

/// The message of a problem that is an error.
pub fn refused(text: &str) -> String {
    let problem = Problem::parse("curve.toml", text);
    let error = match problem.map(|problem| problem.motion(0).map(|_| ())) {
        Err(error) | Ok(Err(error)) => error,
        Ok(Ok(())) => panic!("accepted: {text}"),
    };
    format!("{} ({})", error.message, error.help.unwrap_or_default())
}

pub fn near(found: f64, expected: f64, bound: f64) {
    assert!((found - expected).abs() <= bound, "{found} is not {expected} to {bound:e}");
}
