//! `affinor geodesic --distribution`: extremals, geodesics between two points, and messages.

use crate::program::{Outcome, root, run};
use serde_json::Value;
use std::f64::consts::{PI, TAU};

fn outcome(arguments: &[&str]) -> Outcome {
    run(root(), &[&["geodesic"], arguments].concat(), b"")
}

fn json(arguments: &[&str]) -> Value {
    let outcome = outcome(&[arguments, &["--format", "json"]].concat());
    assert_eq!(outcome.status, 0, "{arguments:?}: {}", outcome.err);
    serde_json::from_str(&outcome.out).unwrap()
}

const HEISENBERG: [&str; 3] = ["heisenberg(3)", "--distribution", "x1, y1"];
const ENGEL: [&str; 3] = ["filiform(4)", "--distribution", "e1, e2"];

/// A full circle of radius 1 on the Heisenberg group encloses the area pi.
#[test]
fn the_exponential_map_of_the_heisenberg_group() {
    let found =
        json(&[&HEISENBERG[..], &["--covector", "1, 0, 1", "--time", "pi, 2*pi, 7"]].concat());
    let points = found["points"].as_array().unwrap();
    for (point, expected) in points.iter().zip([[0.0, 2.0, PI / 2.0], [0.0, 0.0, PI]]) {
        for (found, expected) in point["coordinates"].as_array().unwrap().iter().zip(expected) {
            assert!(
                (found.as_f64().unwrap() - expected).abs() < 1e-11,
                "{found} is not {expected}"
            );
        }
    }
    assert!((found["conjugate_time"].as_f64().unwrap() - TAU).abs() < 1e-10);
    assert_eq!((&found["multiplicity"], &found["kind"]), (&1.into(), &"normal".into()));
    assert_eq!(found["growth_vector"], serde_json::json!([2, 3]));
    // the covector in names, and another start
    let named = ["--covector", "z=1, x1=1, y1=0", "--time", "pi", "--from", "0,0,1"];
    let moved = json(&[&HEISENBERG[..], &named].concat());
    let z = moved["points"][0]["coordinates"][2].as_f64().unwrap();
    assert!((z - 1.0 - PI / 2.0).abs() < 1e-11 && moved["conjugate_time"].is_null());
}

/// With a metric, the inner product is its restriction: the speed of `p = (1, 0, 0)` is 1/2 if the
/// first vector has the length 2.
#[test]
fn the_restriction_of_a_metric() {
    let options = ["--metric", "diag(4,1,1)", "--covector", "1,0,0", "--time", "1"];
    let found = json(&[&HEISENBERG[..], &options].concat());
    assert_eq!((found["speed"].as_f64(), &found["orthonormal"]), (Some(0.5), &Value::Bool(false)));
}

/// The shortest curve from the origin to a point above it has the length `2 sqrt(pi z)`.
#[test]
fn geodesics_between_two_points() {
    let ends = ["--from", "0,0,0", "--to", "0,0,0.5"];
    let found = json(&[&HEISENBERG[..], &ends].concat());
    let length = found["geodesics"][0]["length"].as_f64().unwrap();
    assert!((length - 2.0 * f64::sqrt(PI / 2.0)).abs() < 1e-6, "{length}");
    assert_eq!(found["geodesics"].as_array().unwrap().len(), 1);
    let text = outcome(&[&HEISENBERG[..], &ends].concat()).out;
    assert!(text.contains("not proved: a shorter geodesic may exist"), "{text}");
}

#[test]
fn abnormal_extremals() {
    let abnormal = ["--abnormal", "--covector", "0,0,0,-1", "--time", "2"];
    let found = json(&[&ENGEL[..], &abnormal].concat());
    assert_eq!((&found["kind"], &found["vanishes"]), (&"abnormal".into(), &Value::Null));
    let x = found["points"][0]["coordinates"].as_array().unwrap();
    let x: Vec<f64> = x.iter().map(|x| x.as_f64().unwrap()).collect();
    assert!((x[1] - 2.0).abs() < 1e-12 && x[0].abs() + x[2].abs() + x[3].abs() < 1e-12, "{x:?}");
    let normal = json(&[&ENGEL[..], &["--covector", "0,1,0,0", "--time", "2"]].concat());
    assert_eq!(normal["also_abnormal"], true);
}

#[test]
fn messages() {
    for (space, options, message) in [
        (HEISENBERG, &["--covector", "0,0,1", "--time", "1"][..], "annihilates the distribution"),
        (HEISENBERG, &["--covector", "1,0", "--time", "1"], "a covector has 3"),
        (HEISENBERG, &["--covector", "1,0,0", "--time", "0"], "the time 0 is not positive"),
        (HEISENBERG, &["--covector", "1,0,0", "--time", "2,1"], "the time 1 is not after 2"),
        (HEISENBERG, &["--covector", "1,0,0", "--time", "x"], "`x`"),
        (HEISENBERG, &["--covector", "1,0,0"], "--time"),
        (HEISENBERG, &["--from", "0,0,0"], "--to"),
        (HEISENBERG, &["--from", "0,0,0", "--to", "0,0,0"], "is the start point"),
        (["so3", "--distribution", "e1, e9"], &["--covector", "1,0,0", "--time", "1"], "e9"),
        (
            ["so3", "--distribution", "e1, 2*e1"],
            &["--covector", "1,0,0", "--time", "1"],
            "span only",
        ),
        (
            ["so3", "--distribution", "e1"],
            &["--from", "0,0,0", "--to", "0,1,0"],
            "does not generate",
        ),
        (
            ["S^2", "--distribution", "m1"],
            &["--covector", "1,0", "--time", "1"],
            "needs a Lie algebra",
        ),
        (ENGEL, &["--abnormal", "--covector", "1,0,0,1", "--time", "1"], "h_1 = 1"),
        (
            ["filiform(4)", "--distribution", "e1, e2, e3"],
            &["--abnormal", "--covector", "0,0,0,1", "--time", "1"],
            "rank 2 only",
        ),
    ] {
        let outcome = outcome(&[&space[..], options].concat());
        assert_ne!(outcome.status, 0, "{space:?} {options:?}");
        assert!(outcome.err.contains(message), "{space:?} {options:?}: {}", outcome.err);
    }
    let alone = outcome(&["so3", "--covector", "1,0,0", "--time", "1"]);
    assert!(alone.err.contains("--distribution"), "{}", alone.err);
}

/// Messages have the option, the value and a remedy.
#[test]
fn places_and_remedies() {
    for (options, place, value, remedy) in [
        (
            &["--covector", "0,0,1", "--time", "1"][..],
            "--covector",
            "annihilates",
            "give a covector with p(e) != 0",
        ),
        (&["--covector", "1,0", "--time", "1"], "--covector", "2 values", "give x1, y1, z"),
        (&["--covector", "q=1", "--time", "1"], "--covector", "`q`", "give x1, y1, z"),
        (&["--covector", "1,0,0", "--time", "2,1"], "--time", "the time 1", "increasing order"),
        (&["--covector", "1,0,0", "--time", "-1"], "--time", "the time -1", "change the sign"),
        (&["--from", "0,0", "--to", "1,0,0"], "--from", "2 values", "give x1, y1, z"),
        (&["--from", "0,0,0", "--to", "1,0"], "--to", "2 values", "give x1, y1, z"),
    ] {
        let outcome = outcome(&[&HEISENBERG[..], options].concat());
        assert_ne!(outcome.status, 0, "{options:?}");
        for part in [place, value, remedy] {
            assert!(outcome.err.contains(part), "{options:?}, {part}: {}", outcome.err);
        }
    }
}

/// A search that finds nothing, and extremals with very small and very large numbers end.
#[test]
fn extreme_numbers_end() {
    for options in [
        &["--covector", "1e-200,0,1e-200", "--time", "1"][..],
        &["--covector", "1e200,0,1e200", "--time", "1"],
        &["--covector", "1,0,1", "--time", "1e300"],
        &["--covector", "1,0,1e12", "--time", "1"],
        &["--from", "0,0,0", "--to", "1e300,0,0", "--starts", "2"],
        &["--from", "0,0,0", "--to", "1e-30,0,0", "--starts", "2"],
    ] {
        let outcome = outcome(&[&HEISENBERG[..], options].concat());
        assert!([0, 1, 2].contains(&outcome.status), "{options:?}: {}", outcome.err);
        assert!(!outcome.err.contains("panicked"), "{options:?}: {}", outcome.err);
    }
}
