//! Methods of order 4, composed of symmetric methods of order 2.

use super::Integrator;
use crate::Error;
use crate::mechanics::systems::System;

/// Five steps of a symmetric method of order 2. The step sizes are `p h`, `p h`, `(1 - 4 p) h`,
/// `p h`, `p h` with `p = 1/(4 - 4^(1/3))`. Together they form a symmetric method of order 4, which
/// has the same conserved quantities.
///
/// M. Suzuki, *Phys. Lett. A* 146 (1990) 319-323.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Composed<I>(
    /// The method of order 2.
    pub I,
);

impl<I> Composed<I> {
    /// The order of convergence.
    pub fn order(&self) -> u32 {
        4
    }
}

/// The fractions of the step for the five steps.
fn fractions() -> [f64; 5] {
    let outer = 1.0 / (4.0 - 4.0_f64.cbrt());
    [outer, outer, 1.0 - 4.0 * outer, outer, outer]
}

impl<S: System, I: Integrator<S>> Integrator<S> for Composed<I> {
    fn step(&self, system: &S, state: &mut S::State, h: f64) -> Result<(), Error> {
        let mut next = state.clone();
        for share in fractions() {
            self.0.step(system, &mut next, share * h)?;
        }
        *state = next;
        Ok(())
    }
}
