//! The layer that reads the text of all documents: sources and locations, errors, TOML, JSON, CSV,
//! numbers and meshes.
//!
//! In reading order: `source` and `error` define locations and errors; `file` reads texts; `keys`
//! parses TOML, and `json` parses JSON. `forms` defines the forms in which values are written.
//! `numbers` reads floats, `rows` reads tables of floats, `mesh` reads bodies, and `urdf` reads robots.

pub(crate) mod error;
pub(crate) mod file;
mod files;
pub(crate) mod forms;
mod json;
mod keys;
mod literal;
mod mesh;
pub(crate) mod numbers;
mod rows;
mod source;
#[cfg(feature = "mechanisms")]
pub(crate) mod urdf;

pub(crate) use error::shown;
pub use error::{InputError, Refusal};
pub use file::fingerprint;
pub use files::Files;
pub(crate) use keys::{known_keys, parse_keys};
pub use mesh::{mesh, read_mesh};
pub use numbers::numbers;
pub(crate) use rows::read_columns;
pub use rows::read_rows;
pub use source::{Place, Source};
