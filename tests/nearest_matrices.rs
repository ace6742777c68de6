//! The matrix of a group's algebra that is nearest to a given one: what is left is orthogonal to every generator.

use crate::common::algebras::catalogued;
use affinor::group::{LieGroup, MatrixGroup, MatrixNotation};
use nalgebra::{DMatrix, DVector};

/// Numbers without a pattern between -1 and 1.
fn number(at: usize) -> f64 {
    (at as f64 * 1.7 + 0.3).sin()
}

fn nearest(group: &MatrixGroup, name: &str) {
    let (n, generators) = (group.dimension(), group.generators());
    let x = DVector::from_fn(n, |i, _| number(i));
    let size = generators[0].nrows();
    let sum = generators.iter().zip(x.iter()).map(|(b, x)| b * *x);
    let sum = sum.fold(DMatrix::zeros(size, size), |sum: DMatrix<f64>, term| sum + term);
    assert!((group.generator(&x) - &sum).amax() < 1e-13, "{name}");
    assert!((group.components(&sum) - &x).amax() < 1e-11, "{name}");
    let any = DMatrix::from_fn(size, size, |i, j| number(i * size + j));
    let rest = &any - group.generator(&group.components(&any));
    for b in &generators {
        assert!(rest.dot(b).abs() < 1e-10 * b.norm() * any.norm(), "{name}: {}", rest.dot(b));
    }
    let small = &x * (0.1 / sum.norm());
    let g = group.exp(&small);
    group.expect_element(&g, 1e-9).unwrap();
    assert!(group.expect_element(&(&g + &any * 0.1), 1e-9).is_err(), "{name}");
}

/// Root vectors share no entry with others; in a dense basis all matrices do.
#[test]
fn in_sparse_and_dense_bases() {
    for name in ["so(3)", "sl(3)", "G2", "heisenberg(3)", "bianchi(IV)", "sl(2)+heisenberg(3)"] {
        let algebra = catalogued(name).map(|value| value.to_f64()).unwrap();
        nearest(&MatrixGroup::of_algebra(&algebra).unwrap(), name);
    }
    // t E_ij + s E_kl for many places at once
    let dense: Vec<DMatrix<f64>> = {
        let turns = [(0, 1), (0, 2), (1, 2)].map(|(i, j)| {
            let mut m = DMatrix::zeros(3, 3);
            (m[(i, j)], m[(j, i)]) = (1.0, -1.0);
            m
        });
        vec![&turns[0] + &turns[1], &turns[1] * 2.0 - &turns[2], &turns[0] + &turns[2] * 3.0]
    };
    nearest(&MatrixGroup::new(&dense).unwrap(), "so(3), dense");
}
