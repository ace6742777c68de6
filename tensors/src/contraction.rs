//! Contraction with index letters: a sum of products of tensors, in the usual index notation.
//!
//! ```
//! use affinor_tensors::{Down, Rational, Tensor, Up, contract};
//! # fn main() -> Result<(), affinor_tensors::TensorError> {
//! let epsilon = |[i, j, k]: [usize; 3]| {
//!     let (i, j, k) = (i as i64, j as i64, k as i64);
//!     Rational::from((i - j) * (j - k) * (k - i) / 2)
//! };
//! let c = Tensor::from_fn(3, [Up, Down, Down], epsilon)?;
//! let jacobi = contract(
//!     "c^m_jk c^i_ml + c^m_kl c^i_mj + c^m_lj c^i_mk -> ^i_[jkl]",
//!     &[("c", &c)],
//! )?;
//! assert!(jacobi.is_empty());
//! let killing = contract("c^m_il c^l_jm -> _ij", &[("c", &c)])?;
//! assert_eq!(killing.get(&[0, 0]), Rational::from(-2));
//! # Ok(())
//! # }
//! ```
//!
//! A term consists of named factors, and may begin with a rational coefficient:
//! `1/2 a^i_j b^j_k c^k_l`. After a name, `^` begins upper letters and `_` begins lower letters, in
//! the order of the slots. A free letter occurs once in every term and once in the result. A summed
//! letter occurs twice in a term, once upper and once lower. Variances are checked.
//!
//! All terms of one or two factors are added in one pass. In a longer term, pairs of factors are
//! contracted first, and pairs that leave the fewest indices come first. The tolerance applies to
//! each of these sums.
//!
//! Brackets in the result, `-> ^i_j[kl]`, declare that the sum is antisymmetric in these letters.
//! Then only the components with `k < l` are computed; the other components follow from the sign.
//! The declaration is not checked.

mod accumulator;
mod arithmetic;
mod big_integers;
mod found;
mod integers;
mod kernel;
mod notation;
mod paths;
mod positions;
mod rows;
mod scalar;
mod shape;

use crate::{Tensor, TensorError, Up, Variance};
use arithmetic::{Factor, InRing, Term};
use big_integers::{BigCleared, OnBigIntegers};
use integers::{Cleared, OnIntegers};
use notation::Expression;
use num_rational::Ratio;
#[doc(hidden)]
pub use paths::KernelThresholds;
use paths::MAX_PLACES;
pub use scalar::Scalar;
use std::borrow::Cow;

/// The tensor that `expression` describes. The operands are found by their names.
///
/// # Errors
/// [`TensorError::Notation`] if the expression is malformed or does not fit the operands;
/// [`TensorError::Dimension`] if the dimensions differ; [`TensorError::NotInvertible`] if the
/// denominator of a coefficient has no inverse. [`TensorError::TooLarge`] if the keys of the result
/// exceed 64 bits, or if its last two indices have more than 2^24 pairs of values.
/// [`TensorError::TooLarge`] also if an operand has more than 2^32 - 1 components. The same limits
/// apply to the contracted pairs of a longer term.
pub fn contract<S: Scalar>(
    expression: &str,
    operands: &[(&str, &Tensor<S>)],
) -> Result<Tensor<S>, TensorError> {
    S::contracted(&KernelThresholds::default(), expression, operands)
}

/// Computes [`contract`] with other thresholds between the paths of the kernel. Tests can thus run
/// every path with small tensors.
///
/// # Errors
/// The errors of [`contract`], with [`KernelThresholds::places`] instead of 2^24.
#[doc(hidden)]
pub fn contract_by<S: Scalar>(
    paths: &KernelThresholds,
    expression: &str,
    operands: &[(&str, &Tensor<S>)],
) -> Result<Tensor<S>, TensorError> {
    S::contracted(paths, expression, operands)
}

/// Implements [`Scalar::contracted`], which is the contraction over one scalar type.
pub(crate) fn over<S: Scalar>(
    paths: &KernelThresholds,
    expression: &str,
    operands: &[(&str, &Tensor<S>)],
) -> Result<Tensor<S>, TensorError> {
    let parsed = Expression::parse(expression)?;
    let dimension = operands.first().map_or(0, |(_, operand)| operand.dimension());
    for (_, operand) in operands {
        if operand.dimension() != dimension {
            return Err(TensorError::Dimension(dimension, operand.dimension()));
        }
        // rejects longer operands, because the kernel numbers their entries with 32 bits
        if u32::try_from(operand.len()).is_err() {
            return Err(TensorError::TooLarge { dimension, rank: operand.rank() });
        }
    }
    let one = Tensor::from_components(dimension, &[], [([], S::one())])?;
    let products = parsed.bind(operands)?.into_iter().map(|product| product.in_pairs(paths, &one));
    let terms = fold_mirrors(products.collect::<Result<_, _>>()?, parsed.last_pair());
    let chosen = Tensor::common_tolerance(operands.iter().map(|(_, tensor)| *tensor));
    let tolerance = chosen.unwrap_or_default();
    let rank = parsed.slots.len();
    let zero = Tensor::zero(dimension, &parsed.slots)?;
    let zero = chosen.into_iter().fold(zero, Tensor::with_tolerance);
    if (dimension as u64).saturating_pow(rank.min(2) as u32) > paths.places.min(MAX_PLACES) {
        return Err(TensorError::TooLarge { dimension, rank });
    }
    let groups = &parsed.groups;
    let shape = (dimension, rank);
    let on_integers = Cleared::new(&terms).and_then(|cleared| {
        let (terms, denominator) = cleared.terms(&terms, dimension, paths)?;
        let integers = OnIntegers::new(denominator, paths);
        let found = kernel::run(&integers, &terms, shape, groups, paths);
        (!integers.failed()).then_some(found)
    });
    let on_big_integers = || {
        // omits this path in a browser, where the size of the program is more important than its
        // speed
        if cfg!(target_family = "wasm") {
            return None;
        }
        let cleared = BigCleared::new(&terms)?;
        let (terms, denominator) = cleared.terms(&terms, paths)?;
        let integers = OnBigIntegers::new(denominator);
        let found = kernel::run(&integers, &terms, shape, groups, paths);
        (!integers.failed()).then_some(found)
    };
    let in_ring = || kernel::run(&InRing(tolerance), &InRing::terms(&terms), shape, groups, paths);
    let (keys, values) = on_integers.or_else(on_big_integers).unwrap_or_else(in_ring);
    Ok(zero.fill(keys, values))
}

/// Index letters with their variances, in the notation of contractions: `^i_j_k`.
pub fn indices(letters: impl IntoIterator<Item = (char, Variance)>) -> String {
    let mark = |slot| if slot == Up { '^' } else { '_' };
    letters.into_iter().flat_map(|(letter, slot)| [mark(slot), letter]).collect()
}

/// A term with its operands: `coefficient * factors[0] * factors[1] * ...`.
struct Product<'a, S: Clone> {
    coefficient: Ratio<i64>,
    /// Whether the image of the term under the exchange of the last two result indices is
    /// subtracted.
    mirrored: bool,
    factors: Vec<(Vec<Role>, Cow<'a, Tensor<S>>)>,
}

/// The role of the index letter of a slot.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Role {
    /// The letter is the result index with this number.
    Free(usize),
    /// The letter is summed; both of its slots have this number.
    Summed(usize),
}

/// Joins pairs of terms, if each is the opposite image of the other under the exchange of an
/// antisymmetric last pair.
fn fold_mirrors<S: Clone>(terms: Vec<Product<S>>, pair: Option<(usize, usize)>) -> Vec<Product<S>> {
    let Some((a, b)) = pair else { return terms };
    let exchange = |role: &Role| match *role {
        Role::Free(at) if at == a => Role::Free(b),
        Role::Free(at) if at == b => Role::Free(a),
        other => other,
    };
    let mut kept: Vec<Product<S>> = Vec::new();
    for term in terms {
        let image = |other: &&mut Product<S>| {
            !other.mirrored
                && term.coefficient.numer().checked_neg() == Some(*other.coefficient.numer())
                && term.coefficient.denom() == other.coefficient.denom()
                && other.factors.len() == term.factors.len()
                && other.factors.iter().zip(&term.factors).all(|(x, y)| {
                    std::ptr::eq(&*x.1, &*y.1) && x.0.iter().map(exchange).eq(y.0.iter().copied())
                })
        };
        match kept.iter_mut().find(image) {
            Some(first) => first.mirrored = true,
            None => kept.push(term),
        }
    }
    kept
}

impl<'a, S: Scalar> Product<'a, S> {
    /// Reduces the product to two factors: repeatedly contracts the pair that leaves the fewest
    /// indices. A single factor is multiplied by `one`.
    fn in_pairs(
        mut self,
        paths: &KernelThresholds,
        one: &'a Tensor<S>,
    ) -> Result<Self, TensorError> {
        if self.factors.len() == 1 {
            self.factors.push((vec![], Cow::Borrowed(one)));
        }
        while self.factors.len() > 2 {
            let count = self.factors.len();
            let pairs = (0..count).flat_map(|b| (0..b).map(move |a| (a, b)));
            let all = |(a, b): (usize, usize)| [slots(&self.factors[a]), slots(&self.factors[b])];
            let Some((a, b)) = pairs.min_by_key(|&pair| open(&all(pair).concat()).len()) else {
                break;
            };
            let [x, y] = all((a, b));
            let joined = [&x[..], &y].concat();
            let result = open(&joined);
            let letter = |&(role, variance): &(Role, Variance)| {
                let at = joined.iter().position(|(other, _)| *other == role).unwrap_or(0);
                (char::from(b'a' + at as u8), variance)
            };
            let [x, y, z] = [&x, &y, &result].map(|slots| indices(slots.iter().map(letter)));
            let (y_factor, x_factor) = (self.factors.remove(b), self.factors.remove(a));
            let operands = [("x", &*x_factor.1), ("y", &*y_factor.1)];
            let tensor = contract_by(paths, &format!("x{x} y{y} -> {z}"), &operands)?;
            let roles = result.into_iter().map(|(role, _)| role).collect();
            self.factors.push((roles, Cow::Owned(tensor)));
        }
        Ok(self)
    }

    /// The term, with its components converted to the type `V`.
    fn with_values<'t, V: Clone>(
        &'t self,
        mut values: impl FnMut(usize, &'t Tensor<S>) -> Cow<'t, [V]>,
    ) -> Term<'t, V> {
        let factors = std::array::from_fn(|at| {
            let (roles, tensor) = &self.factors[at];
            Factor { roles, keys: tensor.keys(), values: values(at, tensor) }
        });
        Term { factors, mirrored: self.mirrored }
    }
}

/// The role and the variance of each slot of a factor.
fn slots<S: Scalar>((roles, tensor): &(Vec<Role>, Cow<Tensor<S>>)) -> Vec<(Role, Variance)> {
    roles.iter().copied().zip(tensor.slots().iter().copied()).collect()
}

/// The slots that remain after the sum over pairs of slots.
fn open(slots: &[(Role, Variance)]) -> Vec<(Role, Variance)> {
    let times = |role: Role| slots.iter().filter(|(other, _)| *other == role).count();
    slots.iter().filter(|(role, _)| times(*role) == 1).copied().collect()
}
