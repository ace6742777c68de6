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
    for chart in ["euler-angles", "gibbs-vector", "rotation-vector"] {
        let verify = ["verify", chart, "so3", "--connection", "lambda=1/3"];
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

/// Values at points: closed forms, zeros at multiples of pi, functions that are not given, and set parameters.
#[test]
fn values_at_a_point() {
    let temporary = TempDir::new().unwrap();
    let value = |name: &str, show: &str, more: &[&str]| -> Vec<(String, f64)> {
        let file = definition(name);
        let table = [&["table", &file, "--show", show, "--format", "csv"][..], more].concat();
        let outcome = run(temporary.path(), &table, b"");
        assert_eq!(outcome.status, 0, "{}", outcome.err);
        let row = |line: &str| {
            let (indices, value) = line.rsplit_once(',').unwrap();
            (indices.trim_matches(',').to_string(), value.parse().unwrap())
        };
        outcome.out.lines().skip(1).map(row).collect()
    };
    let near = |found: f64, expected: f64| (found - expected).abs() <= 1e-14 * expected.abs();
    let (m, r, theta) = (0.75_f64, 3.5_f64, 0.4_f64);
    let point = ["--at", "M=3/4,r=3.5", "--at", "theta=0.4"];
    let found = value("schwarzschild.toml", "kretschmann,metric,ricci", &point);
    let expected = [
        ("kretschmann", 48.0 * m * m / r.powi(6)),
        ("metric,1,1", 2.0 * m / r - 1.0),
        ("metric,2,2", 1.0 / (1.0 - 2.0 * m / r)),
        ("metric,3,3", r * r),
        ("metric,4,4", (r * theta.sin()).powi(2)),
    ];
    assert_eq!(found.len(), expected.len(), "{found:?}");
    for ((name, found), (expected, value)) in found.iter().zip(expected) {
        assert!(
            name == expected && near(*found, value),
            "{name} = {found}, not {expected} = {value}"
        );
    }
    // the same after some parameters are set
    let set = ["--set", "M=3/4", "--at", "r=3.5,theta=0.4"];
    assert_eq!(value("schwarzschild.toml", "kretschmann,metric,ricci", &set), found);
    // Lambda^theta_phiphi and Lambda^phi_thetaphi vanish at the equator
    let equator = value("sphere.toml", "affinities", &["--at", "theta=pi/2,a=2"]);
    assert!(equator.is_empty(), "{equator:?}");
    let universe = ["--at", "a(t)=2,a_t(t)=1/3,a_t_t(t)=-1,k=1/2"];
    let [(_, scalar)] = &value("expanding_universe.toml", "scalar_curvature", &universe)[..] else {
        panic!("one value")
    };
    assert!(near(*scalar, 6.0 * (-2.0 + 1.0 / 9.0 + 0.5) / 4.0), "{scalar}");
    let so3 = [
        "table",
        "so3",
        "--metric",
        "diag(a,a,a)",
        "--show",
        "scalar_curvature",
        "--format",
        "csv",
        "--at",
        "a=0.3",
    ];
    let outcome = run(temporary.path(), &so3, b"");
    let scalar: f64 = outcome.out.trim().rsplit(',').next().unwrap().parse().unwrap();
    assert!(near(scalar, 1.5 / 0.3), "{scalar}");
}

/// The point is in the head of every format, and in JSON under its own key.
#[test]
fn a_table_names_its_point() {
    let temporary = TempDir::new().unwrap();
    let table = |format| {
        let sphere = definition("sphere.toml");
        let arguments =
            ["table", &sphere, "--at", "theta=1,a=1/2", "--show", "ricci", "--format", format];
        run(temporary.path(), &arguments, b"").out
    };
    for format in ["text", "markdown", "latex", "html"] {
        assert!(table(format).contains("theta = 1, a = 0.5"), "{}", table(format));
    }
    let json: serde_json::Value = serde_json::from_str(&table("json")).unwrap();
    assert_eq!(json["point"], serde_json::json!({"theta": 1.0, "a": 0.5}));
    assert_eq!(json["scalar"], "float");
    // and is read back
    std::fs::write(temporary.path().join("sphere.json"), table("json")).unwrap();
    let verify = ["verify", &definition("sphere.toml"), "sphere.json"];
    let outcome = run(temporary.path(), &verify, b"");
    assert_eq!(outcome.status, 1, "{}{}", outcome.out, outcome.err);
}

#[test]
fn points_that_are_refused() {
    let temporary = TempDir::new().unwrap();
    let schwarzschild = definition("schwarzschild.toml");
    for (arguments, status, says) in [
        (&["--at", "r=2,M=1,theta=1"][..], 1, "at r = 2, M = 1, theta = 1: division by zero"),
        (&["--at", "r=2,theta=1"], 2, "depends on M, which has no value"),
        (&["--at", "q=2"], 2, "`q` is not a parameter here"),
        (&["--at", "r"], 2, "a value of a point is name=value"),
        (&["--at", "r=x"], 2, "`x` is not a finite number"),
        (&["--at", "r=1e400"], 2, "is not a finite number"),
        (&["--at", "r=1/0"], 2, "zero"),
        (&["--at", "r=1", "--at", "r=1"], 2, "r is given twice"),
        (&["--at", "2*r=1"], 2, "`2*r` is not a coordinate, a parameter or a function"),
        (&["--at", "sin(r)=1"], 2, "`sin(r)` is not a coordinate, a parameter or a function"),
        (&["--set", "M=1", "--at", "M=1"], 2, "M has the value 1 already"),
        (&["--at", "r=1", "--code", "c"], 2, "--at"),
    ] {
        let table = [&["table", &schwarzschild][..], arguments].concat();
        let outcome = run(temporary.path(), &table, b"");
        assert_eq!(outcome.status, status, "{arguments:?} {}", outcome.err);
        assert!(outcome.err.contains(says), "{arguments:?} {}", outcome.err);
        assert_eq!(outcome.out, "");
    }
    let root = "metric = 'diag(log(x), sqrt(y))'\nchart.coordinates = ['x', 'y']\nchart.positive = ['x', 'y']";
    for (point, says) in [("x=-2,y=1", "log(-2)"), ("x=2,y=-3", "sqrt(-3)"), ("x=0,y=1", "log(0)")]
    {
        let table = ["table", "-", "--show", "metric", "--at", point];
        let outcome = run(temporary.path(), &table, root.as_bytes());
        assert_eq!(outcome.status, 1, "{point} {}{}", outcome.out, outcome.err);
        assert!(outcome.err.contains(says), "{point} {}", outcome.err);
    }
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
        ("chart.coordinates = ['x']", 1, "the connection levi-civita needs a metric"),
    ] {
        let outcome =
            run(temporary.path(), &["check", "-", "--format", "json"], definition.as_bytes());
        assert_eq!(outcome.status, status, "{}{}", outcome.out, outcome.err);
        assert!(outcome.out.contains(says), "{}", outcome.out);
    }
}
