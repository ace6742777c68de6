//! Messages of a run about names, connections and constraints.

use super::{columns, done, folder, refused, simulate};

const BODY: &str = "space = \"so3\"\nmetric = \"diag(1, 2, 3)\"\n\
                    initial = { velocity = [1, 2, 3], coordinates = [1, 2, 3] }\n\
                    output = { end = 1, every = 0.5 }\n";

/// The help lists the names that are allowed at the location, without the rejected one.
#[test]
fn a_refused_name_is_not_in_the_help() {
    let given =
        "space = \"so3\"\nprescribed.velocity = [1, 2, 3]\nintegrator.step = 0.1\noutput.end = 1\n";
    let cases = [
        (format!("{BODY}forces.body = [0, 0, \"energy\"]"), "energy", "Omega1..Omega3, H1..H3"),
        (format!("{BODY}forces.spatial = [0, 0, \"power\"]"), "power", "g11..g33, qw"),
        (format!("{given}quantities.k = \"H1\""), "H1", "Omega1..Omega3, omega1..omega3"),
        (format!("{given}events.k = \"kinetic\""), "kinetic", "g11..g33, qw"),
    ];
    for (problem, name, allowed) in cases {
        let message = refused(&mut simulate(folder(&problem).path()), 2);
        assert!(message.contains(&format!("`{name}` is not a known name here")), "{message}");
        let (_, help) = message.split_once("the names here are").unwrap();
        assert!(help.contains(allowed) && !help.contains(name), "{message}");
    }
    // if the names are allowed, they are listed
    let message = refused(&mut simulate(folder(&format!("{BODY}events.k = \"wind\"")).path()), 2);
    assert!(message.contains("kinetic, potential, energy, power"), "{message}");
}

/// `R` means the entries of the matrix, as `g` does; a parameter of this name takes precedence.
#[test]
fn columns_of_the_matrix_have_two_names() {
    let of = |name: &str, lines: &str| {
        let output = format!("output = {{ columns = [\"{name}\"], ");
        columns(folder(&format!("{lines}{}", BODY.replace("output = { ", &output))).path())
    };
    let (r, g) = (of("R", ""), of("g", ""));
    assert_eq!(r.len(), g.len());
    for ((r, by_r), (g, by_g)) in r.iter().zip(&g).take(9) {
        assert_eq!((r.replace('R', "g"), by_r), (g.clone(), by_g));
    }
    assert_eq!((&*r[0].0, &*r[5].0), ("R11", "R23"));
    let parameter = of("R", "parameters.R = 5\n");
    assert_eq!(parameter[0], ("R".to_string(), vec![5.0; 3]));
}

/// A position without a quaternion means a body in the standard attitude.
#[test]
fn a_position_stands_alone() {
    let of = |initial: &str| {
        columns(
            folder(&format!(
                "space = \"se3\"\nmetric = \"diag(1, 2, 3, 1, 1, 1)\"\n\
                 initial = {{ velocity = [1, 2, 3, 0, 0, 0], {initial} }}\noutput.end = 1\n"
            ))
            .path(),
        )
    };
    let alone = of("position = [1, 2, \"1 + 2\"]");
    assert_eq!(alone, of("position = [1, 2, 3], quaternion = [1, 0, 0, 0]"));
    let start = |name: &str| alone.iter().find(|(own, _)| own == name).unwrap().1[0];
    assert_eq!(["x", "y", "z"].map(start), [1.0, 2.0, 3.0]);
    let cases = [("[1, 2]", "se3", 6), ("[1, 2, 3]", "so3", 3), ("[1, 2]", "se2", 3)];
    for (position, space, n) in cases {
        let problem = format!(
            "space = \"{space}\"\nmetric = \"identity\"\n\
             initial = {{ velocity = [{}], position = {position} }}\noutput.end = 1\n",
            vec!["0"; n].join(", ")
        );
        let message = refused(&mut simulate(folder(&problem).path()), 2);
        assert!(
            message
                .contains("`position` must be three numbers x, y, z, and is allowed on se(3) only"),
            "{message}"
        );
    }
}

/// A message names the equations of a connection other than `plus`, even if the file chooses it:
/// the precession has half the rate.
#[test]
fn a_connection_that_is_not_plus_is_said() {
    let momentum = |connection: &str, end: &str| {
        let problem = BODY.replace("end = 1, every = 0.5", &format!("end = {end}"));
        let folder = folder(&format!("connection = \"{connection}\"\n{problem}"));
        let output = done(&mut simulate(folder.path()));
        let columns = columns(folder.path());
        let last =
            |name: &str| *columns.iter().find(|(own, _)| own == name).unwrap().1.last().unwrap();
        (["H1", "H2", "H3"].map(last), String::from_utf8(output.stderr).unwrap())
    };
    let (of_plus, said) = momentum("plus", "1");
    assert!(!said.contains("connection"), "{said}");
    let (of_zero, said) = momentum("zero", "2");
    assert!(said.contains("note: the connection is not plus"), "{said}");
    assert!(said.contains("H' is 0.5 times its value there"), "{said}");
    for (a, b) in of_plus.iter().zip(of_zero) {
        assert!((a - b).abs() < 1e-8, "{of_plus:?}, {of_zero:?}");
    }
}

/// Dependent constraints and forces that are not finite have different messages.
#[test]
fn constraints_that_repeat_themselves_are_named() {
    let problem = |constraints: &str, force: &str| {
        format!(
            "space = \"R^3\"\nmetric = \"identity\"\nconstraints = [{constraints}]\n\
             initial.velocity = [0, 0, 0]\nforces.body = [0, 0, \"{force}\"]\n\
             integrator.step = 0.1\noutput.end = 1\n"
        )
    };
    let cases = [
        (problem("\"x1\", \"x2\", \"2*x1 - x2 + x1^2\"", "-1"), "constraint 3 is dependent"),
        (problem("\"x1^2\"", "-1"), "constraint 1 has a zero gradient"),
        (problem("\"x1\"", "1/t"), "1/t is inf at t = 0"),
    ];
    for (problem, expected) in cases {
        let message = refused(&mut simulate(folder(&problem).path()), 1);
        assert!(message.contains(expected), "{message}");
    }
    done(&mut simulate(folder(&problem("\"x1\", \"x2\"", "-1")).path()));
}
