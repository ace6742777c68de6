//! Numbers and formulas of a problem, read with the parameters that are known so far.

use super::{Value, Written};
use crate::definition::input::{InputError, Source};
use crate::definition::notation::check_name;
use crate::definition::written::{Number, Text, TextsText};
use crate::formula::Formula;

/// Names of numbers, which no parameter takes.
const NUMBERS: [&str; 2] = ["pi", "tau"];

/// Reads numbers, which are formulas in the parameters that are known so far.
pub(super) struct Reader<'s> {
    pub source: &'s Source,
    pub names: Vec<String>,
}

impl Reader<'_> {
    pub fn written(&self, Text(text): &Text) -> Written {
        let source = self.source.holding(text);
        let own = source.own(text);
        Written { text: own.to_string(), place: source.whole(own) }
    }

    pub fn value(&self, Number(text): &Number) -> Result<Value, InputError> {
        let written = self.written(text);
        let names = &self.names;
        let formula =
            Formula::parse(&written.text, &mut |name| names.iter().position(|own| own == name));
        let help = || match names.as_slice() {
            [] => "there are no parameters, only pi and tau".to_string(),
            names => format!("the parameters are {}", names.join(", ")),
        };
        let formula = formula.map_err(|error| written.refused(error, help()))?;
        Ok(Value { formula, written })
    }

    pub fn values(&self, list: &[Number]) -> Result<Vec<Value>, InputError> {
        list.iter().map(|number| self.value(number)).collect()
    }

    pub fn optional(&self, number: &Option<Number>) -> Result<Option<Value>, InputError> {
        number.as_ref().map(|number| self.value(number)).transpose()
    }

    /// Formulas by their names.
    pub fn formulas(
        &self,
        table: &Option<TextsText>,
    ) -> Result<Vec<(String, Written)>, InputError> {
        let named = table.iter().flat_map(|table| &table.0).map(|(name, text)| {
            check_name(&name.0).map_err(|error| error.at(&self.source.key(&name.0)))?;
            Ok((name.0.to_string(), self.written(text)))
        });
        named.collect()
    }

    pub fn declare(&mut self, Text(name): &Text) -> Result<(), InputError> {
        let mut place = self.source.whole(name);
        if place.span.is_none() {
            place = self.source.key(name);
        }
        check_name(name).map_err(|error| error.at(&place))?;
        if NUMBERS.contains(&&**name) || self.names.iter().any(|own| own == name) {
            let message = format!("`{name}` has a meaning already");
            return Err(InputError::usage(message).at(&place).help("take another name"));
        }
        self.names.push(name.to_string());
        Ok(())
    }
}
