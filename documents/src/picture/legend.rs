//! The legend of a figure, in two columns.

use super::arrow::arrow;
use super::{Anchor, Font, Shape, Stroke, style};
use crate::figures::{Figure, Look, Role};

const LINE: f64 = 24.0;
const COLUMNS: usize = 2;
const SAMPLE: f64 = 34.0;

/// The captions without duplicates, each with a sample of its line, arrow or point.
pub(super) struct Legend(Vec<(Sample, String)>);

#[derive(Clone, Copy)]
enum Sample {
    Arrow(Stroke),
    Line(Stroke),
    Point,
    /// A ring, which marks the start of a path.
    Ring,
}

impl Legend {
    pub(super) fn of(figure: &Figure) -> Self {
        let mut entries: Vec<(Sample, String)> = vec![];
        let mut add = |sample: Sample, caption: &str| {
            if !caption.is_empty() && entries.iter().all(|(_, known)| known != caption) {
                entries.push((sample, caption.into()));
            }
        };
        let panels = || figure.panels.iter();
        for panel in panels() {
            for curve in &panel.curves {
                add(Sample::Line(style::stroke(curve.role).0), &curve.caption);
            }
            for arrow in &panel.arrows {
                add(Sample::Arrow(style::stroke(arrow.role).0), &arrow.caption);
            }
            for body in &panel.bodies {
                match &body.look {
                    Look::Box { captions, .. } => {
                        for (i, caption) in captions.iter().enumerate() {
                            add(Sample::Line(style::stroke(Role::Frame(i)).0), caption);
                        }
                    }
                    Look::Parts { role, caption, .. } => {
                        add(Sample::Line(style::stroke(*role).0), caption);
                    }
                }
            }
            for mark in &panel.marks {
                add(Sample::Point, &mark.caption);
            }
        }
        let paths = |sphere: bool| {
            let panels = panels().filter(|panel| panel.sphere || !sphere);
            panels.flat_map(|panel| &panel.curves).any(|curve| curve.directed)
        };
        if paths(false) {
            add(Sample::Ring, "start of a path");
            add(Sample::Point, "end of a path");
        }
        if paths(true) {
            let pale = style::far(style::stroke(Role::Motion).0);
            add(Sample::Line(pale), "far side: thin and pale");
        }
        Legend(entries)
    }

    pub(super) fn height(&self) -> f64 {
        LINE * self.rows() as f64 + 0.8 * LINE
    }

    fn rows(&self) -> usize {
        self.0.len().div_ceil(COLUMNS)
    }

    pub(super) fn draw(&self, top: f64, width: f64, shapes: &mut Vec<Shape>) {
        for (i, (sample, caption)) in self.0.iter().enumerate() {
            let column = (i / self.rows()) as f64;
            let left = 0.06 * width + column * 0.47 * width;
            let y = top + (i % self.rows()) as f64 * LINE + 0.5 * LINE;
            let [from, to] = [[left, y], [left + SAMPLE, y]];
            match *sample {
                Sample::Arrow(stroke) => shapes.extend(arrow(from, to, stroke)),
                Sample::Line(stroke) => {
                    shapes.push(Shape::Line { points: vec![from, to], stroke });
                }
                Sample::Ring => {
                    let at = [left + 0.5 * SAMPLE, y];
                    shapes.push(Shape::Disc { at, radius: 5.2, ink: style::BLACK });
                    shapes.push(Shape::Disc { at, radius: 2.8, ink: style::WHITE });
                }
                Sample::Point => {
                    let at = [left + 0.5 * SAMPLE, y];
                    shapes.push(Shape::Disc { at, radius: 4.2, ink: style::BLACK });
                }
            }
            let font = Font::words(14.0, Anchor::Start);
            let at = [left + SAMPLE + 10.0, y + 5.0];
            shapes.push(Shape::Text { at, text: caption.clone(), font });
        }
    }
}
