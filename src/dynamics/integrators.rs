//! Integrators that stay on the group: steps are exponentials.

mod adaptive;
mod commutator_free;
mod munthe_kaas;

pub use adaptive::Adaptive;
pub use commutator_free::CommutatorFree;
pub use munthe_kaas::MuntheKaas;

use super::euler_poincare::{EulerPoincare, State, Torque};
use crate::Error;
use crate::group::LieGroup;

/// A one-step method.
pub trait Integrator {
    /// The order of the error of a motion.
    fn order(&self) -> u32;

    /// A step of length `h`, forwards or backwards.
    ///
    /// # Errors
    /// [`Error::Integration`] where a value is not finite; the state is then as it was.
    fn step<G: LieGroup, M: Torque<G>>(
        &self,
        system: &EulerPoincare<G, M>,
        state: &mut State<G>,
        h: f64,
    ) -> Result<(), Error>;
}
