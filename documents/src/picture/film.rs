//! A body in motion, as polygons with a frame for each pose.

use super::{Anchor, Font, Ink, Point, Shape, Stroke, View, style};
use crate::figures::{Body, Role};
use nalgebra::Vector3;

/// A box and its axes of inertia. A face is visible while it is turned to the eye; an axis that points away begins behind
/// the box.
pub(super) fn body(body: &Body, view: &View, place: impl Fn(&Vector3<f64>) -> Point) -> Vec<Shape> {
    let towards = |i: usize, sign: f64| -> Vec<bool> {
        body.poses
            .iter()
            .map(|(r, _)| sign * view.depth(&r.column(i).into_owned()) >= 0.0)
            .collect()
    };
    let film = |corners: &[Vector3<f64>], shown, fill, stroke| {
        let at = |pose: &(nalgebra::Matrix3<f64>, Vector3<f64>)| {
            corners.iter().map(|x| place(&(pose.0 * x + pose.1))).collect::<Vec<Point>>()
        };
        let frames = body.poses.iter().map(at).collect();
        Shape::Film { frames, shown, fill, stroke, seconds: body.seconds }
    };
    let axis = |i: usize, sign: f64| {
        let ends = [Vector3::ith(i, body.half[i]), Vector3::ith(i, body.reach.max(body.half[i]))];
        let stroke = Stroke { width: 3.0, dash: style::SOLID, ..style::stroke(Role::Frame(i)).0 };
        film(&ends, towards(i, sign), None, stroke)
    };
    let face = |i: usize, sign: f64| {
        let [j, k] = [(i + 1) % 3, (i + 2) % 3];
        let corners = [[1.0, 1.0], [-1.0, 1.0], [-1.0, -1.0], [1.0, -1.0]].map(|[a, b]| {
            let (j, k) = (Vector3::ith(j, a * body.half[j]), Vector3::ith(k, b * body.half[k]));
            Vector3::ith(i, sign * body.half[i]) + j + k
        });
        let ink = style::stroke(Role::Frame(i)).0.ink;
        let edge = Stroke { ink: style::BLACK, width: 1.0, dash: style::SOLID };
        film(
            &corners,
            towards(i, sign),
            Some(style::tint(ink, if sign > 0.0 { 0.45 } else { 0.7 })),
            edge,
        )
    };
    let behind = (0..3).map(|i| axis(i, -1.0));
    let faces = (0..3).flat_map(|i| [face(i, -1.0), face(i, 1.0)]);
    behind.chain(faces).chain((0..3).map(|i| axis(i, 1.0))).collect()
}

/// A bar that grows with the time, between the first and the last time.
pub(super) fn clock(body: &Body, [left, right]: [f64; 2], y: f64) -> Vec<Shape> {
    let (seconds, shown) = (body.seconds, vec![true, true]);
    let whole = Stroke { ink: Ink::opaque(0xd8d8d8), width: 3.0, dash: style::SOLID };
    let frames = [left, right].map(|to| vec![[left, y], [to, y]]).to_vec();
    let stroke = Stroke { ink: style::GREY, ..whole };
    let label = |at: f64, anchor, time: f64| Shape::Text {
        at: [at, y - 7.0],
        text: format!("t = {}", (time * 1e6).round() / 1e6),
        font: Font::words(13.0, anchor),
    };
    vec![
        Shape::Line { points: vec![[left, y], [right, y]], stroke: whole },
        Shape::Film { frames, shown, fill: None, stroke, seconds },
        label(left, Anchor::Start, body.times[0]),
        label(right, Anchor::End, body.times[1]),
    ]
}
