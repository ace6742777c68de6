//! Charts of definition files: signs and functions of their parameters, frames in their order, and constant curvature in
//! coordinates with roots and logarithms.

use affinor::Geometry;
use affinor_documents::space::Definition;
use affinor_tensors::expression::{Expression, Scalars};
use affinor_tensors::{Notation, Symbolic, Tensor, Tolerance, contract};

fn of(definition: &Definition) -> Geometry<Symbolic> {
    definition.geometry(Tolerance::default()).unwrap()
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

/// Spaces of constant curvature in coordinates with roots, logarithms and multiples of angles: each
/// is another chart of a space above.
#[test]
fn constant_curvature_in_roots_and_logarithms() {
    // x = r^2, with an origin of the angle that depends on x; x = exp(r)
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

/// A value that contradicts a sign is an error: `sqrt(a^2 x) = a sqrt(x)` holds for positive `a`
/// only.
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
                reason.contains("is declared positive, but becomes"),
                "{entry}, {value}: {reason}"
            );
        }
        set(accepted).unwrap();
    }
}

/// If an argument factorizes at a value, the signs of its factors are needed; the values of
/// functions keep declared signs.
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
        ("['y']", "sqrt(x^2 + a)", "0", "declare the positive ones among x"),
        ("['y']", "log(x^2 + a)", "-1", "declare the positive ones among x + 1, x - 1"),
        ("['y']", "1/sin(a*x)", "0", "becomes zero"),
    ] {
        let refused = set(positive, entry, at).unwrap_err().to_string();
        assert!(refused.contains(reason), "{entry}: {refused}");
    }
}

/// Values for the functions of a metric may be set before its tensors are computed, or in the
/// tensors.
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

/// The fields have the order of the file, whatever their names.
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
