//! Torsion, curvature, Ricci, and the Bianchi identities they satisfy; what is made of them.

mod conformal;
mod derivative;
mod kretschmann;
mod ricci;

use crate::Connection;
use crate::frame::formula;
use affinor_tensors::{Ring, Tensor};

impl<S: Ring> Connection<S> {
    /// The torsion (B10), slots `^i_jk`: `tau^i_jk = Lambda^i_jk - Lambda^i_kj - c^i_jk`.
    pub fn torsion(&self) -> Tensor<S> {
        formula(
            "L^i_jk - L^i_kj - c^i_jk -> ^i_[jk]",
            &[("L", self.gamma()), ("c", self.frame().structure())],
        )
    }

    /// The curvature (B14), slots `^i_jkl`, `R(e_k, e_l) e_j = R^i_jkl e_i`:
    ///
    /// ```text
    /// R^i_jkl = e_k(Lambda^i_lj) - e_l(Lambda^i_kj)
    ///         + Lambda^i_km Lambda^m_lj - Lambda^i_lm Lambda^m_kj - c^m_kl Lambda^i_mj
    /// ```
    ///
    /// less the isotropy `h^i_jkl` over the frame of a homogeneous space.
    pub fn curvature(&self) -> Tensor<S> {
        let derivative =
            self.frame().derivative(self.gamma()).expect("the affinities belong to the frame");
        let isotropy = self.frame().isotropy().expect("of the rank of the derivative");
        formula(
            "d_k^i_lj - d_l^i_kj + L^i_km L^m_lj - L^i_lm L^m_kj - c^m_kl L^i_mj - h^i_jkl -> ^i_j[kl]",
            &[
                ("d", &derivative),
                ("L", self.gamma()),
                ("c", self.frame().structure()),
                ("h", &isotropy),
            ],
        )
    }

    /// The Ricci tensor, slots `_jl`: `Ric_jl = R^i_jil`. It need not be symmetric.
    pub fn ricci(&self) -> Tensor<S> {
        formula("R^i_jil -> _jl", &[("R", &self.curvature())])
    }

    /// The residual of the first Bianchi identity with torsion, slots `^i_jkl`: the cyclic sum
    /// over `j, k, l` of `R^i_jkl - tau^m_kl tau^i_mj - (nabla_k tau)^i_lj`. Zero for every
    /// connection over a frame whose structure satisfies the Jacobi identity.
    pub fn bianchi_first(&self) -> Tensor<S> {
        let (torsion, nabla) = (self.torsion(), self.nabla_torsion());
        formula(
            "R^i_jkl + R^i_klj + R^i_ljk \
             - t^m_kl t^i_mj - t^m_lj t^i_mk - t^m_jk t^i_ml \
             - D^i_klj - D^i_ljk - D^i_jkl -> ^i_[jkl]",
            &[("R", &self.curvature()), ("t", &torsion), ("D", &nabla)],
        )
    }

    /// The residual of the second Bianchi identity with torsion, slots `^i_jmkl`: the cyclic sum
    /// over `m, k, l` of `(nabla_m R)^i_jkl + tau^p_mk R^i_jpl`. Zero as the first.
    pub fn bianchi_second(&self) -> Tensor<S> {
        let (curvature, nabla) = (self.curvature(), self.nabla_curvature());
        formula(
            "D^i_mjkl + D^i_kjlm + D^i_ljmk \
             + t^p_mk R^i_jpl + t^p_kl R^i_jpm + t^p_lm R^i_jpk -> ^i_j[mkl]",
            &[("D", &nabla), ("t", &self.torsion()), ("R", &curvature)],
        )
    }
}
