//! Beyond the paper: Levi-Civita of a left-invariant metric and Milnor's Ricci curvature.

use crate::common::charts::sum;
use crate::paper::{
    affine, assert_tensors, heisenberg, inertia, metric, parameters, se2, sl2, so3, symbolic,
};
use crate::paper::{tensor, value, values};
use affinor::{Connection, LieAlgebra, Metric};
use affinor_tensors::{Down, Rational, Symbolic, Tensor, Up, contract};

/// `Lambda^l_ij = 1/2 g^lk (c_ijk - c_jki + c_kij)`, `c_ijk = c^m_ij g_mk`, by loops.
fn koszul(algebra: &LieAlgebra<Rational>, g: &Metric<Rational>) -> Tensor<Rational> {
    let (n, c) = (algebra.dimension(), algebra.structure());
    let total = |terms: Vec<Rational>| terms.iter().fold(Rational::from(0), |sum, v| sum + v);
    let lowered = |i: usize, j: usize, k: usize| {
        total((0..n).map(|m| c.get(&[m, i, j]) * &g.components().get(&[m, k])).collect())
    };
    Tensor::from_fn(n, [Up, Down, Down], |[l, i, j]| {
        let terms = (0..n).map(|k| {
            (lowered(i, j, k) - &lowered(j, k, i) + &lowered(k, i, j)) * &g.inverse().get(&[l, k])
        });
        total(terms.collect()) * &value("1/2")
    })
    .unwrap()
}

#[test]
fn levi_civita_of_left_invariant_metrics() {
    let three = metric(&[&["2", "1", "0"], &["1", "3", "-1"], &["0", "-1", "5"]]);
    for algebra in [so3(), sl2(), se2(), heisenberg()] {
        let connection = Connection::levi_civita(algebra.left_frame(), &three).unwrap();
        assert_tensors(connection.gamma(), &koszul(&algebra, &three), "Lambda");
        assert!(connection.nonmetricity(&three).unwrap().is_empty());
    }
    // aff(1) with the identity, by hand: nabla_x x = nabla_x y = 0, nabla_y x = -y, nabla_y y = x
    let two = metric::<Rational>(&[&["1", "0"], &["0", "1"]]);
    let plane = Connection::levi_civita(affine().left_frame(), &two).unwrap();
    let expected = tensor(2, [Up, Down, Down], &[([2, 2, 1], "-1"), ([1, 2, 2], "1")]);
    assert_tensors(plane.gamma(), &expected, "hyperbolic plane");
}

#[test]
fn geodesics_of_levi_civita_are_euler_equations_without_torque() {
    // J_il Lambda^l_jk w^j w^k = (w x J w)_i
    let (g, omega) = (inertia(), parameters("w", 3));
    let body = Connection::levi_civita(symbolic(&so3()).left_frame(), &g).unwrap();
    let w = Tensor::vector(&omega, Up);
    let once = contract("L^l_jk w^j -> ^l_k", &[("L", body.gamma()), ("w", &w)]).unwrap();
    let twice = contract("L^l_k w^k -> ^l", &[("L", &once), ("w", &w)]).unwrap();
    let found = g.lower(&twice.to_vector().unwrap()).unwrap();
    let h = g.lower(&omega).unwrap();
    let cross = |i: usize, j: usize| omega[i].clone() * &h[j] - &(omega[j].clone() * &h[i]);
    assert_eq!(found, [cross(1, 2), cross(2, 0), cross(0, 1)]);
    // on aff(1) -c^j_ki w^k H_j with H = (a w1 + b w2, b w1 + d w2): (w2 H2, -w1 H2)
    let g = metric(&[&["a", "b"], &["b", "d"]]);
    let plane = Connection::levi_civita(symbolic(&affine()).left_frame(), &g).unwrap();
    let omega = parameters("w", 2);
    let quadratic = |l: usize| {
        let pairs = (0..2).flat_map(|j| (0..2).map(move |k| (j, k)));
        sum(pairs.map(|(j, k)| plane.gamma().get(&[l, j, k]) * &omega[j] * &omega[k]))
    };
    let found = g.lower(&[quadratic(0), quadratic(1)]).unwrap();
    assert_eq!(found, values(["w2*(b*w1 + d*w2)", "-w1*(b*w1 + d*w2)"]));
}

#[test]
fn milnor_ricci_curvature_of_a_body() {
    // mu_i = (J1 + J2 + J3 - 2 J_i)/(2 sqrt(J1 J2 J3)); Ric_11 = 2 mu_2 mu_3 J_1 and cyclic
    let principal = metric(&[&["J1", "0", "0"], &["0", "J2", "0"], &["0", "0", "J3"]]);
    let body = Connection::levi_civita(symbolic(&so3()).left_frame(), &principal).unwrap();
    let mu = |i: usize| -> Symbolic { value(&format!("J1 + J2 + J3 - 2*J{i}")) };
    let ricci =
        |i: usize, j: usize, k: usize| mu(j) * &mu(k) * &value(&format!("J{i}/(2*J1*J2*J3)"));
    let diagonal = [ricci(1, 2, 3), ricci(2, 3, 1), ricci(3, 1, 2)];
    let expected = Tensor::from_fn(3, [Down, Down], |[i, j]| match i == j {
        true => diagonal[i].clone(),
        false => value("0"),
    });
    assert_tensors(&body.ricci(), &expected.unwrap(), "Ric");
    // a flat plate, J3 = J1 + J2: mu_3 = 0
    let plate = metric(&[&["1", "0", "0"], &["0", "2", "0"], &["0", "0", "3"]]);
    let plate = Connection::levi_civita(so3().left_frame(), &plate).unwrap();
    // Ric_33 = 2 mu_1 mu_2 J3 = 2 (4/2)(2/2)/6 * 3
    let expected = tensor(3, [Down, Down], &[([3, 3], "2")]);
    assert_tensors(&plate.ricci(), &expected, "plate");
    // the Heisenberg group with the identity: Ric = diag(-1/2, -1/2, 1/2)
    let one = metric(&[&["1", "0", "0"], &["0", "1", "0"], &["0", "0", "1"]]);
    let nil = Connection::levi_civita(heisenberg().left_frame(), &one).unwrap();
    let expected = [([1, 1], "-1/2"), ([2, 2], "-1/2"), ([3, 3], "1/2")];
    assert_tensors(&nil.ricci(), &tensor(3, [Down, Down], &expected), "Heisenberg");
}

#[test]
fn antisymmetric_torsion_leaves_geodesics_alone() {
    // (+) with the bi-invariant metric has the autoparallels of Levi-Civita, torsion or not
    let two = metric::<Rational>(&[&["2", "0", "0"], &["0", "2", "0"], &["0", "0", "2"]]);
    let levi_civita = Connection::levi_civita(so3().left_frame(), &two).unwrap();
    let zero = crate::paper::epsilons("1/2");
    assert_tensors(levi_civita.gamma(), &zero, "Levi-Civita of a bi-invariant metric is (0)");
}
