//! Groups in coordinates, and frames of functions over them.

use super::algebras::by_table;
use super::{inverse, labels, transform};
use affinor::{Frame, LieAlgebra};
use affinor_tensors::expression::{Expression, Scalars};
use affinor_tensors::{Down, Field, Notation, Ring, Symbolic, Tensor, Up};
use num_traits::Zero;
use std::sync::Arc;

/// A group in coordinates: its algebra and the left-invariant fields, `e_i = E^a_i d/dx^a`.
pub struct Chart {
    pub names: &'static [&'static str],
    pub algebra: LieAlgebra<Symbolic>,
    pub fields: Tensor<Symbolic>,
}

pub fn constant(n: i64) -> Symbolic {
    Symbolic::from_i64(n)
}

pub fn sum(terms: impl IntoIterator<Item = Symbolic>) -> Symbolic {
    terms.into_iter().fold(Symbolic::zero(), |sum, term| sum + &term)
}

fn matrix(rows: &[&[Symbolic]]) -> Tensor<Symbolic> {
    Tensor::from_fn(rows.len(), [Up, Down], |[i, j]| rows[i][j].clone()).unwrap()
}

impl Chart {
    pub fn new(
        names: &'static [&'static str],
        table: &[(usize, usize, usize, i64)],
        fields: &[&[Symbolic]],
    ) -> Self {
        let algebra = by_table(names.len(), table);
        let algebra = algebra.map(|v| Symbolic::constant(v.clone())).unwrap();
        Chart { names, algebra, fields: matrix(fields) }
    }

    pub fn dimension(&self) -> usize {
        self.names.len()
    }

    /// `e_j(f) = E^a_j df/dx^a`.
    pub fn derive(&self, j: usize, f: &Symbolic) -> Symbolic {
        let along = |(a, name): (usize, &&str)| self.fields.get(&[a, j]) * &f.derivative(name);
        sum(self.names.iter().enumerate().map(along))
    }

    /// The coordinate vectors as combinations of the left-invariant ones.
    pub fn coordinates(&self) -> Moved<'_> {
        Moved::new(self, inverse(&self.fields))
    }
}

/// `(x, y, z)(x', y', z') = (x + x', y + y', z + z' + x y')`: `[e1, e2] = e3`.
pub fn heisenberg() -> Chart {
    let [zero, one, x] = [constant(0), constant(1), Symbolic::parameter("x")];
    Chart::new(
        &["x", "y", "z"],
        &[(1, 2, 3, 1)],
        &[
            &[one.clone(), zero.clone(), zero.clone()],
            &[zero.clone(), one.clone(), zero.clone()],
            &[zero.clone(), x, one],
        ],
    )
}

/// `x -> a x + b`: `[e1, e2] = e2`.
pub fn affine() -> Chart {
    let [zero, a] = [constant(0), Symbolic::parameter("a")];
    Chart::new(&["a", "b"], &[(1, 2, 2, 1)], &[&[a.clone(), zero.clone()], &[zero, a]])
}

/// SL(2,R) near 1, `g = exp(u F) diag(a, 1/a) exp(v E)`, with `e1 = H`, `e2 = E`, `e3 = F`:
/// `g^-1 dg = (da/a - v a^2 du) H + (dv + 2 v da/a - v^2 a^2 du) E + a^2 du F`.
pub fn special_linear() -> Chart {
    let [zero, one] = [constant(0), constant(1)];
    let [a, v] = ["a", "v"].map(Symbolic::parameter);
    let square = a.clone() * &a;
    let forms = matrix(&[
        &[one.clone() / &a, zero.clone(), -v.clone() * &square],
        &[constant(2) * &v / &a, one, -v.clone() * &v * &square],
        &[zero.clone(), zero, square],
    ]);
    let algebra = by_table(3, &[(1, 2, 2, 2), (1, 3, 3, -2), (2, 3, 1, 1)]);
    let algebra = algebra.map(|v| Symbolic::constant(v.clone())).unwrap();
    Chart { names: &["a", "v", "u"], algebra, fields: inverse(&forms) }
}

/// SE(2), `(theta, x, y)`: a rotation, then a translation.
pub fn euclidean() -> Chart {
    by_fields(
        &["theta", "x", "y"],
        &[(1, 2, 3, 1), (1, 3, 2, -1)],
        [["1", "0", "0"], ["0", "cos(theta)", "-sin(theta)"], ["0", "sin(theta)", "cos(theta)"]],
    )
}

/// SO(3), `R_z(phi) R_x(theta) R_z(psi)`: H. Goldstein, *Classical Mechanics* (1980), (4-125).
pub fn euler_angles() -> Chart {
    by_fields(
        &["phi", "theta", "psi"],
        &[(1, 2, 3, 1), (2, 3, 1, 1), (3, 1, 2, 1)],
        [
            ["sin(psi)/sin(theta)", "cos(psi)/sin(theta)", "0"],
            ["cos(psi)", "-sin(psi)", "0"],
            ["-cot(theta)*sin(psi)", "-cot(theta)*cos(psi)", "1"],
        ],
    )
}

/// A value in the notation of definition files.
pub fn value(text: &str) -> Symbolic {
    let names = |name: &str| Ok(Symbolic::parameter(name));
    let expression = Expression::parse(text).unwrap();
    expression.evaluate(&Scalars(names, <Symbolic as Notation>::call)).unwrap()
}

/// The matrix with these entries.
pub fn values<const N: usize>(rows: [[&str; N]; N]) -> Tensor<Symbolic> {
    Tensor::from_fn(N, [Up, Down], |[i, j]| value(rows[i][j])).unwrap()
}

fn by_fields<const N: usize>(
    names: &'static [&'static str],
    table: &[(usize, usize, usize, i64)],
    rows: [[&str; N]; N],
) -> Chart {
    let algebra = by_table(N, table).map(|v| Symbolic::constant(v.clone())).unwrap();
    Chart { names, algebra, fields: values(rows) }
}

/// The frame `e'_a = A^i_a e_i` of functions over a chart.
pub struct Moved<'c> {
    pub chart: &'c Chart,
    pub a: Tensor<Symbolic>,
    pub inverse: Tensor<Symbolic>,
}

impl<'c> Moved<'c> {
    pub fn new(chart: &'c Chart, a: Tensor<Symbolic>) -> Self {
        let inverse = inverse(&a);
        Moved { chart, a, inverse }
    }

    /// The frame `e'_b = f_b e_b`, with a function times `e_1` added to `e_2`.
    pub fn scaled(chart: &'c Chart, functions: &[Symbolic], mixed: Symbolic) -> Self {
        let entry = |[i, b]: [usize; 2]| match (i, b) {
            (i, b) if i == b => functions[b].clone(),
            (0, 1) => mixed.clone(),
            _ => constant(0),
        };
        let n = chart.dimension();
        Self::new(chart, Tensor::from_fn(n, [Up, Down], entry).unwrap())
    }

    pub fn tensor(&self, constants: &Tensor<Symbolic>) -> Tensor<Symbolic> {
        transform(constants, &self.a, &self.inverse)
    }

    /// `B^c_i (A^j_a e_j(A^i_b) + A^j_a A^k_b T^i_jk)` in the slots `^c_ab`.
    pub fn inhomogeneous(&self, constants: &Tensor<Symbolic>) -> Tensor<Symbolic> {
        let (n, a) = (self.chart.dimension(), &self.a);
        let along = |[i, k, b]: [usize; 3]| {
            sum((0..n).map(|j| a.get(&[j, k]) * &self.chart.derive(j, &a.get(&[i, b]))))
        };
        let along = Tensor::from_fn(n, [Up, Down, Down], along).unwrap();
        let moved = self.tensor(constants);
        Tensor::from_fn(n, [Up, Down, Down], |[c, k, b]| {
            let derivative = (0..n).map(|i| self.inverse.get(&[c, i]) * &along.get(&[i, k, b]));
            sum(derivative) + &moved.get(&[c, k, b])
        })
        .unwrap()
    }

    /// `[e'_a, e'_b] = A^j_a e_j(A^i_b) e_i - A^j_b e_j(A^i_a) e_i + A^j_a A^k_b c^i_jk e_i`.
    pub fn structure_functions(&self) -> Tensor<Symbolic> {
        let c = self.chart.algebra.structure_constants();
        let half = c.scale(&constant(2).recip().unwrap());
        let part = self.inhomogeneous(&half);
        Tensor::from_fn(self.chart.dimension(), [Up, Down, Down], |[i, j, k]| {
            part.get(&[i, j, k]) - &part.get(&[i, k, j])
        })
        .unwrap()
    }

    pub fn frame(&self) -> Frame<Symbolic> {
        let fields = Tensor::from_fn(self.chart.dimension(), [Up, Down], |[a, b]| {
            let terms = self.a.components().filter(|(at, _)| at[1] == b);
            sum(terms.map(|(at, value)| self.chart.fields.get(&[a, at[0]]) * value))
        });
        let (fields, names) = (fields.unwrap(), self.chart.names);
        let derive = move |k: usize, f: &Symbolic| {
            let along = |(a, name): (usize, &&str)| fields.get(&[a, k]) * &f.derivative(name);
            sum(names.iter().enumerate().map(along))
        };
        let labels = labels(self.chart.dimension());
        Frame::moving(labels, self.structure_functions(), Arc::new(derive)).unwrap()
    }
}
