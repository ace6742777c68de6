//! Numerical methods that do not involve groups; the modules for groups and mechanics build on
//! them.
//!
//! - [`exponential`] of matrices, `logarithm` with `double`-double arithmetic, `stumpff` functions
//!   of angles;
//! - [`tableaux`] of Runge-Kutta methods, `ode` for initial value problems in R^n;
//! - [`blocks`], recorded programs on many rows; `lanes`, several floats in one vector register;
//!   `least_squares`, and `rounding`, which rejects results without correct digits.

pub mod blocks;
pub(crate) mod double;
pub mod exponential;
pub(crate) mod lanes;
pub(crate) mod least_squares;
pub(crate) mod logarithm;
pub(crate) mod ode;
pub(crate) mod rounding;
pub(crate) mod stumpff;
pub mod tableaux;
