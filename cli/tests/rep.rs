//! `affinor rep`: representations, their operations in every format, and invalid input.

use crate::program::{root, run, stdout};
use serde_json::{Value, json};

fn rep(arguments: &[&str]) -> Value {
    let all = [&["rep"], arguments, &["--format", "json"]].concat();
    serde_json::from_str(&stdout(root(), &all)).unwrap()
}

/// The names of the components, with multiplicities above 1.
fn components(report: &Value) -> Vec<String> {
    let all = report["result"]["components"].as_array().unwrap();
    all.iter()
        .map(|component| {
            let name = component["name"].as_str().unwrap();
            match component["multiplicity"].as_str().unwrap() {
                "1" => name.to_string(),
                many => format!("{many} ({name})"),
            }
        })
        .collect()
}

#[test]
fn a_representation_has_its_properties() {
    let report = rep(&["E7", "56"]);
    assert_eq!(report["schema"], "affinor.rep/1");
    let representation = &report["representation"];
    assert_eq!(representation["labels"], json!([0, 0, 0, 0, 0, 0, 1]));
    assert_eq!(representation["reality"], "quaternionic");
    assert_eq!(representation["index"], json!(["12"]));
    assert_eq!(representation["casimir"], json!(["57/2"]));
    assert_eq!(report["certificate"]["ok"], true);
    assert_eq!(report["operations"], json!([]));
}

#[test]
fn operations_follow_one_another() {
    let report = rep(&["SU(5)", "10", "--tensor", "5bar"]);
    assert_eq!(components(&report), ["5", "45"]);
    let report = rep(&["SU(3)", "3", "--power", "2", "--kind", "exterior", "--tensor", "3"]);
    assert_eq!(components(&report), ["1", "8"]);
    let report = rep(&["SU(5)", "10", "--branch", "SU(3)xSU(2)xU(1)"]);
    assert_eq!(components(&report), ["(1,1)(6)", "(3bar,1)(-4)", "(3,2)(1)"]);
    assert_eq!(report["operations"][0]["subalgebra"], "Levi subalgebra without node 2");
    // the square of the representation of E8 with 779,247 dimensions
    let report = rep(&["E8", "1,0,0,0,0,0,0,1", "--tensor", "[1,0,0,0,0,0,0,1]"]);
    assert_eq!(report["result"]["components"].as_array().unwrap().len(), 40);
    assert_eq!(report["result"]["dimension"], "607225887009");
    for report in [
        rep(&["G2", "7", "--power", "3"]),
        rep(&["A2", "[0,0]", "--power", "4", "--kind", "exterior"]),
        rep(&["SU(3)", "3", "--power", "0"]),
        rep(&["SU(3)", "3", "--power", "4", "--kind", "exterior"]),
        rep(&["U(1)", "(-2)", "--tensor", "(5)"]),
        rep(&["SO(8)", "8", "--branch", "SU(3): 8", "--weights"]),
    ] {
        assert_eq!(report["certificate"]["ok"], true, "{report}");
    }
}

#[test]
fn weights_are_listed_with_their_orbits() {
    let report = rep(&["SU(3)", "8", "--weights"]);
    let expected = json!([
        { "labels": [1, 1], "multiplicity": "1", "orbit": "6" },
        { "labels": [0, 0], "multiplicity": "2", "orbit": "1" },
    ]);
    assert_eq!(report["weights"], expected);
}

/// A semisimple algebra in any basis has the representations of its type.
#[test]
fn spaces_have_the_representations_of_their_type() {
    for space in ["so(3,1)+sl(2)", "[x,y]=z, [y,z]=x, [z,x]=y", "su(3)", "so(5)"] {
        let name = if space.len() == 5 { "[1,0]" } else { "[1]" };
        let report = run(root(), &["rep", space, name, "--format", "json"], b"");
        let fits = report.status == 0 || report.err.contains("has 1 labels");
        assert!(fits, "{space}: {}", report.err);
    }
    let outcome = run(root(), &["rep", "se(3)", "2"], b"");
    assert_eq!(outcome.status, 1);
    assert!(outcome.err.contains("is not semisimple"), "{}", outcome.err);
}

#[test]
fn matrices_are_written_in_every_format() {
    let report = rep(&["SU(2)", "2", "--matrices"]);
    assert_eq!(report["schema"], "affinor.matrices/1");
    assert_eq!(report["matrices"][0], json!({ "name": "e1", "entries": [[1, 2, "1"]] }));
    assert_eq!(report["matrices"][2]["entries"], json!([[1, 1, "1"], [2, 2, "-1"]]));
    assert_eq!(report["basis"][1], json!({ "monomial": "f1", "weight": [-1] }));
    assert_eq!(report["bilinear_form"]["symmetry"], "antisymmetric");
    assert_eq!(rep(&["SU(3)", "3", "--matrices"])["bilinear_form"], Value::Null);
    let all = rep(&["A1 + G2", "[1,1,0]", "--matrices=all"]);
    let matrices = all["matrices"].as_array().unwrap();
    assert_eq!(matrices.len(), 17);
    assert_eq!(matrices[3]["name"], "e1_2");
    for (name, dimension) in [("SU(3)", "8"), ("G2", "14")] {
        for format in ["text", "markdown", "latex", "csv", "html"] {
            let arguments = ["rep", name, dimension, "--matrices", "--format", format];
            assert!(stdout(root(), &arguments).contains("e1"), "{format}");
        }
    }
    let latex = stdout(root(), &["rep", "SU(2)", "2", "--matrices", "--format", "latex"]);
    assert!(latex.contains(r"\begin{pmatrix} 0 & 1 \\ 0 & 0 \end{pmatrix}"), "{latex}");
    for line in stdout(root(), &["rep", "SU(3)", "8", "--matrices"]).lines() {
        assert!(line.chars().count() <= 80, "{line}");
    }
}

#[test]
fn vectors_span_subalgebras() {
    let report = rep(&["A2", "8", "--branch", "span e1-f1, e2-f2, e3-f3"]);
    assert_eq!(components(&report), ["3", "5"]);
    assert_eq!(report["operations"][0]["projection"], json!([[2, 2]]));
    assert_eq!(report["certificate"]["ok"], true);
    // a space in its own basis
    let space = "[x,y]=z, [y,z]=x, [z,x]=y";
    let report = rep(&[space, "3", "--branch", "span x + 2*y"]);
    assert_eq!(components(&report).len(), 3);
}

#[test]
fn every_format_is_written() {
    for operations in [&[][..], &["--tensor", "7"], &["--branch", "principal"], &["--weights"]] {
        for format in ["text", "markdown", "latex", "csv", "json", "html"] {
            let arguments = [&["rep", "G2", "7", "--format", format], operations].concat();
            assert!(stdout(root(), &arguments).contains('7'), "{format} {operations:?}");
        }
    }
    // text fits a terminal
    let text = stdout(root(), &["rep", "E6", "27", "--tensor", "27bar"]);
    assert!(text.lines().any(|line| line.contains("650")), "{text}");
}

#[test]
fn invalid_input_is_rejected_with_the_reason() {
    for (arguments, status, reason) in [
        (&["E6", "[1,0]"][..], 2, "has 2 labels, but the rank of E6 is 6"),
        (&["E6", "[1,0,0,0,0,-1]"], 2, "label 6 of the weight is -1"),
        (&["E6", "28"], 2, "E6 has no representation of dimension 28"),
        (&["E6", "27x"], 2, "E6 has"),
        (&["E9", "27"], 2, "E9"),
        (&["so(3)+R^2", "2"], 1, "is not semisimple"),
        (&["nothing", "2"], 2, "nothing"),
        (&["SU(3)", "3", "--branch", "E6"], 2, "no subalgebra of this type is known"),
        (&["SU(3)", "3", "--branch", "levi 7"], 2, "the diagram has no node 7"),
        (&["SU(3)", "3", "--branch", "levi"], 2, "write a name"),
        (&["SU(3)", "3", "--branch", "A1: [[1,2]]"], 2, "for the adjoint representation"),
        (&["SU(3)", "3", "--branch", "A1: [[1,2"], 2, "write a name"),
        (&["SU(3)", "3", "--tensor", "[1]"], 2, "has 1 labels"),
        (&["SU(3)", "3", "--power", "65"], 1, "the degree 65 exceeds the limit of 64"),
        (&["SU(3)", "3", "--kind", "exterior"], 2, "--power"),
        (&["SU(3)", "3", "--power", "-1"], 2, "-1"),
        (&["E8", "[1,0,0,0,0,0,0,1]", "--matrices"], 1, "exceeds the limit of 16384"),
        (&["E6", "[1,0,0,0,0,1]", "--matrices=all"], 2, "write --format csv"),
        (&["SU(3)", "3", "--matrices", "--tensor", "3"], 2, "--tensor"),
        (&["A2", "3", "--branch", "span e1, e2"], 2, "[e1, e2] = e3"),
        (&["A2", "3", "--branch", "span e1, h1"], 2, "e1 is orthogonal"),
        (&["A2", "3", "--branch", "span e9"], 2, "e9"),
        (&["U(3)", "3(0)", "--branch", "span e1"], 2, "centre"),
        (&["E8", "[9,9,9,9,9,9,9,9]", "--tensor", "248", "--weights"], 1, "exceeds the limit"),
        (&["A1", "[1073741824]", "--tensor", "[1073741824]"], 1, "exceeds the limit"),
    ] {
        let all = [&["rep"], arguments].concat();
        let outcome = run(root(), &all, b"");
        assert_eq!(outcome.status, status, "{arguments:?}: {}", outcome.err);
        assert!(outcome.err.contains(reason), "{arguments:?}: {}", outcome.err);
        assert!(outcome.out.is_empty(), "{arguments:?}");
    }
}

#[test]
fn long_computations_stop_at_their_time_limit() {
    let arguments = ["rep", "E8", "[1,1,1,0,0,0,0,0]", "--power", "9", "--timeout", "0.5"];
    let outcome = run(root(), &arguments, b"");
    assert_eq!(outcome.status, 1, "{}", outcome.err);
    assert!(outcome.err.contains("time limit"), "{}", outcome.err);
}
