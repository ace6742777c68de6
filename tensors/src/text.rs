//! Values and linear combinations as text.

mod decimal;

pub use decimal::{exact_decimal, rounded};

use std::fmt::Display;

/// Writes a linear combination from its coefficients and labels, such as `a + 2*b - (p + q)*c`.
///
/// A coefficient that is a sum is enclosed in parentheses. A combination without terms is written
/// `0`.
///
/// ```
/// use affinor_tensors::text::combination;
/// let terms = [("1", "a"), ("-2", "b"), ("p + q", "c")];
/// let terms = terms.map(|(coefficient, label)| (coefficient, label.to_string()));
/// assert_eq!(combination(terms), "a - 2*b + (p + q)*c");
/// ```
pub fn combination<S: Display>(terms: impl IntoIterator<Item = (S, String)>) -> String {
    let mut text = String::new();
    for (coefficient, label) in terms {
        add_term(&mut text, coefficient.to_string(), &label);
    }
    if text.is_empty() { "0".into() } else { text }
}

/// Appends a term to the text of a linear combination.
fn add_term(text: &mut String, coefficient: String, label: &str) {
    let value = short(coefficient);
    let compound = is_sum(&value);
    let (sign, size) = match value.strip_prefix('-') {
        Some(size) if !compound => (" - ", size.to_string()),
        _ if compound => (" + ", format!("({value})")),
        _ => (" + ", value),
    };
    text.push_str(match (text.is_empty(), sign) {
        (true, " - ") => "-",
        (true, _) => "",
        (false, sign) => sign,
    });
    match size.as_str() {
        "1" => text.push_str(label),
        size => text.push_str(&format!("{size}*{label}")),
    }
}

/// Whether the text of a value is a sum of several terms.
pub fn is_sum(value: &str) -> bool {
    let mut depth = 0i64;
    value.char_indices().any(|(at, c)| {
        depth += i64::from(c == '(') - i64::from(c == ')');
        at > 0 && depth == 0 && matches!(c, ' ' | '+')
    })
}

/// The plain text of a value. A very large or very small float is written with an exponent instead
/// of zeros.
pub fn written(value: &impl Display) -> String {
    short(value.to_string())
}

fn short(text: String) -> String {
    // changes only numbers with a decimal point, because only floats contain a decimal point
    match text.parse::<f64>() {
        Ok(x) if text.contains('.') && x != 0.0 && x.abs() < 1e-5 => format!("{x:e}"),
        _ => text,
    }
}
