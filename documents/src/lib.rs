//! Documents of [`affinor`]: files and names that describe spaces and motions, and reports about
//! them.
//!
//! In reading order:
//! - [`input`]: texts with source locations, errors, numbers; [`space`]: spaces, on the command
//!   line and in TOML or JSON files;
//! - [`problem`]: problems of motion in such files, and the motions that they define;
//! - `mechanism`: bodies and joints in such files;
//! - [`certificate`]: checks of a definition, with a witness for each failed check;
//! - [`report`]: tables of tensors, comparisons and equations in every format;
//! - [`formula`]: formulas as trees, written as text, LaTeX and MathML; [`page`]: pages of HTML;
//! - [`figures`]: figures of trajectories and of Paraskevopoulos and Natsiavas (2013), with
//!   rotations as points of a ball;
//! - [`picture`]: shapes on a plane as SVG, and drawings of figures, diagrams, tensors and roots;
//! - [`rows`]: the rows of trajectories as CSV, JSON and, with the feature `parquet`, Parquet;
//! - [`budget`]: limits on the time and the memory of a computation.
//!
//! The program `affinor` is built on this package. Numbers of equations, such as (38), refer to
//! Paraskevopoulos and Natsiavas (2013).

pub mod budget;
pub mod certificate;
mod coefficient;
pub mod figures;
pub mod formula;
pub mod input;
#[cfg(feature = "mechanisms")]
pub mod mechanism;
pub mod page;
pub mod picture;
pub mod problem;
pub mod report;
pub mod rows;
pub mod space;

pub use coefficient::Coefficient;

/// The scalar types that the macro [`over_kind`] names.
#[doc(hidden)]
pub mod scalars {
    pub use affinor::tensors::{Kind, Rational, Symbolic, TrackedFloat};
}
