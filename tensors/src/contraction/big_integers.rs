//! Sums of products in integers of any size, with one common denominator.

use super::arithmetic::{Arithmetic, Term};
use super::integers::lists;
use super::{KernelThresholds, Product};
use crate::Scalar;
use dashu_base::{BitTest, Gcd};
use dashu_int::{IBig, UBig};
use std::borrow::Cow;
use std::sync::atomic::{AtomicBool, Ordering::Relaxed};

/// The factors of products as integers. Each factor has its own denominator. A tensor that occurs
/// in several products is converted once.
pub(super) struct BigCleared {
    lists: Vec<(Vec<IBig>, UBig)>,
    /// For each factor of each product, the index of its list.
    numbers: Vec<Vec<usize>>,
}

impl BigCleared {
    /// Converts the factors. Returns `None` if the scalar has no denominators, or if a common
    /// denominator is too long.
    pub fn new<S: Scalar>(products: &[Product<S>]) -> Option<Self> {
        let (lists, numbers) = lists(products, |t| S::clear_to_big(t.values().iter()))?;
        Some(BigCleared { lists, numbers })
    }

    /// Returns all terms over a common denominator, and this denominator. Returns `None` if the
    /// denominator is so short that sums in the ring are faster.
    pub fn terms<'t, S: Scalar>(
        &'t self,
        products: &'t [Product<S>],
        paths: &KernelThresholds,
    ) -> Option<(Vec<Term<'t, IBig>>, UBig)> {
        let products = || products.iter().zip(&self.numbers);
        let own = |(product, numbers): (&Product<S>, &Vec<usize>)| {
            let start = UBig::from(product.coefficient.denom().unsigned_abs());
            numbers.iter().fold(start, |d, &number| d * &self.lists[number].1)
        };
        let denominator = products().map(own).fold(UBig::ONE, |denominator, own| {
            let common = (&denominator).gcd(&own);
            denominator * (own / common)
        });
        if denominator.bit_len() <= paths.denominator_bits {
            return None;
        }
        let term = |(product, numbers): (&'t Product<S>, &'t Vec<usize>)| {
            let scale = IBig::from(&denominator / own((product, numbers)));
            let scale = scale * IBig::from(*product.coefficient.numer());
            product.with_values(|at, _| {
                let values = &self.lists[numbers[at]].0;
                match at {
                    0 if scale != IBig::ONE => values.iter().map(|value| value * &scale).collect(),
                    _ => Cow::Borrowed(values),
                }
            })
        };
        Some((products().map(term).collect(), denominator))
    }
}

/// Sums of integers of any size over a common denominator. A sum is reduced to lowest terms when it
/// is complete.
pub(super) struct OnBigIntegers {
    denominator: UBig,
    failed: AtomicBool,
}

impl OnBigIntegers {
    pub fn new(denominator: UBig) -> Self {
        OnBigIntegers { denominator, failed: AtomicBool::new(false) }
    }

    /// Whether a quotient does not exist in the ring. In this case, the result is incomplete.
    pub fn failed(&self) -> bool {
        self.failed.load(Relaxed)
    }
}

impl<S: Scalar> Arithmetic<S> for OnBigIntegers {
    type Value = IBig;
    type Sum = IBig;
    #[inline]
    fn add_product(&self, sum: &mut IBig, a: &IBig, b: &IBig, negative: bool) {
        if negative { *sum -= a * b } else { *sum += a * b }
    }
    fn finish(&self, sum: &IBig) -> Option<S> {
        if sum.is_zero() {
            return None;
        }
        let quotient = S::from_big_quotient(sum, &self.denominator);
        if quotient.is_none() {
            self.failed.store(true, Relaxed);
        }
        quotient
    }
}
