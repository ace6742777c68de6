//! Polynomials of fixed length, evaluated fast.

/// `c_0 + c_1 z + c_2 z^2 + ..`, in four chains of every fourth term that a processor runs at once.
#[inline(always)]
pub(super) fn polynomial<const N: usize>(coefficients: &[f64; N], z: f64) -> f64 {
    let square = z * z;
    let fourth = square * square;
    let mut chains = [0.0; 4];
    for k in (0..N).rev() {
        chains[k % 4] = chains[k % 4] * fourth + coefficients[k];
    }
    (chains[0] + z * chains[1]) + square * (chains[2] + z * chains[3])
}

/// The same for eight terms, by Estrin's scheme: the shortest chain of operations.
///
/// G. Estrin, *Western Joint IRE-AIEE-ACM Computer Conference* (1960) 33-40.
#[inline(always)]
pub(super) fn eight_terms(c: &[f64; 8], z: f64) -> f64 {
    let square = z * z;
    let low = (c[0] + z * c[1]) + square * (c[2] + z * c[3]);
    let high = (c[4] + z * c[5]) + square * (c[6] + z * c[7]);
    low + square * square * high
}
