//! Runs are compared with stored references and closed forms.

use super::run::{Run, open};
use affinor_documents::problem::Problem;
use serde_json::Value;

pub fn number(value: &Value) -> f64 {
    value.as_str().unwrap().parse().unwrap()
}

pub fn numbers(value: &Value) -> Vec<f64> {
    value.as_array().unwrap().iter().map(number).collect()
}

/// The largest difference, relative to the expected size if that is above 1.
pub fn off(found: &[f64], expected: &[f64]) -> f64 {
    assert_eq!(found.len(), expected.len());
    let size = expected.iter().fold(1.0_f64, |size, x| size.max(x.abs()));
    found.iter().zip(expected).map(|(x, y)| (x - y).abs() / size).fold(0.0, f64::max)
}

pub fn references() -> Value {
    serde_json::from_str(include_str!("../../../../tests/data/motions.json")).unwrap()
}

/// The states of bodies with wheels and joints, computed without products of groups.
pub fn joints() -> Value {
    serde_json::from_str(include_str!("../../../../tests/data/joints.json")).unwrap()
}

/// The states of a motion of `motions.json` up to its end time: elements and body momenta.
pub fn taylor(run: &Run, name: &str, bound: f64) {
    let all = references();
    let motions = all["motions"].as_array().unwrap();
    let motion = motions.iter().find(|motion| motion["name"] == name).unwrap();
    let end = run.column("t")[run.rows.len() - 1];
    let states = motion["states"].as_array().unwrap();
    let within: Vec<&Value> = states.iter().filter(|s| number(&s["time"]) <= end).collect();
    assert_eq!(number(&within.last().unwrap()["time"]), end, "{name} has no state at its end");
    for state in within {
        let row = run.at(number(&state["time"]));
        let element = run.matrix(row).transpose();
        let found = [element.as_slice(), &run.vector(row, "H")].concat();
        let expected = [numbers(&state["element"]), numbers(&state["momentum"])].concat();
        let error = off(&found, &expected);
        println!("{name} at {}: {error:.1e}", state["time"]);
        assert!(error < bound, "{name} at {}: {error:e}", state["time"]);
    }
}

/// Quaternions and momenta of `free_body.txt`.
pub fn free_body(problem: &Problem, name: &str, bound: f64) {
    let run = Run::new(problem, 0);
    let mut count = 0;
    for line in include_str!("../../../../tests/data/free_body.txt").lines() {
        let Some(rest) = line.strip_prefix(name).and_then(|rest| rest.strip_prefix(' ')) else {
            continue;
        };
        let n: Vec<f64> = rest.split(' ').map(|number| number.parse().unwrap()).collect();
        if !(0.0..=*problem.times(0).unwrap().last().unwrap()).contains(&n[16]) {
            continue;
        }
        let row = run.at(n[16]);
        let found = [run.values(row, &["qw", "qx", "qy", "qz"]), run.vector(row, "H")].concat();
        let error = off(&found, &n[17..24]);
        println!("{name} at {}: {error:.1e}", n[16]);
        assert!(error < bound, "{name} at {}: {error:e}", n[16]);
        count += 1;
    }
    assert!(count >= 3, "{name}: {count} states");
    run.keeps(&["h1", "h2", "h3", "energy", "casimir1"], 1e-13);
}

/// The states in `isospectral.txt` for a flow and a size. Each row begins with numbers that
/// describe the start.
pub fn isospectral(run: &Run, name: &str, given: usize, columns: &[String], bound: f64) {
    let lines = include_str!("../../../../tests/data/isospectral.txt").lines();
    let lines: Vec<&str> = lines.filter_map(|line| line.strip_prefix(name)).collect();
    assert!(lines.len() >= 3, "{name}");
    let columns: Vec<&str> = columns.iter().map(String::as_str).collect();
    for line in lines {
        let n: Vec<f64> = line.split_whitespace().map(|word| word.parse().unwrap()).collect();
        let error = off(&run.values(run.at(n[0]), &columns), &n[1 + given..]);
        println!("{name} at {}: {error:.1e}", n[0]);
        assert!(error < bound, "{name} at {}: {error:e}", n[0]);
    }
}

pub fn pairs(stem: &str, n: usize) -> Vec<String> {
    let pairs = (1..=n).flat_map(|i| (i + 1..=n).map(move |j| (i, j)));
    pairs.map(|(i, j)| format!("{stem}{i}{j}")).collect()
}

pub fn toda(name: &str, n: usize) {
    let run = Run::new(&open(name), 0);
    let mut columns: Vec<String> = (1..=n).map(|i| format!("L{i}{i}")).collect();
    columns.extend((1..n).map(|i| format!("L{}{i}", i + 1)));
    isospectral(&run, &format!("toda {n} "), 2 * n - 1, &columns, 1e-8);
    let eigenvalues: Vec<String> = (1..=n).map(|i| format!("lambda{i}")).collect();
    run.keeps(&eigenvalues.iter().map(String::as_str).collect::<Vec<_>>(), 1e-12);
}

pub fn manakov(name: &str, n: usize) {
    let run = Run::new(&open(name), 0);
    let given = n + n * (n - 1) / 2;
    isospectral(&run, &format!("manakov {n} "), given, &pairs("M", n), 1e-7);
    run.keeps(&["energy", "norm_squared", "pfaffian", "manakov"], 1e-10);
}

pub fn zeitlin(name: &str, n: usize) {
    let run = Run::new(&open(name), 0);
    let modes = (1..n).flat_map(|l| (-(l as i64)..=l as i64).map(move |m| format!("w{l}_{m}")));
    isospectral(&run, &format!("zeitlin {n} "), n * n - 1, &modes.collect::<Vec<_>>(), 1e-7);
    run.keeps(&["energy", "enstrophy", "L1", "L2", "L3"], 1e-11);
}
