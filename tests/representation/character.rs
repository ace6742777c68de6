//! Multiplicities of weights agree with GAP, with Weyl's dimension and with known cases.

use crate::common::property::properties;
use crate::representation::common::{all_weights, gap_table, weight, weights};
use affinor::representation::{Decomposition, RepresentationError};
use num_bigint::BigInt;
use std::collections::BTreeMap;

#[test]
fn characters_agree_with_gap() {
    let rows = gap_table("characters.txt");
    assert_eq!(rows.len(), 150);
    for (algebra, weights, expected) in rows {
        let character = weights[0].character().unwrap();
        let found: BTreeMap<Vec<i64>, i128> =
            character.dominant_weights().map(|(w, m)| (w.to_vec(), m)).collect();
        assert_eq!(found, expected, "{algebra} {}", weights[0]);
    }
}

#[test]
fn the_adjoint_representation_has_the_rank_as_multiplicity_of_zero() {
    for (name, labels, rank) in [
        ("E8", &[0, 0, 0, 0, 0, 0, 0, 1][..], 8),
        ("G2", &[0, 1], 2),
        ("C3", &[2, 0, 0], 3),
        ("B3", &[0, 1, 0], 3),
    ] {
        let character = weight(name, labels).character().unwrap();
        let zero = character.dominant_weights().find(|(w, _)| w.iter().all(|l| *l == 0));
        assert_eq!(zero.unwrap().1, rank, "{name}");
    }
}

#[test]
fn the_representation_of_e8_with_779247_dimensions_has_seven_dominant_weights() {
    let character = weight("E8", &[1, 0, 0, 0, 0, 0, 0, 1]).character().unwrap();
    assert_eq!(character.dominant_weights().len(), 7);
    assert_eq!(character.weight_count(), 56_881u32.into());
    assert_eq!(character.dimension(), 779_247.into());
}

#[test]
fn large_characters_are_rejected_before_the_recursion() {
    for (name, labels) in
        [("E8", vec![1; 8]), ("A1", vec![1 << 22]), ("A2", vec![1 << 20, 0]), ("E8", vec![9; 8])]
    {
        let error = weight(name, &labels).character().unwrap_err();
        assert!(matches!(error, RepresentationError::TooLarge { .. }), "{name}: {error}");
    }
}

properties! {
    #![cases(200)]

    #[test]
    fn the_multiplicities_add_up_to_the_dimension(weight in weights(1_000_000)) {
        let dimension = weight.character().unwrap().dimension();
        proptest::prop_assert_eq!(dimension, BigInt::from(weight.dimension()));
    }

    #[test]
    fn orbits_have_the_sizes_of_their_formula(weight in weights(2000)) {
        let character = weight.character().unwrap();
        let all = all_weights(&Decomposition::irreducible(&weight));
        proptest::prop_assert_eq!(character.weight_count(), all.len().into());
    }
}
