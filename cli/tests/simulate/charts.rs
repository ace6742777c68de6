//! Curves on charts: formats, rows of a curve that ends early, messages and plots.

use super::{done, folder, refused, simulate};
use crate::program;
use std::fs;
use std::process::Command;

const SPHERE: &str = r#"
embedding = ["sin(theta)*cos(phi)", "sin(theta)*sin(phi)"]
[definition]
chart = { coordinates = ["theta", "phi"] }
metric = [1, "sin(theta)^2"]
[initial]
position = { theta = "pi/2", phi = 0 }
velocity = { phi = "w" }
normalize = "unit"
root = "smaller"
[parameters]
w = 0.8
[output]
end = 4
every = 1
[ensemble]
grid = { w = "0.1, 0.5" }
"#;

/// CSV and JSON have the same numbers.
#[test]
fn formats_have_the_same_rows() {
    let folder = folder(SPHERE);
    let folder = folder.path();
    let csv = done(&mut simulate(folder));
    let json = done(simulate(folder).args(["--format", "json"]));
    let json: serde_json::Value = serde_json::from_slice(&json.stdout).unwrap();
    let csv = String::from_utf8(csv.stdout).unwrap();
    let mut lines = csv.lines();
    let header: Vec<&str> = lines.next().unwrap().split(',').collect();
    assert_eq!(header, ["s", "theta", "phi", "v_theta", "v_phi", "norm", "length", "p_phi"]);
    let names: Vec<&str> =
        json["columns"].as_array().unwrap().iter().map(|name| name.as_str().unwrap()).collect();
    assert_eq!(names, header);
    let rows = json["rows"].as_array().unwrap();
    assert_eq!(rows.len(), 5);
    for (line, row) in lines.zip(rows) {
        let numbers: Vec<f64> = line.split(',').map(|number| number.parse().unwrap()).collect();
        let row: Vec<f64> =
            row.as_array().unwrap().iter().map(|number| number.as_f64().unwrap()).collect();
        assert_eq!(numbers, row);
    }
}

#[test]
fn the_summary_and_the_notes_are_printed() {
    let folder = folder(SPHERE);
    let output = done(&mut simulate(folder.path()));
    let messages = String::from_utf8(output.stderr).unwrap();
    for part in [
        "note: v_theta = -0.99498743710662 is the smaller root of g(v, v) = 1; the other root is 0.99498743710662",
        "note: method dop853: a curve on a chart, or bodies in joint coordinates, to a tolerance",
        "p_phi",
        "norm",
    ] {
        assert!(messages.contains(part), "{part}: {messages}");
    }
    let all = done(simulate(folder.path()).arg("--ensemble"));
    let all = String::from_utf8(all.stdout).unwrap();
    assert!(all.starts_with("member,w,s,theta,phi,"), "{all}");
    assert_eq!(all.lines().count(), 11);
}

/// The rows up to the edge of the chart are written to a separate file.
#[test]
fn a_curve_that_leaves_its_chart_has_its_rows() {
    let folder = folder(
        &SPHERE
            .replace("{ phi = \"w\" }", "{ theta = 1, phi = 0 }")
            .replace("root = \"smaller\"", ""),
    );
    let folder = folder.path();
    let message = refused(simulate(folder).args(["-o", "rows.csv"]), 1);
    for part in [
        "the curve ends at the parameter 1.57079",
        "the metric degenerates where sin(theta) = 0",
        "theta = 3.14159",
        "2 rows",
    ] {
        assert!(message.contains(part), "{part}: {message}");
    }
    let rows = fs::read_to_string(folder.join("rows.partial.csv")).unwrap();
    assert_eq!(rows.lines().count(), 3);
}

#[test]
fn curves_are_drawn() {
    let folder = folder(SPHERE);
    for (kind, columns, label) in [
        ("phase", "embedding", "X2"),
        ("phase", "theta,phi", "phi"),
        ("series", "velocity,p_phi", "parameter s"),
        ("series", "momentum", "p_theta"),
    ] {
        let mut command = Command::new(program::path());
        command.current_dir(folder.path());
        command.args(["plot", kind, "top.toml", "--columns", columns]);
        let picture = String::from_utf8(done(&mut command).stdout).unwrap();
        assert!(picture.contains("<svg") && picture.contains(label), "{kind} {columns}");
    }
    let mut command = Command::new(program::path());
    command.current_dir(folder.path()).args(["plot", "drift", "top.toml"]);
    assert!(String::from_utf8(done(&mut command).stdout).unwrap().contains("p_phi"));
}
