//! Integrators that stay on the group: steps are exponentials.
//!
//! | method | order | for | keeps |
//! |---|---|---|---|
//! | [`MuntheKaas`] | 4, 5, 8 | any system | momentum |
//! | [`Projected`] | 4, 5, 8 | any system on a group of [stored](crate::group::Stored) numbers | momentum |
//! | [`Adaptive`] | 5, 8 | any system, to a tolerance | momentum |
//! | [`CommutatorFree`] | 4 | any system | momentum |
//! | [`CrouchGrossman`] | 3 | any system | momentum |
//! | [`Magnus`] | 4, 6 | `g' = g A(t)` | |
//! | [`SimoWong`] | 2 | a rigid body, with any torque | momentum; energy if free |
//! | [`Splitting`] | 2, 4 | a free body | momentum, symplectic form |
//! | [`Kick`] | 2, 4, 6 | a body, torques of time and attitude | momentum as the potential allows, symplectic form |
//! | [`MoserVeselov`](super::MoserVeselov) | 2 to 10 | a free body | momentum, energy, symplectic form |
//!
//! Momentum is that in space: to the last bit on groups of rotations, where it is a part of the state, and to rounding on
//! others.

mod adaptive;
mod commutator_free;
mod composed;
mod crouch_grossman;
mod departure;
mod generalised_alpha;
mod isospectral_midpoint;
pub mod kick;
pub mod magnus;
pub mod munthe_kaas;
pub mod projected;
pub mod runge_kutta;
mod simo_wong;
pub mod splitting;
pub mod tableaux;
mod tolerance;

pub use adaptive::{Adaptive, Pair};
pub use commutator_free::CommutatorFree;
pub use composed::Composed;
pub use crouch_grossman::CrouchGrossman;
pub use generalised_alpha::GeneralisedAlpha;
pub use isospectral_midpoint::IsospectralMidpoint;
pub use kick::Kick;
pub use magnus::{Linear, Magnus, Place};
pub use munthe_kaas::MuntheKaas;
pub use projected::Projected;
pub use runge_kutta::RungeKutta;
pub use simo_wong::SimoWong;
pub use splitting::Splitting;

use crate::Error;
use crate::group::Coordinates;

/// Equations of motion.
pub trait System {
    /// What they move.
    type State: Clone;

    /// The time of a state.
    fn time(&self, state: &Self::State) -> f64;
}

/// A one-step method for the systems `S`.
pub trait Integrator<S: System> {
    /// A step of length `h`, forwards or backwards.
    ///
    /// # Errors
    /// [`Error::Integration`] where a value is not finite, or equations of the step have no solution; the state is then
    /// as it was.
    fn step(&self, system: &S, state: &mut S::State, h: f64) -> Result<(), Error>;
}

/// That all components are finite.
#[inline]
fn expect_finite<V: Coordinates>(t: f64, vector: &V) -> Result<(), Error> {
    if vector.is_finite() {
        return Ok(());
    }
    Err(Error::Integration { t, reason: "a value is not finite".into() })
}
