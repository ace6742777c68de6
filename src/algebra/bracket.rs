//! Brackets: antisymmetric, not yet known to satisfy the Jacobi identity.

use crate::Error;
use crate::frame::Frame;
use affinor_tensors::{Down, Ring, Tensor, Up};
use std::sync::Arc;

/// An antisymmetric bracket `[e_j, e_k] = c^i_jk e_i`, with the Jacobi identity unchecked: what
/// [`LieAlgebra`](crate::LieAlgebra) is made from.
#[derive(Clone, Debug)]
pub struct Bracket<S> {
    frame: Frame<S>,
}

impl<S: Ring> Bracket<S> {
    /// The bracket with the structure constants `c^i_jk`, slots `[Up, Down, Down]`.
    ///
    /// # Errors
    /// [`Error::Shape`]; [`Error::NotAntisymmetric`] with the first pair that is not.
    pub fn new(labels: Arc<[String]>, structure: Tensor<S>) -> Result<Self, Error> {
        Ok(Bracket { frame: Frame::invariant(labels, structure)? })
    }

    /// The bracket from a closure: `bracket(j, k)` lists `(i, c^i_jk)` and is asked for `j < k`
    /// only, from 0.
    ///
    /// # Errors
    /// An index out of range.
    pub fn from_fn(
        labels: &[&str],
        bracket: impl Fn(usize, usize) -> Vec<(usize, S)>,
    ) -> Result<Self, Error> {
        let n = labels.len();
        let pairs = (0..n).flat_map(|j| (j + 1..n).map(move |k| (j, k)));
        let constants =
            pairs.flat_map(|(j, k)| bracket(j, k).into_iter().map(move |(i, v)| (j, k, i, v)));
        let labels = labels.iter().map(|label| label.to_string()).collect();
        Self::from_constants(labels, constants)
    }

    /// The bracket with `[e_j, e_k] = ... + v e_i` for each `(j, k, i, v)` and its antisymmetric
    /// counterpart, from 0.
    ///
    /// # Errors
    /// An index out of range; [`Error::NotAntisymmetric`] for `j = k`.
    pub fn from_constants(
        labels: Arc<[String]>,
        constants: impl IntoIterator<Item = (usize, usize, usize, S)>,
    ) -> Result<Self, Error> {
        let both = constants.into_iter().flat_map(|(j, k, i, v)| {
            let counterpart = (j != k).then(|| ([i, k, j], -v.clone()));
            [Some(([i, j, k], v)), counterpart].into_iter().flatten()
        });
        let structure = Tensor::from_components(labels.len(), &[Up, Down, Down], both)?;
        Self::new(labels, structure)
    }

    /// The structure constants `c^i_jk`.
    pub fn structure(&self) -> &Tensor<S> {
        self.frame.structure()
    }

    /// The names of the basis vectors.
    pub fn labels(&self) -> &Arc<[String]> {
        self.frame.labels()
    }

    /// The Jacobi residual, slots `^i_jkl`:
    /// `[[e_j,e_k],e_l] + [[e_k,e_l],e_j] + [[e_l,e_j],e_k]`. Zero for a Lie algebra.
    pub fn jacobi(&self) -> Tensor<S> {
        self.frame.jacobi()
    }

    /// The first triple of basis vectors that violates the Jacobi identity.
    pub fn jacobi_violation(&self) -> Option<Error> {
        let residual = self.jacobi();
        let at = residual.components().map(|(at, _)| (at[1], at[2], at[3])).min();
        at.map(|(j, k, l)| {
            let label = |at: usize| self.labels()[at].clone();
            let parts = (0..self.labels().len()).map(|i| residual.get(&[i, j, k, l]));
            Error::Jacobi {
                x: label(j),
                y: label(k),
                z: label(l),
                residual: self.frame.write(parts),
            }
        })
    }

    pub(super) fn into_frame(self) -> Frame<S> {
        self.frame
    }
}
