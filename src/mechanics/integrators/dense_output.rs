//! Dense output: states within a step.

use super::Integrator;
use crate::Error;
use crate::mechanics::systems::System;

/// A step, from which the state at any time within the step can be computed: a shorter step from
/// the same start has this state as its result.
///
/// States within the step have the same order and the same conserved quantities as the method;
/// there is no interpolant of lower order. Each state requires one step.
///
/// ```
/// use affinor::mechanics::integrators::dense_output::DenseStep;
/// use affinor::mechanics::{Integrator, PrescribedVelocity, Magnus, KinematicState};
/// use affinor::group::{LieGroup, So3};
/// use nalgebra::Vector3;
/// let wheel = PrescribedVelocity { group: So3, velocity: |t: f64| Vector3::z() * t };
/// let start = KinematicState { time: 0.0, element: So3.identity() };
/// let step = DenseStep { system: &wheel, method: &Magnus::Four, start, length: 0.5 };
/// let turn = So3.log(&step.at(0.2)?.element)?;
/// assert!((turn.z - 0.02).abs() < 1e-16);
/// # Ok::<(), affinor::Error>(())
/// ```
#[derive(Debug)]
pub struct DenseStep<'a, S: System, I> {
    /// The system.
    pub system: &'a S,
    /// The method of the step.
    pub method: &'a I,
    /// The state at the start of the step.
    pub start: S::State,
    /// The step size. It is negative backwards in time.
    pub length: f64,
}

impl<S: System, I: Integrator<S>> DenseStep<'_, S, I> {
    /// The state at a time. If the time is after the end of the step, the result is the state after
    /// a longer step.
    ///
    /// # Errors
    /// The errors of a step of the method.
    pub fn at(&self, time: f64) -> Result<S::State, Error> {
        self.after(time - self.system.time(&self.start))
    }

    /// The state after a time `elapsed` since the start of the step.
    ///
    /// # Errors
    /// The errors of a step of the method.
    pub fn after(&self, elapsed: f64) -> Result<S::State, Error> {
        let mut state = self.start.clone();
        if elapsed != 0.0 {
            self.method.step(self.system, &mut state, elapsed)?;
        }
        Ok(state)
    }
}
