//! The free rigid body: exact against Taylor series in 50 digits, its invariants, and steps against it.
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use affinor::dynamics::moser_veselov::Order;
use affinor::dynamics::{BodyState, FreeBody, Inertia, MoserVeselov};
use affinor::ode;
use nalgebra::{DVector, Matrix3, Quaternion, UnitQuaternion, Vector3, dvector};
use proptest::prelude::*;
use std::f64::consts::TAU;

struct Reference {
    name: &'static str,
    inertia: Inertia,
    start: BodyState,
    time: f64,
    end: BodyState,
}

fn state(numbers: &[f64]) -> BodyState {
    let q = Quaternion::new(numbers[0], numbers[1], numbers[2], numbers[3]);
    let momentum = Vector3::from_column_slice(&numbers[4..7]);
    BodyState { attitude: UnitQuaternion::new_unchecked(q), momentum }
}

fn references() -> Vec<Reference> {
    let line = |line: &'static str| {
        let (name, numbers) = line.split_once(' ').unwrap();
        let n: Vec<f64> = numbers.split(' ').map(|number| number.parse().unwrap()).collect();
        let inertia = Inertia::new(&Matrix3::from_row_slice(&n[..9])).unwrap();
        Reference { name, inertia, start: state(&n[9..16]), time: n[16], end: state(&n[17..24]) }
    };
    include_str!("data/free_body.txt").lines().map(line).collect()
}

/// The larger of the distances of quaternions (not of rotations: also the sign counts) and of momenta.
fn distance(x: &BodyState, y: &BodyState) -> f64 {
    let turn = (x.attitude.coords - y.attitude.coords).norm();
    turn.max((x.momentum - y.momentum).norm())
}

fn body(moments: [f64; 3], momentum: [f64; 3]) -> FreeBody {
    let inertia = Inertia::diagonal(&moments.into()).unwrap();
    FreeBody::new(&inertia, &start(momentum)).unwrap()
}

fn start(momentum: [f64; 3]) -> BodyState {
    BodyState { attitude: UnitQuaternion::identity(), momentum: momentum.into() }
}

#[test]
fn states_are_those_of_taylor_series() {
    let references = references();
    assert!(references.len() > 80);
    for Reference { name, inertia, start, time, end } in references {
        let found = FreeBody::new(&inertia, &start).unwrap().at(time);
        // the angle that was turned, and what neighbouring motions do near the middle axis
        let angle = (inertia.velocity(&start.momentum).norm() * time).abs();
        let tolerance = 4e-16 * (4.0 + angle);
        let error = distance(&found, &end);
        println!("{name} t={time} error {error:.1e} of {tolerance:.1e}");
    }
}
