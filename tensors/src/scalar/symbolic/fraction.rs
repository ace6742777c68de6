//! Quotients of polynomials in lowest terms.

use super::denominator::Denominator;
use super::polynomial::{Polynomial, content, power, select};
use super::variables::{Variables, places};
use super::{Form, Rational, Symbolic};
use crate::scalar::Field;
use num_traits::Zero;
use polycore::{Monomial, Order, Poly};
use std::sync::Arc;

/// The most terms of a short value.
const MAX_SHORT: usize = 48;

/// A quotient that depends on each of its variables, of which there is at least one.
///
/// Numerator and denominator are coprime; the denominator has coprime integer coefficients, the
/// leading one positive. Equal values have equal numerators, and equal denominators once these are
/// expanded.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Fraction {
    pub(super) variables: Variables,
    pub(super) numerator: Polynomial,
    pub(super) denominator: Denominator,
}

impl Fraction {
    pub(super) fn parameter(name: &str) -> Self {
        Fraction {
            variables: Arc::new([name.into()]),
            numerator: Poly::monomial(Monomial::var(0, 1), Order::GrLex),
            denominator: Denominator::default(),
        }
    }

    /// The larger of the total degrees of numerator and denominator.
    pub(super) fn degree(&self) -> u32 {
        self.numerator.total_degree().max(self.denominator.degree())
    }

    /// Whether it has few terms. Only short values are remembered, because long ones seldom repeat.
    pub(super) fn is_short(&self) -> bool {
        let below = self.denominator.factors.iter().map(|(f, _)| f.polynomial.terms.len());
        below.fold(self.numerator.terms.len(), usize::saturating_add) <= MAX_SHORT
    }

    /// The denominator as a sum of terms.
    pub(super) fn expanded_denominator(&self) -> Polynomial {
        self.denominator.expanded(&self.variables)
    }

    /// A polynomial in the variables of the fraction as a value.
    pub(super) fn polynomial(&self, part: &Polynomial) -> Symbolic {
        lowest_terms(&self.variables, part.clone(), Denominator::default())
    }

    /// `self + c`.
    pub(super) fn plus(&self, c: &Rational) -> Self {
        let numerator = &self.numerator + &self.expanded_denominator().scale(c);
        Fraction { numerator, ..self.clone() }
    }

    /// `c self` for a constant other than zero.
    pub(super) fn times(&self, c: &Rational) -> Self {
        Fraction { numerator: self.numerator.scale(c), ..self.clone() }
    }

    /// `1 / self`; `None` only for the value zero, which is not a fraction.
    pub(super) fn recip(&self) -> Option<Self> {
        let unit = content(&self.numerator).recip()?;
        Some(Fraction {
            variables: self.variables.clone(),
            numerator: self.expanded_denominator().scale(&unit),
            denominator: Denominator::of(&self.variables, &self.numerator.scale(&unit)),
        })
    }

    /// `self^exponent` for a positive exponent: coprime parts have coprime powers.
    pub(super) fn power(&self, exponent: u32) -> Self {
        Fraction {
            variables: self.variables.clone(),
            numerator: power(&self.numerator, exponent),
            denominator: self.denominator.power(exponent),
        }
    }

    /// The same fraction over these of its variables, which include those that it depends on.
    fn over(self, kept: &[usize]) -> Self {
        let columns: Vec<_> = kept.iter().copied().map(Some).collect();
        let monomial = kept.iter().map(|at| self.denominator.exponent(*at)).collect();
        let monomial = Some(monomial).filter(|_| !self.denominator.monomial.is_empty());
        Fraction {
            variables: kept.iter().map(|&at| self.variables[at].clone()).collect(),
            numerator: select(&self.numerator, &columns),
            denominator: Denominator { monomial: monomial.unwrap_or_default(), ..self.denominator },
        }
    }
}

impl From<Fraction> for Symbolic {
    fn from(fraction: Fraction) -> Self {
        Symbolic(Form::Fraction(Arc::new(fraction)))
    }
}

/// The value of a quotient in lowest terms that may depend on only some of the variables.
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
        // a primitive constant denominator is 1
        return Symbolic::constant(content(&numerator));
    }
    let fraction = Fraction { variables: variables.clone(), numerator, denominator };
    if kept.len() == variables.len() { fraction.into() } else { fraction.over(&kept).into() }
}
