//! The matrices of a Chevalley basis.

use super::{MatrixRepresentation, commutator};
use crate::algebra::roots::{RootSystem, chevalley_constants};
use affinor_tensors::Rational;
use affinor_tensors::linear::Matrix;
use affinor_tensors::stop::checkpoint;

impl MatrixRepresentation {
    /// The matrices of the Chevalley basis of each simple factor, in the order of
    /// [`chevalley_constants`]: the root vectors `e_α`, then `f_α`, then `h_1, ..., h_r`. The basis
    /// of the centre follows. The brackets of the matrices have the structure constants of
    /// [`chevalley_constants`].
    ///
    /// A root vector of a root `α_i + β` is the bracket `[e_i, e_β]`, divided by its structure
    /// constant.
    ///
    /// ```
    /// use affinor::representation::{HighestWeight, MatrixRepresentation, ReductiveAlgebra};
    /// let g2: ReductiveAlgebra = "G2".parse()?;
    /// let seven = MatrixRepresentation::new(&HighestWeight::new(&g2, [1, 0])?)?;
    /// assert_eq!(seven.chevalley_basis().len(), 14);
    /// # Ok::<(), affinor::representation::RepresentationError>(())
    /// ```
    pub fn chevalley_basis(&self) -> Vec<Matrix<Rational>> {
        let algebra = self.algebra();
        let mut all = vec![];
        for (at, factor) in algebra.simple_factors().iter().enumerate() {
            let positions = algebra.positions(at);
            let roots = RootSystem::new(*factor);
            let (count, rank) = (roots.positive_roots().len(), factor.rank());
            // the first constant of each sum of a simple root and a positive root, of one sign
            let mut sums = vec![None; 2 * count];
            for (i, j, sum, value) in chevalley_constants(&roots) {
                let start = if sum < count { 0 } else { count };
                let simple = (start..start + rank).contains(&i);
                if simple && (start..start + count).contains(&j) && sum < 2 * count {
                    sums[sum] = sums[sum].or(Some((i, j, value)));
                }
            }
            let n = self.dimension();
            let mut vectors = vec![Matrix::zero(n, n); 2 * count];
            vectors[..rank].clone_from_slice(&self.raising[positions.clone()]);
            vectors[count..count + rank].clone_from_slice(&self.lowering[positions.clone()]);
            // a sum of positive roots has a larger number than its terms
            for (sum, term) in sums.into_iter().enumerate() {
                checkpoint();
                if let Some((i, j, value)) = term
                    && let Some(unit) = Rational::new(1, value)
                {
                    let bracket = commutator(&vectors[i], &vectors[j]);
                    vectors[sum] = bracket.map(|entry| entry.clone() * &unit);
                }
            }
            all.extend(vectors);
            all.extend(positions.map(|i| self.diagonal(i)));
        }
        all.extend((algebra.semisimple_rank()..algebra.rank()).map(|i| self.diagonal(i)));
        all
    }
}
