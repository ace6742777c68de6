//! The exponential of matrices, and `(exp(M) - 1)/M`.

use affinor_tensors::linear::balancing;
use affinor_tensors::stop::{checkpoint, detached};
use nalgebra::DMatrix;

/// Below this value of the size of entries times the number of rows, nalgebra computes the
/// exponential. Its algorithm forms sixth powers, which overflow for large entries.
const LARGE: f64 = 1e8;

/// The exponential of a square matrix, for entries of any size. Results beyond the range of floats
/// are infinite or NaN. If a matrix rotates by more than `1e16` radians, the result is meaningless.
///
/// ```
/// use affinor::numerics::exponential::exp;
/// use nalgebra::DMatrix;
/// let m = DMatrix::from_row_slice(2, 2, &[0.0, 1e300, 0.0, 0.0]);
/// assert_eq!(exp(&m)[(0, 1)], 1e300);
/// ```
pub fn exp(m: &DMatrix<f64>) -> DMatrix<f64> {
    exp_halved_from(m, LARGE)
}

/// The exponential as in [`exp`]. Matrices whose size is at least `large` are halved, and the
/// results are squared.
fn exp_halved_from(m: &DMatrix<f64>, large: f64) -> DMatrix<f64> {
    let size = m.amax() * m.nrows() as f64;
    if m.is_empty() {
        m.clone()
    } else if !m.iter().all(|v| v.is_finite()) {
        DMatrix::from_element(m.nrows(), m.ncols(), f64::NAN)
    } else if size < large {
        plain(m)
    } else {
        let (m, exponents) = balanced(m);
        let size = m.amax() * m.nrows() as f64;
        let halvings = size.log2().clamp(0.0, 1100.0).ceil() as i32;
        let halvings = if size < large { 0 } else { halvings };
        let half = scaled(&m, |_, _| -halvings);
        let square = |e: DMatrix<f64>, _| {
            checkpoint();
            &e * &e
        };
        let exp = (0..halvings).fold(plain(&half), square);
        unbalanced(&exp, &exponents)
    }
}

/// The exponential computed by nalgebra.
fn plain(m: &DMatrix<f64>) -> DMatrix<f64> {
    if m.nrows() < LONG {
        return m.exp();
    }
    let m = m.clone();
    detached(move || m.exp())
}

/// The exponential of matrices with at least this number of rows takes longer than a few
/// milliseconds.
const LONG: usize = 100;

/// Multiplies the entries by powers of two. Each power is applied as two factors that are in the
/// range of floats.
fn scaled(m: &DMatrix<f64>, exponent: impl Fn(usize, usize) -> i32) -> DMatrix<f64> {
    DMatrix::from_fn(m.nrows(), m.ncols(), |i, k| {
        let (all, part) = (exponent(i, k), exponent(i, k) / 4);
        let [part, rest] = [part, all - 3 * part].map(|k| 2.0_f64.powi(k));
        m[(i, k)] * part * part * part * rest
    })
}

/// Computes a similar matrix `m_ik 2^(e_k - e_i)` whose entries off the diagonal are small. Returns
/// the matrix and the exponents `e`. Functions of such matrices are accurate even if a rotation is
/// combined with a long translation.
pub(crate) fn balanced(m: &DMatrix<f64>) -> (DMatrix<f64>, Vec<i32>) {
    let exponents = balance(m);
    (balanced_by(m, &exponents), exponents)
}

/// The exponents `e` that [`balanced`] uses.
pub(crate) fn balance(m: &DMatrix<f64>) -> Vec<i32> {
    let n = m.nrows();
    let places = (0..n).flat_map(|i| (0..n).map(move |k| (i, k)));
    balancing(n, places.map(|(i, k)| (i, k, m[(i, k)])))
}

/// The similar matrix with the entries `m_ik 2^(e_k - e_i)`.
pub(crate) fn balanced_by(m: &DMatrix<f64>, exponents: &[i32]) -> DMatrix<f64> {
    scaled(m, |i, k| exponents[k] - exponents[i])
}

/// The inverse of [`balanced`].
pub(crate) fn unbalanced(m: &DMatrix<f64>, exponents: &[i32]) -> DMatrix<f64> {
    scaled(m, |i, k| exponents[i] - exponents[k])
}

/// The integral `sum M^k/(k+1)! = int_0^1 exp(s M) ds`. It is the upper right block of the
/// exponential of `[[M, 1], [0, 0]]`.
///
/// C. F. Van Loan, *IEEE Transactions on Automatic Control* 23 (1978) 395-404.
///
/// ```
/// use affinor::numerics::exponential::phi1;
/// use nalgebra::DMatrix;
/// let m = DMatrix::from_row_slice(2, 2, &[0.0, 2.0, 0.0, 0.0]);
/// assert_eq!(phi1(&m), DMatrix::from_row_slice(2, 2, &[1.0, 1.0, 0.0, 1.0]));
/// ```
pub fn phi1(m: &DMatrix<f64>) -> DMatrix<f64> {
    let n = m.nrows();
    let mut block = DMatrix::zeros(2 * n, 2 * n);
    block.view_mut((0, 0), (n, n)).copy_from(m);
    block.view_mut((0, n), (n, n)).fill_with_identity();
    exp(&block).view((0, n), (n, n)).into_owned()
}

/// The matrix `exp(m) - 1`. It is accurate also for small `m`.
pub(crate) fn exp_less_identity(m: &DMatrix<f64>) -> DMatrix<f64> {
    m * phi1(m)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Both algorithms agree with the closed forms of rotations and of screws `[[0, -w, 1], [w, 0,
    /// 0], [0, 0, 0]]`.
    #[test]
    fn exponentials_with_and_without_halvings() {
        for turn in [1e-3_f64, 0.7, 3.0, 40.0, 1e3, 1e5, 3e7, 1e8] {
            let m =
                DMatrix::from_row_slice(3, 3, &[0.0, -turn, 1.0, turn, 0.0, 0.0, 0.0, 0.0, 0.0]);
            let ((sin, cos), half) = (turn.sin_cos(), (0.5 * turn).sin());
            let screw = [cos, -sin, sin / turn, sin, cos, 2.0 * half * half / turn, 0.0, 0.0, 1.0];
            let expected = DMatrix::from_row_slice(3, 3, &screw);
            for large in [0.0, LARGE] {
                let off = (exp_halved_from(&m, large) - &expected).amax();
                // the tolerance is large, because squarings double the relative error of the angle
                assert!(
                    off <= 16.0 * f64::EPSILON * (1.0 + turn),
                    "{turn}, {large}: off by {off:e}"
                );
            }
        }
    }

    /// A translation of any length is accurate and does not change the linear part. The matrices
    /// are `[[a, b], [0, 0]]`, around the size from which matrices are balanced.
    #[test]
    fn exponentials_with_long_translations() {
        let a = 0.5_f64;
        for b in [1.0, 1e4, 0.49 * LARGE, 0.51 * LARGE, 1e11, 1e18, 1e150, 1e300] {
            for large in [0.0, LARGE] {
                let e = exp_halved_from(&DMatrix::from_row_slice(2, 2, &[a, b, 0.0, 0.0]), large);
                assert!((e[(0, 0)] - a.exp()).abs() <= 8.0 * f64::EPSILON, "{b:e}: {e}");
                let translation = b * (a.exp_m1() / a);
                let off = (e[(0, 1)] / translation - 1.0).abs();
                assert!(off <= 8.0 * f64::EPSILON, "{b:e}: {off:e}");
                assert_eq!([e[(1, 0)], e[(1, 1)]], [0.0, 1.0]);
            }
        }
    }
}
