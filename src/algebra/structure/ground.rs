//! The ground fields of structure theory: exact scalars with signs and residues.

use affinor_tensors::linear::modular::Prime;
use affinor_tensors::scalar::Variable;
use affinor_tensors::{Field, Rational, Ring, Scalar, Symbolic};
use std::cmp::Ordering;

/// An exact field of characteristic 0 whose elements have residues modulo primes.
///
/// Parameters and transcendental numbers have pseudorandom residues. A rank over rational functions
/// is the rank at generic values, so the rank of the residues equals it for almost all residues.
/// The residue of a root is a root of the residue, and satisfies the same equations.
pub trait GroundField: Field + Scalar {
    /// The residue of the value. `None` if the prime divides the denominator, or if a root in the
    /// value has no residue.
    fn residue(&self, prime: Prime) -> Option<u64>;

    /// The sign of a real number; `None` if it depends on parameters, or if approximations do not
    /// decide it.
    fn sign(&self) -> Option<Ordering>;

    /// The value as a rational number; `None` if it is irrational or has parameters.
    fn rational(&self) -> Option<Rational>;

    /// Converts a rational number to this field.
    fn from_rational(value: Rational) -> Self;

    /// The value as a rational function.
    fn symbolic(&self) -> Symbolic;
}

impl GroundField for Rational {
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

impl GroundField for Symbolic {
    fn residue(&self, prime: Prime) -> Option<u64> {
        if let Some(constant) = self.as_constant() {
            return prime.rational(constant);
        }
        let polynomial = |part: &Symbolic| {
            part.terms().into_iter().try_fold(0, |sum, (powers, coefficient)| {
                let term = powers.into_iter().try_fold(
                    prime.rational(&coefficient)?,
                    |product, (variable, power)| {
                        let value = place(variable, prime)?;
                        let power = polycore::modp::pow(value, power.into(), prime.get());
                        Some(prime.mul(product, power))
                    },
                )?;
                Some(prime.add(sum, term))
            })
        };
        let denominator = prime.inv(polynomial(&self.denominator())?)?;
        Some(prime.mul(polynomial(&self.numerator())?, denominator))
    }

    fn sign(&self) -> Option<Ordering> {
        if let Some(constant) = self.as_constant() {
            return constant.sign();
        }
        let signs = [sign_of_sum(&self.numerator())?, sign_of_sum(&self.denominator())?];
        Some(if signs[0] == signs[1] { Ordering::Greater } else { Ordering::Less })
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

/// The residue of a variable. The residue of a root is a root of the residue; the residue of
/// another variable is a hash of its name (FNV-1a).
fn place(variable: Variable, prime: Prime) -> Option<u64> {
    if let Some((argument, order)) = variable.root() {
        return root(argument.residue(prime)?, order, prime);
    }
    let mix = |hash: u64, byte: u8| (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3);
    Some(variable.text().bytes().fold(0xcbf2_9ce4_8422_2325, mix) % prime.get())
}

/// The root of order `order` that is a square modulo the prime; `None` unless there is exactly one.
///
/// If -1 is not a square, the squares form a group of odd order `q = (p - 1)/2`. Roots whose order
/// is coprime to `q` are unique in this group. Therefore, roots of products are products of roots,
/// and roots of roots are roots.
fn root(value: u64, order: u32, prime: Prime) -> Option<u64> {
    let (p, q, n) = (prime.get(), (prime.get() - 1) / 2, u64::from(order));
    let power = |exponent: u64| polycore::modp::pow(value, exponent, p);
    // the inverse of n modulo q is the integer (1 + k q)/n
    let inverse = (0..n).map(|k| 1 + k * q).find(|multiple| multiple.is_multiple_of(n))? / n;
    (q % 2 == 1 && power(q) == 1).then(|| power(inverse))
}

/// The sign of a nonzero polynomial in roots of numbers and pi. Returns `None` if the polynomial
/// has parameters, or if its terms nearly cancel.
fn sign_of_sum(sum: &Symbolic) -> Option<Ordering> {
    let (mut total, mut size) = (Rational::default(), Rational::default());
    for (powers, coefficient) in sum.terms() {
        let mut term = coefficient;
        for (variable, power) in powers {
            let value = Symbolic::variable(variable).approximation()?;
            term *= &num_traits::pow(value, power as usize);
        }
        total += &term;
        size += &term.abs();
    }
    // returns a sign only if the sum exceeds a bound far above the rounding errors of floats, which
    // approximate all functions except roots
    let decided = total.clone().abs() > size * &Rational::new(1, 1 << 30)?;
    total.sign().filter(|_| decided)
}
