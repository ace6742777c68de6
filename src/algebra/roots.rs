//! Root systems of the simple Lie algebras over the complex numbers.
//!
//! [`CartanType`] is the name of a root system, and [`RootSystem`] lists its roots. The function
//! [`chevalley_constants`] computes the integer structure constants of the split real form, and
//! [`identify`] finds the types of a Cartan matrix.
//!
//! Simple roots are numbered as in Bourbaki, *Groupes et algèbres de Lie*, ch. VI, plates I-IX.
//! Every vector in this module is a list of `rank` integers. Roots have coefficients in the simple
//! roots `α_i`, coroots in the simple coroots `α_i^∨`, and weights in the fundamental weights.

mod cartan;
mod chevalley;
mod diagrams;

use std::cmp::Reverse;
use std::collections::{BTreeMap, HashMap};

pub use cartan::{CartanType, MAX_DIMENSION, RootError, Series};
pub use chevalley::{basis_names, chevalley_constants};
pub use diagrams::identify;
pub(crate) use diagrams::{automorphisms, numbering};

/// The reduced irreducible root system of a Cartan type.
///
/// ```
/// use affinor::algebra::roots::{CartanType, RootSystem, Series};
///
/// let g2 = RootSystem::new(CartanType::new(Series::G, 2)?);
/// let roots: Vec<&[i64]> = g2.positive_roots().iter().map(|root| root.coefficients()).collect();
/// assert_eq!(roots, [[1, 0], [0, 1], [1, 1], [2, 1], [3, 1], [3, 2]]);
/// # Ok::<(), affinor::algebra::roots::RootError>(())
/// ```
#[doc(alias("roots", "Weyl group"))]
#[derive(Clone, Debug)]
pub struct RootSystem {
    cartan_type: CartanType,
    positive: Vec<Root>,
    index: HashMap<u128, usize>,
}

/// A positive root.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Root {
    coefficients: Vec<i64>,
    coroot: Vec<i64>,
    weight: Vec<i64>,
    squared_length: i64,
    key: u128,
}

impl RootSystem {
    /// Builds the positive roots level by level. `β + α_i` is a root if the `α_i`-string through
    /// `β`, which reaches down to `β - p α_i`, has `p > <β, α_i^∨>`.
    ///
    /// Humphreys, *Introduction to Lie Algebras and Representation Theory*, 9.4 and 11.1.
    pub fn new(cartan_type: CartanType) -> Self {
        let rank = cartan_type.rank();
        let cartan = cartan_type.cartan_matrix();
        let lengths = cartan_type.squared_lengths();
        let unit = |i: usize| (0..rank).map(|j| i64::from(i == j)).collect();
        let units: Vec<u128> = (0..rank).rev().map(|i| radix(cartan_type).pow(i as u32)).collect();

        let mut system = RootSystem { cartan_type, positive: Vec::new(), index: HashMap::new() };
        let mut level: BTreeMap<Reverse<u128>, Vec<i64>> =
            units.iter().enumerate().map(|(i, &key)| (Reverse(key), unit(i))).collect();
        while !level.is_empty() {
            let start = system.positive.len();
            for (Reverse(key), coefficients) in std::mem::take(&mut level) {
                system.index.insert(key, system.positive.len());
                system.positive.push(Root::new(key, coefficients, &cartan, &lengths));
            }
            for (at, root) in system.positive.iter().enumerate().skip(start) {
                for i in (0..rank).filter(|&i| system.steps_down(at, i) > root.weight[i]) {
                    level.entry(Reverse(root.key + units[i])).or_insert_with(|| {
                        let mut next = root.coefficients.clone();
                        next[i] += 1;
                        next
                    });
                }
            }
        }
        system
    }

    /// The Cartan type of the root system.
    pub fn cartan_type(&self) -> CartanType {
        self.cartan_type
    }

    /// The positive roots by height and, within a height, in descending lexicographic order of
    /// their coefficients. The simple roots `α_1 ... α_r` come first, the highest root last.
    pub fn positive_roots(&self) -> &[Root] {
        &self.positive
    }

    /// The position of a root in [`positive_roots`](Self::positive_roots), from its coefficients;
    /// `None` for other coefficients, including those of negative roots.
    pub fn index(&self, coefficients: &[i64]) -> Option<usize> {
        self.index.get(&key(coefficients, self.cartan_type)?).copied()
    }

    /// Whether the coefficients belong to a root, positive or negative.
    pub fn is_root(&self, coefficients: &[i64]) -> bool {
        let opposite: Vec<i64> = coefficients.iter().map(|c| c.saturating_neg()).collect();
        self.index(coefficients).or_else(|| self.index(&opposite)).is_some()
    }

    /// The position of the root `t - r`, if this difference is a positive root. The search is
    /// exact: keys of sums of two positive roots are distinct, so `key(t) - key(r) = key(s)`
    /// implies `t = r + s`.
    fn difference(&self, t: usize, r: usize) -> Option<usize> {
        let key = self.positive[t].key.checked_sub(self.positive[r].key)?;
        self.index.get(&key).copied()
    }

    /// The largest `p` such that `b - p α_i` is a positive root.
    fn steps_down(&self, b: usize, i: usize) -> i64 {
        std::iter::successors(self.difference(b, i), |&c| self.difference(c, i)).map(|_| 1).sum()
    }
}

impl Root {
    fn new(key: u128, coefficients: Vec<i64>, cartan: &[Vec<i64>], lengths: &[i64]) -> Self {
        let weight: Vec<i64> = (0..coefficients.len())
            .map(|i| coefficients.iter().zip(cartan).map(|(c, row)| c * row[i]).sum())
            .collect();
        // uses (α, α) = sum_i c_i (α, α_i), and 2 (α, α_i) = <α, α_i^∨> (α_i, α_i).
        let twice: i64 =
            coefficients.iter().zip(&weight).zip(lengths).map(|((c, w), l)| c * w * l).sum();
        let squared_length = twice / 2;
        let coroot =
            coefficients.iter().zip(lengths).map(|(c, l)| c * l / squared_length).collect();
        Root { coefficients, coroot, weight, squared_length, key }
    }

    /// The coefficients of the root in the simple roots: `α = sum_i c_i α_i`.
    pub fn coefficients(&self) -> &[i64] {
        &self.coefficients
    }

    /// The coefficients of the coroot `α^∨ = 2α/(α, α)` in the simple coroots.
    pub fn coroot(&self) -> &[i64] {
        &self.coroot
    }

    /// The coefficients of the root in the fundamental weights: the integers `<α, α_i^∨>`.
    pub fn weight(&self) -> &[i64] {
        &self.weight
    }

    /// The sum of the coefficients.
    pub fn height(&self) -> i64 {
        self.coefficients.iter().sum()
    }

    /// The squared length `(α, α)`, normalized to 2 for the short roots, or for all roots if they
    /// have equal lengths.
    pub fn squared_length(&self) -> i64 {
        self.squared_length
    }
}

/// Encodes the coefficients as the digits of one number; the first digit is the most significant
/// digit. The key of a sum is the sum of the keys, and the order of keys is lexicographic. Returns
/// `None` if there are not `rank` coefficients, or if one is out of range.
fn key(coefficients: &[i64], cartan_type: CartanType) -> Option<u128> {
    let radix = radix(cartan_type);
    let digit = |&c: &i64| u128::try_from(c).ok().filter(|&c| c < radix);
    (coefficients.len() == cartan_type.rank())
        .then(|| coefficients.iter().try_fold(0, |key, c| Some(key * radix + digit(c)?)))?
}

/// The base of keys: one more than the largest coefficient of a sum of two positive roots. The
/// coefficients of a root are at most 6 in the exceptional types, and at most 2 in the classical
/// types. `radix^rank` fits in 128 bits.
fn radix(cartan_type: CartanType) -> u128 {
    match cartan_type.series() {
        Series::A | Series::B | Series::C | Series::D => 5,
        Series::E | Series::F | Series::G => 13,
    }
}
