//! Distributions: growth vectors of the literature, and witnesses that prove the answers.

use crate::common::algebras::{algebras, by_table};
use crate::common::{integer, property::properties, rationals};
use affinor::algebra::Distribution;
use affinor::algebra::structure::{StructureTheory, Subspace};
use affinor::{Error, LieAlgebra};
use affinor_tensors::Rational;
use affinor_tensors::linear::Row;
use num_traits::Zero;
use proptest::collection::vec;
use proptest::prelude::*;

fn unit(at: usize) -> Row<Rational> {
    vec![(at, integer(1))]
}

fn first_two(algebra: &LieAlgebra<Rational>) -> Distribution<Rational> {
    Distribution::new(algebra, [unit(0), unit(1)]).unwrap()
}

/// R. Montgomery, *A Tour of Subriemannian Geometries* (2002), chapter 6: the distributions of the
/// Heisenberg, Engel and Cartan groups.
#[test]
fn growth_vectors_of_nilpotent_algebras() {
    let heisenberg = by_table(3, &[(1, 2, 3, 1)]);
    let engel = by_table(4, &[(1, 2, 3, 1), (1, 3, 4, 1)]);
    let cartan = by_table(5, &[(1, 2, 3, 1), (1, 3, 4, 1), (2, 3, 5, 1)]);
    let expected: [(_, &[usize]); 3] =
        [(heisenberg, &[2, 3]), (engel, &[2, 3, 4]), (cartan, &[2, 3, 5])];
    for (algebra, growth) in expected {
        let distribution = first_two(&algebra);
        assert_eq!(distribution.growth_vector(), growth);
        assert!(distribution.is_bracket_generating());
        assert_eq!(distribution.noninvolutive_pair().unwrap().bracket, unit(2));
        assert_eq!(distribution.generating_brackets().len(), algebra.dimension() - 2);
    }
    // the centre and one more vector of the Heisenberg algebra span an abelian subalgebra
    let abelian = Distribution::new(&by_table(3, &[(1, 2, 3, 1)]), [unit(0), unit(2)]).unwrap();
    assert!(abelian.noninvolutive_pair().is_none() && !abelian.is_bracket_generating());
    assert_eq!(abelian.growth_vector(), [2]);
}

#[test]
fn vectors_that_span_no_distribution_are_refused() {
    let heisenberg = by_table(3, &[(1, 2, 3, 1)]);
    let twice = vec![(0, integer(2))];
    for vectors in [vec![], vec![vec![]], vec![unit(0), twice], vec![unit(3)]] {
        let error = Distribution::new(&heisenberg, vectors).unwrap_err();
        assert!(matches!(error, Error::Invalid { what: "distribution", .. }), "{error}");
    }
}

properties! {
    #![cases(60)]

    /// The last term of the flag is the generated subalgebra, and each witness is a bracket.
    #[test]
    fn the_flag_ends_at_the_generated_subalgebra(
        (algebra, rows) in algebras(6).prop_flat_map(|algebra| {
            let n = algebra.dimension();
            (Just(algebra), vec(vec(rationals(), n), 1..=2))
        })
    ) {
        let n = algebra.dimension();
        let sparse = |row: &Vec<Rational>| -> Row<Rational> {
            row.iter().cloned().enumerate().filter(|(_, value)| !value.is_zero()).collect()
        };
        let rows: Vec<_> = rows.iter().map(sparse).collect();
        if Subspace::span(n, rows.clone()).dimension() == rows.len() {
            let distribution = Distribution::new(&algebra, rows.clone()).unwrap();
            let flag = distribution.flag();
            let generated = StructureTheory::new(algebra.clone()).generated(rows);
            prop_assert_eq!(flag.last().unwrap().basis(), generated.basis());
            prop_assert_eq!(distribution.is_bracket_generating(), generated.dimension() == n);
            prop_assert_eq!(distribution.noninvolutive_pair().is_none(), flag.len() == 1);
            let mut all = distribution.subspace().clone();
            for witness in distribution.generating_brackets() {
                let dense = |row: &Row<Rational>| {
                    let mut dense = vec![integer(0); n];
                    row.iter().for_each(|(at, value)| dense[*at] = value.clone());
                    dense
                };
                let [x, y] = &witness.pair;
                prop_assert!(distribution.subspace().contains(x) && all.contains(y));
                let bracket = algebra.bracket(&dense(x), &dense(y)).unwrap();
                prop_assert_eq!(&dense(&witness.bracket), &bracket);
                prop_assert!(all.add(witness.bracket));
            }
            prop_assert_eq!(all.basis(), generated.basis());
        }
    }
}
