//! Options that are invalid, or have no mathematical answer.

use crate::bad_input::case::{commands, definitions};

#[test]
fn arguments() {
    commands(&[]).usage(&[
        ("tabel", &["tabel", "table"]),
        ("table", &["no SPACE is given", "--basis and --bracket"]),
        ("compare so3", &["needs two spaces, or none"]),
        ("compare so3 so3 so3", &["so3"]),
        ("verify", &["SPACE"]),
        ("compare M3 SO3 --metric identity", &["--metric"]),
        ("equations", &["no SPACE is given"]),
        ("equations so3", &["need a metric", "--kind"]),
        ("equations M3 --code c --solve", &["--solve"]),
        ("list xyzzy", &["`xyzzy`", "use `affinor list` to show all"]),
        ("completions cmd", &["cmd", "bash"]),
        ("completions", &["SHELL"]),
    ]);
    commands(&["table", "so3"])
        .usage(&[("so3", &["so3"]), ("--matric identity", &["--matric", "--metric"])]);
    commands(&["equations", "so3"]).usage(&[
        ("--kind up", &["euler-poincare, autoparallel, transp"]),
        ("--code java", &["java", "rust, c, python"]),
    ]);
    commands(&["equations", "so3"]).mathematics(&[("--metric diag(1,1,0)", &["degenerate", "e3"])]);
}

#[test]
fn values() {
    commands(&["table", "so3"]).usage(&[
        ("--show curvatures", &["did you mean curvature?"]),
        ("--show ricci,,torsion", &["`` is not one of"]),
        ("--format xml", &["xml", "text, markdown, latex, csv, json"]),
        ("--color red", &["red", "auto, always, never"]),
        ("--scalar double", &["double", "exact, float"]),
        ("--frame up", &["up", "left, right"]),
        ("--threads 0", &["--threads 0 is not between 1 and 1024"]),
        ("--threads -1", &["--threads -1 is not"]),
        ("--threads 1000000", &["--threads 1000000 is not"]),
        ("--threads two", &["two"]),
        ("--tolerance -1", &["--tolerance -1 is not in"]),
        ("--tolerance 2", &["--tolerance 2 is not in"]),
        ("--tolerance NaN", &["--tolerance NaN is not in"]),
        ("--tolerance inf", &["--tolerance inf is not in"]),
        ("--tolerance small", &["small"]),
    ]);
    commands(&["table", "so3", "--connection"]).usage(&[
        ("left", &["--connection:1:1", "`left` is not a connection"]),
        ("lambda=2e1", &["write `*` or a space between the number and `e1`"]),
        ("lambda=1/0", &["--connection:1:10", "division by zero"]),
        ("lambda=nan", &["--connection:1:8", "`nan` is not"]),
        ("-1/2", &["`-1/2` is not a connection"]),
    ]);
    commands(&["table", "so3", "--metric"]).usage(&[
        ("diag(1,2)", &["--metric:1:1", "diag has 2 entries"]),
        ("diag(1)", &["--metric:1:1", "diag has 1 entry,"]),
        ("[[1]]", &["the metric has 1 row of 1 entry, but the dimension is 3"]),
        ("[[],[],[]]", &["the metric has 3 rows of 0 entries"]),
        ("[]", &["the metric has no rows"]),
        ("diag(2e1,1,1)", &["--metric:1:6", "write `*` or a space between the number and `e1`"]),
        ("diag(1\u{a0}/2,1,1)", &["--metric:1:7", "\\u{a0} is not expected here"]),
        (&format!("diag({}1,1,1)", "-".repeat(101)), &["more than 100 signs in a row"]),
        (&format!("diag({}1,1,1)", "-".repeat(100_000)), &["more than 100 signs in a row"]),
        ("diag(1,2,inf)", &["--metric:1:10", "`inf` is not"]),
        ("diag(1,2,1/0)", &["--metric:1:12", "division by zero"]),
        ("[[1,0],[0,1]]", &["--metric:1:1", "2 rows of 2 entries"]),
        ("[[1,0,0],[0,1],[0,0,1]]", &["3 rows of 2 or 3 entries"]),
        ("[1,2,3]", &["--metric:1:2", "each row of the metric"]),
        ("round", &["`round` is not a metric"]),
        ("", &["`` is not a metric"]),
    ]);
}

#[test]
fn settings() {
    commands(&["table", "M3", "--set"]).usage(&[
        ("J44=1", &["--set:1:1", "`J44` is not a parameter here", "the parameters are J11, J12"]),
        ("J11", &["--set:1:1", "this is not of the form name=value"]),
        ("J11=1,J11=2", &["--set:1:7", "`J11` is set twice"]),
        ("J11=", &["--set:1:5", "the expression ends"]),
        ("J11=1/0", &["--set:1:7", "division by zero"]),
        ("J11=1,J12=nan", &["--set:1:11", "`nan` is not a number"]),
        ("", &["this is not of the form name=value"]),
        ("J11=1 --set J11=2", &["`J11` is set twice"]),
        ("J11=2e1", &["write `*` or a space between the number and `e1`"]),
        ("1=1", &["--set:1:1", "`1` is not a name"]),
        ("J11=1=2", &["--set:1:6", "`=` is not expected here"]),
    ]);
    commands(&["table", "so3"])
        .usage(&[("--set a=1", &["--set:1:1", "`a` is not a parameter here", "there are none"])]);
    commands(&[]).mathematics(&[
        ("table so3@metric=diag(1,1,1/m) --set m=0", &["--set:1:1", "1/m becomes zero"]),
        ("table so3@metric=diag(1,1,m) --set m=0", &["@metric:1:1", "e3 is orthogonal"]),
    ]);
}

#[test]
fn geometries() {
    commands(&["table", "so3", "--connection"]).mathematics(&[(
        "levi-civita",
        &["--connection:1:1", "none is given", "--metric identity"],
    )]);
    commands(&["table", "so3", "--metric"]).mathematics(&[
        ("diag(1,2,0)", &["--metric:1:1", "e3 is orthogonal"]),
        ("[[1,0,0],[0,1,2],[0,0,1]]", &["--metric:1:1", "g(e2,e3) - g(e3,e2) = 2"]),
    ]);
    commands(&[]).mathematics(&[
        ("table heisenberg3 --metric killing", &["--metric:1:1", "x1 is orthogonal"]),
        ("table R^2 --metric killing", &["is orthogonal to every vector"]),
        (
            "table heisenberg3 --metric identity --frame right",
            &["(L_x1 Lambda)^1_22 = -1", "write --frame left"],
        ),
        ("compare so3 so3@levi-civita", &["none is given"]),
    ]);
}

#[test]
fn floats() {
    commands(&[])
        .usage(&[("table M3 --scalar float", &["floats need numbers for J11, J12", "--set"])]);
    commands(&["table", "so3", "--metric"]).usage(&[
        ("diag(1,2,m) --scalar float", &["numbers for m"]),
        (
            "diag(1,2,1e400) --scalar float",
            &["--metric:1:1", "the value 1", "from 1e-307 to 1e308"],
        ),
    ]);
    let content =
        |constant: &str| format!("basis = ['x', 'y']\nbrackets = '[x, y] = {constant}*x'");
    let says = &["R^1_212", "left the range of f64", "leave --scalar float out"];
    definitions("a.toml", content).with(&["--scalar", "float"]).mathematics(&[("1e300", says)]);
}

#[test]
fn spaces() {
    let many = vec!["R"; 15_000].join("+").replace('R', "R^1");
    commands(&["table"]).usage(&[
        ("so3@", &["SPACE:1:4", "the connection is missing", "write so3@plus"]),
        ("so3@plus@zero", &["SPACE:1:4", "more than one `@`"]),
        ("so3;", &["SPACE:1:4", "the connection is missing"]),
        (&many, &["the dimension 15000 is not between 1 and 2048"]),
    ]);
    commands(&["exp"]).usage(&[("so3 1\u{a0}0,2,3", &["\\u{a0} is not expected here"])]);
}
