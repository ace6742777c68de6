//! Null spaces of matrices in floats.

use nalgebra::DMatrix;

/// An orthonormal basis of the null space of a matrix, as columns. Rows count as dependent if their
/// independent part is at most `zero` times the longest row.
///
/// The basis consists of the last columns of `Q` in the factorization `A^T P = Q R` with pivoting.
pub(crate) fn null_space(matrix: &DMatrix<f64>, zero: f64) -> DMatrix<f64> {
    let n = matrix.ncols();
    if n == 0 {
        return DMatrix::zeros(0, 0);
    }
    // with at least as many columns as rows, `Q` is square
    let mut columns = DMatrix::zeros(n, matrix.nrows().max(n));
    columns.columns_mut(0, matrix.nrows()).copy_from(&matrix.transpose());
    let (directions, triangle, _) = columns.col_piv_qr().unpack();
    let pivots = (0..n).map(|k| triangle[(k, k)].abs());
    let largest = triangle[(0, 0)].abs();
    let rank = pivots.take_while(|pivot| *pivot > zero * largest).count();
    directions.columns(rank, n - rank).into_owned()
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::RowDVector;

    /// Matrices of all ranks, also with vanishing and repeated rows.
    #[test]
    fn bases_are_orthonormal_and_complete() {
        let row = |k: usize| RowDVector::from_fn(5, |_, j| ((3 * k + 2 * j) as f64).sin());
        for rank in 0..=5 {
            for rows in [rank, rank + 1, 8] {
                // rows beyond the rank are sums of earlier ones, or zero
                let mut matrix = DMatrix::zeros(rows, 5);
                for at in 0..rows {
                    let own = match (at < rank, rank) {
                        (true, _) => RowDVector::from_fn(5, |_, j| {
                            row(at)[j] + if j == at { 3.0 } else { 0.0 }
                        }),
                        (false, 0) => RowDVector::zeros(5),
                        (false, _) => matrix.row(at % rank) + matrix.row(0) * 0.5,
                    };
                    matrix.row_mut(at).copy_from(&own);
                }
                let basis = null_space(&matrix, 1e-8);
                assert_eq!(basis.shape(), (5, 5 - rank), "{rank}, {rows}");
                if rank < 5 {
                    let square = basis.tr_mul(&basis) - DMatrix::identity(5 - rank, 5 - rank);
                    assert!(square.amax() < 1e-14);
                }
                if rank < 5 && rows > 0 {
                    assert!((&matrix * &basis).amax() < 1e-13, "{rank}, {rows}");
                }
            }
        }
    }
}
