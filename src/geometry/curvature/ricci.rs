//! Tensors and scalars derived from curvature and metric: parts of the Ricci tensor, Einstein
//! tensor, scalar, Kretschmann and sectional curvature.

use crate::Error;
use crate::algebra::frame::{expect_slots, formula};
use crate::geometry::connection::Connection;
use crate::geometry::metric::Metric;
use affinor_tensors::stop::stage;
use affinor_tensors::{Field, Scalar, Tensor, TensorError, Up};

impl<S: Field + Scalar> Connection<S> {
    /// The symmetric part of the Ricci tensor, slots `_jl`: `(Ric_jl + Ric_lj)/2`. The scalar
    /// curvature depends only on this part.
    ///
    /// # Errors
    /// [`Error::Tensor`] over a field in which 2 has no inverse.
    pub fn ricci_symmetric(&self) -> Result<Tensor<S>, Error> {
        Ok(self.ricci().symmetrise(&[0, 1])?)
    }

    /// The antisymmetric part of the Ricci tensor, slots `_jl`: `(Ric_jl - Ric_lj)/2`. It vanishes
    /// for a Levi-Civita connection. For a torsion-free connection, the first Bianchi identity
    /// implies that this part is `R^i_ijl / 2`.
    ///
    /// # Errors
    /// The errors of [`ricci_symmetric`](Self::ricci_symmetric).
    pub fn ricci_antisymmetric(&self) -> Result<Tensor<S>, Error> {
        Ok(self.ricci().antisymmetrise(&[0, 1])?)
    }

    /// The scalar curvature `S = g^jl Ric_jl`.
    ///
    /// ```
    /// use affinor::algebra::catalogue;
    /// use affinor::{Connection, Metric, Rational};
    /// let so3 = catalogue::algebra::<Rational>("so(3)")?;
    /// let round = Metric::identity(3)?;
    /// let connection = Connection::levi_civita(so3.left_frame(), &round)?;
    /// assert_eq!(Some(connection.scalar_curvature(&round)?), Rational::new(3, 2));
    /// # Ok::<(), affinor::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::Shape`] when the dimensions differ.
    #[doc(alias("Ricci scalar"))]
    pub fn scalar_curvature(&self, metric: &Metric<S>) -> Result<S, Error> {
        metric.expect_dimension(self.frame().dimension())?;
        metric.trace(&self.ricci())
    }

    /// The Einstein tensor, slots `_jl`: `G_jl = Ric_jl - 1/2 S g_jl`. For a Levi-Civita
    /// connection, the Einstein tensor is divergence-free.
    ///
    /// ```
    /// use affinor::algebra::catalogue;
    /// use affinor::{Connection, Metric, Rational};
    /// let so3 = catalogue::algebra::<Rational>("so(3)")?;
    /// let round = Metric::identity(3)?;
    /// let connection = Connection::levi_civita(so3.left_frame(), &round)?;
    /// // Ric = g/2 and S = 3/2
    /// assert_eq!(Some(connection.einstein(&round)?.get(&[0, 0])), Rational::new(-1, 4));
    /// # Ok::<(), affinor::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::Shape`] when the dimensions differ; [`Error::Tensor`] over a field in which 2 has
    /// no inverse.
    #[doc(alias("Einstein tensor"))]
    pub fn einstein(&self, metric: &Metric<S>) -> Result<Tensor<S>, Error> {
        let half = S::from_i64(2).recip().ok_or(TensorError::NotInvertible(2))?;
        self.ricci_less_trace(metric, &half)
    }

    /// The trace-free part of the Ricci tensor, slots `_jl`: `Ric_jl - S/n g_jl`. If the Ricci
    /// tensor is symmetric, as for a Levi-Civita connection, this part vanishes exactly if the
    /// metric is Einstein.
    ///
    /// # Errors
    /// [`Error::Shape`] when the dimensions differ; [`Error::Tensor`] over a field in which `n` has
    /// no inverse.
    pub fn ricci_trace_free(&self, metric: &Metric<S>) -> Result<Tensor<S>, Error> {
        let n = self.frame().dimension() as i64;
        let share = S::from_i64(n).recip().ok_or(TensorError::NotInvertible(n))?;
        self.ricci_less_trace(metric, &share)
    }

    /// The tensor `Ric_jl - share S g_jl`.
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

    /// The Kretschmann scalar `R_ijkl R^ijkl`.
    ///
    /// ```
    /// use affinor::algebra::catalogue;
    /// use affinor::{Connection, Metric, Rational};
    /// let so3 = catalogue::algebra::<Rational>("so(3)")?;
    /// let round = Metric::identity(3)?;
    /// let connection = Connection::levi_civita(so3.left_frame(), &round)?;
    /// // twelve components of size 1/4
    /// assert_eq!(Some(connection.kretschmann(&round)?), Rational::new(3, 4));
    /// # Ok::<(), affinor::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::Shape`] when the dimensions differ.
    #[doc(alias("Kretschmann invariant"))]
    pub fn kretschmann(&self, metric: &Metric<S>) -> Result<S, Error> {
        let _stage = stage("kretschmann");
        metric.expect_dimension(self.frame().dimension())?;
        let lowered = self.curvature().lower(0, metric.components())?;
        let raise = |tensor: Tensor<S>, slot| tensor.raise(slot, metric.inverse());
        let raised = (0..4).try_fold(lowered.clone(), raise)?;
        let square = formula("r_ijkl R^ijkl ->", &[("r", &lowered), ("R", &raised)]);
        Ok(square.to_scalar().expect("a tensor of rank 0"))
    }

    /// The sectional curvature `K(x,y) = g(R(x,y)y, x) / (g(x,x) g(y,y) - g(x,y)^2)`. Returns
    /// `None` if the plane is degenerate.
    ///
    /// ```
    /// use affinor::algebra::catalogue;
    /// use affinor::{Connection, Metric, Rational};
    /// let so3 = catalogue::algebra::<Rational>("so(3)")?;
    /// let round = Metric::identity(3)?;
    /// let connection = Connection::levi_civita(so3.left_frame(), &round)?;
    /// let [x, y] = [[1, 0, 0], [0, 1, 0]].map(|v| v.map(Rational::from));
    /// assert_eq!(connection.sectional_curvature(&round, &x, &y)?, Rational::new(1, 4));
    /// # Ok::<(), affinor::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::Shape`] unless the vectors and the metric have the dimension of the frame.
    #[doc(alias("Gauss curvature"))]
    pub fn sectional_curvature(
        &self,
        metric: &Metric<S>,
        x: &[S],
        y: &[S],
    ) -> Result<Option<S>, Error> {
        let n = self.frame().dimension();
        let (x, y) = (Tensor::vector(x, Up), Tensor::vector(y, Up));
        metric.expect_dimension(n)?;
        expect_slots("the first vector", &x, n, &[Up])?;
        expect_slots("the second vector", &y, n, &[Up])?;
        let g = metric.components();
        let product = |a: &Tensor<S>, b: &Tensor<S>| {
            let lowered = formula("g_ij a^i -> _j", &[("g", g), ("a", a)]);
            let value = formula("l_j b^j ->", &[("l", &lowered), ("b", b)]);
            value.to_scalar().expect("a tensor of rank 0")
        };
        // subtracts from y its component along x, which changes neither R(x, y) nor the area. This
        // avoids cancellation for nearly parallel vectors. The Euclidean product of components is
        // used, because g(x, x) may be 0.
        let dot = |a: &Tensor<S>| {
            let terms = a.components().map(|(at, value)| x.get(&at) * value);
            terms.fold(S::zero(), |sum, term| sum + &term)
        };
        let across = match dot(&x).recip() {
            Some(recip) => &y - &x.scale(&(dot(&y) * &recip)),
            None => y.clone(),
        };
        let mixed = product(&x, &across);
        let area = product(&x, &x) * &product(&across, &across) - &(mixed.clone() * &mixed);
        // computes R(x,y)y by contracting one argument at a time
        let r = formula("R^i_jkl y^j -> ^i_kl", &[("R", self.curvature()), ("y", &y)]);
        let r = formula("R^i_kl x^k -> ^i_l", &[("R", &r), ("x", &x)]);
        let r = formula("R^i_l y^l -> ^i", &[("R", &r), ("y", &across)]);
        Ok(area.recip().map(|recip| product(&r, &x) * &recip))
    }
}
