//! Section 4.1: kinematics on M(3), (41)-(61), with the connection (+).

use crate::paper::matrices::{self, assert_close, rodrigues};
use crate::paper::{
    affine, assert_tensors, epsilons, float, heisenberg, parameters, sl2, so3, symbolic,
};
use crate::paper::{tensor, value, values};
use affinor::geometry::paper;
use affinor::{Canonical, Connection, Error};
use affinor_tensors::{Down, Ring, Symbolic, Up};
use nalgebra::{DMatrix, DVector, Rotation3, Unit, Vector3};
use std::f64::consts::PI;

/// A unit vector along no axis.
const N: [f64; 3] = [1.0 / 3.0, -2.0 / 3.0, 2.0 / 3.0];
const TIMES: [f64; 6] = [0.0, 0.4, -1.3, 2.0, PI, 5.5];

/// `B(t)` of (49): parallel transport along `exp(t n)` in left components.
fn transport(which: Canonical, n: [f64; 3], t: f64) -> DMatrix<f64> {
    let connection = Connection::canonical(&float(&so3()), which);
    (connection.transport_generator(&n).unwrap().to_dmatrix().unwrap() * t).exp()
}

#[test]
fn eq_42_parallel_vectors_turn_by_the_affinities() {
    // vdot^i + Lambda^i_jk w^j v^k = 0 along the one-parameter subgroup of w, on aff(1):
    // Lambda^2_12 = 1 = -Lambda^2_21, so vdot = (0, -w1 v2 + w2 v1)
    let plus = Connection::canonical(&symbolic(&affine()), Canonical::Plus);
    let generator = plus.transport_generator(&parameters("w", 2)).unwrap();
    let expected = tensor(2, [Up, Down], &[([2, 1], "w2"), ([2, 2], "-w1")]);
    assert_tensors(&generator, &expected, "aff(1)");
}

#[test]
fn eq_43_autoparallels_keep_constant_components() {
    for algebra in [so3(), sl2(), heisenberg(), affine()] {
        let algebra = symbolic(&algebra);
        let n = parameters("n", algebra.dimension());
        for which in [Canonical::Plus, Canonical::Zero, Canonical::Minus] {
            // refused unless Lambda^i_jk n^j n^k = 0
            assert!(Connection::canonical(&algebra, which).transport_generator(&n).is_ok());
        }
    }
    // of Levi-Civita on diag(1,2,3) only the principal axes do
    let g = crate::paper::metric(&[&["1", "0", "0"], &["0", "2", "0"], &["0", "0", "3"]]);
    let body = Connection::levi_civita(so3().left_frame(), &g).unwrap();
    assert!(body.transport_generator(&values(["0", "1", "0"])).is_ok());
    // nabla_n n = J^-1 (n x J n): (0, 0, 1 * 2 - 1 * 1) / 3 for n = (1, 1, 0)
    match body.transport_generator(&values(["1", "1", "0"])) {
        Err(Error::NotAutoparallel { n, residual }) => {
            assert_eq!((n.as_str(), residual.as_str()), ("e1 + e2", "1/3*e3"));
        }
        other => panic!("{other:?}"),
    }
}

#[test]
fn eq_44_affinities_with_n_are_spin_n() {
    let m3 = paper::m3().unwrap();
    let generator = m3.connection().transport_generator(&parameters("n", 3)).unwrap();
    // the upper index is the row; the generator is minus the matrix of (44)
    let spin = tensor(
        3,
        [Up, Down],
        &[
            ([1, 2], "-n3"),
            ([1, 3], "n2"),
            ([2, 1], "n3"),
            ([2, 3], "-n1"),
            ([3, 1], "-n2"),
            ([3, 2], "n1"),
        ],
    );
    assert_tensors(&generator.map(|value| -value.clone()), &spin, "spin(n)");
}

#[test]
fn eq_45_transport_is_generated_by_minus_ad() {
    // u = (1, 0, 0) and n = e3: udot = -n x u = -e2
    let m3 = paper::m3().unwrap();
    let generator = m3.connection().transport_generator(&values(["0", "0", "1"])).unwrap();
    assert_eq!(generator.get(&[1, 0]), value::<Symbolic>("-1"));
    // sl(2): [n, H] = -2 n2 E + 2 n3 F, [n, E] = 2 n1 E - n3 H, [n, F] = -2 n1 F + n2 H
    let plus = Connection::canonical(&symbolic(&sl2()), Canonical::Plus);
    let minus_ad = tensor(
        3,
        [Up, Down],
        &[
            ([2, 1], "2*n2"),
            ([3, 1], "-2*n3"),
            ([1, 2], "n3"),
            ([2, 2], "-2*n1"),
            ([1, 3], "-n2"),
            ([3, 3], "2*n1"),
        ],
    );
    let generator = plus.transport_generator(&parameters("n", 3)).unwrap();
    assert_tensors(&generator, &minus_ad, "sl(2)");
}

#[test]
fn eq_46_all_27_affinities_of_m3() {
    let m3 = paper::m3().unwrap();
    // Lambda^i_jk: a block for each i, a row for each j
    let printed: [[[i64; 3]; 3]; 3] = [
        [[0, 0, 0], [0, 0, 1], [0, -1, 0]],
        [[0, 0, -1], [0, 0, 0], [1, 0, 0]],
        [[0, 1, 0], [-1, 0, 0], [0, 0, 0]],
    ];
    let gamma = m3.connection().gamma();
    for (i, j, k) in (0..27).map(|at| (at / 9, at / 3 % 3, at % 3)) {
        let expected = Symbolic::from_i64(printed[i][j][k]);
        assert_eq!(gamma.get(&[i, j, k]), expected, "Lambda^{i}_{j}{k}, from 0");
    }
    assert_eq!(gamma.len(), 6);
    // torsion and curvature of M(3)
    assert_tensors(&m3.connection().torsion(), &epsilons("1"), "torsion");
    assert!(m3.connection().curvature().is_empty());
    assert!(m3.connection().ricci().is_empty());
}

#[test]
fn eq_50_a_is_the_exponential_of_t_spin_n() {
    for t in TIMES {
        let a = matrices::inverse(&transport(Canonical::Plus, N, t));
        assert_close(&a, &rodrigues(N, t), "Rodrigues");
        let axis = Unit::new_normalize(Vector3::from(N));
        let rotation = Rotation3::from_axis_angle(&axis, t);
        let rotation = DMatrix::from_fn(3, 3, |i, j| rotation[(i, j)]);
        assert_close(&a, &rotation, "rotation about the axis");
    }
}

#[test]
fn eq_51_b_is_the_inverse_of_a() {
    for t in TIMES {
        let b = transport(Canonical::Plus, N, t);
        assert_close(&b, &rodrigues(N, -t), "exp(-t n~)");
        assert_close(&(b * rodrigues(N, t)), &DMatrix::identity(3, 3), "B A");
    }
}

#[test]
fn eq_57_spatial_and_body_velocity_are_transports_of_each_other() {
    // R = exp(Psi~): omega = R Omega, Omega = B omega; the rotation acts as A, not as exp(t n~/2)
    let t = 1.1;
    let body = DVector::from_vec(vec![0.2, -0.5, 0.9]);
    let spatial = rodrigues(N, t) * &body;
    let back = transport(Canonical::Plus, N, t) * &spatial;
    assert!((&back - &body).norm() < 1e-14);
    let halved = transport(Canonical::Zero, N, t) * &spatial;
    assert!((&halved - &body).norm() > 0.1, "the halved exponent is no change to the body frame");
}

#[test]
fn eq_60_a_ray_reaches_the_rotation_by_its_length() {
    // Psi = t n: the generator is linear in n, so Q(t, n) = Q(1, Psi)
    let psi = N.map(|n| 0.8 * n);
    let one = transport(Canonical::Plus, psi, 1.0);
    assert_close(&one, &transport(Canonical::Plus, N, 0.8), "Q(t, n)");
    assert_close(&one, &rodrigues(N, -0.8), "Rodrigues");
}
