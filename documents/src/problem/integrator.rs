//! The integration settings of a problem: method, time step, and step-size control.

use super::keys::IntegratorKeys;
use super::output::Output;
use super::reader::{Reader, Value};
use crate::input::{InputError, Place, Source, forms::OneOrMore, shown};
use affinor::mechanics::Adaptive;
use affinor::mechanics::simulation::{Integration, Method};

/// The default relative tolerance and the default limit on the number of steps.
const TOLERANCE: f64 = 1e-10;
const MAX_STEPS: usize = 1_000_000;

/// The method, the step and the tolerances that a problem sets.
#[derive(Clone, Debug)]
pub(super) struct Integrator {
    /// The method; `None` if the problem sets none, so that the default of its class is used.
    pub method: Option<Method>,
    step: Option<Value>,
    tolerance: Option<Value>,
    /// The absolute tolerances of rotations and of translations.
    absolute: Option<[Value; 2]>,
    max_step: Option<Value>,
    max_steps: Option<usize>,
}

impl Integrator {
    pub fn read(keys: &IntegratorKeys, reader: &Reader) -> Result<Self, InputError> {
        let source = reader.source;
        let method = match &keys.method {
            None => None,
            Some(name) => Some(method_of(name, &source.at(name))?),
        };
        let absolute = keys.absolute_tolerance.as_ref().map(|OneOrMore(numbers)| {
            match &reader.values(numbers)?[..] {
                [both] => Ok([both.clone(), both.clone()]),
                [rotations, translations] => Ok([rotations.clone(), translations.clone()]),
                others => {
                    let message = format!("`absolute_tolerance` has {} numbers", others.len());
                    let help = "give one number, or one for rotations and one for translations";
                    Err(source.refused("integrator.absolute_tolerance", message).help(help))
                }
            }
        });
        Ok(Integrator {
            method,
            absolute: absolute.transpose()?,
            tolerance: reader.optional(&keys.tolerance)?,
            max_step: reader.optional(&keys.max_step)?,
            max_steps: keys.max_steps,
            step: reader.optional(&keys.step)?,
        })
    }

    /// Returns the settings with another method, and with the given step size or relative
    /// tolerance. Without a given value, the method uses the value of the file if it needs one.
    pub fn with_method(
        &self,
        method: Method,
        step: Option<f64>,
        tolerance: Option<f64>,
        source: &Source,
    ) -> Self {
        let controlled = method.is_controlled();
        let of = |given: Option<f64>, own: &Option<Value>| {
            given.map_or(own.clone(), |given| Some(Value::constant(source, given)))
        };
        Integrator {
            method: Some(method),
            step: of(step, &self.step).filter(|_| method.has_steps()),
            tolerance: of(tolerance, &self.tolerance).filter(|_| controlled),
            absolute: self.absolute.clone().filter(|_| controlled),
            max_step: self.max_step.clone().filter(|_| controlled),
            max_steps: self.max_steps.filter(|_| controlled),
        }
    }

    /// Returns the settings with another method, step or tolerance. If this changes the choice
    /// between a fixed step and step-size control, keys of the file that no longer apply are
    /// ignored.
    pub fn replaced(
        &self,
        method: Option<Method>,
        step: Option<Value>,
        tolerance: Option<Value>,
    ) -> Self {
        let has_steps = method.is_none_or(Method::has_steps);
        let controlled = method.map_or(step.is_none(), Method::is_controlled);
        Integrator {
            method: method.or(self.method),
            step: step.or(self.step.clone().filter(|_| has_steps)),
            tolerance: tolerance.or(self.tolerance.clone().filter(|_| controlled)),
            absolute: self.absolute.clone().filter(|_| controlled),
            max_step: self.max_step.clone().filter(|_| controlled),
            max_steps: self.max_steps.filter(|_| controlled),
        }
    }

    /// Returns an error for keys that the method ignores.
    pub fn expect_no_ignored_keys(
        &self,
        method: Method,
        source: &Source,
    ) -> Result<(), InputError> {
        let (has_steps, controlled) = (method.has_steps(), method.is_controlled());
        let place = |value: &Option<Value>| value.as_ref().map(Value::place);
        let key = |key: &str| source.key(&format!("integrator.{key}"));
        let keys = [
            ("step", place(&self.step).filter(|_| !has_steps)),
            ("tolerance", place(&self.tolerance).filter(|_| !controlled)),
            (
                "absolute_tolerance",
                self.absolute.as_ref().filter(|_| !controlled).map(|_| key("absolute_tolerance")),
            ),
            ("max_step", place(&self.max_step).filter(|_| !controlled)),
            ("max_steps", self.max_steps.filter(|_| !controlled).map(|_| key("max_steps"))),
        ];
        let Some((key, place)) = keys.into_iter().find_map(|(key, at)| Some((key, at?))) else {
            return Ok(());
        };
        let error = InputError::usage(format!("the method {method} has no `{key}`"));
        Err(error.at(&place).help("leave the key out, or name another method"))
    }
}

/// The method with this name.
pub(super) fn method_of(name: &str, place: &Place) -> Result<Method, InputError> {
    Method::from_name(name).ok_or_else(|| {
        if let Some(instead) = Method::instead_of(name) {
            let error = InputError::usage(format!("the method `{name}` was removed"));
            return error.at(place).help(format!("use {instead}"));
        }
        let all: Vec<_> = Method::ALL.iter().map(|method| method.name()).collect();
        let all = all.join(", ");
        let error = InputError::usage(format!("`{}` is not a method", shown(name)));
        error.at(place).help(format!("the methods are {all}"))
    })
}

/// The parameters and times of a single motion, and the parts of its problem that do not depend on
/// the class of the problem.
pub(super) struct Member<'p> {
    pub source: &'p Source,
    /// The parameters with their values for this motion.
    pub parameters: Vec<(String, f64)>,
    /// The times of the rows; the first time is the initial time.
    pub times: Vec<f64>,
    pub integrator: &'p Integrator,
    pub output: &'p Output,
}

impl Member<'_> {
    /// The values of the parameters.
    pub fn values(&self) -> Vec<f64> {
        values_of(&self.parameters)
    }

    /// The method that the file names.
    pub fn method(&self) -> Option<Method> {
        self.integrator.method
    }

    /// The settings of the integration. The step and the tolerances must be positive.
    pub fn integration(&self) -> Result<Integration, InputError> {
        Ok(Integration { method: self.method(), step: self.step()?, control: self.control()? })
    }

    /// The time step, if there is one.
    fn step(&self) -> Result<Option<f64>, InputError> {
        self.positive(&self.integrator.step)
    }

    /// The time step for a class of problems that needs a step. Messages call the class `what`.
    pub fn needed_step(&self, what: &str) -> Result<f64, InputError> {
        self.step()?.ok_or_else(|| InputError::mathematics(format!("{what} needs a step size")))
    }

    /// The settings of the step-size control.
    fn control(&self) -> Result<Adaptive, InputError> {
        let Integrator { tolerance, absolute, max_step, max_steps, .. } = self.integrator;
        let values = self.values();
        let absolute = absolute.as_ref().map(|[rotations, translations]| {
            Ok::<_, InputError>([rotations.positive(&values)?, translations.positive(&values)?])
        });
        let span = match &self.times[..] {
            [first, .., last] => (last - first).abs(),
            _ => f64::INFINITY,
        };
        Ok(Adaptive {
            absolute: absolute.transpose()?,
            span,
            max_steps: max_steps.unwrap_or(MAX_STEPS),
            max_step: self.positive(max_step)?.unwrap_or(f64::INFINITY),
            ..Adaptive::new(self.positive(tolerance)?.unwrap_or(TOLERANCE))
        })
    }

    fn positive(&self, value: &Option<Value>) -> Result<Option<f64>, InputError> {
        value.as_ref().map(|value| value.positive(&self.values())).transpose()
    }
}

/// The values without their names.
pub(super) fn values_of(parameters: &[(String, f64)]) -> Vec<f64> {
    parameters.iter().map(|(_, value)| *value).collect()
}
