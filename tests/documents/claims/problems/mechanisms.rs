//! Mechanisms against programs that share no code with this library: `tests/references/mechanisms.py`
//! integrates them in minimal coordinates with at least 15 digits.

use affinor_documents::input::InputError;
use affinor_documents::problem::Problem;
use nalgebra::{Complex, Matrix3, Vector3};
use serde_json::Value;
use std::fmt::Write as _;

fn references() -> Value {
    let text = include_str!("../../../data/mechanisms.json");
    serde_json::from_str(text).expect("references")
}

fn number(value: &Value) -> f64 {
    let text = value.as_str().expect("a number as text");
    text.parse().expect("a number")
}

fn numbers(value: &Value) -> Vec<f64> {
    value.as_array().expect("a list").iter().map(number).collect()
}

/// The columns at the times of the states of a reference.
fn rows(text: &str, states: &Value, columns: &[&str]) -> Result<Vec<Vec<f64>>, InputError> {
    let states = states.as_array().expect("states");
    let times: Vec<f64> = states.iter().map(|state| number(&state["time"])).collect();
    let problem = Problem::parse("mechanism.toml", text)?.with_columns(columns);
    let mut ready = problem.at_times(&times).motion(0)?;
    let mut rows = vec![];
    for t in times {
        while !ready.motion.step(t)? {}
        rows.push(ready.motion.row());
    }
    Ok(rows)
}

fn expect_close(found: &[f64], expected: &[f64], tolerance: f64) {
    assert_eq!(found.len(), expected.len());
    for (at, (found, expected)) in found.iter().zip(expected).enumerate() {
        let error = (found - expected).abs();
        assert!(error <= tolerance * expected.abs().max(1.0), "{at}: {found}, not {expected}");
    }
}

/// Problem A04 of the IFToMM benchmark library: R. Bricard's mechanism, for 10 s.
#[test]
fn bricards_mechanism() -> Result<(), InputError> {
    let text = include_str!("../../../../examples/mechanisms/bricard.toml")
        .replace("tolerance = 1e-9", "tolerance = 1e-12");
    let states = &references()["bricard"]["cylinder"]["states"];
    let names: Vec<String> =
        ["q", "v"].iter().flat_map(|q| (1..=6).map(move |k| format!("{q}_J{k}"))).collect();
    let names: Vec<&str> = names.iter().map(String::as_str).collect();
    for (row, state) in rows(&text, states, &names)?.iter().zip(states.as_array().unwrap()) {
        expect_close(&row[..6], &numbers(&state["angles"]), 1e-8);
        expect_close(&row[6..12], &numbers(&state["rates"]), 1e-7);
    }
    Ok(())
}

/// Problem A01: a pendulum on a ball joint, for 10 s.
#[test]
fn planar_pendulum() -> Result<(), InputError> {
    let text = "gravity = [0, -9.81, 0]\nbodies = [{ name = \"ground\", fixed = true }, { name = \"bob\", \
                inertia.parts = [{ shape = \"points\", points = [[1, 0, 0, 0]] }] }]\njoints = [{ type = \"revolute\", \
                bodies = [\"ground\", \"bob\"], at = [-1, 0, 0], axis = [0, 0, 1] }]\n\
                integrator.tolerance = 1e-13\noutput = { end = 1, every = 1 }\n";
    let states = &references()["pendulum"]["states"];
    let rows = rows(text, states, &["x", "y", "q_J1", "v_J1"])?;
    for (row, state) in rows.iter().zip(states.as_array().unwrap()) {
        let expected = numbers(&state["position"]);
        // the bob is released at a horizontal distance of 1 from the pivot
        let place = [row[2].cos(), row[2].sin()];
        expect_close(&place, &expected, 1e-10);
        let velocity = [-row[3] * place[1], row[3] * place[0]];
        expect_close(&velocity, &numbers(&state["velocity"]), 1e-9);
    }
    Ok(())
}

/// Rolling bodies: a disk and a coin that leans while it rolls.
#[test]
fn rolling_disks() -> Result<(), InputError> {
    let all = references();
    for (name, tolerance) in [("disk", 1e-9), ("coin", 1e-9)] {
        let reference = &all[name];
        let get = |key: &str| number(&reference[key]);
        let start = &reference["start"];
        let (mass, radius) = (get("mass"), get("radius"));
        let [across, along] = ["across", "along"].map(|key| number(&reference["inertia"][key]));
        let vector = |key: &str| numbers(&start[key]);
        let (place, velocity, spin) =
            (vector("position"), vector("velocity"), vector("angular_velocity"));
        // the axis of the disk is its third axis, and that of the coin its first one
        let axis = vector(if name == "disk" { "e3" } else { "e1" });
        let matrix: Vec<Vec<f64>> = (0..3)
            .map(|i| {
                (0..3)
                    .map(|j| {
                        let unit = f64::from(u8::from(i == j));
                        across * unit + (along - across) * axis[i] * axis[j]
                    })
                    .collect()
            })
            .collect();
        let rates = [velocity, spin].concat();
        let mut text = String::from("gravity = [0, 0, -9.81]\n");
        let _ = write!(
            text,
            "bodies = [{{ name = \"ground\", fixed = true }}, {{ name = \"disk\", inertia.parts = [{{ shape = \
             \"inertia\", mass = {mass}, position = {place:?}, matrix = {matrix:?} }}] }}]\njoints = [{{ name = \"J\", \
             type = \"free\", bodies = [\"ground\", \"disk\"], at = {place:?}, rate = {rates:?} }}]\ncontacts = [{{ type = \
             \"wheel\", body = \"disk\", at = {place:?}, axis = {axis:?}, radius = {radius} }}]\n\
             integrator.tolerance = 1e-13\noutput = {{ end = 1, every = 1 }}\n"
        );
        let states = &reference["states"];
        let columns = ["q1_J", "q2_J", "q3_J", "v1_J", "v2_J", "v3_J"];
        for (row, state) in rows(&text, states, &columns)?.iter().zip(states.as_array().unwrap()) {
            let expected = numbers(&state["position"]);
            let place: Vec<f64> = (0..3).map(|i| row[i] + place[i]).collect();
            expect_close(&place, &expected, tolerance);
            expect_close(&row[3..], &numbers(&state["velocity"]), tolerance);
        }
    }
    Ok(())
}

/// A moving body with a mass, its centre and its inertia about the centre.
fn body(name: &str, mass: f64, centre: [f64; 3], matrix: [[f64; 3]; 3]) -> String {
    format!(
        "[[bodies]]\nname = \"{name}\"\ninertia.parts = [{{ shape = \"inertia\", mass = {mass}, position = {centre:?}, \
         matrix = {matrix:?} }}]\n"
    )
}

fn diagonal(moments: [f64; 3]) -> [[f64; 3]; 3] {
    let [a, b, c] = moments;
    [[a, 0.0, 0.0], [0.0, b, 0.0], [0.0, 0.0, c]]
}

fn joint(name: &str, ends: [&str; 2], keys: &str) -> String {
    let [a, b] = ends;
    format!("[[joints]]\nname = \"{name}\"\nbodies = [\"{a}\", \"{b}\"]\n{keys}\n")
}

const GROUND: &str = "[[bodies]]\nname = \"ground\"\nfixed = true\n";
const OUTPUT: &str = "[output]\nend = 1\nevery = 1\n";

/// Problem A03: Andrews' squeezer, seven bodies and four loops that are driven for 0.03 s. Errors grow
/// by four decimal places in this time.
#[test]
fn andrews_squeezer() -> Result<(), InputError> {
    let all = references();
    let data = &all["squeezer"];
    let mut text = String::from(GROUND);
    let pair = |value: &Value| -> [f64; 2] { numbers(value)[..].try_into().expect("two numbers") };
    for own in data["bodies"].as_array().unwrap() {
        let [x, y] = pair(&own["centre"]);
        let inertia = number(&own["inertia"]);
        let matrix = diagonal([inertia / 2.0, inertia / 2.0, inertia]);
        text += &body(own["name"].as_str().unwrap(), number(&own["mass"]), [x, y, 0.0], matrix);
    }
    for (at, own) in data["joints"].as_array().unwrap().iter().enumerate() {
        let [x, y] = pair(&own["at"]);
        let ends = [0, 1].map(|k| own["bodies"][k].as_str().unwrap());
        let force = if at == 0 { "\nforce = 0.033" } else { "" };
        let keys = format!("type = \"revolute\"\nat = [{x}, {y}, 0]\naxis = [0, 0, 1]{force}");
        text += &joint(&format!("J{}", at + 1), ends, &keys);
    }
    let spring = &data["spring"];
    let ([x, y], [u, v]) = (pair(&spring["at"]), pair(&spring["ground"]));
    let (stiffness, length) = (number(&spring["stiffness"]), number(&spring["rest_length"]));
    let _ = write!(
        text,
        "[[springs]]\nbodies = [\"BDE\", \"ground\"]\nfrom = [{x}, {y}, 0]\nto = [{u}, {v}, 0]\nstiffness = \
         {stiffness}\nlength = {length}\n[integrator]\ntolerance = 1e-13\n{OUTPUT}"
    );
    let found = rows(&text, &data["states"], &["q_J1", "q_J6", "v_J1", "v_J6"])?;
    let state = &data["states"][0];
    let (angles, rates) = (numbers(&state["angles"]), numbers(&state["rates"]));
    let start = numbers(&data["start"]);
    let expected = [angles[0] - start[0], angles[2] - start[2], rates[0], rates[2]];
    expect_close(&found[0], &expected, 1e-8);
    Ok(())
}

/// The spatial slider-crank: a rod between a ball joint and a universal joint.
#[test]
fn spatial_slider_crank() -> Result<(), InputError> {
    let all = references();
    let data = &all["slider_crank"];
    let (b, c) = ([0.0, 0.1, 0.2], [0.2, 0.0, 0.0]);
    let along: Vec<f64> = (0..3).map(|i| (c[i] - b[i]) / 0.3).collect();
    let rod = [0, 1, 2].map(|i| {
        [0, 1, 2].map(|j| 0.004 * f64::from(u8::from(i == j)) - 0.0036 * along[i] * along[j])
    });
    let axes = ["slider_axis", "rod_axis"].map(|key| numbers(&data["universal_joint"][key]));
    let text = [
        "gravity = [0, 0, -9.81]\n".into(),
        GROUND.into(),
        body("crank", 0.12, [0.0, 0.1, 0.16], diagonal([1e-4, 1e-4, 1e-5])),
        body("rod", 0.5, [0.1, 0.05, 0.1], rod),
        body("slider", 2.0, c, diagonal([1e-4; 3])),
        joint(
            "crank",
            ["ground", "crank"],
            "type = \"revolute\"\nat = [0, 0.1, 0.12]\naxis = [1, 0, 0]\nrate = 6",
        ),
        joint("ball", ["crank", "rod"], "type = \"spherical\"\nat = [0, 0.1, 0.2]"),
        joint(
            "universal",
            ["slider", "rod"],
            &format!(
                "type = \"universal\"\nat = [0.2, 0, 0]\naxis = {:?}\nsecond_axis = {:?}",
                axes[0], axes[1]
            ),
        ),
        joint("guide", ["ground", "slider"], "type = \"prismatic\"\naxis = [1, 0, 0]"),
        format!("[integrator]\ntolerance = 1e-12\n{OUTPUT}"),
    ]
    .concat();
    let columns = ["q_crank", "v_crank", "q_guide", "v_guide"];
    let found = rows(&text, &data["states"], &columns)?;
    for (row, state) in found.iter().zip(data["states"].as_array().unwrap()) {
        let keys = ["crank_angle", "crank_rate", "slider", "slider_velocity"];
        let mut expected = keys.map(|key| number(&state[key]));
        expected[2] -= 0.2;
        expect_close(row, &expected, 1e-8);
    }
    Ok(())
}

/// Problem A05: the flyball governor with stiff springs and dampers, by the implicit method.
#[test]
fn flyball_governor() -> Result<(), InputError> {
    let all = references();
    let data = &all["governor"];
    let half = 0.75_f64.sqrt();
    let mut parts = vec![
        "gravity = [0, 0, -9.81]\n".to_string(),
        GROUND.into(),
        "[[bodies]]\nname = \"shaft\"\ninertia.parts = [{ shape = \"box\", edges = [0.01, 0.01, 1], density = 3000, \
         position = [0, 0, 0.5] }]\n"
            .into(),
        "[[bodies]]\nname = \"slider\"\ninertia.parts = [{ shape = \"box\", edges = [0.1, 0.1, 0.1], density = 3000, \
         position = [0, 0, 0.5] }]\n"
            .into(),
        joint("shaft", ["ground", "shaft"], "type = \"revolute\"\nat = [0, 0, 0]\naxis = [0, 0, 1]\nrate = \"spin\""),
        joint("slide", ["shaft", "slider"], "type = \"prismatic\"\naxis = [0, 0, 1]"),
    ];
    for (name, side) in [("right", 1.0), ("left", -1.0)] {
        let (x, z) = (side * (0.05 + half / 2.0), 0.75);
        let (far, low) = (side * (0.05 + half), 0.5);
        // the turn about y that leads from x to the rod
        let turn = side * std::f64::consts::FRAC_PI_6;
        parts.push(format!(
            "[[bodies]]\nname = \"{name}\"\ninertia.parts = [{{ shape = \"box\", edges = [1, 0.01, 0.01], density = \
             3000, position = [{x}, 0, {z}], rotation = [0, {turn}, 0] }}, {{ shape = \"points\", points = [[5, {far}, \
             0, {low}]] }}]\n"
        ));
        let hinge =
            format!("type = \"revolute\"\nat = [{}, 0, 1]\naxis = [0, {side}, 0]", side * 0.05);
        parts.push(joint(name, ["shaft", name], &hinge));
        parts.push(format!(
            "[[springs]]\nbodies = [\"slider\", \"{name}\"]\nfrom = [{}, 0, 0.5]\nto = [{x}, 0, {z}]\nstiffness = \
             8e5\ndamping = 4e4\nlength = 0.5\n",
            side * 0.05
        ));
    }
    parts.push(format!("[integrator]\nmethod = \"radau5\"\ntolerance = 1e-8\n{OUTPUT}"));
    for key in ["0.16 revolutions per second", "1 revolution per second"] {
        let reference = &data[key];
        let spin = number(&reference["shaft_rate"]);
        let text = format!("parameters = {{ spin = {spin} }}\n{}", parts.concat());
        let columns = ["q_shaft", "v_shaft", "q_slide", "v_slide", "q_right", "v_left"];
        let found = rows(&text, &reference["states"], &columns)?;
        for (row, state) in found.iter().zip(reference["states"].as_array().unwrap()) {
            let keys = [
                "shaft_angle",
                "shaft_rate",
                "slider_height",
                "slider_velocity",
                "rod_angle",
                "rod_rate",
            ];
            let mut expected = keys.map(|key| number(&state[key]));
            expected[2] -= 0.5;
            expected[4] -= std::f64::consts::FRAC_PI_6;
            expect_close(row, &expected, 1e-5);
        }
    }
    Ok(())
}

/// The benchmark bicycle: the eigenvalues of its published matrices, which were computed from its
/// parameters with 25 digits.
#[test]
fn eigenvalues_of_a_bicycle() -> Result<(), InputError> {
    let text = include_str!("../../../../examples/mechanisms/bicycle.toml");
    for state in references()["bicycle"]["speeds"].as_array().unwrap() {
        let speed = number(&state["speed"]);
        let mut problem = Problem::parse("bicycle.toml", text)?;
        problem.set(&format!("v={speed}"))?;
        let found = problem.linearized()?.linear;
        assert_eq!((found.matrix.nrows(), found.zeros, found.eigenvalues.len()), (10, 6, 4));
        for expected in state["eigenvalues"].as_array().unwrap() {
            let [re, im] = [0, 1].map(|part| number(&expected[part]));
            let off = |s: &Complex<f64>| (s.re - re).hypot(s.im - im) / re.hypot(im).max(1.0);
            let nearest = found.eigenvalues.iter().map(off).fold(f64::INFINITY, f64::min);
            assert!(nearest < 1e-12, "{speed}: {re}, {im}: {nearest:e}");
        }
    }
    Ok(())
}

/// The snakeboard with motors for its rotor and its axles: three gaits of five periods. It moves
/// forwards, rotates, or moves sideways.
#[test]
fn gaits_of_a_snakeboard() -> Result<(), InputError> {
    let text = include_str!("../../../../examples/mechanisms/snakeboard.toml")
        .replace("tolerance = 1e-10", "tolerance = 1e-13");
    for (name, gait) in references()["snakeboard"]["gaits"].as_object().unwrap() {
        let mut own = text.clone();
        for key in ["rotor_rate", "axle_rate"] {
            own =
                own.replace(&format!("{key} = 1\n"), &format!("{key} = {}\n", number(&gait[key])));
        }
        let columns = ["x_1", "y_1", "q1_board", "v1_board", "r3_rotor", "Omega4", "violation"];
        let found = rows(&own, &gait["states"], &columns)?;
        for (row, state) in found.iter().zip(gait["states"].as_array().unwrap()) {
            let keys = ["x", "y", "angle", "angle_rate", "rotor_torque", "x_rate", "y_rate"];
            let expected = keys.map(|key| number(&state[key]));
            let (sin, cos) = row[2].sin_cos();
            println!("{name}: {row:?}");
            expect_close(&row[..5], &expected[..5], 1e-12);
            expect_close(&[row[5] * cos, row[5] * sin], &expected[5..], 1e-12);
            assert!(row[6] < 1e-13);
        }
    }
    Ok(())
}

/// The centre of the platform, its rotation matrix by rows, the velocity of the centre and the angular
/// velocity.
fn platform(row: &[f64]) -> Vec<f64> {
    let rotation = Matrix3::from_row_slice(&row[3..12]);
    let centre = rotation * Vector3::new(0.06, 0.0, 2.48);
    let turn = rotation * Vector3::from_column_slice(&row[12..15]);
    let velocity = rotation * Vector3::from_column_slice(&row[15..18]) + turn.cross(&centre);
    let place = Vector3::from_column_slice(&row[..3]) + centre;
    [place.as_slice(), &row[3..12], velocity.as_slice(), turn.as_slice()].concat()
}

/// Stewart's platform on six springs with dampers, and with six motors: the motion, and the thrusts of
/// the motors.
#[test]
fn six_legs_of_a_platform() -> Result<(), InputError> {
    let all = references();
    let data = &all["stewart"];
    let springs = include_str!("../../../../examples/mechanisms/flight_simulator.toml")
        .replace("tolerance = 1e-9", "tolerance = 1e-13");
    let mut motors = springs.replace("rest = \"up\"\n", "").replace("rest = \"down\"\n", "");
    let parameters = &data["parameters"];
    for rate in numbers(&parameters["rates"]) {
        let motor = format!("motor = \"{}*sin({rate}*t)\"\n", number(&parameters["rotation"]));
        motors = motors.replacen("stiffness = \"k\"\ndamping = \"c\"\n", &motor, 1);
    }
    let entries = (1..=3).flat_map(|i| (1..=3).map(move |j| format!("g{i}{j}_1")));
    let mut names = ["x_1", "y_1", "z_1"].map(String::from).to_vec();
    names.extend(entries.chain((1..=6).map(|i| format!("Omega{i}"))));
    // the loops have 30 multipliers
    let of_motors = (31..=36).map(|i| format!("lambda{i}")).collect::<Vec<_>>();
    for (key, text, more) in [("springs", springs, &[][..]), ("motors", motors, &of_motors)] {
        let columns: Vec<&str> = names.iter().chain(more).map(String::as_str).collect();
        let found = rows(&text, &data[key], &columns)?;
        for (row, state) in found.iter().zip(data[key].as_array().unwrap()) {
            let keys = ["centre", "rotation", "velocity", "angular_velocity"];
            let expected = keys.map(|key| numbers(&state[key])).concat();
            expect_close(&platform(row), &expected, 1e-9);
            if key == "motors" {
                let thrusts: Vec<f64> = row[18..24].iter().map(|lambda| -lambda).collect();
                expect_close(&thrusts, &numbers(&state["thrusts"]), 1e-9);
            }
        }
    }
    Ok(())
}

/// The eigenvalues of the same platform at its equilibrium without extensions.
#[test]
#[ignore = "half a minute: derivatives in 36 coordinates"]
fn eigenvalues_of_a_platform() -> Result<(), InputError> {
    let text = include_str!("../../../../examples/mechanisms/flight_simulator.toml");
    let mut problem = Problem::parse("flight_simulator.toml", text)?;
    problem.set("up=0,down=0")?;
    let found = problem.linearized()?;
    let expected = &references()["stewart"]["equilibrium"]["values"];
    let expected: Vec<Vec<f64>> = expected.as_array().unwrap().iter().map(numbers).collect();
    assert!(found.is_at_rest && found.linear.zeros == 0);
    assert_eq!(found.linear.eigenvalues.len(), expected.len());
    for value in &expected {
        let off = |s: &Complex<f64>| (s.re - value[0]).hypot(s.im - value[1]);
        let nearest = found.linear.eigenvalues.iter().map(off).fold(f64::INFINITY, f64::min);
        assert!(nearest < 1e-8, "{value:?}: {nearest:e}");
    }
    Ok(())
}

/// The heavy top of O. Bruels, A. Cardona and M. Arnold on a spherical joint at its tip, with the force
/// of the joint. A second joint at the same point is redundant, and has half of the force.
#[test]
fn heavy_top_at_its_tip() -> Result<(), InputError> {
    let joint = |name: &str, ends: &str, rate: &str| {
        format!(
            "{{ name = \"{name}\", type = \"spherical\", bodies = [{ends}], at = [0, 0, 0]{rate} }}"
        )
    };
    let tip = joint("tip", "\"ground\", \"top\"", ", rate = [0, 150, -4.61538]");
    let again = joint("again", "\"top\", \"ground\"", "");
    for (joints, share) in [(tip.clone(), 1.0), (format!("{tip}, {again}"), 0.5)] {
        let text = format!(
            "gravity = [0, 0, -9.81]\nbodies = [{{ name = \"ground\", fixed = true }}, {{ name = \"top\", inertia.parts = [{{ \
             shape = \"inertia\", mass = 15, position = [0, 1, 0], matrix = {:?} }}] }}]\njoints = [{joints}]\n\
             integrator.tolerance = 1e-13\noutput = {{ end = 1, every = 1 }}\n",
            diagonal([0.234375, 0.46875, 0.234375])
        );
        let mut names: Vec<String> =
            (1..=3).flat_map(|i| (1..=3).map(move |j| format!("g{i}{j}"))).collect();
        names.extend(["Omega1", "Omega2", "Omega3"].map(String::from));
        names.extend([4, 5, 6].map(|i| format!("r{i}_tip")));
        let columns: Vec<&str> = names.iter().map(String::as_str).collect();
        for line in include_str!("../../../data/heavy_top.txt").lines().skip(1) {
            let state: Vec<f64> = line.split(' ').map(|own| own.parse().unwrap()).collect();
            let times = serde_json::json!([{ "time": state[0].to_string() }]);
            let found = rows(&text, &times, &columns)?.remove(0);
            // the rotation by rows, the angular velocity, and the force in the ground frame
            expect_close(&found[..12], &state[4..16], 1e-9);
            let force = Matrix3::from_row_slice(&found[..9])
                * Vector3::from_column_slice(&found[12..15])
                / share;
            expect_close(force.as_slice(), &state[16..19], 1e-8);
        }
    }
    Ok(())
}
