//! Charts, frames and functions that cannot be understood, or make no geometry.

use crate::bad_input::case::{Case, Files, MATHEMATICS, USAGE, refuse, refuse_files};

/// The plane `x, y` with the parameter `a`; `keys` stand on line 3, `tables` from line 6.
fn chart(keys: &str, tables: &str) -> String {
    let head = format!("name = \"plane\"\nparameters = [\"a\"]\n{keys}");
    format!("{head}\n[chart]\ncoordinates = [\"x\", \"y\"]\n{tables}\n")
}

/// The same with a metric of these components on the diagonal.
fn with_metric(entry: &str) -> String {
    chart(&format!("metric = \"diag(1, {entry})\""), "")
}

#[test]
fn charts() {
    refuse_files(
        "a.toml",
        &[
            (
                "no metric, no connection",
                &chart("", ""),
                MATHEMATICS,
                &["levi-civita is the connection of a metric, and none is given", "give a metric"],
            ),
            (
                "an unknown key",
                &chart("", "more = 1"),
                USAGE,
                &["a.toml:6:1", "unknown key `more`"],
            ),
            (
                "no coordinates",
                "[chart]\nname = \"x\"",
                USAGE,
                &["a.toml:2:1", "unknown key `name`"],
            ),
            (
                "an empty chart",
                "[chart]\ncoordinates = []",
                USAGE,
                &["dimension 0 is not between 1"],
            ),
            ("a chart of a wrong type", "chart = 3", USAGE, &["a.toml:1:9", "integer `3`"]),
            (
                "a coordinate named twice",
                "[chart]\ncoordinates = [\"x\", \"x\"]",
                USAGE,
                &["a.toml:2:22", "the coordinate `x` is named twice"],
            ),
            (
                "a coordinate that is no name",
                "[chart]\ncoordinates = [\"x\", \"2\"]",
                USAGE,
                &["a.toml:2:22", "`2` is not a name"],
            ),
            (
                "a coordinate and a parameter",
                &chart("", "").replace("[\"a\"]", "[\"x\"]"),
                USAGE,
                &["a.toml:2:16", "the parameter `x` is already the name of something"],
            ),
            (
                "a parameter like a field",
                &chart("", "").replace("[\"a\"]", "[\"d_y\"]"),
                USAGE,
                &["a.toml:2:16", "the parameter `d_y` is already the name of something"],
            ),
            (
                "a coordinate like a field of the frame",
                &chart("", "[frame]\ny = \"d_x\"\nz = \"d_y\""),
                USAGE,
                &["a.toml:5:22", "the coordinate `y` is already the name of something"],
            ),
            (
                "brackets beside a chart",
                &chart("brackets = \"[d_x, d_y] = 0\"", ""),
                USAGE,
                &["a.toml:4:2", "a chart defines the brackets by its fields: give no others"],
            ),
            (
                "structure constants beside a chart",
                &chart("structure_constants = []", ""),
                USAGE,
                &["a chart defines the brackets by its fields"],
            ),
            (
                "a basis beside a chart",
                &chart("basis = [\"u\", \"v\"]", ""),
                USAGE,
                &["a.toml:4:2", "the basis of a chart is its frame: give no other"],
            ),
            (
                "a dimension beside a chart",
                &chart("dimension = 2", ""),
                USAGE,
                &["the basis of a chart"],
            ),
        ],
    );
    let repeated = r#"{"chart": {"coordinates": ["x"]}, "chart": {"coordinates": ["y"]}}"#;
    refuse_files("a.json", &[("a chart given twice", repeated, USAGE, &["duplicate key `chart`"])]);
}

#[test]
fn frames() {
    let frame = |fields: &str| chart("metric = \"identity\"", &format!("[frame]\n{fields}"));
    let table: &[(&str, String, i32, &[&str])] = &[
        (
            "a degenerate frame",
            frame("u = \"sin(x)*d_x\"\nv = \"d_x\""),
            MATHEMATICS,
            &["a.toml:6:2", "the frame is degenerate: its determinant is zero, for", "*u + v = 0"],
        ),
        (
            "a zero field",
            frame("u = \"(sin(x)^2 + cos(x)^2 - 1)*d_x\"\nv = \"d_y\""),
            MATHEMATICS,
            &["the frame is degenerate", "u = 0"],
        ),
        (
            "too few fields",
            frame("u = \"d_x\""),
            USAGE,
            &["a.toml:6:2", "the frame has 1 fields for 2 coordinates"],
        ),
        (
            "an unknown coordinate",
            frame("u = \"d_x\"\nv = \"d_z\""),
            USAGE,
            &["a.toml:8:6", "`d_z` is neither a basis vector here nor a coordinate nor a declared"],
        ),
        (
            "no field",
            frame("u = \"x\"\nv = \"d_y\""),
            USAGE,
            &["a.toml:7:6", "the part x has no basis vector"],
        ),
        (
            "a product of fields",
            frame("u = \"d_x*d_y\"\nv = \"d_y\""),
            USAGE,
            &["a.toml:7:6", "the product of two basis vectors is not defined"],
        ),
        (
            "a function of a field",
            frame("u = \"sin(d_x)*d_x\"\nv = \"d_y\""),
            USAGE,
            &["a.toml:7:6", "a basis vector is no argument"],
        ),
        (
            "a field given twice",
            frame("u = \"d_x\"\nu = \"d_y\""),
            USAGE,
            &["a.toml:8:1", "duplicate key"],
        ),
        (
            "a field of a wrong type",
            frame("u = 1\nv = \"d_y\""),
            USAGE,
            &["a.toml:7:5", "integer `1`"],
        ),
        (
            "a frame of a wrong type",
            chart("frame = [\"d_x\", \"d_y\"]", ""),
            USAGE,
            &["a.toml:3:9", "a table of fields, like e1 ="],
        ),
        (
            "a frame without a chart",
            "frame = {u = \"d_x\"}\nbrackets = \"\"".into(),
            USAGE,
            &["a.toml:1:1", "a frame needs a chart"],
        ),
    ];
    let table: Vec<_> =
        table.iter().map(|(n, text, s, says)| (*n, text.as_str(), *s, *says)).collect();
    refuse_files("a.toml", &table as &Files);
    let repeated = r#"{"chart": {"coordinates": ["x"]}, "frame": {"u": "d_x", "u": "d_x"}, "metric": "identity"}"#;
    refuse_files("a.json", &[("a field given twice", repeated, USAGE, &["duplicate key `u`"])]);
}

#[test]
fn functions() {
    let table: &[(&str, String, i32, &[&str])] = &[
        (
            "an unknown function",
            with_metric("log(x)"),
            USAGE,
            &["a.toml:3:19", "`log` is no function here: there are sin, cos, tan"],
        ),
        (
            "an undeclared coordinate",
            with_metric("sin(z)^2"),
            USAGE,
            &["a.toml:3:22", "`z` is neither a basis vector here nor a coordinate nor a declared"],
        ),
        (
            "a function of a parameter",
            with_metric("sin(a)"),
            USAGE,
            &["a.toml:3:19", "sin takes coordinates, and `a` is none"],
        ),
        ("half an angle", with_metric("sin(x/2)"), USAGE, &["a sum of integer multiples"]),
        ("a function of a number", with_metric("exp(1)"), USAGE, &["a sum of integer multiples"]),
        ("too many multiples", with_metric("cos(1000*x)"), USAGE, &["more than 16 multiples"]),
        ("no argument", with_metric("sin()"), USAGE, &["a.toml:3:23", "is not expected here"]),
        (
            "a metric that is zero",
            with_metric("sin(2*x) - 2*sin(x)*cos(x)"),
            MATHEMATICS,
            &["the metric is degenerate: d_y is orthogonal"],
        ),
        (
            "a division by zero",
            with_metric("1/(cosh(x)^2 - sinh(x)^2 - 1)"),
            USAGE,
            &["division by zero"],
        ),
        (
            "a function without a chart",
            "dimension = 2\nparameters = [\"x\"]\nbrackets = \"[e1, e2] = cos(x)*e1\"".into(),
            USAGE,
            &["a.toml:3:24", "`cos` is no function here: only a chart has some"],
        ),
    ];
    let table: Vec<_> =
        table.iter().map(|(n, text, s, says)| (*n, text.as_str(), *s, *says)).collect();
    refuse_files("a.toml", &table as &Files);
}

#[test]
fn metrics_and_connections() {
    let table: &[(&str, String, i32, &[&str])] = &[
        (
            "too short",
            chart("metric = \"diag(1)\"", ""),
            USAGE,
            &["diag has 1 entries, the dimension is 2"],
        ),
        (
            "not square",
            chart("", "[metric]\ncomponents = [[\"1\", \"x\"], [\"x\"]]"),
            USAGE,
            &["the metric has 2 rows of 1 or 2 entries"],
        ),
        (
            "not symmetric",
            chart("metric = [[\"1\", \"x\"], [\"y\", \"1\"]]", ""),
            MATHEMATICS,
            &["the metric is not symmetric: g(d_x,d_y) - g(d_y,d_x) = x - y"],
        ),
        (
            "an unknown key of the metric",
            chart("", "[metric]\ncomponent = \"identity\""),
            USAGE,
            &["a.toml:7:1", "unknown key `component`"],
        ),
        (
            "an unknown key of the connection",
            chart("metric = \"identity\"", "[connection]\nname = \"levi-civita\""),
            USAGE,
            &["a.toml:7:1", "unknown key `name`"],
        ),
        (
            "an empty connection",
            chart("metric = \"identity\"", "[connection]"),
            USAGE,
            &["a.toml:6:2", "the connection has neither kind nor affinities"],
        ),
        (
            "kind and affinities",
            chart(
                "",
                "[connection]\nkind = \"levi-civita\"\naffinities = \"nabla[d_x, d_y] = d_x\"",
            ),
            USAGE,
            &["not both"],
        ),
        (
            "affinities of what is no field",
            chart("affinities = \"nabla[x, d_y] = d_x\"", ""),
            USAGE,
            &["a.toml:3:21", "`x` is not a basis vector", "the basis is d_x, d_y"],
        ),
        (
            "a canonical connection over functions",
            chart("connection = \"plus\"", "[frame]\nu = \"d_x\"\nv = \"exp(x*1)*d_y\"")
                .replace("exp(x*1)", "(1 + x^2)"),
            MATHEMATICS,
            &[
                "a.toml:3:15",
                "a connection lambda c needs constants, but here c^2_12 = 2*x/(x^2 + 1)",
            ],
        ),
        (
            "a Killing form over functions",
            chart("metric = \"killing\"", "[frame]\nu = \"d_x\"\nv = \"x*d_y\""),
            MATHEMATICS,
            &["a.toml:3:11", "a Killing form needs constants, but here c^2_12 = 1/x"],
        ),
    ];
    let table: Vec<_> =
        table.iter().map(|(n, text, s, says)| (*n, text.as_str(), *s, *says)).collect();
    refuse_files("a.toml", &table as &Files);
}

#[test]
fn commands() {
    let file = with_metric("a*sin(x)^2");
    let flat = chart("", "[frame]\nu = \"d_x\"\nv = \"x*d_y\"")
        .replace("\n\n", "\nmetric = \"identity\"\n");
    let cases: &[(&str, &[&str], i32, &[&str])] = &[
        (
            &file,
            &["table", "a.toml", "--scalar", "float"],
            USAGE,
            &["functions on a chart", "exact"],
        ),
        (
            &file,
            &["table", "a.toml", "--frame", "right"],
            MATHEMATICS,
            &["no right-invariant frame"],
        ),
        (
            &file,
            &["table", "a.toml", "--set", "x=1"],
            USAGE,
            &["`x` is a coordinate, not a parameter"],
        ),
        (
            &file,
            &["table", "a.toml", "--set", "b=1"],
            USAGE,
            &["`b` is no parameter here", "the parameters are a"],
        ),
        (&file, &["table", "a.toml", "--set", "a=0"], MATHEMATICS, &["the metric is degenerate"]),
        (
            &file,
            &["table", "a.toml", "--metric", "diag(1,sin(q))"],
            USAGE,
            &["--metric:1:8", "sin takes coordinates"],
        ),
        (
            &file,
            &["table", "a.toml", "--connection", "lambda=sin(x)"],
            MATHEMATICS,
            &["needs constants, but here lambda = sin(x)"],
        ),
        (
            &file,
            &["table", "so3", "--metric", "diag(1,1,sin(q))"],
            USAGE,
            &["--metric:1:10", "only a chart has some"],
        ),
        (
            &flat,
            &["compare", "a.toml", "so3"],
            MATHEMATICS,
            &["a comparison needs constants, but here c^2_12 = 1/x"],
        ),
    ];
    refuse(cases.iter().map(|(file, arguments, status, says)| Case {
        name: arguments[arguments.len() - 1],
        arguments,
        file: Some(("a.toml", file.as_bytes())),
        input: b"",
        status: *status,
        says,
    }));
}
