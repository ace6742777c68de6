//! `affinor solve`: values of letters in every format, and invalid input.

use crate::program::{root, run, stdout};
use serde_json::{Value, json};

fn solve(arguments: &[&str]) -> Value {
    let all = [&["solve"], arguments, &["--format", "json"]].concat();
    serde_json::from_str(&stdout(root(), &all)).unwrap()
}

/// The values of each point.
fn points(report: &Value) -> Vec<String> {
    let points = report["points"].as_array().unwrap().iter();
    let text = |point: &Value| {
        let values = point["values"].as_array().unwrap().iter();
        let values = values
            .map(|v| format!("{}={}", v["letter"].as_str().unwrap(), v["value"].as_str().unwrap()));
        values.collect::<Vec<_>>().join(" ")
    };
    points.map(text).collect()
}

#[test]
fn the_round_sphere_is_the_only_einstein_metric() {
    let report = solve(&["so3", "--metric", "diag(a,b,c)", "--for", "einstein"]);
    assert_eq!(report["schema"], "affinor.solve/1");
    assert_eq!((&report["complete"], &report["families"]), (&json!(true), &json!([])));
    assert_eq!(points(&report), ["a=1 b=1 c=1"]);
    assert_eq!(report["points"][0]["signature"], json!([3, 0]));
    assert_eq!(report["points"][0]["constant"]["value"], "1/2");
    assert_eq!(report["scaled"], json!(["a", "b", "c"]));
    assert_eq!(report["equations"][0], "(a - b)*(a + b - c)");
}

#[test]
fn families_and_their_samples() {
    let report = solve(&["se2", "--metric", "diag(a,b,c)", "--for", "flat"]);
    assert_eq!(report["families"][0]["equations"], json!(["b - c"]));
    assert_eq!(report["families"][0]["free"], json!(["a", "c"]));
    assert_eq!(report["families"][0]["sample"]["definite"], true);
    let report = solve(&["heisenberg(3)", "--metric", "diag(a,b,c)", "--for", "einstein"]);
    assert_eq!((&report["points"], &report["families"]), (&json!([]), &json!([])));
    assert_eq!(report["equations"], json!(["1"]));
}

#[test]
fn irrational_values_have_a_polynomial_and_an_interval() {
    let report = solve(&["so3", "--metric", "diag(1,p^3-1,q^2-1)", "--for", "einstein"]);
    assert_eq!(points(&report).len(), 2);
    let values = &report["points"][0]["values"];
    assert_eq!(values[0]["polynomial"], json!(["-2", "0", "0", "1"]));
    assert_eq!(
        (&values[0]["decimal"], &values[1]["value"]),
        (&json!("1.25992104989"), &json!("-sqrt(2)"))
    );
    let text =
        stdout(root(), &["solve", "so3", "--metric", "diag(1,p^3-1,q^2-1)", "--for", "einstein"]);
    assert!(text.contains("p = 1.25992104989..., p^3 - 2 = 0"), "{text}");
}

#[test]
fn every_format_is_written() {
    for format in ["text", "markdown", "latex", "html", "csv", "json"] {
        for metric in ["diag(a,b,c)", "[[a,d,0],[d,b,0],[0,0,c]]", "diag(1,p^3-1,q^2-1)"] {
            let arguments = [
                "solve",
                "so3",
                "--metric",
                metric,
                "--for",
                "locally-symmetric",
                "--format",
                format,
            ];
            let text = stdout(root(), &arguments);
            assert!(!text.is_empty());
            let widest = text.lines().map(|line| line.chars().count()).max();
            assert!(format != "text" || widest <= Some(80), "{text}");
        }
    }
}

#[test]
fn invalid_input() {
    let refused = |arguments: &[&str], message: &str, status| {
        let outcome = run(root(), &[&["solve"], arguments].concat(), b"");
        assert_eq!(outcome.status, status, "{}", outcome.err);
        assert!(outcome.err.contains(message), "{}", outcome.err);
    };
    refused(&["so3", "--metric", "identity", "--for", "einstein"], "nothing to solve for", 1);
    refused(&["so3", "--metric", "diag(a,b,c)", "--for", "einstien"], "'einstein'", 2);
    refused(&["so3", "--metric", "diag(a,b,c)"], "--for", 2);
    refused(&["so3@plus", "--for", "einstein"], "metric", 1);
    refused(&["so3", "--metric", "diag(a,b,sqrt(2))", "--for", "flat"], "square roots", 1);
    refused(&["examples/definitions/schwarzschild.toml", "--for", "einstein"], "chart", 1);
    refused(&["so3", "--metric", "diag(a,b,c)", "--for", "flat", "--set", "d=1"], "d", 2);
}

/// The properties name the values for which they would hold.
#[test]
fn properties_with_letters_say_when_they_hold() {
    let arguments = ["properties", "so3", "--metric", "diag(a,a,b)", "--format", "json"];
    let report: Value = serde_json::from_str(&stdout(root(), &arguments)).unwrap();
    let property = |name: &str| {
        let all = report["properties"].as_array().unwrap();
        all.iter().find(|entry| entry["name"] == name).unwrap()["only_if"].clone()
    };
    assert_eq!(property("Einstein (Ric = c g)"), json!(["b = a"]));
    assert_eq!(property("bi-invariant metric"), json!(["b = a"]));
    assert_eq!(property("flat"), json!([]));
    assert_eq!(property("torsion-free"), Value::Null);
    let text = stdout(root(), &arguments[..4]);
    assert!(text.contains("only if b = a") && text.contains("for no real values"), "{text}");
    // without letters nothing changes
    let text = stdout(root(), &["properties", "so3", "--metric", "diag(1,1,2)"]);
    assert!(!text.contains("only if"), "{text}");
}
