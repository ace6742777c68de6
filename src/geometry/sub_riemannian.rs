//! Left-invariant sub-Riemannian structures: a distribution on a group with an inner product.

use crate::algebra::frame::{expect_slots, formula};
use crate::algebra::{Distribution, LieAlgebra};
use crate::geometry::connection::{columns, inverse_gram};
use crate::{Error, Metric};
use affinor_tensors::linear::Row;
use affinor_tensors::{Down, Field, Scalar, Tensor, Up};

/// A left-invariant distribution `D` with an inner product, which measures the curves whose velocity
/// is in `D`.
///
/// Let the columns of `D^i_a` be the given vectors, and `M_ab` their inner products. The cometric
/// and the Hamiltonian are
///
/// ```text
/// Q^ij = D^i_a (M^-1)^ab D^j_b,   E(p) = Q^ij p_i p_j/2
/// ```
///
/// For an orthonormal basis `X_a` of `D`, `E(p) = (h_1^2 + ... + h_r^2)/2` with `h_a = p(X_a)`. The
/// normal extremals are the solutions of `g' = g u`, `p' = ad*_u p` with `u = Q p`. Their
/// projections to the group are locally shortest.
///
/// A. Agrachev, D. Barilari and U. Boscain, *A Comprehensive Introduction to Sub-Riemannian
/// Geometry* (2019), sections 4.3 and 7.6.
///
/// ```
/// use affinor::algebra::catalogue;
/// use affinor::geometry::SubRiemannian;
/// use affinor::Rational;
/// // a knife edge in the plane turns with e1 and slides with e2
/// let se2 = catalogue::algebra::<Rational>("se(2)")?;
/// let [turn, slide] = [0, 1].map(|at| vec![(at, Rational::from(1))]);
/// let knife = SubRiemannian::orthonormal(&se2, [turn, slide])?;
/// let p = [1, 2, 3].map(Rational::from);
/// assert_eq!(knife.hamiltonian(&p)?, Rational::new(5, 2).unwrap());
/// assert_eq!(knife.velocity(&p)?, [1, 2, 0].map(Rational::from));
/// // p' = (-u2 p3, u1 p3, -u1 p2)
/// assert_eq!(knife.covector_rate(&p)?, [-6, 3, -2].map(Rational::from));
/// # Ok::<(), affinor::Error>(())
/// ```
#[doc(alias("Carnot-Caratheodory", "horizontal", "Pontryagin"))]
#[derive(Clone, Debug)]
pub struct SubRiemannian<S> {
    structure: Tensor<S>,
    distribution: Distribution<S>,
    vectors: Vec<Row<S>>,
    /// The inverse `(M^-1)^ab` of the matrix of inner products, slots `[Up, Up]`.
    inverse: Tensor<S>,
    cometric: Tensor<S>,
}

impl<S: Field + Scalar> SubRiemannian<S> {
    /// The structure for which the given vectors of an algebra are orthonormal. A vector is the list
    /// of its nonzero components.
    ///
    /// # Errors
    /// The errors of [`Distribution::new`].
    pub fn orthonormal(
        algebra: &LieAlgebra<S>,
        vectors: impl IntoIterator<Item = Row<S>>,
    ) -> Result<Self, Error> {
        Self::of(algebra, vectors.into_iter().collect(), None)
    }

    /// The distribution that the vectors span, with the restriction of a metric.
    ///
    /// # Errors
    /// The errors of [`Distribution::new`]; [`Error::Shape`] for a metric of another dimension;
    /// [`Error::Invalid`] if the metric is degenerate on the distribution.
    pub fn restricted(
        algebra: &LieAlgebra<S>,
        vectors: impl IntoIterator<Item = Row<S>>,
        metric: &Metric<S>,
    ) -> Result<Self, Error> {
        Self::of(algebra, vectors.into_iter().collect(), Some(metric))
    }

    fn of(
        algebra: &LieAlgebra<S>,
        vectors: Vec<Row<S>>,
        metric: Option<&Metric<S>>,
    ) -> Result<Self, Error> {
        let (n, r) = (algebra.dimension(), vectors.len());
        let distribution = Distribution::new(algebra, vectors.clone())?;
        let basis = columns(n, &vectors)?;
        let inverse = match metric {
            None => Tensor::from_components(n, &[Up, Up], (0..r).map(|a| ([a, a], S::one())))?,
            Some(metric) => {
                let g = metric.components();
                expect_slots("the metric", g, n, &[Down, Down])?;
                inverse_gram(g, &basis, r)?.ok_or_else(|| Error::Invalid {
                    what: "distribution",
                    reason: "the metric is degenerate on it, so it has no cometric".into(),
                })?
            }
        };
        let cometric = formula("D^i_a K^ab D^j_b -> ^ij", &[("D", &basis), ("K", &inverse)]);
        let structure = algebra.structure_constants().clone();
        Ok(SubRiemannian { structure, distribution, vectors, inverse, cometric })
    }

    /// The dimension `n` of the group.
    pub fn dimension(&self) -> usize {
        self.structure.dimension()
    }

    /// The distribution.
    pub fn distribution(&self) -> &Distribution<S> {
        &self.distribution
    }

    /// The vectors that span the distribution, in the given order.
    pub fn vectors(&self) -> &[Row<S>] {
        &self.vectors
    }

    /// The entry `(M^-1)^ab` of the inverse of the matrix of inner products of the given vectors.
    pub fn inverse_product(&self, a: usize, b: usize) -> S {
        self.inverse.get(&[a, b])
    }

    /// The cometric `Q^ij`, slots `[Up, Up]`, of rank `r`.
    pub fn cometric(&self) -> &Tensor<S> {
        &self.cometric
    }

    /// The Hamiltonian `E(p) = Q^ij p_i p_j/2`: half of the squared speed of the normal extremal.
    ///
    /// # Errors
    /// [`Error::Shape`] unless the covector has the dimension of the group.
    pub fn hamiltonian(&self, covector: &[S]) -> Result<S, Error> {
        let p = self.covector(covector)?;
        let twice = formula("Q^ij p_i p_j ->", &[("Q", &self.cometric), ("p", &p)]);
        let twice = twice.to_scalar().expect("a tensor of rank 0");
        let half = S::from_i64(2).recip().expect("2 is not zero in a field");
        Ok(twice * &half)
    }

    /// The velocity `u^i = Q^ij p_j` of the normal extremal.
    ///
    /// # Errors
    /// The errors of [`hamiltonian`](Self::hamiltonian).
    pub fn velocity(&self, covector: &[S]) -> Result<Vec<S>, Error> {
        let p = self.covector(covector)?;
        Ok(self.list(&formula("Q^ij p_j -> ^i", &[("Q", &self.cometric), ("p", &p)])))
    }

    /// The rate `p'_i = (ad*_u p)_i = c^j_ki u^k p_j` of the covector, with `u = Q p`.
    ///
    /// # Errors
    /// The errors of [`hamiltonian`](Self::hamiltonian).
    pub fn covector_rate(&self, covector: &[S]) -> Result<Vec<S>, Error> {
        let p = self.covector(covector)?;
        let operands = [("c", &self.structure), ("Q", &self.cometric), ("p", &p)];
        Ok(self.list(&formula("c^j_ki Q^kl p_l p_j -> _i", &operands)))
    }

    fn covector(&self, covector: &[S]) -> Result<Tensor<S>, Error> {
        let tensor = Tensor::vector(covector, Down).with_tolerance(self.structure.tolerance());
        expect_slots("the covector", &tensor, self.dimension(), &[Down])?;
        Ok(tensor)
    }

    fn list(&self, tensor: &Tensor<S>) -> Vec<S> {
        (0..self.dimension()).map(|i| tensor.get(&[i])).collect()
    }
}
