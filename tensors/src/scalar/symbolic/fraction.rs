//! Quotients of polynomials in lowest terms.

use super::denominator::Denominator;
use super::polynomial::{Polynomial, content, power, select};
use super::variable::{Variable, Variables, places};
use super::{Form, Rational, Symbolic};
use crate::scalar::Field;
use num_traits::Zero;
use polycore::{Monomial, Order, Poly};
use std::ops::Deref;
use std::sync::Arc;

/// A value is short if it has at most this number of terms.
const MAX_SHORT: usize = 48;

/// A quotient of polynomials. It depends on each of its variables, of which there is at least one.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Fraction {
    pub(super) variables: Variables,
    pub(super) quotient: Arc<Quotient>,
}

/// A quotient of polynomials in unnamed variables. For example, the fractions `a/(a + b)` and
/// `x/(x + y)` use the same quotient.
///
/// The numerator and the denominator are coprime. The denominator has coprime integer coefficients,
/// and its leading coefficient is positive. Equal values have equal numerators and equal expanded
/// denominators. Only the factors of denominators refer to named variables.
#[derive(Debug, PartialEq, Eq)]
pub(super) struct Quotient {
    pub(super) numerator: Polynomial,
    pub(super) denominator: Denominator,
}

impl Deref for Fraction {
    type Target = Quotient;
    fn deref(&self) -> &Quotient {
        &self.quotient
    }
}

impl Fraction {
    pub(super) fn new(
        variables: Variables,
        numerator: Polynomial,
        denominator: Denominator,
    ) -> Self {
        Fraction { variables, quotient: Arc::new(Quotient { numerator, denominator }) }
    }

    pub(super) fn variable(variable: Variable) -> Self {
        let numerator = Poly::monomial(Monomial::var(0, 1), Order::GrLex);
        Fraction::new(Arc::new([variable]), numerator, Denominator::default())
    }

    /// Whether the variables can be renamed without any other change.
    pub(super) fn is_nameless(&self) -> bool {
        self.denominator.factors.is_empty() && !self.has_functions()
    }

    /// Whether one of the variables is a function. Functions follow all other variables.
    pub(super) fn has_functions(&self) -> bool {
        self.variables.last().is_some_and(|variable| !variable.is_parameter())
    }

    /// The larger of the total degrees of the numerator and the denominator.
    pub(super) fn degree(&self) -> u32 {
        self.numerator.total_degree().max(self.denominator.degree())
    }

    /// Whether the fraction has few terms. Only short values are cached, because long values seldom
    /// occur again.
    pub(super) fn is_short(&self) -> bool {
        let below = self.denominator.factors.iter().map(|(f, _)| f.polynomial.terms.len());
        below.fold(self.numerator.terms.len(), usize::saturating_add) <= MAX_SHORT
    }

    /// The denominator, expanded into a sum of terms.
    pub(super) fn expanded_denominator(&self) -> Polynomial {
        self.denominator.expanded(&self.variables)
    }

    /// Converts a polynomial in the variables of the fraction to a value.
    pub(super) fn polynomial(&self, part: &Polynomial) -> Symbolic {
        lowest_terms(&self.variables, part.clone(), Denominator::default())
    }

    /// The sum `self + c`.
    pub(super) fn plus(&self, c: &Rational) -> Self {
        let numerator = &self.numerator + &self.expanded_denominator().scale(c);
        Fraction::new(self.variables.clone(), numerator, self.denominator.clone())
    }

    /// The product `c self` for a constant other than zero.
    pub(super) fn times(&self, c: &Rational) -> Self {
        let numerator = self.numerator.scale(c);
        Fraction::new(self.variables.clone(), numerator, self.denominator.clone())
    }

    /// The reciprocal `1 / self`. Only the value zero, which is not a fraction, would yield `None`.
    pub(super) fn recip(&self) -> Option<Self> {
        let unit = content(&self.numerator).recip()?;
        let denominator = Denominator::of(&self.variables, &self.numerator.scale(&unit));
        let numerator = self.expanded_denominator().scale(&unit);
        Some(Fraction::new(self.variables.clone(), numerator, denominator))
    }

    /// The power `self^exponent` for a positive exponent. Powers of coprime polynomials are
    /// coprime, so no common divisors are searched for.
    pub(super) fn power(&self, exponent: u32) -> Self {
        let numerator = power(&self.numerator, exponent);
        Fraction::new(self.variables.clone(), numerator, self.denominator.power(exponent))
    }
}

impl From<Fraction> for Symbolic {
    fn from(fraction: Fraction) -> Self {
        Symbolic(Form::Fraction(Arc::new(fraction)))
    }
}

/// The value of a quotient that is already in lowest terms. Some of the variables may be unused.
pub(super) fn lowest_terms(
    variables: &Variables,
    numerator: Polynomial,
    mut denominator: Denominator,
) -> Symbolic {
    if numerator.is_zero() {
        return Symbolic::zero();
    }
    if denominator.monomial.iter().all(|e| *e == 0) {
        denominator.monomial = Box::default();
    }
    let mut occurs: Vec<bool> = numerator.degrees().into_iter().map(|d| d > 0).collect();
    occurs.iter_mut().enumerate().for_each(|(at, o)| *o |= denominator.exponent(at) > 0);
    for (factor, _) in &denominator.factors {
        places(&factor.variables, variables).into_iter().for_each(|at| occurs[at] = true);
    }
    let kept: Vec<usize> = (0..variables.len()).filter(|&at| occurs[at]).collect();
    if kept.is_empty() {
        // returns the numerator, because a primitive constant denominator is 1
        return Symbolic::constant(content(&numerator));
    }
    if kept.len() == variables.len() {
        return Fraction::new(variables.clone(), numerator, denominator).into();
    }
    let columns: Vec<_> = kept.iter().copied().map(Some).collect();
    if !denominator.monomial.is_empty() {
        denominator.monomial = kept.iter().map(|at| denominator.exponent(*at)).collect();
    }
    let variables = kept.iter().map(|&at| variables[at]).collect();
    Fraction::new(variables, select(&numerator, &columns), denominator).into()
}
