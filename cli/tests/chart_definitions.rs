//! Definition files over charts: published curvatures, the same group given twice, every format,
//! and tables that are read back.

use crate::program::{definition, run};
use affinor::Geometry;
use affinor_documents::space::Definition;
use affinor_tensors::expression::{Expression, Scalars};
use affinor_tensors::{Notation, Symbolic, Tensor, Tolerance, contract};
use tempfile::TempDir;

fn of(definition: &Definition) -> Geometry<Symbolic> {
    definition.geometry(Tolerance::default()).unwrap()
}

fn geometry(file: &str) -> Geometry<Symbolic> {
    of(&Definition::read(&definition(file)).unwrap())
}

fn parsed(text: &str) -> Geometry<Symbolic> {
    of(&Definition::parse("a.toml", text).unwrap())
}

fn value(text: &str) -> Symbolic {
    let names = |name: &str| Ok(Symbolic::parameter(name));
    let expression = Expression::parse(text).unwrap();
    expression.evaluate(&Scalars(names, <Symbolic as Notation>::call)).unwrap()
}

/// `R_ijkl` and `g_ik g_jl - g_il g_jk`.
fn lowered(geometry: &Geometry<Symbolic>) -> [Tensor<Symbolic>; 2] {
    let g = geometry.metric().unwrap().components();
    let r = geometry.connection().curvature();
    [
        contract("g_im R^m_jkl -> _ijkl", &[("g", g), ("R", r)]).unwrap(),
        contract("g_ik g_jl - g_il g_jk -> _ijkl", &[("g", g)]).unwrap(),
    ]
}

/// `R_ijkl R^ijkl`.
fn kretschmann(geometry: &Geometry<Symbolic>) -> Symbolic {
    let [r, _] = lowered(geometry);
    let inverse = geometry.metric().unwrap().inverse();
    let raised = (0..4).fold(r.clone(), |r, slot| r.raise(slot, inverse).unwrap());
    let square = contract("R_ijkl U^ijkl ->", &[("R", &r), ("U", &raised)]).unwrap();
    square.to_scalar().unwrap()
}

#[test]
fn spaces_of_constant_curvature() {
    for (file, k) in [
        ("sphere.toml", "1/a^2"),
        ("hyperbolic_plane.toml", "-1"),
        ("poincare_half_space.toml", "-1"),
        ("hopf.toml", "1/R^2"),
    ] {
        let geometry = geometry(file);
        let [r, constant] = lowered(&geometry);
        assert_eq!(r, constant.scale(&value(k)), "{file}");
        assert!(geometry.connection().torsion().is_empty());
    }
}

/// Functions of products of a parameter and a coordinate. The last is de Sitter's space in flat slices:
/// S. W. Hawking, G. F. R. Ellis, *The Large Scale Structure of Space-Time* (1973), 5.2.
#[test]
fn constant_curvature_in_a_parameter() {
    for (metric, coordinates, k) in [
        ("diag(1, exp(2*a*x))", "['x', 'y']", "-a^2"),
        ("diag(1, cos(a*x)^2)", "['x', 'y']", "a^2"),
        ("diag(1, (sin(a*x)/a)^2, (sin(a*x)*sin(y)/a)^2)", "['x', 'y', 'z']", "a^2"),
        ("diag(-1, exp(2*a*t), exp(2*a*t), exp(2*a*t))", "['t', 'x', 'y', 'z']", "a^2"),
    ] {
        let text =
            format!("metric = '{metric}'\nparameters = ['a']\nchart.coordinates = {coordinates}");
        let [r, constant] = lowered(&parsed(&text));
        assert_eq!(r, constant.scale(&value(k)), "{metric}");
        // a value of the parameter reaches the arguments
        let mut definition = Definition::parse("a.toml", &text).unwrap();
        definition.set(&[("a".into(), value("-3"))].into()).unwrap();
        let [r, constant] = lowered(&of(&definition));
        assert_eq!(r, constant.scale(&value(&k.replace('a', "(-3)"))), "{metric}");
        let mut definition = Definition::parse("a.toml", &text).unwrap();
        definition.set(&[("a".into(), value("1/40"))].into()).unwrap();
        let [r, constant] = lowered(&of(&definition));
        assert_eq!(r, constant.scale(&value(&k.replace('a', "(1/40)"))), "{metric}");
    }
}

/// C. W. Misner, K. S. Thorne, J. A. Wheeler, *Gravitation* (1973): (31.7) with box 14.5 for
/// orthonormal fields.
#[test]
fn the_field_of_a_mass_is_empty_and_curved() {
    let geometry = geometry("schwarzschild.toml");
    assert!(geometry.connection().ricci().is_empty());
    let [r, _] = lowered(&geometry);
    assert_eq!(kretschmann(&geometry), value("48*M^2/r^6"));
    // R_trtr = -2M/r^3 in unit vectors, and g_tt g_rr = -1
    assert_eq!(r.get(&[0, 1, 0, 1]), value("-2*M/r^3"));
    let gamma = geometry.connection().affinities();
    assert_eq!(gamma.get(&[1, 0, 0]), value("M*(r - 2*M)/r^3"));
    assert_eq!(gamma.get(&[1, 1, 1]), value("-M/(r*(r - 2*M))"));
    assert_eq!(gamma.get(&[1, 2, 2]), value("2*M - r"));
    assert_eq!(gamma.get(&[2, 3, 3]), value("-sin(theta)*cos(theta)"));
}

/// Observers at rest, with their acceleration `M/r^2/sqrt(1 - 2M/r)`; and the coordinates of observers in free fall from
/// infinity: K. Martel, E. Poisson, *Am. J. Phys.* 69 (2001) 476-480.
#[test]
fn the_same_field_in_roots() {
    let rest = geometry("schwarzschild_static.toml");
    assert!(rest.connection().ricci().is_empty());
    assert_eq!(kretschmann(&rest), value("48*M^2/r^6"));
    let acceleration = rest.connection().affinities().get(&[1, 0, 0]);
    let expected = value("M/r^2/sqrt(r - 2*M)*sqrt(r)");
    assert_eq!(acceleration, expected);
    let fall = parsed(
        "metric = [['2*M/r - 1', 'sqrt(2*M/r)', '0', '0'], ['sqrt(2*M/r)', '1', '0', '0'],\n\
         ['0', '0', 'r^2', '0'], ['0', '0', '0', 'r^2*sin(theta)^2']]\nparameters = ['M']\n\
         chart = {coordinates = ['t', 'r', 'theta', 'phi'], positive = ['M', 'r']}",
    );
    assert!(fall.connection().ricci().is_empty());
    assert_eq!(kretschmann(&fall), value("48*M^2/r^6"));
}

/// Spaces of constant curvature in coordinates with roots, logarithms and parts of angles: each is another chart of a space
/// above.
#[test]
fn constant_curvature_in_roots_and_logarithms() {
    // x = r^2 and another origin of the angle at each x; x = exp(r)
    let turned = "[['1/(4*x) + x^2', 'x*sqrt(x)'], ['x*sqrt(x)', 'x']]";
    let scaled = "[['1/(4*a*x) + x^2/a', 'x*sqrt(x/a)'], ['x*sqrt(x/a)', 'x']]";
    for (metric, k) in [
        (turned, "0"),
        (scaled, "0"),
        ("'diag(1/x^2, log(x)^2)'", "0"),
        ("'diag(1/(a^2*x^2), log(x/a)^2)'", "0"),
        ("'diag(1, sin(x/3)^2)'", "1/9"),
        ("'diag(1, (exp(x/2) + exp(-x/2))^2)'", "-1/4"),
    ] {
        let text = format!(
            "metric = {metric}\nparameters = ['a']\n\
             chart = {{coordinates = ['x', 'phi'], positive = ['x', 'a']}}"
        );
        let [r, constant] = lowered(&parsed(&text));
        assert_eq!(r, constant.scale(&value(k)), "{metric}");
    }
    // the unit vectors of polar coordinates in cartesian ones
    let unit = parsed(
        "metric = 'identity'\nchart.coordinates = ['x', 'y']\n[frame]\n\
         u = '(x*d_x + y*d_y)/sqrt(x^2 + y^2)'\nv = '(x*d_y - y*d_x)/sqrt(x^2 + y^2)'",
    );
    assert!(unit.connection().curvature().is_empty());
    assert_eq!(unit.connection().affinities().get(&[0, 1, 1]), value("-1/sqrt(x^2 + y^2)"));
}

/// A value that contradicts a sign is refused: `sqrt(a^2 x) = a sqrt(x)` holds for positive `a` alone.
#[test]
fn values_against_declared_signs() {
    let cases = [
        ("parameters = ['a']", "['a', 'x']", "sqrt(a^2*x)", "a", ["-1", "0"], "2"),
        ("parameters = ['a']", "['a - 1', 'x']", "sqrt((a - 1)^2*x)", "a", ["0", "1"], "3"),
        ("parameters = ['a']", "['x', 'a - x', 'y']", "sqrt((x - a)^2*y)", "a", ["-1", "0"], "2"),
        ("", "['f(x)', 'x']", "sqrt(f(x)^2*x)", "f(x)", ["-1 - x^2", "-x"], "1 + x^2"),
    ];
    for (parameters, positive, entry, name, refused, accepted) in cases {
        let functions = if parameters.is_empty() { ", functions = ['f(x)']" } else { "" };
        let text = format!(
            "metric = 'diag(1, x + {entry})'\n{parameters}\n\
             chart = {{coordinates = ['x', 'y'], positive = {positive}{functions}}}"
        );
        let set = |value: &str| {
            let values = [(name.to_string(), value.parse().unwrap())].into();
            Definition::parse("a.toml", &text).unwrap().set(&values)
        };
        for value in refused {
            let reason = set(value).unwrap_err().to_string();
            assert!(
                reason.contains("is declared positive, and becomes"),
                "{entry}, {value}: {reason}"
            );
        }
        set(accepted).unwrap();
    }
}

/// An argument that factorises at a value needs the signs of its factors; the values of functions keep declared signs.
#[test]
fn values_at_which_arguments_factorise() {
    let set = |positive: &str, entry: &str, value: &str| {
        let text = format!(
            "metric = 'diag(1, x + {entry})'\nparameters = ['a']\n\
             chart = {{coordinates = ['x', 'y'], positive = {positive}}}"
        );
        let mut definition = Definition::parse("a.toml", &text).unwrap();
        let values = [("a".to_string(), value.parse().unwrap())].into();
        definition
            .set(&values)
            .map(|()| of(&definition).metric().unwrap().components().get(&[1, 1]))
    };
    for (positive, entry, at, expected) in [
        ("['x']", "sqrt(x^2 + a)", "0", "2*x"),
        ("['-x']", "2*sqrt(x^2 + a)", "0", "-x"),
        ("['x + a*y', 'x - a*y']", "sqrt(x^2 - a^2*y^2)", "0", "2*x"),
        ("['a - x', 'x']", "log(x^2 - 2*x + a)", "1", "x + 2*log(1 - x)"),
        ("['x']", "sin(a*x)^2", "3/4", "x + sin(3*x/4)^2"),
        ("['y']", "sin(a*x)", "1/7", "x + sin(x/7)"),
    ] {
        assert_eq!(set(positive, entry, at).unwrap(), value(expected), "{entry}");
    }
    for (positive, entry, at, reason) in [
        ("['y']", "sqrt(x^2 + a)", "0", "declare which are positive, of x"),
        ("['y']", "log(x^2 + a)", "-1", "declare which are positive, of x + 1, x - 1"),
        ("['y']", "1/sin(a*x)", "0", "becomes zero"),
    ] {
        let refused = set(positive, entry, at).unwrap_err().to_string();
        assert!(refused.contains(reason), "{entry}: {refused}");
    }
}

/// A. Friedmann's equations, S. Weinberg, *Gravitation and Cosmology* (1972), (15.1.18)-(15.1.20); and the limits of a
/// constant rate of expansion (S. W. Hawking, G. F. R. Ellis, 5.2) and of E. A. Milne's flat universe.
#[test]
fn an_expanding_universe() {
    let text = std::fs::read_to_string(definition("expanding_universe.toml")).unwrap();
    let read = || Definition::parse("a.toml", &text).unwrap();
    let geometry = of(&read());
    let ricci = geometry.connection().ricci();
    assert_eq!(ricci.get(&[0, 0]), value("-3*a_t_t(t)/a(t)"));
    let space = value("(a(t)*a_t_t(t) + 2*a_t(t)^2 + 2*k)/a(t)^2");
    let g = geometry.metric().unwrap().components();
    for i in 1..4 {
        assert_eq!(ricci.get(&[i, i]), g.get(&[i, i]) * &space);
    }
    assert_eq!(ricci.components().count(), 4);
    for (a, k, curvature) in
        [("exp(H*t)", "0", "H^2"), ("cosh(H*t)/H", "1", "H^2"), ("t", "-1", "0")]
    {
        let mut definition = read();
        definition.set(&[("a(t)".into(), value(a)), ("k".into(), value(k))].into()).unwrap();
        let [r, constant] = lowered(&of(&definition));
        assert_eq!(r, constant.scale(&value(curvature)), "{a}");
    }
}

/// A static field of spherical symmetry with any `f(r)`, in coordinates and by unit vectors; with
/// `f = 1 - 2M/r - L r^2/3` it is that of F. Kottler, *Ann. Phys.* 361 (1918) 401, with `Ric = L g`.
#[test]
fn any_static_field() {
    let head = "parameters = ['M', 'L']\n[chart]\ncoordinates = ['t', 'r', 'theta', 'phi']\n\
                functions = ['f(r)']\npositive = ['f(r)']\n[metric]\n";
    let coordinates = format!("{head}components = 'diag(-f(r), 1/f(r), r^2, r^2*sin(theta)^2)'");
    let unit = format!(
        "{head}components = 'diag(-1, 1, 1, 1)'\n[frame]\na = 'd_t/sqrt(f(r))'\nb = 'sqrt(f(r))*d_r'\n\
         c = '1/r*d_theta'\nd = '1/(r*sin(theta))*d_phi'"
    );
    for text in [coordinates, unit] {
        let geometry = parsed(&text);
        let ricci = geometry.connection().ricci();
        let inverse = geometry.metric().unwrap().inverse();
        let scalar = contract("U^ij S_ij ->", &[("U", inverse), ("S", &ricci)]).unwrap();
        assert_eq!(scalar.to_scalar(), Some(value("-f_r_r(r) - 4*f_r(r)/r - 2*f(r)/r^2 + 2/r^2")));
        if text.contains("frame") {
            continue;
        }
        let mut definition = Definition::parse("a.toml", &text).unwrap();
        let f = value("1 - 2*M/r - L*r^2/3");
        definition.set(&[("f(r)".into(), f)].into()).unwrap();
        let kottler = of(&definition);
        let g = kottler.metric().unwrap().components();
        assert_eq!(kottler.connection().ricci(), g.scale(&value("L")));
    }
}

/// Values for the functions of a metric may be set before its tensors, or in them.
#[test]
fn functions_are_set_before_or_after() {
    let text = "chart = {coordinates = ['x', 'y'], functions = ['f(x, y)', 'g(y)']}\n\
                metric = [['f(x, y)', 'x*g(y)'], ['x*g(y)', '1 + g_y(y)']]";
    let given =
        [("f(x,y)".to_string(), value("x^2 + 3*y")), ("g(y)".to_string(), value("exp(2*y)"))];
    let given = std::collections::BTreeMap::from(given);
    let mut definition = Definition::parse("a.toml", text).unwrap();
    let before = of(&definition);
    definition.set(&given).unwrap();
    let after = of(&definition);
    let set = |tensor: &Tensor<Symbolic>| tensor.map(|v| v.substitute(&given).unwrap());
    assert_eq!(set(before.connection().affinities()), *after.connection().affinities());
    assert_eq!(set(before.connection().curvature()), *after.connection().curvature());
    let nabla = |geometry: &Geometry<Symbolic>| geometry.connection().nabla_curvature().clone();
    assert_eq!(set(&nabla(&before)), nabla(&after));
}

/// R. C. Henry, *Astrophys. J.* 535 (2000) 350: with `c = cos(theta)` and `x = r^2 + a^2 c^2`,
/// `R_ijkl R^ijkl = 48 M^2 (r^2 - a^2 c^2)(x^2 - 16 r^2 a^2 c^2)/x^6`.
#[test]
fn a_rotating_mass() {
    let geometry = geometry("kerr.toml");
    assert!(geometry.connection().ricci().is_empty());
    let x = "(r^2 + a^2*cos(theta)^2)";
    let ac = "a^2*cos(theta)^2";
    let expected = format!("48*M^2*(r^2 - {ac})*({x}^2 - 16*r^2*{ac})/{x}^6");
    assert_eq!(kretschmann(&geometry), value(&expected));
}

/// Spherical coordinates of flat space, and their unit vectors: M. R. Spiegel, *Vector Analysis*
/// (1959), chapter 7; hyperbolic functions through `exp`: geodesic polar coordinates.
#[test]
fn flat_and_hyperbolic_space_in_polar_coordinates() {
    let flat = parsed(
        "metric = 'diag(1, r^2, r^2*sin(theta)^2)'\nchart.coordinates = ['r', 'theta', 'phi']",
    );
    assert!(flat.connection().curvature().is_empty());
    let unit = parsed(
        "metric = 'identity'\nchart.coordinates = ['r', 'theta', 'phi']\n\
         frame = {a = 'd_r', b = '1/r*d_theta', c = '1/(r*sin(theta))*d_phi'}",
    );
    assert!(unit.connection().curvature().is_empty());
    assert_eq!(unit.frame().structure_functions().get(&[2, 1, 2]), value("-cot(theta)/r"));
    let hyperbolic = parsed("metric = 'diag(1, sinh(r)^2)'\nchart.coordinates = ['r', 'phi']");
    let [r, constant] = lowered(&hyperbolic);
    assert_eq!(r, constant.map(|v| -v.clone()));
    // without a metric: the flat connection of the unit vectors has torsion, and no curvature
    let parallel = parsed(
        "chart.coordinates = ['r', 'phi']\nframe = {a = 'd_r', b = '1/r*d_phi'}\naffinities = ''",
    );
    assert!(parallel.connection().curvature().is_empty());
    assert_eq!(parallel.connection().torsion().get(&[1, 0, 1]), value("1/r"));
}

/// The fields stand in their order, however they are called.
#[test]
fn the_order_of_the_fields_is_that_of_the_file() {
    let toml =
        "metric = 'diag(1, 2)'\n[chart]\ncoordinates = ['x', 'y']\n[frame]\nz = 'd_y'\nb = 'x*d_x'";
    let json = r#"{"metric": {"components": ["diag(1, 2)"]}, "chart": {"coordinates": ["x", "y"]},
        "frame": {"z": "d_y", "b": "x*d_x"}}"#
        .replace("[\"diag(1, 2)\"]", "\"diag(1, 2)\"");
    for text in [toml, &json] {
        let geometry = parsed(text);
        assert_eq!(geometry.frame().labels()[..], ["z", "b"]);
        let fields = geometry.frame_origin().fields().unwrap();
        assert_eq!(fields.written(), ["d_y", "x*d_x"]);
        assert!(geometry.algebra().is_some(), "[d_y, x d_x] = 0");
    }
}

/// The rotation group in its charts, against its brackets.
#[test]
fn charts_of_the_rotation_group_are_so3() {
    let temporary = TempDir::new().unwrap();
    let euler = definition("euler_angles.toml");
    let charts = [&euler, &definition("gibbs_vector.toml"), &definition("rotation_vector.toml")];
    let show = "structure,affinities,torsion,curvature,ricci,killing";
    for connection in ["plus", "zero", "minus", "lambda=1/3"] {
        for format in ["json", "csv"] {
            let table =
                ["table", "so3", "--connection", connection, "--show", show, "--format", format];
            let stored = run(temporary.path(), &[&table[..], &["-o", "so3"]].concat(), b"");
            assert_eq!(stored.status, 0, "{}", stored.err);
            for chart in charts {
                let verify = ["verify", chart, "so3", "--connection", connection];
                let outcome = run(temporary.path(), &verify, b"");
                assert_eq!(outcome.status, 0, "{}", outcome.out);
            }
        }
    }
    let compare = ["compare", &euler, "so3@plus", "--format", "csv"];
    let outcome = run(temporary.path(), &compare, b"");
    assert_eq!(outcome.status, 0, "{}", outcome.err);
    assert!(outcome.out.contains("no: Lambda^1_23 - c^1_23 = -1/2,yes"), "{}", outcome.out);
}

#[test]
fn tables_are_written_in_every_format_and_read_back() {
    let temporary = TempDir::new().unwrap();
    for file in ["sphere.toml", "schwarzschild.toml", "euler_angles.toml"] {
        for format in ["json", "csv"] {
            let table =
                ["table", &definition(file), "--show", "all", "--format", format, "-o", "stored"];
            assert_eq!(run(temporary.path(), &table, b"").status, 0);
            let outcome = run(temporary.path(), &["verify", &definition(file), "stored"], b"");
            assert_eq!(outcome.status, 0, "{}", outcome.out);
            let stored = std::fs::read_to_string(temporary.path().join("stored")).unwrap();
            // the head of the table of Euler angles has it, but no component
            let wrong = stored.replace("cos(theta)/sin(theta)", "sin(theta)/cos(theta)");
            std::fs::write(temporary.path().join("stored"), &wrong).unwrap();
            let outcome = run(temporary.path(), &["verify", &definition(file), "stored"], b"");
            assert_eq!(outcome.status, i32::from(!file.starts_with("euler")), "{}", outcome.out);
        }
    }
    let table = |format| {
        let sphere = definition("sphere.toml");
        let show = "affinities,metric,killing";
        run(temporary.path(), &["table", &sphere, "--format", format, "--show", show], b"").out
    };
    let latex = table("latex");
    assert!(latex.contains(r"&= -\sin \theta \cos \theta"), "{latex}");
    assert!(latex.contains(r"= \frac{\cos \theta}{\sin \theta}"), "{latex}");
    assert!(latex.contains(r"&= a^{2} \sin^{2} \theta"), "{latex}");
    let markdown = table("markdown");
    assert!(markdown.contains("| `Lambda^1_22` | `-sin(theta)*cos(theta)` |"), "{markdown}");
    assert!(markdown.contains("- coordinates: theta, phi"), "{markdown}");
    // coordinate fields commute, so there is an algebra, and its Killing form is zero
    assert!(table("text").contains("K_ij = 0"));
    let half_plane = definition("hyperbolic_plane.toml");
    let text = run(temporary.path(), &["table", &half_plane, "--show", "structure"], b"").out;
    assert!(text.contains("fields       e1 = y*d_x, e2 = y*d_y"), "{text}");
    assert!(text.contains("Structure functions (A6): 2 nonzero components"), "{text}");
}

#[test]
fn values_and_checks() {
    let temporary = TempDir::new().unwrap();
    let sphere = definition("sphere.toml");
    let show = ["--show", "scalar_curvature", "--format", "csv"];
    for (more, scalar) in [
        (vec!["--set", "a=2"], "1/2"),
        (vec!["--metric", "diag(1, cos(phi)^2)"], "0"),
        (vec!["--metric", "diag(exp(2*theta), exp(2*theta))"], "0"),
    ] {
        let arguments = [&["table", &sphere][..], &show, &more].concat();
        let outcome = run(temporary.path(), &arguments, b"");
        let expected =
            if scalar == "0" { String::new() } else { format!("scalar_curvature,,,,,{scalar}\n") };
        assert_eq!(outcome.out, format!("tensor,i,j,k,l,value\n{expected}"), "{}", outcome.err);
    }
    for (definition, status, says) in [
        (
            "metric = 'diag(1, x)'\nchart.coordinates = ['x', 'y']",
            0,
            "symmetric and non-degenerate",
        ),
        ("metric = 'diag(1, 0)'\nchart.coordinates = ['x', 'y']", 1, "d_y is orthogonal to every"),
        (
            "chart.coordinates = ['x']\nframe.u = '(cosh(x)^2 - sinh(x)^2 - 1)*d_x'",
            1,
            "determinant",
        ),
        ("chart.coordinates = ['x']", 1, "levi-civita is the connection of a metric"),
    ] {
        let outcome =
            run(temporary.path(), &["check", "-", "--format", "json"], definition.as_bytes());
        assert_eq!(outcome.status, status, "{}{}", outcome.out, outcome.err);
        assert!(outcome.out.contains(says), "{}", outcome.out);
    }
}
