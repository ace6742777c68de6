//! `affinor geodesic`: closed forms on spheres and hyperbolic planes, references of other programs,
//! groups and homogeneous spaces, and messages.
#![allow(clippy::excessive_precision, reason = "references have 25 digits")]

use crate::program::{Outcome, root, run};
use serde_json::Value;

fn outcome(arguments: &[&str]) -> Outcome {
    run(root(), &[&["geodesic"], arguments].concat(), b"")
}

fn json(arguments: &[&str]) -> Value {
    let outcome = outcome(&[arguments, &["--format", "json"]].concat());
    assert_eq!(outcome.status, 0, "{arguments:?}: {}", outcome.err);
    serde_json::from_str(&outcome.out).unwrap()
}

/// The lengths of all geodesics.
fn lengths(report: &Value) -> Vec<f64> {
    let geodesics = report["geodesics"].as_array().unwrap();
    geodesics.iter().map(|geodesic| geodesic["length"].as_f64().unwrap()).collect()
}

fn numbers(value: &Value) -> Vec<f64> {
    value.as_array().unwrap().iter().map(|number| number.as_f64().unwrap()).collect()
}

fn assert_near(found: f64, expected: f64, relative: f64) {
    assert!((found / expected - 1.0).abs() <= relative, "{found} is not {expected}");
}

/// The great-circle distance: `acos(cos a cos b + sin a sin b cos(phi))`, in 25 digits.
#[test]
fn great_circles_on_the_sphere() {
    for (from, to, length) in [
        ("theta=1, phi=0.5", "theta=2, phi=2.5", 2.145110075517188557751268),
        ("pi/2, 0", "pi/3, 1", 1.083865636737715405565865),
        ("0.1, 0", "3, 0.2", 2.901176613712920556243611),
    ] {
        let report = json(&["sphere", "--set", "R=1", "--from", from, "--to", to]);
        assert_near(lengths(&report)[0], length, 1e-12);
        assert!(report["geodesics"][0]["residual"].as_f64().unwrap() < 1e-11);
        assert_eq!(report["geodesics"][0]["conjugate"], false);
    }
}

/// The distance in the half-plane: `acosh(1 + ((x - x')^2 + (y - y')^2)/(2 y y'))`, in 25 digits.
#[test]
fn the_hyperbolic_plane() {
    for (from, to, length) in [
        ("0, 1", "3, 2", 1.924847300238413789991036),
        ("-1, 0.01", "1, 0.01", 10.59668473122117751473765),
        ("x=0.5, y=1", "y=4, x=0.5", 1.386294361119890618834464),
    ] {
        let report = json(&["hyperbolic-plane", "--set", "R=1", "--from", from, "--to", to]);
        let found = lengths(&report);
        assert_near(found[0], length, 1e-11);
        assert_eq!(found.len(), 1, "a geodesic of the hyperbolic plane is unique");
        // the search does not depend on the unit of length
        let large = json(&["hyperbolic-plane", "--set", "R=1e15", "--from", from, "--to", to]);
        assert_near(lengths(&large)[0], 1e15 * length, 1e-11);
    }
}

/// New York to London on the ellipsoid WGS84, with the length of GeographicLib; see
/// tests/references/geodesics.py.
#[test]
fn the_earth() {
    let report = json(&[
        "ellipsoid",
        "--set",
        "a=6378137,c=6356752.314245179",
        "--from",
        "pi/2 - 0.7069446507862165,-1.2880529879718152",
        "--to",
        "pi/2 - 0.8989544148183954,-0.008726646259971648",
    ]);
    assert_near(lengths(&report)[0], 5551759.4003186785, 1e-13);
}

/// A particle between two events near a black hole, with the velocity of SciPy's solve_bvp; see
/// tests/references/geodesics.py.
#[test]
fn between_two_events() {
    let report = json(&[
        "schwarzschild",
        "--set",
        "M=1",
        "--from",
        "t=0,r=10,theta=pi/2,phi=0",
        "--to",
        "t=60,r=12,theta=pi/2,phi=1.2",
    ]);
    let velocity = numbers(&report["geodesics"][0]["velocity"]);
    let expected = [62.0960546893038, 6.193684515060372, 0.0, 1.6182746797673193];
    for (found, expected) in velocity.iter().zip(expected) {
        assert!((found - expected).abs() < 1e-9, "{found} is not {expected}");
    }
    assert_near(lengths(&report)[0], 52.67734382658148, 1e-11);
    assert!(report["geodesics"][0]["square"].as_f64().unwrap() < 0.0);
}

/// Rotations with the bi-invariant metric: the length is the angle, and the other way around has the
/// rest of a full turn.
#[test]
fn rotations() {
    let end = ["--metric", "identity", "--from", "0,0,0", "--to", "0.3,1,-0.5", "--starts", "12"];
    let report = json(&[&["so3"][..], &end].concat());
    let angle = 1.34_f64.sqrt();
    let found = lengths(&report);
    assert_near(found[0], angle, 1e-12);
    assert!(
        found.iter().any(|length| (length - (std::f64::consts::TAU - angle)).abs() < 1e-10),
        "{found:?}"
    );
    // the start may be any element
    let from = ["--metric", "identity", "--from", "0,0,1", "--to", "1,0,0,0,1,0,0,0,1"];
    assert_near(lengths(&json(&[&["so3"][..], &from].concat()))[0], 1.0, 1e-12);
}

/// The entries of the rotation `exp(x)`, row by row, by the formula of Rodrigues.
fn rotation(x: [f64; 3]) -> [f64; 9] {
    let angle = x.iter().map(|x| x * x).sum::<f64>().sqrt();
    let n = x.map(|x| x / angle);
    let cross = [[0.0, -n[2], n[1]], [n[2], 0.0, -n[0]], [-n[1], n[0], 0.0]];
    std::array::from_fn(|at| {
        let (i, j) = (at / 3, at % 3);
        let unit = f64::from(u8::from(i == j));
        unit * angle.cos() + cross[i][j] * angle.sin() + n[i] * n[j] * (1.0 - angle.cos())
    })
}

/// A rigid body: the curve from the velocity that was found is computed again as a motion.
#[test]
fn a_metric_that_is_not_bi_invariant() {
    let report = json(&["so3", "--metric", "diag(1,2,3)", "--from", "0,0,0", "--to", "0.3,1,-0.5"]);
    let velocity = numbers(&report["geodesics"][0]["velocity"]);
    let folder = tempfile::tempdir().unwrap();
    let problem = format!(
        "space = 'so3'\nmetric = 'diag(1,2,3)'\ninitial.velocity = {velocity:?}\n\
         output = {{ end = 1, columns = ['g', 'energy'] }}\n"
    );
    std::fs::write(folder.path().join("body.toml"), problem).unwrap();
    let rows = run(folder.path(), &["simulate", "body.toml"], b"").out;
    let last: Vec<f64> =
        rows.lines().last().unwrap().split(',').map(|value| value.parse().unwrap()).collect();
    for (i, (value, entry)) in last[..9].iter().zip(rotation([0.3, 1.0, -0.5])).enumerate() {
        assert!((entry - value).abs() < 1e-9, "entry {i}: {value} is not {entry}");
    }
    assert_near(lengths(&report)[0], (2.0 * last[9]).sqrt(), 1e-10);
}

/// On the unit sphere as SO(n+1)/SO(n), the length is the angle between the points.
#[test]
fn spheres_as_homogeneous_spaces() {
    for (space, to, angle) in [("S^2", "0.3,0.4", 0.5), ("S^4", "1,0.5,-0.5,0.5", 1.75_f64.sqrt())]
    {
        let zeros = vec!["0"; to.split(',').count()].join(",");
        let report = json(&[space, "--metric", "identity", "--from", &zeros, "--to", to]);
        assert_near(lengths(&report)[0], angle, 1e-11);
    }
    // between points other than the origin: cos d = cos a cos b for orthogonal directions
    let report = json(&["S^2", "--metric", "identity", "--from", "0.7,0", "--to", "0,1.1"]);
    assert_near(lengths(&report)[0], (0.7_f64.cos() * 1.1_f64.cos()).acos(), 1e-11);
}

/// The connection of the report is the connection of the homogeneous space.
#[test]
fn the_default_connection_of_a_homogeneous_space() {
    let ends = ["S^2", "--from", "0,0", "--to", "0.3,0.4"];
    assert_eq!(json(&ends)["connection"], "natural");
    let text = outcome(&ends).out;
    assert!(text.contains("natural (lambda=1/2)") || text.contains("natural ("), "{text}");
    assert!(text.contains("by entries of the matrix"), "{text}");
    // numbers of any size are short
    let tiny = outcome(&["S^2", "--from", "0,0", "--to", "1e-50,1"]).out;
    assert!(tiny.contains("1e-50, 1"), "{tiny}");
}

/// Antipodal points of the sphere are conjugate.
#[test]
fn conjugate_points() {
    let report = json(&["sphere", "--set", "R=1", "--from", "pi/2,0", "--to", "pi/2,pi"]);
    assert_near(lengths(&report)[0], std::f64::consts::PI, 1e-12);
    assert_eq!(report["geodesics"][0]["conjugate"], true);
    let text = outcome(&["sphere", "--set", "R=1", "--from", "pi/2,0", "--to", "pi/2,pi"]).out;
    assert!(text.contains("conjugate"), "{text}");
}

/// On a product, the square of the length is the sum of the squares: of an angle on the sphere and a
/// distance on the line, or of two angles.
#[test]
fn products_of_spaces() {
    for (space, from, to, length) in [
        ("S^2+R^1", "0,0,0", "0.3,0.4,1.2", 1.3),
        ("S^2+so(3)", "0,0,0,0,0", "0.3,0.4,0,1.2,0", 1.3),
        ("SO(3)/SO(2)+S^3", "0,0,0,0,0", "0.3,0.4,0,1.2,0", 1.3),
    ] {
        let report = json(&[space, "--metric", "identity", "--from", from, "--to", to]);
        assert_near(lengths(&report)[0], length, 1e-11);
    }
    // the scalar curvatures add up: 2 of the sphere, and 3/2 of so(3), for unit metrics
    let table = ["table", "S^2+so(3)", "--metric", "identity", "--show", "scalar_curvature"];
    let table = run(root(), &table, b"").out;
    assert!(table.contains("7/2"), "{table}");
    let isometries = ["isometries", "S^2+R^1", "--metric", "identity", "--format", "json"];
    let report: Value = serde_json::from_str(&run(root(), &isometries, b"").out).unwrap();
    assert_eq!(report["dimension"], 4);
    let wrong = run(root(), &["info", "S^2+so(x)"], b"");
    assert!(wrong.err.contains("so(x)") && wrong.status != 0, "{}", wrong.err);
}

/// Coordinates from the identity are the logarithm of the end, however large its matrix is. Matrices
/// of points that are far from each other do not determine the way.
#[test]
fn points_far_apart() {
    let plane = ["H^2", "--metric", "summands(1)"];
    let report = json(&[&plane[..], &["--from", "0,0", "--to", "30,0"]].concat());
    assert_near(lengths(&report)[0], 30.0 * 2_f64.sqrt(), 1e-9);
    let apart = outcome(&[&plane[..], &["--from", "0,1", "--to", "40,0"]].concat());
    assert!(apart.err.contains("the end point is too far from the start"), "{}", apart.err);
}

#[test]
fn messages() {
    let sphere = |from: &str, to: &str| {
        let outcome = outcome(&["sphere", "--set", "R=1", "--from", from, "--to", to]);
        assert_ne!(outcome.status, 0);
        outcome.err
    };
    for (from, to, message) in [
        ("1", "1,1", "--from has 1 value, but a point has 2"),
        ("1,1", "1,1,1", "--to has 3 values, but a point has 2"),
        ("1,1", "1,1", "the end point is the start point"),
        ("theta=1,psi=1", "1,1", "`psi` is not a name"),
        ("theta=1,theta=1", "1,1", "theta is given twice"),
        ("theta=1,1", "1,1", "the value `1` has no name"),
        ("1,x", "1,1", "`x`"),
        ("0,0", "1,1", "the metric degenerates"),
        ("1,1", "4,1", "the end point is not in the chart"),
    ] {
        let found = sphere(from, to);
        assert!(found.contains(message), "{from} to {to}: {found}");
    }
    let missing = outcome(&["sphere", "--from", "1,1", "--to", "1,2"]);
    assert!(missing.err.contains("the equations need numbers for R"), "{}", missing.err);
    // in polar coordinates, no straight line goes around the origin by more than half a turn
    let apart = outcome(&["cone", "--set", "k=1", "--from", "1,0", "--to", "1,3.5"]);
    assert_eq!(apart.status, 1);
    assert!(apart.err.contains("no geodesic between the points was found"), "{}", apart.err);
}
