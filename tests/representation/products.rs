//! Tensor products agree with GAP, with LiE's components of E8, and with characters on a torus.

use crate::common::property::properties;
use crate::representation::common::{
    PRIME, character_at, gap_table, pairs, representation, torus, weight,
};
use affinor::algebra::roots::{CartanType, Series};
use affinor::representation::{
    Decomposition, HighestWeight, ReductiveAlgebra, RepresentationError,
};
use num_bigint::BigInt;
use std::collections::BTreeMap;

fn labels(decomposition: &Decomposition) -> BTreeMap<Vec<i64>, i128> {
    decomposition.components().map(|(w, m)| (w.labels().to_vec(), m)).collect()
}

#[test]
fn products_agree_with_gap() {
    let rows = gap_table("products.txt");
    assert_eq!(rows.len(), 500);
    for (algebra, weights, expected) in rows {
        let product = weights[0].tensor(&weights[1]).unwrap();
        assert_eq!(labels(&product), expected, "{algebra} {} {}", weights[0], weights[1]);
    }
}

#[test]
fn the_square_of_the_representation_of_e8_with_779247_dimensions_has_40_components() {
    let v = weight("E8", &[1, 0, 0, 0, 0, 0, 0, 1]);
    let square = v.tensor(&v).unwrap();
    assert_eq!(square.components().len(), 40);
    let dimension = BigInt::from(v.dimension());
    assert_eq!(square.dimension(), &dimension * &dimension);
    let index = BigInt::from(v.index().remove(0));
    assert_eq!(square.index(), [index * dimension * 2]);
}

#[test]
fn products_of_physics() {
    for (algebra, left, right, product) in [
        ("SU(2)", "2", "2", "1 + 3"),
        ("SU(3)", "3", "3", "3bar + 6"),
        ("SU(3)", "8", "8", "1 + 2 (8) + 10 + 10bar + 27"),
        ("SU(5)", "5bar", "10", "5 + 45"),
        ("SU(5)", "10", "10", "5bar + 45bar + 50bar"),
        ("SO(10)", "16", "16", "10 + 120 + 126"),
        ("SO(10)", "16", "16bar", "1 + 45 + 210"),
        ("E6", "27", "27bar", "1 + 78 + 650"),
        ("E6", "27", "27", "27bar + 351'bar + 351bar"),
        ("E7", "56", "56", "1 + 133 + 1463 + 1539"),
        ("E8", "248", "248", "1 + 248 + 3875 + 27000 + 30380"),
        ("F4", "26", "26", "1 + 26 + 52 + 273 + 324"),
    ] {
        let left = representation(algebra, left);
        let found = left.tensor(&representation(algebra, right)).unwrap().to_string();
        let sorted = |text: &str| {
            let mut terms: Vec<String> = text.split(" + ").map(str::to_string).collect();
            terms.sort();
            terms
        };
        assert_eq!(sorted(&found), sorted(product), "{algebra}: {found}");
    }
    // G2, 64 x 64: 14 components
    let v = weight("G2", &[1, 1]);
    assert_eq!(v.tensor(&v).unwrap().components().len(), 14);
}

#[test]
fn products_and_sums_need_one_algebra() {
    let (left, right) = (representation("A2", "3"), representation("G2", "7"));
    let error = left.tensor(&right).unwrap_err();
    assert!(matches!(error, RepresentationError::DifferentAlgebras { .. }));
    assert!(left.plus(&right, 1).is_err());
}

#[test]
fn products_with_many_components_are_rejected() {
    let v = weight("A1", &[1 << 22]);
    assert!(matches!(v.tensor(&v), Err(RepresentationError::TooLarge { .. })));
}

properties! {
    #![cases(60)]

    #[test]
    fn characters_multiply_on_the_torus((left, right) in pairs(200)) {
        let t = torus(left.algebra(), 7);
        let product = left.tensor(&right).unwrap();
        let [left, right] = [left, right].map(|w| Decomposition::irreducible(&w));
        let expected = character_at(&left, &t, 1) * character_at(&right, &t, 1) % PRIME;
        proptest::prop_assert_eq!(character_at(&product, &t, 1), expected);
    }

    #[test]
    fn products_commute_and_dualize((left, right) in pairs(3000)) {
        let product = left.tensor(&right).unwrap();
        proptest::prop_assert_eq!(&right.tensor(&left).unwrap(), &product);
        let dual = left.dual().tensor(&right.dual()).unwrap();
        proptest::prop_assert_eq!(dual.components().len(), product.components().len());
        for (weight, multiplicity) in product.components() {
            proptest::prop_assert_eq!(dual.multiplicity(&weight.dual()), multiplicity);
        }
        // the index of a product
        let (d, e) = (BigInt::from(left.dimension()), BigInt::from(right.dimension()));
        let expected: Vec<BigInt> = left.index().into_iter().zip(right.index())
            .map(|(i, j)| &e * BigInt::from(i) + &d * BigInt::from(j))
            .collect();
        proptest::prop_assert_eq!(product.index(), expected);
        proptest::prop_assert_eq!(product.dimension(), d * e);
    }
}

/// The irreducible representations of a type up to a dimension.
fn irreducible(algebra: &ReductiveAlgebra, most: u32) -> Vec<HighestWeight> {
    let mut found = vec![HighestWeight::trivial(algebra)];
    // the dimension grows with each label, so each label is raised from the position of the last one
    let mut open = vec![(vec![0; algebra.rank()], 0)];
    while let Some((labels, from)) = open.pop() {
        for at in from..labels.len() {
            let mut larger = labels.clone();
            larger[at] += 1;
            let weight = HighestWeight::new(algebra, larger.clone()).unwrap();
            if weight.dimension() <= most.into() {
                found.push(weight);
                open.push((larger, at));
            }
        }
    }
    found
}

/// The tensor squares of all irreducible representations up to dimension 100,000, of all types of
/// rank at most 8, have the dimensions that they should have. The limit for rank 1 and 2 is 1000, because their squares
/// have many components.
#[test]
#[ignore = "minutes"]
fn squares_of_all_representations() {
    for series in [Series::A, Series::B, Series::C, Series::D, Series::E, Series::F, Series::G] {
        for rank in 1..=8 {
            let Ok(one) = CartanType::new(series, rank) else { continue };
            let algebra = ReductiveAlgebra::new([one], 0);
            let all = irreducible(&algebra, if rank < 3 { 1000 } else { 100_000 });
            for weight in &all {
                let square = weight.tensor(weight).unwrap();
                assert_eq!(square.dimension(), BigInt::from(weight.dimension().pow(2)));
            }
        }
    }
}
