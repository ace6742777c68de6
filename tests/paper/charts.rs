//! Groups in coordinates: fields, their brackets by coordinates, and the left frame as a moving one.

use crate::common::charts::{self, Chart, constant, sum};
use crate::common::{inverse, labels};
use crate::paper::value;
use affinor::Frame;
use affinor_tensors::{Down, Symbolic, Tensor, Up};
use std::sync::Arc;

/// A group in coordinates with its left- and right-invariant fields; the fields are columns of
/// their coordinate components.
pub struct Group {
    pub name: &'static str,
    pub chart: Chart,
    pub right: Tensor<Symbolic>,
}

fn matrix<const N: usize>(rows: [[&str; N]; N]) -> Tensor<Symbolic> {
    Tensor::from_fn(N, [Up, Down], |[i, j]| value(rows[i][j])).unwrap()
}

/// Rotations by their Gibbs vector `q = tan(angle/2) n`: `R = 1 + 2 (q~ + q~^2)/(1 + q^2)`.
pub fn rotations() -> Group {
    let [rows, right] = [1, -1].map(|sign| {
        // the fields are the columns of 1/2 (1 + q~ + q q^T) and 1/2 (1 - q~ + q q^T)
        let q = ["x", "y", "z"].map(Symbolic::parameter);
        let spin = spin(&q);
        Tensor::from_fn(3, [Up, Down], |[i, j]| {
            let unit = constant(i64::from(i == j)) + &(spin.get(&[i, j]) * &constant(sign));
            (unit + &(q[i].clone() * &q[j])) * &value("1/2")
        })
        .unwrap()
    });
    let rows: Vec<Vec<Symbolic>> =
        (0..3).map(|i| (0..3).map(|j| rows.get(&[i, j])).collect()).collect();
    let rows: Vec<&[Symbolic]> = rows.iter().map(Vec::as_slice).collect();
    let table = [(1, 2, 3, 1), (2, 3, 1, 1), (3, 1, 2, 1)];
    Group { name: "SO(3)", chart: Chart::new(&["x", "y", "z"], &table, &rows), right }
}

/// `x -> a x + b`.
pub fn affine() -> Group {
    let right = matrix([["a", "0"], ["b", "1"]]);
    Group { name: "Aff(1)", chart: charts::affine(), right }
}

pub fn heisenberg() -> Group {
    let right = matrix([["1", "0", "0"], ["0", "1", "0"], ["y", "0", "1"]]);
    Group { name: "Heisenberg", chart: charts::heisenberg(), right }
}

/// SL(2,R), `g = exp(u F) diag(a, 1/a) exp(v E)`; the right-invariant forms are the columns of
/// `dg g^-1 = (da/a - u a^2 dv) H + a^2 dv E + (du + 2 u da/a - u^2 a^2 dv) F`.
pub fn special_linear() -> Group {
    let forms = matrix([["1/a", "-u*a^2", "0"], ["0", "a^2", "0"], ["2*u/a", "-u^2*a^2", "1"]]);
    Group { name: "SL(2,R)", chart: charts::special_linear(), right: inverse(&forms) }
}

pub fn groups() -> [Group; 4] {
    [rotations(), affine(), heisenberg(), special_linear()]
}

/// `spin(q)`, rows `[0,-q3,q2], [q3,0,-q1], [-q2,q1,0]` (6).
pub fn spin(q: &[Symbolic]) -> Tensor<Symbolic> {
    let zero = constant(0);
    let rows = [
        [zero.clone(), -q[2].clone(), q[1].clone()],
        [q[2].clone(), zero.clone(), -q[0].clone()],
        [-q[1].clone(), q[0].clone(), zero],
    ];
    Tensor::from_fn(3, [Up, Down], |[i, j]| rows[i][j].clone()).unwrap()
}

impl Group {
    pub fn n(&self) -> usize {
        self.chart.dimension()
    }

    /// The coordinate components of the left-invariant `e_j`.
    pub fn left(&self, j: usize) -> Vec<Symbolic> {
        column(&self.chart.fields, j)
    }

    /// The coordinate components of the right-invariant field through the same basis vector.
    pub fn right(&self, j: usize) -> Vec<Symbolic> {
        column(&self.right, j)
    }

    /// The left frame, whose vectors differentiate functions of the coordinates.
    pub fn frame(&self) -> Frame<Symbolic> {
        self.frame_of(self.chart.algebra.structure().clone())
    }

    /// A frame with the derivatives of the left one, and any structure.
    pub fn frame_of(&self, structure: Tensor<Symbolic>) -> Frame<Symbolic> {
        let (fields, names) = (self.chart.fields.clone(), self.chart.names);
        let derive = move |k: usize, f: &Symbolic| {
            let along = |(a, name): (usize, &&str)| fields.get(&[a, k]) * &f.derivative(name);
            sum(names.iter().enumerate().map(along))
        };
        Frame::moving(labels(self.n()), structure, Arc::new(derive)).unwrap()
    }

    /// The Lie bracket of two fields by coordinates, `X^b d_b Y^a - Y^b d_b X^a`.
    pub fn lie(&self, x: &[Symbolic], y: &[Symbolic]) -> Vec<Symbolic> {
        let part = |x: &[Symbolic], f: &Symbolic| {
            let terms = self.chart.names.iter().zip(x);
            sum(terms.map(|(name, x)| x.clone() * &f.derivative(name)))
        };
        (0..self.n()).map(|a| part(x, &y[a]) - &part(y, &x[a])).collect()
    }

    /// The coordinate components of a field given in the left frame.
    pub fn to_coordinates(&self, x: &[Symbolic]) -> Vec<Symbolic> {
        apply(&self.chart.fields, x)
    }

    /// The components in the left frame of a field given by coordinates.
    pub fn to_frame(&self, x: &[Symbolic]) -> Vec<Symbolic> {
        apply(&inverse(&self.chart.fields), x)
    }

    /// Two fields without a pattern, in left components.
    pub fn fields(&self) -> [Vec<Symbolic>; 2] {
        let names = self.chart.names;
        let at = |i: usize| Symbolic::parameter(names[i % names.len()]);
        let x = (0..self.n()).map(|i| at(i) * &at(i + 1) + &constant(i as i64 + 1));
        let y = (0..self.n()).map(|i| at(i + 1) * &at(i + 1) - &at(i) + &constant(2));
        [x.collect(), y.collect()]
    }

    /// The bracket of two fields by the library, in the left frame.
    pub fn bracket(&self, x: &[Symbolic], y: &[Symbolic]) -> Vec<Symbolic> {
        self.frame().bracket(x, y).unwrap()
    }
}

pub fn column(matrix: &Tensor<Symbolic>, j: usize) -> Vec<Symbolic> {
    (0..matrix.dimension()).map(|i| matrix.get(&[i, j])).collect()
}

pub fn apply(matrix: &Tensor<Symbolic>, x: &[Symbolic]) -> Vec<Symbolic> {
    let n = matrix.dimension();
    (0..n).map(|i| sum((0..n).map(|j| matrix.get(&[i, j]) * &x[j]))).collect()
}
