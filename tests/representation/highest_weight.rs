//! Dimensions, duals, Casimir eigenvalues and indices agree with tables and with sums over weights.

use crate::common::fraction;
use crate::common::property::properties;
use crate::representation::common::{algebra, all_weights, weight, weights};
use affinor::representation::{Decomposition, HighestWeight, MAX_LABEL, RepresentationError};
use num_bigint::BigUint;

#[test]
fn dimensions_agree_with_mckay_and_patera() {
    // W. G. McKay, J. Patera, Tables of dimensions, indices and branching rules (1981), in the
    // numbering of Bourbaki
    let rows: [(&str, &[i64], u64, u64); 22] = [
        ("A2", &[3, 0], 10, 15),
        ("A2", &[2, 2], 27, 54),
        ("A4", &[0, 1, 0, 1], 45, 24),
        ("B3", &[0, 0, 1], 8, 2),
        ("B4", &[0, 0, 0, 1], 16, 4),
        ("C3", &[0, 0, 1], 14, 5),
        ("C4", &[0, 0, 0, 1], 42, 14),
        ("D4", &[0, 1, 0, 0], 28, 12),
        ("D5", &[0, 0, 0, 0, 2], 126, 70),
        ("G2", &[1, 0], 7, 2),
        ("G2", &[0, 1], 14, 8),
        ("G2", &[2, 0], 27, 18),
        ("G2", &[1, 1], 64, 64),
        ("F4", &[0, 0, 0, 1], 26, 6),
        ("F4", &[1, 0, 0, 0], 52, 18),
        ("F4", &[0, 0, 1, 0], 273, 126),
        ("E6", &[1, 0, 0, 0, 0, 0], 27, 6),
        ("E6", &[0, 1, 0, 0, 0, 0], 78, 24),
        ("E6", &[0, 0, 1, 0, 0, 0], 351, 150),
        ("E7", &[0, 0, 0, 0, 0, 0, 1], 56, 12),
        ("E7", &[0, 1, 0, 0, 0, 0, 0], 912, 360),
        ("E8", &[0, 0, 0, 0, 0, 0, 0, 1], 248, 60),
    ];
    for (name, labels, dimension, index) in rows {
        let weight = weight(name, labels);
        assert_eq!(weight.dimension(), dimension.into(), "{name} {labels:?}");
        assert_eq!(weight.index(), [index.into()], "{name} {labels:?}");
    }
    let fundamental = [3875u64, 147_250, 6_696_000, 6_899_079_264, 146_325_270, 2_450_240, 30_380];
    for (i, dimension) in fundamental.into_iter().enumerate() {
        let mut labels = vec![0; 8];
        labels[i] = 1;
        assert_eq!(weight("E8", &labels).dimension(), dimension.into());
    }
    // the dimension of the representation ρ is 2 to the number of positive roots
    assert_eq!(weight("E8", &[1; 8]).dimension(), BigUint::from(2u8).pow(120));
}

#[test]
fn casimir_eigenvalues_of_the_adjoint_representation_are_twice_the_dual_coxeter_numbers() {
    for (name, number) in [
        ("A4", 5),
        ("B3", 5),
        ("B4", 7),
        ("C3", 4),
        ("C8", 9),
        ("D5", 8),
        ("E6", 12),
        ("E7", 18),
        ("E8", 30),
        ("F4", 9),
        ("G2", 4),
    ] {
        let adjoint = HighestWeight::adjoint(&algebra(name)).remove(0);
        assert_eq!(adjoint.casimir(), [fraction(2 * number, 1)], "{name}");
        assert_eq!(adjoint.dimension(), algebra(name).dimension().into());
    }
    // spin s: 2 s (s + 1)
    assert_eq!(weight("A1", &[3]).casimir(), [fraction(15, 2)]);
}

#[test]
fn labels_must_be_dominant_and_as_many_as_the_rank() {
    let algebra = algebra("A2 + T1");
    let error = |labels: &[i64]| HighestWeight::new(&algebra, labels).unwrap_err();
    assert!(matches!(error(&[1, 0]), RepresentationError::Length { given: 2, expected: 3, .. }));
    assert_eq!(error(&[1, -2, 0]), RepresentationError::NotDominant { position: 2, label: -2 });
    assert!(matches!(
        error(&[MAX_LABEL + 1, 0, 0]),
        RepresentationError::LargeLabel { position: 1, .. }
    ));
    assert!(matches!(error(&[0, 0, i64::MIN]), RepresentationError::LargeLabel { .. }));
    assert!(HighestWeight::new(&algebra, [MAX_LABEL, MAX_LABEL, -MAX_LABEL]).is_ok());
}

properties! {
    #![cases(150)]

    /// The index is half the sum of the squares of the values of the weights at the coroot of the
    /// highest root.
    #[test]
    fn the_index_is_a_sum_over_weights(weight in weights(3000)) {
        let all = all_weights(&Decomposition::irreducible(&weight));
        for (at, index) in weight.index().into_iter().enumerate() {
            let factor = weight.algebra().simple_factors()[at];
            let start = weight.algebra().positions(at).start;
            let roots = affinor::algebra::roots::RootSystem::new(factor);
            let coroot = roots.positive_roots().last().unwrap().coroot();
            let values = all.iter().map(|(nu, m)| {
                let value: i64 = coroot.iter().zip(&nu[start..]).map(|(c, l)| c * l).sum();
                i128::from(value * value) * m
            });
            proptest::prop_assert_eq!(BigUint::try_from(values.sum::<i128>() / 2).unwrap(), index);
        }
    }

    #[test]
    fn the_dual_has_the_negative_weights(weight in weights(1000)) {
        let dual = weight.dual();
        proptest::prop_assert_eq!(dual.dual(), weight.clone());
        proptest::prop_assert_eq!(dual.casimir(), weight.casimir());
        let negative: Vec<_> = all_weights(&Decomposition::irreducible(&weight))
            .into_iter()
            .map(|(w, m)| (w.iter().map(|l| -l).collect::<Vec<i64>>(), m))
            .rev()
            .collect();
        let of_dual: Vec<_> = all_weights(&Decomposition::irreducible(&dual)).into_iter().collect();
        proptest::prop_assert_eq!(of_dual, negative);
    }
}
