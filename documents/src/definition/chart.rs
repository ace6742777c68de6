//! Charts in definitions: coordinates, and fields whose components are functions of them.

use super::functions::Functions;
use super::input::InputError;
use super::notation::Names;
use super::source::{Place, Source};
use super::written::ChartText;
use super::{Given, Reading};
use affinor::geometry::chart::{Chart, Fields};
use affinor_tensors::scalar::PositiveFactors;
use affinor_tensors::{Down, Notation, Tensor, Up};

/// Fields by their components in the coordinate frame.
#[derive(Clone, Debug)]
pub(super) struct OnChart {
    pub functions: Functions,
    pub fields: Vec<Given>,
    /// The place of the fields.
    pub place: Place,
}

impl OnChart {
    /// The fields over a scalar.
    pub fn fields<S: Notation>(
        &self,
        labels: &[String],
        reading: &Reading<S>,
    ) -> Result<Fields<S>, InputError> {
        let mut entries = Vec::new();
        for (i, Given { value, place }) in self.fields.iter().enumerate() {
            for (a, value) in value {
                entries.push(([*a, i], reading.value_at(value, place)?));
            }
        }
        let components = Tensor::from_components(labels.len(), &[Up, Down], entries)?;
        let fields = Chart::new(&self.functions.coordinates)?.fields(labels, components);
        fields.map_err(|error| InputError::from(error).at(&self.place))
    }
}

impl ChartText {
    /// The functions, and their positive factors.
    pub fn functions(&self, names: &Names, source: &Source) -> Result<Functions, InputError> {
        let coordinates = self.coordinates.iter().map(|name| name.to_string()).collect();
        let mut functions = Functions { coordinates, positive: PositiveFactors::default() };
        for text in &self.positive {
            let excerpt = source.excerpt(text);
            let names = Names { functions: Some(&functions), ..*names };
            let positive = names.scalar(excerpt.content(), &excerpt)?;
            let declared = functions.positive.declare(&positive);
            declared.map_err(|reason| InputError::usage(reason).at(&source.at(text)))?;
        }
        Ok(functions)
    }
}
