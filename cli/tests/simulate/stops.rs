//! Runs that end before their end time, with an error message.

use super::{TOP, done, folder, refused, simulate, times};
use std::fs;

/// The rows before the error are written to a separate file; the old file is unchanged.
#[test]
fn what_is_no_number_is_told_with_time_and_state() {
    let problem = TOP.replace("-0.001*Omega1", "sqrt(3 - t)");
    let folder = folder(&problem);
    let folder = folder.path();
    fs::write(folder.join("rows.csv"), "old").unwrap();
    let message = refused(simulate(folder).args(["-o", "rows.csv"]), 1);
    for part in ["sqrt(3 - t) is NaN at t = 3", "Omega = [", "g = [", "13 rows", "partial.csv"] {
        assert!(message.contains(part), "{part}: {message}");
    }
    assert_eq!(fs::read_to_string(folder.join("rows.csv")).unwrap(), "old");
    let rows = fs::read_to_string(folder.join("rows.partial.csv")).unwrap();
    assert_eq!(rows.lines().count(), 14);
    assert!(rows.lines().last().unwrap().starts_with("3,"));
}

/// A potential or a Hamiltonian that is NaN is an error, even if its derivatives are numbers.
#[test]
fn a_potential_is_a_number() {
    for integrator in ["tolerance = 1e-8", "step = 0.1", "step = 0.1\nmethod = \"rkmk4\""] {
        for potential in ["log(g33 - 2)", "g33 + log(3 - t) + 0*g11"] {
            let problem = format!(
                "space = \"so3\"\nmetric = \"diag(1, 2, 3)\"\ninitial.velocity = [0.3, 1, 0.2]\n\
                 forces.potential = \"{potential}\"\n[integrator]\n{integrator}\n\
                 [output]\nend = 5\nevery = 1\n"
            );
            let message = refused(&mut simulate(folder(&problem).path()), 1);
            for part in [&format!("the potential {potential} is"), "at t = ", "g = [", "row"] {
                assert!(message.contains(part), "{part}: {message}");
            }
        }
    }
    let problem = "space = \"so3\"\nhamiltonian = \"H1^2 + H2^2 + 2*H3^2 + log(H1 - 3)\"\n\
                   initial.momentum = [1, 0.2, 0.3]\noutput.end = 1\n";
    let message = refused(&mut simulate(folder(problem).path()), 1);
    assert!(message.contains("log(H1 - 3) is NaN"), "{message}");
}

#[test]
fn an_event_is_a_number() {
    let problem = TOP.replace("every = 0.25", "every = 0.25\nstop = \"k\"");
    let folder = folder(&format!("{problem}[events]\nk = \"sqrt(2.9 - t)\"\n"));
    let message = refused(&mut simulate(folder.path()), 1);
    assert!(message.contains("the value of an event function is NaN"), "{message}");
    assert!(message.contains("12 rows"), "{message}");
}

#[test]
fn what_blows_up_or_is_stiff_ends_with_a_word() {
    let explodes = TOP.replace("-0.001*Omega1", "Omega1^2");
    let message = refused(&mut simulate(folder(&explodes).path()), 1);
    assert!(message.contains("the steps become too small"), "{message}");
    let stiff = TOP.replace("0.001*Omega1", "1e9*Omega1");
    let stiff = stiff.replace("tolerance = 1e-12", "tolerance = 1e-6\nmax_steps = 10000");
    let message = refused(&mut simulate(folder(&stiff).path()), 1);
    assert!(message.contains("the problem is stiff"), "{message}");
    let fixed = TOP.replace("-0.001*Omega1", "Omega1^2");
    let fixed = fixed.replace("tolerance = 1e-12", "method = \"rkmk4\"\nstep = 0.05");
    let message = refused(&mut simulate(folder(&fixed).path()), 1);
    assert!(message.contains("t = "), "{message}");
}

/// A run ends with a message if its values overflow, if the tolerance is below the accuracy of
/// floats, or if it is stiff.
#[test]
fn nothing_is_waited_for_without_end() {
    let line = "space = \"R^1\"\nmetric = \"identity\"\ninitial.velocity = [0.3]\noutput.end = 1\n";
    for (force, word) in [
        ("exp(1000*t)", "exp(1000*t) is inf"),
        ("exp(exp(20*t))", "exp(exp(20*t)) is inf"),
        ("1/(0.5 - t)^3", "the steps become too small"),
        ("100*Omega1^3", "the steps become too small"),
    ] {
        let problem = folder(&format!("{line}forces.body = [\"{force}\"]\n"));
        let message = refused(&mut simulate(problem.path()), 1);
        assert!(message.contains(word), "{force}: {message}");
    }
    let tolerance = |tolerance: &str| {
        folder(&format!("{line}forces.body = [\"sin(t)\"]\nintegrator.tolerance = {tolerance}\n"))
    };
    for small in ["1e-300", "1e-20", "9e-16"] {
        let message = refused(&mut simulate(tolerance(small).path()), 1);
        assert!(message.contains("is too small for floats"), "{message}");
    }
    done(&mut simulate(tolerance("1e-15").path()));
    let top = TOP.replace("tolerance = 1e-12", "tolerance = 1e-15").replace("end = 400", "end = 5");
    for method in ["rkmk54", "rkmk853", "projected853"] {
        let top = top.replace("[integrator]", &format!("[integrator]\nmethod = \"{method}\""));
        done(&mut simulate(folder(&top).path()));
    }
}

/// If the rounding error of the time rotates the body by a full turn, the run fails: the attitude
/// is undefined.
#[test]
fn a_phase_without_meaning_is_refused() {
    let body = |end: &str| {
        folder(&format!(
            "space = \"so3\"\nmetric = \"diag(1, 2, 3)\"\ninitial.velocity = [0.1, 2, 0.1]\n\
             [output]\nend = {end}\ncolumns = [\"t\"]\n"
        ))
    };
    for end in ["1e13", "1e15", "-1e15", "1e300"] {
        let message = refused(&mut simulate(body(end).path()), 1);
        assert!(message.contains("its rounding error alone rotates the body"), "{end}: {message}");
    }
    assert_eq!(times(body("1e9").path()), [0.0, 1e9]);
    // the body is at rest
    let still = body("1e300");
    let text = fs::read_to_string(still.path().join("top.toml")).unwrap();
    fs::write(still.path().join("top.toml"), text.replace("[0.1, 2, 0.1]", "[0, 0, 0]")).unwrap();
    assert_eq!(times(still.path()), [0.0, 1e300]);
}

/// The potential `|x|` has the derivative 0 at its kink.
#[test]
fn a_corner_is_a_place_of_rest() {
    let problem = "space = \"R^1\"\nmetric = \"identity\"\ninitial.velocity = [0]\n\
                   forces.potential = \"abs(x1)\"\n\
                   [output]\nend = 1\ncolumns = [\"x1\"]\n";
    assert_eq!(times(folder(problem).path()), [0.0, 0.0]);
}
