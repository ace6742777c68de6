//! Options that make no sense, or that the mathematics refuses.

use crate::bad_input::case::{Case, Commands, MATHEMATICS, USAGE, refuse, refuse_commands};

#[test]
fn arguments() {
    refuse_commands(&[
        (&["tabel"], USAGE, &["tabel", "table"]),
        (&["table"], USAGE, &["no SPACE is given", "--basis and --bracket"]),
        (&["table", "so3", "so3"], USAGE, &["so3"]),
        (&["table", "so3", "--matric", "identity"], USAGE, &["--matric", "--metric"]),
        (&["compare", "so3"], USAGE, &["compare takes two spaces, or none"]),
        (&["compare", "so3", "so3", "so3"], USAGE, &["so3"]),
        (&["verify"], USAGE, &["SPACE"]),
        (&["compare", "M3", "SO3", "--metric", "identity"], USAGE, &["--metric"]),
        (&["equations"], USAGE, &["no SPACE is given"]),
        (&["equations", "so3"], USAGE, &["need a metric", "--motion"]),
        (&["equations", "so3", "--motion", "up"], USAGE, &["euler-poincare, autoparallel, transp"]),
        (&["equations", "so3", "--code", "java"], USAGE, &["java", "rust, c, python"]),
        (&["equations", "M3", "--code", "c", "--solved"], USAGE, &["--solved"]),
        (&["equations", "so3", "--metric", "diag(1,1,0)"], MATHEMATICS, &["degenerate", "e3"]),
        (&["list", "xyzzy"], USAGE, &["`xyzzy`", "`affinor list` shows all"]),
        (&["completions", "cmd"], USAGE, &["cmd", "bash"]),
        (&["completions"], USAGE, &["SHELL"]),
    ]);
}

#[test]
fn values() {
    refuse_commands(&[
        (
            &["table", "so3", "--show", "curvatures"],
            USAGE,
            &["`curvatures` is not one of structure, affinities"],
        ),
        (&["table", "so3", "--show", "ricci,,torsion"], USAGE, &["`` is not one of"]),
        (&["table", "so3", "--format", "xml"], USAGE, &["xml", "text, markdown, latex, csv, json"]),
        (&["table", "so3", "--color", "red"], USAGE, &["red", "auto, always, never"]),
        (&["table", "so3", "--scalar", "double"], USAGE, &["double", "exact, float"]),
        (&["table", "so3", "--frame", "up"], USAGE, &["up", "left, right"]),
        (&["table", "so3", "--threads", "0"], USAGE, &["--threads 0 is not between 1 and 1024"]),
        (&["table", "so3", "--threads", "-1"], USAGE, &["--threads -1 is not"]),
        (&["table", "so3", "--threads", "1000000"], USAGE, &["--threads 1000000 is not"]),
        (&["table", "so3", "--threads", "two"], USAGE, &["two"]),
        (&["table", "so3", "--tolerance", "-1"], USAGE, &["--tolerance -1 is not in"]),
        (&["table", "so3", "--tolerance", "2"], USAGE, &["--tolerance 2 is not in"]),
        (&["table", "so3", "--tolerance", "NaN"], USAGE, &["--tolerance NaN is not in"]),
        (&["table", "so3", "--tolerance", "inf"], USAGE, &["--tolerance inf is not in"]),
        (&["table", "so3", "--tolerance", "small"], USAGE, &["small"]),
        (
            &["table", "so3", "--connection", "left"],
            USAGE,
            &["--connection:1:1", "`left` is not a connection"],
        ),
        (
            &["table", "so3", "--connection", "lambda=1/0"],
            USAGE,
            &["--connection:1:10", "division by zero"],
        ),
        (
            &["table", "so3", "--connection", "lambda=nan"],
            USAGE,
            &["--connection:1:8", "`nan` is not"],
        ),
        (&["table", "so3", "--connection", "-1/2"], USAGE, &["`-1/2` is not a connection"]),
        (
            &["table", "so3", "--metric", "diag(1,2)"],
            USAGE,
            &["--metric:1:1", "diag has 2 entries"],
        ),
        (&["table", "so3", "--metric", "diag(1,2,inf)"], USAGE, &["--metric:1:10", "`inf` is not"]),
        (
            &["table", "so3", "--metric", "diag(1,2,1/0)"],
            USAGE,
            &["--metric:1:12", "division by zero"],
        ),
        (
            &["table", "so3", "--metric", "[[1,0],[0,1]]"],
            USAGE,
            &["--metric:1:1", "2 rows of 2 entries"],
        ),
        (
            &["table", "so3", "--metric", "[[1,0,0],[0,1],[0,0,1]]"],
            USAGE,
            &["3 rows of 2 or 3 entries"],
        ),
        (&["table", "so3", "--metric", "[1,2,3]"], USAGE, &["--metric:1:2", "a row of the metric"]),
        (&["table", "so3", "--metric", "round"], USAGE, &["`round` is not a metric"]),
        (&["table", "so3", "--metric", ""], USAGE, &["`` is not a metric"]),
    ]);
}

#[test]
fn settings() {
    refuse_commands(&[
        (
            &["table", "M3", "--set", "J44=1"],
            USAGE,
            &["--set:1:1", "`J44` is no parameter here", "the parameters are J11, J12"],
        ),
        (
            &["table", "so3", "--set", "a=1"],
            USAGE,
            &["--set:1:1", "`a` is no parameter here", "there are none"],
        ),
        (&["table", "M3", "--set", "J11"], USAGE, &["--set:1:1", "a setting is name=value"]),
        (&["table", "M3", "--set", "J11=1,J11=2"], USAGE, &["--set:1:7", "`J11` is set twice"]),
        (&["table", "M3", "--set", "J11="], USAGE, &["--set:1:5", "the expression ends"]),
        (&["table", "M3", "--set", "J11=1/0"], USAGE, &["--set:1:7", "division by zero"]),
        (
            &["table", "M3", "--set", "J11=1,J12=nan"],
            USAGE,
            &["--set:1:11", "`nan` is not a number"],
        ),
        (&["table", "M3", "--set", ""], USAGE, &["a setting is name=value"]),
        (&["table", "M3", "--set", "1=1"], USAGE, &["--set:1:1", "`1` is not a name"]),
        (&["table", "M3", "--set", "J11=1=2"], USAGE, &["--set:1:6", "`=` is not expected here"]),
        (
            &["table", "so3@metric=diag(1,1,1/m)", "--set", "m=0"],
            MATHEMATICS,
            &["--set:1:1", "the denominator of 1/m becomes zero"],
        ),
        (
            &["table", "so3@metric=diag(1,1,m)", "--set", "m=0"],
            MATHEMATICS,
            &["@metric:1:1", "e3 is orthogonal to every vector"],
        ),
    ]);
}

#[test]
fn geometries() {
    let table: &Commands = &[
        (
            &["table", "so3", "--connection", "levi-civita"],
            MATHEMATICS,
            &["--connection:1:1", "none is given", "--metric identity"],
        ),
        (
            &["table", "so3", "--metric", "diag(1,2,0)"],
            MATHEMATICS,
            &["--metric:1:1", "e3 is orthogonal"],
        ),
        (
            &["table", "so3", "--metric", "[[1,0,0],[0,1,2],[0,0,1]]"],
            MATHEMATICS,
            &["--metric:1:1", "g(e2,e3) - g(e3,e2) = 2"],
        ),
        (
            &["table", "heisenberg3", "--metric", "killing"],
            MATHEMATICS,
            &["--metric:1:1", "x1 is orthogonal"],
        ),
        (&["table", "R^2", "--metric", "killing"], MATHEMATICS, &["is orthogonal to every vector"]),
        (
            &["table", "heisenberg3", "--metric", "identity", "--frame", "right"],
            MATHEMATICS,
            &["(L_x1 Lambda)^1_22 = -1", "take --frame left"],
        ),
        (&["compare", "so3", "so3@levi-civita"], MATHEMATICS, &["none is given"]),
    ];
    refuse_commands(table);
}

#[test]
fn floats() {
    refuse_commands(&[
        (
            &["table", "M3", "--scalar", "float"],
            USAGE,
            &["floats need numbers for J11, J12", "--set"],
        ),
        (
            &["table", "so3", "--metric", "diag(1,2,m)", "--scalar", "float"],
            USAGE,
            &["numbers for m"],
        ),
        (
            &["table", "so3", "--metric", "diag(1,2,1e400)", "--scalar", "float"],
            USAGE,
            &["--metric:1:1", "the value 1", "within 1e308"],
        ),
    ]);
    let content = b"basis = ['x', 'y']\nbrackets = '[x, y] = 1e300*x'";
    refuse([Case {
        name: "1e300 squared",
        arguments: &["table", "a.toml", "--scalar", "float"],
        file: Some(("a.toml", content)),
        input: b"",
        status: MATHEMATICS,
        says: &["R^1_212", "left the range of f64", "without --scalar float"],
    }]);
}
