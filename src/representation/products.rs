//! Tensor products.

use super::decomposition::Sum;
use super::{Decomposition, HighestWeight, RepresentationError};
use affinor_tensors::stop::stage;

impl HighestWeight {
    /// The tensor product with another irreducible representation of the same algebra, by the
    /// formula of Brauer and Klimyk on the weights of the smaller factor.
    ///
    /// # Errors
    /// [`RepresentationError::DifferentAlgebras`] for representations of different algebras;
    /// [`RepresentationError::TooLarge`] if a character or the product exceeds the limits.
    ///
    /// ```
    /// use affinor::representation::{HighestWeight, ReductiveAlgebra};
    /// let g2: ReductiveAlgebra = "G2".parse()?;
    /// let seven = HighestWeight::new(&g2, [1, 0])?;
    /// assert_eq!(seven.tensor(&seven)?.to_string(), "1 + 7 + 14 + 27");
    /// # Ok::<(), affinor::representation::RepresentationError>(())
    /// ```
    pub fn tensor(&self, other: &Self) -> Result<Decomposition, RepresentationError> {
        Decomposition::irreducible(self).tensor(&Decomposition::irreducible(other))
    }
}

impl Decomposition {
    /// The tensor product with another representation of the same algebra.
    ///
    /// # Errors
    /// [`RepresentationError::DifferentAlgebras`] for representations of different algebras;
    /// [`RepresentationError::TooLarge`] if a character or the product exceeds the limits.
    ///
    /// ```
    /// use affinor::representation::{HighestWeight, ReductiveAlgebra};
    /// use affinor::representation::Decomposition;
    /// let e6: ReductiveAlgebra = "E6".parse()?;
    /// let v = Decomposition::irreducible(&HighestWeight::parse(&e6, "27")?);
    /// let cube = v.tensor(&v)?.tensor(&v)?;
    /// assert_eq!(cube.dimension(), (27 * 27 * 27).into());
    /// assert_eq!(cube.multiplicity(&HighestWeight::trivial(&e6)), 1);
    /// # Ok::<(), affinor::representation::RepresentationError>(())
    /// ```
    pub fn tensor(&self, other: &Self) -> Result<Self, RepresentationError> {
        if self.algebra() != other.algebra() {
            return Err(RepresentationError::DifferentAlgebras {
                left: self.algebra().to_string(),
                right: other.algebra().to_string(),
            });
        }
        let (small, large) =
            if self.dimension() <= other.dimension() { (self, other) } else { (other, self) };
        let character = small.character()?;
        let _stage = stage("product");
        let mut sum = Sum::new(self.algebra());
        for (weight, multiplicity) in large.components() {
            sum.add_product(weight, multiplicity, &character, None)?;
        }
        sum.finish()
    }

    /// The direct sum with a multiple of another representation of the same algebra.
    ///
    /// # Errors
    /// [`RepresentationError::DifferentAlgebras`] for representations of different algebras.
    pub fn plus(&self, other: &Self, multiple: i128) -> Result<Self, RepresentationError> {
        if self.algebra() != other.algebra() {
            return Err(RepresentationError::DifferentAlgebras {
                left: self.algebra().to_string(),
                right: other.algebra().to_string(),
            });
        }
        let mut all: std::collections::BTreeMap<Vec<i64>, i128> = Default::default();
        for (part, factor) in [(self, 1), (other, multiple)] {
            for (weight, multiplicity) in part.components() {
                *all.entry(weight.labels().to_vec()).or_default() += factor * multiplicity;
            }
        }
        let components = all.into_iter().rev().filter(|(_, multiplicity)| *multiplicity != 0);
        let weights = components.map(|(labels, m)| (HighestWeight::of(self.algebra(), labels), m));
        Ok(Self::of(self.algebra(), weights.collect()))
    }
}
