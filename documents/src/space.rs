//! Spaces: given on the command line and in files, and converted to geometries.
//!
//! A SPACE is a geometry of Paraskevopoulos and Natsiavas (2013), a catalogue name, a sum of names,
//! a homogeneous space G/H, a file, or brackets given inline ([`Space`]). Each form becomes a [`Definition`] with exact and
//! symbolic values. A definition is then converted to the scalar type of the computation
//! ([`Coefficient`](crate::Coefficient)). Files are tables of structure constants, or TOML or JSON
//! files, which have the same keys.
//!
//! In reading order: `definition` defines the common form of all spaces, and `read` reads a
//! definition from a file. `tables` detects the notation of structure constants. `document` reads
//! keys, and `notation` reads expressions. `request` finds the space that the SPACE of a command
//! means.

mod catalogue_name;
mod chart;
mod charts;
mod construction;
mod definition;
pub(crate) mod document;
mod entry;
mod form_notation;
pub(crate) mod formulas;
mod functions;
mod group;
#[cfg_attr(not(feature = "homogeneous"), path = "space/homogeneous/absent.rs")]
mod homogeneous;
mod invariant_metric;
mod named;
pub(crate) mod notation;
pub mod paper;
mod plane;
mod point;
mod read;
mod request;
pub(crate) mod setting;
mod spelling;
pub(crate) mod tables;
mod typed;

pub use charts::NamedChart;
pub use definition::Definition;
use definition::{
    ConnectionChoice, Given, MatrixEntries, MetricChoice, Origin, Pairs, add, check_dimension,
};
pub use plane::vectors;
pub use point::Point;
pub use request::{Request, ScalarChoice, Space};
pub use spelling::proper_names;
pub use tables::notations;
pub use typed::{Typed, definition as typed};
