//! Sines, cosines and exponentials of parameters: exact values, derivatives, printing and parsing.

use crate::common::property::properties;
use affinor_tensors::expression::{Expression, Scalars};
use affinor_tensors::{Field, Notation, Ring, Symbolic};
use proptest::prelude::*;

fn read(text: &str) -> Result<Symbolic, String> {
    let function = <Symbolic as Notation>::call;
    let meaning = Scalars(|name: &str| Ok(Symbolic::parameter(name)), function);
    let expression = Expression::parse(text).map_err(|error| error.reason)?;
    expression.evaluate(&meaning).map_err(|error| error.reason)
}

fn value(text: &str) -> Symbolic {
    read(text).unwrap_or_else(|reason| panic!("{text}: {reason}"))
}

/// M. Abramowitz, I. A. Stegun, *Handbook of Mathematical Functions* (1964), 4.2, 4.3 and 4.5.
#[test]
fn identities_hold_exactly() {
    for (left, right) in [
        ("sin(x)^2 + cos(x)^2", "1"),
        ("sin(x + y)", "sin(x)*cos(y) + cos(x)*sin(y)"),
        ("cos(x - y)", "cos(x)*cos(y) + sin(x)*sin(y)"),
        ("tan(x + y)", "(tan(x) + tan(y))/(1 - tan(x)*tan(y))"),
        ("sin(-x)", "-sin(x)"),
        ("cos(3*x)", "4*cos(x)^3 - 3*cos(x)"),
        ("sin(5*x)", "16*sin(x)^5 - 20*sin(x)^3 + 5*sin(x)"),
        ("cot(x)", "cos(x)/sin(x)"),
        ("tan(2*x)", "2*tan(x)/(1 - tan(x)^2)"),
        ("1/(1 - cos(x)) + 1/(1 + cos(x))", "2/sin(x)^2"),
        ("exp(x + 2*y - x)", "exp(y)^2"),
        ("sin(a*x + y)", "sin(a*x)*cos(y) + cos(a*x)*sin(y)"),
        ("cos((a + b)*x)", "cos(a*x)*cos(b*x) - sin(a*x)*sin(b*x)"),
        ("sin(2*x*a)^2 + cos(2*a*x)^2", "1"),
        ("exp((x + y)^2)", "exp(x^2)*exp(x*y)^2*exp(y^2)"),
        ("cosh(x)^2 - sinh(x)^2", "1"),
        ("tanh(2*x)", "2*tanh(x)/(1 + tanh(x)^2)"),
        ("sin(0*x) + cos(0) + exp(x - x)", "2"),
        ("2*sin(x/2)*cos(x/2)", "sin(x)"),
        ("2*sin(x/2)^2", "1 - cos(x)"),
        ("tan(x/2)", "sin(x)/(1 + cos(x))"),
        ("sin(x/2 + y/2)", "sin(x/2)*cos(y/2) + cos(x/2)*sin(y/2)"),
        ("sin(x/2 + x/3)", "sin(x/2)*cos(x/3) + cos(x/2)*sin(x/3)"),
        ("4*cos(a*x/3)^3 - 3*cos(a*x/3)", "cos(a*x)"),
        ("sin(x/6)^2 + cos(x/6)^2 + sin(x/4)^2 + cos(x/4)^2", "2"),
        ("exp(x/2)^2*exp(x/3)^3", "exp(2*x)"),
        ("2*cosh(x/2)^2", "1 + cosh(x)"),
        ("sinh(x/2)*cosh(x/2)*sin(x/2)*cos(x/2)", "sinh(x)*sin(x)/4"),
    ] {
        assert_eq!(value(left), value(right), "{left}");
    }
    assert_ne!(value("sin(x)"), value("sin(y)"));
    assert_ne!(value("exp(x)"), value("x"));
    assert_ne!(value("sin(a*x)"), value("sin(x)"));
    assert_ne!(value("exp(x^2)"), value("exp(x)^2"));
    assert_ne!(value("sin(x/2)"), value("sin(x)/2"));
    assert_ne!(value("sin(x/2)"), value("sin(x/3)"));
}

#[test]
fn derivatives_follow_the_chain_rule() {
    for (function, derivative) in [
        ("sin(x)", "cos(x)"),
        ("cos(x)", "-sin(x)"),
        ("tan(x)", "1 + tan(x)^2"),
        ("cot(x)", "-1/sin(x)^2"),
        ("exp(3*x)", "3*exp(3*x)"),
        ("sinh(x)", "cosh(x)"),
        ("tanh(x)", "1/cosh(x)^2"),
        ("x*sin(2*x - y)", "sin(2*x - y) + 2*x*cos(2*x - y)"),
        ("sin(y)*exp(y)", "0"),
        ("sin(a*x)", "a*cos(a*x)"),
        ("exp(-x^2)", "-2*x*exp(-x^2)"),
        ("sin(x/2)", "cos(x/2)/2"),
        ("exp(-a*x/3)", "-a/3*exp(-a*x/3)"),
        ("x*tan(x^2*y - b*y)", "tan(x^2*y - b*y) + 2*x^2*y*(1 + tan(x^2*y - b*y)^2)"),
    ] {
        assert_eq!(value(function).derivative("x"), value(derivative), "{function}");
    }
}

#[test]
fn values_are_written_as_a_person_would() {
    for (input, text, latex) in [
        ("tan(x)", "sin(x)/cos(x)", r"\frac{\sin x}{\cos x}"),
        ("cot(theta)", "cos(theta)/sin(theta)", r"\frac{\cos \theta}{\sin \theta}"),
        ("1 - cos(x)^2", "sin(x)^2", r"\sin^{2} x"),
        ("-sin(x)*cos(x)", "-sin(x)*cos(x)", r"-\sin x \cos x"),
        ("r^2*sin(x)^2", "r^2*sin(x)^2", r"r^{2} \sin^{2} x"),
        ("1/sin(x)^2 - 1", "cos(x)^2/sin(x)^2", r"\frac{\cos^{2} x}{\sin^{2} x}"),
        ("1/(1 + sin(x))", "1/(sin(x) + 1)", r"\frac{1}{\sin x + 1}"),
        ("(1 - cos(x))/sin(x)", "sin(x)/(cos(x) + 1)", r"\frac{\sin x}{\cos x + 1}"),
        ("cos(x)*sin(y)/sin(x)", "cos(x)*sin(y)/sin(x)", r"\frac{\cos x \sin y}{\sin x}"),
        ("1/2*sin(x)", "1/2*sin(x)", r"\frac{1}{2} \sin x"),
        ("exp(2*x - y)", "exp(2*x)/exp(y)", r"\frac{e^{2 x}}{e^{y}}"),
        ("x*exp(x)", "x*exp(x)", "x e^{x}"),
        ("exp(2*a*x^2)", "exp(2*a*x^2)", "e^{2 a x^{2}}"),
        ("sin(J2*x)^2", "sin(J2*x)^2", r"\sin^{2}(J_{2} x)"),
        ("a^2 + r^2*sin(x)^2", "r^2*sin(x)^2 + a^2", r"r^{2} \sin^{2} x + a^{2}"),
        ("a*sin(x)^2 + b*cos(x)^2", "a*sin(x)^2 + b*cos(x)^2", r"a \sin^{2} x + b \cos^{2} x"),
        ("1/(y + sin(x)^4)", "1/(sin(x)^4 + y)", r"\frac{1}{\sin^{4} x + y}"),
        (
            "1/(1 - sin(x)^2*cos(y)^2)",
            "1/(cos(x)^2*cos(y)^2 + sin(y)^2)",
            r"\frac{1}{\cos^{2} x \cos^{2} y + \sin^{2} y}",
        ),
        ("cos(x)^2 - sin(x)^2", "2*cos(x)^2 - 1", r"2 \cos^{2} x - 1"),
        ("sin(x/2)^3", "sin(x/2)^3", r"\sin^{3}(\frac{x}{2})"),
        ("sin(x/2)*sin(x)", "2*sin(x/2)^2*cos(x/2)", r"2 \sin^{2}(\frac{x}{2}) \cos(\frac{x}{2})"),
        ("exp(3*x/2)", "exp(3*x/2)", r"e^{\frac{3 x}{2}}"),
        (
            "exp(x/4)^2 + exp(a*x/4)",
            "exp(a*x/4) + exp(x/2)",
            r"e^{\frac{a x}{4}} + e^{\frac{x}{2}}",
        ),
    ] {
        let value = value(input);
        assert_eq!(value.to_string(), text, "{input}");
        assert_eq!(Notation::latex(&value), latex, "{input}");
        assert_eq!(Notation::is_negative(&value), text.starts_with('-'), "{input}");
    }
    assert_eq!(value("M*sin(x)*exp(t)").parameters(), ["M", "t", "x"]);
    assert_eq!(value("sin(a*x)*exp(b^2*x)*x").parameters(), ["a", "b", "x"]);
}

#[test]
fn what_has_no_exact_value_is_refused() {
    for (text, reason) in [
        ("atan(x + 1)", "`atan` is not a function here: there are sin, cos, tan"),
        ("exp(tan(x))", "divides by a function of an angle"),
        ("sin(65*x)", "add up to more than 64"),
        ("exp(1000000*x)", "an integer factor greater than 10000"),
        ("exp(9223372036854775807*x)", "an integer factor greater than 10000"),
        ("exp(99999999999999999999*x)", "numbers that are too large"),
        ("exp(x/99999999999)", "numbers that are too large"),
        ("cot(0)", "division by zero"),
        ("sin(a+b+c+d+e+f+g+h+i+j+k+l+m+n+o+p)", "grows beyond the limit"),
        ("1/(sin(x)^2 + cos(x)^2 - 1)", "division by zero"),
        ("sin()", "`)` is not expected here"),
        ("sin(x", "this parenthesis is not closed"),
        ("sin x", "parentheses are missing: write `sin(x)`"),
        ("2(x)", "`*` is missing: write `2*(x)`"),
    ] {
        let found = read(text).expect_err(text);
        assert!(found.contains(reason), "{text}: {found}");
    }
}

/// Substitution applies to arguments: of a quotient of functions, and of the value itself.
#[test]
fn substitution_reaches_arguments() {
    let set = |pairs: &[(&str, &str)]| -> std::collections::BTreeMap<String, Symbolic> {
        pairs.iter().map(|(name, text)| (name.to_string(), value(text))).collect()
    };
    for (text, pairs, image) in [
        ("a + sin(a*x)", &[("a", "2")][..], "2 + sin(2*x)"),
        ("sin(x)/exp(a*x)", &[("a", "-3")], "sin(x)*exp(3*x)"),
        ("cos(a*x)", &[("a", "0")], "1"),
        ("cos(a*x)", &[("a", "b - 1")], "cos(b*x - x)"),
        ("exp(x^2)*y", &[("x", "y"), ("y", "x")], "exp(y^2)*x"),
        ("tan(x)", &[("x", "x + y")], "tan(x + y)"),
        ("sin(a*x)", &[("a", "1/2")], "sin(x/2)"),
        ("sin(a*x)^2/a", &[("a", "3/4")], "4*sin(3*x/4)^2/3"),
        ("tan(a*x + y)", &[("a", "5/12")], "tan(5*x/12 + y)"),
        ("cos(a*x/3)", &[("a", "-1/4")], "cos(x/12)"),
        ("sin(x/2)*exp(x/3)", &[("x", "6*y")], "sin(3*y)*exp(2*y)"),
        ("sin(a*x)", &[("a", "1/17")], "sin(x/17)"),
        ("sin(x)", &[("x", "1")], "sin(1)"),
        ("exp(a*x)", &[("a", "sin(x)")], "exp(x*sin(x))"),
    ] {
        assert_eq!(value(text).substitute(&set(pairs)), Some(value(image)), "{text}");
    }
    for (text, pairs) in [("exp(a*x)", ("a", "sin(x)/cos(x)")), ("1/sin(a*x)", ("a", "0"))] {
        assert_eq!(value(text).substitute(&set(&[pairs])), None, "{text}");
    }
}

/// A random expression, and its value at a point by the functions of f64.
fn expressions() -> impl Strategy<Value = (String, f64)> {
    let x = |name: &str| if name == "x" { 0.7 } else { -1.3 };
    let leaf = prop_oneof![
        prop::sample::select(vec!["x", "y"]).prop_map(move |v| (v.to_string(), x(v))),
        (-3i32..4).prop_map(|n| (format!("({n})"), f64::from(n))),
        (prop::sample::select(vec!["sin", "cos", "exp", "tan"]), -2i32..3, -2i32..3, 0..4)
            .prop_map(|(name, m, n, argument)| {
                // sums of three products would be long
                let (text, at) = match argument {
                    0 => (format!("{m}*x + {n}*y"), f64::from(m) * 0.7 - f64::from(n) * 1.3),
                    1 => (format!("{m}*x*y"), -f64::from(m) * 0.91),
                    2 => (format!("{m}*x/2"), f64::from(m) * 0.35),
                    _ => (format!("{m}*x/3"), f64::from(m) * 0.7 / 3.0),
                };
                let value = match name {
                    "sin" => at.sin(),
                    "cos" => at.cos(),
                    "exp" => at.exp(),
                    _ => at.tan(),
                };
                (format!("{name}({text})"), value)
            }),
    ];
    leaf.prop_recursive(2, 6, 2, |inner| {
        (inner.clone(), inner, prop::sample::select(vec!['+', '*', '-'])).prop_map(
            |((a, u), (b, v), op)| {
                let value = match op {
                    '+' => u + v,
                    '-' => u - v,
                    _ => u * v,
                };
                (format!("({a} {op} {b})"), value)
            },
        )
    })
}

properties! {
    #![cases(64)]

    #[test]
    fn what_is_written_reads_back((text, at) in expressions(), (other, _) in expressions()) {
        let f = value(&text);
        prop_assert_eq!(&value(&f.to_string()), &f);
        prop_assert_eq!((-f.clone()).vanishes() || f.is_negative() != (-f.clone()).is_negative(), true);
        // compared with the functions of f64
        let found = f.evaluate(|name| Some(if name == "x" { 0.7 } else { -1.3 })).unwrap();
        prop_assert!((found - at).abs() <= 1e-6 * (1.0 + at.abs()), "{} {}", found, at);
        if let Some(inverse) = f.recip() {
            prop_assert_eq!(&value(&inverse.to_string()), &inverse);
        }
        // Leibniz
        let g = value(&other);
        let product = (f.clone() * &g).derivative("x");
        prop_assert_eq!(product, f.derivative("x") * &g + &(f * &g.derivative("x")));
    }
}
