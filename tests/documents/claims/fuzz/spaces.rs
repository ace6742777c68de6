//! SPACE names, inline brackets, and the values of options.

use crate::claims::fuzz::assert_sound;
use crate::claims::fuzz::mutation::{mutants, sentences, texts};
use crate::common::property::properties;
use affinor_documents::space::{Request, Space};
use proptest::prelude::*;

const NAMES: &[&str] = &[
    "so3",
    "so(3,1)",
    "su(3)",
    "sl(4)",
    "sp(6)",
    "se(3)",
    "R^3",
    "heisenberg(5)",
    "A2",
    "G2",
    "bianchi(VI,h=-1/2)",
    "bianchi(IX)",
    "M3",
    "SO(3)",
    "so3@plus",
    "so3@lambda=1/3",
    "so3@levi-civita;metric=diag(1,2,3)",
    "so3+R^2+A1",
    "aff(2)",
    "gl3",
    "M(3)@zero",
];

/// Words without two consecutive digits, which would name large algebras.
const WORDS: &[&str] = &[
    "(",
    ")",
    "((",
    ",",
    "+",
    "@",
    ";",
    "=",
    "^",
    "-",
    " ",
    "/",
    "so",
    "su",
    "sl",
    "sp",
    "se",
    "gl",
    "R",
    "A",
    "B",
    "C",
    "D",
    "E",
    "F",
    "G",
    "M",
    "SO",
    "bianchi(",
    "VI",
    "VII",
    "h=",
    "heisenberg",
    "plus",
    "zero",
    "lambda=",
    "levi-civita",
    "metric=",
    "diag(1,",
    "identity",
    "killing",
    "nan",
    "\u{1b}[31m",
    "о",
    "\u{202e}",
    ".toml",
    ".json",
    "0",
    "(1)",
    "(2)",
];

const BRACKETS: &[&str] = &[
    "[x,y]=z",
    "[x,y]=z;[y,z]=x;[z,x]=y",
    "[x, y] = 1/2*z - a x\n[y, z] = (b + 1)^2 x",
    "[x,x]=0",
];

const VALUES: &[&str] = &[
    "diag(1,2,3)",
    "identity",
    "killing",
    "[[1,0,0],[0,2,0],[0,0,1/m]]",
    "diag(J1, J1, (1-t)/2)",
    "plus",
    "levi-civita",
    "lambda=1/3",
    "lambda = t^2",
    "J11=1/2,J12=0",
    "J11=J22",
    "J33=(a+b)^3",
];

const SYMBOLS: &[&str] = &[
    "[",
    "]",
    "(",
    ")",
    ",",
    ";",
    "=",
    "+",
    "-",
    "*",
    "/",
    "^",
    " ",
    "\n",
    "#",
    "x",
    "y",
    "z",
    "w",
    "a",
    "J11",
    "J12",
    "diag(",
    "0",
    "1",
    "2",
    "1/0",
    "1e9",
    "1e99999",
    "nan",
    "x^99999",
    "у",
    "(a+b)^9999",
    "9^9^9",
    "\u{1b}[31m",
    "\u{0}",
    "lambda",
    "metric",
];

fn check(request: Request) {
    match Space::open(&request) {
        Ok(space) => assert!(space.definition.dimension() > 0),
        Err(error) => assert_sound(&error),
    }
}

/// A name that is not a path: the test must not depend on the files of a disk.
fn space(name: String) -> Request {
    let name = name.replace('/', "");
    Request { space: Some(if name == "-" { String::new() } else { name }), ..Request::default() }
}

/// Keeps only the first digit of consecutive digits.
fn with_single_digits(name: &str) -> String {
    let before = std::iter::once(' ').chain(name.chars());
    let pairs = before.zip(name.chars());
    pairs.filter(|(a, b)| !(a.is_ascii_digit() && b.is_ascii_digit())).map(|(_, b)| b).collect()
}

properties! {
    #![cases(256)]

    #[test]
    fn any_name(name in texts()) {
        check(space(name));
    }

    #[test]
    fn nearly_names(name in mutants(NAMES, WORDS)) {
        check(space(with_single_digits(&name)));
    }

    #[test]
    fn words_of_names(name in sentences(WORDS, 8)) {
        check(space(name));
    }

    #[test]
    fn inline_brackets(
        basis in prop_oneof![3 => Just("x y z".to_string()), 1 => sentences(SYMBOLS, 6)],
        bracket in mutants(BRACKETS, SYMBOLS),
    ) {
        let brackets = vec![bracket];
        check(Request { basis: Some(basis), brackets, ..Request::default() });
    }

    #[test]
    fn any_bracket(bracket in texts()) {
        let (basis, brackets) = (Some("x y z".to_string()), vec![bracket]);
        check(Request { basis, brackets, ..Request::default() });
    }

    #[test]
    fn options(value in mutants(VALUES, SYMBOLS)) {
        let of = |request: Request| Request { space: Some("M3".into()), ..request };
        check(of(Request { metric: Some(value.clone()), ..Request::default() }));
        check(of(Request { connection: Some(value.clone()), ..Request::default() }));
        check(of(Request { set: Some(value), ..Request::default() }));
    }

    #[test]
    fn any_options(value in texts()) {
        let of = |request: Request| Request { space: Some("M3".into()), ..request };
        check(of(Request { metric: Some(value.clone()), ..Request::default() }));
        check(of(Request { connection: Some(value.clone()), ..Request::default() }));
        check(of(Request { set: Some(value), ..Request::default() }));
    }
}
