//! Pictures: figures and diagrams drawn as shapes on a plane, and written as SVG or PNG.
//!
//! A [`Picture`] is a list of [`Shape`]s. [`draw`] makes one of a [`Figure`](crate::figures::Figure), [`diagram`]
//! of a [`Diagram`](crate::figures::diagram::Diagram), [`dynkin()`] of Cartan types. [`svg()`] and `png` (feature `png`) write it.

mod arrow;
mod backend;
mod diagram;
mod draw;
mod film;
mod label;
mod legend;
#[cfg(feature = "png")]
mod raster;
mod style;
mod view;

pub use affinor_documents::picture::{
    Anchor, Font, Ink, Picture, Point, Shape, Stroke, dynkin, svg,
};
pub use diagram::diagram;
pub use draw::draw;
#[cfg(feature = "png")]
pub use raster::{PictureError, png};
pub use view::View;

/// The largest width of a picture, in pixels.
pub const MAX_WIDTH: u32 = 8000;
