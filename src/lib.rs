//! affinor.
pub mod algebra;
pub mod connection;
pub mod curvature;
mod error;
pub mod frame;
pub mod geometry;
pub mod metric;
pub mod report;
pub mod roots;
pub mod transport;

pub use algebra::{BasisChange, Bracket, LieAlgebra, MatrixBasis};
pub use connection::{Canonical, Connection};
pub use error::Error;
pub use frame::Frame;
pub use geometry::{ConnectionKind, Geometry};
pub use metric::Metric;
