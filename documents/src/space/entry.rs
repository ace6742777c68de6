//! Definitions of named spaces: catalogue entries, their direct sums, and the geometries of
//! Paraskevopoulos and Natsiavas (2013).

use crate::Coefficient;
use crate::input::{InputError, Place, Source};
use crate::space::{ConnectionChoice, Definition, Given, MetricChoice, Origin, check_dimension};
use affinor::algebra::catalogue::{self, Entry};
use affinor::{ConnectionKind, Geometry};
use affinor_tensors::Symbolic;
use std::collections::BTreeMap;

impl Definition {
    /// The definition of a catalogue entry.
    pub fn from_entry(entry: Entry) -> Self {
        let place = Place::within(Source::new(&entry.name, ""));
        let mut given = BTreeMap::new();
        for (j, k, i, value) in entry.constants {
            let pair = given
                .entry((j, k))
                .or_insert_with(|| Given { value: BTreeMap::new(), place: place.clone() });
            pair.value.insert(i, value);
        }
        Definition::new(entry.name, entry.labels, Origin::Brackets(given))
    }

    /// The direct sum of copies of a catalogue algebra.
    #[cfg(feature = "mechanisms")]
    pub(crate) fn copies(name: &str, count: usize) -> Result<Self, InputError> {
        let entry = catalogue::find(name).map_err(|error| InputError::usage(error.to_string()))?;
        let one = Self::from_entry(entry);
        (1..count).try_fold(one.clone(), |sum, _| sum.direct_sum(one.clone()))
    }

    /// The definition of a geometry of Paraskevopoulos and Natsiavas (2013),
    /// [`paper::m3`](super::paper::m3) or [`paper::so3`](super::paper::so3). `exact` converts its
    /// values.
    ///
    /// # Errors
    /// An error if the catalogue does not contain its algebra.
    pub fn of_paper<S: Coefficient>(
        geometry: &Geometry<S>,
        exact: impl Fn(&S) -> Symbolic,
    ) -> Result<Self, InputError> {
        let entry = catalogue::find(geometry.algebra_name());
        let entry = entry.map_err(|error| InputError::usage(error.to_string()))?;
        let place = Place::within(Source::new(geometry.name(), ""));
        let components = geometry.metric().map(|metric| {
            let entries = metric.components().components();
            entries.map(|(at, value)| ([at[0], at[1]], exact(value))).collect()
        });
        let connection = match geometry.kind() {
            ConnectionKind::Canonical(which) => Some((ConnectionChoice::Canonical(*which), place)),
            _ => None,
        };
        Ok(Definition {
            name: geometry.name().into(),
            algebra_name: Some(entry.name.clone()),
            metric: components.map(|components| MetricChoice::Components(components, None)),
            connection,
            ..Self::from_entry(entry)
        })
    }

    /// The direct sum of two algebras. The basis of the second follows the basis of the first.
    pub(super) fn direct_sum(self, other: Self) -> Result<Self, InputError> {
        let n = self.dimension();
        check_dimension(n + other.dimension())?;
        let labels = affinor::algebra::join_labels(&self.labels, &other.labels);
        let (Origin::Brackets(mut given), Origin::Brackets(theirs)) = (self.origin, other.origin)
        else {
            let message = "the summands of a direct sum must be given by brackets";
            return Err(InputError::usage(message));
        };
        for ((j, k), Given { value, place }) in theirs {
            let value = value.into_iter().map(|(i, value)| (i + n, value)).collect();
            given.insert((j + n, k + n), Given { value, place });
        }
        let name = format!("{} + {}", self.name, other.name);
        Ok(Definition::new(name, labels, Origin::Brackets(given)))
    }
}
