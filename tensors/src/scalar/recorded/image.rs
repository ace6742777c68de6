//! Values at a fixed point modulo two primes: the certificate by which recorded values differ.
//!
//! Two rational functions with different images are different. Two different ones of degree `d` share
//! an image with a probability below `d^2 / 2^122` (R. Zippel, *EUROSAM* 1979, 216-226; J. T. Schwartz,
//! *J. ACM* 27 (1980) 701-717): the coordinates of the point are hashes of the names. Sines and
//! cosines are rational functions of `tan(x/2)`, as in [`Symbolic`](crate::Symbolic).

use super::Function;
use crate::Rational;
use num_bigint::BigInt;
use num_integer::Integer;
use num_rational::{BigRational, Ratio};
use num_traits::ToPrimitive;

const PRIMES: [u64; 2] = [(1 << 61) - 1, (1 << 62) - 57];

/// The residues modulo both primes.
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
        // below a prime of 62 bits
        Self::each(|at| (product(at) % u128::from(PRIMES[at])) as u64)
    }

    pub fn negated(self) -> Self {
        Self::each(|at| if self.0[at] == 0 { 0 } else { PRIMES[at] - self.0[at] })
    }

    /// The inverse; `None` unless both residues are units.
    pub fn recip(self) -> Option<Self> {
        if self.0.contains(&0) {
            return None;
        }
        let power = |at: usize| {
            let p = u128::from(PRIMES[at]);
            let (mut base, mut result) = (u128::from(self.0[at]), 1);
            let mut exponent = PRIMES[at] - 2;
            while exponent > 0 {
                if exponent & 1 == 1 {
                    result = result * base % p;
                }
                base = base * base % p;
                exponent >>= 1;
            }
            result as u64
        };
        Some(Self::each(power))
    }

    /// The image of a number; `None` if a prime divides its denominator.
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
        // FNV-1a, then the finaliser of SplitMix64
        let hash = name.bytes().fold(0xcbf2_9ce4_8422_2325_u64, |hash, byte| {
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

    /// The image of a function of a variable.
    pub fn function(function: Function, name: &str) -> Option<Self> {
        if function == Function::Exp {
            return Some(Self::variable(&format!("exp({name})")));
        }
        let t = Self::variable(&format!("tan({name}/2)"));
        let below = Self::ONE.add(t.mul(t)).recip()?;
        Some(match function {
            Function::Sin => t.add(t).mul(below),
            _ => Self::ONE.add(t.mul(t).negated()).mul(below),
        })
    }

    /// The image with a vanishing residue is no certificate: `None`, unless both vanish.
    pub fn certain(self) -> Option<Self> {
        (self == Self::ZERO || !self.0.contains(&0)).then_some(self)
    }
}
