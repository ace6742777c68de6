//! Pictures as PNG, rasterised with the letters of the DejaVu fonts.

use super::{Anchor, Font, Ink, MAX_WIDTH, Picture, Point, Shape, style};
use std::error::Error;
use tiny_skia::{
    Color, FillRule, LineJoin, Paint, Path, PathBuilder, Pixmap, Stroke, StrokeDash, Transform,
};
use ttf_parser::{Face, GlyphId, OutlineBuilder};

/// Why a picture cannot be written as PNG.
#[derive(Debug, thiserror::Error)]
pub enum PictureError {
    /// The width is 0 or too large.
    #[error("a picture is 1 to {MAX_WIDTH} pixels wide, not {width}")]
    Width {
        /// The width in pixels.
        width: u32,
    },
    /// There are too many pixels.
    #[error("a picture of {width} x {height} pixels is too large")]
    Size {
        /// The width in pixels.
        width: u32,
        /// The height in pixels.
        height: u32,
    },
    /// The pixels cannot be encoded.
    #[error("the picture cannot be encoded as PNG")]
    Encoding(#[source] Box<dyn Error + Send + Sync>),
}

/// The picture as PNG, `width` pixels wide, on a white background.
///
/// # Errors
/// [`PictureError::Width`] for a width of 0 or above [`MAX_WIDTH`].
pub fn png(picture: &Picture, width: u32) -> Result<Vec<u8>, PictureError> {
    if !(1..=MAX_WIDTH).contains(&width) {
        return Err(PictureError::Width { width });
    }
    let height = picture.pixel_height(width);
    let pixels = Pixmap::new(width, height).ok_or(PictureError::Size { width, height })?;
    let scale = (f64::from(width) / picture.width) as f32;
    let [sans, serif] = [dejavu::sans::regular(), dejavu::serif::italic()]
        .map(|font| Face::parse(font, 0).expect("the fonts are part of the program"));
    let mut canvas = Canvas { pixels, scale: Transform::from_scale(scale, scale), sans, serif };
    canvas.pixels.fill(Color::WHITE);
    picture.shapes.iter().for_each(|shape| canvas.shape(shape));
    canvas.pixels.encode_png().map_err(|error| PictureError::Encoding(Box::new(error)))
}

struct Canvas {
    pixels: Pixmap,
    /// From the plane of the picture to pixels.
    scale: Transform,
    sans: Face<'static>,
    serif: Face<'static>,
}

impl Canvas {
    fn shape(&mut self, shape: &Shape) {
        match shape {
            Shape::Line { points, stroke } => {
                let dash = stroke.dash.iter().map(|length| *length as f32).collect();
                let pen = Stroke { dash: StrokeDash::new(dash, 0.0), ..pen(stroke.width) };
                self.stroke(polyline(points, false), &pen, stroke.ink, self.scale);
            }
            Shape::Area { points, ink } => self.fill(polyline(points, true), *ink, self.scale),
            Shape::Disc { at: [x, y], radius, ink } => {
                let disc = PathBuilder::from_circle(*x as f32, *y as f32, *radius as f32);
                self.fill(disc, *ink, self.scale);
            }
            Shape::Film { frames, shown, fill, stroke, .. } => {
                if let (Some(points), Some(true)) = (frames.first(), shown.first()) {
                    if let Some(ink) = fill {
                        self.fill(polyline(points, true), *ink, self.scale);
                    }
                    let edge = polyline(points, true);
                    self.stroke(edge, &pen(stroke.width), stroke.ink, self.scale);
                }
            }
            Shape::Text { at, text, font } => self.text(*at, text, font),
        }
    }

    fn text(&mut self, [x, y]: Point, text: &str, font: &Font) {
        let faces = if font.symbol { [&self.serif, &self.sans] } else { [&self.sans, &self.serif] };
        let mut letters = Letters { path: PathBuilder::new(), x: 0.0, unit: 0.0 };
        for letter in text.chars() {
            let found = faces.iter().find_map(|face| Some((*face, face.glyph_index(letter)?)));
            // glyph 0 stands for a missing one
            let (face, glyph) = found.unwrap_or((faces[0], GlyphId(0)));
            letters.unit = font.size as f32 / f32::from(face.units_per_em());
            face.outline_glyph(glyph, &mut letters);
            letters.x += letters.unit * f32::from(face.glyph_hor_advance(glyph).unwrap_or(0));
        }
        let start = match font.anchor {
            Anchor::Start => 0.0,
            Anchor::Middle => -0.5 * letters.x,
            Anchor::End => -letters.x,
        };
        let place = self.scale.pre_translate(x as f32, y as f32);
        let place = if font.turned { place.pre_rotate(-90.0) } else { place };
        let place = place.pre_translate(start, 0.0);
        let path = letters.path.finish();
        if font.symbol {
            self.stroke(path.clone(), &pen(style::EDGE), style::WHITE, place);
        }
        self.fill(path, font.ink, place);
    }

    /// A path without area, or beyond the numbers of the rasteriser, is none.
    fn fill(&mut self, path: Option<Path>, ink: Ink, place: Transform) {
        if let Some(path) = path {
            self.pixels.fill_path(&path, &paint(ink), FillRule::Winding, place, None);
        }
    }

    fn stroke(&mut self, path: Option<Path>, pen: &Stroke, ink: Ink, place: Transform) {
        if let Some(path) = path {
            self.pixels.stroke_path(&path, &paint(ink), pen, place, None);
        }
    }
}

fn paint(ink: Ink) -> Paint<'static> {
    let [red, green, blue] = ink.rgb;
    let mut paint = Paint::default();
    paint.set_color_rgba8(red, green, blue, (255.0 * ink.opacity).round() as u8);
    paint
}

fn pen(width: f64) -> Stroke {
    Stroke { width: width as f32, line_join: LineJoin::Round, ..Stroke::default() }
}

fn polyline(points: &[Point], closed: bool) -> Option<Path> {
    let mut path = PathBuilder::new();
    for (at, [x, y]) in points.iter().enumerate() {
        let (x, y) = (*x as f32, *y as f32);
        if at == 0 { path.move_to(x, y) } else { path.line_to(x, y) }
    }
    if closed {
        path.close();
    }
    path.finish()
}

/// The outlines of glyphs, the next one at `x`; `unit` is the size of a unit of its font.
struct Letters {
    path: PathBuilder,
    x: f32,
    unit: f32,
}

impl Letters {
    fn at(&self, x: f32, y: f32) -> (f32, f32) {
        (self.x + self.unit * x, -self.unit * y)
    }
}

impl OutlineBuilder for Letters {
    fn move_to(&mut self, x: f32, y: f32) {
        let (x, y) = self.at(x, y);
        self.path.move_to(x, y);
    }

    fn line_to(&mut self, x: f32, y: f32) {
        let (x, y) = self.at(x, y);
        self.path.line_to(x, y);
    }

    fn quad_to(&mut self, x1: f32, y1: f32, x: f32, y: f32) {
        let ((x1, y1), (x, y)) = (self.at(x1, y1), self.at(x, y));
        self.path.quad_to(x1, y1, x, y);
    }

    fn curve_to(&mut self, x1: f32, y1: f32, x2: f32, y2: f32, x: f32, y: f32) {
        let ((x1, y1), (x2, y2), (x, y)) = (self.at(x1, y1), self.at(x2, y2), self.at(x, y));
        self.path.cubic_to(x1, y1, x2, y2, x, y);
    }

    fn close(&mut self) {
        self.path.close();
    }
}
