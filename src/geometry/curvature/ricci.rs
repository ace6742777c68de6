//! The parts of the Ricci tensor, the scalar curvature and the Einstein tensor.

use crate::Error;
use crate::algebra::frame::formula;
use crate::geometry::connection::Connection;
use crate::geometry::metric::Metric;
use affinor_tensors::{Field, Tensor, TensorError};

impl<S: Field> Connection<S> {
    /// The symmetric part, slots `_jl`: `(Ric_jl + Ric_lj)/2`. It alone enters the scalar curvature.
    ///
    /// # Errors
    /// Over a field in which 2 has no inverse.
    pub fn ricci_symmetric(&self) -> Result<Tensor<S>, Error> {
        Ok(self.ricci().symmetrise(&[0, 1])?)
    }

    /// The antisymmetric part, slots `_jl`: `(Ric_jl - Ric_lj)/2`. Zero for a Levi-Civita
    /// connection; for a torsion-free one it is `R^i_ijl / 2`, by the first Bianchi identity.
    ///
    /// # Errors
    /// As [`ricci_symmetric`](Self::ricci_symmetric).
    pub fn ricci_antisymmetric(&self) -> Result<Tensor<S>, Error> {
        Ok(self.ricci().antisymmetrise(&[0, 1])?)
    }

    /// The scalar curvature `S = g^jl Ric_jl`.
    ///
    /// # Errors
    /// [`Error::Shape`] when the dimensions differ.
    pub fn scalar_curvature(&self, metric: &Metric<S>) -> Result<S, Error> {
        metric.expect_dimension(self.frame().dimension())?;
        metric.trace(&self.ricci())
    }

    /// The Einstein tensor, slots `_jl`: `G_jl = Ric_jl - 1/2 S g_jl`. That of a Levi-Civita
    /// connection has no divergence.
    ///
    /// # Errors
    /// [`Error::Shape`] when the dimensions differ; [`Error::Tensor`] over a field in which 2 has no
    /// inverse.
    ///
    /// ```
    /// use affinor::algebra::catalogue;
    /// use affinor::{Connection, Metric, Rational};
    /// // [x, y] = y, orthonormal: the hyperbolic plane, Ric = -g and S = -2
    /// let algebra = catalogue::algebra::<Rational>("aff(1)")?;
    /// let metric = Metric::identity(2)?;
    /// let plane = Connection::levi_civita(algebra.left_frame(), &metric)?;
    /// assert!(plane.einstein(&metric)?.is_empty()); // as for every surface
    /// # Ok::<(), affinor::Error>(())
    /// ```
    pub fn einstein(&self, metric: &Metric<S>) -> Result<Tensor<S>, Error> {
        let half = S::from_i64(2).recip().ok_or(TensorError::NotInvertible(2))?;
        self.ricci_less_trace(metric, &half)
    }

    /// `Ric_jl - share S g_jl`.
    pub(super) fn ricci_less_trace(
        &self,
        metric: &Metric<S>,
        share: &S,
    ) -> Result<Tensor<S>, Error> {
        metric.expect_dimension(self.frame().dimension())?;
        let ricci = self.ricci();
        let trace = metric.components().scale(&(metric.trace(&ricci)? * share));
        Ok(formula("r_jl - s_jl -> _jl", &[("r", &ricci), ("s", &trace)]))
    }
}
