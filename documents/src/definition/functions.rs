//! The functions that expressions over a chart may contain.

use super::input::shown;
use affinor_tensors::expression::{POWER, no_function};
use affinor_tensors::scalar::{FreeFunction, PositiveFactors};
use affinor_tensors::{Rational, Symbolic};

/// The functions on a chart: of its coordinates, with the signs by which roots and logarithms are defined, and those
/// that are declared without being given.
#[derive(Clone, Debug)]
pub(crate) struct Functions {
    pub coordinates: Vec<String>,
    pub free: Vec<FreeFunction>,
    pub positive: PositiveFactors,
}

impl Functions {
    /// The value of a function.
    pub fn call(&self, name: &str, arguments: &[Symbolic]) -> Result<Symbolic, String> {
        let head = name.split('_').next().unwrap_or_default();
        if let Some(free) = self.free.iter().find(|free| free.name() == head) {
            return FreeFunction::new(name, free.arguments())?.at(arguments);
        }
        match arguments {
            [argument] => self.positive.function(name, argument),
            [base, exponent] if name == POWER => self.positive.power(base, exponent),
            several => {
                let (name, count) = (shown(name), several.len());
                Err(format!("there is no function `{name}` of {count} arguments here"))
            }
        }
    }
}

/// The value of a function where there is no chart: the square root of a square.
pub(super) fn without_chart(name: &str, arguments: &[Symbolic]) -> Result<Symbolic, String> {
    if name == POWER {
        return no_function(name, arguments);
    }
    let (Some(argument), "sqrt") = (arguments.first(), name) else {
        return Err(format!("`{}` is no function here: only a chart has some", shown(name)));
    };
    let root = argument.as_constant().and_then(Rational::sqrt).map(Symbolic::constant);
    root.ok_or_else(|| format!("the square root of {argument} is not rational; exact values are"))
}
