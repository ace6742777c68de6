//! Written forms with roots in the denominator, such as `1/(2 + sqrt(x))^2` instead of
//! `(x - 4*sqrt(x) + 4)/(x - 4)^2`.
//!
//! The unique form of a value has no roots in its denominator. A factor `g = q r` of the
//! denominator may be a product of conjugates: `x - 4` is the product of `sqrt(x) - 2` and
//! `sqrt(x) + 2`. The numerator is divided by `q` as often as the division is exact. Without this
//! division, the written form would be `0/0` where `q` vanishes.

use super::argument::by_power;
use super::fraction::Fraction;
use super::variable::{Kind, Part, Variable};
use super::{Form, Symbolic};
use crate::scalar::{Field, Ring};
use num_traits::{One, Zero, pow};

/// The value with roots in its denominator, if this form cancels a factor of the numerator.
/// Otherwise, the value is unchanged.
pub(super) fn cancelled(value: Symbolic) -> Symbolic {
    let Form::Fraction(f) = &value.0 else { return value };
    let root = |variable: &Variable| match variable.kind() {
        Kind::Root(part) => Some((*variable, part)),
        _ => None,
    };
    let mut roots = f.variables.iter().filter_map(root);
    let found = roots.find_map(|(v, part)| {
        let over = Root { v, part, free: Variable::function(Kind::FreeRoot(part.clone())) };
        over.as_variable(f).or_else(|| over.by_divisors(f))
    });
    found.unwrap_or(value)
}

/// A root `v^n = p`, and a variable without this relation, which represents the root.
struct Root {
    v: Variable,
    part: &'static Part,
    free: Variable,
}

impl Root {
    /// Writes the value as a quotient of polynomials in `v` instead of `x`, in lowest terms. This
    /// requires `p = a*x + b` with a number `a`, and a variable `x` that does not occur in any
    /// function.
    fn as_variable(&self, f: &Fraction) -> Option<Symbolic> {
        let (p, n) = (&self.part.of, self.part.parts);
        let alone = |x: &Variable| {
            let others = f.variables.iter().filter(|own| *own != x && **own != self.v);
            x.is_parameter()
                && others.into_iter().all(|own| own.parameters().all(|inner| inner != *x))
        };
        let linear = |x: &Variable| match &by_power(p, *x)[..] {
            [b, a] if a.as_constant().is_some() => Some((*x, a.clone(), b.clone())),
            _ => None,
        };
        let inside = p.variables().iter().filter(|x| f.variables.contains(x) && alone(x));
        let (x, a, b) = inside.filter_map(linear).next()?;
        let free = Symbolic::variable(self.free);
        let image = (pow(free.clone(), n as usize) - &b) / &a;
        let over = |polynomial: &Symbolic| {
            let by_x = by_power(&self.freed(polynomial), x).into_iter().rev();
            by_x.fold(Symbolic::zero(), |sum, c| sum * &image + &c)
        };
        let value = Symbolic::from(f.clone());
        let mut degree = 0;
        let mut reduced = over(&value.numerator());
        for (factor, e) in f.denominator.parts(&f.variables) {
            let factor = over(&f.polynomial(&factor.expanded(&f.variables)));
            degree += self.degree(&factor) * e as usize;
            reduced *= &pow(factor.recip()?, e as usize);
        }
        let Form::Fraction(reduced) = &reduced.0 else { return None };
        let at = reduced.variables.iter().position(|own| *own == self.free);
        let power = at.map_or(0, |at| reduced.denominator.exponent(at) as usize);
        let factors = reduced.denominator.factors.iter();
        let left: usize = factors
            .map(|(g, e)| {
                self.degree(&reduced.polynomial(&g.over(&reduced.variables))) * *e as usize
            })
            .sum();
        let lost = degree - left - power;
        // returns `None` if only a power of the root cancels, because another function moves it to
        // the denominator
        if lost == 0 || left == 0 {
            return None;
        }
        let below = reduced.denominator.parts(&reduced.variables).into_iter();
        let below = below.map(|(g, e)| (reduced.polynomial(&g.expanded(&reduced.variables)), e));
        let numerator = reduced.polynomial(&reduced.numerator);
        let mut inverse = below.map(|(g, e)| match g == free {
            true => self.in_roots(&pow(g, e as usize)).recip(),
            false => Some(pow(self.in_roots(&g).recip()?, e as usize)),
        });
        inverse.try_fold(self.in_roots(&numerator), |product, factor| Some(product * &factor?))
    }

    fn degree(&self, polynomial: &Symbolic) -> usize {
        by_power(polynomial, self.free).len().saturating_sub(1)
    }

    /// The polynomial in which high powers of the root replace powers of `p`.
    fn in_roots(&self, polynomial: &Symbolic) -> Symbolic {
        let (p, n) = (&self.part.of, self.part.parts as usize);
        let free = Symbolic::variable(self.free);
        let terms = by_power(polynomial, self.free).into_iter().enumerate();
        let terms = terms.map(|(e, c)| c * &pow(p.clone(), e / n) * &pow(free.clone(), e % n));
        terms.fold(Symbolic::zero(), |sum, term| sum + &term)
    }

    /// The polynomial in which the variable without a relation replaces the root.
    fn freed(&self, polynomial: &Symbolic) -> Symbolic {
        let free = Symbolic::variable(self.free);
        let terms = by_power(polynomial, self.v).into_iter().rev();
        terms.fold(Symbolic::zero(), |sum, c| sum * &free + &c)
    }

    /// Divides the value by common divisors of the numerator and a factor of the denominator. Both
    /// are regarded as polynomials in a variable on which `p` does not depend.
    fn by_divisors(&self, f: &Fraction) -> Option<Symbolic> {
        let factors = f.denominator.irreducible(&f.variables)?;
        let value = Symbolic::from(f.clone());
        let mut numerator = value.numerator();
        let mut below = Symbolic::one();
        let mut found = false;
        for (factor, e) in factors {
            let factor = f.polynomial(&factor);
            let usable = |z: &&Variable| {
                let outside = |other: &Variable| other.parameters().all(|inner| inner != **z);
                z.is_parameter() && f.variables.iter().all(|own| own == *z || outside(own))
            };
            let z = factor.variables().iter().find(usable);
            let split = z.and_then(|z| self.split(&numerator, &factor, *z));
            let Some(([q, r], z)) = split.zip(z) else {
                below *= &pow(factor, e as usize);
                continue;
            };
            let mut left = e;
            while left > 0
                && let Some(quotient) = divided(&by_power(&numerator, *z), &q)
            {
                numerator = assembled(&quotient, *z);
                left -= 1;
            }
            found |= left < e;
            let [q, r] = [q, r].map(|part| self.freed(&assembled(&part, *z)));
            below *= &(pow(q, left as usize) * &pow(r, e as usize));
        }
        let inverse = below.recip()?;
        found.then(|| self.freed(&numerator) * &inverse)
    }

    /// The coefficients of the factors `q` and `r` of `g = q r`. Returns `None` unless `q` also
    /// divides the numerator.
    fn split(&self, numerator: &Symbolic, g: &Symbolic, z: Variable) -> Option<[Vec<Symbolic>; 2]> {
        let below = by_power(g, z);
        if below.len() > MAX_LENGTH || !numerator.variables().contains(&self.v) {
            return None;
        }
        let (mut a, mut b) = (below.clone(), remainder(&by_power(numerator, z), &below)?.1);
        while !b.is_empty() {
            let (_, rest) = remainder(&a, &b)?;
            (a, b) = (b, rest);
        }
        if a.len() < 2 || a.len() == below.len() {
            return None;
        }
        let unit = a.last()?.recip()?;
        let q: Vec<Symbolic> = a.iter().map(|c| c.clone() * &unit).collect();
        let whole = |part: &[Symbolic]| part.iter().all(|c| c.denominator().is_one());
        let r = divided(&below, &q)?;
        (whole(&q) && whole(&r)).then_some([q, r])
    }
}

/// The largest number of coefficients of a polynomial that is split.
const MAX_LENGTH: usize = 9;

/// The quotient of two polynomials. Returns `None` unless the division is exact, and the
/// coefficients of the quotient are polynomials.
fn divided(f: &[Symbolic], g: &[Symbolic]) -> Option<Vec<Symbolic>> {
    let (quotient, rest) = remainder(f, g)?;
    (rest.is_empty() && quotient.iter().all(|c| c.denominator().is_one())).then_some(quotient)
}

/// The quotient and the remainder of two polynomials, all given by their coefficients.
fn remainder(f: &[Symbolic], g: &[Symbolic]) -> Option<(Vec<Symbolic>, Vec<Symbolic>)> {
    let unit = g.last()?.recip()?;
    let mut rest = f.to_vec();
    let mut quotient = vec![Symbolic::zero(); (f.len() + 1).saturating_sub(g.len())];
    while rest.len() >= g.len() {
        let Some(lead) = rest.pop() else { break };
        let at = rest.len() + 1 - g.len();
        let factor = lead * &unit;
        for (value, c) in rest[at..].iter_mut().zip(g) {
            *value = value.clone() - &(factor.clone() * c);
        }
        quotient[at] = factor;
    }
    while rest.last().is_some_and(Symbolic::vanishes) {
        rest.pop();
    }
    Some((quotient, rest))
}

/// The polynomial with these coefficients.
fn assembled(coefficients: &[Symbolic], z: Variable) -> Symbolic {
    let z = Symbolic::variable(z);
    coefficients.iter().rev().fold(Symbolic::zero(), |sum, c| sum * &z + c)
}
