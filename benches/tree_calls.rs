//! The dynamics of a tree of bodies in this process: the peer of a call inside another program.
//!
//! `cargo bench -p affinor-benches --bench tree_calls -- FILE`, where FILE is
//! `{"joints": [{"before": body, "kind": "revolute", "at": [x, y, z], "axis": [x, y, z]}, ..],
//! "bodies": [{"mass": m, "centre": [x, y, z], "inertia": [[..], ..]}, ..], "gravity": [x, y, z],
//! "numbers": [..], "rates": [..], "forces": [..]}`. Body 0 is the ground, and joint k leads to body
//! k + 1. It prints a line of JSON: the least seconds per call of forward dynamics, inverse dynamics
//! and the mass matrix, and the accelerations. Each call contains the forward kinematics.

use affinor::mechanics::MassProperties;
use affinor::mechanism::{Joint, Mechanism, MovingTree, Tree};
use nalgebra::{Matrix3, Vector3};
use serde_json::{Value, json};
use std::hint::black_box;
use std::time::Instant;

fn list(value: &Value) -> Vec<f64> {
    value.as_array().unwrap().iter().map(|number| number.as_f64().unwrap()).collect()
}

fn vector(value: &Value) -> Vector3<f64> {
    Vector3::from_vec(list(value))
}

/// The least seconds per call, over series of calls that fill a second.
fn least(mut call: impl FnMut()) -> f64 {
    let (mut least, begin, mut calls) = (f64::INFINITY, Instant::now(), 1);
    while begin.elapsed().as_secs_f64() < 1.0 {
        let start = Instant::now();
        (0..calls).for_each(|_| call());
        let seconds = start.elapsed().as_secs_f64();
        least = least.min(seconds / f64::from(calls));
        if seconds < 1e-3 {
            calls *= 2;
        }
    }
    least
}

fn main() {
    // cargo adds an option
    let file = std::env::args().skip(1).find(|argument| !argument.starts_with("--")).unwrap();
    let model: Value = serde_json::from_str(&std::fs::read_to_string(file).unwrap()).unwrap();
    let (mut joints, mut bodies, mut names) = (vec![], vec![None], vec!["0".to_string()]);
    for (at, joint) in model["joints"].as_array().unwrap().iter().enumerate() {
        let axis = vector(&joint["axis"]).into();
        let own = match joint["kind"].as_str().unwrap() {
            "revolute" => Joint::revolute(&vector(&joint["at"]).into(), &axis),
            _ => Joint::prismatic(&axis),
        };
        let before = joint["before"].as_u64().unwrap() as usize;
        joints.push(own.unwrap().between(format!("J{at}"), [before, at + 1]));
        names.push((at + 1).to_string());
    }
    for body in model["bodies"].as_array().unwrap() {
        let rows: Vec<f64> = body["inertia"].as_array().unwrap().iter().flat_map(list).collect();
        let inertia = Matrix3::from_row_slice(&rows);
        let mass = body["mass"].as_f64().unwrap();
        bodies.push(Some(MassProperties::new(mass, vector(&body["centre"]), &inertia).unwrap()));
    }
    let mechanism = Mechanism::new(names, &[0], joints).unwrap();
    let tree = Tree::new(&mechanism, &bodies, &vector(&model["gravity"])).unwrap();
    let [numbers, rates, forces] = ["numbers", "rates", "forces"].map(|key| list(&model[key]));
    let mut moving = MovingTree::new(tree.into());
    let mut accelerations = vec![0.0; rates.len()];
    let forward = least(|| {
        moving.place(black_box(&numbers), black_box(&rates));
        moving.forward(black_box(&forces), &mut accelerations).unwrap();
    });
    let mut back = vec![0.0; rates.len()];
    let inverse = least(|| {
        moving.place(black_box(&numbers), black_box(&rates));
        moving.inverse(black_box(&accelerations), &mut back);
    });
    let mass = least(|| {
        moving.place(black_box(&numbers), black_box(&rates));
        black_box(moving.mass_matrix());
    });
    let answer = json!({
        "forward": forward, "inverse": inverse, "mass": mass, "accelerations": accelerations,
    });
    println!("{answer}");
}
