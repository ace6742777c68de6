//! Differences that contain roots, as factors of polynomials. They are split off, and rewritten
//! without cancellation: `sqrt(x + 1) - 1` is `x/(sqrt(x + 1) + 1)`.
//!
//! A polynomial with a root `v^n = p` is divided by `v - c` for numbers `c`, by `v - w` for another
//! root `w`, and by conjugates of other factors. The division is repeated as long as the quotient
//! is a polynomial of lower degree. The degree of `v` is the degree of `p` divided by `n`.

use super::argument::by_power;
use super::factors::factors;
use super::variable::{Kind, Part, Variable};
use super::{Form, Rational, Symbolic};
use crate::scalar::Field;
use num_traits::{One, Zero, pow};

/// The largest number of terms of a factor that is divided.
const MAX_TERMS: usize = 100;

/// Separates differences from the factors of a product.
pub(super) fn separated(all: Vec<(Symbolic, i64)>) -> Vec<(Symbolic, i64)> {
    let mut roots: Vec<&'static Part> = Vec::new();
    for part in all.iter().flat_map(|(factor, _)| factor.variables().iter().filter_map(root)) {
        if !roots.contains(&part) {
            roots.push(part);
        }
    }
    let mut differences: Vec<Difference> = Vec::new();
    for (at, part) in roots.iter().enumerate() {
        differences.extend(Difference::of_number(part, square_root_at_zero(part)));
        differences
            .extend(roots[..at].iter().filter_map(|other| Difference::of_roots(part, other)));
        for (factor, _) in &all {
            differences.extend(
                zeros(part, factor)
                    .into_iter()
                    .filter_map(|c| Difference::of_number(part, Some(c))),
            );
            differences.extend(Difference::conjugate(part, factor));
        }
    }
    let scale = roots.iter().map(|part| part.parts).product();
    let mut product = Vec::new();
    for (factor, e) in all {
        let has_root = factor.variables().iter().any(|variable| root(variable).is_some());
        if !has_root || terms(&factor) > MAX_TERMS {
            product.push((factor, e));
            continue;
        }
        let mut rest = related(&factor);
        let before = product.len();
        for difference in &differences {
            while let Some(quotient) = difference.divide(&rest, scale) {
                rest = quotient;
                match &difference.quotient {
                    Some([above, below]) => {
                        product.extend([(above.clone(), e), (below.clone(), -e)])
                    }
                    None => product.push((difference.value.clone(), e)),
                }
            }
        }
        product.push((if product.len() == before { factor } else { rest }, e));
    }
    product
}

/// A difference that contains a root.
struct Difference {
    value: Symbolic,
    inverse: Symbolic,
    /// The numerator and the denominator of the form without cancellation.
    quotient: Option<[Symbolic; 2]>,
}

impl Difference {
    fn new(value: Symbolic, quotient: Option<[Symbolic; 2]>) -> Option<Self> {
        Some(Difference { inverse: value.recip()?, value, quotient })
    }

    /// The difference `v - c = (p - c^n)/(v^(n-1) + ... + c^(n-1))` for a positive number `c`.
    fn of_number(part: &Part, c: Option<Rational>) -> Option<Self> {
        let c = c.filter(|c| !c.is_zero() && !c.is_negative())?;
        let (n, c, v) = (part.parts as usize, Symbolic::constant(c), variable(part));
        let sum = (0..n).map(|k| pow(v.clone(), k) * &pow(c.clone(), n - 1 - k));
        let below = sum.fold(Symbolic::zero(), |sum, term| sum + &term);
        let above = part.of.clone() - &pow(c.clone(), n);
        Self::new(v - &c, Some([above, below]))
    }

    /// The difference `v - w = (p - q)/(v + w)` of square roots.
    fn of_roots(part: &Part, other: &Part) -> Option<Self> {
        let [v, w] = [part, other].map(variable);
        let above = part.of.clone() - &other.of;
        let squares = part.parts == 2 && other.parts == 2;
        squares.then(|| Self::new(v.clone() - &w, Some([above, v + &w])))?
    }

    /// The conjugate of a factor, in which `-v` replaces a square root `v`.
    fn conjugate(part: &Part, factor: &Symbolic) -> Option<Self> {
        if part.parts != 2 || terms(factor) > 8 {
            return None;
        }
        let (factor, minus) = (related(factor), -variable(part));
        let own = Variable::function(Kind::Root(part.clone()));
        let by_root = by_power(&factor, own).into_iter().rev();
        let value = by_root.fold(Symbolic::zero(), |sum, c| sum * &minus + &c);
        (value != factor && value != -factor).then(|| Self::new(value, None))?
    }

    /// The quotient of a value and the difference. Returns `None` unless it is a polynomial of
    /// lower degree.
    fn divide(&self, value: &Symbolic, scale: u32) -> Option<Symbolic> {
        let degree = weight(value, scale).filter(|degree| *degree > 0)?;
        let quotient = value.clone() * &self.inverse;
        let lower = quotient.denominator().is_one() && weight(&quotient, scale)? < degree;
        lower.then_some(quotient)
    }
}

/// The part of a root. Returns `None` if the variable is not a root.
fn root(variable: &Variable) -> Option<&'static Part> {
    match variable.kind() {
        Kind::Root(part) | Kind::FreeRoot(part) => Some(part),
        _ => None,
    }
}

fn variable(part: &Part) -> Symbolic {
    Symbolic::variable(Variable::function(Kind::Root(part.clone())))
}

/// The polynomial in which the roots replace the variables that represent them.
fn related(polynomial: &Symbolic) -> Symbolic {
    let free = |v: &Variable| matches!(v.kind(), Kind::FreeRoot(_));
    let all: Vec<Variable> = polynomial.variables().iter().copied().filter(free).collect();
    all.into_iter().fold(polynomial.clone(), |value, v| {
        let Some(image) = root(&v).map(variable) else { return value };
        by_power(&value, v).into_iter().rev().fold(Symbolic::zero(), |sum, c| sum * &image + &c)
    })
}

fn terms(value: &Symbolic) -> usize {
    match &value.0 {
        Form::Constant(_) => 1,
        Form::Fraction(f) => f.numerator.terms.len(),
    }
}

/// The degree of a polynomial times a scale. Returns `None` if it contains a root whose argument is
/// not a polynomial in parameters.
fn weight(value: &Symbolic, scale: u32) -> Option<u32> {
    let Form::Fraction(f) = &value.0 else { return Some(0) };
    let of_variable = |variable: &Variable| match root(variable) {
        Some(part) => Some(polynomial(part)?.total_degree() * scale / part.parts),
        None => Some(scale),
    };
    let weights: Option<Vec<u32>> = f.variables.iter().map(of_variable).collect();
    let weights = weights?;
    let of_term = |exponents: &[u32]| exponents.iter().zip(&weights).map(|(e, w)| e * w).sum();
    f.numerator.terms.iter().map(|(monomial, _)| of_term(monomial.exps())).max()
}

/// The argument of a root. Returns `None` if it is not a polynomial in parameters.
fn polynomial(part: &Part) -> Option<&super::polynomial::Polynomial> {
    let Form::Fraction(p) = &part.of.0 else { return None };
    let plain = p.variables.iter().all(|v| v.is_parameter()) && part.of.denominator().is_one();
    plain.then_some(&p.numerator)
}

/// The value of the root at the point where all parameters are zero. Returns `None` if it is
/// irrational.
fn square_root_at_zero(part: &Part) -> Option<Rational> {
    let p = polynomial(part)?;
    let constant = p.terms.iter().find(|(monomial, _)| monomial.exps().iter().all(|e| *e == 0));
    let (_, constant) = constant?;
    match part.parts {
        2 => constant.sqrt(),
        _ => constant.is_one().then(Rational::one),
    }
}

/// The rational values that the root of a linear `p = a*x + b` has at the zeros of a polynomial in
/// `x` and the root.
fn zeros(part: &Part, factor: &Symbolic) -> Vec<Rational> {
    let found = || {
        let [x] = part.of.variables() else { return None };
        let own = Variable::function(Kind::Root(part.clone()));
        let [b, a] = &by_power(&part.of, *x)[..] else { return None };
        let value = related(factor);
        let inside = value.variables().iter().all(|v| v == x || *v == own);
        if !inside || polynomial(part).is_none() || !value.variables().contains(&own) {
            return None;
        }
        let free = Symbolic::variable(Variable::function(Kind::FreeRoot(part.clone())));
        let image = (pow(free.clone(), part.parts as usize) - b) * &a.recip()?;
        let over = |value: &Symbolic, v: Variable, image: &Symbolic| {
            let by_variable = by_power(value, v).into_iter().rev();
            by_variable.fold(Symbolic::zero(), |sum, c| sum * image + &c)
        };
        let Form::Fraction(f) = &over(&over(&value, own, &free), *x, &image).0 else { return None };
        let zero = |g: &super::polynomial::Polynomial| match &g.terms[..] {
            [(_, lead), (_, rest)] if g.total_degree() == 1 => Some(-rest.clone() / lead),
            _ => None,
        };
        Some(factors(&f.numerator).factors.iter().filter_map(|(g, _)| zero(g)).collect())
    };
    found().unwrap_or_default()
}
