//! Diagrams as pictures, with axes and legends by plotters.

use super::backend::Shapes;
use super::{Ink, Picture};
use crate::figures::diagram::{Diagram, Graph, Scale};
use plotters::coord::ranged1d::ValueFormatter;
use plotters::coord::types::RangedCoordf64;
use plotters::prelude::*;
use std::ops::Range;

/// The width and height of a panel.
const PANEL: [u32; 2] = [560, 420];
/// The height of the title.
const TITLE: u32 = 40;
const FONT: &str = "DejaVu Sans";
/// The colours of the lines, distinguishable in greyscale.
const INKS: [u32; 10] = [
    0x111111, 0x0a5fa8, 0xd05a00, 0x1aa67a, 0xa3173f, 0x966ec8, 0x787878, 0xc8a000, 0x56b4e9,
    0x643c14,
];

/// The diagram as a picture.
pub fn diagram(diagram: &Diagram) -> Picture {
    let count = diagram.graphs.len().max(1) as u32;
    let size = (PANEL[0] * count, PANEL[1] + TITLE);
    let mut shapes = vec![];
    {
        let root = Shapes { shapes: &mut shapes, size }.into_drawing_area();
        // a graph without room is left out; collecting shapes cannot fail
        if let Ok(below) = root.titled(&diagram.title, (FONT, 20).into_font()) {
            let areas = below.split_evenly((1, count as usize));
            for (area, graph) in areas.iter().zip(&diagram.graphs) {
                let _ = draw(area, graph);
            }
        }
    }
    let (width, height) = (f64::from(size.0), f64::from(size.1));
    Picture { title: diagram.title.clone(), width, height, shapes }
}

type Area<'a> = DrawingArea<Shapes<'a>, plotters::coord::Shift>;
type Drawn<'a> = Result<(), DrawingAreaErrorKind<<Shapes<'a> as DrawingBackend>::ErrorType>>;

/// Draws a graph; values on a logarithmic axis are drawn by their exponents.
fn draw<'a>(area: &Area<'a>, graph: &Graph) -> Drawn<'a> {
    let flat = |[x, y]: [f64; 2]| (exponent(&graph.x, x), exponent(&graph.y, y));
    let points = || graph.lines.iter().flat_map(|line| &line.points).map(|point| flat(*point));
    let (x, y) = (range(points().map(|point| point.0)), range(points().map(|point| point.1)));
    let mut chart = ChartBuilder::on(area)
        .margin(12)
        .x_label_area_size(44)
        .y_label_area_size(64)
        .build_cartesian_2d(
        Axis(x.clone().into(), graph.x.logarithmic),
        Axis(y.clone().into(), graph.y.logarithmic),
    )?;
    let labels = (FONT, 13);
    chart
        .configure_mesh()
        .light_line_style(TRANSPARENT)
        .bold_line_style(RGBColor(225, 225, 225))
        .axis_desc_style((FONT, 14))
        .label_style(labels)
        .x_desc(&graph.x.label)
        .y_desc(&graph.y.label)
        .draw()?;
    for (i, line) in graph.lines.iter().enumerate() {
        let [red, green, blue] = Ink::opaque(INKS[i % INKS.len()]).rgb;
        let ink = RGBColor(red, green, blue);
        let points: Vec<(f64, f64)> = line.points.iter().map(|point| flat(*point)).collect();
        let finite = points.into_iter().filter(|(x, y)| x.is_finite() && y.is_finite());
        let points: Vec<(f64, f64)> = finite.collect();
        if line.marked {
            chart.draw_series(points.iter().map(|at| Circle::new(*at, 3, ink.filled())))?;
        }
        chart
            .draw_series(LineSeries::new(points, ink.stroke_width(2)))?
            .label(&line.caption)
            .legend(move |(x, y)| PathElement::new([(x, y), (x + 18, y)], ink.stroke_width(2)));
    }
    chart
        .configure_series_labels()
        .position(emptiest(points(), &x, &y))
        .background_style(WHITE.mix(0.8))
        .border_style(RGBColor(180, 180, 180))
        .label_font(labels)
        .draw()
}

fn exponent(scale: &Scale, value: f64) -> f64 {
    if scale.logarithmic { value.log10() } else { value }
}

/// The corner with the fewest points near it.
fn emptiest(
    points: impl Iterator<Item = (f64, f64)>,
    x: &Range<f64>,
    y: &Range<f64>,
) -> SeriesLabelPosition {
    use SeriesLabelPosition::{LowerLeft, LowerRight, UpperLeft, UpperRight};
    let share = |value: f64, range: &Range<f64>| (value - range.start) / (range.end - range.start);
    let mut counts = [0; 4];
    for (at_x, at_y) in points {
        let (right, up) = (share(at_x, x), share(at_y, y));
        let near = |share: f64, high: bool| if high { share > 0.6 } else { share < 0.4 };
        for (k, count) in counts.iter_mut().enumerate() {
            *count += usize::from(near(right, k < 2) && near(up, k % 2 == 0));
        }
    }
    let fewest = (0..4).min_by_key(|k| counts[*k]);
    match fewest {
        Some(1) => LowerRight,
        Some(2) => UpperLeft,
        Some(3) => LowerLeft,
        _ => UpperRight,
    }
}

/// The range of the finite values, with a margin.
fn range(values: impl Iterator<Item = f64>) -> Range<f64> {
    let finite = values.filter(|value| value.is_finite());
    let around = |(low, high): (f64, f64), value: f64| (low.min(value), high.max(value));
    let (low, high) = finite.fold((f64::INFINITY, f64::NEG_INFINITY), around);
    if low > high {
        return 0.0..1.0;
    }
    let margin = if high > low { 0.04 * (high - low) } else { 0.5 };
    low - margin..high + margin
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
            return self.0.key_points(hint);
        }
        // integer exponents, about eight of them
        let (low, high) = (range.start.ceil() as i64, range.end.floor() as i64);
        let every = ((high - low) / 8).max(0) + 1;
        (low..=high).filter(|k| k.rem_euclid(every) == 0).map(|k| k as f64).collect()
    }

    fn range(&self) -> Range<f64> {
        self.0.range()
    }
}

impl ValueFormatter<f64> for Axis {
    fn format_ext(&self, value: &f64) -> String {
        if self.1 { format!("1e{value:.0}") } else { format!("{}", (value * 1e9).round() / 1e9) }
    }
}
