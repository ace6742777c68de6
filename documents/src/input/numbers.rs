//! Floats in a text: vectors, matrices in row-major order, lines of CSV and JSON.

use super::Source;
use super::{InputError, shown};
use affinor_tensors::expression::{Evaluator, Expression};
use affinor_tensors::{Notation, Rational};
use std::f64::consts::{PI, TAU};

/// Reads the numbers in a line. They may be separated by commas, spaces or brackets: `1, 2, 3`,
/// `[[1,0],[0,1]]`, `pi/2 -0.5 1e-3`.
///
/// ```
/// use affinor_documents::input::{Source, numbers};
/// let row = numbers(&Source::new("a line", "[1/2, -1e-3, 2*pi]"))?;
/// assert_eq!(row, [0.5, -0.001, std::f64::consts::TAU]);
/// # Ok::<(), affinor_documents::input::InputError>(())
/// ```
///
/// # Errors
/// An error with its location, for a word that is not a finite number, and for a number so near
/// zero that a float would lose accuracy.
pub fn numbers(source: &Source) -> Result<Vec<f64>, InputError> {
    numbers_in(source.content(), source)
}

/// Reads the numbers in a piece of a source.
pub(crate) fn numbers_in(text: &str, source: &Source) -> Result<Vec<f64>, InputError> {
    expect_values(text, source)?;
    let apart = |c: char| c.is_ascii_whitespace() || ",;[]".contains(c);
    let words = text.split(apart).filter(|word| !word.is_empty());
    words.map(|word| number(word, source)).collect()
}

/// Returns an error for a comma at the beginning and for two commas with nothing between them,
/// because a missing number is not zero.
fn expect_values(text: &str, source: &Source) -> Result<(), InputError> {
    let mut before = ',';
    for (at, sign) in text.char_indices().filter(|(_, sign)| !sign.is_ascii_whitespace()) {
        if sign == ',' && ",;[".contains(before) {
            let place = source.find(text, at..at + 1);
            return Err(InputError::usage("a number is missing before a comma").at(&place));
        }
        before = sign;
    }
    Ok(())
}

fn number(word: &str, source: &Source) -> Result<f64, InputError> {
    // the parser accepts `inf`, `nan` and numbers that underflow; the check below rejects them
    let digits = word.split(['e', 'E']).next().unwrap_or(word);
    let is_zero = !digits.contains(|c: char| ('1'..='9').contains(&c));
    let kept = |value: &f64| value.is_normal() || (*value == 0.0 && is_zero);
    if let Some(value) = word.parse().ok().filter(kept) {
        return Ok(value);
    }
    let value = Expression::parse(word).and_then(|number| number.evaluate(&Floats));
    let value = value.map_err(|error| {
        let place = source.find(word, error.span.clone());
        InputError::usage(format!("`{}` is not a number: {}", shown(word), error.reason)).at(&place)
    })?;
    if value.is_finite() {
        return Ok(value);
    }
    let message = format!("`{}` is beyond the range of floats", shown(word));
    Err(InputError::usage(message).at(&source.whole(word)))
}

/// Evaluates numbers, `pi` and `tau` in floats.
struct Floats;

impl Evaluator for Floats {
    type Value = f64;

    fn number(&self, number: &Rational) -> Result<f64, String> {
        f64::from_rational(number).ok_or_else(beyond)
    }

    fn name(&self, name: &str) -> Result<f64, String> {
        match name {
            "pi" => Ok(PI),
            "tau" => Ok(TAU),
            _ => Err("the only names are pi and tau".into()),
        }
    }

    fn add(&self, a: f64, b: f64) -> Result<f64, String> {
        Ok(a + b)
    }

    fn multiply(&self, a: f64, b: f64) -> Result<f64, String> {
        let product = a * b;
        let lost = product.abs() < f64::MIN_POSITIVE && a != 0.0 && b != 0.0;
        if lost { Err(beyond()) } else { Ok(product) }
    }

    fn negate(&self, a: f64) -> f64 {
        -a
    }

    fn reciprocal(&self, a: f64) -> Result<f64, String> {
        match a.recip() {
            _ if a == 0.0 => Err("it divides by zero".into()),
            reciprocal if reciprocal.is_subnormal() => Err(beyond()),
            reciprocal => Ok(reciprocal),
        }
    }

    fn raise(&self, base: f64, exponent: f64) -> Result<f64, String> {
        match base.powf(exponent) {
            power if power.is_nan() => Err(format!("{base}^{exponent} is not a real number")),
            0.0 if base == 0.0 => Ok(0.0),
            power if power.is_normal() => Ok(power),
            _ => Err(beyond()),
        }
    }
}

fn beyond() -> String {
    "it is beyond the range of floats".into()
}
