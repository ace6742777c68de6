//! Scalars with a written form. They are converted from numbers and parameters, and to text and
//! LaTeX.

use super::{Field, Rational, Variable};
use crate::expression::{POWER, no_function, several_arguments};
use std::collections::BTreeSet;

/// The three kinds of scalars that tables contain.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// Exact rationals.
    Exact,
    /// Exact rational functions of parameters.
    Symbolic,
    /// Floating point with a tolerance.
    Float,
}

/// A field whose values have a written form. `Display` writes the plain text.
pub trait Notation: Field {
    /// The kind of this scalar.
    const KIND: Kind;

    /// Converts a rational number to this scalar. Returns `None` if a float would overflow, or
    /// would lose accuracy because the number is too close to zero.
    fn from_rational(value: &Rational) -> Option<Self>;

    /// The parameter with this name, or the number `pi`. Returns `None` for scalars without
    /// parameters.
    fn parameter(name: &str) -> Option<Self> {
        let _ = name;
        None
    }

    /// The value that parsing the text of this value returns. Conditions on free functions are
    /// lost.
    fn read_back(&self) -> Self {
        self.clone()
    }

    /// The sorted names of the parameters on which the value depends.
    fn parameters(&self) -> Vec<String> {
        vec![]
    }

    /// The names of the parameters on which any of the values depends.
    fn parameters_of(values: &mut dyn Iterator<Item = &Self>) -> BTreeSet<String> {
        match Self::KIND {
            Kind::Symbolic => values.flat_map(Self::parameters).collect(),
            Kind::Exact | Kind::Float => BTreeSet::new(),
        }
    }

    /// The value of an elementary function such as `sin` at an argument.
    ///
    /// # Errors
    /// A message if the function is unknown, or if this scalar has no value of the function at this
    /// argument.
    fn function(name: &str, argument: &Self) -> Result<Self, String> {
        no_function(name, argument)
    }

    /// The value of a function at a list of arguments. By default, a function has one argument. A
    /// power with an exponent that is not an integer is the function `pow` of its base and
    /// exponent.
    ///
    /// # Errors
    /// The errors of [`function`](Self::function).
    fn call(name: &str, arguments: &[Self]) -> Result<Self, String> {
        match arguments {
            [argument] => Self::function(name, argument),
            [_, exponent] if name == POWER => no_function(name, exponent),
            several => Err(several_arguments(name, several.len())),
        }
    }

    /// The partial derivative with respect to the parameter `name`. It is zero for numbers.
    fn derivative(&self, name: &str) -> Self {
        let _ = name;
        Self::zero()
    }

    /// The terms of the numerator. Each term is a monomial in the variables (with their powers) and
    /// its rational coefficient. The value vanishes exactly if there are no terms. For floats, the
    /// list is always empty.
    fn numerator_terms(&self) -> Vec<(Vec<(Variable, u32)>, Rational)> {
        vec![]
    }

    /// The value of a variable that occurs in [`numerator_terms`](Self::numerator_terms). Returns
    /// `None` for scalars without parameters.
    fn variable(variable: Variable) -> Option<Self> {
        let _ = variable;
        None
    }

    /// The value as a float. Returns `None` if it depends on a parameter.
    fn to_f64(&self) -> Option<f64>;

    /// The value in the mathematics mode of LaTeX.
    fn latex(&self) -> String;

    /// Whether the plain text begins with a minus sign. Tables use this method to print only one of
    /// `x` and `-x`.
    fn is_negative(&self) -> bool {
        self.to_string().starts_with('-')
    }

    /// The size of the stored value. For a number, it is the number of bits; for a fraction, it is
    /// the sum of bits and degrees of its terms. Limits on the size protect against malicious
    /// input.
    fn size(&self) -> usize;

    /// An upper bound of the size of the sum.
    fn sum_size(&self, other: &Self) -> usize {
        self.size().saturating_add(other.size())
    }

    /// An upper bound of the size of the product.
    fn product_size(&self, other: &Self) -> usize {
        self.size().saturating_add(other.size())
    }
}
