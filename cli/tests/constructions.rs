//! The constructions of definition files.

use crate::info::{info, info_of};
use crate::program::{root, run, stdout};
use serde_json::{Value, json};

/// The dimensions that most constructions change.
fn shape(info: &Value) -> Value {
    json!([
        info["dimension"],
        info["radical"]["dimension"],
        info["centre"]["dimension"],
        info["dynkin_type"]
    ])
}

#[test]
fn constructions_of_files() {
    let rows = [
        (r#"sum = ["so(3)", "R^3"]"#, "so(3)+R^3"),
        (r#"semidirect = { of = "so(3)", by = "adjoint" }"#, "se(3)"),
        (r#"semidirect = { of = "so(3)", by = "coadjoint" }"#, "se(3)"),
        (
            "[semidirect]\nof = 'R^1'\non = 'R^2'\nby = [[[1, 0], [0, '-1/2']]]",
            "bianchi(VI,h=-1/2)",
        ),
        (
            "[semidirect]\nof = 'R^1'\non = 'heisenberg(3)'\nby = [[[0, 1, 0], [-1, 0, 0], [0, 0, 0]]]",
            "oscillator(4)",
        ),
        (r#"subalgebra = { of = "sl(3)", spanned_by = ["E12", "E23", "E13"] }"#, "heisenberg(3)"),
        (r#"subalgebra = { of = "sl(4)", generated_by = ["E12", "E23", "E34"] }"#, "n(4)"),
        (r#"subalgebra = { of = "gl(3)", centralizer_of = ["E33"] }"#, "gl(2)+R^1"),
        (r#"quotient = { of = "heisenberg(5)", by = ["z"] }"#, "R^4"),
        (r#"quotient = { of = "galilei(3)", by = ["p1", "p2", "p3"] }"#, "se(3)+R^1"),
        (
            r#"central_extension = { of = "R^2", centre = ["z"], cocycle = "[e1, e2] = z" }"#,
            "heisenberg(3)",
        ),
        (r#"contraction = { of = "so(3)", weights = [1, 1, 0] }"#, "se(2)"),
        (
            r#"contraction = { of = "so(4,1)", weights = [0, 0, 0, 0, 0, 0, 1, 1, 1, 1] }"#,
            "iso(3,1)",
        ),
        (r#"truncated = { of = "so(3)", order = 2 }"#, "se(3)"),
        ("[tensor_product]\nof = 'so(3)'\nbasis = ['n']\nproducts = ''", "R^3"),
        (
            "[tensor_product]\nof = 'sl(2)'\nbasis = ['one', 'u']\n\
             products = ['product[one, one] = one', 'product[u, one] = u', 'product[u, u] = one']",
            "sl(2)+sl(2)",
        ),
        (
            "[tensor_product]\nof = 'sl(2)'\nbasis = ['one', 'j']\n\
             products = 'product[one, one] = one; product[one, j] = j; product[j, j] = j - one'",
            "so(3,1)",
        ),
        (
            "[tensor_product]\nof = 'so(3)'\nbasis = ['one', 'x', 'y']\n\
             products = 'product[one, one] = one; product[one, x] = x; product[one, y] = y'",
            "se_2(3)",
        ),
        (r#"complexification = "sl(2)""#, "so(3,1)"),
        (
            r#"change_of_basis = { of = "sl(2)", vectors = ["E12 + E21", "E12 - E21", "H1"] }"#,
            "sl(2)",
        ),
        (r#"sum = ["so(3)", { truncated = { of = "R^1", order = 2 } }]"#, "so(3)+R^2"),
        (
            r#"quotient = { of = { subalgebra = { of = "sl(4)", generated_by = ["E12", "E23", "E34"] } }, by = ["e3"] }"#,
            "degraaf(5,8)",
        ),
        (
            "[complexification]\nbasis = ['x', 'y', 'z']\nbrackets = '[x, y] = z; [y, z] = x; [z, x] = y'",
            "so(3,1)",
        ),
        (r#"truncated = { of = "so(3)+R^1", order = 2 }"#, "se(3)+R^2"),
    ];
    for (file, peer) in rows {
        let (built, peer) = (info_of(file), info(peer));
        for key in [
            "derived_series",
            "lower_central_series",
            "upper_central_series",
            "betti",
            "derivations",
        ] {
            assert_eq!(built[key], peer[key], "{key} of {file}");
        }
        assert_eq!(built["killing"]["signature"], peer["killing"]["signature"], "{file}");
        assert_eq!(shape(&built), shape(&peer), "{file}");
    }
}

/// The paths of parts are relative to the folder of the file; a file that contains itself is an
/// error.
#[test]
fn constructions_of_other_files() {
    let folder = tempfile::tempdir().unwrap();
    let write = |name: &str, text: &str| std::fs::write(folder.path().join(name), text).unwrap();
    std::fs::create_dir(folder.path().join("parts")).unwrap();
    write("parts/plane.toml", "basis = ['x', 'y', 'z']\nbrackets = '[x, y] = z'");
    write("parts/sum.toml", "sum = ['plane.toml', 'so(3)']");
    write("whole.toml", "truncated = { of = 'parts/sum.toml', order = 1 }");
    write("snake.toml", "sum = ['R^1', './snake.toml']");
    let found = stdout(folder.path(), &["info", "whole.toml", "--format", "json"]);
    let found: Value = serde_json::from_str(&found).unwrap();
    assert_eq!(shape(&found), json!([6, 3, 1, "A1"]));
    for (file, message) in [("snake.toml", "refer to itself"), ("parts/none.toml", "cannot read")] {
        let outcome = run(folder.path(), &["info", file], b"");
        assert_eq!(outcome.status, 2, "{}", outcome.err);
        assert!(outcome.err.contains(message), "{}", outcome.err);
    }
    let outcome = run(folder.path(), &["info", "-"], b"sum = ['so(3)', '-']");
    assert!(outcome.status == 2 && outcome.err.contains("standard input"), "{}", outcome.err);
    let outcome = run(
        folder.path(),
        &["info", "-"],
        b"sum = ['so(3)', { truncated = { of = 'so(3)', oder = 2 } }]",
    );
    assert!(outcome.status == 2 && outcome.err.contains("oder"), "{}", outcome.err);
}

#[test]
fn constructions_carry_names_metrics_and_connections() {
    let file = "name = 'tangent'\nbasis = ['a','b','c','x','y','z']\nmetric = 'identity'\n\
                connection = 'levi-civita'\ntruncated = { of = 'so(3)', order = 2 }";
    let outcome = run(root(), &["table", "-", "--show", "structure"], file.as_bytes());
    assert_eq!(outcome.status, 0, "{}", outcome.err);
    assert!(
        outcome.out.contains("[a, y] = z") && outcome.out.contains("levi-civita"),
        "{}",
        outcome.out
    );
}

#[test]
fn constructions_are_refused_with_a_witness() {
    let rows = [
        (
            "quotient = { of = 'so(3)', by = ['e1'] }",
            1,
            "not an ideal: [e2, e1] = -e3 is not in it",
        ),
        (
            "subalgebra = { of = 'sl(3)', spanned_by = ['E12', 'E23'] }",
            1,
            "not a subalgebra: [E12, E23] = E13 is not in it",
        ),
        (
            "central_extension = { of = 'so(3)+R^1', centre = ['z'], cocycle = \"[e1, e1'] = z\" }",
            1,
            "not a cocycle",
        ),
        (
            "[semidirect]\nof = 'R^1'\non = 'heisenberg(3)'\nby = [[[1, 0, 0], [0, 1, 0], [0, 0, 1]]]",
            1,
            "the matrix D of e1 is not a derivation: D [x1,y1] - [D x1,y1] - [x1,D y1] = -z",
        ),
        (
            "[semidirect]\nof = 'R^2'\non = 'R^2'\nby = [[[0, 1], [0, 0]], [[0, 0], [1, 0]]]",
            1,
            "not an action: (D_e1 D_e2 - D_e2 D_e1 - D_[e1,e2]) e1 = e1",
        ),
        (
            "[tensor_product]\nof = 'so(3)'\nbasis = ['u', 'v']\nproducts = 'product[u, u] = v; product[v, v] = u'",
            1,
            "(u u) v - u (u v) = u",
        ),
        (
            "[tensor_product]\nof = 'so(3)'\nbasis = ['u', 'v']\nproducts = 'product[u, v] = u; product[v, u] = v'",
            2,
            "this product is given twice",
        ),
        (
            "[tensor_product]\nof = 'so(3)'\nbasis = ['u']\nproducts = 'u*u = u'",
            2,
            "write product[x, y] = ...",
        ),
        ("tensor_product = { of = 'so(3)', basis = [], products = '' }", 2, "must have names"),
        ("contraction = { of = 'so(3)', weights = [1, 0, 0] }", 1, "no limit"),
        ("contraction = { of = 'so(3)', weights = [1, 0] }", 1, "the number of weights"),
        ("subalgebra = { of = 'so(3)', spanned_by = ['q'] }", 2, "q"),
        ("change_of_basis = { of = 'R^2', vectors = ['e1', '2*e1'] }", 2, "linearly dependent"),
        ("sum = ['so(3)', 'foo']", 2, "no algebra named `foo`"),
        ("sum = ['a.toml']", 2, "cannot read a.toml"),
        ("sum = ['so(3)']\nquotient = { of = 'R^2', by = ['e1'] }", 2, "defines the algebra"),
        ("sum = ['so(3)']\nbrackets = '[e1,e2]=e3'", 2, "defines the algebra"),
        ("semidirect = { of = 'so(3)', by = 'what' }", 2, "adjoint, coadjoint, or a list"),
        ("quotient = { of = 'R^2', by = ['e1', 'e2'] }", 2, "zero"),
        ("truncated = { of = 'so(3)', order = 0 }", 2, "order"),
        ("sum = ['so(3)']\nbasis = ['x']", 2, "1 names for dimension 3"),
    ];
    for (file, status, witness) in rows {
        let outcome = run(root(), &["info", "-"], file.as_bytes());
        let said = outcome.err.split_whitespace().collect::<Vec<_>>().join(" ");
        assert_eq!(outcome.status, status, "{file}: {said}");
        assert!(said.contains(witness), "{file}: {said}");
    }
    let names: Vec<String> = (0..65).map(|k| format!("'u{k}'")).collect();
    let basis = names.join(", ");
    let file = format!("tensor_product = {{ of = 'so(3)', basis = [{basis}], products = '' }}");
    let outcome = run(root(), &["info", "-"], file.as_bytes());
    assert!(outcome.status == 1 && outcome.err.contains("65 vectors"), "{}", outcome.err);
}
