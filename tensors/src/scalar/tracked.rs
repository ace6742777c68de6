//! Floating point with a running estimate of the rounding error.

use super::operators::forward_operators;
use super::{Field, Kind, Notation, Rational, Ring, Sum, Summable, Tabular, Tolerance};
use crate::function::Function;
use std::fmt;
use std::ops::{Add, Mul, Neg};

/// An `f64` with its accumulated rounding error. The error is the computed value minus the exact
/// value, up to the rounding of the error itself.
///
/// A plain `f64` is compared only with the terms of the last sum. If terms cancel, the next sum
/// uses the remainder as if it were exact. In contrast, this type computes the rounding error of
/// every product and sum, which floating point allows exactly, and propagates it. Terms of second
/// order are included, because sums of large terms may consist mostly of such terms if a metric is
/// ill-conditioned.
///
/// ```text
/// a + b:  e_a + e_b + (fl(a + b) - (a + b))
/// a b:    e_a b + a e_b - e_a e_b + (fl(a b) - a b)
/// 1/a:    -e_a/(a (a - e_a)) + (fl(1/a) - 1/a)
/// ```
///
/// A value `v` with the error `e` counts as zero in three cases:
/// - it consists of its error: `|v - e| <= |v|/1024`. If a value has a correct digit, the error
///   therefore never makes it zero, even if the computation is ill-conditioned;
/// - it is below the tolerance, as for an `f64`: `|v| <= tau (sum of the |terms|)`;
/// - it is a sum of terms that all count as zero.
///
/// A tensor does not show such a component, but stores it. In the next sum, the value may cancel a
/// component that is shown, and the difference `v - e` between the value and its error may be large
/// compared with the result. The component is not stored if this difference is negligible:
/// `|v - e| <= 2^-40 |v|`.
///
/// The arithmetic uses the values of `f64`. The text ([`Display`](fmt::Display), [`Notation`])
/// shows the corrected value `v - e`.
///
/// The error-free transformations are those of T. J. Dekker, *Numer. Math.* 18 (1971) 224-242, and
/// D. E. Knuth. The correction follows P. Langlois, *BIT* 41 (2001) 515-526, which includes only
/// the first order.
///
/// ```
/// use affinor_tensors::{Notation, Rational, Sum, Summable, Tolerance, TrackedFloat};
/// let number = |n, d| TrackedFloat::from_rational(&Rational::new(n, d).unwrap()).unwrap();
/// // 1/3 * 3.1 - 3.1/3 leaves 2e-16 in place of 0
/// let rounding = number(1, 3) * number(31, 10) - number(31, 30);
/// let later = rounding * number(1_000_000, 1);
/// assert!(later.value() != 0.0);
/// assert!(<TrackedFloat as Summable>::Sum::term(&later).finish(Tolerance::default()).is_none());
/// ```
#[derive(Clone, Copy)]
pub struct TrackedFloat {
    value: f64,
    /// The error. Its last binary digit is a mark, because no error estimate is accurate to this
    /// digit. The mark is 1 if the value counts as zero in the sum from which it comes. Compared
    /// with a separate field, this mark saves a third of the memory of tensors with millions of
    /// components.
    marked_error: f64,
}

/// A value consists of its error if at most this fraction of it remains after subtraction of the
/// error.
const LEFT: f64 = 1.0 / 1024.0;

/// A remainder is negligible if it is at most this fraction of the value. Errors are not known more
/// accurately.
const NOTHING: f64 = 1.0 / (1u64 << 40) as f64;

impl TrackedFloat {
    /// An exact number.
    pub const fn new(value: f64) -> Self {
        TrackedFloat { value, marked_error: 0.0 }
    }

    const fn marked(value: f64, error: f64, small: bool) -> Self {
        TrackedFloat { value, marked_error: f64::from_bits(error.to_bits() & !1 | small as u64) }
    }

    const fn counts_as_zero(self) -> bool {
        self.marked_error.to_bits() & 1 == 1
    }

    /// A number whose computed value is too large by `error`.
    pub(crate) const fn with_error(value: f64, error: f64) -> Self {
        TrackedFloat::marked(value, error, false)
    }

    /// The value.
    pub const fn value(self) -> f64 {
        self.value
    }

    /// The rounding error, which is the computed value minus the exact value.
    pub const fn error(self) -> f64 {
        f64::from_bits(self.marked_error.to_bits() & !1)
    }

    /// The value minus the error. If the error overflows, it is the value.
    pub fn corrected(self) -> f64 {
        let corrected = self.value - self.error();
        if corrected.is_finite() { corrected } else { self.value }
    }

    /// An elementary function of the number. The result is `f(v)` with the error `f'(v) e`; the
    /// rounding error of `f` itself is not included.
    ///
    /// ```
    /// use affinor_tensors::{Notation, Rational, TrackedFloat, scalar::Function};
    /// // the float next to pi/2 is too small by 6e-17, and so is its cosine too large
    /// let angle: Rational = "1570796326794896619231321691639751/10^33".parse().unwrap();
    /// let cosine = TrackedFloat::from_rational(&angle).unwrap().applied(Function::Cos);
    /// assert!(cosine.value() > 6e-17 && cosine.corrected().abs() < 1e-30);
    /// ```
    #[must_use]
    pub fn applied(self, function: Function) -> Self {
        let value = function.value(self.value);
        let error = function.slope(self.value, value) * self.error();
        // replaces an infinite error by 0, because the slope of the square root is infinite at zero
        TrackedFloat::with_error(value, if error.is_finite() { error } else { 0.0 })
    }

    /// The number. Returns `None` if it consists of its error.
    pub fn significant(self, tolerance: Tolerance) -> Option<Self> {
        TrackedSum::term(&self).finish(tolerance)
    }
}

impl From<f64> for TrackedFloat {
    fn from(value: f64) -> Self {
        TrackedFloat::new(value)
    }
}

/// The sum of two magnitudes. If both are negative, the sum is negative, which means that all terms
/// count as zero.
#[inline(always)]
fn magnitudes(a: f64, b: f64) -> f64 {
    let sign = a.to_bits() & b.to_bits() & (1 << 63);
    f64::from_bits((a.abs() + b.abs()).to_bits() | sign)
}

/// The sum `fl(a + b)`, and its rounding error.
#[inline(always)]
fn added(a: f64, b: f64) -> (f64, f64) {
    let sum = a + b;
    let second = sum - a;
    (sum, (second - b) + ((sum - second) - a))
}

/// The upper half of the binary digits of a float.
#[inline(always)]
fn upper(a: f64) -> f64 {
    let shifted = 134_217_729.0 * a; // 2^27 + 1
    shifted - (shifted - a)
}

/// The product `fl(a b)`, and its rounding error. The error is NaN if a half overflows.
#[inline(always)]
fn multiplied(a: f64, b: f64) -> (f64, f64) {
    let product = a * b;
    let (a1, b1) = (upper(a), upper(b));
    let (a2, b2) = (a - a1, b - b1);
    (product, ((product - a1 * b1) - a1 * b2 - a2 * b1) - a2 * b2)
}

/// A sum with its rounding error, and with the sum of the magnitudes of its terms.
#[derive(Clone, Copy, Debug)]
pub struct TrackedSum {
    value: f64,
    error: f64,
    /// The sum of the magnitudes. It is negative if all terms count as zero.
    magnitude: f64,
}

/// The empty sum.
impl Default for TrackedSum {
    fn default() -> Self {
        TrackedSum { value: 0.0, error: 0.0, magnitude: -0.0 }
    }
}

impl TrackedSum {
    #[inline(always)]
    fn add(&mut self, other: TrackedSum) {
        let (value, rounding) = added(self.value, other.value);
        self.value = value;
        self.error += other.error + rounding;
        self.magnitude = magnitudes(self.magnitude, other.magnitude);
    }

    fn plain(&self) -> TrackedFloat {
        TrackedFloat::marked(self.value, self.error, self.magnitude.is_sign_negative())
    }

    /// Whether the value counts as zero.
    fn is_small(&self, tolerance: Tolerance) -> bool {
        self.magnitude.is_sign_negative()
            || tolerance.covers(self.value, self.magnitude)
            || self.leaves(LEFT, tolerance)
    }

    /// Whether at most the fraction `share` of the value remains after subtraction of the error.
    /// The result is false if the error is not finite.
    fn leaves(&self, share: f64, tolerance: Tolerance) -> bool {
        let tolerates = tolerance.relative() > 0.0;
        let exact = self.value == 0.0 && (self.error == 0.0 || !tolerates);
        let left = (self.value - self.error).abs();
        exact || (tolerates && self.value != 0.0 && left <= share * self.value.abs())
    }

    /// The magnitude of a term. It is negative if the term counts as zero.
    #[inline(always)]
    fn size(value: f64, small: bool) -> f64 {
        if small || value == 0.0 { -value.abs() } else { value.abs() }
    }
}

impl Sum<TrackedFloat> for TrackedSum {
    #[inline(always)]
    fn term(a: &TrackedFloat) -> Self {
        let magnitude = Self::size(a.value, a.counts_as_zero());
        TrackedSum { value: a.value, error: a.error(), magnitude }
    }
    #[inline(always)]
    fn product(a: &TrackedFloat, b: &TrackedFloat) -> Self {
        let (value, rounding) = multiplied(a.value, b.value);
        let (e, f) = (a.error(), b.error());
        let error = e * b.value + a.value * f - e * f + rounding;
        let small = a.counts_as_zero() || b.counts_as_zero();
        TrackedSum { value, error, magnitude: Self::size(value, small) }
    }
    #[inline(always)]
    fn add_term(&mut self, a: &TrackedFloat) {
        self.add(Self::term(a));
    }
    #[inline(always)]
    fn add_product(&mut self, a: &TrackedFloat, b: &TrackedFloat) {
        self.add(Self::product(a, b));
    }
    fn finish(&self, tolerance: Tolerance) -> Option<TrackedFloat> {
        (!self.is_small(tolerance)).then(|| self.plain())
    }
    fn kept(&self, tolerance: Tolerance) -> Option<TrackedFloat> {
        let kept = TrackedFloat::marked(self.value, self.error, self.is_small(tolerance));
        (!self.leaves(NOTHING, tolerance)).then_some(kept)
    }
}

/// Two tracked floats are equal if their values are equal. The errors are ignored.
impl PartialEq for TrackedFloat {
    fn eq(&self, other: &Self) -> bool {
        self.value == other.value
    }
}

impl PartialOrd for TrackedFloat {
    fn partial_cmp(&self, other: &Self) -> Option<std::cmp::Ordering> {
        self.value.partial_cmp(&other.value)
    }
}

impl Add<&TrackedFloat> for TrackedFloat {
    type Output = TrackedFloat;
    fn add(self, other: &TrackedFloat) -> TrackedFloat {
        let mut sum = TrackedSum::term(&self);
        sum.add_term(other);
        sum.plain()
    }
}

impl Mul<&TrackedFloat> for TrackedFloat {
    type Output = TrackedFloat;
    fn mul(self, other: &TrackedFloat) -> TrackedFloat {
        TrackedSum::product(&self, other).plain()
    }
}

impl Neg for TrackedFloat {
    type Output = TrackedFloat;
    fn neg(self) -> TrackedFloat {
        TrackedFloat { value: -self.value, marked_error: -self.marked_error }
    }
}

forward_operators!(TrackedFloat: Add add AddAssign add_assign, Sub sub SubAssign sub_assign,
    Mul mul MulAssign mul_assign);

impl Ring for TrackedFloat {
    fn from_i64(n: i64) -> Self {
        // computes the error, because a float stores only 53 of 64 binary digits
        let value = n as f64;
        let error = (value as i128 - i128::from(n)) as f64;
        TrackedFloat::with_error(value, error)
    }
    fn vanishes(&self) -> bool {
        self.value == 0.0
    }
    fn from_quotient(numerator: i64, denominator: i64) -> Option<Self> {
        let value = f64::from_quotient(numerator, denominator)?;
        let (n, d) = (Self::from_i64(numerator), Self::from_i64(denominator));
        let (product, rounding) = multiplied(value, d.value);
        let residual = (product - n.value) - rounding + n.error() - value * d.error();
        Some(TrackedFloat::with_error(value, residual / (d.value - d.error())))
    }
}

impl Summable for TrackedFloat {
    type Sum = TrackedSum;
    fn is_small(&self) -> bool {
        self.counts_as_zero()
    }
    fn is_number(&self) -> bool {
        self.value.is_finite()
    }
    fn negligible(&self, beside: &Self, tolerance: Tolerance) -> bool {
        let sum = TrackedSum { magnitude: beside.value.abs(), ..TrackedSum::term(self) };
        sum.finish(tolerance).is_none()
    }
}

impl Field for TrackedFloat {
    fn recip(&self) -> Option<Self> {
        let value = Field::recip(&self.value)?;
        // computes the rounding error of the division from the residual 1 - value * self.value
        let (product, rounding) = multiplied(value, self.value);
        let residual = (1.0 - product) + rounding;
        let error = -(residual + self.error() * value) / (self.value - self.error());
        Some(TrackedFloat::with_error(value, error))
    }
    fn pivot_weight(&self) -> f64 {
        self.value.abs()
    }
}

impl Notation for TrackedFloat {
    const KIND: Kind = Kind::Float;
    /// The float that is nearest to the number, with its rounding error.
    fn from_rational(exact: &Rational) -> Option<Self> {
        let value = f64::from_rational(exact)?;
        let error = Rational::from_f64(value).map_or(0.0, |own| (own - exact).to_f64());
        Some(TrackedFloat::with_error(value, error))
    }
    fn latex(&self) -> String {
        self.corrected().latex()
    }
    fn to_f64(&self) -> Option<f64> {
        Some(self.corrected())
    }
    fn size(&self) -> usize {
        1
    }
}

impl Tabular for TrackedFloat {}

/// Writes the corrected value.
impl fmt::Display for TrackedFloat {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.corrected().fmt(f)
    }
}

/// Writes the value and its error, such as `0.1 (off by 5e-18)`.
impl fmt::Debug for TrackedFloat {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:?} (off by {:?})", self.value, self.error())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The mark changes only the last digit of an error. It changes a negative error in the same
    /// way.
    #[test]
    fn an_error_keeps_its_digits_beside_the_mark() {
        for error in [0.0, 1.0, 1e-17, 0.1, 3e-300, 5e-324, f64::MAX, f64::INFINITY] {
            for (error, small) in [(error, false), (error, true), (-error, false), (-error, true)] {
                let value = TrackedFloat::marked(2.0, error, small);
                assert_eq!((value.counts_as_zero(), (-value).counts_as_zero()), (small, small));
                assert_eq!((-value).error(), -value.error());
                // the mark rounds the error towards zero, or does not change it
                let below = (error.abs().next_down()).copysign(error);
                assert!(
                    [error, below].contains(&value.error()),
                    "{error} became {}",
                    value.error()
                );
            }
        }
    }
}
