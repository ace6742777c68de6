//! Section 4.2, "SO(3)" with the connection (0), (62)-(71), and the algebras of 4.3, (84)-(90).

use crate::common::charts::constant;
use crate::common::{fraction, inverse, stored};
use crate::paper::charts::{self, spin};
use crate::paper::matrices::{self, assert_close, rodrigues};
use crate::paper::{assert_tensors, delta, epsilons, float, metric, sl2, so3, value, values};
use affinor::algebra::Complex;
use affinor::algebra::catalogue;
use affinor::geometry::paper;
use affinor::{Canonical, Connection, MatrixBasis, Metric};
use affinor_tensors::{Down, Rational, Symbolic, Tensor, Tolerance, Up, contract};
use nalgebra::DMatrix;
use std::f64::consts::TAU;

fn zero() -> Connection<Rational> {
    Connection::canonical(&so3(), Canonical::Zero)
}

fn product(a: &Tensor<Symbolic>, b: &Tensor<Symbolic>) -> Tensor<Symbolic> {
    contract("a^i_m b^m_j -> ^i_j", &[("a", a), ("b", b)]).unwrap()
}

/// `R(q) = 1 + 2 (q~ + q~^2)/(1 + q^2)` by the Gibbs vector.
fn rotation() -> Tensor<Symbolic> {
    let spin = spin(&["x", "y", "z"].map(Symbolic::parameter));
    let square = product(&spin, &spin);
    let share: Symbolic = value("2/(1 + x^2 + y^2 + z^2)");
    Tensor::from_fn(3, [Up, Down], |[i, j]| {
        constant(delta(i, j)) + &((spin.get(&[i, j]) + &square.get(&[i, j])) * &share)
    })
    .unwrap()
}

#[test]
fn eq_63_and_69_left_and_right_frames_are_products_with_spin_matrices() {
    let (group, r) = (charts::rotations(), rotation());
    for j in 0..3 {
        let unit: Vec<_> = (0..3).map(|i| constant(delta(i, j))).collect();
        let derivative = |field: &[Symbolic]| {
            r.map(|entry| {
                let terms = group.chart.names.iter().zip(field);
                let terms = terms.map(|(name, v)| v.clone() * &entry.derivative(name));
                crate::common::charts::sum(terms)
            })
        };
        let left = derivative(&group.left(j));
        assert_tensors(&left, &product(&r, &spin(&unit)), "(63): e_j(R) = R spin(unit j)");
        let right = derivative(&group.right(j));
        assert_tensors(&right, &product(&spin(&unit), &r), "(69): e_j(R) = spin(unit j) R");
    }
    // (10), (57): the right fields through omega and the left ones through Omega are one velocity
    let body = product(&inverse(&group.right), &group.chart.fields);
    assert_tensors(&body, &r, "omega = R Omega");
}

#[test]
fn eq_64_and_65_structure_and_affinities_of_so3() {
    let so3 = paper::so3().unwrap();
    assert_tensors(so3.frame().structure(), &epsilons("1"), "(64)");
    assert_tensors(so3.connection().gamma(), &epsilons("1/2"), "(65)");
    assert!(so3.connection().torsion().is_empty());
}

#[test]
fn after_65_the_table_of_twelve_and_69_zeros() {
    let plus = ["1212", "1313", "2121", "2323", "3131", "3232"];
    let minus = ["1221", "1331", "2112", "2332", "3113", "3223"];
    let space = paper::so3().unwrap();
    let curvature = space.connection().curvature();
    let mut zeros = 0;
    for (i, j, k, l) in (0..81).map(|at| (at / 27, at / 9 % 3, at / 3 % 3, at % 3)) {
        let name = format!("{}{}{}{}", i + 1, j + 1, k + 1, l + 1);
        let printed = match (plus.contains(&name.as_str()), minus.contains(&name.as_str())) {
            (true, _) => fraction(1, 4),
            (_, true) => fraction(-1, 4),
            _ => {
                zeros += 1;
                Rational::from(0)
            }
        };
        assert_eq!(curvature.get(&[i, j, k, l]), printed, "R {name}");
        let closed = delta(i, k) * delta(j, l) - delta(i, l) * delta(j, k);
        assert_eq!(curvature.get(&[i, j, k, l]), fraction(closed, 4), "closed form {name}");
    }
    assert_eq!((zeros, curvature.len()), (69, 12));
}

#[test]
fn after_65_ricci_scalar_and_sectional_curvature() {
    let half = Tensor::from_fn(3, [Down, Down], |[j, l]| fraction(delta(j, l), 2)).unwrap();
    assert_tensors(&zero().ricci(), &half, "Ric = 1/2 delta");
    let multiple =
        |n: &str| -> Metric<Rational> { metric(&[&[n, "0", "0"], &["0", n, "0"], &["0", "0", n]]) };
    for (n, scalar, sectional) in [("1", "3/2", "1/4"), ("2", "3/4", "1/8")] {
        let g = multiple(n);
        assert_eq!(zero().scalar_curvature(&g).unwrap(), value(scalar));
        let planes = [
            (values(["1", "0", "0"]), values(["0", "1", "0"])),
            (values(["1", "2", "-1"]), values(["3", "0", "1/2"])),
        ];
        for (x, y) in planes {
            let k = zero().sectional_curvature(&g, &x, &y).unwrap();
            assert_eq!(k, Some(value(sectional)), "{n} delta");
        }
    }
    // sl(2) with its Killing form 8 HH + 4 (EF + FE): Ric = -1/4 K, so S = -3/4
    let killing = metric(&[&["8", "0", "0"], &["0", "0", "4"], &["0", "4", "0"]]);
    let zero = Connection::canonical(&sl2(), Canonical::Zero);
    assert_tensors(&zero.ricci(), &killing.components().scale(&value("-1/4")), "sl(2)");
    assert_eq!(zero.scalar_curvature(&killing).unwrap(), fraction(-3, 4));
}

#[test]
fn eq_71_transport_by_half_of_spin_n() {
    let n = [2.0 / 7.0, 3.0 / 7.0, -6.0 / 7.0];
    let zero = Connection::canonical(&float(&so3()), Canonical::Zero);
    let generator = zero.transport_generator(&n).unwrap().to_dmatrix().unwrap();
    for t in [0.0, 0.7, -2.0, 4.0] {
        let transport = (&generator * t).exp();
        let a = matrices::inverse(&transport);
        assert_close(&a, &rodrigues(n, t / 2.0), "exp(t n~/2)");
        // it differs from what (50) gives
        assert!(t == 0.0 || (a - rodrigues(n, t)).norm() > 0.1);
    }
}

#[test]
fn after_71_holonomy_of_the_closed_subgroup() {
    let n = [0.0, 0.6, -0.8];
    let around = |which| {
        let connection = Connection::canonical(&float(&so3()), which);
        (connection.transport_generator(&n).unwrap().to_dmatrix().unwrap() * TAU).exp()
    };
    // a rotation by pi about n: 2 n n^T - 1
    let half_turn = DMatrix::from_fn(3, 3, |i, j| 2.0 * n[i] * n[j] - delta(i, j) as f64);
    assert_close(&around(Canonical::Zero), &half_turn, "zero");
    assert_close(&around(Canonical::Plus), &DMatrix::identity(3, 3), "plus");
    assert_close(&around(Canonical::Minus), &DMatrix::identity(3, 3), "minus");
}

/// `spin(unit i)` as entries, columns of the cross product with unit vectors.
fn spin_matrices() -> Vec<Vec<(usize, usize, Complex<Rational>)>> {
    let entry = |i: usize, r: usize, c: usize| Rational::from(-crate::paper::epsilon(i, r, c));
    let places = || (0..3).flat_map(|r| (0..3).map(move |c| (r, c)));
    let matrix = |i| places().map(|(r, c)| (r, c, Complex::real(entry(i, r, c)))).collect();
    (0..3).map(matrix).collect()
}

#[test]
fn eq_62_and_88_the_basis_of_so3_is_spin_of_the_unit_vectors() {
    // the printed matrices, rows of e~_1(I), e~_2(I), e~_3(I)
    let printed = [
        [[0, 0, 0], [0, 0, -1], [0, 1, 0]],
        [[0, 0, 1], [0, 0, 0], [-1, 0, 0]],
        [[0, -1, 0], [1, 0, 0], [0, 0, 0]],
    ];
    for (i, entries) in spin_matrices().iter().enumerate() {
        for (r, c, value) in entries {
            assert_eq!(value.re, Rational::from(printed[i][*r][*c]), "{i} {r} {c}");
        }
    }
    // the catalogue's so(3) is this basis: the same products and the same bracket
    let entry = catalogue::find("so(3)").unwrap();
    let catalogued = entry.matrices.unwrap().bracket().unwrap();
    assert_tensors(catalogued.structure(), &epsilons("1"), "catalogue");
}

#[test]
fn eq_89_and_90_spin_is_an_isomorphism() {
    let labels = crate::common::labels(3);
    let basis = MatrixBasis::new(labels, 3, spin_matrices(), Tolerance::default()).unwrap();
    let of_matrices = basis.bracket().unwrap();
    assert_tensors(of_matrices.structure(), &epsilons("1"), "(89)");
    let (m3, so3) = (paper::m3().unwrap(), paper::so3().unwrap());
    let abstract_constants = m3.frame().structure();
    let constants = abstract_constants.map(|v| v.as_constant().unwrap().clone());
    assert_eq!(stored(&constants), stored(of_matrices.structure()), "(90)");
    assert_eq!(stored(&constants), stored(so3.frame().structure()), "(90)");
}
