//! Eigenvalues of equilibria and steady motions: published speeds, closed forms, and what must not
//! matter.

use super::constraints::{example, two_hinges};
use super::{expect_close, single};
use affinor_documents::input::InputError;
use affinor_documents::problem::Problem;
use std::f64::consts::PI;

/// The weave of the benchmark bicycle is stable above a published speed: J. P. Meijaard et al., Proc. R.
/// Soc. A 463 (2007) 1955-1982.
#[test]
fn weave_speed_of_a_bicycle() -> Result<(), InputError> {
    let text = example("bicycle", 1e-9);
    // the real part of the pair vanishes at the weave speed
    let weave = |v: f64| -> Result<f64, InputError> {
        let mut problem = Problem::parse("bicycle.toml", &text)?;
        problem.set(&format!("v={v}"))?;
        let pair = problem.linearized()?.linear.eigenvalues;
        Ok(pair.iter().filter(|s| s.im > 0.0).map(|s| s.re).fold(f64::MIN, f64::max))
    };
    let published = 4.292_382_536_341_11;
    let [below, above] = [weave(published - 1e-9)?, weave(published + 1e-9)?];
    assert!(below > 0.0 && above < 0.0, "{below}, {above}");
    // a real eigenvalue, the capsize, vanishes at a higher speed; very near, it counts as 0
    let capsize = |v: f64| -> Result<f64, InputError> {
        let mut problem = Problem::parse("bicycle.toml", &text)?;
        problem.set(&format!("v={v}"))?;
        Ok(problem.linearized()?.linear.eigenvalues[0].re)
    };
    let published = 6.024_262_015_388_37;
    let [below, above] = [capsize(published - 1e-4)?, capsize(published + 1e-4)?];
    assert!(below < 0.0 && above > 0.0, "{below}, {above}");
    Ok(())
}

/// Pendulums hanging and standing: `s^2 = -g/l` and `s^2 = g/l`. Newton's method finds the equilibrium.
#[test]
fn equilibria_of_a_pendulum() -> Result<(), InputError> {
    let text = |start: f64| {
        let joint =
            format!("type = \"revolute\", at = [0, 0, 0], axis = [0, 1, 0], coordinate = {start}");
        single("gravity = [0, 0, -9.81]", &joint).replace(
            "shape = \"box\", edges = [1, 2, 3], mass = 2",
            "shape = \"ball\", radius = 0.5, mass = 2, position = [0, 0, -2]",
        )
    };
    let square: f64 = 9.81 * 2.0 / (4.0 + 0.4 * 0.25);
    let hanging = Problem::parse("hanging.toml", &text(0.3))?.linearized()?;
    expect_close(&hanging.state[..1], &[0.0], 1e-13);
    let [s, _] = hanging.linear.eigenvalues[..] else { panic!() };
    expect_close(&[s.re, s.im], &[0.0, square.sqrt()], 1e-11);
    let standing = Problem::parse("standing.toml", &text(PI - 0.3))?.linearized()?;
    let values: Vec<f64> = standing.linear.eigenvalues.iter().map(|s| s.re).collect();
    expect_close(&values, &[square.sqrt(), -square.sqrt()], 1e-11);
    Ok(())
}

/// Eigenvalues follow the unit of time, and a stiff part does not hide a soft one.
#[test]
fn eigenvalues_of_stiff_and_soft_parts() -> Result<(), InputError> {
    let square: f64 = 9.81 * 2.0 / (4.0 + 0.4 * 0.25);
    for unit in [1.0, 1e-5, 1e5] {
        // gravity and stiffness in another unit of time
        let g = 9.81 * unit * unit;
        let stiffness = 1e9 * unit * unit;
        let keys = format!("gravity = [0, 0, {}]", -g);
        let text = two_hinges(&keys, &format!("stiffness = {stiffness}"), "coordinate = 0");
        let found = Problem::parse("pendulums.toml", &text)?.linearized()?.linear;
        assert_eq!((found.zeros, found.eigenvalues.len()), (0, 4));
        let inertia = 2.0 * (4.0 + 0.4 * 0.25);
        let expected = [(square + 1e9 / inertia).sqrt(), square.sqrt()];
        let mut sizes: Vec<f64> =
            found.eigenvalues.iter().filter(|s| s.im > 0.0).map(|s| s.im / unit).collect();
        sizes.sort_by(|a, b| b.total_cmp(a));
        for (found, expected) in sizes.iter().zip(expected) {
            assert!((found / expected - 1.0).abs() < 1e-5, "{unit}: {found}, {expected}");
        }
    }
    Ok(())
}

/// Newton's method starts from a horizontal pendulum. Forces and motors that change with the time
/// allow no linear equations with constant coefficients.
#[test]
fn states_that_are_no_equilibria_are_errors() -> Result<(), InputError> {
    let gravity = "gravity = [0, 0, -9.81]";
    let found = Problem::parse(
        "two.toml",
        &two_hinges(gravity, "coordinate = \"pi/2\"", "rest = 0, stiffness = 0"),
    )?;
    let found = found.linearized()?;
    expect_close(&found.state[..1], &[0.0], 1e-10);
    for (first, second) in [
        ("force = \"t\"", "rate = 0"),
        ("force = \"sin(t)\"", "rate = 0"),
        ("motor = \"t^2\"", "motor = \"t^2\""),
        ("motor = \"sin(t)\"", "rate = 0"),
    ] {
        let problem = Problem::parse("two.toml", &two_hinges(gravity, first, second))?;
        assert!(problem.linearized().is_err(), "{first}, {second}");
    }
    let driven = two_hinges(gravity, "motor = \"2*t\"", "motor = \"3*t\"");
    let driven = Problem::parse("driven.toml", &driven)?.linearized()?.linear;
    assert_eq!((driven.matrix.nrows(), driven.zeros, driven.eigenvalues.len()), (0, 0, 0));
    Ok(())
}
