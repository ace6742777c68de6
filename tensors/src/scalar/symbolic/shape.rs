//! The shape of a written fraction. It is a tree whose leaves are numbers and positions of
//! variables.
//!
//! Text, LaTeX and programs are written from the same shape. The shape depends on the lengths of
//! names, but not on the names themselves.

use super::collected::{self, Part};
use super::common::CommonFactors;
use super::factors::{Factors, factors, known, sort, within_limits};
use super::fraction::Fraction;
use super::polynomial::{Polynomial, common_denominator};
use super::writing;
use crate::expression::{Evaluator, power};
use crate::scalar::Rational;
use num_traits::One;

/// A part of a written fraction.
#[derive(Clone, Debug)]
pub(super) enum Shape {
    /// A number that is not negative.
    Number(Rational),
    /// A power of the variable at this position.
    Variable(usize, u32),
    /// A power of a factor that has a name.
    Named(Box<str>, u32),
    /// A power of a sum.
    Power(Box<Shape>, u32),
    Product(Vec<Shape>),
    /// A list of terms. The flag marks a subtracted term.
    Sum(Vec<(bool, Shape)>),
    Quotient(Box<Shape>, Box<Shape>),
}

impl Shape {
    /// Evaluates the shape. The parameter `variable` returns the values of the powers of variables.
    ///
    /// # Errors
    /// The errors of the evaluator.
    pub fn evaluate<M: Evaluator>(
        &self,
        meaning: &M,
        variable: &mut dyn FnMut(usize, u32) -> Result<M::Value, String>,
    ) -> Result<M::Value, String> {
        match self {
            Shape::Number(number) => meaning.number(number),
            Shape::Variable(at, e) => variable(*at, *e),
            Shape::Named(name, e) => power(meaning, meaning.name(name)?, u64::from(*e)),
            Shape::Power(base, e) => {
                power(meaning, base.evaluate(meaning, variable)?, u64::from(*e))
            }
            Shape::Product(factors) => {
                let mut values = factors.iter().map(|factor| factor.evaluate(meaning, variable));
                let first = values.next().unwrap_or_else(|| meaning.number(&Rational::one()))?;
                values.try_fold(first, |product, value| meaning.multiply(product, value?))
            }
            Shape::Sum(terms) => {
                let mut values = terms.iter().map(|(subtracted, term)| {
                    let value = term.evaluate(meaning, variable)?;
                    Ok(if *subtracted { meaning.negate(value) } else { value })
                });
                let first = values.next().unwrap_or_else(|| meaning.number(&Rational::from(0)))?;
                values.try_fold(first, |sum, value| meaning.add(sum, value?))
            }
            Shape::Quotient(above, below) => {
                let above = above.evaluate(meaning, variable)?;
                let below = meaning.reciprocal(below.evaluate(meaning, variable)?)?;
                meaning.multiply(above, below)
            }
        }
    }
}

/// Builds the shapes of fractions.
#[derive(Clone, Copy)]
pub(super) struct Shaping<'w> {
    /// The factors that have names.
    pub names: &'w CommonFactors,
}

impl Shaping<'_> {
    /// The shape of a fraction. It is for example `1/2*a` for one term without a denominator.
    /// Otherwise, numerator and denominator have integer coefficients, and are written in factors
    /// if that is shorter.
    pub fn fraction(self, f: &Fraction) -> Shape {
        let whole = f.denominator.is_one();
        if whole && f.numerator.terms.len() == 1 {
            return self.expanded(&f.numerator);
        }
        let unit = common_denominator(&f.numerator);
        let above = f.numerator.scale(&unit);
        let negative = leads_negative(&above);
        let size = if negative { -&above } else { above.clone() };
        if whole && unit.is_one() {
            return match self.factored(f, &size) {
                Ok(product) => signed(negative, product),
                Err(sum) if !negative => sum,
                Err(_) => self.sum(f, &above),
            };
        }
        let top = self.factored_above(f, &size);
        let bottom = self.denominator(f, unit);
        signed(negative, Shape::Quotient(top.into(), bottom.into()))
    }

    /// The denominator, multiplied by a number.
    ///
    /// The known factors are written separately if one of them has a name. They are also written
    /// separately if [`factors`] would find the same factors, or would find none.
    fn denominator(self, f: &Fraction, unit: Rational) -> Shape {
        if f.denominator.factors.iter().any(|(factor, _)| self.names.name(factor).is_some()) {
            let mut factors = f.denominator.all(&f.variables);
            sort(&mut factors);
            return self.product(f, &Factors { content: unit, factors });
        }
        let irreducible = f.denominator.irreducible(&f.variables);
        let separate = irreducible.as_ref().and_then(|factors| known(unit.clone(), factors));
        let part = || f.expanded_denominator().scale(&unit);
        let (found, part) = match (separate, f.denominator.terms() > MAX_EXPANDED) {
            (Some(found), true) => return self.product(f, &found),
            (Some(found), false) => (found, part()),
            (None, large) => match irreducible {
                Some(mut factors) if large || !within_limits(&part()) => {
                    sort(&mut factors);
                    let found = Factors { content: unit.clone(), factors };
                    if large {
                        return self.product(f, &found);
                    }
                    (found, part())
                }
                _ => (factors(&part()), part()),
            },
        };
        self.shorter(f, &part, &found, Place::Below).unwrap_or_else(|sum| sum)
    }

    /// The product of the factors of a polynomial if its text is shorter; otherwise the sum.
    fn factored(self, f: &Fraction, part: &Polynomial) -> Result<Shape, Shape> {
        match part.terms.len() {
            0 | 1 => Err(self.sum(f, part)),
            _ => self.shorter(f, part, &factors(part), Place::Alone),
        }
    }

    fn factored_above(self, f: &Fraction, part: &Polynomial) -> Shape {
        match part.terms.len() {
            0 | 1 => self.sum(f, part),
            _ => self.shorter(f, part, &factors(part), Place::Above).unwrap_or_else(|sum| sum),
        }
    }

    /// The product of these factors if its text is shorter; otherwise the sum.
    fn shorter(
        self,
        f: &Fraction,
        part: &Polynomial,
        found: &Factors,
        place: Place,
    ) -> Result<Shape, Shape> {
        let whole = match &found.factors[..] {
            [(factor, 1)] if found.content.is_one() => {
                self.names.of_polynomial(&f.variables, factor).is_none()
            }
            _ => false,
        };
        let sum = self.sum(f, part);
        if whole || part.terms.len() < 2 {
            return Err(sum);
        }
        let product = self.product(f, found);
        let length = |shape: &Shape, place| writing::text_at(shape, &f.variables, place).len();
        // adds the parentheses of the sum to its length, even if a common factor is taken out of it
        let parentheses = if place == Place::Alone { 0 } else { 2 };
        let longer = length(&sum, Place::Alone) + parentheses;
        if length(&product, place) < longer { Ok(product) } else { Err(sum) }
    }

    fn product(self, f: &Fraction, found: &Factors) -> Shape {
        let number = Some(Shape::Number(found.content.clone())).filter(|_| !found.content.is_one());
        let factor = |(factor, exponent): &(Polynomial, u32)| {
            if let [(monomial, _)] = &factor.terms[..] {
                let at = monomial.exps().iter().position(|e| *e > 0).unwrap_or(0);
                return Shape::Variable(at, *exponent);
            }
            if let Some(name) = self.names.of_polynomial(&f.variables, factor) {
                return Shape::Named(name.into(), *exponent);
            }
            match exponent {
                1 => self.sum(f, factor),
                _ => Shape::Power(self.sum(f, factor).into(), *exponent),
            }
        };
        product(number.into_iter().chain(found.factors.iter().map(factor)))
    }

    /// The sum of the terms. Common factors are taken out if the result is shorter.
    fn sum(self, f: &Fraction, part: &Polynomial) -> Shape {
        if part.terms.len() < 3 {
            return self.expanded(part);
        }
        parts(&collected::parts(part, &f.variables))
    }

    /// The sum of the terms, without taking out common factors.
    fn expanded(self, part: &Polynomial) -> Shape {
        sum(part.terms.iter().map(|(m, c)| {
            let powers = m.exps().iter().copied().enumerate().filter(|(_, e)| *e > 0);
            (c.is_negative(), term(&c.clone().abs(), powers, None))
        }))
    }
}

fn parts(all: &[Part]) -> Shape {
    sum(all.iter().map(|Part { coefficient, powers, inner }| {
        let inner = Some(inner).filter(|inner| !inner.is_empty()).map(|inner| parts(inner));
        let size = coefficient.clone().abs();
        (coefficient.is_negative(), term(&size, powers.iter().copied(), inner))
    }))
}

/// The product of a nonzero coefficient, powers of variables, and a sum.
fn term(
    coefficient: &Rational,
    powers: impl Iterator<Item = (usize, u32)>,
    inner: Option<Shape>,
) -> Shape {
    let mut powers = powers.map(|(at, e)| Shape::Variable(at, e)).peekable();
    let number = !coefficient.is_one() || powers.peek().is_none();
    let number = number.then(|| Shape::Number(coefficient.clone()));
    product(number.into_iter().chain(powers).chain(inner))
}

/// The product of shapes. A single shape is returned unchanged.
fn product(factors: impl Iterator<Item = Shape>) -> Shape {
    let mut factors: Vec<Shape> = factors.collect();
    match factors.len() {
        1 => factors.swap_remove(0),
        _ => Shape::Product(factors),
    }
}

/// The sum of terms. A single positive term is returned unchanged.
fn sum(terms: impl Iterator<Item = (bool, Shape)>) -> Shape {
    let mut terms: Vec<(bool, Shape)> = terms.collect();
    match &terms[..] {
        [(false, _)] => terms.swap_remove(0).1,
        _ => Shape::Sum(terms),
    }
}

fn signed(negative: bool, shape: Shape) -> Shape {
    if negative { Shape::Sum(vec![(true, shape)]) } else { shape }
}

/// The position of a shape in a fraction.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Place {
    Alone,
    Above,
    Below,
}

/// A product with at most this number of terms is expanded to compare the lengths of both texts.
const MAX_EXPANDED: u64 = 4096;

/// Whether the leading coefficient is negative, so that the text begins with a minus sign.
pub(super) fn leads_negative(f: &Polynomial) -> bool {
    f.lc().is_some_and(Rational::is_negative)
}
