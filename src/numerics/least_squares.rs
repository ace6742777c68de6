//! Least squares with linearly dependent columns.

use nalgebra::{DMatrix, DVector};

/// Eigenvalues of `A^T A` count as zero if their ratio to the largest eigenvalue is at most this
/// value.
const KERNEL: f64 = 1e-13;

/// The shortest of the vectors `x` that minimize `|A x - b|`. The columns may be linearly
/// dependent, but should have similar scales.
pub(crate) fn least_squares(matrix: &DMatrix<f64>, right: &DVector<f64>) -> DVector<f64> {
    least_squares_with_ratio(matrix, right).0
}

/// The vector `x` of [`least_squares`], and the ratio of the smallest to the largest singular value
/// of the matrix. Ratios below `1e-8` are rounding errors.
pub(crate) fn least_squares_with_ratio(
    matrix: &DMatrix<f64>,
    right: &DVector<f64>,
) -> (DVector<f64>, f64) {
    // uses eigenvalues, because the singular values of nalgebra are unreliable if some of them are
    // zero
    let eigen = (matrix.transpose() * matrix).symmetric_eigen();
    let (largest, smallest) = (eigen.eigenvalues.amax(), eigen.eigenvalues.min().max(0.0));
    let least = KERNEL * largest;
    let inverse = eigen.eigenvalues.map(|value| if value > least { 1.0 / value } else { 0.0 });
    let vectors = &eigen.eigenvectors;
    let solved = |right: &DVector<f64>| {
        let turned = vectors.transpose() * (matrix.transpose() * right);
        vectors * turned.component_mul(&inverse)
    };
    let first = solved(right);
    // makes one step of iterative refinement, because the normal equations square the condition
    // number
    let second = solved(&(right - matrix * &first));
    let ratio = if largest > 0.0 { (smallest / largest).sqrt() } else { 0.0 };
    (first + second, ratio)
}
