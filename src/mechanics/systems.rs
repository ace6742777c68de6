//! Equations of motion on groups, and of matrices.
//!
//! In reading order, [`cotangent`] is the common interface of systems of an element and its
//! momentum. [`euler_poincare`] contains the systems of a connection and a metric, and
//! [`lie_poisson`] contains the systems of a Hamiltonian. [`constrained`] adds constraints
//! on the element and the velocity, and [`reduced`] is the same system without multipliers. [`isospectral`] contains flows of matrices that conserve the spectrum. [`chart`]
//! contains curves on charts: autoparallels, with potentials and charges. [`homogeneous`] contains
//! autoparallels on homogeneous spaces. [`tree`] contains motions of bodies in joint coordinates.

mod bilinear;
mod centred;
pub mod chart;
pub mod constrained;
pub(in crate::mechanics) mod constraint;
pub mod cotangent;
pub mod euler_poincare;
pub mod homogeneous;
pub mod isospectral;
pub mod lie_poisson;
mod matrix;
pub mod reduced;
pub(in crate::mechanics) mod saddle;
pub mod tree;

pub use constrained::{Constrained, ConstrainedState};
pub use constraint::Constraint;
pub use cotangent::{CotangentSystem, State};
pub use euler_poincare::EulerPoincare;
pub use homogeneous::HomogeneousSystem;
pub use isospectral::{Isospectral, Manakov, MatrixState, Toda, Zeitlin};
pub use lie_poisson::LiePoissonSystem;
pub use tree::{TreeState, TreeSystem};

/// Equations of motion, in first order.
pub trait System {
    /// The type of the state at a time.
    type State: Clone;

    /// The time of a state.
    fn time(&self, state: &Self::State) -> f64;
}
