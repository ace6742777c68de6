//! Recorded programs agree with the formulas: with rational functions, rationals and jets.

mod solution;

use crate::common::property::properties;
use affinor_tensors::linear::Matrix;
use affinor_tensors::scalar::{Count, Function, Step, StraightLine, derivatives, laws};
use affinor_tensors::{
    Field, Jet, Notation, Rational, Recorded, Ring, Scalar, Symbolic, Tolerance,
};
use num_traits::{One, Zero};
use proptest::prelude::*;

/// A formula in the inputs `a`, `b` and `c`.
#[derive(Clone, Debug)]
enum Formula {
    Input(usize),
    Constant(i64, i64),
    Sum(Box<Formula>, Box<Formula>),
    Difference(Box<Formula>, Box<Formula>),
    Product(Box<Formula>, Box<Formula>),
    /// The quotient, or the numerator if the denominator vanishes.
    Quotient(Box<Formula>, Box<Formula>),
}

const NAMES: [&str; 3] = ["a", "b", "c"];

impl Formula {
    fn value<S: Field + Scalar>(&self, inputs: &[S; 3]) -> S {
        let both = |a: &Formula, b: &Formula| (a.value(inputs), b.value(inputs));
        match self {
            Formula::Input(at) => inputs[*at].clone(),
            Formula::Constant(n, d) => S::from_quotient(*n, *d).unwrap(),
            Formula::Sum(a, b) => {
                let (a, b) = both(a, b);
                a + &b
            }
            Formula::Difference(a, b) => {
                let (a, b) = both(a, b);
                a - &b
            }
            Formula::Product(a, b) => {
                let (a, b) = both(a, b);
                a * &b
            }
            Formula::Quotient(a, b) => {
                let (a, b) = both(a, b);
                match b.recip() {
                    Some(inverse) => a * &inverse,
                    None => a,
                }
            }
        }
    }
}

fn formula() -> impl Strategy<Value = Formula> {
    let leaf = prop_oneof![
        3 => (0usize..3).prop_map(Formula::Input),
        1 => (-4i64..=4, 1i64..=3).prop_map(|(n, d)| Formula::Constant(n, d)),
    ];
    leaf.prop_recursive(4, 24, 2, |inner| {
        let pair = || (inner.clone(), inner.clone()).prop_map(|(a, b)| (Box::new(a), Box::new(b)));
        prop_oneof![
            2 => pair().prop_map(|(a, b)| Formula::Sum(a, b)),
            2 => pair().prop_map(|(a, b)| Formula::Difference(a, b)),
            3 => pair().prop_map(|(a, b)| Formula::Product(a, b)),
            1 => pair().prop_map(|(a, b)| Formula::Quotient(a, b)),
        ]
    })
}

fn inputs() -> [Recorded; 3] {
    NAMES.map(|name| Recorded::parameter(name).unwrap())
}

fn recorded() -> impl Strategy<Value = Recorded> {
    formula().prop_map(|formula| formula.value(&inputs()))
}

fn point() -> impl Strategy<Value = [Rational; 3]> {
    [(-50i64..50, 1i64..9), (-50i64..50, 1i64..9), (-50i64..50, 1i64..9)]
        .prop_map(|point| point.map(|(n, d)| Rational::new(n, d).unwrap()))
}

fn at<S: Clone>(point: &[S; 3]) -> impl Fn(&str) -> S {
    |name| point[NAMES.iter().position(|own| *own == name).unwrap()].clone()
}

/// The value of a rational function; `None` at a pole.
fn substituted(value: &Symbolic, point: &[Rational; 3]) -> Option<Rational> {
    let set = NAMES.map(str::to_string).into_iter().zip(point.clone().map(Symbolic::constant));
    value.substitute(&set.collect())?.as_constant().cloned()
}

properties! {
    #![cases(128)]

    #[test]
    fn recorded_values_are_a_field([a, b, c] in [recorded(), recorded(), recorded()]) {
        laws::field(&a, &b, &c, Tolerance::new(0.0).unwrap())?;
    }

    /// Equality, zero and constants agree with rational functions.
    #[test]
    fn they_are_zero_where_rational_functions_are(f in formula(), g in formula()) {
        let symbols = NAMES.map(Symbolic::parameter);
        let ([x, y], [p, q]) = (
            [&f, &g].map(|formula| formula.value(&inputs())),
            [&f, &g].map(|formula| formula.value(&symbols)),
        );
        prop_assert_eq!(x == y, p == q);
        prop_assert_eq!(x.vanishes(), p.vanishes());
        prop_assert_eq!(Recorded::try_from(&p).unwrap(), x);
    }

    /// A program computes the values of the formula and of its derivatives.
    #[test]
    fn programs_compute_the_formula(f in formula(), g in formula(), point in point()) {
        let symbols = NAMES.map(Symbolic::parameter);
        let (values, functions) = (
            [&f, &g].map(|formula| formula.value(&inputs())),
            [&f, &g].map(|formula| formula.value(&symbols)),
        );
        let mut outputs = values.to_vec();
        let mut expected = functions.to_vec();
        for name in NAMES {
            outputs.extend(derivatives(&values, name));
            expected.extend(functions.iter().map(|value| value.derivative(name)));
        }
        let program = StraightLine::new(&outputs);
        let found = program.evaluate(at(&point), |_, x| x.clone());
        let expected: Option<Vec<_>> = expected.iter().map(|v| substituted(v, &point)).collect();
        // a pole of the program may cancel in the reduced fraction
        if let (Some(found), Some(expected)) = (found, expected) {
            prop_assert_eq!(found, expected);
        }
    }

    /// Derivatives agree with forward differentiation in floats.
    #[test]
    fn derivatives_are_those_of_jets(f in formula(), point in [1.0..2.0f64, 2.0..3.0, 3.0..4.0]) {
        let jet = f.value(&Jet::coordinates(point));
        let value = f.value(&inputs());
        for (k, name) in NAMES.into_iter().enumerate() {
            let program = StraightLine::new(&derivatives(std::slice::from_ref(&value), name));
            let Some(found) = program.evaluate(at(&point), |_, x| *x) else { continue };
            let expected = jet.derivative(k).value();
            if jet.is_finite() && found[0].is_finite() {
                let size = 1.0 + expected.abs() + jet.value().abs();
                prop_assert!((found[0] - expected).abs() <= 1e-6 * size * size, "{value}");
            }
        }
    }

    /// The inverse of a full symmetric matrix agrees with the exact inverse at a point.
    #[test]
    fn inverses_are_programs(entries in prop::collection::vec(-9i64..9, 10)) {
        let (upper, n) = (|i: usize, j: usize| format!("g{}{}", i.min(j), i.max(j)), 4);
        let symbols: Vec<Vec<_>> = (0..n)
            .map(|i| (0..n).map(|j| Recorded::parameter(&upper(i, j)).unwrap()).collect())
            .collect();
        let names: Vec<String> = (0..n).flat_map(|i| (i..n).map(move |j| upper(i, j))).collect();
        let value = |name: &str| {
            let at = names.iter().position(|own| own == name).unwrap();
            let diagonal = name[1..2] == name[2..3];
            Rational::from(entries[at] + if diagonal { 40 } else { 0 })
        };
        let inverse = Matrix::from_dense(&symbols).unwrap().inverse().unwrap();
        let outputs: Vec<_> = inverse.to_dense().concat();
        let program = StraightLine::new(&outputs);
        let numbers: Vec<Vec<_>> =
            (0..n).map(|i| (0..n).map(|j| value(&upper(i, j))).collect()).collect();
        let expected = Matrix::from_dense(&numbers).unwrap().inverse().unwrap().to_dense().concat();
        prop_assert_eq!(program.evaluate(value, |_, x| x.clone()), Some(expected));
        // one division for each pivot and each weight, and one for the largest entry; equal entries are computed once
        prop_assert_eq!(program.count().divisions, 2 * n + 1);
        prop_assert!(program.count().multiplications < 120, "{:?}", program.count());
    }
}

/// A common subexpression is computed once, also if it is written in another form or negated.
#[test]
fn equal_values_are_one_step() {
    let [a, b, c] = inputs();
    let first = (a.clone() + &b) * &c;
    let second = a.clone() * &c + &(b.clone() * &c);
    let third = (-b.clone() - &a) * &c;
    let program = StraightLine::new(&[first, second, third]);
    let steps = [
        Step::Input("a".into()),
        Step::Input("b".into()),
        Step::Sum(Rational::zero(), vec![(Rational::one(), 0), (Rational::one(), 1)]),
        Step::Input("c".into()),
        Step::Product(2, 3),
    ];
    assert_eq!(program.steps(), steps);
    let outputs: Vec<_> = program.outputs().iter().map(|o| (o.factor.to_f64(), o.step)).collect();
    assert_eq!(outputs, [(1.0, Some(4)), (1.0, Some(4)), (-1.0, Some(4))]);
    let count = Count { additions: 1, multiplications: 1, ..Count::default() };
    assert_eq!(program.count(), count);
}

/// Values that no output uses are not computed.
#[test]
fn dead_code_is_dropped() {
    let [a, b, _] = inputs();
    let cancelled = (a.clone() + &b) * &(a.clone() - &b) + &(b.clone() * &b);
    // equal to a^2, though recorded as a product of sums
    let program = StraightLine::new(&[a.clone() * &a, cancelled]);
    assert_eq!(program.steps(), [Step::Input("a".into()), Step::Product(0, 0)]);
    assert!(StraightLine::new(&[a.clone() - &a, Recorded::one()]).steps().is_empty());
}

/// Sines and cosines of equal arguments satisfy sin^2 + cos^2 = 1.
#[test]
fn sines_and_cosines_are_dependent() {
    let [x, ..] = inputs();
    let [sine, cosine, exponential, tangent] =
        ["sin", "cos", "exp", "tan"].map(|name| Recorded::function(name, &x).unwrap());
    assert_eq!(sine.clone() * &sine + &(cosine.clone() * &cosine), Recorded::one());
    assert_eq!(sine.derivative("a"), cosine);
    assert_eq!(cosine.derivative("a"), -sine.clone());
    assert_eq!(exponential.derivative("a"), exponential);
    assert_eq!(tangent.derivative("a"), Recorded::one() + &(tangent.clone() * &tangent));
    assert_eq!(sine.derivative("b"), Recorded::zero());
    let program = StraightLine::new(&[tangent * &exponential]);
    let value = program.evaluate(|_| 0.7, float).unwrap();
    assert!((value[0] - 0.7f64.tan() * 0.7f64.exp()).abs() < 1e-15);
    assert!(Recorded::function("gamma", &x).is_err());
}

/// The addition theorems hold for sums of products of inputs, also for some of the terms, and for
/// any signs.
#[test]
fn functions_of_sums_obey_the_addition_theorems() {
    let [a, b, c] = inputs();
    let f = |name: &str, x: &Recorded| Recorded::function(name, x).unwrap();
    let (x, y) = (a.clone() * &b, b * &c);
    let half = x.clone() * &Recorded::from_quotient(1, 2).unwrap();
    let sum = x.clone() + &y;
    assert_eq!(f("sin", &sum), f("sin", &x) * &f("cos", &y) + &(f("cos", &x) * &f("sin", &y)));
    assert_eq!(f("exp", &sum), f("exp", &x) * &f("exp", &y));
    assert_eq!(f("sin", &-x.clone()), -f("sin", &x));
    assert_eq!(f("exp", &-x.clone()), f("exp", &x).recip().unwrap());
    assert_eq!(f("sin", &x), f("sin", &half) * &f("cos", &half) * &Recorded::from_i64(2));
    assert_ne!(f("sin", &x), f("sin", &y));
    let difference = y.clone() - &x;
    let opposite = x.clone() - &y;
    assert_eq!(f("cos", &difference), f("cos", &opposite));
    // one of the two is the negative of the other in the program
    let program = StraightLine::new(&[difference, f("exp", &opposite), f("log", &opposite)]);
    let value = |name: &str| if name == "a" { 0.9 } else { 0.3 + f64::from(name == "c") / 8.0 };
    let found = program.evaluate(value, float).unwrap();
    let expected = value("b") * (value("a") - value("c"));
    let expected = [-expected, expected.exp(), expected.ln()];
    assert!(found.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-14), "{found:?}");
}

/// Roots and logarithms: derivatives, and the square of a root.
#[test]
fn roots_and_logarithms_have_derivatives() {
    let [a, b, _] = inputs();
    let p = a.clone() * &a + &b;
    let [root, log] = ["sqrt", "log"].map(|name| Recorded::function(name, &p).unwrap());
    assert_eq!(root.clone() * &root, p);
    let inverse = root.recip().unwrap();
    assert_eq!(inverse.clone() * &root, Recorded::one());
    assert_eq!(inverse.clone() * &inverse * &inverse * &a, inverse * &a * &p.recip().unwrap());
    assert_eq!(log.derivative("a"), (a.clone() + &a) * &p.recip().unwrap());
    let program = StraightLine::new(&[root.derivative("a"), log, root]);
    let found = program.evaluate(|name| if name == "a" { 1.5 } else { 0.25 }, float).unwrap();
    let (p, root) = (2.5f64, 2.5f64.sqrt());
    let expected = [1.5 / root, p.ln(), root];
    assert!(found.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-15), "{found:?}");
}

fn float(function: Function, x: &f64) -> f64 {
    function.value(*x)
}

/// Nonzero numbers that a prime of the certificate divides are not taken for zero.
#[test]
fn multiples_of_the_primes_do_not_vanish() {
    let [a, b, _] = inputs();
    for prime in [(1i64 << 61) - 1, (1 << 62) - 57] {
        let p = Recorded::from_i64(prime);
        let sum = a.clone() * &p + &b;
        assert_ne!(sum, b);
        assert!(!p.vanishes() && p.recip().is_some());
        let value = |name: &str| Rational::from(if name == "a" { 1 } else { 2 });
        let quotient = sum.clone() * &p.recip().unwrap();
        let program = StraightLine::new(&[sum, quotient]);
        let found = program.evaluate(value, |_, x| x.clone()).unwrap();
        assert_eq!(found, [Rational::from(prime + 2), Rational::new(prime + 2, prime).unwrap()]);
    }
}

/// A long chain is recorded, written and dropped without a deep recursion.
#[test]
fn long_chains_need_no_stack() {
    let [a, b, _] = inputs();
    let mut value = a;
    for _ in 0..200_000 {
        value = (value * &b).recip().unwrap() + &Recorded::one();
    }
    assert!(value.to_string().contains("..."));
    assert_eq!(value.parameters(), ["a", "b"]);
    assert!(StraightLine::new(&[value]).count().divisions > 100_000);
}

/// The first operation without a finite value is named, and none is named where all results are finite.
#[test]
fn failures_are_named() {
    let [a, b] = ["a", "b"].map(Recorded::input);
    let function = |name, argument: &Recorded| Recorded::function(name, argument).unwrap();
    let quotient = (a.clone() - &b).recip().unwrap();
    let large = Recorded::from_rational(&Rational::from_f64(1e300).unwrap()).unwrap();
    for (value, [x, y], expected) in [
        (quotient.clone(), [1.0, 2.0], None),
        (quotient.clone(), [2.0, 2.0], Some("division by zero")),
        (function("log", &a), [-1.5, 0.0], Some("log(-1.5)")),
        (function("log", &a), [0.0, 0.0], Some("log(0)")),
        (function("sqrt", &(a.clone() * &b)), [-1.0, 4.0], Some("sqrt(-4)")),
        (function("exp", &a), [1000.0, 0.0], Some("a number beyond the range of floats")),
        (a.clone() * &b, [1e200, 1e200], Some("a number beyond the range of floats")),
        (a.clone() * &large, [1e20, 0.0], Some("a number beyond the range of floats")),
        (a.clone() * &b, [f64::NAN, 1.0], Some("a = NaN")),
    ] {
        let program = StraightLine::new(&[value]);
        let found = program.failure(|name| if name == "a" { x } else { y });
        assert_eq!(found.as_deref(), expected);
    }
}
