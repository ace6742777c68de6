//! The expression parser, over every scalar.

use crate::claims::fuzz::mutation::{mutants, sentences, texts};
use crate::common::property::properties;
use affinor_documents::Coefficient;
use affinor_tensors::expression::{Expression, ExpressionError, Scalars};
use affinor_tensors::{Rational, Symbolic};
use proptest::collection::vec;
use proptest::prelude::*;
use proptest::sample::select;

const WORDS: &[&str] = &[
    "0",
    "1",
    "2",
    "10",
    "9999",
    "1000000000000000000000",
    "0.5",
    ".",
    "1e3",
    "1e-9",
    "1e9999",
    "e",
    "e1",
    "sin(",
    "exp(x)",
    "x",
    "y",
    "_z",
    "i",
    "nan",
    "inf",
    "+",
    "-",
    "*",
    "/",
    "^",
    "^2",
    "^-3",
    "^300",
    "^10000",
    "(",
    ")",
    "((",
    "))",
    " ",
    "\t",
    "\n",
    ",",
    "[",
    "]",
    "=",
    "é",
    "Θ",
    "\u{2126}",
    "\u{445}",
    "\u{301}",
    "−",
    "·",
    "²",
    "⁻¹",
    "ⁿ",
    "₁",
    "**",
    "^(",
    "^x",
    "sin^2(",
    "sin^-1(",
    "coth(",
    "ln",
    "\u{202e}",
    "\u{0}",
];

const SEEDS: &[&str] = &[
    "(a^2 - b)/(4*c)",
    "1/2*x + 3 y - 0.25",
    "(x + y)^30/(x - y)^20",
    "1/(x + 1) + 1/(x + 2) + 1/(y + 3)",
    "((((1))))",
    "cos(theta)/sin(theta) - exp(2*x - y)*cosh(y)",
    "r^2*sin(2*theta + phi)^2/(1 + cos(phi))",
    "2^-2 - 1e-3",
    "x**2*y^(2/3)^(1/2) − sec²(Θ)·ω_1",
    "2M/r + sin theta - r theta",
    "999999999999999999999999999999^99",
];

fn evaluate(text: &str) -> Vec<Result<(), ExpressionError>> {
    fn over<S: Coefficient>(text: &str) -> Result<(), ExpressionError> {
        let name = |name: &str| S::parameter(name).or_else(|| S::from_quotient(1, 3));
        let names = |text: &str| name(text).ok_or("no value".to_string());
        let meaning = Scalars(names, S::call);
        let value = Expression::parse(text)?.evaluate(&meaning)?;
        // a value is printed and read back as the same value
        let again = Expression::parse(&value.to_string())?.evaluate(&meaning)?;
        assert!(S::KIND == affinor_tensors::Kind::Float || again == value, "{value}");
        Ok(())
    }
    vec![over::<Symbolic>(text), over::<Rational>(text), over::<f64>(text)]
}

fn check(text: String) {
    for outcome in evaluate(&text) {
        if let Err(ExpressionError { span, reason }) = outcome {
            assert!(!reason.is_empty());
            assert!(text.get(span.clone()).is_some() || text.len() < span.end, "{span:?}");
        }
    }
    drop(Expression::parse_beside(&text, &|name| name == "e1"));
}

/// Sums, products, quotients and powers that are well formed, but may be much too large.
fn formulas() -> impl Strategy<Value = String> {
    let leaf = prop_oneof![
        4 => select(&["a", "b", "c", "d"][..]).prop_map(String::from),
        2 => (0..20u32).prop_map(|n| n.to_string()),
        1 => (1..400u32).prop_map(|n| format!("{n}/7")),
        2 => (select(&["sin", "cos", "tan", "exp", "tanh"][..]), -3..9i32)
            .prop_map(|(name, n)| format!("{name}({n}*a - b)")),
    ];
    leaf.prop_recursive(6, 60, 4, |inner| {
        prop_oneof![
            3 => vec(inner.clone(), 2..5).prop_map(|terms| format!("({})", terms.join(" + "))),
            1 => (inner.clone(), inner.clone()).prop_map(|(a, b)| format!("({a} - {b})")),
            2 => (inner.clone(), inner.clone()).prop_map(|(a, b)| format!("{a}*{b}")),
            2 => (inner.clone(), inner.clone()).prop_map(|(a, b)| format!("({a})/({b})")),
            2 => (inner, -9..40i32).prop_map(|(a, n)| format!("({a})^{n}")),
        ]
    })
}

properties! {
    #![cases(256)]

    #[test]
    fn formulas_of_any_size(text in formulas()) {
        check(text);
    }

    #[test]
    fn any_text(text in texts()) {
        check(text);
    }

    #[test]
    fn words_of_the_grammar(text in sentences(WORDS, 24)) {
        check(text);
    }

    #[test]
    fn nearly_right(text in mutants(SEEDS, WORDS)) {
        check(text);
    }
}
