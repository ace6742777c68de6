//! Charts, frames and functions that cannot be parsed, or do not define a geometry.

use crate::bad_input::case::{commands, definitions};

/// The plane `x, y` with the parameter `a`; `keys` are on line 3, `tables` begin on line 6.
fn chart(keys: &str, tables: &str) -> String {
    let head = format!("name = \"plane\"\nparameters = [\"a\"]\n{keys}");
    format!("{head}\n[chart]\ncoordinates = [\"x\", \"y\"]\n{tables}\n")
}

/// The same chart with keys only.
fn with_keys(keys: &str) -> String {
    chart(keys, "")
}

/// The same chart with these diagonal components of the metric.
fn with_metric(entry: &str) -> String {
    chart(&format!("metric = \"diag(1, {entry})\""), "")
}

#[test]
fn charts() {
    definitions("a.toml", with_keys).mathematics(&[(
        "",
        &["the connection levi-civita needs a metric, but none is given", "give a metric"],
    )]);
    definitions("a.toml", |tables: &str| chart("", tables)).usage(&[
        ("more = 1", &["a.toml:6:1", "unknown key `more`"]),
        ("[frame]\ny = \"d_x\"\nz = \"d_y\"", &["a.toml:5:22", "is already in use"]),
    ]);
    definitions("a.toml", str::to_string).usage(&[
        ("[chart]\nname = \"x\"", &["a.toml:2:1", "unknown key `name`"]),
        ("[chart]\ncoordinates = []", &["dimension 0 is not between 1"]),
        ("chart = 3", &["a.toml:1:9", "integer `3`"]),
        ("[chart]\ncoordinates = [\"x\", \"x\"]", &["a.toml:2:22", "`x` is named twice"]),
        ("[chart]\ncoordinates = [\"x\", \"2\"]", &["a.toml:2:22", "`2` is not a name"]),
        (&chart("", "").replace("[\"a\"]", "[\"x\"]"), &["a.toml:2:16", "is already in use"]),
        (
            &chart("", "").replace("[\"a\"]", "[\"d_y\"]"),
            &["a.toml:2:16", "the name `d_y` of the parameter is already in use"],
        ),
    ]);
    definitions("a.toml", with_keys).usage(&[
        ("brackets = \"[d_x, d_y] = 0\"", &["a.toml:4:2", "brackets are given twice"]),
        ("structure_constants = []", &["brackets are given twice"]),
        ("basis = [\"u\", \"v\"]", &["a.toml:4:2", "the basis of a chart is its frame"]),
        ("dimension = 2", &["the basis of a chart"]),
    ]);
    let repeated = r#"{"chart": {"coordinates": ["x"]}, "chart": {"coordinates": ["y"]}}"#;
    definitions("a.json", str::to_string).usage(&[(repeated, &["duplicate key `chart`"])]);
}

#[test]
fn frames() {
    let frame = |fields: &str| chart("metric = \"identity\"", &format!("[frame]\n{fields}"));
    definitions("a.toml", frame).mathematics(&[
        ("u = \"sin(x)*d_x\"\nv = \"d_x\"", &["a.toml:6:2", "degenerate", "*u + v = 0"]),
        ("u = \"(sin(x)^2 + cos(x)^2 - 1)*d_x\"\nv = \"d_y\"", &["degenerate", "u = 0"]),
    ]);
    definitions("a.toml", frame).usage(&[
        ("u = \"d_x\"", &["a.toml:6:2", "the frame has 1 fields for 2 coordinates"]),
        ("u = \"d_x\"\nv = \"d_z\"", &["a.toml:8:6", "`d_z` is neither"]),
        ("u = \"x\"\nv = \"d_y\"", &["a.toml:7:6", "the term x does not contain a basis vector"]),
        ("u = \"d_x*d_y\"\nv = \"d_y\"", &["a.toml:7:6", "the product of two basis vectors"]),
        (
            "u = \"sin(d_x)*d_x\"\nv = \"d_y\"",
            &["a.toml:7:6", "a basis vector cannot be an argument"],
        ),
        ("u = \"d_x\"\nu = \"d_y\"", &["a.toml:8:1", "duplicate key"]),
        ("u = 1\nv = \"d_y\"", &["a.toml:7:5", "integer `1`"]),
    ]);
    definitions("a.toml", with_keys)
        .usage(&[("frame = [\"d_x\", \"d_y\"]", &["a.toml:3:9", "a table of names and values"])]);
    definitions("a.toml", str::to_string).usage(&[(
        "frame = {u = \"d_x\"}\nbrackets = \"\"",
        &["a.toml:1:1", "a frame needs a chart"],
    )]);
    let repeated = r#"{"chart": {"coordinates": ["x"]}, "frame": {"u": "d_x", "u": "d_x"}, "metric": "identity"}"#;
    definitions("a.json", str::to_string).usage(&[(repeated, &["duplicate key `u`"])]);
}

#[test]
fn functions() {
    definitions("a.toml", with_metric).usage(&[
        ("gamma(x)", &["a.toml:3:19", "`gamma` is not a function here: there are sin, cos, tan"]),
        ("sqrt(x*y)", &["a.toml:3:19", "unknown sign: declare the positive ones among x, y"]),
        ("sqrt(x^2)", &["unknown sign: declare the positive ones among x"]),
        ("log(0)", &["the argument of log is zero"]),
        ("sqrt(-4)", &["the argument of sqrt is negative: -4"]),
        ("sqrt(1 + sin(x))", &["a.toml:3:19", "the argument of sqrt contains a function"]),
        ("exp(tan(x))", &["a.toml:3:19", "divides by a function of an angle"]),
        ("sin(z)^2", &["a.toml:3:23", "`z` is neither a basis vector"]),
        ("cos(1000*x)", &["add up to more than 64"]),
        ("exp(20000*x)", &["an integer factor greater than 10000"]),
        ("sin()", &["a.toml:3:23", "is not expected here"]),
        ("1/(cosh(x)^2 - sinh(x)^2 - 1)", &["division by zero"]),
    ]);
    let positive = |list: &str| chart("metric = \"identity\"", &format!("positive = [{list}]"));
    definitions("a.toml", positive).usage(&[
        ("\"x*y\"", &["a.toml:6:14", "unknown sign: declare the positive ones among x, y"]),
        ("\"x\", \"-x\"", &["a.toml:6:19", "a positive function is negative: -x"]),
        ("\"x - x\"", &["a.toml:6:14", "a positive function is zero"]),
        ("\"z\"", &["a.toml:6:14", "`z` is neither a basis vector here nor a coordinate"]),
        ("\"cos(x)\"", &["a positive function contains a function"]),
        ("1", &["a.toml:6:13", "integer `1`"]),
    ]);
    let free = |list: &str| chart("metric = \"identity\"", &format!("functions = [{list}]"));
    definitions("a.toml", free).usage(&[
        ("\"f\"", &["a.toml:6:15", "`f` is not a function of the form a(t)"]),
        ("\"f(x, x)\"", &["a.toml:6:15", "`f` has the argument `x` twice"]),
        ("\"f(z)\"", &["`f` has the argument `z`, which is not a coordinate"]),
        ("\"f(a)\"", &["`f` has the argument `a`, which is not a coordinate"]),
        ("\"f_x(x)\"", &["the name of a function has no `_`: f_x(x)"]),
        ("\"f_z(x)\"", &["`f_z` is not a derivative of a function of x: f_x"]),
        ("\"sin(x)\"", &["`sin` is the name of an elementary function"]),
        ("\"x(y)\"", &["the function name `x` is already in use"]),
        ("\"sec(x)\"", &["`sec` is the name of an elementary function"]),
        ("\"f(x)\", \"f(x, y)\"", &["a.toml:6:23", "the function name `f` is already in use"]),
        ("\"f(x + y)\"", &["the arguments of `f` must be names"]),
    ]);
    let with_free =
        |entry: &str| chart(&format!("metric = \"diag(1, {entry})\""), "functions = [\"f(x, y)\"]");
    definitions("a.toml", with_free).usage(&[
        ("f(x)", &["a.toml:3:19", "the function is declared as f(x,y)"]),
        ("f(1, 2)", &["the value of `f` at a number is not known"]),
        ("f_z(x, y)", &["`f_z` is not a derivative of a function of x, y: f_x"]),
        ("f", &["`f` is neither a basis vector here nor a coordinate"]),
        ("g(x, y)", &["there is no function `g` of 2 arguments here"]),
        ("sqrt(f(x, y))*sqrt(x*f(x, y))", &["declare the positive ones among x, f(x,y)"]),
    ]);
    definitions("a.toml", with_metric).mathematics(&[(
        "sin(2*x) - 2*sin(x)*cos(x)",
        &["the metric is degenerate: d_y is orthogonal"],
    )]);
    definitions("a.toml", str::to_string).usage(&[(
        "dimension = 2\nparameters = [\"x\"]\nbrackets = \"[e1, e2] = cos(x)*e1\"",
        &["a.toml:3:24", "`cos` is not a function here: only charts allow functions"],
    )]);
}

#[test]
fn metrics_and_connections() {
    definitions("a.toml", with_keys).usage(&[
        ("metric = \"diag(1)\"", &["diag has 1 entry, but the dimension is 2"]),
        ("affinities = \"nabla[x, d_y] = d_x\"", &["a.toml:3:21", "`x` is not", "is d_x, d_y"]),
    ]);
    definitions("a.toml", |tables: &str| chart("", tables)).usage(&[
        ("[metric]\ncomponents = [[\"1\", \"x\"], [\"x\"]]", &["2 rows of 1 or 2 entries"]),
        ("[metric]\ncomponent = \"identity\"", &["a.toml:7:1", "unknown key `component`"]),
        (
            "[connection]\nkind = \"levi-civita\"\naffinities = \"nabla[d_x, d_y] = d_x\"",
            &["not both"],
        ),
    ]);
    definitions("a.toml", with_keys).mathematics(&[(
        "metric = [[\"1\", \"x\"], [\"y\", \"1\"]]",
        &["the metric is not symmetric: g(d_x,d_y) - g(d_y,d_x) = x - y"],
    )]);
    definitions("a.toml", str::to_string).usage(&[
        (
            &chart("metric = \"identity\"", "[connection]\nname = \"levi-civita\""),
            &["a.toml:7:1", "unknown key `name`"],
        ),
        (
            &chart("metric = \"identity\"", "[connection]"),
            &["a.toml:6:2", "the connection has neither kind nor affinities"],
        ),
    ]);
    definitions("a.toml", str::to_string).mathematics(&[
        (
            &chart("connection = \"plus\"", "[frame]\nu = \"d_x\"\nv = \"exp(x*1)*d_y\"")
                .replace("exp(x*1)", "(1 + x^2)"),
            &[
                "a.toml:3:15",
                "a connection lambda c needs constants, but here c^2_12 = 2*x/(x^2 + 1)",
            ],
        ),
        (
            &chart("metric = \"killing\"", "[frame]\nu = \"d_x\"\nv = \"x*d_y\""),
            &["a.toml:3:11", "a Killing form needs constants, but here c^2_12 = 1/x"],
        ),
    ]);
}

#[test]
fn options() {
    let file = with_metric("a*sin(x)^2");
    let flat = chart("", "[frame]\nu = \"d_x\"\nv = \"x*d_y\"")
        .replace("\n\n", "\nmetric = \"identity\"\n");
    commands(&[]).beside("a.toml", &file).usage(&[
        ("table a.toml --scalar float", &["functions on a chart", "exact"]),
        ("table a.toml --set x=1", &["`x` is a coordinate, not a parameter"]),
        ("table a.toml --set b=1", &["`b` is not a parameter here", "the parameters are a"]),
        ("table so3 --metric diag(1,1,sin(q))", &["--metric:1:10", "only charts allow functions"]),
    ]);
    commands(&[]).beside("a.toml", &file).mathematics(&[
        ("table a.toml --frame right", &["no right-invariant frame"]),
        ("table a.toml --set a=0", &["the metric is degenerate"]),
        ("table a.toml --connection lambda=sin(x)", &["needs constants, but here lambda = sin(x)"]),
    ]);
    commands(&[]).beside("a.toml", &flat).mathematics(&[(
        "compare a.toml so3",
        &["a comparison needs constants, but here c^2_12 = 1/x"],
    )]);
}
