//! Scalars that are read and written: numbers, parameters, text and LaTeX.

use super::{Field, Rational};

/// Which of the three scalars a table was computed in.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// Exact rationals.
    Exact,
    /// Exact rational functions of parameters.
    Symbolic,
    /// Floating point with a tolerance.
    Float,
}

/// A field whose values can be written down and read back; `Display` gives the plain text.
pub trait Notation: Field {
    /// The kind of this scalar.
    const KIND: Kind;

    /// The value of a rational number; `None` where this scalar cannot hold it: beyond the range of
    /// floats, or so near zero that they lose its digits.
    fn from_rational(value: &Rational) -> Option<Self>;

    /// The parameter of that name; `None` for scalars without parameters.
    fn parameter(name: &str) -> Option<Self> {
        let _ = name;
        None
    }

    /// The parameters that the value depends on, sorted.
    fn parameters(&self) -> Vec<String> {
        vec![]
    }

    /// The value of a function like `sin` at an argument.
    ///
    /// # Errors
    /// Why there is none: an unknown function, or an argument at which it is no value of this
    /// scalar.
    fn function(name: &str, argument: &Self) -> Result<Self, String> {
        let _ = argument;
        Err(format!("`{name}` is no function here"))
    }

    /// The partial derivative by the parameter of that name; zero for numbers.
    fn derivative(&self, name: &str) -> Self {
        let _ = name;
        Self::zero()
    }

    /// The numerator as a sum of monomials in the parameters (names and powers), with rational
    /// coefficients; the value vanishes exactly when they do. Empty for floats, which are not
    /// polynomials.
    fn numerator_terms(&self) -> Vec<(Vec<(String, u32)>, Rational)>;

    /// The value as a number, free of parameters; `None` while it still depends on one.
    fn to_f64(&self) -> Option<f64>;

    /// The value in LaTeX's mathematics mode.
    fn latex(&self) -> String;

    /// Whether the plain text starts with a minus sign: which of `x` and `-x` a table prints.
    fn is_negative(&self) -> bool {
        self.to_string().starts_with('-')
    }

    /// A measure of storage (bits of a number, terms of a fraction) that bounds hostile input.
    fn size(&self) -> usize;

    /// A bound for the size of a sum.
    fn sum_size(&self, other: &Self) -> usize {
        self.size().saturating_add(other.size())
    }

    /// A bound for the size of a product.
    fn product_size(&self, other: &Self) -> usize {
        self.size().saturating_add(other.size())
    }
}
