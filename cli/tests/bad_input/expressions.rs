//! Expressions that are meaningless, or too large.

use crate::bad_input::case::definitions;

/// The column of an expression in a file of the plane `e1, e2` with the parameters `x, y`.
const COLUMN: usize = 27;

fn refuse_expressions(table: &[(&str, usize, &[&str])]) {
    let content = |expression: &str| {
        format!("dimension = 2\nparameters = ['x', 'y']\nbrackets = '[e1, e2] = e1*{expression}'")
    };
    for &(expression, offset, says) in table {
        let place = format!("a.toml:3:{}", COLUMN + offset);
        let says: Vec<&str> = says.iter().copied().chain([place.as_str()]).collect();
        definitions("a.toml", content).usage(&[(expression, &says)]);
    }
}

#[test]
fn the_grammar_is_kept() {
    refuse_expressions(&[
        ("", 0, &["the expression ends where a value is expected"]),
        ("(1 + 2", 0, &["this parenthesis is not closed"]),
        ("(1 2)", 3, &["`2` is not expected here"]),
        ("1 +", 3, &["the expression ends where a value is expected"]),
        ("1 2", 2, &["`2` is not expected here"]),
        ("2x", 1, &["`*` is missing: write `e1*2*x`"]),
        ("x y", 2, &["`*` is missing: write `e1*x*y`"]),
        ("x 2", 2, &["`*` is missing: write `e1*x*2`"]),
        ("2(x)", 1, &["`*` is missing: write `e1*2*(x)`"]),
        (
            "2e1",
            0,
            &["write `*` or a space between the number and `e1`, or `e+1` for a power of ten"],
        ),
        ("1.2.3", 3, &["`.` is not expected here"]),
        ("1,2", 1, &["`,` is not expected here"]),
        (".", 0, &["a number needs a digit"]),
        ("x^y", 2, &["an exponent must be an integer"]),
        ("x^1/2*q", 6, &["`q` is neither"]),
        ("x^0.5", 2, &["an exponent must be an integer"]),
        ("x^(1/2)", 2, &["an exponent must be an integer"]),
        ("x^(2 x)", 2, &["an exponent must be an integer"]),
        ("9^9^9", 2, &["an exponent must be at most 10000"]),
        ("x***2", 3, &["`*` is not expected here"]),
        ("sqrt(-2)", 0, &["the argument of sqrt is negative: -2"]),
        ("sqrt(-1)", 0, &["the argument of sqrt is negative: -1"]),
        ("log(2)", 0, &["`log` is not a function here"]),
        ("2 e1(1)", 2, &["`e1` is not a function here"]),
        ("0x10", 1, &["`*` is missing: write `e1*0*x10`"]),
        ("1_000", 1, &["`*` is missing: write `e1*1*_000`"]),
        ("x=1", 1, &["`=` is not expected here"]),
        ("½", 0, &["`½` is not expected here"]),
        ("２", 0, &["`２` is not expected here"]),
    ]);
}

#[test]
fn values_exist() {
    refuse_expressions(&[
        ("1/0", 2, &["division by zero"]),
        ("0/0", 2, &["division by zero"]),
        ("0^-1", 0, &["division by zero"]),
        ("1/(1/2 - 0.5)", 2, &["division by zero"]),
        ("1/(x - x)", 2, &["division by zero"]),
        ("y/((x + y)^2 - x^2 - 2*x*y - y^2)", 2, &["division by zero"]),
        ("nan", 0, &["`nan` is not a number"]),
        ("NaN", 0, &["`NaN` is not a number"]),
        ("2*inf", 2, &["`inf` is not a number"]),
        ("1 - Infinity", 4, &["`Infinity` is not a number"]),
    ]);
}

#[test]
fn values_have_a_limit() {
    refuse_expressions(&[
        ("x^99999", 2, &["an exponent must be at most 10000"]),
        ("x^99999999999999999999", 2, &["an exponent must be at most 10000"]),
        ("x^-99999", 3, &["an exponent must be at most 10000"]),
        ("1e99999", 1, &["an exponent must be at most 10000"]),
        ("1e-99999", 1, &["an exponent must be at most 10000"]),
        ("1e9999999999999999999999", 1, &["an exponent must be at most 10000"]),
        ("(9^9999)^9999", 0, &["grows beyond the limit"]),
        ("(x + y)^9999", 0, &["grows beyond the limit"]),
        ("1/(x + y)^9999", 2, &["grows beyond the limit"]),
        ("((x + y)^90 + 1)^90", 1, &["grows beyond the limit"]),
    ]);
}

#[test]
fn sums_of_fractions_have_a_limit() {
    // each sum is small, and their common denominator has 2^18 terms
    let sum = |from: usize| {
        (from..from + 9).map(|i| format!("1/(a{i} + b{i})")).collect::<Vec<_>>().join(" + ")
    };
    let names: Vec<String> = (0..18).map(|i| format!("'a{i}', 'b{i}'")).collect();
    let content = format!(
        "dimension = 2\nparameters = [{}]\nbrackets = '[e1, e2] = (({}) + ({}))*e1'",
        names.join(", "),
        sum(0),
        sum(9)
    );
    let says = &["a.toml:3:", "grows beyond the limit"];
    definitions("a.toml", str::to_string).usage(&[(&content, says)]);
}
