//! Matrices of representations satisfy the relations of their algebra, multiplied out exactly.

use crate::common::property::properties;
use crate::representation::common::{algebra, all_weights, weight, weights};
use affinor::Rational;
use affinor::algebra::roots::{RootSystem, chevalley_constants};
use affinor::representation::{
    Decomposition, HighestWeight, Indicator, MatrixRepresentation, RepresentationError,
};
use affinor::tensors::Ring;
use affinor::tensors::linear::Matrix;
use num_bigint::BigInt;
use std::collections::BTreeMap;

type M = Matrix<Rational>;

fn module(name: &str, labels: &[i64]) -> MatrixRepresentation {
    MatrixRepresentation::new(&weight(name, labels)).unwrap()
}

fn scaled(matrix: &M, factor: i64) -> M {
    matrix.map(|value| value.clone() * &Rational::from(factor))
}

fn bracket(a: &M, b: &M) -> M {
    a.mul(b).unwrap().add(&scaled(&b.mul(a).unwrap(), -1)).unwrap()
}

/// The trace of a product.
fn trace(a: &M, b: &M) -> Rational {
    let terms = a.entries().map(|(i, j, value)| value.clone() * &b.get(j, i));
    terms.fold(Rational::from(0), |sum, term| sum + &term)
}

/// The Cartan matrix of all factors.
fn cartan(v: &MatrixRepresentation) -> Vec<Vec<i64>> {
    let rank = v.algebra().semisimple_rank();
    let mut all = vec![vec![0; rank]; rank];
    for (at, factor) in v.algebra().simple_factors().iter().enumerate() {
        let start = v.algebra().positions(at).start;
        for (i, row) in factor.cartan_matrix().into_iter().enumerate() {
            all[start + i][start..start + row.len()].copy_from_slice(&row);
        }
    }
    all
}

/// Chevalley's and Serre's relations, where `cartan[i][j] = <α_i, α_j^∨>`.
fn check_relations(v: &MatrixRepresentation) {
    let (n, cartan) = (v.dimension(), cartan(v));
    let zero = M::zero(n, n);
    for (i, e) in v.raising().iter().enumerate() {
        for (j, f) in v.lowering().iter().enumerate() {
            let expected = if i == j { v.diagonal(i) } else { zero.clone() };
            assert_eq!(bracket(e, f), expected, "[e{i},f{j}]");
            let h = v.diagonal(j);
            assert_eq!(bracket(&h, e), scaled(e, cartan[i][j]), "[h{j},e{i}]");
            let f = &v.lowering()[i];
            assert_eq!(bracket(&h, f), scaled(f, -cartan[i][j]), "[h{j},f{i}]");
            if i != j {
                for x in [v.raising(), v.lowering()] {
                    let powers = 0..1 - cartan[j][i];
                    let serre = powers.fold(x[j].clone(), |y, _| bracket(&x[i], &y));
                    assert_eq!(serre, zero, "ad(x{i})^({}) x{j}", 1 - cartan[j][i]);
                }
            }
        }
    }
}

/// `tr(e_α f_α)` is the Dynkin index for long roots, and a multiple for short ones; the weights of
/// the basis are the character; invariant forms are invariant.
fn check_invariants(v: &MatrixRepresentation) {
    let highest = v.highest_weight();
    assert_eq!(BigInt::from(highest.dimension()), BigInt::from(v.dimension()));
    let mut counted: BTreeMap<Vec<i64>, i128> = BTreeMap::new();
    v.basis().iter().for_each(|b| *counted.entry(b.weight().to_vec()).or_default() += 1);
    assert_eq!(counted, all_weights(&Decomposition::irreducible(highest)));
    for (at, factor) in v.algebra().simple_factors().iter().enumerate() {
        let roots = RootSystem::new(*factor);
        let simple = roots.positive_roots()[..factor.rank()].iter();
        let lengths: Vec<i64> = simple.map(|root| root.squared_length()).collect();
        let long = lengths.iter().max().unwrap();
        let index: i64 = (&highest.index()[at]).try_into().unwrap();
        for (k, i) in v.algebra().positions(at).enumerate() {
            let expected = Rational::from(index * long / lengths[k]);
            assert_eq!(trace(&v.raising()[i], &v.lowering()[i]), expected, "{highest} {i}");
        }
    }
    let s = v.contravariant_form();
    assert_eq!(s, s.transpose());
    let form = v.invariant_form();
    assert_eq!(form.is_some(), highest.indicator() != Indicator::Complex);
    for (e, f) in v.raising().iter().zip(v.lowering()) {
        // S(f v, w) = S(v, e w)
        assert_eq!(f.transpose().mul(&s).unwrap(), s.mul(e).unwrap());
        if let Some(b) = &form {
            for x in [e, f] {
                let left = x.transpose().mul(b).unwrap();
                assert_eq!(left, scaled(&b.mul(x).unwrap(), -1));
            }
        }
    }
    if let Some(b) = form {
        assert_eq!(b.transpose(), scaled(&b, highest.indicator().value()));
        assert!(v.dimension() > 100 || b.inverse().is_some());
    }
}

/// The brackets of all matrices of a Chevalley basis have the structure constants.
fn check_chevalley(v: &MatrixRepresentation) {
    let all = v.chevalley_basis();
    assert_eq!(all.len(), v.algebra().dimension());
    let n = v.dimension();
    let mut start = 0;
    for factor in v.algebra().simple_factors() {
        let mut sums: BTreeMap<(usize, usize), M> = BTreeMap::new();
        for (i, j, k, value) in chevalley_constants(&RootSystem::new(*factor)) {
            let sum = sums.entry((i, j)).or_insert_with(|| M::zero(n, n));
            *sum = sum.add(&scaled(&all[start + k], value)).unwrap();
        }
        for i in 0..factor.dimension() {
            for j in i + 1..factor.dimension() {
                let expected = sums.remove(&(i, j)).unwrap_or_else(|| M::zero(n, n));
                assert_eq!(bracket(&all[start + i], &all[start + j]), expected, "{i} {j}");
            }
        }
        start += factor.dimension();
    }
}

#[test]
fn chevalley_bases_have_the_structure_constants() {
    for (name, labels) in [
        ("A1", &[4][..]),
        ("A2", &[1, 1]),
        ("A3", &[0, 1, 0]),
        ("B2", &[1, 1]),
        ("B3", &[0, 0, 1]),
        ("C3", &[0, 0, 1]),
        ("D4", &[0, 0, 1, 0]),
        ("D5", &[0, 0, 0, 0, 1]),
        ("G2", &[1, 0]),
        ("G2", &[1, 1]),
        ("F4", &[0, 0, 0, 1]),
        ("E6", &[1, 0, 0, 0, 0, 0]),
        ("A2 + A1 + T1", &[1, 1, 1, -2]),
    ] {
        check_chevalley(&module(name, labels));
    }
}

/// Representations of G2 of dimension 729 and 924; minuscule and adjoint representations; spinors.
#[test]
fn relations_are_multiplied_out() {
    for (name, labels, dimension) in [
        ("G2", &[2, 2][..], 729),
        ("G2", &[4, 1], 924),
        ("G2", &[0, 3], 273),
        ("E6", &[1, 0, 0, 0, 0, 0], 27),
        ("E7", &[0, 0, 0, 0, 0, 0, 1], 56),
        ("E8", &[0, 0, 0, 0, 0, 0, 0, 1], 248),
        ("F4", &[0, 1, 0, 0], 1274),
        ("B4", &[0, 0, 0, 1], 16),
        ("D6", &[0, 0, 0, 0, 0, 1], 32),
        ("D5", &[1, 0, 0, 0, 1], 144),
        ("A3", &[2, 1, 2], 300),
        ("A1", &[40], 41),
        ("A2", &[9, 9], 1000),
        ("B2 + G2 + T1", &[1, 1, 1, 0, 5], 112),
        ("T2", &[3, -1], 1),
        ("A4", &[0, 0, 0, 0], 1),
    ] {
        let v = module(name, labels);
        assert_eq!(v.dimension(), dimension, "{name} {labels:?}");
        check_relations(&v);
        check_invariants(&v);
    }
}

properties! {
    #![cases(40)]

    #[test]
    fn random_representations_satisfy_the_relations(highest in weights(400)) {
        let v = MatrixRepresentation::new(&highest).unwrap();
        check_relations(&v);
        check_invariants(&v);
    }
}

/// The contravariant form is positive definite: its elimination has positive pivots.
#[test]
fn the_contravariant_form_is_positive_definite() {
    for (name, labels) in [("A2", &[2, 2][..]), ("G2", &[1, 1]), ("B3", &[1, 0, 1])] {
        let mut rows = module(name, labels).contravariant_form().to_dense();
        for k in 0..rows.len() {
            let pivot = rows[k][k].clone();
            assert!(!pivot.vanishes() && !pivot.is_negative(), "{name} {k}");
            let unit = Rational::from(1) / &pivot;
            let (above, below) = rows.split_at_mut(k + 1);
            for row in below {
                let factor = row[k].clone() * &unit;
                for (entry, of_pivot) in row.iter_mut().zip(&above[k]).skip(k) {
                    *entry = entry.clone() - &(factor.clone() * of_pivot);
                }
            }
        }
    }
}

/// The Casimir element acts by `(λ, λ + 2ρ)`: the sum of `(e_α f_α + f_α e_α) (α, α)/2` and of the
/// inverse form of the Cartan subalgebra, which the trace form of the adjoint representation gives.
#[test]
fn the_casimir_element_acts_by_its_eigenvalue() {
    for (name, labels) in [("A2", &[2, 1][..]), ("G2", &[1, 1]), ("B3", &[0, 0, 1])] {
        let v = module(name, labels);
        let adjoint = HighestWeight::adjoint(&algebra(name)).remove(0);
        let twice_coxeter: i64 = (&adjoint.index()[0]).try_into().unwrap();
        let g = MatrixRepresentation::new(&adjoint).unwrap().chevalley_basis();
        let rows = g.iter().map(|x| g.iter().map(|y| trace(x, y)).collect::<Vec<_>>());
        // the form in which long roots have squared length 2 is the Killing form over 2 h
        let form = M::from_dense(&rows.collect::<Vec<_>>()).unwrap();
        let dual = scaled(&form.inverse().unwrap(), twice_coxeter);
        let all = v.chevalley_basis();
        let mut sum = M::zero(v.dimension(), v.dimension());
        for (i, j, value) in dual.entries() {
            let product = all[i].mul(&all[j]).unwrap();
            sum = sum.add(&product.map(|entry| entry.clone() * value)).unwrap();
        }
        let eigenvalue = v.highest_weight().casimir().remove(0);
        let expected = Matrix::diagonal(std::iter::repeat_n(eigenvalue, v.dimension()));
        assert_eq!(sum, expected, "{name}");
    }
}

#[test]
fn large_representations_are_rejected() {
    let error = MatrixRepresentation::new(&weight("E8", &[1, 0, 0, 0, 0, 0, 0, 1])).unwrap_err();
    assert!(matches!(error, RepresentationError::TooLarge { .. }), "{error}");
    assert!(error.to_string().contains("779247"), "{error}");
}
