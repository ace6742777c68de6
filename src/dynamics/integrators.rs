//! Integrators that stay on the group: steps are exponentials.

mod adaptive;
mod commutator_free;
mod composed;
mod generalised_alpha;
mod isospectral_midpoint;
mod munthe_kaas;

pub use adaptive::Adaptive;
pub use commutator_free::CommutatorFree;
pub use composed::Composed;
pub use generalised_alpha::GeneralisedAlpha;
pub use isospectral_midpoint::IsospectralMidpoint;
pub use munthe_kaas::MuntheKaas;

use crate::Error;

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
