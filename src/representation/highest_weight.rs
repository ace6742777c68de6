//! Irreducible representations, given by their highest weights.

use super::{ReductiveAlgebra, RepresentationError};
use crate::representation::algebra::PositiveRoot;
use affinor_tensors::Rational;
use num_bigint::BigUint;
use num_rational::BigRational;
use num_traits::One;
use std::fmt;

/// The largest absolute value of a label or a charge.
pub const MAX_LABEL: i64 = 1 << 31;

/// An irreducible representation of a reductive algebra, given by its highest weight.
///
/// ```
/// use affinor::representation::{HighestWeight, ReductiveAlgebra};
/// let e8: ReductiveAlgebra = "E8".parse()?;
/// let weight = HighestWeight::new(&e8, [1, 0, 0, 0, 0, 0, 0, 1])?;
/// assert_eq!(weight.dimension(), 779_247u32.into());
/// # Ok::<(), affinor::representation::RepresentationError>(())
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct HighestWeight {
    algebra: ReductiveAlgebra,
    labels: Vec<i64>,
}

impl HighestWeight {
    /// The representation with these Dynkin labels and charges.
    ///
    /// # Errors
    /// [`RepresentationError::Length`] if the number of labels is not the rank,
    /// [`RepresentationError::NotDominant`] if a Dynkin label is negative,
    /// [`RepresentationError::LargeLabel`] if a label exceeds [`MAX_LABEL`].
    pub fn new(
        algebra: &ReductiveAlgebra,
        labels: impl Into<Vec<i64>>,
    ) -> Result<Self, RepresentationError> {
        let labels = labels.into();
        if labels.len() != algebra.rank() {
            return Err(RepresentationError::Length {
                given: labels.len(),
                expected: algebra.rank(),
                algebra: algebra.to_string(),
            });
        }
        for (at, &label) in labels.iter().enumerate() {
            if at < algebra.semisimple_rank() && label < 0 {
                return Err(RepresentationError::NotDominant { position: at + 1, label });
            }
            if label.unsigned_abs() > MAX_LABEL.unsigned_abs() {
                let limit = MAX_LABEL;
                return Err(RepresentationError::LargeLabel { position: at + 1, label, limit });
            }
        }
        Ok(HighestWeight { algebra: algebra.clone(), labels })
    }

    /// A weight that is dominant by construction.
    pub(super) fn of(algebra: &ReductiveAlgebra, labels: Vec<i64>) -> Self {
        HighestWeight { algebra: algebra.clone(), labels }
    }

    /// The trivial representation.
    pub fn trivial(algebra: &ReductiveAlgebra) -> Self {
        Self::of(algebra, vec![0; algebra.rank()])
    }

    /// The adjoint representations of the simple factors.
    ///
    /// ```
    /// use affinor::representation::{HighestWeight, ReductiveAlgebra};
    /// let algebra: ReductiveAlgebra = "A2 + A1".parse()?;
    /// let adjoint = HighestWeight::adjoint(&algebra);
    /// assert_eq!(adjoint[0].labels(), [1, 1, 0]);
    /// assert_eq!(adjoint[1].labels(), [0, 0, 2]);
    /// # Ok::<(), affinor::representation::RepresentationError>(())
    /// ```
    pub fn adjoint(algebra: &ReductiveAlgebra) -> Vec<Self> {
        let highest = |factor| algebra.roots_of(factor).last().map(|root| root.labels.clone());
        let factors = 0..algebra.simple_factors().len();
        let labels = factors.filter_map(highest).map(|mut labels| {
            labels.resize(algebra.rank(), 0);
            labels
        });
        labels.map(|labels| Self::of(algebra, labels)).collect()
    }

    /// The algebra.
    pub fn algebra(&self) -> &ReductiveAlgebra {
        &self.algebra
    }

    /// The Dynkin labels of the simple factors in order, then the charges.
    pub fn labels(&self) -> &[i64] {
        &self.labels
    }

    /// The dimension: the product of `<λ + ρ, α^∨> / <ρ, α^∨>` over the positive roots `α` (Weyl).
    pub fn dimension(&self) -> BigUint {
        self.dimension_over(self.algebra.positive_roots())
    }

    /// The dimension of the representation of a simple factor.
    pub(super) fn factor_dimension(&self, factor: usize) -> BigUint {
        self.dimension_over(self.algebra.roots_of(factor))
    }

    fn dimension_over<'r>(&self, roots: impl IntoIterator<Item = &'r PositiveRoot>) -> BigUint {
        let (mut above, mut below) = (Product::default(), Product::default());
        for root in roots {
            let height: i64 = root.coroot.iter().sum();
            let value: i64 = root.coroot.iter().zip(&self.labels).map(|(c, label)| c * label).sum();
            if value > 0 {
                above.multiply((value + height).unsigned_abs());
                below.multiply(height.unsigned_abs());
            }
        }
        above.value() / below.value()
    }

    /// The dual representation: its highest weight is `-w_0(λ)`, with the longest element `w_0` of
    /// the Weyl group.
    ///
    /// ```
    /// use affinor::representation::{HighestWeight, ReductiveAlgebra};
    /// let e6: ReductiveAlgebra = "E6".parse()?;
    /// let weight = HighestWeight::new(&e6, [1, 0, 0, 0, 0, 0])?;
    /// assert_eq!(weight.dual().labels(), [0, 0, 0, 0, 0, 1]);
    /// # Ok::<(), affinor::representation::RepresentationError>(())
    /// ```
    pub fn dual(&self) -> Self {
        let mut labels: Vec<i64> = self.labels.iter().map(|label| -label).collect();
        self.algebra.make_dominant(&mut labels);
        Self::of(&self.algebra, labels)
    }

    /// The Casimir eigenvalue of each simple factor: `(λ, λ + 2ρ)`, where long roots have squared
    /// length 2. The adjoint representation has twice the dual Coxeter number. Divide by this
    /// number for the Casimir element of the Killing form.
    ///
    /// ```
    /// use affinor::Rational;
    /// use affinor::representation::{HighestWeight, ReductiveAlgebra};
    /// let su3: ReductiveAlgebra = "SU(3)".parse()?;
    /// let quark = HighestWeight::new(&su3, [1, 0])?;
    /// assert_eq!(quark.casimir(), [Rational::new(8, 3).unwrap()]);
    /// # Ok::<(), affinor::representation::RepresentationError>(())
    /// ```
    pub fn casimir(&self) -> Vec<Rational> {
        let factors = 0..self.algebra.simple_factors().len();
        factors.map(|factor| self.casimir_of(factor)).collect()
    }

    fn casimir_of(&self, factor: usize) -> Rational {
        let (above, below) = self.casimir_ratio(factor);
        BigRational::new(above.into(), below.into()).into()
    }

    /// The numerator and the denominator of a Casimir eigenvalue, with common factors.
    ///
    /// The sum of `<λ, α^∨><μ, α^∨>` over the positive roots is invariant under the Weyl group, so
    /// it is a multiple of `(λ, μ)`. The highest root, with squared length 2, fixes the multiple.
    fn casimir_ratio(&self, factor: usize) -> (BigUint, BigUint) {
        let form = |left: &[i64], right: &[i64]| {
            let products = self.algebra.roots_of(factor).map(|root| {
                let pair = |w: &[i64]| root.coroot.iter().zip(w).map(|(c, l)| c * l).sum::<i64>();
                i128::from(pair(left)) * i128::from(pair(right))
            });
            BigUint::from(products.sum::<i128>().unsigned_abs())
        };
        let highest = self.algebra.roots_of(factor).last().map_or(&[][..], |root| &root.labels);
        let shifted: Vec<i64> = self.labels.iter().map(|label| label + 2).collect();
        (form(&self.labels, &shifted) * 2u32, form(highest, highest))
    }

    /// The Dynkin index of each simple factor: `dim V/dim g_i` times the Casimir eigenvalue. It is
    /// an integer: 1 for the defining representation of `SU(n)`, twice the dual Coxeter number for
    /// the adjoint representation.
    ///
    /// ```
    /// use affinor::representation::{HighestWeight, ReductiveAlgebra};
    /// let su5: ReductiveAlgebra = "SU(5)".parse()?;
    /// assert_eq!(HighestWeight::new(&su5, [0, 1, 0, 0])?.index(), [3u32.into()]);
    /// # Ok::<(), affinor::representation::RepresentationError>(())
    /// ```
    pub fn index(&self) -> Vec<BigUint> {
        self.index_for_dimension(&self.dimension())
    }

    /// The [index](Self::index), for a dimension that is known.
    pub fn index_for_dimension(&self, dimension: &BigUint) -> Vec<BigUint> {
        let factors = self.algebra.simple_factors().iter().enumerate();
        factors
            .map(|(at, factor)| {
                let (above, below) = self.casimir_ratio(at);
                above * dimension / (below * factor.dimension())
            })
            .collect()
    }
}

impl fmt::Display for HighestWeight {
    /// The labels in brackets, such as `[0,1,0,0]`.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let labels: Vec<String> = self.labels.iter().map(ToString::to_string).collect();
        write!(f, "[{}]", labels.join(","))
    }
}

/// A product of machine integers; big integers are multiplied only when a word is full.
struct Product {
    big: BigUint,
    word: u64,
}

impl Default for Product {
    fn default() -> Self {
        Product { big: BigUint::one(), word: 1 }
    }
}

impl Product {
    fn multiply(&mut self, factor: u64) {
        match self.word.checked_mul(factor) {
            Some(word) => self.word = word,
            None => {
                self.big *= self.word;
                self.word = factor;
            }
        }
    }

    fn value(self) -> BigUint {
        self.big * self.word
    }
}
