//! Koszul's formula: a connection from what it does to the metric and from its antisymmetric part.

use crate::frame::formula;
use crate::{Error, Metric};
use affinor_tensors::{Field, Tensor};

/// The only `L^i_jk` with `L_ikj + L_jki = d_kij` and `L^i_jk - L^i_kj = b^i_jk`, its first index
/// lowered by the metric (`d_kij` symmetric in `ij`, `b^i_jk` antisymmetric in `jk`):
///
/// ```text
/// 2 L_ijk = d_jki + d_kij - d_ijk + b_ijk - b_jki + b_kij
/// ```
///
/// Linear in `d` and `b`: affinities for `d = e(g) - Q` and `b = c + tau`, and for each of these
/// alone its share in them.
///
/// # Errors
/// [`Error::Frame`] where 2 has no inverse.
pub(super) fn koszul<S: Field>(
    metric: &Metric<S>,
    d: &Tensor<S>,
    b: &Tensor<S>,
) -> Result<Tensor<S>, Error> {
    let half = S::from_i64(2).recip().ok_or(Error::Frame("2 is not invertible"))?;
    let b = formula("g_im b^m_jk -> _ijk", &[("g", metric.components()), ("b", b)]);
    let lowered =
        formula("d_j_ki + d_k_ij - d_i_jk + b_ijk - b_jki + b_kij -> _ijk", &[("d", d), ("b", &b)]);
    Ok(formula("h^im l_mjk -> ^i_jk", &[("h", metric.inverse()), ("l", &lowered.scale(&half))]))
}
