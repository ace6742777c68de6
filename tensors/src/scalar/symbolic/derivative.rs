//! Derivatives of quotients.

use super::Symbolic;
use super::fraction::{Fraction, lowest_terms};
use super::polynomial::{Polynomial, constant};
use super::sum::SymbolicSum;
use crate::{Rational, Sum};
use num_traits::One;

impl Fraction {
    /// Computes `N'/D - (N/D) (D'/D)`, where `D'/D` is the sum of `e f'/f` over the factors `f^e`.
    pub(super) fn derivative(&self, variable: usize) -> Symbolic {
        let derivative = |factor: &Polynomial| self.polynomial(&factor.derivative(variable));
        let value = Symbolic::from(self.clone());
        let one = constant(Rational::one(), self.variables.len());
        let below = lowest_terms(&self.variables, one, self.denominator.clone());
        let mut sum = SymbolicSum::default();
        sum.add_product(&derivative(&self.numerator), &below);
        for (factor, exponent) in self.denominator.parts(&self.variables) {
            let slope = derivative(&factor.expanded(&self.variables));
            let one = constant(Rational::from(-i64::from(exponent)), self.variables.len());
            let ratio = slope * &lowest_terms(&self.variables, one, factor);
            sum.add_product(&value, &ratio);
        }
        sum.value()
    }
}
