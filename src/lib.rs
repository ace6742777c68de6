//! Differential geometry of Lie groups: torsion, curvature and the tensors derived from them, for
//! any Lie algebra, over exact, symbolic and floating-point scalars.
//!
//! Each formula is implemented once, for all scalars and all frames. [`conventions`] fixes signs
//! and index orders. The modules in reading order:
//!
//! - [`tensors`]: the re-exported package `affinor-tensors`, with scalars, sparse tensors,
//!   contraction by index letters and linear algebra. It contains no geometry;
//! - [`algebra`]: frames, brackets, Lie algebras, the catalogue of named algebras;
//! - [`geometry`]: connections, metrics, torsion, curvature, charts, forms, homogeneous spaces;
//! - [`group`]: group elements in `f64`: exp, log, adjoint, parallel transport;
//! - [`numerics`]: matrix exponentials and tableaux, below groups and mechanics;
//! - [`mechanics`]: rigid bodies, Euler-Poincare and Lie-Poisson systems, integrators.
//!
//! Three types represent the geometry. A [`Frame`] has structure functions and derivations. A
//! [`LieAlgebra`] is a frame with constant structure that satisfies the Jacobi identity. A
//! [`Connection`] is a frame with affinities (connection coefficients).
//!
//! ```
//! use affinor::{Bracket, CanonicalConnection, Connection, LieAlgebra, Rational};
//! // the Heisenberg algebra: [x, y] = z
//! let bracket = Bracket::from_fn(["x", "y", "z"], |j, k| match (j, k) {
//!     (0, 1) => vec![(2, Rational::from(1))],
//!     _ => vec![],
//! })?;
//! let heisenberg = LieAlgebra::try_from(bracket)?;
//! let plus = Connection::canonical(&heisenberg, CanonicalConnection::Plus);
//! assert_eq!(plus.torsion(), *heisenberg.structure_constants());
//! assert!(plus.curvature().is_empty());
//! # Ok::<(), affinor::Error>(())
//! ```

pub mod algebra;
pub mod conventions;
mod error;
pub mod geometry;
pub mod group;
pub mod mechanics;
pub mod numerics;
#[cfg(feature = "serde")]
mod serial;

pub use affinor_tensors as tensors;
pub use affinor_tensors::{
    Down, Field, Jet, Notation, Rational, Ring, Scalar, Summable, Symbolic, Tensor, TensorError,
    Tolerance, TrackedFloat, Up, Variance, contract,
};
pub use algebra::frame::Frame;
pub use algebra::lie_poisson::LiePoisson;
pub use algebra::{BasisChange, Bracket, LieAlgebra, MatrixBasis};
pub use error::{Error, Law};
pub use geometry::chart::Chart;
pub use geometry::connection::{CanonicalConnection, Connection};
pub use geometry::forms::Form;
pub use geometry::metric::Metric;
pub use geometry::reductive::ReductivePair;
pub use geometry::{ConnectionKind, FrameOrigin, Geometry};
/// The crate for the vectors and matrices of group elements.
pub use nalgebra;

/// The program of the README, as a doctest.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
