//! Arrows of figures and of their legend, arrowheads along paths, and marks at the ends of paths.

use super::{Ink, Point, Shape, Stroke, style};

/// The length of an arrowhead.
const HEAD: f64 = 11.0;
/// The positions of arrowheads along a path, as fractions of its length.
const PLACES: [f64; 3] = [0.16, 0.5, 0.84];

/// Draws an arrow: a shaft with a white edge, and a head. An arrow shorter than a pixel becomes a
/// disc.
pub(super) fn arrow(from: Point, to: Point, stroke: Stroke) -> Vec<Shape> {
    let [x, y] = [to[0] - from[0], to[1] - from[1]];
    let length = x.hypot(y);
    if length < 1.0 {
        return vec![Shape::Disc { at: to, radius: stroke.width, ink: stroke.ink }];
    }
    let (head, neck) = head(to, [x / length, y / length], HEAD.min(0.6 * length), stroke.ink);
    let shaft = |stroke| Shape::Line { points: vec![from, neck], stroke };
    // a dashed arrow has no edge, so that shapes behind it are visible through its gaps
    let edge = stroke.dash.is_empty().then(|| shaft(edge(stroke)));
    edge.into_iter().chain([shaft(stroke), head]).collect()
}

/// The white edge that separates a line from the lines behind it.
pub(super) fn edge(stroke: Stroke) -> Stroke {
    Stroke { ink: style::WHITE, width: stroke.width + 2.4, dash: &[] }
}

/// Draws an arrowhead with its tip at `to`, along a unit vector. Also returns the point where the
/// shaft ends.
fn head(to: Point, [x, y]: Point, size: f64, ink: Ink) -> (Shape, Point) {
    let neck = [to[0] - 0.8 * size * x, to[1] - 0.8 * size * y];
    let corner = |side: f64| {
        let across = side * 0.36 * size;
        [to[0] - size * x - across * y, to[1] - size * y + across * x]
    };
    (Shape::Area { points: vec![to, corner(1.0), neck, corner(-1.0)], ink }, neck)
}

/// Draws arrowheads along a path, at fixed fractions of its length.
pub(super) fn heads(path: &[Point], ink: Ink) -> Vec<Shape> {
    let length = |pair: &[Point]| (pair[1][0] - pair[0][0]).hypot(pair[1][1] - pair[0][1]);
    let whole: f64 = path.windows(2).map(length).sum();
    if whole < 4.0 * HEAD {
        return vec![];
    }
    let mut next = PLACES.iter().map(|share| share * whole).peekable();
    let (mut passed, mut found) = (0.0, vec![]);
    for pair in path.windows(2) {
        let here = length(pair);
        while let Some(at) = next.next_if(|at| *at <= passed + here) {
            let share = (at - passed) / here;
            let [x, y] = [pair[1][0] - pair[0][0], pair[1][1] - pair[0][1]];
            // puts the middle of the arrowhead at this position
            let tip = |k: usize, step: f64| pair[0][k] + share * step + 0.5 * HEAD * step / here;
            found.push(head([tip(0, x), tip(1, y)], [x / here, y / here], HEAD, ink).0);
        }
        passed += here;
    }
    found
}

/// Draws a ring at the start of a path, and a disc at its end.
pub(super) fn ends(path: &[Point], ink: Ink) -> Vec<Shape> {
    let (Some(&start), Some(&end)) = (path.first(), path.last()) else { return vec![] };
    let disc = |at, radius, ink| Shape::Disc { at, radius, ink };
    vec![disc(end, 4.2, ink), disc(start, 5.2, ink), disc(start, 2.8, style::WHITE)]
}
