//! Pictures: figures drawn on a plane, and written as SVG or PNG.
//!
//! A [`Picture`] is a list of [`Shape`]s. [`draw`] makes one of a [`Figure`](crate::figures::Figure); a backend
//! is a function of a picture, [`svg()`] and [`png()`] so far.

mod diagram;
mod draw;
mod label;
mod legend;
mod look;
mod raster;
mod vector;
mod view;

pub use diagram::diagram;
pub use draw::draw;
pub use raster::{MAX_WIDTH, PictureError, png, rendered};
pub use vector::svg;
pub use view::View;

/// Shapes on a plane, `x` to the right and `y` down, the later ones on top.
#[derive(Clone, Debug, PartialEq)]
pub struct Picture {
    /// For who cannot see it.
    pub title: String,
    /// To the right end.
    pub width: f64,
    /// To the lower end.
    pub height: f64,
    /// From behind to the front.
    pub shapes: Vec<Shape>,
}

/// What a picture is made of.
#[derive(Clone, Debug, PartialEq)]
pub enum Shape {
    /// A line through points.
    Line {
        /// One behind the other.
        points: Vec<Point>,
        /// How it is drawn.
        stroke: Stroke,
    },
    /// A filled polygon.
    Area {
        /// Its corners.
        points: Vec<Point>,
        /// Its colour.
        ink: &'static str,
    },
    /// A filled disc.
    Disc {
        /// Its centre.
        at: Point,
        /// Its radius.
        radius: f64,
        /// Its colour.
        ink: &'static str,
    },
    /// A line of text.
    Text {
        /// Its anchor, on the base line.
        at: Point,
        /// What it says.
        text: String,
        /// How it is set.
        font: Font,
    },
}

/// Right and down.
pub type Point = [f64; 2];

/// How a line is drawn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stroke {
    /// Its colour.
    pub ink: &'static str,
    /// How thick it is.
    pub width: f64,
    /// Lengths of dashes and gaps; none for a solid line.
    pub dash: &'static [f64],
}

/// How text is set.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Font {
    /// Its size.
    pub size: f64,
    /// Mathematics is italic with serifs, on a bright edge; words are upright without.
    pub symbol: bool,
    /// Whether the anchor is its middle, or else its left end.
    pub centered: bool,
    /// Its colour.
    pub ink: &'static str,
}
