//! Printed equations of motion, and their generated code compared with the library.

use crate::common::algebras::seeds;
use crate::common::integer;
use crate::compiled;
use crate::program::{self, definition, root, stdout};
use affinor::geometry::equations::{EquationKind, Equations};
use affinor::{CanonicalConnection, ConnectionKind, Geometry, LieAlgebra, Metric};
use affinor_documents::Coefficient;
use affinor_documents::report::{EquationReport, Format, Language, Report};
use affinor_tensors::{Down, Notation, Rational, Recorded, Symbolic, Tensor};

fn seed(name: &str) -> LieAlgebra<Rational> {
    seeds().into_iter().find(|(other, _)| *other == name).unwrap().1
}

fn metric<S: Coefficient>(algebra: &LieAlgebra<S>, rows: &[Vec<S>]) -> Metric<S> {
    let n = algebra.dimension();
    let tensor = Tensor::from_fn(n, [Down, Down], |[i, j]| rows[i][j].clone()).unwrap();
    Metric::new(algebra.labels(), tensor).unwrap()
}

/// A family with awkward parameter names (reserved words) and a full metric.
fn awkward<S: Coefficient>() -> Geometry<S> {
    let [a, b] = ["lambda", "int"].map(|name| S::parameter(name).unwrap());
    let bracket = affinor::Bracket::from_fn(&["x", "y", "z"], |j, k| match (j, k) {
        (0, 2) => {
            vec![(0, a.clone()), (1, S::from_rational(&crate::common::fraction(-2, 3)).unwrap())]
        }
        (1, 2) => vec![(1, b.clone())],
        _ => vec![],
    });
    let algebra = LieAlgebra::try_from(bracket.unwrap()).unwrap();
    let constant = |n: i64| S::from_rational(&integer(n)).unwrap();
    let rows = vec![
        vec![constant(4) + &(a.clone() * &a), b.clone(), constant(1)],
        vec![b, constant(5), constant(-1)],
        vec![constant(1), constant(-1), a],
    ];
    let metric = metric(&algebra, &rows);
    let plus = ConnectionKind::Canonical(CanonicalConnection::Plus);
    Geometry::new("awkward", algebra, plus, Some(metric)).unwrap()
}

#[test]
fn generated_code_gives_the_same_numbers() {
    let folder = tempfile::tempdir().unwrap();
    let (geometry, recorded) = (awkward::<Symbolic>(), awkward::<Recorded>());
    let values = [("int", 1.75), ("lambda", 2.5)];
    let (state, other) = ([0.3, -1.1, 0.7], [0.2, 0.5, -0.9]);
    for motion in EquationKind::ALL {
        let equations = Equations::new(motion, geometry.connection(), geometry.metric()).unwrap();
        let constant = |x: f64| Symbolic::constant(Rational::from_f64(x).unwrap());
        let beside: &[f64] = if motion == EquationKind::Autoparallel { &[] } else { &other };
        let exact = equations
            .rate(&state.map(constant), &beside.iter().map(|x| constant(*x)).collect::<Vec<_>>());
        let exact = exact.unwrap();
        let set = values.map(|(name, x)| (name.to_string(), constant(x))).into();
        // the rates, then their derivatives by both parameters
        let by = values.map(|(name, _)| name.to_string());
        let derivatives = by.iter().flat_map(|name| exact.iter().map(|rate| rate.derivative(name)));
        let expected: Vec<f64> = (exact.iter().cloned().chain(derivatives))
            .map(|rate| rate.substitute(&set).unwrap().to_f64().unwrap())
            .collect();
        let equations = Equations::new(motion, recorded.connection(), recorded.metric()).unwrap();
        let system = EquationReport::new(equations, &recorded);
        for language in Language::ALL {
            let code = system.code(language, &by).unwrap();
            let vectors = [&state[..], beside];
            let vectors = if beside.is_empty() { &vectors[..1] } else { &vectors };
            let value = |name: &str| values.iter().find(|(own, _)| *own == name).unwrap().1;
            let shapes = [vec![3], vec![2, 3]];
            let Some(rates) =
                compiled::run(folder.path(), language, &code, vectors, &value, &shapes)
            else {
                continue;
            };
            assert_eq!(rates.len(), expected.len());
            for (rate, expected) in rates.iter().zip(&expected) {
                assert!((rate - expected).abs() <= 1e-12 * (1.0 + expected.abs()), "{code}");
            }
        }
    }
}

/// The output of `affinor equations`.
fn printed(arguments: &[&str]) -> String {
    stdout(root(), &[&["equations"], arguments].concat())
}

/// Great circles: `theta'' = sin theta cos theta phi'^2`, `phi'' = -2 cot theta theta' phi'`.
#[test]
fn geodesics_of_the_sphere_in_coordinates() {
    let sphere = &definition("sphere.toml");
    let folder = tempfile::tempdir().unwrap();
    let (theta, v) = (0.7f64, [0.4, -1.2]);
    let expected =
        [v[0], v[1], theta.sin() * theta.cos() * v[1] * v[1], -2.0 / theta.tan() * v[0] * v[1]];
    let vectors: [&[f64]; 2] = [&[theta, 0.3], &v];
    for language in Language::ALL {
        let code = printed(&[sphere, "--kind", "autoparallel", "--code", language.name()]);
        let no_parameter = |name: &str| panic!("{name}: the radius cancels");
        let Some(rates) =
            compiled::run(folder.path(), language, &code, &vectors, &no_parameter, &[vec![4]])
        else {
            continue;
        };
        for (rate, expected) in rates.iter().zip(expected) {
            assert!((rate - expected).abs() < 1e-14, "{rates:?}\n{code}");
        }
    }
}

#[test]
fn rows_of_a_csv_are_named_by_coordinate_or_number() {
    let sphere = &definition("sphere.toml");
    let csv = printed(&[sphere, "--kind", "autoparallel", "--format", "csv"]);
    let names: Vec<_> = csv.lines().map(|line| line.split(',').next().unwrap()).collect();
    assert_eq!(names, ["equation", "theta", "phi", "1", "1", "2", "2"], "{csv}");
}

/// The kinematics of the Euler angles z-x-z (Goldstein, Classical Mechanics, 4-87, solved for the
/// rates), and the error for a metric that varies.
#[test]
fn kinematics_of_euler_angles() {
    let text = printed(&["euler-angles", "--metric", "diag(1,2,3)", "--connection", "plus"]);
    for line in [
        "dphi/dt = sin(psi)/sin(theta)*Omega1 + cos(psi)/sin(theta)*Omega2\n",
        "dtheta/dt = cos(psi)*Omega1 - sin(psi)*Omega2\n",
        "dOmega1/dt = -Omega2*Omega3 + M1\n",
    ] {
        assert!(text.contains(line), "{text}");
    }
    let orbits = ["--kind", "autoparallel", "--format", "latex"];
    let orbits = printed(&[&[definition("schwarzschild.toml").as_str()], &orbits[..]].concat());
    let sine = "- \\sin^{2} \\theta \\, \\left(2 M - r\\right) (v^{4})^2";
    assert!(orbits.contains(sine), "{orbits}");
    let refused = program::run(root(), &["equations", &definition("sphere.toml")], b"");
    assert_eq!(refused.status, 1);
    assert!(refused.err.contains("need a metric with constant components"), "{}", refused.err);
}

/// In a moving frame the Euler-Poincare equations are the equations of Boltzmann and Hamel, with
/// structure functions. Another connection gives different equations.
#[test]
fn moving_frames_tell_other_connections_apart() {
    let folder = tempfile::tempdir().unwrap();
    let frame = "[chart]\ncoordinates = ['theta', 'phi']\n[frame]\ne1 = 'd_theta'\n\
                 e2 = '1/sin(theta)*d_phi'\n[metric]\ncomponents = 'identity'\n[connection]\n";
    for (connection, title) in [
        ("kind = 'levi-civita'", "Euler-Poincare equations of"),
        ("affinities = 'nabla[e1, e2] = e1'", "DH/Dt = M (not the Euler-Poincare equations) of"),
    ] {
        let path = folder.path().join("sphere.toml");
        std::fs::write(&path, format!("name = 'sphere'\n{frame}{connection}\n")).unwrap();
        let text = printed(&[path.to_str().unwrap()]);
        assert!(text.starts_with(title), "{text}");
    }
}

#[test]
fn names_do_not_meet_parameters() {
    let so3 = seed("so(3)").map(|v| Symbolic::constant(v.clone())).unwrap();
    let symbols = ["M1", "Omega2", "c"].map(Symbolic::parameter);
    let rows: Vec<Vec<Symbolic>> = (0..3)
        .map(|i| (0..3).map(|j| if i == j { symbols[i].clone() } else { zero() }).collect())
        .collect();
    let inertia = metric(&so3, &rows);
    let plus = ConnectionKind::Canonical(CanonicalConnection::Plus);
    let geometry = Geometry::new("so(3)", so3, plus, Some(inertia)).unwrap();
    let equations =
        Equations::euler_poincare(geometry.connection(), geometry.metric().unwrap()).unwrap();
    let mut text = Vec::new();
    let system = EquationReport::new(equations, &geometry);
    system.write(Format::Text, &mut text).unwrap();
    let text = String::from_utf8(text).unwrap();
    assert!(text.contains("M1*dOmega_1/dt = (Omega2 - c)*Omega_2*Omega_3 + M_1"), "{text}");
    let mut latex = Vec::new();
    system.write(Format::Latex, &mut latex).unwrap();
    let latex = String::from_utf8(latex).unwrap();
    assert!(latex.contains("\\mathit{M\\_}_{1}"), "{latex}");
}

fn zero() -> Symbolic {
    num_traits::Zero::zero()
}

/// Geodesics of left-invariant metrics solve the Euler-Poincare equations, also in floats.
#[test]
fn geodesics_are_euler_poincare_in_floats() {
    for space in ["so3", "se(2)", "sl(2)", "heisenberg(3)", "bianchi(V)"] {
        for metric in ["diag(0.1,0.2,0.3)", "[[5,-3,1],[-3,7,2],[1,2,3]]", "diag(1e-6,3e5,0.7)"] {
            for (connection, genuine) in [("levi-civita", true), ("plus", true), ("zero", false)] {
                let arguments =
                    ["equations", space, "--metric", metric, "--connection", connection];
                for scalar in ["exact", "float"] {
                    let format = ["--scalar", scalar, "--format", "json"];
                    let json = stdout(root(), &[&arguments[..], &format].concat());
                    let json: serde_json::Value = serde_json::from_str(&json).unwrap();
                    assert_eq!(json["genuine"], genuine, "{space} {metric} {connection} {scalar}");
                }
            }
        }
    }
}

/// The parameter of a curve differs from the names of the coordinates and parameters, in every
/// format that contains it.
#[test]
fn the_parameter_of_a_curve_has_a_name_of_its_own() {
    let folder = tempfile::tempdir().unwrap();
    for (coordinates, metric, time) in [
        ("t, x", "diag(-1, t^2)", "s"),
        ("x, y", "diag(1, x^2)", "t"),
        ("x, y", "diag(1, x^2 + t)", "s"),
        ("s, t", "diag(1, s^2)", "tau"),
        ("t, s", "diag(1, t^2 + tau)", "lambda"),
    ] {
        let names: Vec<&str> = coordinates.split(", ").collect();
        let parameters = "parameters = [\"t\", \"tau\"]";
        let parameters = if names.contains(&"t") { "parameters = [\"tau\"]" } else { parameters };
        let definition = format!(
            "{parameters}\nmetric = \"{metric}\"\nconnection = \"levi-civita\"\n\
             [chart]\ncoordinates = {names:?}\n"
        );
        std::fs::write(folder.path().join("a.toml"), definition).unwrap();
        for kind in ["autoparallel", "transport"] {
            let equations = |format: &str| {
                stdout(folder.path(), &["equations", "a.toml", "--kind", kind, "--format", format])
            };
            let text = equations("text");
            for name in &names {
                assert!(text.contains(&format!("\n  d{name}/d{time} = ")), "{text}");
            }
            assert!(
                text.contains(&format!("v^i/d{time} = "))
                    || text.contains(&format!("u^i/d{time} = "))
            );
            let words = text.split_whitespace().collect::<Vec<_>>().join(" ");
            assert_eq!(words.contains("the parameter of the curve"), time != "t", "{text}");
            let json = equations("json");
            assert!(json.contains(&format!("1/d{time}\"")), "{json}");
        }
    }
}
