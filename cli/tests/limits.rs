//! Expressions that exceed the size limit are errors. The message names the limit, the location and
//! the remedy.

use crate::program::run;
use std::path::Path;

/// A full symmetric matrix of symbols.
fn full(n: usize) -> String {
    let row = |i: usize| -> String {
        let entry = |j: usize| format!("g{}{}", i.min(j) + 1, i.max(j) + 1);
        format!("[{}]", (0..n).map(entry).collect::<Vec<_>>().join(","))
    };
    format!("[{}]", (0..n).map(row).collect::<Vec<_>>().join(","))
}

#[test]
fn a_passed_limit_names_itself() {
    let metric = full(6);
    let mut messages = Vec::new();
    for threads in ["1", "2"] {
        let table =
            ["table", "se3", "--metric", &metric, "--show", "curvature", "--threads", threads];
        let outcome = run(Path::new("."), &[&table[..], &["--max-terms", "20000"]].concat(), b"");
        assert_eq!(outcome.status, 1, "{}", outcome.err);
        assert!(outcome.out.is_empty());
        for part in
            ["limit of 20000 terms", "`curvature`", "--max-terms 80000", "--code c", "--set"]
        {
            assert!(outcome.err.contains(part), "{part}: {}", outcome.err);
        }
        messages.push(outcome.err);
    }
    assert_eq!(messages[0], messages[1]);
}

#[test]
fn a_chart_is_limited_too() {
    let folder = tempfile::TempDir::new().unwrap();
    let chart = "[chart]\ncoordinates = [\"x\", \"y\"]\n[metric]\ncomponents = [[\"a + cos(x)^2\", \
                 \"sin(x)*cos(y)\"], [\"sin(x)*cos(y)\", \"2 + sin(y)\"]]\n";
    std::fs::write(folder.path().join("chart.toml"), format!("parameters = [\"a\"]\n{chart}"))
        .unwrap();
    let table = ["table", "chart.toml", "--show", "nabla_curvature", "--max-terms", "2000"];
    let outcome = run(folder.path(), &table, b"");
    assert_eq!(outcome.status, 1, "{}", outcome.err);
    assert!(outcome.err.contains("limit of 2000 terms"), "{}", outcome.err);
}

/// If a limit is exceeded while formulas are prepared for the output, nothing is written, and an
/// existing file is unchanged.
#[test]
fn a_limit_in_the_output() {
    let folder = tempfile::TempDir::new().unwrap();
    let chart = "metric = \"diag(1/(x^2+1), 1, -1)\"\n[chart]\ncoordinates = [\"x\", \"y\", \"z\"]\n[frame]\n\
                 e1 = \"x*d_z\"\ne2 = \"z*d_x + sin(z)*d_y\"\ne3 = \"cosh(y)*d_x\"\n";
    std::fs::write(folder.path().join("chart.toml"), chart).unwrap();
    let kept = folder.path().join("kept");
    for limit in ["2000", "10000"] {
        for format in ["text", "markdown", "latex", "csv", "json", "html"] {
            let show = "ricci,scalar_curvature";
            let table =
                ["table", "chart.toml", "--show", show, "--format", format, "--max-terms", limit];
            let outcome = run(folder.path(), &table, b"");
            assert_eq!((outcome.status, outcome.out.as_str()), (1, ""), "{format}");
            assert!(outcome.err.contains("in the stage `output`"), "{format}: {}", outcome.err);
            std::fs::write(&kept, "kept").unwrap();
            let outcome = run(folder.path(), &[&table[..], &["-o", "kept"]].concat(), b"");
            assert_eq!(outcome.status, 1, "{format}: {}", outcome.err);
            assert_eq!(std::fs::read_to_string(&kept).unwrap(), "kept", "{format}");
        }
    }
}

#[test]
fn a_limit_is_a_positive_number() {
    for limit in ["0", "-1", "many", "1.5"] {
        let outcome = run(Path::new("."), &["table", "so3", &format!("--max-terms={limit}")], b"");
        assert_eq!(outcome.status, 2, "{limit}: {}", outcome.err);
    }
    let least = run(Path::new("."), &["table", "so3", "--max-terms", "1"], b"");
    assert_eq!(least.status, 0, "numbers are not formulas: {}", least.err);
}
