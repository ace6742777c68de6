//! Invalid problems of motion.

use crate::bad_input::case::problems;

pub const GOOD: &str = r#"space = "so3"
metric = "diag(1, 2, 3)"
initial.velocity = [1, 2, 3]
output = { end = 1, every = 0.5 }
"#;

pub const SPACE: &str = "space = \"so3\"\n";
pub const METRIC: &str = "metric = \"diag(1, 2, 3)\"\n";
const INITIAL: &str = "initial.velocity = [1, 2, 3]\n";
const OUTPUT: &str = "output = { end = 1, every = 0.5 }\n";

/// The valid problem with one of its lines replaced.
pub fn instead_of(line: &'static str) -> impl Fn(&str) -> String {
    assert!(GOOD.contains(line), "{line}");
    move |by| GOOD.replace(line, &format!("{by}\n"))
}

/// The valid problem with lines inserted after one of its own.
fn after(line: &'static str) -> impl Fn(&str) -> String {
    move |lines| instead_of(line)(&format!("{line}{lines}"))
}

/// The valid problem with `end` as its only output key, and more lines from line 5 on.
pub fn with(lines: &str) -> String {
    instead_of(OUTPUT)(&format!("output.end = 1\n{lines}"))
}

#[test]
fn keys() {
    problems("a.toml", instead_of(METRIC)).usage(&[
        ("metrik = 'identity'", &["a.toml:2:1", "unknown key `metrik`", "did you mean `metric`?"]),
        ("metric = 'identity'\nmetric = 'identity'", &["a.toml:3:1", "duplicate key"]),
        ("metric = 'diag(1, 2)'", &["a.toml"]),
    ]);
    problems("a.toml", instead_of(OUTPUT)).usage(&[
        ("output = { end = 1, evry = 0.5 }", &["a.toml:4:", "`evry`", "did you mean `every`?"]),
        ("", &["missing field `output`"]),
    ]);
    problems("a.toml", with)
        .usage(&[("forces.wind = [1, 0, 0]", &["a.toml:5:", "`wind`", "the keys are body"])]);
    problems("a.toml", instead_of(SPACE)).usage(&[
        ("", &["the space is missing", "as in space = "]),
        ("space = 'so(3'", &["a.toml:1:12", "not closed"]),
        ("space = 'none.toml'", &["a.toml:1:10", "cannot read none.toml"]),
    ]);
    problems("a.toml", instead_of(METRIC)).mathematics(&[
        ("", &["the metric of the kinetic energy is missing", "give metric ="]),
        ("metric = 'diag(1, 0, 3)'", &["degenerate", "whose matrix is invertible"]),
        ("metric = [['1', '2', '0'], ['0', '1', '0'], ['0', '0', '1']]", &["symmetric"]),
    ]);
    problems("a.toml", instead_of(INITIAL))
        .usage(&[("", &["the initial velocity is missing", "give one of velocity, momentum"])]);
    problems("a.toml", after(INITIAL)).usage(&[
        ("initial.momentum = [1, 2, 3]", &["the velocity is given more than once"]),
        ("invariance = 'both'", &["a.toml:4:1", "`both` is neither left nor right"]),
        ("connection = 'plus-minus'", &["plus-minus"]),
    ]);
}

#[test]
fn numbers() {
    problems("a.toml", instead_of(INITIAL)).usage(&[
        (
            "initial.velocity = [1, 'speed', 3]",
            &["a.toml:3:25", "not a known name here", "only pi and tau"],
        ),
        ("initial.velocity = [1, '2*sin(speed)', 3]", &["a.toml:3:31", "^^^^^"]),
        ("initial.velocity = [1, 'sine(2)', 3]", &["a.toml:3:25", "`sine` is not a function"]),
        ("initial.velocity = [1, nan, 3]", &["a.toml:3", "NaN"]),
        ("initial.velocity = [1, inf, 3]", &["a.toml:3", "inf"]),
        ("initial.velocity = [1, 2]", &["a.toml:3:9", "2 components, but the dimension is 3"]),
        ("initial.velocity = [1, 2, 3, 4]", &["4 components, but the dimension is 3"]),
        ("initial.velocity = []", &["0 components, but the dimension is 3"]),
        ("initial.velocity = 1", &["a.toml:3:20"]),
    ]);
    problems("a.toml", instead_of(INITIAL)).mathematics(&[
        ("initial.velocity = [1, '1/0', 3]", &["a.toml:3:25", "`1/0` is inf, which is not finite"]),
        (
            "initial.velocity = [1, '10^400', 3]",
            &["a.toml:3:25", "`10^400` is inf, which is not finite"],
        ),
    ]);
    problems("a.toml", after(INITIAL)).usage(&[
        ("parameters = { a = 'b', b = 'a' }", &["a.toml:4:21", "`b` is not a known name here"]),
        ("parameters = { a = 'a + 1' }", &["a.toml:4:21", "`a` is not a known name here"]),
        ("parameters = { pi = 3 }", &["a.toml:4:16", "the name `pi` is already in use"]),
        (
            "parameters = { H1 = 3 }",
            &["a.toml:4:", "is already in use", "choose a name other than"],
        ),
        ("parameters = { 'a b' = 3 }", &["a.toml:4:"]),
    ]);
    let deep = format!("initial.velocity = [1, 2, '{}1{}']\n", "(".repeat(5000), ")".repeat(5000));
    let long = format!("initial.velocity = [1, 2, '{}x']\n", "1+".repeat(200_000));
    problems("a.toml", instead_of(INITIAL)).usage(&[(&deep, &["nested parentheses"])]);
    problems("a.toml", instead_of(INITIAL)).usage(&[(&long, &["a.toml:3"])]);
}

#[test]
fn starts() {
    problems("a.toml", instead_of(SPACE)).usage(&[(
        "space = 'se2'\ninitial.quaternion = [1, 0, 0, 0]",
        &["a.toml:2:", "`quaternion` is allowed on so(3) only"],
    )]);
    problems("a.toml", after(SPACE)).usage(&[
        ("initial.quaternion = [1, 0, 0]", &["`quaternion` must be four numbers"]),
        ("initial.position = [0, 0, 1]", &["a.toml:2:", "three numbers x, y, z"]),
        (
            "initial.quaternion = [1, 0, 0, 0]\ninitial.position = [0, 0, 1]",
            &["`quaternion` is allowed on so(3) only, and with `position` on se(3)"],
        ),
        ("initial.element = [[1, 0, 0], [0, 1], [0, 0, 1]]", &["different lengths"]),
        ("initial.coordinates = [1, 2]", &["coordinates has 2 components"]),
        (
            "initial.coordinates = [0, 0, 0]\ninitial.quaternion = [1, 0, 0, 0]",
            &["the element is given more than once"],
        ),
    ]);
    problems("a.toml", after(SPACE)).mathematics(&[
        ("initial.quaternion = [0, 0, 0, 0]", &["a.toml:2:"]),
        ("initial.element = [[2, 0, 0], [0, 1, 0], [0, 0, 1]]", &["a.toml:2:"]),
        ("initial.element = [[1, 0], [0, 1]]", &["a.toml:2:"]),
        ("initial.element = []", &["a.toml:2:"]),
    ]);
}

/// An error for a renamed key gives the new name.
#[test]
fn renamed_keys() {
    let part = "inertia.parts = [{ shape = 'ball', radius = 1, mass = 1, ";
    problems("a.toml", after(OUTPUT)).usage(&[
        ("initial.space_velocity = [1, 2, 3]", &["`space_velocity` is now `spatial_velocity`"]),
        ("initial.space_momentum = [1, 2, 3]", &["`space_momentum` is now `spatial_momentum`"]),
        ("forces.space = [1, 2, 3]", &["`space` is now `spatial`"]),
        ("forces.table_in = 'space'", &["`space` is now `spatial`", "a.toml:5:"]),
        ("given.velocity = [1, 2, 3]", &["`given` is now `prescribed`", "a.toml:5:"]),
        ("prescribed.space_velocity = [1, 2, 3]", &["is now `spatial_velocity`"]),
        (&format!("{part}at = [0, 0, 1] }}]"), &["`at` is now `position`"]),
        (&format!("{part}turn = [0, 0, 1] }}]"), &["`turn` is now `rotation`"]),
    ]);
}

#[test]
fn methods() {
    problems("a.toml", after(OUTPUT)).usage(&[
        ("integrator.method = 'rk4'", &["a.toml:5:22", "`rk4` is not a method", "rkmk54"]),
        ("integrator.method = 'cg3'", &["a.toml:5:22", "`cg3` was removed", "use cf4"]),
        ("integrator.method = 'kick6'", &["use kick4"]),
        ("integrator = { method = 'rkmk4', step = 0 }", &["a.toml:5:", "0 is not positive"]),
        ("integrator = { method = 'rkmk4', step = -0.1 }", &["-0.1 is not positive"]),
        ("integrator = { method = 'rkmk4', step = inf }", &["inf"]),
        ("integrator.tolerance = 0\nforces.potential = 'R33'", &["0 is not positive"]),
    ]);
    problems("a.toml", after(OUTPUT)).mathematics(&[
        ("integrator.method = 'rkmk4'", &["rkmk4", "it needs a step"]),
        (
            "integrator = { method = 'dmv10', step = 0.1 }\nforces.body = [0, 0, 1]",
            &["a body without forces"],
        ),
        (
            "integrator = { method = 'kick4', step = 0.1 }\nforces.body = ['-Omega1', 0, 0]",
            &["do not depend on the velocity"],
        ),
        ("integrator = { method = 'magnus6', step = 0.1 }", &["magnus6"]),
        ("integrator = { method = 'isospectral2', step = 0.1 }", &["isospectral2"]),
    ]);
    let on_se2 = "space = 'se2'\nintegrator = { method = 'exact' }\n";
    problems("a.toml", instead_of(SPACE)).mathematics(&[(on_se2, &["it is for a rigid body"])]);
    let on_matrices = "space = 'so(2,1)'\nintegrator = { method = 'projected853' }\n";
    problems("a.toml", instead_of(SPACE))
        .mathematics(&[(on_matrices, &["it is for left-invariant systems"])]);
}

#[test]
fn outputs() {
    problems("a.toml", instead_of(OUTPUT)).usage(&[
        (
            "output = { end = 1, every = 0 }",
            &["a.toml:4:", "interval between rows must be positive"],
        ),
        (
            "output = { end = 1, every = -1 }",
            &["a.toml:4:", "interval between rows must be positive"],
        ),
        ("output = { every = 1 }", &["a.toml:4:1", "give `end` and optionally `every`"]),
        ("output = { end = 1, times = [1] }", &["a.toml:4:1", "give `end` and optionally `every`"]),
        ("output = { times = [1, 3, 2] }", &["a.toml:4:", "must increase or decrease"]),
        ("output = { end = 1, every = 1e-12 }", &["a.toml:4:", "rows exceed the limit"]),
        ("output = { end = 1e300, every = 1e-300 }", &["rows exceed the limit"]),
        (
            "output = { end = 1, columns = ['t', 'speed'] }",
            &["a.toml:4:38", "`speed` is not a quantity", "the names here are t, Omega1..Omega3"],
        ),
        (
            "output = { end = 1, columns = ['H', 'H1'] }",
            &["a.toml:4:", "the column name `H1` occurs twice"],
        ),
        (
            "output = { end = 1 }\nquantities.k = 'H1 + 2*H9'",
            &["a.toml:5:24", "^^", "`H9` is not a known name here"],
        ),
        (
            "output = { end = 1 }\nquantities.energy = 'H1'",
            &["the column name `energy` occurs twice"],
        ),
    ]);
}
