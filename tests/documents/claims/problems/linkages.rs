//! Linkages of parallel rods, which pass singular positions: closed forms, many loops, and what must not
//! matter.

use crate::problem::on_tree::{expect_close, last};
use affinor_documents::input::InputError;
use nalgebra::{Matrix3, Rotation3, Vector3};
use std::fmt::Write as _;

/// A chain of `windows` four-bar linkages with links of length `l`; the left corner is at `(x, y)`.
pub fn windows(windows: usize, l: f64, [x, y]: [f64; 2], speed: f64, gravity: f64) -> String {
    let mut text = format!("gravity = [0, {gravity}, 0]\n");
    let mut body = |name: String, [x, y]: [f64; 2], turn: &str| {
        let part = format!(
            "shape = \"rod\", length = {l}, mass = 1, position = [{x}, {y}, 0], rotation = {turn}"
        );
        let _ = write!(text, "[[bodies]]\nname = \"{name}\"\ninertia.parts = [{{ {part} }}]\n");
    };
    for k in 0..=windows {
        body(format!("rod{k}"), [x + l * k as f64, y + l / 2.0], "[\"pi/2\", 0, 0]");
    }
    for k in 0..windows {
        body(format!("bar{k}"), [x + l * (k as f64 + 0.5), y + l], "[0, \"pi/2\", 0]");
    }
    let mut hinge = |name: String, ends: [String; 2], [x, y]: [f64; 2], rate: &str| {
        let _ = write!(
            text,
            "[[joints]]\nname = \"{name}\"\ntype = \"revolute\"\nbodies = [\"{}\", \"{}\"]\n\
             at = [{x}, {y}, 0]\naxis = [0, 0, 1]\n{rate}",
            ends[0], ends[1]
        );
    };
    for k in 0..=windows {
        let rate = if k == 0 { format!("rate = {}\n", -speed / l) } else { String::new() };
        let ends = ["ground".into(), format!("rod{k}")];
        hinge(format!("A{k}"), ends, [x + l * k as f64, y], &rate);
    }
    for k in 0..windows {
        let at = |k: usize| [x + l * k as f64, y + l];
        hinge(format!("B{k}"), [format!("rod{k}"), format!("bar{k}")], at(k), "");
        hinge(format!("C{k}"), [format!("bar{k}"), format!("rod{}", k + 1)], at(k + 1), "");
    }
    let ground = "[[bodies]]\nname = \"ground\"\nfixed = true\n";
    format!("{text}{ground}[integrator]\ntolerance = 1e-12\n[output]\nend = 1\nevery = 1\n")
}

/// The double four-bar linkage of the IFToMM benchmark library passes a singular position, in which
/// all links are in a line, many times. All rods stay parallel, so `3 theta'' = 3.5 g sin(theta)`,
/// whose solution at `t = 10` was computed with 30 digits.
#[test]
fn double_four_bar_linkage_passes_singular_positions() -> Result<(), InputError> {
    let columns = ["q_A0", "v_A0", "violation", "energy"];
    let found = last(&windows(2, 1.0, [0.0, 0.0], 1.0, -9.81), 10.0, &columns)?;
    let [q, v] = [found[0], found[1]];
    let end = [-q.sin(), q.cos(), -v * q.cos(), -v * q.sin()];
    let expected = [
        0.328_458_111_540_815,
        0.944_518_538_178_601,
        1.423_051_470_206_94,
        -0.494_868_845_487_043,
    ];
    expect_close(&end, &expected, 1e-8);
    assert!(found[2] < 1e-13);
    // three rods with a kinetic energy of 1/6 each, two bars of 1/2 each
    expect_close(&[found[3]], &[1.5 + 9.81 * 3.5], 1e-8);
    Ok(())
}

/// With `n` windows, all rods of the linkage move as a pendulum with `((n + 1)/3 + n) theta'' =
/// ((n + 1)/2 + n) g sin(theta)`. The numbers of windows are on both sides of the one from which
/// factorizations are sparse. The values at `t = 1` were computed with 22 digits.
#[test]
fn many_windows_move_as_one_pendulum() -> Result<(), InputError> {
    for (count, expected) in [
        (10, [-3.271_261_740_835_93, -6.731_797_045_114_96]),
        (19, [-3.262_449_147_774_42, -6.721_190_693_411_18]),
        (20, [-3.261_953_153_415_09, -6.720_589_568_651_74]),
        (60, [-3.255_610_935_099_46, -6.712_863_928_225_57]),
    ] {
        let text = windows(count, 1.0, [0.0, 0.0], 1.0, -9.81).replace("1e-12", "1e-11");
        let found = last(&text, 1.0, &["q_A0", "v_A0", "violation"])?;
        expect_close(&found[..2], &expected, 1e-9);
        assert!(found[2] < 1e-12, "{}", found[2]);
    }
    Ok(())
}

/// The motion does not depend on the origin of the ground frame or on the unit of length.
#[test]
fn linkages_do_not_depend_on_origin_and_units() -> Result<(), InputError> {
    let end = |text: &str| last(text, 2.0, &["q_A0", "v_A0"]);
    let expected = end(&windows(1, 1.0, [0.0, 0.0], 1.0, -9.81))?;
    let shifted = end(&windows(1, 1.0, [1e4, -2e4], 1.0, -9.81))?;
    expect_close(&shifted, &expected, 1e-7);
    for l in [1e3, 1e-3] {
        expect_close(&end(&windows(1, l, [0.0, 0.0], l, -9.81 * l))?, &expected, 1e-8);
    }
    Ok(())
}

/// A body that is divided into two bodies, which are fixed together, moves as before.
#[test]
fn linkages_do_not_depend_on_divided_bodies() -> Result<(), InputError> {
    let whole = windows(1, 1.0, [0.0, 0.0], 1.0, -9.81);
    let half = "{ shape = \"rod\", length = 1, mass = 0.5, position = [0.5, 1, 0], rotation = [0, \"pi/2\", 0] }";
    let (before, after) = whole.split_once("name = \"bar0\"\n").expect("a bar");
    let (_, after) = after.split_once('\n').expect("an inertia");
    let divided = format!(
        "{before}name = \"bar0\"\ninertia.parts = [{half}]\n[[bodies]]\nname = \"twin\"\n\
         inertia.parts = [{half}]\n[[joints]]\ntype = \"fixed\"\nbodies = [\"bar0\", \"twin\"]\n{after}"
    );
    let columns = ["q_A0", "v_A1", "energy"];
    expect_close(&last(&divided, 1.0, &columns)?, &last(&whole, 1.0, &columns)?, 1e-8);
    // the second hinge of the bar may belong to the twin
    let moved = divided.replace("[\"bar0\", \"rod1\"]", "[\"twin\", \"rod1\"]");
    expect_close(&last(&moved, 1.0, &columns)?, &last(&whole, 1.0, &columns)?, 1e-8);
    Ok(())
}

/// A linkage whose axes are inclined moves as one whose axes are parallel to a coordinate axis.
/// Redundant constraints then have rounding errors in all components.
#[test]
fn linkages_do_not_depend_on_the_frame() -> Result<(), InputError> {
    let straight = windows(2, 1.0, [0.0, 0.0], 1.0, -9.81);
    let expected = last(&straight, 2.0, &["q_A0", "v_A0", "q_C1", "energy"])?;
    let turn = Rotation3::new(Vector3::new(0.3, -0.8, 0.5));
    let mut text = String::new();
    for line in straight.lines() {
        let key =
            ["at = [", "axis = [", "gravity = ["].into_iter().find(|key| line.starts_with(key));
        let line = match key {
            Some(key) => {
                let list = line[key.len()..].trim_end_matches(']');
                let numbers = list.split(", ").map(|number| number.parse().unwrap());
                let image = turn * Vector3::from_iterator(numbers);
                format!("{key}{}, {}, {}]", image.x, image.y, image.z)
            }
            None if line.starts_with("inertia") => {
                // the rod along the first or the second axis
                let is_upright = line.contains("\"pi/2\", 0, 0");
                let place = line.split("position = [").nth(1).unwrap();
                let place = place.split(']').next().unwrap();
                let numbers = place.split(", ").map(|number| number.parse().unwrap());
                let centre = turn * Vector3::from_iterator(numbers);
                let along = turn * if is_upright { Vector3::y() } else { Vector3::x() };
                let across = (Matrix3::identity() - along * along.transpose()) / 12.0;
                let rows: Vec<[f64; 3]> =
                    (0..3).map(|i| [0, 1, 2].map(|j| across[(i, j)])).collect();
                let place = [centre.x, centre.y, centre.z];
                format!(
                    "inertia.parts = [{{ shape = \"inertia\", mass = 1, position = {place:?}, matrix = {rows:?} }}]"
                )
            }
            None => line.to_string(),
        };
        let _ = writeln!(text, "{line}");
    }
    let found = last(&text, 2.0, &["q_A0", "v_A0", "q_C1", "energy"])?;
    expect_close(&found, &expected, 1e-8);
    Ok(())
}
