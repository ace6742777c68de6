//! Matrices for tests, and their comparison.

use affinor_tensors::linear::Matrix;
use affinor_tensors::{Kind, Notation, Scalar};
use proptest::collection::vec;
use proptest::prelude::*;

/// The matrix with the entries `f(i, j)`.
pub fn dense<S: Scalar>(rows: usize, columns: usize, f: impl Fn(usize, usize) -> S) -> Matrix<S> {
    let row = |i| (0..columns).map(|j| f(i, j)).enumerate().collect::<Vec<_>>();
    Matrix::from_rows(columns, (0..rows).map(row)).unwrap()
}

pub fn from_words<S: Scalar>(rows: &[Vec<i64>]) -> Matrix<S> {
    let row = |row: &Vec<i64>| row.iter().map(|n| S::from_i64(*n)).collect();
    Matrix::from_dense(&rows.iter().map(row).collect::<Vec<_>>()).unwrap()
}

/// Rows of small integers.
pub fn square(n: usize) -> impl Strategy<Value = Vec<Vec<i64>>> {
    vec(vec(-3i64..=3, n), n)
}

/// Checks for equality, in floats up to rounding errors.
pub fn same<S: Notation + Scalar>(a: &S, b: &S) -> bool {
    match (S::KIND, a.to_f64(), b.to_f64()) {
        (Kind::Float, Some(a), Some(b)) => (a - b).abs() <= 1e-9 * (1.0 + a.abs() + b.abs()),
        _ => a == b,
    }
}
