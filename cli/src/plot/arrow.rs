//! Arrows of figures and of their legend.

use super::{Point, Shape, Stroke, style};

/// The length of an arrowhead.
const HEAD: f64 = 11.0;

/// An arrow: a shaft on a white edge, and a head; a disc where it is shorter than a pixel.
pub(super) fn arrow(from: Point, to: Point, stroke: Stroke) -> Vec<Shape> {
    let [x, y] = [to[0] - from[0], to[1] - from[1]];
    let length = x.hypot(y);
    if length < 1.0 {
        return vec![Shape::Disc { at: to, radius: stroke.width, ink: stroke.ink }];
    }
    let [x, y] = [x / length, y / length];
    let head = HEAD.min(0.6 * length);
    let neck = [to[0] - 0.8 * head * x, to[1] - 0.8 * head * y];
    let corner = |side: f64| {
        let across = side * 0.36 * head;
        [to[0] - head * x - across * y, to[1] - head * y + across * x]
    };
    let shaft = |stroke| Shape::Line { points: vec![from, neck], stroke };
    // a dashed arrow has no edge: what lies behind it shows through its gaps
    let edge = stroke.dash.is_empty().then(|| shaft(edge(stroke)));
    let head = Shape::Area { points: vec![to, corner(1.0), neck, corner(-1.0)], ink: stroke.ink };
    edge.into_iter().chain([shaft(stroke), head]).collect()
}

/// The white edge that sets a line apart from the lines behind it.
pub(super) fn edge(stroke: Stroke) -> Stroke {
    Stroke { ink: style::WHITE, width: stroke.width + 2.4, dash: &[] }
}
