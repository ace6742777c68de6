//! Numerical integrators whose steps stay on the group.
//!
//! | method | order | systems | conserved |
//! |---|---|---|---|
//! | [`MuntheKaas`] | 4, 5, 8 | any system | momentum |
//! | [`Projected`] | 4, 5, 8 | any system on an [embedded](crate::group::Embedded) group | momentum |
//! | [`Adaptive`] | 5, 8 | any system, to a tolerance | momentum |
//! | [`ChartSteps`] | 8 | a curve on a chart, to a tolerance | |
//! | [`TreeSteps`] | 8, or 5 for stiff forces | a tree of bodies, to a tolerance | |
//! | [`CommutatorFree`] | 4 | any system | momentum |
//! | [`Magnus`] | 4, 6 | `g' = g A(t)` | |
//! | [`SimoWong`] | 2 | a rigid body, with any torque | momentum; energy if free |
//! | [`Kick`] | 2, 4, 6 | a body, torques of time and attitude | momentum of symmetries, symplectic form |
//! | [`MoserVeselov`] | 2 to 10 | a free body | momentum, energy, symplectic form |
//!
//! Momentum in this table means the spatial momentum. It is conserved exactly on groups of
//! rotations, where it is a part of the state, and up to rounding errors on other groups. In
//! reading order: [`runge_kutta`] with its [`tableaux`](crate::numerics::tableaux), [`munthe_kaas`]
//! and [`projected`] are the methods for any system. [`dense_output`] computes states within steps,
//! and a [`Trajectory`] contains the states of a whole run with events. [`GeneralisedAlpha`] is for
//! constraints, [`IsospectralMidpoint`] is for flows of matrices, and [`Composed`] raises the order
//! of a method.

mod adaptive;
mod chart_steps;
mod commutator_free;
mod compensated;
mod composed;
pub mod dense_output;
mod generalised_alpha;
mod isospectral_midpoint;
pub mod kick;
pub mod magnus;
pub mod moser_veselov;
pub mod munthe_kaas;
mod principal;
pub mod projected;
pub mod runge_kutta;
mod simo_wong;
mod step_start;
mod tolerance;
mod trajectory;
mod tree_steps;

pub use adaptive::{Adaptive, Pair};
pub use chart_steps::ChartSteps;
pub use commutator_free::CommutatorFree;
pub use composed::Composed;
pub use generalised_alpha::GeneralisedAlpha;
pub use isospectral_midpoint::IsospectralMidpoint;
pub use kick::Kick;
pub use magnus::{KinematicState, Magnus, PrescribedVelocity};
pub use moser_veselov::MoserVeselov;
pub use munthe_kaas::MuntheKaas;
pub use projected::Projected;
pub use runge_kutta::RungeKutta;
pub use simo_wong::SimoWong;
pub use trajectory::Trajectory;
pub use tree_steps::{TreeScheme, TreeSteps};

use crate::Error;
use crate::group::Coordinates;
use crate::mechanics::stopped;
use crate::mechanics::systems::System;

/// A one-step method for the systems `S`.
pub trait Integrator<S: System> {
    /// Advances the state by a step of length `h`. The length is negative backwards in time.
    ///
    /// # Errors
    /// [`Error::Integration`] if a value is not finite, or if implicit equations have no solution.
    /// In this case, the state is unchanged.
    fn step(&self, system: &S, state: &mut S::State, h: f64) -> Result<(), Error>;
}

/// Checks that all components are finite.
#[inline]
fn expect_finite<V: Coordinates>(t: f64, vector: &V) -> Result<(), Error> {
    if vector.is_finite() {
        return Ok(());
    }
    Err(stopped(t, "a value is not finite"))
}
