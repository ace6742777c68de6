//! Dense matrices of floats: tensors of rank 2 to nalgebra and back, and least squares.
//!
//! Tensors are sparse and hold what the geometry computes; exponentials, eigenvalues and
//! factorisations of small matrices are nalgebra's.

use crate::Error;
use affinor_tensors::{Tensor, Variance};
use nalgebra::{DMatrix, DVector};

/// A tensor of rank 2 as a matrix: the first index is the row, as in `(ad_n)^i_k`.
///
/// ```
/// use affinor::dense::to_dmatrix;
/// use affinor::{Bracket, LieAlgebra};
/// // the Heisenberg algebra: [x, y] = z
/// let bracket = Bracket::from_fn(&["x", "y", "z"], |j, k| match (j, k) {
///     (0, 1) => vec![(2, 1.0)],
///     _ => vec![],
/// })?;
/// let ad_x = LieAlgebra::try_from(bracket)?.ad(&[1.0, 0.0, 0.0])?;
/// // Ad of the group element exp(x), as ad_x is nilpotent: 1 + ad_x
/// let adjoint = to_dmatrix(&ad_x)?.exp();
/// assert_eq!(adjoint[(2, 1)], 1.0);
/// # Ok::<(), affinor::Error>(())
/// ```
///
/// # Errors
/// [`Error::Shape`] unless the tensor has rank 2.
pub fn to_dmatrix(tensor: &Tensor<f64>) -> Result<DMatrix<f64>, Error> {
    if tensor.rank() != 2 {
        let found = format!("rank {}", tensor.rank());
        return Err(Error::Shape { what: "a matrix", expected: "rank 2".into(), found });
    }
    let mut matrix = DMatrix::zeros(tensor.dimension(), tensor.dimension());
    for (at, value) in tensor.components() {
        matrix[(at[0], at[1])] = *value;
    }
    Ok(matrix)
}

/// A square matrix as a tensor with these slots: the row is the first index.
///
/// # Errors
/// [`Error::Shape`] unless the matrix is square.
pub fn from_dmatrix(matrix: &DMatrix<f64>, slots: [Variance; 2]) -> Result<Tensor<f64>, Error> {
    if !matrix.is_square() {
        let found = format!("{} rows and {} columns", matrix.nrows(), matrix.ncols());
        return Err(Error::Shape {
            what: "a matrix",
            expected: "as many rows as columns".into(),
            found,
        });
    }
    Ok(Tensor::from_fn(matrix.nrows(), slots, |[i, j]| matrix[(i, j)])?)
}

/// What is this small beside the largest eigenvalue of `A^T A` is zero.
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
