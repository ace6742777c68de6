//! Conventions of stored tables: formulas for stored components in terms of the computed
//! components.

use super::super::indexed::{Index, Names, Tensors};
use super::super::statements::scalar;
use super::super::{Quantity, Table};
use crate::Coefficient;
use crate::input::{InputError, Source};
use affinor::Geometry;
use affinor_tensors::contraction::indices;
use affinor_tensors::expression::ExpressionError;
use affinor_tensors::{Symbolic, Tensor, contract};
use std::collections::BTreeMap;

/// The convention of a stored tensor, as an equation. The left-hand side is a stored component; the
/// right-hand side is an expression in the tensors of this program.
///
/// | convention | the stored table has |
/// |---|---|
/// | `R^i_jkl = -R^i_jkl` | the other sign |
/// | `Lambda^i_jk = Lambda^i_kj` | the direction as the last index |
/// | `R_ijkl = R_ijkl` | all indices lowered by the metric |
#[derive(Clone, Debug)]
pub struct Convention {
    source: Source,
}

/// The form of a convention, for messages.
const FORM: &str =
    "write the stored component, =, and its value here, as in \"R^i_jkl = -R^i_jkl\"";

impl Convention {
    /// Parses a convention.
    pub fn new(text: &str) -> Self {
        Convention { source: Source::new("--convention", text) }
    }

    /// Converts the tensor of a computed table to this convention, if the table contains it.
    /// Returns the quantity, and whether the table contains it. `scalars` are the names of scalars,
    /// and `values` are the values of parameters that were set.
    ///
    /// # Errors
    /// An error if the text is not a component, `=` and an expression, and if the expression has no
    /// value, or indices that differ from those of the component.
    pub(in crate::report) fn apply<S: Coefficient>(
        &self,
        table: &mut Table<S>,
        geometry: &Geometry<S>,
        scalars: &[String],
        values: &BTreeMap<String, Symbolic>,
    ) -> Result<(Quantity, bool), InputError> {
        let names = Names::new(geometry, scalars.iter().cloned());
        let scalar = |name: &str| scalar::<S>(name, &names, values);
        let tensors = Tensors::new(geometry, &scalar);
        let (quantity, tensor) = self.stored(&names, &tensors)?;
        let entry = table.tensors.iter_mut().find(|entry| entry.quantity == quantity);
        let used = entry.map(|entry| entry.tensor = tensor).is_some();
        Ok((quantity, used))
    }

    /// The remark that no stored table contains the tensor of this convention.
    pub(in crate::report) fn unused(&self, quantity: Quantity) -> String {
        let text = crate::input::shown(self.source.text.trim());
        format!("--convention \"{text}\" is not used: no stored table has {}", quantity.key())
    }

    /// The error for an invalid convention.
    pub(in crate::report) fn refused(&self, reason: String) -> InputError {
        InputError::usage(reason).at(&self.source.whole(&self.source.text))
    }

    fn stored<S: Coefficient>(
        &self,
        names: &Names,
        tensors: &Tensors<S>,
    ) -> Result<(Quantity, Tensor<S>), InputError> {
        let refused = |part: &str, reason: String| {
            InputError::usage(reason).at(&self.source.whole(part)).help(FORM)
        };
        let text = self.source.content();
        let Some((left, right)) = text.split_once('=').map(|(a, b)| (a.trim(), b.trim())) else {
            return Err(refused(text, "the convention is not an equation".into()));
        };
        let within = |part: &str, ExpressionError { span, reason }: ExpressionError| {
            InputError::usage(reason).at(&self.source.find(part, span)).help(FORM)
        };
        let parsed = names.parse(left).map_err(|error| within(left, error))?;
        let written = match parsed.occurrences.as_slice() {
            [only] if only.span == (0..left.len()) => only.indices.as_ref().map(|at| (only, at)),
            _ => None,
        };
        let letter = |&(index, variance): &(Index, _)| match index {
            Index::Letter(letter) => Some((letter, variance)),
            Index::Number(_) => None,
        };
        let result: Option<(Quantity, Vec<_>)> = written.and_then(|(occurrence, indices)| {
            Some((occurrence.quantity, indices.iter().map(letter).collect::<Option<_>>()?))
        });
        let Some((quantity, letters)) = result else {
            return Err(refused(
                left,
                "the left side must be one tensor with a letter for each index".into(),
            ));
        };
        let value = names.parse(right).and_then(|parsed| tensors.value(&parsed));
        let value = value.map_err(|error| within(right, error))?;
        let own = value.letters.iter().copied().zip(value.tensor.slots().iter().copied());
        let reordered = format!("a{} -> {}", indices(own), indices(letters));
        let tensor = contract(&reordered, &[("a", &value.tensor)]);
        let tensor =
            tensor.map_err(|_| refused(text, "the sides have different indices".into()))?;
        Ok((quantity, tensor))
    }
}
