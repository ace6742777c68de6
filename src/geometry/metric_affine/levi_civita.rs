//! The Levi-Civita connection of a metric, by Koszul's formula.

use super::koszul::koszul;
use crate::Error;
use crate::algebra::frame::{Frame, expect_slots};
use crate::geometry::connection::Connection;
use crate::geometry::metric::Metric;
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
        let gamma = koszul(metric, &frame.derivative(g)?, frame.structure())?;
        Connection::new(frame.clone(), gamma)
    }
}
