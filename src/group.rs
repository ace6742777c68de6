//! Lie groups in floating point: exponential, logarithm, adjoint action, tangent operators.
//!
//! In reading order:
//! - [`LieGroup`], the trait of every group; [`Embedded`] for embedding coordinates,
//!   [`MatrixNotation`] for matrices in files, [`TranslationSplit`] for the split of rotations and
//!   translations in integrators;
//! - in `groups`, one file for each group: groups in closed form [`Translations`], [`So2`],
//!   [`So3`], [`Se2`], [`Se3`], [`Se23`], [`Sl2`], [`Heisenberg`], [`Homotheties`]; general groups
//!   [`MatrixGroup`], [`Nilpotent`], [`Product`], [`Opposite`] (right-invariant systems);
//! - [`AnyGroup`], a group chosen at run time, and the [`registry`] of all groups by name;
//! - [`rotation`]: quaternions, matrices, Euler angles; [`batch`]: many rotations at once;
//! - [`fields`] and [`velocity`]: invariant vector fields, body and spatial velocity of paths;
//! - [`transport`]: parallel translation and autoparallels of a left-invariant connection;
//! - [`laws`]: checks of the laws of a Lie group, for user-defined groups.
//!
//! A vector is the list of its components in the basis of the algebra. A tangent vector at `g` has
//! components in the left-invariant frame. For a matrix group, the components of `x` at `g`
//! represent the matrix `g x`.

mod any;
pub mod batch;
mod coordinates;
mod embedded;
pub mod fields;
mod groups;
pub mod kak;
pub mod laws;
mod left_frame;
mod lie_group;
mod matrices;
mod mean;
pub mod registry;
mod restored;
pub mod rotation;
mod split;
mod tangent;
pub mod transport;
pub mod velocity;

pub use any::AnyGroup;
pub use coordinates::Coordinates;
pub use embedded::Embedded;
pub use groups::{
    ExtendedPose, Heisenberg, Homotheties, MatrixGroup, Nilpotent, Opposite, Product, Translations,
};
pub use groups::{Se2, Se3, Se23, Sl2, So2, So3};
pub(crate) use left_frame::expect_left_frame;
pub use lie_group::LieGroup;
pub use matrices::{Block, Coordinate, Generator, MatrixNotation, Partial};
pub use restored::{RESTORABLE, restored};
pub use split::TranslationSplit;
pub use velocity::Velocity;
