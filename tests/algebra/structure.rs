//! Invariants of algebras are compared with stored ones. `tests/data/structure/invariants.json` has
//! 140 algebras, computed by an independent program with fractions and compared there with GAP
//! 4.12.1. `tests/data/structure/gap.json` has 194 algebras, computed by GAP. Each is tested in its
//! own basis, in a dense basis, and in a dense basis of its sum with an abelian and a simple
//! algebra.

mod certificates;
mod decomposition;
mod ideals;
mod identification;
mod orthogonal_forms;
mod real_forms;
mod root_spaces;
mod satake;
mod symplectic;
mod vogan;

use crate::common::algebras::catalogued;
use crate::common::labels;
use affinor::algebra::structure::{Existence, StructureTheory, Subspace};
use affinor::{BasisChange, Bracket, LieAlgebra, Rational, Tensor};
use affinor_tensors::linear::Matrix;
use affinor_tensors::{Down, Up};
use serde_json::{Value, json};
use std::collections::BTreeMap;

type Algebra = LieAlgebra<Rational>;

/// The stored algebras with their invariants.
pub fn stored() -> Vec<(Algebra, Value)> {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/data/structure/invariants.json");
    let data: Value = serde_json::from_str(&std::fs::read_to_string(path).unwrap()).unwrap();
    data["algebras"]
        .as_array()
        .unwrap()
        .iter()
        .map(|entry| (algebra(entry), entry.clone()))
        .collect()
}

fn algebra(entry: &Value) -> Algebra {
    let n = entry["dimension"].as_u64().unwrap() as usize;
    let constants = entry["structure_constants"].as_array().unwrap().iter().map(|row| {
        let at = |slot: usize| row[slot].as_u64().unwrap() as usize - 1;
        (at(0), at(1), at(2), rational(row[3].as_str().unwrap()))
    });
    Bracket::from_constants(labels(n), constants).unwrap().try_into().unwrap()
}

fn rational(text: &str) -> Rational {
    let (above, below) = text.split_once('/').unwrap_or((text, "1"));
    Rational::new(above.parse().unwrap(), below.parse().unwrap()).unwrap()
}

/// The algebra in a dense basis with small entries, which is the same in every run.
pub fn scrambled(algebra: &Algebra, seed: i64) -> Algebra {
    let n = algebra.dimension();
    let entry =
        |i: usize, j: usize| ((i as i64 * 7 + j as i64 * 5 + seed + (i * j) as i64 * 3) % 5) - 2;
    // lower times upper triangular with ones: unimodular
    let lower = |i: usize, j: usize| match i.cmp(&j) {
        std::cmp::Ordering::Greater => entry(i, j) % 2,
        std::cmp::Ordering::Equal => 1,
        _ => 0,
    };
    let a = |[i, j]: [usize; 2]| {
        let terms = (0..n).map(|k| lower(i, k) * lower(j, k));
        Rational::from(terms.sum::<i64>())
    };
    let change = Tensor::from_fn(n, [Up, Down], a).unwrap();
    algebra.change_basis(&BasisChange::new(change).unwrap()).unwrap()
}

fn dimensions(series: &[Subspace<Rational>]) -> Vec<usize> {
    series.iter().map(Subspace::dimension).collect()
}

/// The compared invariants: the keys of the data that do not depend on the basis.
pub fn invariants(algebra: Algebra) -> Value {
    let structure = StructureTheory::new(algebra);
    let [plus, minus, zero] = structure.killing().signature().unwrap();
    let types = structure.dynkin_type().unwrap_or_default();
    let types: Vec<String> = types.iter().map(ToString::to_string).collect();
    serde_json::json!({
        "derived_series": dimensions(structure.derived_series()),
        "lower_central_series": dimensions(structure.lower_central_series()),
        "upper_central_series": dimensions(&structure.upper_central_series()),
        "abelian": structure.is_abelian(),
        "nilpotent": structure.is_nilpotent(),
        "solvable": structure.is_solvable(),
        "perfect": structure.is_perfect(),
        "unimodular": structure.is_unimodular(),
        "centre": structure.centre().dimension(),
        "killing_signature": [plus, minus, zero],
        "radical": structure.radical().dimension(),
        "nilradical": structure.nilradical().dimension(),
        "derivations": structure.derivation_dimension().map(|all| all.dimension),
        "inner_derivations": structure.dimension() - structure.centre().dimension(),
        "invariant_forms": structure.invariant_form_dimension().map(|all| all.dimension),
        "index": structure.index().dimension,
        "cartan_subalgebra": structure.cartan_subalgebra().dimension(),
        "levi_type": if types.is_empty() { Value::Null } else { types.join(" + ").into() },
        "betti": if structure.dimension() > 10 { Value::Null } else { structure.betti_numbers().map(|found| found.0).into() },
    })
}

pub fn expect(found: &Value, expected: &Value, name: &str) {
    for (key, value) in found.as_object().unwrap() {
        if expected.get(key).is_some_and(|expected| !expected.is_null()) || key == "levi_type" {
            assert_eq!(value, &expected[key], "{key} of {name}");
        }
    }
}

#[test]
fn of_all_stored_algebras() {
    let stored = stored();
    assert!(stored.len() >= 140);
    for (algebra, entry) in stored {
        let name = entry["name"].as_str().unwrap();
        let structure = StructureTheory::new(algebra.clone());
        assert_eq!(
            structure.killing().determinant(),
            rational(entry["killing_determinant"].as_str().unwrap()),
            "{name}"
        );
        expect(&invariants(algebra), &entry, name);
    }
}

#[test]
fn do_not_depend_on_the_basis() {
    for (at, (algebra, entry)) in stored().into_iter().enumerate() {
        let name = entry["name"].as_str().unwrap();
        expect(&invariants(scrambled(&algebra, at as i64)), &entry, name);
    }
}

#[test]
fn add_up_beside_an_abelian_and_a_simple_summand() {
    let beside = catalogued("R^2+sl(2)");
    for (algebra, entry) in stored().into_iter().filter(|(algebra, _)| algebra.dimension() <= 6) {
        let name = entry["name"].as_str().unwrap();
        let alone = StructureTheory::new(algebra.clone());
        let sum = StructureTheory::new(scrambled(&algebra.direct_sum(&beside).unwrap(), 3));
        let of = |structure: &StructureTheory<Rational>| {
            let [plus, minus, zero] = structure.killing().signature().unwrap();
            let nilradical = structure.nilradical().dimension();
            let rank = structure.cartan_subalgebra().dimension();
            let (centre, radical) =
                (structure.centre().dimension(), structure.radical().dimension());
            vec![centre, radical, nilradical, structure.index().dimension, rank, plus, minus, zero]
        };
        let expected: Vec<usize> =
            of(&alone).iter().zip([2, 2, 2, 3, 3, 2, 1, 2]).map(|(a, b)| a + b).collect();
        assert_eq!(of(&sum), expected, "{name}");
        let types = sum.dynkin_type().unwrap();
        assert_eq!(types.len(), alone.dynkin_type().unwrap().len() + 1, "{name}");
        assert_eq!(sum.levi().unwrap().dimension(), alone.levi().unwrap().dimension() + 3);
    }
}

/// A matrix with these rows whose determinant is not zero.
pub fn regular(rows: &[Vec<Rational>]) -> bool {
    Matrix::from_dense(rows).unwrap().rank().unwrap() == rows.len()
}

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

fn levi_type(structure: &StructureTheory<Rational>) -> Vec<String> {
    structure.dynkin_type().unwrap().iter().map(ToString::to_string).collect()
}

/// Compares all answers of GAP.
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
fn gap_in_the_basis_of_the_catalogue() {
    let answered = answered();
    assert!(answered.len() >= 150);
    answered.iter().for_each(|(algebra, expected)| compare(algebra, expected));
}

#[test]
fn gap_in_a_dense_basis() {
    for (at, (algebra, expected)) in answered().iter().enumerate() {
        compare(&scrambled(algebra, at as i64), expected);
    }
}

/// The answers for a sum follow from the answers for its summands.
#[test]
fn gap_beside_an_abelian_and_a_simple_summand() {
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
        // the derived series of sl(2) is constant; the derived series of R^2 is zero after one step
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

/// The algebra without vectors is abelian, and not semisimple: it has no simple ideals. Its only 2-form is symplectic.
#[test]
fn of_dimension_zero() {
    let bracket = Bracket::from_constants(labels(0), []).unwrap();
    let algebra: Algebra = LieAlgebra::try_from(bracket).unwrap();
    let structure = StructureTheory::new(algebra);
    assert!(!structure.is_semisimple());
    assert!(structure.is_abelian() && structure.is_solvable() && structure.is_nilpotent());
    // the form without components is not degenerate
    let exact = structure.exact_symplectic_form(&structure.two_forms().unwrap());
    assert_eq!(exact, Existence::Witness(vec![]));
}

/// The brackets of two subspaces are those of all pairs of basis vectors, as of coordinate planes of rotations.
#[test]
fn brackets_of_subspaces() {
    let structure = StructureTheory::new(catalogued("so(4)"));
    let algebra = structure.algebra();
    let span = |units: &[usize]| Subspace::span(6, units.iter().map(|&at| vec![(at, 1.into())]));
    let sets: Vec<Vec<usize>> =
        (0..64_usize).map(|set| (0..6).filter(|at| set >> at & 1 == 1).collect()).collect();
    for (v, w) in sets.iter().flat_map(|v| sets.iter().map(move |w| (v, w))) {
        let constants = algebra.structure_constants().components();
        let images = constants.filter(|(at, _)| v.contains(&at[1]) && w.contains(&at[2]));
        // each bracket of basis vectors is a multiple of a basis vector
        let expected: Vec<usize> = images.map(|(at, _)| at[0]).collect();
        assert_eq!(structure.bracket(&span(v), &span(w)), span(&expected), "{v:?} {w:?}");
    }
}
