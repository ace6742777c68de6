//! Balancing of square matrices.

/// The largest number of sweeps over all rows.
const SWEEPS: usize = 100;

/// Computes exponents `e` that balance a matrix. Consider the entries off the diagonal in the
/// similar matrix `m_ik 2^(e_k - e_i)`. For each index, their largest sizes in the row and in the
/// column are about equal; sizes below 1 count as 1. The similar matrix has the same eigenvalues.
/// Scaling by powers of two causes no rounding errors.
///
/// The parameter `entries` contains the entries `(i, k, m_ik)` of an `n x n` matrix. E. E. Osborne,
/// *J. ACM* 7 (1960) 338-345.
///
/// ```
/// use affinor_tensors::linear::balancing;
/// let e = balancing(2, [(0, 0, 0.5), (0, 1, 1e18)]);
/// assert!(1e18 * f64::powi(2.0, e[1] - e[0]) < 16.0);
/// assert_eq!(balancing(2, [(0, 1, 1e9), (1, 0, 1e9)]), [0, 0]);
/// ```
pub fn balancing(n: usize, entries: impl IntoIterator<Item = (usize, usize, f64)>) -> Vec<i32> {
    let off_diagonal = |(i, k, value): &(usize, usize, f64)| i != k && *value != 0.0;
    let sizes: Vec<(usize, usize, i32)> = entries
        .into_iter()
        .filter(off_diagonal)
        .map(|(i, k, value)| (i, k, value.abs().log2().ceil() as i32))
        .collect();
    let mut exponents = vec![0_i32; n];
    for _ in 0..SWEEPS {
        let before = exponents.clone();
        for index in 0..n {
            let (mut row, mut column) = (0, 0);
            for &(i, k, size) in &sizes {
                let size = size + exponents[k] - exponents[i];
                if i == index {
                    row = row.max(size);
                } else if k == index {
                    column = column.max(size);
                }
            }
            exponents[index] += (row - column) / 2;
        }
        if exponents == before {
            break;
        }
    }
    exponents
}
