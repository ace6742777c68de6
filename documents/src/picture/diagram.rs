//! Diagrams as pictures: graphs one below the other, with axes, and with captions next to the axes.

use super::arrow::{ends, heads};
use super::axis::Axis;
use super::label::Labels;
use super::{Anchor, Font, Ink, Picture, Point, SOLID, Shape, Stroke, style, width};
use crate::figures::diagram::{Diagram, Drawn, Graph, Line};
use std::ops::Range;

/// The width of a graph without its captions, and its smallest height.
const GRAPH: [f64; 2] = [560.0, 420.0];
/// The height of the title, the height of the labels below a graph, and the margin.
const TITLE: f64 = 40.0;
const BELOW: f64 = 44.0;
const MARGIN: f64 = 12.0;
/// The font sizes of the labels of ticks, and of other words.
const TICK: f64 = 11.0;
const WORDS: f64 = 13.0;
/// The height of a caption, and the offset of its text from the sample of the line.
const LINE: f64 = 17.0;
const SAMPLE: f64 = 34.0;
/// The space next to the axes for the names of both ends of a curve.
const ENDS: f64 = 60.0;
const GRID: Stroke = Stroke { ink: Ink::opaque(0xe1e1e1), width: 1.0, dash: SOLID };
const FRAME: Stroke = Stroke { ink: style::BLACK, width: 1.0, dash: SOLID };
/// The colours of the first lines, which also differ in greyscale. [`ink`] generates further
/// colours.
const INKS: [u32; 10] = [
    0x111111, 0x0a5fa8, 0xd05a00, 0x1aa67a, 0xa3173f, 0x966ec8, 0x787878, 0xc8a000, 0x56b4e9,
    0x643c14,
];

/// Draws the diagram as a picture. Captions are placed next to the axes, at the heights where their
/// lines end.
///
/// ```
/// use affinor_documents::figures::diagram::{Diagram, Drawn, Graph, Line, Scale};
/// use affinor_documents::picture::{diagram, svg};
/// let line = Line { caption: "x^2".into(), points: vec![[0.0, 0.0], [1.0, 1.0], [2.0, 4.0]], drawn: Drawn::Marked };
/// let (x, y) = (Scale::linear("x"), Scale::linear("y"));
/// let graph = Graph { x, y, equal: false, lines: vec![line] };
/// let picture = diagram(&Diagram { title: "a parabola".into(), graphs: vec![graph] });
/// assert_eq!(svg(&picture, 400).matches("<circle").count(), 3);
/// ```
pub fn diagram(diagram: &Diagram) -> Picture {
    let lines = || diagram.graphs.iter().flat_map(|graph| &graph.lines);
    let captions =
        |graph: &Graph| graph.lines.iter().filter(|line| !line.caption.is_empty()).count();
    let most = diagram.graphs.iter().map(captions).max().unwrap_or(0);
    let height = GRAPH[1].max(LINE * most as f64 + BELOW + 2.0 * MARGIN);
    let widest = lines().map(|line| width(&line.caption, WORDS)).fold(0.0, f64::max);
    let beside = if widest > 0.0 { SAMPLE + widest } else { ENDS };
    let whole = [(GRAPH[0] + beside).round(), height * diagram.graphs.len().max(1) as f64 + TITLE];
    let title = Font::words(17.0, Anchor::Middle);
    let mut shapes =
        vec![Shape::Text { at: [0.5 * whole[0], 24.0], text: diagram.title.clone(), font: title }];
    let axes: Vec<[Axis; 2]> = diagram.graphs.iter().map(axes).collect();
    let ticks = axes.iter().flat_map(|[_, y]| y.ticks(|_| true));
    let widest = ticks.map(|(_, label)| width(&label, TICK)).fold(0.0, f64::max);
    let across = MARGIN + 2.0 * WORDS + widest..GRAPH[0] - MARGIN;
    for (at, (graph, axes)) in diagram.graphs.iter().zip(axes).enumerate() {
        let top = TITLE + height * at as f64 + MARGIN;
        let down = top..top + height - 2.0 * MARGIN - BELOW;
        let frame = Frame::new(axes, [across.clone(), down], graph.equal);
        frame.axes(graph, &mut shapes);
        frame.contents(graph, &mut shapes);
    }
    Picture { title: diagram.title.clone(), width: whole[0], height: whole[1], shapes }
}

/// The colour of a line; all lines have different colours.
fn ink(number: usize) -> Ink {
    if let Some(known) = INKS.get(number) {
        return Ink::opaque(*known);
    }
    // multiples of the golden section give hues that never repeat
    let hue = (0.618_033_988_749_895 * (number - INKS.len()) as f64).fract();
    let lightness = [0.25, 0.37, 0.49][number % 3];
    let part = |offset: f64| {
        let k = (offset + 12.0 * hue) % 12.0;
        let share = lightness - 0.7 * lightness * (k - 3.0).min(9.0 - k).clamp(-1.0, 1.0);
        (255.0 * share).round() as u8
    };
    Ink { rgb: [0.0, 8.0, 4.0].map(part), opacity: 1.0 }
}

/// The axes of a graph, with ranges for all its values.
fn axes(graph: &Graph) -> [Axis; 2] {
    [(&graph.x, 0), (&graph.y, 1)].map(|(scale, k)| {
        let points = graph.lines.iter().flat_map(|line| &line.points);
        Axis::of(scale.logarithmic, points.map(|point| point[k]))
    })
}

/// The axes of a graph, and their position in the picture.
struct Frame {
    axes: [Axis; 2],
    places: [Range<f64>; 2],
}

impl Frame {
    fn new([x, y]: [Axis; 2], places: [Range<f64>; 2], equal: bool) -> Self {
        if !equal {
            return Frame { axes: [x, y], places };
        }
        let [across, down] = places.each_ref().map(|place| place.end - place.start);
        let unit = (x.length() / across).max(y.length() / down);
        Frame { axes: [x.widened(unit * across), y.widened(unit * down)], places }
    }

    /// The point of the picture that has these fractions of both axes.
    fn place(&self, [x, y]: [f64; 2]) -> Point {
        let [across, down] = &self.places;
        [across.start + x * (across.end - across.start), down.end - y * (down.end - down.start)]
    }

    /// Draws the grid, the axes with labelled ticks, and the names of the axes.
    fn axes(&self, graph: &Graph, shapes: &mut Vec<Shape>) {
        let line = |from: Point, to: Point, stroke| Shape::Line { points: vec![from, to], stroke };
        let text = |at: Point, text: &str, font| Shape::Text { at, text: text.into(), font };
        let [left, bottom] = self.place([0.0, 0.0]);
        let [right, top] = self.place([1.0, 1.0]);
        let (mut grid, mut labels) = (vec![], vec![]);
        let beside = |ticks: &[(f64, String)]| {
            let widths = ticks.iter().map(|(_, label)| width(label, TICK) + TICK);
            widths.sum::<f64>() <= right - left
        };
        for (share, label) in self.axes[0].ticks(beside) {
            let [x, _] = self.place([share, 0.0]);
            grid.push(line([x, top], [x, bottom], GRID));
            labels.push(line([x, bottom], [x, bottom + 5.0], FRAME));
            let font = Font::words(TICK, Anchor::Middle);
            labels.push(text([x, bottom + 8.0 + TICK], &label, font));
        }
        for (share, label) in self.axes[1].ticks(|_| true) {
            let [_, y] = self.place([0.0, share]);
            grid.push(line([left, y], [right, y], GRID));
            labels.push(line([left - 5.0, y], [left, y], FRAME));
            let font = Font::words(TICK, Anchor::End);
            labels.push(text([left - 8.0, y + 0.35 * TICK], &label, font));
        }
        shapes.append(&mut grid);
        shapes.push(line([left, top], [left, bottom], FRAME));
        shapes.push(line([left, bottom], [right, bottom], FRAME));
        shapes.append(&mut labels);
        let font = Font::words(WORDS, Anchor::Middle);
        shapes.push(text([0.5 * (left + right), bottom + BELOW - 6.0], &graph.x.label, font));
        if !graph.y.label.is_empty() {
            let at = [MARGIN + 0.5 * WORDS, 0.5 * (top + bottom)];
            shapes.push(text(at, &graph.y.label, Font { turned: true, ..font }));
        }
    }

    /// Draws the lines of a graph, and their captions.
    fn contents(&self, graph: &Graph, shapes: &mut Vec<Shape>) {
        let mut captions = vec![];
        let mut colours = 0..;
        for line in &graph.lines {
            let number = match line.drawn {
                Drawn::Guide => None,
                _ => colours.next(),
            };
            let stroke = stroke(number);
            let points = self.line(line, stroke, shapes);
            let last = points.into_iter().max_by(|a, b| a[0].total_cmp(&b[0]));
            if let Some(last) = last.filter(|_| !line.caption.is_empty()) {
                captions.push((last, stroke, line.caption.clone()));
            }
        }
        self.captions(captions, shapes);
    }

    /// Draws a line. Returns the points of the picture at its finite values.
    fn line(&self, line: &Line, stroke: Stroke, shapes: &mut Vec<Shape>) -> Vec<Point> {
        let before = shapes.len();
        let [x, y] = &self.axes;
        let placed =
            line.points.iter().map(|point| self.place([x.share(point[0]), y.share(point[1])]));
        let points: Vec<Point> = placed.filter(|[x, y]| x.is_finite() && y.is_finite()).collect();
        if line.drawn != Drawn::Points {
            shapes.push(Shape::Line { points: points.clone(), stroke });
        }
        let discs =
            |radius| points.iter().map(move |at| Shape::Disc { at: *at, radius, ink: stroke.ink });
        match line.drawn {
            Drawn::Line | Drawn::Guide => {}
            Drawn::Points => shapes.extend(discs(2.0)),
            Drawn::Marked => shapes.extend(discs(3.0)),
            Drawn::Directed => {
                shapes.extend(heads(&points, stroke.ink));
                shapes.extend(ends(&points, stroke.ink));
                let mut labels = Labels::new(&shapes[before..]);
                for (at, text) in [(points.first(), "start"), (points.last(), "end")] {
                    let Some(at) = at else { continue };
                    shapes.extend(labels.put(text, *at, [0.0, 0.0], style::BLACK));
                }
            }
        }
        points
    }

    /// Draws captions next to the axes, each as near as possible to the end of its line.
    fn captions(&self, mut captions: Vec<(Point, Stroke, String)>, shapes: &mut Vec<Shape>) {
        captions.sort_by(|a, b| a.0[1].total_cmp(&b.0[1]));
        let [across, down] = &self.places;
        let half = 0.5 * LINE;
        let mut heights: Vec<f64> = vec![];
        for (end, ..) in &captions {
            let free = heights.last().map_or(down.start + half, |above| above + LINE);
            heights.push(end[1].max(free));
        }
        // moves captions up that are below the lower end of the axis
        let mut free = down.end - half;
        for height in heights.iter_mut().rev() {
            *height = height.min(free);
            free = *height - LINE;
        }
        for ((end, stroke, caption), y) in captions.into_iter().zip(heights) {
            let (from, to) = (across.end + 8.0, across.end + SAMPLE - 8.0);
            let thin = Stroke { width: 0.7, dash: SOLID, ..stroke };
            // connects a caption with its line only if the line ends at the right edge
            if across.end - end[0] < 0.06 * (across.end - across.start) {
                shapes.push(Shape::Line { points: vec![end, [from, y]], stroke: thin });
            }
            shapes.push(Shape::Line { points: vec![[from, y], [to, y]], stroke });
            let font = Font { ink: stroke.ink, ..Font::words(WORDS, Anchor::Start) };
            let at = [to + 5.0, y + 0.35 * WORDS];
            shapes.push(Shape::Text { at, text: caption, font });
        }
    }
}

/// The stroke of the line with a number; without a number, the stroke of a guide.
fn stroke(number: Option<usize>) -> Stroke {
    match number {
        None => Stroke { ink: style::GREY, width: 1.0, dash: style::DOTTED },
        // in print, dashes distinguish further colours
        Some(number) => Stroke {
            ink: ink(number),
            width: 2.0,
            dash: [SOLID, style::DASHED, style::SHORT][(number / INKS.len()).min(2)],
        },
    }
}
