//! Checking the Jacobi identity on generators gives the same result as on all triples of basis
//! vectors.

use crate::algebra::structure::scrambled;
use crate::common::algebras::catalogued;
use affinor::{BasisChange, Bracket, LieAlgebra, Rational, Tensor};
use affinor_tensors::{Down, Ring, Up};

type Constant = (usize, usize, usize, Rational);

fn constants(algebra: &LieAlgebra<Rational>) -> Vec<Constant> {
    let components = algebra.structure_constants().components();
    let pairs = components.filter(|(at, _)| at[1] < at[2]);
    pairs.map(|(at, value)| (at[1], at[2], at[0], value.clone())).collect()
}

/// Whether the identity holds on all triples; expects the same result on generators.
fn holds(algebra: &LieAlgebra<Rational>, constants: Vec<Constant>) -> bool {
    let bracket = Bracket::from_constants(algebra.labels(), constants).unwrap();
    let all = bracket.jacobi().is_empty();
    assert_eq!(bracket.jacobi_violation().is_none(), all, "{}", algebra.labels().len());
    all
}

/// Doubles every `step`-th constant in turn. Returns the number of brackets that violate the
/// identity.
fn violations(algebra: &LieAlgebra<Rational>, step: usize) -> usize {
    let given = constants(algebra);
    assert!(holds(algebra, given.clone()));
    let changed = (0..given.len()).step_by(step).filter(|&at| {
        let mut constants = given.clone();
        constants[at].3 = constants[at].3.clone() + &constants[at].3;
        !holds(algebra, constants)
    });
    changed.count()
}

#[test]
fn every_constant_counts_in_the_basis_of_the_catalogue() {
    for name in
        ["so(5)", "sl(3)", "G2", "free_nilpotent(2,4)", "parabolic(A3,1)", "sl(2)+heisenberg(3)"]
    {
        let found = violations(&catalogued(name), 1);
        assert!(found > 0, "{name}");
    }
    // in so(5) every constant occurs in a triple with cancellation
    let so5 = catalogued("so(5)");
    assert_eq!(violations(&so5, 1), constants(&so5).len());
}

/// With one nonzero constant in eight, the matrices are multiplied as dense ones.
#[test]
fn every_constant_counts_in_a_full_table() {
    let dense = scrambled(&catalogued("so(8)"), 1);
    let n = dense.dimension();
    assert!(8 * dense.structure_constants().len() > n * n * n);
    assert!(violations(&dense, 1999) > 0);
}

/// From dimension 24 on, generators are combinations of the basis; below, all triples are computed.
#[test]
fn every_constant_counts_in_a_dense_basis() {
    for (name, step) in [("so(6)", 97), ("sl(5)", 997), ("so(8)", 1999)] {
        let plain = catalogued(name);
        let n = plain.dimension();
        // lower triangular with ones: its inverse has two diagonals
        let ones = |[i, a]: [usize; 2]| Rational::from_i64(i64::from(a <= i));
        let change = BasisChange::new(Tensor::from_fn(n, [Up, Down], ones).unwrap()).unwrap();
        let dense = plain.change_basis(&change).unwrap();
        assert!(violations(&dense, step) > 0, "{name}");
    }
}

/// An abelian algebra needs as many generators as its dimension.
#[test]
fn algebras_without_few_generators() {
    for name in ["R^5", "R^30", "heisenberg(41)"] {
        let algebra = catalogued(name);
        assert!(holds(&algebra, constants(&algebra)));
    }
}
