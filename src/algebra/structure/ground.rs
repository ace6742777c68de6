//! The ground fields of structure theory: exact scalars with signs and residues.

use affinor_tensors::linear::modular::Prime;
use affinor_tensors::{Field, Rational, Ring, Symbolic};
use std::cmp::Ordering;

/// An exact field of characteristic 0 whose elements have residues modulo primes.
///
/// Parameters take pseudorandom residues. A rank over rational functions is the rank at generic
/// values, so ranks of residues are generic ranks.
pub trait Ground: Field {
    /// The residue; `None` if the prime divides the denominator.
    fn residue(&self, prime: Prime) -> Option<u64>;

    /// The sign of a real number; `None` where it depends on parameters.
    fn sign(&self) -> Option<Ordering>;

    /// The value as a rational number, if it depends on no parameter.
    fn rational(&self) -> Option<Rational>;

    /// A rational number.
    fn from_rational(value: Rational) -> Self;

    /// The value as a rational function.
    fn symbolic(&self) -> Symbolic;
}

impl Ground for Rational {
    fn residue(&self, prime: Prime) -> Option<u64> {
        prime.rational(self)
    }

    fn sign(&self) -> Option<Ordering> {
        Some(match self {
            zero if zero.vanishes() => Ordering::Equal,
            negative if negative.is_negative() => Ordering::Less,
            _ => Ordering::Greater,
        })
    }

    fn rational(&self) -> Option<Rational> {
        Some(self.clone())
    }

    fn from_rational(value: Rational) -> Self {
        value
    }

    fn symbolic(&self) -> Symbolic {
        Symbolic::constant(self.clone())
    }
}

impl Ground for Symbolic {
    fn residue(&self, prime: Prime) -> Option<u64> {
        if let Some(constant) = self.as_constant() {
            return prime.rational(constant);
        }
        let polynomial = |part: &Symbolic| {
            part.terms().into_iter().try_fold(0, |sum, (powers, coefficient)| {
                let powers = powers.into_iter().map(|(variable, power)| {
                    polycore::modp::pow(place(variable.text(), prime), power.into(), prime.get())
                });
                let term = powers.fold(prime.rational(&coefficient)?, |a, b| prime.mul(a, b));
                Some(prime.add(sum, term))
            })
        };
        let denominator = prime.inv(polynomial(&self.denominator())?)?;
        Some(prime.mul(polynomial(&self.numerator())?, denominator))
    }

    fn sign(&self) -> Option<Ordering> {
        self.as_constant()?.sign()
    }

    fn rational(&self) -> Option<Rational> {
        self.as_constant().cloned()
    }

    fn from_rational(value: Rational) -> Self {
        Symbolic::constant(value)
    }

    fn symbolic(&self) -> Symbolic {
        self.clone()
    }
}

/// The residue of a parameter: a hash of its name (FNV-1a).
fn place(name: &str, prime: Prime) -> u64 {
    let mix = |hash: u64, byte: u8| (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3);
    name.bytes().fold(0xcbf2_9ce4_8422_2325, mix) % prime.get()
}
