//! How a problem is integrated: its method, time step, and step-size control.

use super::keys::IntegratorKeys;
use super::reader::{Reader, Value};
use crate::definition::input::{InputError, shown};
use crate::definition::source::Source;
use crate::definition::written::OneOrMore;
use affinor::mechanics::Adaptive;
use affinor::mechanics::motions::Method;

/// The relative tolerance and the largest number of steps, unless the file gives them.
const TOLERANCE: f64 = 1e-10;
const MAX_STEPS: usize = 1_000_000;

/// The table `[integrator]`.
#[derive(Clone, Debug)]
pub(super) struct Integration {
    /// The method, unless the problem takes that of its class.
    pub method: Option<Method>,
    step: Option<Value>,
    tolerance: Option<Value>,
    /// Absolute tolerances of rotations and of translations.
    absolute: Option<[Value; 2]>,
    max_step: Option<Value>,
    max_steps: Option<usize>,
}

impl Integration {
    pub fn read(keys: &IntegratorKeys, reader: &Reader) -> Result<Self, InputError> {
        let source = reader.source;
        let method = match &keys.method {
            None => None,
            Some(name) => Some(Method::from_name(name).ok_or_else(|| {
                let all = Method::ALL.map(Method::name).join(", ");
                let error = InputError::usage(format!("`{}` is no method", shown(name)));
                error.at(&source.at(name)).help(format!("the methods are {all}"))
            })?),
        };
        let absolute = keys.absolute_tolerance.as_ref().map(|OneOrMore(numbers)| {
            match &reader.values(numbers)?[..] {
                [both] => Ok([both.clone(), both.clone()]),
                [rotations, translations] => Ok([rotations.clone(), translations.clone()]),
                others => {
                    let message = format!("`absolute_tolerance` has {} numbers", others.len());
                    let help = "give one number, or one for rotations and one for translations";
                    let place = source.key("integrator.absolute_tolerance");
                    Err(InputError::usage(message).at(&place).help(help))
                }
            }
        });
        Ok(Integration {
            method,
            absolute: absolute.transpose()?,
            tolerance: reader.optional(&keys.tolerance)?,
            max_step: reader.optional(&keys.max_step)?,
            max_steps: keys.max_steps,
            step: reader.optional(&keys.step)?,
        })
    }

    /// The same for another method, with steps of this length, or with this relative tolerance.
    pub fn with_method(
        &self,
        method: Method,
        step: Option<f64>,
        tolerance: f64,
        source: &Source,
    ) -> Self {
        let controlled = method.is_controlled();
        Integration {
            method: Some(method),
            step: step.map(|step| Value::constant(source, step)),
            tolerance: controlled.then(|| Value::constant(source, tolerance)),
            absolute: self.absolute.clone().filter(|_| controlled),
            max_step: self.max_step.clone().filter(|_| controlled),
            max_steps: self.max_steps.filter(|_| controlled),
        }
    }

    /// The time step, where there is one.
    ///
    /// # Errors
    /// A step that is not positive.
    pub fn step(&self, source: &Source, parameters: &[f64]) -> Result<Option<f64>, InputError> {
        positive(&self.step, parameters, source, "step")
    }

    /// The step-size control of a motion through these times.
    ///
    /// # Errors
    /// A value that is not positive.
    pub fn control(
        &self,
        source: &Source,
        parameters: &[f64],
        times: &[f64],
    ) -> Result<Adaptive, InputError> {
        let tolerance = positive(&self.tolerance, parameters, source, "tolerance")?;
        let absolute = self.absolute.as_ref().map(|[rotations, translations]| {
            let of = |value: &Value| {
                let place = source.key("integrator.absolute_tolerance");
                value.positive(parameters).map_err(|error| error.or_near(&place))
            };
            Ok::<_, InputError>([of(rotations)?, of(translations)?])
        });
        let max_step = positive(&self.max_step, parameters, source, "max_step")?;
        let span = match times {
            [first, .., last] => (last - first).abs(),
            _ => f64::INFINITY,
        };
        Ok(Adaptive {
            absolute: absolute.transpose()?,
            span,
            max_steps: self.max_steps.unwrap_or(MAX_STEPS),
            max_step: max_step.unwrap_or(f64::INFINITY),
            ..Adaptive::new(tolerance.unwrap_or(TOLERANCE))
        })
    }

    /// Refuses keys that the method ignores.
    pub fn expect_no_ignored_keys(
        &self,
        method: Method,
        source: &Source,
    ) -> Result<(), InputError> {
        let (has_steps, controlled) = (method.has_steps(), method.is_controlled());
        let keys = [
            ("step", self.step.is_some() && !has_steps),
            ("tolerance", self.tolerance.is_some() && !controlled),
            ("absolute_tolerance", self.absolute.is_some() && !controlled),
            ("max_step", self.max_step.is_some() && !controlled),
            ("max_steps", self.max_steps.is_some() && !controlled),
        ];
        let Some((key, _)) = keys.iter().find(|(_, ignored)| *ignored) else { return Ok(()) };
        let error = InputError::usage(format!("the method {method} has no `{key}`"));
        let place = source.key(&format!("integrator.{key}"));
        Err(error.at(&place).help("leave the key out, or name another method"))
    }
}

fn positive(
    value: &Option<Value>,
    parameters: &[f64],
    source: &Source,
    key: &str,
) -> Result<Option<f64>, InputError> {
    let value = value.as_ref().map(|value| value.positive(parameters)).transpose();
    value.map_err(|error| error.or_near(&source.key(&format!("integrator.{key}"))))
}
