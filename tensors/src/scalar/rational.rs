//! Exact rationals. They never overflow, and they are never rounded.
//!
//! A value is stored in two machine words if it fits; otherwise it is stored in big integers. Every
//! result that fits is stored in words again, so equal values have equal forms. Common factors are
//! cancelled before numerators and denominators are multiplied (P. Henrici, *J. ACM* 3 (1956) 6-9).

mod sum;

use super::operators::forward_operators;
use super::{Field, Kind, Notation, Ring, Summable, Tabular, Variable};
use crate::expression::{Expression, ExpressionError};
use crate::stop::checkpoint;
use dashu_base::BitTest;
use dashu_int::{IBig, UBig};
use dashu_ratio::RBig;
use num_bigint::{BigInt, Sign};
use num_integer::Integer;
use num_rational::{BigRational, Ratio};
use num_traits::{One, ToPrimitive, Zero};
use std::cmp::Ordering;
use std::fmt;
use std::num::NonZeroI64;
use std::ops::{Add, Div, Mul, Neg};
pub use sum::RationalSum;

/// An exact rational number in lowest terms, with a positive denominator.
///
/// ```
/// use affinor_tensors::Rational;
/// let third = Rational::new(1, 3).unwrap();
/// assert_eq!((third.clone() + &third).to_string(), "2/3");
/// let big = Rational::from(i64::MAX) * &Rational::from(i64::MAX);
/// assert_eq!(big.to_string(), "85070591730234615847396907784232501249");
/// ```
#[derive(Clone, PartialEq, Eq, Hash)]
pub struct Rational(Form);

/// The canonical form. `Big` is used only if the numerator or the denominator does not fit in a
/// word.
#[derive(Clone, PartialEq, Eq, Hash)]
enum Form {
    Small { numerator: i64, denominator: NonZeroI64 },
    Big(Box<RBig>),
}
use Form::{Big, Small};

/// The denominator of integers.
const UNIT: NonZeroI64 = match NonZeroI64::new(1) {
    Some(unit) => unit,
    None => unreachable!(),
};

impl Rational {
    /// The number `numerator / denominator`. Returns `None` if the denominator is zero.
    pub fn new(numerator: i64, denominator: i64) -> Option<Self> {
        (denominator != 0).then(|| Self::reduced(numerator.into(), denominator.into()))
    }

    /// The integer with these decimal digits. Returns `None` if the text contains another
    /// character.
    pub fn from_digits(digits: &str) -> Option<Self> {
        if digits.is_empty() || !digits.bytes().all(|b| b.is_ascii_digit()) {
            return None;
        }
        let small = digits.parse::<i64>().ok().map(Self::from);
        small.or_else(|| Some(Self::demote(IBig::from_str_radix(digits, 10).ok()?.into())))
    }

    /// The exact value of a float. Returns `None` for infinities and NaN.
    pub fn from_f64(x: f64) -> Option<Self> {
        RBig::try_from(x).ok().map(Self::demote)
    }

    /// Whether the denominator is one.
    pub fn is_integer(&self) -> bool {
        match &self.0 {
            Small { denominator, .. } => denominator.get() == 1,
            Big(r) => r.denominator().is_one(),
        }
    }

    /// The value as a machine integer. Returns `None` if it is not a machine integer.
    pub fn to_i64(&self) -> Option<i64> {
        match self.0 {
            Small { numerator, denominator } if denominator.get() == 1 => Some(numerator),
            _ => None,
        }
    }

    /// The `f64` that is nearest to the value. It is infinite if the value is beyond the range of
    /// `f64`.
    pub fn to_f64(&self) -> f64 {
        match &self.0 {
            Small { numerator, denominator }
                if numerator.unsigned_abs() < 1 << 53 && denominator.get() < 1 << 53 =>
            {
                *numerator as f64 / denominator.get() as f64
            }
            _ => self.to_big().to_f64().value(),
        }
    }

    /// Whether the value is negative.
    pub fn is_negative(&self) -> bool {
        match &self.0 {
            Small { numerator, .. } => *numerator < 0,
            Big(r) => **r < RBig::ZERO,
        }
    }

    /// The content: the rational `q` for which the quotients of all values by `q` are coprime
    /// integers. The sign of `q` is the sign of the first value. If all values are zero, or there
    /// are no values, `q` is one.
    pub(crate) fn content<'r>(values: impl Iterator<Item = &'r Rational> + Clone) -> Self {
        let first = values.clone().find(|value| !value.vanishes());
        let Some(first) = first else { return Self::one() };
        let positive = match Self::content_in_words(values.clone()) {
            Some(content) => content,
            None => {
                let start = (BigInt::zero(), BigInt::one());
                let (above, below) = values.fold(start, |(above, below), value| {
                    let value = BigRational::from(value);
                    (above.gcd(value.numer()), below.lcm(value.denom()))
                });
                BigRational::new(above, below).into()
            }
        };
        if first.is_negative() { -positive } else { positive }
    }

    /// The magnitude of the content. Returns `None` unless all values fit machine words.
    fn content_in_words<'r>(values: impl Iterator<Item = &'r Rational>) -> Option<Self> {
        let (mut above, mut below) = (0u64, 1u64);
        for value in values {
            let (numerator, denominator) = value.words()?;
            if above != 1 {
                above = gcd(above, numerator.unsigned_abs());
            }
            if denominator != 1 {
                let denominator = denominator.unsigned_abs();
                below = (below / gcd(below, denominator)).checked_mul(denominator)?;
            }
        }
        Some(Self::reduced(above.into(), below.into()))
    }

    /// The number of characters of the text, without a sign.
    pub(crate) fn letters(&self) -> usize {
        let digits = |n: i64| n.unsigned_abs().checked_ilog10().unwrap_or(0) as usize + 1;
        match self.words() {
            Some((numerator, 1)) => digits(numerator),
            Some((numerator, denominator)) => digits(numerator) + 1 + digits(denominator),
            None => self.to_string().trim_start_matches('-').len(),
        }
    }

    /// The absolute value.
    pub fn abs(self) -> Self {
        if self.is_negative() { -self } else { self }
    }

    /// The nonnegative square root. Returns `None` if it is irrational.
    ///
    /// ```
    /// use affinor_tensors::Rational;
    /// assert_eq!(Rational::new(9, 4).and_then(|x| x.sqrt()), Rational::new(3, 2));
    /// assert_eq!(Rational::from(2).sqrt(), None);
    /// ```
    pub fn sqrt(&self) -> Option<Self> {
        if self.is_negative() {
            return None;
        }
        let value = BigRational::from(self);
        let exact = |n: &BigInt| {
            let root = n.sqrt();
            (&root * &root == *n).then_some(root)
        };
        Some(BigRational::new(exact(value.numer())?, exact(value.denom())?).into())
    }

    /// The quotient in lowest terms. The denominator must not be zero.
    pub(super) fn reduced(numerator: i128, denominator: i128) -> Self {
        if let (Ok(n), Ok(d)) = (i64::try_from(numerator), i64::try_from(denominator))
            && n != i64::MIN
            && d > 0
        {
            // in the most frequent case, the denominator is one, or both numbers fit single words
            let gcd = if d == 1 { 1 } else { gcd(n.unsigned_abs(), d.unsigned_abs()) as i64 };
            return Self::coprime((n / gcd).into(), (d / gcd).into());
        }
        // the gcd fits in a signed integer, because both magnitudes are below 2^127
        let gcd = numerator.unsigned_abs().gcd(&denominator.unsigned_abs()) as i128;
        let gcd = gcd * denominator.signum();
        Self::coprime(numerator / gcd, denominator / gcd)
    }

    /// The quotient of a numerator and a positive denominator, which must be coprime.
    fn coprime(numerator: i128, denominator: i128) -> Self {
        Self::small(numerator, denominator).unwrap_or_else(|| {
            let denominator = UBig::from(denominator.unsigned_abs());
            Rational(Big(Box::new(RBig::from_parts(numerator.into(), denominator))))
        })
    }

    /// The quotient of a coprime numerator and denominator as words. Returns `None` unless both fit
    /// in words and the denominator is positive.
    #[inline]
    fn small(numerator: impl TryInto<i64>, denominator: impl TryInto<i64>) -> Option<Self> {
        let (numerator, denominator) = (numerator.try_into().ok()?, denominator.try_into().ok()?);
        Some(Rational(Small { numerator, denominator: NonZeroI64::new(denominator)? }))
    }

    /// The numerator and the denominator. Returns `None` unless the value is stored in words.
    #[inline]
    fn words(&self) -> Option<(i64, i64)> {
        match self.0 {
            Small { numerator, denominator } => Some((numerator, denominator.get())),
            Big(_) => None,
        }
    }

    fn to_big(&self) -> RBig {
        match &self.0 {
            Small { numerator, denominator } => RBig::from_parts(
                IBig::from(*numerator),
                UBig::from(denominator.get().unsigned_abs()),
            ),
            Big(r) => (**r).clone(),
        }
    }

    /// Stores the result of an operation in words if it fits. The sums and products of long numbers
    /// often fit.
    fn demote(value: RBig) -> Self {
        checkpoint();
        Self::small(value.numerator(), value.denominator())
            .unwrap_or_else(|| Rational(Big(Box::new(value))))
    }
}

impl From<Ratio<i64>> for Rational {
    fn from(r: Ratio<i64>) -> Self {
        Self::reduced((*r.numer()).into(), (*r.denom()).into())
    }
}

impl From<BigRational> for Rational {
    fn from(r: BigRational) -> Self {
        let magnitude = |n: &BigInt| UBig::from_le_bytes(&n.to_bytes_le().1);
        let numerator = IBig::from(magnitude(r.numer()));
        let signed = if r.numer().sign() == Sign::Minus { -numerator } else { numerator };
        Self::demote(RBig::from_parts(signed, magnitude(r.denom())))
    }
}

impl From<&Rational> for BigRational {
    fn from(r: &Rational) -> Self {
        let big = r.to_big();
        let integer = |sign, n: &UBig| BigInt::from_bytes_le(sign, &n.to_le_bytes());
        let sign = if r.is_negative() { Sign::Minus } else { Sign::Plus };
        let (_, magnitude) = big.numerator().clone().into_parts();
        BigRational::new(integer(sign, &magnitude), integer(Sign::Plus, big.denominator()))
    }
}

impl TryFrom<&Rational> for Ratio<i64> {
    type Error = NotWords;
    /// Returns an error, and does not round, if the numerator or the denominator does not fit in 64
    /// bits.
    fn try_from(r: &Rational) -> Result<Self, NotWords> {
        r.words().map(|(n, d)| Ratio::new_raw(n, d)).ok_or(NotWords)
    }
}

/// The numerator or the denominator does not fit in 64 bits.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("the rational does not fit into two 64-bit words")]
pub struct NotWords;

impl Add<&Rational> for Rational {
    type Output = Rational;
    fn add(self, other: &Rational) -> Rational {
        match (self.words(), other.words()) {
            // the sum |a d + c b| <= 2 * 2^63 * (2^63 - 1) fits in 128 bits
            (Some((a, b)), Some((c, d))) if b == d => {
                Rational::reduced(i128::from(a) + i128::from(c), b.into())
            }
            (Some((a, b)), Some((c, d))) => {
                let [a, b, c, d] = [a, b, c, d].map(i128::from);
                Rational::reduced(a * d + c * b, b * d)
            }
            _ => Rational::demote(self.to_big() + other.to_big()),
        }
    }
}

impl Mul<&Rational> for Rational {
    type Output = Rational;
    fn mul(self, other: &Rational) -> Rational {
        match (self.words(), other.words()) {
            (Some((a, 1)), Some((c, 1))) => Rational::reduced(i128::from(a) * i128::from(c), 1),
            (Some((a, b)), Some((c, d))) => {
                let (g, h) = (common(a, d), common(c, b));
                let [a, b, c, d] = [a, b, c, d].map(i128::from);
                Rational::coprime((a / g) * (c / h), (b / h) * (d / g))
            }
            _ => Rational::demote(self.to_big() * other.to_big()),
        }
    }
}

/// The gcd of a numerator and a positive denominator. It is at least 1.
fn common(numerator: i64, denominator: i64) -> i128 {
    gcd(numerator.unsigned_abs(), denominator.unsigned_abs()).into()
}

/// The greatest common divisor, computed by J. Stein's binary algorithm. The algorithm has one
/// branch, which processors predict well.
fn gcd(a: u64, b: u64) -> u64 {
    if a == 0 || b == 0 {
        return a | b;
    }
    let shift = (a | b).trailing_zeros();
    let (mut a, mut b) = (a >> a.trailing_zeros(), b >> b.trailing_zeros());
    while a != b {
        let difference = a.abs_diff(b);
        a = a.min(b);
        b = difference >> difference.trailing_zeros();
    }
    a << shift
}

impl Neg for Rational {
    type Output = Rational;
    fn neg(self) -> Rational {
        match self.0 {
            Small { numerator, denominator } if numerator != i64::MIN => {
                Rational(Small { numerator: -numerator, denominator })
            }
            _ => Rational::demote(-self.to_big()),
        }
    }
}

impl Div<&Rational> for Rational {
    type Output = Rational;
    /// # Panics
    /// If `other` is zero, as for integers. [`Field::recip`] returns `None` instead.
    #[expect(clippy::suspicious_arithmetic_impl, reason = "dividing is multiplying by the inverse")]
    fn div(self, other: &Rational) -> Rational {
        self * &other.recip().expect("division by zero")
    }
}

forward_operators!(Rational: Add add AddAssign add_assign, Sub sub SubAssign sub_assign,
    Mul mul MulAssign mul_assign, Div div DivAssign div_assign);

impl std::str::FromStr for Rational {
    type Err = ExpressionError;

    /// Parses an [`Expression`] of numbers, such as `-3/4`, `0.25`, `1e-3`.
    fn from_str(text: &str) -> Result<Self, ExpressionError> {
        Expression::parse(text)?.evaluate_constant()
    }
}

/// Converts integers exactly. Returns `None` for a fraction, and for an integer that does not fit
/// in the type.
impl ToPrimitive for Rational {
    fn to_i64(&self) -> Option<i64> {
        Rational::to_i64(self)
    }
    fn to_u64(&self) -> Option<u64> {
        if self.is_integer() { u64::try_from(self.to_big().numerator()).ok() } else { None }
    }
    fn to_f64(&self) -> Option<f64> {
        Some(Rational::to_f64(self))
    }
}

impl Ord for Rational {
    fn cmp(&self, other: &Self) -> Ordering {
        match (self.words(), other.words()) {
            (Some((a, b)), Some((c, d))) => {
                (i128::from(a) * i128::from(d)).cmp(&(i128::from(c) * i128::from(b)))
            }
            _ => self.to_big().cmp(&other.to_big()),
        }
    }
}

impl PartialOrd for Rational {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl fmt::Display for Rational {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match &self.0 {
            Small { numerator, denominator } if denominator.get() == 1 => {
                write!(f, "{numerator}")
            }
            Small { numerator, denominator } => write!(f, "{numerator}/{denominator}"),
            Big(r) => write!(f, "{r}"),
        }
    }
}

impl fmt::Debug for Rational {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Display::fmt(self, f)
    }
}

impl Ring for Rational {
    fn from_i64(n: i64) -> Self {
        Rational(Small { numerator: n, denominator: UNIT })
    }
    fn vanishes(&self) -> bool {
        matches!(self.0, Small { numerator: 0, .. })
    }
    fn from_quotient(numerator: i64, denominator: i64) -> Option<Self> {
        Self::new(numerator, denominator)
    }
}

impl Summable for Rational {
    type Sum = RationalSum;
    fn clear_denominators<'a>(
        values: impl Iterator<Item = &'a Self> + Clone,
    ) -> Option<(Vec<i64>, i64)> {
        let mut denominator = 1i64;
        for value in values.clone() {
            let (_, d) = value.words()?;
            if denominator % d != 0 {
                denominator = denominator.checked_mul(d / denominator.gcd(&d))?;
            }
        }
        let scale = |value: &Self| {
            let (n, d) = value.words()?;
            if d == denominator { Some(n) } else { n.checked_mul(denominator / d) }
        };
        let integers = values.map(scale).collect::<Option<_>>()?;
        Some((integers, denominator))
    }
    fn clear_to_big<'a>(
        values: impl Iterator<Item = &'a Self> + Clone,
    ) -> Option<(Vec<IBig>, UBig)> {
        let (mut denominator, mut longest) = (UBig::ONE, 0);
        for value in values.clone() {
            let own = value.to_big();
            let own = own.denominator();
            longest = longest.max(own.bit_len());
            if !(&denominator % own).is_zero() {
                let common = dashu_base::Gcd::gcd(&denominator, own);
                denominator *= own / common;
            }
            if denominator.bit_len() > 2 * longest + UNRELATED {
                return None;
            }
        }
        let scale = |value: &Self| {
            let value = value.to_big();
            value.numerator() * IBig::from(&denominator / value.denominator())
        };
        let integers = values.map(scale).collect();
        Some((integers, denominator))
    }
    fn from_big_quotient(numerator: &IBig, denominator: &UBig) -> Option<Self> {
        Some(Self::demote(RBig::from_parts(numerator.clone(), denominator.clone())))
    }
}

/// If a common denominator is longer than twice the longest denominator by more than this number of
/// bits, the denominators count as unrelated.
const UNRELATED: usize = 64;

impl Field for Rational {
    fn recip(&self) -> Option<Self> {
        match self.words() {
            Some((0, _)) => None,
            Some((n, d)) => Some(Self::reduced(d.into(), n.into())),
            None => Some(Self::demote(RBig::ONE / self.to_big())),
        }
    }
    fn pivot_weight(&self) -> f64 {
        -(self.size() as f64)
    }
}

impl Notation for Rational {
    const KIND: Kind = Kind::Exact;
    fn from_rational(value: &Rational) -> Option<Self> {
        Some(value.clone())
    }
    fn numerator_terms(&self) -> Vec<(Vec<(Variable, u32)>, Rational)> {
        if self.is_zero() { vec![] } else { vec![(vec![], self.clone())] }
    }
    fn to_f64(&self) -> Option<f64> {
        Some(Rational::to_f64(self))
    }
    fn latex(&self) -> String {
        let sign = if self.is_negative() { "-" } else { "" };
        let size = self.clone().abs().to_string();
        match size.split_once('/') {
            Some((above, below)) => format!("{sign}\\frac{{{above}}}{{{below}}}"),
            None => sign.to_owned() + &size,
        }
    }
    fn is_negative(&self) -> bool {
        Rational::is_negative(self)
    }
    fn size(&self) -> usize {
        use dashu_base::BitTest;
        match self.words() {
            Some((n, d)) => (128 - n.unsigned_abs().leading_zeros() - d.leading_zeros()) as usize,
            None => {
                let big = self.to_big();
                big.numerator().bit_len() + big.denominator().bit_len()
            }
        }
    }
}

impl Tabular for Rational {}
