//! Pictures as SVG.

use super::{Picture, Point, Shape, look};
use std::fmt::Write;
use svg::Document;
use svg::node::element::{Circle, Polygon, Polyline, Rectangle, Text, Title};

/// The picture as SVG, `width` pixels wide. The text stays text, in DejaVu where the viewer has it.
pub fn svg(picture: &Picture, width: u32) -> String {
    let height = (f64::from(width) * picture.height / picture.width).round();
    let document = Document::new()
        .set("viewBox", (0, 0, short(picture.width), short(picture.height)))
        .set("width", width)
        .set("height", height)
        .set("role", "img")
        .add(Title::new(&picture.title))
        .add(Rectangle::new().set("width", "100%").set("height", "100%").set("fill", look::WHITE));
    let document = picture.shapes.iter().fold(document, add);
    format!("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n{document}\n")
}

fn add(document: Document, shape: &Shape) -> Document {
    match shape {
        Shape::Line { points, stroke } => {
            let mut line = Polyline::new()
                .set("points", written(points))
                .set("fill", "none")
                .set("stroke", stroke.ink)
                .set("stroke-width", stroke.width)
                .set("stroke-linejoin", "round");
            if !stroke.dash.is_empty() {
                let dash: Vec<String> = stroke.dash.iter().map(f64::to_string).collect();
                line = line.set("stroke-dasharray", dash.join(" "));
            }
            document.add(line)
        }
        Shape::Area { points, ink } => {
            document.add(Polygon::new().set("points", written(points)).set("fill", *ink))
        }
        Shape::Disc { at, radius, ink } => {
            let circle = Circle::new().set("cx", short(at[0])).set("cy", short(at[1]));
            document.add(circle.set("r", *radius).set("fill", *ink))
        }
        Shape::Text { at, text, font } => {
            let mut node = Text::new(text.as_str())
                .set("x", short(at[0]))
                .set("y", short(at[1]))
                .set("font-size", font.size)
                .set("fill", font.ink);
            if font.symbol {
                node = node
                    .set("font-family", "DejaVu Serif, DejaVu Sans, Georgia, serif")
                    .set("font-style", "italic")
                    .set("stroke", look::WHITE)
                    .set("stroke-width", 3)
                    .set("stroke-linejoin", "round")
                    .set("paint-order", "stroke");
            } else {
                node = node.set("font-family", "DejaVu Sans, Verdana, sans-serif");
            }
            document.add(if font.centered { node.set("text-anchor", "middle") } else { node })
        }
    }
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

/// Hundredths of a pixel are enough.
fn short(x: f64) -> f64 {
    (x * 100.0).round() / 100.0 + 0.0
}
