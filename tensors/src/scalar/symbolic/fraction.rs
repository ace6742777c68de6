//! Quotients of polynomials in lowest terms.
//!
//! Sums and products cancel common divisors before they multiply (P. Henrici, *J. ACM* 3 (1956)
//! 6-9). The operands are in lowest terms, so only divisors of opposite parts are left to find.

use super::polynomial::{Polynomial, cofactors, constant, content, product, select};
use super::variables::{Variables, union};
use super::{Form, Rational, Symbolic};
use crate::scalar::Field;
use num_traits::{One, Zero};
use polycore::{Monomial, Order, Poly};
use std::borrow::Cow;
use std::sync::Arc;

/// A quotient that depends on each of its variables, of which there is at least one.
///
/// Numerator and denominator are coprime; the denominator has coprime integer coefficients, the
/// leading one positive. Equal values have equal fractions.
#[derive(Clone, PartialEq, Eq)]
pub(super) struct Fraction {
    pub(super) variables: Variables,
    pub(super) numerator: Polynomial,
    pub(super) denominator: Polynomial,
}

impl Fraction {
    pub(super) fn parameter(name: &str) -> Self {
        Fraction {
            variables: Arc::new([name.into()]),
            numerator: Poly::monomial(Monomial::var(0, 1), Order::GrLex),
            denominator: constant(Rational::one(), 1),
        }
    }

    /// The larger of the total degrees of numerator and denominator.
    pub(super) fn degree(&self) -> u32 {
        self.numerator.total_degree().max(self.denominator.total_degree())
    }

    /// The numerator or the denominator as a value.
    pub(super) fn polynomial(&self, part: &Polynomial) -> Symbolic {
        let one = constant(Rational::one(), part.nvars);
        lowest_terms(&self.variables, part.clone(), one)
    }

    /// `self + c`.
    pub(super) fn plus(&self, c: &Rational) -> Self {
        let numerator = &self.numerator + &self.denominator.scale(c);
        Fraction { numerator, ..self.clone() }
    }

    /// `c self` for a constant other than zero.
    pub(super) fn times(&self, c: &Rational) -> Self {
        Fraction { numerator: self.numerator.scale(c), ..self.clone() }
    }

    pub(super) fn sum(&self, other: &Self) -> Symbolic {
        let variables = union(&self.variables, &other.variables);
        let (a, b) = (self.over(&variables), other.over(&variables));
        let (common, left, right) = cofactors(&a.denominator, &b.denominator);
        let numerator = &product(&a.numerator, &right) + &product(&b.numerator, &left);
        let (_, numerator, common) = cofactors(&numerator, &common);
        lowest_terms(&variables, numerator, product(&product(&left, &right), &common))
    }

    pub(super) fn product(&self, other: &Self) -> Symbolic {
        let variables = union(&self.variables, &other.variables);
        let (a, b) = (self.over(&variables), other.over(&variables));
        let (_, left, below_right) = cofactors(&a.numerator, &b.denominator);
        let (_, right, below_left) = cofactors(&b.numerator, &a.denominator);
        let denominator = product(&below_left, &below_right);
        lowest_terms(&variables, product(&left, &right), denominator)
    }

    /// `1 / self`; `None` only for the value zero, which is not a fraction.
    pub(super) fn recip(&self) -> Option<Self> {
        let unit = content(&self.numerator).recip()?;
        Some(Fraction {
            variables: self.variables.clone(),
            numerator: self.denominator.scale(&unit),
            denominator: self.numerator.scale(&unit),
        })
    }

    /// `self^exponent` for a positive exponent: coprime parts have coprime powers.
    pub(super) fn power(&self, exponent: u32) -> Self {
        Fraction {
            variables: self.variables.clone(),
            numerator: self.numerator.pow(exponent),
            denominator: self.denominator.pow(exponent),
        }
    }

    /// `(N' D - N D') / D^2`, with `gcd(D, D')` cancelled beforehand.
    pub(super) fn derivative(&self, variable: usize) -> Symbolic {
        let (n, d) = (&self.numerator, &self.denominator);
        let (_, d1, rest) = cofactors(&d.derivative(variable), d);
        let numerator = &product(&n.derivative(variable), &rest) - &product(n, &d1);
        let (_, numerator, denominator) = cofactors(&numerator, &product(d, &rest));
        lowest_terms(&self.variables, numerator, denominator)
    }

    /// The same fraction over these variables, which include those that it depends on.
    fn over(&self, variables: &Variables) -> Cow<'_, Self> {
        if self.variables == *variables {
            return Cow::Borrowed(self);
        }
        let place = |name| self.variables.iter().position(|own| own == name);
        let columns: Vec<_> = variables.iter().map(place).collect();
        Cow::Owned(Fraction {
            variables: variables.clone(),
            numerator: select(&self.numerator, &columns),
            denominator: select(&self.denominator, &columns),
        })
    }
}

impl From<Fraction> for Symbolic {
    fn from(fraction: Fraction) -> Self {
        Symbolic(Form::Fraction(Arc::new(fraction)))
    }
}

/// The value of a quotient in lowest terms that may depend on only some of the variables.
fn lowest_terms(variables: &Variables, numerator: Polynomial, denominator: Polynomial) -> Symbolic {
    if numerator.is_zero() {
        return Symbolic::zero();
    }
    let (above, below) = (numerator.degrees(), denominator.degrees());
    let kept = (0..variables.len()).filter(|&k| above[k] + below[k] > 0);
    let kept: Variables = kept.map(|k| variables[k].clone()).collect();
    if kept.is_empty() {
        // a primitive constant denominator is 1
        return Symbolic::constant(content(&numerator));
    }
    let fraction = Fraction { variables: variables.clone(), numerator, denominator };
    match kept.len() == variables.len() {
        true => fraction.into(),
        false => fraction.over(&kept).into_owned().into(),
    }
}
