//! Connections on a space with a metric: nonmetricity, and the connections that a metric
//! determines.
//!
//! Connection and metric are independent (metric-affine geometry). All functions of this module use
//! Koszul's formula: [`Connection::levi_civita`] and the connections with given torsion and
//! nonmetricity are special cases.

use crate::algebra::frame::{Frame, expect_slots, expect_symmetry, formula};
use crate::geometry::connection::Connection;
use crate::geometry::metric::Metric;
use crate::{Error, Law};
use affinor_tensors::stop::stage;
use affinor_tensors::{Down, Field, Scalar, Tensor, TensorError, Up, contract};

impl<S: Field + Scalar> Connection<S> {
    /// The nonmetricity `Q_kij = (nabla_k g)_ij`. It is zero if the metric is parallel.
    ///
    /// ```
    /// use affinor::algebra::catalogue;
    /// use affinor::{CanonicalConnection, Connection, Metric, Rational};
    /// let so3 = catalogue::algebra::<Rational>("so(3)")?;
    /// let zero = Connection::canonical(&so3, CanonicalConnection::Zero);
    /// let round = Metric::identity(3)?;
    /// assert!(zero.nonmetricity(&round)?.is_empty());
    /// # Ok::<(), affinor::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::Shape`] when the dimensions differ.
    #[doc(alias("nabla g"))]
    pub fn nonmetricity(&self, metric: &Metric<S>) -> Result<Tensor<S>, Error> {
        self.nabla(metric.components())
    }

    /// The torsion-free connection that is compatible with `metric`, in any frame:
    ///
    /// ```text
    /// 2 g(nabla_{e_j} e_k, e_i) = e_j(g_ki) + e_k(g_ij) - e_i(g_jk)
    ///                           + g([e_j,e_k],e_i) - g([e_k,e_i],e_j) + g([e_i,e_j],e_k)
    /// ```
    ///
    /// # Errors
    /// [`Error::Shape`] when the dimensions differ; [`Law::IsotropyInvariance`] on a homogeneous
    /// space, unless the metric is invariant under its isotropy: `h^m_ikl g_mj + h^m_jkl g_im = 0`.
    #[doc(alias("Christoffel symbols", "Koszul formula"))]
    pub fn levi_civita(frame: &Frame<S>, metric: &Metric<S>) -> Result<Self, Error> {
        let _stage = stage("levi-civita");
        let g = metric.components();
        expect_slots("the metric", g, frame.dimension(), &[Down, Down])?;
        if !frame.is_invariant() {
            let operands = [("h", &frame.isotropy()?), ("g", g)];
            let moved = formula("h^m_ikl g_mj + h^m_jkl g_im -> _ijkl", &operands);
            if let Some((at, residual)) = moved.components().next() {
                let [k, l] = [at[2], at[3]].map(|index| frame.labels()[index].as_str());
                let component = crate::error::indices(at[..2].iter().map(|index| index + 1));
                let at = ["the metric".into(), format!("[{k}, {l}]_h"), component];
                return Err(Law::IsotropyInvariance.broken(at, residual.to_string()));
            }
        }
        let gamma = koszul(metric, &frame.derivative(g)?, frame.structure_functions())?;
        Connection::new(frame.clone(), gamma)
    }

    /// The unique connection with this torsion, slots `^i_jk`, that is compatible with `metric`, in
    /// any frame. It is the sum of the Levi-Civita connection and the [`contorsion`].
    ///
    /// ```
    /// use affinor::algebra::catalogue;
    /// use affinor::{Connection, Metric, Rational};
    /// let so3 = catalogue::algebra::<Rational>("so(3)")?;
    /// let round = Metric::identity(3)?;
    /// // the metric connection with the torsion of `plus` is `plus`
    /// let plus = Connection::with_torsion(so3.left_frame(), &round, so3.structure_constants())?;
    /// assert_eq!(plus.affinities(), so3.structure_constants());
    /// # Ok::<(), affinor::Error>(())
    /// ```
    ///
    /// # Errors
    /// The errors of [`contorsion`].
    #[doc(alias("metric connection with torsion"))]
    pub fn with_torsion(
        frame: &Frame<S>,
        metric: &Metric<S>,
        torsion: &Tensor<S>,
    ) -> Result<Self, Error> {
        let nonmetricity = Tensor::zero(frame.dimension(), &[Down; 3])?;
        Self::with_torsion_and_nonmetricity(frame, metric, torsion, &nonmetricity)
    }

    /// The [`contorsion`] of the torsion of this connection. If the connection is compatible with
    /// the metric, the contorsion is the difference `K = Lambda - LeviCivita`. Otherwise, the
    /// difference also contains the [`disformation`](Self::disformation).
    ///
    /// # Errors
    /// [`Error::Shape`] when the dimensions differ.
    #[doc(alias("contortion"))]
    pub fn contorsion(&self, metric: &Metric<S>) -> Result<Tensor<S>, Error> {
        contorsion(metric, &self.torsion())
    }

    /// The unique connection with this torsion `tau^i_jk` and nonmetricity `Q_kij`, in any frame:
    ///
    /// ```text
    /// Lambda = LeviCivita + K(tau) + L(Q)
    /// ```
    ///
    /// with the [`contorsion`] and the [`disformation`]. Koszul's formula is linear in three
    /// inputs, and each summand is its value for one of them.
    ///
    /// # Errors
    /// [`Error::Shape`]; [`Error::Symmetry`] unless `tau^i_jk = -tau^i_kj` and `Q_kij = Q_kji`.
    pub fn with_torsion_and_nonmetricity(
        frame: &Frame<S>,
        metric: &Metric<S>,
        torsion: &Tensor<S>,
        nonmetricity: &Tensor<S>,
    ) -> Result<Self, Error> {
        let (n, g) = (frame.dimension(), metric.components());
        expect_slots("the metric", g, n, &[Down, Down])?;
        expect_torsion(torsion, n)?;
        expect_nonmetricity(nonmetricity, n)?;
        let derivative = frame.derivative(g)?;
        let d = contract("d_kij - Q_kij -> _kij", &[("d", &derivative), ("Q", nonmetricity)])?;
        let b = [("c", frame.structure_functions()), ("t", torsion)];
        let b = contract("c^i_jk + t^i_jk -> ^i_[jk]", &b)?;
        Connection::new(frame.clone(), koszul(metric, &d, &b)?)
    }

    /// The [`disformation`] of the nonmetricity of this connection.
    ///
    /// # Errors
    /// [`Error::Shape`] when the dimensions differ.
    pub fn disformation(&self, metric: &Metric<S>) -> Result<Tensor<S>, Error> {
        disformation(metric, &self.nonmetricity(metric)?)
    }
}

/// The contorsion of a torsion `tau^i_jk`. Its slots are `^i_jk` as for the affinities, with the
/// direction first:
///
/// ```text
/// K_ijk = (tau_ijk + tau_jik + tau_kij) / 2,    K_ijk = -K_kji
/// ```
///
/// where the metric lowers the first index (F. W. Hehl et al., *Phys. Rep.* 258 (1995) 1-171; J.
/// Beltrán Jiménez, L. Heisenberg and T. Koivisto, *Universe* 5 (2019) 173).
///
/// # Errors
/// [`Error::Shape`]; [`Error::NotFinite`]; [`Error::Symmetry`] unless the torsion is antisymmetric.
pub fn contorsion<S: Field + Scalar>(
    metric: &Metric<S>,
    torsion: &Tensor<S>,
) -> Result<Tensor<S>, Error> {
    let n = metric.components().dimension();
    expect_torsion(torsion, n)?;
    koszul(metric, &Tensor::zero(n, &[Down; 3])?, torsion)
}

/// Checks the slots and the antisymmetry of a torsion.
fn expect_torsion<S: Field + Scalar>(torsion: &Tensor<S>, n: usize) -> Result<(), Error> {
    expect_slots("the torsion", torsion, n, &[Up, Down, Down])?;
    expect_symmetry("the torsion", torsion, [1, 2], -1)
}

/// The disformation of a nonmetricity `Q_kij = (nabla_k g)_ij`. Its slots are `^i_jk` as for the
/// affinities:
///
/// ```text
/// L_ijk = (Q_ijk - Q_jki - Q_kij) / 2,    L_ijk = L_ikj
/// ```
///
/// where the metric lowers the first index (J. Beltrán Jiménez, L. Heisenberg and T. Koivisto,
/// *Universe* 5 (2019) 173).
///
/// # Errors
/// [`Error::Shape`]; [`Error::NotFinite`]; [`Error::Symmetry`] unless `Q_kij = Q_kji`.
pub fn disformation<S: Field + Scalar>(
    metric: &Metric<S>,
    nonmetricity: &Tensor<S>,
) -> Result<Tensor<S>, Error> {
    let n = metric.components().dimension();
    expect_nonmetricity(nonmetricity, n)?;
    let zero = Tensor::zero(n, &[Up, Down, Down])?;
    koszul(metric, &nonmetricity.scale(&S::from_i64(-1)), &zero)
}

fn expect_nonmetricity<S: Scalar>(nonmetricity: &Tensor<S>, n: usize) -> Result<(), Error> {
    expect_slots("the nonmetricity", nonmetricity, n, &[Down; 3])?;
    expect_symmetry("the nonmetricity", nonmetricity, [1, 2], 1)
}

/// The unique tensor `L^i_jk` with `L_ikj + L_jki = d_kij` and `L^i_jk - L^i_kj = b^i_jk`, where
/// `d_kij` is symmetric in `ij` and `b^i_jk` is antisymmetric in `jk`. If the metric lowers the
/// first index, the tensor is
///
/// ```text
/// 2 L_ijk = d_jki + d_kij - d_ijk + b_ijk - b_jki + b_kij
/// ```
///
/// The tensor is linear in `d` and `b`. The affinities have `d = e(g) - Q` and `b = c + tau`, and
/// each summand yields its own contribution.
fn koszul<S: Field + Scalar>(
    metric: &Metric<S>,
    d: &Tensor<S>,
    b: &Tensor<S>,
) -> Result<Tensor<S>, Error> {
    let half = S::from_i64(2).recip().ok_or(TensorError::NotInvertible(2))?;
    let lowered = formula("g_im b^m_jk -> _ijk", &[("g", metric.components()), ("b", b)]);
    // The antisymmetric part of the result is exactly b/2, also in floats. All terms except b_ijk
    // are symmetric in j and k, and raising the index of b_ijk returns b.
    let symmetric =
        formula("d_j_ki + d_k_ij - d_i_jk + b_jik + b_kij -> _ijk", &[("d", d), ("b", &lowered)]);
    let raised = formula("h^im s_mjk -> ^i_jk", &[("h", metric.inverse()), ("s", &symmetric)]);
    let twice = formula("b^i_jk + r^i_jk -> ^i_jk", &[("b", b), ("r", &raised)]);
    Ok(twice.scale(&half))
}
