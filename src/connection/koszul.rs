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
    let lowered = formula("g_im b^m_jk -> _ijk", &[("g", metric.components()), ("b", b)]);
    // all but b_ijk, which raised is b itself, is symmetric in j and k: so in floats, too, the
    // antisymmetric part is nothing but rounding of b
    let symmetric =
        formula("d_j_ki + d_k_ij - d_i_jk + b_jik + b_kij -> _ijk", &[("d", d), ("b", &lowered)]);
    let raised = formula("h^im s_mjk -> ^i_jk", &[("h", metric.inverse()), ("s", &symmetric)]);
    let twice = formula("b^i_jk + r^i_jk -> ^i_jk", &[("b", b), ("r", &raised)]);
    Ok(twice.scale(&half))
}
