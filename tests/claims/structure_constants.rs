//! Structure constants have the same meaning in every interface: constructors, definition files,
//! the command line.
//!
//! Guards `Bracket`, `Definition` and `Space`.

use crate::common::algebras::algebras;
use crate::common::{integer, labels, property::properties};
use affinor::{Bracket, Error, Law};
use affinor_documents::input::InputError;
use affinor_documents::space::{Definition, Request, Space};
use affinor_tensors::{Down, Rational, Ring, Scalar, Tensor, Tolerance, Up};
use proptest::prelude::*;
use std::collections::BTreeSet;
use std::fmt::Display;

/// `(j, k, i, v)`: `[e_j, e_k] = ... + v e_i`, with indices from 0.
type Constant<S> = (usize, usize, usize, S);

/// The result of reading constants through an interface: the structure, or the error message.
type Read<S> = Result<Tensor<S>, String>;

fn of_bracket<S: Scalar>(bracket: Result<Bracket<S>, Error>) -> Read<S> {
    bracket.map(|bracket| bracket.structure_constants().clone()).map_err(|error| error.to_string())
}

fn exact(definition: &Definition) -> Result<Bracket<Rational>, InputError> {
    definition.bracket(Tolerance::default())
}

fn of_definition(definition: Result<Definition, InputError>) -> Read<Rational> {
    let bracket = definition.and_then(|definition| exact(&definition));
    bracket.map(|bracket| bracket.structure_constants().clone()).map_err(|error| error.message)
}

/// The constants as rows of a definition file.
fn rows<S: Display>(constants: &[Constant<S>]) -> String {
    let row = |(j, k, i, v): &Constant<S>| format!("[{}, {}, {}, \"{v}\"]", j + 1, k + 1, i + 1);
    constants.iter().map(row).collect::<Vec<_>>().join(", ")
}

/// The constants as statements, one for each ordered pair.
fn statements(constants: &[Constant<Rational>]) -> Vec<String> {
    let pairs: BTreeSet<_> = constants.iter().map(|(j, k, ..)| (*j, *k)).collect();
    let statement = |(j, k): &(usize, usize)| {
        let of_pair = constants.iter().filter(|c| (c.0, c.1) == (*j, *k));
        let terms: Vec<_> = of_pair.map(|(.., i, v)| format!("({v})*e{}", i + 1)).collect();
        format!("[e{}, e{}] = {}", j + 1, k + 1, terms.join(" + "))
    };
    pairs.iter().map(statement).collect()
}

/// The constants read through every interface that accepts them in any order.
fn doors(n: usize, constants: &[Constant<Rational>]) -> Vec<(&'static str, Read<Rational>)> {
    let quoted: Vec<_> = statements(constants).iter().map(|line| format!("{line:?}")).collect();
    let (rows, quoted) = (rows(constants), quoted.join(", "));
    let basis: Vec<_> = labels(n).to_vec();
    let inline = Space::open(&Request {
        basis: Some(basis.join(" ")),
        brackets: statements(constants),
        ..Request::default()
    });
    let toml = format!("dimension = {n}\nstructure_constants = [{rows}]\n");
    let json = format!("{{\"dimension\": {n}, \"structure_constants\": [{rows}]}}");
    let brackets = format!("dimension = {n}\nbrackets = [{quoted}]\n");
    vec![
        ("from_constants", of_bracket(Bracket::from_constants(labels(n), constants.to_vec()))),
        ("rows in TOML", of_definition(Definition::parse("a.toml", &toml))),
        ("rows in JSON", of_definition(Definition::parse("a.json", &json))),
        ("statements in TOML", of_definition(Definition::parse("b.toml", &brackets))),
        ("inline", of_definition(inline.map(|space| space.definition))),
    ]
}

/// The orders in which the pairs of an algebra are given, and a shuffle of the rows.
fn tables() -> impl Strategy<Value = (Tensor<Rational>, Vec<Constant<Rational>>)> {
    let raw = algebras(5).prop_flat_map(|algebra| {
        let n = algebra.dimension();
        (Just(algebra.structure_constants().clone()), prop::collection::vec(0..3usize, n * n))
    });
    raw.prop_flat_map(|(structure, orders)| {
        let n = structure.dimension();
        let constants = structure.components().filter(|(at, _)| {
            let [j, k] = [at[1], at[2]];
            match orders[j.min(k) * n + j.max(k)] {
                0 => j < k,
                1 => j > k,
                _ => true,
            }
        });
        let constants: Vec<_> = constants.map(|(at, v)| (at[1], at[2], at[0], v.clone())).collect();
        (Just(structure), Just(constants).prop_shuffle())
    })
}

properties! {
    #![cases(128)]

    /// Half a table, a full table, or a mixture of both, with rows in any order.
    #[test]
    fn every_door_reads_the_same((structure, constants) in tables()) {
        let n = structure.dimension();
        for (door, read) in doors(n, &constants) {
            prop_assert_eq!(read.as_ref(), Ok(&structure), "{}", door);
        }
        // interfaces that require an order
        let full = Bracket::new(labels(n), structure.clone());
        prop_assert_eq!(&of_bracket(full), &Ok(structure.clone()));
        let names = labels(n);
        let names: Vec<&str> = names.iter().map(String::as_str).collect();
        let half = |j, k| (0..n).map(|i| (i, structure.get(&[i, j, k]))).collect();
        prop_assert_eq!(&of_bracket(Bracket::from_fn(&names, half)), &Ok(structure.clone()));
        // the same in floats
        let floats = constants.iter().map(|(j, k, i, v)| (*j, *k, *i, v.to_f64()));
        let floats = Bracket::from_constants(labels(n), floats.collect::<Vec<_>>());
        prop_assert_eq!(of_bracket(floats), Ok(structure.map(Rational::to_f64)));
    }

    /// A pair of indices is given in two orders, but the values are not opposite: a component is
    /// given in both orders or in only one.
    #[test]
    fn a_pair_that_disagrees_is_refused((structure, _) in tables(), pick in any::<prop::sample::Index>(), new in any::<bool>()) {
        let n = structure.dimension();
        let mut constants: Vec<_> =
            structure.components().map(|(at, v)| (at[1], at[2], at[0], v.clone())).collect();
        prop_assume!(!constants.is_empty());
        let (j, k, i, v) = constants.swap_remove(pick.index(constants.len()));
        let free = (0..n).find(|i| structure.get(&[*i, j, k]).vanishes());
        match free.filter(|_| new) {
            Some(free) => constants.extend([(j, k, i, v.clone()), (j, k, free, v.clone())]),
            None => constants.push((j, k, i, v.clone() + &integer(1))),
        }
        let (x, y) = (format!("e{}", j.min(k) + 1), format!("e{}", j.max(k) + 1));
        let pair = format!("the bracket is not antisymmetric: [{x}, {y}] + [{y}, {x}] = ");
        for (door, read) in doors(n, &constants) {
            let said = read.unwrap_err();
            prop_assert!(said.starts_with(&pair) && said.contains(&format!("[{y}, {x}] = ")), "{door}: {said}");
        }
        let full = constants.iter().map(|(j, k, i, v)| ([*i, *j, *k], v.clone()));
        let full = Tensor::from_components(n, &[Up, Down, Down], full).unwrap();
        match Bracket::new(labels(n), full) {
            Err(Error::Broken { law: Law::Antisymmetry, at, .. }) => prop_assert_eq!(at, [x, y]),
            other => prop_assert!(false, "{:?}", other),
        }
    }
}

#[test]
fn what_a_disagreeing_pair_says() {
    let given = [(0, 1, 2, 1.0), (1, 0, 2, 1.0), (0, 2, 1, 0.0)];
    let refused = Bracket::from_constants(labels(3), given).unwrap_err();
    let at = ["e1", "e2", "e3", "e3"].map(String::from);
    let expected = Law::OppositeOrders.broken(at, "2*e3");
    assert_eq!(refused, expected);
    let said = "the bracket is not antisymmetric: [e1, e2] + [e2, e1] = 2*e3, \
                for [e1, e2] = e3 and [e2, e1] = e3";
    assert_eq!(refused.to_string(), said);
    // zero is a value too
    let given = [(0, 1, 2, integer(1)), (1, 0, 2, integer(0))];
    let refused = Bracket::from_constants(labels(3), given).unwrap_err().to_string();
    assert_eq!(
        refused,
        "the bracket is not antisymmetric: [e1, e2] + [e2, e1] = e3, for [e1, e2] = e3 and [e2, e1] = 0"
    );
    // rounding errors are not a disagreement
    let given = [(0, 1, 2, 0.1 + 0.2), (1, 0, 2, -0.3)];
    let bracket = Bracket::from_constants(labels(3), given).unwrap();
    assert_eq!(
        bracket.structure_constants().get(&[2, 0, 1]),
        -bracket.structure_constants().get(&[2, 1, 0])
    );
}

/// A repeated row is an error where rows are given, even if the values are equal.
#[test]
fn a_component_given_twice_is_refused() {
    for second in [1, 2] {
        let given = vec![(0, 1, 2, integer(1)), (1, 2, 0, integer(1)), (0, 1, 2, integer(second))];
        let by_file = format!("dimension = 3\nstructure_constants = [{}]\n", rows(&given));
        let by_file = of_definition(Definition::parse("a.toml", &by_file)).unwrap_err();
        assert!(by_file.contains("[1, 2, 3, ") && by_file.contains("twice"), "{by_file}");
        match Bracket::from_constants(labels(3), given) {
            Err(Error::Broken { law: Law::GivenOnce, at, residual }) => {
                assert_eq!(at, ["e1", "e2", "e3", "1"]);
                assert_eq!(residual, second.to_string());
            }
            other => panic!("{other:?}"),
        }
        let names = ["x", "y", "z"];
        let twice = |j: usize, k: usize| match (j, k) {
            (0, 1) => vec![(2, integer(1)), (2, integer(second))],
            _ => vec![],
        };
        let refused = Bracket::from_fn(&names, twice).unwrap_err();
        assert!(matches!(refused, Error::Broken { law: Law::GivenOnce, .. }), "{refused}");
    }
}

/// The bracket of a vector with itself, and indices without a label.
#[test]
fn what_is_no_bracket_is_refused() {
    let same = Bracket::from_constants(labels(2), [(1, 1, 0, integer(1))]).unwrap_err();
    assert!(matches!(same, Error::Broken { law: Law::Antisymmetry, .. }), "{same}");
    for given in [(2, 0, 0, 1.0), (0, 2, 0, 1.0), (0, 1, 2, 1.0)] {
        let refused = Bracket::from_constants(labels(2), [given]).unwrap_err().to_string();
        assert_eq!(refused, "index 2 is out of range for dimension 2");
    }
}
