//! Floating point: `f64`, with a tolerance for zero within one sum of products.
//!
//! A result above the tolerance counts as exact in all later sums. In contrast, the scalar
//! [`TrackedFloat`](super::TrackedFloat) tracks rounding errors through all stages.

use super::{Field, Kind, Notation, Rational, Ring, Sum, Summable, Tabular, Tolerance};
use num_traits::One;

/// A sum of floats, and the sum of the magnitudes of its terms.
#[derive(Clone, Copy, Debug, Default)]
pub struct FloatSum {
    value: f64,
    magnitude: f64,
}

impl Sum<f64> for FloatSum {
    #[inline]
    fn add_term(&mut self, a: &f64) {
        self.value += a;
        self.magnitude += a.abs();
    }
    #[inline]
    fn add_product(&mut self, a: &f64, b: &f64) {
        self.add_term(&(a * b));
    }
    #[inline]
    fn finish(&self, tolerance: Tolerance) -> Option<f64> {
        (!tolerance.covers(self.value, self.magnitude)).then_some(self.value)
    }
}

impl Ring for f64 {
    fn from_i64(n: i64) -> Self {
        n as f64
    }
    fn vanishes(&self) -> bool {
        *self == 0.0
    }
    fn from_quotient(numerator: i64, denominator: i64) -> Option<Self> {
        (denominator != 0).then(|| numerator as f64 / denominator as f64)
    }
}

impl Summable for f64 {
    type Sum = FloatSum;
    fn is_number(&self) -> bool {
        self.is_finite()
    }
    fn negligible(&self, beside: &Self, tolerance: Tolerance) -> bool {
        tolerance.covers(*self, beside.abs())
    }
}

impl Field for f64 {
    fn recip(&self) -> Option<Self> {
        // values without an inverse are NaN, infinite values, and values whose inverse overflows
        let inverse = 1.0 / self;
        (self.is_finite() && inverse.is_finite()).then_some(inverse)
    }
    fn pivot_weight(&self) -> f64 {
        self.abs()
    }
}

impl Notation for f64 {
    const KIND: Kind = Kind::Float;
    fn from_rational(value: &Rational) -> Option<Self> {
        let x = value.to_f64();
        let kept = if x.is_normal() { true } else { x.is_finite() && shortest(x) == *value };
        kept.then_some(x)
    }
    fn latex(&self) -> String {
        let text = self.to_string();
        match text.split_once('e') {
            Some((mantissa, exponent)) => format!("{mantissa} \\times 10^{{{exponent}}}"),
            None => text,
        }
    }
    fn to_f64(&self) -> Option<f64> {
        Some(*self)
    }
    fn size(&self) -> usize {
        1
    }
}

impl Tabular for f64 {}

/// The shortest decimal that parses to this finite float. For a subnormal float, the exact value of
/// the float is this decimal, because the float has too few digits to represent any other.
fn shortest(x: f64) -> Rational {
    let text = format!("{x:e}");
    let (mantissa, exponent) = text.split_once('e').unwrap_or((&text, "0"));
    let digits: i64 = mantissa.replace('.', "").parse().unwrap_or(0);
    let behind = mantissa.split_once('.').map_or(0, |(_, behind)| behind.len()) as i32;
    let power = exponent.parse::<i32>().unwrap_or(0) - behind;
    let ten = num_traits::pow(Rational::from(10), power.unsigned_abs() as usize);
    let ten = if power < 0 { ten.recip().unwrap_or_else(Rational::one) } else { ten };
    Rational::from(digits) * &ten
}
