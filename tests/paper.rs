//! The equations of the paper, in its order, computed and compared with what it prints.
//!
//! I. Paraskevopoulos and S. Natsiavas, *Int. J. Solids and Structures* 50 (2013) 57-72. A test is
//! named after its equation. Expected values stand in the tests: the paper's numbers and formulas,
//! products of matrices, or loops over structure constants written down by hand. Algebras other
//! than so(3) are there to catch signs and index orders that cancel on it.

mod appendices;
mod canonical;
mod charts;
mod classical;
mod coordinates;
mod dynamics;
mod extensions;
mod fields;
mod groups;
mod halves;
mod kinematics;
mod matrices;
mod metrics;
mod motion;
mod on_groups;
mod power;
mod rotations;
mod translations;

use crate::common::algebras::by_table;
use affinor::{LieAlgebra, Metric};
use affinor_tensors::expression::{Expression, Scalars, no_function};
use affinor_tensors::{Down, Notation, Rational, Scalar, Symbolic, Tensor, Up, Variance};

/// A rational number or a formula, as written on paper.
fn value<S: Notation + Scalar>(text: &str) -> S {
    let parameter = |name: &str| S::parameter(name).ok_or(format!("`{name}` is no number"));
    Expression::parse(text).unwrap().evaluate(&Scalars(parameter, no_function)).unwrap()
}

fn values<S: Notation + Scalar, const N: usize>(texts: [&str; N]) -> Vec<S> {
    texts.map(value).to_vec()
}

/// The tensor with these components, indices from 1 as on paper.
fn tensor<S: Notation + Scalar, const R: usize>(
    n: usize,
    slots: [Variance; R],
    components: &[([usize; R], &str)],
) -> Tensor<S> {
    let components = components.iter().map(|(at, text)| (at.map(|index| index - 1), value(text)));
    Tensor::from_components(n, &slots, components).unwrap()
}

/// The symmetric matrix with these rows as a metric.
fn metric<S: Notation + Scalar>(rows: &[&[&str]]) -> Metric<S> {
    let n = rows.len();
    let g = Tensor::from_fn(n, [Down, Down], |[i, j]| value(rows[i][j])).unwrap();
    Metric::new(crate::common::labels(n), g).unwrap()
}

/// The inertia of a body, all six components free.
fn inertia() -> Metric<Symbolic> {
    metric(&[&["J11", "J12", "J13"], &["J12", "J22", "J23"], &["J13", "J23", "J33"]])
}

/// The Levi-Civita symbol, indices from 0.
fn epsilon(i: usize, j: usize, k: usize) -> i64 {
    match (i, j, k) {
        (0, 1, 2) | (1, 2, 0) | (2, 0, 1) => 1,
        (2, 1, 0) | (1, 0, 2) | (0, 2, 1) => -1,
        _ => 0,
    }
}

fn delta(i: usize, j: usize) -> i64 {
    i64::from(i == j)
}

/// `share * eps_ijk` in the slots `^i_jk`.
fn epsilons<S: Notation + Scalar>(share: &str) -> Tensor<S> {
    let share: S = value(share);
    let component = |[i, j, k]: [usize; 3]| share.clone() * &S::from_i64(epsilon(i, j, k));
    Tensor::from_fn(3, [Up, Down, Down], component).unwrap()
}

/// `[e1, e2] = e3` and cyclic.
fn so3() -> LieAlgebra<Rational> {
    by_table(3, &[(1, 2, 3, 1), (2, 3, 1, 1), (3, 1, 2, 1)])
}

/// `H, E, F`: `[H, E] = 2 E`, `[H, F] = -2 F`, `[E, F] = H`.
fn sl2() -> LieAlgebra<Rational> {
    by_table(3, &[(1, 2, 2, 2), (1, 3, 3, -2), (2, 3, 1, 1)])
}

/// The rotation `e1` of the plane and its translations: `[e1, e2] = e3`, `[e1, e3] = -e2`.
fn se2() -> LieAlgebra<Rational> {
    by_table(3, &[(1, 2, 3, 1), (1, 3, 2, -1)])
}

/// Rotations `e1..e3` and translations `e4..e6` of space.
fn se3() -> LieAlgebra<Rational> {
    let mut table = vec![(1, 2, 3, 1), (2, 3, 1, 1), (3, 1, 2, 1)];
    table.extend([(1, 5, 6, 1), (2, 6, 4, 1), (3, 4, 5, 1)]);
    table.extend([(1, 6, 5, -1), (2, 4, 6, -1), (3, 5, 4, -1)]);
    by_table(6, &table)
}

/// `[e1, e2] = e3`.
fn heisenberg() -> LieAlgebra<Rational> {
    by_table(3, &[(1, 2, 3, 1)])
}

/// `[e1, e2] = e2`: not unimodular.
fn affine() -> LieAlgebra<Rational> {
    by_table(2, &[(1, 2, 2, 1)])
}

fn algebras() -> [(&'static str, LieAlgebra<Rational>); 6] {
    [
        ("so(3)", so3()),
        ("se(3)", se3()),
        ("sl(2)", sl2()),
        ("heisenberg(3)", heisenberg()),
        ("aff(1)", affine()),
        ("se(2)", se2()),
    ]
}

fn symbolic(algebra: &LieAlgebra<Rational>) -> LieAlgebra<Symbolic> {
    algebra.map(|value| Symbolic::constant(value.clone())).unwrap()
}

fn float(algebra: &LieAlgebra<Rational>) -> LieAlgebra<f64> {
    algebra.map(Rational::to_f64).unwrap()
}

/// `-1/4 c^m_kl c^i_mj`, by a loop.
fn minus_quarter_c_c(c: &Tensor<Rational>) -> Tensor<Rational> {
    let n = c.dimension();
    Tensor::from_fn(n, [Up, Down, Down, Down], |[i, j, k, l]| {
        let terms = (0..n).map(|m| c.get(&[m, k, l]) * &c.get(&[i, m, j]));
        let sum = terms.fold(Rational::from(0), |sum, term| sum + &term);
        sum * &crate::common::fraction(-1, 4)
    })
    .unwrap()
}

/// The parameters `x1 .. xn` of a letter.
fn parameters(letter: &str, n: usize) -> Vec<Symbolic> {
    (1..=n).map(|i| Symbolic::parameter(&format!("{letter}{i}"))).collect()
}

/// Whether two tensors are equal, with the first difference in the message.
#[track_caller]
fn assert_tensors<S: Scalar>(found: &Tensor<S>, expected: &Tensor<S>, what: &str) {
    assert_eq!(found.slots(), expected.slots(), "{what}");
    assert_eq!(crate::common::stored(found), crate::common::stored(expected), "{what}");
}
