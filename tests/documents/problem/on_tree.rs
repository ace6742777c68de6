//! Motions in joint coordinates: closed forms, the exact motion of a free body, the same files with
//! constraints, and invalid files.

mod constraints;
mod linearized;
mod springs;

use affinor_documents::input::InputError;
use affinor_documents::problem::Problem;

/// The values of columns at a time.
pub fn last(text: &str, end: f64, columns: &[&str]) -> Result<Vec<f64>, InputError> {
    let problem = Problem::parse("tree.toml", text)?;
    let mut ready = problem.with_columns(columns).at_times(&[end]).motion(0)?;
    while !ready.motion.step(end)? {}
    Ok(ready.motion.row())
}

pub fn expect_close(found: &[f64], expected: &[f64], tolerance: f64) {
    assert_eq!(found.len(), expected.len());
    for (at, (found, expected)) in found.iter().zip(expected).enumerate() {
        assert!((found - expected).abs() <= tolerance, "{at}: {found} instead of {expected}");
    }
}

const OUTPUT: &str = "integrator.tolerance = 1e-12\noutput = { end = 1, every = 1 }\n";
const GROUND: &str = "{ name = \"ground\", fixed = true }";

/// One body with one joint to the ground.
fn single(keys: &str, joint: &str) -> String {
    let part = "{ shape = \"box\", edges = [1, 2, 3], mass = 2 }";
    let bodies = format!("[{GROUND}, {{ name = \"body\", inertia.parts = [{part}] }}]");
    let ends = "bodies = [\"ground\", \"body\"]";
    format!(
        "coordinates = \"joints\"\n{keys}\nbodies = {bodies}\njoints = [{{ {ends}, {joint} }}]\n{OUTPUT}"
    )
}

/// A mass on a spring with a damper: `q = e^(-c t) (a cos(w t) + b sin(w t)) + rest`.
#[test]
fn springs_and_dampers_have_their_closed_form() -> Result<(), InputError> {
    let text = single(
        "parameters = { k = 10 }",
        "name = \"slide\", type = \"prismatic\", axis = [0, 3, 4], coordinate = 0.7, rate = -0.4, \
         stiffness = \"k\", damping = 0.8, rest = 0.2",
    );
    let (c, t): (f64, f64) = (0.2, 3.0);
    let w = (5.0 - c * c).sqrt();
    let (a, b) = (0.5, (-0.4 + c * 0.5) / w);
    let q = (-c * t).exp() * (a * (w * t).cos() + b * (w * t).sin()) + 0.2;
    let found = last(&text, t, &["q_slide", "y", "z", "energy", "power", "v_slide", "f_slide"])?;
    expect_close(&found[..3], &[q, 0.6 * q, 0.8 * q], 1e-10);
    let [energy, power, v, f] = found[3..] else { unreachable!() };
    expect_close(&[energy], &[v * v + 5.0 * (q - 0.2).powi(2)], 1e-10);
    expect_close(&[power, f], &[-0.8 * v * v, -0.8 * v - 10.0 * (q - 0.2)], 1e-9);
    Ok(())
}

/// A force as a formula in the time, a coordinate and a rate: `2 q'' = 2 cos(t) - 6 q - 2 q'`.
#[test]
fn forces_are_formulas_of_the_state() -> Result<(), InputError> {
    let text = single(
        "",
        "name = \"slide\", type = \"prismatic\", axis = [1, 0, 0], \
         force = \"2*cos(t) - 6*q_slide - 2*v_slide\", coordinate = \"2/5\", rate = \"1/5\"",
    );
    // the initial values are those of the periodic solution (2 cos(t) + sin(t))/5
    let t: f64 = 7.5;
    let found = last(&text, t, &["q_slide", "v_slide"])?;
    let expected = [2.0 * t.cos() + t.sin(), t.cos() - 2.0 * t.sin()].map(|value| value / 5.0);
    expect_close(&found, &expected, 1e-10);
    Ok(())
}

/// A helical joint under gravity along its axis: `(J + m p^2) q'' = m g p`.
#[test]
fn a_screw_falls_with_constant_acceleration() -> Result<(), InputError> {
    let text = single(
        "gravity = [0, 0, -9.81]",
        "name = \"screw\", type = \"helical\", at = [0, 0, 0], axis = [0, 0, 2], pitch = 0.25",
    );
    // J = m (1 + 4)/12 about the axis
    let rate = -2.0 * 9.81 * 0.25 / (2.0 * 5.0 / 12.0 + 2.0 * 0.0625);
    let found = last(&text, 3.0, &["q_screw", "v_screw", "z", "energy"])?;
    expect_close(&found, &[4.5 * rate, 3.0 * rate, 1.125 * rate, 0.0], 1e-9);
    Ok(())
}

/// A body on a ball joint at its centre, and a free body, rotate as the exact motion of a free body
/// does.
#[test]
fn a_ball_joint_rotates_as_a_free_body() -> Result<(), InputError> {
    let exact = format!(
        "space = \"so3\"\ninertia.parts = [{{ shape = \"box\", edges = [1, 2, 3], mass = 2 }}]\n\
         initial.velocity = [0.1, 2, 0.2]\n{OUTPUT}"
    )
    .replace("integrator.tolerance = 1e-12\n", "");
    let expected =
        last(&exact, 20.0, &["Omega1", "Omega2", "Omega3", "qw", "qx", "qy", "qz", "energy"])?;
    let ball = "name = \"ball\", type = \"spherical\", at = [0, 0, 0], rate = [0.1, 2, 0.2]";
    let free = "name = \"ball\", type = \"free\", rate = [1, 2, 3, 0.1, 2, 0.2]";
    for (joint, first) in [(ball, 1), (free, 4)] {
        let rates = [0, 1, 2].map(|k| format!("v{}_ball", first + k));
        let mut columns: Vec<&str> = rates.iter().map(String::as_str).collect();
        columns.extend(["qw_ball", "qx_ball", "qy_ball", "qz_ball", "energy", "x", "z"]);
        let found = last(&single("", joint), 20.0, &columns)?;
        let sign = (found[3] * expected[3]).signum();
        expect_close(&found[..3], &expected[..3], 1e-8);
        let quaternion: Vec<f64> = expected[3..7].iter().map(|value| sign * value).collect();
        expect_close(&found[3..7], &quaternion, 1e-8);
        let moves = if first == 4 { 1.0 } else { 0.0 };
        expect_close(&found[7..], &[expected[7] + 14.0 * moves, 20.0 * moves, 60.0 * moves], 1e-8);
    }
    Ok(())
}

/// A double pendulum of equal rods: `theta` are the absolute angles. Runge-Kutta steps of the
/// equations of a textbook.
#[test]
fn a_double_pendulum_satisfies_the_textbook() -> Result<(), InputError> {
    let text = include_str!("../../../examples/mechanisms/double_pendulum.toml");
    let text = format!("{text}\n[integrator]\ntolerance = 1e-11\n");
    let slope = |y: [f64; 4]| -> [f64; 4] {
        let [a, b, va, vb] = y;
        let (sin, cos) = (a - b).sin_cos();
        let g = 9.81;
        // 4/3 a'' + cos/2 b'' = p,  cos/2 a'' + 1/3 b'' = q
        let p = -0.5 * sin * vb * vb - 1.5 * g * a.sin();
        let q = 0.5 * sin * va * va - 0.5 * g * b.sin();
        let det = 4.0 / 9.0 - 0.25 * cos * cos;
        [va, vb, (p / 3.0 - 0.5 * cos * q) / det, (4.0 / 3.0 * q - 0.5 * cos * p) / det]
    };
    let mut y = [2.0, 2.5, 0.0, 0.0];
    let h = 1e-4;
    for _ in 0..20_000 {
        let at = |k: [f64; 4], s: f64| std::array::from_fn(|i| y[i] + s * k[i]);
        let a = slope(y);
        let b = slope(at(a, h / 2.0));
        let c = slope(at(b, h / 2.0));
        let d = slope(at(c, h));
        y = std::array::from_fn(|i| y[i] + h / 6.0 * (a[i] + 2.0 * b[i] + 2.0 * c[i] + d[i]));
    }
    let found = last(&text, 2.0, &["q_upper", "q_lower", "v_upper", "v_lower"])?;
    // a rotation about +y by theta moves a rod below the hinge towards -x
    let [q, r, v, w] = found[..] else { unreachable!() };
    expect_close(&[q, q + r, v, v + w], &y, 1e-8);
    let energy = |t| Ok::<f64, InputError>(last(&text, t, &["energy"])?[0]);
    expect_close(&[energy(10.0)?], &[energy(0.0)?], 1e-7);
    Ok(())
}

/// The same file moves by joint coordinates and by constraints; the constrained method has order 2.
#[test]
fn joint_coordinates_agree_with_constraints() -> Result<(), InputError> {
    let part = |x: f64| {
        format!(
            "inertia.parts = [{{ shape = \"box\", edges = [1, 0.2, 0.3], mass = 2, position = [{x}, 0.1, 0] }}]"
        )
    };
    let text = format!(
        "coordinates = \"joints\"\ngravity = [1, 0, -9.81]\n\
         bodies = [{GROUND}, {{ name = \"a\", {} }}, {{ name = \"b\", {} }}, {{ name = \"c\", {} }}]\n\
         output = {{ end = 0.05, every = 0.05 }}\n\
         [[joints]]\ntype = \"revolute\"\nbodies = [\"ground\", \"a\"]\nat = [0, 0, 0]\naxis = [0, 1, 1]\nrate = 2\n\
         [[joints]]\ntype = \"prismatic\"\nbodies = [\"b\", \"a\"]\naxis = [1, 0, 1]\nrate = -1\n\
         [[joints]]\ntype = \"spherical\"\nbodies = [\"b\", \"c\"]\nat = [2, 0, 0]\n",
        part(0.5),
        part(1.5),
        part(2.5)
    );
    let columns = ["x_1", "z_2", "qx_2", "x_3", "y_3", "qw_3", "qz_3", "energy"];
    let expected = last(&text, 0.05, &columns)?;
    let errors = [0.01, 0.005].map(|step| -> Result<f64, InputError> {
        let poses = text.replace("\"joints\"\n", &format!("\"poses\"\nintegrator.step = {step}\n"));
        let found = last(&poses, 0.05, &columns)?;
        let sign = (found[5] * expected[5]).signum();
        let off = |at: usize| {
            let flips = [2, 5, 6].contains(&at) && sign < 0.0;
            (found[at] - if flips { -expected[at] } else { expected[at] }).abs()
        };
        Ok((0..7).map(off).fold(0.0, f64::max))
    });
    let [coarse, fine] = errors;
    let (coarse, fine) = (coarse?, fine?);
    assert!(coarse < 1e-3 && (3.0..5.0).contains(&(coarse / fine)), "{coarse:e}, {fine:e}");
    Ok(())
}

/// A satellite with an arm: its momentum is constant, and the energy changes by the power.
#[test]
fn a_free_manipulator_keeps_its_momentum() -> Result<(), InputError> {
    let text = include_str!("../../../examples/mechanisms/manipulator.toml");
    let columns = ["h1", "h2", "h3", "h4", "h5", "h6", "energy", "power"];
    let (start, end) = (last(text, 0.0, &columns)?, last(text, 20.0, &columns)?);
    expect_close(&end[..6], &start[..6], 1e-6);
    let [before, at, after] = [4.99, 5.0, 5.01].map(|t| last(text, t, &columns));
    let (before, at, after) = (before?, at?, after?);
    expect_close(&[(after[6] - before[6]) / 0.02], &[at[7]], 1e-4);
    Ok(())
}

/// Millimetres and tonnes give the same steps as metres and kilograms.
#[test]
fn units_change_no_step() -> Result<(), InputError> {
    let file = |length: f64, mass: f64| {
        let at = |x: f64| x * length;
        format!(
            "coordinates = \"joints\"\ngravity = [0, {}, 0]\n\
             bodies = [{GROUND}, {{ name = \"a\", inertia.parts = [{{ shape = \"ball\", radius = {}, mass = {} }}] }}, \
             {{ name = \"b\", inertia.parts = [{{ shape = \"ball\", radius = {}, mass = {}, position = [{}, 0, 0] }}] }}]\n\
             joints = [{{ type = \"prismatic\", bodies = [\"ground\", \"a\"], axis = [1, 1, 0] }}, \
             {{ type = \"revolute\", bodies = [\"a\", \"b\"], at = [0, 0, 0], axis = [0, 0, 1] }}]\n{OUTPUT}",
            at(-9.81),
            at(0.2),
            3.0 * mass,
            at(0.3),
            2.0 * mass,
            at(1.5)
        )
    };
    let run = |text: &str| -> Result<(u64, Vec<f64>), InputError> {
        let problem = Problem::parse("tree.toml", text)?.with_columns(&["q_J1", "q_J2", "energy"]);
        let mut ready = problem.at_times(&[4.0]).motion(0)?;
        while !ready.motion.step(4.0)? {}
        Ok((ready.motion.steps(), ready.motion.row()))
    };
    let (steps, row) = run(&file(1.0, 1.0))?;
    let (same, small) = run(&file(1000.0, 0.001))?;
    assert_eq!(steps, same);
    expect_close(&[small[0] / 1000.0, small[1], small[2] / 1000.0], &row, 1e-9);
    Ok(())
}

/// Invalid files, with words of the message and of the advice.
#[test]
fn invalid_trees_are_errors_with_advice() {
    let hinge = "type = \"revolute\", at = [0, 0, 0], axis = [0, 0, 1]";
    let ball = "inertia.parts = [{ shape = \"ball\", radius = 1, mass = 1 }]";
    let two = |joints: &str| {
        format!(
            "coordinates = \"joints\"\nbodies = [{GROUND}, {{ name = \"a\", {ball} }}, {{ name = \"b\", {ball} }}]\n\
             joints = [{joints}]\n{OUTPUT}"
        )
    };
    let cases = [
        (
            two(&format!("{{ bodies = [\"ground\", \"a\"], {hinge} }}")),
            "no joint connects `b` to the ground",
            "connect every body",
        ),
        (
            single("", &format!("{hinge}, rate = [1, 2]")),
            "the revolute joint `J1` needs 1 values here, not 2",
            "one value for each freedom",
        ),
        (
            single("", "type = \"spherical\", at = [0, 0, 0], coordinate = [0, 0, 0]"),
            "needs 4 values here, not 3",
            "quaternion",
        ),
        (
            single("", "type = \"spherical\", at = [0, 0, 0], coordinate = [0, 0, 0, 0]"),
            "no direction",
            "1, 0, 0, 0",
        ),
        (
            single("", "type = \"spherical\", at = [0, 0, 0], stiffness = 1"),
            "rotations about a point have no `stiffness`",
            "damping only",
        ),
        (single("", &format!("{hinge}, rest = 1")), "`rest` needs a stiffness", "give stiffness"),
        (
            single("", &format!("{hinge}, force = \"-q_J2\"")),
            "q_J2",
            "a joint force may contain t, q_J1, v_J1",
        ),
        (single("parameters = { v_J1 = 1 }", hinge), "the name `v_J1` is already in use", "rename"),
        (single("forces.potential = \"0\"", hinge), "has no `forces`", "leave the key out"),
        (
            single("", hinge).replace("\"joints\"\n", "\"angles\"\n"),
            "`angles` is neither joints nor poses",
            "",
        ),
        (
            single("", &format!("{hinge}, damping = 1")).replace("\"joints\"\n", "\"poses\"\n"),
            "this key needs joint coordinates",
            "leave coordinates",
        ),
        (
            format!("coordinates = \"joints\"\nspace = \"so3\"\nmetric = \"identity\"\n{OUTPUT}"),
            "`coordinates` needs bodies and joints",
            "[[bodies]]",
        ),
        (single("", &format!("{hinge}, force = \"1/t\"")), "the force 1/t is inf at t = 0", ""),
        (
            single("integrator.method = \"rkmk4\"", hinge)
                .replace("integrator.tolerance = 1e-12", ""),
            "joint coordinates need one of dop853",
            "",
        ),
    ];
    for (text, message, advice) in cases {
        let Err(error) = last(&text, 1.0, &["t"]) else { panic!("no error: {text}") };
        let found = format!("{error:?}");
        let found = found.replace("\\\"", "\"").replace("\\n", " ");
        assert!(found.contains(message) && found.contains(advice), "{text}: {found}");
    }
}

/// Keys of other problems are not ignored, with joint coordinates or with poses.
#[test]
fn keys_of_other_problems_are_refused() {
    let lines = [
        "metric = \"identity\"",
        "connection = \"plus\"",
        "invariance = \"left\"",
        "hamiltonian = \"h1\"",
        "embedding = [\"x\", \"y\", \"z\"]",
        "transport = { v = [1, 0, 0] }",
        "initial.momentum = [0, 0, 0]",
        "initial.spatial_velocity = [0, 0, 0]",
        "initial.spatial_momentum = [0, 0, 0]",
        "initial.quaternion = [1, 0, 0, 0]",
        "initial.position = [0, 0, 0]",
        "initial.coordinates = [0, 0, 0]",
    ];
    for line in lines {
        let key = line.split(' ').next().unwrap().trim_start_matches("initial.");
        for coordinates in ["joints", "poses"] {
            let text = single(line, "type = \"revolute\", at = [0, 0, 0], axis = [0, 0, 1]")
                .replace("\"joints\"\n", &format!("\"{coordinates}\"\n"));
            let Err(error) = last(&text, 1.0, &["t"]) else { panic!("no error: {text}") };
            let found = format!("{error:?}");
            assert!(found.contains(&format!("has no `{key}`")), "{text}: {found}");
        }
    }
}
