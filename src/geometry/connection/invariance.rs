//! Invariance of connections under `ad`, and components of bi-invariant connections in the
//! right-invariant frame.

use super::Connection;
use crate::algebra::LieAlgebra;
use crate::{Error, Law};
use affinor_tensors::stop::stage;
use affinor_tensors::{Down, Field, Scalar, Tensor, Up, contract};

impl<S: Scalar> Connection<S> {
    /// The action of `ad_{e_m}` on the affinities, slots `^i_mjk`:
    /// `(L_m Lambda)^i_jk = c^i_mp Lambda^p_jk - c^p_mj Lambda^i_pk - c^p_mk Lambda^i_jp`. This
    /// action is the covariant derivative with the connection `plus`.
    ///
    /// The action vanishes exactly if the connection is bi-invariant. The function
    /// [`bi_invariant`](Self::bi_invariant) finds all bi-invariant connections.
    ///
    /// # Errors
    /// [`Error::Unsupported`] in a frame that is not invariant.
    pub fn ad_invariance_defect(&self) -> Result<Tensor<S>, Error> {
        if !self.frame.is_invariant() {
            return Err(Error::Unsupported(
                "invariance under ad is defined in an invariant frame only".into(),
            ));
        }
        Connection::in_frame(&self.frame, &S::one()).nabla(&self.gamma)
    }

    /// The same connection in the right-invariant frame through the same basis. The affinities are
    /// `Lambda_right = Lambda - c`, and the structure is `-c`.
    ///
    /// # Errors
    /// [`Law::AdInvariance`] with a component of
    /// [`ad_invariance_defect`](Self::ad_invariance_defect) that does not vanish, because the
    /// components in the right-invariant frame are not constant in this case.
    /// [`Error::Unsupported`] if the connection is not in the left-invariant frame of `algebra`.
    pub fn in_right_frame(&self, algebra: &LieAlgebra<S>) -> Result<Self, Error> {
        if self.frame.structure_functions() != algebra.structure_constants() {
            return Err(Error::Unsupported(
                "the connection is not in the left-invariant frame of this algebra".into(),
            ));
        }
        if let Some((at, residual)) = self.ad_invariance_defect()?.components().next() {
            let [i, j, k] = [at[0], at[2], at[3]].map(|index| (index + 1).to_string());
            let at = [self.frame.labels()[at[1]].clone(), i, j, k];
            return Err(Law::AdInvariance.broken(at, residual.to_string()));
        }
        let operands = [("L", &self.gamma), ("c", algebra.structure_constants())];
        let gamma = contract("L^i_jk - c^i_jk -> ^i_jk", &operands)?;
        Connection::new(algebra.right_frame(), gamma)
    }
}

impl<S: Field + Scalar> Connection<S> {
    /// A basis of the bi-invariant connections of an algebra, as affinities `Lambda^i_jk` in the
    /// left-invariant frame. They are the solutions of `L_x Lambda = 0` for all `x`.
    /// [`LieAlgebra::invariant_tensors`] solves the equations for some `x` only.
    ///
    /// The bi-invariant connections form a vector space that contains `c`. On a simple compact
    /// group, `c` spans this space, except that SU(n) with n >= 3 also has a symmetric solution (H.
    /// T. Laquer, *Trans. Amer. Math. Soc.* 331 (1992) 541-551).
    ///
    /// # Errors
    /// [`Error::Size`] for more than [`MAX_UNKNOWNS`](crate::algebra::invariants::MAX_UNKNOWNS)
    /// components.
    pub fn bi_invariant(algebra: &LieAlgebra<S>) -> Result<Vec<Tensor<S>>, Error> {
        let _stage = stage("bi-invariant connections");
        let directions: Vec<_> = algebra.basis().collect();
        algebra.invariant_tensors(&[Up, Down, Down], &directions)
    }
}
