//! Differential geometry of Lie groups, from a bracket table: torsion, curvature and what follows
//! from them, by one implementation of each formula over exact, symbolic and floating scalars.
//!
//! Three types carry everything. A [`Frame`] is structure functions and derivations; a
//! [`LieAlgebra`] is one with constant structure whose Jacobi identity was checked. A
//! [`Connection`] is a frame and its affinities, and torsion, curvature and covariant derivatives
//! are functions of it. They return [`Tensor`](affinor_tensors::Tensor)s of the package
//! `affinor-tensors`, which knows no geometry. Signs and orders of indices are in [`conventions`].
//!
//! - [`frame`], [`algebra`], [`connection`], [`metric`], [`curvature`], [`transport`]: the
//!   geometry, from the bottom up; [`forms`] and [`lie_derivative`] on any frame;
//! - [`reductive`]: homogeneous spaces; [`invariants`]: tensors, connections among them, that an
//!   algebra leaves alone; [`lie_poisson`]: the dual of an algebra, its bracket and Casimirs;
//! - [`holonomy`], [`properties`]: what a connection or a metric is like, with proof;
//! - [`chart`]: coordinates, and frames of functions over them;
//! - [`group`]: group elements in floats: exp, log, translations, tangent operators;
//!   [`transport`]: what connections carry along its curves; [`any_group`]: chosen at run time;
//! - [`dynamics`]: motions of the free rigid body, exact and by steps, and of Euler-Poincare systems;
//!   [`simulation`]: chosen at run time, with forces by [`formula`];
//! - [`Geometry`]: an algebra or a frame, a connection and a metric; [`paper`] has two of them;
//! - [`catalogue`]: algebras by name; [`roots`]: root systems and Chevalley bases;
//! - [`definition`]: what a person writes, on the command line or in a file;
//! - [`figures`]: scenes of the rotation group, as numbers; `plot` (a feature, on by default) draws them;
//! - [`report`]: tables, comparisons, and their formats; [`claims`] and [`certificate`]: what holds.
//!
//! ```
//! use affinor::{Bracket, Canonical, Connection, LieAlgebra};
//! use affinor_tensors::Rational;
//! // the Heisenberg algebra: [x, y] = z
//! let bracket = Bracket::from_fn(&["x", "y", "z"], |j, k| match (j, k) {
//!     (0, 1) => vec![(2, Rational::from(1))],
//!     _ => vec![],
//! })?;
//! let heisenberg = LieAlgebra::try_from(bracket)?;
//! let plus = Connection::canonical(&heisenberg, Canonical::Plus);
//! assert_eq!(plus.torsion(), *heisenberg.structure());
//! assert!(plus.curvature().is_empty());
//! # Ok::<(), affinor::Error>(())
//! ```

pub mod algebra;
pub mod any_group;
pub mod catalogue;
pub mod certificate;
pub mod chart;
pub mod claims;
pub mod connection;
pub mod conventions;
pub mod convergence;
pub mod curvature;
pub mod definition;
pub mod dense;
pub mod dynamics;
pub mod equations;
mod error;
pub mod figures;
pub mod forms;
pub mod formula;
pub mod frame;
pub mod geometry;
pub mod group;
pub mod holonomy;
pub mod invariants;
pub mod lie_derivative;
pub mod lie_poisson;
pub mod metric;
pub mod ode;
pub mod paper;
#[cfg(feature = "plot")]
pub mod plot;
pub mod properties;
pub mod reductive;
pub mod report;
pub mod roots;
pub mod run;
pub mod simulation;
pub mod transport;

pub use algebra::{BasisChange, Bracket, LieAlgebra, MatrixBasis};
pub use chart::Chart;
pub use connection::{Canonical, Connection};
pub use error::Error;
pub use forms::Form;
pub use frame::Frame;
pub use geometry::{ConnectionKind, Geometry, Ground};
pub use lie_poisson::LiePoisson;
pub use metric::Metric;
pub use reductive::ReductivePair;

/// The program of the README, as a doctest.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
