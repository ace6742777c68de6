//! Spaces, given on the command line and in files, and converted to geometries.
//!
//! A SPACE is a geometry of the paper, a catalogue name, a sum of names, a file, or brackets given inline ([`Space`]).
//! Each becomes a [`Definition`], exact and symbolic, which is then converted to the scalar of the computation
//! ([`Coefficient`](crate::Coefficient)). Files are TOML or JSON with the same keys, or tables of structure constants.
//!
//! In reading order: `definition` is the definition; `read` reads a definition from a file;
//! `tables` detects the notation of structure constants; `document` reads keys, and `notation`
//! expressions; `request` resolves the SPACE of a command.

mod chart;
mod construction;
mod definition;
pub(crate) mod document;
mod entry;
mod functions;
mod group;
mod named;
pub(crate) mod notation;
pub mod paper;
mod plane;
mod point;
mod read;
mod request;
pub(crate) mod setting;
mod tables;

pub use definition::Definition;
use definition::{
    ConnectionChoice, Given, MatrixEntries, MetricChoice, Origin, Pairs, add, check_dimension,
};
pub use point::Point;
pub use request::{Request, ScalarChoice, Space};
