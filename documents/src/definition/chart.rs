//! Charts in definitions: coordinates, and fields whose components are functions of them.

use super::input::InputError;
use super::source::Place;
use super::{Given, Reading};
use affinor::geometry::chart::{Chart, Fields};
use affinor_tensors::{Down, Notation, Tensor, Up};

/// Coordinates, and fields by their components in the coordinate frame.
#[derive(Clone, Debug)]
pub(super) struct OnChart {
    pub coordinates: Vec<String>,
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
        let fields = Chart::new(&self.coordinates)?.fields(labels, components);
        fields.map_err(|error| InputError::from(error).at(&self.place))
    }
}
