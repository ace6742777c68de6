//! Homogeneous spaces G/H at the command line and in files: names, metrics, connections, errors.

use crate::program::{Outcome, root, run};
use serde_json::Value;
use std::fs;
use tempfile::TempDir;

fn outcome(arguments: &[&str]) -> Outcome {
    run(root(), arguments, b"")
}

fn json(arguments: &[&str]) -> Value {
    let outcome = outcome(&[arguments, &["--format", "json"]].concat());
    assert_eq!(outcome.status, 0, "{arguments:?}: {}", outcome.err);
    serde_json::from_str(&outcome.out).unwrap()
}

/// The components of a tensor of a table.
fn components(table: &Value, tensor: &str) -> Vec<(Vec<u64>, String)> {
    let rows = table["tensors"][tensor]["components"].as_array().unwrap();
    let row = |row: &Value| {
        let at = row[0].as_array().unwrap().iter().map(|i| i.as_u64().unwrap()).collect();
        (at, row[1].as_str().unwrap().to_string())
    };
    rows.iter().map(row).collect()
}

fn value(table: &Value, tensor: &str, at: &[u64]) -> Option<String> {
    components(table, tensor).into_iter().find(|(place, _)| place == at).map(|(_, value)| value)
}

/// All spellings of a name mean one space: text before `=`, families, signs of other alphabets.
#[test]
fn spellings_of_a_name() {
    for (spellings, name, dimension) in [
        (&["SU(3)/U(2)", " SU(3) / U(2)", "\\mathrm{SU}(3)/\\mathrm{U}(2)"][..], "SU(3)/U(2)", 4),
        (&["S^7 = Sp(2)/Sp(1)", "Sp(2)/Sp(1)", "V(1,H^2)"], "Sp(2)/Sp(1)", 7),
        (&["CP^2", "CP²", "ℂP²"], "SU(3)/S(U(2)xU(1))", 4),
        (&["SO(5)/SO(3)", "V(2,R^5)", "SO5/SO3", "V(2,ℝ⁵)"], "SO(5)/SO(3)", 7),
        (&["Fl(3)", "SU(3)/T", "SU(3)/T^2"], "SU(3)/T", 6),
        (&["SU(3)/U(1)_{1,-1}", "SU(3)/U(1)_1,-1"], "SU(3)/U(1)_{1,-1}", 7),
        (&["SU(3)xSU(3)/SU(3)", "SU(3)×SU(3)/SU(3)"], "SU(3)xSU(3)/SU(3)", 8),
        (&["S^2"], "SO(3)/SO(2)", 2),
    ] {
        for spelling in spellings {
            let table = json(&["table", spelling, "--show", "structure"]);
            assert_eq!(table["name"], name, "{spelling}");
            assert_eq!(table["algebra"]["dimension"], dimension, "{spelling}");
            assert_eq!(table["conventions"]["frame"], "reductive");
        }
    }
    // capitals are the geometries of the paper only in these names
    assert_eq!(json(&["table", "SO3", "--show", "structure"])["name"], "SO(3)");
}

/// A path of an existing file is a path, whatever it looks like.
#[test]
fn an_existing_file_is_no_name() {
    let folder = TempDir::new().unwrap();
    fs::create_dir(folder.path().join("SU(3)")).unwrap();
    fs::write(folder.path().join("SU(3)/U(2)"), "name = 'mine'\ndimension = 1\nbrackets = ''\n")
        .unwrap();
    let outcome = run(folder.path(), &["table", "SU(3)/U(2)", "--show", "structure"], b"");
    assert!(outcome.out.starts_with("mine\n"), "{} {}", outcome.out, outcome.err);
}

#[test]
fn misspelt_names_have_a_suggestion() {
    for (text, name) in [
        ("su(3)/u(2)", "SU(3)/U(2)"),
        ("SP(2)/Sp(1)", "Sp(2)/Sp(1)"),
        ("Cp^2", "CP^2"),
        ("gr(2,C^4)", "Gr(2,C^4)"),
        ("SUU(3)/U(2)", "SU(3)/U(2)"),
    ] {
        let outcome = outcome(&["table", text]);
        assert_eq!(outcome.status, 2);
        let expected = format!("there is no space named `{text}`; the nearest is {name}");
        assert!(outcome.err.contains(&expected), "{text}: {}", outcome.err);
    }
    for (text, message) in [
        ("SO(5)/E8", "no embedding of the second group"),
        ("no/such/file", "cannot read no/such/file"),
    ] {
        let outcome = outcome(&["table", text]);
        assert_eq!(outcome.status, 2);
        assert!(outcome.err.contains(message), "{text}: {}", outcome.err);
    }
}

/// The head states the embedding and the complement, in text and in JSON.
#[test]
fn the_head_states_the_embedding() {
    let text = outcome(&["table", "CP^2", "--metric", "killing", "--show", "ricci"]);
    for part in ["embedding    blocks of the matrices of SU(3)", "complement   m1 = "] {
        assert!(text.out.contains(part), "{}", text.out);
    }
    assert!(text.err.contains("minus the Killing form of su(3) on the complement"), "{}", text.err);
    let hyperbolic = outcome(&["table", "H^3", "--metric", "killing", "--show", "ricci"]);
    assert!(hyperbolic.err.contains("metric: the Killing form of so(3,1)"), "{}", hyperbolic.err);
    let table = json(&["table", "CP^2"]);
    assert_eq!(table["homogeneous"]["complement"].as_array().unwrap().len(), 4);
}

/// `canonical` is `minus`, and `natural` is `zero`, on groups as well; on G/H these are their names.
#[test]
fn connections_by_name() {
    let same = |space: &str, names: [&str; 2]| {
        let [a, b] = names.map(|name| json(&["table", space, "--connection", name]));
        assert_eq!(a, b, "{space}");
        a["connection"]["name"].as_str().unwrap().to_string()
    };
    assert_eq!(same("SU(3)/T", ["canonical", "minus"]), "canonical");
    assert_eq!(same("SU(3)/T", ["natural", "zero"]), "natural");
    assert_eq!(same("so3", ["canonical", "minus"]), "minus");
    assert_eq!(same("so3", ["natural", "zero"]), "zero");
    // torsion (2 lambda - 1) [x,y]_m
    let one =
        json(&["table", "SU(3)/T", "--connection", "lambda=1", "--show", "torsion,structure"]);
    assert_eq!(components(&one, "torsion"), components(&one, "structure"));
    let natural = json(&["table", "SU(3)/T", "--connection", "natural", "--show", "torsion"]);
    assert!(components(&natural, "torsion").is_empty());
    let canonical = ["table", "SU(3)/T", "--connection", "canonical", "--show", "nabla_curvature"];
    assert!(components(&json(&canonical), "nabla_curvature").is_empty());
}

/// All commands that compute with frames work on homogeneous spaces.
#[test]
fn commands_work_on_homogeneous_spaces() {
    let space = "SU(3)/T@levi-civita;metric=killing";
    let folder = TempDir::new().unwrap();
    let stored = folder.path().join("stored.json");
    let table = outcome(&["table", space, "--show", "ricci,curvature", "--format", "json"]);
    fs::write(&stored, &table.out).unwrap();
    let stored = stored.to_str().unwrap();
    for command in [
        &["check", space][..],
        &["check", "SU(3)/T"],
        &["verify", space, stored],
        &["properties", space],
        &["equations", space],
        &["equations", space, "--kind", "autoparallel"],
        &["isometries", space],
        &["info", space],
        &["compare", space, "CP^2@natural"],
        &["compare", "S^2", "so3@zero"],
        &["claims", space, "--claim", "locally symmetric"],
        &["table", space, "--scalar", "float"],
        &["table", space, "--code", "c", "--show", "ricci"],
        &["table", space, "--format", "latex"],
        &["table", space, "--format", "html"],
    ] {
        let outcome = outcome(command);
        let refuted = command[0] == "claims";
        assert_eq!(outcome.status, i32::from(refuted), "{command:?}: {}", outcome.err);
    }
    // a table of a homogeneous space does not define an algebra
    for (command, message) in [
        (&["table", stored][..], "a table of a homogeneous space"),
        (&["table", "SU(3)/T", "--frame", "right"], "no right-invariant frame"),
        (&["table", "SU(3)/T", "--format", "gap", "--show", "structure"], "not a Lie algebra"),
        (&["plot", "roots", "CP^2"], "CP^2"),
    ] {
        let outcome = outcome(command);
        assert!((1..=2).contains(&outcome.status), "{command:?}");
        assert!(!outcome.err.contains("panicked"), "{}", outcome.err);
        assert!(command[0] == "plot" || outcome.err.contains(message), "{}", outcome.err);
    }
}

/// `invariant` has a letter for each parameter; on a group these are all left-invariant metrics.
#[test]
fn the_general_invariant_metric() {
    for (space, parameters) in [
        ("CP^2", &["x1"][..]),
        ("Fl(3)", &["x1", "x2", "x3"]),
        ("V(2,R^5)", &["x1", "x2", "x3", "y1"]),
        ("V(2,R^4)", &["x1", "x2", "x3", "y1", "y2"]),
        ("so3", &["x1", "x2", "x3", "y1", "y2", "y3"]),
    ] {
        let table = json(&["table", space, "--metric", "invariant", "--show", "metric"]);
        assert_eq!(table["algebra"]["parameters"], serde_json::json!(parameters), "{space}");
    }
    let set = ["table", "CP^2", "--metric", "invariant", "--set", "x1=2", "--show", "metric"];
    assert_eq!(value(&json(&set), "metric", &[1, 1]).as_deref(), Some("2"));
    let chart = outcome(&["table", "examples/definitions/sphere.toml", "--metric", "invariant"]);
    assert!(chart.err.contains("a chart has no invariant metrics"), "{}", chart.err);
}

/// The scalar curvature of `x1 B + x2 B + x3 B` on the flags of three lines, where `B` is minus the
/// Killing form: `S = 1/x1 + 1/x2 + 1/x3 - (x1^2 + x2^2 + x3^2)/(6 x1 x2 x3)`.
#[test]
fn factors_of_isotropy_summands() {
    for (x, scalar) in [("1,1,1", "5/2"), ("1,1,2", "2"), ("1,2,3", "13/9")] {
        let metric = format!("summands({x})");
        let table = json(&["table", "Fl(3)", "--metric", &metric, "--show", "scalar_curvature"]);
        assert_eq!(value(&table, "scalar_curvature", &[]).as_deref(), Some(scalar), "{x}");
    }
    let letters = ["table", "Fl(3)", "--metric", "summands(a,b,b)", "--show", "scalar_curvature"];
    assert_eq!(json(&letters)["algebra"]["parameters"], serde_json::json!(["a", "b"]));
    for (arguments, message) in [
        (["Fl(3)", "summands(1,2)"], "2 factors for 3 isotropy summands"),
        (["V(2,R^5)", "summands(1,2)"], "2 equivalent summands"),
        (["so3", "summands(1,2,3)"], "only a homogeneous space G/H"),
        (["Fl(3)", "diag(1,2,3)"], "summands(a, b, ...)"),
    ] {
        let outcome = outcome(&["table", arguments[0], "--metric", arguments[1]]);
        assert!((1..=2).contains(&outcome.status));
        assert!(outcome.err.contains(message), "{arguments:?}: {}", outcome.err);
    }
}

/// Metrics and affinities must be invariant under h; the error states a component that changes.
#[test]
fn invariance_is_required() {
    let refused = outcome(&["table", "CP^2", "--metric", "diag(1,2,1,1)"]);
    assert_eq!(refused.status, 1);
    assert!(refused.err.contains("the metric must be invariant under h"), "{}", refused.err);
    let checked = outcome(&["check", "CP^2", "--metric", "diag(1,2,1,1)"]);
    assert_eq!(checked.status, 1);
    assert!(checked.out.contains("FAILS"), "{}", checked.out);
    let file = "homogeneous = { of = 'so(3)', by = ['e3'] }\naffinities = 'nabla[m1, m1] = m2'\n";
    let refused = run(root(), &["table", "-"], file.as_bytes());
    assert_eq!(refused.status, 1);
    assert!(refused.err.contains("the affinities must be invariant under h"), "{}", refused.err);
    // the invariant affinities of SU(3)/T are multiples of the structure on each summand
    let file =
        "homogeneous = { of = 'heisenberg(3)', by = ['z'] }\naffinities = 'nabla[m1, m1] = m2'\n";
    assert_eq!(run(root(), &["check", "-"], file.as_bytes()).status, 0);
}

/// A file defines a space by a subalgebra, in any basis, with or without a complement.
#[test]
fn spaces_in_files() {
    let sphere = |keys: &str| {
        let file = format!("metric = 'killing'\n{keys}\n");
        let arguments = ["table", "-", "--show", "scalar_curvature", "--format", "json"];
        let outcome = run(root(), &arguments, file.as_bytes());
        assert_eq!(outcome.status, 0, "{file}: {}", outcome.err);
        let table: Value = serde_json::from_str(&outcome.out).unwrap();
        value(&table, "scalar_curvature", &[]).unwrap()
    };
    let expected = sphere("homogeneous = { of = 'so(3)', by = ['e3'] }");
    assert_eq!(expected, "1");
    for keys in [
        "homogeneous = { of = 'SO(3)', by = ['e1'] }",
        "homogeneous = { of = 'su(2)', by = ['2 e2'] }",
        "homogeneous = { of = 'so(3)', by = ['e1 + 2 e2 - e3'] }",
        "homogeneous = { of = 'so(3)', by = ['e3'], complement = ['e1 + e2', 'e2'] }",
        "basis = ['x', 'y']\nhomogeneous = { of = 'so(3)', by = ['e3'] }",
        "parameters = ['a']\nhomogeneous = { of = 'so(3)', by = ['e3 + a*e1'] }",
        "[homogeneous]\nby = ['v']\n[homogeneous.of.change_of_basis]\nof = 'so(3)'\nvectors = ['e1 + e2', 'e2 - e3', 'e3']\n[homogeneous.of]\nbasis = ['u', 'v', 'w']",
    ] {
        assert_eq!(sphere(keys), expected, "{keys}");
    }
}

/// Files that define no space, each with the reason.
#[test]
fn files_that_are_refused() {
    for (keys, status, message) in [
        ("of = 'so(3)', by = ['e1', 'e2']", 1, "[e1, e2] = e3 is not in their span"),
        ("of = 'so(3)', by = ['e1', '2 e1']", 2, "the vectors of `by` are linearly dependent"),
        ("of = 'so(3)', by = ['e1', 'e2', 'e3']", 2, "the space is a point"),
        ("of = 'so(3)', by = ['e4']", 2, "`e4`"),
        ("of = 'so(3)', by = ['e1'], complement = ['e2']", 2, "its dimension is 2"),
        ("of = 'so(3)', by = ['e1'], complement = ['e2', 'e1']", 2, "linearly dependent"),
        ("of = 'so(3)', by = ['e1'], complement = ['e2 + e1', 'e3']", 1, "is not in m"),
        ("of = 'se(3)', by = ['p1', 'p2', 'p3']", 1, "no complement of h is invariant under h"),
        ("of = 'CP^2', by = ['e1']", 2, "CP^2 is a homogeneous space, not a Lie algebra"),
        ("of = 'so(3)'", 2, "missing field `by`"),
        ("of = 'so(3)', by = ['e1'], with = 3", 2, "with"),
    ] {
        let file = format!("homogeneous = {{ {keys} }}\n");
        let outcome = run(root(), &["table", "-"], file.as_bytes());
        assert_eq!(outcome.status, status, "{keys}: {}", outcome.err);
        assert!(outcome.err.contains(message), "{keys}: {}", outcome.err);
    }
    let file = "dimension = 2\nhomogeneous = { of = 'so(3)', by = ['e1'] }\n";
    let outcome = run(root(), &["table", "-"], file.as_bytes());
    assert!(outcome.err.contains("give no brackets and no dimension"), "{}", outcome.err);
}

/// The keys of `info` and of `properties` on homogeneous spaces, against the literature.
#[test]
fn info_and_properties() {
    let info = json(&["info", "SU(3)/U(1)_{1,1}"]);
    assert_eq!(info["schema"], "affinor.homogeneous/1");
    assert_eq!(info["betti"], serde_json::json!([1, 0, 1, 0, 0, 1, 0, 1]));
    assert_eq!((&info["invariant_metrics"], &info["symmetric"]), (&10.into(), &false.into()));
    let plane = json(&["info", "CP^2"]);
    let summand = &plane["summands"][0];
    assert_eq!((&summand["multiplicity"], &summand["type"]), (&1.into(), &"complex".into()));
    assert_eq!((&plane["rank"], &plane["euler_characteristic"]), (&1.into(), &3.into()));
    let stiefel = json(&["info", "V(2,R^5)"]);
    let types: Vec<_> = stiefel["summands"].as_array().unwrap().iter().collect();
    assert_eq!((&types[1]["multiplicity"], &types[1]["type"]), (&2.into(), &"real".into()));
    let property = |space: &str, name: &str| {
        let all = json(&["properties", space]);
        let all = all["properties"].as_array().unwrap().clone();
        all.into_iter().find(|entry| entry["name"] == name).unwrap_or_default()
    };
    let nearly_kaehler = "S^6 = G2/SU(3)@canonical;metric=killing";
    assert_eq!(property(nearly_kaehler, "parallel torsion")["holds"], true);
    assert_eq!(
        property("CP^2@levi-civita;metric=killing", "Einstein (Ric = c g)")["value"],
        "c = 1/2"
    );
    assert_eq!(
        property("V(2,R^5)@levi-civita;metric=killing", "naturally reductive")["holds"],
        true
    );
    assert_eq!(
        property("Fl(3)@levi-civita;metric=summands(1,1,2)", "naturally reductive")["holds"],
        false
    );
    assert_eq!(
        property("Fl(3)@levi-civita;metric=summands(1,1,2)", "Einstein (Ric = c g)")["holds"],
        true
    );
    let list = json(&["list", "CP^n"]);
    assert_eq!(list["spaces"][0]["example"], "CP^2");
}
