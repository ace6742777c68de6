//! Images: values at a fixed point modulo two primes. They prove that recorded values differ.
//!
//! Two rational functions with different images are different. The probability that two different
//! rational functions of degree `d` have the same image is below `d^2 / 2^122` (R. Zippel,
//! *EUROSAM* 1979, 216-226; J. T. Schwartz, *J. ACM* 27 (1980) 701-717), because the coordinates of
//! the point are hashes of the names. Sines and cosines of `x` are rational functions of the
//! tangent of a fixed fraction of `x`, similar to `tan(x/2)` in [`Symbolic`](crate::Symbolic).

use super::Function;
use crate::Rational;
use num_bigint::BigInt;
use num_integer::Integer;
use num_rational::{BigRational, Ratio};
use num_traits::ToPrimitive;

/// Images of functions are computed for arguments that are divided by this number, so that the
/// addition theorems hold. The number is 100 times the least common multiple of the numbers up
/// to 20.
const PARTS: i64 = 23_279_256_000;

const PRIMES: [u64; 2] = [(1 << 61) - 1, (1 << 62) - 57];

/// The residues modulo the two primes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub(super) struct Image([u64; 2]);

impl Image {
    pub const ZERO: Image = Image([0; 2]);
    pub const ONE: Image = Image([1; 2]);

    fn each(f: impl Fn(usize) -> u64) -> Self {
        Image(std::array::from_fn(f))
    }

    pub fn add(self, other: Self) -> Self {
        Self::each(|at| {
            let sum = self.0[at] + other.0[at];
            if sum >= PRIMES[at] { sum - PRIMES[at] } else { sum }
        })
    }

    pub fn mul(self, other: Self) -> Self {
        let product = |at| u128::from(self.0[at]) * u128::from(other.0[at]);
        // the product fits, because both factors are below a prime of 62 bits
        Self::each(|at| (product(at) % u128::from(PRIMES[at])) as u64)
    }

    pub fn negated(self) -> Self {
        Self::each(|at| if self.0[at] == 0 { 0 } else { PRIMES[at] - self.0[at] })
    }

    /// The inverse. Returns `None` unless both residues are units.
    pub fn recip(self) -> Option<Self> {
        if self.0.contains(&0) {
            return None;
        }
        let inverse = |at: usize| {
            let p = u128::from(PRIMES[at]);
            power(u128::from(self.0[at]), 1, PRIMES[at] - 2, |a, b| a * b % p) as u64
        };
        Some(Self::each(inverse))
    }

    /// A representative of an image and its negative. It is the same for both.
    pub fn up_to_sign(self) -> Self {
        self.min(self.negated())
    }

    /// The image of a rational number. Returns `None` if a prime divides its denominator.
    pub fn rational(value: &Rational) -> Option<Self> {
        let modulo = |n: i64, p: u64| i128::from(n).rem_euclid(i128::from(p)) as u64;
        let [above, below] = match Ratio::<i64>::try_from(value) {
            Ok(ratio) => {
                [ratio.numer(), ratio.denom()].map(|n| Self::each(|at| modulo(*n, PRIMES[at])))
            }
            Err(_) => {
                let big = BigRational::from(value);
                let residue = |n: &BigInt, p: u64| n.mod_floor(&p.into()).to_u64().unwrap_or(0);
                [big.numer(), big.denom()].map(|n| Self::each(|at| residue(n, PRIMES[at])))
            }
        };
        if below == Self::ONE { Some(above) } else { Some(above.mul(below.recip()?)) }
    }

    /// The coordinate of the point that belongs to a variable.
    pub fn variable(name: &str) -> Self {
        Self::coordinate(name.bytes())
    }

    /// The coordinate of the point that belongs to a function of values with these images.
    pub fn named(function: &str, arguments: &[Image]) -> Self {
        let residues = arguments.iter().flat_map(|own| own.0).flat_map(u64::to_le_bytes);
        // adds a parenthesis, so that calls and names have different hashes: names contain no
        // parentheses
        Self::coordinate(function.bytes().chain([b'(']).chain(residues))
    }

    fn coordinate(bytes: impl Iterator<Item = u8>) -> Self {
        // hashes by FNV-1a, followed by the finalizer of SplitMix64
        let hash = bytes.fold(0xcbf2_9ce4_8422_2325_u64, |hash, byte| {
            (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3)
        });
        let mixed = |seed: u64| {
            let mut z = hash.wrapping_add(seed.wrapping_mul(0x9e37_79b9_7f4a_7c15));
            z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
            z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
            z ^ (z >> 31)
        };
        Self::each(|at| 2 + mixed(at as u64 + 1) % (PRIMES[at] - 4))
    }

    /// The image of the sine, cosine or exponential of a sum of multiples of values. It is computed
    /// by the addition theorems. Returns `None` if a coefficient is not a multiple of `1/PARTS`.
    pub fn function(function: Function, multiples: &[(Rational, Image)]) -> Option<Self> {
        let parts = Rational::from(PARTS);
        let parts_of = |factor: &Rational| {
            let ratio = Ratio::<i64>::try_from(&(factor.clone() * &parts)).ok()?;
            ratio.is_integer().then(|| ratio.to_integer())
        };
        let multiples = multiples.iter().map(|(factor, value)| Some((parts_of(factor)?, *value)));
        let multiples: Vec<(i64, Image)> = multiples.collect::<Option<_>>()?;
        if let Function::Exp | Function::Sinh | Function::Cosh | Function::Tanh = function {
            let e = multiples.into_iter().try_fold(Self::ONE, |product, (n, value)| {
                let e = Self::named("exp", &[value]);
                let e = if n < 0 { e.recip()? } else { e };
                Some(product.mul(power(e, Self::ONE, n.unsigned_abs(), Self::mul)))
            })?;
            let back = e.recip()?;
            let (sum, difference) = (e.add(back), e.add(back.negated()));
            let half = Self::ONE.add(Self::ONE).recip()?;
            return Some(match function {
                Function::Exp => e,
                Function::Sinh => difference.mul(half),
                Function::Cosh => sum.mul(half),
                _ => difference.mul(sum.recip()?),
            });
        }
        // computes p + iq, the product of all (1 + i tan(x/(2 PARTS)))^n
        let times = |[a, b]: [Self; 2], [c, d]: [Self; 2]| {
            [a.mul(c).add(b.mul(d).negated()), a.mul(d).add(b.mul(c))]
        };
        let one = [Self::ONE, Self::ZERO];
        let [p, q] = multiples.into_iter().fold(one, |product, (n, value)| {
            let t = Self::named("tan", &[value]);
            let t = if n < 0 { t.negated() } else { t };
            times(product, power([Self::ONE, t], one, n.unsigned_abs(), times))
        });
        let [pp, qq, pq] = [p.mul(p), q.mul(q), p.mul(q)];
        if function == Function::Tan {
            return Some(pq.add(pq).mul(pp.add(qq.negated()).recip()?));
        }
        let below = pp.add(qq).recip()?;
        match function {
            Function::Sin => Some(pq.add(pq).mul(below)),
            Function::Cos => Some(pp.add(qq.negated()).mul(below)),
            _ => None,
        }
    }

    /// Returns the image, unless exactly one residue vanishes. In this case, the image proves
    /// nothing, and the result is `None`.
    pub fn certain(self) -> Option<Self> {
        (self == Self::ZERO || !self.0.contains(&0)).then_some(self)
    }
}

/// The power `base^exponent`, computed by repeated squaring.
fn power<T: Copy>(mut base: T, one: T, mut exponent: u64, times: impl Fn(T, T) -> T) -> T {
    let mut result = one;
    while exponent > 0 {
        if exponent & 1 == 1 {
            result = times(result, base);
        }
        base = times(base, base);
        exponent >>= 1;
    }
    result
}
