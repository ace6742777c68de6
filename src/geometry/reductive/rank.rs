//! The rank of a symmetric space.

use super::ReductivePair;
use crate::Error;
use crate::algebra::structure::StructureTheory;
use affinor_tensors::linear::Matrix;
use affinor_tensors::stop::checkpoint;
use affinor_tensors::{Rational, Ring};
use std::collections::{BTreeMap, HashSet};

/// The number of dense vectors that are tried.
const TRIALS: i64 = 8;

impl ReductivePair<Rational> {
    /// The rank of a symmetric pair: the dimension of a maximal abelian subspace of `m`. `None` if the
    /// pair is not symmetric, or if no vector is found whose centralizer in `m` is abelian.
    ///
    /// The centralizer of a general vector in `m` is such a subspace if G is semisimple and the
    /// isotropy algebra compact (S. Helgason, *Differential Geometry, Lie Groups, and Symmetric
    /// Spaces*, V.6). It has the least dimension among the centralizers of vectors.
    ///
    /// First, the vector is a combination of basis vectors that commute, so that its centralizer is
    /// computed from few numbers. The centralizer is accepted if it is abelian and the Killing form is
    /// not degenerate on it. Then `m` is the sum of the centralizer and of the image of `ad_x^2`, so
    /// the vector is semisimple and general.
    ///
    /// ```
    /// use affinor::geometry::homogeneous::HomogeneousSpace;
    /// assert_eq!(HomogeneousSpace::find("Gr(2,R^5)")?.pair().rank()?, Some(2));
    /// # Ok::<(), affinor::Error>(())
    /// ```
    ///
    /// # Errors
    /// No error occurs for a valid pair. An [`Error::Shape`] of a computation is returned unchanged.
    pub fn rank(&self) -> Result<Option<usize>, Error> {
        if !self.is_symmetric() {
            return Ok(None);
        }
        let r = self.dimension();
        let powers = |t: i64| {
            std::iter::successors(Some(t), move |power| Some(power * t % 1009)).map(Rational::from)
        };
        let commuting = self.commuting_basis_vectors();
        let sparse = commuting.into_iter().zip(powers(2)).collect::<BTreeMap<_, _>>();
        let dense = (2..2 + TRIALS).map(|t| (0..r).zip(powers(t)).collect::<BTreeMap<_, _>>());
        let first = self.centralizer(&sparse)?;
        if self.is_abelian(&first)? && self.has_regular_killing_form(&first)? {
            return Ok(Some(first.len()));
        }
        let mut least: Option<Vec<Vec<Rational>>> = None;
        for x in dense {
            let kernel = self.centralizer(&x)?;
            if least.as_ref().is_none_or(|known| kernel.len() < known.len()) {
                least = Some(kernel);
            }
        }
        let Some(least) = least else { return Ok(None) };
        Ok(self.is_abelian(&least)?.then_some(least.len()))
    }

    /// Basis vectors of `m` that commute with each other, chosen one by one.
    fn commuting_basis_vectors(&self) -> Vec<usize> {
        let components = self.algebra.structure_constants().components();
        let pairs: HashSet<(usize, usize)> = components.map(|(at, _)| (at[1], at[2])).collect();
        let mut chosen: Vec<usize> = vec![];
        for next in 0..self.dimension() {
            let commutes = |other: &usize| !pairs.contains(&(next, *other));
            if chosen.iter().all(commutes) {
                chosen.push(next);
            }
        }
        chosen
    }

    /// A basis of the centralizer in `m` of a vector of `m`, in the basis of the algebra.
    fn centralizer(&self, x: &BTreeMap<usize, Rational>) -> Result<Vec<Vec<Rational>>, Error> {
        checkpoint();
        let (n, r) = (self.algebra.dimension(), self.dimension());
        let dense = |i| x.get(&i).cloned().unwrap_or_default();
        let ad = self.algebra.ad(&(0..n).map(dense).collect::<Vec<_>>())?;
        let mut rows = vec![vec![]; n];
        for (at, value) in ad.components().filter(|(at, _)| at[1] < r) {
            rows[at[0]].push((at[1], value.clone()));
        }
        let kernel = Matrix::from_rows(r, rows)?.nullspace()?.to_dense();
        let lifted = |x: Vec<Rational>| {
            x.into_iter().chain((r..n).map(|_| Rational::from(0))).collect::<Vec<_>>()
        };
        Ok(kernel.into_iter().map(lifted).collect())
    }

    fn is_abelian(&self, vectors: &[Vec<Rational>]) -> Result<bool, Error> {
        for (at, x) in vectors.iter().enumerate() {
            for y in &vectors[..at] {
                if self.algebra.bracket(x, y)?.iter().any(|value| !value.vanishes()) {
                    return Ok(false);
                }
            }
        }
        Ok(true)
    }

    /// Whether the Killing form is not degenerate on the span of independent vectors.
    fn has_regular_killing_form(&self, vectors: &[Vec<Rational>]) -> Result<bool, Error> {
        if vectors.is_empty() {
            return Ok(true);
        }
        let theory = StructureTheory::new(self.algebra.clone());
        let basis = Matrix::from_dense(vectors)?;
        let form = basis.mul(theory.killing_matrix())?.mul(&basis.transpose())?;
        Ok(form.rank()? == vectors.len())
    }
}
