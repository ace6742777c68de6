//! Forces, ensembles, flows and bodies of problems of motion that are none, and files that hold no problem.

use crate::bad_input::case::{Case, MATHEMATICS, USAGE, refuse};
use crate::bad_input::problems::{GOOD, METRIC, OUTPUT, refuse_problems};
use crate::program::run;
use tempfile::TempDir;

#[test]
fn forces() {
    refuse_problems(&[
        (
            "length",
            OUTPUT,
            "output.end = 1\nforces.body = [1, 2]\n",
            USAGE,
            &["a.toml:5:", "the force has 2 components, the dimension is 3"],
        ),
        (
            "more",
            OUTPUT,
            "output.end = 1\nforces.space = [1, 2, 3, 4]\n",
            USAGE,
            &["the force has 4 components"],
        ),
        (
            "a name",
            OUTPUT,
            "output.end = 1\nforces.body = [1, 'cos(wind)', 3]\n",
            USAGE,
            &["a.toml:5:23", "^^^^", "`wind` is no name here"],
        ),
        (
            "power",
            OUTPUT,
            "output.end = 1\nforces.body = [1, 'power', 3]\n",
            USAGE,
            &["`power` is no name here"],
        ),
        (
            "potential",
            OUTPUT,
            "output.end = 1\nforces.potential = 'H1^2'\n",
            USAGE,
            &["a.toml:5:21", "`H1` is no name here", "a potential is a formula"],
        ),
        (
            "no table",
            OUTPUT,
            "output.end = 1\nforces.table = 'none.csv'\n",
            USAGE,
            &["a.toml:5:", "cannot read"],
        ),
        (
            "a folder",
            OUTPUT,
            "output.end = 1\nforces.table = '.'\n",
            USAGE,
            &["a.toml:5:", "cannot read"],
        ),
        (
            "no table at all",
            OUTPUT,
            "output.end = 1\nforces.table_in = 'space'\n",
            USAGE,
            &["there is no table"],
        ),
        (
            "the side",
            OUTPUT,
            "output.end = 1\nforces.table = 'a'\nforces.table_in = 'mars'\n",
            USAGE,
            &["`mars` is neither body nor space"],
        ),
    ]);
}

/// It stops where a force is infinite, says which, and keeps the rows up to there.
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

/// A step that no one can wait for ends at once.
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
        ("t,M1,M2,M3\n0,1,2,3\n0,1,2,3\n", "increasing times"),
        ("t,M1,M2,M3\n1,1,2,3\n0,1,2,3\n", "increasing times"),
        ("t,M1,M2,M3\n", "none"),
        ("", "none"),
        ("t\n0\n", "rows of a time and"),
        ("t,M1,M2,M3\n0,1,2\n", "a row of 3 numbers stands below 4 names"),
        ("t,M1\n0,1\n", "the table has 1 components, the dimension is 3"),
        ("t,M1,M2,M3\n0,1,2,nan\n", "is no number"),
        ("t,M1,M2,M3\n0,1,2,wind\n", "is no number"),
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
    refuse_problems(&[
        (
            "no members",
            OUTPUT,
            "output.end = 1\nensemble.samples = 0\n",
            USAGE,
            &["a.toml:5:", "between 1 and"],
        ),
        (
            "many",
            OUTPUT,
            "output.end = 1\nensemble.samples = 10000000000\n",
            USAGE,
            &["between 1 and 1000000000 members"],
        ),
        (
            "a product",
            OUTPUT,
            "output.end = 1\n[ensemble]\nsamples = 1000000\ngrid.a = '0 .. 1 in 100000'\n",
            USAGE,
            &["between 1 and 1000000000 members"],
        ),
        ("negative", OUTPUT, "output.end = 1\nensemble.samples = -1\n", USAGE, &["a.toml:5:"]),
        (
            "no points",
            OUTPUT,
            "output.end = 1\nensemble.grid.a = '0 .. 1 in 0'\n",
            USAGE,
            &["a.toml:5:20", "at least one point"],
        ),
        (
            "empty",
            OUTPUT,
            "output.end = 1\nensemble.grid.a = ''\n",
            USAGE,
            &["a.toml:5:20", "a grid is"],
        ),
        (
            "endless",
            OUTPUT,
            "output.end = 1\nensemble.grid.a = '0 .. 1 in 4000000000'\n",
            USAGE,
            &["4000000000 points are too many"],
        ),
        (
            "a word",
            OUTPUT,
            "output.end = 1\nensemble.grid.a = 'one'\n",
            USAGE,
            &["a.toml:5:20", "`one` is no number"],
        ),
        (
            "a law",
            OUTPUT,
            "output.end = 1\nensemble.random.a = 'poisson(3)'\n",
            USAGE,
            &["a.toml:5:22", "neither normal(mean, deviation)"],
        ),
        (
            "one number",
            OUTPUT,
            "output.end = 1\nensemble.random.a = 'normal(3)'\n",
            USAGE,
            &["1 numbers stand here instead of 2"],
        ),
        (
            "a deviation",
            OUTPUT,
            "output.end = 1\nensemble.random.a = 'normal(3, -1)'\n",
            USAGE,
            &["a deviation is not negative"],
        ),
        (
            "twice",
            OUTPUT,
            "output.end = 1\nensemble = { grid = { a = '1' }, random = { a = 'uniform(0, 1)' } }\n",
            USAGE,
            &["`a` is varied twice"],
        ),
        (
            "a name",
            OUTPUT,
            "output.end = 1\nensemble.grid.t = '1'\n",
            USAGE,
            &["`t` has a meaning already"],
        ),
    ]);
    let file = Some(("a.toml", GOOD.as_bytes()));
    let arguments: &[&str] = &["simulate", "--ensemble", "a.toml"];
    let says = &["the problem defines no ensemble"];
    refuse([Case { name: "none", arguments, file, input: b"", status: USAGE, says }]);
}

#[test]
fn flows() {
    let flow = |lines: &str| format!("{lines}\nintegrator.step = 0.1\noutput.end = 1\n");
    for (name, lines, status, says) in [
        (
            "kind",
            "flow.kind = 'kdv'",
            USAGE,
            &["a.toml:1:14", "`kdv` is no flow", "toda, manakov, zeitlin"][..],
        ),
        ("nothing", "flow.kind = 'toda'", USAGE, &["needs positions and momenta"]),
        (
            "lengths",
            "flow = { kind = 'toda', positions = [0], momenta = [0, 1] }",
            MATHEMATICS,
            &["a.toml:1"],
        ),
        (
            "none",
            "flow = { kind = 'toda', positions = [], momenta = [] }",
            MATHEMATICS,
            &["a.toml:1"],
        ),
        (
            "masses",
            "flow = { kind = 'manakov', masses = [1, 2], momentum = [[0, 1, 2], [-1, 0, 3], [-2, -3, 0]] }",
            MATHEMATICS,
            &["a.toml:1"],
        ),
        (
            "symmetric",
            "flow = { kind = 'manakov', masses = [1, 2], momentum = [[0, 1], [1, 0]] }",
            MATHEMATICS,
            &["a.toml:1"],
        ),
        (
            "negative mass",
            "flow = { kind = 'manakov', masses = [1, -1], momentum = [[0, 1], [-1, 0]] }",
            MATHEMATICS,
            &["a.toml:1"],
        ),
        (
            "ragged",
            "flow = { kind = 'manakov', masses = [1, 2], momentum = [[0, 1], [1]] }",
            USAGE,
            &["different lengths"],
        ),
        (
            "size 0",
            "flow = { kind = 'zeitlin', size = 0, modes = [[1, 0, 1]] }",
            MATHEMATICS,
            &["a.toml:1"],
        ),
        (
            "huge",
            "flow = { kind = 'zeitlin', size = 100000000, seed = 1, degree = 2 }",
            MATHEMATICS,
            &["a.toml:1"],
        ),
        (
            "constraints",
            "constraints = ['g11']\nflow = { kind = 'zeitlin', size = 5, seed = 1, degree = 2 }",
            USAGE,
            &["has no `constraints`"],
        ),
        (
            "harmonic",
            "flow = { kind = 'zeitlin', size = 5, modes = [[1, 2, 1]] }",
            MATHEMATICS,
            &["a.toml:1"],
        ),
        (
            "mode",
            "flow = { kind = 'zeitlin', size = 5, modes = [[1, 2]] }",
            USAGE,
            &["a mode is [l, m, coefficient]"],
        ),
        (
            "half",
            "flow = { kind = 'zeitlin', size = 5, modes = [[0.5, 0, 1]] }",
            USAGE,
            &["no spherical harmonic"],
        ),
        (
            "degree",
            "flow = { kind = 'zeitlin', size = 5, seed = 1, degree = 9 }",
            MATHEMATICS,
            &["a.toml:1"],
        ),
        (
            "method",
            "integrator.method = 'rkmk4'\nflow = { kind = 'zeitlin', size = 5, seed = 1, degree = 2 }",
            MATHEMATICS,
            &["is not for flows", "isospectral2"],
        ),
        (
            "metric",
            "metric = 'identity'\nflow = { kind = 'zeitlin', size = 5, seed = 1, degree = 2 }",
            USAGE,
            &["a.toml:1:1", "a flow of matrices has no `metric`"],
        ),
        (
            "columns",
            "output.columns = ['t']\nflow = { kind = 'zeitlin', size = 5, seed = 1, degree = 2 }",
            USAGE,
            &["has no `columns`"],
        ),
    ] {
        refuse_problems(&[(name, GOOD, &flow(lines), status, says)]);
    }
    let without =
        "flow = { kind = 'toda', positions = [0, 0], momenta = [1, 2] }\noutput.end = 1\n";
    refuse_problems(&[(
        "no step",
        GOOD,
        without,
        MATHEMATICS,
        &["a flow of matrices needs a step"],
    )]);
}

#[test]
fn given_velocities() {
    let given = |lines: &str| format!("space = 'so3'\n{lines}\noutput.end = 1\n");
    for (name, lines, status, says) in [
        ("no step", "given.velocity = [1, 2, 3]", MATHEMATICS, &["needs a step"][..]),
        (
            "length",
            "integrator.step = 0.1\ngiven.velocity = [1, 2]",
            USAGE,
            &["a.toml:3:", "2 components, the dimension is 3"],
        ),
        (
            "both",
            "given = { velocity = [1, 2, 3], space_velocity = [1, 2, 3] }",
            USAGE,
            &["give one of velocity"],
        ),
        (
            "side",
            "integrator.step = 0.1\ngiven.space_velocity = [1, 2, 3]",
            USAGE,
            &["with invariance = \"right\""],
        ),
        (
            "a name",
            "integrator.step = 0.1\ngiven.velocity = [1, 'H1', 3]",
            USAGE,
            &["a.toml:3:", "`H1` is no name here"],
        ),
        (
            "a metric",
            "metric = 'identity'\nintegrator.step = 0.1\ngiven.velocity = [1, 2, 3]",
            USAGE,
            &["a velocity given over time has no `metric`"],
        ),
        (
            "a start",
            "initial.momentum = [1, 2, 3]\nintegrator.step = 0.1\ngiven.velocity = [1, 2, 3]",
            USAGE,
            &["has no `momentum`"],
        ),
        (
            "forces",
            "forces.body = [1, 2, 3]\nintegrator.step = 0.1\ngiven.velocity = [1, 2, 3]",
            USAGE,
            &["has no `forces`"],
        ),
    ] {
        refuse_problems(&[(name, GOOD, &given(lines), status, says)]);
    }
}

#[test]
fn bodies() {
    let part = |part: &str| format!("inertia.parts = [{part}]\n");
    for (name, line, status, says) in [
        (
            "moments",
            "inertia.moments = [1, 2, 4]\n",
            MATHEMATICS,
            &["a.toml:2:1", "no masses have them, as 4 > 1 + 2"][..],
        ),
        ("negative", "inertia.moments = [1, 2, -2]\n", MATHEMATICS, &["-2 is a principal moment"]),
        ("two", "inertia.moments = [1, 2]\n", USAGE, &["components instead of 3"]),
        (
            "matrix",
            "inertia.matrix = [[1, 2, 0], [0, 1, 0], [0, 0, 1]]\n",
            MATHEMATICS,
            &["off symmetric"],
        ),
        (
            "both",
            "metric = 'identity'\ninertia.moments = [1, 2, 2]\n",
            USAGE,
            &["a.toml:3:1", "the metric is given twice"],
        ),
        (
            "a parameter mass",
            "parameters = { mass = 1 }\ninertia.parts = [{ shape = 'ball', radius = 1, mass = 2 }]\n",
            USAGE,
            &["a.toml:2:", "`mass` has a meaning already"],
        ),
        ("no parts", "inertia.parts = []\n", USAGE, &["the body has no part but holes"]),
        (
            "about",
            "inertia = { about = 'top', parts = [{ shape = 'ball', radius = 1, mass = 1 }] }\n",
            USAGE,
            &["a.toml:2:", "`top` is no point"],
        ),
        (
            "about numbers",
            "inertia = { about = [1, 2], parts = [{ shape = 'ball', radius = 1, mass = 1 }] }\n",
            USAGE,
            &["the point has 2 components"],
        ),
        (
            "about moments",
            "inertia = { about = 'centre', moments = [1, 1, 1] }\n",
            USAGE,
            &["a point goes with parts"],
        ),
    ] {
        refuse_problems(&[(name, METRIC, line, status, says)]);
    }
    for (name, line, status, says) in [
        (
            "shape",
            "{ shape = 'torus', mass = 1 }",
            USAGE,
            &["a.toml:2:", "`torus` is no shape", "cylinder (radius, height)"][..],
        ),
        (
            "sizes",
            "{ shape = 'ball', edges = [1, 2, 3], mass = 1 }",
            USAGE,
            &["the part has radius"],
        ),
        (
            "more sizes",
            "{ shape = 'ball', radius = 1, height = 2, mass = 1 }",
            USAGE,
            &["the part has radius"],
        ),
        (
            "edges",
            "{ shape = 'box', edges = [1, 2], mass = 1 }",
            USAGE,
            &["a box has 2 components"],
        ),
        ("no mass", "{ shape = 'ball', radius = 1 }", USAGE, &["a mass or a density"]),
        (
            "both",
            "{ shape = 'ball', radius = 1, mass = 1, density = 1 }",
            USAGE,
            &["a mass or a density"],
        ),
        (
            "radius",
            "{ shape = 'ball', radius = 0, mass = 1 }",
            MATHEMATICS,
            &["a.toml:2:", "a length is 0"],
        ),
        ("mass", "{ shape = 'ball', radius = 1, mass = -1 }", MATHEMATICS, &["the mass is -1"]),
        ("overflow", "{ shape = 'ball', radius = 1e200, mass = 1 }", MATHEMATICS, &["a.toml:2:"]),
        (
            "a line",
            "{ shape = 'rod', length = 1, mass = 1 }",
            MATHEMATICS,
            &["a.toml:2:1", "0 is a principal moment"],
        ),
        (
            "a point",
            "{ shape = 'points', points = [[1, 0, 0]] }",
            USAGE,
            &["2 components instead of 3"],
        ),
        ("no points", "{ shape = 'points', points = [] }", MATHEMATICS, &["there are no masses"]),
        (
            "a hole",
            "{ shape = 'ball', radius = 1, mass = 1 }, { shape = 'ball', radius = 2, mass = 2, hole = true }",
            MATHEMATICS,
            &["the mass left is -1"],
        ),
        (
            "only holes",
            "{ shape = 'ball', radius = 1, mass = 1, hole = true }",
            USAGE,
            &["no part but holes"],
        ),
        ("mesh", "{ mesh = 'none.stl', density = 1 }", USAGE, &["a.toml:2:", "cannot read"]),
        ("no mesh", "{ mesh = 'a.toml', density = 1 }", USAGE, &["a.toml is no mesh by its name"]),
        ("nothing", "{ mass = 1 }", USAGE, &["a part has a shape or a mesh"]),
        ("a key", "{ shape = 'ball', radius = 1, weight = 1 }", USAGE, &["unknown key `weight`"]),
    ] {
        refuse_problems(&[(name, METRIC, &part(line), status, says)]);
    }
    let on_se2 = "space = 'se2'\ninertia.moments = [1, 1, 1]\noutput.end = 1\ninitial.velocity = [1, 2, 3]\n";
    refuse_problems(&[("on se(2)", GOOD, on_se2, USAGE, &["so(3) and se(3)"])]);
}

#[test]
fn files() {
    let case = |name, file, input, says| Case {
        name,
        arguments: &["simulate", "a.toml"],
        file,
        input,
        status: USAGE,
        says,
    };
    refuse([
        case(
            "empty",
            Some(("a.toml", &b""[..])),
            b"",
            &["a.toml is empty", "a problem has a space"],
        ),
        case("binary", Some(("a.toml", &b"\x00\xff\xfe\x01"[..])), b"", &["is not text: byte 2"]),
        case("none", None, b"", &["cannot read a.toml"]),
    ]);
    let says = &["cannot read"];
    let arguments = &["simulate", "."];
    refuse([Case { name: "a folder", arguments, file: None, input: b"", status: USAGE, says }]);
    // JSON has the same keys
    let json = br#"{"space": "so3", "metric": "identity", "initial": {"velocity": [1, 2, "x"]}, "output": {"end": 1}}"#;
    let says = &["a.json:1:", "`x` is no name here"];
    let arguments = &["simulate", "a.json"];
    let file = Some(("a.json", &json[..]));
    refuse([Case { name: "JSON", arguments, file, input: b"", status: USAGE, says }]);
    let json = br#"{"space": "so3", "metric": "identity", "parameters": {"a": 1, "a": 2}, "initial": {"velocity": [1, 2, 3]}, "output": {"end": 1}}"#;
    let file = Some(("a.json", &json[..]));
    let says = &["a.json:1:", "duplicate key `a`"];
    refuse([Case { name: "twice", arguments, file, input: b"", status: USAGE, says }]);
}

/// A velocity over time has no inertia.
#[test]
fn velocities_over_time_have_no_energy() {
    let given = "space = 'so3'\nintegrator.step = 0.1\ngiven.velocity = [1, 't', 0]\n";
    let cases = [
        ("columns", "output = { end = 1, columns = ['t', 'H'] }"),
        ("quantities", "output = { end = 1 }\nquantities = { k = 'kinetic' }"),
        ("events", "output = { end = 1 }\nevents = { k = 'energy - 1' }"),
    ];
    let texts = cases.map(|(name, output)| (name, format!("{given}{output}")));
    refuse(texts.iter().map(|(name, text)| Case {
        name,
        arguments: &["simulate", "a.toml"],
        file: Some(("a.toml", text.as_bytes())),
        input: b"",
        status: USAGE,
        says: &["is no name here"],
    }));
}
