//! Appendices A and B: frames, brackets, connections, torsion and curvature, (A1)-(B14).

use crate::common::charts::{constant, sum};
use crate::common::labels;
use crate::paper::charts::groups;
use crate::paper::{affine, assert_tensors, metric, se2, sl2, so3, tensor, value, values};
use affinor::{Bracket, Canonical, Connection, Error, Frame, Metric};
use affinor_tensors::{Down, Rational, Symbolic, Tensor, Up};

/// `X(f) = X^i e_i(f)` with the derivatives of the engine's frame: (A1).
fn directional(frame: &Frame<Symbolic>, x: &[Symbolic], f: &Symbolic) -> Symbolic {
    let n = frame.dimension();
    let f = Tensor::from_components(n, &[], [([0; 0], f.clone())]).unwrap();
    let df = frame.derivative(&f).unwrap();
    sum((0..n).map(|i| x[i].clone() * &df.get(&[i])))
}

#[test]
fn eq_a1_and_a2_frame_derivatives_are_quasi_derivatives() {
    for group in groups() {
        let frame = group.frame();
        let names = group.chart.names;
        let f = names.iter().fold(constant(1), |f, name| f * &Symbolic::parameter(name))
            + &Symbolic::parameter(names[0]);
        for i in 0..group.n() {
            let unit: Vec<_> = (0..group.n()).map(|j| constant(i64::from(i == j))).collect();
            // e_i(f) = e_i^a df/dtheta^a
            let partials = names.iter().zip(group.left(i));
            let expected = sum(partials.map(|(name, e)| f.derivative(name) * &e));
            assert_eq!(directional(&frame, &unit, &f), expected, "{} {i}", group.name);
        }
    }
    // e_1 = a d/da on Aff(1): not the partial derivative
    let frame = crate::paper::charts::affine().frame();
    let found = directional(&frame, &values(["1", "0"]), &value("a^2"));
    assert_eq!(found, value("2*a^2"));
}

#[test]
fn eq_a3_to_a7_bracket_of_fields_is_the_commutator_of_derivations() {
    for group in groups() {
        let (frame, [x, y]) = (group.frame(), group.fields());
        let name = |i: usize| Symbolic::parameter(group.chart.names[i]);
        let f = name(0) * &name(0) * &name(1) + &name(group.n() - 1);
        let of = |v: &[Symbolic], f: &Symbolic| directional(&frame, v, f);
        let commutator = of(&x, &of(&y, &f)) - &of(&y, &of(&x, &f));
        assert_eq!(of(&group.bracket(&x, &y), &f), commutator, "{}", group.name);
    }
}

#[test]
fn eq_a9_coordinate_frames_have_no_structure() {
    let frame = Frame::coordinates(&["x", "y", "z"]).unwrap();
    assert!(frame.structure().is_empty());
    let found = directional(&frame, &values(["0", "1", "0"]), &value("x*y^2"));
    assert_eq!(found, value("2*x*y"));
}

#[test]
fn eq_a10_structure_is_antisymmetric() {
    // c^2_12 = 1 without c^2_21 is refused, with the pair and the residual
    let half = tensor::<Rational, 3>(2, [Up, Down, Down], &[([2, 1, 2], "1")]);
    match Bracket::new(labels(2), half) {
        Err(Error::NotAntisymmetric { x, y, residual }) => {
            assert_eq!([x.as_str(), y.as_str(), residual.as_str()], ["e1", "e2", "e2"]);
        }
        other => panic!("{other:?}"),
    }
    assert_eq!(affine().structure().get(&[1, 1, 0]), Rational::from(-1));
}

/// Affinities of functions without a pattern, over the left frame of a group.
fn wild(group: &crate::paper::charts::Group) -> Connection<Symbolic> {
    let n = group.n();
    let name = |at: usize| Symbolic::parameter(group.chart.names[at % n]);
    let gamma = Tensor::from_fn(n, [Up, Down, Down], |[i, j, k]| match (i + 2 * j + k) % 4 {
        0 => name(i + j) * &constant(j as i64 - 2 * k as i64),
        1 => name(k) * &name(j) + &constant(i as i64),
        2 => constant(j as i64 + 1),
        _ => constant(0),
    });
    Connection::new(group.frame(), gamma.unwrap()).unwrap()
}

/// `nabla_X Y` in left components.
fn along(connection: &Connection<Symbolic>, x: &[Symbolic], y: &[Symbolic]) -> Vec<Symbolic> {
    let nabla = connection.nabla(&Tensor::vector(y, Up)).unwrap();
    let n = x.len();
    (0..n).map(|i| sum((0..n).map(|m| nabla.get(&[i, m]) * &x[m]))).collect()
}

#[test]
fn eq_b1_first_lower_index_is_the_direction() {
    // nabla_{e1} e2 = 5 e2 alone
    let gamma = tensor::<Rational, 3>(2, [Up, Down, Down], &[([2, 1, 2], "5")]);
    let connection = Connection::new(affine().left_frame().clone(), gamma).unwrap();
    let second = connection.nabla(&Tensor::vector(&values(["0", "1"]), Up)).unwrap();
    assert_tensors(&second, &tensor(2, [Up, Down], &[([2, 1], "5")]), "nabla e2");
    let first = connection.nabla(&Tensor::vector(&values(["1", "0"]), Up)).unwrap();
    assert!(first.is_empty(), "nabla e1");
}

#[test]
fn eq_b2_and_b3_nabla_of_a_vector_field() {
    for group in groups() {
        let (connection, [w, v]) = (wild(&group), group.fields());
        let gamma = connection.gamma();
        // (e_i(v^k) + Lambda^k_ij v^j) w^i, by loops
        let expected: Vec<_> = (0..group.n())
            .map(|k| {
                sum((0..group.n()).map(|i| {
                    let turned = sum((0..group.n()).map(|j| gamma.get(&[k, i, j]) * &v[j]));
                    (group.chart.derive(i, &v[k]) + &turned) * &w[i]
                }))
            })
            .collect();
        assert_eq!(along(&connection, &w, &v), expected, "{}", group.name);
    }
}

#[test]
fn eq_b4_and_b5_parallel_fields() {
    // the right-invariant field d/db = e_2/a of Aff(1) is parallel for (+)
    let group = crate::paper::charts::affine();
    let gamma = group.chart.algebra.structure().clone();
    let plus = Connection::new(group.frame(), gamma).unwrap();
    let parallel = plus.nabla(&Tensor::vector(&values(["0", "1/a"]), Up)).unwrap();
    assert!(parallel.is_empty());
    // e_2 itself turns along e_1: vdot^2 = -Lambda^2_12 w^1 v^2
    let turning = plus.nabla(&Tensor::vector(&values(["0", "1"]), Up)).unwrap();
    assert_eq!(turning.get(&[1, 0]), value("1"));
}

#[test]
fn eq_b7_and_b8_antisymmetric_affinities_keep_autoparallels_constant() {
    let plus = Connection::canonical(&sl2(), Canonical::Plus);
    assert!(plus.transport_generator(&values(["1", "2", "3"])).is_ok());
    // only the symmetric part enters (B7): Lambda^1_12 = 1 and Lambda^1_21 = -1 do not move n,
    // Lambda^1_12 = 1 alone does, by n1 n2
    let frame = affine().left_frame().clone();
    let gamma = |table: &[([usize; 3], &str)]| tensor::<Rational, 3>(2, [Up, Down, Down], table);
    let both = gamma(&[([1, 1, 2], "1"), ([1, 2, 1], "-1")]);
    let both = Connection::new(frame.clone(), both).unwrap();
    assert!(both.transport_generator(&values(["2", "3"])).is_ok());
    let one = Connection::new(frame, gamma(&[([1, 1, 2], "1")])).unwrap();
    match one.transport_generator(&values(["2", "3"])) {
        Err(Error::NotAutoparallel { residual, .. }) => assert_eq!(residual, "6*e1"),
        other => panic!("{other:?}"),
    }
}

#[test]
fn eq_b9_and_b10_torsion() {
    for group in groups() {
        let (connection, [x, y]) = (wild(&group), group.fields());
        let torsion = connection.torsion();
        let (xy, yx) = (along(&connection, &x, &y), along(&connection, &y, &x));
        let bracket =
            group.to_frame(&group.lie(&group.to_coordinates(&x), &group.to_coordinates(&y)));
        for i in 0..group.n() {
            // nabla_X Y - nabla_Y X - [X, Y]
            let expected = xy[i].clone() - &yx[i] - &bracket[i];
            let pairs = (0..group.n()).flat_map(|j| (0..group.n()).map(move |k| (j, k)));
            let terms = pairs.map(|(j, k)| torsion.get(&[i, j, k]) * &x[j] * &y[k]);
            assert_eq!(sum(terms), expected, "{} {i}", group.name);
        }
    }
    // (B10) by hand on aff(1): Lambda^2_12 = 5, Lambda^2_21 = 2, c^2_12 = 1: tau^2_12 = 2
    let gamma = tensor::<Rational, 3>(2, [Up, Down, Down], &[([2, 1, 2], "5"), ([2, 2, 1], "2")]);
    let connection = Connection::new(affine().left_frame().clone(), gamma).unwrap();
    let expected = tensor(2, [Up, Down, Down], &[([2, 1, 2], "2"), ([2, 2, 1], "-2")]);
    assert_tensors(&connection.torsion(), &expected, "tau");
}

#[test]
fn eq_b11_without_torsion_structure_is_the_antisymmetric_part() {
    let g3 = metric(&[&["2", "1", "0"], &["1", "3", "-1"], &["0", "-1", "5"]]);
    for algebra in [so3(), sl2(), se2()] {
        let connection = Connection::levi_civita(algebra.left_frame(), &g3).unwrap();
        let (gamma, c) = (connection.gamma(), algebra.structure());
        for (i, j, k) in (0..27).map(|at| (at / 9, at / 3 % 3, at % 3)) {
            let antisymmetric = gamma.get(&[i, j, k]) - &gamma.get(&[i, k, j]);
            assert_eq!(antisymmetric, c.get(&[i, j, k]));
        }
        assert!(connection.torsion().is_empty());
    }
}

/// The Levi-Civita connection of `g` in the coordinates of its parameters.
fn in_coordinates(names: &[&str], g: &[&[&str]]) -> (Connection<Symbolic>, Metric<Symbolic>) {
    let frame = Frame::coordinates(names).unwrap();
    let g = metric(g);
    (Connection::levi_civita(&frame, &g).unwrap(), g)
}

#[test]
fn eq_b12_in_coordinates_symmetric_affinities_have_no_torsion() {
    // the plane in polar coordinates: Lambda^r_tt = -r, Lambda^t_rt = Lambda^t_tr = 1/r, flat
    let (polar, _) = in_coordinates(&["r", "t"], &[&["1", "0"], &["0", "r^2"]]);
    let expected =
        tensor(2, [Up, Down, Down], &[([1, 2, 2], "-r"), ([2, 1, 2], "1/r"), ([2, 2, 1], "1/r")]);
    assert_tensors(polar.gamma(), &expected, "polar coordinates");
    assert!(polar.torsion().is_empty() && polar.curvature().is_empty());
    // the half plane: K = -1
    let (half, g) = in_coordinates(&["x", "y"], &[&["1/y^2", "0"], &["0", "1/y^2"]]);
    let expected = tensor(
        2,
        [Up, Down, Down],
        &[([1, 1, 2], "-1/y"), ([1, 2, 1], "-1/y"), ([2, 1, 1], "1/y"), ([2, 2, 2], "-1/y")],
    );
    assert_tensors(half.gamma(), &expected, "half plane");
    let k = half.sectional_curvature(&g, &values(["1", "0"]), &values(["0", "1"])).unwrap();
    assert_eq!(k, Some(value("-1")));
    // affinities that are not symmetric have their antisymmetric part as torsion
    let gamma = tensor(2, [Up, Down, Down], &[([1, 1, 2], "x")]);
    let twisted = Connection::new(Frame::coordinates(&["x", "y"]).unwrap(), gamma).unwrap();
    let expected = tensor(2, [Up, Down, Down], &[([1, 1, 2], "x"), ([1, 2, 1], "-x")]);
    assert_tensors(&twisted.torsion(), &expected, "torsion");
}

#[test]
fn eq_b12_canonical_connections_in_the_coordinates_of_the_group() {
    // Aff(1): d/da = e_1/a, d/db = e_2/a. For (0) nabla_{e1} e2 = 1/2 e2 = -nabla_{e2} e1, so
    // nabla_a d_b = e_1(1/a)/a e_2 + 1/2 e_2/a^2 = -1/(2a) d_b = nabla_b d_a, nabla_a d_a = -1/a d_a
    let frame = Frame::coordinates(&["a", "b"]).unwrap();
    let zero = tensor(
        2,
        [Up, Down, Down],
        &[([1, 1, 1], "-1/a"), ([2, 1, 2], "-1/2/a"), ([2, 2, 1], "-1/2/a")],
    );
    let zero = Connection::new(frame, zero).unwrap();
    assert!(zero.torsion().is_empty());
    // curvature is a tensor: R(e1,e2) e1 = -1/4 [e2, e1] = 1/4 e2, so R(d_a,d_b) d_a = 1/4 d_b/a^2
    let expected =
        tensor(2, [Up, Down, Down, Down], &[([2, 1, 1, 2], "1/4/a^2"), ([2, 1, 2, 1], "-1/4/a^2")]);
    assert_tensors(zero.curvature(), &expected, "curvature of (0) in coordinates");
}

#[test]
fn eq_b13_and_b14_curvature_is_the_commutator_of_covariant_derivatives() {
    for group in groups() {
        let (connection, [x, y]) = (wild(&group), group.fields());
        let curvature = connection.curvature();
        let v: Vec<_> = x.iter().zip(&y).map(|(x, y)| x.clone() - &(y.clone() * y)).collect();
        let bracket =
            group.to_frame(&group.lie(&group.to_coordinates(&x), &group.to_coordinates(&y)));
        let of = |x: &[Symbolic], v: &[Symbolic]| along(&connection, x, v);
        let (xy, yx) = (of(&x, &of(&y, &v)), of(&y, &of(&x, &v)));
        let commutator = of(&bracket, &v);
        for i in 0..group.n() {
            let expected = xy[i].clone() - &yx[i] - &commutator[i];
            // R^i_jkl v^j X^k Y^l
            let terms = curvature.components().filter(|(at, _)| at[0] == i);
            let terms = terms.map(|(at, r)| r.clone() * &v[at[1]] * &x[at[2]] * &y[at[3]]);
            assert_eq!(sum(terms), expected, "{} {i}", group.name);
        }
    }
}

#[test]
fn eq_b14_by_hand_with_a_position_dependent_affinity() {
    // Aff(1), Lambda^1_22 = a^2 b alone: e_1 = a d/da. R^1_212 = e_1(a^2 b) - c^2_12 a^2 b = a^2 b
    let group = crate::paper::charts::affine();
    let gamma = tensor(2, [Up, Down, Down], &[([1, 2, 2], "a^2*b")]);
    let connection = Connection::new(group.frame(), gamma).unwrap();
    let expected =
        tensor(2, [Up, Down, Down, Down], &[([1, 2, 1, 2], "a^2*b"), ([1, 2, 2, 1], "-a^2*b")]);
    assert_tensors(connection.curvature(), &expected, "R");
    // constants without a frame derivative, by hand: Lambda^1_12 = 2, Lambda^2_21 = 3, c^2_12 = 1
    // R^1_112 = Lambda^1_12 Lambda^2_21 = 6, R^2_212 = -Lambda^2_21 Lambda^1_12 = -6,
    // R^2_112 = -c^2_12 Lambda^2_21 = -3
    let gamma = tensor::<Rational, 3>(2, [Up, Down, Down], &[([1, 1, 2], "2"), ([2, 2, 1], "3")]);
    let connection = Connection::new(affine().left_frame().clone(), gamma).unwrap();
    let curvature = connection.curvature();
    assert_eq!(curvature.get(&[0, 0, 0, 1]), Rational::from(6));
    assert_eq!(curvature.get(&[1, 1, 0, 1]), Rational::from(-6));
    assert_eq!(curvature.get(&[1, 0, 0, 1]), Rational::from(-3));
    assert_eq!(curvature.len(), 6);
}
