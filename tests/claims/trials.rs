//! Inputs for which the first trial fails: primes that divide structure constants, and elements
//! that are tried first.
//!
//! Guards `linear::modular` and the choices of elements in `algebra::structure`.

use crate::algebra::structure::{invariants, scrambled};
use crate::common::algebras::{by_table, catalogued};
use crate::common::{fraction, labels};
use affinor::algebra::structure::{Existence, StructureTheory};
use affinor::{Bracket, LieAlgebra, Rational};
use affinor_tensors::linear::modular::PRIMES;
use affinor_tensors::linear::{Echelon, Matrix};
use affinor_tensors::{Field, Ring};

type Algebra = LieAlgebra<Rational>;

/// The same algebra in a basis of multiples of the basis vectors.
fn scaled(algebra: &Algebra, factor: &Rational) -> Algebra {
    algebra.map(|value| value.clone() * factor).unwrap()
}

/// Factors: a prime, a product of two primes, and the product of all primes that are tried first.
fn factors() -> Vec<Rational> {
    let product = |count: usize| {
        let primes = PRIMES[..count].iter().map(|prime| Rational::from(prime.get() as i64));
        primes.fold(Rational::from(1), |product, prime| product * &prime)
    };
    vec![
        product(1),
        product(2),
        product(6),
        product(1).recip().unwrap(),
        product(6).recip().unwrap(),
    ]
}

/// Structure constants that are multiples of the primes, or have them as denominators, do not
/// change invariants and proofs.
#[test]
fn primes_that_divide_all_constants() {
    let names = [
        "heisenberg(3)",
        "so(3)",
        "so(5)",
        "so(3)+sl(2)",
        "so(3,1)",
        "se(3)",
        "aff(1)+aff(1)",
        "filiform(5)",
        "degraaf(5,6)",
        "degraaf(6,22,e=-1)",
        "heisenberg(5)",
        "oscillator(4)",
    ];
    for name in names {
        for (plain, dense) in [(catalogued(name), false), (scrambled(&catalogued(name), 5), true)] {
            let structure = StructureTheory::new(plain.clone());
            let expected = invariants(plain.clone());
            let exists = |structure: &StructureTheory<Rational>| {
                let contact = matches!(structure.contact_form(), Existence::Witness(_));
                let forms = structure.two_forms().unwrap();
                [contact, matches!(structure.symplectic_form(&forms), Existence::Witness(_))]
            };
            let identified = structure.identify().map(|found| found.names);
            for factor in factors().into_iter().step_by(if dense { 4 } else { 1 }) {
                let case = format!("{factor} times {name}, dense: {dense}");
                let other = StructureTheory::new(scaled(&plain, &factor));
                assert_eq!(invariants(scaled(&plain, &factor)), expected, "{case}");
                assert_eq!(exists(&other), exists(&structure), "{case}");
                assert_eq!(other.identify().map(|found| found.names), identified, "{case}");
                assert_eq!(other.index(), structure.index(), "{case}");
                let counted = [other.derivation_dimension(), structure.derivation_dimension()];
                assert_eq!(counted[0], counted[1], "{case}");
            }
        }
    }
}

/// The Pfaffian of the form of this Heisenberg algebra is a multiple of the primes, while its entries are not.
#[test]
fn primes_that_divide_a_minor() {
    for count in [1, 2] {
        let product: i64 = PRIMES[..count].iter().map(|prime| prime.get() as i64).product();
        let table = [(1, 2, 5, 1), (3, 4, 5, product + 6), (1, 3, 5, 2), (2, 4, 5, 3)];
        let structure = StructureTheory::new(by_table(5, &table));
        assert!(matches!(structure.contact_form(), Existence::Witness(_)));
        let counted = structure.index();
        assert_eq!((counted.dimension, counted.proved), (1, true));
        assert!(structure.regular_form().is_some());
        let found = structure.identify().unwrap().names;
        let expected = StructureTheory::new(catalogued("heisenberg(5)")).identify().unwrap().names;
        assert_eq!(found, expected);
    }
}

/// A torus acts on planes by opposite weights. One weight vanishes on each of the elements that are
/// tried first.
#[test]
fn weights_that_vanish_on_the_elements_tried_first() {
    let (torus, planes) = (12, 6);
    let tried = |trial: i64| -> Vec<Rational> {
        let next = |power: &i64| Some((*power * trial + 1) % 101);
        std::iter::successors(next(&1), next).take(torus).map(Rational::from).collect()
    };
    let n = torus + 2 * planes;
    let mut constants = vec![];
    let mut weights = Echelon::new();
    for plane in 0..planes {
        let rows: Vec<Vec<Rational>> = (1..=64).skip(plane).step_by(planes).map(tried).collect();
        let kernel = Matrix::from_dense(&rows).unwrap().nullspace().unwrap();
        let weight = kernel.row(0).to_vec();
        for (at, value) in &weight {
            let (v, w) = (torus + 2 * plane, torus + 2 * plane + 1);
            constants.push((*at, v, v, value.clone()));
            constants.push((*at, w, w, -value.clone()));
        }
        weights.insert(weight).unwrap();
    }
    let bracket = Bracket::from_constants(labels(n), constants).unwrap();
    let structure = StructureTheory::new(bracket.try_into().unwrap());
    // the common kernel of the weights is central
    let nilradical = structure.nilradical();
    assert_eq!(nilradical.dimension(), n - weights.rank());
    assert!(structure.is_ideal(&nilradical));
    assert!(structure.subalgebra(&nilradical).unwrap().is_nilpotent());
}

/// An algebra with more ideals than there are numbers modulo 11.
#[test]
fn many_equal_simple_ideals() {
    for (real, split) in [(7, 0), (5, 4), (12, 0)] {
        let names = [vec!["so(3)"; real], vec!["sl(2)"; split]].concat();
        let structure = StructureTheory::new(catalogued(&names.join("+")));
        let found = structure.simple_ideals().unwrap().unwrap();
        assert_eq!(found.rational.len(), real + split);
        let count = |name: &str| found.real.iter().filter(|one| one.names == [name]).count();
        assert_eq!((count("su(2)"), count("sl(2,R)")), (real, split));
    }
}

/// Algebras without an invariant of degree 4 satisfy `2 (n + 2) tr X^4 = 5 (tr X^2)^2`; types B6
/// and C6 do not. This identity distinguishes E6 from them.
#[test]
fn types_of_dimension_78() {
    for (name, wanted) in
        [("E6", true), ("G2", true), ("F4", true), ("so(13)", false), ("sp(12)", false)]
    {
        let structure = StructureTheory::new(catalogued(name));
        let algebra = structure.algebra();
        let n = algebra.dimension();
        let x: Vec<Rational> = (0..n).map(|at| Rational::from((at * at % 7) as i64 - 3)).collect();
        let ad = algebra.ad(&x).unwrap();
        let rows: Vec<Vec<Rational>> =
            (0..n).map(|i| (0..n).map(|j| ad.get(&[i, j])).collect()).collect();
        let square = Matrix::from_dense(&rows).unwrap();
        let square = square.mul(&square).unwrap();
        let trace =
            |m: &Matrix<Rational>| (0..n).fold(Rational::from(0), |sum, i| sum + &m.get(i, i));
        let (second, fourth) = (trace(&square), trace(&square.mul(&square).unwrap()));
        let difference = fourth * &fraction(2 * n as i64 + 4, 5) - &(second.clone() * &second);
        assert_eq!(difference.vanishes(), wanted, "{name}");
        assert_eq!(structure.dynkin_type().unwrap().len(), 1, "{name}");
    }
    for (name, text) in [("so(13)", "B6"), ("sp(12)", "C6"), ("E6", "E6")] {
        let types = StructureTheory::new(catalogued(name)).dynkin_type().unwrap();
        assert_eq!(types[0].to_string(), text);
    }
}
