//! Real algebraic numbers: a polynomial and an isolating interval of one of its roots.

use super::Univariate;
use super::factors::univariate_factors;
use super::real_roots::{Interval, isolate};
use crate::text::rounded;
use crate::{Rational, Ring};
use num_traits::{One, Zero};
use polycore::Uni;
use std::cmp::Ordering;
use std::fmt;

/// A real algebraic number. It is the only root of a polynomial with coprime integer coefficients in
/// an interval with rational ends.
///
/// ```
/// use affinor_tensors::polynomial::RealNumber;
/// use affinor_tensors::Rational;
/// // x^2 - 2
/// let roots = RealNumber::roots(&[-2, 0, 1].map(Rational::from));
/// assert_eq!(roots.len(), 2);
/// assert_eq!(roots[1].decimal(10), "1.414213562");
/// assert_eq!(roots[0].to_string(), "-sqrt(2)");
/// ```
#[derive(Clone, Debug)]
pub struct RealNumber {
    polynomial: Univariate,
    interval: Interval,
}

impl RealNumber {
    /// The real roots of a polynomial, in ascending order. The coefficients begin with the constant
    /// term. The zero polynomial has no list of roots, and yields none.
    pub fn roots(coefficients: &[Rational]) -> Vec<Self> {
        let f = Uni::new(coefficients.to_vec());
        if f.deg() == 0 {
            return vec![];
        }
        let mut found: Vec<Self> = univariate_factors(&f).iter().flat_map(Self::roots_of).collect();
        found.sort_by(Self::compare);
        found
    }

    /// The roots of a polynomial without multiple roots, in ascending order.
    pub(super) fn roots_of(f: &Univariate) -> Vec<Self> {
        let content = Rational::content(f.0.iter().rev());
        let polynomial = f.scale(&(Rational::one() / &content));
        let number = |interval| RealNumber { polynomial: polynomial.clone(), interval };
        isolate(&polynomial).into_iter().map(number).collect()
    }

    /// The rational number with this value.
    pub fn from_rational(value: Rational) -> Self {
        let linear = Uni::new(vec![-value.clone(), Rational::one()]);
        let content = Rational::content(linear.0.iter().rev());
        let polynomial = linear.scale(&(Rational::one() / &content));
        RealNumber { polynomial, interval: Interval { low: value.clone(), high: value } }
    }

    /// Whether the isolating interval meets an interval, after it has become shorter.
    pub(super) fn may_be_in(&self, other: &Interval) -> bool {
        let mut own = self.interval.clone();
        if other.is_exact() {
            return own.meets(other) && self.polynomial.eval(&other.low).vanishes();
        }
        let width = other.high.clone() - &other.low;
        while !own.is_exact() && own.high.clone() - &own.low > width {
            own.refine(&self.polynomial);
        }
        own.meets(other)
    }

    /// The coefficients of the defining polynomial, which begin with the constant term. They are
    /// coprime integers. The polynomial is irreducible, unless its factors are too hard to find.
    pub fn polynomial(&self) -> &[Rational] {
        &self.polynomial.0
    }

    /// The degree of the defining polynomial.
    pub fn degree(&self) -> usize {
        self.polynomial.deg()
    }

    /// The value, if it is rational.
    pub fn rational(&self) -> Option<Rational> {
        match &self.polynomial.0[..] {
            [constant, lead] => Some(-constant.clone() / lead),
            _ => self.interval.is_exact().then(|| self.interval.low.clone()),
        }
    }

    /// An interval with rational ends that contains no other root of the polynomial, and is shorter
    /// than `width`.
    pub fn interval(&self, width: &Rational) -> [Rational; 2] {
        let mut interval = self.interval.clone();
        while interval.high.clone() - &interval.low > *width {
            interval.refine(&self.polynomial);
        }
        [interval.low, interval.high]
    }

    /// The sign of the number.
    pub fn sign(&self) -> Ordering {
        self.compare(&Self::from_rational(Rational::zero()))
    }

    /// Compares two numbers. The result is exact.
    pub fn compare(&self, other: &Self) -> Ordering {
        let common = self.polynomial.gcd(&other.polynomial);
        let (mut x, mut y) = (self.interval.clone(), other.interval.clone());
        // two roots of the common divisor are equal if they belong to the same interval
        let may_agree = common.deg() > 0 && x.contains_root(&common) && y.contains_root(&common);
        let shared = if may_agree { isolate(&common) } else { vec![] };
        loop {
            match (x.high < y.low, y.high < x.low) {
                (true, _) => return Ordering::Less,
                (_, true) => return Ordering::Greater,
                _ => {}
            }
            let near = |z: &Interval| {
                let mut all = shared.iter().enumerate().filter(|(_, other)| other.meets(z));
                all.next().filter(|_| all.next().is_none()).map(|(at, _)| at)
            };
            match (near(&x), near(&y)) {
                (Some(i), Some(j)) if i == j => return Ordering::Equal,
                _ if x.is_exact() && y.is_exact() => return x.low.cmp(&y.low),
                _ => {}
            }
            x.refine(&self.polynomial);
            y.refine(&other.polynomial);
        }
    }

    /// The value as a float, correct up to one unit in the last place.
    pub fn to_f64(&self) -> f64 {
        let mut interval = self.interval.clone();
        loop {
            let [low, high] = [interval.low.to_f64(), interval.high.to_f64()];
            let width = (high - low).abs();
            if interval.is_exact() || width <= f64::EPSILON / 2.0 * low.abs().min(high.abs()) {
                return low;
            }
            interval.refine(&self.polynomial);
        }
    }

    /// The value as a decimal number, truncated after some significant digits.
    pub fn decimal(&self, digits: u32) -> String {
        let truncated = |x: &Rational| rounded(x, digits, x.is_negative());
        if let Some(value) = self.rational() {
            return truncated(&value).unwrap_or_else(|| value.to_string());
        }
        let mut interval = self.interval.clone();
        loop {
            let ends = [&interval.low, &interval.high].map(truncated);
            if let [Some(low), Some(high)] = ends
                && low == high
            {
                return low;
            }
            // numbers beyond the range of floats have no decimal form
            let tiny = Rational::new(1, i64::MAX)
                .is_some_and(|x| interval.high.clone() - &interval.low < x.clone() * &x * &x * &x);
            if tiny {
                return interval.low.to_string();
            }
            interval.refine(&self.polynomial);
        }
    }

    /// The numbers `p`, `q`, `d` of a number `p + q sqrt(d)` of degree two.
    fn surd(&self) -> Option<(Rational, Rational, Rational)> {
        let [c, b, a] = &self.polynomial.0[..] else { return None };
        let twice = a.clone() * &Rational::from(2);
        let four = Rational::from(4);
        let mut discriminant = b.clone() * b - &(four * &(a.clone() * c));
        let mut factor = Rational::one() / &twice.clone().abs();
        // extracts square factors
        let mut root = 2;
        while root <= 1000 && Rational::from(root * root) <= discriminant {
            let quotient = discriminant.clone() / &Rational::from(root * root);
            match quotient.is_integer() {
                true => {
                    discriminant = quotient;
                    factor *= &Rational::from(root);
                }
                false => root += 1,
            }
        }
        let centre = -b.clone() / &twice;
        let below = self.compare(&Self::from_rational(centre.clone())) == Ordering::Less;
        Some((centre, if below { -factor } else { factor }, discriminant))
    }
}

/// Writes a rational number, a number `p + q sqrt(d)`, or the first ten digits of another number.
impl fmt::Display for RealNumber {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Some(value) = self.rational() {
            return write!(f, "{value}");
        }
        let Some((p, q, d)) = self.surd() else { return f.write_str(&self.decimal(10)) };
        let minus = if q.is_negative() { "-" } else { "" };
        let q = q.abs();
        let (above, below) = (num_rational::BigRational::from(&q).numer().clone(), &q);
        let below = num_rational::BigRational::from(below).denom().clone();
        let root = match above == One::one() {
            true => format!("sqrt({d})"),
            false => format!("{above}*sqrt({d})"),
        };
        let root = if below == One::one() { root } else { format!("{root}/{below}") };
        match p.vanishes() {
            true => write!(f, "{minus}{root}"),
            false => write!(f, "{p} {} {root}", if minus.is_empty() { "+" } else { "-" }),
        }
    }
}

impl PartialEq for RealNumber {
    fn eq(&self, other: &Self) -> bool {
        self.compare(other) == Ordering::Equal
    }
}
