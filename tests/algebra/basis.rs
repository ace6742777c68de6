//! Changes of basis in floats: algebras and metrics remain valid in every regular basis.

use crate::common::algebras::catalogued;
use crate::common::{labels, metrics, property::properties};
use affinor::algebra::catalogue;
use affinor::{BasisChange, Bracket, Form, LieAlgebra, Metric};
use affinor_tensors::{Down, Rational, Tensor, Up};
use nalgebra::{DMatrix, DVector};
use proptest::prelude::*;

/// The largest dimension of the tested algebras.
const MOST: usize = 10;

/// The algebras of the catalogue up to that dimension that have no parameters, and sums of them.
fn names() -> Vec<String> {
    let orders = |name: &str, n: std::ops::RangeInclusive<usize>| {
        n.map(|n| name.replace('n', &n.to_string())).collect::<Vec<_>>()
    };
    let families = [
        orders("R^n", 1..=4),
        orders("so(n)", 3..=5),
        orders("su(n)", 2..=3),
        orders("sl(n)", 2..=3),
        orders("gl(n)", 1..=3),
        orders("se(n)", 2..=4),
        [
            "heisenberg(3)",
            "heisenberg(5)",
            "heisenberg(7)",
            "sp(2)",
            "sp(4)",
            "so(2,1)",
            "so(3,1)",
            "so(2,2)",
        ]
        .map(String::from)
        .to_vec(),
        ["aff(1)", "A1", "A2", "B2", "bianchi(II)", "bianchi(III)", "bianchi(IV)"]
            .map(String::from)
            .to_vec(),
        ["bianchi(V)", "bianchi(VI,h=-1/2)", "bianchi(VII,h=2)", "bianchi(VIII)", "bianchi(IX)"]
            .map(String::from)
            .to_vec(),
        [
            "so*(4)",
            "u(2)",
            "usp(4)",
            "iso(2,1)",
            "galilei(2)",
            "sim(2)",
            "hom(3)",
            "conformal(1,1)",
        ]
        .map(String::from)
        .to_vec(),
        [
            "schroedinger(1)",
            "oscillator(4)",
            "compact(B2)",
            "t(3)",
            "n(4)",
            "borel(A2)",
            "parabolic(A2,1)",
        ]
        .map(String::from)
        .to_vec(),
        [
            "free_nilpotent(2,3)",
            "filiform(5)",
            "damek_ricci(1,2)",
            "patera(4,8)",
            "degraaf(5,6)",
            "gong(7,17)",
        ]
        .map(String::from)
        .to_vec(),
        ["so(3)+heisenberg(3)", "sl(2)+R^2", "aff(1)+se(2)"].map(String::from).to_vec(),
    ];
    families.concat()
}

fn floats(name: &str) -> LieAlgebra<f64> {
    catalogued(name).map(Rational::to_f64).unwrap()
}

/// A matrix with the singular values `1 .. 10^-decades`, from random numbers by two rotations.
fn basis(n: usize, numbers: &[f64], decades: f64) -> DMatrix<f64> {
    let random = |from: usize| DMatrix::from_fn(n, n, |i, j| numbers[from + i * n + j]);
    let (q, p) = (random(0).qr().q(), random(n * n).qr().q());
    let exponent = |i: usize| -decades * i as f64 / (n.max(2) - 1) as f64;
    let sizes = DVector::from_fn(n, |i, _| 10f64.powf(exponent(i)));
    q * DMatrix::from_diagonal(&sizes) * p
}

fn change(matrix: &DMatrix<f64>) -> BasisChange<f64> {
    let n = matrix.nrows();
    let tensor = Tensor::from_fn(n, [Up, Down], |[i, j]| matrix[(i, j)]).unwrap();
    BasisChange::new(tensor).unwrap()
}

/// An algebra of the catalogue, the numbers of a basis, and the exponent of its condition number.
fn cases() -> impl Strategy<Value = (String, Vec<f64>, f64)> {
    let numbers = prop::collection::vec(-1.0..1.0f64, 2 * MOST * MOST);
    (prop::sample::select(names()), numbers, prop_oneof![Just(0.0), 0.0..3.0, 3.0..6.0])
}

properties! {
    #![cases(512)]

    /// Brackets stay antisymmetric to the last bit, as every constructor requires.
    #[test]
    fn every_algebra_in_every_basis((name, numbers, decades) in cases()) {
        let algebra = floats(&name);
        let n = algebra.dimension();
        prop_assert!(n <= MOST, "{}", name);
        let matrix = basis(n, &numbers, decades);
        let change = change(&matrix);
        let new = algebra.change_basis(&change);
        prop_assert!(new.is_ok(), "{name}: {new:?}");
        let structure = new.unwrap().structure_constants().clone();
        for (at, value) in structure.components() {
            prop_assert_eq!(*value, -structure.get(&[at[0], at[2], at[1]]));
        }
        prop_assert!(Bracket::new(labels(n), structure.clone()).is_ok());
        // c' = A^-1 c (A, A), by matrices: ad'_a = A^-1 ad_{A e_a} A
        let inverse = matrix.clone().try_inverse().unwrap();
        let largest = algebra.structure_constants().components().fold(0.0f64, |m, (_, v)| m.max(v.abs()));
        // the inverse is accurate to the rounding error times the condition number
        let condition = inverse.norm() * matrix.norm();
        let size = largest * inverse.norm() * matrix.norm().powi(2);
        let bound = 4.0 * f64::EPSILON * (n * n) as f64 * size * condition;
        for a in 0..n {
            let column: Vec<f64> = matrix.column(a).iter().copied().collect();
            let ad = algebra.ad(&column).unwrap();
            let ad = DMatrix::from_fn(n, n, |i, k| ad.get(&[i, k]));
            let expected = &inverse * ad * &matrix;
            for (i, k) in (0..n).flat_map(|i| (0..n).map(move |k| (i, k))) {
                let off = (expected[(i, k)] - structure.get(&[i, a, k])).abs();
                prop_assert!(off <= bound, "{name}: {off:e} > {bound:e}");
            }
        }
    }

    /// Symmetric tensors remain symmetric and antisymmetric tensors antisymmetric, as constructors
    /// require.
    #[test]
    fn metrics_and_forms(
        (g, numbers) in (1..6usize).prop_flat_map(|n| {
            (metrics(n), prop::collection::vec(-1.0..1.0f64, 2 * n * n))
        }),
        decades in 0.0..4.0f64,
    ) {
        let g = g.components().map(Rational::to_f64);
        let n = g.dimension();
        let change = change(&basis(n, &numbers, decades));
        let moved = change.apply(&g).unwrap();
        for (at, value) in moved.components() {
            prop_assert_eq!(*value, moved.get(&[at[1], at[0]]));
        }
        // for larger condition numbers the determinant is a rounding error
        let matrix = DMatrix::from_fn(n, n, |i, k| moved.get(&[i, k]));
        let moments = matrix.symmetric_eigenvalues().abs();
        let is_regular = moments.min() > 1e-13 * moments.max();
        prop_assert!(Metric::new(labels(n), moved).is_ok() || !is_regular);
        // a form of degree 3 from the same numbers
        let term = |[i, j, k]: [usize; 3]| {
            let x = |a: usize, i: usize| numbers[(a * n + i) % numbers.len()];
            let minor = |p: usize, q: usize| x(p, j) * x(q, k) - x(p, k) * x(q, j);
            x(0, i) * minor(1, 2) - x(1, i) * minor(0, 2) + x(2, i) * minor(0, 1)
        };
        let form = Tensor::from_fn(n, [Down; 3], |[i, j, k]| {
            // exactly antisymmetric
            let mut at = [i, j, k];
            at.sort_unstable();
            let even = [[0, 1, 2], [1, 2, 0], [2, 0, 1]].iter().any(|p| p.map(|p| at[p]) == [i, j, k]);
            if at[0] == at[1] || at[1] == at[2] { 0.0 } else if even { term(at) } else { -term(at) }
        }).unwrap();
        prop_assert!(Form::new(form.clone()).is_ok());
        let moved = change.apply(&form).unwrap();
        for (at, value) in moved.components() {
            let [i, j, k] = [at[0], at[1], at[2]];
            prop_assert_eq!(*value, -moved.get(&[j, i, k]));
            prop_assert_eq!(*value, -moved.get(&[k, j, i]));
        }
        prop_assert!(Form::new(moved).is_ok());
    }
}

/// The names above are in the catalogue, and include every family.
#[test]
fn all_families_take_part() {
    let heads: Vec<String> = names()
        .iter()
        .flat_map(|name| name.split('+').map(str::to_string).collect::<Vec<_>>())
        .map(|name| name.chars().take_while(|c| c.is_ascii_alphabetic()).collect())
        .collect();
    for family in catalogue::families() {
        let head: String = family.example.chars().take_while(|c| c.is_ascii_alphabetic()).collect();
        let smallest = catalogue::find(family.example).unwrap().dimension();
        assert!(heads.contains(&head) || smallest > MOST, "{}", family.pattern);
    }
}
