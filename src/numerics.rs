//! Numerical methods that do not involve groups. The modules for groups and mechanics use them.
//!
//! - [`exponential`] and `logarithm` of matrices; `double` for double-double arithmetic; `stumpff`
//!   functions of angles;
//! - [`tableaux`] of Runge-Kutta methods, `ode` for initial value problems in R^n;
//! - [`blocks`] for recorded programs on many rows; `lanes` for several floats in one vector
//!   register; `least_squares`; `shooting` for ends of curves; `rounding`, which rejects results without correct digits.

pub mod blocks;
pub(crate) mod derivative;
pub(crate) mod double;
pub mod exponential;
pub(crate) mod lanes;
pub(crate) mod least_squares;
pub(crate) mod logarithm;
pub(crate) mod null_space;
pub(crate) mod ode;
pub(crate) mod radau;
pub(crate) mod rounding;
pub(crate) mod shooting;
pub(crate) mod stumpff;
pub mod tableaux;
