//! Clebsch-Gordan coefficients, 3j and 6j symbols of su(2), and coupling tensors in a real basis.

use super::RepresentationError;
use affinor_tensors::stop::checkpoint;
use affinor_tensors::{Rational, Ring};
use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{One, Signed, Zero};
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

    /// The position of a magnetic quantum number, given twice, in the order `j, j - 1, ...`.
    fn position(self, m: i64) -> Option<usize> {
        let steps = self.0 - m;
        usize::try_from(steps / 2).ok().filter(|_| steps % 2 == 0)
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
        // the square is scaled by a power of 4, because it can be smaller than the least float
        let square = BigRational::from(&self.0);
        let shift = (square.denom().bits().saturating_sub(square.numer().bits()) / 2) as usize;
        let scaled = Rational::from(square * (BigInt::one() << (2 * shift))).to_f64();
        let root = scaled.abs().sqrt() * 0.5_f64.powi(shift as i32);
        root.copysign(scaled)
    }

    fn zero() -> Self {
        SignedRoot(Rational::from(0))
    }

    /// The number `sum sqrt(above/below)`.
    fn product(sum: BigInt, above: BigInt, below: BigInt) -> Self {
        // both factors are in lowest terms, so that only the faster product of `Rational` reduces
        let inverse = Rational::from(BigRational::new_raw(BigInt::one(), below));
        let square = Rational::from(BigRational::from_integer(above * &sum * &sum)) * &inverse;
        SignedRoot(if sum.is_negative() { -square } else { square })
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
/// couple. [`Coupling`] computes many coefficients of the same spins.
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
    let [[j1, m1], [j2, m2], [j, m]] = [first, second, total];
    Coupling::new(j1, j2, j)
        .filter(|_| m1.0 + m2.0 == m.0)
        .map_or_else(SignedRoot::zero, |coupling| coupling.coefficient(m1, m2))
}

/// The coefficients `<j1 m1 j2 m2 | j m1+m2>` of three spins. A value of this type contains the binomial
/// coefficients that all coefficients share.
///
/// With `a = j1+j2-j`, `p = j1-m1` and `q = j2+m2`, the coefficient is the product of the integer
/// `sum over k of (-1)^k C(a,k) C(2 j1-a,p-k) C(2 j2-a,q-k)` and the square root of
/// `C(2 j1,a) C(2 j2,a) / (C(j1+j2+j+1,a) C(2 j1,p) C(2 j2,q) C(2 j,j-m))`. This is the formula of
/// Racah (Edmonds, *Angular Momentum in Quantum Mechanics*, 3.6), in binomial coefficients.
///
/// ```
/// use affinor::representation::{Coupling, Spin};
/// let [half, one] = [1, 2].map(|twice| Spin::from_twice(twice).unwrap());
/// let coupling = Coupling::new(one, half, half).expect("the spins couple");
/// let values = coupling.pairs().map(|(m1, m2)| coupling.coefficient(m1, m2).to_string());
/// assert_eq!(values.collect::<Vec<_>>(), ["-sqrt(2/3)", "sqrt(1/3)", "-sqrt(1/3)", "sqrt(2/3)"]);
/// assert!(Coupling::new(half, half, half).is_none());
/// ```
#[derive(Clone, Debug)]
pub struct Coupling {
    spins: [Spin; 3],
    /// The binomial coefficients of `a`, `2 j1 - a` and `2 j2 - a`.
    terms: [Vec<BigInt>; 3],
    /// The binomial coefficients of `2 j1`, `2 j2` and `2 j`.
    norms: [Vec<BigInt>; 3],
    above: BigInt,
    below: BigInt,
}

impl Coupling {
    /// The coupling of two spins to a total spin; `None` if they do not couple to it.
    pub fn new(j1: Spin, j2: Spin, j: Spin) -> Option<Self> {
        let [a, b, c] = differences(j1.0, j2.0, j.0)?;
        let norms = [j1.0, j2.0, j.0].map(binomials);
        let above = binomial(j1.0, a) * binomial(j2.0, a);
        let below = binomial(a + j.0 + 1, a);
        Some(Coupling { spins: [j1, j2, j], terms: [a, b, c].map(binomials), norms, above, below })
    }

    /// The coefficient of two magnetic quantum numbers. Zero if one of them, or their sum, does not
    /// belong to its spin.
    pub fn coefficient(&self, m1: Spin, m2: Spin) -> SignedRoot {
        checkpoint();
        self.racah(m1, m2).unwrap_or_else(SignedRoot::zero)
    }

    /// The 3j symbol `(j1 j2 j; m1 m2 -m1-m2)`, see [`wigner_3j`].
    pub fn three_j(&self, m1: Spin, m2: Spin) -> SignedRoot {
        let [j1, j2, j] = self.spins;
        let odd = (j1.0 - j2.0 + m1.0 + m2.0) % 4 != 0;
        let factor = Rational::new(if odd { -1 } else { 1 }, j.0 + 1);
        self.coefficient(m1, m2).times(&factor.unwrap_or_default())
    }

    /// The pairs `(m1, m2)` with `|m1+m2| <= j`, in increasing order. The other coefficients vanish.
    pub fn pairs(&self) -> impl Iterator<Item = (Spin, Spin)> + use<> {
        let [j1, j2, j] = self.spins;
        let pairs = j1.projections().flat_map(move |m1| j2.projections().map(move |m2| (m1, m2)));
        pairs.filter(move |(m1, m2)| (m1.0 + m2.0).abs() <= j.0)
    }

    /// `None` if a magnetic quantum number does not belong to its spin.
    fn racah(&self, m1: Spin, m2: Spin) -> Option<SignedRoot> {
        let [j1, j2, j] = self.spins;
        let (p, q, r) = (j1.position(m1.0)?, j2.position(-m2.0)?, j.position(m1.0 + m2.0)?);
        let [x, y, z] = &self.norms;
        let below = &self.below * x.get(p)? * y.get(q)? * z.get(r)?;
        let [a, b, c] = &self.terms;
        let terms = a.iter().enumerate().filter_map(|(k, a)| {
            let term = a * b.get(p.checked_sub(k)?)? * c.get(q.checked_sub(k)?)?;
            Some(if k % 2 == 0 { term } else { -term })
        });
        Some(SignedRoot::product(terms.sum(), self.above.clone(), below))
    }
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
    let [[j1, m1], [j2, m2], [j3, m3]] = [first, second, third];
    Coupling::new(j1, j2, j3)
        .filter(|_| m1.0 + m2.0 + m3.0 == 0)
        .map_or_else(SignedRoot::zero, |coupling| coupling.three_j(m1, m2))
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
    let counts = triples.map(|(x, y, z)| ways(x, y, z));
    let (Some([z, y, x]), [Some(above), Some(n1), Some(n2), Some(n3)]) =
        (differences(a, b, c), counts)
    else {
        return SignedRoot::zero();
    };
    // sum over t of (-1)^t C(t+1, whole+1) times one binomial coefficient for each start
    let [whole, starts @ ..] = triples.map(|(x, y, z)| (x + y + z) / 2);
    let rows = [x, y, z].map(binomials);
    let least = starts.into_iter().fold(whole, i64::max);
    let mut first = binomial(least + 1, whole + 1);
    let mut sum = BigInt::zero();
    for t in least.. {
        checkpoint();
        let factors = rows.iter().zip(starts).map(|(row, start)| row.get((t - start) as usize));
        let Some(term) = factors.into_iter().try_fold(first.clone(), |all, one| Some(all * one?))
        else {
            break;
        };
        sum += if t % 2 == 0 { term } else { -term };
        first = first * (t + 2) / (t + 1 - whole);
    }
    SignedRoot::product(sum, above, n1 * n2 * n3)
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
    let Some(coupling) = Coupling::new(l1, l2, l3) else {
        return Err(RepresentationError::NotASpin {
            text: l3.to_string(),
            reason: format!("the spins {l1} and {l2} do not couple to it"),
        });
    };
    let pairs = || l1.projections().flat_map(|i| l2.projections().map(move |k| (i, k)));
    let table: Vec<SignedRoot> = pairs().map(|(i, k)| coupling.coefficient(i, k)).collect();
    let mut tensor = vec![];
    for (a, b) in pairs() {
        checkpoint();
        let sizes = [(a.0 + b.0).abs(), (a.0 - b.0).abs()];
        tensor.extend(l3.projections().map(|c| match sizes.contains(&c.0.abs()) {
            true => real_entry(&table, [l1, l2, l3], [a, b, c]),
            false => SignedRoot::zero(),
        }));
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

/// The integers `a+b-c`, `a-b+c`, `b+c-a` of spins that are given twice; `None` if the spins do not
/// satisfy the triangle condition.
fn differences(a: i64, b: i64, c: i64) -> Option<[i64; 3]> {
    let all = [a + b - c, a - b + c, b + c - a];
    all.iter().all(|n| *n >= 0 && n % 2 == 0).then(|| all.map(|n| n / 2))
}

/// The integer `(a+b+c+1)! / ((a+b-c)! (a-b+c)! (b+c-a)!)` for spins that are given twice.
fn ways(a: i64, b: i64, c: i64) -> Option<BigInt> {
    let [x, _, z] = differences(a, b, c)?;
    Some(binomial(z + a + 1, z) * binomial(a, x) * (a + 1))
}

/// The binomial coefficient `C(n, k)`.
fn binomial(n: i64, k: i64) -> BigInt {
    (0..k.min(n - k)).fold(BigInt::one(), |value, i| value * (n - i) / (i + 1))
}

/// The binomial coefficients `C(n, 0), ..., C(n, n)`.
fn binomials(n: i64) -> Vec<BigInt> {
    let mut row = vec![BigInt::one()];
    for i in 0..n {
        row.push(&row[row.len() - 1] * (n - i) / (i + 1));
    }
    row
}
