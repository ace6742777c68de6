//! Sparse tensors, contraction with index letters, and exact linear algebra, over any scalar.
//!
//! This package does not contain geometry. In reading order:
//! - [`scalar`]: the traits [`Ring`], [`Field`] and [`Summable`], and their laws. The scalars are
//!   exact [`Rational`]s, `f64`, [`TrackedFloat`]s with an estimate of their rounding error, and
//!   [`Symbolic`] rational functions of parameters. [`Jet`]s are floats with first and second
//!   derivatives, and [`Recorded`] values are programs;
//! - [`expression`]: parsing and evaluation of scalars in written form;
//! - [`Tensor`]: sorted nonzero components with upper and lower slots;
//! - [`contract`]: sums of products that are written with index letters and computed by one kernel;
//! - [`linear`]: rank, nullspace, solutions, inverse and determinant over any field;
//! - [`polynomial`]: systems of polynomial equations, and all their real solutions;
//! - [`text`]: values and linear combinations as text;
//! - [`stop`]: computations that can be stopped from outside.
//!
//! # Features
//! - `parallel` (default): contractions use several threads, by rayon;
//! - `nalgebra`, `ndarray`: tensors are converted to and from dense matrices and arrays;
//! - `num-dual`: `Dual64` is a scalar. `Ratio<i64>` and `BigRational` of num-rational are always
//!   scalars;
//! - `serde`: tensors and scalars are serialized. They are checked when they are read.

pub mod contraction;
#[cfg(any(feature = "nalgebra", feature = "ndarray"))]
mod dense;
mod error;
pub mod expression;
mod function;
mod limits;
pub mod linear;
mod operations;
pub mod polynomial;
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
