//! Logarithms of matrices with an angle near `pi`, for which iterated square roots do not converge.

use super::{CLOSE, MatrixGroup, fit, is_identity};
use crate::Error;
use crate::group::LieGroup;
use crate::numerics::exponential::exp;
use crate::numerics::logarithm::logarithm;
use nalgebra::linalg::{SVD, Schur, SymmetricEigen};
use nalgebra::{DMatrix, DVector};
use std::f64::consts::PI;

/// The size of the components of a vector whose exponential maps an element to a neighbour.
const NEIGHBOURHOOD: f64 = 1e-3;

/// The number of directions in which neighbours of an element are tried.
const NEIGHBOURS: usize = 8;

/// The smallest distance of an angle from `pi` that floats can resolve.
const BRANCH: f64 = 1e-14;

/// If an angle is closer to `pi` than this distance, a missing logarithm is called ill-conditioned.
const NEAR_PI: f64 = 1e-6;

/// Angles that are closer to `pi` than this distance are computed from their sines.
const ROUGHLY_PI: f64 = 1e-3;

/// The direction of an angle is well determined if the ratio of its sine to the rounding error of
/// entries exceeds this value.
const DECIDED: f64 = 8.0;

/// The largest number of iterations of one decomposition.
const ITERATIONS: usize = 1000;

impl MatrixGroup {
    /// The logarithm of an element with an angle so close to `pi` that square roots do not
    /// converge. It is continued from the logarithms of elements in the neighbourhood. Returns
    /// `None` if this fails, or if the angle is `pi`.
    pub(super) fn log_near_half_turn(&self, g: &DMatrix<f64>) -> Option<DVector<f64>> {
        let n = self.dimension();
        // the directions are generic, and the same in every run
        let entry = |at: usize| NEIGHBOURHOOD * (12.9898 * (at + 1) as f64).sin();
        let directions = (0..NEIGHBOURS).map(|k| DVector::from_fn(n, |i, _| entry(k * n + i)));
        directions.flat_map(|x| [x.clone(), -x]).find_map(|direction| {
            let log = logarithm(&(g * exp(&self.generator(&direction)))).ok()?;
            let guess = self.components(&log);
            let is_close = self.outside(&log) <= CLOSE * (1.0 + log.norm());
            let x = is_close.then(|| fit::nearest(&self.span, g, &guess)).flatten()?;
            let schur = Schur::try_new(self.generator(&x), f64::EPSILON, ITERATIONS)?;
            let angles = schur.complex_eigenvalues().map(|eigenvalue| eigenvalue.im.abs());
            // rejects angles beyond pi, because their logarithm belongs to another branch
            (angles.max() < PI - BRANCH).then_some(x)
        })
    }
}

impl MatrixGroup {
    /// The logarithm of an orthogonal element `g = S + K` with angles so close to `pi` that only
    /// the antisymmetric part `K` resolves the distance. On the eigenspace of `S` near `-1`, a
    /// singular value decomposition is `K = U sin(theta) W^T`, and the logarithm is `U theta W^T`.
    /// Returns `None` if rounding errors of the entries determine a direction, or if the angle is
    /// `pi`.
    pub(super) fn log_of_rotation(&self, g: &DMatrix<f64>) -> Option<DVector<f64>> {
        self.form.as_ref().filter(|form| is_identity(form))?;
        let [symmetric, skew] = [(g + g.transpose()) * 0.5, (g - g.transpose()) * 0.5];
        let eigen = SymmetricEigen::try_new(symmetric, f64::EPSILON, ITERATIONS)?;
        let is_near = |at: &usize| eigen.eigenvalues[*at] < -1.0 + 0.5 * ROUGHLY_PI.powi(2);
        let (near, far): (Vec<_>, Vec<_>) = (0..self.size()).partition(is_near);
        let [near, far] = [near, far].map(|chosen| eigen.eigenvectors.select_columns(&chosen));
        let rounding = g.abs() + g.transpose().abs();
        let rounding = DMatrix::from_fn(g.nrows(), g.ncols(), |i, j| match i == j {
            true => 0.0,
            false => f64::EPSILON * rounding[(i, j)],
        });
        let rounding = (near.transpose().abs() * rounding * near.abs()).norm();
        let parts = SVD::try_new(near.tr_mul(&skew) * &near, true, true, f64::EPSILON, ITERATIONS)?;
        let (u, mut w) = (parts.u?, parts.v_t?);
        for (mut row, sine) in w.row_iter_mut().zip(&parts.singular_values) {
            if *sine <= DECIDED * rounding {
                return None;
            }
            row *= PI - sine.asin();
        }
        let turned = &near * (u * w) * near.transpose();
        let rest = match far.ncols() {
            0 => DMatrix::zeros(g.nrows(), g.ncols()),
            _ => &far * logarithm(&(far.tr_mul(g) * &far)).ok()? * far.transpose(),
        };
        self.in_algebra(turned + rest).ok()
    }
}

/// The error if a matrix has no logarithm because an angle is near `pi`. Returns `None` if there is
/// no such angle, or if it is exactly `pi`.
pub(super) fn near_pi(g: &DMatrix<f64>) -> Option<Error> {
    let eigenvalues = Schur::try_new(g.clone(), f64::EPSILON, ITERATIONS)?.complex_eigenvalues();
    let gaps = eigenvalues.iter().map(|eigenvalue| PI - eigenvalue.im.atan2(eigenvalue.re).abs());
    let gap = gaps.fold(f64::INFINITY, f64::min);
    let reason = format!(
        "an angle is too near pi, at the distance {gap:.1e}: rounding errors of the entries decide the result"
    );
    let near = 0.0 < gap && gap < NEAR_PI;
    near.then_some(Error::Invalid { what: "logarithm", reason })
}
