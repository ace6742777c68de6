//! The invariants of 194 algebras by GAP 4.12.1, in `tests/data/structure/gap.json`: each algebra in its own basis, in a
//! dense basis, and in a dense basis beside an abelian and a simple summand.

use super::invariants::{scrambled, stored};
use crate::common::algebras::catalogued;
use affinor::algebra::structure::{StructureTheory, Subspace};
use affinor::{LieAlgebra, Rational};
use serde_json::{Value, json};
use std::collections::BTreeMap;

type Algebra = LieAlgebra<Rational>;

/// The algebras with the answers of GAP.
fn answered() -> Vec<(Algebra, Value)> {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/data/structure/gap.json");
    let data: Value = serde_json::from_str(&std::fs::read_to_string(path).unwrap()).unwrap();
    let name = |entry: &Value| entry["name"].as_str().unwrap().to_string();
    let brackets: BTreeMap<String, Algebra> =
        stored().into_iter().map(|(algebra, entry)| (name(&entry), algebra)).collect();
    let algebra = |entry: &Value| match entry["from"].as_str() {
        Some("catalogue") => catalogued(&name(entry)),
        _ => brackets[&name(entry)].clone(),
    };
    let entries = data["algebras"].as_array().unwrap();
    entries.iter().map(|entry| (algebra(entry), entry.clone())).collect()
}

fn dimensions(series: &[Subspace<Rational>]) -> Vec<usize> {
    series.iter().map(Subspace::dimension).collect()
}

fn levi_type(structure: &StructureTheory<Rational>) -> Vec<String> {
    structure.dynkin_type().unwrap().iter().map(ToString::to_string).collect()
}

/// Compares all that GAP has answered.
fn compare(algebra: &Algebra, expected: &Value) {
    let name = &expected["name"];
    let structure = StructureTheory::new(algebra.clone());
    let types = levi_type(&structure);
    let found = json!({
        "dimension": structure.dimension(),
        "derived_series": dimensions(structure.derived_series()),
        "lower_central_series": dimensions(structure.lower_central_series()),
        "upper_central_series": dimensions(&structure.upper_central_series()),
        "radical": structure.radical().dimension(),
        "nilradical": structure.nilradical().dimension(),
        "centre": structure.centre().dimension(),
        "killing_rank": structure.killing().rank(),
        "derivations": structure.derivation_dimension().map(|all| all.dimension),
        "cartan_subalgebra": structure.cartan_subalgebra().dimension(),
        "levi_type": if types.is_empty() { "none".into() } else { types.join(" + ") },
    });
    for (key, value) in found.as_object().unwrap() {
        assert_eq!(value, &expected[key], "{key} of {name}");
    }
    if let Some(parts) = structure.indecomposable_ideals().unwrap() {
        let mut parts: Vec<usize> = parts.iter().map(|part| part.ideal.dimension()).collect();
        parts.sort_unstable();
        assert_eq!(json!(parts), expected["indecomposable_over_Q"], "parts of {name}");
    }
}

#[test]
fn in_the_basis_of_the_catalogue() {
    let answered = answered();
    assert!(answered.len() >= 150);
    answered.iter().for_each(|(algebra, expected)| compare(algebra, expected));
}

#[test]
fn in_a_dense_basis() {
    for (at, (algebra, expected)) in answered().iter().enumerate() {
        compare(&scrambled(algebra, at as i64), expected);
    }
}

/// The answers of a sum follow from those of the summands.
#[test]
fn beside_an_abelian_and_a_simple_summand() {
    let beside = catalogued("R^2+sl(2)");
    for (at, (algebra, expected)) in answered().iter().enumerate() {
        let sum = scrambled(&algebra.direct_sum(&beside).unwrap(), at as i64 + 1);
        let sum = StructureTheory::new(sum);
        let name = &expected["name"];
        let number = |key: &str| expected[key].as_u64().unwrap() as usize;
        assert_eq!(sum.centre().dimension(), number("centre") + 2, "{name}");
        assert_eq!(sum.radical().dimension(), number("radical") + 2, "{name}");
        assert_eq!(sum.nilradical().dimension(), number("nilradical") + 2, "{name}");
        assert_eq!(sum.killing().rank(), number("killing_rank") + 3, "{name}");
        // the derived series of sl(2) is constant, that of R^2 ends at once
        let derived: Vec<u64> = serde_json::from_value(expected["derived_series"].clone()).unwrap();
        let last = dimensions(sum.derived_series()).last().map(|last| *last as u64);
        assert_eq!(last, derived.last().map(|last| last + 3), "{name}");
        let mut types = levi_type(&sum);
        let place = types.iter().position(|one| one == "A1").unwrap();
        types.remove(place);
        let alone = if types.is_empty() { "none".into() } else { types.join(" + ") };
        assert_eq!(alone, expected["levi_type"], "{name}");
        assert_eq!(sum.levi().unwrap().dimension() + sum.radical().dimension(), sum.dimension());
    }
}
