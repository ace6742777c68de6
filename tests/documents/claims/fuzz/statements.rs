//! Statements about spaces.

use crate::claims::fuzz::assert_sound;
use crate::claims::fuzz::mutation::{mutants, texts};
use crate::common::property::properties;
use affinor_documents::report::{Computation, Statements};
use affinor_documents::space::{Request, Space};
use std::sync::LazyLock;

const STATEMENTS: &[&str] = &[
    "torsion = 0\nRic_11 = Ric_22 = (a - b)/2 # equal\nR^i_jkl = -1/4*c^m_kl c^i_mj\n",
    "R_ijkl R^ijkl = Kr\nnot locally symmetric\nS^2 >= Ric^{1}_{1} + 2*g_xy\n(nabla tau)^1_123 != 0\n",
];

const WORDS: &[&str] = &[
    "=",
    "!=",
    "<=",
    ">",
    "_",
    "^",
    "{",
    "}",
    "(",
    ")",
    ",",
    " ",
    "\n",
    "#",
    "0",
    "1",
    "9",
    "-",
    "*",
    "/",
    "1/0",
    "99999999999999999999",
    "9^9^9",
    "a",
    "x",
    "i",
    "α",
    "R",
    "R^",
    "_ijkl",
    "c^i_jk",
    "(nabla",
    "(nabla tau)",
    "nabla_torsion",
    "ricci",
    "flat",
    "not",
    "sqrt(2)",
    "pi",
    "g^ij",
    "\u{a0}",
    "\u{1b}[31m",
    "Ω",
];

static SPACES: LazyLock<[Space; 2]> = LazyLock::new(|| {
    ["x y z", "i j k"].map(|basis| {
        let basis = Some(basis.to_string());
        let metric = Some("diag(a,b,1)".to_string());
        Space::open(&Request { basis, metric, ..Request::default() }).unwrap()
    })
});

fn check(text: &str) {
    let statements = match Statements::parse("claims", text) {
        Ok(statements) => statements,
        Err(error) => return assert_sound(&error),
    };
    for space in &*SPACES {
        match Computation::of(space).test(&statements) {
            Ok(verdicts) => {
                assert!(verdicts.iter().count() + verdicts.errors().len() > 0);
                verdicts.errors().iter().for_each(assert_sound);
            }
            Err(error) => assert_sound(&error),
        }
    }
}

properties! {
    #![cases(256)]

    #[test]
    fn any_text(text in texts()) {
        check(&text);
        check(&format!("Ric_11 = {text}"));
    }

    #[test]
    fn nearly_statements(text in mutants(STATEMENTS, WORDS)) {
        check(&text);
    }
}
