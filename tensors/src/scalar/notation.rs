//! Scalars with a written form: conversion from numbers and parameters, and to text and LaTeX.

use super::{Field, Rational, Variable};
use crate::expression::{POWER, no_function, several_arguments};
use std::collections::BTreeSet;

/// The three kinds of scalars of tables.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// Exact rationals.
    Exact,
    /// Exact rational functions of parameters.
    Symbolic,
    /// Floating point with a tolerance.
    Float,
}

/// A field whose values have a written form; `Display` gives the plain text.
pub trait Notation: Field {
    /// The kind of this scalar.
    const KIND: Kind;

    /// The value of a rational number. `None` if a float would overflow, or would lose accuracy
    /// because the number is too close to zero.
    fn from_rational(value: &Rational) -> Option<Self>;

    /// The parameter of that name, or the number `pi`; `None` for scalars without parameters.
    fn parameter(name: &str) -> Option<Self> {
        let _ = name;
        None
    }

    /// The value that is parsed from the text of this value; conditions on free functions are lost.
    fn read_back(&self) -> Self {
        self.clone()
    }

    /// The parameters that the value depends on, sorted.
    fn parameters(&self) -> Vec<String> {
        vec![]
    }

    /// The parameters that any of the values depends on.
    fn parameters_of(values: &mut dyn Iterator<Item = &Self>) -> BTreeSet<String> {
        match Self::KIND {
            Kind::Symbolic => values.flat_map(Self::parameters).collect(),
            Kind::Exact | Kind::Float => BTreeSet::new(),
        }
    }

    /// The value of an elementary function like `sin` at an argument.
    ///
    /// # Errors
    /// A message: the function is unknown, or this scalar has no value of the function at this
    /// argument.
    fn function(name: &str, argument: &Self) -> Result<Self, String> {
        no_function(name, argument)
    }

    /// The value of a function at a list of arguments. By default functions have one argument. A
    /// power with an exponent that is not an integer is the function `pow` of base and exponent.
    ///
    /// # Errors
    /// Those of [`function`](Self::function).
    fn call(name: &str, arguments: &[Self]) -> Result<Self, String> {
        match arguments {
            [argument] => Self::function(name, argument),
            [_, exponent] if name == POWER => no_function(name, exponent),
            several => Err(several_arguments(name, several.len())),
        }
    }

    /// The partial derivative with respect to the parameter of that name; zero for numbers.
    fn derivative(&self, name: &str) -> Self {
        let _ = name;
        Self::zero()
    }

    /// The terms of the numerator: monomials in the variables (with powers) with rational
    /// coefficients. The value vanishes exactly if there are no terms. Always empty for floats.
    fn numerator_terms(&self) -> Vec<(Vec<(Variable, u32)>, Rational)> {
        vec![]
    }

    /// The value of a variable of [`numerator_terms`](Self::numerator_terms); `None` for scalars without parameters.
    fn variable(variable: Variable) -> Option<Self> {
        let _ = variable;
        None
    }

    /// The value as a float; `None` if it depends on a parameter.
    fn to_f64(&self) -> Option<f64>;

    /// The value in LaTeX's mathematics mode.
    fn latex(&self) -> String;

    /// Whether the plain text begins with a minus sign. Tables use it to print one of `x` and `-x`.
    fn is_negative(&self) -> bool {
        self.to_string().starts_with('-')
    }

    /// The storage size: for a number its bits, for a fraction the bits and degrees of its terms.
    /// Limits on it protect against malicious input.
    fn size(&self) -> usize;

    /// An upper bound for the size of the sum.
    fn sum_size(&self, other: &Self) -> usize {
        self.size().saturating_add(other.size())
    }

    /// An upper bound for the size of the product.
    fn product_size(&self, other: &Self) -> usize {
        self.size().saturating_add(other.size())
    }
}
