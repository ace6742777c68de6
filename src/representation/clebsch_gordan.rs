//! Clebsch-Gordan coefficients, 3j and 6j symbols of su(2), and coupling tensors in a real basis.

use super::RepresentationError;
use affinor_tensors::stop::checkpoint;
use affinor_tensors::{Rational, Ring};
use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{One, Zero};
use std::fmt;
use std::str::FromStr;

/// The maximum spin.
pub const MAX_SPIN: i64 = 1000;

/// A spin `j` or a magnetic quantum number `m`: an integer or half an odd integer.
///
/// ```
/// use affinor::representation::Spin;
/// let half: Spin = "-3/2".parse()?;
/// assert_eq!((half.twice(), half.to_string().as_str()), (-3, "-3/2"));
/// # Ok::<(), affinor::representation::RepresentationError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Spin(i64);

impl Spin {
    /// The number `n/2`; `None` if its magnitude exceeds [`MAX_SPIN`].
    pub fn from_twice(n: i64) -> Option<Self> {
        (n.unsigned_abs() <= 2 * MAX_SPIN.unsigned_abs()).then_some(Spin(n))
    }

    /// Twice the number.
    pub fn twice(self) -> i64 {
        self.0
    }

    /// The numbers `-j, -j + 1, ..., j`.
    pub fn projections(self) -> impl DoubleEndedIterator<Item = Spin> + Clone {
        (0..=self.0).map(move |k| Spin(2 * k - self.0))
    }

    /// The total spins `|j - k|, ..., j + k` of the coupling of two spins.
    pub fn coupled(self, other: Spin) -> impl DoubleEndedIterator<Item = Spin> + Clone {
        let (least, greatest) = ((self.0 - other.0).abs(), self.0 + other.0);
        (0..=(greatest - least) / 2).map(move |k| Spin(least + 2 * k))
    }
}

impl fmt::Display for Spin {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.0 % 2 {
            0 => write!(f, "{}", self.0 / 2),
            _ => write!(f, "{}/2", self.0),
        }
    }
}

impl FromStr for Spin {
    type Err = RepresentationError;

    fn from_str(text: &str) -> Result<Self, RepresentationError> {
        let twice = match text.trim().split_once('/') {
            Some((n, "2")) => n.parse().ok(),
            Some(_) => None,
            None => text.trim().parse::<i64>().ok().and_then(|n| n.checked_mul(2)),
        };
        twice.and_then(Self::from_twice).ok_or_else(|| RepresentationError::NotASpin {
            text: text.into(),
            reason: format!(
                "write an integer or half an odd integer up to {MAX_SPIN}, such as 3/2"
            ),
        })
    }
}

/// A real number `±sqrt(q)` with a rational `q`.
///
/// ```
/// use affinor::Rational;
/// use affinor::representation::SignedRoot;
/// let root = SignedRoot::new(Rational::new(-1, 2).unwrap());
/// assert_eq!((root.to_string().as_str(), root.to_f64()), ("-sqrt(1/2)", -0.5_f64.sqrt()));
/// ```
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct SignedRoot(Rational);

impl SignedRoot {
    /// The number with this square, which carries the sign of the number.
    pub fn new(signed_square: Rational) -> Self {
        SignedRoot(signed_square)
    }

    /// The square, with the sign of the number.
    pub fn signed_square(&self) -> &Rational {
        &self.0
    }

    /// Whether the number is zero.
    pub fn is_zero(&self) -> bool {
        self.0.vanishes()
    }

    /// The nearest float of the square root of the nearest float of the square.
    pub fn to_f64(&self) -> f64 {
        let square = self.0.to_f64();
        square.abs().sqrt().copysign(square)
    }

    fn with_sign(square: BigRational, negative: bool) -> Self {
        let square = Rational::from(square);
        SignedRoot(if negative { -square } else { square })
    }

    /// The number times `±sqrt(q)`.
    fn times(&self, root: &Rational) -> Self {
        let negative = self.0.is_negative() != root.is_negative();
        let square = self.0.clone().abs() * &root.clone().abs();
        SignedRoot(if negative { -square } else { square })
    }
}

impl fmt::Display for SignedRoot {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let square = self.0.clone().abs();
        let sign = if self.0.is_negative() { "-" } else { "" };
        match square.sqrt() {
            Some(root) => write!(f, "{sign}{root}"),
            None => write!(f, "{sign}sqrt({square})"),
        }
    }
}

/// The Clebsch-Gordan coefficient `<j1 m1 j2 m2 | j m>` in the convention of Condon and Shortley:
/// all coefficients are real, and `<j1 j1 j2 (j-j1) | j j>` is positive. Zero if the spins do not
/// couple. The formula is Racah's (Edmonds, *Angular Momentum in Quantum Mechanics*, 3.6).
///
/// ```
/// use affinor::representation::{Spin, clebsch_gordan};
/// let [half, zero, up, down] = ["1/2", "0", "1/2", "-1/2"].map(|s| s.parse::<Spin>().unwrap());
/// let singlet = clebsch_gordan([half, up], [half, down], [zero, zero]);
/// assert_eq!(singlet.to_string(), "sqrt(1/2)");
/// let singlet = clebsch_gordan([half, down], [half, up], [zero, zero]);
/// assert_eq!(singlet.to_string(), "-sqrt(1/2)");
/// ```
#[doc(alias("Clebsch-Gordan", "vector coupling coefficient"))]
pub fn clebsch_gordan(first: [Spin; 2], second: [Spin; 2], total: [Spin; 2]) -> SignedRoot {
    let [[Spin(j1), Spin(m1)], [Spin(j2), Spin(m2)], [Spin(j), Spin(m)]] = [first, second, total];
    let allowed = |j: i64, m: i64| m.abs() <= j && (j - m) % 2 == 0;
    let fits = allowed(j1, m1) && allowed(j2, m2) && allowed(j, m);
    if !fits || m1 + m2 != m || !triangle(j1, j2, j) {
        return SignedRoot::new(Rational::from(0));
    }
    // all arguments below are twice an integer
    let denominators = |k: i64| {
        let factors =
            [j1 + j2 - j - k, j1 - m1 - k, j2 + m2 - k, j - j2 + m1 + k, j - j1 - m2 + k, k];
        let least = factors.iter().min().copied().unwrap_or(0);
        (least >= 0).then(|| product(factors))
    };
    let range = (0..=j1 + j2 - j).step_by(2);
    let terms = range.filter_map(|k| Some((k % 4 != 0, denominators(k)?)));
    let sum = alternating(terms.map(|(negative, below)| (negative, BigInt::one(), below)));
    let above = product([j + m, j - m, j1 - m1, j1 + m1, j2 - m2, j2 + m2]) * BigInt::from(j + 1);
    let square = delta(j1, j2, j) * BigRational::from(above) * &sum * &sum;
    SignedRoot::with_sign(square, sum < BigRational::zero())
}

/// The 3j symbol of Wigner,
/// `(j1 j2 j3; m1 m2 m3) = (-1)^(j1-j2-m3) <j1 m1 j2 m2 | j3 -m3> / sqrt(2 j3 + 1)`.
///
/// ```
/// use affinor::representation::{Spin, wigner_3j};
/// let [one, two, zero] = [2, 4, 0].map(|twice| Spin::from_twice(twice).unwrap());
/// assert_eq!(wigner_3j([one, zero], [one, zero], [two, zero]).to_string(), "sqrt(2/15)");
/// ```
#[doc(alias("3j symbol", "three-j"))]
pub fn wigner_3j(first: [Spin; 2], second: [Spin; 2], third: [Spin; 2]) -> SignedRoot {
    let [Spin(j3), Spin(m3)] = third;
    let value = clebsch_gordan(first, second, [Spin(j3), Spin(-m3)]);
    let odd = (first[0].0 - second[0].0 - m3) % 4 != 0;
    let factor = Rational::new(if odd { -1 } else { 1 }, j3 + 1);
    value.times(&factor.unwrap_or_default())
}

/// The 6j symbol `{j1 j2 j3; j4 j5 j6}` by the formula of Racah. Zero if one of the triples
/// `(j1 j2 j3)`, `(j1 j5 j6)`, `(j4 j2 j6)`, `(j4 j5 j3)` violates the triangle condition.
///
/// ```
/// use affinor::representation::{Spin, wigner_6j};
/// let one = Spin::from_twice(2).unwrap();
/// assert_eq!(wigner_6j([one; 3], [one; 3]).to_string(), "1/6");
/// ```
#[doc(alias("6j symbol", "six-j", "Racah W coefficient"))]
pub fn wigner_6j(upper: [Spin; 3], lower: [Spin; 3]) -> SignedRoot {
    let [a, b, c] = upper.map(Spin::twice);
    let [d, e, f] = lower.map(Spin::twice);
    let triples = [(a, b, c), (a, e, f), (d, b, f), (d, e, c)];
    if triples.iter().any(|&(x, y, z)| !triangle(x, y, z)) {
        return SignedRoot::new(Rational::from(0));
    }
    let least = triples.iter().map(|&(x, y, z)| x + y + z);
    let greatest = [a + b + d + e, b + c + e + f, c + a + f + d];
    let (from, to) = (least.max().unwrap_or(0), greatest.into_iter().min().unwrap_or(-1));
    let terms = (from..=to).step_by(2).map(|t| {
        let below = product(triples.map(|(x, y, z)| t - x - y - z));
        (t % 4 != 0, factorial(t + 2), below * product(greatest.map(|sum| sum - t)))
    });
    let sum = alternating(terms);
    let deltas = triples.map(|(x, y, z)| delta(x, y, z));
    let square = deltas.into_iter().fold(&sum * &sum, |all, one| all * one);
    SignedRoot::with_sign(square, sum < BigRational::zero())
}

/// The coupling tensor of three integer spins in a basis of real spherical harmonics, normalized so
/// that the sum of its squares is 1. The entry `[m1 + l1, m2 + l2, m3 + l3]` is at the position
/// `((m1 + l1)(2 l2 + 1) + m2 + l2)(2 l3 + 1) + m3 + l3`.
///
/// The tensor is invariant under rotations and unique up to its sign. The real basis vectors are
///
/// ```text
/// r_m = (-i)^l (e_(-m) + (-1)^m e_m)/sqrt(2),    r_0 = (-i)^l e_0,
/// r_(-m) = (-i)^(l+1) (e_(-m) - (-1)^m e_m)/sqrt(2)    for m > 0,
/// ```
///
/// with the basis `e_m` of Condon and Shortley. Basis and sign are those of `o3.wigner_3j` in the
/// library e3nn 0.6.
///
/// # Errors
/// [`RepresentationError::NotASpin`] if a spin is not an integer, is negative, or if the spins do
/// not couple.
///
/// ```
/// use affinor::representation::{Spin, real_coupling};
/// let one = Spin::from_twice(2).unwrap();
/// // the cross product
/// let tensor = real_coupling(one, one, one)?;
/// assert_eq!(tensor[5].to_string(), "sqrt(1/6)");
/// assert_eq!(tensor[7].to_string(), "-sqrt(1/6)");
/// # Ok::<(), affinor::representation::RepresentationError>(())
/// ```
pub fn real_coupling(l1: Spin, l2: Spin, l3: Spin) -> Result<Vec<SignedRoot>, RepresentationError> {
    for l in [l1, l2, l3] {
        if l.0 < 0 || l.0 % 2 != 0 {
            return Err(RepresentationError::NotASpin {
                text: l.to_string(),
                reason: "the real basis is defined for integers that are not negative".into(),
            });
        }
    }
    if !triangle(l1.0, l2.0, l3.0) {
        return Err(RepresentationError::NotASpin {
            text: l3.to_string(),
            reason: format!("the spins {l1} and {l2} do not couple to it"),
        });
    }
    let table: Vec<SignedRoot> = l1
        .projections()
        .flat_map(|i| l2.projections().map(move |k| (i, k)))
        .map(|(i, k)| clebsch_gordan([l1, i], [l2, k], [l3, Spin(i.0 + k.0)]))
        .collect();
    let mut tensor = vec![];
    for a in l1.projections() {
        for b in l2.projections() {
            checkpoint();
            for c in l3.projections() {
                tensor.push(real_entry(&table, [l1, l2, l3], [a, b, c]));
            }
        }
    }
    Ok(tensor)
}

/// An entry of [`real_coupling`]: the sum of `Q1_(i a) Q2_(k b) conj(Q3_(n c)) <i k | n>`, where the
/// table contains `<i k | i+k>` for all `i`, `k`.
fn real_entry(table: &[SignedRoot], [l1, l2, l3]: [Spin; 3], [a, b, c]: [Spin; 3]) -> SignedRoot {
    // the terms differ by powers of the imaginary unit, because `<-m1, -m2 | -m> = ± <m1, m2 | m>`
    let mut count = 0;
    let mut square = Rational::from(0);
    for (i, first, p) in in_standard_basis(l1, a) {
        for (k, second, q) in in_standard_basis(l2, b) {
            for (n, third, r) in in_standard_basis(l3, c) {
                let at = ((i.0 + l1.0) / 2) * (l2.0 + 1) + (k.0 + l2.0) / 2;
                let Some(value) = table.get(at as usize).filter(|value| !value.is_zero()) else {
                    continue;
                };
                if i.0 + k.0 != n.0 {
                    continue;
                }
                let halves = Rational::new(1, 1 << (p + q + r)).unwrap_or_default();
                square = value.signed_square().clone().abs() * &halves;
                let negative = if value.signed_square().is_negative() { 2 } else { 0 };
                // the imaginary terms cancel
                count += match (first + second - third + negative).rem_euclid(4) {
                    0 => 1,
                    2 => -1,
                    _ => 0,
                };
            }
        }
    }
    let norm = Rational::new(i64::signum(count) * count * count, l3.0 + 1);
    SignedRoot::new(square * &norm.unwrap_or_default())
}

/// The components `i^power / sqrt(2)^halves` of a real basis vector in the standard basis, as
/// `(m, power, halves)`.
fn in_standard_basis(l: Spin, m: Spin) -> Vec<(Spin, i64, u32)> {
    // the factor (-i)^l
    let phase = -(l.0 / 2);
    let odd = if m.0 % 4 == 0 { 0 } else { 2 };
    match m.0 {
        0 => vec![(m, phase, 0)],
        // -i/sqrt(2) at m, i (-1)^m/sqrt(2) at -m
        ..0 => vec![(m, phase - 1, 1), (Spin(-m.0), phase + 1 + odd, 1)],
        // (-1)^m/sqrt(2) at m, 1/sqrt(2) at -m
        _ => vec![(m, phase + odd, 1), (Spin(-m.0), phase, 1)],
    }
}

/// Whether three spins, given twice, satisfy the triangle condition.
fn triangle(a: i64, b: i64, c: i64) -> bool {
    (a + b + c) % 2 == 0 && (a - b).abs() <= c && c <= a + b
}

/// `(a+b-c)! (a-b+c)! (-a+b+c)! / (a+b+c+1)!` for spins that are given twice.
fn delta(a: i64, b: i64, c: i64) -> BigRational {
    BigRational::new(product([a + b - c, a - b + c, b + c - a]), factorial(a + b + c + 2))
}

/// The product of the factorials of numbers that are given twice.
fn product<const N: usize>(twice: [i64; N]) -> BigInt {
    twice.into_iter().fold(BigInt::one(), |all, n| all * factorial(n))
}

/// The factorial of a number that is given twice.
fn factorial(twice: i64) -> BigInt {
    (2..=twice / 2).fold(BigInt::one(), |all, n| all * n)
}

/// The sum of fractions `(negative, numerator, denominator)`.
fn alternating(terms: impl Iterator<Item = (bool, BigInt, BigInt)>) -> BigRational {
    terms.fold(BigRational::zero(), |sum, (negative, above, below)| {
        checkpoint();
        let term = BigRational::new(above, below);
        if negative { sum - term } else { sum + term }
    })
}
