//! Canonical coordinates of the first and second kind, and the invariant forms, which are computed
//! from functions of `ad`.

use crate::Error;
use crate::algebra::{ad, to_matrix};
use affinor_tensors::linear::Matrix;
use affinor_tensors::{Field, Scalar, Tensor, Up, Variance};
use std::ops::Range;

/// The side of the translations that leave fields invariant.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    /// Left-invariant fields, with the structure constants `c`.
    Left,
    /// Right-invariant fields, with the structure constants `-c`.
    Right,
}

impl Side {
    /// The matrix `-ad` for the left side, and `ad` for the right side.
    pub(super) fn signed<S: Scalar>(self, ad: &Matrix<S>) -> Matrix<S> {
        match self {
            Side::Left => ad.map(|value| -value.clone()),
            Side::Right => ad.clone(),
        }
    }
}

/// The two kinds of canonical coordinates of group elements near the identity.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CanonicalCoordinates {
    /// Coordinates of the first kind: `g = exp(x^1 e_1 + ... + x^n e_n)`.
    First,
    /// Coordinates of the second kind: `g = exp(x^1 e_1) ... exp(x^n e_n)`.
    Second,
}

/// An entire function that is applied to a matrix.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Entire {
    /// The exponential `e^z`.
    Exponential,
    /// The integral of the exponential, `(e^z - 1)/z`.
    Integral,
}

/// The forms `g^-1 dg` (left) or `dg g^-1` (right), slots `[Up, Down]`, by the formulas of
/// [`Chart::invariant_fields`](super::Chart::invariant_fields).
///
/// `value(function, ad, at)` computes the function of `-ad` (left) or `ad` (right). The matrix `ad`
/// depends only on the coordinates in the range `at`.
pub(super) fn invariant_forms<S: Field + Scalar>(
    structure: &Tensor<S>,
    x: &[S],
    kind: CanonicalCoordinates,
    side: Side,
    value: impl Fn(Entire, &Matrix<S>, Range<usize>) -> Result<Matrix<S>, Error>,
) -> Result<Tensor<S>, Error> {
    let n = x.len();
    // calls ad, which also checks the dimension of x
    let ad_x = to_matrix(&ad(structure, x)?);
    let forms = match kind {
        CanonicalCoordinates::First => value(Entire::Integral, &ad_x, 0..n)?,
        CanonicalCoordinates::Second => {
            let vector = |m: usize, value: &S| -> Vec<S> {
                (0..n).map(|i| if i == m { value.clone() } else { S::zero() }).collect()
            };
            let one_parameter = x.iter().enumerate().map(|(m, x)| {
                let ad = to_matrix(&ad(structure, &vector(m, x))?);
                value(Entire::Exponential, &ad, m..m + 1)
            });
            let one_parameter = one_parameter.collect::<Result<Vec<_>, Error>>()?;
            let columns = (0..n).map(|a| {
                let others: Vec<usize> = match side {
                    Side::Left => (a + 1..n).collect(),
                    Side::Right => (0..a).rev().collect(),
                };
                others.into_iter().fold(vector(a, &S::one()), |column, m| {
                    one_parameter[m].apply(&column).expect("a square matrix")
                })
            });
            let columns: Vec<Vec<S>> = columns.collect();
            Matrix::from_dense(&columns).expect("columns of one length").transpose()
        }
    };
    let entries = forms.entries().map(|(i, a, value)| ([i, a], value.clone()));
    Ok(Tensor::from_components(n, &[Up, Variance::Down], entries)?)
}
