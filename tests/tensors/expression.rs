//! The grammar of expressions: valid input, errors with their location, and bounded work.

use crate::common::property::properties;
use affinor_tensors::expression::{
    Evaluator, Expression, ExpressionError, MAX_DIGITS, MAX_SIZE, Scalars, no_function,
};
use affinor_tensors::{Field, Notation, Rational, Ring, Symbolic};
use proptest::prelude::*;
use std::cell::Cell;
use std::fmt::Write;

/// The value of the text over any parameters.
fn symbolic(text: &str) -> Result<Symbolic, ExpressionError> {
    let parameter = |name: &str| Ok(Symbolic::parameter(name));
    Expression::parse(text)?.evaluate(&Scalars(parameter, no_function))
}

fn exact(text: &str) -> Result<Rational, ExpressionError> {
    Expression::parse(text)?.evaluate_constant()
}

#[test]
fn numbers_are_read() {
    for (text, value) in [
        ("0", "0"),
        ("  12 ", "12"),
        ("007", "7"),
        ("1/4", "1/4"),
        ("6/4", "3/2"),
        ("0.25", "1/4"),
        (".5", "1/2"),
        ("5.", "5"),
        ("1e3", "1000"),
        ("1E3", "1000"),
        ("1e-3", "1/1000"),
        ("2.50e+1", "25"),
        ("1.5e-1", "3/20"),
        ("-3", "-3"),
        ("+3", "3"),
        ("--3", "3"),
        ("-+-3", "3"),
        ("1 - -2", "3"),
        ("1 + 2*3", "7"),
        ("(1 + 2)*3", "9"),
        ("12/2/3", "2"),
        ("12/(2/3)", "18"),
        ("12/2*3", "18"),
        ("2 - 3 - 4", "-5"),
        ("2^10", "1024"),
        ("-2^2", "-4"),
        ("(-2)^2", "4"),
        ("2^-2", "1/4"),
        ("2^(-2)", "1/4"),
        ("2^+2", "4"),
        ("2^0", "1"),
        ("0^0", "1"),
        ("3*2^2", "12"),
        ("(1/2)^3", "1/8"),
        ("1/2^3", "1/8"),
        ("\t1\n+ 2", "3"),
        ("2*-3", "-6"),
        ("1/-2", "-1/2"),
        ("10000000000000000000000", "10000000000000000000000"),
        ("1e20 - 1e20 + 1", "1"),
        ("0.1 + 0.2 - 0.3", "0"),
        ("2^3^2", "512"),
        ("2^(3^2)", "512"),
        ("(2^3)^2", "64"),
        ("2^-2^2", "1/16"),
        ("2^--2", "4"),
        ("2^-(2)", "1/4"),
        ("2**3", "8"),
        ("2 ** -1", "1/2"),
        ("2**3**2", "512"),
        ("-2**2", "-4"),
        ("2^1/2", "1"),
        ("3^(4/2)", "9"),
        ("3^(1+1)", "9"),
        ("3^(2*(3 - 1)^2/4)", "9"),
        ("3^2.0", "9"),
        ("3^2e0", "9"),
        ("2^(10^4/1000)", "1024"),
        ("2^-1*3", "3/2"),
        ("1e\u{2212}2", "1/100"),
        ("\u{2212}2\u{b2}", "-4"),
        ("2\u{b7}3\u{d7}4\u{22c5}5", "120"),
        ("2\u{b9}\u{2070}", "1024"),
        ("2\u{207b}\u{b9} + 2\u{207a}\u{b3}", "17/2"),
        ("(1 + 1)\u{2074}/2", "8"),
        ("2^3\u{b2}", "512"),
    ] {
        assert_eq!(exact(text).map(|v| v.to_string()), Ok(value.to_string()), "{text}");
    }
}

#[test]
fn names_are_read() {
    for (text, value) in [
        ("a", "a"),
        ("_x1", "_x1"),
        ("2*a", "2*a"),
        ("2 a", "2*a"),
        ("1/2 a", "1/2*a"),
        ("-a", "-a"),
        ("a*b - b*a", "0"),
        ("2 a b^2/b", ""),
        ("a^2*a^-1", "a"),
        ("(a + b)^2", "(a + b)^2"),
        ("e1 + 2 e1", "3*e1"),
        ("1e2*e", "100*e"),
        ("e", "e"),
        ("\u{398}*\u{3c9}_1", "\u{398}*\u{3c9}_1"),
        ("\u{e9}1 + \u{3c6}\u{2081} - \u{e9}1", "\u{3c6}\u{2081}"),
        ("\u{2126}*\u{b5}/(\u{3a9}*\u{3bc})", "1"),
        ("x\u{b2}*y\u{207b}\u{b9}", "x^2/y"),
        ("x\u{b7}y \u{2212} y\u{d7}x", "0"),
    ] {
        let read = symbolic(text).map(|v| v.to_string());
        match value {
            "" => assert!(read.is_err(), "{text}"),
            value => assert_eq!(read, Ok(value.to_string()), "{text}"),
        }
    }
}

#[test]
fn what_is_refused_is_underlined() {
    for (text, underlined, reason) in [
        ("", "", "the expression ends where a value is expected"),
        ("   ", "", "the expression ends where a value is expected"),
        ("1 +", "", "the expression ends where a value is expected"),
        ("1 + * 2", "*", "`*` is not expected here"),
        ("1\u{a0}+ 2", "\u{a0}", "the character \\u{a0} is not expected here"),
        ("1 2", "2", "`2` is not expected here"),
        ("(1", "(", "this parenthesis is not closed"),
        ("((1)", "(", "this parenthesis is not closed"),
        ("1)", ")", "`)` is not expected here"),
        ("()", ")", "`)` is not expected here"),
        ("(1)(2)", "(", "`*` is missing: write `(1)*(2)`"),
        ("2(3)", "(", "`*` is missing: write `2*(3)`"),
        ("(2)3", "3", "`*` is missing: write `(2)*3`"),
        (".", ".", "a number needs a digit"),
        ("1,5", ",", "`,` is not expected here"),
        ("1..2", ".", "`.` is not expected here"),
        ("0x10", "x10", "`*` is missing: write `0*x10`"),
        ("2x", "x", "`*` is missing: write `2*x`"),
        (" 2M/r - 3 k2 x + 2(1)", "M", "`*` is missing: write `2*M/r - 3 k2*x + 2*(1)`"),
        ("r theta", "theta", "`*` is missing: write `r*theta`"),
        ("r 2", "2", "`*` is missing: write `r*2`"),
        ("1e", "e", "`*` is missing: write `1*e`"),
        ("1e+", "e", "`*` is missing: write `1*e`"),
        ("2abc(d)+", "abc", "`*` is missing: write `2*abc`"),
        ("a b", "b", "`*` is missing: write `a*b`"),
        ("(2) a", "a", "`*` is missing: write `(2)*a`"),
        ("2^2 a", "a", "`*` is missing: write `2^2*a`"),
        ("2\u{b2} a", "a", "`*` is missing: write `2\u{b2}*a`"),
        ("sin x", "x", "parentheses are missing: write `sin(x)`"),
        ("2*sin^2 x", "x", "parentheses are missing: write `sin^2(x)`"),
        ("sin (x)", "(", "remove the space before the parenthesis: write `sin(x)`"),
        ("sin 2", "2", "parentheses are missing: write `sin(2)`"),
        ("2^a", "a", "`a` is not a number"),
        ("2^", "", "the expression ends where a value is expected"),
        ("2^1/2)", ")", "`)` is not expected here"),
        ("2^(1/2)", "(1/2)", "an exponent must be an integer"),
        ("2^0.5", "0.5", "an exponent must be an integer"),
        ("2^(1/0)", "0", "division by zero"),
        ("2^-10001", "10001", "an exponent must be at most 10000"),
        ("2^(10^10)", "(10^10)", "an exponent must be at most 10000"),
        ("2^10001.5", "10001.5", "an exponent must be at most 10000"),
        ("9^9^9", "9^9", "an exponent must be at most 10000"),
        ("2\u{b2}^3", "^", "write parentheses around a power of a power"),
        (
            "sin^-1(0)",
            "sin^-1",
            "`sin^-1` may be the reciprocal or the inverse function: write `1/sin(...)` or \
          `sin(...)^-1` for the reciprocal",
        ),
        ("1***2", "*", "`*` is not expected here"),
        ("1 + \u{3b1}", "\u{3b1}", "`\u{3b1}` is not a number"),
        ("1 + \u{bd}", "\u{bd}", "`\u{bd}` is not expected here"),
        ("1 + x\u{2093}\u{301}", "\u{301}", "the character \\u{301} is not expected here"),
        (
            "2*a_\u{445}",
            "\u{445}",
            "the character \\u{445} is not expected here: it looks like a Latin letter",
        ),
        ("x\u{207f}", "\u{207f}", "`\u{207f}` is not expected here"),
        ("r \u{3b8}", "\u{3b8}", "`*` is missing: write `r*\u{3b8}`"),
        ("1\u{7}", "\u{7}", "the character \\u{7} is not expected here"),
        ("\u{221e}", "\u{221e}", "`\u{221e}` is not expected here"),
        ("NaN", "NaN", "`NaN` is not a number"),
        ("1 + inf", "inf", "`inf` is not a number"),
        ("1/0", "0", "division by zero"),
        ("2 + 1/(1 - 1)", "(1 - 1)", "division by zero"),
        ("3*0^-1", "0^-1", "division by zero"),
    ] {
        let error = exact(text).unwrap_err();
        let span = text.get(error.span.clone());
        assert_eq!((span, error.reason.as_str()), (Some(underlined), reason), "{text}");
        assert_eq!(error.to_string(), reason);
    }
}

#[test]
fn a_number_glued_to_a_basis_name_is_refused() {
    let basis = |name: &str| ["e1", "e2", "e"].contains(&name);
    for (text, underlined) in [("2e1", "2e1"), ("1 + 3.5e2", "3.5e2"), ("7e", "7e")] {
        let error = Expression::parse_beside(text, &basis).unwrap_err();
        assert_eq!(&text[error.span], underlined);
        assert!(error.reason.contains("`*` or a space"), "{}", error.reason);
    }
    for text in ["2 e1", "2*e1", "2e3", "1e-3"] {
        assert!(Expression::parse_beside(text, &basis).is_ok() || text == "1e-3", "{text}");
    }
    assert_eq!(exact("2e1"), Ok(Rational::from(20)));
}

#[test]
fn floats_stay_finite() {
    let float = |text: &str| Expression::parse(text).and_then(|e| e.evaluate_constant::<f64>());
    assert_eq!(float("1/3"), Ok(1.0 / 3.0));
    assert_eq!(float("1e308"), Ok(1e308));
    assert_eq!(float("0.1"), Ok(0.1));
    for text in ["1e309", "1e308*10", "1e308 + 1e308", "1e200^2", "1/1e-309", "1/0"] {
        assert!(float(text).is_err(), "{text}: {:?}", float(text));
    }
}

/// Malicious texts are rejected, or evaluated, at once.
#[test]
fn work_is_bounded() {
    let many = |text: &str, count: usize| text.repeat(count);
    let pole = |n: usize| format!("1/(x{n} + {n})");
    let poles: Vec<String> = (1..40).map(pole).collect();
    for (text, refused) in [
        (many("9", 1_000_000), true),
        (format!("0.{}", many("3", 1_000_000)), true),
        (format!("1e{}", many("9", 1_000_000)), true),
        (format!("2^{}", many("9", 1_000_000)), true),
        (format!("{}1{}", many("(", 100_000), many(")", 100_000)), true),
        (many("(", 100_000), true),
        (many("-", 1_000_000), true),
        (format!("{}1", many("-", 1_000_000)), true),
        (format!("{}1", many("-", 100)), false),
        (format!("{}1", many("-", 101)), true),
        (format!("1{}", many("+1", 100_000)), false),
        (format!("1{}", many("*1", 100_000)), false),
        (many("9", 10_000), false),
        (many("9", 10_001), true),
        ("2^10000".into(), false),
        ("2^10001".into(), true),
        ("2^99999".into(), true),
        ("2^9223372036854775808".into(), true),
        ("1e10000".into(), false),
        ("1e-10000".into(), false),
        ("1e99999".into(), true),
        ("1e-99999".into(), true),
        ("9^9^9".into(), true),
        ("(9^9999)^9999".into(), true),
        ("((((2^9999)^9999)^9999)^9999)^9999".into(), true),
        ("(x + y)^5000".into(), true),
        ("(x + y + z + w + 1)^9999".into(), true),
        ("(1/(x + y))^5000".into(), false),
        ("((x^9999)^9999)^9999".into(), true),
        (poles.join(" + "), true),
    ] {
        let counted = Counted(Cell::new(0));
        let result = Expression::parse(&text).and_then(|text| text.evaluate(&counted));
        let head: String = text.chars().take(40).collect();
        assert_eq!(result.is_err(), refused, "{head}: {:?}", result.err());
        let work = counted.0.get();
        let bound = 4 * MAX_SIZE + 32 * text.len();
        assert!(work < bound, "{head}: values of size {work} together");
    }
}

/// Rational functions of any parameters, with the sizes of all computed values added up.
struct Counted(Cell<usize>);

impl Counted {
    fn scalars(&self) -> impl Evaluator<Value = Symbolic> {
        Scalars(|name: &str| Ok(Symbolic::parameter(name)), no_function)
    }

    fn count(&self, value: Result<Symbolic, String>) -> Result<Symbolic, String> {
        self.0.set(self.0.get() + value.as_ref().map_or(1, Notation::size));
        value
    }
}

impl Evaluator for Counted {
    type Value = Symbolic;
    fn number(&self, number: &Rational) -> Result<Symbolic, String> {
        self.count(self.scalars().number(number))
    }
    fn name(&self, name: &str) -> Result<Symbolic, String> {
        self.count(self.scalars().name(name))
    }
    fn add(&self, a: Symbolic, b: Symbolic) -> Result<Symbolic, String> {
        self.count(self.scalars().add(a, b))
    }
    fn multiply(&self, a: Symbolic, b: Symbolic) -> Result<Symbolic, String> {
        self.count(self.scalars().multiply(a, b))
    }
    fn negate(&self, a: Symbolic) -> Symbolic {
        self.scalars().negate(a)
    }
    fn reciprocal(&self, a: Symbolic) -> Result<Symbolic, String> {
        self.count(self.scalars().reciprocal(a))
    }
}

/// Texts that are nearly valid.
fn texts() -> impl Strategy<Value = String> {
    let leaf = prop_oneof!["[0-9]{1,3}", "[a-c]", "[0-9]\\.[0-9]", "[0-9]e-?[0-9]", "[ (.^*]"];
    leaf.prop_recursive(4, 24, 3, |inner| {
        prop_oneof![
            (inner.clone(), "[-+*/^ ]", inner.clone()).prop_map(|(a, op, b)| a + &op + &b),
            inner.clone().prop_map(|a| format!("({a})")),
            inner.prop_map(|a| format!("-{a}")),
        ]
    })
}

/// Texts that are nearly valid, with typographic signs and letters of other scripts.
fn typographic_texts() -> impl Strategy<Value = String> {
    let sign = "[-+*/^()., 0-9xe\u{3b8}\u{e9}\u{301}\u{2126}\u{b5}\u{2212}\u{b7}\u{d7}\u{b2}\u{2070}\u{207b}\u{207f}\u{2081}'_]|sin|log|sec|\\*\\*";
    prop::collection::vec(sign, 0..12).prop_map(|signs| signs.concat())
}

fn rationals() -> impl Strategy<Value = Rational> {
    let word = prop_oneof![-20i64..20, any::<i64>()];
    (word, 1i64..50, 0usize..3).prop_map(|(n, d, power)| {
        let value = Rational::new(n, d).unwrap();
        (0..power).fold(value.clone(), |product, _| product * &value)
    })
}

/// Rational functions by sums, products and quotients.
fn functions() -> impl Strategy<Value = Symbolic> {
    let leaf = prop_oneof![
        rationals().prop_map(Symbolic::constant),
        prop::sample::select(vec!["a", "b", "J10", "J2", "_x", "e1"]).prop_map(Symbolic::parameter),
    ];
    leaf.prop_recursive(3, 12, 2, |inner| {
        (inner.clone(), 0..4, inner).prop_map(|(a, operation, b)| match operation {
            0 => a + &b,
            1 => a - &b,
            2 => a * &b,
            _ if b.vanishes() => a,
            _ => a / &b,
        })
    })
}

/// An expression as a tree, with its value if it has one.
#[derive(Clone, Debug)]
enum Tree {
    Number(i64),
    Name(&'static str),
    Operation(&'static str, Box<[Tree; 2]>),
    Power(Box<Tree>, i64),
}

fn trees() -> impl Strategy<Value = Tree> {
    let name = prop::sample::select(vec!["x", "\u{3b8}", "\u{e9}_1", "\u{3c9}\u{2082}"]);
    let leaf = prop_oneof![(0i64..20).prop_map(Tree::Number), name.prop_map(Tree::Name)];
    leaf.prop_recursive(4, 24, 2, |inner| {
        let signs = prop::sample::select(vec!["+", "-", "*", "/"]);
        prop_oneof![
            (inner.clone(), signs, inner.clone())
                .prop_map(|(a, sign, b)| Tree::Operation(sign, Box::new([a, b]))),
            (inner, -3i64..4).prop_map(|(a, n)| Tree::Power(Box::new(a), n)),
        ]
    })
}

/// The style of signs and powers.
#[derive(Clone, Copy, Debug)]
struct Style {
    minus: &'static str,
    times: &'static str,
    power: &'static str,
}

fn styles() -> impl Strategy<Value = Style> {
    let of = |signs: Vec<&'static str>| prop::sample::select(signs);
    let power = of(vec!["^", "**", " ^ ", "superscript", "parentheses", "sum", "tower"]);
    (of(vec!["-", "\u{2212}", " - "]), of(vec!["*", "\u{b7}", " \u{d7} "]), power)
        .prop_map(|(minus, times, power)| Style { minus, times, power })
}

impl Tree {
    fn value(&self, names: &dyn Fn(&str) -> Rational) -> Option<Rational> {
        Some(match self {
            Tree::Number(n) => Rational::from(*n),
            Tree::Name(name) => names(name),
            Tree::Operation(sign, parts) => {
                let [a, b] = [parts[0].value(names)?, parts[1].value(names)?];
                match *sign {
                    "+" => a + &b,
                    "-" => a - &b,
                    "*" => a * &b,
                    _ => a * &b.recip()?,
                }
            }
            Tree::Power(base, n) => {
                let base = base.value(names)?;
                let base = if *n < 0 { base.recip()? } else { base };
                (0..n.abs()).fold(Rational::from(1), |power, _| power * &base)
            }
        })
    }

    /// Writes the tree with all parentheses that are necessary, and some others.
    fn write(&self, style: Style) -> String {
        match self {
            Tree::Number(n) => n.to_string(),
            Tree::Name(name) => name.to_string(),
            Tree::Operation(sign, parts) => {
                let sign = match *sign {
                    "-" => style.minus,
                    "*" => style.times,
                    sign => sign,
                };
                format!("({}{sign}{})", parts[0].write(style), parts[1].write(style))
            }
            Tree::Power(base, n) => {
                let (mut text, minus) = (format!("({})", base.write(style)), style.minus);
                let sign = if *n < 0 { minus.trim() } else { "" };
                let size = n.abs();
                let written = match style.power {
                    "superscript" => {
                        let sign = if *n < 0 { "\u{207b}" } else { "" };
                        write!(
                            text,
                            "{sign}{}",
                            ["\u{2070}", "\u{b9}", "\u{b2}", "\u{b3}"][size as usize]
                        )
                    }
                    "parentheses" => write!(text, "^({sign}{size})"),
                    "sum" => write!(text, "^({}/2 + {}/2)", n - 1, n + 1),
                    "tower" => write!(text, "^{sign}{size}^1**1"),
                    power => write!(text, "{power}{sign}{size}"),
                };
                written.unwrap();
                text
            }
        }
    }
}

/// Values of names at which a wrong sign or a wrong precedence changes the result.
fn at_point(name: &str) -> Rational {
    let sum: u32 = name.chars().map(u32::from).sum();
    Rational::new(i64::from(sum % 97) - 40, 7).unwrap()
}

properties! {
    #![cases(256)]

    #[test]
    fn every_notation_has_the_value_of_the_tree(tree in trees(), style in styles()) {
        let text = tree.write(style);
        let names = Scalars(|name: &str| Ok(at_point(name)), no_function);
        let read = Expression::parse(&text)?.evaluate(&names);
        match tree.value(&at_point) {
            Some(value) => prop_assert_eq!(read?, value.clone(), "{}", text),
            None => prop_assert_eq!(read.map_err(|error| error.reason), Err("division by zero".into())),
        }
    }

    /// `e^(a*b)`, `e^a^b` and `e^(p/q)` in floats agree with the powers of the standard library.
    #[test]
    fn powers_of_floats_are_right_associative(a in 0.1f64..4.0, b in 0.1f64..2.0, p in 1i64..9, q in 2i64..9) {
        let values = Scalars(
            |name: &str| Ok(if name == "a" { a } else { b }),
            |name: &str, arguments: &[f64]| match (name, arguments) {
                ("pow", [base, exponent]) => Ok(base.powf(*exponent)),
                _ => no_function(name, arguments),
            },
        );
        let read = |text: String| Expression::parse(&text).and_then(|text| text.evaluate(&values));
        let exponent = p as f64 / q as f64;
        prop_assert_eq!(read("b^a^b".into())?, b.powf(a.powf(b)));
        prop_assert_eq!(read("a^(a*b)".into())?, a.powf(a * b));
        prop_assert_eq!(read("a**-b".into())?, a.powf(-b));
        prop_assert_eq!(read("-a^b".into())?, -a.powf(b));
        let quotient = read(format!("a^({p}/{q})"))?;
        prop_assert!((quotient - a.powf(exponent)).abs() <= 1e-14 * quotient, "{}/{}", p, q);
    }

    /// Other function names have the values of the quotients that they abbreviate.
    #[test]
    fn abbreviations_are_quotients(x in 0.1f64..1.5, n in 2i32..5) {
        let values = Scalars(|_: &str| Ok(x), |name: &str, arguments: &[f64]| match (name, arguments) {
            ("sin", [x]) => Ok(x.sin()),
            ("cos", [x]) => Ok(x.cos()),
            ("sinh", [x]) => Ok(x.sinh()),
            ("cosh", [x]) => Ok(x.cosh()),
            ("tanh", [x]) => Ok(x.tanh()),
            ("log", [x]) => Ok(x.ln()),
            _ => no_function(name, arguments),
        });
        for (name, value) in [
            ("ln", x.ln()),
            ("sec", 1.0 / x.cos()),
            ("csc", 1.0 / x.sin()),
            ("cot", 1.0 / x.tan()),
            ("sech", 2.0 / (x.exp() + (-x).exp())),
            ("csch", 2.0 / (x.exp() - (-x).exp())),
            ("coth", 1.0 + 2.0 / (2.0 * x).exp_m1()),
        ] {
            let digit = ["\u{b2}", "\u{b3}", "\u{2074}"][n as usize - 2];
            for (text, value) in [
                (format!("{name}(x)"), value),
                (format!("{name}^{n}(x)"), value.powi(n)),
                (format!("{name}**{n} (x)"), value.powi(n)),
                (format!("{name}{digit}(x)"), value.powi(n)),
                (format!("1/{name}^-{n}(x)"), value.powi(n)),
            ] {
                let read = Expression::parse(&text)?.evaluate(&values)?;
                prop_assert!((read - value).abs() <= 1e-12 * value.abs(), "{}: {} {}", text, read, value);
            }
        }
    }

    #[test]
    fn a_rational_reads_back(value in rationals()) {
        prop_assert_eq!(exact(&value.to_string())?, value);
    }

    #[test]
    fn a_function_reads_back(value in functions()) {
        prop_assert_eq!(symbolic(&value.to_string())?, value);
    }

    #[test]
    fn a_float_reads_back(value in any::<f64>().prop_filter("finite", |x| x.is_finite())) {
        let text = value.to_string();
        prop_assert_eq!(Expression::parse(&text)?.evaluate_constant::<f64>()?, value);
        prop_assert_eq!(exact(&text)?.to_f64(), value);
    }

    #[test]
    fn no_text_panics(text in ".*", near in texts(), typographic in typographic_texts()) {
        for text in [text, near, typographic] {
            match symbolic(&text) {
                Err(error) => prop_assert!(text.get(error.span.clone()).is_some(), "{error:?}"),
                // a power may have more digits than numbers in the input
                Ok(value) if value.to_string().len() > MAX_DIGITS => {}
                Ok(value) => prop_assert_eq!(symbolic(&value.to_string())?, value),
            }
            if let Ok(read) = Expression::parse(&text) {
                prop_assert!(text.get(read.span()).is_some());
                let _ = read.evaluate_constant::<f64>();
            }
        }
    }

    /// Every name that scalars accept as a parameter can be parsed.
    #[test]
    fn every_parameter_can_be_written(name in "[a-z\u{3b1}\u{2126}_][a-z0-9\u{3b1}\u{e9}\u{b2}\u{2081}\u{445}_]{0,3}") {
        if let Some(value) = <Symbolic as Notation>::parameter(&name) {
            prop_assert_eq!(symbolic(&name)?, value);
        }
    }
}
