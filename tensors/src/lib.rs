//! Sparse tensors, contraction by index letters and exact linear algebra, over any scalar.
//!
//! This package does not contain geometry. In reading order:
//! - [`scalar`]: the traits [`Ring`], [`Field`] and [`Summable`], their laws, and the scalars:
//!   exact [`Rational`]s, `f64`, [`TrackedFloat`] floats with a rounding error estimate,
//!   [`Symbolic`] rational functions of parameters, [`Jet`]s, which are floats with first and
//!   second derivatives, and [`Recorded`] values, which are programs;
//! - [`expression`]: parsing and evaluating written scalars;
//! - [`Tensor`]: sorted nonzero components with upper and lower slots;
//! - [`contract`]: sums of products written with index letters, computed by one kernel;
//! - [`linear`]: rank, nullspace, solutions, inverse and determinant over any field;
//! - [`text`]: values and linear combinations as text;
//! - [`stop`]: computations that can be stopped from outside.
//!
//! # Features
//! - `parallel` (default): contractions on several threads, by rayon;
//! - `nalgebra`, `ndarray`: conversions of tensors to and from dense matrices and arrays;
//! - `num-dual`: `Dual64` as a scalar. `Ratio<i64>` and `BigRational` of num-rational are always
//!   scalars;
//! - `serde`: tensors and scalars are serialized, and checked when they are read.

pub mod contraction;
#[cfg(any(feature = "nalgebra", feature = "ndarray"))]
mod dense;
mod error;
pub mod expression;
mod function;
mod limits;
pub mod linear;
mod operations;
pub mod scalar;
#[cfg(feature = "serde")]
mod serial;
pub mod stop;
mod tensor;
pub mod text;
mod threads;

pub use contraction::{Scalar, contract};
pub use error::{NotationError, TensorError};
pub use limits::Limits;
pub use scalar::{
    CommonFactors, Effort, EffortExceeded, Field, Jet, Kind, Notation, Rational, Recorded, Ring,
    Sum, Summable, Symbolic, Tabular, Tolerance, TrackedFloat,
};
pub use tensor::{Components, Down, Indices, Tensor, Up, Variance};
