//! Tables and certificates in floats, as the program prints them: no noise where theory has zero.
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

#[path = "common/program.rs"]
mod program;

use program::{run, stdout};
use std::path::Path;

const METRIC: &str = "[[0.1,1/3,2],[1/3,1/3,2],[2,2,0]]";

fn table(space: &str, metric: &str, scalar: &str, show: &str) -> String {
    stdout(
        Path::new("."),
        &[
            "table", space, "--metric", metric, "--scalar", scalar, "--show", show, "--format",
            "csv",
        ],
    )
}

/// The rows of a CSV table without their values.
fn places(csv: &str) -> Vec<&str> {
    csv.lines().map(|line| line.rsplit_once(',').unwrap().0).collect()
}

#[test]
fn what_vanishes_by_dimension_or_theory_is_not_listed() {
    let zero = "torsion,nonmetricity,ricci_antisymmetric,weyl,nabla_torsion";
    for metric in [METRIC, "diag(0.1,0.7,1.3)", "[[1e-3,1e-2,0],[1e-2,0.7,0.1],[0,0.1,1e3]]"] {
        for space in ["sl2", "so3", "se2", "bianchi(VI,h=-1/3)"] {
            let csv = table(space, metric, "float", zero);
            assert_eq!(csv, "tensor,i,j,k,l,value\n", "{space} {metric}");
        }
    }
}

#[test]
fn float_tables_list_what_exact_ones_do() {
    for space in ["sl2", "so3", "heisenberg(3)", "bianchi(VI,h=-1/3)", "bianchi(IX)"] {
        for metric in [METRIC, "[[2,0.3,0],[0.3,1/7,0],[0,0,-1]]", "killing"] {
            if metric == "killing" && !["sl2", "so3"].contains(&space) {
                continue;
            }
            let [exact, float] =
                ["exact", "float"].map(|scalar| table(space, metric, scalar, "all"));
            assert_eq!(places(&float), places(&exact), "{space} {metric}");
        }
    }
}

#[test]
fn certificates_hold_in_floats() {
    for space in ["sl2", "so3", "se3", "so(3,1)", "heisenberg(5)", "A2"] {
        let n: usize = match space {
            "se3" | "so(3,1)" => 6,
            "heisenberg(5)" => 5,
            "A2" => 8,
            _ => 3,
        };
        let rows = (0..n).map(|i| {
            let entry = |j: usize| match i.abs_diff(j) {
                0 => format!("{}/3", i + 1),
                1 => "0.1".to_string(),
                _ => "0".to_string(),
            };
            format!("[{}]", (0..n).map(entry).collect::<Vec<_>>().join(","))
        });
        let metric = format!("[{}]", rows.collect::<Vec<_>>().join(","));
        let arguments = ["check", space, "--metric", &metric, "--scalar", "float"];
        let outcome = run(Path::new("."), &arguments, b"");
        assert_eq!(outcome.status, 0, "{space}: {}{}", outcome.out, outcome.err);
    }
}
