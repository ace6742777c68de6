//! Square roots and logarithms: exact, with the signs of their arguments.

use crate::common::property::properties;
use affinor_tensors::scalar::{PositiveFactors, laws};
use affinor_tensors::{Field, Symbolic, Tolerance};
use proptest::prelude::*;
use std::collections::BTreeMap;

fn value(text: &str) -> Symbolic {
    text.parse().unwrap_or_else(|error| panic!("{text}: {error}"))
}

fn positive(functions: &[&str]) -> PositiveFactors {
    let mut positive = PositiveFactors::default();
    functions.iter().for_each(|text| positive.declare(&value(text)).unwrap());
    positive
}

/// M. Abramowitz, I. A. Stegun, *Handbook of Mathematical Functions* (1964), 3.1 and 4.1.
#[test]
fn identities_hold_exactly() {
    for (left, right) in [
        ("sqrt(x)^2", "x"),
        ("sqrt(12)", "2*sqrt(3)"),
        ("sqrt(6)", "sqrt(2)*sqrt(3)"),
        ("sqrt(8/9)", "2*sqrt(2)/3"),
        ("sqrt(0) + log(1)", "0"),
        ("sqrt(4*x)", "2*sqrt(x)"),
        ("sqrt(x^3)", "x*sqrt(x)"),
        ("sqrt(1/x)", "sqrt(x)/x"),
        ("sqrt(2)*sqrt(x)*sqrt(2*x)", "2*x"),
        ("1/(sqrt(x) - 1)", "(sqrt(x) + 1)/(x - 1)"),
        ("(sqrt(x) + sqrt(y) + 1)/(sqrt(x) + sqrt(y) + 1)", "1"),
        ("1/(1 + sqrt(2) + sqrt(3))", "1/2 + sqrt(2)/4 - sqrt(2)*sqrt(3)/4"),
        ("sqrt(x^2 + y^2)^4", "(x^2 + y^2)^2"),
        ("log(8/9)", "3*log(2) - 2*log(3)"),
        ("log(2*x)", "log(2) + log(x)"),
        ("log(1/x)", "-log(x)"),
        ("log(x^3*8)", "3*log(x) + 3*log(2)"),
    ] {
        assert_eq!(value(left), value(right), "{left}");
    }
    for text in
        ["sqrt(x) - sqrt(y)", "sqrt(x) - x", "log(x) - sqrt(x)", "sqrt(1 - x) - sqrt(x - 1)"]
    {
        assert_ne!(value(text), value("0"), "{text}");
    }
}

/// Factors are taken out of roots with the declared or deduced sign.
#[test]
fn signs_of_factors_are_those_declared() {
    for (declared, root) in [
        (&["x", "y"][..], "x*sqrt(y)"),
        (&["-x", "y"], "-x*sqrt(y)"),
        (&["y", "x*y"], "x*sqrt(y)"),
        (&["-x"], "-x*sqrt(y)"),
    ] {
        let found = positive(declared).function("sqrt", &value("x^2*y")).unwrap();
        assert_eq!(found, value(root), "{declared:?}");
    }
    // outside and inside of the horizon
    for (declared, argument, root) in [
        (["r", "1 - 2*M/r"], "1 - 2*M/r", "sqrt(r - 2*M)/sqrt(r)"),
        (["r", "2*M - r"], "2*M/r - 1", "sqrt(2*M - r)/sqrt(r)"),
    ] {
        assert_eq!(positive(&declared).function("sqrt", &value(argument)), Ok(value(root)));
    }
    let positive = positive(&["x - 1", "x - 2"]);
    let found = positive.function("log", &value("(x^2 - 3*x + 2)^2")).unwrap();
    assert_eq!(found, value("2*log(x - 1) + 2*log(x - 2)"));
}

#[test]
fn what_has_no_sign_is_refused() {
    for (text, reason) in [
        ("sqrt(x*y)", "the argument of sqrt has factors of unknown sign"),
        ("sqrt(x^2)", "declare the positive ones among x"),
        ("log(x^2)", "declare the positive ones among x"),
        ("sqrt(-1)", "the argument of sqrt is negative: -1"),
        ("log(0)", "the argument of log is zero"),
        ("log(-2)", "the argument of log is negative"),
        ("sqrt(sin(x))", "contains a function"),
        ("sqrt(18446744073709551616*x)", "is too large"),
        ("sqrt(1000000016000000063)", "is too large"),
    ] {
        let found = text.parse::<Symbolic>().expect_err(text).reason;
        assert!(found.contains(reason), "{text}: {found}");
    }
    let known = positive(&["x"]);
    let found = known.function("sqrt", &value("-4*x")).unwrap_err();
    assert_eq!(found, "the argument of sqrt is negative: -4*x, by the functions declared positive");
    let mut contradicted = known.clone();
    assert!(contradicted.declare(&value("-x^3")).unwrap_err().contains("is negative"));
    assert!(contradicted.declare(&value("y*z")).unwrap_err().contains("among y, z"));
    assert!(contradicted.declare(&value("0")).unwrap_err().contains("is zero"));
}

#[test]
fn they_are_written_and_differentiated() {
    for (input, text, latex, rate) in [
        ("sqrt(x)", "sqrt(x)", r"\sqrt{x}", "1/(2*sqrt(x))"),
        ("y/sqrt(x)", "y/sqrt(x)", r"\frac{y}{\sqrt{x}}", "-y/(2*x*sqrt(x))"),
        ("sqrt(x^2 + y^2)", "sqrt(x^2 + y^2)", r"\sqrt{x^{2} + y^{2}}", "x/sqrt(x^2 + y^2)"),
        ("log(x)/x", "log(x)/x", r"\frac{\log x}{x}", "(1 - log(x))/x^2"),
        ("log(x + a)^2", "log(a + x)^2", r"\log^{2}(a + x)", "2*log(x + a)/(x + a)"),
        ("sqrt(2)*sqrt(3)", "sqrt(2)*sqrt(3)", r"\sqrt{2} \sqrt{3}", "0"),
    ] {
        let value = value(input);
        assert_eq!(value.to_string(), text, "{input}");
        assert_eq!(value.to_latex(), latex, "{input}");
        assert_eq!(value.derivative("x"), self::value(rate), "{input}");
    }
    assert_eq!(value("sqrt(a*x + b)*log(y) + sqrt(2)").parameters(), ["a", "b", "x", "y"]);
}

/// The value of a root remains positive if its argument is substituted.
#[test]
fn substitution_reaches_arguments() {
    let set = |name: &str, text: &str| BTreeMap::from([(name.to_string(), value(text))]);
    for (text, (name, by), image) in [
        ("sqrt(x)", ("x", "4"), Some("2")),
        ("sqrt(x - 2*M)", ("M", "x/2 - y"), Some("sqrt(2*y)")),
        ("1/sqrt(x)", ("x", "y^3"), Some("1/(y*sqrt(y))")),
        ("log(x)", ("x", "12"), Some("2*log(2) + log(3)")),
        ("sqrt(x)", ("x", "-1"), None),
        ("sqrt(x)", ("x", "y^2"), None),
        ("log(x)", ("x", "0"), None),
        ("1/sqrt(x)", ("x", "0"), None),
    ] {
        assert_eq!(value(text).substitute(&set(name, by)), image.map(value), "{text}");
    }
    let found = value("sqrt(x)*log(x + 1)").evaluate(|_| Some(2.5)).unwrap();
    assert!((found - 2.5f64.sqrt() * 3.5f64.ln()).abs() < 1e-15);
    assert_eq!(value("sqrt(x)").evaluate(|_| Some(-1.0)), None);
}

/// A random expression, and its value at `x = 0.7`, `y = 2.3`.
fn expressions() -> impl Strategy<Value = (String, f64)> {
    let leaves = [
        ("x", 0.7),
        ("y", 2.3),
        ("sqrt(x)", 0.7f64.sqrt()),
        ("sqrt(x + y)", 3.0f64.sqrt()),
        ("sqrt(2*y)", 4.6f64.sqrt()),
        ("sqrt(2)", 2f64.sqrt()),
        ("log(x)", 0.7f64.ln()),
        ("log(2*x + 2*y)", 6.0f64.ln()),
        ("sin(x/2)", 0.35f64.sin()),
        ("3/2", 1.5),
    ];
    let leaf = prop::sample::select(leaves.to_vec()).prop_map(|(text, at)| (text.to_string(), at));
    leaf.prop_recursive(3, 8, 2, |inner| {
        let operator = prop::sample::select(vec!['+', '*', '-', '/']);
        (inner.clone(), inner, operator).prop_map(|((a, u), (b, v), operator)| match operator {
            '+' => (format!("({a} + {b})"), u + v),
            '*' => (format!("({a} * {b})"), u * v),
            '-' => (format!("({a} - {b})"), u - v),
            _ => (format!("({a} / ({b} + 5))"), u / (v + 5.0)),
        })
    })
}

properties! {
    #![cases(64)]

    #[test]
    fn values_are_a_differential_field((text, at) in expressions(), (other, _) in expressions()) {
        let (f, g) = (value(&text), value(&other));
        prop_assert_eq!(&value(&f.to_string()), &f);
        let found = f.evaluate(|name| Some(if name == "x" { 0.7 } else { 2.3 })).unwrap();
        prop_assert!((found - at).abs() <= 1e-6 * (1.0 + at.abs()), "{} {}", found, at);
        let third = value("sqrt(x) + sqrt(2)");
        prop_assert_eq!(laws::field(&f, &g, &third, Tolerance::default()), Ok(()));
        let product = (f.clone() * &g).derivative("x");
        prop_assert_eq!(product, f.derivative("x") * &g + &(f.clone() * &g.derivative("x")));
        if let Some(inverse) = f.recip() {
            prop_assert_eq!(&value(&inverse.to_string()), &inverse);
            prop_assert_eq!(inverse.derivative("y"), -(f.derivative("y") * &inverse * &inverse));
        }
    }

    /// `x -> u^2` makes every root of `x` a function of `u`; it commutes with the operations.
    #[test]
    fn substitution_commutes((a, _) in expressions(), (b, _) in expressions()) {
        let set = BTreeMap::from([("x".to_string(), value("3*z")), ("y".to_string(), value("5*z"))]);
        let image = |f: &Symbolic| f.substitute(&set);
        let (f, g) = (value(&a), value(&b));
        if let (Some(u), Some(v)) = (image(&f), image(&g)) {
            prop_assert_eq!(image(&(f.clone() * &g)), Some(u.clone() * &v));
            prop_assert_eq!(image(&(f + &g)), Some(u + &v));
        }
    }
}
