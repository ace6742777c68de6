//! SO(3) is accurate to a few ulps everywhere, compared with 1000-digit arithmetic; so are other
//! libraries, for comparison.
//!
//! `cargo test --test rotation_accuracy -- --ignored --nocapture` prints the table of docs/rotations.md.

use crate::common::property::properties;
use affinor::group::batch;
use affinor::group::rotation::{from_matrix, matrix};
use affinor::group::{LieGroup, So3};
use affinor::{Error, Law};
use nalgebra::{Matrix3, Quaternion, UnitQuaternion, Vector3};
use proptest::prelude::*;
#[path = "../../common/rotation_peers.rs"]
mod rotation_peers;

use rotation_peers::{PEERS, Peer};
use std::f64::consts::{PI, TAU};

const EPS: f64 = f64::EPSILON;

/// The stored points of one kind: the numbers of a line.
fn points(kind: &str) -> impl Iterator<Item = Vec<f64>> {
    let lines = include_str!("../../data/so3.txt").lines();
    lines.filter_map(move |line| {
        let numbers = line.strip_prefix(kind)?.strip_prefix(' ')?;
        Some(numbers.split(' ').map(|number| number.parse().expect("a number")).collect())
    })
}

/// The norm, without overflow or underflow.
fn norm(v: &[f64]) -> f64 {
    let largest = v.iter().fold(0.0, |m: f64, c| m.max(c.abs()));
    if largest == 0.0 {
        return 0.0;
    }
    v.iter().map(|c| (c / largest).powi(2)).sum::<f64>().sqrt() * largest
}

fn distance(u: &[f64], v: &[f64]) -> f64 {
    let difference: Vec<f64> = u.iter().zip(v).map(|(u, v)| u - v).collect();
    norm(&difference)
}

/// The relative error in units of the machine precision; infinite for NaN.
fn error(found: &[f64], exact: &[f64], scale: f64) -> f64 {
    let error = distance(found, exact);
    if error == 0.0 && found.iter().all(|c| c.is_finite()) {
        return 0.0;
    }
    let relative = error / scale / EPS;
    if relative.is_nan() { f64::INFINITY } else { relative }
}

/// A point, its error, and the factor by which the error may be larger: a condition number.
struct Row {
    angle: f64,
    error: f64,
    condition: f64,
}

/// Computes a row from the numbers of a point.
type Judge = Box<dyn Fn(&[f64]) -> Row>;

/// The errors of a method at all points of its functions.
fn rows(peer: &Peer, kind: &str) -> Option<Vec<Row>> {
    let three = |p: &[f64]| -> [f64; 3] { p[..3].try_into().unwrap() };
    let row: Judge = match kind {
        // the vector part and the whole, each relative to its own length, so that tiny rotations
        // count
        "exp" => {
            let f = peer.exp?;
            Box::new(move |p| {
                let (found, angle) = (f(three(p)), norm(&p[..3]));
                let whole = error(&found, &p[3..7], 1.0);
                let vector = error(&found[1..], &p[4..7], norm(&p[4..7]));
                // beyond pi the vector part is smaller again
                let error = if angle < 3.0 { whole.max(vector) } else { whole };
                Row { angle, error, condition: angle.max(1.0) }
            })
        }
        "log" => {
            let f = peer.log?;
            Box::new(move |p| {
                let found = f(p[..4].try_into().unwrap());
                let angle = norm(&p[4..7]);
                Row { angle, error: error(&found, &p[4..7], angle), condition: 1.0 }
            })
        }
        "matrix" => {
            let f = peer.matrix?;
            Box::new(move |p| {
                let angle = norm(&p[..3]);
                let error = error(&f(three(p)), &p[3..12], 1.0);
                Row { angle, error, condition: angle.max(1.0) }
            })
        }
        "left" => {
            let f = peer.left?;
            Box::new(move |p| {
                let error = error(&f(three(p), three(&p[3..])), &p[6..9], norm(&p[3..6]));
                Row { angle: norm(&p[..3]), error, condition: 1.0 }
            })
        }
        "inverse" => {
            let f = peer.inverse?;
            Box::new(move |p| {
                let angle = norm(&p[..3]);
                // the norm of T^-1, which is also its condition number
                let size =
                    if angle < 1.0 { 1.1 } else { (0.5 * angle / (0.5 * angle).sin()).abs() };
                let error = error(&f(three(p), three(&p[3..])), &p[6..9], norm(&p[3..6]) * size);
                Row { angle, error, condition: size }
            })
        }
        "product" => {
            let f = peer.product?;
            Box::new(move |p| {
                let (exact, found) = (&p[6..9], f(three(p), three(&p[3..])));
                let (size, angle) = (norm(&p[..3]) + norm(&p[3..6]), norm(exact));
                let mut error = error(&found, exact, angle);
                if angle > 3.0 {
                    // on both sides of pi
                    let other: Vec<f64> = exact.iter().map(|c| c * (1.0 - TAU / angle)).collect();
                    error = error.min(self::error(&found, &other, angle));
                }
                Row { angle: norm(&p[..3]), error, condition: (size / angle).max(1.0) }
            })
        }
        _ => unreachable!("{kind}"),
    };
    Some(points(kind).map(|p| row(&p)).collect())
}

const KINDS: [&str; 6] = ["exp", "log", "matrix", "left", "inverse", "product"];

/// Errors are at most 8 units of the machine precision, times the condition number if it is above
/// 1. The condition number is the angle for `exp`, the norm of the operator for `T^-1`, and `(|x| +
/// |y|)/|x*y|` for products.
#[test]
fn within_eight_roundings() {
    for kind in KINDS {
        for row in rows(&PEERS[0], kind).expect("affinor has them all") {
            let (found, bound) = (row.error, 8.0 * row.condition);
            assert!(found <= bound, "{kind} at {}: {found} eps, not {bound}", row.angle);
        }
    }
}

/// Logarithms from the matrix, also at and near `pi`.
#[test]
fn logarithms_of_matrices() {
    for p in points("matrix") {
        let r = Matrix3::from_row_slice(&p[3..12]);
        let (x, angle) = (Vector3::from_row_slice(&p[..3]), norm(&p[..3]));
        if angle > PI + 1e-9 {
            continue;
        }
        let found = So3.log(&from_matrix(&r, 4.0 * EPS).unwrap()).unwrap();
        let other = if angle > 3.0 { x * (1.0 - TAU / angle) } else { x };
        let error = (found - x).norm().min((found - other).norm());
        assert!(error <= 8.0 * EPS * angle.max(1.0), "{angle}: {found} for {x}");
        if angle < 0.1 {
            assert!(distance(found.as_slice(), x.as_slice()) <= 8.0 * EPS * angle, "{angle}");
        }
    }
}

#[test]
fn matrices_are_orthogonal() {
    for p in points("exp") {
        let r = matrix(&So3.exp(&Vector3::from_row_slice(&p[..3])));
        let defect = (r.transpose() * r - Matrix3::identity()).amax();
        assert!(defect <= 4.0 * EPS, "{:?}: {} eps", &p[..3], defect / EPS);
    }
}

/// The float nearest to `pi` is slightly smaller, so the vector is found again, from the quaternion
/// and from the matrix.
#[test]
fn the_largest_angle_below_a_half_turn() {
    for x in [Vector3::z() * PI, Vector3::y() * -PI, Vector3::x() * -PI] {
        let g = So3.exp(&x);
        assert_eq!(So3.log(&g).unwrap(), x);
        assert_eq!(So3.log(&from_matrix(&matrix(&g), 4.0 * EPS).unwrap()).unwrap(), x);
    }
}

/// At exactly `pi` the first component of the axis that is not zero is positive.
#[test]
fn the_sign_at_a_half_turn() {
    for v in [[1.0, 0.0, 0.0], [0.0, 0.6, -0.8], [0.0, 0.0, 1.0], [0.6, -0.8, 0.0]] {
        let v = Vector3::from(v);
        for (w, v) in [(0.0, v), (-0.0, v), (0.0, -v), (-0.0, -v)] {
            let g = UnitQuaternion::new_unchecked(Quaternion::from_parts(w, v));
            let x = So3.log(&g).unwrap();
            assert!(*x.iter().find(|c| **c != 0.0).unwrap() > 0.0, "{x}");
            assert!((x.norm() - PI).abs() < 2.0 * EPS * PI);
        }
    }
}

/// A finite float with random bits.
fn finite() -> impl Strategy<Value = f64> {
    any::<u64>().prop_map(f64::from_bits).prop_filter("finite", |x| x.is_finite())
}

fn vectors() -> impl Strategy<Value = Vector3<f64>> {
    prop_oneof![
        [finite(), finite(), finite()],
        [-8.0..8.0f64, -8.0..8.0, -8.0..8.0],
        [-1e-300..1e-300f64, -1e-310..1e-310, -1.0..1.0],
        Just([f64::MAX; 3]),
        Just([f64::MIN_POSITIVE, 5e-324, 0.0]),
    ]
    .prop_map(Vector3::from)
}

properties! {
    #![cases(4096)]
    #[test]
    fn nothing_finite_makes_a_nan(x in vectors(), v in vectors()) {
        let g = So3.exp(&x);
        prop_assert!((g.norm() - 1.0).abs() < 4.0 * EPS, "{g:?}");
        prop_assert!(So3.log(&g).unwrap().iter().all(|c| c.is_finite()));
        prop_assert!(So3.tangent_left(&x, &v).iter().all(|c| !c.is_nan()));
        if let Ok(u) = So3.tangent_left_inverse(&x, &v) {
            prop_assert!(u.iter().all(|c| !c.is_nan()), "{u}");
        }
    }

    /// Tangent operators and their inverses, and exp and log, are inverse to each other.
    #[test]
    fn inverses(
        x in [-1.8..1.8f64, -1.8..1.8, -1.8..1.8],
        v in [-1.0..1.0f64, -1.0..1.0, -1.0..1.0],
    ) {
        let (x, v) = (Vector3::from(x), Vector3::from(v));
        let back = So3.tangent_left_inverse(&x, &So3.tangent_left(&x, &v)).unwrap();
        prop_assert!((back - v).norm() <= 32.0 * EPS * v.norm());
        if x.norm() < PI {
            prop_assert!((So3.log(&So3.exp(&x)).unwrap() - x).norm() <= 8.0 * EPS * x.norm().max(1e-300));
        }
    }
}

/// Kernels for many rows give the values of single calls, also in blocks with an exceptional
/// element.
#[test]
fn batches() {
    let vectors: Vec<Vector3<f64>> =
        points("exp").map(|p| Vector3::from_row_slice(&p[..3])).collect();
    let near: Vec<Vector3<f64>> =
        (0..5000).map(|k| Vector3::new(1e-4, -3e-4, 2e-4) * f64::from(k)).collect();
    for mut vectors in [vectors, near] {
        for _ in 0..2 {
            let singles: Vec<UnitQuaternion<f64>> = vectors.iter().map(|x| So3.exp(x)).collect();
            let rotations: Vec<[f64; 4]> = singles.iter().map(|g| [g.w, g.i, g.j, g.k]).collect();
            let rows: Vec<[f64; 3]> = vectors.iter().map(|x| (*x).into()).collect();
            let mut found = vec![[0.0; 4]; rows.len()];
            batch::exp_rows(&rows, &mut found);
            let mut squares = found.clone();
            batch::compose_rows(&rotations, &found, &mut squares);
            let mut logarithms = rows.clone();
            assert!(batch::log_rows(&rotations, &mut logarithms));
            for (at, g) in singles.iter().enumerate() {
                let (x, square) = (vectors[at], g * g);
                let square = [square.w, square.i, square.j, square.k];
                assert!(distance(&found[at], &rotations[at]) <= 2.0 * EPS, "{x}");
                assert!(distance(&squares[at], &square) <= 4.0 * EPS, "{x}");
                let log = So3.log(g).unwrap();
                assert!(distance(&logarithms[at], log.as_slice()) <= 2.0 * EPS * log.norm(), "{x}");
            }
            vectors.push(Vector3::new(0.0, 7.0, 1e200));
        }
    }
    let mut found = [[0.0; 3]; 2];
    assert!(!batch::log_rows(&[[3.0, 0.0, 4.0, 0.0], [0.0; 4]], &mut found));
    assert!(distance(&found[0], &[0.0, 2.0 * 4.0f64.atan2(3.0), 0.0]) < 4.0 * EPS);
    assert!(found[1][0].is_nan());
}

/// Prints the table: the largest error in units of the machine precision, divided by the condition
/// number.
#[test]
#[ignore = "prints the table of docs/rotations.md"]
fn table() {
    let ranges = [(0.0, 1e-4), (1e-4, 3.0), (3.0, 3.3), (3.3, 6.0), (6.0, 6.6), (6.6, f64::MAX)];
    let names = ["up to 1e-4", "1e-4 to 3", "3 to 3.3", "3.3 to 6", "6 to 6.6", "above"];
    println!("| | |{}", names.map(|name| format!(" {name} |")).concat());
    println!("|---|---|{}", "---|".repeat(names.len()));
    for kind in KINDS {
        for peer in &PEERS {
            let Some(rows) = rows(peer, kind) else { continue };
            print!("| {kind} | {} |", peer.name);
            for (low, high) in ranges {
                let inside = rows.iter().filter(|row| row.angle >= low && row.angle < high);
                let errors: Vec<f64> = inside.map(|row| row.error / row.condition).collect();
                match errors.iter().copied().reduce(f64::max) {
                    None => print!(" |"),
                    Some(e) if e < 100.0 => print!(" {e:.1} |"),
                    Some(e) => print!(" {e:.0e} |"),
                }
            }
            println!();
        }
    }
}

/// A quaternion of any length is projected to length 1, and has the logarithm of its rotation.
#[test]
fn lengths_of_quaternions_have_no_influence() {
    let g = So3.exp(&Vector3::new(0.9, -1.3, 0.4));
    for off in [0.0, 1e-12, -1e-9, 1e-8, -1e-6, 1e-5, 1e-4, -1e-3, 0.01, -0.5, 1.0, 1e9] {
        let scaled = UnitQuaternion::new_unchecked(g.into_inner() * (1.0 + off));
        let projected = So3.project(scaled);
        assert!((projected.coords - g.coords).amax() <= 2.0 * EPS, "{off}: {projected}");
        let logs = [&g, &scaled].map(|g| So3.log(g).unwrap());
        assert!((logs[0] - logs[1]).amax() <= 4.0 * EPS, "{off}: {}", logs[1]);
    }
}

/// The logarithm near a vector differs from it by at most half a turn, along its own axis: at the identity that of the vector.
#[test]
fn logarithms_near_vectors() {
    let axis = Vector3::new(2.0, -1.0, 2.0) / 3.0;
    for angle in [0.0, 1.0, 3.0, 4.0, TAU, 10.0, 5.0 * TAU] {
        let x = axis * angle;
        let g = if angle % TAU == 0.0 { So3.identity() } else { So3.exp(&x) };
        for near in [-2.5, -0.4, 0.0, 0.4, 2.5].map(|off| axis * (angle + off)) {
            let found = So3.log_near(&g, &near).unwrap();
            assert!((found - x).norm() <= 1e-14 * angle.max(1.0), "{angle}: {found} near {near}");
        }
    }
}

/// The rounding error of a long vector exceeds its distance from the singular lengths `2 pi k`.
#[test]
fn tangents_at_long_vectors_are_rejected() {
    let (axis, v) = (Vector3::new(2.0, -1.0, 2.0) / 3.0, Vector3::new(0.3, 0.5, -0.2));
    let huge = [1e16, 1e100, 1e300];
    for length in (1..=100).map(|k| 1e15 + 1e12 * f64::from(k)).chain(huge) {
        let found = So3.tangent_left_inverse(&(axis * length), &v);
        assert!(matches!(found, Err(Error::Broken { law: Law::RegularTangent, .. })), "{length}");
    }
    for length in [1.0, 1e3, 1e8, 1e12] {
        let x = axis * length;
        let there = So3.tangent_left_inverse(&x, &v).unwrap();
        let back = So3.tangent_left(&x, &there);
        assert!((back - v).norm() <= 1e-3, "{length}: {back}");
    }
}
