//! Logarithms of matrices with an angle near `pi`, where their square roots do not converge.

use super::{CLOSE, MatrixGroup, fit};
use crate::Error;
use crate::group::LieGroup;
use crate::numerics::exponential::exp;
use crate::numerics::logarithm::logarithm;
use nalgebra::linalg::Schur;
use nalgebra::{DMatrix, DVector};
use std::f64::consts::PI;

/// The size of the components of a vector that leads to a neighbour of an element.
const NEIGHBOURHOOD: f64 = 1e-3;

/// The number of lines through an element on which neighbours are sought.
const NEIGHBOURS: usize = 8;

/// The distance of angles from `pi` that floats tell apart.
const BRANCH: f64 = 1e-14;

/// The distance of an angle from `pi` at which a logarithm that is not found is ill-conditioned.
const NEAR_PI: f64 = 1e-6;

/// The largest number of iterations of a Schur decomposition.
const ITERATIONS: usize = 1000;

impl MatrixGroup {
    /// The logarithm of an element with an angle so near `pi` that square roots do not converge: from the logarithms of
    /// elements in its neighbourhood. `None` if none of them leads to it, or the angle is `pi`.
    pub(super) fn log_near_half_turn(&self, g: &DMatrix<f64>) -> Option<DVector<f64>> {
        let n = self.dimension();
        // generic directions, the same in every run
        let entry = |at: usize| NEIGHBOURHOOD * (12.9898 * (at + 1) as f64).sin();
        let directions = (0..NEIGHBOURS).map(|k| DVector::from_fn(n, |i, _| entry(k * n + i)));
        directions.flat_map(|x| [x.clone(), -x]).find_map(|direction| {
            let log = logarithm(&(g * exp(&self.generator(&direction)))).ok()?;
            let guess = self.components(&log);
            let is_close = self.outside(&log) <= CLOSE * (1.0 + log.norm());
            let x = is_close.then(|| fit::nearest(&self.span, g, &guess)).flatten()?;
            let schur = Schur::try_new(self.generator(&x), f64::EPSILON, ITERATIONS)?;
            let angles = schur.complex_eigenvalues().map(|eigenvalue| eigenvalue.im.abs());
            // beyond pi it is the logarithm of another branch
            (angles.max() < PI - BRANCH).then_some(x)
        })
    }
}

/// The error about the logarithm of a matrix with an angle near `pi`; `None` if it has none, or the angle is `pi`.
pub(super) fn near_pi(g: &DMatrix<f64>) -> Option<Error> {
    let eigenvalues = Schur::try_new(g.clone(), f64::EPSILON, ITERATIONS)?.complex_eigenvalues();
    let gaps = eigenvalues.iter().map(|eigenvalue| PI - eigenvalue.im.atan2(eigenvalue.re).abs());
    let gap = gaps.fold(f64::INFINITY, f64::min);
    let reason =
        format!("an angle is too near pi, by {gap:.1e}: the rounding of the entries decides");
    let near = 0.0 < gap && gap < NEAR_PI;
    near.then_some(Error::Invalid { what: "logarithm", reason })
}
