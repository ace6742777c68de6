//! Invalid forces, ensembles, flows and bodies in problems of motion, and files without a problem.

use crate::bad_input::case::{Case, MATHEMATICS, USAGE, commands, problems, refuse};
use crate::bad_input::problems::{GOOD, METRIC, instead_of, with};
use crate::program::run;
use tempfile::TempDir;

#[test]
fn forces() {
    problems("a.toml", with).usage(&[
        (
            "forces.body = [1, 2]",
            &["a.toml:5:", "the force has 2 components, but the dimension is 3"],
        ),
        ("forces.spatial = [1, 2, 3, 4]", &["the force has 4 components"]),
        (
            "forces.body = [1, 'cos(wind)', 3]",
            &["a.toml:5:24", "^^^^", "`wind` is not a known name here"],
        ),
        ("forces.body = [1, 'power', 3]", &["`power` is not a known name here"]),
        (
            "forces.potential = 'H1^2'",
            &["a.toml:5:21", "`H1` is not a known name here", "may contain"],
        ),
        ("forces.table = 'none.csv'", &["a.toml:5:", "cannot read"]),
        ("forces.table = '.'", &["a.toml:5:", "cannot read"]),
        ("forces.table_in = 'spatial'", &["this key needs a table"]),
        ("forces.columns = { M1 = 'a' }", &["a.toml:5:", "this key needs a table"]),
        ("initial.restore = true", &["`restore` needs a matrix, but none is given"]),
        ("forces.interpolation = 'hold'", &["a.toml:5:", "this key needs a table"]),
        (
            "forces.table = 'a'\nforces.interpolation = 'cubic'",
            &["a.toml:6:", "`cubic` is neither linear nor hold"],
        ),
        ("forces.table = 'a'\nforces.table_in = 'mars'", &["`mars` is neither body nor spatial"]),
    ]);
}

/// The run stops where a force is infinite, names the force, and keeps the rows up to there.
#[test]
fn a_pole() {
    let folder = TempDir::new().unwrap();
    let problem = format!("{GOOD}forces.body = [0, 0, '1/(t - 1)']\n");
    std::fs::write(folder.path().join("a.toml"), problem).unwrap();
    let outcome = run(folder.path(), &["simulate", "a.toml"], b"");
    assert_eq!(outcome.status, MATHEMATICS, "{}", outcome.err);
    assert!(outcome.err.contains("the integration stops at t = "), "{}", outcome.err);
    assert!(outcome.out.lines().count() == 3 && !outcome.out.contains("inf"), "{}", outcome.out);
}

/// A step size that needs too many steps is an error at once.
#[test]
fn a_tiny_step() {
    let folder = TempDir::new().unwrap();
    let problem = format!("{GOOD}integrator = {{ method = 'rkmk4', step = 1e-300 }}\n");
    std::fs::write(folder.path().join("a.toml"), problem).unwrap();
    let outcome = run(folder.path(), &["simulate", "a.toml"], b"");
    assert_eq!(outcome.status, MATHEMATICS, "{}", outcome.err);
    assert!(outcome.err.contains("steps are too many"), "{}", outcome.err);
}

#[test]
fn tables() {
    let folder = TempDir::new().unwrap();
    let problem = format!("{GOOD}forces.table = 'pushes.csv'\n");
    std::fs::write(folder.path().join("a.toml"), problem).unwrap();
    let cases = [
        ("t,M1,M2,M3\n0,1,2,3\n0,1,2,3\n0,1,2,3\n", "at most two rows at one time"),
        ("t,M1,M2,M3\n1,1,2,3\n0,1,2,3\n", "increasing times"),
        ("t,M1,M2,M3\n", "none"),
        ("", "no column `t`"),
        ("t\n0\n", "rows of a time and"),
        ("t,M1,M2,M3\n0,1,2\n", "a row of 3 numbers does not match the 4 names"),
        ("t,M1\n0,1\n", "the table has 1 components, but the dimension is 3"),
        ("t,M1,M2,M3\n0,1,2,nan\n", "is not a number"),
        ("t,M1,M2,M3\n0,1,2,inf\n", "is not finite"),
        ("t,M1,M2,M3\n0,1,2,wind\n", "is not a number"),
    ];
    for (content, says) in cases {
        std::fs::write(folder.path().join("pushes.csv"), content).unwrap();
        let outcome = run(folder.path(), &["simulate", "a.toml"], b"");
        assert_eq!(outcome.status, USAGE, "{content}: {}", outcome.err);
        assert!(outcome.err.contains(says), "{content}: {}", outcome.err);
        assert!(
            outcome.err.contains("pushes.csv") || outcome.err.contains("table"),
            "{}",
            outcome.err
        );
    }
}

#[test]
fn ensembles() {
    problems("a.toml", with).usage(&[
        ("ensemble.samples = 0", &["a.toml:5:", "from 1 to"]),
        ("ensemble.samples = 10000000000", &["from 1 to 1000000000"]),
        ("[ensemble]\nsamples = 1000000\ngrid.a = '0 .. 1 in 100000'", &["from 1 to 1000000000"]),
        ("ensemble.samples = -1", &["a.toml:5:"]),
        ("ensemble.grid.a = '0 .. 1 in 0'", &["a.toml:5:20", "the grid has no points"]),
        ("ensemble.grid.a = ''", &["a.toml:5:20", "write a grid as"]),
        ("ensemble.grid.a = '0 .. 1 in 4000000000'", &["4000000000 points exceed the limit"]),
        ("ensemble.grid.a = 'one'", &["a.toml:5:20", "`one` is not a number"]),
        (
            "ensemble.random.a = 'poisson(3)'",
            &["a.toml:5:22", "write the law as normal(mean, deviation)"],
        ),
        ("ensemble.random.a = 'normal(3)'", &["1 numbers are given instead of 2"]),
        ("ensemble.random.a = 'normal(3, -1)'", &["the deviation -1 is negative"]),
        ("ensemble = { grid = { a = '1' }, random = { a = 'uniform(0, 1)' } }", &["varied twice"]),
        ("ensemble.grid.t = '1'", &["the name `t` is already in use"]),
    ]);
    commands(&["simulate", "--ensemble"])
        .beside("a.toml", GOOD)
        .usage(&[("a.toml", &["the problem defines no ensemble"])]);
}

#[test]
fn flows() {
    let flow = |lines: &str| format!("{lines}\nintegrator.step = 0.1\noutput.end = 1\n");
    problems("a.toml", flow).usage(&[
        ("flow.kind = 'kdv'", &["a.toml:1:14", "`kdv` is not a flow", "toda, manakov or zeitlin"]),
        ("flow.kind = 'toda'", &["needs positions and momenta"]),
        (
            "flow = { kind = 'manakov', masses = [1, 2], momentum = [[0, 1], [1]] }",
            &["different lengths"],
        ),
        (
            "constraints = ['g11']\nflow = { kind = 'zeitlin', size = 5, seed = 1, degree = 2 }",
            &["has no `constraints`"],
        ),
        ("flow = { kind = 'zeitlin', size = 5, modes = [[1, 2]] }", &["[l, m, coefficient]"]),
        ("flow = { kind = 'zeitlin', size = 5, modes = [[0.5, 0, 1]] }", &["spherical harmonic"]),
        (
            "metric = 'identity'\nflow = { kind = 'zeitlin', size = 5, seed = 1, degree = 2 }",
            &["a.toml:1:1", "a flow of matrices has no `metric`"],
        ),
        (
            "output.columns = ['t']\nflow = { kind = 'zeitlin', size = 5, seed = 1, degree = 2 }",
            &["has no `columns`"],
        ),
    ]);
    problems("a.toml", flow).mathematics(&[
("flow = { kind = 'toda', positions = [0], momenta = [0, 1] }", &["a.toml:1"]),
("flow = { kind = 'toda', positions = [], momenta = [] }", &["a.toml:1"]),
("flow = { kind = 'manakov', masses = [1, 2], momentum = [[0, 1, 2], [-1, 0, 3], [-2, -3, 0]] }", &["a.toml:1"]),
("flow = { kind = 'manakov', masses = [1, 2], momentum = [[0, 1], [1, 0]] }", &["a.toml:1"]),
("flow = { kind = 'manakov', masses = [1, -1], momentum = [[0, 1], [-1, 0]] }", &["a.toml:1"]),
("flow = { kind = 'zeitlin', size = 0, modes = [[1, 0, 1]] }", &["a.toml:1"]),
("flow = { kind = 'zeitlin', size = 100000000, seed = 1, degree = 2 }", &["a.toml:1"]),
("flow = { kind = 'zeitlin', size = 5, modes = [[1, 2, 1]] }", &["a.toml:1"]),
("flow = { kind = 'zeitlin', size = 5, seed = 1, degree = 9 }", &["a.toml:1"]),
("integrator.method = 'rkmk4'\nflow = { kind = 'zeitlin', size = 5, seed = 1, degree = 2 }", &["does not support flows", "isospectral2"]),
]);
    let without =
        "flow = { kind = 'toda', positions = [0, 0], momenta = [1, 2] }\noutput.end = 1\n";
    problems("a.toml", str::to_string)
        .mathematics(&[(without, &["a flow of matrices needs a step"])]);
}

#[test]
fn given_velocities() {
    let given = |lines: &str| format!("space = 'so3'\n{lines}\noutput.end = 1\n");
    problems("a.toml", given)
        .mathematics(&[("prescribed.velocity = [1, 2, 3]", &["needs a step"])]);
    problems("a.toml", given).usage(&[
        ("integrator.step = 0.1\nprescribed.velocity = [1, 2]", &["a.toml:3:", "2 components"]),
        ("prescribed = { velocity = [1, 2, 3], spatial_velocity = [1, 2, 3] }", &["give one"]),
        ("integrator.step = 0.1\nprescribed.spatial_velocity = [1, 2, 3]", &["invariance"]),
        (
            "integrator.step = 0.1\nprescribed.velocity = [1, 'H1', 3]",
            &["a.toml:3:", "`H1` is not a known name here"],
        ),
        (
            "metric = 'identity'\nintegrator.step = 0.1\nprescribed.velocity = [1, 2, 3]",
            &["a prescribed velocity has no `metric`"],
        ),
        (
            "initial.momentum = [1, 2, 3]\nintegrator.step = 0.1\nprescribed.velocity = [1, 2, 3]",
            &["has no `momentum`"],
        ),
        (
            "forces.body = [1, 2, 3]\nintegrator.step = 0.1\nprescribed.velocity = [1, 2, 3]",
            &["has no `forces`"],
        ),
    ]);
}

#[test]
fn bodies() {
    let part = |part: &str| format!("inertia.parts = [{part}]\n");
    problems("a.toml", instead_of(METRIC)).mathematics(&[
        (
            "inertia.moments = [1, 2, 4]",
            &["a.toml:2:1", "no body has these moments, because 4 > 1 + 2"],
        ),
        ("inertia.moments = [1, 2, -2]", &["a principal moment is -2"]),
        ("inertia.matrix = [[1, 2, 0], [0, 1, 0], [0, 0, 1]]", &["not symmetric"]),
    ]);
    problems("a.toml", instead_of(METRIC)).usage(&[
        ("inertia.moments = [1, 2]", &["components instead of 3"]),
        ("metric = 'identity'\ninertia.moments = [1, 2, 2]", &["a.toml:3:1", "given twice"]),
        (
            "parameters = { mass = 1 }\ninertia.parts = [{ shape = 'ball', radius = 1, mass = 2 }]",
            &["a.toml:2:", "the name `mass` is already in use"],
        ),
        ("inertia.parts = []", &["all parts of the body are holes"]),
        (
            "inertia = { about = 'top', parts = [{ shape = 'ball', radius = 1, mass = 1 }] }",
            &["a.toml:2:", "`top` is not a point"],
        ),
        (
            "inertia = { about = [1, 2], parts = [{ shape = 'ball', radius = 1, mass = 1 }] }",
            &["the point has 2 components"],
        ),
        (
            "inertia = { about = 'centre', moments = [1, 1, 1] }",
            &["`about` is allowed with `parts` only"],
        ),
    ]);
    problems("a.toml", |text: &str| instead_of(METRIC)(&part(text))).usage(&[
        ("{ shape = 'torus', mass = 1 }", &["a.toml:2:", "not a known shape", "(radius, height)"]),
        ("{ shape = 'ball', edges = [1, 2, 3], mass = 1 }", &["do not fit the shape: give radius"]),
        (
            "{ shape = 'ball', radius = 1, height = 2, mass = 1 }",
            &["do not fit the shape: give radius"],
        ),
        ("{ shape = 'box', edges = [1, 2], mass = 1 }", &["a box has 2 components"]),
        ("{ shape = 'ball', radius = 1 }", &["a mass or a density"]),
        ("{ shape = 'ball', radius = 1, mass = 1, density = 1 }", &["a mass or a density"]),
        ("{ shape = 'points', points = [[1, 0, 0]] }", &["2 components instead of 3"]),
        (
            "{ shape = 'ball', radius = 1, mass = 1, hole = true }",
            &["all parts of the body are holes"],
        ),
        ("{ mesh = 'none.stl', density = 1 }", &["a.toml:2:", "cannot read"]),
        ("{ mesh = 'a.toml', density = 1 }", &["a.toml does not have the name of a mesh file"]),
        ("{ mass = 1 }", &["a part needs either a shape or a mesh"]),
        ("{ shape = 'ball', radius = 1, weight = 1 }", &["unknown key `weight`"]),
    ]);
    problems("a.toml", |text: &str| instead_of(METRIC)(&part(text))).mathematics(&[
("{ shape = 'ball', radius = 0, mass = 1 }", &["a.toml:2:", "a length is 0"]),
("{ shape = 'ball', radius = 1, mass = -1 }", &["the mass is -1"]),
("{ shape = 'ball', radius = 1e200, mass = 1 }", &["a.toml:2:"]),
("{ shape = 'rod', length = 1, mass = 1 }", &["a.toml:2:1", "a principal moment is 0"]),
("{ shape = 'points', points = [] }", &["there are no masses"]),
("{ shape = 'ball', radius = 1, mass = 1 }, { shape = 'ball', radius = 2, mass = 2, hole = true }", &["the remaining mass is -1"]),
]);
    let on_se2 = "space = 'se2'\ninertia.moments = [1, 1, 1]\noutput.end = 1\ninitial.velocity = [1, 2, 3]\n";
    problems("a.toml", str::to_string).usage(&[(on_se2, &["so(3) and se(3)"])]);
}

#[test]
fn files() {
    problems("a.toml", str::to_string).usage(&[("", &["a.toml is empty", "give a space"])]);
    let binary = Some(("a.toml", &b"\x00\xff\xfe\x01"[..]));
    let (arguments, says) = (&["simulate", "a.toml"], &["is not text: byte 2"]);
    refuse([Case { name: "binary", arguments, file: binary, input: b"", status: USAGE, says }]);
    commands(&["simulate"]).usage(&[("a.toml", &["cannot read a.toml"]), (".", &["cannot read"])]);
    // JSON files have the same keys
    let json = |rest: &str| {
        format!(r#"{{"space": "so3", "metric": "identity", {rest}, "output": {{"end": 1}}}}"#)
    };
    problems("a.json", json).usage(&[
        (r#""initial": {"velocity": [1, 2, "x"]}"#, &["a.json:1:", "`x` is not a known name here"]),
        (
            r#""parameters": {"a": 1, "a": 2}, "initial": {"velocity": [1, 2, 3]}"#,
            &["a.json:1:", "duplicate key `a`"],
        ),
    ]);
}

/// A motion with a prescribed velocity does not have an inertia.
#[test]
fn velocities_over_time_have_no_energy() {
    let given = "space = 'so3'\nintegrator.step = 0.1\nprescribed.velocity = [1, 't', 0]\n";
    let says = &["is not a known name here"];
    problems("a.toml", |output: &str| format!("{given}{output}")).usage(&[
        ("output = { end = 1, columns = ['t', 'H'] }", says),
        ("output = { end = 1 }\nquantities = { k = 'kinetic' }", says),
        ("output = { end = 1 }\nevents = { k = 'energy - 1' }", says),
    ]);
}
