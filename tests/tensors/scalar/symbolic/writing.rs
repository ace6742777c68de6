//! Printed sums and common factors: never longer than the sum of terms, read back as the same
//! value, and with the sign of the value.

use crate::common::property::properties;
use affinor_tensors::scalar::Variable;
use affinor_tensors::{CommonFactors, Notation, Rational, Symbolic, Tabular};
use proptest::prelude::*;
use std::collections::BTreeMap;

fn value(text: &str) -> Symbolic {
    text.parse().unwrap()
}

/// The sum of the terms of a polynomial with integer coefficients, written one by one.
fn expanded(polynomial: &Symbolic) -> String {
    let mut text = String::new();
    for (powers, c) in polynomial.terms() {
        let size = if c.is_negative() { -c.clone() } else { c.clone() };
        text += match (text.is_empty(), c.is_negative()) {
            (true, false) => "",
            (true, true) => "-",
            (false, false) => " + ",
            (false, true) => " - ",
        };
        let number = Some(size.to_string()).filter(|n| n != "1" || powers.is_empty());
        let power = |(name, e): &(Variable, u32)| match e {
            1 => name.to_string(),
            e => format!("{name}^{e}"),
        };
        let factors: Vec<String> = number.into_iter().chain(powers.iter().map(power)).collect();
        text += &factors.join("*");
    }
    text
}

#[test]
fn common_factors_of_terms_are_taken_out() {
    for (terms, written) in [
        ("a*b*c + a*b*d + a*b*e + 7", "a*b*(c + d + e) + 7"),
        ("7*x^3*y + 14*x^2*y*z - 21*x*y + w", "7*x*y*(x^2 + 2*x*z - 3) + w"),
        // factoring does not make the text shorter
        ("a*b + a*c + d", "a*b + a*c + d"),
        ("a*b - c^2", "a*b - c^2"),
        ("x^2 + y^2 + 1", "x^2 + y^2 + 1"),
        // the sign is that of the leading term
        ("-alpha*beta - alpha*gamma - alpha*delta + w", "-alpha*(beta + delta + gamma) + w"),
    ] {
        assert_eq!(value(terms).to_string(), written);
        assert_eq!(value(written), value(terms));
    }
    let latex = value("alpha*beta + alpha*gamma + alpha*delta + 7").to_latex();
    assert_eq!(latex, "\\alpha \\left(\\beta + \\delta + \\gamma\\right) + 7");
}

#[test]
fn names_are_given_where_the_whole_gets_shorter() {
    let texts = |names: &[&str], below: &str| -> Vec<Symbolic> {
        names.iter().map(|name| value(&format!("{name}/({below})"))).collect()
    };
    let none: Vec<(&str, Symbolic)> = Vec::new();
    let found = |values: &[Symbolic], taken: &[&str]| {
        let taken: Vec<String> = taken.iter().map(|name| name.to_string()).collect();
        Symbolic::common_factors(&mut values.iter(), &taken)
    };
    let long = "alpha*gamma - beta^2";
    assert_eq!(found(&texts(&["a"], long), &[]).iter().collect::<Vec<_>>(), none);
    let short = texts(&["a", "b", "c", "d", "e", "f", "g", "h"], "x*z - y^2");
    assert_eq!(found(&short, &[]).iter().collect::<Vec<_>>(), none);
    let values = texts(&["a", "b", "c"], long);
    let names = |factors: &CommonFactors| -> Vec<String> {
        factors.iter().map(|(name, _)| name.to_string()).collect()
    };
    assert_eq!(names(&found(&values, &[])), ["D"]);
    assert_eq!(names(&found(&values, &["Delta", "a"])), ["D"]);
    assert_eq!(names(&found(&values, &["D"])), ["W"]);
    assert_eq!(names(&found(&values, &["D2", "W"])), ["Q"]);
    assert_eq!(names(&found(&values, &["D2", "W", "Q", "D_"])), [""; 0]);
    let two: Vec<Symbolic> =
        values.iter().map(|v| v.clone() / &value("(lambda*nu - rho^2)^2")).collect();
    let factors = found(&two, &[]);
    assert_eq!(names(&factors), ["D1", "D2"]);
    assert_eq!(two[0].text_with(&factors), "a/(D1*D2^2)");
    assert_eq!(two[0].latex_with(&factors), "\\frac{a}{D_{1} D_{2}^{2}}");
}

#[test]
fn a_factor_above_has_its_name_too() {
    let values = [
        "a/(alpha*gamma - beta^2)",
        "b/(alpha*gamma - beta^2)",
        "(a + 1)^2*(alpha*gamma - beta^2)",
    ]
    .map(value);
    let factors = Symbolic::common_factors(&mut values.iter().cycle().take(9), &[]);
    assert_eq!(values[2].text_with(&factors), "D*(a + 1)^2");
}

/// Polynomials in four names of different lengths.
fn polynomial() -> impl Strategy<Value = Symbolic> {
    let term = (-9i64..=9, prop::array::uniform4(0u32..=3));
    prop::collection::vec(term, 1..14).prop_map(|terms| {
        terms.into_iter().fold(value("0"), |sum, (c, powers)| {
            let names = ["a", "J11", "omega", "x2"].map(Symbolic::parameter).into_iter();
            let term =
                names.zip(powers).fold(Symbolic::constant(Rational::from(c)), |term, (name, e)| {
                    term * &num_traits::pow(name, e as usize)
                });
            sum + &term
        })
    })
}

properties! {
    #![cases(96)]

    #[test]
    fn sums_read_back_and_are_not_longer(p in polynomial(), q in polynomial()) {
        let text = p.to_string();
        prop_assert!(text.len() <= expanded(&p).len().max(1), "{}", text);
        prop_assert_eq!(value(&text), p.clone());
        prop_assert_eq!(text.starts_with('-'), p.is_negative(), "{}", text);
        if q != value("0") {
            let quotient = p / &q;
            prop_assert_eq!(value(&quotient.to_string()), quotient);
        }
    }

    /// Substituting the factors for the names gives the values back; the written forms of a value
    /// and its negative differ only by a sign.
    #[test]
    fn names_stand_for_their_factors(
        above in prop::collection::vec(polynomial(), 1..6),
        below in polynomial(),
    ) {
        prop_assume!(below != value("0"));
        let values: Vec<Symbolic> = above.into_iter().map(|p| p / &below).collect();
        let factors = Symbolic::common_factors(&mut values.iter(), &[]);
        let names: BTreeMap<String, Symbolic> =
            factors.iter().map(|(name, value)| (name.to_string(), value)).collect();
        let plain: usize = values.iter().map(|v| v.to_string().len()).sum();
        let named: usize = values.iter().map(|v| v.text_with(&factors).len()).sum();
        let lines: usize = names.iter().map(|(name, v)| name.len() + v.to_string().len() + 3).sum();
        prop_assert!(named + lines <= plain, "{} {} {}", named, lines, plain);
        for own in &values {
            let written = value(&own.text_with(&factors));
            prop_assert_eq!(written.substitute(&names), Some(own.clone()));
        }
    }
}
