//! Section 4.1 on groups: velocities, translation along rays and rotation vectors, (41)-(61).
//!
//! What the paper says of M(3) holds of the connection (+) on any group: `A = Ad_p`, `B = Ad_p^-1`.

use crate::paper::matrices::{self, Basis, assert_close};
use crate::paper::on_groups::{
    CANONICAL, column, commutator, differ, distance, equal, hat, on_every_group, path, rate, same,
    slope, translation, vectors,
};
use affinor::Canonical::{Minus, Plus, Zero};
use affinor::group::fields::{InvariantField, Side};
use affinor::group::{Coordinates, LieGroup, So3, Velocity};
use affinor_tensors::Tensor;
use nalgebra::{DMatrix, DVector, Vector3};
use std::f64::consts::{PI, TAU};

fn velocity<G: LieGroup>(group: &G, t: f64) -> Velocity<G::Vector> {
    Velocity::of_path(group, path(group), t, 0.02).unwrap()
}

#[test]
fn eq_41_and_52_to_56_the_velocity_in_the_frame_and_at_the_identity() {
    fn law<G: LieGroup>(name: &str, group: &G, basis: &Basis) {
        let (t, curve) = (0.9, path(group));
        let (g, derivative) = (group.matrix(&curve(t)), rate(|t| group.matrix(&path(group)(t)), t));
        let Velocity { body, spatial } = velocity(group, t);
        // (41), (52): w^i e_i(p), with the fields of the library at p as matrices
        let frame = group.basis().into_iter().map(|unit| {
            let field = InvariantField { side: Side::Left, vector: unit };
            rate(|s| group.matrix(&field.flow(group, &curve(t), s)), 0.0)
        });
        let w = frame.zip(body.components()).fold(&g * 0.0, |sum, (e, w)| sum + e * *w);
        same(&w, &derivative, name);
        // (53)-(55): the same components at the identity; (56): those of omega there
        same(&(&g * hat(basis, &body)), &derivative, name);
        same(&(hat(basis, &spatial) * &g), &derivative, name);
        differ(&column(&body), &column(&spatial), name);
    }
    on_every_group!(law);
}

#[test]
fn eq_59_and_66_to_69_the_velocity_by_right_translation() {
    fn law<G: LieGroup>(name: &str, group: &G, basis: &Basis) {
        for t in [-0.7, 0.9] {
            let curve = path(group);
            let (g, derivative) = (group.matrix(&curve(t)), rate(|t| group.matrix(&curve(t)), t));
            let Velocity { body, spatial } = velocity(group, t);
            // (66), (67): R spin(Omega) = spin(omega) R and not the other way round
            same(&(&g * hat(basis, &body)), &derivative, name);
            same(&(hat(basis, &spatial) * &g), &derivative, name);
            assert!(distance(&(&g * hat(basis, &spatial)), &derivative) > 1e-3, "{name}");
            // (68), (69): in the frames R E_i and E_i R
            let sum = |side, v: &G::Vector| {
                let terms = group.basis().into_iter().zip(v.components()).map(|(unit, v)| {
                    let field = InvariantField { side, vector: unit };
                    hat(basis, &field.at(group, &curve(t))) * *v
                });
                &g * terms.fold(hat(basis, v) * 0.0, |sum, term| sum + term)
            };
            same(&sum(Side::Left, &body), &derivative, name);
            same(&sum(Side::Right, &spatial), &derivative, name);
        }
    }
    on_every_group!(law);
}

#[test]
fn eq_42_parallel_vectors_along_a_curve() {
    fn law<G: LieGroup + Clone>(name: &str, group: &G, basis: &Basis) {
        let (u, curve, t) = (vectors(group)[1].clone(), path(group), 0.8);
        let w = |t: f64| velocity(group, t).body;
        let start = group.matrix(&curve(0.0));
        for (which, lambda) in [(Plus, 1.0), (Zero, 0.5), (Minus, 0.0)] {
            let on_group = translation(group, which);
            let carried =
                |t: f64| &on_group.along_curve(w, &[0.0, t], 1e-13).unwrap()[1] * column(&u);
            // vdot + lambda [w, v] = 0, with commutators of matrices
            let v = G::Vector::from_components(carried(t).as_slice());
            let turned = commutator(basis, &w(t), &v) * lambda;
            let residual = slope(carried, t) + &turned;
            assert!(residual.amax() < 1e-8, "{name} {which:?}: {residual}");
            // (+): the vector is right translated, whatever the curve
            let there = group.matrix(&curve(t));
            let right = hat(basis, &u) * matrices::inverse(&start) * &there;
            let right = matrices::inverse(&there) * &start * right;
            if which == Plus {
                assert!((hat(basis, &v) - right).amax() < 1e-9, "{name}");
            } else {
                assert!((hat(basis, &v) - right).amax() > 1e-2, "{name} {which:?}");
            }
        }
    }
    on_every_group!(law);
}

#[test]
fn before_42_nabla_along_a_curve_is_the_rate_of_what_is_carried_back() {
    fn law<G: LieGroup + Clone>(name: &str, group: &G, basis: &Basis) {
        let ([x, y, _], t) = (vectors(group), 0.8);
        let v = |t: f64| column(&x) * t.cos() + column(&y) * t;
        let w = |t: f64| velocity(group, t).body;
        for (which, lambda) in [(Plus, 1.0), (Zero, 0.5), (Minus, 0.0)] {
            let on_group = translation(group, which);
            let back = |s: f64| {
                let there = on_group.along_curve(w, &[t, s], 1e-13).unwrap().remove(1);
                matrices::inverse(&there) * v(s)
            };
            // (vdot^i + Lambda^i_jk w^j v^k) e_i
            let here = G::Vector::from_components(v(t).as_slice());
            let expected = slope(v, t) + commutator(basis, &w(t), &here) * lambda;
            let off = (slope(back, t) - expected).amax();
            assert!(off < 1e-8, "{name} {which:?}: {off:e}");
        }
    }
    on_every_group!(law);
}

#[test]
fn eq_43_autoparallels_are_translated_one_parameter_groups() {
    fn law<G: LieGroup + Clone>(name: &str, group: &G, basis: &Basis) {
        let [x, n, _] = vectors(group);
        let start = group.exp(&x);
        for which in CANONICAL {
            let on_group = translation(group, which);
            let times = [0.7, 2.0];
            let found = on_group.autoparallel(&start, &n, &times, 1e-12).unwrap();
            for (t, at) in times.into_iter().zip(found) {
                let off = (column(&at.left) - column(&n)).amax();
                assert!(off < 1e-12, "{name} {which:?}: {off:e}");
                let expected = group.matrix(&start) * (hat(basis, &n) * t).exp();
                assert!(distance(&group.matrix(&at.base), &expected) < 1e-9, "{name} {which:?}");
            }
        }
    }
    on_every_group!(law);
}

#[test]
fn eq_44_and_45_the_generator_is_minus_ad() {
    fn law<G: LieGroup + Clone>(name: &str, group: &G, basis: &Basis) {
        let [n, u, _] = vectors(group);
        let on_group = translation(group, Plus);
        // (44): Lambda^i_jk n^j, the upper index is the row
        let generator = on_group.connection().transport_generator(n.components()).unwrap();
        let generator = generator.to_dmatrix().unwrap();
        equal(&(-&generator * column(&u)), &commutator(basis, &n, &u), name);
        // (45): along exp(t n)
        let carried = |t: f64| on_group.along_subgroup(&(n.clone() * t)).unwrap() * column(&u);
        for t in [0.0, 1.3] {
            let v = G::Vector::from_components(carried(t).as_slice());
            equal(&slope(carried, t), &(-commutator(basis, &n, &v)), name);
            differ(&slope(carried, t), &commutator(basis, &n, &v), name);
        }
    }
    on_every_group!(law);
}

#[test]
fn eq_47_and_48_left_invariant_fields_keep_their_components() {
    fn law<G: LieGroup>(name: &str, group: &G, basis: &Basis) {
        let [x, n, _] = vectors(group);
        let p = group.exp(&x);
        for (e, unit) in basis.0.iter().zip(group.basis()) {
            let field = InvariantField { side: Side::Left, vector: unit.clone() };
            assert_eq!(field.at(group, &p), unit);
            let flow = |t: f64| group.matrix(&field.flow(group, &p, t));
            same(&rate(flow, 0.0), &(group.matrix(&p) * e), name);
        }
        // n^i_p = n^i_e along exp(t n)
        for t in [0.0, 1.4] {
            let along = |t: f64| group.exp(&(n.clone() * t));
            let tangent = Velocity::of_path(group, along, t, 0.02).unwrap().body;
            equal(&column(&tangent), &column(&n), name);
        }
    }
    on_every_group!(law);
}

#[test]
fn eq_49_to_51_translation_along_a_ray() {
    fn law<G: LieGroup + Clone>(name: &str, group: &G, basis: &Basis) {
        let [n, u, _] = vectors(group);
        for t in [0.6, -1.1, 2.3] {
            let p = group.exp(&(n.clone() * t));
            let b = translation(group, Plus).along_subgroup(&(n.clone() * t)).unwrap();
            let a = matrices::inverse(&b);
            // (49): u_p = B u_e is the right translate: P hat(u_p) = hat(u_e) P
            let u_p = G::Vector::from_components((&b * column(&u)).as_slice());
            let matrix = group.matrix(&p);
            same(&(&matrix * hat(basis, &u_p)), &(hat(basis, &u) * &matrix), name);
            // (50), (51): A = exp(t ad_n) = Ad_p, B its inverse
            let ad = DMatrix::from_columns(
                &group.basis().iter().map(|e| commutator(basis, &n, e)).collect::<Vec<_>>(),
            );
            same(&a, &(&ad * t).exp(), name);
            same(&b, &(&ad * -t).exp(), name);
            same(&a, &group.operator_matrix(|v| group.adjoint(&p, v)), name);
            assert!(distance(&a, &b) > 1e-2, "{name}");
        }
    }
    on_every_group!(law);
    // on SO(3) A is the rotation itself
    let psi = Vector3::new(0.4, -1.2, 0.7);
    let b = translation(&So3, Plus).along_subgroup(&psi).unwrap();
    assert_close(&b.transpose(), &So3.matrix(&So3.exp(&psi)), "A = R");
}

#[test]
fn eq_57_and_10_the_two_images_are_translates_of_each_other() {
    fn law<G: LieGroup + Clone>(name: &str, group: &G, basis: &Basis) {
        let t = 1.3;
        let g = path(group)(t);
        let (matrix, derivative) = (group.matrix(&g), rate(|t| group.matrix(&path(group)(t)), t));
        // both from the matrices
        let back = matrices::inverse(&matrix);
        let omega_body = basis.components(&(&back * &derivative));
        let omega = basis.components(&(&derivative * &back));
        let along =
            |which| translation(group, which).along_subgroup(&group.log(&g).unwrap()).unwrap();
        let b = along(Plus);
        equal(&(&b * &omega), &omega_body, name);
        equal(&(matrices::inverse(&b) * &omega_body), &omega, name);
        let found = velocity(group, t);
        equal(&column(&found.body), &omega_body, name);
        equal(&column(&found.spatial), &omega, name);
        // the halved exponent of (71) is no change of frame, nor is the other side
        differ(&(along(Zero) * &omega), &omega_body, name);
        differ(&(&b * &omega_body), &omega, name);
    }
    on_every_group!(law);
}

#[test]
fn eq_57_a_is_the_rotation_matrix() {
    let g = path(&So3)(0.6);
    let b = translation(&So3, Plus).along_subgroup(&So3.log(&g).unwrap()).unwrap();
    assert_close(&b, &So3.matrix(&g).transpose(), "B = R^T");
    let Velocity { body, spatial } = velocity(&So3, 0.6);
    assert!((g * body - spatial).norm() < 1e-14);
    // from samples too
    let times: Vec<f64> = (0..9).map(|i| 0.6 + 0.01 * f64::from(i - 4)).collect();
    let samples: Vec<_> = times.iter().map(|t| path(&So3)(*t)).collect();
    let sampled = Velocity::of_samples(&So3, &times, &samples).unwrap();
    assert!((sampled[4].body - body).norm() < 1e-7);
    assert!((sampled[4].spatial - spatial).norm() < 1e-7);
}

#[test]
fn eq_58_omega_translated_along_rays_is_parallel() {
    fn law<G: LieGroup + Clone>(name: &str, group: &G, _: &Basis) {
        let [n, omega, other] = vectors(group);
        let right = InvariantField { side: Side::Right, vector: omega.clone() };
        let b = |x: &G::Vector| translation(group, Plus).along_subgroup(x).unwrap();
        // the field q -> B(q) omega is the right-invariant one
        for x in [&n, &other] {
            let there = right.at(group, &group.exp(x));
            equal(&(b(x) * column(&omega)), &column(&there), name);
        }
        // nabla_n = d/dt + Lambda n along exp(t n): zero for (+) alone
        for (which, lambda) in [(Plus, 1.0), (Zero, 0.5)] {
            let field = |t: f64| column(&right.at(group, &group.exp(&(n.clone() * t))));
            let gamma = translation(group, which);
            let generator = gamma.connection().transport_along(n.components()).unwrap();
            let nabla = slope(field, 0.4) - generator.to_dmatrix().unwrap() * field(0.4);
            let zero = DVector::zeros(group.dimension());
            if lambda == 1.0 {
                equal(&nabla, &zero, name);
            } else {
                differ(&nabla, &zero, name);
            }
        }
    }
    on_every_group!(law);
}

/// The dimension of the vectors that `Ad_g` leaves alone.
fn fixed(g: &nalgebra::UnitQuaternion<f64>) -> usize {
    3 - (So3.operator_matrix(|v| So3.adjoint(g, v)) - DMatrix::identity(3, 3)).rank(1e-9)
}

#[test]
fn after_59_equal_images_are_parallel_to_n_only_off_the_identity() {
    let n = Vector3::new(2.0, -1.0, 2.0) / 3.0;
    for angle in [0.3, 2.0, PI, 5.0] {
        let g = So3.exp(&(n * angle));
        // Omega = omega on one line, which is that of n
        assert_eq!(fixed(&g), 1, "{angle}");
        let along = Velocity::from_body(&So3, &g, n);
        assert!((along.body - along.spatial).norm() < 1e-14);
    }
    // at p = e, and after whole turns, all velocities have equal images
    for angle in [0.0, TAU, 2.0 * TAU] {
        let g = So3.exp(&(n * angle));
        assert_eq!(fixed(&g), 3, "{angle}");
        let across = Velocity::from_body(&So3, &g, Vector3::new(1.0, 2.0, 0.0));
        assert!((across.body - across.spatial).norm() < 1e-14);
        assert!(across.body.cross(&n).norm() > 1.0);
    }
}

#[test]
fn eq_60_and_61_a_motion_by_its_rays() {
    let curve = path(&So3);
    for t in [0.2, 0.9, 1.3] {
        let psi = So3.log(&curve(t)).unwrap();
        let n = psi / t;
        // Q(s, n(t)) is a one-parameter group that reaches R at s = t
        assert_close(&So3.matrix(&So3.exp(&(n * t))), &So3.matrix(&curve(t)), "Q(t, n)");
        let by_translation = translation(&So3, Plus).along_subgroup(&(n * t)).unwrap();
        assert_close(&by_translation, &So3.matrix(&curve(t)).transpose(), "A(t)");
        // (61): psi is t n, the canonical coordinates; n is not the velocity
        assert!((So3.exp(&psi).angle_to(&curve(t))).abs() < 1e-14);
        assert!((n - velocity(&So3, t).body).norm() > 0.1);
    }
    // n(t) = Psi(t)/t has no limit at t = 0 unless the motion starts at the identity
    let length = |t: f64| (So3.log(&curve(t)).unwrap() / t).norm();
    assert!(length(1e-8) > 1e6);
    // nor is it unique: the ray back around reaches the same rotation
    let psi = Vector3::new(1.0, 2.0, 2.0);
    let around = psi - psi.normalize() * TAU;
    assert!(So3.exp(&psi).angle_to(&So3.exp(&around)) < 1e-14);
}

#[test]
fn after_60_rodrigues_from_no_turn_to_a_thousand() {
    let n = [1.0 / 3.0, -2.0 / 3.0, 2.0 / 3.0];
    for angle in [0.0, 1e-9, 1e-3, 0.5, PI, 6.0, TAU, 100.0, 1e4] {
        let found = So3.matrix(&So3.exp(&(Vector3::from(n) * angle)));
        let expected = matrices::rodrigues(n, angle);
        let off = (found - expected).amax();
        assert!(off < 1e-15 * (4.0 + angle), "{angle}: {off:e}");
    }
    // the half-angle form keeps what 1 - cos loses: entry 1,1 is 1 - 2 sin^2(angle/2) (1 - n1^2)
    let small = So3.log(&So3.exp(&Vector3::new(1e-9, 0.0, 0.0))).unwrap();
    assert!((small.x / 1e-9 - 1.0).abs() < 1e-15);
}

/// (46) is `Lambda = eps` of the library's own group.
#[test]
fn eq_46_and_65_affinities_of_the_rotation_group() {
    for (which, share) in [(Plus, 1), (Zero, 2)] {
        let on_group = translation(&So3, which);
        let expected: Tensor<f64> =
            crate::paper::epsilons::<affinor_tensors::Rational>(&format!("1/{share}"))
                .map(|v| v.to_f64());
        crate::paper::assert_tensors(on_group.connection().gamma(), &expected, "eps");
    }
}
