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
        // all but g([e_j, e_k], e_i), which raised is c itself, is symmetric in j and k: so in
        // floats, too, the torsion is nothing but rounding of c
        let symmetric = formula(
            "d_j_ki + d_k_ij - d_i_jk + b_jik + b_kij -> _ijk",
            &[("d", &derivative), ("b", &b)],
        );
        let raised = formula("h^im s_mjk -> ^i_jk", &[("h", metric.inverse()), ("s", &symmetric)]);
        let operands = [("c", frame.structure()), ("r", &raised)];
        let twice = formula("c^i_jk + r^i_jk -> ^i_jk", &operands);
        Connection::new(frame.clone(), twice.scale(&half))
    }
}
