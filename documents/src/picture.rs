//! Pictures: shapes on a plane, written as SVG.
//!
//! A [`Picture`] is a list of [`Shape`]s. [`draw()`] draws a [`Figure`](crate::figures::Figure),
//! [`diagram()`] draws a [`Diagram`](crate::figures::diagram::Diagram), [`dynkin()`] and
//! [`roots()`] draw Cartan types, [`weights()`] draws a representation, and [`heat()`] draws a
//! tensor. [`svg()`] writes the picture.

mod arrow;
mod axis;
mod diagram;
mod draw;
mod dynkin;
mod film;
mod heat;
mod label;
mod legend;
mod roots;
mod still;
mod style;
mod svg;
mod view;
mod weights;

pub use diagram::diagram;
pub use draw::draw;
pub use dynkin::dynkin;
pub use heat::heat;
pub use roots::roots;
pub use svg::svg;
pub use view::View;
pub use weights::weights;

/// The colour of lines and words.
const BLACK: Ink = Ink::opaque(0x111111);
/// The background colour.
const WHITE: Ink = Ink::opaque(0xffffff);
/// The width of the white edge around symbols.
const EDGE: f64 = 3.0;
/// The dash pattern of a solid line.
const SOLID: &[f64] = &[];

/// Shapes on a plane: `x` points to the right and `y` points down. [`Picture::width`] defines the
/// unit of both.
#[derive(Clone, Debug, PartialEq)]
pub struct Picture {
    /// The title, which is the alternative text of the picture.
    pub title: String,
    /// The width of the plane.
    pub width: f64,
    /// The height of the plane.
    pub height: f64,
    /// The shapes, from back to front.
    pub shapes: Vec<Shape>,
}

impl Picture {
    /// Whether all coordinates are finite floats; other pictures cannot be drawn.
    pub fn is_finite(&self) -> bool {
        let finite = |point: &Point| point.iter().all(|x| x.is_finite());
        self.shapes.iter().all(|shape| match shape {
            Shape::Line { points, .. } | Shape::Area { points, .. } => points.iter().all(finite),
            Shape::Film { frames, .. } => frames.iter().flatten().all(finite),
            Shape::Disc { at, radius, .. } => finite(at) && radius.is_finite(),
            Shape::Text { at, .. } => finite(at),
        })
    }
}

/// One element of a picture.
#[derive(Clone, Debug, PartialEq)]
pub enum Shape {
    /// A polyline.
    Line {
        /// The vertices, in order.
        points: Vec<Point>,
        /// The stroke of the line.
        stroke: Stroke,
    },
    /// A filled polygon.
    Area {
        /// The vertices, in order.
        points: Vec<Point>,
        /// The fill colour.
        ink: Ink,
    },
    /// A filled disc.
    Disc {
        /// The centre of the disc.
        at: Point,
        /// The radius of the disc.
        radius: f64,
        /// The fill colour.
        ink: Ink,
    },
    /// An animated closed polygon, which repeats. A medium without animation shows the first frame.
    Film {
        /// The vertices in each frame; frames are at equal intervals of time.
        frames: Vec<Vec<Point>>,
        /// For each frame, whether the polygon is visible.
        shown: Vec<bool>,
        /// The fill colour; `None` for a polygon without fill.
        fill: Option<Ink>,
        /// The stroke of the edge.
        stroke: Stroke,
        /// The duration of the animation in seconds.
        seconds: f64,
    },
    /// A line of text.
    Text {
        /// The anchor of the text, on its baseline.
        at: Point,
        /// The characters.
        text: String,
        /// The font.
        font: Font,
    },
}

/// Estimates the width of a text.
fn width(text: &str, size: f64) -> f64 {
    0.6 * size * text.chars().count() as f64
}

/// A point of the plane: the coordinate to the right, and the coordinate down.
pub type Point = [f64; 2];

/// A colour and its opacity.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ink {
    /// Red, green and blue, each 0 to 255.
    pub rgb: [u8; 3],
    /// The opacity, from 0 (transparent) to 1 (opaque).
    pub opacity: f64,
}

impl Ink {
    /// The opaque colour `0xRRGGBB`.
    pub const fn opaque(rgb: u32) -> Self {
        let [_, red, green, blue] = rgb.to_be_bytes();
        Ink { rgb: [red, green, blue], opacity: 1.0 }
    }
}

/// The stroke of a line.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stroke {
    /// The colour of the line.
    pub ink: Ink,
    /// The width of the line.
    pub width: f64,
    /// The lengths of dashes and gaps, in turn; empty for a solid line.
    pub dash: &'static [f64],
}

/// The font of a text.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Font {
    /// The size of the font.
    pub size: f64,
    /// Whether the text is a mathematical symbol. A symbol is set in italics with serifs, on a
    /// white edge; words are upright and have no serifs.
    pub symbol: bool,
    /// The part of the text that is placed at its anchor.
    pub anchor: Anchor,
    /// Whether the text runs upwards, rotated anticlockwise by a right angle.
    pub turned: bool,
    /// The colour of the text.
    pub ink: Ink,
}

impl Font {
    /// A font for black words.
    pub const fn words(size: f64, anchor: Anchor) -> Self {
        Font { size, symbol: false, anchor, turned: false, ink: BLACK }
    }

    /// A font for a symbol that is anchored at its middle.
    pub const fn symbol(size: f64, ink: Ink) -> Self {
        Font { size, symbol: true, anchor: Anchor::Middle, turned: false, ink }
    }
}

/// The part of a text that is placed at its anchor.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Anchor {
    /// The first character.
    Start,
    /// The middle.
    Middle,
    /// The last character.
    End,
}
