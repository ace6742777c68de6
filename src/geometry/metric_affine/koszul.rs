//! Koszul's formula: affinities from the derivative of the metric and their antisymmetric part.

use crate::Error;
use crate::algebra::frame::formula;
use crate::geometry::metric::Metric;
use affinor_tensors::{Field, Tensor, TensorError};

/// The only `L^i_jk` with `L_ikj + L_jki = d_kij` and `L^i_jk - L^i_kj = b^i_jk`, its first index
/// lowered by the metric (`d_kij` symmetric in `ij`, `b^i_jk` antisymmetric in `jk`):
///
/// ```text
/// 2 L_ijk = d_jki + d_kij - d_ijk + b_ijk - b_jki + b_kij
/// ```
///
/// It is linear in `d` and `b`. `d = e(g) - Q` and `b = c + tau` give the affinities; each summand
/// alone gives its contribution.
///
/// # Errors
/// [`Error::Tensor`] where 2 has no inverse.
pub(super) fn koszul<S: Field>(
    metric: &Metric<S>,
    d: &Tensor<S>,
    b: &Tensor<S>,
) -> Result<Tensor<S>, Error> {
    let half = S::from_i64(2).recip().ok_or(TensorError::NotInvertible(2))?;
    let lowered = formula("g_im b^m_jk -> _ijk", &[("g", metric.components()), ("b", b)]);
    // All terms but b_ijk are symmetric in j and k, and b_ijk raised is b itself. So in floats, too,
    // the antisymmetric part of the result is b/2 to the last bit.
    let symmetric =
        formula("d_j_ki + d_k_ij - d_i_jk + b_jik + b_kij -> _ijk", &[("d", d), ("b", &lowered)]);
    let raised = formula("h^im s_mjk -> ^i_jk", &[("h", metric.inverse()), ("s", &symmetric)]);
    let twice = formula("b^i_jk + r^i_jk -> ^i_jk", &[("b", b), ("r", &raised)]);
    Ok(twice.scale(&half))
}
