//! Section 5: momenta and Euler's equations, (100), (104)-(109).

use crate::common::labels;
use crate::paper::matrices::{self, assert_close};
use crate::paper::{
    affine, algebras, assert_tensors, epsilons, float, heisenberg, inertia, metric,
};
use crate::paper::{parameters, se2, se3, sl2, so3, symbolic, tensor, value, values};
use affinor::geometry::equations::{EquationKind, Equations};
use affinor::{BasisChange, Canonical, Connection, LieAlgebra, Metric};
use affinor_tensors::{Down, Rational, Symbolic, Tensor, Up, contract};

/// `DH/Dt - dH/dt` of a covector along `Omega`: `(nabla_Omega H)_i` of constant components.
fn gyroscopic(
    connection: &Connection<Symbolic>,
    omega: &[Symbolic],
    h: &[Symbolic],
) -> Vec<Symbolic> {
    let nabla = connection.nabla(&Tensor::vector(h, Down)).unwrap();
    assert_eq!(nabla.slots(), [Down, Down]);
    let omega = Tensor::vector(omega, Up);
    let along = contract("D_ki O^k -> _i", &[("D", &nabla), ("O", &omega)]).unwrap();
    along.to_vector().unwrap()
}

/// `g_ij dOmega^j/dt` of the library's equations of motion, under a torque.
fn euler_poincare(
    connection: &Connection<Symbolic>,
    metric: &Metric<Symbolic>,
    (omega, torque): (&[Symbolic], &[Symbolic]),
) -> Vec<Symbolic> {
    let equations = Equations::euler_poincare(connection, metric).unwrap();
    metric.lower(&equations.rate(omega, torque).unwrap()).unwrap()
}

/// `M - share Omega x H`: (15) for a share of 1.
fn euler(
    share: &str,
    (omega, torque): (&[Symbolic], &[Symbolic]),
    h: &[Symbolic],
) -> Vec<Symbolic> {
    let terms = scaled(&cross(omega, h), share);
    torque.iter().zip(&terms).map(|(m, term)| m.clone() - term).collect()
}

fn canonical(algebra: &LieAlgebra<Rational>, which: Canonical) -> Connection<Symbolic> {
    Connection::canonical(&symbolic(algebra), which)
}

/// `Omega x H`, each component as written on paper.
fn cross(omega: &[Symbolic], h: &[Symbolic]) -> Vec<Symbolic> {
    let term = |i: usize, j: usize| omega[i].clone() * &h[j] - &(omega[j].clone() * &h[i]);
    vec![term(1, 2), term(2, 0), term(0, 1)]
}

fn scaled(v: &[Symbolic], share: &str) -> Vec<Symbolic> {
    v.iter().map(|v| v.clone() * &value(share)).collect()
}

#[test]
fn eq_100_structure_and_inertia_change_basis_together() {
    let change = |rows: [[&str; 3]; 3]| {
        let a = Tensor::<Symbolic>::from_fn(3, [Up, Down], |[i, j]| value(rows[i][j])).unwrap();
        BasisChange::new(a).unwrap()
    };
    let c = symbolic(&so3());
    // a rotation of the axes keeps c = eps; columns are the new vectors
    let turned = change([["3/5", "-4/5", "0"], ["4/5", "3/5", "0"], ["0", "0", "1"]]);
    let after = c.change_basis(&turned).unwrap();
    assert_tensors(after.structure(), &epsilons("1"), "a rotation keeps eps");
    let j = turned.apply(inertia().components()).unwrap();
    let expected = "9/25*J11 + 24/25*J12 + 16/25*J22";
    assert_eq!(j.get(&[0, 0]), value(expected), "J' = A^T J A");
    assert_eq!(j.get(&[0, 2]), value("3/5*J13 + 4/5*J23"));
    // a scaling does not: [2 e1, e2] = 2 e3
    let doubled = change([["2", "0", "0"], ["0", "1", "0"], ["0", "0", "1"]]);
    let scaled = c.change_basis(&doubled).unwrap();
    let expected = tensor(
        3,
        [Up, Down, Down],
        &[
            ([3, 1, 2], "2"),
            ([3, 2, 1], "-2"),
            ([2, 3, 1], "2"),
            ([2, 1, 3], "-2"),
            ([1, 2, 3], "1/2"),
            ([1, 3, 2], "-1/2"),
        ],
    );
    assert_tensors(scaled.structure(), &expected, "scaled");
    // Euler's equations of the scaled basis are those of the old one: with Omega' = (w1/2, w2, w3)
    // and H' = (2 H1, H2, H3), the first of (Omega x H) doubles, the others stay
    let g = doubled.apply(inertia().components()).unwrap();
    let g = Metric::new(labels(3), g).unwrap();
    let omega = values(["w1/2", "w2", "w3"]);
    let found = gyroscopic(
        &Connection::canonical(&scaled, Canonical::Plus),
        &omega,
        &g.lower(&omega).unwrap(),
    );
    let old = parameters("w", 3);
    let mut expected = cross(&old, &inertia().lower(&old).unwrap());
    expected[0] = expected[0].clone() * &value("2");
    assert_eq!(found, expected);
    // J alone in the new basis, with the old c, gives other equations
    let mixed = gyroscopic(&canonical(&so3(), Canonical::Plus), &omega, &g.lower(&omega).unwrap());
    assert_ne!(mixed, expected);
}

#[test]
fn eq_104_lowering_does_not_commute_with_d_dt() {
    let plus = canonical(&so3(), Canonical::Plus);
    let omega = parameters("w", 3);
    let h = inertia().lower(&omega).unwrap();
    // of the vector: Lambda^i_jk Omega^j Omega^k = 0
    let nabla = plus.nabla(&Tensor::vector(&omega, Up)).unwrap();
    let operands = [("D", &nabla), ("O", &Tensor::vector(&omega, Up))];
    let of_vector = contract("D^i_k O^k -> ^i", &operands).unwrap();
    assert!(of_vector.is_empty(), "J Domega/Dt is J domega/dt");
    let autoparallel = Equations::new(EquationKind::Autoparallel, &plus, None).unwrap();
    assert_eq!(autoparallel.rate(&omega, &[]).unwrap(), values(["0", "0", "0"]));
    // of the covector: the gyroscopic term
    let of_covector = gyroscopic(&plus, &omega, &h);
    let first = "w2*(J13*w1 + J23*w2 + J33*w3) - w3*(J12*w1 + J22*w2 + J23*w3)";
    assert_eq!(of_covector[0], value(first));
    // and that is what the equations have: J dOmega/dt = M - Omega x H
    let torque = parameters("M", 3);
    let found = euler_poincare(&plus, &inertia(), (&omega, &torque));
    assert_eq!(found, euler("1", (&omega, &torque), &h));
}

#[test]
fn after_105_nabla_of_the_dual_frame() {
    // nabla_{e_k} e^j = -Lambda^j_ki e^i on aff(1): e^2 goes to -Lambda^2_12 e^2 along e1 and to
    // -Lambda^2_21 e^1 along e2
    let plus = Connection::canonical(&affine(), Canonical::Plus);
    let dual = Tensor::vector(&values(["0", "1"]), Down);
    let expected = tensor(2, [Down, Down], &[([1, 2], "-1"), ([2, 1], "1")]);
    assert_tensors(&plus.nabla(&dual).unwrap(), &expected, "nabla e^2");
    let first = Tensor::vector(&values(["1", "0"]), Down);
    assert!(plus.nabla(&first).unwrap().is_empty(), "nabla e^1");
    // the product rule on e^j(e_i)
    for (name, algebra) in algebras() {
        let plus = Connection::canonical(&algebra, Canonical::Plus);
        let n = algebra.dimension();
        let unit = |j| (0..n).map(|i| Rational::from(i64::from(i == j))).collect::<Vec<_>>();
        for (i, j) in (0..n).flat_map(|i| (0..n).map(move |j| (i, j))) {
            let of_dual = plus.nabla(&Tensor::vector(&unit(j), Down)).unwrap();
            let of_vector = plus.nabla(&Tensor::vector(&unit(i), Up)).unwrap();
            for k in 0..n {
                let sum = of_dual.get(&[k, i]) + &of_vector.get(&[j, k]);
                assert_eq!(sum, Rational::from(0), "{name} {i} {j} {k}");
            }
        }
    }
}

#[test]
fn eq_106_and_108_plus_gives_euler_equations() {
    let plus = canonical(&so3(), Canonical::Plus);
    let omega = parameters("w", 3);
    let h = inertia().lower(&omega).unwrap();
    assert_eq!(gyroscopic(&plus, &omega, &h), cross(&omega, &h));
    // principal axes: (J3 - J2) w2 w3, (J1 - J3) w3 w1, (J2 - J1) w1 w2
    let principal = metric(&[&["J1", "0", "0"], &["0", "J2", "0"], &["0", "0", "J3"]]);
    let found = gyroscopic(&plus, &omega, &principal.lower(&omega).unwrap());
    let expected = ["(J3 - J2)*w2*w3", "(J1 - J3)*w3*w1", "(J2 - J1)*w1*w2"];
    assert_eq!(found, values(expected));
    let found = euler_poincare(&plus, &principal, (&omega, &parameters("M", 3)));
    let expected = ["M1 + (J2 - J3)*w2*w3", "M2 + (J3 - J1)*w3*w1", "M3 + (J1 - J2)*w1*w2"];
    assert_eq!(found, values(expected));
}

#[test]
fn eq_106_on_other_algebras_is_the_coadjoint_action() {
    // DH_i - Hdot_i = -c^j_ki Omega^k H_j
    let (h2, h3) = (parameters("h", 2), parameters("h", 3));
    let (w2, w3) = (parameters("w", 2), parameters("w", 3));
    let terms = |algebra: &LieAlgebra<Rational>, w: &[Symbolic], h: &[Symbolic]| {
        gyroscopic(&canonical(algebra, Canonical::Plus), w, h)
    };
    assert_eq!(terms(&affine(), &w2, &h2), values(["w2*h2", "-w1*h2"]));
    // [H, E] = 2 E, [H, F] = -2 F, [E, F] = H
    let expected = ["2*w2*h2 - 2*w3*h3", "-2*w1*h2 + w3*h1", "2*w1*h3 - w2*h1"];
    assert_eq!(terms(&sl2(), &w3, &h3), values(expected));
    assert_eq!(terms(&heisenberg(), &w3, &h3), values(["w2*h3", "-w1*h3", "0"]));
    // [e1, e2] = e3, [e1, e3] = -e2
    let expected = ["w2*h3 - w3*h2", "-w1*h3", "w1*h2"];
    assert_eq!(terms(&se2(), &w3, &h3), values(expected));
    // the equations of motion have these terms with the other sign
    let g = metric(&[&["2", "1", "0"], &["1", "3", "-1"], &["0", "-1", "5"]]);
    for algebra in [so3(), sl2(), se2(), heisenberg()] {
        let moving = scaled(&terms(&algebra, &w3, &g.lower(&w3).unwrap()), "-1");
        let plus = canonical(&algebra, Canonical::Plus);
        assert_eq!(euler_poincare(&plus, &g, (&w3, &values(["0", "0", "0"]))), moving);
    }
}

#[test]
fn eq_104_parallel_covectors_are_constant_spatial_momenta() {
    // DH/Dt = 0 along g = exp(t Omega) means that <H, Ad_(g^-1) X> is constant
    let omega = [0.4, -0.3, 0.6];
    let cases = [
        (so3(), matrices::so3()),
        (sl2(), matrices::sl2()),
        (se2(), matrices::se2()),
        (affine(), matrices::affine()),
    ];
    for (algebra, basis) in cases {
        let omega = &omega[..algebra.dimension()];
        let plus = Connection::canonical(&float(&algebra), Canonical::Plus);
        // dH_i/dt = Lambda^j_ki Omega^k H_j: minus the transposed generator of vectors
        let generator = plus.transport_generator(omega).unwrap().to_dmatrix().unwrap();
        let of_covectors = (-generator.transpose() * 1.7).exp();
        let g = (basis.combine(omega) * 1.7).exp();
        let adjoint = basis.conjugation(&matrices::inverse(&g), &g);
        let identity = nalgebra::DMatrix::identity(omega.len(), omega.len());
        assert_close(&(of_covectors.transpose() * adjoint), &identity, "H(t) Ad_(g^-1) = h");
    }
}

#[test]
fn eq_107_is_spin_with_the_lower_index_as_the_row() {
    let plus = canonical(&so3(), Canonical::Plus);
    let omega = Tensor::vector(&parameters("w", 3), Up);
    let operands = [("L", plus.gamma()), ("O", &omega)];
    // row i below, column j above
    let array = contract("-1 L^j_ki O^k -> _i^j", &operands).unwrap();
    let spin = [["0", "-w3", "w2"], ["w3", "0", "-w1"], ["-w2", "w1", "0"]];
    let expected = Tensor::from_fn(3, [Down, Up], |[i, j]| value(spin[i][j])).unwrap();
    assert_tensors(&array, &expected, "spin(Omega)");
    // with the upper index as the row, as in (44), the same numbers are -spin(Omega)
    let array = contract("-1 L^j_ki O^k -> ^j_i", &operands).unwrap();
    let expected = Tensor::from_fn(3, [Up, Down], |[i, j]| value::<Symbolic>(spin[j][i])).unwrap();
    assert_tensors(&array, &expected, "-spin(Omega)");
    assert_eq!(array.get(&[0, 1]), value("w3"));
}

#[test]
fn after_108_zero_gives_half_of_the_gyroscopic_term() {
    let omega = parameters("w", 3);
    let h = inertia().lower(&omega).unwrap();
    let torque = parameters("M", 3);
    let moving = |which| euler_poincare(&canonical(&so3(), which), &inertia(), (&omega, &torque));
    let of = |share| euler(share, (&omega, &torque), &h);
    assert_eq!(moving(Canonical::Plus), of("1"));
    assert_eq!(moving(Canonical::Zero), of("1/2"));
    assert_eq!(moving(Canonical::Minus), of("0"));
    assert_ne!(of("1/2"), of("1"));
    // numbers: J = diag(1,2,3), Omega = (1,1,1): Omega x H = (1,-2,1)
    let g = metric(&[&["1", "0", "0"], &["0", "2", "0"], &["0", "0", "3"]]);
    let (omega, free) = (values(["1", "1", "1"]), values(["0", "0", "0"]));
    let moving = |which| euler_poincare(&canonical(&so3(), which), &g, (&omega, &free));
    assert_eq!(moving(Canonical::Plus), values(["-1", "2", "-1"]));
    assert_eq!(moving(Canonical::Zero), values(["-1/2", "1", "-1/2"]));
}

/// `Lambda^j_mi Omega^i Omega^m H_j`
fn power(connection: &Connection<Symbolic>) -> Symbolic {
    let n = connection.frame().dimension();
    let omega = Tensor::vector(&parameters("w", n), Up);
    let h = Tensor::vector(&parameters("h", n), Down);
    let once = contract("L^j_mi O^m -> ^j_i", &[("L", connection.gamma()), ("O", &omega)]).unwrap();
    let twice = contract("L^j_i O^i -> ^j", &[("L", &once), ("O", &omega)]).unwrap();
    contract("v^j h_j ->", &[("v", &twice), ("h", &h)]).unwrap().to_scalar().unwrap()
}

#[test]
fn eq_109_the_connection_does_no_work() {
    for algebra in [so3(), se2(), affine(), sl2(), heisenberg(), se3()] {
        for which in [Canonical::Plus, Canonical::Zero] {
            assert_eq!(power(&canonical(&algebra, which)), value("0"));
        }
    }
    // affinities that are not antisymmetric do: Levi-Civita of diag(1,1,J) on so(3) has
    // nabla_w w = (0, 0, 0) + ((J - 1) w2 w3, (1 - J) w1 w3, 0)
    let g = metric(&[&["1", "0", "0"], &["0", "1", "0"], &["0", "0", "J"]]);
    let body = Connection::levi_civita(symbolic(&so3()).left_frame(), &g).unwrap();
    assert_eq!(power(&body), value("(J - 1)*w3*(w2*h1 - w1*h2)"));
}
