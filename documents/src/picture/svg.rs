//! Pictures as SVG.

use super::{Anchor, EDGE, Ink, Picture, Point, Shape, WHITE};
use std::fmt::Write;
use svg::node::element::{Animate, Circle, Polygon, Polyline, Rectangle, Text, Title};
use svg::{Document, Node};

/// The picture as SVG, `width` pixels wide. Text stays text; the viewer needs the DejaVu fonts for exact widths.
pub fn svg(picture: &Picture, width: u32) -> String {
    let document = Document::new()
        .set("viewBox", (0, 0, short(picture.width), short(picture.height)))
        .set("width", width)
        .set("height", picture.pixel_height(width))
        .set("role", "img")
        .add(Title::new(&picture.title))
        .add(Rectangle::new().set("width", "100%").set("height", "100%").set("fill", hex(WHITE)));
    let document = picture.shapes.iter().fold(document, add);
    format!("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n{document}\n")
}

fn add(document: Document, shape: &Shape) -> Document {
    match shape {
        Shape::Line { points, stroke } => {
            let mut line = Polyline::new()
                .set("points", written(points))
                .set("fill", "none")
                .set("stroke-width", stroke.width)
                .set("stroke-linejoin", "round");
            if !stroke.dash.is_empty() {
                let dash: Vec<String> = stroke.dash.iter().map(f64::to_string).collect();
                line = line.set("stroke-dasharray", dash.join(" "));
            }
            document.add(painted(line, "stroke", stroke.ink))
        }
        Shape::Area { points, ink } => {
            document.add(painted(Polygon::new().set("points", written(points)), "fill", *ink))
        }
        Shape::Disc { at, radius, ink } => {
            let circle = Circle::new().set("cx", short(at[0])).set("cy", short(at[1]));
            document.add(painted(circle.set("r", *radius), "fill", *ink))
        }
        Shape::Film { frames, shown, fill, stroke, seconds } => {
            let first = frames.first().map(|points| written(points)).unwrap_or_default();
            let mut polygon = Polygon::new()
                .set("points", first)
                .set("stroke-width", stroke.width)
                .set("stroke-linejoin", "round")
                .add(
                    animated("points", *seconds)
                        .set("values", joined(frames.iter().map(|points| written(points)))),
                );
            let visibility = |shown: bool| if shown { "visible" } else { "hidden" };
            polygon.assign("visibility", visibility(shown.first().is_none_or(|first| *first)));
            // the frames at which it appears or disappears
            let turns = (0..shown.len()).filter(|k| *k == 0 || shown[*k] != shown[k - 1]);
            let turns: Vec<usize> = turns.collect();
            if turns.len() > 1 {
                let last = (shown.len() - 1) as f64;
                // a change in the last frame would be at the end of the film
                let inside = || turns.iter().filter(|k| (**k as f64) < last);
                let times = inside().map(|k| format!("{:.6}", *k as f64 / last));
                let values = inside().map(|k| visibility(shown[*k]).to_string());
                let node = animated("visibility", *seconds).set("calcMode", "discrete");
                let node = node.set("keyTimes", joined(times)).set("values", joined(values));
                polygon = polygon.add(node);
            }
            match fill {
                Some(ink) => polygon = painted(polygon, "fill", *ink),
                None => polygon.assign("fill", "none"),
            }
            document.add(painted(polygon, "stroke", stroke.ink))
        }
        Shape::Text { at: [x, y], text, font } => {
            let (x, y) = (short(*x), short(*y));
            let mut node = Text::new(text.as_str()).set("x", x).set("y", y);
            node.assign("font-size", short(font.size));
            if font.symbol {
                node = node
                    .set("font-family", "DejaVu Serif, DejaVu Sans, Georgia, serif")
                    .set("font-style", "italic")
                    .set("stroke", hex(WHITE))
                    .set("stroke-width", EDGE)
                    .set("stroke-linejoin", "round")
                    .set("paint-order", "stroke");
            } else {
                node = node.set("font-family", "DejaVu Sans, Verdana, sans-serif");
            }
            match font.anchor {
                Anchor::Start => {}
                Anchor::Middle => node.assign("text-anchor", "middle"),
                Anchor::End => node.assign("text-anchor", "end"),
            }
            if font.turned {
                node.assign("transform", format!("rotate(-90 {x} {y})"));
            }
            document.add(painted(node, "fill", font.ink))
        }
    }
}

/// The animation of an attribute, repeated without end.
fn animated(attribute: &str, seconds: f64) -> Animate {
    Animate::new()
        .set("attributeName", attribute)
        .set("dur", format!("{seconds}s"))
        .set("repeatCount", "indefinite")
}

fn joined(values: impl Iterator<Item = String>) -> String {
    values.collect::<Vec<_>>().join(";")
}

/// The node with its `fill` or `stroke` in a colour.
fn painted<N: Node>(mut node: N, what: &str, ink: Ink) -> N {
    node.assign(what, hex(ink));
    if ink.opacity < 1.0 {
        node.assign(format!("{what}-opacity"), ink.opacity);
    }
    node
}

fn hex(ink: Ink) -> String {
    let [red, green, blue] = ink.rgb;
    format!("#{red:02x}{green:02x}{blue:02x}")
}

fn written(points: &[Point]) -> String {
    let mut text = String::new();
    for point in points {
        let gap = if text.is_empty() { "" } else { " " };
        // writing to a string cannot fail
        let _ = write!(text, "{gap}{},{}", short(point[0]), short(point[1]));
    }
    text
}

/// Rounded to hundredths of the unit of the picture.
fn short(x: f64) -> f64 {
    (x * 100.0).round() / 100.0 + 0.0
}
