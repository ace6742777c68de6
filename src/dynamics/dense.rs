//! States within a step.

use super::{Integrator, System};
use crate::Error;

/// A step that was made, and the state at any time within it: a shorter step from the same start.
///
/// So the states within are as good as those at the end, of the order of the method, and keep what it keeps; there is
/// no interpolant of a lower order. A state costs one step.
///
/// ```
/// use affinor::dynamics::dense::Step;
/// use affinor::dynamics::{Integrator, Linear, Magnus, Place};
/// use affinor::group::{LieGroup, So3};
/// use nalgebra::Vector3;
/// let wheel = Linear { group: So3, velocity: |t: f64| Vector3::z() * t };
/// let start = Place { time: 0.0, element: So3.identity() };
/// let step = Step { system: &wheel, method: &Magnus::Four, start, length: 0.5 };
/// let turn = So3.log(&step.at(0.2)?.element)?;
/// assert!((turn.z - 0.02).abs() < 1e-16);
/// # Ok::<(), affinor::Error>(())
/// ```
#[derive(Debug)]
pub struct Step<'a, S: System, I> {
    /// The system.
    pub system: &'a S,
    /// The method of the step.
    pub method: &'a I,
    /// Where it begins.
    pub start: S::State,
    /// How long it is; negative backwards.
    pub length: f64,
}

impl<S: System, I: Integrator<S>> Step<'_, S, I> {
    /// The state at a time. Beyond the step it is that of a longer one.
    ///
    /// # Errors
    /// Those of the method.
    pub fn at(&self, time: f64) -> Result<S::State, Error> {
        self.after(time - self.system.time(&self.start))
    }

    /// The state some time after the start.
    ///
    /// # Errors
    /// Those of the method.
    pub fn after(&self, elapsed: f64) -> Result<S::State, Error> {
        let mut state = self.start.clone();
        if elapsed != 0.0 {
            self.method.step(self.system, &mut state, elapsed)?;
        }
        Ok(state)
    }
}
