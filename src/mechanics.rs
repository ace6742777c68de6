//! Mechanical systems on Lie groups and their motions, in floats.
//!
//! In reading order:
//!
//! - [`systems`]: equations of motion: [`EulerPoincare`] of a connection, a metric and a torque on any group,
//!   [`LiePoissonSystem`] of a Hamiltonian, [`Constrained`] with holonomic constraints, flows of matrices such as [`Zeitlin`];
//! - [`integrators`]: methods whose steps stay on the group, from [`MuntheKaas`] to [`MoserVeselov`]; [`Adaptive::run`] gives a
//!   [`Trajectory`];
//! - [`events`]: sign changes of functions along a trajectory;
//! - [`bodies`]: [`MassProperties`] of shapes, meshes and points, and the [`FreeBody`], whose
//!   attitude and momentum at any time have a closed form;
//! - [`formula`] and [`simulation`]: systems, forces and columns as formulas, chosen at run time.
//!
//! Attitudes map body to spatial components, `Rdot = R spin(Omega)`. Momentum `H = J Omega` and velocity are in body components,
//! `Hdot = H cross Omega` is (108) without torque, and `R H` is the spatial momentum.

pub mod bodies;
pub mod events;
pub mod formula;
pub mod integrators;
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

/// The error of an integration that stops at time `t`.
fn stopped(t: f64, reason: impl Into<String>) -> Error {
    Error::Integration { t, reason: reason.into() }
}

/// The error for an invalid inertia.
fn invalid_inertia(reason: impl Into<String>) -> Error {
    Error::Invalid { what: "inertia", reason: reason.into() }
}
