//! `affinor mobility`: mechanisms of the literature, and invalid files; the motion of mechanisms.

use crate::program::{root, run, stdout};
use serde_json::{Value, json};

fn mobility(file: &str) -> Value {
    let path = format!("examples/mechanisms/{file}.toml");
    let text = stdout(root(), &["mobility", &path, "--format", "json"]);
    serde_json::from_str(&text).unwrap()
}

/// The mobility, the count in space and the number of rates of mechanisms. Bennett 1903; Bricard
/// 1897 and Arponen, Piipponen and Tuomela 2013 (one motion, rank 5); Sarrus 1853; Herve 1978. The
/// other values are those of textbooks (J. M. McCarthy, G. S. Soh, *Geometric design of linkages*).
#[test]
fn mechanisms_of_the_literature_have_the_published_mobility() {
    let expected = [
        ("bennett", 1, -2, 1, "rational functions"),
        ("bricard", 1, 0, 1, "symmetry"),
        ("sarrus", 1, 0, 1, "two chains"),
        ("four_bar", 1, -2, 1, "independent"),
        ("spherical_four_bar", 1, -2, 1, "independent"),
        ("slider_crank", 1, -2, 1, "independent"),
        ("double_four_bar", 1, -5, 1, "independent"),
        ("watt", 1, -5, 1, "independent"),
        ("screw_jack", 1, -3, 1, "independent"),
        ("six_hinges", 0, 0, 0, "the rates vanish"),
        ("stewart", 6, 6, 6, "independent"),
    ];
    for (file, exact, kutzbach, rates, proof) in expected {
        let report = mobility(file);
        assert_eq!(report["schema"], "affinor.mobility/1");
        assert_eq!(report["mobility"], exact, "{file}");
        assert_eq!(report["kutzbach"], kutzbach, "{file}");
        assert_eq!(report["rates"].as_array().unwrap().len(), rates, "{file}");
        let proofs = report["proofs"].to_string();
        assert!(proofs.contains(proof), "{file}: {proofs}");
        for position in report["positions"].as_array().unwrap() {
            assert_eq!(position["rates"], exact, "{file}");
            assert!(position["gap"].as_f64().unwrap() > 1e6, "{file}");
        }
    }
}

#[test]
fn witnesses_are_exact() {
    let bricard = mobility("bricard");
    assert_eq!(bricard["rates"], json!([["-1", "1", "-1", "1", "-1", "1"]]));
    assert_eq!((&bricard["rank"], &bricard["equations"]), (&json!(5), &json!(6)));
    assert!(bricard["joints"].as_array().unwrap().iter().all(|joint| joint["determined"] == false));
    let sarrus = mobility("sarrus");
    assert_eq!(sarrus["rates"], json!([["1", "-2", "1", "1", "-2", "1"]]));
}

/// In the horizontal position branches cross: there are three rates, and second-order terms exclude
/// most of them. Nearby positions have one.
#[test]
fn branches_cross_in_the_flat_double_four_bar_linkage() {
    let report = mobility("double_four_bar_flat");
    assert_eq!(report["rates"].as_array().unwrap().len(), 3);
    assert_eq!((&report["lower"], &report["upper"]), (&json!(0), &json!(2)));
    assert!(report["positions"].as_array().unwrap().iter().all(|at| at["rates"] == 1));
}

const HEAD: &str = "bodies = [{ name = \"ground\", fixed = true }, { name = \"arm\" }]\n";

/// Invalid files, with words of the message and of the advice.
#[test]
fn invalid_files_are_errors_with_advice() {
    let joint = |text: &str| format!("{HEAD}joints = [{{ {text} }}]\n");
    let pair = "bodies = [\"ground\", \"arm\"]";
    let cases = [
        (String::new(), "is empty", "give bodies and joints"),
        ("joint = 1\n".into(), "unknown key `joint`", "did you mean `joints`?"),
        (
            joint(&format!("type = \"revolute\", {pair}, at = [0,0,0], axis = [0,0,0]")),
            "the axis has length zero",
            "not zero",
        ),
        (
            joint("type = \"spherical\", bodies = [\"ground\", \"arn\"], at = [0,0,0]"),
            "there is no body `arn`",
            "did you mean `arm`?",
        ),
        (
            joint("type = \"spherical\", bodies = [\"ground\", \"elephant\"], at = [0,0,0]"),
            "there is no body `elephant`",
            "the bodies are ground, arm",
        ),
        (
            joint(&format!("type = \"hinge\", {pair}")),
            "no joint of the type `hinge`",
            "the types are revolute",
        ),
        (
            joint(&format!("type = \"revolut\", {pair}")),
            "no joint of the type `revolut`",
            "did you mean `revolute`?",
        ),
        (
            joint(&format!("type = \"revolute\", {pair}, at = [0,0,0]")),
            "needs the key `axis`",
            "as in axis",
        ),
        (
            joint(&format!("type = \"revolute\", {pair}, axis = [0,0,1]")),
            "needs the key `at`",
            "give a point",
        ),
        (
            joint(&format!("type = \"helical\", {pair}, at = [0,0,0], axis = [0,0,1]")),
            "needs the key `pitch`",
            "translation per radian",
        ),
        (
            joint(&format!("type = \"spherical\", {pair}, at = [0,0,0], pitch = 1")),
            "does not use the key `pitch`",
            "leave the key out",
        ),
        (
            joint(&format!("type = \"spherical\", {pair}, at = [0,0]")),
            "2 components instead of 3",
            "",
        ),
        (joint(&format!("type = \"spherical\", {pair}, at = [0,0,\"1/0\"]")), "", ""),
        (joint(&format!("type = \"spherical\", {pair}, at = [0,0,\"1+\"]")), "", ""),
        (
            joint("type = \"spherical\", bodies = [\"arm\", \"arm\"], at = [0,0,0]"),
            "connects `arm` with itself",
            "two different bodies",
        ),
        (
            joint("type = \"spherical\", bodies = [\"arm\"], at = [0,0,0]"),
            "connects 1 bodies",
            "connects two bodies",
        ),
        (
            joint(&format!(
                "type = \"universal\", {pair}, at = [0,0,0], axis = [1,0,0], second_axis = [2,0,0]"
            )),
            "axes of a universal joint are parallel",
            "not parallel",
        ),
        (
            joint(&format!("type = \"subgroup\", {pair}, twists = [[1,0,0,0,0,0],[0,1,0,0,0,0]]")),
            "do not span a subalgebra: the bracket [1, 2] = (0, 0, 1, 0, 0, 0)",
            "add the bracket",
        ),
        (
            joint(&format!("type = \"subgroup\", {pair}, twists = [[1,0,0,0,0,0],[2,0,0,0,0,0]]")),
            "twist 2 is a combination",
            "",
        ),
        (joint(&format!("type = \"subgroup\", {pair}, twists = [[1,0,0]]")), "instead of 6", ""),
        (HEAD.into(), "no joint connects `arm`", "connect every body"),
        (
            "bodies = [{ name = \"a\" }, { name = \"a\" }]".into(),
            "two bodies have the name `a`",
            "another name",
        ),
        (
            format!(
                "{HEAD}joints = [{{ name = \"J\", type = \"fixed\", {pair} }}, {{ name = \"J\", type = \
                 \"fixed\", {pair} }}]"
            ),
            "two joints have the name `J`",
            "another name",
        ),
        (
            "joints = [{ type = \"fixed\", bodies = [\"a\", \"b\"] }]".into(),
            "the file has no bodies",
            "name the bodies",
        ),
        (
            "links = [{ length = 1 }, { length = 1 }]".into(),
            "the loop is not closed: the last frame is at (2, 0, 0)",
            "change a length",
        ),
        (
            "links = [{ twist = 30 }]".into(),
            "the twist 30 is not a multiple of 90 degrees",
            "tangent of half the angle",
        ),
        (
            "links = [{ twist = 90, half_twist = 1 }]".into(),
            "the twist is given twice",
            "one of twist, half_twist",
        ),
    ];
    let folder = tempfile::tempdir().unwrap();
    for (text, message, advice) in cases {
        let path = folder.path().join("case.toml");
        std::fs::write(&path, &text).unwrap();
        let outcome = run(root(), &["mobility", path.to_str().unwrap()], b"");
        assert!([1, 2].contains(&outcome.status), "{text}: {}", outcome.out);
        let err = outcome.err.split_whitespace().collect::<Vec<_>>().join(" ");
        assert!(err.starts_with("error: "), "{text}: {err}");
        assert!(err.contains(message) && err.contains(advice), "{text}: {err}");
    }
}

/// A bar on a hinge falls from the horizontal: `omega^2 = m g l sin(phi)/I` with
/// `I = m (l^2/3 + r^2/4)`.
#[test]
fn a_bar_on_a_hinge_falls_as_energy_says() {
    let part = "shape = \"cylinder\", radius = 0.1, height = 1, mass = 2, position = [0.5, 0, 0]";
    let text = format!(
        "coordinates = \"poses\"\ngravity = [0, -9.81, 0]\n\
         bodies = [{{ name = \"ground\", fixed = true }}, \
         {{ name = \"arm\", inertia.parts = [{{ {part}, rotation = [0, \"pi/2\", 0] }}] }}]\n\
         joints = [{{ type = \"revolute\", bodies = [\"ground\", \"arm\"], at = [0, 0, 0], axis = [0, 0, 1] }}]\n\
         integrator.step = 0.002\n\
         output = {{ end = 0.2, every = 0.2, columns = [\"g21\", \"Omega3\"] }}\n"
    );
    let outcome = run(root(), &["simulate", "-"], text.as_bytes());
    assert_eq!(outcome.status, 0, "{}", outcome.err);
    let last = outcome.out.lines().last().unwrap();
    let row: Vec<f64> = last.split(',').map(|value| value.parse().unwrap()).collect();
    let [sine, omega] = [row[0], row[1]];
    let expected = 9.81 * -sine / (1.0 / 3.0 + 0.01 / 4.0);
    assert!(sine < -0.28 && (omega * omega / expected - 1.0).abs() < 1e-4, "{omega}, {expected}");
}

/// Rates, axes and gravity follow the parameters, also those of an option, and an ensemble.
#[test]
fn motions_follow_their_parameters() {
    let part = "shape = \"cylinder\", radius = 0.1, height = 1, mass = 2, position = [0.5, 0, 0]";
    let text = format!(
        "coordinates = \"poses\"\ngravity = [0, \"-g\", 0]\n\
         parameters = {{ g = 9.81, w = 1, s = 0 }}\n\
         bodies = [{{ name = \"ground\", fixed = true }}, \
         {{ name = \"arm\", inertia.parts = [{{ {part}, rotation = [0, \"pi/2\", 0] }}] }}]\n\
         joints = [{{ type = \"revolute\", bodies = [\"ground\", \"arm\"], at = [\"s\", 0, 0], axis = [0, 0, 2], rate = \"w\" }}]\n\
         integrator.step = 0.002\n\
         output = {{ end = 0.1, every = 0.1, columns = [\"Omega3\", \"Omega5\"] }}\n"
    );
    let rows = |settings: &str| -> Vec<Vec<f64>> {
        let outcome = run(root(), &["simulate", "-", "--set", settings], text.as_bytes());
        assert_eq!(outcome.status, 0, "{}", outcome.err);
        let row = |line: &str| line.split(',').map(|value| value.parse().unwrap()).collect();
        outcome.out.lines().skip(1).map(row).collect()
    };
    let near = |a: f64, b: f64| assert!((a - b).abs() < 1e-9, "{a}, {b}");
    for (settings, rate, at) in [("w=1", 1.0, 0.0), ("w=3", 3.0, 0.0), ("w=2,s=0.5", 2.0, 0.5)] {
        let start = &rows(settings)[0];
        near(start[0], rate);
        // the origin of the body moves around the axis at s
        near(start[1], -rate * at);
    }
    // without gravity the rate is constant; about the centre gravity has no moment
    for settings in ["w=3,g=0", "w=3,s=0.5"] {
        near(rows(settings)[1][0], 3.0);
    }
    assert!(rows("w=3")[1][0] < 2.0);
}

/// The parallelograms of problem A02 move as one pendulum: `3 theta'' = 3.5 g sin(theta)`, solved
/// separately with 24 digits. They pass the position in which all links are in a line.
#[test]
fn a_double_four_bar_linkage_moves_as_its_pendulum() {
    let file = "examples/mechanisms/double_four_bar.toml";
    let settings = ["--end", "10", "--every", "10", "--tolerance", "1e-11"];
    let outcome = run(root(), &[&["simulate", file], &settings[..]].concat(), b"");
    assert_eq!(outcome.status, 0, "{}", outcome.err);
    assert!(outcome.err.contains("6 of 12 equations"), "{}", outcome.err);
    let last = outcome.out.lines().last().unwrap();
    let row: Vec<f64> = last.split(',').map(|value| value.parse().unwrap()).collect();
    for (found, expected) in row[1..3].iter().zip([0.328458111540815, 0.944518538178601]) {
        assert!((found - expected).abs() < 1e-8, "{found}, {expected}");
    }
}

/// Motions that a file does not determine, with words of the message and of the advice.
#[test]
fn invalid_motions_are_errors_with_advice() {
    let rod = "inertia.parts = [{ shape = \"ball\", radius = 1, mass = 1 }]";
    let ground = "{ name = \"ground\", fixed = true }";
    let hinge = "bodies = [\"ground\", \"arm\"], at = [0,0,0], axis = [0,0,1]";
    let file = |bodies: &str, joints: &str| {
        format!(
            "coordinates = \"poses\"\noutput = {{ end = 1, every = 1 }}\nintegrator.step = 1\nbodies = [{bodies}]\njoints = [{joints}]\n"
        )
    };
    let arm = format!("{ground}, {{ name = \"arm\", {rod} }}");
    let cases = [
        (
            file(
                &format!("{ground}, {{ name = \"arm\" }}"),
                &format!("{{ type = \"revolute\", {hinge} }}"),
            ),
            "the moving body `arm` has no inertia",
            "fixed = true",
        ),
        (
            file(
                &format!("{{ name = \"ground\", {rod} }}, {{ name = \"arm\", {rod} }}"),
                &format!("{{ type = \"revolute\", {hinge} }}"),
            ),
            "one body must be fixed",
            "fixed = true",
        ),
        (
            file(&arm, &format!("{{ type = \"helical\", pitch = 1, {hinge} }}")),
            "the motion of a helical joint is not supported",
            "leave coordinates",
        ),
        (
            file(&arm, "{ type = \"fixed\", bodies = [\"ground\", \"arm\"] }"),
            "the joints lock all bodies",
            "remove a joint",
        ),
        (
            file(&arm, &format!("{{ type = \"cylindrical\", rate = 1, {hinge} }}")),
            "this joint has several rates",
            "revolute and prismatic",
        ),
        (
            file(
                &arm,
                &format!(
                    "{{ type = \"revolute\", rate = 1, {hinge} }}, {{ type = \"revolute\", rate = 2, {hinge} }}"
                ),
            ),
            "the joints do not allow these rates",
            "close all loops",
        ),
        (
            format!(
                "space = \"so3\"\n{}",
                file(&arm, &format!("{{ type = \"revolute\", {hinge} }}"))
            ),
            "a problem with bodies and joints has no `space`",
            "leave the key out",
        ),
        (
            format!(
                "gravity = [0, 1]\n{}",
                file(&arm, &format!("{{ type = \"revolute\", {hinge} }}"))
            ),
            "the vector has 2 components instead of 3",
            "",
        ),
    ];
    let folder = tempfile::tempdir().unwrap();
    for (text, message, advice) in cases {
        let path = folder.path().join("case.toml");
        std::fs::write(&path, &text).unwrap();
        let outcome = run(root(), &["simulate", path.to_str().unwrap()], b"");
        assert!([1, 2].contains(&outcome.status), "{text}: {}", outcome.out);
        let err = outcome.err.split_whitespace().collect::<Vec<_>>().join(" ");
        assert!(err.contains(message) && err.contains(advice), "{text}: {err}");
    }
}
