//! Runs a problem of the examples.

use affinor_documents::problem::Problem;
use nalgebra::{DMatrix, Isometry3, Quaternion, UnitQuaternion, Vector3};
use std::path::PathBuf;

pub fn folder() -> PathBuf {
    PathBuf::from(concat!(env!("CARGO_MANIFEST_DIR"), "/..")).join("examples/motions")
}

pub fn open(name: &str) -> Problem {
    let path = folder().join(format!("{name}.toml"));
    Problem::read(path.to_str().unwrap()).unwrap_or_else(|error| panic!("{name}: {error}"))
}

/// The rows of a motion, with columns found by name.
pub struct Run {
    pub name: String,
    pub names: Vec<String>,
    pub rows: Vec<Vec<f64>>,
}

impl Run {
    pub fn new(problem: &Problem, member: u64) -> Self {
        let mut ready = problem.motion(member).unwrap_or_else(|e| panic!("{}: {e}", problem.name));
        let names = ready.columns.iter().map(|column| column.name.clone()).collect();
        let mut rows = vec![];
        for time in ready.times.clone() {
            while !ready.motion.step(time).unwrap() {}
            rows.push(ready.motion.row());
            assert!(rows[rows.len() - 1].iter().all(|x| x.is_finite()), "{}", problem.name);
        }
        Run { name: problem.name.clone(), names, rows }
    }

    pub fn has(&self, name: &str) -> bool {
        self.names.iter().any(|own| own == name)
    }

    pub fn column(&self, name: &str) -> Vec<f64> {
        let at = self.names.iter().position(|own| own == name);
        let at = at.unwrap_or_else(|| panic!("{} has no column {name}", self.name));
        self.rows.iter().map(|row| row[at]).collect()
    }

    /// The row at a time of the motion, up to rounding.
    pub fn at(&self, time: f64) -> usize {
        let times = self.column("t");
        let row = times.iter().position(|t| (t - time).abs() < 1e-9);
        row.unwrap_or_else(|| panic!("{} has no row at {time}", self.name))
    }

    pub fn values(&self, row: usize, names: &[&str]) -> Vec<f64> {
        names.iter().map(|name| self.column(name)[row]).collect()
    }

    /// All columns `stem1`, `stem2`, ...
    pub fn vector(&self, row: usize, stem: &str) -> Vec<f64> {
        let names = (1..).map(|i| format!("{stem}{i}")).take_while(|name| self.has(name));
        let names: Vec<String> = names.collect();
        assert!(!names.is_empty(), "{} has no {stem}", self.name);
        names.iter().map(|name| self.column(name)[row]).collect()
    }

    /// The matrix of the element, from the coordinates that the motion has.
    pub fn matrix(&self, row: usize) -> DMatrix<f64> {
        let value = |name: &str| self.column(name)[row];
        if self.has("qw") {
            let q = Quaternion::new(value("qw"), value("qx"), value("qy"), value("qz"));
            let q = UnitQuaternion::new_unchecked(q);
            let turn = q.to_rotation_matrix().into_inner();
            if !self.has("x") {
                return DMatrix::from_iterator(3, 3, turn.iter().copied());
            }
            let place = Vector3::new(value("x"), value("y"), value("z"));
            let motion = Isometry3::from_parts(place.into(), q).to_homogeneous();
            return DMatrix::from_iterator(4, 4, motion.iter().copied());
        }
        if self.has("angle") {
            let (sin, cos) = value("angle").sin_cos();
            let rows = [cos, -sin, value("x"), sin, cos, value("y"), 0.0, 0.0, 1.0];
            return DMatrix::from_row_slice(3, 3, &rows);
        }
        let n = (1..10).take_while(|i| self.has(&format!("g{i}{i}"))).count();
        DMatrix::from_fn(n, n, |i, j| value(&format!("g{}{}", i + 1, j + 1)))
    }

    /// The largest change of a column, relative to its size if that is above 1.
    pub fn drift(&self, name: &str) -> f64 {
        let column = self.column(name);
        let change = column.iter().map(|x| (x - column[0]).abs()).fold(0.0, f64::max);
        change / column[0].abs().max(1.0)
    }

    pub fn keeps(&self, names: &[&str], bound: f64) {
        for name in names {
            let drift = self.drift(name);
            assert!(drift < bound, "{}: {name} changes by {drift:e}", self.name);
        }
    }
}
