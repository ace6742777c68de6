//! Figures as pictures: panels next to each other, each with its ball, above a legend.

use super::arrow::{arrow, edge, ends, heads};
use super::film;
use super::label::Labels;
use super::legend::Legend;
use super::{Anchor, Font, Picture, Point, Shape, Stroke, View, style};
use crate::figures::{Arrow, Curve, Figure, Panel, Role};
use nalgebra::{Rotation3, Vector3};
use std::cmp::Ordering;
use std::f64::consts::{PI, TAU};

const WIDTH: f64 = 800.0;
/// The largest number of panels in a row.
const COLUMNS: usize = 2;
/// The heights of the title and of the header of a panel.
const HEADS: [f64; 2] = [44.0, 26.0];
/// The margin around a panel.
const MARGIN: f64 = 22.0;
/// The length above which a path in time is drawn with a thin line, in radii of the ball.
const LONG: f64 = 60.0;
/// The length of the axes, in radii of the ball.
const AXES: f64 = 1.12;

/// Draws a figure, viewed from a direction.
///
/// ```
/// use affinor_documents::figures::{Path, images};
/// use affinor_documents::picture::{View, draw, svg};
/// use nalgebra::Vector3;
/// let path = Path { factors: vec![Vector3::new(0.0, 0.0, 1.5), Vector3::new(1.0, 0.0, 0.0)] };
/// let picture = draw(&images(&path, 1.0)?, &View::default());
/// assert!(svg(&picture, 400).contains("Ω"));
/// # Ok::<(), affinor::Error>(())
/// ```
pub fn draw(figure: &Figure, view: &View) -> Picture {
    let columns = figure.panels.len().clamp(1, COLUMNS);
    let width = WIDTH / columns as f64;
    // the height of a single panel may be smaller than its width
    let height = if columns == 1 { 0.75 * width } else { width };
    let has_heads = figure.panels.iter().any(|panel| !panel.title.is_empty());
    let row = height + if has_heads { HEADS[1] } else { 0.0 };
    let reach = figure.panels.iter().map(|panel| reach(panel, view)).fold(AXES, f64::max);
    let scale = (0.5 * width.min(height) - MARGIN) / reach;
    let title = Font::words(19.0, Anchor::Middle);
    let mut shapes = vec![text([0.5 * WIDTH, 30.0], &figure.title, title)];
    for (i, panel) in figure.panels.iter().enumerate() {
        let left = (i % columns) as f64 * width;
        let top = HEADS[0] + (i / columns) as f64 * row;
        let head = Font { size: 15.0, ..title };
        shapes.push(text([left + 0.5 * width, top + 14.0], &panel.title, head));
        let center = [left + 0.5 * width, top + row - 0.5 * height];
        let mut plane = Plane { view, center, scale: scale / panel.radius, shapes: vec![] };
        plane.ball(panel);
        plane.contents(panel);
        shapes.append(&mut plane.shapes);
        if let Some(body) = panel.bodies.first() {
            shapes.extend(film::clock(body, [left + 40.0, left + width - 40.0], top + row - 8.0));
        }
    }
    let top = HEADS[0] + figure.panels.len().div_ceil(columns) as f64 * row;
    let legend = Legend::of(figure);
    legend.draw(top, WIDTH, &mut shapes);
    shapes.retain(|shape| !matches!(shape, Shape::Text { text, .. } if text.is_empty()));
    Picture { title: figure.title.clone(), width: WIDTH, height: top + legend.height(), shapes }
}

/// The largest distance of a point of the panel from its centre along an axis of the picture, in
/// radii.
fn reach(panel: &Panel, view: &View) -> f64 {
    let curves = panel.curves.iter().flat_map(|curve| &curve.points);
    let points = curves.chain(panel.arrows.iter().flat_map(|arrow| &arrow.ends));
    let sizes = points.flat_map(|x| view.flat(x)).map(f64::abs);
    sizes.fold(0.0, f64::max) / panel.radius
}

fn text(at: Point, text: &str, font: Font) -> Shape {
    Shape::Text { at, text: text.into(), font }
}

/// The plane on which a panel is drawn.
struct Plane<'v> {
    view: &'v View,
    center: Point,
    scale: f64,
    shapes: Vec<Shape>,
}

impl Plane<'_> {
    fn place(&self, x: &Vector3<f64>) -> Point {
        let [right, down] = self.view.flat(x);
        [self.center[0] + self.scale * right, self.center[1] + self.scale * down]
    }

    fn line(&mut self, points: &[Vector3<f64>], stroke: Stroke) {
        let points = points.iter().map(|x| self.place(x)).collect();
        self.shapes.push(Shape::Line { points, stroke });
    }

    /// Draws the axes and the sphere.
    fn ball(&mut self, panel: &Panel) {
        let r = panel.radius;
        for (i, label) in panel.axes.iter().enumerate() {
            let end = Vector3::ith(i, AXES * r);
            self.line(&[Vector3::zeros(), end], style::AXIS);
            let at = self.place(&(end * 1.06));
            self.shapes.push(text([at[0], at[1] + 5.0], label, Font::symbol(14.0, style::GREY)));
        }
        if panel.sphere {
            self.sphere(r);
        }
    }

    /// Draws the circles on the sphere, first those on the far side.
    fn sphere(&mut self, r: f64) {
        let parallels = (1..6).map(|i| ring(Vector3::z(), PI / 6.0 * f64::from(i), r));
        let meridians = (0..6).map(|i| {
            let azimuth = PI / 6.0 * f64::from(i);
            ring(Vector3::new(-azimuth.sin(), azimuth.cos(), 0.0), 0.5 * PI, r)
        });
        let circles: Vec<_> = parallels.chain(meridians).collect();
        let great: Vec<_> = (0..3).map(|i| ring(Vector3::ith(i, 1.0), 0.5 * PI, r)).collect();
        for side in [1, 0] {
            for (circles, strokes) in [(&circles, style::CIRCLES), (&great, style::GREAT_CIRCLES)] {
                for circle in circles {
                    for arc in arcs(circle, |x| (self.view.depth(x) >= 0.0) == (side == 0)) {
                        self.line(&arc, strokes[side]);
                    }
                }
            }
        }
        self.line(&ring(self.view.axes()[0], 0.5 * PI, r), style::RIM);
    }

    /// The length of a path in time, measured in the picture; 0 for other curves.
    fn length(&self, curve: &Curve) -> f64 {
        let points = if curve.directed { &curve.points[..] } else { &[] };
        self.scale * points.windows(2).map(|pair| (pair[1] - pair[0]).norm()).sum::<f64>()
    }

    /// Draws a path in time, with arrowheads along it and marks at its ends. The far side of a
    /// sphere is paler.
    fn path(&mut self, Curve { points, .. }: &Curve, sphere: bool, stroke: Stroke) {
        for (near, stroke) in [(false, style::far(stroke)), (true, stroke)] {
            for arc in arcs(points, |x| (!sphere || self.view.depth(x) >= 0.0) == near) {
                self.line(&arc, stroke);
            }
        }
        let flat: Vec<Point> = points.iter().map(|x| self.place(x)).collect();
        self.shapes.extend(heads(&flat, stroke.ink));
        self.shapes.extend(ends(&flat, stroke.ink));
    }

    fn contents(&mut self, panel: &Panel) {
        let background = self.shapes.len();
        let mut curves: Vec<&Curve> = panel.curves.iter().collect();
        // draws longer paths below shorter paths
        let layer = |curve: &Curve| (style::stroke(curve.role).1, -self.length(curve));
        curves.sort_by(|a, b| layer(a).partial_cmp(&layer(b)).unwrap_or(Ordering::Equal));
        for curve in curves {
            let (stroke, _) = style::stroke(curve.role);
            if curve.directed {
                // draws a path that fills the sphere with a thin line
                let thin = self.length(curve) > LONG * panel.radius * self.scale;
                let width = if thin { 0.5 * stroke.width } else { stroke.width };
                self.path(curve, panel.sphere, Stroke { width, ..stroke });
                continue;
            }
            if curve.role == Role::Motion {
                self.line(&curve.points, edge(stroke));
            }
            self.line(&curve.points, stroke);
        }
        let mut arrows: Vec<&Arrow> = panel.arrows.iter().collect();
        arrows.sort_by_key(|arrow| style::stroke(arrow.role).1);
        for Arrow { role, ends, .. } in arrows {
            let [from, to] = ends.map(|x| self.place(&x));
            self.shapes.extend(arrow(from, to, style::stroke(*role).0));
        }
        for mark in &panel.marks {
            let at = self.place(&mark.at);
            self.shapes.push(Shape::Disc { at, radius: 6.0, ink: style::WHITE });
            self.shapes.push(Shape::Disc { at, radius: 4.2, ink: style::BLACK });
        }
        let mut labels = Labels::new(&self.shapes[background..]);
        let mut symbols = vec![];
        for mark in &panel.marks {
            symbols.extend(labels.put(&mark.label, self.place(&mark.at), [0.0, 0.0], style::BLACK));
        }
        for arrow in panel.arrows.iter().rev() {
            let [from, to] = arrow.ends.map(|x| self.place(&x));
            let along = [to[0] - from[0], to[1] - from[1]];
            symbols.extend(labels.put(&arrow.label, to, along, style::stroke(arrow.role).0.ink));
        }
        for curve in &panel.curves {
            let middle = curve.points.len().saturating_sub(1) * 3 / 5;
            if let Some(pair) = curve.points.windows(2).nth(middle) {
                let (at, ink) = (pair[0].lerp(&pair[1], 0.5), style::stroke(curve.role).0.ink);
                symbols.extend(labels.put(&curve.label, self.place(&at), [0.0, 0.0], ink));
            }
        }
        self.shapes.append(&mut symbols);
        let place = |x: &Vector3<f64>| self.place(x);
        let shapes = film::bodies(&panel.bodies, self.view, place);
        self.shapes.extend(shapes);
    }
}

/// The circle on a sphere around `axis`, at this angle from the axis.
fn ring(axis: Vector3<f64>, angle: f64, radius: f64) -> Vec<Vector3<f64>> {
    let turn = Rotation3::rotation_between(&Vector3::z(), &axis)
        .unwrap_or_else(|| Rotation3::from_axis_angle(&Vector3::x_axis(), PI));
    let (sin, cos) = angle.sin_cos();
    let at = |i: u32| {
        let (s, c) = (TAU * f64::from(i) / 96.0).sin_cos();
        turn * Vector3::new(radius * sin * c, radius * sin * s, radius * cos)
    };
    (0..=96).map(at).collect()
}

/// Splits a polyline into maximal runs of segments whose midpoints satisfy `keep`.
fn arcs(line: &[Vector3<f64>], keep: impl Fn(&Vector3<f64>) -> bool) -> Vec<Vec<Vector3<f64>>> {
    let mut arcs: Vec<Vec<Vector3<f64>>> = vec![];
    let mut open = false;
    for pair in line.windows(2) {
        let middle = (pair[0] + pair[1]) * 0.5;
        match arcs.last_mut() {
            Some(arc) if open && keep(&middle) => arc.push(pair[1]),
            _ if keep(&middle) => arcs.push(pair.to_vec()),
            _ => {}
        }
        open = keep(&middle);
    }
    arcs
}
