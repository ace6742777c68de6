//! Branching agrees with dimensions, indices, characters on a torus, products and chains.

use crate::common::property::properties;
use crate::representation::common::{
    PRIME, algebra, all_weights, character_at, power, representation, torus,
};
use affinor::representation::{
    Decomposition, HighestWeight, ReductiveAlgebra, RepresentationError, Subalgebra,
};
use num_bigint::BigInt;
use proptest::prelude::*;

/// Subalgebras of each kind.
fn subalgebras() -> Vec<Subalgebra> {
    let levi = |name: &str, removed: &[usize]| Subalgebra::levi(&algebra(name), removed).unwrap();
    let regular =
        |name: &str, node| Subalgebra::borel_de_siebenthal(&algebra(name), 0, node).unwrap();
    let by = |name: &str, sub: &str, v: &str| {
        Subalgebra::by_representation(&algebra(name), &representation(sub, v)).unwrap()
    };
    let principal = |name: &str| Subalgebra::principal_sl2(&algebra(name)).unwrap();
    vec![
        levi("A4", &[3]),
        levi("A4", &[2, 3]),
        levi("D5", &[5]),
        levi("E6", &[6]),
        levi("G2", &[1]),
        levi("C3", &[3]),
        levi("A2 + A1 + T1", &[2]),
        regular("G2", 1),
        regular("F4", 4),
        regular("E6", 4),
        regular("E7", 2),
        regular("E8", 8),
        regular("C4", 2),
        by("A5", "A2 + A1", "(3,2)"),
        by("A7", "A1 + A1 + A1", "(2,2,2)"),
        by("A4", "B2", "5"),
        by("A3", "C2", "4"),
        by("B3", "G2", "7"),
        by("D4", "A2", "8"),
        by("C7", "C3", "14'"),
        principal("G2"),
        principal("F4"),
        principal("A3"),
    ]
}

fn some_weight(algebra: &ReductiveAlgebra, at: usize, label: i64) -> HighestWeight {
    let mut labels = vec![0; algebra.rank()];
    labels[at % algebra.semisimple_rank()] = label;
    if algebra.abelian_dimension() > 0 {
        labels[algebra.semisimple_rank()] = 1;
    }
    HighestWeight::new(algebra, labels).unwrap()
}

properties! {
    #![cases(120)]

    #[test]
    fn restrictions_keep_dimensions_indices_and_characters(
        (which, at, label) in (0..23_usize, 0..8_usize, 1..3_i64),
    ) {
        let subalgebra = &subalgebras()[which];
        let weight = some_weight(subalgebra.ambient(), at, label);
        prop_assume!(weight.dimension() < 3000u32.into());
        let v = Decomposition::irreducible(&weight);
        let restricted = subalgebra.branch(&weight).unwrap();
        prop_assert_eq!(restricted.dimension(), v.dimension());
        // the index of the restriction, by the embedding indices
        let index = v.index();
        let expected: Vec<BigInt> = subalgebra
            .embedding_index()
            .iter()
            .map(|row| row.iter().zip(&index).map(|(e, i)| i * BigInt::from(*e)).sum())
            .collect();
        prop_assert_eq!(restricted.index(), expected);
        // the torus of the subalgebra in the torus of the algebra: s_k = product of t_i^(P_ik)
        let t = torus(subalgebra.algebra(), 5);
        let s: Vec<u64> = (0..subalgebra.ambient().rank())
            .map(|k| {
                let rows = subalgebra.projection().iter().zip(&t);
                rows.fold(1, |value, (row, t)| value * power(*t, row[k]) % PRIME)
            })
            .collect();
        prop_assert_eq!(character_at(&restricted, &t, 1), character_at(&v, &s, 1));
    }

    #[test]
    fn restriction_commutes_with_products_duals_and_powers(
        (which, at, other) in (0..23_usize, 0..8_usize, 0..8_usize),
    ) {
        let subalgebra = &subalgebras()[which];
        let weights = [at, other].map(|at| some_weight(subalgebra.ambient(), at, 1));
        prop_assume!(weights.iter().all(|w| w.dimension() < 300u32.into()));
        let [v, w] = weights.clone().map(|w| Decomposition::irreducible(&w));
        let restrict = |v: &Decomposition| subalgebra.restrict(v).unwrap();
        let product = restrict(&v.tensor(&w).unwrap());
        prop_assert_eq!(product, restrict(&v).tensor(&restrict(&w)).unwrap());
        let square = restrict(&v.exterior_power(2).unwrap());
        prop_assert_eq!(square, restrict(&v).exterior_power(2).unwrap());
        let dual = subalgebra.branch(&weights[0].dual()).unwrap();
        for (component, multiplicity) in restrict(&v).components() {
            prop_assert_eq!(dual.multiplicity(&component.dual()), multiplicity);
        }
    }
}

/// Another base of the roots: a projection composed with a Weyl group element of the algebra has
/// the same branching rules.
#[test]
fn the_weyl_group_does_not_change_branching_rules() {
    for subalgebra in subalgebras() {
        let ambient = subalgebra.ambient();
        let factor = ambient.simple_factors()[0];
        let cartan = factor.cartan_matrix();
        for i in 0..factor.rank() {
            // the columns of the projection composed with the reflection s_i
            let rows: Vec<Vec<i64>> = subalgebra
                .projection()
                .iter()
                .map(|row| {
                    let root: i64 = cartan[i].iter().zip(row).map(|(a, p)| a * p).sum();
                    let mut row = row.clone();
                    row[i] -= root;
                    row
                })
                .collect();
            let other = Subalgebra::by_projection(ambient, subalgebra.algebra(), rows).unwrap();
            let weight = some_weight(ambient, i, 1);
            if weight.dimension() < 3000u32.into() {
                assert_eq!(other.branch(&weight).unwrap(), subalgebra.branch(&weight).unwrap());
            }
        }
    }
}

#[test]
fn chains_of_subalgebras_compose() {
    // E6 > D5 + T1 > A4 + T1 + T1, in one projection
    let first = Subalgebra::levi(&algebra("E6"), &[6]).unwrap();
    let second = Subalgebra::levi(first.algebra(), &[5]).unwrap();
    let product: Vec<Vec<i64>> = second
        .projection()
        .iter()
        .map(|row| {
            (0..6)
                .map(|k| row.iter().zip(first.projection()).map(|(a, b)| a * b[k]).sum())
                .collect()
        })
        .collect();
    let both = Subalgebra::by_projection(first.ambient(), second.algebra(), product).unwrap();
    let v = representation("E6", "27");
    let steps = second.restrict(&first.restrict(&v).unwrap()).unwrap();
    assert_eq!(both.restrict(&v).unwrap(), steps);
    assert_eq!(steps.components().map(|(_, m)| m).sum::<i128>(), 6);
    assert!(all_weights(&steps).len() > 6);
}

#[test]
fn other_projections_are_rejected() {
    let (su3, so3) = (algebra("SU(3)"), algebra("SO(3)"));
    for (projection, reason) in [
        (vec![vec![1, 2]], "for the adjoint representation"),
        (vec![vec![0, 0]], "does not contain"),
        (vec![vec![2]], "the projection must have 1 rows with 2 entries"),
        (vec![vec![1 << 20, 2]], "exceeds 65536"),
        (vec![], "the projection must have 1 rows with 2 entries"),
    ] {
        let error = Subalgebra::by_projection(&su3, &so3, projection).unwrap_err();
        assert!(error.to_string().contains(reason), "{error}");
    }
    let subalgebra = Subalgebra::levi(&su3, &[1]).unwrap();
    let error = subalgebra.branch(&HighestWeight::trivial(&so3)).unwrap_err();
    assert!(matches!(error, RepresentationError::DifferentAlgebras { .. }));
}
