//! Algebras whose structure constants contain square roots and pi.

use crate::program::{root, run, stdout};
use serde_json::{Value, json};

/// su(3) in the basis `-i lambda_a/2` of Gell-Mann's matrices.
const GELL_MANN: &str = r#"
name = "su(3), Gell-Mann"
dimension = 8
brackets = """
[e1,e2]=e3; [e1,e3]=-e2; [e2,e3]=e1
[e1,e4]=1/2*e7; [e1,e5]=-1/2*e6; [e1,e6]=1/2*e5; [e1,e7]=-1/2*e4
[e2,e4]=1/2*e6; [e2,e5]=1/2*e7; [e2,e6]=-1/2*e4; [e2,e7]=-1/2*e5
[e3,e4]=1/2*e5; [e3,e5]=-1/2*e4; [e3,e6]=-1/2*e7; [e3,e7]=1/2*e6
[e4,e5]=1/2*e3+sqrt(3)/2*e8; [e6,e7]=-1/2*e3+sqrt(3)/2*e8
[e4,e6]=1/2*e2; [e4,e7]=1/2*e1; [e5,e6]=-1/2*e1; [e5,e7]=1/2*e2
[e4,e8]=-sqrt(3)/2*e5; [e5,e8]=sqrt(3)/2*e4; [e6,e8]=-sqrt(3)/2*e7; [e7,e8]=sqrt(3)/2*e6
"""
"#;

fn with(file: &str, arguments: &[&str]) -> String {
    let outcome = run(root(), arguments, file.as_bytes());
    assert_eq!(outcome.status, 0, "{arguments:?}: {}", outcome.err);
    outcome.out
}

fn refused(file: &str, arguments: &[&str]) -> String {
    let outcome = run(root(), arguments, file.as_bytes());
    assert_ne!(outcome.status, 0, "{arguments:?}: {}", outcome.out);
    outcome.out + &outcome.err
}

fn json_of(file: &str, arguments: &[&str]) -> Value {
    serde_json::from_str(&with(file, &[arguments, &["--format", "json"]].concat())).unwrap()
}

/// Keys of the answers that do not depend on a basis.
const INVARIANT: [&str; 12] = [
    "simple",
    "dynkin_type",
    "simple_ideals",
    "derived_series",
    "lower_central_series",
    "upper_central_series",
    "rank",
    "derivations",
    "betti",
    "index",
    "invariant_forms",
    "unimodular",
];

#[test]
fn su3_in_the_basis_of_gell_mann_is_su3() {
    let found = json_of(GELL_MANN, &["info", "-"]);
    let expected: Value =
        serde_json::from_str(&stdout(root(), &["info", "su(3)", "--format", "json"])).unwrap();
    for key in INVARIANT {
        assert_eq!(found[key], expected[key], "{key}");
    }
    assert_eq!(found["killing"]["signature"], json!([0, 8, 0]));
    assert_eq!(found["identification"]["name"], expected["identification"]["name"]);
    assert_eq!(found["basis"][7], "e8/sqrt(3)");
    let basis = &found["rational_basis"];
    assert_eq!(basis["given"][7], "e8");
    assert_eq!(basis["divisors"], json!(["1", "1", "1", "1", "1", "1", "1", "sqrt(3)"]));
    assert_eq!(basis["killing_multiple"], "-3");
    let text = with(GELL_MANN, &["info", "-", "--format", "csv"]);
    assert!(text.contains("e8/sqrt(3) instead of e8") && text.contains("-3 * identity"), "{text}");
}

/// For rational tables the output does not mention another basis.
#[test]
fn rational_algebras_have_no_other_basis() {
    let info = stdout(root(), &["info", "su(3)", "--format", "json"]);
    assert!(!info.contains("rational_basis"));
}

#[test]
fn commands_compute_with_roots_exactly_and_in_floats() {
    for arguments in [
        &["check", "-"][..],
        &["check", "-", "--scalar", "float"],
        &["properties", "-"],
        &["equations", "-", "--metric", "identity"],
        &["table", "-", "--metric", "killing"],
        &["table", "-", "--metric", "killing", "--scalar", "float"],
        &["exp", "-", "1,0,0,0,0,0,0,0"],
    ] {
        with(GELL_MANN, arguments);
    }
    // a metric proportional to the Killing form is Einstein: Ric = K/4 and g = K
    let properties = json_of(GELL_MANN, &["properties", "-", "--metric", "killing"]);
    let list = properties["properties"].as_array().unwrap();
    let einstein = list.iter().find(|entry| entry["name"] == "Einstein (Ric = c g)").unwrap();
    assert_eq!(einstein["holds"], true);
    assert_eq!(properties["scalar"], "symbolic");
    let table = json_of(GELL_MANN, &["table", "-", "--show", "structure"]);
    assert_eq!(table["scalar"], "symbolic");
}

/// Motions do not change if the basis is scaled by a root.
#[test]
fn simulations_scale_with_the_basis() {
    let file = |factor: &str, unit: f64| {
        let brackets =
            on_three(&format!("[x,y] = {factor}*z\n[y,z] = {factor}*x\n[z,x] = {factor}*y"));
        let velocity = [1.0, 0.1, 0.2].map(|v| v * unit);
        (brackets, velocity)
    };
    let last_row = |(brackets, velocity): (String, [f64; 3])| -> Vec<f64> {
        let folder = tempfile::tempdir().unwrap();
        std::fs::write(folder.path().join("g.toml"), brackets).unwrap();
        let problem = format!(
            "space = \"g.toml\"\nmetric = \"diag(1, 2, 3)\"\n[initial]\nvelocity = {velocity:?}\n\
             [integrator]\ntolerance = 1e-12\n[output]\nend = 3\nevery = 3\ncolumns = [\"Omega\"]\n"
        );
        std::fs::write(folder.path().join("m.toml"), problem).unwrap();
        let text = stdout(folder.path(), &["simulate", "m.toml"]);
        text.lines().last().unwrap().split(',').map(|value| value.parse().unwrap()).collect()
    };
    // a velocity has the components Omega/sqrt(2) in the basis sqrt(2) e; a factor of the metric does not matter
    let unit = 0.5f64.sqrt();
    let (given, scaled) = (last_row(file("1", 1.0)), last_row(file("sqrt(2)", unit)));
    // the last column is a Casimir function
    for (given, scaled) in given.iter().zip(&scaled).take(3) {
        assert!((given * unit - scaled).abs() < 1e-10, "{given} {scaled}");
    }
}

/// A parameter may have the value of a root, exactly and in floats.
#[test]
fn parameters_take_roots_as_values() {
    let given = GELL_MANN
        .replace("sqrt(3)", "s")
        .replace("dimension = 8", "dimension = 8\nparameters = [\"s\"]");
    let exact = with(GELL_MANN, &["info", "-"]);
    assert_eq!(with(&given, &["info", "-", "--set", "s=sqrt(3)"]), exact);
    with(&given, &["check", "-", "--scalar", "float", "--set", "s=sqrt(3)"]);
    let wrong = refused(&given, &["check", "-", "--scalar", "float", "--set", "s=sqrt(2)"]);
    assert!(wrong.contains("jacobi"), "{wrong}");
}

fn on_three(brackets: &str) -> String {
    format!(
        "name = \"g\"\nbasis = [\"x\", \"y\", \"z\"]\nparameters = [\"a\"]\nbrackets = \"\"\"\n{brackets}\n\"\"\"\n"
    )
}

#[test]
fn tables_that_no_scaling_makes_rational_are_refused_at_the_bracket() {
    for (brackets, pair, value) in [
        ("[x,y] = (1 + sqrt(3))*z", "[x, y]", "sqrt(3) + 1"),
        ("[x,y] = y\n[x,z] = sqrt(2)*z", "[x, z]", "sqrt(2)"),
        ("[x,y] = y\n[x,z] = pi*z", "[x, z]", "pi"),
        ("[x,y] = (a + sqrt(2))*z", "[x, y]", "sqrt(2)"),
    ] {
        let message = refused(&on_three(brackets), &["info", "-"]);
        assert!(message.contains("no division of basis vectors by square roots"), "{message}");
        assert!(message.contains(pair) && message.contains(value), "{message}");
        assert!(message.contains("give another basis") && message.contains("-->"), "{message}");
        with(&on_three(brackets), &["check", "-"]);
    }
}

/// Roots are removed by scaling, also if there are parameters. The answers are those for the
/// brackets without roots.
#[test]
fn brackets_with_parameters_and_roots_are_scaled() {
    let file = on_three("[x,y] = sqrt(2)*z\n[y,z] = a*sqrt(2)*x\n[z,x] = sqrt(2)*y");
    let info = json_of(&file, &["info", "-"]);
    let without = json_of(&file.replace("sqrt(2)", "1"), &["info", "-"]);
    assert_eq!(info["parameters"], json!(["a"]));
    for key in INVARIANT.into_iter().chain(["exceptional_values"]) {
        assert_eq!(info[key], without[key], "{key}");
    }
}

/// Exports for other programs use fields that contain these numbers.
#[test]
fn exports_have_roots_and_pi() {
    let file = on_three("[x,y] = sqrt(2)/3*z\n[z,x] = a*pi*y");
    let export =
        |program: &str| with(&file, &["table", "-", "--show", "structure", "--format", program]);
    let contains = |program: &str, parts: &[&str]| {
        let text = export(program);
        parts.iter().for_each(|part| assert!(text.contains(part), "{part}\n{text}"));
    };
    let field = "F := FunctionField( Field( [ Sqrt(2) ] ), [ \"a\", \"pi\" ] );";
    contains("gap", &[field, "SetEntrySCTable( T, 1, 2, [ 1/3*Sqrt(2), 3 ] );"]);
    contains("sage", &["a, = (SR.var('a'),)", "LieAlgebra(SR, {", "'z': 1/3*sqrt(2)"]);
    contains("maple", &["1/3*sqrt(2)*z", "Pi"]);
    let import = "from sympy import MutableDenseNDimArray, Rational, pi, sqrt, symbols";
    contains("sympy", &[import, "c[2, 0, 1] = Rational('1/3')*sqrt(2)"]);
    let sympy = |brackets: &str| {
        let show = ["table", "-", "--show", "structure", "--format", "sympy"];
        with(&on_three(brackets), &show)
    };
    let rational = sympy("[x,y] = 2/3*z");
    assert!(rational.contains("Rational, symbols") && rational.contains("Rational('2/3')"));
    // Python divides integers to floats
    let quotients = sympy("[x,y] = a/3*z + (a^2/2 + 1/(4*a))*y + a^2/7*x");
    for part in ["= Rational('1/3')*a\n", "= Rational('1/7')*a**2\n", "= (2*a**3 + 1)/(4*a)\n"] {
        assert!(quotients.contains(part), "{part}\n{quotients}");
    }
}
