//! The functions that expressions over a chart may contain.

use super::input::shown;
use affinor_tensors::expression::{POWER, no_function};
use affinor_tensors::scalar::{FreeFunction, PositiveFactors};
use affinor_tensors::Symbolic;

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

/// The value of a function where there is no chart: roots of numbers.
pub(super) fn without_chart(name: &str, arguments: &[Symbolic]) -> Result<Symbolic, String> {
    let is_number = |value: &Symbolic| value.parameters().is_empty();
    let positive = PositiveFactors::default();
    match arguments {
        [argument] if name == "sqrt" && is_number(argument) => positive.function(name, argument),
        [argument] if name == "sqrt" => {
            Err(format!("sqrt takes numbers here, and {argument} has parameters"))
        }
        [base, exponent] if name == POWER => match is_number(base) && is_number(exponent) {
            true => positive.power(base, exponent),
            false => no_function(name, arguments),
        },
        _ => Err(format!("`{}` is no function here: only a chart has some", shown(name))),
    }
}
