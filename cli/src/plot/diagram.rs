//! Diagrams as pictures, with axes and legends by plotters.

use super::arrow::{ends, heads};
use super::backend::Shapes;
use super::label::{Labels, width};
use super::{Anchor, Font, Ink, Picture, Point, Shape, Stroke, style};
use crate::figures::diagram::{Diagram, Drawn, Graph, Scale};
use plotters::coord::ranged1d::ValueFormatter;
use plotters::coord::types::RangedCoordf64;
use plotters::prelude::*;
use std::ops::Range;

/// The width and the least height of a panel, without its captions.
const PANEL: [u32; 2] = [560, 420];
/// The height of the title, and the margin and the labels around the axes.
const TITLE: u32 = 40;
const MARGIN: u32 = 12;
const LABELS: [u32; 2] = [64, 44];
const FONT: &str = "DejaVu Sans";
const SMALL: f64 = 13.0;
/// The height of a caption, and the width before its text.
const LINE: f64 = 17.0;
const SAMPLE: f64 = 34.0;
/// The room beside the axes for the names of the ends of a curve.
const ENDS: f64 = 60.0;
/// The colours of the lines, distinguishable in greyscale. Others follow by [`ink`].
const INKS: [u32; 10] = [
    0x111111, 0x0a5fa8, 0xd05a00, 0x1aa67a, 0xa3173f, 0x966ec8, 0x787878, 0xc8a000, 0x56b4e9,
    0x643c14,
];

/// The diagram as a picture. Captions stand beside the axes, at the heights of the ends of their lines.
pub fn diagram(diagram: &Diagram) -> Picture {
    let count = diagram.graphs.len().max(1);
    let captions =
        |graph: &Graph| graph.lines.iter().filter(|line| !line.caption.is_empty()).count();
    let most = diagram.graphs.iter().map(captions).max().unwrap_or(0);
    let height = PANEL[1].max((LINE * most as f64) as u32 + LABELS[1] + 2 * MARGIN);
    let all = diagram.graphs.iter().flat_map(|graph| &graph.lines);
    let widest = all.map(|line| width(&line.caption, SMALL)).fold(0.0, f64::max);
    let beside = if widest > 0.0 { SAMPLE + widest } else { ENDS };
    let beside = beside as u32;
    let size = (PANEL[0] + beside, height * count as u32 + TITLE);
    let mut shapes = vec![];
    let mut frames = vec![];
    {
        let root = Shapes { shapes: &mut shapes, size }.into_drawing_area();
        // a graph without room is left out; collecting shapes cannot fail
        if let Ok(below) = root.titled(&diagram.title, (FONT, 20).into_font()) {
            let areas = below.split_evenly((count, 1));
            let drawn = areas.iter().zip(&diagram.graphs);
            frames.extend(drawn.map(|(area, graph)| axes(area, graph, MARGIN + beside).ok()));
        }
    }
    for (frame, graph) in frames.iter().zip(&diagram.graphs) {
        if let Some(frame) = frame {
            shapes.append(&mut frame.contents(graph));
        }
    }
    let (width, height) = (f64::from(size.0), f64::from(size.1));
    Picture { title: diagram.title.clone(), width, height, shapes }
}

/// The colour of a line; no two lines have the same.
fn ink(number: usize) -> Ink {
    if let Some(known) = INKS.get(number) {
        return Ink::opaque(*known);
    }
    // hues a golden section apart never meet
    let turn = 0.618_033_988_749_895 * (number - INKS.len()) as f64;
    let lightness = [0.25, 0.37, 0.49][number % 3];
    let (red, green, blue) = HSLColor(turn.fract(), 0.7, lightness).to_rgba().rgb();
    Ink { rgb: [red, green, blue], opacity: 1.0 }
}

type Area<'a> = DrawingArea<Shapes<'a>, plotters::coord::Shift>;
type Failed<'a> = DrawingAreaErrorKind<<Shapes<'a> as DrawingBackend>::ErrorType>;

/// The axes of a graph: their places in the picture, and their ranges.
struct Frame {
    places: [Range<f64>; 2],
    ranges: [Range<f64>; 2],
}

/// Draws the axes of a graph; values on a logarithmic axis are drawn by their exponents.
fn axes<'a>(area: &Area<'a>, graph: &Graph, right: u32) -> Result<Frame, Failed<'a>> {
    let points =
        || graph.lines.iter().flat_map(|line| &line.points).map(|point| flat(graph, point));
    let (mut x, mut y) =
        (range(points().map(|point| point[0])), range(points().map(|point| point[1])));
    if graph.equal {
        // the room inside the axes
        let (width, height) = area.dim_in_pixel();
        let across = f64::from(width) - f64::from(LABELS[0] + MARGIN + right);
        let down = f64::from(height) - f64::from(LABELS[1] + 2 * MARGIN);
        let unit = ((x.end - x.start) / across).max((y.end - y.start) / down);
        (x, y) = (widened(&x, unit * across), widened(&y, unit * down));
    }
    let mut chart = ChartBuilder::on(area)
        .margin(MARGIN)
        .margin_right(right)
        .x_label_area_size(LABELS[1])
        .y_label_area_size(LABELS[0])
        .build_cartesian_2d(
            Axis(x.clone().into(), graph.x.logarithmic),
            Axis(y.clone().into(), graph.y.logarithmic),
        )?;
    chart
        .configure_mesh()
        .light_line_style(TRANSPARENT)
        .bold_line_style(RGBColor(225, 225, 225))
        .axis_desc_style((FONT, 14))
        .label_style((FONT, SMALL))
        .x_desc(&graph.x.label)
        .y_desc(&graph.y.label)
        .draw()?;
    let (across, down) = chart.plotting_area().get_pixel_range();
    let places = [across, down].map(|range| f64::from(range.start)..f64::from(range.end));
    Ok(Frame { places, ranges: [x, y] })
}

fn flat(graph: &Graph, [x, y]: &[f64; 2]) -> [f64; 2] {
    [exponent(&graph.x, *x), exponent(&graph.y, *y)]
}

fn exponent(scale: &Scale, value: f64) -> f64 {
    if scale.logarithmic { value.log10() } else { value }
}

impl Frame {
    /// The lines of a graph, and their captions.
    fn contents(&self, graph: &Graph) -> Vec<Shape> {
        let mut shapes = vec![];
        let mut captions = vec![];
        let mut colours = 0..;
        for line in &graph.lines {
            let points = self.placed(graph, &line.points);
            let guide = line.drawn == Drawn::Guide;
            let number = if guide { 0 } else { colours.next().unwrap_or(0) };
            let ink = if guide { style::GREY } else { ink(number) };
            // in print, colours that follow the first are told apart by their dashes
            let dashes = [style::SOLID, style::DASHED, style::SHORT];
            let dash = dashes[(number / INKS.len()).min(2)];
            let (width, dash) = if guide { (1.0, style::DOTTED) } else { (2.0, dash) };
            let stroke = Stroke { ink, width, dash };
            let disc = |at: &Point, radius| Shape::Disc { at: *at, radius, ink };
            match line.drawn {
                Drawn::Points => shapes.extend(points.iter().map(|at| disc(at, 2.0))),
                _ => shapes.push(Shape::Line { points: points.clone(), stroke }),
            }
            match line.drawn {
                Drawn::Marked => shapes.extend(points.iter().map(|at| disc(at, 3.0))),
                Drawn::Directed => {
                    shapes.extend(heads(&points, ink));
                    shapes.extend(ends(&points, ink));
                    let mut labels = Labels::new(&shapes, 0);
                    for (at, text) in [(points.first(), "start"), (points.last(), "end")] {
                        let at = at.copied().unwrap_or_default();
                        labels.put(text, at, [0.0, 0.0], style::BLACK);
                    }
                    shapes.append(&mut labels.shapes());
                }
                _ => {}
            }
            let last = points.iter().copied().max_by(|a, b| a[0].total_cmp(&b[0]));
            if let Some(last) = last.filter(|_| !line.caption.is_empty()) {
                captions.push((last, stroke, line.caption.clone()));
            }
        }
        self.captions(captions, &mut shapes);
        shapes
    }

    /// The finite points in the picture.
    fn placed(&self, graph: &Graph, points: &[[f64; 2]]) -> Vec<Point> {
        let place = |point: &[f64; 2]| {
            let [x, y] = flat(graph, point);
            let share = |k: usize, value: f64| {
                let range = &self.ranges[k];
                (value - range.start) / (range.end - range.start)
            };
            let [across, down] = &self.places;
            [
                across.start + share(0, x) * (across.end - across.start),
                down.end - share(1, y) * (down.end - down.start),
            ]
        };
        let placed = points.iter().map(place);
        placed.filter(|[x, y]| x.is_finite() && y.is_finite()).collect()
    }

    /// Captions beside the axes, as near to the ends of their lines as there is room.
    fn captions(&self, mut captions: Vec<(Point, Stroke, String)>, shapes: &mut Vec<Shape>) {
        captions.sort_by(|a, b| a.0[1].total_cmp(&b.0[1]));
        let [across, down] = &self.places;
        let half = 0.5 * LINE;
        let mut heights: Vec<f64> = vec![];
        for (end, ..) in &captions {
            let free = heights.last().map_or(down.start + half, |above| above + LINE);
            heights.push(end[1].max(free));
        }
        // what runs over the lower end moves up
        let mut free = down.end - half;
        for height in heights.iter_mut().rev() {
            *height = height.min(free);
            free = *height - LINE;
        }
        for ((end, stroke, caption), y) in captions.into_iter().zip(heights) {
            let (from, to) = (across.end + 8.0, across.end + SAMPLE - 8.0);
            let thin = Stroke { width: 0.7, dash: style::SOLID, ..stroke };
            // only a line that ends at the right edge has a leader
            if across.end - end[0] < 0.06 * (across.end - across.start) {
                shapes.push(Shape::Line { points: vec![end, [from, y]], stroke: thin });
            }
            shapes.push(Shape::Line { points: vec![[from, y], [to, y]], stroke });
            let font = Font { ink: stroke.ink, ..Font::words(SMALL, Anchor::Start) };
            let at = [to + 5.0, y + 0.35 * SMALL];
            shapes.push(Shape::Text { at, text: caption, font });
        }
    }
}

/// The least margin of a range, relative to its values.
const NARROW: f64 = 64.0 * f64::EPSILON;

/// The range of the finite values, with a margin.
fn range(values: impl Iterator<Item = f64>) -> Range<f64> {
    let finite = values.filter(|value| value.is_finite());
    let around = |(low, high): (f64, f64), value: f64| (low.min(value), high.max(value));
    let (low, high) = finite.fold((f64::INFINITY, f64::NEG_INFINITY), around);
    if low > high {
        return 0.0..1.0;
    }
    let margin = if high > low { 0.04 * (high - low) } else { 0.5 };
    // ticks of a narrower range would be the same floats
    let margin = margin.max(NARROW * low.abs().max(high.abs()));
    low - margin..high + margin
}

/// A range of some length with the same middle.
fn widened(range: &Range<f64>, length: f64) -> Range<f64> {
    let middle = 0.5 * (range.start + range.end);
    middle - 0.5 * length..middle + 0.5 * length
}

/// A value of an axis, rounded to a millionth of the range. Very small and very large ranges have exponents.
fn label(value: f64, range: &Range<f64>) -> String {
    let exponent = |x: f64| x.abs().log10().floor();
    let digits = exponent(value) - exponent(range.end - range.start) + 6.0;
    if value == 0.0 || digits < 0.0 {
        return "0".into();
    }
    let written = format!("{value:.*e}", (digits as usize).min(16));
    let rounded: f64 = written.parse().unwrap_or(value);
    let largest = range.start.abs().max(range.end.abs());
    if (1e-4..1e6).contains(&largest) { rounded.to_string() } else { format!("{rounded:e}") }
}

/// A range of values, or of their exponents where the flag is set.
#[derive(Clone)]
struct Axis(RangedCoordf64, bool);

impl Ranged for Axis {
    type FormatOption = plotters::coord::ranged1d::NoDefaultFormatting;
    type ValueType = f64;

    fn map(&self, value: &f64, limit: (i32, i32)) -> i32 {
        self.0.map(value, limit)
    }

    fn key_points<H: plotters::coord::ranged1d::KeyPointHint>(&self, hint: H) -> Vec<f64> {
        let range = self.0.range();
        if !self.1 {
            // plotters takes a range below 2e-16 for a point
            let unit = 10_f64.powf((range.end - range.start).log10().floor());
            let scaled = RangedCoordf64::from(range.start / unit..range.end / unit);
            return scaled.key_points(hint).into_iter().map(|value| value * unit).collect();
        }
        // powers of ten, about eight of them; where there are few also twice and five times these
        let (low, high) = (range.start.ceil() as i64, range.end.floor() as i64);
        if high - low < 2 {
            let all =
                (low - 1..=high).flat_map(|k| [1.0, 2.0, 5.0].map(|m: f64| m.log10() + k as f64));
            return all.filter(|value| range.contains(value)).collect();
        }
        let every = ((high - low) / 8).max(0) + 1;
        (low..=high).filter(|k| k.rem_euclid(every) == 0).map(|k| k as f64).collect()
    }

    fn range(&self) -> Range<f64> {
        self.0.range()
    }
}

impl ValueFormatter<f64> for Axis {
    fn format_ext(&self, value: &f64) -> String {
        if !self.1 {
            return label(*value, &self.0.range());
        }
        let power = (value + 1e-9).floor();
        format!("{:.0}e{power:.0}", 10_f64.powf(value - power))
    }
}
