//! Undetermined functions: derivatives, substitution, printing and parsing.

use crate::common::property::properties;
use affinor_tensors::scalar::{FreeFunction, PositiveFactors, laws};
use affinor_tensors::{Notation, Recorded, Symbolic, Tolerance, scalar::StraightLine};
use proptest::prelude::*;
use std::collections::BTreeMap;

fn value(text: &str) -> Symbolic {
    text.parse().unwrap_or_else(|error| panic!("{text}: {error}"))
}

fn given(values: &[(&str, &str)]) -> BTreeMap<String, Symbolic> {
    values.iter().map(|(name, text)| (name.to_string(), value(text))).collect()
}

#[test]
fn derivatives_have_names_in_which_the_order_does_not_matter() {
    let f = value("f(r, theta)");
    assert_eq!(f.derivative("theta").derivative("r"), value("f_r_theta(r,theta)"));
    assert_eq!(value("f_theta_r(r, theta)"), f.derivative("r").derivative("theta"));
    assert_eq!(value("r*a(t)").derivative("t").to_string(), "r*a_t(t)");
    assert_eq!(value("r*a(t)").derivative("r"), value("a(t)"));
    assert_eq!(value("1/a(t)").derivative("t"), value("-a_t(t)/a(t)^2"));
    assert_eq!(value("a(t)").derivative("a"), value("0"));
    assert_eq!(f.derivative("phi"), value("0"));
    assert_eq!(value("f(r,theta)*sin(theta)*m").parameters(), ["m", "r", "theta"]);
}

#[test]
fn names_that_are_no_function_are_refused() {
    for text in ["f(2)", "f_y(x)", "sin_x(x)", "_f(x)", "f_(x)", "f_3(x,y)", "f()"] {
        assert!(text.parse::<Symbolic>().is_err(), "{text}");
        assert!(FreeFunction::read(text).is_err(), "{text}");
    }
    for text in ["f(x + y)", "f(x, x)", "f(a_b)", "f(g(x))"] {
        assert!(FreeFunction::read(text).is_err(), "{text}");
        assert_eq!(value(text).to_string().replace(' ', ""), text.replace(' ', ""));
    }
    assert!(<Symbolic as Notation>::parameter("f_r(r,s)").is_none());
}

#[test]
fn roots_and_logarithms_of_free_functions() {
    let mut positive = PositiveFactors::default();
    positive.declare(&value("f(r)")).unwrap();
    let refused = positive.function("sqrt", &value("r*g(r)")).unwrap_err();
    assert!(refused.contains("among r, g(r)"), "{refused}");
    let root = positive.function("sqrt", &value("4*f(r)^3")).unwrap();
    assert_eq!(root, value("2*f(r)*sqrt(f(r))"));
    assert_eq!(root.derivative("r"), value("3*sqrt(f(r))*f_r(r)"));
    assert_eq!(value("log(f(r))").derivative("r"), value("f_r(r)/f(r)"));
    assert_eq!(value(&root.to_string()), root);
    assert_eq!(root.parameters(), ["r"]);
    let at = given(&[("f(r)", "x^2 + 1"), ("r", "x")]);
    assert_eq!(value("r*sqrt(f(r))").substitute(&at), Some(value("x*sqrt(x^2 + 1)")));
}

#[test]
fn substitution_reaches_functions_and_their_arguments() {
    let expansion = given(&[("a(t)", "exp(H*t)")]);
    assert_eq!(value("a_t(t)/a(t)").substitute(&expansion), Some(value("H")));
    assert_eq!(value("a_t_t(t)").substitute(&expansion), Some(value("H^2*exp(H*t)")));
    assert_eq!(value("f_x(x,y)").substitute(&given(&[("x", "u")])), Some(value("f_u(u,y)")));
    assert_eq!(
        value("f_x(x,y)").substitute(&given(&[("x", "y"), ("y", "x")])),
        Some(value("f_y(y,x)"))
    );
    assert_eq!(value("f_x(x,y)").substitute(&given(&[("x", "y")])), Some(value("f_1(y,y)")));
    assert_eq!(value("f(x)").substitute(&given(&[("x", "2*y")])), Some(value("f(2*y)")));
    assert_eq!(value("f(x)").substitute(&given(&[("x", "2")])), None);
    // by the chain rule, at any argument
    let square = given(&[("f(x)", "x^2")]);
    assert_eq!(value("f_1(r/t)").substitute(&square), Some(value("2*r/t")));
    assert_eq!(value("f(r/t)").derivative("t"), value("-r*f_1(r/t)/t^2"));
    // a function is evaluated at the new argument
    let both = given(&[("f(x)", "x^3"), ("x", "2")]);
    assert_eq!(value("f_x(x) + x").substitute(&both), Some(value("14")));
    assert_eq!(value("f_x(x)").evaluate(|name| (name == "f_x(x)").then_some(0.5)), Some(0.5));
}

#[test]
fn latex_has_indices_for_derivatives() {
    for (text, latex) in [
        ("a(t)^2", "a^{2}"),
        ("a_t_t(t)*r", "r a_{,t t}"),
        ("f1_theta(theta)^2", "f_{1,\\theta}^{2}"),
        ("rho(x)/2", "\\frac{1}{2} \\rho"),
        ("sqrt(f(r))", "\\sqrt{f}"),
    ] {
        assert_eq!(value(text).to_latex(), latex);
    }
}

/// Rational functions of `x`, `y`, `a`, two free functions and their derivatives.
fn values() -> impl Strategy<Value = Symbolic> {
    let names = ["x", "y", "a", "2", "f(x,y)", "f_x(x,y)", "f_x_y(x,y)", "g(y)", "g_y_y(y)"];
    let leaf = prop::sample::select(names.to_vec()).prop_map(value);
    leaf.prop_recursive(3, 10, 2, |inner| {
        (inner.clone(), 0..4, inner).prop_map(|(a, operation, b)| match operation {
            0 => a + &b,
            1 => a - &b,
            2 => a * &b,
            _ if b == Symbolic::default() => a,
            _ => a / &b,
        })
    })
}

/// Polynomials of `x`, `y` and `a` by their coefficients.
fn polynomials(names: &'static [&'static str]) -> impl Strategy<Value = Symbolic> {
    prop::collection::vec(-3i64..4, 6).prop_map(move |c| {
        let (x, y) = (names[0], names[names.len() - 1]);
        value(&format!(
            "{} + {}*{x} + {}*{x}^2 + {}*{x}*{y} + a*{}*{y}^3 + {}*{y}",
            c[0], c[1], c[2], c[3], c[4], c[5]
        ))
    })
}

properties! {
    #![cases(96)]

    #[test]
    fn fractions_of_free_functions_are_a_field(a in values(), b in values(), c in values()) {
        prop_assert_eq!(laws::field(&a, &b, &c, Tolerance::default()), Ok(()));
    }

    /// Replacing functions commutes with derivatives.
    #[test]
    fn replacing_functions_commutes_with_derivatives(
        v in values(), f in polynomials(&["x", "y"]), g in polynomials(&["y"]),
    ) {
        let given = BTreeMap::from([("f(x,y)".to_string(), f), ("g(y)".to_string(), g)]);
        if let Some(replaced) = v.substitute(&given) {
            for name in ["x", "y", "a"] {
                // the free functions do not depend on `a`, but their replacements may
                if name != "a" || !given.values().any(|f| f.parameters().contains(&"a".into())) {
                    prop_assert_eq!(v.derivative(name).substitute(&given), Some(replaced.derivative(name)));
                }
            }
        }
    }

    #[test]
    fn text_reads_back(v in values()) {
        prop_assert_eq!(value(&v.to_string()), v);
    }

    /// The program of a derivative computes the derivative.
    #[test]
    fn programs_of_derivatives(v in values(), f in polynomials(&["x", "y"]), g in polynomials(&["y"])) {
        let recorded = Recorded::try_from(&v).unwrap().derivative("y");
        let program = StraightLine::new(&[recorded]);
        let given = BTreeMap::from([("f(x,y)".to_string(), f), ("g(y)".to_string(), g)]);
        let at = BTreeMap::from([("x", "3/7"), ("y", "-5/3"), ("a", "2")].map(|(n, v)| (n.to_string(), value(v))));
        let number = |v: &Symbolic| v.substitute(&given)?.substitute(&at)?.as_constant().cloned();
        let input = |name: &str| number(&value(name)).unwrap();
        if let (Some(found), Some(expected)) = (program.evaluate(input, |_, x| x.clone()), number(&v.derivative("y"))) {
            prop_assert_eq!(&found[0], &expected);
        }
    }
}
