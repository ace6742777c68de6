//! Least squares with dependent columns.

use nalgebra::{DMatrix, DVector};

/// Eigenvalues of `A^T A` below this share of the largest count as zero.
const KERNEL: f64 = 1e-13;

/// The shortest of the vectors `x` for which `|A x - b|` is least. The columns may depend on each other; the others are to be
/// alike in scale.
pub(crate) fn least_squares(matrix: &DMatrix<f64>, right: &DVector<f64>) -> DVector<f64> {
    // nalgebra's singular values are not reliable where there are zeros among them
    let eigen = (matrix.transpose() * matrix).symmetric_eigen();
    let least = KERNEL * eigen.eigenvalues.amax();
    let inverse = eigen.eigenvalues.map(|value| if value > least { 1.0 / value } else { 0.0 });
    let vectors = &eigen.eigenvectors;
    let solved = |right: &DVector<f64>| {
        let turned = vectors.transpose() * (matrix.transpose() * right);
        vectors * turned.component_mul(&inverse)
    };
    let first = solved(right);
    // what squaring the matrix has lost
    let second = solved(&(right - matrix * &first));
    first + second
}
