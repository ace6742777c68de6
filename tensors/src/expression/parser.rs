//! The parser of expressions. It works by recursive descent, with one method for each level of the
//! grammar.

use super::functions::is_elementary;
use super::names::{begins_name, canonical_name, continues_name, looks_latin, shown};
use super::signs::{MINUS, caret, plain, superscript};
use super::{
    Expression, ExpressionError, MAX_DEPTH, MAX_DIGITS, MAX_EXPONENT, MAX_SIGNS, MAX_TOWER, Node,
};
use crate::Rational;
use std::ops::Range;

/// Messages repeat the text if its length is at most this value.
const MAX_SHOWN: usize = 60;

/// The largest number of corrections that a message proposes.
const MAX_EDITS: usize = 8;

/// Parses a text, which must be a single expression. The names for which `known` is true exist.
pub(super) fn parse(
    text: &str,
    known: &dyn Fn(&str) -> bool,
) -> Result<Expression, ExpressionError> {
    parse_once(text, known).map_err(|(mut error, edit)| {
        if let Some(whole) = edit.and_then(|edit| corrected(text, known, edit)) {
            let problem = error.reason.split(": ").next().unwrap_or_default();
            error.reason = format!("{problem}: write `{whole}`");
        }
        error
    })
}

/// A correction of the text: a range and its replacement.
type Edit = (Range<usize>, &'static str);

fn parse_once(
    text: &str,
    known: &dyn Fn(&str) -> bool,
) -> Result<Expression, (ExpressionError, Option<Edit>)> {
    let mut parser = Parser { text, at: 0, depth: 0, tower: 0, edit: None, known };
    parser.whole().map_err(|error| (error, parser.edit))
}

/// Applies this correction, and all corrections that follow from it, to the whole text. Returns
/// `None` if the result is long, or has other errors.
fn corrected(text: &str, known: &dyn Fn(&str) -> bool, edit: Edit) -> Option<String> {
    let mut text = text.to_string();
    let mut next = Some(edit);
    for _ in 0..MAX_EDITS {
        let (range, replacement) = next.filter(|_| is_short(&text))?;
        text.replace_range(range, replacement);
        next = match parse_once(&text, known) {
            Ok(_) => return Some(text.trim().into()),
            Err((_, edit)) => edit,
        };
    }
    None
}

/// Whether the text is short enough to occur in a message.
fn is_short(text: &str) -> bool {
    text.len() <= MAX_SHOWN && !text.contains(char::is_control)
}

struct Parser<'t> {
    text: &'t str,
    at: usize,
    depth: usize,
    /// The nesting depth of exponents at the current position.
    tower: usize,
    /// The correction of the error, if there is a correction.
    edit: Option<Edit>,
    known: &'t dyn Fn(&str) -> bool,
}

impl Parser<'_> {
    fn whole(&mut self) -> Result<Expression, ExpressionError> {
        let expression = self.sum()?;
        self.skip_space();
        match self.peek() {
            None => Ok(expression),
            Some(symbol) => Err(self.unexpected(symbol)),
        }
    }

    fn peek(&self) -> Option<char> {
        self.text[self.at..].chars().next()
    }

    fn skip_space(&mut self) {
        let rest = &self.text[self.at..];
        self.at += rest.len() - rest.trim_start_matches(|c: char| c.is_ascii_whitespace()).len();
    }

    /// Consumes the next symbol after white space, if it is one of `symbols`. Returns this symbol.
    fn take(&mut self, symbols: &[char]) -> Option<char> {
        self.skip_space();
        let symbol = self.peek()?;
        let found = symbols.contains(&plain(symbol)).then(|| plain(symbol))?;
        self.at += symbol.len_utf8();
        Some(found)
    }

    /// The length of the name that begins at the current position.
    fn name_length(&self) -> usize {
        let rest = &self.text[self.at..];
        rest.find(|c| !continues_name(c)).unwrap_or(rest.len())
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
        let reason = format!("{} is not expected here", shown(symbol));
        ExpressionError { span, reason }
    }

    fn sum(&mut self) -> Result<Expression, ExpressionError> {
        self.skip_space();
        let from = self.at;
        let mut terms = Vec::new();
        loop {
            terms.push((self.signs()?, self.product()?));
            self.skip_space();
            if !matches!(self.peek().map(plain), Some('+' | '-')) {
                return Ok(fold(terms, from..self.at, Node::Sum));
            }
        }
    }

    /// Reads signs. Returns whether the number of minus signs is odd.
    fn signs(&mut self) -> Result<bool, ExpressionError> {
        let mut negative = false;
        let mut last = self.at;
        for _ in 0..=MAX_SIGNS {
            last = self.at;
            match self.take(&['+', '-']) {
                Some(sign) => negative ^= sign == '-',
                None => return Ok(negative),
            }
        }
        self.error(last..self.at, format!("more than {MAX_SIGNS} signs in a row"))
    }

    /// Reads a factor after `*` or `/`. The factor may begin with signs.
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
                continue;
            }
            let numeral = match factors.last() {
                Some((_, Expression { node: Node::Number(_), .. })) => {
                    self.text[from..end].ends_with(|c: char| c.is_ascii_digit() || c == '.')
                }
                _ => false,
            };
            let name = self.peek().is_some_and(begins_name);
            match self.peek() {
                Some(_) if name && numeral && self.at > end => {
                    factors.push((false, self.power()?));
                }
                Some(c) if name || c == '(' || (c.is_ascii_digit() && !numeral) => {
                    return Err(self.missing(factors.last().map(|(_, factor)| factor), end));
                }
                _ => {
                    self.at = end;
                    return Ok(fold(factors, from..end, Node::Product));
                }
            }
        }
    }

    /// The error if an operator, or the parentheses of a function, are missing between a factor and
    /// the current position.
    fn missing(&mut self, last: Option<&Expression>, end: usize) -> ExpressionError {
        let width = self.name_length().max(1);
        let span = self.at..self.at + width;
        let before = last.and_then(|last| self.text.get(last.span()));
        let before = before.filter(|text| is_short(text)).unwrap_or("...");
        let after = Some(&self.text[span.clone()]).filter(|text| is_short(text)).unwrap_or("...");
        let called = last.is_some_and(Expression::is_function_name);
        let edit = if called { "" } else { "*" };
        let reason = match (called, after) {
            (true, "(") => {
                format!("remove the space before the parenthesis: write `{before}(...)`")
            }
            (true, _) => format!("parentheses are missing: write `{before}({after})`"),
            (false, "(") => format!("`*` is missing: write `{before}*(...)`"),
            (false, _) => format!("`*` is missing: write `{before}*{after}`"),
        };
        self.edit = (!called || after == "(").then_some((end..self.at, edit));
        ExpressionError { span, reason }
    }

    fn power(&mut self) -> Result<Expression, ExpressionError> {
        let base = self.atom()?;
        let end = self.at;
        let exponent = match superscript(&self.text[end..]) {
            Some((exponent, width)) => {
                self.at += width;
                let exponent = self.integer(&exponent, end)?;
                let end = self.at;
                if self.take_caret() {
                    let reason = "write parentheses around a power of a power";
                    return self.error(end..self.at, reason);
                }
                self.at = end;
                exponent
            }
            None if self.take_caret() => self.exponent()?,
            None => {
                self.at = end;
                return Ok(base);
            }
        };
        let span = base.span.start..self.at;
        Ok(Expression { span, node: Node::Power(Box::new(base), Box::new(exponent)) })
    }

    /// Consumes `^` or `**`.
    fn take_caret(&mut self) -> bool {
        self.skip_space();
        let width = caret(&self.text[self.at..]);
        self.at += width;
        width > 0
    }

    /// Reads an exponent, which may begin with a sign: `-2`, `(1/2)`, `2^p`.
    fn exponent(&mut self) -> Result<Expression, ExpressionError> {
        self.skip_space();
        let from = self.at;
        self.tower += 1;
        if self.tower > MAX_TOWER {
            let reason = format!("more than {MAX_TOWER} powers in exponents");
            return self.error(from..from, reason);
        }
        let (negative, size) = (self.signs()?, self.power()?);
        self.tower -= 1;
        let (without_sign, span) = (size.span(), from..self.at);
        let exponent = fold(vec![(negative, size)], span.clone(), Node::Sum);
        if !exponent.is_rational() {
            return Ok(exponent);
        }
        let value: Rational = exponent.evaluate_constant()?;
        Ok(Expression { span, ..self.bounded_exponent(value, without_sign)? })
    }

    fn bounded_exponent(
        &self,
        value: Rational,
        span: Range<usize>,
    ) -> Result<Expression, ExpressionError> {
        if value.to_f64().abs() > MAX_EXPONENT as f64 {
            return self.error(span, format!("an exponent must be at most {MAX_EXPONENT}"));
        }
        Ok(Expression { span, node: Node::Number(value) })
    }

    /// The exponent with these digits. Its text begins at `from`, and may begin with a sign.
    fn integer(&self, digits: &str, from: usize) -> Result<Expression, ExpressionError> {
        // uses the maximum for a number that does not fit, because both exceed the limit
        let value = digits.parse().unwrap_or(i64::MAX);
        self.bounded_exponent(Rational::from(value), from..self.at)
    }

    /// Reads the integer `n` in `sin^n(x)`, from the end of the name to the parenthesis.
    fn power_of_function(&mut self) -> Result<Option<Expression>, ExpressionError> {
        let from = self.at;
        let rest = &self.text[from..];
        let (digits, width) = superscript(rest).unwrap_or_else(|| {
            let start = caret(rest);
            let written = &rest[start..];
            let sign = written.chars().next().filter(|c| plain(*c) == '-');
            let behind = &written[sign.map_or(0, char::len_utf8)..];
            let count = behind.find(|c: char| !c.is_ascii_digit()).unwrap_or(behind.len());
            let digits = format!("{}{}", sign.map_or("", |_| "-"), &behind[..count]);
            if start == 0 || count == 0 {
                return (digits, 0);
            }
            (digits, rest.len() - behind.len() + count)
        });
        self.at += width;
        let end = self.at;
        self.skip_space();
        if width == 0 || self.peek() != Some('(') {
            self.at = from;
            return Ok(None);
        }
        let behind = std::mem::replace(&mut self.at, end);
        let power = self.integer(&digits, from)?;
        self.at = behind;
        Ok(Some(power))
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
                let length = self.name_length();
                if looks_latin(&self.text[from..from + length]) {
                    self.at += self.text[from..].find(|c: char| !c.is_ascii()).unwrap_or_default();
                    let letter = self.peek().unwrap_or(c);
                    let ExpressionError { span, reason } = self.unexpected(letter);
                    return self.error(span, reason + ": it looks like a Latin letter");
                }
                // accepts primes in the names of basis vectors of a direct sum, such as `e1'`
                let rest = &self.text[from + length..];
                let primes = rest.bytes().take_while(|byte| *byte == b'\'').count();
                self.at += length + primes;
                let name = &*canonical_name(&self.text[from..self.at]);
                let power = if is_elementary(name) { self.power_of_function()? } else { None };
                if self.peek() != Some('(') {
                    return Ok(Expression { span: from..self.at, node: Node::Name(name.into()) });
                }
                if let Some(power) = power.as_ref().filter(|power| power.as_integer() == Some(-1)) {
                    let reason = format!(
                        "`{name}^-1` may be the reciprocal or the inverse function: write `1/{name}(...)` or `{name}(...)^-1` \
                         for the reciprocal"
                    );
                    return self.error(from..power.span.end, reason);
                }
                let arguments = self.parenthesis(Self::arguments)?;
                let call = Expression::call(name, arguments, from..self.at);
                Ok(match power {
                    None => call,
                    Some(power) => {
                        let node = Node::Power(Box::new(call), Box::new(power));
                        Expression { span: from..self.at, node }
                    }
                })
            }
            Some(c) => Err(self.unexpected(c)),
        }
    }

    /// Reads parentheses. The function `inside` reads their content.
    fn parenthesis<T>(
        &mut self,
        inside: fn(&mut Self) -> Result<T, ExpressionError>,
    ) -> Result<T, ExpressionError> {
        let from = self.at;
        self.at += 1;
        self.depth += 1;
        // allows more depth in exponents, because each exponent may be in parentheses
        if self.depth > MAX_DEPTH + self.tower {
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

    /// Reads the arguments of a function, which are separated by commas.
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

    /// Reads the power of ten of `e-3` directly after a number. Returns zero if there is none.
    fn power_of_ten(&mut self) -> Result<i64, ExpressionError> {
        let rest = &self.text[self.at..];
        let Some(behind) = rest.strip_prefix(['e', 'E']) else { return Ok(0) };
        let digits = behind.strip_prefix(['+', '-', MINUS]).unwrap_or(behind);
        if !digits.starts_with(|c: char| c.is_ascii_digit()) {
            return Ok(0);
        }
        let from = self.at;
        self.at += rest.len() - digits.len();
        let value = self.digits().parse::<i64>().ok().filter(|n| *n <= MAX_EXPONENT);
        match value {
            Some(value) => Ok(if behind.starts_with(['-', MINUS]) { -value } else { value }),
            None => {
                self.error(from..self.at, format!("an exponent must be at most {MAX_EXPONENT}"))
            }
        }
    }

    /// Reads a number, which consists of digits, a fraction and a power of ten.
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
            return self.error(span, format!("a number can have at most {MAX_DIGITS} digits"));
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

/// A sum or product of several parts. A single part without a sign is returned unchanged.
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
