//! Loops, contacts, motors and formulas as constraints in joint coordinates: closed forms, the balance
//! of reactions, and what must not matter.

use super::{GROUND, expect_close, last, single};
use crate::claims::problems::linkages::windows;
use affinor_documents::input::InputError;
use affinor_documents::problem::Problem;
use std::f64::consts::FRAC_PI_2;

/// An example, with other columns and a tolerance.
pub fn example(name: &str, tolerance: f64) -> String {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../examples/mechanisms");
    let text = std::fs::read_to_string(format!("{folder}/{name}.toml")).expect("an example");
    let (before, _) = text.split_once("[integrator]").expect("an integrator");
    let output = "[output]\nend = 1\nevery = 1\n";
    format!("{before}[integrator]\ntolerance = {tolerance}\n{output}")
}

/// Bricard's mechanism swings with a period, and returns to its initial position. Each joint in turn
/// may be the one that closes the loop.
#[test]
fn bricards_mechanism_does_not_depend_on_the_cut() -> Result<(), InputError> {
    let text = example("bricard", 1e-11);
    let columns = ["q_J1", "q_J3", "x_3", "y_3", "z_3"];
    let expected = last(&text, 1.0, &columns)?;
    let (head, rest) = text.split_once("[[joints]]").expect("joints");
    let (list, tail) = rest.split_once("[integrator]").expect("an integrator");
    let joints: Vec<&str> = list.split("[[joints]]").collect();
    assert_eq!(joints.len(), 6);
    for first in [2, 5] {
        // the cut depends on the order of the joints
        let order = (0..6).map(|k| (first + 5 * k) % 6);
        let listed: Vec<String> =
            order.map(|k| format!("[[joints]]\nname = \"J{}\"{}", k + 1, joints[k])).collect();
        let other = format!("{head}{}[integrator]{tail}", listed.concat());
        expect_close(&last(&other, 1.0, &columns)?, &expected, 1e-8);
    }
    Ok(())
}

/// The reactions of the ground and the weight change the momentum: `h' = m g + sum f`. In a planar
/// linkage, the reactions along the axes are those of the smallest norm, which is zero.
#[test]
fn reactions_balance_the_momentum() -> Result<(), InputError> {
    let text = example("slider_crank", 1e-11);
    let at = |t: f64| {
        let columns = ["h4", "h5", "g11_1", "g21_1", "r4_main_bearing", "r5_main_bearing"];
        let more = ["r6_main_bearing", "r4_guide", "r5_guide", "r6_guide", "r3_piston_pin"];
        last(&text, t, &[&columns[..], &more].concat())
    };
    let (t, s) = (0.35, 1e-4);
    let [before, here, after] = [at(t - s)?, at(t)?, at(t + s)?];
    let rate = |k: usize| (after[k] - before[k]) / (2.0 * s);
    // the frame of the crank is turned
    let (cos, sin) = (here[2], here[3]);
    let force = [cos * here[4] - sin * here[5] + here[7], sin * here[4] + cos * here[5] + here[8]];
    let mass = 0.4 + 1.0 + 0.8 + 0.2 + 0.5;
    expect_close(&force, &[rate(0), rate(1) + mass * 9.81], 1e-4);
    // along the axis; the guide has no force along its direction, and pins have no moment
    expect_close(&[here[6], here[9], here[7], here[10]], &[0.0; 4], 1e-9);
    Ok(())
}

/// A crank with a motor: the slider has its closed form, and the power of the motor changes the
/// energy.
#[test]
fn motors_move_a_slider_crank() -> Result<(), InputError> {
    let text =
        example("slider_crank", 1e-11).replace("rate = 10\n", "motor = \"-w*t - 0.1*t^2\"\n");
    let text = text.replace("[parameters]", "[parameters]\nw = 6");
    let at = |t: f64| last(&text, t, &["x_3", "q_main_bearing", "energy", "power", "v_guide"]);
    let (t, s) = (0.7, 1e-4);
    let [before, here, after] = [at(t - s)?, at(t)?, at(t + s)?];
    let angle = FRAC_PI_2 - 6.0 * t - 0.1 * t * t;
    let (r, l): (f64, f64) = (0.15, 0.45);
    let place = r * angle.cos() + (l * l - (r * angle.sin()).powi(2)).sqrt();
    let start = (l * l - r * r).sqrt();
    expect_close(&here[..2], &[place - start, angle - FRAC_PI_2], 1e-10);
    expect_close(&[here[3]], &[(after[2] - before[2]) / (2.0 * s)], 1e-4);
    expect_close(&[here[4]], &[(after[0] - before[0]) / (2.0 * s)], 1e-6);
    Ok(())
}

/// Two flywheels with a gear `q_a + 3 q_b = 0`, driven by a torque on the first: `(I_a + I_b/9) q''
/// = 2`. The multiplier is the torque of the gear. A second copy of the constraint changes nothing.
#[test]
fn gears_are_formulas() -> Result<(), InputError> {
    let wheel = "inertia.parts = [{ shape = \"cylinder\", radius = 1, height = 1, mass = 4 }]";
    let hinge = "type = \"revolute\", at = [0, 0, 0], axis = [0, 0, 1]";
    let text = |gears: &str| {
        format!(
            "constraints = [{gears}]\nbodies = [{GROUND}, {{ name = \"a\", {wheel} }}, \
             {{ name = \"b\", {wheel} }}]\njoints = [{{ name = \"a\", bodies = [\"ground\", \"a\"], {hinge}, \
             force = \"2\" }}, {{ name = \"b\", bodies = [\"ground\", \"b\"], {hinge} }}]\n\
             integrator.tolerance = 1e-12\noutput = {{ end = 1, every = 1 }}\n"
        )
    };
    let acceleration = 2.0 / (2.0 + 2.0 / 9.0);
    let t = 3.0;
    let columns = ["q_a", "v_b", "lambda1", "violation"];
    let found = last(&text("\"q_a + 3*q_b\""), t, &columns)?;
    let expected = [0.5 * acceleration * t * t, -acceleration * t / 3.0];
    expect_close(&found[..2], &expected, 1e-10);
    // 2 q_a'' = 2 - lambda
    expect_close(&found[2..], &[2.0 - 2.0 * acceleration, 0.0], 1e-10);
    let columns = ["q_a", "v_b", "lambda1", "lambda2"];
    let twice = last(&text("\"q_a + 3*q_b\", \"2*q_a + 6*q_b\""), t, &columns)?;
    expect_close(&twice[..2], &expected, 1e-10);
    // the two constraints share the torque by their sizes
    let torque = 2.0 - 2.0 * acceleration;
    expect_close(&twice[2..], &[0.5 * torque, 0.25 * torque], 1e-10);
    // the same gear as a constraint on the rates
    let rates = text("").replace("constraints = []", "velocity_constraints = [\"v_a + 3*v_b\"]");
    expect_close(&last(&rates, t, &["q_a", "v_b"])?, &expected, 1e-10);
    Ok(())
}

/// One body with a joint and a contact. It moves in a field of gravity.
fn rolling(gravity: [f64; 3], part: &str, joint: &str, contact: &str) -> String {
    format!(
        "gravity = {gravity:?}\nbodies = [{GROUND}, {{ name = \"body\", \
         inertia.parts = [{part}] }}]\njoints = [{{ name = \"J\", bodies = [\"ground\", \"body\"], {joint} }}]\n\
         contacts = [{{ body = \"body\", {contact} }}]\nintegrator.tolerance = 1e-12\n\
         output = {{ end = 1, every = 1 }}\n"
    )
}

/// A homogeneous ball on an inclined plane: the acceleration is `5/7 g sin(alpha)`. A spin about the
/// normal does not disturb it.
#[test]
fn balls_roll_down_a_plane() -> Result<(), InputError> {
    let (g, alpha): (f64, f64) = (9.81, 0.3);
    let text = rolling(
        [g * alpha.sin(), 0.0, -g * alpha.cos()],
        "{ shape = \"ball\", radius = 0.2, mass = 3, position = [0, 0, 0.2] }",
        "type = \"free\", at = [0, 0, 0.2], rate = [0, 0.5, 0, -2.5, 0, 4]",
        "type = \"ball\", at = [0, 0, 0.2], radius = 0.2",
    );
    let t = 1.7;
    let found = last(&text, t, &["x", "y", "z", "lambda1", "energy"])?;
    let centre = 5.0 / 14.0 * g * alpha.sin() * t * t;
    let poses = last(&text, t, &["q1_J", "q2_J", "q3_J"])?;
    expect_close(&poses, &[centre, 0.5 * t, 0.0], 1e-10);
    // the multiplier of the normal is the negative force
    expect_close(&[found[3]], &[-3.0 * g * alpha.cos()], 1e-9);
    let [start, end] = [last(&text, 1e-9, &["energy"])?[0], found[4]];
    expect_close(&[end], &[start], 1e-9);
    Ok(())
}

/// A disk rolls in a circle at constant lean, with the relation between lean, radius and speed of a
/// steady motion.
#[test]
fn disks_roll_in_circles() -> Result<(), InputError> {
    let (radius, lean, turn): (f64, f64, f64) = (0.5, 0.4, 0.9);
    // the spin about the axis follows from the balance of moments about the centre
    let (g, k) = (9.81, radius * radius);
    let (sin, cos) = (lean.sin(), lean.cos());
    // (I3 + m r^2) s turn cos + I1 turn^2 sin cos = m g r sin, with I1 = k/4 and I3 = k/2
    let spin = (g * radius * sin - 0.25 * k * turn * turn * sin * cos) / (1.5 * k * turn * cos);
    // the axis in the plane of y and z; the disk leans to the left for a turn to the left
    let axis = [0.0, cos, -sin];
    let centre = [0.0, radius * sin, radius * cos];
    // angular velocity: turn about z, and the spin about the axis
    let along = spin - turn * -sin;
    let w = [0.0, along * axis[1], along * axis[2] + turn];
    let v = spin * radius;
    let text = rolling(
        [0.0, 0.0, -g],
        &format!(
            "{{ shape = \"inertia\", mass = 2, position = {centre:?}, matrix = [[{0}, 0, 0], [0, {1}, {2}], \
             [0, {2}, {3}]] }}",
            2.0 * k / 4.0,
            2.0 * (k / 4.0 + k / 4.0 * cos * cos),
            2.0 * (k / 4.0 * -sin * cos),
            2.0 * (k / 4.0 + k / 4.0 * sin * sin)
        ),
        &format!(
            "type = \"free\", at = {centre:?}, rate = [{v}, 0, 0, {}, {}, {}]",
            w[0], w[1], w[2]
        ),
        &format!("type = \"wheel\", at = {centre:?}, axis = {axis:?}, radius = {radius}"),
    );
    let t = 2.0;
    let found = last(&text, t, &["q3_J", "q1_J", "q2_J", "violation"])?;
    let path = v / turn;
    let expected = [0.0, path * (turn * t).sin(), path * (1.0 - (turn * t).cos()), 0.0];
    expect_close(&found, &expected, 1e-8);
    Ok(())
}

/// A knife edge at the centre of mass of a body in the plane: the sleigh moves in a circle at constant
/// speed. The planar joint and the edge both keep the height, which is redundant.
#[test]
fn knife_edges_slide_along_their_direction() -> Result<(), InputError> {
    let text = rolling(
        [0.0, 0.0, -9.81],
        "{ shape = \"box\", edges = [1, 0.5, 0.2], mass = 2, position = [0.3, 0, 0] }",
        "type = \"planar\", at = [0.3, 0, 0], axis = [0, 0, 1], rate = [0.8, 0, -1.5]",
        "type = \"edge\", at = [0.3, 0, 0], axis = [1, 0, 0]",
    );
    let t = 2.5;
    let found = last(&text, t, &["g14", "g24", "g11", "g21", "energy"])?;
    let (turn, speed): (f64, f64) = (0.8, 1.5);
    let angle = turn * t;
    let centre = [0.3 + speed / turn * angle.sin(), speed / turn * (1.0 - angle.cos())];
    // the frame of the body was the ground frame
    let (cos, sin) = (angle.cos(), angle.sin());
    let origin = [centre[0] - 0.3 * cos, centre[1] - 0.3 * sin];
    expect_close(&found[..4], &[origin[0], origin[1], cos, sin], 1e-10);
    Ok(())
}

/// Coordinates of some joints are given, and the others follow. Rounded coordinates are corrected,
/// with a note. A larger error ends the run.
#[test]
fn mechanisms_are_assembled() -> Result<(), InputError> {
    let text = windows(1, 1.0, [0.0, 0.0], 1.0, -9.81);
    let given = |joint: &str, value: f64, text: &str| {
        let key = format!("name = \"{joint}\"\n");
        text.replace(&key, &format!("{key}coordinate = {value}\n"))
    };
    let columns = ["q_A0", "q_A1", "q_B0", "q_C0"];
    let start = |text: &str| -> Result<(Vec<f64>, Vec<String>), InputError> {
        let ready = Problem::parse("bar.toml", text)?.with_columns(&columns).motion(0)?;
        Ok((ready.motion.row(), ready.notes))
    };
    let (found, notes) = start(&given("A0", 0.7, &text))?;
    expect_close(&found, &[0.7, 0.7, -0.7, 0.7], 1e-12);
    assert!(notes.len() == 1 && notes[0].contains("3 of 6 equations"), "{notes:?}");
    let rounded = given("A1", 0.7003, &given("A0", 0.7, &text));
    let (found, notes) = start(&rounded)?;
    expect_close(&[found[0] - found[1]], &[0.0], 1e-12);
    assert!(notes[0].contains("were changed by up to"), "{notes:?}");
    let Err(error) = start(&given("A1", 0.9, &given("A0", 0.7, &text))) else { panic!() };
    let message = error.to_string();
    assert!(
        message.contains("the loop of the body `bar0` cannot close")
            || message.contains("the loop of the body `rod1` cannot close"),
        "{message}"
    );
    Ok(())
}

/// Invalid constraints are errors with their place and a remedy.
#[test]
fn invalid_constraints_are_errors() {
    let hinge = "type = \"revolute\", at = [0, 0, 0], axis = [0, 0, 1]";
    let free = "type = \"free\", at = [0, 0, 0]";
    let touching = |keys: &str| single(&format!("contacts = [{{ {keys} }}]"), free);
    let spring = |keys: &str| single(&format!("springs = [{{ {keys} }}]"), hinge);
    let ends = "bodies = [\"ground\", \"body\"], from = [0, 0, 0]";
    let cases = [
        (
            touching("type = \"skate\", body = \"body\", at = [0, 0, 0]"),
            "no contact of the type `skate`",
            "wheel, ball, edge",
        ),
        (
            touching("type = \"wheel\", body = \"body\", at = [0, 0, 0], radius = 1"),
            "a contact of type wheel needs `axis`",
            "axis = [0, 1, 0]",
        ),
        (
            touching(
                "type = \"ball\", body = \"body\", at = [0, 0, 0], radius = 1, axis = [0, 0, 1]",
            ),
            "does not use the key `axis`",
            "leave the key out",
        ),
        (
            touching("type = \"ball\", body = \"body\", at = [0, 0, 0], radius = -1"),
            "the value -1 is not positive",
            "",
        ),
        (
            touching("type = \"ball\", body = \"ground\", at = [0, 0, 0], radius = 1"),
            "a fixed body cannot roll",
            "a body that moves",
        ),
        (
            touching("type = \"ball\", body = \"boy\", at = [0, 0, 0], radius = 1"),
            "there is no body `boy`",
            "did you mean `body`?",
        ),
        (
            touching(
                "type = \"wheel\", body = \"body\", at = [0, 0, 0], radius = 1, axis = [0, 0, 2]",
            ),
            "the axis of the wheel is orthogonal",
            "not parallel",
        ),
        (
            touching(
                "type = \"edge\", body = \"body\", at = [0, 0, 0], axis = [0, 1, 0], normal = [0, 0, 0]",
            ),
            "the normal of the plane is zero",
            "[0, 0, 1]",
        ),
        (
            spring(&format!("{ends}, to = [0, 0, 1]")),
            "spring 1 has no force",
            "stiffness or damping",
        ),
        (
            spring(&format!("{ends}, to = [0, 0, 0], stiffness = 1, length = 1")),
            "the ends of the spring coincide",
            "length = 0",
        ),
        (
            spring("bodies = [\"body\"], from = [0, 0, 0], to = [0, 0, 1], stiffness = 1"),
            "spring 1 connects 1 bodies",
            "connects two bodies",
        ),
        (
            single("constraints = [\"q_J1 - v_J1\"]", hinge),
            "v_J1",
            "a constraint may contain t, q_J1",
        ),
        (
            single("constraints = [\"q_J1 - 1\"]", &format!("{hinge}, coordinate = 0")),
            "the constraint cannot be satisfied: it is off by 1",
            "change the initial coordinates",
        ),
        (
            single("velocity_constraints = [\"v_J1^2\"]", hinge),
            "not affine in the velocity",
            "may contain t, q_J1, v_J1",
        ),
        (
            single("velocity_constraints = [\"q_J1\"]", hinge),
            "the constraint contains no rate",
            "among `constraints`",
        ),
        (
            single("", &format!("{hinge}, motor = \"t\", rate = 1")),
            "a joint with a motor has no initial value",
            "leave the key out",
        ),
        (
            single("", "type = \"cylindrical\", at = [0, 0, 0], axis = [0, 0, 1], motor = \"t\""),
            "does not have one coordinate",
            "`constraints`",
        ),
        (single("", &format!("{hinge}, motor = \"q_J1\"")), "q_J1", "a motor is a formula in t"),
        (
            single("springs = []", hinge).replace("\"joints\"\n", "\"poses\"\n"),
            "`springs` needs joint coordinates",
            "leave coordinates",
        ),
    ];
    for (text, message, advice) in cases {
        let Err(error) = last(&text, 1.0, &["t"]) else { panic!("no error: {text}") };
        let found = format!("{error:?}");
        let found = found.replace("\\\"", "\"").replace("\\n", " ");
        assert!(found.contains(message) && found.contains(advice), "{text}: {found}");
    }
}

/// Two hinges about one axis, with constraints.
pub fn two_hinges(keys: &str, first: &str, second: &str) -> String {
    let part =
        "inertia.parts = [{ shape = \"ball\", radius = 0.5, mass = 2, position = [0, 0, -2] }]";
    let hinge =
        "bodies = [\"ground\", \"NAME\"], type = \"revolute\", at = [0, 0, 0], axis = [0, 1, 0]";
    let joint = |name: &str, more: &str| {
        format!("{{ name = \"{name}\", {}, {more} }}", hinge.replace("NAME", name))
    };
    format!(
        "{keys}\nbodies = [{GROUND}, {{ name = \"a\", {part} }}, {{ name = \"b\", {part} }}]\njoints = [{}, {}]\n\
         integrator.tolerance = 1e-10\noutput = {{ end = 1, every = 1 }}\n",
        joint("a", first),
        joint("b", second)
    )
}

/// Contradictory constraints are errors at the start, or end the run at a later time.
#[test]
fn contradictory_constraints_end_the_run() {
    let start = "the constraint allows no acceleration at these rates";
    let later = "the constraints cannot be satisfied at t = ";
    let cases = [
        ("constraints = [\"q_a - t\", \"q_a - t - 0.1*t^2\"]", start),
        ("velocity_constraints = [\"v_a - t\", \"v_a - 2*t\"]", start),
        ("constraints = [\"q_a - t\", \"q_a - t - 0.1*t^4\"]", later),
        ("velocity_constraints = [\"v_a - t\", \"v_a - t - t^3\"]", later),
    ];
    for (keys, message) in cases {
        let text = two_hinges(keys, "rest = 0, stiffness = 0", "rate = 0");
        let Err(error) = last(&text, 1.0, &["q_a"]) else { panic!("{keys}") };
        assert!(error.to_string().contains(message), "{keys}: {error}");
    }
}

/// Slow rates are consistent in a strong field of gravity, however small they are.
#[test]
fn slow_rates_are_accepted() -> Result<(), InputError> {
    for rate in ["1e-3", "1e-6", "1e-12", "0"] {
        let text =
            example("slider_crank", 1e-10).replace("rate = 10\n", &format!("rate = {rate}\n"));
        let found = last(&text, 0.1, &["energy", "violation"])?;
        let start: f64 = last(&text, 1e-9, &["energy"])?[0];
        expect_close(&found, &[start, 0.0], 1e-9);
    }
    Ok(())
}

/// In a flat parallelogram, the rates of the two cranks may have equal or opposite signs to first
/// order. Opposite signs with arbitrary rates of the rod belong to no motion.
#[test]
fn rates_at_a_singular_position_belong_to_a_branch() -> Result<(), InputError> {
    let rod = |x: f64| {
        format!(
            "inertia.parts = [{{ shape = \"rod\", length = 1, mass = 1, position = [{x}, 0, 0], rotation = [0, \
             \"pi/2\", 0] }}]"
        )
    };
    let hinge = |ends: [&str; 2], x: f64, rate: &str| {
        format!(
            "{{ name = \"{}{}\", bodies = [\"{}\", \"{}\"], type = \"revolute\", at = [{x}, 0, 0], axis = [0, 0, 1]{rate} }}",
            ends[0], ends[1], ends[0], ends[1]
        )
    };
    let text = |rates: [&str; 2]| {
        format!(
            "bodies = [{GROUND}, {{ name = \"a\", {} }}, {{ name = \"c\", {} }}, {{ name = \"b\", {} }}]\njoints = [{}, {}, \
             {}, {}]\nintegrator.tolerance = 1e-10\noutput = {{ end = 1, every = 1 }}\n",
            rod(0.5),
            rod(1.5),
            rod(1.5),
            hinge(["ground", "a"], 0.0, rates[0]),
            hinge(["a", "c"], 1.0, ""),
            hinge(["c", "b"], 2.0, ""),
            hinge(["ground", "b"], 1.0, rates[1])
        )
    };
    // the rod stays parallel to the ground
    let found =
        last(&text([", rate = 1", ", rate = 1"]), 0.5, &["q_grounda", "q_groundb", "energy"])?;
    expect_close(&found, &[0.5, 0.5, 1.0 / 6.0 + 0.5 + 1.0 / 6.0], 1e-8);
    let Err(error) = last(&text([", rate = 1", ", rate = -0.5"]), 0.5, &["energy"]) else {
        panic!()
    };
    assert!(error.to_string().contains("allows no acceleration at these rates"), "{error}");
    Ok(())
}

/// The moment of a reaction is about the same point if the bodies of the joint change their order.
#[test]
fn reactions_do_not_depend_on_the_order_of_bodies() -> Result<(), InputError> {
    for kind in ["planar", "prismatic"] {
        let text = |bodies: &str, sign: f64| {
            format!(
                "gravity = [0, 0, -9.81]\nbodies = [{GROUND}, {{ name = \"a\", inertia.parts = [{{ shape = \"ball\", radius \
                 = 0.5, mass = 2, position = [1, 2, 3] }}] }}]\njoints = [{{ name = \"J\", bodies = [{bodies}], type = \
                 \"{kind}\", axis = [0, 1, {sign}] }}]\nintegrator.tolerance = 1e-10\noutput = {{ end = 1, every = 1 }}\n"
            )
        };
        let columns = ["r1_J", "r2_J", "r3_J", "r4_J", "r5_J", "r6_J"];
        let forward = last(&text("\"ground\", \"a\"", 1.0), 0.2, &columns)?;
        let mut backward = last(&text("\"a\", \"ground\"", 1.0), 0.2, &columns)?;
        backward.iter_mut().for_each(|value| *value = -*value);
        expect_close(&backward, &forward, 1e-9);
        assert!(forward[5] > 1.0, "{forward:?}");
    }
    Ok(())
}
