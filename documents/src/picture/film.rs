//! Animated bodies: polygons with one frame for each pose.

use super::{Anchor, Font, Ink, Point, Shape, Stroke, View, style};
use crate::figures::{Body, Look, Role};
use crate::problem::Solid;
use nalgebra::{Matrix3, Vector3};

/// Draws bodies, nearer bodies in front of others. A face is visible in the frames in which it
/// faces the viewer.
pub(super) fn bodies(
    bodies: &[Body],
    view: &View,
    place: impl Fn(&Vector3<f64>) -> Point,
) -> Vec<Shape> {
    let mut shapes = vec![];
    let mut parts = vec![];
    for body in bodies {
        let film = Film { body, view, place: &place };
        match &body.look {
            Look::Box { half, reach, .. } => shapes.extend(film.cuboid(half, *reach)),
            Look::Parts { solids, role, .. } => {
                parts.extend(solids.iter().map(|solid| Part::new(film, solid, *role)));
            }
        }
    }
    shapes.extend(layered(&parts));
    shapes
}

/// Draws parts in as many layers as there are parts, from back to front. In each frame, a part is
/// visible only in the layer of its distance.
fn layered<P: Fn(&Vector3<f64>) -> Point>(parts: &[Part<P>]) -> Vec<Shape> {
    // the layer of a part in a frame is the number of parts that are behind it
    let is_behind = |other: usize, part: usize, frame: usize| {
        let depth = |part: usize| parts[part].depths[frame];
        depth(other).total_cmp(&depth(part)).then(other.cmp(&part)).is_lt()
    };
    let layer = |part: usize, frame: usize| {
        (0..parts.len()).filter(|other| is_behind(*other, part, frame)).count()
    };
    let layers: Vec<Vec<usize>> = parts
        .iter()
        .enumerate()
        .map(|(at, part)| (0..part.depths.len()).map(|frame| layer(at, frame)).collect())
        .collect();
    let in_layer = |layer: usize| {
        parts.iter().zip(&layers).flat_map(move |(part, layers)| {
            let here: Vec<bool> = layers.iter().map(|own| *own == layer).collect();
            if here.contains(&true) { part.shapes(&here) } else { vec![] }
        })
    };
    (0..parts.len()).flat_map(in_layer).collect()
}

/// The animation of a body.
struct Film<'b, P> {
    body: &'b Body,
    view: &'b View,
    place: &'b P,
}

impl<P> Clone for Film<'_, P> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<P> Copy for Film<'_, P> {}

impl<P: Fn(&Vector3<f64>) -> Point> Film<'_, P> {
    /// For each frame, whether this direction of the body points to the viewer.
    fn towards(&self, direction: &Vector3<f64>) -> Vec<bool> {
        let points =
            |(r, _): &(Matrix3<f64>, Vector3<f64>)| self.view.depth(&(r * direction)) >= 0.0;
        self.body.poses.iter().map(points).collect()
    }

    fn polygon(
        &self,
        corners: &[Vector3<f64>],
        shown: Vec<bool>,
        fill: Option<Ink>,
        stroke: Stroke,
    ) -> Shape {
        let at = |pose: &(Matrix3<f64>, Vector3<f64>)| {
            corners.iter().map(|x| (self.place)(&(pose.0 * x + pose.1))).collect::<Vec<Point>>()
        };
        let frames = self.body.poses.iter().map(at).collect();
        Shape::Film { frames, shown, fill, stroke, seconds: self.body.seconds }
    }

    /// Draws a box and its axes of inertia. The drawing of an axis that points away from the viewer
    /// begins behind the box.
    fn cuboid(&self, half: &[f64; 3], reach: f64) -> Vec<Shape> {
        let towards = |i: usize, sign: f64| self.towards(&Vector3::ith(i, sign));
        let axis = |i: usize, sign: f64| {
            let ends = [Vector3::ith(i, half[i]), Vector3::ith(i, reach.max(half[i]))];
            let stroke =
                Stroke { width: 3.0, dash: style::SOLID, ..style::stroke(Role::Frame(i)).0 };
            self.polygon(&ends, towards(i, sign), None, stroke)
        };
        let face = |i: usize, sign: f64| {
            let [j, k] = [(i + 1) % 3, (i + 2) % 3];
            let corners = [[1.0, 1.0], [-1.0, 1.0], [-1.0, -1.0], [1.0, -1.0]].map(|[a, b]| {
                let (j, k) = (Vector3::ith(j, a * half[j]), Vector3::ith(k, b * half[k]));
                Vector3::ith(i, sign * half[i]) + j + k
            });
            let ink = style::stroke(Role::Frame(i)).0.ink;
            let tint = style::tint(ink, if sign > 0.0 { 0.45 } else { 0.7 });
            self.polygon(&corners, towards(i, sign), Some(tint), EDGE)
        };
        let behind = (0..3).map(|i| axis(i, -1.0));
        let faces = (0..3).flat_map(|i| [face(i, -1.0), face(i, 1.0)]);
        behind.chain(faces).chain((0..3).map(|i| axis(i, 1.0))).collect()
    }
}

/// The stroke of the edges of a box.
const EDGE: Stroke = Stroke { ink: style::BLACK, width: 1.0, dash: style::SOLID };
/// The stroke of the edges of parts.
const THIN: Stroke = Stroke { width: 0.5, ..EDGE };

/// A part of an animated body.
struct Part<'b, P> {
    film: Film<'b, P>,
    solid: &'b Solid,
    role: Role,
    /// For each frame, the coordinate of the middle of the part towards the viewer.
    depths: Vec<f64>,
}

impl<'b, P: Fn(&Vector3<f64>) -> Point> Part<'b, P> {
    fn new(film: Film<'b, P>, solid: &'b Solid, role: Role) -> Self {
        let middle = solid.corners.iter().sum::<Vector3<f64>>() / solid.corners.len() as f64;
        let depth = |(r, x): &(Matrix3<f64>, Vector3<f64>)| film.view.depth(&(r * middle + x));
        Part { film, solid, role, depths: film.body.poses.iter().map(depth).collect() }
    }

    /// The faces of the part, visible in the frames for which `here` is true.
    fn shapes(&self, here: &[bool]) -> Vec<Shape> {
        let ink = style::stroke(self.role).0.ink;
        let face = |face: &Vec<usize>| {
            let corners: Vec<Vector3<f64>> = face.iter().map(|k| self.solid.corners[*k]).collect();
            if let [_, _] = corners[..] {
                let stroke = Stroke { ink, width: 3.0, dash: style::SOLID };
                return self.film.polygon(&corners, here.to_vec(), None, stroke);
            }
            let (a, b) = (corners[1] - corners[0], corners[2] - corners[0]);
            let normal = a.cross(&b);
            let towards = self.film.towards(&normal);
            let shown = towards.iter().zip(here).map(|(towards, here)| *towards && *here).collect();
            // the shade of a face depends on its direction
            let share = normal.try_normalize(0.0).map_or(0.0, |n| n.dot(&LIGHT));
            self.film.polygon(&corners, shown, Some(style::tint(ink, 0.5 + 0.25 * share)), THIN)
        };
        self.solid.faces.iter().map(face).collect()
    }
}

/// The direction, in the frame of the body, of the lightest faces.
const LIGHT: Vector3<f64> = Vector3::new(0.36, 0.48, 0.8);

/// A bar that shows the time: it grows from the first to the last time.
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
