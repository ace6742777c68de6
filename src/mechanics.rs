//! Mechanical systems on Lie groups and their trajectories, in floats.
//!
//! In reading order:
//!
//! - [`systems`]: equations of motion. [`EulerPoincare`] has a connection, a metric and a torque on
//!   any group, [`LiePoissonSystem`] has a Hamiltonian, and [`Constrained`] has holonomic
//!   constraints. Flows of matrices are for example [`Zeitlin`]; [`systems::chart`] has curves on
//!   charts, and [`systems::homogeneous`] curves on homogeneous spaces;
//! - [`integrators`]: methods whose steps stay on the group, from [`MuntheKaas`] to
//!   [`MoserVeselov`]; [`Adaptive::run`] computes a [`Trajectory`];
//! - [`geodesics`]: geodesics between two points;
//! - [`mechanism`]: bodies and joints, with an exact account of mobility;
//! - [`events`]: sign changes of functions along a trajectory;
//! - [`formula`] and [`simulation`]: systems, forces and columns that are given as formulas and
//!   chosen at run time.
//! - [`formula`] and [`simulation`]: systems, forces and columns as formulas, chosen at run time.
//!
//! Attitudes map body to spatial components, `Rdot = R spin(Omega)`. The momentum `H = J Omega` and
//! the velocity are in body components. Without a torque, equation (108) is `Hdot = H cross Omega`.
//! The spatial momentum is `R H`.

pub mod bodies;
pub mod events;
pub mod formula;
pub mod geodesics;
pub mod integrators;
pub mod mechanism;
pub mod simulation;

pub mod systems;

pub use bodies::{BodyState, FreeBody, Inertia, MassProperties, Mesh};
pub use integrators::{Adaptive, CommutatorFree, Composed, GeneralisedAlpha};
pub use integrators::{
    Integrator, IsospectralMidpoint, Kick, Magnus, MoserVeselov, PrescribedVelocity,
};
pub use integrators::{KinematicState, MuntheKaas, Projected, SimoWong, Trajectory};
pub use systems::Zeitlin;
pub use systems::{Constrained, ConstrainedState, Constraint, CotangentSystem, EulerPoincare};
pub use systems::{Isospectral, LiePoissonSystem, Manakov, MatrixState, State, System, Toda};

use crate::Error;

/// The error if an integration stops at the time `t`.
fn stopped(t: f64, reason: impl Into<String>) -> Error {
    Error::Integration { t, reason: reason.into() }
}

/// The error for an invalid inertia.
fn invalid_inertia(reason: impl Into<String>) -> Error {
    Error::Invalid { what: "inertia", reason: reason.into() }
}
