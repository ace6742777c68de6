//! Rational numbers as decimal numbers.

use crate::Rational;
use num_bigint::BigInt;
use num_rational::BigRational;

/// The number as a decimal with this number of significant digits. It is rounded up or down.
///
/// ```
/// use affinor_tensors::{Rational, text::rounded};
/// let third = Rational::new(-1, 3).unwrap();
/// assert_eq!(rounded(&third, 4, true).as_deref(), Some("-0.3333"));
/// assert_eq!(rounded(&third, 4, false).as_deref(), Some("-0.3334"));
/// let large = Rational::new(1_234_567_891, 1).unwrap();
/// assert_eq!(rounded(&large, 3, false).as_deref(), Some("1.23e9"));
/// ```
///
/// Returns `None` for zero, and for numbers beyond the range of floats.
pub fn rounded(value: &Rational, digits: u32, up: bool) -> Option<String> {
    let size = Some(value.to_f64().abs()).filter(|size| size.is_normal())?;
    let exponent = size.log10().floor() as i32 + 1 - i32::try_from(digits).ok()?;
    let ten = BigRational::from_integer(10.into());
    let units = BigRational::from(value) / ten.pow(exponent);
    let units = if up { units.ceil() } else { units.floor() };
    Some(decimal(&units.to_integer(), exponent))
}

/// The number as a decimal with at most this number of decimal places. Returns `None` unless this
/// decimal is exact.
///
/// ```
/// use affinor_tensors::{Rational, text::exact_decimal};
/// assert_eq!(exact_decimal(&Rational::new(-5, 4).unwrap(), 3).as_deref(), Some("-1.25"));
/// assert_eq!(exact_decimal(&Rational::new(1, 3).unwrap(), 3), None);
/// ```
pub fn exact_decimal(value: &Rational, decimals: u8) -> Option<String> {
    let ten = BigRational::from_integer(10.into());
    let units = BigRational::from(value) * ten.pow(decimals.into());
    units.is_integer().then(|| decimal(&units.to_integer(), -i32::from(decimals)))
}

/// The number `units * 10^exponent` as text, without trailing zeros.
fn decimal(units: &BigInt, exponent: i32) -> String {
    let text = units.to_string();
    let (sign, digits) = match text.strip_prefix('-') {
        Some(digits) => ("-", digits),
        None => ("", text.as_str()),
    };
    // writes very large and very small numbers with an exponent instead of zeros
    let places = match usize::try_from(-exponent) {
        Ok(places) if places <= digits.len() + 5 => places,
        _ if exponent == 0 => 0,
        _ => {
            let short = digits.trim_end_matches('0');
            let (first, rest) = short.split_at(short.len().min(1));
            let point = if rest.is_empty() { "" } else { "." };
            let exponent = exponent + digits.len() as i32 - 1;
            return format!("{sign}{first}{point}{rest}e{exponent}");
        }
    };
    let padded = format!("{digits:0>width$}", width = places + 1);
    let (whole, part) = padded.split_at(padded.len() - places);
    match part.trim_end_matches('0') {
        "" => format!("{sign}{whole}"),
        part => format!("{sign}{whole}.{part}"),
    }
}
