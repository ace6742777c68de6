//! Section 2: rotating bodies as in a course of mechanics, (1)-(16).
//!
//! The body is four point masses; sums over them stand against the library's rotations, velocities,
//! momenta and equations of motion.

use crate::common::labels;
use crate::paper::on_groups::{column, equal, path, rate, same};
use affinor::geometry::equations::Equations;
use affinor::group::{LieGroup, So3, Velocity};
use affinor::mechanics::MassProperties;
use affinor::{Canonical, Connection, Metric};
use affinor_tensors::{Down, Tensor};
use nalgebra::{DMatrix, Isometry3, Matrix3, Translation3, UnitQuaternion, Vector3};

const T: f64 = 0.8;

/// Masses and their places in the body; no axis is principal.
fn body() -> [(f64, Vector3<f64>); 4] {
    [
        (1.0, Vector3::new(0.3, -0.5, 1.0)),
        (2.0, Vector3::new(-1.0, 0.2, 0.4)),
        (0.5, Vector3::new(0.8, 1.5, -0.3)),
        (1.5, Vector3::new(0.1, -0.7, -0.9)),
    ]
}

fn rotation(t: f64) -> UnitQuaternion<f64> {
    path(&So3)(t)
}

fn matrix(t: f64) -> DMatrix<f64> {
    So3.matrix(&rotation(t))
}

fn velocity(t: f64) -> Velocity<Vector3<f64>> {
    Velocity::of_path(&So3, rotation, t, 0.02).unwrap()
}

/// Rows `[0, -w3, w2], [w3, 0, -w1], [-w2, w1, 0]`, (6).
fn spin(w: &Vector3<f64>) -> DMatrix<f64> {
    DMatrix::from_row_slice(3, 3, &[0.0, -w.z, w.y, w.z, 0.0, -w.x, -w.y, w.x, 0.0])
}

/// `sum m ((X . X) 1 - X X^T)`.
fn inertia(places: impl Iterator<Item = (f64, Vector3<f64>)>) -> Matrix3<f64> {
    places.fold(Matrix3::zeros(), |sum, (m, x)| {
        sum + (Matrix3::identity() * x.dot(&x) - x * x.transpose()) * m
    })
}

fn metric() -> Metric<f64> {
    let j = inertia(body().into_iter());
    let components = Tensor::from_fn(3, [Down, Down], |[i, k]| j[(i, k)]).unwrap();
    Metric::new(labels(3), components).unwrap()
}

/// `H = J Omega` by the library.
fn momentum(omega: &Vector3<f64>) -> Vector3<f64> {
    Vector3::from_vec(metric().lower(omega.as_slice()).unwrap())
}

/// `sum m x cross v` over the moving masses, with `v` from the positions.
fn spatial_momentum(t: f64) -> Vector3<f64> {
    body().iter().fold(Vector3::zeros(), |sum, (m, place)| {
        let at = |t: f64| DMatrix::from_column_slice(3, 1, (rotation(t) * place).as_slice());
        let (x, v) = (at(t), rate(at, t));
        let [x, v] = [x, v].map(|v| Vector3::from_column_slice(v.as_slice()));
        sum + x.cross(&v) * *m
    })
}

#[test]
fn eq_1_to_4_rotations_take_body_to_spatial_components() {
    // a third of a turn about (1, 1, 1): E_1 -> E_2 -> E_3, whose columns are the e_i
    let third = So3.exp(&(Vector3::repeat(1.0).normalize() * std::f64::consts::TAU / 3.0));
    let r = So3.matrix(&third);
    let expected = DMatrix::from_row_slice(3, 3, &[0.0, 0.0, 1.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0]);
    same(&r, &expected, "(1), (3)");
    for (i, unit) in So3.basis().iter().enumerate() {
        let e = third * unit; // e_i = R E_i = r_ji E_j
        equal(&column(&e), &r.column(i).into_owned(), "(1)");
    }
    // (2), (3): x = X_i e_i has the spatial components R X
    let place = Vector3::new(3.0, 5.0, 7.0);
    assert!((third * place - Vector3::new(7.0, 3.0, 5.0)).norm() < 1e-14);
    // (4)
    for t in [-2.0, 0.3, 1.9] {
        let r = matrix(t);
        assert!((r.transpose() * &r - DMatrix::identity(3, 3)).amax() < 1e-15);
        assert!((r.determinant() - 1.0).abs() < 1e-14);
    }
}

#[test]
fn eq_5_to_8_both_angular_velocities() {
    for t in [-0.4, T, 1.5] {
        let (r, derivative, Velocity { body, spatial }) = (matrix(t), rate(matrix, t), velocity(t));
        // (5), (6), (7)
        same(&(r.transpose() * &derivative), &spin(&body), "R^T Rdot");
        same(&(&derivative * r.transpose()), &spin(&spatial), "Rdot R^T");
        // (8)
        same(&(spin(&spatial) * &r), &derivative, "omega~ R");
        same(&(&r * spin(&body)), &derivative, "R Omega~");
        assert!((body - spatial).norm() > 1e-3);
    }
}

#[test]
fn eq_9_and_10_velocities_of_points() {
    let Velocity { body: omega_body, spatial } = velocity(T);
    for (_, place) in body() {
        let at = |t: f64| DMatrix::from_column_slice(3, 1, (rotation(t) * place).as_slice());
        let v = rate(at, T).column(0).into_owned();
        equal(&column(&spatial.cross(&(rotation(T) * place))), &v, "(9)");
        equal(&column(&(rotation(T) * omega_body.cross(&place))), &v, "R (Omega x X)");
    }
    equal(&(matrix(T) * column(&omega_body)), &column(&spatial), "(10)");
}

#[test]
fn eq_11_to_14_momenta_of_the_body_and_of_space() {
    let Velocity { body: omega_body, spatial } = velocity(T);
    let (r, h) = (rotation(T), spatial_momentum(T));
    // (12): J and I(t) = R J R^T; X~^T X~ = (X . X) 1 - X X^T
    let j = inertia(body().into_iter());
    let turned = inertia(body().into_iter().map(|(m, x)| (m, r * x)));
    let of_spin = body()
        .iter()
        .fold(DMatrix::zeros(3, 3), |sum, (m, x)| sum + spin(x).transpose() * spin(x) * *m);
    same(&of_spin, &DMatrix::from_column_slice(3, 3, j.as_slice()), "(12)");
    let rotation_matrix = Matrix3::from_column_slice(So3.matrix(&r).as_slice());
    assert!((rotation_matrix * j * rotation_matrix.transpose() - turned).norm() < 1e-13);
    let masses = MassProperties::points(&body()).unwrap();
    let about_origin = |masses: MassProperties| masses.inertia_matrix_about(&Vector3::zeros());
    assert!((about_origin(masses) - j).norm() < 1e-14);
    let moved = masses.moved(&Isometry3::from_parts(Translation3::identity(), r));
    assert!((about_origin(moved) - turned).norm() < 1e-13);
    // (11), (13), (14)
    assert!((turned * spatial - h).norm() < 1e-10, "h = I omega");
    assert!((r * momentum(&omega_body) - h).norm() < 1e-10, "h = R H");
    assert!((momentum(&omega_body) - h).norm() > 1e-2);
}

#[test]
fn eq_15_eulers_law_in_the_body() {
    // after (14): the torque m is the rate of h; in the body M = R^T m
    let h = |t: f64| DMatrix::from_column_slice(3, 1, spatial_momentum(t).as_slice());
    let torque = matrix(T).transpose() * rate(h, T);
    let plus = Connection::canonical(&So3.algebra().unwrap(), Canonical::Plus);
    let euler = Equations::euler_poincare(&plus, &metric()).unwrap();
    let omega = |t: f64| DMatrix::from_column_slice(3, 1, velocity(t).body.as_slice());
    let found = euler.rate(omega(T).as_slice(), torque.as_slice()).unwrap();
    let off = Vector3::from_vec(found) - Vector3::from_column_slice(rate(omega, T).as_slice());
    assert!(off.norm() < 1e-7, "J dOmega/dt = M - Omega x H: {off}");
    // and without the gyroscopic term it fails
    assert!(velocity(T).body.cross(&momentum(&velocity(T).body)).norm() > 0.1);
}

#[test]
fn eq_16_kinetic_energy() {
    let energy = body().iter().fold(0.0, |sum, (m, place)| {
        let at = |t: f64| DMatrix::from_column_slice(3, 1, (rotation(t) * place).as_slice());
        sum + 0.5 * m * rate(at, T).norm_squared()
    });
    let omega = velocity(T).body;
    assert!((0.5 * momentum(&omega).dot(&omega) - energy).abs() < 1e-10 * energy);
}
