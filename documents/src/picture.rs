//! Pictures: shapes on a plane, written as SVG.
//!
//! A [`Picture`] is a list of [`Shape`]s. [`draw()`] draws a [`Figure`](crate::figures::Figure),
//! [`diagram()`] a [`Diagram`](crate::figures::diagram::Diagram), [`dynkin()`] and [`roots()`]
//! Cartan types, and [`heat()`] a tensor. [`svg()`] writes the picture.

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

pub use diagram::diagram;
pub use draw::draw;
pub use dynkin::dynkin;
pub use heat::heat;
pub use roots::roots;
pub use svg::svg;
pub use view::View;

/// The colour of lines and words.
const BLACK: Ink = Ink::opaque(0x111111);
/// The background colour.
const WHITE: Ink = Ink::opaque(0xffffff);
/// The width of the white edge around symbols.
const EDGE: f64 = 3.0;
/// The dash pattern of a solid line.
const SOLID: &[f64] = &[];

/// Shapes on a plane: `x` points right, `y` down, both in the unit of [`Picture::width`].
#[derive(Clone, Debug, PartialEq)]
pub struct Picture {
    /// Alternative text.
    pub title: String,
    /// The width of the plane.
    pub width: f64,
    /// The height of the plane.
    pub height: f64,
    /// The shapes, from back to front.
    pub shapes: Vec<Shape>,
}

impl Picture {
    /// Whether all points are within the range of floats; other pictures cannot be drawn.
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
        /// Its vertices, in order.
        points: Vec<Point>,
        /// Its stroke.
        stroke: Stroke,
    },
    /// A filled polygon.
    Area {
        /// Its vertices, in order.
        points: Vec<Point>,
        /// Its colour.
        ink: Ink,
    },
    /// A filled disc.
    Disc {
        /// Its centre.
        at: Point,
        /// Its radius.
        radius: f64,
        /// Its colour.
        ink: Ink,
    },
    /// An animated closed polygon, which repeats. Media without animation show the first frame.
    Film {
        /// Its vertices at equal intervals of time.
        frames: Vec<Vec<Point>>,
        /// Whether each frame is visible.
        shown: Vec<bool>,
        /// The fill colour; `None` for no fill.
        fill: Option<Ink>,
        /// Its edge.
        stroke: Stroke,
        /// Its duration in seconds.
        seconds: f64,
    },
    /// A line of text.
    Text {
        /// The anchor, on the baseline.
        at: Point,
        /// The characters.
        text: String,
        /// The font.
        font: Font,
    },
}

/// An estimate of the width of a text.
fn width(text: &str, size: f64) -> f64 {
    0.6 * size * text.chars().count() as f64
}

/// A point of the plane: coordinates to the right and down.
pub type Point = [f64; 2];

/// A colour and its opacity.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ink {
    /// Red, green and blue, each 0 to 255.
    pub rgb: [u8; 3],
    /// From 0, transparent, to 1, opaque.
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
    /// Its colour.
    pub ink: Ink,
    /// Its width.
    pub width: f64,
    /// Alternating lengths of dashes and gaps; empty for a solid line.
    pub dash: &'static [f64],
}

/// The font of a text.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Font {
    /// Its size.
    pub size: f64,
    /// A mathematical symbol is set in italics with serifs, on a white edge; words are upright and without serifs.
    pub symbol: bool,
    /// The part of the text that is placed at its anchor.
    pub anchor: Anchor,
    /// Whether the text runs upwards, rotated anticlockwise by a right angle.
    pub turned: bool,
    /// Its colour.
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
