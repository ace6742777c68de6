//! Section 5: covectors, metrics and what the connection does to them, (91)-(103).

use crate::common::charts::sum;
use crate::common::labels;
use crate::paper::{
    affine, assert_tensors, epsilons, inertia, matrices, metric, parameters, se3, sl2, so3,
};
use crate::paper::{symbolic, tensor, value, values};
use affinor::algebra::Complex;
use affinor::geometry::conditions::conditions;
use affinor::geometry::forms::Form;
use affinor::geometry::paper;
use affinor::{Canonical, Connection, LieAlgebra, MatrixBasis};
use affinor_tensors::{Down, Rational, Symbolic, Tensor, Tolerance, Up};

/// The value of a covector on a vector.
fn of(covector: &Form<Rational>, u: &[Rational]) -> Rational {
    let value = covector.interior(&Tensor::vector(u, Up)).unwrap();
    value.components().to_scalar().unwrap()
}

#[test]
fn eq_91_to_95_covectors() {
    // indefinite and not diagonal
    let g = metric::<Rational>(&[&["2", "1/3", "-1"], &["1/3", "-5", "0"], &["-1", "0", "4"]]);
    let (v, u): (Vec<Rational>, Vec<_>) = (values(["3", "6", "-1"]), values(["1", "-2", "5"]));
    let covector = Form::new(Tensor::vector(&g.lower(&v).unwrap(), Down)).unwrap();
    // (91), (95): v*(u) = v^i u^j g_ij, by a loop
    let mut product = Rational::from(0);
    for (i, j) in (0..9).map(|at| (at / 3, at % 3)) {
        product += &(v[i].clone() * &u[j] * &g.components().get(&[i, j]));
    }
    assert_eq!(of(&covector, &u), product);
    // (93), (94): the components are the values on the basis, and the pairing is v_i u^i
    let units = [["1", "0", "0"], ["0", "1", "0"], ["0", "0", "1"]].map(values::<Rational, 3>);
    let lowered = units.iter().map(|unit| of(&covector, unit)).collect::<Vec<_>>();
    assert_eq!(lowered, g.lower(&v).unwrap());
    // (92)
    for (i, e) in so3().left_frame().coframe().iter().enumerate() {
        for (j, unit) in units.iter().enumerate() {
            assert_eq!(of(e, unit), Rational::from(crate::paper::delta(i, j)));
        }
    }
}

#[test]
fn eq_96_to_98_and_103_the_metric_lowers_and_gives_the_energy() {
    let numbers = metric::<Rational>(&[&["2", "1/3", "-1"], &["1/3", "5", "0"], &["-1", "0", "4"]]);
    let omega = values(["3", "6", "-1"]);
    let h = numbers.lower(&omega).unwrap();
    // 6 + 2 + 1, 1 + 30, -3 - 4
    assert_eq!(h, values(["9", "31", "-7"]));
    let twice = omega.iter().zip(&h).fold(Rational::from(0), |sum, (a, b)| sum + &(a.clone() * b));
    // T = 1/2 (27 + 186 + 7)
    assert_eq!(twice * &value("1/2"), value("110"));
    // (103) with all symbols
    let omega = parameters("w", 3);
    let h = inertia().lower(&omega).unwrap();
    let expected =
        ["J11*w1 + J12*w2 + J13*w3", "J12*w1 + J22*w2 + J23*w3", "J13*w1 + J23*w2 + J33*w3"];
    assert_eq!(h, values(expected));
    let twice: Symbolic =
        value("J11*w1^2 + J22*w2^2 + J33*w3^2 + 2*J12*w1*w2 + 2*J13*w1*w3 + 2*J23*w2*w3");
    let product = sum(omega.iter().zip(&h).map(|(a, b)| a.clone() * b));
    assert_eq!(product, twice);
}

#[test]
fn eq_99_m3_has_the_inertia_as_its_metric() {
    let m3 = paper::m3().unwrap();
    let rows = [["J11", "J12", "J13"], ["J12", "J22", "J23"], ["J13", "J23", "J33"]];
    let inertia = Tensor::from_fn(3, [Down, Down], |[i, j]| value(rows[i][j])).unwrap();
    assert_tensors(m3.metric().unwrap().components(), &inertia, "J");
    assert_tensors(m3.frame().structure(), &epsilons("1"), "c");
}

#[test]
fn eq_102_product_of_matrices_is_twice_delta() {
    // tr(A^T B) of the spin matrices, by their entries
    let spins = matrices::so3();
    let g =
        Tensor::from_fn(3, [Down, Down], |[i, j]| (spins.0[i].transpose() * &spins.0[j]).trace());
    let two = Tensor::from_fn(3, [Down, Down], |[i, j]| if i == j { 2.0 } else { 0.0 });
    assert_tensors(&g.unwrap(), &two.unwrap(), "tr(A^T B)");
    let two = metric::<Rational>(&[&["2", "0", "0"], &["0", "2", "0"], &["0", "0", "2"]]);
    let so3 = paper::so3().unwrap();
    assert_tensors(so3.metric().unwrap().components(), two.components(), "SO(3)");
    // of sl(2), where transposition matters: tr(H^T H) = 2, tr(E^T E) = 1, tr(E^T F) = 0
    let one = |i, j, v: i64| (i, j, Complex::real(Rational::from(v)));
    let basis = vec![vec![one(0, 0, 1), one(1, 1, -1)], vec![one(0, 1, 1)], vec![one(1, 0, 1)]];
    let basis = MatrixBasis::new(labels(3), 2, basis, Tolerance::default()).unwrap();
    let expected = tensor(3, [Down, Down], &[([1, 1], "2"), ([2, 2], "1"), ([3, 3], "1")]);
    assert_tensors(&basis.frobenius(), &expected, "sl(2)");
}

#[test]
fn after_102_the_product_is_compatible_with_zero_plus_and_minus() {
    let g = metric::<Rational>(&[&["2", "0", "0"], &["0", "2", "0"], &["0", "0", "2"]]);
    for which in [Canonical::Zero, Canonical::Plus, Canonical::Minus] {
        let connection = Connection::canonical(&so3(), which);
        assert!(connection.nonmetricity(&g).unwrap().is_empty(), "{which:?}");
    }
    assert!(g.bi_invariant(&so3()).unwrap().holds().is_some());
    // on sl(2) the product tr(A^T B) is not: Q_122 = -2 g(nabla_H E, E) = -2 * 2 for plus
    let g = metric::<Rational>(&[&["2", "0", "0"], &["0", "1", "0"], &["0", "0", "1"]]);
    let plus = Connection::canonical(&sl2(), Canonical::Plus);
    assert_eq!(plus.nonmetricity(&g).unwrap().get(&[0, 1, 1]), Rational::from(-4));
    assert!(g.bi_invariant(&sl2()).unwrap().witness().is_some());
}

#[test]
fn claim_plus_is_incompatible_with_an_inertia_that_is_no_multiple_of_the_identity() {
    let m3 = paper::m3().unwrap();
    let q = m3.connection().nonmetricity(m3.metric().unwrap()).unwrap();
    let mut found: Vec<String> = conditions(&q).iter().map(Symbolic::to_string).collect();
    found.sort();
    assert_eq!(found, ["J11 - J33", "J12", "J13", "J22 - J33", "J23"]);
    // and a multiple is compatible
    let ball = metric(&[&["J", "0", "0"], &["0", "J", "0"], &["0", "0", "J"]]);
    assert!(m3.connection().nonmetricity(&ball).unwrap().is_empty());
    // Q_kij = -Lambda^m_ki J_mj - Lambda^m_kj J_im: Q_123 = -J33 + J22, Q_112 = -J13
    assert_eq!(q.get(&[0, 1, 2]), value("J22 - J33"));
    assert_eq!(q.get(&[0, 0, 1]), value("-J13"));
}

#[test]
fn claim_plus_is_compatible_exactly_with_ad_invariant_metrics() {
    let plus =
        |algebra: &LieAlgebra<Rational>| Connection::canonical(&symbolic(algebra), Canonical::Plus);
    // sl(2): of the metrics with six free components, the multiples of 2 HH + EF + FE
    let free = metric(&[&["a", "d", "e"], &["d", "b", "f"], &["e", "f", "c"]]);
    let q = plus(&sl2()).nonmetricity(&free).unwrap();
    let mut found: Vec<String> = conditions(&q).iter().map(Symbolic::to_string).collect();
    found.sort();
    assert_eq!(found, ["a - 2*f", "b", "c", "d", "e"]);
    let killing = metric::<Rational>(&[&["8", "0", "0"], &["0", "0", "4"], &["0", "4", "0"]]);
    assert_tensors(&sl2().killing_form(), killing.components(), "Killing form");
    assert!(killing.bi_invariant(&sl2()).unwrap().holds().is_some());
    // se(3): rotations against translations, and no positive definite one
    let klein = |i: usize, j: usize| if i.abs_diff(j) == 3 { "1" } else { "0" };
    let rows: Vec<Vec<&str>> = (0..6).map(|i| (0..6).map(|j| klein(i, j)).collect()).collect();
    let rows: Vec<&[&str]> = rows.iter().map(Vec::as_slice).collect();
    assert!(plus(&se3()).nonmetricity(&metric(&rows)).unwrap().is_empty());
    let unit = |i, j| if i == j { "1" } else { "0" };
    let rows: Vec<Vec<&str>> = (0..6).map(|i| (0..6).map(|j| unit(i, j)).collect()).collect();
    let rows: Vec<&[&str]> = rows.iter().map(Vec::as_slice).collect();
    assert!(!plus(&se3()).nonmetricity(&metric(&rows)).unwrap().is_empty());
    // aff(1): none at all; the equations leave no metric
    let free = metric(&[&["a", "b"], &["b", "d"]]);
    let q = plus(&affine()).nonmetricity(&free).unwrap();
    let mut found: Vec<String> = conditions(&q).iter().map(Symbolic::to_string).collect();
    found.sort();
    assert_eq!(found, ["b", "d"]);
}
