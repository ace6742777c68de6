//! Expressions: parsing and evaluating written scalars.
//!
//! The grammar has `+ - * / ^ ( )`, integers, quotients `p/q`, decimals, `1e-3`, names, and functions
//! like `sin(x)`. Decimals are exact. White space is that of ASCII. A `*` or a space separates a number from a name; `2x` and
//! `a b` are errors. The caller gives names and operations their meaning ([`Meaning`]), so one
//! grammar serves scalars, vectors written in basis names, and complex numbers.
//!
//! ```
//! use affinor_tensors::{Notation, Rational, expression::Expression};
//! let text = Expression::parse("1/2 - 2^-2 + 0.25")?;
//! let value: Rational = text.evaluate_constant()?;
//! assert_eq!(value.to_string(), "1/2");
//! # Ok::<(), affinor_tensors::expression::ExpressionError>(())
//! ```

use crate::{Notation, Rational};
use num_traits::One;
use std::ops::Range;

/// The most digits one number may have.
pub const MAX_DIGITS: usize = 10_000;
/// The largest exponent, of a power or of ten.
pub const MAX_EXPONENT: i64 = 10_000;
/// The deepest nesting of parentheses.
pub const MAX_DEPTH: usize = 100;
/// The most signs in front of one value.
pub const MAX_SIGNS: usize = 100;
/// The largest [`Notation::size`] a value may reach.
pub const MAX_SIZE: usize = 1 << 18;

/// An error in an expression, with its byte range in the text.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{reason}")]
pub struct ExpressionError {
    /// The offending part of the text.
    pub span: Range<usize>,
    /// What is wrong with it.
    pub reason: String,
}

/// A parsed expression. Every part has its byte range in the text.
#[derive(Clone, Debug, PartialEq)]
pub struct Expression {
    span: Range<usize>,
    node: Node,
}

#[derive(Clone, Debug, PartialEq)]
enum Node {
    Number(Rational),
    Name(String),
    /// Terms, each with whether it is subtracted.
    Sum(Vec<(bool, Expression)>),
    /// Factors, each with whether it divides.
    Product(Vec<(bool, Expression)>),
    Power(Box<Expression>, i64),
    /// A function and its arguments.
    Call(String, Vec<Expression>),
}

/// The parts of an expression, to look at.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum View<'e> {
    /// A number.
    Number(&'e Rational),
    /// A name.
    Name(&'e str),
    /// Terms, each with whether it is subtracted.
    Sum(&'e [(bool, Expression)]),
    /// Factors, each with whether it divides the product of those in front of it.
    Product(&'e [(bool, Expression)]),
    /// A power with its exponent.
    Power(&'e Expression, i64),
    /// A function and its arguments.
    Call(&'e str, &'e [Expression]),
}

/// An interpretation of expressions: the values of numbers and names, and the operations on values.
///
/// An error is the reason in words; [`Expression::evaluate`] adds the byte range.
pub trait Meaning {
    /// The values that expressions take.
    type Value: Clone;
    /// The value of a number.
    fn number(&self, number: &Rational) -> Result<Self::Value, String>;
    /// The value of a name.
    fn name(&self, name: &str) -> Result<Self::Value, String>;
    /// `a + b`.
    fn add(&self, a: Self::Value, b: Self::Value) -> Result<Self::Value, String>;
    /// `a * b`.
    fn multiply(&self, a: Self::Value, b: Self::Value) -> Result<Self::Value, String>;
    /// `-a`.
    fn negate(&self, a: Self::Value) -> Self::Value;
    /// `1 / a`.
    fn reciprocal(&self, a: Self::Value) -> Result<Self::Value, String>;
    /// The value of a function at an argument. By default no function is known.
    fn function(&self, name: &str, argument: Self::Value) -> Result<Self::Value, String> {
        no_function(name, &argument)
    }
    /// The value of a function at a list of arguments. By default functions take one.
    fn call(&self, name: &str, arguments: Vec<Self::Value>) -> Result<Self::Value, String> {
        match <[_; 1]>::try_from(arguments) {
            Ok([argument]) => self.function(name, argument),
            Err(several) => Err(several_arguments(name, several.len())),
        }
    }
}

/// The value of a function where none is known: an error.
pub fn no_function<V, A: ?Sized>(name: &str, _: &A) -> Result<V, String> {
    Err(format!("`{name}` is no function here"))
}

/// The reason why a function of one argument has no value at several.
pub(crate) fn several_arguments(name: &str, count: usize) -> String {
    format!("there is no function `{name}` of {count} arguments here")
}

impl Expression {
    /// Parses a whole text.
    ///
    /// # Errors
    /// The first syntax error, or the first excess of a limit of this module.
    pub fn parse(text: &str) -> Result<Self, ExpressionError> {
        Self::parse_beside(text, &|_| false)
    }

    /// Parses a text in which names like `e1` exist, so that `2e1` is ambiguous: a number directly
    /// followed by a name for which `known` is true is an error.
    ///
    /// # Errors
    /// As [`parse`](Self::parse).
    pub fn parse_beside(text: &str, known: &dyn Fn(&str) -> bool) -> Result<Self, ExpressionError> {
        let mut parser = Parser { text, at: 0, depth: 0, known };
        let expression = parser.sum()?;
        parser.skip_space();
        match parser.peek() {
            None => Ok(expression),
            Some(symbol) => Err(parser.unexpected(symbol)),
        }
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
            Node::Power(base, exponent) => View::Power(base, *exponent),
            Node::Call(name, arguments) => View::Call(name, arguments),
        }
    }

    /// The value under a meaning.
    ///
    /// # Errors
    /// The error of the meaning, with the byte range of the part where it occurs.
    pub fn evaluate<M: Meaning>(&self, meaning: &M) -> Result<M::Value, ExpressionError> {
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
                    let value = factor.evaluate(meaning)?;
                    let at = |reason| ExpressionError { span: factor.span(), reason };
                    if *divides { meaning.reciprocal(value).map_err(at) } else { Ok(value) }
                });
                let first = values.next().ok_or_else(|| here("an empty product".into()))??;
                values.try_fold(first, |product, value| {
                    meaning.multiply(product, value?).map_err(here)
                })
            }
            Node::Power(base, exponent) => {
                let mut value = base.evaluate(meaning)?;
                if *exponent < 0 {
                    value = meaning.reciprocal(value).map_err(here)?;
                }
                power(meaning, value, exponent.unsigned_abs()).map_err(here)
            }
            Node::Call(name, arguments) => {
                let values = arguments.iter().map(|argument| argument.evaluate(meaning));
                meaning.call(name, values.collect::<Result<_, _>>()?).map_err(here)
            }
        }
    }

    /// The value as a scalar without parameters.
    ///
    /// # Errors
    /// A name, a division by zero, or a value that exceeds a limit.
    pub fn evaluate_constant<S: Notation>(&self) -> Result<S, ExpressionError> {
        self.evaluate(&Scalars(|name: &str| Err(format!("`{name}` is not a number")), no_function))
    }
}

/// The power by repeated squaring.
fn power<M: Meaning>(meaning: &M, mut base: M::Value, mut n: u64) -> Result<M::Value, String> {
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

/// The meaning of expressions as scalars: one closure gives the values of names, another the values
/// of functions, like [`Notation::call`] or [`no_function`].
pub struct Scalars<N, F>(pub N, pub F);

impl<S, N, F> Meaning for Scalars<N, F>
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

/// Whether the text is a valid name: an ASCII letter or `_`, then letters, digits and `_`.
pub fn is_name(name: &str) -> bool {
    name.starts_with(begins_name) && name.chars().all(continues_name)
}

const NO_INTEGER: &str = "an exponent is an integer";

fn begins_name(c: char) -> bool {
    c.is_ascii_alphabetic() || c == '_'
}

fn continues_name(c: char) -> bool {
    c.is_ascii_alphanumeric() || c == '_'
}

struct Parser<'t> {
    text: &'t str,
    at: usize,
    depth: usize,
    known: &'t dyn Fn(&str) -> bool,
}

impl Parser<'_> {
    fn peek(&self) -> Option<char> {
        self.text[self.at..].chars().next()
    }

    fn skip_space(&mut self) {
        let rest = &self.text[self.at..];
        self.at += rest.len() - rest.trim_start_matches(|c: char| c.is_ascii_whitespace()).len();
    }

    /// Consumes and returns the next symbol after white space, if it is one of `symbols`.
    fn take(&mut self, symbols: &[char]) -> Option<char> {
        self.skip_space();
        let symbol = self.peek().filter(|symbol| symbols.contains(symbol))?;
        self.at += symbol.len_utf8();
        Some(symbol)
    }

    fn error<T>(
        &self,
        span: Range<usize>,
        reason: impl Into<String>,
    ) -> Result<T, ExpressionError> {
        Err(ExpressionError { span, reason: reason.into() })
    }

    fn unexpected(&self, symbol: char) -> ExpressionError {
        let span = self.at..self.at + symbol.len_utf8();
        let reason = if symbol.is_ascii_graphic() {
            format!("`{symbol}` is not expected here")
        } else {
            format!("the character {} is not expected here", symbol.escape_unicode())
        };
        ExpressionError { span, reason }
    }

    fn sum(&mut self) -> Result<Expression, ExpressionError> {
        self.skip_space();
        let from = self.at;
        let mut terms = Vec::new();
        loop {
            terms.push((self.signs()?, self.product()?));
            self.skip_space();
            if !matches!(self.peek(), Some('+' | '-')) {
                return Ok(fold(terms, from..self.at, Node::Sum));
            }
        }
    }

    /// Whether an odd number of minus signs stands here.
    fn signs(&mut self) -> Result<bool, ExpressionError> {
        let mut negative = false;
        for _ in 0..=MAX_SIGNS {
            match self.take(&['+', '-']) {
                Some(sign) => negative ^= sign == '-',
                None => return Ok(negative),
            }
        }
        self.error(self.at - 1..self.at, format!("more than {MAX_SIGNS} signs in a row"))
    }

    /// A factor behind `*` or `/`, perhaps with signs.
    fn factor(&mut self) -> Result<Expression, ExpressionError> {
        self.skip_space();
        let from = self.at;
        let sign = (self.signs()?, self.power()?);
        Ok(fold(vec![sign], from..self.at, Node::Sum))
    }

    fn product(&mut self) -> Result<Expression, ExpressionError> {
        self.skip_space();
        let from = self.at;
        let mut factors = vec![(false, self.power()?)];
        loop {
            let end = self.at;
            if let Some(symbol) = self.take(&['*', '/']) {
                factors.push((symbol == '/', self.factor()?));
            } else if self.peek().is_some_and(begins_name) {
                let number =
                    matches!(factors.last(), Some((_, Expression { node: Node::Number(_), .. })));
                let written =
                    self.text[from..end].ends_with(|c: char| c.is_ascii_digit() || c == '.');
                if !(number && written) {
                    return self
                        .error(self.at..self.at + 1, "an operator is missing before this name");
                }
                if self.at == end {
                    let span = self.at..self.at + 1;
                    return self.error(span, "write `*` or a space between a number and a name");
                }
                factors.push((false, self.power()?));
            } else {
                self.at = end;
                return Ok(fold(factors, from..end, Node::Product));
            }
        }
    }

    fn power(&mut self) -> Result<Expression, ExpressionError> {
        let base = self.atom()?;
        let end = self.at;
        if self.take(&['^']).is_none() {
            self.at = end;
            return Ok(base);
        }
        let exponent = self.exponent()?;
        let end = self.at;
        if self.take(&['^']).is_some() {
            return self.error(self.at - 1..self.at, "write parentheses around a power of a power");
        }
        self.at = end;
        let span = base.span.start..end;
        Ok(Expression { span, node: Node::Power(Box::new(base), exponent) })
    }

    /// An integer with an optional sign, optionally in parentheses.
    fn exponent(&mut self) -> Result<i64, ExpressionError> {
        let parenthesis = self.take(&['(']).is_some();
        let sign = self.take(&['+', '-']);
        self.skip_space();
        let from = self.at;
        let digits = self.digits();
        if digits.is_empty() {
            let width = self.peek().map_or(0, char::len_utf8);
            return self.error(from..from + width, NO_INTEGER);
        }
        if self.peek() == Some('.') {
            return self.error(from..self.at + 1, NO_INTEGER);
        }
        let value = digits.parse::<i64>().ok().filter(|n| *n <= MAX_EXPONENT);
        let Some(value) = value else {
            return self.error(from..self.at, format!("an exponent is at most {MAX_EXPONENT}"));
        };
        let end = self.at;
        if parenthesis && self.take(&[')']).is_none() {
            if self.take(&['/', '*', '+', '-']).is_some() {
                return self.error(from..end, NO_INTEGER);
            }
            return self.error(self.at..self.at, "`)` is missing after the exponent");
        }
        Ok(if sign == Some('-') { -value } else { value })
    }

    fn atom(&mut self) -> Result<Expression, ExpressionError> {
        self.skip_space();
        let from = self.at;
        match self.peek() {
            None => self.error(from..from, "the expression ends where a value is expected"),
            Some('(') => {
                let inside = self.parenthesis(Self::sum)?;
                Ok(Expression { span: from..self.at, node: inside.node })
            }
            Some(c) if c.is_ascii_digit() || c == '.' => self.number(),
            Some(c) if begins_name(c) => {
                let rest = &self.text[from..];
                let length = rest.find(|c| !continues_name(c)).unwrap_or(rest.len());
                // basis vectors of a sum, `e1'`
                let primes = rest[length..].bytes().take_while(|byte| *byte == b'\'').count();
                self.at += length + primes;
                let name = self.text[from..self.at].to_string();
                if self.peek() != Some('(') {
                    return Ok(Expression { span: from..self.at, node: Node::Name(name) });
                }
                let node = Node::Call(name, self.parenthesis(Self::arguments)?);
                Ok(Expression { span: from..self.at, node })
            }
            Some(c) => Err(self.unexpected(c)),
        }
    }

    /// What stands in parentheses, from the opening one on.
    fn parenthesis<T>(
        &mut self,
        inside: fn(&mut Self) -> Result<T, ExpressionError>,
    ) -> Result<T, ExpressionError> {
        let from = self.at;
        self.at += 1;
        self.depth += 1;
        if self.depth > MAX_DEPTH {
            let reason = format!("more than {MAX_DEPTH} nested parentheses");
            return self.error(from..from + 1, reason);
        }
        let found = inside(self)?;
        self.depth -= 1;
        match (self.take(&[')']), self.peek()) {
            (Some(_), _) => Ok(found),
            (None, Some(symbol)) => Err(self.unexpected(symbol)),
            (None, None) => self.error(from..from + 1, "this parenthesis is not closed"),
        }
    }

    /// The arguments of a function, separated by commas.
    fn arguments(&mut self) -> Result<Vec<Expression>, ExpressionError> {
        let mut all = vec![self.sum()?];
        while self.take(&[',']).is_some() {
            all.push(self.sum()?);
        }
        Ok(all)
    }

    fn digits(&mut self) -> String {
        let rest = &self.text[self.at..];
        let digits = &rest[..rest.find(|c: char| !c.is_ascii_digit()).unwrap_or(rest.len())];
        self.at += digits.len();
        digits.into()
    }

    /// The exponent of `e-3` directly after a number; zero if there is none.
    fn power_of_ten(&mut self) -> Result<i64, ExpressionError> {
        let rest = &self.text[self.at..];
        let Some(behind) = rest.strip_prefix(['e', 'E']) else { return Ok(0) };
        let digits = behind.strip_prefix(['+', '-']).unwrap_or(behind);
        if !digits.starts_with(|c: char| c.is_ascii_digit()) {
            return Ok(0);
        }
        let from = self.at;
        self.at += rest.len() - digits.len();
        let value = self.digits().parse::<i64>().ok().filter(|n| *n <= MAX_EXPONENT);
        match value {
            Some(value) => Ok(if behind.starts_with('-') { -value } else { value }),
            None => self.error(from..self.at, format!("an exponent is at most {MAX_EXPONENT}")),
        }
    }

    /// Digits, a fraction, a power of ten.
    fn number(&mut self) -> Result<Expression, ExpressionError> {
        let from = self.at;
        let mut digits = self.digits();
        let mut decimals = 0;
        if self.peek() == Some('.') {
            self.at += 1;
            let fraction = self.digits();
            decimals = fraction.len() as i64;
            digits.push_str(&fraction);
        }
        let glued = &self.text[self.at..];
        let glued = &glued[..glued.find(|c| !continues_name(c)).unwrap_or(glued.len())];
        if (self.known)(glued) {
            let mut reason = format!("write `*` or a space between the number and `{glued}`");
            if let Some(digits) = glued.strip_prefix(['e', 'E'])
                && digits.starts_with(|c: char| c.is_ascii_digit())
            {
                reason += &format!(", or `e+{digits}` for a power of ten");
            }
            return self.error(from..self.at + glued.len(), reason);
        }
        let exponent = self.power_of_ten()?;
        let span = from..self.at;
        if digits.len() > MAX_DIGITS {
            return self.error(span, format!("a number has at most {MAX_DIGITS} digits"));
        }
        let Some(mantissa) = Rational::from_digits(&digits) else {
            return self.error(span, "a number needs a digit");
        };
        let shift = exponent - decimals;
        let ten = Rational::from_digits(&format!("1{}", "0".repeat(shift.unsigned_abs() as usize)));
        let value = match (ten, shift < 0) {
            (Some(ten), false) => mantissa * &ten,
            (Some(ten), true) => mantissa / &ten,
            (None, _) => mantissa,
        };
        Ok(Expression { span, node: Node::Number(value) })
    }
}

/// A sum or product; a single positive part is returned unchanged.
fn fold(
    mut parts: Vec<(bool, Expression)>,
    span: Range<usize>,
    node: fn(Vec<(bool, Expression)>) -> Node,
) -> Expression {
    match parts.as_slice() {
        [(false, _)] => parts.swap_remove(0).1,
        _ => Expression { span, node: node(parts) },
    }
}
