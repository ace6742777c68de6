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
        if name == POWER {
            return no_function(name, arguments);
        }
        let head = name.split('_').next().unwrap_or_default();
        if let Some(free) = self.free.iter().find(|free| free.name() == head) {
            let function = FreeFunction::new(name, free.arguments())?;
            let same = arguments.len() == free.arguments().len()
                && arguments
                    .iter()
                    .zip(free.arguments())
                    .all(|(a, b)| *a == Symbolic::parameter(b));
            let value = || Symbolic::parameter(&function.variable());
            return same
                .then(value)
                .ok_or_else(|| format!("it is declared as {}", free.variable()));
        }
        let [argument] = arguments else {
            let name = shown(name);
            return Err(format!(
                "there is no function `{name}` of {} arguments here",
                arguments.len()
            ));
        };
        if let "sqrt" | "log" = name {
            return self.positive.function(name, argument);
        }
        // each term has one: `sin(a*x)`
        let coordinate = |(other, _): &(String, u32)| self.coordinates.contains(other);
        let terms = argument.terms().into_iter().map(|(powers, _)| powers);
        let others = terms.filter(|powers| !powers.iter().any(coordinate)).flatten();
        match others.map(|(other, _)| other).next() {
            Some(other) => Err(format!("{} takes coordinates, and `{other}` is none", shown(name))),
            None => self.positive.function(name, argument),
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
