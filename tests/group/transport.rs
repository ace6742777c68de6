//! Parallel translation and autoparallels on groups, against closed forms and conservation laws.

use crate::common::property::properties;
use affinor::geometry::equations::{EquationKind, Equations};
use affinor::group::transport::{ParallelTranslation, TangentVector};
use affinor::group::{Coordinates, Heisenberg, LieGroup, MatrixGroup, Se2, Se3, Sl2, So2, So3};
use affinor::{Bracket, CanonicalConnection, Connection, Error, LieAlgebra, Metric};
use affinor_tensors::{Down, Tensor};
use nalgebra::{Const, DMatrix, DVector, Matrix3, UnitQuaternion, Vector3};
use proptest::prelude::*;
use std::f64::consts::{PI, TAU};

fn so3() -> LieAlgebra<f64> {
    So3.algebra().unwrap()
}

fn canonical(which: CanonicalConnection) -> ParallelTranslation<So3> {
    ParallelTranslation::new(So3, Connection::canonical(&so3(), which)).unwrap()
}

fn levi_civita(j: Matrix3<f64>) -> ParallelTranslation<So3> {
    let algebra = so3();
    let metric = Tensor::from_fn(3, [Down, Down], |[i, k]| j[(i, k)]).unwrap();
    let metric = Metric::new(algebra.labels(), metric).unwrap();
    let connection = Connection::levi_civita(algebra.left_frame(), &metric).unwrap();
    ParallelTranslation::new(So3, connection).unwrap()
}

fn vector() -> impl Strategy<Value = Vector3<f64>> {
    [-1.5..1.5, -1.5..1.5, -1.5..1.5f64].prop_map(Vector3::from)
}

/// A metric that is not diagonal.
fn full<G: LieGroup + Clone>(group: &G) -> ParallelTranslation<G> {
    let algebra = group.algebra().unwrap();
    let entry = |[i, j]: [usize; 2]| if i == j { 2.0 + i as f64 } else { 0.3 / (i + j) as f64 };
    let metric = Tensor::from_fn(group.dimension(), [Down, Down], entry).unwrap();
    let metric = Metric::new(algebra.labels(), metric).unwrap();
    let connection = Connection::levi_civita(algebra.left_frame(), &metric).unwrap();
    ParallelTranslation::new(group.clone(), connection).unwrap()
}

/// Along `exp(s x)`, in left-invariant components: plus is right translation, zero `L_sqrt(p)
/// R_sqrt(p)`, minus left translation. For every connection, transport there and back is the
/// identity.
fn laws<G: LieGroup + Clone>(group: G, numbers: &[f64; 6]) {
    let x = G::Vector::from_components(&numbers[..group.dimension()]);
    let algebra = group.algebra().unwrap();
    let on_group = |which| {
        let connection = Connection::canonical(&algebra, which);
        ParallelTranslation::new(group.clone(), connection).unwrap()
    };
    let back = |share: f64| {
        let p = group.exp(&(x.clone() * -share));
        group.operator_matrix(|u| group.adjoint(&p, u))
    };
    let scale = 1.0 + back(1.0).amax() + back(-1.0).amax();
    let cases = [
        (CanonicalConnection::Plus, 1.0),
        (CanonicalConnection::Zero, 0.5),
        (CanonicalConnection::Minus, 0.0),
    ];
    for (which, share) in cases {
        let off = on_group(which).along_subgroup(&x).unwrap() - back(share);
        assert!(off.amax() < 1e-13 * scale, "{which:?}: {off}");
    }
    let loops =
        [on_group(CanonicalConnection::Plus), on_group(CanonicalConnection::Zero), full(&group)];
    for on_group in loops {
        let there = on_group.along_subgroup(&x).unwrap();
        let both = on_group.along_subgroup(&-x.clone()).unwrap() * &there;
        let off = (both - DMatrix::identity(there.nrows(), there.nrows())).amax();
        assert!(off < 1e-12 * there.amax() * (1.0 + there.amax()), "{off}");
    }
}

/// Whether the loops of an arc of this length and of two such arcs are computed without an error.
fn there_and_back_far<G: LieGroup + Clone>(group: G, numbers: &[f64; 6], length: f64) -> bool {
    let n = group.dimension();
    let vector = |at: usize| {
        let turned: Vec<f64> = (0..n).map(|i| length * numbers[(at + i) % 6]).collect();
        G::Vector::from_components(&turned)
    };
    let (x, y) = (vector(0), vector(3));
    let on_group = full(&group);
    let mut all = true;
    for arcs in [vec![x.clone(), -x.clone()], vec![x.clone(), y.clone(), -y, -x]] {
        match on_group.along_arcs(&arcs) {
            Ok(around) if around.iter().all(|entry| entry.is_finite()) => {
                let off = (around - DMatrix::identity(n, n)).amax();
                assert!(off < 1e-4, "{length}: {off:e}");
            }
            // outside the range of floats
            Ok(_) => all = false,
            Err(Error::Invalid { .. }) => all = false,
            Err(error) => panic!("{error}"),
        }
    }
    all
}

/// Transport is an error if only rounding errors are left, and not before.
#[test]
fn rounding_of_long_arcs() {
    let algebra = Sl2.algebra().unwrap();
    let plus = Connection::canonical(&algebra, CanonicalConnection::Plus);
    let on_group = ParallelTranslation::new(Sl2, plus).unwrap();
    let there_and_back = |length: f64| {
        let x = Vector3::new(length, length, 0.0);
        on_group.along_arcs(&[x, -x])
    };
    let off = (there_and_back(5.0).unwrap() - DMatrix::identity(3, 3)).amax();
    assert!(off < 1e-6, "{off:e}");
    let reason = there_and_back(10.0).unwrap_err().to_string();
    assert!(reason.contains("rounding errors of the arcs"), "{reason}");
    // eigenvectors of ad with the values 2 and -2: the shrinking one has no correct digits when the
    // other has grown by 1e8
    let boost = |length: f64| on_group.along_arcs(&[Vector3::new(length, length, 0.0)]).unwrap();
    let shrinks = Vector3::new(1.0, -1.0, -1.0);
    let carried = on_group.carry(&boost(2.0), &shrinks).unwrap();
    let expected = DVector::from_column_slice(shrinks.as_slice()) * (-4f64).exp();
    assert!((&carried - &expected).amax() < 1e-13, "{carried}");
    assert!(on_group.carry(&boost(9.0), &shrinks).is_err());
    assert!(on_group.carry(&boost(9.0), &Vector3::new(1.0, -1.0, 1.0)).is_ok());
    // ten thousand rotation arcs
    let turn = |k: i32| Vector3::new(f64::from(k).sin(), f64::from(k).cos(), 0.3);
    let many: Vec<_> = (0..10_000).map(turn).collect();
    let matrix = canonical(CanonicalConnection::Zero).along_arcs(&many).unwrap();
    assert!((matrix.transpose() * &matrix - DMatrix::identity(3, 3)).amax() < 1e-11);
}

/// The rotation matrix as a dynamic matrix.
fn rotation(g: &UnitQuaternion<f64>) -> DMatrix<f64> {
    So3.matrix(g)
}

/// An analytic curve through the identity with all components of its velocity.
fn curve(t: f64) -> UnitQuaternion<f64> {
    So3.compose(
        &So3.exp(&Vector3::new(t.sin(), t, -t * t)),
        &So3.exp(&Vector3::new(0.0, t.cos() - 1.0, 2.0 * t)),
    )
}

/// The velocity `g^-1 g'` of the curve by the product rule, with the tangent operator of each
/// factor.
fn velocity(t: f64) -> Vector3<f64> {
    let (x, y) = (Vector3::new(t.sin(), t, -t * t), Vector3::new(0.0, t.cos() - 1.0, 2.0 * t));
    let (dx, dy) = (Vector3::new(t.cos(), 1.0, -2.0 * t), Vector3::new(0.0, -t.sin(), 2.0));
    let back = So3.inverse(&So3.exp(&y));
    So3.adjoint(&back, &So3.tangent_left(&x, &dx)) + So3.tangent_left(&y, &dy)
}

properties! {
    #![cases(256)]

    #[test]
    fn translation_on_every_group(numbers in proptest::array::uniform6(-1.5..1.5f64)) {
        let stretch = DMatrix::from_row_slice(2, 2, &[1.0, 0.0, 0.0, 0.0]);
        let shift = DMatrix::from_row_slice(2, 2, &[0.0, 1.0, 0.0, 0.0]);
        laws(MatrixGroup::new(&[stretch, shift]).unwrap(), &numbers);
        laws(So2, &numbers);
        laws(Se2, &numbers);
        laws(Se3, &numbers);
        laws(Sl2, &numbers);
        laws(Heisenberg::<Const<5>>::new(), &numbers);
    }

    /// Along long arcs and back, results are right unless they are errors.
    #[test]
    fn long_arcs(numbers in proptest::array::uniform6(-1.5..1.5f64), length in 0.0..4.0f64) {
        let length = 10f64.powf(length);
        let stretch = DMatrix::from_row_slice(2, 2, &[1.0, 0.0, 0.0, 0.0]);
        let shift = DMatrix::from_row_slice(2, 2, &[0.0, 1.0, 0.0, 0.0]);
        there_and_back_far(MatrixGroup::new(&[stretch, shift]).unwrap(), &numbers, length);
        there_and_back_far(Sl2, &numbers, length);
        there_and_back_far(Se3, &numbers, length);
        // on a compact group every length is allowed
        prop_assert!(there_and_back_far(So3, &numbers, length));
    }

    /// Plus is right translation, minus left translation, zero `L_sqrt(p) R_sqrt(p)`: all in
    /// left-invariant components at `p = exp(x)`.
    #[test]
    fn canonical_translations_are_those_of_the_group(x in vector(), u in vector()) {
        let u_dynamic = DVector::from_column_slice(u.as_slice());
        let carried = |which| canonical(which).along_subgroup(&x).unwrap() * &u_dynamic;
        let p = So3.exp(&x);
        // R_p* u = u p = p (p^-1 u p)
        let right = So3.adjoint(&So3.inverse(&p), &u);
        prop_assert!((carried(CanonicalConnection::Plus) - DVector::from_column_slice(right.as_slice())).amax() < 1e-14);
        prop_assert!((carried(CanonicalConnection::Minus) - &u_dynamic).amax() == 0.0);
        let half = So3.adjoint(&So3.inverse(&So3.exp(&(x * 0.5))), &u);
        prop_assert!((carried(CanonicalConnection::Zero) - DVector::from_column_slice(half.as_slice())).amax() < 1e-14);
    }

    /// For every connection, transport along an arc and back is the identity.
    #[test]
    fn there_and_back(x in vector(), j in vector()) {
        let inertia = Matrix3::from_diagonal(&Vector3::new(2.0, 3.0, 4.0)) + j * j.transpose();
        for on_group in [canonical(CanonicalConnection::Plus), canonical(CanonicalConnection::Zero), levi_civita(inertia)] {
            let both = on_group.along_subgroup(&-x).unwrap() * on_group.along_subgroup(&x).unwrap();
            prop_assert!((both - DMatrix::identity(3, 3)).amax() < 1e-13);
        }
    }

    /// Levi-Civita preserves lengths and angles: `B^T g B = g`.
    #[test]
    fn levi_civita_keeps_the_metric(j in vector()) {
        let inertia = Matrix3::from_diagonal(&Vector3::new(2.0, 3.0, 4.0)) + j * j.transpose();
        let on_group = levi_civita(inertia);
        let carried = on_group.along_curve(velocity, &[0.0, 1.0], 1e-12).unwrap();
        let g = DMatrix::from_column_slice(3, 3, inertia.as_slice());
        prop_assert!((carried[1].transpose() * &g * &carried[1] - &g).amax() < 1e-10);
    }
}

/// On M(3) transport depends on the end points only: `B = Ad_{q^-1 p}`. On SO(3) it depends on the
/// curve.
#[test]
fn translation_is_path_independent_on_m3_alone() {
    let (start, end) = (curve(0.0), curve(2.0));
    let plus = canonical(CanonicalConnection::Plus);
    let along = plus.along_curve(velocity, &[0.0, 2.0], 1e-12).unwrap();
    let right = rotation(&So3.compose(&So3.inverse(&end), &start));
    assert!((&along[1] - &right).amax() < 1e-11);
    let straight = plus.along_samples(&[start, end]).unwrap();
    assert!((&along[1] - straight).amax() < 1e-11);

    let zero = canonical(CanonicalConnection::Zero);
    let along = zero.along_curve(velocity, &[0.0, 2.0], 1e-12).unwrap();
    let straight = zero.along_samples(&[start, end]).unwrap();
    assert!((&along[1] - straight).amax() > 0.1);
}

/// The error of transport along samples is of second order in their distance.
#[test]
fn samples_are_of_second_order() {
    let zero = canonical(CanonicalConnection::Zero);
    let exact = &zero.along_curve(velocity, &[0.0, 1.0], 1e-13).unwrap()[1];
    let error = |n: usize| {
        let samples: Vec<_> = (0..=n).map(|i| curve(i as f64 / n as f64)).collect();
        (zero.along_samples(&samples).unwrap() - exact).norm()
    };
    let order = (error(40) / error(80)).log2();
    assert!((order - 2.0).abs() < 0.05, "{order}");
}

/// Transport around the closed subgroup of full turns is the identity on M(3) and a half turn on
/// SO(3) (after (71)). Transport around a small loop is a rotation by curvature times area.
#[test]
fn holonomy_of_loops() {
    let turn = Vector3::new(0.0, TAU, 0.0);
    let plus = canonical(CanonicalConnection::Plus).along_subgroup(&turn).unwrap();
    assert!((plus - DMatrix::identity(3, 3)).amax() < 1e-14);
    let zero = canonical(CanonicalConnection::Zero).along_subgroup(&turn).unwrap();
    let half_turn = rotation(&So3.exp(&Vector3::new(0.0, PI, 0.0)));
    assert!((zero - half_turn).amax() < 1e-14);

    // R(e1, e2) e2 = e1/4 along the square with side h in the plane of e1 and e2; the bracket of
    // the sides closes the loop
    let h = 1e-3;
    let sides =
        [Vector3::x(), Vector3::y(), -Vector3::x(), -Vector3::y()].map(|e| So3.exp(&(e * h)));
    let mut corners = vec![So3.identity()];
    for side in sides {
        corners.push(So3.compose(&corners[corners.len() - 1], &side));
    }
    corners.push(So3.identity());
    let on_group = canonical(CanonicalConnection::Zero);
    let around = on_group.along_samples(&corners).unwrap();
    let change = (around - DMatrix::identity(3, 3)) / (h * h);
    let curvature = on_group.connection().curvature();
    for i in 0..3 {
        for j in 0..3 {
            assert!((change[(i, j)] + curvature.get(&[i, j, 0, 1])).abs() < 1e-3, "{change}");
        }
    }
}

/// Geodesics of the inertia are motions of free bodies: R H and the energy are constant, and the
/// velocity satisfies Euler's equations, also for an inertia that is not diagonal.
#[test]
fn geodesics_are_free_bodies() {
    let inertia = Matrix3::new(2.0, 0.3, -0.2, 0.3, 3.0, 0.5, -0.2, 0.5, 4.0);
    let on_group = levi_civita(inertia);
    let (g0, w0) = (curve(0.7), Vector3::new(1.0, -0.4, 0.8));
    let momentum = |g: &UnitQuaternion<f64>, w: &Vector3<f64>| g * (inertia * w);
    let h0 = momentum(&g0, &w0);
    let times = [0.5, 2.0, 10.0];
    let motion = on_group.autoparallel(&g0, &w0, &times, 1e-12).unwrap();
    for TangentVector { base: g, left: w } in &motion {
        assert!((momentum(g, w) - h0).norm() < 1e-9);
        assert!((w.dot(&(inertia * w)) - w0.dot(&(inertia * w0))).abs() < 1e-9);
        assert!((g.norm() - 1.0).abs() < 1e-13);
    }
    // the motion is not a fixed point, which would conserve everything
    assert!((motion[2].left - w0).norm() > 0.1);
    // the motion backwards from the end leads to the start
    let TangentVector { base: g, left: w } = &motion[2];
    let back = on_group.autoparallel(g, &-w, &[10.0], 1e-12).unwrap();
    assert!(So3.log(&So3.compose(&So3.inverse(&g0), &back[0].base)).unwrap().norm() < 1e-8);
}

/// On the motions of the plane, geodesics of a metric satisfy the Euler-Poincare equations of
/// `plus`, and the spatial momentum `Ad*_{g^-1} H` is constant.
#[test]
fn geodesics_of_the_motions_of_a_plane_are_free_bodies() {
    let algebra = Se2.algebra().unwrap();
    let j = Matrix3::new(2.0, 0.4, -0.3, 0.4, 1.5, 0.2, -0.3, 0.2, 3.0);
    let metric = Tensor::from_fn(3, [Down, Down], |[i, k]| j[(i, k)]).unwrap();
    let metric = Metric::new(algebra.labels(), metric).unwrap();
    let body = Connection::levi_civita(algebra.left_frame(), &metric).unwrap();
    let plus = Connection::canonical(&algebra, CanonicalConnection::Plus);
    let euler = Equations::euler_poincare(&plus, &metric).unwrap();
    let geodesic = Equations::new(EquationKind::Autoparallel, &body, None).unwrap();
    let omega = Vector3::new(0.7, -1.0, 0.5);
    // (106) without torque: dH_i/dt = H_k [Omega, e_i]^k
    let h = j * omega;
    let terms = Se2.basis().into_iter().map(|e| h.dot(&Se2.bracket(&omega, &e)));
    let expected = j.try_inverse().unwrap() * Vector3::from_iterator(terms);
    assert!(expected.amax() > 0.1);
    let by_euler = euler.rate(omega.as_slice(), &[0.0; 3]).unwrap();
    let by_geodesic = geodesic.rate(omega.as_slice(), &[]).unwrap();
    for found in [by_euler, by_geodesic] {
        assert!((Vector3::from_vec(found) - expected).amax() < 1e-13);
    }
    let start = Se2.exp(&Vector3::new(0.8, -0.5, 1.2));
    let momentum = |g: &<Se2 as LieGroup>::Element, w: &Vector3<f64>| {
        let back = Se2.inverse(g);
        Se2.operator_matrix(|v| Se2.adjoint(&back, v)).transpose() * (j * w)
    };
    let on_group = ParallelTranslation::new(Se2, body).unwrap();
    let end = on_group.autoparallel(&start, &omega, &[2.0], 1e-12).unwrap().remove(0);
    assert!((momentum(&end.base, &end.left) - momentum(&start, &omega)).amax() < 1e-10);
    assert!((end.left - omega).norm() > 0.05);
}

/// The covariant derivative along a curve, `vdot + Lambda(w, v)`, is the time derivative of the
/// vectors transported back to one point.
#[test]
fn covariant_derivatives_are_rates_of_vectors_carried_back() {
    let (x, y, t) = (Vector3::new(0.3, -0.8, 0.5), Vector3::new(-0.6, 0.2, 0.9), 0.8_f64);
    let v = |t: f64| x * t.cos() + y * t;
    let vdot = y - x * t.sin();
    for (which, lambda) in [
        (CanonicalConnection::Plus, 1.0),
        (CanonicalConnection::Zero, 0.5),
        (CanonicalConnection::Minus, 0.0),
    ] {
        let on_group = canonical(which);
        let back = |s: f64| {
            let there = on_group.along_curve(velocity, &[t, s], 1e-13).unwrap().remove(1);
            there.try_inverse().unwrap() * v(s)
        };
        let slope = |h: f64| (back(t + h) - back(t - h)) / (2.0 * h);
        let found = (slope(5e-3) * 4.0 - slope(1e-2)) / 3.0;
        let expected = vdot + So3.bracket(&velocity(t), &v(t)) * lambda;
        let off = (found - expected).amax();
        assert!(off < 1e-7, "{which:?}: {off:e}");
    }
}

/// Autoparallels of the three canonical connections are the same curves `g exp(t n)` (43), (B8).
#[test]
fn canonical_autoparallels_are_one_parameter_groups() {
    let (g0, n) = (curve(0.3), Vector3::new(0.6, -2.0, 1.5));
    for which in [CanonicalConnection::Plus, CanonicalConnection::Zero, CanonicalConnection::Minus]
    {
        let TangentVector { base: g, left: tangent } =
            &canonical(which).autoparallel(&g0, &n, &[3.0], 1e-12).unwrap()[0];
        let expected = So3.compose(&g0, &So3.exp(&(n * 3.0)));
        assert!(So3.log(&So3.compose(&So3.inverse(&expected), g)).unwrap().norm() < 1e-10);
        assert!((tangent - n).norm() < 1e-12);
    }
}

#[test]
fn a_geodesic_between_two_points() {
    let inertia = Matrix3::new(2.0, 0.3, -0.2, 0.3, 3.0, 0.5, -0.2, 0.5, 4.0);
    let on_group = levi_civita(inertia);
    let (p, q) = (curve(0.2), curve(0.8));
    let n = on_group.autoparallel_between(&p, &q, 1e-10).unwrap();
    let end = &on_group.autoparallel(&p, &n, &[1.0], 1e-12).unwrap()[0].base;
    assert!(So3.log(&So3.compose(&So3.inverse(&q), end)).unwrap().norm() < 1e-9);
    // it is not the one-parameter group
    assert!((n - So3.log(&So3.compose(&So3.inverse(&p), &q)).unwrap()).norm() > 1e-2);
    // from a point to the same point
    assert!(on_group.autoparallel_between(&p, &p, 1e-10).unwrap().norm() < 1e-16);
}

#[test]
fn what_does_not_fit_is_refused() {
    let heisenberg = Bracket::from_fn(&["x", "y", "z"], |j, k| match (j, k) {
        (0, 1) => vec![(2, 1.0)],
        _ => vec![],
    });
    let heisenberg = LieAlgebra::try_from(heisenberg.unwrap()).unwrap();
    let other = Connection::canonical(&heisenberg, CanonicalConnection::Plus);
    let error = ParallelTranslation::new(So3, other).unwrap_err();
    assert!(error.to_string().contains("c^2_1,3 = 0 and not -1"), "{error}");

    let plus = canonical(CanonicalConnection::Plus);
    let pole = |t: f64| Vector3::new(1.0 / (1.0 - t), 0.0, 1.0 / (1.0 - t));
    let stops = plus.along_curve(pole, &[0.0, 2.0], 1e-9).unwrap_err();
    assert!(matches!(stops, Error::Integration { .. }), "{stops}");
    let fast = plus.autoparallel(&So3.identity(), &Vector3::repeat(1e300), &[1.0], 1e-9);
    assert!(matches!(fast.unwrap_err(), Error::Integration { .. }));
    let nowhere = plus.autoparallel(&So3.identity(), &Vector3::x(), &[f64::NAN], 1e-9);
    assert!(matches!(nowhere.unwrap_err(), Error::Integration { .. }));
}

/// A generator whose turns exceed the rounding error of its angle is rejected. Long translations are transported.
#[test]
fn too_many_turns_are_rejected() {
    let zero = canonical(CanonicalConnection::Zero);
    for angle in [1.0, 1e6, 1e9] {
        let found = zero.along_subgroup(&Vector3::new(0.0, 0.6 * angle, 0.8 * angle)).unwrap();
        assert!((found.trace() - (1.0 + 2.0 * (0.5 * angle).cos())).abs() < 1e-6, "{angle}");
    }
    for angle in [1e17, 1e20, 1e100] {
        let lost = zero.along_subgroup(&Vector3::new(0.0, 0.6 * angle, 0.8 * angle));
        assert!(matches!(lost, Err(Error::Integration { .. })), "{angle}: {lost:?}");
    }
    let plus = Connection::canonical(&Se2.algebra().unwrap(), CanonicalConnection::Plus);
    let plane = ParallelTranslation::new(Se2, plus).unwrap();
    for length in [1.0, 1e9, 1e15, 1e20] {
        let x = Vector3::new(0.3, length, -0.5 * length);
        let found = plane.along_subgroup(&x).unwrap();
        let exact = Se2.adjoint_exp(&-x);
        assert!((found - &exact).amax() <= 1e-14 * exact.amax(), "{length}");
    }
}
