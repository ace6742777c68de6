//! Torsion, curvature and the tensors derived from them, with the Bianchi identities.
//!
//! The curvature of a connection is computed once and shared by all tensors of this module.

mod conformal;
mod ricci;

use crate::algebra::frame::formula;
use crate::geometry::connection::Connection;
use affinor_tensors::stop::stage;
use affinor_tensors::{Scalar, Tensor};

/// The formula of the components `R^i_jkl` of the curvature.
const CURVATURE: &str =
    "d_k^i_lj - d_l^i_kj + L^i_km L^m_lj - L^i_lm L^m_kj - c^m_kl L^i_mj - h^i_jkl";

impl<S: Scalar> Connection<S> {
    /// The torsion (B10), slots `^i_jk`: `tau^i_jk = Lambda^i_jk - Lambda^i_kj - c^i_jk`.
    ///
    /// ```
    /// use affinor::algebra::catalogue;
    /// use affinor::{CanonicalConnection, Connection, Rational};
    /// let so3 = catalogue::algebra::<Rational>("so(3)")?;
    /// let plus = Connection::canonical(&so3, CanonicalConnection::Plus);
    /// assert_eq!(plus.torsion(), *so3.structure_constants());
    /// # Ok::<(), affinor::Error>(())
    /// ```
    #[doc(alias("torsion tensor"))]
    pub fn torsion(&self) -> Tensor<S> {
        formula(
            "L^i_jk - L^i_kj - c^i_jk -> ^i_[jk]",
            &[("L", self.affinities()), ("c", self.frame().structure_functions())],
        )
    }

    /// The curvature (B14), slots `^i_jkl`, `R(e_k, e_l) e_j = R^i_jkl e_i`:
    ///
    /// ```text
    /// R^i_jkl = e_k(Lambda^i_lj) - e_l(Lambda^i_kj)
    ///         + Lambda^i_km Lambda^m_lj - Lambda^i_lm Lambda^m_kj - c^m_kl Lambda^i_mj
    /// ```
    ///
    /// Over the frame of a homogeneous space, the isotropy `h^i_jkl` is subtracted.
    ///
    /// The curvature is computed on the first call, and stored.
    #[doc(alias("Riemann tensor", "riemann"))]
    pub fn curvature(&self) -> &Tensor<S> {
        let _stage = stage("curvature");
        let cell = &self.curvature;
        // does not use `get_or_init(compute)`, which could deadlock: a pool thread that waits
        // within `compute` may start other work that needs this curvature
        cell.get().unwrap_or_else(|| {
            let curvature = self.compute_curvature();
            cell.get_or_init(|| curvature)
        })
    }

    fn compute_curvature(&self) -> Tensor<S> {
        self.evaluate(&format!("{CURVATURE} -> ^i_j[kl]"))
    }

    /// The Ricci tensor, slots `_jl`: `Ric_jl = R^i_jil`. The tensor need not be symmetric.
    ///
    /// For scalars that grow ([`GROWS`](affinor_tensors::Summable::GROWS)), the Ricci tensor is
    /// computed without the curvature, because the components of the curvature may be much longer.
    /// If the curvature is already known, it is used.
    ///
    /// ```
    /// use affinor::algebra::catalogue;
    /// use affinor::{CanonicalConnection, Connection, Rational};
    /// let so3 = catalogue::algebra::<Rational>("so(3)")?;
    /// let zero = Connection::canonical(&so3, CanonicalConnection::Zero);
    /// assert_eq!(Some(zero.ricci().get(&[0, 0])), Rational::new(1, 2));
    /// # Ok::<(), affinor::Error>(())
    /// ```
    #[doc(alias("Ricci curvature"))]
    pub fn ricci(&self) -> Tensor<S> {
        let _stage = stage("ricci");
        if S::GROWS && self.curvature.get().is_none() {
            let known = self.ricci.get().cloned();
            return known.unwrap_or_else(|| {
                // computes outside `get_or_init`, for the reason given in `curvature`
                let ricci = self.evaluate(&format!("{} -> _jl", CURVATURE.replace('k', "i")));
                self.ricci.get_or_init(|| ricci).clone()
            });
        }
        formula("R^i_jil -> _jl", &[("R", self.curvature())])
    }

    /// Evaluates a formula in the affinities `L`, their derivatives `d`, the structure `c` and the
    /// isotropy `h`.
    fn evaluate(&self, expression: &str) -> Tensor<S> {
        let derivative =
            self.frame().derivative(self.affinities()).expect("the affinities belong to the frame");
        let isotropy = self.frame().isotropy().expect("of the rank of the derivative");
        formula(
            expression,
            &[
                ("d", &derivative),
                ("L", self.affinities()),
                ("c", self.frame().structure_functions()),
                ("h", &isotropy),
            ],
        )
    }

    /// The derivative of the torsion, slots `^i_mjk`: `(nabla_m tau)^i_jk`. It vanishes for the
    /// canonical connections of a group.
    pub fn nabla_torsion(&self) -> Tensor<S> {
        let _stage = stage("nabla_torsion");
        self.nabla(&self.torsion()).expect("the torsion belongs to the frame")
    }

    /// The derivative of the curvature, slots `^i_mjkl`: `(nabla_m R)^i_jkl`. For a torsion-free
    /// connection, the derivative vanishes exactly if the space is locally symmetric.
    pub fn nabla_curvature(&self) -> Tensor<S> {
        let _stage = stage("nabla_curvature");
        self.nabla(self.curvature()).expect("the curvature belongs to the frame")
    }

    /// The residual of the first Bianchi identity with torsion, slots `^i_jkl`: the cyclic sum over
    /// `j, k, l` of `R^i_jkl - tau^m_kl tau^i_mj - (nabla_k tau)^i_lj`. The residual vanishes for
    /// every connection over a frame whose structure satisfies the Jacobi identity.
    ///
    /// ```
    /// use affinor::algebra::catalogue;
    /// use affinor::{CanonicalConnection, Connection, Rational};
    /// let so3 = catalogue::algebra::<Rational>("so(3)")?;
    /// let plus = Connection::canonical(&so3, CanonicalConnection::Plus);
    /// assert!(plus.bianchi_first().is_empty());
    /// # Ok::<(), affinor::Error>(())
    /// ```
    #[doc(alias("Bianchi identity"))]
    pub fn bianchi_first(&self) -> Tensor<S> {
        let _stage = stage("first Bianchi identity");
        let (torsion, nabla) = (self.torsion(), self.nabla_torsion());
        formula(
            "R^i_jkl + R^i_klj + R^i_ljk \
             - t^m_kl t^i_mj - t^m_lj t^i_mk - t^m_jk t^i_ml \
             - D^i_klj - D^i_ljk - D^i_jkl -> ^i_[jkl]",
            &[("R", self.curvature()), ("t", &torsion), ("D", &nabla)],
        )
    }

    /// The residual of the second Bianchi identity with torsion, slots `^i_jmkl`: the cyclic sum
    /// over `m, k, l` of `(nabla_m R)^i_jkl + tau^p_mk R^i_jpl`. The residual vanishes under the
    /// same condition as the residual of the first identity.
    ///
    /// The affinities between the lower indices `m, k, l` of `nabla R` cancel against those in the
    /// torsion, for every connection. The remainder is the exterior covariant derivative of the
    /// curvature form. This method computes the remainder, which is the cyclic sum of
    ///
    /// ```text
    /// e_m(R^i_jkl) + Lambda^i_mp R^p_jkl - Lambda^p_mj R^i_pkl - c^p_mk R^i_jpl
    /// ```
    pub fn bianchi_second(&self) -> Tensor<S> {
        let _stage = stage("second Bianchi identity");
        let curvature = self.curvature();
        let derivative =
            self.frame().derivative(curvature).expect("the curvature belongs to the frame");
        // m, k, l come first, because the kernel loops over the leading indices, and then computes
        // only m < k < l
        let residual = formula(
            "d_m^i_jkl + d_k^i_jlm + d_l^i_jmk \
             + L^i_mp R^p_jkl + L^i_kp R^p_jlm + L^i_lp R^p_jmk \
             - L^p_mj R^i_pkl - L^p_kj R^i_plm - L^p_lj R^i_pmk \
             - c^p_mk R^i_jpl - c^p_kl R^i_jpm - c^p_lm R^i_jpk -> _[mkl]^i_j",
            &[
                ("d", &derivative),
                ("L", self.affinities()),
                ("R", curvature),
                ("c", self.frame().structure_functions()),
            ],
        );
        residual.permute(&[3, 4, 0, 1, 2]).expect("an order of the slots")
    }
}
