//! Derivatives of formulas with kinks and discontinuities: exact at smooth points, the mean of both
//! sides at a kink.

use crate::common::property::properties;
use affinor::mechanics::formula::{Formula, Symbol, Workspace};
use proptest::prelude::*;

const TEXTS: [&str; 12] = [
    "min(x, y)*y",
    "max(x^2, y, 1/2)",
    "min(3*x, max(y, x*y), 2 - x, x + y)",
    "sign(x)*y^3 + step(y)*x",
    "floor(2*x)*y + x^2",
    "atan2(y, x)",
    "atan2(x*y + 7, sin(x))",
    "abs(max(x, -y))^2",
    "step(x - y)*sin(x - y)^2",
    "exp(x)/(2 + y^2) - tan(x/2)*log(3 + y)",
    // with repeated subexpressions
    "sin(x*y)/(1 + x^2 + y^2) + sin(y*x)*min(x*y, y*x) - exp(y^2 + x^2)*(1 + x^2 + y^2)*x*x",
    "sqrt(5 + x*y)*atan(x) - tanh(y)/(x^2 + cos(1))^2",
];

fn formula(text: &str) -> Formula {
    Formula::parse(text, &mut |name| ["x", "y"].iter().position(|known| *known == name)).unwrap()
}

properties! {
    #![cases(64)]

    /// Central differences, if two step sizes agree.
    #[test]
    fn slopes_are_those_of_the_values(x in -2.0..2.0_f64, y in -2.0..2.0_f64) {
        for text in TEXTS {
            let formula = formula(text);
            let mut slopes = [0.0; 2];
            let value = formula.gradient(&[x, y], &mut slopes);
            prop_assert_eq!(value, formula.value(&[x, y]));
            for (k, slope) in slopes.iter().enumerate() {
                let quotient = |h: f64| {
                    let at = |s: f64| formula.value(&[x + s * f64::from(k == 0), y + s * f64::from(k == 1)]);
                    (at(h) - at(-h)) / (2.0 * h)
                };
                let smooth = quotient(1e-4);
                // at a kink or a discontinuity the quotients differ
                if (smooth - quotient(1e-5)).abs() < 1e-6 * (1.0 + smooth.abs()) {
                    prop_assert!((slope - smooth).abs() < 1e-5 * (1.0 + smooth.abs()), "{}: {} {}", text, slope, smooth);
                }
            }
        }
    }

    /// A name may be a constant or a variable: values and derivatives are the same.
    #[test]
    fn constants_are_variables_that_do_not_change(x in -2.0..2.0_f64, y in -2.0..2.0_f64) {
        for text in TEXTS {
            let mut expected = [0.0; 2];
            let value = formula(text).gradient(&[x, y], &mut expected);
            let at = [x, y];
            for (constants, x, y) in [
                ([false, false], Symbol::Variable(0), Symbol::Variable(1)),
                ([true, false], Symbol::Number(x), Symbol::Variable(1)),
                ([false, true], Symbol::Variable(0), Symbol::Number(y)),
                ([true, true], Symbol::Number(x), Symbol::Number(y)),
            ] {
                let mut symbol = |name: &str| match name {
                    "x" => Some(x),
                    "y" => Some(y),
                    _ => None,
                };
                let read = Formula::read(text, &mut symbol).unwrap();
                let mut workspace = Workspace::default();
                prop_assert_eq!(read.value(&at), value, "{}", text);
                let gradient = read.differentiated();
                let (found, slopes) = gradient.evaluate(&at, &mut workspace);
                prop_assert_eq!(found, value, "{}", text);
                let mut all = [0.0; 2];
                slopes.for_each(|(k, slope)| all[k] = slope);
                for k in 0..2 {
                    let slope = if constants[k] { 0.0 } else { expected[k] };
                    let off = (all[k] - slope).abs();
                    prop_assert!(off <= 1e-12 * slope.abs(), "{}: {} {}", text, all[k], slope);
                }
            }
        }
    }
}

#[test]
fn corners_have_the_mean_slope() {
    let cases: [(&str, [f64; 2], f64, [f64; 2]); 8] = [
        ("min(x, y)", [1.0, 1.0], 1.0, [0.5, 0.5]),
        ("max(x, 2*y)", [2.0, 1.0], 2.0, [0.5, 1.0]),
        ("abs(x)", [0.0, 1.0], 0.0, [0.0, 0.0]),
        ("sign(x) + sign(-x - 1)", [0.0, 1.0], -1.0, [0.0, 0.0]),
        ("step(x) + 2*step(-y)", [0.0, 1.0], 1.0, [0.0, 0.0]),
        ("floor(x) - floor(-y)", [-0.5, 2.0], 1.0, [0.0, 0.0]),
        ("atan2(x, y)", [0.0, -1.0], std::f64::consts::PI, [-1.0, 0.0]),
        // no infinity times zero: the other branch is not used
        ("min(x, 1/y)", [1.0, 0.0], 1.0, [1.0, 0.0]),
    ];
    for (text, at, value, slopes) in cases {
        let mut found = [f64::NAN; 2];
        assert_eq!(formula(text).gradient(&at, &mut found), value, "{text}");
        assert_eq!(found, slopes, "{text}");
    }
    for text in
        ["min(x, y)", "max(y, x)", "max(x, y, 1)", "step(x)", "sign(x)", "floor(x)", "atan2(y, x)"]
    {
        assert!(formula(text).value(&[f64::NAN, 1.0]).is_nan(), "{text}");
    }
}
