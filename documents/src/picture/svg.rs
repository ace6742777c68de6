//! Writes pictures as SVG.

use super::{Anchor, EDGE, Ink, Picture, Point, Shape, Stroke, WHITE};

/// Writes the picture as SVG, `width` pixels wide. Text remains text, in the fonts `sans-serif` and
/// `serif` of the viewer.
pub fn svg(picture: &Picture, width: u32) -> String {
    let (right, down) = (short(picture.width), short(picture.height));
    let height = (f64::from(width) * picture.height / picture.width).round().max(1.0);
    let elements: String = picture.shapes.iter().map(element).collect();
    format!(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n\
         <svg xmlns=\"http://www.w3.org/2000/svg\" role=\"img\" width=\"{width}\" height=\"{height}\" \
         viewBox=\"0 0 {right} {down}\" font-family=\"sans-serif\">\n<title>{}</title>\n\
         <rect width=\"100%\" height=\"100%\" fill=\"{}\"/>\n{elements}</svg>\n",
        escaped(&picture.title),
        hex(WHITE)
    )
}

fn element(shape: &Shape) -> String {
    match shape {
        Shape::Line { points, stroke } => {
            let points = written(points);
            format!("<polyline points=\"{points}\" fill=\"none\"{}/>\n", stroked(stroke))
        }
        Shape::Area { points, ink } => {
            format!("<polygon points=\"{}\"{}/>\n", written(points), painted("fill", *ink))
        }
        Shape::Disc { at: [x, y], radius, ink } => {
            let (x, y, fill) = (short(*x), short(*y), painted("fill", *ink));
            format!("<circle cx=\"{x}\" cy=\"{y}\" r=\"{radius}\"{fill}/>\n")
        }
        Shape::Film { frames, shown, fill, stroke, seconds } => {
            let fill = fill.map_or(" fill=\"none\"".into(), |ink| painted("fill", ink));
            let first = frames.first().map(|points| written(points)).unwrap_or_default();
            let visibility = visible(shown.first().is_none_or(|first| *first));
            let frames: Vec<String> = frames.iter().map(|points| written(points)).collect();
            let motion = animated("points", *seconds, "", &frames);
            let appearance = appearance(shown, *seconds);
            format!(
                "<polygon points=\"{first}\" visibility=\"{visibility}\"{fill}{}>\n{motion}{appearance}</polygon>\n",
                stroked(stroke)
            )
        }
        Shape::Text { at: [x, y], text, font } => {
            let (x, y) = (short(*x), short(*y));
            let symbol = if font.symbol {
                let white = hex(WHITE);
                format!(
                    " font-family=\"serif\" font-style=\"italic\" stroke=\"{white}\" stroke-width=\"{EDGE}\" \
                     stroke-linejoin=\"round\" paint-order=\"stroke\""
                )
            } else {
                String::new()
            };
            let anchor = match font.anchor {
                Anchor::Start => "",
                Anchor::Middle => " text-anchor=\"middle\"",
                Anchor::End => " text-anchor=\"end\"",
            };
            let turned = if font.turned {
                format!(" transform=\"rotate(-90 {x} {y})\"")
            } else {
                String::new()
            };
            let (size, fill) = (short(font.size), painted("fill", font.ink));
            format!(
                "<text x=\"{x}\" y=\"{y}\" font-size=\"{size}\"{symbol}{anchor}{turned}{fill}>{}</text>\n",
                escaped(text)
            )
        }
    }
}

/// The animation of an attribute, repeated forever.
fn animated(attribute: &str, seconds: f64, timing: &str, values: &[String]) -> String {
    let values = values.join(";");
    format!(
        "<animate attributeName=\"{attribute}\" dur=\"{seconds}s\" repeatCount=\"indefinite\"{timing} values=\"{values}\"/>\n"
    )
}

/// The animation of the visibility, from the frames at which the polygon appears or disappears. The
/// text is empty if the visibility never changes.
fn appearance(shown: &[bool], seconds: f64) -> String {
    let last = shown.len().saturating_sub(1);
    // ignores the last frame, because a change there would occur at the end of the animation
    let turns: Vec<usize> = (0..last).filter(|k| *k == 0 || shown[*k] != shown[k - 1]).collect();
    if turns.len() < 2 {
        return String::new();
    }
    let times: Vec<String> =
        turns.iter().map(|k| format!("{:.6}", *k as f64 / last as f64)).collect();
    let values: Vec<String> = turns.iter().map(|k| visible(shown[*k]).into()).collect();
    let timing = format!(" calcMode=\"discrete\" keyTimes=\"{}\"", times.join(";"));
    animated("visibility", seconds, &timing, &values)
}

fn visible(shown: bool) -> &'static str {
    if shown { "visible" } else { "hidden" }
}

fn stroked(stroke: &Stroke) -> String {
    let dash: Vec<String> = stroke.dash.iter().map(f64::to_string).collect();
    let dash = match dash.join(" ") {
        none if none.is_empty() => none,
        dash => format!(" stroke-dasharray=\"{dash}\""),
    };
    let ink = painted("stroke", stroke.ink);
    format!("{ink} stroke-width=\"{}\" stroke-linejoin=\"round\"{dash}", stroke.width)
}

/// The attribute `fill` or `stroke` with a colour.
fn painted(attribute: &str, ink: Ink) -> String {
    let color = hex(ink);
    match ink.opacity {
        opacity if opacity < 1.0 => {
            format!(" {attribute}=\"{color}\" {attribute}-opacity=\"{opacity}\"")
        }
        _ => format!(" {attribute}=\"{color}\""),
    }
}

fn hex(ink: Ink) -> String {
    let [red, green, blue] = ink.rgb;
    format!("#{red:02x}{green:02x}{blue:02x}")
}

fn written(points: &[Point]) -> String {
    let pair = |[x, y]: &Point| format!("{},{}", short(*x), short(*y));
    points.iter().map(pair).collect::<Vec<_>>().join(" ")
}

/// Rounds a number to hundredths of the unit of the picture.
fn short(x: f64) -> f64 {
    (x * 100.0).round() / 100.0 + 0.0
}

/// Escapes the text of an element, and removes control characters, which XML does not allow.
fn escaped(text: &str) -> String {
    let mut escaped = String::new();
    for c in text.chars() {
        match c {
            '&' => escaped += "&amp;",
            '<' => escaped += "&lt;",
            '>' => escaped += "&gt;",
            c => escaped.push(if c.is_control() || c == '\u{fffe}' || c == '\u{ffff}' {
                ' '
            } else {
                c
            }),
        }
    }
    escaped
}
