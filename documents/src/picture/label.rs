//! Placement of symbols: near their points, away from lines and from other symbols.

use super::{Font, Ink, Point, Shape, width};
use std::f64::consts::TAU;

const SIZE: f64 = 18.0;
/// The distance between sample points on lines; these points repel symbols.
const STEP: f64 = 4.0;

/// Places symbols one after the other.
pub(super) struct Labels {
    /// Sample points of lines.
    lines: Vec<Point>,
    /// The lower and the upper corner of a box around each disc and each symbol.
    boxes: Vec<[Point; 2]>,
}

impl Labels {
    /// Prepares the placement of symbols among these shapes.
    pub(super) fn new(shapes: &[Shape]) -> Self {
        let (mut lines, mut boxes) = (vec![], vec![]);
        for shape in shapes {
            match shape {
                Shape::Line { points, .. } | Shape::Area { points, .. } => {
                    lines.extend(points.windows(2).flat_map(|pair| dense(pair[0], pair[1])));
                }
                Shape::Disc { at: [x, y], radius: r, .. } => {
                    boxes.push([[x - r, y - r], [x + r, y + r]]);
                }
                Shape::Text { .. } | Shape::Film { .. } => {}
            }
        }
        Labels { lines, boxes }
    }

    /// Places a symbol near a point, preferably on the side to which the direction points; `None`
    /// for an empty text.
    pub(super) fn put(
        &mut self,
        text: &str,
        near: Point,
        [x, y]: Point,
        ink: Ink,
    ) -> Option<Shape> {
        if text.is_empty() {
            return None;
        }
        let wish = y.atan2(x);
        let wished = if [x, y] == [0.0, 0.0] { 0.0 } else { 2.0 };
        let half = 0.5 * width(text, SIZE);
        let cost = |(far, angle): (f64, f64)| {
            let (sin, cos) = angle.sin_cos();
            let at = [near[0] + cos * (far - 6.0 + half), near[1] + sin * far + 0.36 * SIZE];
            let area = [[at[0] - half, at[1] - 0.85 * SIZE], [at[0] + half, at[1] + 0.15 * SIZE]];
            let on_lines = self.lines.iter().filter(|point| inside(point, &area)).count();
            let on_boxes: f64 = self.boxes.iter().map(|other| overlap(other, &area)).sum();
            let aside = wished * (1.0 - (angle - wish).cos());
            (4.0 * on_lines as f64 + 2.0 * on_boxes + 0.35 * far + aside, at, area)
        };
        let angles = (0..24).map(|i| TAU * f64::from(i) / 24.0);
        let places = angles.flat_map(|angle| [13.0, 18.0, 25.0, 34.0].map(|far| (far, angle)));
        let best = places.map(cost).min_by(|a, b| a.0.total_cmp(&b.0));
        let (_, at, area) = best?;
        self.boxes.push(area);
        Some(Shape::Text { at, text: text.into(), font: Font::symbol(SIZE, ink) })
    }
}

fn inside(point: &Point, [low, high]: &[Point; 2]) -> bool {
    (0..2).all(|k| low[k] <= point[k] && point[k] <= high[k])
}

fn overlap(a: &[Point; 2], b: &[Point; 2]) -> f64 {
    let side = |k: usize| (a[1][k].min(b[1][k]) - a[0][k].max(b[0][k])).max(0.0);
    side(0) * side(1)
}

/// Sample points along a line.
fn dense(from: Point, to: Point) -> impl Iterator<Item = Point> {
    let length = (to[0] - from[0]).hypot(to[1] - from[1]);
    let count = (length / STEP).ceil().clamp(1.0, 1e3) as u32;
    (0..count).map(move |i| {
        let share = f64::from(i) / f64::from(count);
        [0, 1].map(|k| from[k] + share * (to[k] - from[k]))
    })
}
