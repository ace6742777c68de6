//! The Kretschmann scalar.

use crate::Error;
use crate::algebra::frame::formula;
use crate::geometry::connection::Connection;
use crate::geometry::metric::Metric;
use affinor_tensors::{Field, Tensor};

impl<S: Field> Connection<S> {
    /// The Kretschmann scalar `R_ijkl R^ijkl`.
    ///
    /// # Errors
    /// [`Error::Shape`] when the dimensions differ.
    pub fn kretschmann(&self, metric: &Metric<S>) -> Result<S, Error> {
        metric.expect_dimension(self.frame().dimension())?;
        let lowered = self.curvature().lower(0, metric.components())?;
        let raise = |tensor: Tensor<S>, slot| tensor.raise(slot, metric.inverse());
        let raised = (0..4).try_fold(lowered.clone(), raise)?;
        let square = formula("r_ijkl R^ijkl ->", &[("r", &lowered), ("R", &raised)]);
        Ok(square.to_scalar().expect("a tensor of rank 0"))
    }
}
