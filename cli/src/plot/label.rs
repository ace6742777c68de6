//! Places of symbols: near their point, away from lines and from each other.

use super::{Font, Ink, Point, Shape};
use std::f64::consts::TAU;

const SIZE: f64 = 18.0;
/// The distance of the points by which a line repels symbols.
const STEP: f64 = 4.0;

/// Symbols placed so far.
pub(super) struct Labels {
    /// Points of lines, each with its weight.
    lines: Vec<(Point, f64)>,
    boxes: Vec<[Point; 2]>,
    shapes: Vec<Shape>,
}

impl Labels {
    /// Places around shapes; the lines among the first `background` ones do not repel.
    pub(super) fn new(shapes: &[Shape], background: usize) -> Self {
        let mut lines = vec![];
        let mut boxes = vec![];
        for (at, shape) in shapes.iter().enumerate() {
            match shape {
                Shape::Line { points, stroke } if at >= background => {
                    let weight = if stroke.width > 1.5 { 4.0 } else { 2.0 };
                    lines.extend(dense(points).map(|point| (point, weight)));
                }
                Shape::Disc { at, radius, .. } => boxes.push(square(*at, *radius)),
                Shape::Area { points, .. } => lines.extend(dense(points).map(|p| (p, 8.0))),
                Shape::Text { at, text, font } => boxes.push(extent(*at, text, font.size)),
                Shape::Line { .. } | Shape::Film { .. } => {}
            }
        }
        Labels { lines, boxes, shapes: vec![] }
    }

    /// Places a symbol near a point, preferably ahead of it in a direction.
    pub(super) fn put(&mut self, text: &str, near: Point, ahead: Point, ink: Ink) {
        if text.is_empty() {
            return;
        }
        let wish = ahead[1].atan2(ahead[0]);
        let wished = ahead != [0.0, 0.0];
        let places = [13.0, 18.0, 25.0, 34.0]
            .into_iter()
            .flat_map(|far| (0..24).map(move |i| (far, TAU * f64::from(i) / 24.0)));
        let cost = |(far, angle): (f64, f64)| {
            let at = beside(near, text, far, angle);
            let area = extent(at, text, SIZE);
            let on_lines: f64 =
                self.lines.iter().filter(|(p, _)| inside(p, &area)).map(|(_, weight)| weight).sum();
            let on_boxes = self.boxes.iter().map(|other| overlap(other, &area)).sum::<f64>();
            let aside = if wished { 2.0 * (1.0 - (angle - wish).cos()) } else { 0.0 };
            (on_lines + 2.0 * on_boxes + 0.35 * far + aside, at)
        };
        let best = places.map(cost).min_by(|a, b| a.0.total_cmp(&b.0));
        let Some((_, at)) = best else { return };
        self.boxes.push(extent(at, text, SIZE));
        self.shapes.push(Shape::Text { at, text: text.into(), font: Font::symbol(SIZE, ink) });
    }

    /// The symbols, placed.
    pub(super) fn shapes(self) -> Vec<Shape> {
        self.shapes
    }
}

/// The anchor of a text whose box is `far` away from a point.
fn beside(near: Point, text: &str, far: f64, angle: f64) -> Point {
    let (sin, cos) = angle.sin_cos();
    let half = 0.5 * width(text, SIZE);
    [near[0] + cos * (far - 6.0 + half), near[1] + sin * far + 0.36 * SIZE]
}

/// An estimate of the width of a text.
pub(super) fn width(text: &str, size: f64) -> f64 {
    0.6 * size * text.chars().count() as f64
}

/// The box of a text with its anchor in the middle.
fn extent(at: Point, text: &str, size: f64) -> [Point; 2] {
    let half = 0.5 * width(text, size);
    [[at[0] - half, at[1] - 0.85 * size], [at[0] + half, at[1] + 0.15 * size]]
}

fn square(at: Point, half: f64) -> [Point; 2] {
    [[at[0] - half, at[1] - half], [at[0] + half, at[1] + half]]
}

fn inside(p: &Point, [low, high]: &[Point; 2]) -> bool {
    (0..2).all(|i| low[i] <= p[i] && p[i] <= high[i])
}

fn overlap(a: &[Point; 2], b: &[Point; 2]) -> f64 {
    let side = |i: usize| (a[1][i].min(b[1][i]) - a[0][i].max(b[0][i])).max(0.0);
    side(0) * side(1)
}

/// Points along a line.
fn dense(points: &[Point]) -> impl Iterator<Item = Point> {
    points.windows(2).flat_map(|pair| {
        let [from, to] = [pair[0], pair[1]];
        let n = ((to[0] - from[0]).hypot(to[1] - from[1]) / STEP).ceil().clamp(1.0, 1e3) as u32;
        (0..n).map(move |i| {
            let s = f64::from(i) / f64::from(n);
            [from[0] + s * (to[0] - from[0]), from[1] + s * (to[1] - from[1])]
        })
    })
}
