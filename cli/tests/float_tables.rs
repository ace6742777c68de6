//! Printed tables and certificates in floats: components that are zero in theory show no rounding
//! errors.

use crate::program::{run, stdout};
use std::path::Path;

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

/// The inverse of a metric is accurate whatever the units of the basis vectors.
#[test]
fn metrics_of_many_scales() {
    for (space, metric) in [
        ("aff1", "[[1,2],[2,1e15]]"),
        ("aff1", "[[1e15,2],[2,1]]"),
        ("aff1", "[[1,2],[2,-1e15]]"),
        ("so3", "[[1,1,1],[1,2,1e9],[1,1e9,1e34]]"),
        ("sl2", "[[1e-20,1e-8,3],[1e-8,5e4,1e9],[3,1e9,1e22]]"),
        ("heisenberg(3)", "[[0,1e9,1],[1e9,3,1e-9],[1,1e-9,1e-15]]"),
    ] {
        let [exact, float] =
            ["exact", "float"].map(|scalar| table(space, metric, scalar, "inverse_metric,ricci"));
        assert_eq!(places(&float), places(&exact), "{space} {metric}");
        for (exact, float) in exact.lines().zip(float.lines()).skip(1) {
            let value = |line: &str| -> f64 {
                let text = line.rsplit(',').next().unwrap();
                let (above, below) = text.split_once('/').unwrap_or((text, "1"));
                above.parse::<f64>().unwrap() / below.parse::<f64>().unwrap()
            };
            let [exact, float] = [value(exact), value(float)];
            assert!((float / exact - 1.0).abs() < 1e-7, "{space} {metric}: {float} {exact}");
        }
    }
}

/// A component below the tolerance can cancel a component above it.
#[test]
fn certificates_hold_over_many_scales() {
    for exponent in 0..=9 {
        for digit in [1, 3] {
            let metric = format!("diag(1,1,1,1,1,1,{digit}e-{exponent},1)");
            let arguments = ["check", "sl(3)", "--connection", "levi-civita", "--metric", &metric];
            let outcome =
                run(Path::new("."), &[&arguments[..], &["--scalar", "float"]].concat(), b"");
            assert_eq!(outcome.status, 0, "{metric}: {}", outcome.out);
        }
    }
}

/// The output of `table - --scalar float` for affinities without brackets.
fn of_affinities(dimension: usize, affinities: &str, options: &[&str]) -> String {
    let file = format!(
        "dimension = {dimension}\nbrackets = \"\"\naffinities = \"\"\"\n{affinities}\"\"\"\n"
    );
    let arguments = [&["table", "-", "--scalar", "float", "--format", "csv"], options].concat();
    let outcome = run(Path::new("."), &arguments, file.as_bytes());
    assert_eq!(outcome.status, 0, "{}", outcome.err);
    outcome.out
}

/// `R^1_413 = 1e16 - 1e16 + 1` is not shown, but cancels `R^2_423 = -1` in the Ricci tensor.
#[test]
fn a_component_that_is_not_shown_enters_the_next_sum() {
    let affinities = "nabla[e1, e5] = 100000000*e1\n\
                      nabla[e3, e4] = 100000000*e5 - 100000000*e6 + e7 - e8\n\
                      nabla[e1, e6] = 100000000*e1\n\
                      nabla[e1, e7] = e1\n\
                      nabla[e2, e8] = e2\n";
    let csv = of_affinities(8, affinities, &["--show", "curvature,ricci"]);
    assert!(csv.contains("\ncurvature,2,4,2,3,-1\n"), "{csv}");
    assert!(!csv.contains("\ncurvature,1,4,1,3,"), "{csv}");
    assert!(!csv.contains("\nricci,4,3,"), "{csv}");
}

/// The tolerance holds in all stages: here `R^1_212 = 1e-15` is a sum of terms of size 1.
#[test]
fn a_smaller_tolerance_is_kept_to() {
    let affinities = "nabla[e1, e1] = e1\n\
                      nabla[e2, e2] = e1\n\
                      nabla[e2, e1] = e1\n\
                      nabla[e1, e2] = (1 - 1e-15)*e1\n";
    let show = ["--show", "torsion,curvature"];
    let shown = |tolerance: &[&str]| {
        let csv = of_affinities(2, affinities, &[&show[..], tolerance].concat());
        csv.lines().map(|line| line.split(',').next().unwrap().to_string()).collect::<Vec<_>>()
    };
    assert_eq!(shown(&[]), ["tensor"]);
    let all = ["tensor", "torsion", "torsion", "curvature", "curvature"];
    assert_eq!(shown(&["--tolerance", "1e-17"]), all);
}

/// An ill-conditioned metric, for which `f64` has no correct digit of these components. Rounding
/// errors are kept for later sums, and subtracted from the output.
#[test]
fn rounding_is_corrected_in_ill_conditioned_metrics() {
    let metric = "[[-18,-1/3,37/7,38/3,10/3],[-1/3,14/9,-2/3,-23/9,-7/9],[37/7,-2/3,-58/49,-443/189,-13/21],\
                  [38/3,-23/9,-443/189,-319/81,-2/3],[10/3,-7/9,-13/21,-2/3,2/3]]";
    let show = "scalar_curvature,kretschmann";
    let [exact, float] = ["exact", "float"].map(|scalar| {
        let csv = table("heisenberg(5)", metric, scalar, show);
        let values = csv.lines().skip(1).map(|line| line.rsplit_once(',').unwrap().1);
        let value =
            |text: &str| text.split('/').map(|n| n.parse::<f64>().unwrap()).reduce(|a, b| a / b);
        values.map(|text| value(text).unwrap()).collect::<Vec<_>>()
    });
    for (at, bound) in [1e-11, 1e-2].into_iter().enumerate() {
        assert!((float[at] - exact[at]).abs() <= bound * exact[at].abs(), "{exact:?} {float:?}");
    }
}
