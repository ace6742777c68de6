//! Floating point that tracks its rounding.

use super::{Field, Kind, Notation, Rational, Ring, Sum, Tolerance};
use num_traits::{One, Zero};
use std::fmt;
use std::ops::{Add, Mul, Neg, Sub};

/// An `f64` with the error that it has come by: what it is too large by, through all stages of a
/// computation.
///
/// A plain `f64` is judged by the terms of the last sum alone: what is left of terms that cancel
/// enters the next sum as if it were exact. Here the rounding of every product and sum is computed,
/// which floats can do without error, and handed on to first order:
///
/// ```text
/// a + b:  e_a + e_b + (fl(a + b) - (a + b))
/// a b:    e_a b + a e_b - e_a e_b + (fl(a b) - a b)
/// 1/a:    -e_a/a^2 + (fl(1/a) - 1/a)
/// ```
///
/// A value counts as zero when that of an `f64` does, `|v| <= tau (sum of the |terms|)`, or when it
/// is its error: `|v - e| <= |v|/1024`. A value that has a correct digit is never taken for zero by
/// its error, however ill-conditioned the computation is. The values are those of `f64`.
///
/// The transformations without error are those of T. J. Dekker, *Numer. Math.* 18 (1971) 224-242, and
/// D. E. Knuth; the first-order correction is that of P. Langlois, *BIT* 41 (2001) 515-526.
///
/// ```
/// use affinor_tensors::{Notation, Rational, Ring, Sum, Tolerance, Tracked};
/// let number = |n, d| Tracked::from_rational(&Rational::new(n, d).unwrap()).unwrap();
/// // 1/3 * 3.1 - 3.1/3 leaves 2e-16 in place of 0
/// let rounding = number(1, 3) * number(31, 10) - number(31, 30);
/// let later = rounding * number(1_000_000, 1);
/// assert!(later.value() != 0.0);
/// assert!(<Tracked as Ring>::Sum::term(&later).finish(Tolerance::default()).is_none());
/// ```
#[derive(Clone, Copy)]
pub struct Tracked {
    value: f64,
    error: f64,
}

/// A value is its error if less than this share of it is left without.
const LEFT: f64 = 1.0 / 1024.0;

impl Tracked {
    /// A number that is meant exactly.
    pub const fn new(value: f64) -> Self {
        Tracked { value, error: 0.0 }
    }

    /// The value.
    pub const fn value(self) -> f64 {
        self.value
    }

    /// What the value is too large by, to first order.
    pub const fn error(self) -> f64 {
        self.error
    }
}

impl From<f64> for Tracked {
    fn from(value: f64) -> Self {
        Tracked::new(value)
    }
}

/// Whether nothing is left of a value without its error. An error that is not finite says nothing.
#[inline]
fn is_error(value: f64, error: f64) -> bool {
    (value - error).abs() <= LEFT * value.abs()
}

/// `fl(a + b)`, and what it is too large by.
#[inline(always)]
fn added(a: f64, b: f64) -> (f64, f64) {
    let sum = a + b;
    let second = sum - a;
    (sum, (second - b) + ((sum - second) - a))
}

/// The upper half of the digits.
#[inline(always)]
fn upper(a: f64) -> f64 {
    let shifted = 134_217_729.0 * a; // 2^27 + 1
    shifted - (shifted - a)
}

/// `fl(a b)`, and what it is too large by; not a number where the halves overflow.
#[inline(always)]
fn multiplied(a: f64, b: f64) -> (f64, f64) {
    let product = a * b;
    let (a1, b1) = (upper(a), upper(b));
    let (a2, b2) = (a - a1, b - b1);
    (product, ((product - a1 * b1) - a1 * b2 - a2 * b1) - a2 * b2)
}

/// A sum of values with its error, beside the sum of the magnitudes of its terms.
#[derive(Clone, Copy, Debug)]
pub struct TrackedSum {
    value: f64,
    error: f64,
    magnitude: f64,
}

impl TrackedSum {
    #[inline(always)]
    fn add(&mut self, other: TrackedSum) {
        let (value, rounding) = added(self.value, other.value);
        self.value = value;
        self.error += other.error + rounding;
        self.magnitude += other.magnitude;
    }

    fn plain(&self) -> Tracked {
        Tracked { value: self.value, error: self.error }
    }
}

impl Sum<Tracked> for TrackedSum {
    #[inline(always)]
    fn term(a: &Tracked) -> Self {
        TrackedSum { value: a.value, error: a.error, magnitude: a.value.abs() }
    }
    #[inline(always)]
    fn product(a: &Tracked, b: &Tracked) -> Self {
        let (value, rounding) = multiplied(a.value, b.value);
        let error = a.error * b.value + a.value * b.error - a.error * b.error + rounding;
        TrackedSum { value, error, magnitude: value.abs() }
    }
    #[inline(always)]
    fn add_term(&mut self, a: &Tracked) {
        self.add(Self::term(a));
    }
    #[inline(always)]
    fn add_product(&mut self, a: &Tracked, b: &Tracked) {
        self.add(Self::product(a, b));
    }
    fn finish(&self, tolerance: Tolerance) -> Option<Tracked> {
        let bound = tolerance.relative() * self.magnitude;
        let zero = self.value == 0.0 || (self.value.abs() <= bound && bound.is_finite());
        let error = tolerance.relative() > 0.0 && is_error(self.value, self.error);
        (!zero && !error).then(|| self.plain())
    }
}

/// Equal values; what is known of their errors does not matter.
impl PartialEq for Tracked {
    fn eq(&self, other: &Self) -> bool {
        self.value == other.value
    }
}

impl PartialOrd for Tracked {
    fn partial_cmp(&self, other: &Self) -> Option<std::cmp::Ordering> {
        self.value.partial_cmp(&other.value)
    }
}

impl Add<&Tracked> for Tracked {
    type Output = Tracked;
    fn add(self, other: &Tracked) -> Tracked {
        let mut sum = TrackedSum::term(&self);
        sum.add_term(other);
        sum.plain()
    }
}

impl Sub<&Tracked> for Tracked {
    type Output = Tracked;
    fn sub(self, other: &Tracked) -> Tracked {
        self + -*other
    }
}

impl Mul<&Tracked> for Tracked {
    type Output = Tracked;
    fn mul(self, other: &Tracked) -> Tracked {
        TrackedSum::product(&self, other).plain()
    }
}

impl Neg for Tracked {
    type Output = Tracked;
    fn neg(self) -> Tracked {
        Tracked { value: -self.value, error: -self.error }
    }
}

macro_rules! by_value {
    ($($operator:ident $method:ident),*) => {$(
        impl $operator for Tracked {
            type Output = Tracked;
            fn $method(self, other: Tracked) -> Tracked {
                $operator::$method(self, &other)
            }
        }
    )*};
}
by_value!(Add add, Sub sub, Mul mul);

impl Zero for Tracked {
    fn zero() -> Self {
        Tracked::new(0.0)
    }
    fn is_zero(&self) -> bool {
        self.value == 0.0
    }
}

impl One for Tracked {
    fn one() -> Self {
        Tracked::new(1.0)
    }
}

impl Ring for Tracked {
    type Sum = TrackedSum;

    fn from_i64(n: i64) -> Self {
        // of 64 digits a float has 53
        let value = n as f64;
        let error = (value as i128 - i128::from(n)) as f64;
        Tracked { value, error }
    }
    fn vanishes(&self) -> bool {
        self.value == 0.0
    }
    fn is_number(&self) -> bool {
        self.value.is_finite()
    }
    fn negligible(&self, beside: &Self, tolerance: Tolerance) -> bool {
        let bound = tolerance.relative() * beside.value.abs();
        let small = self.value.abs() <= bound && bound.is_finite();
        small || TrackedSum::term(self).finish(tolerance).is_none()
    }
    fn from_quotient(numerator: i64, denominator: i64) -> Option<Self> {
        let value = f64::from_quotient(numerator, denominator)?;
        let (n, d) = (Self::from_i64(numerator), Self::from_i64(denominator));
        let (product, rounding) = multiplied(value, d.value);
        let residual = (product - n.value) - rounding + n.error - value * d.error;
        Some(Tracked { value, error: residual / d.value })
    }
}

impl Field for Tracked {
    fn recip(&self) -> Option<Self> {
        let value = Field::recip(&self.value)?;
        // 1 - value self.value, and so the rounding of the division
        let (product, rounding) = multiplied(value, self.value);
        let residual = (1.0 - product) + rounding;
        Some(Tracked { value, error: -(residual + self.error * value) * value })
    }
    fn pivot_weight(&self) -> f64 {
        self.value.abs()
    }
}

impl Notation for Tracked {
    const KIND: Kind = Kind::Float;

    /// The nearest float, with what it is off by.
    fn from_rational(exact: &Rational) -> Option<Self> {
        let value = f64::from_rational(exact)?;
        let error = Rational::from_f64(value).map_or(0.0, |own| (own - exact).to_f64());
        Some(Tracked { value, error })
    }
    fn latex(&self) -> String {
        self.value.latex()
    }
    fn numerator_terms(&self) -> Vec<(Vec<(String, u32)>, Rational)> {
        self.value.numerator_terms()
    }
    fn to_f64(&self) -> Option<f64> {
        Some(self.value)
    }
    fn size(&self) -> usize {
        1
    }
}

/// As the `f64`.
impl fmt::Display for Tracked {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.value.fmt(f)
    }
}

/// The value and its error: `0.1 (off by 5e-18)`.
impl fmt::Debug for Tracked {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:?} (off by {:?})", self.value, self.error)
    }
}
