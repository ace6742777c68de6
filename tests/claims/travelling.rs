//! Motions of bodies that travel: far from the origin, in a fast frame, in other units, rotated,
//! and backwards.
//!
//! The force field moves with the frame, so all cases describe the same motion. Each must agree
//! with the case at the origin up to the rounding error of its coordinates.
//!
//! Guards `Problem`, `mechanics::systems::centred` and the integrators on SE(3).

use crate::common::property::properties;
use affinor_documents::problem::Problem;
use nalgebra::{Matrix3, Matrix6, Rotation3, Vector3, Vector6};
use proptest::prelude::*;
use std::fmt::Write;

/// The group of rotations and translations, in four forms.
const SPACES: [&str; 4] =
    ["se3", "se3 by matrices", "SO(3) x R^3 by matrices", "se3 in another basis"];

const FIXED: [&str; 3] = ["rkmk4", "cf4", "projected4"];
const CONTROLLED: [&str; 4] = ["rkmk54", "rkmk853", "projected54", "projected853"];

/// A body with its initial condition.
#[derive(Clone, Debug)]
struct Body {
    /// The inertia about the centre of mass, the mass, and the centre in the body.
    inertia: Matrix3<f64>,
    mass: f64,
    centre: Vector3<f64>,
    spin: Vector3<f64>,
    velocity: Vector3<f64>,
    attitude: Vector3<f64>,
}

/// The frame of the description.
#[derive(Clone, Debug)]
struct Frame {
    shift: Vector3<f64>,
    boost: Vector3<f64>,
    turn: Rotation3<f64>,
    /// The units of length, mass and time, relative to those of the body.
    units: [f64; 3],
}

impl Frame {
    fn own() -> Self {
        let zero = Vector3::zeros();
        Frame { shift: zero, boost: zero, turn: Rotation3::identity(), units: [1.0; 3] }
    }
}

/// Parameters of a run: space, method, step size, tolerance and final time.
#[derive(Clone, Copy, Debug)]
struct How {
    space: &'static str,
    method: &'static str,
    step: f64,
    tolerance: f64,
    end: f64,
}

impl How {
    fn is_fixed(self) -> bool {
        FIXED.contains(&self.method)
    }
}

/// Spin, attitude and position at the end, in the units and the frame of the body's description.
#[derive(Clone, Debug)]
struct End {
    spin: Vector3<f64>,
    attitude: Matrix3<f64>,
    place: Vector3<f64>,
}

impl End {
    fn off(&self, other: &End) -> f64 {
        let spin = (self.spin - other.spin).amax() / other.spin.amax();
        let place = (self.place - other.place).amax() / (1.0 + other.place.amax());
        spin.max((self.attitude - other.attitude).amax()).max(place)
    }
}

fn list(numbers: &[f64]) -> String {
    format!("{numbers:?}")
}

fn rows(entry: impl Fn(usize, usize) -> f64, size: usize) -> String {
    let row =
        |i| (0..size).map(|j| format!("\"{:?}\"", entry(i, j))).collect::<Vec<_>>().join(", ");
    let rows: Vec<String> = (0..size).map(|i| format!("[{}]", row(i))).collect();
    format!("[{}]", rows.join(", "))
}

/// The metric of a body on the twists `(w, u)`, with `d` the offset of its centre.
fn metric(body: &Body, [length, mass, _]: [f64; 3]) -> Matrix6<f64> {
    let d = body.centre.cross_matrix();
    let mut all = Matrix6::identity() * (body.mass * mass);
    let about = (body.inertia - d * d * body.mass) * (mass * length * length);
    let coupling = d * (body.mass * mass * length);
    all.fixed_view_mut::<3, 3>(0, 0).copy_from(&about);
    all.fixed_view_mut::<3, 3>(0, 3).copy_from(&coupling);
    all.fixed_view_mut::<3, 3>(3, 0).copy_from(&coupling.transpose());
    all
}

/// A change of the basis of se(3) with determinant 1, the same one in every unit of length. With
/// 0.5 km instead of 0.5 m the moments of inertia would be smaller than the rounding error of the
/// mass.
fn change(length: f64) -> Matrix6<f64> {
    let mut there = Matrix6::identity();
    for (i, j, share) in [(3, 0, 0.5 * length), (4, 2, -0.25 * length), (1, 0, 1.0), (5, 4, 0.5)] {
        let sum = there.column(j) + there.column(i) * share;
        there.set_column(j, &sum);
    }
    there
}

/// The problem of a body in a frame, between two times. In its own frame a spring pulls the body to
/// the position `0.3 sin t` along the first axis, and a torque rotates it.
fn problem(body: &Body, frame: &Frame, how: How) -> String {
    let How { space, method, step, tolerance, end } = how;
    let [length, mass, time] = frame.units;
    let mut all = metric(body, frame.units);
    let there = change(length);
    let is_mixed = space == "se3 in another basis";
    let is_product = space == "SO(3) x R^3 by matrices";
    if is_product {
        // no lever: the position is the position of the centre
        let zero = Matrix3::zeros();
        all.fixed_view_mut::<3, 3>(0, 3).copy_from(&zero);
        all.fixed_view_mut::<3, 3>(3, 0).copy_from(&zero);
        all.fixed_view_mut::<3, 3>(0, 0).copy_from(&(body.inertia * (mass * length * length)));
    }
    if is_mixed {
        all = there.transpose() * all * there;
        // rounding errors of large moments are not an asymmetry
        all = (all + all.transpose()) * 0.5;
    }
    let mut text = String::new();
    if space == "se3" {
        writeln!(text, "space = \"se3\"").unwrap();
    }
    writeln!(text, "metric = {}", rows(|i, j| all[(i, j)], 6)).unwrap();
    // the attitude in the frame
    let attitude = frame.turn * Rotation3::new(body.attitude);
    let places =
        |matrix: &str, at: usize| (1..=3).map(|i| format!("{matrix}{i}{at}")).collect::<Vec<_>>();
    let place = match space {
        "se3" => vec!["x".to_string(), "y".into(), "z".into()],
        _ if is_product => places("g", 7)
            .iter()
            .map(|name| name.replace("g1", "g4").replace("g2", "g5").replace("g3", "g6"))
            .collect(),
        _ => places("g", 4),
    };
    // in the frame: the spring moves with the frame, and the time is in other units
    let follow = |axis: usize| {
        let pull = frame.turn * Vector3::x();
        format!(
            "({} - ({:e}) - ({:e})*t - ({:e})*sin(t*({:e})))",
            place[axis],
            frame.shift[axis] * length,
            frame.boost[axis] * length / time,
            0.3 * pull[axis] * length,
            1.0 / time
        )
    };
    let squares: Vec<String> = (0..3).map(|axis| format!("{}^2", follow(axis))).collect();
    writeln!(text, "[forces]").unwrap();
    writeln!(
        text,
        "potential = \"({:e})*({})\"",
        0.75 * body.mass * mass / (time * time),
        squares.join(" + ")
    )
    .unwrap();
    let torque = mass * length * length / (time * time) * body.inertia.trace();
    let moment = |share: f64, phase: f64| {
        format!("({:e})*sin(t*({:e}) + ({phase:e}))", share * torque, 1.0 / time)
    };
    let moments = [moment(0.1, 0.0), moment(0.2, 1.0), moment(-0.05, 2.0)];
    let zero = "0".to_string();
    let all_forces = [&moments[0], &moments[1], &moments[2], &zero, &zero, &zero];
    let forces: Vec<String> = if is_mixed {
        // covectors are transformed by the transpose
        let share = |i: usize| {
            (0..6).map(|k| format!("({:e})*({})", there[(k, i)], all_forces[k])).collect::<Vec<_>>()
        };
        (0..6).map(|i| format!("\"{}\"", share(i).join(" + "))).collect()
    } else {
        all_forces.iter().map(|force| format!("\"{force}\"")).collect()
    };
    writeln!(text, "body = [{}]", forces.join(", ")).unwrap();
    // position and velocity of the body's origin
    let origin = frame.shift;
    let space_velocity = Rotation3::new(body.attitude) * body.velocity;
    let velocity = attitude.inverse() * (frame.turn * space_velocity + frame.boost);
    let spin = body.spin / time;
    let mut twist = [spin.as_slice(), (velocity * (length / time)).as_slice()].concat();
    if is_product {
        // g' = g Omega: the velocity in space
        twist[3..].copy_from_slice((attitude * velocity * (length / time)).as_slice());
    }
    if is_mixed {
        let back = there.try_inverse().unwrap() * Vector6::from_column_slice(&twist);
        twist.copy_from_slice(back.as_slice());
    }
    let matrix = |i: usize, j: usize| match (i, j) {
        (0..3, 0..3) => attitude[(i, j)],
        (0..3, 3) => origin[i] * length,
        _ => f64::from(i == j),
    };
    let large = |i: usize, j: usize| match (i, j) {
        (0..3, 0..3) => attitude[(i, j)],
        (3..6, 6) => origin[i - 3] * length,
        _ => f64::from(i == j),
    };
    let element = if is_product { rows(large, 7) } else { rows(matrix, 4) };
    writeln!(text, "[initial]\nelement = {element}\nvelocity = {}", list(&twist)).unwrap();
    writeln!(text, "[integrator]\nmethod = \"{method}\"").unwrap();
    match how.is_fixed() {
        true => writeln!(text, "step = {:e}", step * time).unwrap(),
        false => writeln!(text, "tolerance = {tolerance:e}").unwrap(),
    }
    writeln!(
        text,
        "[output]\nend = {:e}\nevery = {:e}\ncolumns = [\"Omega\", \"g\"]",
        end * time,
        end * time
    )
    .unwrap();
    if space != "se3" {
        text.push_str("[definition]\nmatrices = [");
        let unit = |i: usize, entries: &[(usize, usize, f64)], size: usize| {
            let value = |a, b| {
                entries.iter().filter(|(i, j, _)| (*i, *j) == (a, b)).map(|(.., v)| v).sum::<f64>()
            };
            format!("{{name = \"e{}\", rows = {}}},", i + 1, rows(value, size))
        };
        let (size, first) = if is_product { (7, 3) } else { (4, 0) };
        let plain = |i: usize| -> Vec<(usize, usize, f64)> {
            if i < 3 {
                let (j, k) = ((i + 1) % 3, (i + 2) % 3);
                vec![(k, j, 1.0), (j, k, -1.0)]
            } else {
                vec![(first + i - 3, size - 1, 1.0)]
            }
        };
        for i in 0..6 {
            let entries: Vec<(usize, usize, f64)> = if is_mixed {
                (0..6)
                    .flat_map(|k| {
                        plain(k).into_iter().map(move |(a, b, v)| (a, b, v * there[(k, i)]))
                    })
                    .collect()
            } else {
                plain(i)
            };
            text.push_str(&unit(i, &entries, size));
        }
        text.push_str("]\n");
    }
    text
}

/// The end of the motion, transformed back to the frame and the units of the body.
fn end(body: &Body, frame: &Frame, how: How) -> End {
    let text = problem(body, frame, how);
    let problem = Problem::parse("body.toml", &text).unwrap_or_else(|e| panic!("{text}: {e}"));
    let mut ready = problem.motion(0).unwrap_or_else(|e| panic!("{text}: {e}"));
    let last = *ready.times.last().unwrap();
    while !ready.motion.step(last).unwrap_or_else(|e| panic!("{how:?} {frame:?}: {e}\n{text}")) {}
    let row = ready.motion.row();
    let [length, _, time] = frame.units;
    let mut twist = Vector6::from_column_slice(&row[..6]);
    if how.space == "se3 in another basis" {
        twist = change(length) * twist;
    }
    let size = if how.space == "SO(3) x R^3 by matrices" { 7 } else { 4 };
    let entry = |i: usize, j: usize| row[6 + i * size + j];
    let first = size - 4;
    let attitude = Matrix3::from_fn(entry);
    let place = Vector3::from_fn(|i, _| entry(first + i, size - 1));
    let place = (place / length) - frame.shift - frame.boost * (last / time);
    End {
        spin: Vector3::new(twist[0], twist[1], twist[2]) * time,
        attitude: frame.turn.inverse().matrix() * attitude,
        place: frame.turn.inverse() * place,
    }
}

prop_compose! {
    fn vectors(size: f64)(x in -1.0..1.0, y in -1.0..1.0, z in -1.0..1.0) -> Vector3<f64> {
        Vector3::new(x, y, z) * size
    }
}

prop_compose! {
    fn bodies()(
        moments in [1.0..2.0, 1.0..2.0, 1.0..2.0],
        axes in vectors(1.0),
        mass in 0.5..5.0,
        centre in prop_oneof![Just(Vector3::zeros()), vectors(0.4)],
        (spin, velocity, attitude) in (vectors(1.0), vectors(1.0), vectors(2.0)),
    ) -> Body {
        let axes = Rotation3::new(axes);
        let inertia = axes.matrix() * Matrix3::from_diagonal(&Vector3::from(moments)) * axes.matrix().transpose();
        let inertia = (inertia + inertia.transpose()) * 0.5;
        Body { inertia, mass, centre, spin: spin.add_scalar(1.2), velocity, attitude }
    }
}

fn method() -> impl Strategy<Value = (&'static str, &'static str)> {
    let fixed = (prop::sample::select(&FIXED[..]), prop::sample::select(&SPACES[..]));
    let controlled = (prop::sample::select(&CONTROLLED[..]), prop::sample::select(&SPACES[..]));
    prop_oneof![fixed, controlled].prop_map(|(method, space)| {
        match method.starts_with("projected") {
            true => (method, SPACES[0]),
            false => (method, space),
        }
    })
}

/// The allowed error in a frame: the rounding error of its coordinates, plus the tolerance for
/// adaptive methods.
fn allowed(frame: &Frame, how: How) -> f64 {
    // the size of the position and of the momentum
    let rounding = 4e-15 * (1.0 + frame.shift.norm() + frame.boost.norm() * (how.end + 10.0));
    1e-12 + 30.0 * rounding + if how.is_fixed() { 0.0 } else { 2e3 * how.tolerance }
}

fn same(body: &Body, frame: &Frame, how: How) -> Result<(), TestCaseError> {
    // on the direct product a lever of the centre would define another problem
    let centre = if how.space == SPACES[2] { Vector3::zeros() } else { body.centre };
    let body = &Body { centre, ..body.clone() };
    let off = end(body, frame, how).off(&end(body, &Frame::own(), how));
    let allowed = allowed(frame, how);
    prop_assert!(off <= allowed, "{how:?}: {off:e}, {allowed:e} is allowed");
    Ok(())
}

fn how((method, space): (&'static str, &'static str)) -> How {
    How { space, method, step: 0.02, tolerance: 1e-10, end: 4.0 }
}

properties! {
    #![cases(24)]

    #[test]
    fn a_shifted_origin_changes_nothing(body in bodies(), shift in vectors(1e7), by in method()) {
        same(&body, &Frame { shift, ..Frame::own() }, how(by))?;
    }

    #[test]
    fn a_fast_frame_changes_nothing(body in bodies(), boost in vectors(1e3), by in method()) {
        same(&body, &Frame { boost, ..Frame::own() }, how(by))?;
    }

    #[test]
    fn a_turned_frame_changes_nothing(body in bodies(), turn in vectors(3.0), by in method()) {
        same(&body, &Frame { turn: Rotation3::new(turn), ..Frame::own() }, how(by))?;
    }

    #[test]
    fn units_change_nothing(
        body in bodies(),
        units in prop::sample::select(vec![[1e-3, 1.0, 1.0], [1e3, 1e3, 1.0], [1.0, 1e-3, 1e3], [1e3, 1e-6, 1e-3], [0.3048, 14.6, 1.0]]),
        by in method(),
    ) {
        same(&body, &Frame { units, ..Frame::own() }, how(by))?;
    }

    #[test]
    fn all_of_it_changes_nothing(
        body in bodies(),
        (shift, boost, turn) in (vectors(1e6), vectors(1e2), vectors(3.0)),
        units in prop::sample::select(vec![[1e-3, 1.0, 1.0], [1e3, 1e3, 1.0], [1.0, 1e-3, 60.0]]),
        by in method(),
    ) {
        let frame = Frame { shift, boost, turn: Rotation3::new(turn), units };
        same(&body, &frame, how(by))?;
    }
}
