//! A body in motion: a box with its axes of inertia.

use super::{Body, Figure, Panel, Role};
use crate::rows::RunRows;
use affinor::Error;
use affinor::mechanics::Inertia;
use nalgebra::{Matrix3, Rotation3, UnitQuaternion, Vector3};

/// Frames in a second of the film.
const RATE: f64 = 25.0;
/// The largest number of frames.
const FRAMES: f64 = 2400.0;
/// The rotation between two frames, in radians, unless there would be too many.
const TURN: f64 = 0.25;
/// Half the diagonal of the box, in radii of the picture: on the sphere of the axes, and along a path.
const SIZES: [f64; 2] = [0.62, 0.2];
/// The least edge of the box, relative to its diagonal.
const THINNEST: f64 = 0.06;

/// The body of rows, in a film of some seconds: a homogeneous box with the same axes and ratios of inertia, and the path
/// of the axis that moves least; with a position also the path of the body.
///
/// # Errors
/// [`Error::Name`] for a trajectory without an attitude; [`Error::Invalid`] for elements that are not rotations.
pub fn animation(run: &RunRows, inertia: &Inertia, seconds: f64) -> Result<Figure, Error> {
    let times = run.column("t")?;
    let (Some(&first), Some(&last)) = (times.first(), times.last()) else {
        let reason = "there are no rows".into();
        return Err(Error::Invalid { what: "trajectory", reason });
    };
    let axes = inertia.axes();
    let turns: Vec<Matrix3<f64>> = run.attitudes()?.iter().map(|r| r * axes).collect();
    let places = run.vectors(["g14", "g24", "g34"]).ok();
    let moments = inertia.principal_moments();
    let size = SIZES[usize::from(places.is_some())];
    let (mut panel, center) = match &places {
        Some(places) => space(places, size),
        None => (Panel::new("", 1.0, ["X", "Y", "Z"]), Vector3::zeros()),
    };
    let captions = [0, 1, 2].map(|i| {
        let axis = ["1", "2", "3"][i];
        format!("axis {axis} of inertia, moment {}", (moments[i] * 1e6).round() / 1e6)
    });
    match &places {
        Some(places) => {
            let path = places.iter().map(|place| place - center).collect();
            panel.path(Role::Motion, "path of the body", path);
        }
        None => {
            let (i, path) = calmest(&turns);
            panel.path(Role::Frame(i), &format!("path of axis {}", i + 1), path);
        }
    }
    let whole: f64 = turns.windows(2).map(|pair| angle(&pair[0], &pair[1])).sum();
    let count = (whole / TURN).max(RATE * seconds).clamp(1.0, FRAMES).ceil() as u32;
    let poses = (0..=count).map(|k| {
        let (at, share) = between(&times, first + (last - first) * f64::from(k) / f64::from(count));
        let next = (at + 1).min(times.len() - 1);
        let place = places.as_ref().map_or(center, |all| all[at].lerp(&all[next], share));
        (turned(&turns[at], &turns[next], share), place - center)
    });
    let radius = panel.radius;
    let edges = inertia.box_edges();
    let edges = edges.map(|edge| edge.max(THINNEST * edges.norm()));
    let half = edges * (size * radius / edges.norm());
    panel.body = Some(Body {
        half: half.into(),
        reach: if places.is_some() { 1.5 * size * radius } else { radius },
        captions,
        poses: poses.collect(),
        times: [first, last],
        turn: whole / f64::from(count),
        seconds,
    });
    Ok(Figure { title: format!("{}: the body in motion", run.name), panels: vec![panel] })
}

/// A panel around a path in space, with room for a body, and its centre.
fn space(places: &[Vector3<f64>], size: f64) -> (Panel, Vector3<f64>) {
    let start = places.first().copied().unwrap_or_default();
    let corners = places.iter().fold((start, start), |(low, high), x| (low.inf(x), high.sup(x)));
    let center = (corners.0 + corners.1) * 0.5;
    let farthest = places.iter().map(|x| (x - center).norm()).fold(0.0, f64::max);
    let radius = if farthest > 0.0 { farthest / (1.0 - size) } else { 1.0 };
    let mut panel = Panel::new("", radius, ["X", "Y", "Z"]);
    panel.sphere = false;
    if center.norm() < radius {
        panel.mark("O", "", -center);
    }
    (panel, center)
}

/// The axis with the shortest path on the sphere, and the path.
fn calmest(turns: &[Matrix3<f64>]) -> (usize, Vec<Vector3<f64>>) {
    let path = |i: usize| turns.iter().map(move |r| r.column(i).into_owned()).collect::<Vec<_>>();
    let length = |i: usize| -> f64 {
        turns.windows(2).map(|pair| (pair[1].column(i) - pair[0].column(i)).norm()).sum()
    };
    let lengths = [0, 1, 2].map(length);
    let shortest = (0..3).min_by(|i, j| lengths[*i].total_cmp(&lengths[*j])).unwrap_or(0);
    (shortest, path(shortest))
}

fn rotation(r: &Matrix3<f64>) -> UnitQuaternion<f64> {
    UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix_unchecked(*r))
}

fn angle(a: &Matrix3<f64>, b: &Matrix3<f64>) -> f64 {
    rotation(a).angle_to(&rotation(b))
}

/// The rotation at a share of the way between two.
fn turned(a: &Matrix3<f64>, b: &Matrix3<f64>, share: f64) -> Matrix3<f64> {
    let (a, b) = (rotation(a), rotation(b));
    let between = a.try_slerp(&b, share, 1e-9).unwrap_or(a);
    between.to_rotation_matrix().into_inner()
}

/// The last row before a time, and the share of the way to the next row.
fn between(times: &[f64], time: f64) -> (usize, f64) {
    let forwards = times[times.len() - 1] >= times[0];
    let passed = times.partition_point(|t| if forwards { *t <= time } else { *t >= time });
    let at = passed.saturating_sub(1);
    let Some(next) = times.get(at + 1) else { return (at, 0.0) };
    (at, ((time - times[at]) / (next - times[at])).clamp(0.0, 1.0))
}
