//! Names in the formulas of problems: several names of one quantity have one meaning.
//!
//! Guards `documents::problem::forces` and `mechanics::formula`.

use affinor_documents::problem::Problem;

/// A body on se(3) or se(2) in a potential and with a force, with or without a constraint.
fn last_row(
    space: &str,
    n: usize,
    potential: &str,
    force: &str,
    constraint: Option<&str>,
) -> Vec<f64> {
    let masses: Vec<String> = (0..n).map(|i| format!("{}", i + 1)).collect();
    let numbers = |f: &dyn Fn(usize) -> String| (0..n).map(f).collect::<Vec<_>>().join(", ");
    let velocity = numbers(&|i| format!("0.{}", if constraint.is_some() { 0 } else { i + 1 }));
    let forces = numbers(&|i| if i == 0 { format!("\"{force}\"") } else { "0".into() });
    let held = constraint.map_or(String::new(), |text| format!("constraints = [\"{text}\"]\n"));
    let step = if constraint.is_some() { "integrator.step = 0.01" } else { "" };
    let text = format!(
        "space = \"{space}\"\nmetric = \"diag({})\"\n{held}initial.velocity = [{velocity}]\n\
         forces = {{ potential = \"{potential}\", body = [{forces}] }}\n{step}\noutput.end = 1\n",
        masses.join(", ")
    );
    let mut motion = Problem::parse("named.toml", &text).unwrap().motion(0).unwrap().motion;
    while !motion.step(1.0).unwrap() {}
    motion.row()
}

/// A position is the last column of the matrix, in potentials, forces and constraints.
#[test]
fn positions_are_entries() {
    let named = last_row("se3", 6, "9.81*z + x*y^2", "0.1*y", None);
    assert_eq!(named, last_row("se3", 6, "9.81*g34 + g14*g24^2", "0.1*g24", None));
    assert_ne!(named, last_row("se3", 6, "9.81*g34 + g14*g24", "0.1*g24", None));
    let named = last_row("se2", 3, "x + 2*y", "0.1*x", None);
    assert_eq!(named, last_row("se2", 3, "g13 + 2*g23", "0.1*g13", None));
    let named = last_row("se3", 6, "9.81*z", "0.1", Some("z - x"));
    assert_eq!(named, last_row("se3", 6, "9.81*g34", "0.1", Some("g34 - g14")));
}

/// If a potential contains an unknown name, the message lists the allowed names.
#[test]
fn other_names_are_refused_with_those_there_are() {
    let text = |potential: &str| {
        format!(
            "space = \"se3\"\nmetric = \"identity\"\ninitial.velocity = [0, 0, 0, 0, 0, 0]\n\
             forces.potential = \"{potential}\"\noutput.end = 1\n"
        )
    };
    for potential in ["qw", "Omega1", "w"] {
        let problem = Problem::parse("named.toml", &text(potential)).unwrap();
        let error = problem.motion(0).map(drop).unwrap_err();
        let help = error.help.unwrap();
        assert!(help.contains("g11..g44, x, y, z"), "{help}");
        assert_eq!(error.at.unwrap().text(), Some(potential));
    }
}
