//! Contraction by index letters: a signed sum of products, written as on paper, in one pass.
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
//! A term is an optional integer and one or two named factors; `^` opens upper and `_` lower
//! letters, in the order of the slots. A letter stands once in every term and in the result, or
//! twice in a term, once up and once down, and is summed. Variances are checked.
//!
//! Letters in brackets, `-> ^i_j[kl]`, are a promise that the sum is antisymmetric in them: only
//! the components with `k < l` are computed, the others follow by sign.

mod arithmetic;
mod kernel;
mod notation;
mod paths;
mod rows;

use crate::{Ring, Tensor, TensorError, Up, Variance};
use arithmetic::{Factor, InRing, OnIntegers, Term};
use notation::Expression;
use paths::MAX_PLACES;
#[doc(hidden)]
pub use paths::Paths;

/// The tensor that `expression` describes, with operands found by name.
///
/// # Errors
/// [`TensorError::Notation`] when the expression is malformed or does not fit the operands;
/// [`TensorError::Dimension`]; [`TensorError::TooLarge`] for a result whose keys exceed 64 bits, or
/// whose last two indices take more than 2^24 values together, or for an operand of more than
/// 2^32 - 1 components.
pub fn contract<S: Ring>(
    expression: &str,
    operands: &[(&str, &Tensor<S>)],
) -> Result<Tensor<S>, TensorError> {
    contract_by(&Paths::default(), expression, operands)
}

/// [`contract`] with other sizes at which the kernel takes another path: the door by which tests
/// enter every path with small tensors.
///
/// # Errors
/// As [`contract`], with [`Paths::places`] in place of 2^24.
#[doc(hidden)]
pub fn contract_by<S: Ring>(
    paths: &Paths,
    expression: &str,
    operands: &[(&str, &Tensor<S>)],
) -> Result<Tensor<S>, TensorError> {
    let parsed = Expression::parse(expression)?;
    let mut dimension = None;
    for (_, operand) in operands {
        match dimension.replace(operand.dimension()) {
            Some(other) if other != operand.dimension() => {
                return Err(TensorError::Dimension(other, operand.dimension()));
            }
            _ => {}
        }
        // entries are numbered by 32 bits
        if u32::try_from(operand.len()).is_err() {
            let (dimension, rank) = (operand.dimension(), operand.rank());
            return Err(TensorError::TooLarge { dimension, rank });
        }
    }
    let terms = fold_mirrors(parsed.bind(operands)?, parsed.last_pair());
    let tolerance =
        operands.iter().map(|(_, t)| t.tolerance()).reduce(|a, b| a.weaker(b)).unwrap_or_default();
    let (dimension, rank) = (dimension.unwrap_or(0), parsed.slots().len());
    let zero = Tensor::zero(dimension, parsed.slots())?.with_tolerance(tolerance);
    if (dimension as u64).saturating_pow(rank.min(2) as u32) > paths.places.min(MAX_PLACES) {
        return Err(TensorError::TooLarge { dimension, rank });
    }
    let groups = parsed.antisymmetric();
    let (keys, values) = match OnIntegers::clear(&terms, zero.dimension(), paths) {
        Some((integers, terms)) => kernel::run(&integers, &terms, &zero, groups, paths),
        None => kernel::run(&InRing::new(tolerance), &InRing::terms(&terms), &zero, groups, paths),
    };
    Ok(zero.fill(keys, values))
}

/// Letters with their variances as the notation writes them: `^i_j_k`.
pub fn indices(letters: impl IntoIterator<Item = (char, Variance)>) -> String {
    let mark = |slot| if slot == Up { '^' } else { '_' };
    letters.into_iter().flat_map(|(letter, slot)| [mark(slot), letter]).collect()
}

/// A term with its operands: `coefficient * factors[0] * factors[1]`.
struct Product<'a, S> {
    coefficient: i64,
    /// Stands for itself less the same with the last two indices of the result exchanged.
    mirrored: bool,
    factors: Vec<(Vec<Role>, &'a Tensor<S>)>,
}

/// What the letter of a slot does.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Role {
    /// It is the index of that number of the result.
    Free(usize),
    /// It is summed; equal numbers belong together.
    Summed(usize),
}

/// Joins terms that are each other's images under the exchange of an antisymmetric last pair.
fn fold_mirrors<S>(terms: Vec<Product<S>>, pair: Option<(usize, usize)>) -> Vec<Product<S>> {
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
                && Some(other.coefficient) == term.coefficient.checked_neg()
                && other.factors.len() == term.factors.len()
                && other.factors.iter().zip(&term.factors).all(|(x, y)| {
                    std::ptr::eq(x.1, y.1) && x.0.iter().map(exchange).eq(y.0.iter().copied())
                })
        };
        match kept.iter_mut().find(image) {
            Some(first) => first.mirrored = true,
            None => kept.push(term),
        }
    }
    kept
}

impl<S: Ring> Product<'_, S> {
    /// The term with its values taken as `V`.
    fn with_values<V>(&self, mut values: impl FnMut(usize, &Tensor<S>) -> Vec<V>) -> Term<'_, V> {
        let factor = |(at, (roles, tensor))| {
            let (roles, tensor): (&Vec<_>, &Tensor<S>) = (roles, tensor);
            Factor { roles, keys: tensor.keys(), values: values(at, tensor) }
        };
        let factors = self
            .factors
            .iter()
            .map(|(roles, tensor)| (roles, *tensor))
            .enumerate()
            .map(factor)
            .collect();
        Term { factors, mirrored: self.mirrored }
    }
}
