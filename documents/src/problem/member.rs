//! One motion of a problem: that of a member of an ensemble, or the only one.

use super::integration::Integration;
use super::output::Output;
use crate::definition::InputError;
use crate::definition::source::Source;
use affinor::mechanics::Adaptive;
use affinor::mechanics::motions::Method;

/// The parameters and times of one motion, and the parts of the problem that do not depend on its class.
pub(super) struct Member<'p> {
    pub source: &'p Source,
    /// The parameters with their values.
    pub parameters: Vec<(String, f64)>,
    /// The times of the rows; the first is the initial time.
    pub times: Vec<f64>,
    pub integration: &'p Integration,
    pub output: &'p Output,
}

impl Member<'_> {
    /// The values of the parameters.
    pub fn values(&self) -> Vec<f64> {
        values_of(&self.parameters)
    }

    /// The method that the file names.
    pub fn method(&self) -> Option<Method> {
        self.integration.method
    }

    /// The time step, where there is one.
    ///
    /// # Errors
    /// A step that is not positive.
    pub fn step(&self) -> Result<Option<f64>, InputError> {
        self.integration.step(self.source, &self.values())
    }

    /// The time step of a class of problems that needs one; `what` names the class.
    ///
    /// # Errors
    /// A step that is missing or not positive.
    pub fn needed_step(&self, what: &str) -> Result<f64, InputError> {
        self.step()?.ok_or_else(|| InputError::mathematics(format!("{what} needs a step")))
    }

    /// The step-size control.
    ///
    /// # Errors
    /// A tolerance or a limit that is not positive.
    pub fn control(&self) -> Result<Adaptive, InputError> {
        self.integration.control(self.source, &self.values(), &self.times)
    }
}

/// Values without their names.
pub(super) fn values_of(parameters: &[(String, f64)]) -> Vec<f64> {
    parameters.iter().map(|(_, value)| *value).collect()
}
