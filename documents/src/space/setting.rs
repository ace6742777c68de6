//! Replaces parameters of a definition by values.

use crate::input::{InputError, Source, numbers::numbers_in, shown};
use crate::space::{
    Definition,
    notation::{Names, check_name, split},
};
use affinor_tensors::expression::canonical_name;
use affinor_tensors::scalar::{FreeFunction, PositiveFactors};
use affinor_tensors::{Notation, Symbolic};
use std::collections::BTreeMap;

/// The largest size of a value after the replacement of its parameters.
const MAX_SIZE: f64 = (1u64 << 22) as f64;

impl Definition {
    /// Replaces parameters and undetermined functions by values, all at the same time.
    ///
    /// # Errors
    /// An error for a name that is not a parameter of this definition, for a denominator that
    /// becomes zero, and for a value that becomes too large.
    pub fn set(&mut self, values: &BTreeMap<String, Symbolic>) -> Result<(), InputError> {
        let mut parameters = self.parameters();
        let others = self
            .declared
            .iter()
            .filter(|name| !parameters.contains(name) && !self.coordinates().contains(name));
        let others: Vec<_> = others.cloned().collect();
        parameters.extend(others);
        if let Some(fixed) = values.keys().find(|name| self.coordinates().contains(*name)) {
            let message = format!("`{}` is a coordinate, not a parameter", shown(fixed));
            return Err(InputError::usage(message).help("set parameters only"));
        }
        for free in self.functions().map_or(&[][..], |functions| &functions.free) {
            let others = self.coordinates().iter().filter(|name| !free.arguments().contains(name));
            let value = values.get(&free.declaration()).map_or(vec![], Symbolic::parameters);
            if let Some(other) = others.into_iter().find(|name| value.contains(name)) {
                let message = format!("{} cannot depend on {other}", free.declaration());
                return Err(InputError::usage(message));
            }
            parameters.push(free.declaration());
        }
        if let Some(unknown) = values.keys().find(|name| !parameters.contains(name)) {
            return Err(no_parameter(unknown, &parameters));
        }
        let positive = match self.functions() {
            None => PositiveFactors::default(),
            Some(functions) => {
                functions.positive.known().with_values(values).map_err(InputError::mathematics)?
            }
        };
        let mut failed = None;
        self.each_value_mut(&mut |value| {
            if failed.is_some() {
            } else if growth(value, values) > MAX_SIZE {
                let message = format!("{value} becomes too large when the parameters are set");
                failed = Some(InputError::usage(message));
            } else {
                match positive.substitute(value, values) {
                    Ok(substituted) => *value = substituted,
                    Err(message) => failed = Some(InputError::mathematics(message)),
                }
            }
        });
        failed.map_or(Ok(()), Err)
    }
}

/// An upper bound for the size of `value` after the replacement of its parameters by `values`. The
/// bound assumes that no terms are collected or cancel.
fn growth(value: &Symbolic, values: &BTreeMap<String, Symbolic>) -> f64 {
    let part = |part: Symbolic| {
        let terms = part.numerator_terms();
        let images = terms.iter().map(|(powers, _)| {
            // includes functions whose arguments contain replaced parameters
            let given = powers.iter().filter_map(|(variable, power)| {
                let own = Symbolic::variable(*variable);
                let image = own.substitute(values).filter(|image| *image != own)?;
                Some((image, power))
            });
            let image = given.fold((1.0, 0.0), |(terms, size), (value, power)| {
                let power = f64::from(*power);
                (terms * terms_of_power(&value, power), size + power * value.size() as f64)
            });
            image.0 * image.1
        });
        images.sum::<f64>()
    };
    part(value.numerator()) + part(value.denominator())
}

/// The largest possible number of terms of a power: `C(t + e - 1, e)`, where `t` is the number of
/// terms and `e` is the exponent.
fn terms_of_power(value: &Symbolic, exponent: f64) -> f64 {
    let count = |part: Symbolic| part.numerator_terms().len();
    let terms = count(value.numerator()).max(count(value.denominator()));
    (1..terms).fold(1.0, |product, t| product * (exponent + t as f64) / t as f64)
}

/// The error for a name that is not one of the parameters.
pub(crate) fn no_parameter(name: &str, parameters: &[String]) -> InputError {
    let help = match parameters {
        [] => "there are none".into(),
        some => format!("the parameters are {}", some.join(", ")),
    };
    InputError::usage(format!("`{}` is not a parameter here", shown(name))).help(help)
}

/// The names and values of substitutions `name=value,...`, as pieces of the text.
///
/// # Errors
/// An error for a piece without an equals sign.
pub(crate) fn named_values(source: &Source) -> Result<Vec<(&str, &str)>, InputError> {
    let named = |part| match str::split_once(part, '=') {
        Some((name, value)) => Ok((name.trim(), value)),
        None => {
            let error = InputError::usage("this is not of the form name=value");
            let error = error.at(&source.whole(part));
            Err(error.help("separate several by commas, as in --set \"J1=1/2,h=-1\""))
        }
    };
    let pieces = split(&source.text).into_iter();
    pieces.map(named).collect()
}

/// The names and numbers of substitutions `name=number,...`.
///
/// # Errors
/// Those of [`named_values`], and an error for a value that is not one number.
pub(crate) fn named_numbers(source: &Source) -> Result<Vec<(&str, f64)>, InputError> {
    let number = |(name, value)| match numbers_in(value, source)?[..] {
        [number] => Ok((name, number)),
        _ => {
            let error = InputError::usage("give the parameter exactly one value");
            Err(error.at(&source.whole(name)))
        }
    };
    named_values(source)?.into_iter().map(number).collect()
}

/// Parses substitutions `name=value,...`.
pub(super) fn settings(
    source: &Source,
    names: &Names,
) -> Result<BTreeMap<String, Symbolic>, InputError> {
    let mut values = BTreeMap::new();
    for (name, value) in named_values(source)? {
        let place = source.whole(name);
        let name = &*canonical_name(name);
        let free = FreeFunction::read(name).map(|function| function.declaration());
        if free.is_err() {
            check_name(name).map_err(|error| error.at(&source.whole(name)))?;
        }
        let value = names.scalar(value, source)?;
        if values.insert(free.unwrap_or_else(|_| name.to_string()), value).is_some() {
            let error = InputError::usage(format!("the parameter `{name}` is set twice"));
            return Err(error.at(&place));
        }
    }
    Ok(values)
}
