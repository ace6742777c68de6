//! Eigenvalues of Casimir elements against the products of matrices and closed forms.

use crate::representation::common::algebra;
use affinor::Rational;
use affinor::representation::{CasimirElement, HighestWeight, MatrixRepresentation};
use affinor_tensors::Field;
use affinor_tensors::linear::Matrix;

type Square = Matrix<Rational>;

fn representation(name: &str, weight: &str) -> HighestWeight {
    HighestWeight::parse(&algebra(name), weight).unwrap()
}

/// The operator `sum of K^ab x_a ⊗ u_b` on `V ⊗ U`, with the inverse of `K_ab = tr(u_a u_b)/index`.
fn operator(v: &MatrixRepresentation, u: &MatrixRepresentation) -> Square {
    let [on_v, on_u] = [v, u].map(MatrixRepresentation::chevalley_basis);
    let index = Rational::from(u.highest_weight().index()[0].to_string().parse::<i64>().unwrap());
    let trace = |a: &Square, b: &Square| {
        let product = a.mul(b).unwrap();
        (0..product.rows()).fold(Rational::from(0), |sum, i| sum + &product.get(i, i))
    };
    let scale = index.recip().unwrap();
    let form: Vec<Vec<Rational>> =
        on_u.iter().map(|a| on_u.iter().map(|b| trace(a, b) * &scale).collect()).collect();
    let inverse = Matrix::from_dense(&form).unwrap().inverse().unwrap();
    let (m, n) = (v.dimension(), u.dimension());
    let mut sum = Matrix::zero(m * n, m * n);
    for (a, b, factor) in inverse.entries() {
        let mut rows = vec![vec![]; m * n];
        for (i, j, x) in on_v[a].entries() {
            for (k, l, y) in on_u[b].entries() {
                rows[i * n + k].push((j * n + l, x.clone() * y * factor));
            }
        }
        sum = sum.add(&Matrix::from_rows(m * n, rows).unwrap()).unwrap();
    }
    sum
}

/// The partial trace over `U` of a power is the eigenvalue times the identity of `V`.
#[test]
fn eigenvalues_are_those_of_matrices() {
    for (name, weight, defining, degrees) in [
        ("A1", "3", "2", 4),
        ("A2", "3", "3", 4),
        ("A2", "6bar", "3", 4),
        ("A2", "8", "3", 3),
        ("C3", "6", "6", 4),
        ("B2", "4", "5", 4),
        ("G2", "7", "7", 6),
    ] {
        let weight = representation(name, weight);
        let [v, u] = [&weight, &representation(name, defining)]
            .map(|weight| MatrixRepresentation::new(weight).unwrap());
        let (m, n) = (v.dimension(), u.dimension());
        let a = operator(&v, &u);
        let mut power = Matrix::identity(m * n);
        for degree in 1..=degrees {
            power = power.mul(&a).unwrap();
            let value = weight.trace_casimir(0, degree).unwrap();
            for i in 0..m {
                for j in 0..m {
                    let trace = (0..n)
                        .fold(Rational::from(0), |sum, k| sum + &power.get(i * n + k, j * n + k));
                    let expected = if i == j { value.clone() } else { Rational::from(0) };
                    assert_eq!(trace, expected, "{name} {weight} degree {degree}");
                }
            }
        }
    }
}

/// The eigenvalue of `d_abc` on the representation `[p, q]` of SU(3) is a multiple of
/// `(p - q)(2p + q + 3)(p + 2q + 3)`: A. Pais, *Rev. Mod. Phys.* 38 (1966) 215-255.
#[test]
fn cubic_casimir_of_su3() {
    let su3 = algebra("A2");
    for (p, q) in [(1, 0), (0, 2), (3, 1), (4, 4), (7, 2)] {
        let weight = HighestWeight::new(&su3, [p, q]).unwrap();
        let value = |weight: &HighestWeight| weight.trace_casimir(0, 3).unwrap();
        let difference = value(&weight) - &value(&weight.dual());
        let expected = Rational::new(2 * (p - q) * (2 * p + q + 3) * (p + 2 * q + 3), 9).unwrap();
        assert_eq!(difference, expected, "[{p},{q}]");
    }
}

/// The quadratic element is the Casimir eigenvalue times the index of the defining representation; all
/// traces vanish on the trivial representation. The Pfaffian distinguishes half-spin representations.
#[test]
fn degrees_and_normalization() {
    for (name, index, degrees) in [
        ("A4", 1, &[2, 3, 4, 5][..]),
        ("B3", 2, &[2, 4, 6]),
        ("C3", 1, &[2, 4, 6]),
        ("D5", 2, &[2, 4, 6, 8]),
        ("F4", 6, &[2, 6, 8, 12]),
        ("E6", 6, &[2, 5, 6, 8, 9, 12]),
        ("E7", 12, &[2, 6, 8, 10, 12, 14, 18]),
    ] {
        let adjoint = HighestWeight::adjoint(&algebra(name)).remove(0);
        let all = adjoint.casimirs().unwrap().remove(0);
        let expected = degrees.iter().map(|degree| CasimirElement::Trace { degree: *degree });
        let has_pfaffian = name.starts_with('D').then_some(CasimirElement::Pfaffian);
        let expected: Vec<CasimirElement> = expected.chain(has_pfaffian).collect();
        assert_eq!(all.iter().map(|(element, _)| *element).collect::<Vec<_>>(), expected, "{name}");
        assert_eq!(all[0].1, adjoint.casimir()[0].clone() * &Rational::from(index), "{name}");
        let trivial = HighestWeight::trivial(&algebra(name));
        assert_eq!(trivial.trace_casimir(0, degrees[1]).unwrap(), Rational::from(0), "{name}");
    }
    let so10 = algebra("D5");
    let [plus, minus] =
        [[0, 0, 0, 0, 1], [0, 0, 0, 1, 0]].map(|labels| HighestWeight::new(&so10, labels).unwrap());
    assert_eq!(plus.pfaffian(0), minus.pfaffian(0).map(|value| -value));
    let traces = |weight: &HighestWeight| weight.trace_casimir(0, 4).unwrap();
    assert_eq!(traces(&plus), traces(&minus));
    // a sum of algebras has one list for each factor
    let both = representation("A2 + A1", "(3,2)").casimirs().unwrap();
    assert_eq!(both.iter().map(Vec::len).collect::<Vec<_>>(), [2, 1]);
}
