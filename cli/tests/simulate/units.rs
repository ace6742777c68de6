//! Results do not depend on the units of length, time and mass, or on the origin of time.

use super::{columns, done, folder, refused, simulate, times};

/// A pendulum of length `l`, mass `m` and gravity `9.81 l`: its angle is independent of `l` and
/// `m`.
const PENDULUM: &str = r#"
space = "R^2"
metric = "diag(m, m)"
constraints = ["x1^2 + x2^2 - l^2"]
[initial]
coordinates = ["start*l*sin(1)", "-start*l*cos(1)"]
velocity = ["l*cos(1)", "l*sin(1)"]
[forces]
potential = "9.81*m*l*x2"
[integrator]
step = 0.01
[output]
end = 2
every = 1
columns = ["t"]
[quantities]
u1 = "x1/l"
u2 = "x2/l"
"#;

fn pendulum(length: f64, mass: f64, start: f64) -> String {
    format!("{PENDULUM}[parameters]\nl = {length:e}\nm = {mass:e}\nstart = {start}\n")
}

#[test]
fn units_of_length_and_mass_do_not_matter() {
    let run = |length: f64, mass: f64| {
        let columns = columns(folder(&pendulum(length, mass, 1.0)).path());
        let column = |name: &str, unit: f64| {
            let (_, values) = columns.iter().find(|(found, _)| found == name).unwrap();
            values.iter().map(|value| value / unit).collect::<Vec<_>>()
        };
        [column("u1", 1.0), column("u2", 1.0), column("lambda1", mass)].concat()
    };
    let expected = run(1.0, 1.0);
    let units = [(7e6, 1.0), (1.5e11, 1e24), (1e-6, 1e-15), (1.0, 1e8), (1.0, 1e-12), (1e5, 1e9)];
    for (length, mass) in units {
        for (found, expected) in run(length, mass).iter().zip(&expected) {
            assert!((found - expected).abs() < 1e-8, "{length:e}, {mass:e}: {found} {expected}");
        }
    }
}

#[test]
fn violations_are_found_in_all_units() {
    for length in [1e-6, 1e-4, 1.0, 1e8] {
        let folder = folder(&pendulum(length, 1.0, 1.05));
        let error = refused(&mut simulate(folder.path()), 1);
        assert!(error.contains("constraint 1 is"), "{error}");
    }
}

/// A constraint without forces does not change the motion, from rest too; forces before the start
/// are not evaluated.
#[test]
fn a_constrained_motion_starts_from_rest() {
    for (force, tolerance) in [("6*t*exp(-t/0.04)", 1e-6), ("6*sqrt(t)*exp(-t/0.04)", 3e-5)] {
        let problem = format!(
            "space = \"se3\"\nmetric = \"diag(1,1,1,2,2,2)\"\n\
             initial.velocity = [0,0,0,0,0,0]\nforces.body = [0,0,0,\"{force}\",0,0]\n\
             integrator.step = 0.001\noutput = {{ end = 1, every = 0.5, columns = [\"t\", \"x\"] }}\n"
        );
        let free = columns(folder(&problem.replace("step = 0.001", "tolerance = 1e-12")).path());
        let held = columns(folder(&format!("constraints = [\"g24\", \"g34\"]\n{problem}")).path());
        for (free, held) in free[1].1.iter().zip(&held[1].1) {
            assert!((free - held).abs() < tolerance, "{force}: {free} {held}");
        }
    }
}

/// A velocity that is zero up to rounding, such as `sin(pi) = 1.2e-16`, satisfies the constraints;
/// a larger one does not.
#[test]
fn rest_may_be_rounded() {
    let hanging = |speed: &str| {
        format!(
            "space = \"R^2\"\nmetric = \"identity\"\nconstraints = [\"x1^2 + x2^2 - 1\"]\n\
             initial = {{ coordinates = [0, -1], velocity = [0, \"{speed}\"] }}\n\
             integrator.step = 0.1\noutput = {{ end = 1, columns = [\"x1\", \"x2\"] }}\n"
        )
    };
    let columns = columns(folder(&hanging("sin(3.141592653589793)")).path());
    assert_eq!(columns[0].1.last(), Some(&0.0));
    let moving = folder(&hanging("1e-12"));
    assert!(refused(&mut simulate(moving.path()), 1).contains("changes at the rate"));
}

/// Constraint forces change the coadjoint orbit like other forces.
#[test]
fn constrained_motions_have_no_casimir_functions() {
    let output = done(&mut simulate(folder(&pendulum(1.0, 1.0, 1.0)).path()));
    let text = String::from_utf8(output.stderr).unwrap();
    assert!(text.contains("violation") && !text.contains("casimir"), "{text}");
}

/// From rest with the acceleration `a`, a body rotates by a quarter turn in the time `sqrt(pi/a)`,
/// in any unit of time.
#[test]
fn events_from_rest_do_not_depend_on_the_unit_of_time() {
    for acceleration in [1.0_f64, 3600.0, 1e6, 1e-4] {
        for method in ["rkmk54", "rkmk853"] {
            let quarter = (std::f64::consts::PI / acceleration).sqrt();
            let problem = format!(
                "space = \"so3\"\nmetric = \"diag(1,1,1)\"\ninitial.velocity = [0,0,0]\n\
                 forces.body = [0,0,{acceleration}]\nevents.quarter = \"R11\"\n\
                 integrator.method = \"{method}\"\n\
                 output = {{ end = {}, stop = \"quarter\", columns = [\"t\"] }}\n",
                20.0 * quarter
            );
            let stop = *times(folder(&problem).path()).last().unwrap();
            assert!((stop / quarter - 1.0).abs() < 1e-9, "{method}, {acceleration}: {stop}");
        }
    }
}

/// Rounding errors of times do not duplicate or lose rows.
#[test]
fn rows_do_not_depend_on_the_origin_of_time() {
    for start in [0.0, 1e5, 2_460_000.5, 1e7, 1.7e9, -1e7] {
        for every in [0.1, 0.02, 0.3, 0.25] {
            let problem = format!(
                "space = \"so3\"\nmetric = \"diag(1,2,3)\"\n\
                 initial = {{ time = {start:?}, velocity = [1,0.1,0.3] }}\n\
                 output = {{ end = {:?}, every = {every}, columns = [\"t\"] }}\n",
                start + 7.0 * every
            );
            let found = times(folder(&problem).path());
            assert_eq!(found.len(), 8, "{start}, {every}: {found:?}");
        }
    }
}

/// A torque with a discontinuity at the end of a step, whose time is rounded: fixed steps keep
/// their order.
#[test]
fn steps_end_at_jumps_up_to_rounding() {
    let table = "t,M1,M2,M3\n0,0,0,0\n1,0,0,0\n1,0,0,0.6\n2,0,0,0.6\n2,0,0,0\n";
    for method in ["kick4", "rkmk4", "cf4", "projected4", "simo-wong"] {
        for every in [0.1, 0.2, 0.3, 0.5, 3.0] {
            let folder = folder(&format!(
                "space = \"so3\"\nmetric = \"diag(1,2,3)\"\ninitial.velocity = [0,0,0]\n\
                 forces.table = \"jumps.csv\"\nintegrator = {{ method = \"{method}\", step = 0.1 }}\n\
                 output = {{ end = 3, every = {every}, columns = [\"t\", \"Omega3\"] }}\n"
            ));
            std::fs::write(folder.path().join("jumps.csv"), table).unwrap();
            let last = *columns(folder.path())[1].1.last().unwrap();
            // the impulse 0.6 over the moment of inertia 3
            assert!((last - 0.2).abs() < 1e-12, "{method}, {every}: {last}");
        }
    }
}

/// Finite differences stay in the domain of a constraint, also along directions in which its
/// gradient is constant.
#[test]
fn constraints_of_a_limited_domain() {
    let problem = "space = \"R^2\"\nmetric = \"identity\"\nconstraints = [\"log(exp(x2)) - 1\"]\n\
                   initial = { coordinates = [0, 1], velocity = [1, 0] }\n\
                   forces.body = [0, 3]\nintegrator.step = 0.1\n\
                   output = { end = 1, columns = [\"x1\", \"x2\"] }\n";
    let columns = columns(folder(problem).path());
    for (name, expected) in [("x1", 1.0), ("x2", 1.0), ("lambda1", 3.0)] {
        let (_, values) = columns.iter().find(|(found, _)| found == name).unwrap();
        assert!((values.last().unwrap() - expected).abs() < 1e-9, "{name}: {values:?}");
    }
}

/// Named quantities are columns in the listed order. The columns of constraints follow all others.
#[test]
fn columns_of_quantities_and_of_constraints() {
    let names = |listed: &str| -> Vec<String> {
        let problem = format!(
            "space = \"R^2\"\nmetric = \"identity\"\nconstraints = [\"x1^2 + x2^2 - 1\"]\n\
             initial = {{ coordinates = [0, -1], velocity = [1, 0] }}\nintegrator.step = 0.1\n\
             output = {{ end = 1, columns = [{listed}] }}\n\
             quantities = {{ height = \"x2\", speed = \"Omega1^2 + Omega2^2\" }}\n"
        );
        columns(folder(&problem).path()).into_iter().map(|(name, _)| name).collect()
    };
    let behind = ["lambda1", "violation"];
    assert_eq!(
        names("\"t\", \"x\""),
        [&["t", "x1", "x2", "height", "speed"][..], &behind].concat()
    );
    let listed = "\"speed\", \"t\", \"violation\", \"lambda\", \"x2\"";
    assert_eq!(names(listed), [&["speed", "t", "x2", "height"][..], &behind].concat());
    // a motion without constraints has no column `violation`
    let free = "space = \"R^2\"\nmetric = \"identity\"\ninitial.velocity = [1, 0]\n\
                output = { end = 1, columns = [\"violation\"] }\n";
    let message = refused(&mut simulate(folder(free).path()), 2);
    assert!(message.contains("`violation` is not a quantity of this motion"), "{message}");
}
