//! The linear equations for accelerations and Lagrange multipliers.

use nalgebra::{DMatrix, DVector, Dyn, LU};

/// The matrix `[[J, B^T], [C, 0]]`.
pub(in crate::mechanics) fn saddle(
    mass: &DMatrix<f64>,
    b: &DMatrix<f64>,
    c: &DMatrix<f64>,
) -> DMatrix<f64> {
    let (n, m) = (mass.nrows(), b.nrows());
    let mut matrix = DMatrix::zeros(n + m, n + m);
    matrix.view_mut((0, 0), (n, n)).copy_from(mass);
    matrix.view_mut((0, n), (n, m)).copy_from(&b.transpose());
    matrix.view_mut((n, 0), (m, n)).copy_from(c);
    matrix
}

/// The concatenation of two vectors.
pub(in crate::mechanics) fn stacked(first: &DVector<f64>, second: &DVector<f64>) -> DVector<f64> {
    DVector::from_iterator(first.len() + second.len(), first.iter().chain(second).copied())
}

/// The number of scalings of rows and columns.
const SCALINGS: usize = 4;
/// If the ratio of the smallest to the largest pivot exceeds this value, the matrix needs no
/// scaling.
const EVEN: f64 = 1e-6;

/// The solution of linear equations. Returns `None` if the matrix is singular, or if the solution
/// is not finite.
pub(in crate::mechanics) fn solve(
    matrix: DMatrix<f64>,
    right: &DVector<f64>,
) -> Option<DVector<f64>> {
    solved_from(EVEN, matrix, right)
}

/// The solution as in [`solve`]. The matrix is scaled if the ratio of the smallest to the largest
/// pivot is at most `even`.
fn solved_from(even: f64, matrix: DMatrix<f64>, right: &DVector<f64>) -> Option<DVector<f64>> {
    let ratio = |lu: &LU<f64, Dyn, Dyn>| {
        let pivots = lu.u().diagonal().abs();
        pivots.min() / pivots.max()
    };
    let plain = matrix.clone().lu();
    let solution = if ratio(&plain) > even {
        plain.solve(right)?
    } else {
        let (matrix, rows, columns) = scaled(matrix);
        let lu = matrix.lu();
        let ratio = ratio(&lu);
        if ratio.is_nan() || ratio <= 1e-14 {
            return None;
        }
        lu.solve(&right.component_mul(&rows))?.component_mul(&columns)
    };
    Some(solution).filter(|x| x.iter().all(|x| x.is_finite()))
}

/// Scales a matrix so that its pivots do not depend on units. Returns the scaled matrix, and the
/// factors of its rows and columns. The factors are powers of two, which cause no rounding errors.
fn scaled(mut matrix: DMatrix<f64>) -> (DMatrix<f64>, DVector<f64>, DVector<f64>) {
    let n = matrix.nrows();
    let scale =
        |largest: f64| if largest > 0.0 { (-0.5 * largest.log2()).round().exp2() } else { 1.0 };
    let [mut rows, mut columns] = [DVector::repeat(n, 1.0), DVector::repeat(n, 1.0)];
    for _ in 0..SCALINGS {
        let by_row = DVector::from_fn(n, |i, _| scale(matrix.row(i).amax()));
        let by_column = DVector::from_fn(n, |k, _| scale(matrix.column(k).amax()));
        matrix = DMatrix::from_fn(n, n, |i, k| matrix[(i, k)] * by_row[i] * by_column[k]);
        rows.component_mul_assign(&by_row);
        columns.component_mul_assign(&by_column);
    }
    (matrix, rows, columns)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Both ways to solve the equations, with and without scaling, agree for ratios of the pivots
    /// around the threshold. The example is a body of mass `m` on a line.
    #[test]
    fn equations_with_and_without_scaling() {
        let gradient = DMatrix::from_row_slice(1, 2, &[0.6, 0.8]);
        for mass in [1e-12, 1e-3, 1.0, 1e3, 1.1e3, 1e8, 1e20] {
            let inertia = DMatrix::identity(2, 2) * mass;
            let right = DVector::from_column_slice(&[mass, 2.0 * mass, 0.0]);
            // the force along the line accelerates the body, and the force across it is the
            // multiplier
            let expected = [-0.32, 0.24, 2.2 * mass];
            for even in [0.0, EVEN, 2.0] {
                let matrix = saddle(&inertia, &gradient, &gradient);
                let Some(found) = solved_from(even, matrix, &right) else {
                    panic!("{mass}, {even}")
                };
                for (found, expected) in found.iter().zip(expected) {
                    assert!((found / expected - 1.0).abs() < 1e-12, "{mass}, {even}: {found}");
                }
            }
        }
        let twice = DMatrix::from_row_slice(2, 2, &[0.6, 0.8, 1.2, 1.6]);
        let singular = saddle(&DMatrix::identity(2, 2), &twice, &twice);
        assert!(solve(singular, &DVector::repeat(4, 1.0)).is_none());
    }
}
