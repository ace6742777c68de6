//! Rational functions of parameters, compared with exact values at rational points, Euclid's
//! algorithm in one variable, closed forms and finite differences.

mod denominator;
mod elementary;
mod free;
mod memo;
mod positive;
mod writing;

use crate::common::property::properties;
use affinor_tensors::scalar::Variable;
use affinor_tensors::{Field, Kind, Notation, Rational, Ring, Sum, Summable, Symbolic, Tolerance};
use num_traits::{One, Zero, pow};
use proptest::prelude::*;
use std::collections::BTreeMap;

const NAMES: [&str; 3] = ["a", "b", "c"];

fn parameter(name: &str) -> Symbolic {
    Symbolic::parameter(name)
}

fn rational(n: i64, d: i64) -> Rational {
    Rational::new(n, d).expect("denominator not zero")
}

fn number(n: i64, d: i64) -> Symbolic {
    Symbolic::constant(rational(n, d))
}

/// A polynomial as a plain list of terms, with values computed term by term.
#[derive(Clone, Debug)]
struct Terms(Vec<(Rational, [usize; 3])>);

impl Terms {
    fn at(&self, point: &[Rational; 3]) -> Rational {
        self.0.iter().fold(Rational::zero(), |sum, (c, exponents)| {
            let powers = exponents.iter().zip(point);
            sum + powers.fold(c.clone(), |term, (&e, x)| term * pow(x.clone(), e))
        })
    }

    fn symbolic(&self) -> Symbolic {
        self.0.iter().fold(Symbolic::zero(), |sum, (c, exponents)| {
            let powers = exponents.iter().zip(NAMES);
            sum + powers.fold(Symbolic::constant(c.clone()), |term, (&e, name)| {
                term * pow(parameter(name), e)
            })
        })
    }
}

/// A quotient of two lists of terms, and the same as a value under test.
#[derive(Clone, Debug)]
struct Quotient {
    above: Terms,
    below: Terms,
    value: Symbolic,
}

impl Quotient {
    fn at(&self, point: &[Rational; 3]) -> Option<Rational> {
        Some(self.above.at(point) * &self.below.at(point).recip()?)
    }
}

fn terms() -> impl Strategy<Value = Terms> {
    let term = ((-4i64..=4, 1i64..=3), [0usize..=2, 0..=2, 0..=1]);
    let term = term.prop_map(|((n, d), exponents)| (rational(n, d), exponents));
    prop::collection::vec(term, 1..=3).prop_map(Terms)
}

fn quotient() -> impl Strategy<Value = Quotient> {
    (terms(), terms()).prop_filter_map("zero denominator", |(above, below)| {
        let denominator = below.symbolic().recip()?;
        let value = above.symbolic() * &denominator;
        Some(Quotient { above, below, value })
    })
}

fn point() -> impl Strategy<Value = [Rational; 3]> {
    let coordinate = || (-30i64..=30, 1i64..=7).prop_map(|(n, d)| rational(n, d));
    [coordinate(), coordinate(), coordinate()]
}

fn values<T>(
    point: impl IntoIterator<Item = T>,
    f: impl Fn(T) -> Symbolic,
) -> BTreeMap<String, Symbolic> {
    NAMES.into_iter().zip(point).map(|(name, x)| (name.to_owned(), f(x))).collect()
}

/// The exact value of a quotient at a point.
fn at(value: &Symbolic, point: &[Rational; 3]) -> Option<Rational> {
    let constant = value.substitute(&values(point.clone(), Symbolic::constant))?;
    Some(constant.as_constant().expect("free of parameters").clone())
}

/// Coefficients by rising powers of one parameter, with values for the others; without zeros at the
/// end.
fn image(polynomial: &Symbolic, name: &str, point: &[Rational; 3]) -> Vec<Rational> {
    let mut image: Vec<Rational> = Vec::new();
    for (powers, c) in polynomial.terms() {
        let mut value = c;
        let mut degree = 0;
        for (own, e) in powers {
            if own.text() == name {
                degree = e as usize;
            } else {
                let k = NAMES.iter().position(|n| *n == own.text()).expect("a known parameter");
                value *= pow(point[k].clone(), e as usize);
            }
        }
        image.resize(image.len().max(degree + 1), Rational::zero());
        image[degree] = image[degree].clone() + &value;
    }
    trim(image)
}

fn trim(mut f: Vec<Rational>) -> Vec<Rational> {
    while f.last().is_some_and(Rational::is_zero) {
        f.pop();
    }
    f
}

/// The degree of the greatest common divisor of two nonzero polynomials in one variable.
fn euclid(mut f: Vec<Rational>, mut g: Vec<Rational>) -> usize {
    while let Some(unit) = g.last().and_then(Field::recip) {
        while f.len() >= g.len() {
            let factor = f[f.len() - 1].clone() * &unit;
            let shift = f.len() - g.len();
            for (k, c) in g.iter().enumerate() {
                f[shift + k] = f[shift + k].clone() - &(factor.clone() * c);
            }
            f = trim(f);
        }
        (f, g) = (g, f);
    }
    f.len() - 1
}

/// Whether numerator and denominator are proved to be coprime: for every parameter there is a point
/// where the leading coefficients do not vanish and the images have no common divisor.
fn coprime(value: &Symbolic, points: &[[Rational; 3]]) -> bool {
    let (above, below) = (value.numerator(), value.denominator());
    let degree = |f: &Symbolic, name: &str| {
        let powers = f.terms().into_iter().flat_map(|(powers, _)| powers);
        powers.filter(|(own, _)| own.text() == name).map(|(_, e)| e as usize).max().unwrap_or(0)
    };
    NAMES.iter().all(|name| {
        points.iter().any(|point| {
            let (f, g) = (image(&above, name, point), image(&below, name, point));
            f.len() == degree(&above, name) + 1
                && g.len() == degree(&below, name) + 1
                && euclid(f, g) == 0
        })
    })
}

/// Reads the text form: sums of products of powers, with the usual precedence.
fn read(text: &str) -> Symbolic {
    fn sum(s: &mut &str) -> Symbolic {
        let mut value = product(s);
        while let Some(sign) = take(s, "+-") {
            let next = product(s);
            value = if sign == '+' { value + next } else { value - next };
        }
        value
    }
    fn product(s: &mut &str) -> Symbolic {
        if take(s, "-").is_some() {
            return -product(s);
        }
        let mut value = factor(s);
        while let Some(sign) = take(s, "*/") {
            let next = factor(s);
            value = if sign == '*' { value * next } else { value / next };
        }
        value
    }
    fn factor(s: &mut &str) -> Symbolic {
        let base = if take(s, "(").is_some() {
            let value = sum(s);
            assert_eq!(take(s, ")"), Some(')'));
            value
        } else {
            let word = word(s);
            Rational::from_digits(word).map_or_else(|| parameter(word), Symbolic::constant)
        };
        match take(s, "^") {
            Some(_) => pow(base, word(s).parse().expect("an exponent")),
            None => base,
        }
    }
    fn word<'a>(s: &mut &'a str) -> &'a str {
        let end = s.find(|c: char| !c.is_alphanumeric()).unwrap_or(s.len());
        let (word, rest) = s.split_at(end);
        *s = rest;
        word
    }
    fn take(s: &mut &str, signs: &str) -> Option<char> {
        *s = s.trim_start();
        let sign = s.chars().next().filter(|c| signs.contains(*c))?;
        *s = s[1..].trim_start();
        Some(sign)
    }
    let mut rest = text;
    let value = sum(&mut rest);
    assert_eq!(rest, "", "all of {text:?} read");
    value
}

properties! {
    #![cases(96)]

    #[test]
    fn operations_agree_with_exact_values(x in quotient(), y in quotient(), p in point()) {
        let Some((u, v)) = x.at(&p).zip(y.at(&p)) else { return Ok(()) };
        let (x, y) = (x.value, y.value);
        prop_assert_eq!(at(&x, &p), Some(u.clone()));
        prop_assert_eq!(at(&(x.clone() + &y), &p), Some(u.clone() + &v));
        prop_assert_eq!(at(&(x.clone() - &y), &p), Some(u.clone() - &v));
        prop_assert_eq!(at(&(x.clone() * &y), &p), Some(u.clone() * &v));
        prop_assert_eq!(at(&-x.clone(), &p), Some(-u.clone()));
        if !v.is_zero() {
            prop_assert_eq!(at(&(x / &y), &p), Some(u / &v));
        }
    }

    #[test]
    fn results_are_in_lowest_terms(x in quotient(), y in quotient(), points in prop::collection::vec(point(), 12)) {
        let (x, y) = (x.value, y.value);
        for value in [x.clone() + &y, x.clone() * &y, x.clone() - &y, x.derivative("a")] {
            prop_assert_eq!(value.numerator() / value.denominator(), value.clone());
            if value.is_zero() {
                continue;
            }
            prop_assert!(coprime(&value, &points), "{} is not reduced", value);
            let coefficients: Vec<_> = value.denominator().terms().into_iter().map(|t| t.1).collect();
            prop_assert!(coefficients.iter().all(Rational::is_integer));
            prop_assert!(!coefficients[0].is_negative());
            // coprime integers: no prime up to the largest coefficient divides all of them
            for prime in [2, 3, 5, 7, 11, 13] {
                let divides = |c: &Rational| (c.clone() * &rational(1, prime)).is_integer();
                prop_assert!(!coefficients.iter().all(divides), "{} divides {}", prime, value.denominator());
            }
        }
    }

    #[test]
    fn field_laws_hold_as_equality_of_forms(x in quotient(), y in quotient(), z in quotient()) {
        let (x, y, z) = (x.value, y.value, z.value);
        prop_assert_eq!(x.clone() + &y, y.clone() + &x);
        prop_assert_eq!(x.clone() * &y, y.clone() * &x);
        prop_assert_eq!((x.clone() + &y) + &z, x.clone() + &(y.clone() + &z));
        prop_assert_eq!((x.clone() * &y) * &z, x.clone() * &(y.clone() * &z));
        prop_assert_eq!((x.clone() + &y) * &z, x.clone() * &z + &(y.clone() * &z));
        prop_assert!((x.clone() - &x).vanishes());
        prop_assert_eq!(x.recip().is_none(), x.vanishes());
        if let Some(inverse) = x.recip() {
            prop_assert_eq!(inverse * &x, Symbolic::one());
        }
        let sum = (x.clone() * &z + &(y.clone() * &z)).to_string();
        prop_assert_eq!(((x + &y) * &z).to_string(), sum);
    }

    #[test]
    fn common_factors_cancel(f in terms(), g in terms(), h in terms()) {
        let (f, g, h) = (f.symbolic(), g.symbolic(), h.symbolic());
        prop_assume!(!g.is_zero() && !h.is_zero());
        prop_assert_eq!((f.clone() * &h) / &(g.clone() * &h), f / &g);
    }

    #[test]
    fn derivatives_obey_the_rules(x in quotient(), y in quotient()) {
        let (x, y) = (x.value, y.value);
        for name in NAMES {
            let (dx, dy) = (x.derivative(name), y.derivative(name));
            prop_assert_eq!((x.clone() + &y).derivative(name), dx.clone() + &dy);
            let cross = [dx * &y, x.clone() * &dy];
            prop_assert_eq!((x.clone() * &y).derivative(name), cross[0].clone() + &cross[1]);
            if let Some(inverse) = y.recip() {
                let expected = (cross[0].clone() - &cross[1]) * &(inverse.clone() * &inverse);
                prop_assert_eq!((x.clone() * &inverse).derivative(name), expected);
            }
        }
        prop_assert_eq!(x.derivative("a").derivative("b"), x.derivative("b").derivative("a"));
        prop_assert!(x.derivative("d").is_zero());
    }

    #[test]
    fn derivatives_agree_with_difference_quotients(x in quotient(), p in point()) {
        // the points a + h and a - h are exact, so the error is only h^2 f'''/6
        let h = rational(1, 1 << 20);
        let shifted = |h: Rational| [p[0].clone() + &h, p[1].clone(), p[2].clone()];
        let values = (x.at(&shifted(h.clone())), x.at(&shifted(-h.clone())));
        prop_assume!(x.below.at(&p).to_f64().abs() > 1e-2);
        let (Some(right), Some(left)) = values else { return Ok(()) };
        let quotient = ((right - &left) / &(h * &rational(2, 1))).to_f64();
        let derivative = at(&x.value.derivative("a"), &p).expect("no pole").to_f64();
        let scale = 1.0 + derivative.abs();
        let third = x.value.derivative("a").derivative("a").derivative("a");
        let third = at(&third, &p).expect("no pole").to_f64().abs();
        prop_assert!((quotient - derivative).abs() < 1e-9 * scale + 1e-11 * third, "{quotient} {derivative}");
    }

    #[test]
    fn text_reads_back(x in quotient()) {
        let x = x.value;
        let text = x.to_string();
        prop_assert_eq!(read(&text), x.clone());
        prop_assert_eq!(text.starts_with('-'), x.is_negative());
        prop_assert_eq!(x.latex().starts_with('-'), x.is_negative());
        prop_assert!(x.is_zero() || x.is_negative() != (-x.clone()).is_negative());
    }

    #[test]
    fn substitution_is_simultaneous_composition(x in quotient(), y in quotient(), z in quotient(), p in point()) {
        // a -> y, b -> z, c is unchanged
        let images = [("a".to_owned(), y.value.clone()), ("b".to_owned(), z.value.clone())].into();
        let inner = y.at(&p).zip(z.at(&p));
        let (Some((u, v)), Some(composed)) = (inner, x.value.substitute(&images)) else {
            return Ok(());
        };
        if let Some(expected) = x.at(&[u, v, p[2].clone()]) {
            prop_assert_eq!(at(&composed, &p), Some(expected));
        }
    }

    #[test]
    fn floats_follow_the_exact_values(x in quotient(), p in point()) {
        let Some(exact) = x.at(&p) else { return Ok(()) };
        let float = |name: &str| NAMES.iter().position(|n| *n == name).map(|k| p[k].to_f64());
        let value = x.value.evaluate(float);
        // far from poles, so that the rounding error of the denominator is small
        prop_assume!(x.below.at(&p).to_f64().abs() > 1e-2);
        let value = value.expect("finite");
        let exact = exact.to_f64();
        prop_assert!((value - exact).abs() <= 1e-6 * (1.0 + exact.abs()), "{value} {exact}");
    }
}

#[test]
fn text_is_what_a_person_would_write() {
    let cases = [
        // (a value with its operations, the text, the LaTeX)
        ("(a^2 - b)/(4*c)", "(a^2 - b)/(4*c)", r"\frac{a^{2} - b}{4 c}"),
        ("J11 - J22", "J11 - J22", "J_{11} - J_{22}"),
        ("a/2", "1/2*a", r"\frac{1}{2} a"),
        ("-(3*a)/2", "-3/2*a", r"-\frac{3}{2} a"),
        ("-a/b", "-a/b", r"-\frac{a}{b}"),
        ("1/2 - 1/(2*t)", "(t - 1)/(2*t)", r"\frac{t - 1}{2 t}"),
        ("h", "h", "h"),
        ("b*a*b*3", "3*a*b^2", "3 a b^{2}"),
        ("a/2 - 3*b", "(a - 6*b)/2", r"\frac{a - 6 b}{2}"),
        ("3*b - a/2", "-(a - 6*b)/2", r"-\frac{a - 6 b}{2}"),
        ("b - a", "-a + b", "-a + b"),
        ("(b - a)/c", "-(a - b)/c", r"-\frac{a - b}{c}"),
        ("(2*a + 2*b)/3", "2*(a + b)/3", r"\frac{2 \left(a + b\right)}{3}"),
        ("2*t^2 - 2*t", "2*t^2 - 2*t", "2 t^{2} - 2 t"),
        ("-(a + b)^3*c", "-c*(a + b)^3", r"-c \left(a + b\right)^{3}"),
        // Heron's formula, as in Milnor's Ricci curvatures
        (
            "(a^2 - (b - c)^2)/(2*b*c)",
            "(a + b - c)*(a - b + c)/(2*b*c)",
            r"\frac{\left(a + b - c\right) \left(a - b + c\right)}{2 b c}",
        ),
        (
            "1/((a + b)^2*(a - 2*b)*(c + a)^2)",
            "1/((a - 2*b)*(a + c)^2*(a + b)^2)",
            r"\frac{1}{\left(a - 2 b\right) \left(a + c\right)^{2} \left(a + b\right)^{2}}",
        ),
        ("4*(a/2 - b)^2/c", "(a - 2*b)^2/c", r"\frac{\left(a - 2 b\right)^{2}}{c}"),
        ("a/(4*c)", "a/(4*c)", r"\frac{a}{4 c}"),
        ("a/c^2", "a/c^2", r"\frac{a}{c^{2}}"),
        ("a/(b*c)", "a/(b*c)", r"\frac{a}{b c}"),
        ("1/c", "1/c", r"\frac{1}{c}"),
        ("-3/(4*c)", "-3/(4*c)", r"-\frac{3}{4 c}"),
        ("1/(2*a - 4*b)", "1/(2*a - 4*b)", r"\frac{1}{2 a - 4 b}"),
        ("1/(b - a)", "-1/(a - b)", r"-\frac{1}{a - b}"),
        ("1 + a + b^2 + a*b + a^2*b", "a^2*b + a*b + b^2 + a + 1", "a^{2} b + a b + b^{2} + a + 1"),
        ("J10*J2 + J33 + J11", "J2*J10 + J11 + J33", "J_{2} J_{10} + J_{11} + J_{33}"),
        ("lambda*mu3^2/2", "1/2*lambda*mu3^2", r"\frac{1}{2} \lambda \mu_{3}^{2}"),
        ("abc + Omega", "Omega + abc", r"\Omega + \mathit{abc}"),
        ("-7/3 + a - a", "-7/3", r"-\frac{7}{3}"),
    ];
    for (value, text, latex) in cases {
        assert_eq!(read(value).to_string(), text);
        assert_eq!(read(value).latex(), latex);
        assert_eq!(format!("{:?}", read(value)), text);
    }
    let underscored = ["J_11", "x_max", "max_x", "a_", "_"].map(|name| parameter(name).latex());
    let expected =
        ["J_{11}", r"x_{\mathit{max}}", r"\mathit{max}_{x}", r"\mathit{a\_}", r"\mathit{\_}"];
    assert_eq!(underscored, expected);
}

#[test]
fn equal_values_are_equal_whatever_their_history() {
    let [a, b] = ["a", "b"].map(parameter);
    let squares = a.clone() * &a - &(b.clone() * &b);
    assert_eq!(squares / &(a.clone() - &b), a.clone() + &b);
    // parameters that cancel do not occur in the result
    let value = (a.clone() + &b) - &b;
    assert_eq!(value, a);
    assert_eq!(value.parameters(), ["a"]);
    let one = (a.clone() * &b) / &(b.clone() * &a);
    assert_eq!(one.as_constant(), Some(&Rational::one()));
    assert_eq!(one, Symbolic::one());
}

#[test]
fn parameter_sets_merge_by_name() {
    let left = parameter("J10") / &parameter("x");
    let right = parameter("J2") / &parameter("b");
    let sum = left.clone() + &right;
    assert_eq!(sum.parameters(), ["J2", "J10", "b", "x"]);
    assert_eq!(sum.to_string(), "(J2*x + J10*b)/(b*x)");
    assert_eq!(sum, right.clone() + &left);
    assert_eq!(sum - &right, left);
}

#[test]
fn constants_are_free_of_context() {
    let a = parameter("a");
    assert_eq!(Symbolic::zero() + &a, a);
    assert_eq!(a.clone() + &Symbolic::zero(), a);
    assert_eq!(Symbolic::one() * &a, a);
    assert_eq!((a.clone() * &Symbolic::zero()).as_constant(), Some(&Rational::zero()));
    assert_eq!((a.clone() + &Symbolic::from_i64(2)).to_string(), "a + 2");
    assert_eq!((number(2, 3) - &(Symbolic::one() / &a)).to_string(), "(2*a - 3)/(3*a)");
    assert_eq!(number(1, 2) + &number(1, 3), number(5, 6));
    assert_eq!(Symbolic::zero().recip(), None);
    assert!(!a.vanishes());
    assert_eq!(number(1, 2).to_f64(), Some(0.5));
    assert_eq!(a.to_f64(), None);
}

#[test]
fn traits_speak_for_constants_and_fractions() {
    let a = parameter("a");
    let constants = [number(1, 2), number(-2, 3)];
    let cleared = Symbolic::clear_denominators(constants.iter());
    assert_eq!(cleared, Some((vec![3, -4], 6)));
    assert_eq!(Symbolic::clear_denominators([&a, &constants[0]].into_iter()), None);
    assert_eq!(Symbolic::from_quotient(2, -4), Some(number(-1, 2)));
    assert_eq!(Symbolic::from_quotient(1, 0), None);
    assert_eq!(Symbolic::KIND, Kind::Symbolic);
    assert_eq!(<Symbolic as Notation>::parameter("J_11"), Some(parameter("J_11")));
    for name in ["", "2", "a b", "a+b", "1a", "\u{7}"] {
        assert_eq!(<Symbolic as Notation>::parameter(name), None);
    }
    // simple pivots first, and constants before fractions
    let sum = a.clone() + &parameter("b");
    let pivots = [number(1, 1), number(i64::MAX, 7), a.clone(), sum.clone()];
    assert!(pivots.is_sorted_by(|x, y| x.pivot_weight() > y.pivot_weight()));
    assert!(sum.size() > a.size() && pow(a.clone(), 100_000).size() >= 100_000);

    let mut collected = <Symbolic as Summable>::Sum::product(&a, &a);
    collected.add_product(&-a.clone(), &a);
    assert_eq!(collected.finish(Tolerance::default()), None);
    collected.add_term(&a);
    assert_eq!(collected.finish(Tolerance::default()), Some(a));
}

#[test]
fn terms_are_coordinates_over_the_monomials() {
    let power = |name: &str, e| (Variable::from(name), e);
    assert_eq!(
        read("(a^2*b - 3*c)/4 + 1").terms(),
        [
            (vec![power("a", 2), power("b", 1)], rational(1, 4)),
            (vec![power("c", 1)], rational(-3, 4)),
            (vec![], rational(1, 1)),
        ]
    );
    assert_eq!(number(2, 3).terms(), [(vec![], rational(2, 3))]);
    assert_eq!(Symbolic::zero().terms(), []);
    assert_eq!(read("(a/2 + 1)/(3*c)").terms(), read("a/6 + 1/3").terms());
}

#[test]
fn substitution_refuses_poles() {
    let value = read("(a + b)/(a - c)");
    let onto =
        |pairs: &[(&str, &str)]| pairs.iter().map(|(n, v)| (n.to_string(), read(v))).collect();
    assert_eq!(value.substitute(&onto(&[("a", "c")])), None);
    assert_eq!(value.substitute(&onto(&[("a", "1"), ("c", "1")])), None);
    assert_eq!(value.substitute(&onto(&[("a", "b"), ("b", "a")])), Some(read("(a + b)/(b - c)")));
    assert_eq!(value.substitute(&onto(&[("unknown", "1")])), Some(value.clone()));
    assert_eq!(value.substitute(&onto(&[("a", "1/t"), ("c", "0")])), Some(read("1 + b*t")));
    assert_eq!(value.evaluate(|_| Some(1.0)), None);
    assert_eq!(value.evaluate(|name| (name != "c").then_some(1.0)), None);
    assert_eq!(read("a^3/4 - b").evaluate(|_| Some(2.0)), Some(0.0));
}

#[test]
fn high_degrees_neither_wrap_nor_allocate() {
    let high = pow(parameter("a"), 1 << 30);
    assert_eq!(high.to_string(), "a^1073741824");
    assert_eq!((high.clone() * &parameter("b") / &high).to_string(), "b");
    assert_eq!((parameter("b") / &high).derivative("a").to_string(), "-1073741824*b/a^1073741825");
    let itself = [("a".to_owned(), high.clone())].into();
    assert_eq!(high.substitute(&itself), None);
    let one = [("a".to_owned(), Symbolic::one())].into();
    assert_eq!(high.substitute(&one), Some(Symbolic::one()));
    assert_eq!(read("(a^400 - b^400)/(a^399 - b^399)").parameters(), ["a", "b"]);
    assert_eq!(read("(a^64 - 1)/(a^32 + 1)"), read("a^32 - 1"));
}

#[test]
#[should_panic(expected = "total degree")]
fn exponents_never_wrap() {
    let high = pow(parameter("a"), 1 << 31);
    let _ = high.clone() * &high;
}

#[test]
fn numbers_beyond_words_stay_exact() {
    let big = pow(number(3, 1), 50);
    let a = parameter("a");
    let f = (a.clone() + &big) * &(a.clone() - &big);
    assert_eq!(f.clone() / &(a.clone() + &big), a.clone() - &big);
    assert_eq!(f / &(a.clone() * &a - &(big.clone() * &big)), Symbolic::one());
    assert_eq!((a / &big).to_string(), "1/717897987691852588770249*a");
}

/// so(3) with the metric diag(a, b, c): J. Milnor, *Adv. Math.* 21 (1976), Theorem 4.3. Let l_i =
/// (a, b, c)/sqrt(abc) in an orthonormal frame, and m_i = (l_1 + l_2 + l_3)/2 - l_i. Then the
/// sectional curvature of the first plane is l_3 m_3 - m_1 m_2, and R_1212 is a b times the
/// curvature.
#[test]
fn milnors_curvature_of_the_rotation_group() {
    let [a, b, c] = NAMES.map(parameter);
    let half = (a.clone() + &b + &c) * &number(1, 2);
    let [m1, m2, m3] = [&a, &b, &c].map(|x| half.clone() - x);
    let volume = a.clone() * &b * &c;
    let sectional = (c.clone() * &m3 - &(m1 * &m2)) / &volume;
    let milnor = sectional * &(a.clone() * &b);

    let difference = a.clone() - &b;
    let direct = (a.clone() + &b) * &number(1, 2) - &(c.clone() * &number(3, 4))
        + &(difference.clone() * &difference / &(c.clone() * &number(4, 1)));
    assert_eq!(milnor, direct);
    assert_eq!(direct.to_string(), "(a*(a - 2*b + 2*c) + b^2 + 2*b*c - 3*c^2)/(4*c)");
    assert_eq!(direct, read("(a + b)/2 - 3*c/4 + (a - b)^2/(4*c)"));
    // the round metric has R_1212 = a/4
    let round = values([&a, &a, &a], Clone::clone);
    assert_eq!(direct.substitute(&round), Some(a * &number(1, 4)));
    assert_eq!(direct.derivative("c"), read("-3/4 - (a - b)^2/(4*c^2)"));
}

#[test]
fn parameters_are_in_natural_order() {
    let names = ["J", "J02", "J2", "J10", "J10a", "J11", "J33", "K1", "a", "a1b2", "a1b10", "b"];
    for reversed in [false, true] {
        let mut parameters = names.map(Symbolic::parameter).to_vec();
        if reversed {
            parameters.reverse();
        }
        let sum: Symbolic = parameters.into_iter().sum();
        assert_eq!(sum.parameters(), names);
        assert_eq!(sum.to_string(), names.join(" + "));
    }
    // functions come after all names, ordered by their arguments, the sine first
    let sum: Symbolic = "sin(y) + exp(x) + cos(x) + sin(x) + z".parse().unwrap();
    assert_eq!(sum.to_string(), "z + sin(x) + cos(x) + exp(x) + sin(y)");
}

/// The quick proof that two polynomials are coprime computes modulo `2^61 - 1` at a fixed point.
#[test]
fn an_unlucky_point_proves_nothing() {
    const PRIME: i128 = (1 << 61) - 1;
    let coordinate = |k: u64| i128::from(k.wrapping_mul(0x9e37_79b9_7f4a_7c15)) % PRIME;
    let integer = |n: i128| Symbolic::from((n.rem_euclid(PRIME)) as i64);
    // h is congruent to (x - p)(y - q) + 1, which is 1 along both lines through (p, q)
    let (p, q) = (coordinate(1), coordinate(2));
    let [x, y, z] = ["x", "y", "z"].map(parameter);
    let h = &x * &y + &x * integer(-q) + &y * integer(-p) + integer(p * q % PRIME + 1);
    let next = &z + integer(1);
    assert_eq!(&h * &z / (&h * &next), z / next);
}
