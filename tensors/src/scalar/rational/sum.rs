//! Sums of rationals. A sum is reduced to lowest terms only once, when it is complete.

use super::Rational;
use crate::{Sum, Tolerance};
use num_traits::Zero;

/// A sum `numerator / denominator + rest`. The fraction is not reduced, and consists of machine
/// integers; the remainder `rest` contains the terms that do not fit.
#[derive(Clone, Debug)]
pub struct RationalSum {
    numerator: i128,
    /// The denominator, which is positive.
    denominator: i64,
    rest: Rational,
}

impl Default for RationalSum {
    fn default() -> Self {
        RationalSum { numerator: 0, denominator: 1, rest: Rational::zero() }
    }
}

impl RationalSum {
    /// Adds `n / d` to the fraction. If the result does not fit, adds nothing and returns `None`.
    #[inline]
    fn add_words(&mut self, n: i128, d: i64) -> Option<()> {
        if self.numerator == 0 {
            (self.numerator, self.denominator) = (n, d);
        } else if self.denominator == d {
            self.numerator = self.numerator.checked_add(n)?;
        } else {
            // the products of words, and the sum of two products, are below 2^127
            let [a, b] = [self.numerator, n].map(i64::try_from);
            let (a, b) = (i128::from(a.ok()?), i128::from(b.ok()?));
            let common = self.denominator.checked_mul(d)?;
            self.numerator = a * i128::from(d) + b * i128::from(self.denominator);
            self.denominator = common;
        }
        Some(())
    }

    /// Adds `words` to the fraction if they are given and the result fits. Otherwise adds `value`
    /// to the remainder.
    #[inline]
    fn add(&mut self, words: Option<(i128, i64)>, value: impl FnOnce() -> Rational) {
        if words.and_then(|(n, d)| self.add_words(n, d)).is_none() {
            self.rest = self.value() + &value();
            self.numerator = 0;
        }
    }

    fn value(&self) -> Rational {
        let fraction = Rational::reduced(self.numerator, self.denominator.into());
        if self.rest.is_zero() { fraction } else { fraction + &self.rest }
    }
}

impl Sum<Rational> for RationalSum {
    #[inline]
    fn add_term(&mut self, a: &Rational) {
        let words = a.words().map(|(n, d)| (n.into(), d));
        self.add(words, || a.clone());
    }
    #[inline]
    fn add_product(&mut self, a: &Rational, b: &Rational) {
        let words = a
            .words()
            .zip(b.words())
            .and_then(|((n, d), (m, e))| Some((i128::from(n) * i128::from(m), d.checked_mul(e)?)));
        self.add(words, || a.clone() * b);
    }
    #[inline]
    fn finish(&self, _: Tolerance) -> Option<Rational> {
        Some(self.value()).filter(|value| !value.is_zero())
    }
}
