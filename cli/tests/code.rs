//! Tensors as generated programs: compiled, run, and compared with the exact tensors at rational
//! points.

mod accuracy;
mod pivots;

use crate::common::root;
use crate::compiled::{self, run_numpy};
use crate::program::{self, definition, stdout};
use affinor_documents::Coefficient;
use affinor_documents::report::{Language, Quantity};
use affinor_documents::space::{Request, Space};
use affinor_tensors::{Notation, Rational, Symbolic, Tensor, Tolerance};
use std::collections::BTreeMap;

/// A full symmetric matrix of symbols `J11`, `J12`, ..., as an option.
fn full(n: usize) -> String {
    let entry = |i: usize, j: usize| format!("J{}{}", i.min(j), i.max(j));
    let row = |i| (1..=n).map(|j| entry(i, j)).collect::<Vec<_>>().join(",");
    format!("[{}]", (1..=n).map(|i| format!("[{}]", row(i))).collect::<Vec<_>>().join(","))
}

/// A rational number for a name and a draw. The metric is diagonally dominant.
fn number(name: &str, draw: i64) -> Rational {
    let hash = name.bytes().fold(draw * 7 + 3, |hash, byte| (hash * 31 + i64::from(byte)) % 1009);
    let digits = name.trim_start_matches(|c: char| !c.is_ascii_digit()).as_bytes();
    let diagonal = digits.len() == 2 && digits[0] == digits[1];
    Rational::new(hash % 41 - 20 + if diagonal { 200 } else { 0 }, hash % 7 + 1).unwrap()
}

/// A space with options: a connection, a metric, and values of parameters.
fn open(space: &str, [connection, metric]: [&str; 2], set: Option<String>) -> Space {
    let option = |text: &str| Some(text.to_string()).filter(|text| !text.is_empty());
    let (connection, metric) = (option(connection), option(metric));
    let space = Some(space.to_string());
    Space::open(&Request { space, connection, metric, set, ..Request::default() }).unwrap()
}

/// All components of a tensor, zeros included; the last index changes first.
fn dense<S: Coefficient>(tensor: &Tensor<S>, n: usize, value: impl Fn(&S) -> f64) -> Vec<f64> {
    let mut all = vec![0.0; n.pow(tensor.slots().len() as u32)];
    for (at, component) in tensor.components() {
        all[at.iter().fold(0, |place, i| place * n + i)] = value(component);
    }
    all
}

/// The source code of tensors, with more options.
fn code(space: &str, options: [&str; 2], show: &str, language: Language, more: &[&str]) -> String {
    let mut arguments = vec!["table", space, "--show", show, "--code", language.name()];
    for (name, value) in ["--connection", "--metric"].into_iter().zip(options) {
        if !value.is_empty() {
            arguments.extend([name, value]);
        }
    }
    stdout(root(), &[&arguments, more].concat())
}

fn close(found: &[f64], expected: &[f64], source: &str) {
    assert_eq!(found.len(), expected.len());
    let size = expected.iter().fold(1.0, |size: f64, x| size.max(x.abs()));
    for (at, (found, expected)) in found.iter().zip(expected).enumerate() {
        assert!((found - expected).abs() <= 1e-11 * size, "{at}: {found} {expected}\n{source}");
    }
}

/// Spaces, connections, metrics and tensors.
fn cases() -> Vec<(String, &'static str, String, &'static str)> {
    let all = "structure,affinities,torsion,curvature,ricci,scalar_curvature,metric,inverse_metric,\
               nonmetricity,killing,einstein,kretschmann,ricci_antisymmetric";
    vec![
        ("so(3)".into(), "", full(3), all),
        ("so(3)".into(), "", "diag(J1,J2,J3)".into(), "nabla_curvature"),
        ("sl(2)".into(), "lambda=h/3", full(3), all),
        ("heisenberg(3)".into(), "levi-civita", full(3), "curvature,schouten,cotton,weyl"),
        ("aff(1)".into(), "minus", full(2), all),
        ("se(3)".into(), "", full(6), "curvature,ricci,scalar_curvature"),
        ("so(4)".into(), "", full(6), "scalar_curvature"),
        // a metric without a nonzero diagonal entry for a pivot
        ("so(3)".into(), "", "[[0,J12,0],[J12,0,1],[0,1,J33]]".into(), "curvature,inverse_metric"),
        (
            definition("affinities.toml"),
            "",
            full(3),
            "affinities,torsion,curvature,ricci,nonmetricity",
        ),
        (definition("bianchi_vi_h.toml"), "", full(3), "curvature,torsion"),
    ]
}

#[test]
fn tensors_as_programs_give_the_exact_values() {
    let folder = tempfile::tempdir().unwrap();
    for (space, connection, metric, show) in cases() {
        let options = [connection, metric.as_str()];
        let symbolic = open(&space, options, None);
        let parameters = symbolic.definition.parameters();
        for draw in 0..2 {
            let set: Vec<String> =
                parameters.iter().map(|name| format!("{name}={}", number(name, draw))).collect();
            let set = Some(set.join(",")).filter(|set| !set.is_empty());
            let exact = open(&space, options, set);
            let geometry = exact.definition.geometry::<Rational>(Tolerance::default()).unwrap();
            let n = geometry.frame().dimension();
            let (mut expected, mut shapes) = (vec![], vec![]);
            for key in show.split(',') {
                let quantity = Quantity::from_key(key.trim()).unwrap();
                if let Some(tensor) = quantity.of(&geometry).unwrap() {
                    expected.extend(dense(&tensor, n, Rational::to_f64));
                    shapes.push(vec![n; quantity.slots().len()]);
                }
            }
            for language in Language::ALL {
                // rustc is slow on a large function
                if language == Language::Rust && (n > 3 || draw > 0) {
                    continue;
                }
                let source = code(&space, options, show, language, &[]);
                let value = |name: &str| number(name, draw).to_f64();
                let found = compiled::run(folder.path(), language, &source, &[], &value, &shapes);
                if let Some(found) = found {
                    close(&found, &expected, &source);
                }
            }
        }
    }
}

/// Greek parameters become arguments with Latin names, which differ from the other arguments.
#[test]
fn greek_parameters_as_programs() {
    let folder = tempfile::tempdir().unwrap();
    let options = ["", "diag(\u{3b8}, theta, \u{3c9}_1 + \u{e9})"];
    let show = "ricci,scalar_curvature";
    let set = "\u{3b8}=2,theta=3,\u{3c9}_1=5,\u{e9}=7/2";
    let exact = open("so(3)", options, Some(set.into()));
    let geometry = exact.definition.geometry::<Rational>(Tolerance::default()).unwrap();
    let (mut expected, mut shapes) = (vec![], vec![]);
    for quantity in [Quantity::Ricci, Quantity::ScalarCurvature] {
        let tensor = quantity.of(&geometry).unwrap().unwrap();
        expected.extend(dense(&tensor, 3, Rational::to_f64));
        shapes.push(vec![3; quantity.slots().len()]);
    }
    let value = |name: &str| match name {
        "theta_2" => 2.0,
        "theta" => 3.0,
        "omega_1" => 5.0,
        "uE9" => 3.5,
        other => panic!("{other}"),
    };
    for language in Language::ALL {
        let source = code("so(3)", options, show, language, &[]);
        assert!(source.contains("p_theta_2 is \u{3b8}"), "{source}");
        if let Some(found) = compiled::run(folder.path(), language, &source, &[], &value, &shapes) {
            close(&found, &expected, &source);
        }
    }
}

/// Programs of functions on a chart agree with the rational functions at a point.
#[test]
fn charts_as_programs() {
    let folder = tempfile::tempdir().unwrap();
    // products, multiples of angles, roots and logarithms
    let products = folder.path().join("products.toml");
    let text = "parameters = ['a']\nmetric = 'diag(exp(2*r), cos(a*r/2)^2 + log(r)^2*sqrt(y))'\n\
                chart = {coordinates = ['r', 'y'], positive = ['r', 'y']}\n";
    std::fs::write(&products, text).unwrap();
    for (space, point) in [
        (definition("sphere.toml"), &[0.7, 0.3][..]),
        (definition("schwarzschild.toml"), &[0.4, 9.5, 1.1, 0.2]),
        ("schwarzschild-observers".into(), &[0.4, 9.5, 1.1, 0.2]),
        ("3-sphere".into(), &[0.8, 0.1, 0.3]),
        (definition("expanding_universe.toml"), &[2.5, 0.6, 1.1, 0.2]),
        (products.to_str().unwrap().into(), &[0.7, 0.4]),
    ] {
        let opened = open(&space, ["", ""], None);
        let geometry = opened.definition.geometry::<Symbolic>(Tolerance::default()).unwrap();
        let coordinates = opened.definition.coordinates().to_vec();
        let parameter = |_: &str| 1.25;
        let lookup = |name: &str| {
            let at = coordinates.iter().position(|own| own == name);
            Some(at.map_or_else(|| parameter(name), |at| point[at]))
        };
        let n = geometry.frame().dimension();
        let (mut expected, mut shapes) = (vec![], vec![]);
        for quantity in [Quantity::Affinities, Quantity::Curvature, Quantity::Kretschmann] {
            let tensor = quantity.of(&geometry).unwrap().unwrap();
            expected.extend(dense(&tensor, n, |value| value.evaluate(lookup).unwrap()));
            shapes.push(vec![n; quantity.slots().len()]);
        }
        let by = coordinates.iter().find(|name| ["theta", "r"].contains(&name.as_str())).unwrap();
        let kretschmann = Quantity::Kretschmann.of(&geometry).unwrap().unwrap();
        let rate = kretschmann.to_scalar().unwrap().derivative(by);
        for language in Language::ALL {
            let show = "affinities,curvature,kretschmann";
            let source = code(&space, ["", ""], show, language, &[]);
            let found =
                compiled::run(folder.path(), language, &source, &[point], &parameter, &shapes);
            if let Some(found) = found {
                close(&found, &expected, &source);
            }
            let more = ["--derivatives", by.as_str()];
            let source = code(&space, ["", ""], "kretschmann", language, &more);
            let shapes = [vec![], vec![1]];
            let found =
                compiled::run(folder.path(), language, &source, &[point], &parameter, &shapes);
            if let Some(found) = found {
                close(&found[1..], &[rate.evaluate(lookup).unwrap()], &source);
            }
        }
    }
}

/// Derivatives by parameters agree with the derivatives of the rational functions.
#[test]
fn derivatives_are_those_of_the_formulas() {
    let folder = tempfile::tempdir().unwrap();
    let metric = full(3);
    let space = open("so(3)", ["", &metric], None);
    let geometry = space.definition.geometry::<Symbolic>(Tolerance::default()).unwrap();
    let ricci = Quantity::Ricci.of(&geometry).unwrap().unwrap();
    let set: BTreeMap<String, Symbolic> = (space.definition.parameters().into_iter())
        .map(|name| (name.clone(), Symbolic::constant(number(&name, 5))))
        .collect();
    let value = |value: &Symbolic| value.substitute(&set).unwrap().to_f64().unwrap();
    let mut expected = dense(&ricci, 3, value);
    for name in ["J23", "J11"] {
        expected.extend(dense(&ricci.map(|v| v.derivative(name)), 3, value));
    }
    for language in Language::ALL {
        let more = ["--derivatives", "J23,J11"];
        let source = code("so(3)", ["", &metric], "ricci", language, &more);
        let value = |name: &str| number(name, 5).to_f64();
        let shapes = [vec![3, 3], vec![2, 3, 3]];
        let found = compiled::run(folder.path(), language, &source, &[], &value, &shapes);
        if let Some(found) = found {
            close(&found, &expected, &source);
        }
    }
}

/// The statements of a C function: the names or components on the left, and the right sides.
fn statements(source: &str) -> Vec<(String, String)> {
    let body = source.split_once("\n{\n").unwrap().1;
    let pairs = body.split(';').filter_map(|line| line.split_once(" = "));
    pairs.map(|(left, right)| (left.trim().replace("const double ", ""), right.into())).collect()
}

/// No right side is computed twice, every variable is used, and abelian summands add no code.
#[test]
fn every_value_is_computed_once() {
    let metric = full(3);
    let alone = code("so(3)", ["", &metric], "curvature", Language::C, &[]);
    let temporaries: Vec<_> =
        statements(&alone).into_iter().filter(|(left, _)| left.starts_with('t')).collect();
    assert!(temporaries.len() > 50, "{alone}");
    for (at, (name, right)) in temporaries.iter().enumerate() {
        assert!(temporaries[..at].iter().all(|(_, other)| other != right), "{right}\n{alone}");
        let word = |text: &str| text.split(|c: char| !c.is_alphanumeric()).any(|w| w == name);
        assert!(statements(&alone).iter().any(|(_, right)| word(right)), "{name}\n{alone}");
    }
    let rows = metric.replace("],[", ",0,0],[").replace("]]", ",0,0],[0,0,0,1,0],[0,0,0,0,1]]");
    let beside = code("so(3)+R^2", ["", &rows], "curvature", Language::C, &[]);
    assert_eq!(statements(&alone), statements(&beside));
}

/// Python functions accept arrays that broadcast; the indices are the last axes.
#[test]
fn python_broadcasts() {
    let folder = tempfile::tempdir().unwrap();
    let source = code("so(3)", ["", "diag(J1,J2,J3)"], "ricci", Language::Python, &[]);
    let equations = ["equations", "so(3)", "--metric", "diag(J1,J2,J3)", "--code", "python"];
    let motion = stdout(root(), &equations);
    let main = format!(
        "{source}\n{motion}\nJ1 = np.linspace(1, 2, 5)[:, None]\nJ2 = np.array([2.0, 3.0])\n\
         all = ricci(J1, J2, 1.5)\nassert all.shape == (5, 2, 3, 3)\nfor i in range(5):\n    \
         for j in range(2):\n        assert (all[i, j] == ricci(J1[i, 0], J2[j], 1.5)).all()\n\
         omega = np.ones((4, 1, 3)) * [1, 2, 3]\nrate = euler_poincare(omega, [0, 0, 0], 1, J2, 3)\n\
         assert rate.shape == (4, 2, 3)\nassert (rate[2, 1] == euler_poincare([1, 2, 3], [0, 0, 0], \
         1, 3, 3)).all()\nprint('done')\n"
    );
    if let Some(out) = run_numpy(folder.path(), &main) {
        assert_eq!(out, "done\n");
    }
}

/// The source code in every language.
#[test]
fn programs_in_every_language() {
    let mut settings = insta::Settings::clone_current();
    settings.set_snapshot_path("../../snapshots");
    settings.set_prepend_module_to_snapshot(false);
    settings.bind(|| {
        for language in Language::ALL {
            let metric = "[[J11,J12,0],[J12,J22,0],[0,0,1/3]]";
            let show = "torsion,ricci,scalar_curvature";
            let options = ["zero", metric];
            let tensors = code("so(3)", options, show, language, &["--derivatives", "J12"]);
            let sphere = definition("sphere.toml");
            let arguments = ["equations", &sphere, "--kind", "autoparallel", "--code"];
            let motion = stdout(root(), &[&arguments[..], &[language.name()]].concat());
            let name = format!("program_{}", language.name());
            insta::assert_snapshot!(name, format!("{tensors}\n{motion}"));
        }
    });
}

/// Derivatives by a declared parameter on which no component depends vanish.
#[test]
fn derivatives_by_a_parameter_on_which_nothing_depends() {
    let folder = tempfile::tempdir().unwrap();
    let definition = "basis = [\"x\", \"y\"]\nparameters = [\"m\"]\nbrackets = \"[x, y] = y\"\nmetric = \"identity\"\n";
    std::fs::write(folder.path().join("a.toml"), definition).unwrap();
    let space = folder.path().join("a.toml").display().to_string();
    for language in Language::ALL {
        let source = code(&space, ["", ""], "ricci", language, &["--derivatives", "m"]);
        let shapes = [vec![2, 2], vec![1, 2, 2]];
        let found = compiled::run(folder.path(), language, &source, &[], &|_| 3.0, &shapes);
        if let Some(found) = found {
            close(&found, &[-1.0, 0.0, 0.0, -1.0, 0.0, 0.0, 0.0, 0.0], &source);
        }
    }
}

#[test]
fn refusals_of_programs() {
    let so3 = ["table", "so3", "--metric", "diag(J1,1,1)"];
    for (arguments, status, message) in [
        (&["--code", "fortran"][..], 2, "the languages are rust, c, python"),
        (&["--code", "c", "--format", "csv"], 2, "cannot be used with"),
        (&["--code", "c", "--independent"], 2, "leave --independent out"),
        (&["--code", "c", "--scalar", "float"], 2, "leave --scalar float out"),
        (&["--derivatives", "J1"], 2, "--code"),
        (&["--code", "c", "--derivatives", "K"], 2, "there is no parameter `K`"),
        (&["--code", "c", "--derivatives", "J1,J1"], 2, "names J1 twice"),
        (
            &["--code", "c", "--show", "weyl", "--connection", "plus"],
            2,
            "not defined for this space: weyl",
        ),
        (&["--code", "c", "--set", "J1=0"], 1, "degenerate"),
        (
            &["--code", "c", "--set", "J1=1e400", "--show", "metric"],
            2,
            "beyond the range of floats",
        ),
    ] {
        let outcome = program::run(root(), &[&so3[..], arguments].concat(), b"");
        assert_eq!(outcome.status, status, "{arguments:?}: {outcome:?}");
        assert!(outcome.err.contains(message), "{arguments:?}: {}", outcome.err);
        assert_eq!(outcome.out, "");
    }
    let outcome = program::run(root(), &["table", "E8", "--show", "curvature", "--code", "c"], b"");
    assert_eq!(outcome.status, 2);
    assert!(outcome.err.contains("curvature has 248^4 components"), "{}", outcome.err);
    // a mathematical error is reported with its witness, also with parameters
    let broken = ["table", "--basis", "x y z", "--bracket", "[x,y]=a*z; [x,z]=b*x", "--code", "c"];
    let outcome = program::run(root(), &broken, b"");
    assert_eq!(outcome.status, 1, "{outcome:?}");
    assert!(outcome.err.contains("Jacobi"), "{}", outcome.err);
    // degenerate because of an identity between parameters
    let metric = "[[a^2,a*b,0],[a*b,b^2,0],[0,0,1]]";
    let outcome = program::run(root(), &["table", "so3", "--metric", metric, "--code", "c"], b"");
    assert_eq!(outcome.status, 1, "{outcome:?}");
    assert!(outcome.err.contains("degenerate"), "{}", outcome.err);
}
