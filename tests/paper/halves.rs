//! Section 4.2 on groups: spin matrices, frames of SO(3), and the connection (0), (62)-(71), with what
//! the paper says too much of it.

use crate::common::labels;
use crate::paper::matrices::{self, Basis, assert_close, rodrigues};
use crate::paper::on_groups::{
    CANONICAL, column, commutator, differ, distance, equal, hat, on_every_group, path, rate, same,
    translation, vectors,
};
use affinor::Canonical::{Minus, Plus, Zero};
use affinor::geometry::equations::{EquationKind, Equations};
use affinor::group::fields::{InvariantField, Side};
use affinor::group::transport::{ParallelTranslation, TangentVector};
use affinor::group::{Coordinates, LieGroup, Se2, Se3, So3, Velocity};
use affinor::{Canonical, Connection, Metric};
use affinor_tensors::{Down, Tensor};
use nalgebra::{DMatrix, DVector, Matrix3, Vector3, Vector6};
use std::f64::consts::TAU;

#[test]
fn eq_62_the_basis_of_the_library_is_spin_of_the_unit_vectors() {
    // the three printed matrices, row by row
    let printed = [
        [0.0, 0.0, 0.0, 0.0, 0.0, -1.0, 0.0, 1.0, 0.0],
        [0.0, 0.0, 1.0, 0.0, 0.0, 0.0, -1.0, 0.0, 0.0],
        [0.0, -1.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0],
    ];
    for (unit, rows) in So3.basis().into_iter().zip(printed) {
        let derivative = rate(|t| So3.matrix(&So3.exp(&(unit * t))), 0.0);
        same(&derivative, &DMatrix::from_row_slice(3, 3, &rows), "spin");
    }
}

#[test]
fn eq_63_and_69_left_and_right_frames() {
    fn law<G: LieGroup>(name: &str, group: &G, basis: &Basis) {
        let g = path(group)(0.8);
        let matrix = group.matrix(&g);
        for (e, unit) in basis.0.iter().zip(group.basis()) {
            for (side, expected) in [(Side::Left, &matrix * e), (Side::Right, e * &matrix)] {
                let field = InvariantField { side, vector: unit.clone() };
                let flow = |t: f64| group.matrix(&field.flow(group, &g, t));
                same(&rate(flow, 0.0), &expected, name);
                same(&(&matrix * hat(basis, &field.at(group, &g))), &expected, name);
            }
        }
    }
    on_every_group!(law);
}

#[test]
fn eq_70_one_generator_on_both_sides() {
    let n = Vector3::new(0.3, -1.1, 0.8);
    let spin = matrices::so3().combine(n.as_slice());
    for s in [0.4, 1.7, -3.0] {
        let q = So3.matrix(&So3.exp(&(n * s)));
        let derivative = rate(|s| So3.matrix(&So3.exp(&(n * s))), s);
        same(&derivative, &(&q * &spin), "Q n~");
        same(&derivative, &(&spin * &q), "n~ Q");
    }
}

#[test]
fn eq_71_translation_by_zero_is_by_square_roots() {
    fn law<G: LieGroup + Clone>(name: &str, group: &G, basis: &Basis) {
        let [x, u, _] = vectors(group);
        let b = translation(group, Zero).along_subgroup(&x).unwrap();
        // A = exp(ad_x/2)
        let half = group.exp(&(x.clone() * 0.5));
        same(&matrices::inverse(&b), &group.operator_matrix(|v| group.adjoint(&half, v)), name);
        // P hat(B u) = sqrt(P) hat(u) sqrt(P), with the root from the matrices
        let root = (hat(basis, &x) * 0.5).exp();
        let carried = G::Vector::from_components((&b * column(&u)).as_slice());
        let there = group.matrix(&group.exp(&x)) * hat(basis, &carried);
        same(&there, &(&root * hat(basis, &u) * &root), name);
        differ(&(&b * column(&u)), &column(&u), name);
        let plus = translation(group, Plus).along_subgroup(&x).unwrap();
        differ(&(&b * column(&u)), &(plus * column(&u)), name);
        // what commutes with x all three carry alike
        for which in CANONICAL {
            let carried = translation(group, which).along_subgroup(&x).unwrap() * column(&x);
            equal(&carried, &column(&x), name);
        }
    }
    on_every_group!(law);
    let n = [2.0 / 7.0, 3.0 / 7.0, -6.0 / 7.0];
    for t in [0.7, -2.0, 4.0] {
        let b = translation(&So3, Zero).along_subgroup(&(Vector3::from(n) * t)).unwrap();
        assert_close(&b, &rodrigues(n, -t / 2.0), "exp(-t n~/2)");
    }
}

#[test]
fn after_71_what_zero_carries_from_the_body_is_not_omega() {
    fn law<G: LieGroup + Clone>(name: &str, group: &G, _: &Basis) {
        let g = path(group)(1.3);
        let Velocity { body, spatial } = Velocity::of_path(group, path(group), 1.3, 0.02).unwrap();
        let x = group.log(&g).unwrap();
        let back = |which| {
            matrices::inverse(&translation(group, which).along_subgroup(&x).unwrap())
                * column(&body)
        };
        equal(&back(Plus), &column(&spatial), name);
        differ(&back(Zero), &column(&spatial), name);
        differ(&back(Minus), &column(&spatial), name);
    }
    on_every_group!(law);
}

#[test]
fn after_71_around_the_closed_subgroup() {
    let n = Vector3::new(0.0, 0.6, -0.8);
    let corners: Vec<_> = (0..=12).map(|i| So3.exp(&(n * (TAU * f64::from(i) / 12.0)))).collect();
    let half_turn = rodrigues([0.0, 0.6, -0.8], TAU / 2.0);
    for (which, expected) in
        [(Plus, DMatrix::identity(3, 3)), (Zero, half_turn), (Minus, DMatrix::identity(3, 3))]
    {
        let on_group = translation(&So3, which);
        assert_close(&on_group.along_subgroup(&(n * TAU)).unwrap(), &expected, "at once");
        let in_pieces = on_group.along_samples(&corners).unwrap();
        assert!(distance(&in_pieces, &expected) < 1e-13, "{which:?} {in_pieces}");
    }
    // around a full turn about an axis through (1, 2, 0) in SE(3): Ad of half that turn
    let turn = Vector6::new(0.0, 0.0, TAU, 2.0 * TAU, -TAU, 0.0);
    let whole = Se3.matrix(&Se3.exp(&turn));
    assert!(distance(&whole, &DMatrix::identity(4, 4)) < 1e-14, "closed");
    let half = Se3.exp(&(turn * 0.5));
    let zero = translation(&Se3, Zero).along_subgroup(&turn).unwrap();
    assert!(distance(&zero, &Se3.operator_matrix(|v| Se3.adjoint(&half, v))) < 1e-13);
    assert!(distance(&zero, &DMatrix::identity(6, 6)) > 0.1);
    let plus = translation(&Se3, Plus).along_subgroup(&turn).unwrap();
    assert!(distance(&plus, &DMatrix::identity(6, 6)) < 1e-13);
}

/// An inertia that is not diagonal.
fn inertia() -> Matrix3<f64> {
    Matrix3::new(2.0, 0.3, -0.2, 0.3, 3.0, 0.5, -0.2, 0.5, 4.0)
}

fn metric(g: &DMatrix<f64>) -> Metric<f64> {
    let n = g.nrows();
    let components = Tensor::from_fn(n, [Down, Down], |[i, j]| g[(i, j)]).unwrap();
    Metric::new(labels(n), components).unwrap()
}

fn levi_civita<G: LieGroup + Clone>(group: &G, g: &DMatrix<f64>) -> ParallelTranslation<G> {
    let algebra = group.algebra().unwrap();
    let connection = Connection::levi_civita(algebra.left_frame(), &metric(g)).unwrap();
    ParallelTranslation::new(group.clone(), connection).unwrap()
}

/// `H_j [Omega, e_i]^j`, with commutators of matrices: the right side of (106) without torque.
fn coadjoint<G: LieGroup>(
    group: &G,
    basis: &Basis,
    omega: &G::Vector,
    h: &DVector<f64>,
) -> DVector<f64> {
    let terms = group.basis().into_iter().map(|e| commutator(basis, omega, &e).dot(h));
    DVector::from_iterator(group.dimension(), terms)
}

/// The paper finds SO(3) unsuitable; only its pair of (0) and the bi-invariant metric is. With (+), or
/// with the Levi-Civita connection of `J`, the same group gives (10) and (108).
#[test]
fn claim_after_71_so3_serves_with_plus_or_with_levi_civita_of_j() {
    let j = inertia();
    let dynamic = DMatrix::from_column_slice(3, 3, j.as_slice());
    let so3 = So3.algebra().unwrap();
    let euler = |which: Canonical| {
        Equations::euler_poincare(&Connection::canonical(&so3, which), &metric(&dynamic)).unwrap()
    };
    let body = levi_civita(&So3, &dynamic);
    let geodesic = Equations::new(EquationKind::Autoparallel, body.connection(), None).unwrap();
    // (108): J dOmega/dt = M - Omega x J Omega, from (+) with a torque, from Levi-Civita without
    let (omega, m) = (Vector3::new(1.0, -0.4, 0.8), Vector3::new(0.2, 0.7, -0.3));
    let inverse = j.try_inverse().unwrap();
    let expected = |m: Vector3<f64>| inverse * (m - omega.cross(&(j * omega)));
    let found = |equations: &Equations<f64>, other: &[f64]| {
        Vector3::from_column_slice(&equations.rate(omega.as_slice(), other).unwrap())
    };
    assert!((found(&euler(Plus), m.as_slice()) - expected(m)).norm() < 1e-14);
    assert!((found(&geodesic, &[]) - expected(Vector3::zeros())).norm() < 1e-14);
    assert!((found(&euler(Zero), m.as_slice()) - expected(m)).norm() > 0.1);

    // (10) and R H = const along the motion, whose elements come from the same group
    let start = path(&So3)(0.4);
    let at = |t: f64| body.autoparallel(&start, &omega, &[t], 1e-13).unwrap().remove(0);
    let h0 = start * (j * omega);
    for t in [0.5, 3.0] {
        let TangentVector { base: g, left: tangent } = at(t);
        let Velocity { body, spatial } = Velocity::of_path(&So3, |t| at(t).base, t, 0.02).unwrap();
        assert!((body - tangent).norm() < 1e-8, "Rdot = R Omega~");
        assert!((spatial - g * tangent).norm() < 1e-8, "(10)");
        assert!((g * (j * tangent) - h0).norm() < 1e-10, "R H");
        assert!((tangent - omega).norm() > 0.05, "it moves");
        let (h, d) = (1e-3, |t: f64| at(t).left);
        let rate = (d(t + h) - d(t - h)) / (2.0 * h);
        let residual = j * rate + tangent.cross(&(j * tangent));
        assert!(residual.norm() < 1e-4, "(108): {residual}");
        // the halved term of (0) is far from it
        assert!((j * rate + tangent.cross(&(j * tangent)) * 0.5).norm() > 0.05);
    }

    // the pair of the paper: (0) is Levi-Civita of 2 delta, and its geodesics never turn
    let round = levi_civita(&So3, &(DMatrix::identity(3, 3) * 2.0));
    let zero = translation(&So3, Zero);
    crate::paper::assert_tensors(round.connection().gamma(), zero.connection().gamma(), "(0)");
    let tangent = zero.autoparallel(&start, &omega, &[3.0], 1e-12).unwrap()[0].left;
    assert!((tangent - omega).norm() < 1e-12);
}

/// The same on a group that is not unimodular-compact: (+) and Levi-Civita of one metric agree.
#[test]
fn claim_after_71_on_the_motions_of_a_plane() {
    let j = DMatrix::from_row_slice(3, 3, &[2.0, 0.4, -0.3, 0.4, 1.5, 0.2, -0.3, 0.2, 3.0]);
    let body = levi_civita(&Se2, &j);
    let plus = Connection::canonical(&Se2.algebra().unwrap(), Plus);
    let euler = Equations::euler_poincare(&plus, &metric(&j)).unwrap();
    let geodesic = Equations::new(EquationKind::Autoparallel, body.connection(), None).unwrap();
    let omega = Vector3::new(0.7, -1.0, 0.5);
    let h = &j * column(&omega);
    let expected = matrices::inverse(&j) * coadjoint(&Se2, &matrices::se2(), &omega, &h);
    for found in [
        euler.rate(omega.as_slice(), &[0.0; 3]).unwrap(),
        geodesic.rate(omega.as_slice(), &[]).unwrap(),
    ] {
        equal(&DVector::from_vec(found), &expected, "SE(2)");
    }
    assert!(expected.amax() > 0.1);
    // the spatial momentum Ad*_{g^-1} H is constant
    let start = path(&Se2)(0.4);
    let momentum = |g: &<Se2 as LieGroup>::Element, w: &Vector3<f64>| {
        let back = Se2.inverse(g);
        Se2.operator_matrix(|v| Se2.adjoint(&back, v)).transpose() * (&j * column(w))
    };
    let TangentVector { base: g, left: w } =
        &body.autoparallel(&start, &omega, &[2.0], 1e-12).unwrap()[0];
    assert!((momentum(g, w) - momentum(&start, &omega)).amax() < 1e-10);
    assert!((w - omega).norm() > 0.05);
}
