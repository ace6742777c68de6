//! Decompositions into irreducible representations.

use super::levi::{Components, Levi};
use super::packed::{Packing, Word};
use super::{Character, HighestWeight, ReductiveAlgebra, RepresentationError};
use affinor_tensors::stop::{checkpoint, stage};
use num_bigint::{BigInt, BigUint};
use num_traits::Zero;
use rustc_hash::FxHashMap;
use std::collections::HashMap;
use std::fmt;

/// The maximum number of different irreducible components.
const MAX_COMPONENTS: usize = 1 << 21;

/// The order of the Weyl group of a Levi subalgebra from which on the components of a restriction
/// cost less than all weights.
const LEVI_ORDER: f64 = 24.0;

/// Irreducible representations with their multiplicities, by highest weights in descending
/// lexicographic order.
///
/// ```
/// use affinor::representation::{HighestWeight, ReductiveAlgebra};
/// let su3: ReductiveAlgebra = "SU(3)".parse()?;
/// let quark = HighestWeight::new(&su3, [1, 0])?;
/// let product = quark.tensor(&quark.dual())?;
/// assert_eq!(product.to_string(), "1 + 8");
/// assert_eq!(product.dimension(), 9.into());
/// # Ok::<(), affinor::representation::RepresentationError>(())
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Decomposition {
    algebra: ReductiveAlgebra,
    components: Vec<(HighestWeight, i128)>,
}

impl Decomposition {
    /// One irreducible representation.
    pub fn irreducible(weight: &HighestWeight) -> Self {
        let components = vec![(weight.clone(), 1)];
        Decomposition { algebra: weight.algebra().clone(), components }
    }

    /// Decomposes the character with these weights and multiplicities. The weights are all weights
    /// of the representation; equal weights are added.
    ///
    /// # Errors
    /// [`RepresentationError::NotACharacter`] if the Weyl group does not preserve the weights or if
    /// an irreducible component would have a negative multiplicity;
    /// [`RepresentationError::Length`] if a weight has the wrong length.
    ///
    /// ```
    /// use affinor::representation::{Decomposition, ReductiveAlgebra};
    /// let su2: ReductiveAlgebra = "SU(2)".parse()?;
    /// let weights = [vec![2], vec![0], vec![0], vec![-2]].map(|weight| (weight, 1));
    /// assert_eq!(Decomposition::from_weights(&su2, weights)?.to_string(), "1 + 3");
    /// # Ok::<(), affinor::representation::RepresentationError>(())
    /// ```
    pub fn from_weights(
        algebra: &ReductiveAlgebra,
        weights: impl IntoIterator<Item = (Vec<i64>, i64)>,
    ) -> Result<Self, RepresentationError> {
        let mut all: HashMap<Vec<i64>, i128> = HashMap::new();
        for (weight, multiplicity) in weights {
            let (given, expected) = (weight.len(), algebra.rank());
            if given != expected {
                let algebra = algebra.to_string();
                return Err(RepresentationError::Length { given, expected, algebra });
            }
            *all.entry(weight).or_default() += i128::from(multiplicity);
        }
        all.retain(|_, multiplicity| *multiplicity != 0);
        let mut sum = Sum::new(algebra);
        let origin = HighestWeight::trivial(algebra);
        for (weight, &multiplicity) in &all {
            for i in 0..algebra.semisimple_rank() {
                let mut image = weight.clone();
                algebra.reflect(&mut image, i);
                if all.get(&image) != Some(&multiplicity) {
                    let reason = format!(
                        "the multiplicity of {weight:?} is {multiplicity}, but that of {image:?} is {}",
                        all.get(&image).unwrap_or(&0)
                    );
                    return Err(RepresentationError::NotACharacter { reason });
                }
            }
            sum.add_straightened(origin.labels(), weight, multiplicity);
        }
        sum.finish()?.effective()
    }

    pub(super) fn of(algebra: &ReductiveAlgebra, components: Vec<(HighestWeight, i128)>) -> Self {
        Decomposition { algebra: algebra.clone(), components }
    }

    /// The algebra.
    pub fn algebra(&self) -> &ReductiveAlgebra {
        &self.algebra
    }

    /// The irreducible representations with their multiplicities.
    pub fn components(&self) -> impl ExactSizeIterator<Item = (&HighestWeight, i128)> {
        self.components.iter().map(|(weight, multiplicity)| (weight, *multiplicity))
    }

    /// The multiplicity of an irreducible representation.
    pub fn multiplicity(&self, weight: &HighestWeight) -> i128 {
        let found = self.components.binary_search_by(|(w, _)| weight.labels().cmp(w.labels()));
        match found {
            Ok(at) if self.algebra == *weight.algebra() => self.components[at].1,
            _ => 0,
        }
    }

    /// The dimension.
    pub fn dimension(&self) -> BigInt {
        self.sum(1, |weight| vec![weight.dimension()]).remove(0)
    }

    /// The Dynkin index of each simple factor: the sum of the [indices](HighestWeight::index) of
    /// the components.
    pub fn index(&self) -> Vec<BigInt> {
        self.sum(self.algebra.simple_factors().len(), HighestWeight::index)
    }

    fn sum(&self, n: usize, value: impl Fn(&HighestWeight) -> Vec<BigUint>) -> Vec<BigInt> {
        let mut sums = vec![BigInt::zero(); n];
        for (weight, multiplicity) in &self.components {
            checkpoint();
            for (sum, value) in sums.iter_mut().zip(value(weight)) {
                *sum += BigInt::from(value) * BigInt::from(*multiplicity);
            }
        }
        sums
    }

    /// The sum of the characters of the components.
    ///
    /// # Errors
    /// [`RepresentationError::TooLarge`] if the number of dominant weights or the multiplicities
    /// exceed the limits.
    pub fn character(&self) -> Result<Character, RepresentationError> {
        let mut weights: HashMap<Vec<i64>, i128> = HashMap::new();
        for (component, multiplicity) in &self.components {
            for (weight, m) in component.character()?.dominant_weights() {
                *weights.entry(weight.to_vec()).or_default() += m * multiplicity;
            }
        }
        let mut weights: Vec<_> = weights.into_iter().filter(|(_, m)| *m != 0).collect();
        weights.sort_by(|a, b| b.0.cmp(&a.0));
        Ok(Character::of(&self.algebra, weights))
    }

    /// The decomposition if all multiplicities are positive.
    pub(super) fn effective(self) -> Result<Self, RepresentationError> {
        match self.components.iter().find(|(_, multiplicity)| *multiplicity < 0) {
            None => Ok(self),
            Some((weight, multiplicity)) => Err(RepresentationError::NotACharacter {
                reason: format!("the multiplicity of {weight} would be {multiplicity}"),
            }),
        }
    }
}

impl fmt::Display for Decomposition {
    /// The components by dimension, such as `1 + 2 (8) + 10`. Components without a
    /// [name](super::names::name) are written by their labels.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let names = super::names::names(self.components.iter().map(|(weight, _)| weight));
        let mut components: Vec<_> = self
            .components()
            .zip(names)
            .map(|((weight, m), name)| (weight.dimension(), weight, m, name))
            .collect();
        components.sort_by(|a, b| a.0.cmp(&b.0));
        let terms = components.into_iter().map(|(_, weight, multiplicity, name)| {
            let name = name.unwrap_or_else(|| weight.to_string());
            if multiplicity == 1 { name } else { format!("{multiplicity} ({name})") }
        });
        let terms: Vec<String> = terms.collect();
        f.write_str(if terms.is_empty() { "0" } else { "" })?;
        f.write_str(&terms.join(" + "))
    }
}

/// A sum of products of irreducible representations with characters, in the ring of virtual
/// representations.
pub(super) struct Sum {
    algebra: ReductiveAlgebra,
    multiplicities: HashMap<Vec<i64>, i128>,
    buffer: Vec<i64>,
    /// A bound of the absolute values of all multiplicities.
    bound: BigInt,
    full: bool,
}

impl Sum {
    pub fn new(algebra: &ReductiveAlgebra) -> Self {
        Sum {
            algebra: algebra.clone(),
            multiplicities: HashMap::new(),
            buffer: vec![],
            bound: BigInt::zero(),
            full: false,
        }
    }

    /// Adds `factor` times the product of an irreducible representation `λ` with a character, by
    /// the formula of Brauer and Klimyk. Each weight `ν` contributes to the representation
    /// `w(λ + ν + ρ) - ρ` its multiplicity, times the sign of `w`.
    ///
    /// The rows of `projection` map the weights of the character to labels of weights of the
    /// algebra; by default both algebras are the same.
    ///
    /// # Errors
    /// [`RepresentationError::TooLarge`] if the multiplicities may exceed 128 bits, or if the
    /// number of components exceeds the limit.
    pub fn add_product(
        &mut self,
        base: &HighestWeight,
        factor: i128,
        character: &Character,
        projection: Option<&[Vec<i64>]>,
    ) -> Result<(), RepresentationError> {
        let absolute = |m: i128| BigInt::from(m.unsigned_abs());
        let sizes = character
            .dominant_weights()
            .map(|(weight, m)| BigInt::from(character.algebra().orbit_size(weight)) * absolute(m));
        self.bound += sizes.fold(BigInt::zero(), |sum, size| sum + size) * absolute(factor);
        if self.bound.bits() > 126 {
            return Err(RepresentationError::TooLarge {
                what: "the bound of the multiplicities".into(),
                limit: "the 128-bit integers".into(),
            });
        }
        let done = if projection.is_none()
            && let Some((target, components)) = restricted(base, character, LEVI_ORDER)
        {
            self.add_components(&target, base, factor, &components)
        } else if let Some(packed) = Packed::<u64>::new(base, character, projection) {
            self.add_weights(&packed, base, factor, character)
        } else if let Some(packed) = Packed::<u128>::new(base, character, projection) {
            self.add_weights(&packed, base, factor, character)
        } else {
            self.add_listed(base, factor, character, projection)
        };
        done.ok_or_else(|| RepresentationError::TooLarge {
            what: "the number of components".into(),
            limit: MAX_COMPONENTS.to_string(),
        })
    }

    /// [`add_product`](Self::add_product) for labels of any size; `None` for too many components.
    fn add_listed(
        &mut self,
        base: &HighestWeight,
        factor: i128,
        character: &Character,
        projection: Option<&[Vec<i64>]>,
    ) -> Option<()> {
        let mut image = vec![0; self.algebra.rank()];
        for (weight, multiplicity) in character.dominant_weights() {
            character.algebra().for_each_in_orbit(weight, |weight| {
                if !self.full {
                    project(projection, weight, &mut image);
                    self.add_straightened(base.labels(), &image, multiplicity * factor);
                }
            });
        }
        (!self.full).then_some(())
    }

    /// The same for packed weights.
    fn add_weights<W: Word>(
        &mut self,
        packed: &Packed<W>,
        base: &HighestWeight,
        factor: i128,
        character: &Character,
    ) -> Option<()> {
        let Packed { source, target, projection, steps } = packed;
        let rank = self.algebra.semisimple_rank();
        let mut sums: FxHashMap<W, i128> = FxHashMap::default();
        let mut image = vec![0; self.algebra.rank()];
        for (weight, multiplicity) in character.dominant_weights() {
            project(*projection, weight, &mut image);
            image.iter_mut().zip(base.labels()).for_each(|(label, base)| *label += base);
            image[..rank].iter_mut().for_each(|label| *label += 1);
            let multiplicity = multiplicity * factor;
            let mut visited = 0u32;
            source.for_each_image(source.weight(weight), target.weight(&image), steps, |image| {
                visited = visited.wrapping_add(1);
                if visited.is_multiple_of(1024) {
                    checkpoint();
                }
                if let Some((weight, odd)) = target.straighten(image)
                    && sums.len() <= MAX_COMPONENTS
                {
                    *sums.entry(weight).or_default() +=
                        if odd { -multiplicity } else { multiplicity };
                }
            });
            checkpoint();
        }
        self.add_packed_sums(target, sums)
    }

    /// The same for the components of the restriction of the character to the Levi subalgebra that
    /// stabilizes the weight.
    fn add_components(
        &mut self,
        target: &Packing<u128>,
        base: &HighestWeight,
        factor: i128,
        components: &[(u128, i128)],
    ) -> Option<()> {
        let rank = self.algebra.semisimple_rank();
        let shift = base.labels().iter().enumerate().map(|(i, l)| l + i64::from(i < rank));
        let shift = target.vector(&shift.collect::<Vec<_>>());
        let mut sums: FxHashMap<u128, i128> = FxHashMap::default();
        for &(weight, multiplicity) in components {
            checkpoint();
            if let Some((weight, odd)) = target.straighten(weight.wrapping_add(shift)) {
                let multiplicity = multiplicity * factor;
                *sums.entry(weight).or_default() += if odd { -multiplicity } else { multiplicity };
            }
        }
        self.add_packed_sums(target, sums)
    }

    fn add_packed_sums<W: Word>(
        &mut self,
        target: &Packing<W>,
        sums: FxHashMap<W, i128>,
    ) -> Option<()> {
        for (weight, sum) in sums {
            *self.multiplicities.entry(target.labels(weight)).or_default() += sum;
        }
        self.full |= self.multiplicities.len() > MAX_COMPONENTS;
        (!self.full).then_some(())
    }

    #[inline]
    fn add_straightened(&mut self, base: &[i64], weight: &[i64], multiplicity: i128) {
        let rank = self.algebra.semisimple_rank();
        self.buffer.clear();
        self.buffer.extend(base.iter().zip(weight).map(|(b, w)| b + w));
        self.buffer[..rank].iter_mut().for_each(|label| *label += 1);
        let sign = self.algebra.straighten(&mut self.buffer);
        if sign == 0 {
            return;
        }
        match self.multiplicities.get_mut(&self.buffer) {
            Some(sum) => *sum += sign * multiplicity,
            None => {
                self.multiplicities.insert(self.buffer.clone(), sign * multiplicity);
                self.full |= self.multiplicities.len() > MAX_COMPONENTS;
            }
        }
    }

    /// The sum.
    ///
    /// # Errors
    /// [`RepresentationError::LargeLabel`] if a label exceeds the limit.
    pub fn finish(self) -> Result<Decomposition, RepresentationError> {
        self.divided(1)
    }

    /// The sum, divided by an integer that divides all its multiplicities.
    ///
    /// # Errors
    /// [`RepresentationError::LargeLabel`] if a label exceeds the limit.
    pub fn divided(self, divisor: i128) -> Result<Decomposition, RepresentationError> {
        let _stage = stage("components");
        let rank = self.algebra.semisimple_rank();
        let mut components = vec![];
        for (mut labels, multiplicity) in self.multiplicities {
            if multiplicity != 0 {
                labels[..rank].iter_mut().for_each(|label| *label -= 1);
                components
                    .push((HighestWeight::new(&self.algebra, labels)?, multiplicity / divisor));
            }
        }
        components.sort_by(|a, b| b.0.labels().cmp(a.0.labels()));
        Ok(Decomposition::of(&self.algebra, components))
    }
}

/// A product of a representation with a character whose weights fit into packed integers.
struct Packed<'p, W> {
    /// The algebra of the character.
    source: Packing<W>,
    /// The algebra of the sum.
    target: Packing<W>,
    projection: Option<&'p [Vec<i64>]>,
    /// The images of the simple roots.
    steps: Vec<W>,
}

impl<'p, W: Word> Packed<'p, W> {
    /// The layouts, if all labels fit.
    fn new(
        base: &HighestWeight,
        character: &Character,
        projection: Option<&'p [Vec<i64>]>,
    ) -> Option<Self> {
        let (from, to) = (character.algebra(), base.algebra());
        let largest = largest_label(character)?;
        let source = Packing::new(from, largest)?;
        let shift = base.labels().iter().map(|label| label.abs() + 1).collect::<Vec<_>>();
        let image: Vec<i64> = match projection {
            None => vec![largest; to.rank()],
            Some(rows) => rows
                .iter()
                .map(|row| row.iter().map(|entry| entry.abs()).sum::<i64>().checked_mul(largest))
                .collect::<Option<_>>()?,
        };
        let bound = match projection {
            None => bound_of_product(base, largest)?,
            Some(_) => {
                let sum: Vec<i64> =
                    image.iter().zip(&shift).map(|(i, s)| i.saturating_add(*s)).collect();
                to.largest_label(&sum)
            }
        };
        let target = Packing::new(to, bound)?;
        let mut steps = vec![];
        let mut image = vec![0; to.rank()];
        for i in 0..from.semisimple_rank() {
            project(projection, &from.simple_root(i), &mut image);
            steps.push(target.vector(&image));
        }
        Some(Packed { source, target, projection, steps })
    }
}

/// The components of the restriction of a character to the Levi subalgebra that stabilizes a
/// weight, in packed weights. `None` if they do not fit, or if the Weyl group of the subalgebra is
/// smaller than `order`.
fn restricted(
    base: &HighestWeight,
    character: &Character,
    order: f64,
) -> Option<(Packing<u128>, Components)> {
    let bound = bound_of_product(base, largest_label(character)?)?;
    let target = Packing::new(base.algebra(), bound)?;
    let levi = Levi::stabilizing(base, &target).filter(|levi| levi.order() >= order)?;
    let components = levi.components(character)?;
    Some((target, components))
}

/// The largest label of a weight of a character.
fn largest_label(character: &Character) -> Option<i64> {
    let algebra = character.algebra();
    character.dominant_weights().map(|(weight, _)| algebra.largest_label(weight)).max()
}

/// A bound of the labels in the formula of a product with a character: the largest label of the
/// orbit of `λ + ρ`, plus the largest label of the character.
fn bound_of_product(base: &HighestWeight, largest: i64) -> Option<i64> {
    let shift: Vec<i64> = base.labels().iter().map(|label| label.abs() + 1).collect();
    base.algebra().largest_label(&shift).checked_add(largest)
}

/// The image of a weight: the weight itself, or a product with the rows of a projection.
fn project(projection: Option<&[Vec<i64>]>, weight: &[i64], image: &mut [i64]) {
    match projection {
        None => image.copy_from_slice(weight),
        Some(rows) => {
            for (label, row) in image.iter_mut().zip(rows) {
                *label = row.iter().zip(weight).map(|(entry, w)| entry * w).sum();
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{Packed, Sum, Word, restricted};
    use crate::representation::{HighestWeight, ReductiveAlgebra, Subalgebra};

    /// Packed and listed weights have the same sums: products, with charges as well, and
    /// restrictions, in lanes of 62 bits (rank 1) to 4 bits (rank 16 in a `u64`).
    #[test]
    fn packed_sums_are_those_of_lists() -> Result<(), Box<dyn std::error::Error>> {
        fn compare<W: Word>(
            base: &HighestWeight,
            weight: &HighestWeight,
            rows: Option<&[Vec<i64>]>,
        ) -> Option<()> {
            let character = weight.character().ok()?;
            let packed = Packed::<W>::new(base, &character, rows)?;
            let sum = |add: &dyn Fn(&mut Sum) -> Option<()>| {
                let mut sum = Sum::new(base.algebra());
                add(&mut sum)?;
                sum.multiplicities.retain(|_, m| *m != 0);
                Some(sum.multiplicities)
            };
            let listed = sum(&|sum| sum.add_listed(base, -3, &character, rows))?;
            assert!(!listed.is_empty());
            let weights = sum(&|sum| sum.add_weights(&packed, base, -3, &character))?;
            assert_eq!(weights, listed, "{base} x {weight}");
            if rows.is_none() {
                // a Levi subalgebra of any order
                let (target, components) = restricted(base, &character, 0.0)?;
                let components = sum(&|sum| sum.add_components(&target, base, -3, &components))?;
                assert_eq!(components, listed, "{base} x {weight}");
            }
            Some(())
        }
        let (mut short, mut all) = (0, 0);
        let mut both = |base: &HighestWeight, weight: &HighestWeight, rows: Option<&[Vec<i64>]>| {
            all += 1;
            short += usize::from(compare::<u64>(base, weight, rows).is_some());
            assert!(compare::<u128>(base, weight, rows).is_some(), "{base} x {weight} fits");
        };
        for (name, one, other) in [
            ("A1", "[7]", "[12]"),
            ("A1", "[0]", "[12]"),
            ("G2", "[0,4]", "[3,2]"),
            ("G2", "[4,0]", "[3,2]"),
            ("F4", "[0,0,2,0]", "[1,0,1,1]"),
            ("C4", "[0,0,3,0]", "[2,1,0,1]"),
            ("D4", "[0,0,0,0]", "[1,1,0,2]"),
            ("E7", "[0,0,0,2,0,0,0]", "[1,0,0,0,0,1,0]"),
            ("B3 + T1 + C3", "[0,0,1,5,0,2,0]", "[1,1,0,1,0,1,-2]"),
            ("G2", "[3,1]", "[1,2]"),
            ("B3", "[0,2,1]", "[2,0,1]"),
            ("C4", "[1,0,0,2]", "[0,1,0,1]"),
            ("D5", "[1,1,0,1,0]", "[0,0,1,0,2]"),
            ("F4", "[1,0,0,1]", "[0,1,0,1]"),
            ("E6", "[1,1,0,0,0,0]", "[0,0,0,1,0,0]"),
            ("A9", "[1,0,1,0,0,0,0,0,1]", "[0,2,0,0,0,0,0,1,0]"),
            ("A2 + A1 + T1", "[1,1,2,-5]", "[2,0,1,7]"),
            ("D8 + E8", "[0,1,0,0,0,0,0,0,0,0,0,0,0,0,0,0]", "[0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,1]"),
        ] {
            let algebra: ReductiveAlgebra = name.parse()?;
            let weight = |text| HighestWeight::parse(&algebra, text);
            both(&weight(one)?, &weight(other)?, None);
        }
        for (name, weight, subalgebra) in [
            ("E6", "[1,1,0,0,0,1]", "levi 4"),
            ("E7", "[1,0,0,0,0,0,1]", "extended 2"),
            ("F4", "[1,0,1,0]", "principal"),
            ("A4", "[2,1,0,1]", "levi 2,3"),
        ] {
            let algebra: ReductiveAlgebra = name.parse()?;
            let subalgebra = Subalgebra::parse(&algebra, subalgebra)?;
            let origin = HighestWeight::trivial(subalgebra.algebra());
            both(&origin, &HighestWeight::parse(&algebra, weight)?, Some(subalgebra.projection()));
        }
        // 64 bits are too short for some of them only
        assert!(10 < short && short < all, "{short} of {all}");
        // labels that do not fit into 7 bits
        let large: ReductiveAlgebra = "D8 + D8".parse()?;
        let mut labels = vec![0; 16];
        labels[0] = 130;
        let large = HighestWeight::new(&large, labels)?;
        let trivial = HighestWeight::trivial(large.algebra()).character()?;
        assert!(Packed::<u128>::new(&large, &trivial, None).is_none());
        assert_eq!(
            large.tensor(&HighestWeight::trivial(large.algebra()))?.to_string(),
            large.to_string()
        );
        Ok(())
    }
}
