//! A connection beside a metric: nonmetricity, and the connections that a metric determines.
//!
//! Connection and metric are given independently (metric-affine geometry). Koszul's formula is the
//! one formula behind this module: [`Connection::levi_civita`] and the connections with given
//! torsion and nonmetricity are cases of it.

mod contorsion;
mod disformation;
mod koszul;
mod levi_civita;

pub use contorsion::contorsion;
pub use disformation::disformation;

use crate::Error;
use crate::geometry::connection::Connection;
use crate::geometry::metric::Metric;
use affinor_tensors::{Field, Tensor};

impl<S: Field> Connection<S> {
    /// The nonmetricity `Q_kij = (nabla_k g)_ij`; zero when the metric is compatible.
    ///
    /// # Errors
    /// [`Error::Shape`] when the dimensions differ.
    pub fn nonmetricity(&self, metric: &Metric<S>) -> Result<Tensor<S>, Error> {
        self.nabla(metric.components())
    }
}
