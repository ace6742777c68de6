//! The text above the components: conventions, tolerance and brackets; and witnesses of metrics.

use crate::program::{root, run, stdout};
use serde_json::{Value, json};
use tempfile::TempDir;

/// The witnesses of a metric that fails.
#[test]
fn certificates_of_metrics_have_witnesses() {
    for (metric, indices, residual) in [
        ("[[1,2,0],[0,1,0],[0,0,1]]", json!([1, 2]), json!([[0, "2"]])),
        ("[[1,1,0],[1,1,0],[0,0,1]]", json!([]), json!([[1, "-1"], [2, "1"]])),
    ] {
        let check = ["check", "so3", "--metric", metric, "--format", "json"];
        let outcome = run(root(), &check, b"");
        assert_eq!(outcome.status, 1, "{}", outcome.err);
        let certificate: Value = serde_json::from_str(&outcome.out).unwrap();
        let last = certificate["checks"].as_array().unwrap().last().unwrap();
        assert_eq!(last["name"], "metric");
        assert_eq!(last["witness"], json!({ "indices": indices, "residual": residual }));
    }
}

/// Comparisons and certificates begin with the conventions, and in floats with the tolerance.
#[test]
fn heads_state_conventions_and_tolerance() {
    let bracket = "[e_j, e_k] = c^i_jk e_i";
    let verified = TempDir::new().unwrap();
    let table = ["table", "so3@zero", "--show", "ricci", "--format", "csv", "-o", "a.csv"];
    assert_eq!(run(verified.path(), &table, b"").status, 0);
    for command in [&["compare", "so3", "sl2"][..], &["check", "so3"], &["verify", "SO3", "a.csv"]]
    {
        for format in ["text", "markdown", "latex", "csv", "json"] {
            let print = |scalar: &str| {
                let options = ["--scalar", scalar, "--format", format];
                stdout(verified.path(), &[command, &options[..]].concat())
            };
            if (command[0], format) == ("verify", "text") {
                continue; // a single line
            }
            let (exact, float) = (print("exact"), print("float"));
            let formula = match format {
                "markdown" => r"\[e\_j, e\_k\] = c\^i\_jk e\_i",
                "latex" => "$[e_{j}, e_{k}] = c^{i}{}_{jk} e_{i}$",
                _ => bracket,
            };
            assert!(exact.contains(formula), "{command:?} {format}: {exact}");
            assert!(!exact.contains("1.421e-14"), "{command:?} {format}: {exact}");
            assert!(float.contains("1.421e-14"), "{command:?} {format}: {float}");
        }
    }
}

#[test]
fn markdown_and_latex_show_the_brackets() {
    let table = |format: &str| {
        stdout(root(), &["table", "aff1@plus", "--show", "structure", "--format", format])
    };
    assert!(table("markdown").contains("- `[x, y] = y`\n"), "{}", table("markdown"));
    assert!(table("latex").contains("$[x, y] = y$\\par\n"), "{}", table("latex"));
}
