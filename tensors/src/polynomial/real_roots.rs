//! Isolation of real roots by Descartes' rule of signs and bisection (G. E. Collins, A. G. Akritas,
//! *Proc. SYMSAC '76*, 272-275), in integers.

use super::Univariate;
use crate::stop::checkpoint;
use crate::{Rational, Ring};
use num_bigint::BigInt;
use num_integer::Integer;
use num_rational::BigRational;
use num_traits::{One, Signed, Zero};
use std::cmp::Ordering;

/// An interval that contains exactly one root of a polynomial without multiple roots. Either both
/// ends are the root, or the polynomial has different signs at the ends.
#[derive(Clone, Debug)]
pub(super) struct Interval {
    pub low: Rational,
    pub high: Rational,
}

/// The polynomial with the same roots, all simple.
pub(super) fn squarefree(f: &Univariate) -> Univariate {
    match f.deg() {
        0 | 1 => f.clone(),
        _ => f / &f.gcd(&f.derivative()),
    }
}

/// The sign of a value.
pub(super) fn sign(value: &Rational) -> Ordering {
    value.cmp(&Rational::zero())
}

/// Isolating intervals of all real roots of a nonzero polynomial, in ascending order.
pub(super) fn isolate(f: &Univariate) -> Vec<Interval> {
    let f = squarefree(f);
    if f.deg() == 0 {
        return vec![];
    }
    let mut integers = integers(&f);
    let has_zero = integers[0].is_zero();
    if has_zero {
        integers.remove(0);
    }
    let mut found = vec![];
    for negative in [true, false] {
        let signed = integers.iter().enumerate().map(|(power, c)| match negative {
            true if power % 2 == 1 => -c,
            _ => c.clone(),
        });
        let mut positive = positive_roots(signed.collect());
        if negative {
            positive.reverse();
            positive.iter_mut().for_each(|(low, high)| {
                (*low, *high) = (-high.clone(), -low.clone());
            });
        }
        found.extend(positive);
        if negative && has_zero {
            found.push((Rational::zero(), Rational::zero()));
        }
    }
    found.into_iter().map(|(low, high)| opened(&f, low, high)).collect()
}

/// The coefficients as integers.
fn integers(f: &Univariate) -> Vec<BigInt> {
    let big: Vec<BigRational> = f.0.iter().map(BigRational::from).collect();
    let common = big.iter().fold(BigInt::one(), |common, c| common.lcm(c.denom()));
    big.iter().map(|c| c.numer() * (&common / c.denom())).collect()
}

/// Open intervals with one positive root each; intervals without length are roots. The constant
/// term is not zero.
fn positive_roots(f: Vec<BigInt>) -> Vec<(Rational, Rational)> {
    let degree = f.len() - 1;
    // all roots are less than 2^bound: Cauchy's bound 1 + max |c_i / c_n|
    let largest = f[..degree].iter().map(BigInt::bits).max().unwrap_or(0);
    let bound = (largest + 2).saturating_sub(f[degree].bits()).max(1);
    let scaled = f.into_iter().enumerate().map(|(power, c)| c << (bound * power as u64));
    let two = BigInt::from(2);
    let mut found = vec![];
    // a polynomial, whose roots in (0, 1) belong to the interval from c / 2^k to (c + 1) / 2^k
    let mut open = vec![(scaled.collect::<Vec<_>>(), BigInt::zero(), 0u32)];
    let place = |c: &BigInt, k: u32| -> Rational {
        let scale = BigRational::new(two.pow(bound as u32), two.pow(k));
        (BigRational::from(c.clone()) * scale).into()
    };
    while let Some((f, c, k)) = open.pop() {
        checkpoint();
        match variations(&f) {
            0 => {}
            1 => found.push((place(&c, k), place(&(&c + 1), k))),
            _ => {
                let degree = f.len() as u64 - 1;
                let left: Vec<BigInt> = f
                    .into_iter()
                    .enumerate()
                    .map(|(power, c)| c << (degree - power as u64))
                    .collect();
                let mut right = shifted(left.clone());
                let middle: BigInt = &c * 2 + 1;
                if right[0].is_zero() {
                    right.remove(0);
                    let root = place(&middle, k + 1);
                    found.push((root.clone(), root));
                }
                open.push((right, middle, k + 1));
                open.push((left, c * 2, k + 1));
            }
        }
    }
    found.sort();
    found
}

/// The polynomial `f(x + 1)`.
fn shifted(mut f: Vec<BigInt>) -> Vec<BigInt> {
    for end in 0..f.len() {
        for at in (end..f.len() - 1).rev() {
            let next = f[at + 1].clone();
            f[at] += next;
        }
    }
    f
}

/// The number of sign variations of `(1 + x)^n f(1 / (1 + x))`, which is at least the number of
/// roots in (0, 1), and equal to it if it is 0 or 1.
fn variations(f: &[BigInt]) -> usize {
    let reversed: Vec<BigInt> = f.iter().rev().cloned().collect();
    let image = shifted(reversed);
    let signs: Vec<bool> = image.iter().filter(|c| !c.is_zero()).map(Signed::is_positive).collect();
    signs.windows(2).filter(|pair| pair[0] != pair[1]).count()
}

/// Shrinks an open interval until its ends are not roots.
fn opened(f: &Univariate, mut low: Rational, mut high: Rational) -> Interval {
    let slope = f.derivative();
    let above = match sign(&f.eval(&low)) {
        Ordering::Equal => sign(&slope.eval(&low)),
        other => other,
    };
    while low < high && (f.eval(&low).vanishes() || f.eval(&high).vanishes()) {
        (low, high) = half(f, above, low, high);
    }
    Interval { low, high }
}

/// The half of an interval that contains the root; `above` is the sign of the polynomial above the
/// lower end.
fn half(f: &Univariate, above: Ordering, low: Rational, high: Rational) -> (Rational, Rational) {
    checkpoint();
    let middle = (low.clone() + &high) / &Rational::from(2);
    match sign(&f.eval(&middle)) {
        Ordering::Equal => (middle.clone(), middle),
        other if other == above => (middle, high),
        _ => (low, middle),
    }
}

impl Interval {
    /// Whether the root is known exactly.
    pub fn is_exact(&self) -> bool {
        self.low == self.high
    }

    /// Halves the interval. The polynomial must have the same root.
    pub fn refine(&mut self, f: &Univariate) {
        if !self.is_exact() {
            let above = sign(&f.eval(&self.low));
            let ends = half(f, above, self.low.clone(), self.high.clone());
            (self.low, self.high) = ends;
        }
    }

    /// Whether the root in this interval is a root of the divisor `g` of the polynomial.
    pub fn contains_root(&self, g: &Univariate) -> bool {
        match self.is_exact() {
            true => g.eval(&self.low).vanishes(),
            false => sign(&g.eval(&self.low)) != sign(&g.eval(&self.high)),
        }
    }

    /// An interval that contains the value of a polynomial at the root.
    pub fn image(&self, h: &Univariate) -> Interval {
        let zero = Rational::zero;
        let start = Interval { low: zero(), high: zero() };
        h.0.iter().rev().fold(start, |sum, c| {
            let ends = [&sum.low, &sum.high].into_iter();
            let products = ends.flat_map(|x| [&self.low, &self.high].map(|y| x.clone() * y));
            let products: Vec<Rational> = products.collect();
            let low = products.iter().min().cloned().unwrap_or_default();
            let high = products.iter().max().cloned().unwrap_or_default();
            Interval { low: low + c, high: high + c }
        })
    }

    /// Whether two intervals have a common point.
    pub fn meets(&self, other: &Self) -> bool {
        self.low <= other.high && other.low <= self.high
    }
}
