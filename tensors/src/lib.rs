//! Sparse tensors, contraction by index letters and exact linear algebra, over any scalar.
//!
//! This package knows no geometry. It holds
//! - [`scalar`]: the traits [`Ring`] and [`Field`], their laws, and the scalars: exact
//!   [`Rational`]s, `f64`, [`Tracked`] floats that know their rounding, [`Symbolic`] rational
//!   functions of parameters, and [`Jet`]s, floats with derivatives;
//! - [`expression`]: the written form of scalars;
//! - [`Tensor`]: sorted nonzero components with upper and lower slots;
//! - [`contract`]: signed sums of products written by index letters, through one kernel;
//! - [`linear`]: rank, nullspace, solutions, inverse, determinant over any field.

pub mod contraction;
mod error;
pub mod expression;
pub mod linear;
mod operations;
pub mod scalar;
mod tensor;

pub use contraction::contract;
pub use error::TensorError;
pub use scalar::{Field, Jet, Kind, Notation, Rational, Ring, Sum, Symbolic, Tolerance, Tracked};
pub use tensor::{Down, Indices, Tensor, Up, Variance};
