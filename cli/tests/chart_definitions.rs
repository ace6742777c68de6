//! Definition files over charts, through the program: formats, values and checks.

use crate::program::{definition, run};
use tempfile::TempDir;

/// The rotation group in several charts agrees with its brackets.
#[test]
fn charts_of_the_rotation_group_are_so3() {
    let temporary = TempDir::new().unwrap();
    let show = "structure,affinities,torsion,curvature,ricci,killing";
    let so3 = ["so3", "--connection", "lambda=1/3"];
    let table = [&["table"], &so3[..], &["--show", show, "--format", "csv", "-o", "so3"]].concat();
    assert_eq!(run(temporary.path(), &table, b"").status, 0);
    for chart in ["euler_angles.toml", "gibbs_vector.toml", "rotation_vector.toml"] {
        let verify = ["verify", &definition(chart), "so3", "--connection", "lambda=1/3"];
        let outcome = run(temporary.path(), &verify, b"");
        assert_eq!(outcome.status, 0, "{chart}: {}", outcome.out);
    }
}

#[test]
fn functions_are_written_in_every_format() {
    let temporary = TempDir::new().unwrap();
    let table = |format| {
        let sphere = definition("sphere.toml");
        let show = "affinities,metric,killing";
        run(temporary.path(), &["table", &sphere, "--format", format, "--show", show], b"").out
    };
    let latex = table("latex");
    assert!(latex.contains(r"&= -\sin \theta \cos \theta"), "{latex}");
    assert!(latex.contains(r"= \frac{\cos \theta}{\sin \theta}"), "{latex}");
    assert!(latex.contains(r"&= a^{2} \sin^{2} \theta"), "{latex}");
    let markdown = table("markdown");
    assert!(markdown.contains("| `Lambda^1_22` | `-sin(theta)*cos(theta)` |"), "{markdown}");
    assert!(markdown.contains("- coordinates: theta, phi"), "{markdown}");
    // coordinate fields commute, so they define an algebra, and its Killing form is zero
    assert!(table("text").contains("K_ij = 0"));
    let half_plane = definition("hyperbolic_plane.toml");
    let text = run(temporary.path(), &["table", &half_plane, "--show", "structure"], b"").out;
    assert!(text.contains("fields       e1 = y*d_x, e2 = y*d_y"), "{text}");
    assert!(text.contains("Structure functions: 2 nonzero components"), "{text}");
}

#[test]
fn values_and_checks() {
    let temporary = TempDir::new().unwrap();
    let sphere = definition("sphere.toml");
    let show = ["--show", "scalar_curvature", "--format", "csv"];
    for (more, scalar) in [
        (vec!["--set", "a=2"], "1/2"),
        (vec!["--metric", "diag(1, cos(phi)^2)"], "0"),
        (vec!["--metric", "diag(exp(2*theta), exp(2*theta))"], "0"),
    ] {
        let arguments = [&["table", &sphere][..], &show, &more].concat();
        let outcome = run(temporary.path(), &arguments, b"");
        let expected =
            if scalar == "0" { String::new() } else { format!("scalar_curvature,,,,,{scalar}\n") };
        assert_eq!(outcome.out, format!("tensor,i,j,k,l,value\n{expected}"), "{}", outcome.err);
    }
    for (definition, status, says) in [
        (
            "metric = 'diag(1, x)'\nchart.coordinates = ['x', 'y']",
            0,
            "symmetric and non-degenerate",
        ),
        ("metric = 'diag(1, 0)'\nchart.coordinates = ['x', 'y']", 1, "d_y is orthogonal to every"),
        (
            "chart.coordinates = ['x']\nframe.u = '(cosh(x)^2 - sinh(x)^2 - 1)*d_x'",
            1,
            "determinant",
        ),
        ("chart.coordinates = ['x']", 1, "levi-civita is the connection of a metric"),
    ] {
        let outcome =
            run(temporary.path(), &["check", "-", "--format", "json"], definition.as_bytes());
        assert_eq!(outcome.status, status, "{}{}", outcome.out, outcome.err);
        assert!(outcome.out.contains(says), "{}", outcome.out);
    }
}
