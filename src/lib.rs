//! Differential geometry of Lie groups: torsion, curvature and the tensors derived from them. The
//! algebra may be any Lie algebra, over exact, symbolic or floating-point scalars.
//!
//! A Lie algebra is defined by a name, a table of brackets or matrices. With a connection and a
//! metric, it has torsion, curvature, a Ricci tensor and equations of motion. Its groups have
//! exponentials, parallel transport, and integrators that keep the state on the group.
//! [`conventions`] defines the signs and the order of indices, which count from 0.
//!
//! Equation numbers such as (A9), (B14) or (104) in this documentation refer to E. Paraskevopoulos
//! and S. Natsiavas, *Int. J. Solids and Structures* 50 (2013) 57-72. "The paper" means this
//! article.
//!
//! # Geometry
//!
//! The exact curvature of a left-invariant metric with parameters:
//!
//! ```
//! use affinor::algebra::catalogue;
//! use affinor::{Connection, Metric, Symbolic};
//! let so3 = catalogue::algebra::<Symbolic>("so(3)")?;
//! let metric = Metric::diagonal([Symbolic::parameter("a"), "1".parse()?, "1".parse()?])?;
//! let connection = Connection::levi_civita(so3.left_frame(), &metric)?;
//! assert_eq!(connection.ricci().get(&[0, 0]).to_string(), "1/2*a^2");
//! assert!(connection.bianchi_first().is_empty());
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # Algebra
//!
//! Structure theory of a table of brackets, over the rationals:
//!
//! ```
//! use affinor::algebra::structure::StructureTheory;
//! use affinor::{Bracket, LieAlgebra, Rational};
//! // [t, x] = y, [t, y] = -x: the plane with its rotations
//! let constants = [(0, 1, 2, 1), (0, 2, 1, -1)].map(|(j, k, i, c)| (j, k, i, Rational::from(c)));
//! let algebra = LieAlgebra::try_from(Bracket::from_constants(["t", "x", "y"], constants)?)?;
//! let structure = StructureTheory::new(algebra);
//! assert!(structure.is_solvable() && !structure.is_nilpotent() && structure.is_unimodular());
//! # Ok::<(), affinor::Error>(())
//! ```
//!
//! # Mechanics
//!
//! A free rigid body, integrated on the rotation group to a tolerance. Time, length and mass may
//! have any consistent units; angles are in radians:
//!
//! ```
//! use affinor::group::{LieGroup, So3};
//! use affinor::mechanics::{Adaptive, EulerPoincare};
//! use affinor::{CanonicalConnection, Connection, Metric};
//! use nalgebra::{UnitQuaternion, Vector3};
//! let plus = Connection::canonical(&So3.algebra()?, CanonicalConnection::Plus);
//! let inertia = Metric::diagonal([1.0, 2.0, 3.0])?;
//! let torque = |_: f64, _: &UnitQuaternion<f64>, _: &Vector3<f64>| Vector3::zeros();
//! let body = EulerPoincare::new(So3, &plus, &inertia, torque)?;
//! let start = body.state(0.0, UnitQuaternion::identity(), &Vector3::new(0.1, 2.0, 0.1));
//! let end = Adaptive::of_order_8(1e-12).states(&body, &start, &[10.0])?.remove(0);
//! assert!((body.energy(&end) - body.energy(&start)).abs() < 1e-10);
//! # Ok::<(), affinor::Error>(())
//! ```
//!
//! # Modules
//!
//! | module | contents |
//! |---|---|
//! | [`tensors`] | the re-exported package `affinor-tensors`: scalars, sparse tensors, [`contract`], linear algebra |
//! | [`algebra`] | [`Frame`], [`Bracket`], [`LieAlgebra`], the [`catalogue`](algebra::catalogue), [`structure`](algebra::structure) theory, roots |
//! | [`representation`] | irreducible representations of reductive algebras: products, powers, branching rules |
//! | [`geometry`] | [`Connection`], [`Metric`], torsion, curvature, [`Chart`], forms, homogeneous spaces ([`ReductivePair`]), equations of motion |
//! | [`group`] | group elements in `f64`: exponential, logarithm, adjoint, parallel transport, rotations |
//! | [`mechanics`] | rigid bodies, Euler-Poincare and Lie-Poisson systems, integrators, events |
//! | [`numerics`] | matrix exponentials, tableaux of Runge-Kutta methods |
//!
//! Each formula is implemented once, for all scalars: [`Rational`], [`Symbolic`], `f64` and
//! user-defined types ([`Scalar`]). A [`LieAlgebra`] is a [`Frame`] with constant structure that
//! satisfies the Jacobi identity; a [`Connection`] is a frame with affinities (connection
//! coefficients).
//!
//! # Features
//!
//! - `serde`: scalars, tensors, algebras, metrics, connections, geometries and states of motions
//!   implement the traits of serde;
//! - `ndarray`: tensors are converted to and from arrays of `ndarray`;
//! - `num-dual`: dual numbers of `num-dual` are scalars;
//! - `simd`: batches of rotations use the vector instructions of the processor.

pub mod algebra;
pub mod conventions;
mod error;
pub mod geometry;
pub mod group;
pub mod mechanics;
pub mod numerics;
pub mod representation;
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
pub use mechanics::mechanism;
/// The crate whose vectors and matrices represent group elements.
pub use nalgebra;

/// The program in the README, compiled as a doctest.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
