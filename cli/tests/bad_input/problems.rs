//! Problems of motion that are none.

use crate::bad_input::case::{Case, MATHEMATICS, USAGE, refuse};

/// What is refused: its name, lines in the place of lines of [`GOOD`], the status, and what is said.
pub type Problems<'c> = [(&'c str, &'c str, &'c str, i32, &'c [&'c str])];

pub const GOOD: &str = r#"space = "so3"
metric = "diag(1, 2, 3)"
initial.velocity = [1, 2, 3]
output = { end = 1, every = 0.5 }
"#;

pub fn refuse_problems(table: &Problems) {
    let changed = table.iter().map(|&(name, line, by, status, says)| {
        assert!(GOOD.contains(line), "{name}");
        (name, GOOD.replace(line, by), status, says)
    });
    let changed: Vec<_> = changed.collect();
    refuse(changed.iter().map(|(name, text, status, says)| Case {
        name,
        arguments: &["simulate", "a.toml"],
        file: Some(("a.toml", text.as_bytes())),
        input: b"",
        status: *status,
        says,
    }));
}

pub const SPACE: &str = "space = \"so3\"\n";
pub const METRIC: &str = "metric = \"diag(1, 2, 3)\"\n";
const INITIAL: &str = "initial.velocity = [1, 2, 3]\n";
pub const OUTPUT: &str = "output = { end = 1, every = 0.5 }\n";

#[test]
fn keys() {
    refuse_problems(&[
        (
            "unknown",
            METRIC,
            "metrik = 'identity'\n",
            USAGE,
            &["a.toml:2:1", "unknown key `metrik`", "did you mean `metric`?"],
        ),
        (
            "unknown inside",
            OUTPUT,
            "output = { end = 1, evry = 0.5 }\n",
            USAGE,
            &["a.toml:4:", "`evry`", "did you mean `every`?"],
        ),
        (
            "unknown force",
            OUTPUT,
            "output.end = 1\nforces.wind = [1, 0, 0]",
            USAGE,
            &["a.toml:5:", "`wind`", "the keys are body"],
        ),
        (
            "duplicate",
            METRIC,
            "metric = 'identity'\nmetric = 'identity'\n",
            USAGE,
            &["a.toml:3:1", "duplicate key"],
        ),
        ("no space", SPACE, "", USAGE, &["names no space", "give space"]),
        ("unknown space", SPACE, "space = 'so(3'\n", USAGE, &["a.toml:1:12", "not closed"]),
        (
            "no file",
            SPACE,
            "space = 'none.toml'\n",
            USAGE,
            &["a.toml:1:10", "cannot read none.toml"],
        ),
        (
            "no metric",
            METRIC,
            "",
            MATHEMATICS,
            &["needs the metric of its kinetic energy", "give metric ="],
        ),
        (
            "degenerate",
            METRIC,
            "metric = 'diag(1, 0, 3)'\n",
            MATHEMATICS,
            &["degenerate", "a metric has an inverse"],
        ),
        (
            "asymmetric",
            METRIC,
            "metric = [['1', '2', '0'], ['0', '1', '0'], ['0', '0', '1']]\n",
            MATHEMATICS,
            &["symmetric"],
        ),
        ("size of metric", METRIC, "metric = 'diag(1, 2)'\n", USAGE, &["a.toml"]),
        ("no output", OUTPUT, "", USAGE, &["missing field `output`"]),
        (
            "no start",
            INITIAL,
            "",
            USAGE,
            &["no velocity at the start", "give one of velocity, momentum"],
        ),
        (
            "two velocities",
            INITIAL,
            "initial.velocity = [1, 2, 3]\ninitial.momentum = [1, 2, 3]\n",
            USAGE,
            &["the velocity is given more than once"],
        ),
        (
            "invariance",
            INITIAL,
            "initial.velocity = [1, 2, 3]\ninvariance = 'both'\n",
            USAGE,
            &["a.toml:4:1", "`both` is neither left nor right"],
        ),
        (
            "connection",
            INITIAL,
            "initial.velocity = [1, 2, 3]\nconnection = 'plus-minus'\n",
            USAGE,
            &["plus-minus"],
        ),
    ]);
}

#[test]
fn numbers() {
    refuse_problems(&[
        (
            "a name",
            INITIAL,
            "initial.velocity = [1, 'speed', 3]\n",
            USAGE,
            &["a.toml:3:25", "`speed` is no name here", "only pi and tau"],
        ),
        (
            "in a formula",
            INITIAL,
            "initial.velocity = [1, '2*sin(speed)', 3]\n",
            USAGE,
            &["a.toml:3:30", "^^^^^"],
        ),
        (
            "a function",
            INITIAL,
            "initial.velocity = [1, 'sine(2)', 3]\n",
            USAGE,
            &["a.toml:3:25", "`sine` is no function"],
        ),
        ("nan", INITIAL, "initial.velocity = [1, nan, 3]\n", USAGE, &["a.toml:3", "NaN"]),
        ("inf", INITIAL, "initial.velocity = [1, inf, 3]\n", USAGE, &["a.toml:3", "inf"]),
        (
            "division by zero",
            INITIAL,
            "initial.velocity = [1, '1/0', 3]\n",
            MATHEMATICS,
            &["a.toml:3:25", "`1/0` is inf"],
        ),
        (
            "too large",
            INITIAL,
            "initial.velocity = [1, '10^400', 3]\n",
            MATHEMATICS,
            &["a.toml:3:25", "`10^400` is inf"],
        ),
        (
            "too few",
            INITIAL,
            "initial.velocity = [1, 2]\n",
            USAGE,
            &["a.toml:3:9", "2 components, the dimension is 3"],
        ),
        (
            "too many",
            INITIAL,
            "initial.velocity = [1, 2, 3, 4]\n",
            USAGE,
            &["4 components, the dimension is 3"],
        ),
        ("none", INITIAL, "initial.velocity = []\n", USAGE, &["0 components, the dimension is 3"]),
        ("no list", INITIAL, "initial.velocity = 1\n", USAGE, &["a.toml:3:20"]),
        (
            "parameters in a ring",
            INITIAL,
            "initial.velocity = [1, 2, 3]\nparameters = { a = 'b', b = 'a' }\n",
            USAGE,
            &["a.toml:4:21", "`b` is no name here"],
        ),
        (
            "of itself",
            INITIAL,
            "initial.velocity = [1, 2, 3]\nparameters = { a = 'a + 1' }\n",
            USAGE,
            &["a.toml:4:21", "`a` is no name here"],
        ),
        (
            "a parameter pi",
            INITIAL,
            "initial.velocity = [1, 2, 3]\nparameters = { pi = 3 }\n",
            USAGE,
            &["a.toml:4:16", "`pi` has a meaning already"],
        ),
        (
            "a parameter H1",
            INITIAL,
            "initial.velocity = [1, 2, 3]\nparameters = { H1 = 3 }\n",
            USAGE,
            &["a.toml:4:", "`H1` has a meaning already", "take another name"],
        ),
        (
            "a parameter with a space",
            INITIAL,
            "initial.velocity = [1, 2, 3]\nparameters = { 'a b' = 3 }\n",
            USAGE,
            &["a.toml:4:"],
        ),
    ]);
    let deep = format!("initial.velocity = [1, 2, '{}1{}']\n", "(".repeat(5000), ")".repeat(5000));
    let long = format!("initial.velocity = [1, 2, '{}x']\n", "1+".repeat(200_000));
    refuse_problems(&[
        ("deep", INITIAL, &deep, USAGE, &["nested parentheses"]),
        ("long", INITIAL, &long, USAGE, &["a.toml:3"]),
    ]);
}

#[test]
fn starts() {
    refuse_problems(&[
        (
            "a quaternion on se(2)",
            SPACE,
            "space = 'se2'\ninitial.quaternion = [1, 0, 0, 0]\n",
            USAGE,
            &["a.toml:2:", "a quaternion is for so(3)"],
        ),
        (
            "three numbers",
            SPACE,
            "space = 'so3'\ninitial.quaternion = [1, 0, 0]\n",
            USAGE,
            &["a quaternion is four numbers"],
        ),
        (
            "zero",
            SPACE,
            "space = 'so3'\ninitial.quaternion = [0, 0, 0, 0]\n",
            MATHEMATICS,
            &["a.toml:2:"],
        ),
        (
            "a position alone",
            SPACE,
            "space = 'so3'\ninitial.position = [0, 0, 1]\n",
            USAGE,
            &["a position stands beside a quaternion"],
        ),
        (
            "a position on so(3)",
            SPACE,
            "space = 'so3'\ninitial.quaternion = [1, 0, 0, 0]\ninitial.position = [0, 0, 1]\n",
            USAGE,
            &["a quaternion is for so(3), and with a position for se(3)"],
        ),
        (
            "no rotation",
            SPACE,
            "space = 'so3'\ninitial.element = [[2, 0, 0], [0, 1, 0], [0, 0, 1]]\n",
            MATHEMATICS,
            &["a.toml:2:"],
        ),
        (
            "ragged",
            SPACE,
            "space = 'so3'\ninitial.element = [[1, 0, 0], [0, 1], [0, 0, 1]]\n",
            USAGE,
            &["different lengths"],
        ),
        (
            "small",
            SPACE,
            "space = 'so3'\ninitial.element = [[1, 0], [0, 1]]\n",
            MATHEMATICS,
            &["a.toml:2:"],
        ),
        ("empty", SPACE, "space = 'so3'\ninitial.element = []\n", MATHEMATICS, &["a.toml:2:"]),
        (
            "coordinates",
            SPACE,
            "space = 'so3'\ninitial.coordinates = [1, 2]\n",
            USAGE,
            &["coordinates has 2 components"],
        ),
        (
            "twice",
            SPACE,
            "space = 'so3'\ninitial.coordinates = [0, 0, 0]\ninitial.quaternion = [1, 0, 0, 0]\n",
            USAGE,
            &["the element is given more than once"],
        ),
    ]);
}

#[test]
fn methods() {
    let with = |line: &str| format!("{OUTPUT}{line}\n");
    for (name, line, status, says) in [
        (
            "unknown",
            "integrator.method = 'rk4'",
            USAGE,
            &["a.toml:5:22", "`rk4` is no method", "rkmk54"][..],
        ),
        ("no step", "integrator.method = 'rkmk4'", MATHEMATICS, &["rkmk4", "it needs a step"]),
        (
            "forces",
            "integrator = { method = 'dmv6', step = 0.1 }\nforces.body = [0, 0, 1]",
            MATHEMATICS,
            &["no forces"],
        ),
        (
            "velocities",
            "integrator = { method = 'kick4', step = 0.1 }\nforces.body = ['-Omega1', 0, 0]",
            MATHEMATICS,
            &["depend on no velocity"],
        ),
        ("magnus", "integrator = { method = 'magnus6', step = 0.1 }", MATHEMATICS, &["magnus6"]),
        (
            "isospectral",
            "integrator = { method = 'isospectral2', step = 0.1 }",
            MATHEMATICS,
            &["isospectral2"],
        ),
        (
            "zero",
            "integrator = { method = 'rkmk4', step = 0 }",
            USAGE,
            &["a.toml:5:", "0 is not above zero"],
        ),
        (
            "negative",
            "integrator = { method = 'rkmk4', step = -0.1 }",
            USAGE,
            &["-0.1 is not above zero"],
        ),
        ("infinite", "integrator = { method = 'rkmk4', step = inf }", USAGE, &["inf"]),
        (
            "tolerance",
            "integrator.tolerance = 0\nforces.potential = 'R33'",
            USAGE,
            &["0 is not above zero"],
        ),
    ] {
        refuse_problems(&[(name, OUTPUT, &with(line), status, says)]);
    }
    let on_se2 = "space = 'se2'\nintegrator = { method = 'exact' }\n";
    refuse_problems(&[("on se(2)", SPACE, on_se2, MATHEMATICS, &["it is for a body"])]);
    let on_matrices = "space = 'so(2,1)'\nintegrator = { method = 'projected853' }\n";
    refuse_problems(&[(
        "on matrices",
        SPACE,
        on_matrices,
        MATHEMATICS,
        &["it is for so(2), so(3)"],
    )]);
}

#[test]
fn outputs() {
    refuse_problems(&[
        (
            "every 0",
            OUTPUT,
            "output = { end = 1, every = 0 }\n",
            USAGE,
            &["a.toml:4:", "never come to the end"],
        ),
        (
            "every -1",
            OUTPUT,
            "output = { end = 1, every = -1 }\n",
            USAGE,
            &["a.toml:4:", "never come to the end"],
        ),
        (
            "neither",
            OUTPUT,
            "output = { every = 1 }\n",
            USAGE,
            &["a.toml:4:1", "the output has an end"],
        ),
        (
            "both",
            OUTPUT,
            "output = { end = 1, times = [1] }\n",
            USAGE,
            &["a.toml:4:1", "the output has an end"],
        ),
        (
            "to and fro",
            OUTPUT,
            "output = { times = [1, 3, 2] }\n",
            USAGE,
            &["a.toml:4:", "neither increase nor decrease"],
        ),
        (
            "many",
            OUTPUT,
            "output = { end = 1, every = 1e-12 }\n",
            USAGE,
            &["a.toml:4:", "rows are too many"],
        ),
        (
            "endless",
            OUTPUT,
            "output = { end = 1e300, every = 1e-300 }\n",
            USAGE,
            &["rows are too many"],
        ),
        (
            "column",
            OUTPUT,
            "output = { end = 1, columns = ['t', 'speed'] }\n",
            USAGE,
            &["a.toml:4:38", "`speed` is no quantity", "the names here are t, Omega1..Omega3"],
        ),
        (
            "column twice",
            OUTPUT,
            "output = { end = 1, columns = ['H', 'H1'] }\n",
            USAGE,
            &["a.toml:4:", "two columns `H1`"],
        ),
        (
            "quantity",
            OUTPUT,
            "output = { end = 1 }\nquantities.k = 'H1 + 2*H9'\n",
            USAGE,
            &["a.toml:5:24", "^^", "`H9` is no name here"],
        ),
        (
            "quantity twice",
            OUTPUT,
            "output = { end = 1 }\nquantities.energy = 'H1'\n",
            USAGE,
            &["two columns `energy`"],
        ),
    ]);
}
