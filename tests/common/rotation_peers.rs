//! Rotations by other libraries: nalgebra and glam, and the formulas of Sophus and manif rewritten
//! here.
//!
//! - Sophus (H. Strasdat), `sophus/so3.hpp`: thresholds on angles at `epsilon = 1e-10`.
//! - manif (J. Deray, J. Sola), `impl/so3/SO3_base.h` and `SO3Tangent_base.h`: thresholds on squares at `eps = 1e-14`.
//!
//! Their Jacobians are matrices; here they act on vectors, and all are brought to `T_left` (the right Jacobian).
#![allow(dead_code, reason = "each takes what it needs")]

use affinor::group::rotation::matrix;
use affinor::group::{LieGroup, So3};
use glam::{DQuat, DVec3};
use nalgebra::{Matrix3, Quaternion, Rotation3, UnitQuaternion, Vector3};

type Three = [f64; 3];
type Four = [f64; 4];

/// The functions of a library on plain numbers; quaternions are `w, x, y, z`.
pub struct Peer {
    pub name: &'static str,
    pub exp: Option<fn(Three) -> Four>,
    pub log: Option<fn(Four) -> Three>,
    pub matrix: Option<fn(Three) -> [f64; 9]>,
    pub left: Option<fn(Three, Three) -> Three>,
    pub inverse: Option<fn(Three, Three) -> Three>,
    pub product: Option<fn(Three, Three) -> Three>,
}

pub const PEERS: [Peer; 6] = [
    Peer {
        name: "affinor",
        exp: Some(|x| four(So3.exp(&x.into()))),
        log: Some(|q| log(unit(q))),
        matrix: Some(|x| rows(matrix(&So3.exp(&x.into())))),
        left: Some(|x, v| So3.tangent_left(&x.into(), &v.into()).into()),
        inverse: Some(|x, v| {
            So3.tangent_left_inverse(&x.into(), &v.into()).map_or([f64::NAN; 3], Into::into)
        }),
        product: Some(|x, y| log(So3.compose(&So3.exp(&x.into()), &So3.exp(&y.into())))),
    },
    Peer {
        name: "nalgebra UnitQuaternion",
        exp: Some(|x| four(UnitQuaternion::from_scaled_axis(Vector3::from(x)))),
        log: Some(|q| unit(q).scaled_axis().into()),
        matrix: Some(|x| {
            rows(
                UnitQuaternion::from_scaled_axis(Vector3::from(x))
                    .to_rotation_matrix()
                    .into_inner(),
            )
        }),
        left: None,
        inverse: None,
        product: Some(|x, y| {
            let [x, y] = [x, y].map(|x| UnitQuaternion::from_scaled_axis(Vector3::from(x)));
            (x * y).scaled_axis().into()
        }),
    },
    Peer {
        name: "nalgebra Rotation3",
        exp: None,
        log: None,
        matrix: Some(|x| rows(Rotation3::from_scaled_axis(Vector3::from(x)).into_inner())),
        left: None,
        inverse: None,
        product: Some(|x, y| {
            let [x, y] = [x, y].map(|x| Rotation3::from_scaled_axis(Vector3::from(x)));
            (x * y).scaled_axis().into()
        }),
    },
    Peer {
        name: "glam DQuat",
        exp: Some(|x| glam_four(glam_exp(x))),
        log: Some(|[w, x, y, z]| glam_log(DQuat::from_xyzw(x, y, z, w))),
        matrix: Some(|x| {
            let columns = glam::DMat3::from_quat(glam_exp(x)).to_cols_array();
            rows(Matrix3::from_column_slice(&columns))
        }),
        left: None,
        inverse: None,
        product: Some(|x, y| glam_log(glam_exp(x) * glam_exp(y))),
    },
    Peer {
        name: "Sophus (formulas)",
        exp: Some(|x| four(sophus_exp(x))),
        log: Some(|q| sophus_log(unit(q))),
        matrix: Some(|x| rows(sophus_exp(x).to_rotation_matrix().into_inner())),
        left: Some(|x, v| {
            let angle = Vector3::from(x).norm();
            if angle * angle < 1e-20 {
                return jacobian(x, v, -0.5, 0.0);
            }
            let square = angle * angle;
            let sine = (angle - angle.sin()) / (square * angle);
            jacobian(x, v, -(1.0 - angle.cos()) / square, sine)
        }),
        inverse: Some(|x, v| {
            let square = Vector3::from(x).norm_squared();
            if square < 1e-20 {
                return jacobian(x, v, 0.5, 1.0 / 12.0);
            }
            let (angle, half) = (square.sqrt(), 0.5 * square.sqrt());
            jacobian(x, v, 0.5, (1.0 - 0.5 * angle * half.cos() / half.sin()) / (angle * angle))
        }),
        product: Some(|x, y| sophus_log(sophus_exp(x) * sophus_exp(y))),
    },
    Peer {
        name: "manif (formulas)",
        exp: Some(|x| four(manif_exp(x))),
        log: Some(|q| manif_log(unit(q))),
        matrix: Some(|x| rows(manif_exp(x).to_rotation_matrix().into_inner())),
        left: Some(|x, v| {
            let square = Vector3::from(x).norm_squared();
            if square <= 1e-14 {
                return jacobian(x, v, -0.5, 0.0);
            }
            let angle = square.sqrt();
            let sine = (angle - angle.sin()) / (square * angle);
            jacobian(x, v, -(1.0 - angle.cos()) / square, sine)
        }),
        inverse: Some(|x, v| {
            let square = Vector3::from(x).norm_squared();
            if square <= 1e-14 {
                return jacobian(x, v, 0.5, 0.0);
            }
            let angle = square.sqrt();
            let second = 1.0 / square - (1.0 + angle.cos()) / (2.0 * angle * angle.sin());
            jacobian(x, v, 0.5, second)
        }),
        product: Some(|x, y| manif_log(manif_exp(x) * manif_exp(y))),
    },
];

fn unit([w, x, y, z]: Four) -> UnitQuaternion<f64> {
    UnitQuaternion::new_unchecked(Quaternion::new(w, x, y, z))
}

fn four(g: UnitQuaternion<f64>) -> Four {
    [g.w, g.i, g.j, g.k]
}

fn rows(r: Matrix3<f64>) -> [f64; 9] {
    std::array::from_fn(|at| r[(at / 3, at % 3)])
}

fn log(g: UnitQuaternion<f64>) -> Three {
    So3.log(&g).map_or([f64::NAN; 3], Into::into)
}

fn glam_exp(x: Three) -> DQuat {
    DQuat::from_scaled_axis(DVec3::from(x))
}

fn glam_four(q: DQuat) -> Four {
    [q.w, q.x, q.y, q.z]
}

/// The rotation by the smaller angle, for a fair comparison: glam's angle is up to `2 pi`.
fn glam_log(q: DQuat) -> Three {
    (if q.w < 0.0 { -q } else { q }).to_scaled_axis().into()
}

/// `v + a x cross v + b x cross (x cross v)`.
fn jacobian(x: Three, v: Three, a: f64, b: f64) -> Three {
    let (x, v) = (Vector3::from(x), Vector3::from(v));
    let w = x.cross(&v);
    (v + w * a + x.cross(&w) * b).into()
}

pub fn sophus_exp(x: Three) -> UnitQuaternion<f64> {
    let x = Vector3::from(x);
    let square = x.norm_squared();
    let (w, factor) = if square < 1e-20 {
        let fourth = square * square;
        (1.0 - square / 8.0 + fourth / 384.0, 0.5 - square / 48.0 + fourth / 3840.0)
    } else {
        let angle = square.sqrt();
        ((0.5 * angle).cos(), (0.5 * angle).sin() / angle)
    };
    UnitQuaternion::new_unchecked(Quaternion::from_parts(w, x * factor))
}

pub fn sophus_log(g: UnitQuaternion<f64>) -> Three {
    let (w, v) = (g.w, g.imag());
    let square = v.norm_squared();
    let factor = if square < 1e-20 {
        2.0 / w - 2.0 / 3.0 * square / (w * w * w)
    } else {
        let n = square.sqrt();
        2.0 * if w < 0.0 { (-n).atan2(-w) } else { n.atan2(w) } / n
    };
    (v * factor).into()
}

pub fn manif_exp(x: Three) -> UnitQuaternion<f64> {
    let x = Vector3::from(x);
    let square = x.norm_squared();
    if square <= 1e-14 {
        return UnitQuaternion::new_unchecked(Quaternion::from_parts(1.0, x / 2.0));
    }
    let angle = square.sqrt();
    let (sin, cos) = (0.5 * angle).sin_cos();
    UnitQuaternion::new_unchecked(Quaternion::from_parts(cos, x.normalize() * sin))
}

pub fn manif_log(g: UnitQuaternion<f64>) -> Three {
    let (w, v) = (g.w, g.imag());
    let square = v.norm_squared();
    if square <= 1e-14 {
        return (v * 2.0).into();
    }
    let n = square.sqrt();
    (v * (2.0 * if w < 0.0 { (-n).atan2(-w) } else { n.atan2(w) } / n)).into()
}
