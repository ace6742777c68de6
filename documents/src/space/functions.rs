//! The functions that expressions on a chart may contain.

use crate::input::shown;
use affinor_tensors::Symbolic;
use affinor_tensors::expression::{POWER, no_function};
use affinor_tensors::scalar::{FreeFunction, PositiveFactors};
use std::sync::{Mutex, PoisonError};

/// The functions on a chart: functions of its coordinates, the signs that define roots and
/// logarithms, and undetermined functions.
#[derive(Clone, Debug)]
pub(crate) struct Functions {
    pub coordinates: Vec<String>,
    pub free: Vec<FreeFunction>,
    pub positive: Positive,
}

/// The factors that are positive on the chart. While a definition is read, the bases of powers with
/// symbolic exponents are added.
#[derive(Debug, Default)]
pub(crate) struct Positive(Mutex<PositiveFactors>);

impl Positive {
    /// The positive factors that are known so far.
    pub fn known(&self) -> PositiveFactors {
        self.0.lock().unwrap_or_else(PoisonError::into_inner).clone()
    }

    /// Declares that a function is positive on the chart.
    pub fn declare(&self, function: &Symbolic) -> Result<(), String> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner).declare(function)
    }

    fn power(&self, base: &Symbolic, exponent: &Symbolic) -> Result<Symbolic, String> {
        let mut factors = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        factors.assumed_power(base, exponent)
    }
}

impl Clone for Positive {
    fn clone(&self) -> Self {
        Positive(Mutex::new(self.known()))
    }
}

impl Functions {
    /// The declared function with this name, or the derivative of a declared function.
    pub fn derivative(&self, name: &str) -> Option<FreeFunction> {
        let head = name.split('_').next()?;
        let free = self.free.iter().find(|free| free.name() == head)?;
        free.named(name).ok()
    }

    /// Evaluates a function at its arguments.
    pub fn call(&self, name: &str, arguments: &[Symbolic]) -> Result<Symbolic, String> {
        let head = name.split('_').next().unwrap_or_default();
        if let Some(free) = self.free.iter().find(|free| free.name() == head) {
            return free.named(name)?.at(arguments);
        }
        match arguments {
            [argument] => self.positive.known().function(name, argument),
            [base, exponent] if name == POWER => self.positive.power(base, exponent),
            several => {
                let (name, count) = (shown(name), several.len());
                Err(format!("there is no function `{name}` of {count} arguments here"))
            }
        }
    }
}

/// Evaluates a function if there is no chart. Only roots of numbers are allowed.
pub(super) fn without_chart(name: &str, arguments: &[Symbolic]) -> Result<Symbolic, String> {
    let is_number = |value: &Symbolic| value.parameters().is_empty();
    let positive = PositiveFactors::default();
    match arguments {
        [argument] if name == "sqrt" && is_number(argument) => positive.function(name, argument),
        [argument] if name == "sqrt" => {
            Err(format!("sqrt is allowed for numbers only here, but {argument} has parameters"))
        }
        [base, exponent] if name == POWER => match is_number(base) && is_number(exponent) {
            true => positive.power(base, exponent),
            false => no_function(name, arguments),
        },
        _ => Err(format!("`{}` is not a function here: only charts allow functions", shown(name))),
    }
}
