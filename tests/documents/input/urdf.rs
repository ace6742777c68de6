//! Robots in URDF: the motion of an arm by another program, and loops that are closed by hand.

use crate::common::root;
use affinor_documents::input::InputError;
use affinor_documents::mechanism::MechanismFile;
use affinor_documents::problem::Problem;
use serde_json::Value;
use tempfile::TempDir;

fn list(value: &Value) -> Vec<f64> {
    value.as_array().unwrap().iter().map(|x| x.as_f64().unwrap()).collect()
}

fn expect_close(found: &[f64], expected: &[f64], tolerance: f64) {
    assert_eq!(found.len(), expected.len());
    for (at, (found, expected)) in found.iter().zip(expected).enumerate() {
        assert!((found - expected).abs() <= tolerance, "{at}: {found} instead of {expected}");
    }
}

/// The values of columns at some times. Each list of a joint gives its values by a table.
fn rows(text: &str, times: &[f64], columns: &[&str]) -> Result<Vec<Vec<f64>>, InputError> {
    let problem = Problem::parse("arm.toml", text)?.with_columns(columns);
    let mut rows = vec![];
    for &time in times {
        let mut ready = problem.at_times(&[time]).motion(0)?;
        while time > 0.0 && !ready.motion.step(time)? {}
        rows.push(ready.motion.row());
    }
    Ok(rows)
}

/// A file with the arm of tests/data, and the reference numbers.
fn arm() -> (String, Value) {
    let data = root().join("tests/data");
    let expected = std::fs::read_to_string(data.join("arm_seven.json")).unwrap();
    let expected: Value = serde_json::from_str(&expected).unwrap();
    let [q, v, f] = ["coordinates", "rates", "forces"].map(|key| list(&expected[key]));
    let names = expected["names"].as_array().unwrap().iter().map(|name| name.as_str().unwrap());
    let joints = names.enumerate().map(|(at, name)| {
        let (q, v, f) = (q[at], v[at], f[at]);
        format!("{{ name = \"{name}\", coordinate = {q:?}, rate = {v:?}, force = {f:?} }}")
    });
    let joints: Vec<String> = joints.collect();
    let text = format!(
        "coordinates = \"joints\"\nurdf = {:?}\ngravity = {:?}\njoints = [{}]\n\
         integrator.tolerance = 1e-13\noutput = {{ end = 1, every = 1 }}\n",
        data.join("arm_seven.urdf"),
        list(&expected["gravity"]),
        joints.join(", ")
    );
    (text, expected)
}

/// The accelerations at the start are the derivatives of the rates: a difference of order 6.
#[test]
fn accelerations_of_an_arm_agree_with_pinocchio() -> Result<(), InputError> {
    let (text, expected) = arm();
    let h = 1e-3;
    let times: Vec<f64> = (0..=6).map(|k| h * f64::from(k)).collect();
    let rates = rows(&text, &times, &["rates"])?;
    let weights = [-2.45, 6.0, -7.5, 20.0 / 3.0, -3.75, 1.2, -1.0 / 6.0];
    let accelerations: Vec<f64> = (0..7)
        .map(|i| weights.iter().zip(&rates).map(|(w, row)| w * row[i]).sum::<f64>() / h)
        .collect();
    expect_close(&accelerations, &list(&expected["accelerations"]), 2e-8);
    Ok(())
}

#[test]
fn the_motion_and_the_energies_of_an_arm_agree_with_pinocchio() -> Result<(), InputError> {
    let (text, expected) = arm();
    let columns = ["kinetic", "potential", "x_9", "y_9", "z_9"];
    let start = &rows(&text, &[0.0], &columns)?[0];
    expect_close(&start[..2], &list(&expected["energies"]), 1e-12);
    let row = expected["rows"].as_array().unwrap();
    for row in row {
        let t = row["t"].as_f64().unwrap();
        let columns = ["coordinates", "rates", "kinetic", "potential"];
        let found = &rows(&text, &[t], &columns)?[0];
        expect_close(&found[..7], &list(&row["q"]), 1e-10);
        expect_close(&found[7..14], &list(&row["v"]), 1e-9);
        expect_close(&found[14..], &list(&row["energies"]), 1e-9);
    }
    Ok(())
}

/// The frame of a body is parallel to the ground frame at the zero configuration, so the tip is the
/// image of its position there.
#[test]
fn the_poses_of_an_arm_agree_with_pinocchio() -> Result<(), InputError> {
    let (text, expected) = arm();
    let home = expected["tip_at_zero"].as_array().unwrap();
    let home: Vec<f64> = home.iter().map(|x| x.as_f64().unwrap()).collect();
    let poses = &rows(&text, &[0.0], &["poses"])?[0];
    let [qw, qx, qy, qz, x, y, z] = poses[poses.len() - 7..] else { unreachable!() };
    let rotation =
        nalgebra::UnitQuaternion::from_quaternion(nalgebra::Quaternion::new(qw, qx, qy, qz));
    let tip = rotation * nalgebra::Vector3::from_vec(home) + nalgebra::Vector3::new(x, y, z);
    expect_close(tip.as_slice(), &list(&expected["tip"]), 1e-14);
    Ok(())
}

/// Notes name limits, transmissions and friction.
#[test]
fn notes_name_ignored_properties() -> Result<(), InputError> {
    let (text, _) = arm();
    let notes = Problem::parse("arm.toml", &text)?.motion(0)?.notes;
    assert_eq!(notes.len(), 2, "{notes:?}");
    let limits = "the limits of the joints axis1, axis2, slide, axis5 and 1 more are not enforced";
    assert!(notes[0].ends_with(limits), "{notes:?}");
    assert!(notes[1].ends_with("transmissions are ignored"));
    Ok(())
}

/// A robot of links in a plane, with the angles of its joints.
fn chain(joints: &[&str]) -> String {
    let links: String = (0..=joints.len())
        .map(|k| {
            format!(
                "<link name='L{k}'><inertial><origin xyz='0.5 0 0'/><mass value='1'/><inertia ixx='0.01' \
                 ixy='0' ixz='0' iyy='0.1' iyz='0' izz='0.1'/></inertial></link>\n"
            )
        })
        .collect();
    let joints: String = joints
        .iter()
        .enumerate()
        .map(|(k, keys)| {
            let below = k + 1;
            format!(
                "<joint name='J{k}' {keys}<parent link='L{k}'/><child link='L{below}'/></joint>\n"
            )
        })
        .collect();
    format!("<robot name='chain'>{links}{joints}</robot>")
}

fn mobility(urdf: &str, toml: &str) -> Result<(Option<usize>, String), Box<dyn std::error::Error>> {
    let folder = TempDir::new()?;
    std::fs::write(folder.path().join("arm.urdf"), urdf)?;
    let path = folder.path().join("arm.toml");
    std::fs::write(&path, format!("urdf = \"arm.urdf\"\n{toml}"))?;
    let file = MechanismFile::read(&path.to_string_lossy(), &[])?;
    let mobility = file.mechanism.mobility()?;
    Ok((mobility.verdict.exact(), format!("{:?}", file.kind())))
}

/// A parallelogram in a plane x = 0 whose right angles are rounded: its axes are exactly parallel, so
/// that the mobility of a linkage with redundant constraints is proved.
#[test]
fn rounded_right_angles_are_exact_in_mobilities() -> Result<(), Box<dyn std::error::Error>> {
    let hinge = |origin: &str| format!("type='revolute'><origin {origin}/><axis xyz='0 0 1'/>");
    let urdf = chain(&[
        &hinge("xyz='0 0 0' rpy='1.5708 0 1.57'"),
        &hinge("xyz='0.7 0 0' rpy='0 0 -1.57080'"),
        &hinge("xyz='1.1 0 0' rpy='0 0 -1.571'"),
    ]);
    let toml = "joints = [{ type = \"revolute\", bodies = [\"L3\", \"L0\"], at = [0, 0, -1.1], axis = [1, 0, 0] }]";
    let (exact, kind) = mobility(&urdf, toml)?;
    assert_eq!((exact, &*kind), (Some(1), "Exact"));
    Ok(())
}

/// The rotation of a joint at 45 degrees has roots, and rotations by other angles are rational.
#[test]
fn chains_without_loops_have_all_freedoms() -> Result<(), Box<dyn std::error::Error>> {
    let urdf = chain(&[
        "type='planar'><origin xyz='0 0 0.1' rpy='0.7853982 0.3 -1.1'/><axis xyz='0.6 0 0.8'/>",
        "type='prismatic'><origin rpy='0 0.2 -2.7'/><axis xyz='0 1 1'/>",
        "type='fixed'>",
        "type='floating'><origin xyz='1 2 3' rpy='1 2 3'/>",
        "type='continuous'>",
    ]);
    let (exact, _) = mobility(&urdf, "")?;
    assert_eq!(exact, Some(3 + 1 + 6 + 1));
    Ok(())
}

/// Bodies and joints of the file follow those of the robot: a pendulum at the end of the arm moves
/// as the link of a robot with the same mass.
#[test]
fn tables_continue_the_tree_of_a_robot() -> Result<(), Box<dyn std::error::Error>> {
    let hinge = "type='continuous'><origin xyz='1 0 0' rpy='0.4 0 0'/><axis xyz='0 1 0'/>";
    let folder = TempDir::new()?;
    let motion = |urdf: &str, toml: &str| -> Result<Vec<f64>, Box<dyn std::error::Error>> {
        let path = folder.path().join("arm.urdf");
        std::fs::write(&path, urdf)?;
        let text = format!(
            "coordinates = \"joints\"\nurdf = {path:?}\ngravity = [0, 0, -9.81]\n{toml}\n\
             integrator.tolerance = 1e-12\noutput = {{ end = 1, every = 1 }}\n"
        );
        Ok(rows(&text, &[0.5], &["coordinates", "rates", "energy"])?.remove(0))
    };
    let whole = motion(&chain(&[hinge, hinge]), "joints = [{ name = \"J0\", rate = 0.3 }]")?;
    // the second joint is at (2, 0, 0) with the axis turned by 0.4 and 0.4 about x
    let (sin, cos) = 0.8_f64.sin_cos();
    let by_hand = format!(
        "bodies = [{{ name = \"end\", inertia.parts = [\
         {{ shape = \"box\", edges = [{}, {}, {}], mass = 1, position = [2.5, 0, 0], rotation = [0.8, 0, 0] }}] }}]\n\
         joints = [{{ name = \"J0\", rate = 0.3 }}, {{ name = \"J1\", type = \"revolute\", \
         bodies = [\"L1\", \"end\"], at = [2, 0, 0], axis = [0, {cos}, {sin}] }}]",
        (12.0 * (0.2 - 0.01) / 2.0_f64).sqrt(),
        (12.0 * 0.01 / 2.0_f64).sqrt(),
        (12.0 * 0.01 / 2.0_f64).sqrt(),
    );
    expect_close(&motion(&chain(&[hinge]), &by_hand)?, &whole, 1e-10);
    Ok(())
}
