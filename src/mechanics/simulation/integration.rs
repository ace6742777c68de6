//! The settings of the integration of a motion.

use super::methods::Method;
use crate::Error;
use crate::mechanics::Adaptive;

/// The method, the step size and the step-size control of a motion.
#[derive(Clone, Copy, Debug)]
pub struct Integration {
    /// The method, or `None` for the default of the class of problems.
    pub method: Option<Method>,
    /// The step size of methods with fixed steps.
    pub step: Option<f64>,
    /// The step-size control: its tolerances, its longest step, and the largest number of steps
    /// from one output time to the next.
    pub control: Adaptive,
}

impl Integration {
    /// The step size of a method; 0 for methods without one.
    ///
    /// # Errors
    /// [`Error::Unsupported`] for fixed steps without a step size, and for a tolerance that is too small.
    pub(super) fn step_of(&self, method: Method) -> Result<f64, Error> {
        method.expect_resolved(self.control.tolerance)?;
        match self.step {
            Some(step) => Ok(step),
            None if method.has_steps() => Err(method.refused("it needs a step")),
            None => Ok(0.0),
        }
    }
}
