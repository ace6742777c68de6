//! Expressions: parsing and evaluation of scalars in written form.
//!
//! The grammar has `+ - * / ^ ( )`, integers, quotients `p/q`, decimals, `1e-3`, names, and
//! functions like `sin(x)`. Decimals are exact. White space is ASCII only. A `*` or a space must
//! separate a number from a name, so `2x` is an error. A `*` must separate two names, so `a b` is
//! an error. The caller defines the meaning of names and operations ([`Evaluator`]). Therefore, one
//! grammar applies to scalars, to vectors that are written with the names of basis vectors, and to
//! complex numbers.
//!
//! | notation | means |
//! |---|---|
//! | `x**2`, `x²` | `x^2` |
//! | `a^b^c` | `a^(b^c)` |
//! | `−`, `·`, `×` | `-`, `*`, `*` |
//! | `ln(x)` | `log(x)` |
//! | `sec(x)`, `csc(x)`, `cot(x)`, `sech(x)`, `csch(x)`, `coth(x)` | `1/cos(x)`, `1/sin(x)`, `cos(x)/sin(x)`, `1/cosh(x)`, ... |
//! | Ohm sign Ω, micro sign µ | the Greek letters Ω, μ |
//! | `sin^2(x)` | `sin(x)^2`, for elementary functions |
//!
//! ```
//! use affinor_tensors::{Notation, Rational, expression::Expression};
//! let text = Expression::parse("1/2 - 2^-2 + 0.25")?;
//! let value: Rational = text.evaluate_constant()?;
//! assert_eq!(value.to_string(), "1/2");
//! # Ok::<(), affinor_tensors::expression::ExpressionError>(())
//! ```

mod functions;
mod names;
mod parser;
mod signs;

pub use functions::is_abbreviation;
pub use names::{canonical_name, is_name, is_name_character, is_printable, looks_latin};

use crate::{Notation, Rational};
use num_traits::One;
use std::ops::Range;

/// The largest number of digits of a number in an expression.
pub const MAX_DIGITS: usize = 10_000;
/// The largest exponent of a power, or of ten.
pub const MAX_EXPONENT: i64 = 10_000;
/// The deepest nesting of parentheses.
pub const MAX_DEPTH: usize = 100;
/// The deepest nesting of powers in exponents.
pub const MAX_TOWER: usize = 10;
/// The largest number of signs in front of a value.
pub const MAX_SIGNS: usize = 100;
/// The largest [`Notation::size`] of a value.
pub const MAX_SIZE: usize = 1 << 18;

/// An error in an expression, with its byte range in the text.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{reason}")]
pub struct ExpressionError {
    /// The offending part of the text.
    pub span: Range<usize>,
    /// The message.
    pub reason: String,
}

/// A parsed expression. Every part of it has a byte range in the text.
#[derive(Clone, Debug, PartialEq)]
pub struct Expression {
    span: Range<usize>,
    node: Node,
}

#[derive(Clone, Debug, PartialEq)]
enum Node {
    Number(Rational),
    Name(String),
    /// A list of terms. The flag marks a subtracted term.
    Sum(Vec<(bool, Expression)>),
    /// A list of factors. The flag marks a divisor.
    Product(Vec<(bool, Expression)>),
    /// A base and an exponent. An exponent without names and functions is reduced to a number.
    Power(Box<Expression>, Box<Expression>),
    /// A function and its arguments.
    Call(String, Vec<Expression>),
}

/// A view of the parts of an expression, for matching.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum View<'e> {
    /// A number.
    Number(&'e Rational),
    /// A name.
    Name(&'e str),
    /// A list of terms. The flag marks a subtracted term.
    Sum(&'e [(bool, Expression)]),
    /// A list of factors. The flag marks a factor that divides the product of the factors before
    /// it.
    Product(&'e [(bool, Expression)]),
    /// A base and an exponent. An exponent without names is a number.
    Power(&'e Expression, &'e Expression),
    /// A function and its arguments.
    Call(&'e str, &'e [Expression]),
}

/// An interpretation of expressions. It defines the values of numbers and names, and the operations
/// on values.
///
/// An error of these methods is a message. [`Expression::evaluate`] adds the byte range.
pub trait Evaluator {
    /// The type of the values of expressions.
    type Value: Clone;
    /// The value of a number.
    fn number(&self, number: &Rational) -> Result<Self::Value, String>;
    /// The value of a name.
    fn name(&self, name: &str) -> Result<Self::Value, String>;
    /// Computes `a + b`.
    fn add(&self, a: Self::Value, b: Self::Value) -> Result<Self::Value, String>;
    /// Computes `a * b`.
    fn multiply(&self, a: Self::Value, b: Self::Value) -> Result<Self::Value, String>;
    /// Computes `-a`.
    fn negate(&self, a: Self::Value) -> Self::Value;
    /// Computes `1 / a`.
    fn reciprocal(&self, a: Self::Value) -> Result<Self::Value, String>;
    /// Computes `base^exponent` for an exponent that is not an integer; integer powers are computed
    /// as products. By default, such an exponent is an error.
    fn raise(&self, base: Self::Value, exponent: Self::Value) -> Result<Self::Value, String> {
        let _ = (base, exponent);
        Err(NO_INTEGER.into())
    }
    /// Computes `1 / a^n`.
    fn divide(&self, a: Self::Value, n: u64) -> Result<Self::Value, String> {
        self.reciprocal(power(self, a, n)?)
    }
    /// The value of a function at an argument. By default, every function is an error.
    fn function(&self, name: &str, argument: Self::Value) -> Result<Self::Value, String> {
        no_function(name, &argument)
    }
    /// The value of a function at a list of arguments. By default, a function has one argument.
    fn call(&self, name: &str, arguments: Vec<Self::Value>) -> Result<Self::Value, String> {
        match <[_; 1]>::try_from(arguments) {
            Ok([argument]) => self.function(name, argument),
            Err(several) => Err(several_arguments(name, several.len())),
        }
    }
}

/// The name of the function of two arguments by which [`Scalars`] compute `base^exponent`.
pub const POWER: &str = "pow";

/// The message for an exponent that is not an integer, but must be an integer.
pub(crate) const NO_INTEGER: &str = "an exponent must be an integer";

/// The error for a function in expressions that must not contain functions.
pub fn no_function<V, A: ?Sized>(name: &str, _: &A) -> Result<V, String> {
    Err(if name == POWER { NO_INTEGER.into() } else { format!("`{name}` is not a function here") })
}

/// The message if a function of one argument has several arguments.
pub(crate) fn several_arguments(name: &str, count: usize) -> String {
    format!("there is no function `{name}` of {count} arguments here")
}

impl Expression {
    /// Parses a text, which must be a single expression.
    ///
    /// # Errors
    /// The first syntax error, or the first violation of a limit of this module.
    pub fn parse(text: &str) -> Result<Self, ExpressionError> {
        Self::parse_beside(text, &|_| false)
    }

    /// Parses a text in which names such as `e1` exist, so that `2e1` is ambiguous. If `known` is
    /// true for a name, it is an error that a number directly precedes this name.
    ///
    /// # Errors
    /// The errors of [`parse`](Self::parse); also an error for a number that directly precedes a
    /// known name.
    pub fn parse_beside(text: &str, known: &dyn Fn(&str) -> bool) -> Result<Self, ExpressionError> {
        parser::parse(text, known)
    }

    /// The byte range of the expression in its text.
    pub fn span(&self) -> Range<usize> {
        self.span.clone()
    }

    /// The parts of the expression.
    ///
    /// ```
    /// use affinor_tensors::expression::{Expression, View};
    /// let quotient = Expression::parse("a*(b + 1)/2")?;
    /// let View::Product([(false, _), (false, sum), (true, _)]) = quotient.view() else { panic!() };
    /// assert_eq!((sum.view(), sum.span()), (Expression::parse("  (b + 1)")?.view(), 2..9));
    /// # Ok::<(), affinor_tensors::expression::ExpressionError>(())
    /// ```
    pub fn view(&self) -> View<'_> {
        match &self.node {
            Node::Number(number) => View::Number(number),
            Node::Name(name) => View::Name(name),
            Node::Sum(terms) => View::Sum(terms),
            Node::Product(factors) => View::Product(factors),
            Node::Power(base, exponent) => View::Power(base, exponent),
            Node::Call(name, arguments) => View::Call(name, arguments),
        }
    }

    /// The value of the expression, computed by an evaluator.
    ///
    /// # Errors
    /// The error of the evaluator, with the byte range of the part where it occurs.
    pub fn evaluate<M: Evaluator>(&self, meaning: &M) -> Result<M::Value, ExpressionError> {
        let here = |reason| ExpressionError { span: self.span(), reason };
        match &self.node {
            Node::Number(number) => meaning.number(number).map_err(here),
            Node::Name(name) => meaning.name(name).map_err(here),
            Node::Sum(terms) => {
                let mut values = terms.iter().map(|(subtracted, term)| {
                    let value = term.evaluate(meaning)?;
                    Ok(if *subtracted { meaning.negate(value) } else { value })
                });
                let first = values.next().ok_or_else(|| here("an empty sum".into()))??;
                values.try_fold(first, |sum, value| meaning.add(sum, value?).map_err(here))
            }
            Node::Product(factors) => {
                let mut values = factors.iter().map(|(divides, factor)| {
                    let at = |reason| ExpressionError { span: factor.span(), reason };
                    if let (true, Node::Power(base, n)) = (*divides, &factor.node)
                        && let Some(n) = n.as_integer().filter(|n| *n > 0)
                    {
                        return meaning
                            .divide(base.evaluate(meaning)?, n.unsigned_abs())
                            .map_err(at);
                    }
                    let value = factor.evaluate(meaning)?;
                    if *divides { meaning.reciprocal(value).map_err(at) } else { Ok(value) }
                });
                let first = values.next().ok_or_else(|| here("an empty product".into()))??;
                values.try_fold(first, |product, value| {
                    meaning.multiply(product, value?).map_err(here)
                })
            }
            Node::Power(base, exponent) => {
                let mut value = base.evaluate(meaning)?;
                let Some(n) = exponent.as_integer() else {
                    let at = |reason| ExpressionError { span: exponent.span(), reason };
                    let exponent = exponent.evaluate(meaning)?;
                    return meaning.raise(value, exponent).map_err(at);
                };
                if n < 0 {
                    value = meaning.reciprocal(value).map_err(here)?;
                }
                power(meaning, value, n.unsigned_abs()).map_err(here)
            }
            Node::Call(name, arguments) => {
                let values = arguments.iter().map(|argument| argument.evaluate(meaning));
                meaning.call(name, values.collect::<Result<_, _>>()?).map_err(here)
            }
        }
    }

    /// The value, if the expression is an integer without an operation.
    fn as_integer(&self) -> Option<i64> {
        match &self.node {
            Node::Number(number) => number.to_i64(),
            _ => None,
        }
    }

    /// Whether the expression consists only of numbers and rational operations.
    fn is_rational(&self) -> bool {
        match &self.node {
            Node::Number(_) => true,
            Node::Name(_) | Node::Call(..) => false,
            Node::Sum(parts) | Node::Product(parts) => {
                parts.iter().all(|(_, part)| part.is_rational())
            }
            Node::Power(base, exponent) => exponent.as_integer().is_some() && base.is_rational(),
        }
    }

    /// The value of the expression as a scalar without parameters.
    ///
    /// # Errors
    /// A message if the expression contains a name or a division by zero, or if a value exceeds a
    /// limit.
    pub fn evaluate_constant<S: Notation>(&self) -> Result<S, ExpressionError> {
        self.evaluate(&Scalars(|name: &str| Err(format!("`{name}` is not a number")), no_function))
    }
}

/// Computes a power by repeated squaring.
pub(crate) fn power<M: Evaluator + ?Sized>(
    meaning: &M,
    mut base: M::Value,
    mut n: u64,
) -> Result<M::Value, String> {
    let mut result = meaning.number(&Rational::one())?;
    loop {
        if n & 1 == 1 {
            result = meaning.multiply(result, base.clone())?;
        }
        n >>= 1;
        if n == 0 {
            return Ok(result);
        }
        base = meaning.multiply(base.clone(), base)?;
    }
}

/// The evaluator for scalars. The first closure returns the values of names. The second closure
/// returns the values of functions, as in [`Notation::call`] or [`no_function`].
pub struct Scalars<N, F>(pub N, pub F);

impl<S, N, F> Evaluator for Scalars<N, F>
where
    S: Notation,
    N: Fn(&str) -> Result<S, String>,
    F: Fn(&str, &[S]) -> Result<S, String>,
{
    type Value = S;
    fn number(&self, number: &Rational) -> Result<S, String> {
        S::from_rational(number).ok_or_else(|| "the number is beyond the range of f64".into())
    }
    fn name(&self, name: &str) -> Result<S, String> {
        self.0(name)
    }
    fn add(&self, a: S, b: S) -> Result<S, String> {
        bounded(a.sum_size(&b))?;
        finite(a + &b)
    }
    fn multiply(&self, a: S, b: S) -> Result<S, String> {
        bounded(a.product_size(&b))?;
        finite(a * &b)
    }
    fn negate(&self, a: S) -> S {
        -a
    }
    fn reciprocal(&self, a: S) -> Result<S, String> {
        finite(a.recip().ok_or("division by zero")?)
    }
    /// Divides by the base repeatedly, because the factors of a formula are found in the base, but
    /// not in the expanded power.
    fn divide(&self, a: S, n: u64) -> Result<S, String> {
        if S::KIND == crate::Kind::Symbolic {
            power(self, self.reciprocal(a)?, n)
        } else {
            self.reciprocal(power(self, a, n)?)
        }
    }
    fn raise(&self, base: S, exponent: S) -> Result<S, String> {
        self.1(POWER, &[base, exponent])
    }
    fn call(&self, name: &str, arguments: Vec<S>) -> Result<S, String> {
        self.1(name, &arguments)
    }
}

fn bounded(size: usize) -> Result<(), String> {
    let fits = size <= MAX_SIZE;
    fits.then_some(()).ok_or_else(|| format!("the value grows beyond the limit of {MAX_SIZE}"))
}

fn finite<S: Notation>(value: S) -> Result<S, String> {
    match value.to_f64() {
        Some(x) if S::KIND == crate::Kind::Float && !x.is_finite() => {
            Err("the value is beyond the range of f64".into())
        }
        _ => Ok(value),
    }
}
