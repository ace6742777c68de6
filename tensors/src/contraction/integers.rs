//! Sums of products in machine integers, with one common denominator.

use super::arithmetic::{Arithmetic, Term};
use super::{KernelThresholds, Product, Role};
use crate::{Scalar, Tensor};
use std::borrow::Cow;
use std::sync::atomic::{AtomicBool, Ordering::Relaxed};

/// The factors of products as integers. Each factor has its own denominator. A tensor that occurs
/// in several products is converted once.
pub(super) struct Cleared {
    lists: Vec<(Vec<i64>, i64)>,
    /// For each factor of each product, the index of its list.
    numbers: Vec<Vec<usize>>,
}

/// Converts each tensor of the products to one list. Returns the lists and, for each factor, the
/// index of its list.
pub(super) fn lists<'t, S: Scalar, L>(
    products: &'t [Product<S>],
    list: impl Fn(&Tensor<S>) -> Option<L>,
) -> Option<(Vec<L>, Vec<Vec<usize>>)> {
    let (mut tensors, mut lists): (Vec<&'t Tensor<S>>, Vec<_>) = (vec![], vec![]);
    let mut number = |tensor: &'t Tensor<S>| {
        let known = tensors.iter().position(|&other| std::ptr::eq(other, tensor));
        known.map_or_else(
            || {
                lists.push(list(tensor)?);
                tensors.push(tensor);
                Some(tensors.len() - 1)
            },
            Some,
        )
    };
    let numbers = products
        .iter()
        .map(|product| product.factors.iter().map(|(_, tensor)| number(tensor)).collect())
        .collect::<Option<_>>()?;
    Some((lists, numbers))
}

impl Cleared {
    /// Converts the factors. Returns `None` if the scalar has no denominators, or if a denominator
    /// exceeds 64 bits.
    pub fn new<S: Scalar>(products: &[Product<S>]) -> Option<Self> {
        let (lists, numbers) = lists(products, |t| S::clear_denominators(t.values().iter()))?;
        Some(Cleared { lists, numbers })
    }

    /// Returns all terms over a common denominator, and this denominator. Returns `None` if a sum
    /// may exceed 64 bits.
    pub fn terms<'t, S: Scalar>(
        &'t self,
        products: &'t [Product<S>],
        dimension: usize,
        paths: &KernelThresholds,
    ) -> Option<(Vec<Term<'t, i64>>, i64)> {
        let products = || products.iter().zip(&self.numbers);
        let own = |(product, numbers): (&Product<S>, &Vec<usize>)| {
            let factors = numbers.iter().map(|&number| self.lists[number].1);
            { factors }.try_fold(*product.coefficient.denom(), |d, factor| d.checked_mul(factor))
        };
        let denominator = products().map(own).try_fold(1i64, |denominator, own| {
            let own = own?;
            denominator.checked_mul(own / num_integer::gcd(own, denominator))
        })?;
        let mut bound = 0u64;
        let mut terms = Vec::new();
        for (product, numbers) in products() {
            let scale = denominator / own((product, numbers))?;
            let scale = product.coefficient.numer().checked_mul(scale)?;
            // counts the products in one component: one for each combination of values of the
            // summed letters
            let summed = product.factors.iter().flat_map(|(roles, _)| roles);
            let pairs = summed.filter(|r| matches!(r, Role::Summed(_))).count() / 2;
            let values = || numbers.iter().map(|&number| &self.lists[number].0);
            let entries = values().map(|values| values.len() as u64).max()?;
            let count = (dimension as u64)
                .saturating_pow(pairs as u32)
                .min(entries.saturating_mul(entries));
            // a mirrored term also adds this number of products to its image
            let count = count.checked_mul(1 + u64::from(product.mirrored))?;
            let largest =
                |values: &Vec<i64>| values.iter().map(|v| v.unsigned_abs()).max().unwrap_or(0);
            let size = values().map(largest).try_fold(count, u64::checked_mul)?;
            if size == 0 {
                // a factor has no components, so the term vanishes
                continue;
            }
            bound = bound.checked_add(size.checked_mul(scale.unsigned_abs())?)?;
            if bound > paths.largest_integer.min(i64::MAX as u64) {
                return None;
            }
            terms.push(product.with_values(|at, _| {
                let values = &self.lists[numbers[at]].0;
                match at {
                    // the product cannot overflow, because a value that is multiplied here is below
                    // the bound
                    0 if scale != 1 => values.iter().map(|value| value * scale).collect(),
                    _ => Cow::Borrowed(values),
                }
            }));
        }
        Some((terms, denominator))
    }
}

/// Sums of machine integers over a common denominator. It has been proved that the sums do not
/// overflow.
pub(super) struct OnIntegers<S> {
    denominator: i64,
    /// The quotients with numerators from `-kept` to `kept`. They occur most often.
    frequent: Vec<Option<S>>,
    kept: i64,
    failed: AtomicBool,
}

impl<S: Scalar> OnIntegers<S> {
    pub fn new(denominator: i64, paths: &KernelThresholds) -> Self {
        let kept = i64::from(paths.kept_quotients);
        let frequent = (-kept..=kept).map(|sum| S::from_quotient(sum, denominator)).collect();
        OnIntegers { denominator, frequent, kept, failed: AtomicBool::new(false) }
    }

    /// Whether a quotient does not exist in the ring. In this case, the result is incomplete.
    pub fn failed(&self) -> bool {
        self.failed.load(Relaxed)
    }
}

impl<S: Scalar> Arithmetic<S> for OnIntegers<S> {
    type Value = i64;
    type Sum = i64;
    #[inline(always)]
    fn add_product(&self, sum: &mut i64, a: &i64, b: &i64, negative: bool) {
        *sum += if negative { -(a * b) } else { a * b };
    }
    #[inline(always)]
    fn finish(&self, sum: &i64) -> Option<S> {
        let sum = *sum;
        if sum == 0 {
            return None;
        }
        // compares before the conversion to a list index, which has 32 bits on some machines
        let quotient = if sum.unsigned_abs() <= self.kept.unsigned_abs() {
            self.frequent[(sum + self.kept) as usize].clone()
        } else {
            S::from_quotient(sum, self.denominator)
        };
        if quotient.is_none() {
            self.failed.store(true, Relaxed);
        }
        quotient
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A quotient that does not exist in the ring is reported, whether or not it is stored. A sum
    /// of zero needs no quotient.
    #[test]
    fn missing_quotients_are_noticed() {
        let paths = KernelThresholds { kept_quotients: 2, ..KernelThresholds::default() };
        for sum in [-100, -3, -2, 1, 2, 3, i64::MAX] {
            // floats have all quotients except those by zero
            let [with, without] =
                [4, 0].map(|denominator| OnIntegers::<f64>::new(denominator, &paths));
            assert_eq!((with.finish(&sum), with.failed()), (Some(sum as f64 / 4.0), false));
            assert_eq!((without.finish(&0), without.failed()), (None, false));
            assert_eq!((without.finish(&sum), without.failed()), (None, true));
        }
    }
}
