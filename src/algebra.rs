//! Lie algebras and their frames. In reading order:
//!
//! - [`frame`]: structure functions and derivations of frame vectors;
//! - [`Bracket`]: antisymmetric structure constants; [`LieAlgebra`]: a bracket that satisfies the
//!   Jacobi identity;
//! - [`BasisChange`], [`MatrixBasis`]: other bases, and structure constants from matrices;
//! - [`RationalBasis`]: a basis in which the structure constants have no square roots;
//! - [`roots`]: root systems and Chevalley bases; [`catalogue`]: Lie algebras by name;
//! - [`Module`]: modules by matrices; `cochains`: the complex of Chevalley and Eilenberg;
//! - [`structure`]: series, radicals, Levi subalgebras, types, simple ideals;
//! - [`Distribution`]: subspaces as distributions, integrable or bracket-generating;
//! - [`lie_derivative`]: Lie derivatives of tensors; [`invariants`]: invariant tensors;
//! - [`lie_poisson`]: the dual space, its Poisson bracket, Casimir functions, coadjoint orbits.
//!
//! The method [`LieAlgebra::bch`] computes the Baker-Campbell-Hausdorff series.

mod basis;
mod bch;
mod bracket;
pub mod catalogue;
mod cochains;
mod distribution;
mod factors;
pub mod frame;
mod generators;
pub mod invariants;
pub mod lie_derivative;
pub mod lie_poisson;
mod matrices;
pub(crate) mod matrix_polynomials;
mod module;
mod rational_basis;
pub mod roots;
mod sparse_bracket;
pub mod structure;

pub use basis::BasisChange;
pub(crate) use basis::{LETTERS, indices, inverse, to_matrix};
pub use bracket::Bracket;
pub use cochains::Dimensions;
pub(crate) use cochains::relative_cohomology;
pub use distribution::{BracketWitness, Distribution};
pub(crate) use factors::irreducible_factors;
pub use matrices::{Complex, MatrixBasis};
pub use module::{MAX_DIMENSION as MAX_MODULE, Module};
pub use rational_basis::RationalBasis;
pub(crate) use sparse_bracket::SparseBracket;

use crate::Error;
use crate::algebra::frame::{Frame, formula};
use affinor_tensors::{Down, Field, Scalar, Tensor, Up};
use std::fmt;

/// A Lie algebra: a bracket that is antisymmetric and satisfies the Jacobi identity.
///
/// ```
/// use affinor::{Bracket, LieAlgebra};
/// use affinor::Rational;
/// // the Heisenberg algebra: [x, y] = z
/// let bracket = Bracket::from_fn(&["x", "y", "z"], |j, k| match (j, k) {
///     (0, 1) => vec![(2, Rational::from(1))],
///     _ => vec![],
/// })?;
/// let heisenberg = LieAlgebra::try_from(bracket)?;
/// assert!(heisenberg.killing_form().is_empty());
/// # Ok::<(), affinor::Error>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct LieAlgebra<S> {
    frame: Frame<S>,
}

/// Writes the nonzero brackets `[x, y] = z`, one per line.
impl<S: Scalar> fmt::Display for LieAlgebra<S> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.frame.write_products(f, self.structure_constants(), "[", "]", |j, k| j < k)
    }
}

impl<S: Scalar> TryFrom<Bracket<S>> for LieAlgebra<S> {
    type Error = Error;

    /// Checks the Jacobi identity; [`Law::Jacobi`](crate::Law::Jacobi) names the first triple that
    /// fails.
    fn try_from(bracket: Bracket<S>) -> Result<Self, Error> {
        match bracket.jacobi_violation() {
            Some(violation) => Err(violation),
            None => Ok(LieAlgebra { frame: bracket.into_frame() }),
        }
    }
}

impl<S: Scalar> LieAlgebra<S> {
    /// The dimension.
    pub fn dimension(&self) -> usize {
        self.frame.dimension()
    }

    /// The names of the basis vectors.
    pub fn labels(&self) -> &[String] {
        self.frame.labels()
    }

    /// The basis vectors as lists of components.
    pub(crate) fn basis(&self) -> impl Iterator<Item = Vec<S>> {
        let n = self.dimension();
        (0..n).map(move |j| {
            let mut vector = vec![S::zero(); n];
            vector[j] = S::one();
            vector
        })
    }

    /// The left-invariant frame through the basis: structure `c`, zero derivations.
    pub fn left_frame(&self) -> &Frame<S> {
        &self.frame
    }

    /// The right-invariant frame through the same basis: structure `-c`.
    pub fn right_frame(&self) -> Frame<S> {
        let opposite = self.structure_constants().map(|value| -value.clone());
        Frame::invariant(self.labels(), opposite).expect("the opposite of an algebra")
    }

    /// The opposite algebra, with the bracket `-[x, y]`. Its left-invariant frame is the
    /// right-invariant frame of this algebra.
    ///
    /// ```
    /// use affinor::algebra::catalogue;
    /// use affinor::Rational;
    /// let so3 = catalogue::algebra::<Rational>("so(3)")?;
    /// assert_eq!(so3.opposite().structure_constants().get(&[2, 0, 1]), (-1).into());
    /// # Ok::<(), affinor::Error>(())
    /// ```
    #[doc(alias("right-invariant"))]
    pub fn opposite(&self) -> Self {
        LieAlgebra { frame: self.right_frame() }
    }

    /// The structure constants `c^i_jk`, `[e_j, e_k] = c^i_jk e_i`.
    ///
    /// ```
    /// use affinor::algebra::catalogue;
    /// use affinor::Rational;
    /// let so3 = catalogue::algebra::<Rational>("so(3)")?;
    /// // [e1, e2] = e3
    /// assert_eq!(so3.structure_constants().get(&[2, 0, 1]), 1.into());
    /// # Ok::<(), affinor::Error>(())
    /// ```
    #[doc(alias("commutator", "structure constants", "brackets"))]
    pub fn structure_constants(&self) -> &Tensor<S> {
        self.frame.structure_functions()
    }

    /// The matrix of `[n, .]`: `(ad_n)^i_k = c^i_jk n^j`, slots `[Up, Down]`.
    ///
    /// ```
    /// use affinor::algebra::catalogue;
    /// use affinor::Rational;
    /// let so3 = catalogue::algebra::<Rational>("so(3)")?;
    /// let ad = so3.ad(&[1, 0, 0].map(Rational::from))?;
    /// // [e1, e2] = e3
    /// assert_eq!(ad.get(&[2, 1]), 1.into());
    /// # Ok::<(), affinor::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::Shape`] unless `n` has as many components as the algebra.
    #[doc(alias("adjoint representation"))]
    pub fn ad(&self, n: &[S]) -> Result<Tensor<S>, Error> {
        ad(self.structure_constants(), n)
    }

    /// The bracket of two vectors, `[x, y]^i = c^i_jk x^j y^k`.
    ///
    /// ```
    /// use affinor::algebra::catalogue;
    /// use affinor::Rational;
    /// let so3 = catalogue::algebra::<Rational>("so(3)")?;
    /// let [x, y] = [[1, 0, 0], [0, 1, 0]].map(|v| v.map(Rational::from));
    /// assert_eq!(so3.bracket(&x, &y)?, [0, 0, 1].map(Rational::from));
    /// # Ok::<(), affinor::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::Shape`] unless `x` and `y` have as many components as the algebra.
    #[doc(alias("commutator"))]
    pub fn bracket(&self, x: &[S], y: &[S]) -> Result<Vec<S>, Error> {
        let (ad, y) = (self.ad(x)?, self.vector(y)?);
        let bracket = formula("a^i_k y^k -> ^i", &[("a", &ad), ("y", &y)]);
        Ok(bracket.to_vector().expect("a tensor of rank 1"))
    }

    /// The Killing form `K_ij = c^m_il c^l_jm = tr(ad_i ad_j)`, slots `[Down, Down]`.
    ///
    /// ```
    /// use affinor::algebra::catalogue;
    /// use affinor::Rational;
    /// let so3 = catalogue::algebra::<Rational>("so(3)")?;
    /// // -2 times the identity
    /// assert_eq!(so3.killing_form().get(&[0, 0]), (-2).into());
    /// # Ok::<(), affinor::Error>(())
    /// ```
    #[doc(alias("Cartan-Killing form"))]
    pub fn killing_form(&self) -> Tensor<S> {
        formula("c^m_il c^l_jm -> _ij", &[("c", self.structure_constants())])
    }

    /// The direct sum, in the basis of this algebra followed by the basis of `other`. If a label of
    /// `other` also occurs in this algebra, a prime is appended to it.
    ///
    /// ```
    /// use affinor::algebra::catalogue;
    /// use affinor::Rational;
    /// let so3 = catalogue::algebra::<Rational>("so(3)")?;
    /// let line = catalogue::algebra("R^1")?;
    /// assert_eq!(so3.direct_sum(&line)?.dimension(), 4);
    /// # Ok::<(), affinor::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::Tensor`] if the dimension of the sum is too large for the indices of a tensor, 64
    /// bits.
    #[doc(alias("direct product"))]
    pub fn direct_sum(&self, other: &Self) -> Result<Self, Error> {
        let (n, m) = (self.dimension(), other.dimension());
        let labels = join_labels(self.labels(), other.labels());
        let shifted = |by: usize| {
            move |(at, v): (affinor_tensors::Indices, &S)| {
                ([at[0] + by, at[1] + by, at[2] + by], v.clone())
            }
        };
        let mine = self.structure_constants().components().map(shifted(0));
        let theirs = other.structure_constants().components().map(shifted(n));
        let both = mine.chain(theirs);
        let structure = Tensor::from_components(n + m, &[Up, Down, Down], both)?;
        // no check is needed, because a direct sum of Lie algebras satisfies the Jacobi identity
        Ok(LieAlgebra { frame: Frame::invariant(labels, structure)? })
    }

    /// A vector of the algebra as a tensor.
    pub(crate) fn vector(&self, components: &[S]) -> Result<Tensor<S>, Error> {
        vector(self.structure_constants(), components)
    }

    /// The same algebra over another scalar type. The function `f` must be a homomorphism of rings.
    ///
    /// ```
    /// use affinor::algebra::catalogue;
    /// use affinor::Rational;
    /// let so3 = catalogue::algebra::<Rational>("so(3)")?;
    /// let floats = so3.map(Rational::to_f64)?;
    /// assert_eq!(floats.structure_constants().get(&[2, 0, 1]), 1.0);
    /// # Ok::<(), affinor::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Law::Jacobi`](crate::Law::Jacobi) or [`Law::Antisymmetry`](crate::Law::Antisymmetry) when
    /// `f` is not a homomorphism.
    #[doc(alias("convert scalars"))]
    pub fn map<T: Scalar>(&self, f: impl Fn(&S) -> T) -> Result<LieAlgebra<T>, Error> {
        Bracket::new(self.labels(), self.structure_constants().map(f))?.try_into()
    }
}

impl<S: Field + Scalar> LieAlgebra<S> {
    /// The same algebra in the basis `e'_a = A^i_a e_i`: `c' = A^-1 c (A, A)`.
    ///
    /// # Errors
    /// [`Error::Shape`] unless `A` has the dimension of the algebra.
    #[doc(alias("basis change"))]
    pub fn change_basis(&self, change: &BasisChange<S>) -> Result<Self, Error> {
        self.in_basis(change, (1..=self.dimension()).map(|a| format!("e{a}")))
    }

    /// The same algebra in another basis, whose vectors have these names.
    pub(crate) fn in_basis(
        &self,
        change: &BasisChange<S>,
        labels: impl IntoIterator<Item = String>,
    ) -> Result<Self, Error> {
        let structure = change.apply(self.structure_constants())?;
        // the Jacobi identity is not checked again: a change of basis preserves the identity, but
        // the check might fail because of rounding errors
        Ok(LieAlgebra { frame: Frame::invariant(labels, structure)? })
    }
}

/// The matrix of `[n, .]`. The structure constants have been checked before.
pub(crate) fn ad<S: Scalar>(structure: &Tensor<S>, n: &[S]) -> Result<Tensor<S>, Error> {
    let n = vector(structure, n)?;
    Ok(formula("c^i_jk n^j -> ^i_k", &[("c", structure), ("n", &n)]))
}

fn vector<S: Scalar>(structure: &Tensor<S>, components: &[S]) -> Result<Tensor<S>, Error> {
    let vector = Tensor::vector(components, Up).with_tolerance(structure.tolerance());
    crate::algebra::frame::expect_slots("the vector", &vector, structure.dimension(), &[Up])?;
    Ok(vector)
}

/// The labels of a direct sum: a label of `second` that also occurs before it is extended by
/// primes.
pub fn join_labels(first: &[String], second: &[String]) -> Vec<String> {
    let mut labels = first.to_vec();
    for label in second {
        let mut label = label.clone();
        while labels.contains(&label) {
            label.push('\'');
        }
        labels.push(label);
    }
    labels
}
