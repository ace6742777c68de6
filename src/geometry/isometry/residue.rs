//! Residues modulo the prime `2^255 - 19`, and the rational numbers with small numerators and
//! denominators that they represent.
//!
//! One residue determines a rational number whose numerator and denominator have less than 255 bits
//! together. The arithmetic takes the place of rational arithmetic, whose numbers grow with every
//! derivative of a metric.

use affinor_tensors::scalar::ExactSum;
use affinor_tensors::{Field, Rational, Ring, Scalar, Summable};
use num_bigint::{BigInt, BigUint, Sign};
use num_rational::{BigRational, Ratio};
use num_traits::{One, Signed, Zero};
use std::fmt;
use std::ops::{Add, Mul, Neg, Sub};

/// The prime `2^255 - 19`, in words of increasing weight.
const PRIME: [u64; 4] = [u64::MAX - 18, u64::MAX, u64::MAX, u64::MAX >> 1];
/// The number of bits that a numerator and its denominator may have together. The other bits show
/// that the rational number is not accidental: the probability is about `2^-50`.
const BITS: u64 = 205;

/// A residue modulo `2^255 - 19`, in words of increasing weight, below the prime.
#[derive(Clone, Copy, PartialEq, Eq)]
pub struct Residue([u64; 4]);

impl Residue {
    /// The residue of a rational number; `None` if the prime divides the denominator.
    pub fn of(value: &Rational) -> Option<Self> {
        if let Ok(words) = Ratio::<i64>::try_from(value) {
            return Self::from_quotient(*words.numer(), *words.denom());
        }
        let big = BigRational::from(value);
        Some(Self::integer(big.numer()) * Self::integer(big.denom()).recip()?)
    }

    fn integer(value: &BigInt) -> Self {
        let words = value.magnitude().to_u64_digits();
        // Horner's scheme in blocks of 64 bits
        let base = Residue([0, 1, 0, 0]);
        let horner = |sum: Self, word: &u64| sum * base + Residue([*word, 0, 0, 0]);
        let residue = words.iter().rev().fold(Self::zero(), horner);
        if value.sign() == Sign::Minus { -residue } else { residue }
    }

    /// The rational number with the shortest numerator and denominator that has this residue.
    /// Returns `None` if they have more than 205 bits together.
    pub fn rational(self) -> Option<Rational> {
        let big = |words: [u64; 4]| {
            let halves = words.into_iter().flat_map(|word| [word as u32, (word >> 32) as u32]);
            BigInt::from(BigUint::new(halves.collect()))
        };
        // the remainders of Euclid's algorithm are numerators, the cofactors denominators
        let (mut r, mut s) = ([big(PRIME), big(self.0)], [BigInt::zero(), BigInt::one()]);
        let length = |n: &BigInt, d: &BigInt| n.bits() + d.bits();
        let mut best = (r[1].clone(), s[1].clone());
        while !r[1].is_zero() {
            if length(&r[1], &s[1]) < length(&best.0, &best.1) {
                best = (r[1].clone(), s[1].clone());
            }
            let quotient = &r[0] / &r[1];
            let next = [&r[0] - &quotient * &r[1], &s[0] - &quotient * &s[1]];
            let [remainder, cofactor] = next;
            r = [std::mem::take(&mut r[1]), remainder];
            s = [std::mem::take(&mut s[1]), cofactor];
        }
        let (mut numerator, mut denominator) = best;
        if denominator.is_negative() {
            (numerator, denominator) = (-numerator, -denominator);
        }
        (length(&numerator, &denominator) <= BITS)
            .then(|| Rational::from(BigRational::new(numerator, denominator)))
    }

    /// The residue of `words` below `2^256`.
    fn reduced(mut words: [u64; 4]) -> Self {
        let top = words[3] >> 63;
        words[3] &= u64::MAX >> 1;
        let mut carry = u128::from(top) * 19;
        for word in &mut words {
            carry += u128::from(*word);
            *word = carry as u64;
            carry >>= 64;
        }
        if !below(&words) {
            words = difference(words, PRIME);
        }
        Residue(words)
    }

    fn power(self, exponent: &[u64; 4]) -> Self {
        let bits = (0..256).rev().map(|at| exponent[at / 64] >> (at % 64) & 1);
        bits.fold(Self::one(), |power, bit| {
            let square = power * power;
            if bit == 1 { square * self } else { square }
        })
    }
}

/// Whether the number is below the prime.
fn below(words: &[u64; 4]) -> bool {
    words.iter().rev().lt(PRIME.iter().rev())
}

/// The difference of two numbers, modulo `2^256`.
fn difference(a: [u64; 4], b: [u64; 4]) -> [u64; 4] {
    let mut borrow = false;
    std::array::from_fn(|at| {
        let (first, under) = a[at].overflowing_sub(b[at]);
        let (word, again) = first.overflowing_sub(borrow.into());
        borrow = under || again;
        word
    })
}

impl Add for Residue {
    type Output = Residue;
    fn add(self, other: Residue) -> Residue {
        let mut carry = 0u128;
        Residue::reduced(std::array::from_fn(|at| {
            carry += u128::from(self.0[at]) + u128::from(other.0[at]);
            let word = carry as u64;
            carry >>= 64;
            word
        }))
    }
}

impl Add<&Residue> for Residue {
    type Output = Residue;
    fn add(self, other: &Residue) -> Residue {
        self + *other
    }
}

impl Sub<&Residue> for Residue {
    type Output = Residue;
    fn sub(self, other: &Residue) -> Residue {
        self + (-*other)
    }
}

impl Neg for Residue {
    type Output = Residue;
    fn neg(self) -> Residue {
        if self.is_zero() { self } else { Residue(difference(PRIME, self.0)) }
    }
}

impl Mul for Residue {
    type Output = Residue;
    fn mul(self, other: Residue) -> Residue {
        let mut wide = [0u64; 8];
        for (i, a) in self.0.into_iter().enumerate() {
            let mut carry = 0u128;
            for (j, b) in other.0.into_iter().enumerate() {
                carry += u128::from(a) * u128::from(b) + u128::from(wide[i + j]);
                wide[i + j] = carry as u64;
                carry >>= 64;
            }
            wide[i + 4] = carry as u64;
        }
        // 2^256 = 38
        let mut words = [0; 4];
        let mut carry = 0u128;
        for at in 0..4 {
            carry += u128::from(wide[at]) + 38 * u128::from(wide[at + 4]);
            words[at] = carry as u64;
            carry >>= 64;
        }
        carry *= 38;
        for word in &mut words {
            carry += u128::from(*word);
            *word = carry as u64;
            carry >>= 64;
        }
        // a second overflow leaves a number below 2^12
        words[0] += 38 * carry as u64;
        Residue::reduced(words)
    }
}

impl Mul<&Residue> for Residue {
    type Output = Residue;
    fn mul(self, other: &Residue) -> Residue {
        self * *other
    }
}

impl Zero for Residue {
    fn zero() -> Self {
        Residue([0; 4])
    }
    fn is_zero(&self) -> bool {
        self.0 == [0; 4]
    }
}

impl One for Residue {
    fn one() -> Self {
        Residue([1, 0, 0, 0])
    }
}

impl Ring for Residue {
    fn from_i64(n: i64) -> Self {
        let magnitude = Residue([n.unsigned_abs(), 0, 0, 0]);
        if n < 0 { -magnitude } else { magnitude }
    }
    fn vanishes(&self) -> bool {
        self.is_zero()
    }
    fn from_quotient(numerator: i64, denominator: i64) -> Option<Self> {
        let numerator = Self::from_i64(numerator);
        match denominator {
            1 => Some(numerator),
            denominator => Some(numerator * Self::from_i64(denominator).recip()?),
        }
    }
}

impl Summable for Residue {
    type Sum = ExactSum<Self>;
}

impl Scalar for Residue {}

impl Field for Residue {
    fn recip(&self) -> Option<Self> {
        // Fermat: x^(p - 2)
        (!self.is_zero()).then(|| self.power(&difference(PRIME, [2, 0, 0, 0])))
    }
    fn pivot_weight(&self) -> f64 {
        if self.is_zero() { -1.0 } else { 0.0 }
    }
}

impl fmt::Display for Residue {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.rational() {
            Some(value) => value.fmt(f),
            None => write!(f, "{:x?}", self.0),
        }
    }
}

impl fmt::Debug for Residue {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Display::fmt(self, f)
    }
}
