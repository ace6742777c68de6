//! StoredTable tables in JSON and CSV.

use crate::claims::fuzz::mutation::{mutants, texts};
use crate::common::property::properties;
use affinor::{Bracket, CanonicalConnection, ConnectionKind, Geometry, LieAlgebra};
use affinor_documents::Coefficient;
use affinor_documents::report::{Quantity, StoredTable, Table};
use affinor_documents::space::Definition;
use affinor_tensors::{Rational, Symbolic};
use std::sync::LazyLock;

const JSON: &[&str] = &[
    "{\"schema\": \"affinor.table/1\", \"name\": \"so(3)\", \"algebra\": {\"dimension\": 3}, \"connection\": {\"name\": \"zero\"}, \"tensors\": {\"structure\": {\"components\": [[[1, 2, 3], \"1\"], [[2, 1, 3], \"-1\"]]}, \"ricci\": {\"components\": [[[1, 1], \"1/2\"], [[2, 2], 0.5]]}}}",
    "{\"schema\": \"affinor.table/1\", \"tensors\": {\"scalar_curvature\": {\"components\": [[[], \"(a^2 - b)/(4*c)\"]]}}}",
];

const CSV: &[&str] = &[
    "tensor,i,j,k,l,value\nstructure,1,2,3,,1\nstructure,2,1,3,,-1\nricci,1,1,,,1/2\nricci,2,2,,,1/2\n",
    "tensor,i,j,k,l,value\ncurvature,1,2,1,2,\"1/4\"\ncurvature,1,2,2,1,-0.25\nkilling,1,1,,,(a + b)^2\n",
];

const WORDS: &[&str] = &[
    "\"",
    "[",
    "]",
    "{",
    "}",
    "[]",
    ",",
    ":",
    "\n",
    "\r\n",
    " ",
    "0",
    "1",
    "4",
    "-1",
    "1.5",
    "1e3",
    "1e999",
    "18446744073709551615",
    "18446744073709551616",
    "1/0",
    "x^99999",
    "9^9^9",
    "a",
    "(a+b)^9999",
    "null",
    "schema",
    "affinor.table/1",
    "tensors",
    "structure",
    "curvature",
    "ricci",
    "scalar_curvature",
    "metric",
    "weyl",
    "components",
    "dimension",
    "value",
    "\\u0041",
    "\\ud800",
    "\u{1b}[31m",
    "\u{0}",
];

fn rotations<S: Coefficient>() -> Table<S> {
    let unit = |sign: i64| S::from_i64(sign);
    let bracket = Bracket::from_fn(&["x", "y", "z"], |j, k| match (j, k) {
        (0, 1) => vec![(2, unit(1))],
        (0, 2) => vec![(1, unit(-1))],
        _ => vec![(0, unit(1))],
    });
    let algebra = LieAlgebra::try_from(bracket.unwrap()).unwrap();
    let zero = ConnectionKind::Canonical(CanonicalConnection::Zero);
    let geometry = Geometry::new("so(3)", algebra, zero, None).unwrap();
    Table::new(&geometry, &Quantity::ALL).unwrap()
}

static EXACT: LazyLock<Table<Rational>> = LazyLock::new(rotations);
static SYMBOLIC: LazyLock<Table<Symbolic>> = LazyLock::new(rotations);
static FLOAT: LazyLock<Table<f64>> = LazyLock::new(rotations);

fn check(text: &str) {
    let stored = match StoredTable::parse("a table", text) {
        Ok(stored) => stored,
        Err(error) => {
            assert!(!error.message.is_empty());
            return;
        }
    };
    let outcomes =
        [stored.differences(&EXACT), stored.differences(&SYMBOLIC), stored.differences(&FLOAT)];
    for outcome in outcomes {
        match outcome {
            Ok(differences) => {
                assert!(differences.iter().all(|[_, stored, computed]| stored != computed))
            }
            Err(error) => assert!(!error.message.is_empty()),
        }
    }
}

properties! {
    #![cases(256)]

    #[test]
    fn any_text(text in texts()) {
        check(&text);
        check(&format!("{{\"schema\": \"affinor.table/1\", \"tensors\": {text}"));
        check(&format!("tensor,i,j,k,l,value\n{text}"));
    }

    #[test]
    fn nearly_json(text in mutants(JSON, WORDS)) {
        check(&text);
    }

    #[test]
    fn nearly_csv(text in mutants(CSV, WORDS)) {
        check(&text);
    }
}

/// Definitions and stored tables are distinguished.
#[test]
fn a_definition_is_no_table() {
    let definition = "{\"dimension\": 2, \"brackets\": \"\"}";
    assert!(Definition::parse("a.json", definition).is_ok());
    assert!(StoredTable::parse("a.json", definition).is_err());
}
