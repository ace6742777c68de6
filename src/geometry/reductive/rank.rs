//! The rank of a symmetric space.

use super::ReductivePair;
use crate::Error;
use crate::algebra::structure::Subspace;
use affinor_tensors::Rational;
use affinor_tensors::linear::Matrix;

/// The number of vectors that are tried.
const TRIALS: i64 = 8;

impl ReductivePair<Rational> {
    /// The rank of a symmetric pair: the dimension of a maximal abelian subspace of `m`. `None` if the
    /// pair is not symmetric, or if no vector is found whose centralizer in `m` is abelian.
    ///
    /// The centralizer of a general vector in `m` is such a subspace if G is semisimple and the
    /// isotropy algebra compact (S. Helgason, *Differential Geometry, Lie Groups, and Symmetric
    /// Spaces*, V.6).
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
        let (n, r) = (self.algebra.dimension(), self.dimension());
        let mut least: Option<Vec<Vec<Rational>>> = None;
        for t in 2..2 + TRIALS {
            let mut power = 1i64;
            let x = (0..n).map(|i| {
                power = power * t % 1009;
                Rational::from(if i < r { power } else { 0 })
            });
            let ad = self.algebra.ad(&x.collect::<Vec<_>>())?;
            let mut rows = vec![vec![]; n];
            for (at, value) in ad.components().filter(|(at, _)| at[1] < r) {
                rows[at[0]].push((at[1], value.clone()));
            }
            let kernel = Matrix::from_rows(r, rows)?.nullspace()?.to_dense();
            if least.as_ref().is_none_or(|known| kernel.len() < known.len()) {
                least = Some(kernel);
            }
        }
        let Some(centralizer) = least else { return Ok(None) };
        let lifted = |x: &Vec<Rational>| {
            x.iter().cloned().chain((r..n).map(|_| Rational::from(0))).collect::<Vec<_>>()
        };
        let vectors: Vec<_> = centralizer.iter().map(lifted).collect();
        for (at, x) in vectors.iter().enumerate() {
            for y in &vectors[..at] {
                let bracket = self.algebra.bracket(x, y)?.into_iter().enumerate().collect();
                if !Subspace::span(n, [bracket]).is_zero() {
                    return Ok(None);
                }
            }
        }
        Ok(Some(vectors.len()))
    }
}
