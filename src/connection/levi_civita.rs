//! The Levi-Civita connection of a metric, by Koszul's formula.

use super::Connection;
use crate::frame::{Frame, expect_slots, formula};
use crate::{Error, Metric};
use affinor_tensors::{Down, Field};

impl<S: Field> Connection<S> {
    /// The torsion-free connection compatible with `metric`, in any frame:
    ///
    /// ```text
    /// 2 g(nabla_{e_j} e_k, e_i) = e_j(g_ki) + e_k(g_ij) - e_i(g_jk)
    ///                           + g([e_j,e_k],e_i) - g([e_k,e_i],e_j) + g([e_i,e_j],e_k)
    /// ```
    ///
    /// # Errors
    /// [`Error::Shape`] when the dimensions differ.
    pub fn levi_civita(frame: &Frame<S>, metric: &Metric<S>) -> Result<Self, Error> {
        let g = metric.components();
        expect_slots("the metric", g, frame.dimension(), &[Down, Down])?;
        let half = S::from_i64(2).recip().ok_or(Error::Frame("2 is not invertible"))?;
        let derivative = frame.derivative(g)?;
        // b_ijk = g([e_j, e_k], e_i)
        let b = formula("g_im c^m_jk -> _ijk", &[("g", g), ("c", frame.structure())]);
        let lowered = formula(
            "d_j_ki + d_k_ij - d_i_jk + b_ijk - b_jki + b_kij -> _ijk",
            &[("d", &derivative), ("b", &b)],
        );
        let gamma = formula(
            "h^im l_mjk -> ^i_jk",
            &[("h", metric.inverse()), ("l", &lowered.scale(&half))],
        );
        Connection::new(frame.clone(), gamma)
    }
}
