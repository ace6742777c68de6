//! Derivatives of formulas with corners and jumps: exact where they are smooth, the mean of both sides at a corner.

use affinor::mechanics::formula::Formula;
use proptest::prelude::*;

const TEXTS: [&str; 9] = [
    "min(x, y)*y",
    "max(x^2, y, 1/2)",
    "min(3*x, max(y, x*y), 2 - x, x + y)",
    "sign(x)*y^3 + step(y)*x",
    "floor(2*x)*y + x^2",
    "atan2(y, x)",
    "atan2(x*y + 7, sin(x))",
    "abs(max(x, -y))^2",
    "step(x - y)*sin(x - y)^2",
];

fn formula(text: &str) -> Formula {
    Formula::parse(text, &mut |name| ["x", "y"].iter().position(|known| *known == name)).unwrap()
}

proptest! {
    #![proptest_config(crate::common::property::cases(64))]

    /// Central differences, where two step sizes agree.
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
                // at a corner or a jump the quotients differ
                if (smooth - quotient(1e-5)).abs() < 1e-6 * (1.0 + smooth.abs()) {
                    prop_assert!((slope - smooth).abs() < 1e-5 * (1.0 + smooth.abs()), "{}: {} {}", text, slope, smooth);
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
        // no infinity times zero: the other branch does not count
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
