//! The keys of a problem file; those of its tables are in the files that read them.

use super::body::InertiaKeys;
use super::ensemble::EnsembleKeys;
use super::forces::ForceKeys;
use super::initial::InitialKeys;
use super::integrator::IntegratorKeys;
use super::matrix_flow::FlowKeys;
use super::output::OutputKeys;
use super::prescribed_velocity::PrescribedKeys;
use crate::definition::document::Document;
use crate::definition::written::{Entries, Formulas, MetricText, Number, Text};
use serde::Deserialize;

/// The dotted paths of the keys that only problems on a group have.
pub(super) const OF_GROUPS: [&str; 11] = [
    "space",
    "definition",
    "invariance",
    "prescribed",
    "initial.element",
    "initial.coordinates",
    "initial.quaternion",
    "initial.position",
    "output.columns",
    "quantities",
    "events",
];

/// The dotted paths of the keys that only problems with equations of motion on a group have.
pub(super) const OF_DYNAMICS: [&str; 10] = [
    "metric",
    "inertia",
    "connection",
    "forces",
    "constraints",
    "hamiltonian",
    "initial.velocity",
    "initial.spatial_velocity",
    "initial.momentum",
    "initial.spatial_momentum",
];

/// All keys of a file.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Keys {
    pub name: Option<String>,
    pub space: Option<Text>,
    pub definition: Option<Document>,
    pub metric: Option<MetricText>,
    pub inertia: Option<InertiaKeys>,
    pub connection: Option<Text>,
    pub invariance: Option<Text>,
    pub parameters: Option<Entries<Text, Number>>,
    pub flow: Option<FlowKeys>,
    #[serde(default)]
    pub initial: InitialKeys,
    pub prescribed: Option<PrescribedKeys>,
    pub hamiltonian: Option<Text>,
    pub constraints: Option<Vec<Text>>,
    #[serde(default)]
    pub forces: ForceKeys,
    #[serde(default)]
    pub integrator: IntegratorKeys,
    pub output: OutputKeys,
    pub quantities: Option<Formulas>,
    pub events: Option<Formulas>,
    pub ensemble: Option<EnsembleKeys>,
}
