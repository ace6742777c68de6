//! The settings of the integration of a motion.

use super::methods::Method;
use crate::Error;
use crate::mechanics::Adaptive;

/// The method, the step size and the step-size control of a motion.
#[derive(Clone, Copy, Debug)]
pub struct Integration {
    /// The method. `None` means the default of the class of problems.
    pub method: Option<Method>,
    /// The step size of methods with fixed steps.
    pub step: Option<f64>,
    /// The step-size control. It contains the tolerances, the longest step, and the largest number
    /// of steps between two output times.
    pub control: Adaptive,
}

impl Integration {
    /// The step size of a method. Returns 0 for methods without a fixed step size.
    ///
    /// # Errors
    /// [`Error::Unsupported`] if a method with fixed steps has no step size, or if a tolerance is
    /// too small.
    pub(super) fn step_of(&self, method: Method) -> Result<f64, Error> {
        method.expect_resolved(self.control.tolerance)?;
        match self.step {
            Some(step) => Ok(step),
            None if method.has_steps() => Err(method.refused("it needs a step size")),
            None => Ok(0.0),
        }
    }
}
