//! Arguments of functions. They are written as rational multiples of the members of a basis.
//!
//! If arguments are linearly independent over the rationals, also modulo constants, their
//! exponentials are algebraically independent, and so are their half tangents (J. Ax, *Ann. Math.*
//! 93 (1971) 252-268; M. Rothstein, B. Caviness, *SIAM J. Comput.* 8 (1979) 357-367).
//!
//! Therefore, an argument is written in a basis of all values over the rationals. This basis does
//! not depend on the computation. Its members are products of powers of variables, possibly with a
//! denominator, such as `x^2*y/M`. If the denominator is a sum, the members are the partial
//! fractions in the first variable, then in the next variable. For angles within arguments, the
//! members are powers of cosines, and their products with the sine.

use super::fraction::{Fraction, lowest_terms};
use super::normal_form::{in_cosines, in_half_tangents, is_written};
use super::polynomial::constant;
use super::variable::{Kind, Part, Variable};
use super::{Form, Rational, Symbolic};
use crate::linear::Matrix;
use crate::scalar::{Field, Ring};
use num_rational::Ratio;
use num_traits::{One, Zero};
use polycore::Poly;
use std::collections::BTreeMap;

/// A summand of an argument: `count * of / parts`.
pub(super) struct Multiple {
    pub of: Symbolic,
    pub count: i64,
    pub parts: u32,
}

impl Multiple {
    /// The member of the basis, divided by the number of parts of this multiple.
    pub fn part(&self) -> Part {
        Part { of: self.of.clone(), parts: self.parts }
    }
}

/// The largest degree of a denominator, and the largest number of coefficients of a numerator, that
/// are decomposed into partial fractions.
const MAX_DEGREE: usize = 24;

/// Expands an argument in the basis of arguments.
///
/// # Errors
/// A message if the factors of a denominator are unknown, if a denominator contains sines, or if
/// numbers exceed 64 bits.
pub(super) fn multiples(function: &str, value: &Symbolic) -> Result<Vec<Multiple>, String> {
    let refuse = |reason: &str| Err(format!("the argument {value} of {function} {reason}"));
    let Some(flat) = in_cosines(value) else {
        return refuse("divides by a function of an angle");
    };
    let Some(members) = members(&flat) else {
        return refuse("has a denominator whose factors are not known");
    };
    let mut all = Vec::new();
    for (of, coefficient) in members {
        let number = Ratio::<i64>::try_from(&coefficient).ok();
        let parts = number.and_then(|number| u32::try_from(*number.denom()).ok());
        let (Some(number), Some(parts)) = (number, parts) else {
            return refuse("has numbers that are too large");
        };
        let of = if of.variables().iter().any(is_written) { in_half_tangents(&of) } else { of };
        all.push(Multiple { of, count: *number.numer(), parts });
    }
    Ok(all)
}

/// The members of the basis whose combination is a value, with their coefficients.
fn members(value: &Symbolic) -> Option<Vec<(Symbolic, Rational)>> {
    let f = match &value.0 {
        Form::Constant(c) if c.is_zero() => return Some(vec![]),
        Form::Constant(c) => return Some(vec![(Symbolic::one(), c.clone())]),
        Form::Fraction(f) => f,
    };
    if f.denominator.factors.is_empty() {
        let member = |(monomial, c): &(polycore::Monomial, Rational)| {
            let one = Poly::new(
                vec![(monomial.clone(), Rational::one())],
                f.variables.len(),
                polycore::Order::GrLex,
            );
            let below = lowest_terms(
                &f.variables,
                constant(Rational::one(), f.variables.len()),
                f.denominator.clone(),
            );
            (f.polynomial(&one) * &below, c.clone())
        };
        return Some(f.numerator.terms.iter().map(member).collect());
    }
    partial_fractions(f)
}

/// The members for a value whose denominator contains sums. They are the partial fractions in the
/// first variable of these sums; the coefficients are expanded in the other variables.
fn partial_fractions(f: &Fraction) -> Option<Vec<(Symbolic, Rational)>> {
    let factors = f.denominator.irreducible(&f.variables)?;
    let sums = factors.iter().filter(|(factor, _)| factor.terms.len() > 1);
    let at = sums.filter_map(|(factor, _)| factor.degrees().iter().position(|d| *d > 0)).min()?;
    let x = f.variables[at];
    let (own, others): (Vec<_>, Vec<_>) =
        factors.into_iter().partition(|(factor, _)| factor.degrees()[at] > 0);
    let value =
        |(factor, e): &(super::polynomial::Polynomial, u32)| (f.polynomial(factor), *e as usize);
    let own: Vec<(Symbolic, usize)> = own.iter().map(value).collect();
    let product = |factors: &[(Symbolic, usize)]| {
        let power = |(factor, e): &(Symbolic, usize)| num_traits::pow(factor.clone(), *e);
        factors.iter().map(power).fold(Symbolic::one(), |product, power| product * &power)
    };
    let others = product(&others.iter().map(value).collect::<Vec<_>>());
    let below = product(&own);
    let numerator = f.polynomial(&f.numerator);
    let (above, degree) = (by_power(&numerator, x), by_power(&below, x).len() - 1);
    if above.len().max(degree) > MAX_DEGREE {
        return None;
    }
    let whole = above.len().saturating_sub(degree);
    let variable = Symbolic::variable(x);
    // the partial fractions, and the polynomial that each of them has over the common denominator
    let mut parts: Vec<Symbolic> =
        (0..whole).map(|power| num_traits::pow(variable.clone(), power)).collect();
    for (factor, exponent) in &own {
        let length = by_power(factor, x).len() - 1;
        for e in 1..=*exponent {
            let below = num_traits::pow(factor.clone(), e).recip()?;
            parts
                .extend((0..length).map(|power| num_traits::pow(variable.clone(), power) * &below));
        }
    }
    let columns = parts.iter().map(|part| by_power(&(part.clone() * &below), x));
    let columns: Vec<Vec<Symbolic>> = columns.collect();
    let coefficient = |of: &[Symbolic], row: usize| of.get(row).cloned().unwrap_or_default();
    let rows = whole + degree;
    let matrix: Vec<Vec<Symbolic>> = (0..rows)
        .map(|row| columns.iter().map(|column| coefficient(column, row)).collect())
        .collect();
    let right: Vec<Symbolic> = (0..rows).map(|row| coefficient(&above, row)).collect();
    let found = Matrix::from_dense(&matrix).ok()?.solve(&right).ok()??;
    let below = others.recip()?;
    let mut all: Vec<(Symbolic, Rational)> = Vec::new();
    for (part, share) in parts.into_iter().zip(found) {
        let inner = members(&(share * &below))?;
        all.extend(inner.into_iter().map(|(member, c)| (member * &part, c)));
    }
    Some(all)
}

/// The coefficients of a polynomial in one variable. They begin with the constant.
pub(super) fn by_power(polynomial: &Symbolic, variable: Variable) -> Vec<Symbolic> {
    let mut coefficients = Vec::new();
    for ([at], part) in by_powers(polynomial, [variable]) {
        coefficients.resize(at, Symbolic::zero());
        coefficients.push(part);
    }
    coefficients
}

/// Groups the terms of a polynomial by their powers of the given variables.
pub(super) fn by_powers<const N: usize>(
    polynomial: &Symbolic,
    variables: [Variable; N],
) -> BTreeMap<[usize; N], Symbolic> {
    let Form::Fraction(f) = &polynomial.0 else {
        let constant = (!polynomial.vanishes()).then(|| ([0; N], polynomial.clone()));
        return constant.into_iter().collect();
    };
    let columns = variables.map(|variable| f.variables.iter().position(|own| *own == variable));
    let mut parts = BTreeMap::<_, Vec<_>>::new();
    for (monomial, c) in &f.numerator.terms {
        let mut rest = monomial.exps().to_vec();
        let powers = columns.map(|k| k.map_or(0, |k| std::mem::take(&mut rest[k]) as usize));
        // appends the term, so that terms of equal powers remain in the same order
        parts.entry(powers).or_default().push((polycore::Monomial::new(rest), c.clone()));
    }
    let polynomial = |terms| Poly { terms, ..f.numerator.clone() };
    parts.into_iter().map(|(at, terms)| (at, f.polynomial(&polynomial(terms)))).collect()
}

/// The argument `p`, if the value is a single logarithm `log(p)`, as in `exp(2*log(p))`; otherwise
/// `None`.
pub(super) fn logarithm(of: &Symbolic) -> Option<&'static Symbolic> {
    let [variable] = of.variables() else { return None };
    match variable.kind() {
        Kind::Logarithm(p) if *of == Symbolic::variable(*variable) => Some(p),
        _ => None,
    }
}
