//! Step-size control, as a file describes it.

use super::Value;
use crate::definition::input::{InputError, Source};
use crate::dynamics::Adaptive;
use crate::simulation::Method;

/// The relative tolerance and the most steps where none are named.
const TOLERANCE: f64 = 1e-10;
const MAX_STEPS: usize = 1_000_000;

/// The keys of a table `[integrator]` that are for methods with step-size control.
#[derive(Clone, Debug, Default)]
pub(super) struct Control {
    pub tolerance: Option<Value>,
    /// Of turns, and of translations.
    pub absolute: Option<[Value; 2]>,
    pub max_step: Option<Value>,
    pub max_steps: Option<usize>,
}

impl Control {
    /// The same for another method, with another relative tolerance.
    pub fn of(&self, method: Method, tolerance: Value) -> Self {
        if !method.is_controlled() {
            return Control::default();
        }
        Control { tolerance: Some(tolerance), ..self.clone() }
    }

    /// The control of a run through these times.
    ///
    /// # Errors
    /// A value that is not above zero.
    pub fn at(
        &self,
        source: &Source,
        parameters: &[f64],
        times: &[f64],
    ) -> Result<Adaptive, InputError> {
        let positive = |value: &Value, key: &str| {
            value.positive(parameters).map_err(|error| error.or_near(&source.key(key)))
        };
        let optional =
            |value: &Option<Value>, key| value.as_ref().map(|v| positive(v, key)).transpose();
        let tolerance = optional(&self.tolerance, "tolerance")?.unwrap_or(TOLERANCE);
        let absolute = self.absolute.as_ref().map(|[turns, translations]| {
            let of = |value| positive(value, "absolute_tolerance");
            Ok::<_, InputError>([of(turns)?, of(translations)?])
        });
        let span = match times {
            [first, .., last] => (last - first).abs(),
            _ => f64::INFINITY,
        };
        Ok(Adaptive {
            absolute: absolute.transpose()?,
            span,
            max_steps: self.max_steps.unwrap_or(MAX_STEPS),
            max_step: optional(&self.max_step, "max_step")?.unwrap_or(f64::INFINITY),
            ..Adaptive::new(tolerance)
        })
    }

    /// The keys that are given.
    pub fn given(&self) -> [(&'static str, bool); 4] {
        [
            ("tolerance", self.tolerance.is_some()),
            ("absolute_tolerance", self.absolute.is_some()),
            ("max_step", self.max_step.is_some()),
            ("max_steps", self.max_steps.is_some()),
        ]
    }
}
