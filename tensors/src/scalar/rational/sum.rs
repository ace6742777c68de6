//! Sums of rationals that are reduced to lowest terms once, at their end.

use super::Rational;
use crate::{Sum, Tolerance};
use num_traits::Zero;

/// A sum as an unreduced fraction, as long as its parts fit machine integers.
#[derive(Clone, Debug)]
pub struct RationalSum(State);

#[derive(Clone, Debug)]
enum State {
    /// The denominator is positive.
    Words {
        numerator: i128,
        denominator: i64,
    },
    Reduced(Rational),
}
use State::{Reduced, Words};

impl State {
    /// `a b`, not reduced; `None` where the denominator exceeds a word.
    #[inline]
    fn product(a: &Rational, b: &Rational) -> Option<(i128, i64)> {
        let ((a, d), (b, e)) = (a.words()?, b.words()?);
        Some((i128::from(a) * i128::from(b), d.checked_mul(e)?))
    }

    fn value(&self) -> Rational {
        match self {
            Words { numerator, denominator } => {
                Rational::reduced(*numerator, i128::from(*denominator))
            }
            Reduced(value) => value.clone(),
        }
    }
}

impl RationalSum {
    /// Adds `n / d`. If the result does not fit, adds nothing and returns `false`.
    #[inline]
    fn add_words(&mut self, n: i128, d: i64) -> bool {
        let Words { numerator, denominator } = &mut self.0 else { return false };
        if *denominator == d {
            return match numerator.checked_add(n) {
                Some(sum) => {
                    *numerator = sum;
                    true
                }
                None => false,
            };
        }
        // the products of words and their sum stay below 2^127
        let (Ok(a), Ok(b)) = (i64::try_from(*numerator), i64::try_from(n)) else { return false };
        let Some(common) = denominator.checked_mul(d) else { return false };
        *numerator = i128::from(a) * i128::from(d) + i128::from(b) * i128::from(*denominator);
        *denominator = common;
        true
    }

    /// Adds `n / d`, after reducing both to lowest terms if necessary.
    #[inline]
    fn add(&mut self, words: Option<(i128, i64)>, value: impl FnOnce() -> Rational) {
        if words.is_some_and(|(n, d)| self.add_words(n, d)) {
            return;
        }
        let sum = self.0.value() + &value();
        self.0 = match sum.words() {
            Some((numerator, denominator)) => Words { numerator: numerator.into(), denominator },
            None => Reduced(sum),
        };
    }
}

impl Sum<Rational> for RationalSum {
    #[inline]
    fn term(a: &Rational) -> Self {
        RationalSum(match a.words() {
            Some((numerator, denominator)) => Words { numerator: numerator.into(), denominator },
            None => Reduced(a.clone()),
        })
    }
    #[inline]
    fn product(a: &Rational, b: &Rational) -> Self {
        match State::product(a, b) {
            Some((numerator, denominator)) => RationalSum(Words { numerator, denominator }),
            None => Self::term(&(a.clone() * b)),
        }
    }
    #[inline]
    fn add_term(&mut self, a: &Rational) {
        let words = a.words().map(|(n, d)| (n.into(), d));
        self.add(words, || a.clone());
    }
    #[inline]
    fn add_product(&mut self, a: &Rational, b: &Rational) {
        self.add(State::product(a, b), || a.clone() * b);
    }
    #[inline]
    fn finish(&self, _: Tolerance) -> Option<Rational> {
        match &self.0 {
            Words { numerator: 0, .. } => None,
            Reduced(value) if value.is_zero() => None,
            state => Some(state.value()),
        }
    }
}
