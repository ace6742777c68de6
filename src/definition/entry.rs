//! Definitions that are not written down: catalogue entries, their sums, the paper's geometries.

use super::input::{InputError, Place, Source};
use super::{ConnectionChoice, Definition, Given, MetricChoice, Origin, check_dimension};
use crate::Canonical;
use crate::catalogue::{self, Entry};
use affinor_tensors::Symbolic;
use std::collections::BTreeMap;

impl Definition {
    /// A catalogue entry.
    pub fn from_entry(entry: Entry) -> Self {
        let place = Place::within(Source::new(&entry.name, ""));
        let mut given = BTreeMap::new();
        for (j, k, i, value) in entry.constants {
            let pair = given
                .entry((j, k))
                .or_insert_with(|| Given { value: BTreeMap::new(), place: place.clone() });
            pair.value.insert(i, value);
        }
        Definition {
            name: entry.name,
            algebra_name: None,
            labels: entry.labels,
            origin: Origin::Brackets(given),
            metric: None,
            connection: None,
            declared: vec![],
            source: None,
        }
    }

    /// M(3): the rotation group with the connection (29), `plus`, and the inertia `J` as its
    /// left-invariant metric (99); equations (41)-(61) and section 5 of the paper.
    ///
    /// # Errors
    /// None that a valid catalogue causes.
    pub fn m3() -> Result<Self, InputError> {
        let inertia = (0..3).flat_map(|i| (0..3).map(move |j| [i, j]));
        let inertia = inertia.map(|[i, j]| {
            let (row, column) = (i.min(j) + 1, i.max(j) + 1);
            ([i, j], Symbolic::parameter(&format!("J{row}{column}")))
        });
        let place = Place::within(Source::new("M(3)", ""));
        let metric = MetricChoice::Components(inertia.collect(), place);
        Self::rotations("M(3)", Canonical::Plus, |_| Some(metric))
    }

    /// "SO(3)" as the paper sees it: the rotation group with the connection (31), `zero`, and the
    /// bi-invariant metric `tr(A^T B)` of (102); equations (62)-(71).
    ///
    /// # Errors
    /// None that a valid catalogue causes.
    pub fn so3() -> Result<Self, InputError> {
        Self::rotations("SO(3)", Canonical::Zero, |entry| {
            let product = entry.matrices.as_ref()?.frobenius();
            Some(MetricChoice::Given(product.map(|value| Symbolic::constant(value.clone()))))
        })
    }

    fn rotations(
        name: &str,
        connection: Canonical,
        metric: impl FnOnce(&Entry) -> Option<MetricChoice>,
    ) -> Result<Self, InputError> {
        let entry =
            catalogue::find("so(3)").map_err(|error| InputError::usage(error.to_string()))?;
        let metric = metric(&entry);
        let place = Place::within(Source::new(name, ""));
        let connection = Some((ConnectionChoice::Canonical(connection), place));
        let (name, algebra_name) = (name.into(), Some(entry.name.clone()));
        Ok(Definition { name, algebra_name, metric, connection, ..Self::from_entry(entry) })
    }

    /// The direct sum of two algebras; the second basis stands behind the first.
    ///
    /// # Errors
    /// When the dimension of the sum is beyond the engine.
    pub(super) fn direct_sum(self, other: Self) -> Result<Self, InputError> {
        let n = self.dimension();
        check_dimension(n + other.dimension())?;
        let labels = crate::algebra::join_labels(&self.labels, &other.labels);
        let (Origin::Brackets(mut given), Origin::Brackets(theirs)) = (self.origin, other.origin)
        else {
            return Err(InputError::usage("only brackets add up"));
        };
        for ((j, k), Given { value, place }) in theirs {
            let value = value.into_iter().map(|(i, value)| (i + n, value)).collect();
            given.insert((j + n, k + n), Given { value, place });
        }
        Ok(Definition {
            name: format!("{} + {}", self.name, other.name),
            algebra_name: None,
            labels,
            origin: Origin::Brackets(given),
            metric: None,
            connection: None,
            declared: vec![],
            source: None,
        })
    }
}
