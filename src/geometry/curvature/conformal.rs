//! The tensors of conformal geometry: Schouten, Weyl and Cotton.
//!
//! These tensors are meant for a Levi-Civita connection. The metric is conformally flat exactly
//! where the Weyl tensor (in dimension 4 and more) or the Cotton tensor (in dimension 3) vanishes
//! (L. P. Eisenhart, *Riemannian Geometry* (1926), section 28). The same formulas apply to any
//! connection, but the Weyl tensor is trace-free only for a Levi-Civita connection.

use crate::Error;
use crate::algebra::frame::formula;
use crate::geometry::connection::Connection;
use crate::geometry::metric::Metric;
use affinor_tensors::stop::stage;
use affinor_tensors::{Field, Scalar, Tensor, TensorError};

impl<S: Field + Scalar> Connection<S> {
    /// The Schouten tensor, slots `_jl`, in dimension 3 and more:
    /// `P_jl = (Ric_jl - S/(2(n-1)) g_jl) / (n-2)`.
    ///
    /// # Errors
    /// [`Error::Shape`] when the dimensions differ, or in dimension less than 3; [`Error::Tensor`]
    /// over a field in which `2(n-1)` or `n-2` has no inverse.
    pub fn schouten(&self, metric: &Metric<S>) -> Result<Tensor<S>, Error> {
        let n = self.frame().dimension();
        if n < 3 {
            return Err(Error::Shape {
                what: "a frame with a Schouten tensor",
                expected: "dimension 3 or more".into(),
                found: format!("dimension {n}"),
            });
        }
        let share = |of: usize| {
            let of = of as i64;
            S::from_i64(of).recip().ok_or(TensorError::NotInvertible(of))
        };
        let difference = self.ricci_less_trace(metric, &share(2 * (n - 1))?)?;
        Ok(difference.scale(&share(n - 2)?))
    }

    /// The Weyl tensor, slots `^i_jkl`, in dimension 3 and more:
    /// `W^i_jkl = R^i_jkl - delta^i_k P_jl + delta^i_l P_jk - g_jl P^i_k + g_jk P^i_l`. In
    /// dimension 3, the Weyl tensor is zero.
    ///
    /// ```
    /// use affinor::algebra::catalogue;
    /// use affinor::{Connection, Metric, Rational};
    /// let so3 = catalogue::algebra::<Rational>("so(3)")?;
    /// let algebra = so3.direct_sum(&catalogue::algebra("R^1")?)?;
    /// let metric = Metric::identity(4)?;
    /// let product = Connection::levi_civita(algebra.left_frame(), &metric)?;
    /// // the product of a sphere and a line is conformally flat
    /// assert!(product.weyl(&metric)?.is_empty());
    /// # Ok::<(), affinor::Error>(())
    /// ```
    ///
    /// # Errors
    /// The errors of [`schouten`](Self::schouten).
    #[doc(alias("conformal curvature", "Weyl tensor"))]
    pub fn weyl(&self, metric: &Metric<S>) -> Result<Tensor<S>, Error> {
        let _stage = stage("weyl");
        let schouten = self.schouten(metric)?;
        let raised = schouten.raise(0, metric.inverse())?;
        Ok(formula(
            "R^i_jkl - d^i_k P_jl + d^i_l P_jk - g_jl Q^i_k + g_jk Q^i_l -> ^i_j[kl]",
            &[
                ("R", self.curvature()),
                ("d", &Tensor::identity(self.frame().dimension())),
                ("P", &schouten),
                ("g", metric.components()),
                ("Q", &raised),
            ],
        ))
    }

    /// The Cotton tensor, slots `_jkl`, in dimension 3 and more:
    /// `C_jkl = (nabla_k P)_jl - (nabla_l P)_jk`. For a Levi-Civita connection,
    /// `nabla_i W^i_jkl = (n-3) C_jkl`.
    ///
    /// # Errors
    /// The errors of [`schouten`](Self::schouten).
    pub fn cotton(&self, metric: &Metric<S>) -> Result<Tensor<S>, Error> {
        let _stage = stage("cotton");
        let nabla = self.nabla(&self.schouten(metric)?)?;
        Ok(formula("D_kjl - D_ljk -> _j[kl]", &[("D", &nabla)]))
    }
}
