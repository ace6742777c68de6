//! Polynomials of fixed length, evaluated fast.

/// `c_0 + c_1 z + c_2 z^2 + ..`, in blocks of four terms that a processor computes at once.
#[inline(always)]
pub(super) fn polynomial<const N: usize>(coefficients: &[f64; N], z: f64) -> f64 {
    let square = z * z;
    let fourth = square * square;
    let c = |i: usize| if i < N { coefficients[i] } else { 0.0 };
    let block = |k: usize| (c(k) + z * c(k + 1)) + square * (c(k + 2) + z * c(k + 3));
    let last = (N - 1) / 4;
    (0..last).rev().fold(block(4 * last), |sum, k| block(4 * k) + fourth * sum)
}
