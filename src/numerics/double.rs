//! Double-double numbers. They are unevaluated sums of two floats, and have a relative precision of
//! about `2^-104`.
//!
//! Sums and products are free of errors (T. J. Dekker, *Numerische Mathematik* 18 (1971) 224-242).
//! Products are computed by splitting, and not by fused multiply-add, so that results are the same
//! on every machine.

use affinor_tensors::stop::checkpoint;
use nalgebra::DMatrix;
use num_traits::{One, Zero};
use std::ops::{Add, AddAssign, Div, Mul, MulAssign, Neg, Sub, SubAssign};

/// The sum `high + low`, where `high` is the nearest float to the sum.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Double {
    high: f64,
    low: f64,
}

impl Double {
    /// The relative precision of sums and products.
    pub const EPSILON: f64 = f64::EPSILON * f64::EPSILON;

    /// The float that is nearest to the number.
    pub fn rounded(self) -> f64 {
        self.high
    }

    /// The product of the number and a power of two. The result must be in the range of floats.
    pub fn scaled(self, power: f64) -> Self {
        Double { high: self.high * power, low: self.low * power }
    }
}

impl From<f64> for Double {
    fn from(high: f64) -> Self {
        Double { high, low: 0.0 }
    }
}

/// The sum `a + b`, together with its rounding error.
fn sum(a: f64, b: f64) -> Double {
    let high = a + b;
    let part = high - a;
    Double { high, low: (a - (high - part)) + (b - part) }
}

/// The sum `a + b`, together with its rounding error, for `|a| >= |b|`.
fn ordered_sum(a: f64, b: f64) -> Double {
    let high = a + b;
    Double { high, low: b - (high - a) }
}

/// Splits a float into the upper and the lower half of its digits.
fn halves(a: f64) -> (f64, f64) {
    const SPLIT: f64 = 134_217_729.0; // 2^27 + 1
    let shifted = SPLIT * a;
    let upper = shifted - (shifted - a);
    (upper, a - upper)
}

/// The product `a b`, together with its rounding error.
fn product(a: f64, b: f64) -> Double {
    let high = a * b;
    let ((a, a_low), (b, b_low)) = (halves(a), halves(b));
    Double { high, low: ((a * b - high) + a * b_low + a_low * b) + a_low * b_low }
}

impl Add for Double {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        let (high, low) = (sum(self.high, other.high), sum(self.low, other.low));
        let first = ordered_sum(high.high, high.low + low.high);
        ordered_sum(first.high, first.low + low.low)
    }
}

impl Neg for Double {
    type Output = Self;

    fn neg(self) -> Self {
        Double { high: -self.high, low: -self.low }
    }
}

impl Sub for Double {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl Mul for Double {
    type Output = Self;

    fn mul(self, other: Self) -> Self {
        let first = product(self.high, other.high);
        ordered_sum(first.high, first.low + (self.high * other.low + self.low * other.high))
    }
}

impl Div for Double {
    type Output = Self;

    fn div(self, other: Self) -> Self {
        let first = self.high / other.high;
        let rest = self - other * first.into();
        let second = rest.high / other.high;
        let third = (rest - other * second.into()).high / other.high;
        ordered_sum(first, second) + third.into()
    }
}

impl AddAssign for Double {
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

impl SubAssign for Double {
    fn sub_assign(&mut self, other: Self) {
        *self = *self - other;
    }
}

impl MulAssign for Double {
    fn mul_assign(&mut self, other: Self) {
        *self = *self * other;
    }
}

impl Zero for Double {
    fn zero() -> Self {
        0.0.into()
    }

    fn is_zero(&self) -> bool {
        self.high == 0.0
    }
}

impl One for Double {
    fn one() -> Self {
        1.0.into()
    }
}

/// The matrix of floats that is nearest to a matrix.
pub(crate) fn rounded(m: &DMatrix<Double>) -> DMatrix<f64> {
    m.map(Double::rounded)
}

/// Applies a linear map of matrices of floats to both parts of the entries. The map must not cause
/// rounding errors.
pub(crate) fn mapped(
    m: &DMatrix<Double>,
    map: impl Fn(&DMatrix<f64>) -> DMatrix<f64>,
) -> DMatrix<Double> {
    map(&m.map(|value| value.high)).zip_map(&map(&m.map(|value| value.low)), ordered_sum)
}

/// The matrix `exp(m) - 1`. It is accurate also for small `m`. The function computes the series for
/// `2^-k m`, and then applies `x -> 2 x + x^2` `k` times.
pub(crate) fn exp_less_identity(m: &DMatrix<Double>) -> DMatrix<Double> {
    /// The series needs few terms if the norm is at most this value.
    const SHORT: f64 = 0.0625;
    let size = rounded(m).norm();
    let halvings = (size / SHORT).log2().ceil().clamp(0.0, 1100.0) as i32;
    let part = 2.0_f64.powi(-halvings);
    let x = m.map(|value| value.scaled(part));
    let (mut sum, mut term, mut k) = (x.clone(), x.clone(), 1.0);
    while rounded(&term).norm() > Double::EPSILON * size * part {
        checkpoint();
        k += 1.0;
        let divisor = Double::from(k);
        term = (term * &x).map(|value| value / divisor);
        sum += &term;
    }
    (0..halvings).fold(sum, |x, _| &x * &x + x.map(|value| value.scaled(2.0)))
}

/// The inverse of a matrix, computed by Gauss-Jordan elimination with partial pivoting. Returns
/// `None` if the matrix is singular.
pub(crate) fn inverse(m: &DMatrix<Double>) -> Option<DMatrix<Double>> {
    let n = m.nrows();
    let (mut m, mut inverse) = (m.clone(), DMatrix::identity(n, n));
    for k in 0..n {
        checkpoint();
        let size = |i: &usize| m[(*i, k)].rounded().abs();
        let pivot = (k..n).max_by(|i, j| size(i).total_cmp(&size(j)))?;
        m.swap_rows(k, pivot);
        inverse.swap_rows(k, pivot);
        if m[(k, k)].is_zero() {
            return None;
        }
        let reciprocal = Double::one() / m[(k, k)];
        for matrix in [&mut m, &mut inverse] {
            matrix.row_mut(k).iter_mut().for_each(|value| *value *= reciprocal);
        }
        for i in (0..n).filter(|i| *i != k) {
            let factor = -m[(i, k)];
            for matrix in [&mut m, &mut inverse] {
                for column in 0..n {
                    let product = factor * matrix[(k, column)];
                    matrix[(i, column)] += product;
                }
            }
        }
    }
    Some(inverse)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The results for integers of 100 bits agree with machine integers of 128 bits: sums and
    /// products are equal, and quotients invert products.
    #[test]
    fn doubles_have_a_hundred_digits() {
        let integer = |n: i128| {
            let high = n as f64;
            ordered_sum(high, (n - high as i128) as f64)
        };
        let back = |x: Double| x.high as i128 + x.low as i128;
        let mut state = 1_u64;
        let mut random = || {
            state = state
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1_442_695_040_888_963_407);
            i128::from((state >> 14) as i64 - (1 << 49))
        };
        for _ in 0..1000 {
            let [a, b, c, d] = [(); 4].map(|()| random());
            let (long, other) = (a * b, c * d);
            assert_eq!(back(integer(long) + integer(other)), long + other);
            assert_eq!(back(integer(long) - integer(other)), long - other);
            assert_eq!(back(integer(a) * integer(b)), long);
            let quotient = integer(long) / integer(other) * integer(other) - integer(long);
            assert!(quotient.high.abs() <= 8.0 * Double::EPSILON * (long as f64).abs());
        }
    }
}
