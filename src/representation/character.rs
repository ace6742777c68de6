//! Characters of representations: dominant weights with their multiplicities.

use super::{HighestWeight, ReductiveAlgebra, RepresentationError};
use affinor_tensors::stop::{checkpoint, stage};
use num_bigint::{BigInt, BigUint};
use num_traits::Zero;
use rustc_hash::FxHashMap;
use std::collections::HashMap;

/// The maximum number of dominant weights of a character.
const MAX_WEIGHTS: usize = 1 << 20;

/// The weights of a representation with their multiplicities. The Weyl group permutes the weights,
/// so only the dominant weights are stored.
///
/// ```
/// use affinor::representation::{HighestWeight, ReductiveAlgebra};
/// let su3: ReductiveAlgebra = "SU(3)".parse()?;
/// let octet = HighestWeight::new(&su3, [1, 1])?.character()?;
/// let weights: Vec<_> = octet.dominant_weights().collect();
/// assert_eq!(weights, [(&[1, 1][..], 1), (&[0, 0][..], 2)]);
/// assert_eq!(octet.dimension(), 8.into());
/// # Ok::<(), affinor::representation::RepresentationError>(())
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Character {
    algebra: ReductiveAlgebra,
    weights: Vec<(Vec<i64>, i128)>,
}

impl Character {
    pub(super) fn of(algebra: &ReductiveAlgebra, weights: Vec<(Vec<i64>, i128)>) -> Self {
        Character { algebra: algebra.clone(), weights }
    }

    /// The algebra.
    pub fn algebra(&self) -> &ReductiveAlgebra {
        &self.algebra
    }

    /// The dominant weights with their multiplicities; for an irreducible representation the
    /// highest weight comes first.
    pub fn dominant_weights(&self) -> impl ExactSizeIterator<Item = (&[i64], i128)> {
        self.weights.iter().map(|(weight, multiplicity)| (&weight[..], *multiplicity))
    }

    /// The number of different weights.
    pub fn weight_count(&self) -> BigUint {
        self.weights.iter().map(|(weight, _)| self.algebra.orbit_size(weight)).sum()
    }

    /// The dimension: the sum of the multiplicities of all weights.
    pub fn dimension(&self) -> BigInt {
        let orbit = |weight: &[i64]| BigInt::from(self.algebra.orbit_size(weight));
        let terms = self.weights.iter().map(|(weight, m)| orbit(weight) * BigInt::from(*m));
        terms.fold(BigInt::zero(), |sum, term| sum + term)
    }

    /// The Adams operation `ψ^k`: each weight is multiplied by `k`.
    pub(super) fn adams(&self, k: i64) -> Self {
        let scaled = |weight: &Vec<i64>| weight.iter().map(|label| label * k).collect();
        let weights = self.weights.iter().map(|(weight, m)| (scaled(weight), *m));
        Self::of(&self.algebra, weights.collect())
    }

    /// Visits all weights with their multiplicities, without storing them.
    ///
    /// ```
    /// use affinor::representation::HighestWeight;
    /// let triplet = HighestWeight::parse(&"SU(3)".parse()?, "3")?.character()?;
    /// let mut weights = vec![];
    /// triplet.for_each_weight(|weight, _| weights.push(weight.to_vec()));
    /// assert_eq!(weights, [[1, 0], [-1, 1], [0, -1]]);
    /// # Ok::<(), affinor::representation::RepresentationError>(())
    /// ```
    pub fn for_each_weight(&self, mut visit: impl FnMut(&[i64], i128)) {
        for (weight, multiplicity) in &self.weights {
            self.algebra.for_each_in_orbit(weight, |weight| visit(weight, *multiplicity));
        }
    }
}

impl HighestWeight {
    /// The dominant weights with their multiplicities, by Freudenthal's formula
    ///
    /// ```text
    /// ((λ+ρ)² - (μ+ρ)²) m(μ) = 2 sum over α > 0, k >= 1 of m(μ + kα) (μ + kα, α)
    /// ```
    ///
    /// Only dominant weights are stored, and of the roots only one for each orbit of the stabilizer
    /// of `μ` (Moody and Patera, *Bull. AMS* 7 (1982) 237-242).
    ///
    /// # Errors
    /// [`RepresentationError::TooLarge`] if the number of dominant weights or the multiplicities
    /// exceed the limits.
    pub fn character(&self) -> Result<Character, RepresentationError> {
        let _stage = stage("weights");
        let weights = self.lowered_weights()?.into_iter();
        Ok(Character::of(self.algebra(), weights.map(|(weight, _, m)| (weight, m)).collect()))
    }

    /// The dominant weights `μ` of the [character](Self::character), with the coefficients of
    /// `λ - μ` over the simple roots and with their multiplicities.
    pub(super) fn lowered_weights(&self) -> Result<Vec<Lowered>, RepresentationError> {
        Ok(Freudenthal::new(self)?.multiplicities())
    }
}

/// A dominant weight `μ`, the coefficients of `λ - μ` over the simple roots, and the multiplicity.
pub(super) type Lowered = (Vec<i64>, Vec<i64>, i128);

/// The data of Freudenthal's recursion.
struct Freudenthal<'a> {
    algebra: &'a ReductiveAlgebra,
    half_lengths: Vec<i64>,
    /// The dominant weights below the highest one.
    weights: Vec<Vec<i64>>,
    /// For each weight `μ` the coefficients of `λ - μ` over the simple roots.
    differences: Vec<Vec<i64>>,
    index: FxHashMap<Vec<i64>, usize>,
    /// Representatives of the orbits of a stabilizer on the roots, with the sizes of the orbits, for
    /// each set of labels that are zero.
    orbits: HashMap<Vec<bool>, Vec<(usize, i64)>>,
}

impl<'a> Freudenthal<'a> {
    fn new(highest: &'a HighestWeight) -> Result<Self, RepresentationError> {
        let algebra = highest.algebra();
        let large = |what: &str, limit: String| RepresentationError::TooLarge {
            what: format!("the {what} of {highest}"),
            limit,
        };
        // the sums of the recursion are below dim V * (number of roots) * 18 * rank * label
        let label = highest.labels().iter().map(|label| label.unsigned_abs()).max().unwrap_or(0);
        let roots = (algebra.positive_roots().len() * algebra.rank() * 18 + 1) as u64;
        let bits = highest.dimension().bits() + u64::from(label.max(1).ilog2() + roots.ilog2() + 2);
        if bits > 126 {
            return Err(large("bound of the multiplicities", "the 128-bit integers".into()));
        }
        let rank = algebra.semisimple_rank();
        let mut weights = vec![highest.labels().to_vec()];
        let mut differences = vec![vec![0; rank]];
        let mut index = FxHashMap::from_iter([(highest.labels().to_vec(), 0)]);
        let mut at = 0;
        // subtracting positive roots from dominant weights reaches all dominant weights (Stembridge)
        while at < weights.len() {
            checkpoint();
            for root in algebra.positive_roots() {
                let dominant = weights[at].iter().zip(&root.labels).all(|(w, r)| w >= r);
                if dominant {
                    let mut lower = weights[at].clone();
                    lower.iter_mut().zip(&root.labels).for_each(|(w, r)| *w -= r);
                    if !index.contains_key(&lower) {
                        let difference = differences[at].iter().zip(&root.coefficients);
                        differences.push(difference.map(|(d, c)| d + c).collect());
                        index.insert(lower.clone(), weights.len());
                        weights.push(lower);
                        if weights.len() > MAX_WEIGHTS {
                            let limit = MAX_WEIGHTS.to_string();
                            return Err(large("number of dominant weights", limit));
                        }
                    }
                }
            }
            at += 1;
        }
        let half_lengths = algebra.half_lengths();
        let orbits = HashMap::new();
        Ok(Freudenthal { algebra, half_lengths, weights, differences, index, orbits })
    }

    fn multiplicities(mut self) -> Vec<Lowered> {
        let mut order: Vec<usize> = (0..self.weights.len()).collect();
        order.sort_by_key(|&at| self.differences[at].iter().sum::<i64>());
        let mut multiplicities = vec![0_i128; self.weights.len()];
        multiplicities[0] = 1;
        let (mut shifted, mut dominant) = (vec![], vec![]);
        for &at in &order[1..] {
            checkpoint();
            let zeros: Vec<bool> =
                self.weights[at][..self.half_lengths.len()].iter().map(|&l| l == 0).collect();
            if !self.orbits.contains_key(&zeros) {
                let orbits = orbits_of_roots(self.algebra, &zeros);
                self.orbits.insert(zeros.clone(), orbits);
            }
            // λ - k α_i has the multiplicity 1
            if self.differences[at].iter().filter(|c| **c != 0).count() == 1 {
                multiplicities[at] = 1;
                continue;
            }
            let weight = &self.weights[at];
            let mut sum = 0_i128;
            for &(root, size) in &self.orbits[&zeros] {
                let root = &self.algebra.positive_roots()[root];
                let mut product = i128::from(self.product(&root.coefficients, weight));
                let mut partial = 0;
                shifted.clone_from(weight);
                loop {
                    shifted.iter_mut().zip(&root.labels).for_each(|(w, r)| *w += r);
                    product += i128::from(2 * root.half_length);
                    dominant.clone_from(&shifted);
                    self.algebra.make_dominant(&mut dominant);
                    let Some(&above) = self.index.get(&dominant) else { break };
                    partial += multiplicities[above] * product;
                }
                sum += partial * i128::from(size);
            }
            // (λ+ρ)² - (μ+ρ)² = (λ - μ, λ + μ + 2ρ); the sizes contain the factor 2
            let total: Vec<i64> =
                weight.iter().zip(&self.weights[0]).map(|(w, highest)| w + highest + 2).collect();
            let norm = i128::from(self.product(&self.differences[at], &total));
            multiplicities[at] = sum / norm;
        }
        let taken = order.iter().map(|&at| {
            let weight = std::mem::take(&mut self.weights[at]);
            (weight, std::mem::take(&mut self.differences[at]), multiplicities[at])
        });
        taken.collect()
    }

    /// The product `(β, ν)` of a sum of simple roots with a weight.
    fn product(&self, coefficients: &[i64], weight: &[i64]) -> i64 {
        let terms = coefficients.iter().zip(weight).zip(&self.half_lengths);
        terms.map(|((c, label), half)| c * label * half).sum()
    }
}

/// The orbits of the parabolic subgroup of some nodes on the roots up to sign. Each orbit is given by
/// its positive root that is dominant for the nodes, and by twice the number of its roots in
/// Freudenthal's sum.
///
/// The subgroup permutes the positive roots outside its own root system. Inside, both signs occur,
/// and opposite roots contribute equally.
fn orbits_of_roots(algebra: &ReductiveAlgebra, nodes: &[bool]) -> Vec<(usize, i64)> {
    let roots = algebra.positive_roots();
    let index: HashMap<&[i64], usize> =
        roots.iter().enumerate().map(|(at, root)| (&root.labels[..], at)).collect();
    let mut sizes = vec![0; roots.len()];
    for root in roots {
        let mut labels = root.labels.clone();
        let negative = |labels: &[i64]| (0..nodes.len()).find(|&i| nodes[i] && labels[i] < 0);
        while let Some(i) = negative(&labels) {
            algebra.reflect(&mut labels, i);
        }
        if let Some(&at) = index.get(&labels[..]) {
            sizes[at] += 2;
        }
    }
    sizes.into_iter().enumerate().filter(|&(_, size)| size > 0).collect()
}
