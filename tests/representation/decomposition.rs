//! Characters that are given by weights.

use crate::common::property::properties;
use crate::representation::common::{algebra, all_weights, pairs};
use affinor::representation::{Decomposition, RepresentationError};

properties! {
    #![cases(60)]

    #[test]
    fn the_weights_of_a_sum_decompose_into_its_terms((left, right) in pairs(1000)) {
        let sum = Decomposition::irreducible(&left)
            .plus(&Decomposition::irreducible(&right), 3)
            .unwrap();
        let weights = all_weights(&sum).into_iter().map(|(w, m)| (w, m as i64));
        let found = Decomposition::from_weights(left.algebra(), weights).unwrap();
        proptest::prop_assert_eq!(found, sum);
    }
}

#[test]
fn other_weights_are_rejected() {
    let a1 = algebra("A1");
    let of = |weights: &[(i64, i64)]| {
        Decomposition::from_weights(&a1, weights.iter().map(|(w, m)| (vec![*w], *m)))
    };
    assert_eq!(of(&[]).unwrap().to_string(), "0");
    for weights in [&[(1, 1)][..], &[(2, 1), (-2, 1)], &[(1, 1), (-1, 2)], &[(0, -1)]] {
        let error = of(weights).unwrap_err();
        assert!(matches!(error, RepresentationError::NotACharacter { .. }), "{weights:?}");
    }
    let error = Decomposition::from_weights(&a1, [(vec![1, 0], 1)]).unwrap_err();
    assert!(matches!(error, RepresentationError::Length { given: 2, expected: 1, .. }));
}
