//! The keys of a problem file.

use super::body::InertiaKeys;
use super::ensemble::EnsembleKeys;
use super::forces::ForceKeys;
use super::initial::InitialKeys;
#[cfg(feature = "mechanisms")]
use super::joint_keys::{BodyKeys, ContactKeys, JointKeys, SpringKeys};
use crate::input::forms::{
    Entries, Formulas, MetricText, Number, OneOrEach, OneOrMore, Text, VectorText,
};
use crate::space::document::Document;
use serde::Deserialize;

/// The dotted paths of the keys that are allowed only in problems on a group.
pub(super) const OF_GROUPS: [&str; 13] = [
    "space",
    "definition",
    "invariance",
    "prescribed",
    "initial.element",
    "initial.restore",
    "initial.coordinates",
    "initial.quaternion",
    "initial.position",
    "initial.parts",
    "output.columns",
    "quantities",
    "events",
];

/// The dotted paths of the keys that are allowed only in problems with equations of motion on a
/// group.
pub(super) const OF_DYNAMICS: [&str; 11] = [
    "metric",
    "inertia",
    "connection",
    "forces",
    "constraints",
    "velocity_constraints",
    "hamiltonian",
    "initial.velocity",
    "initial.spatial_velocity",
    "initial.momentum",
    "initial.spatial_momentum",
];

/// The dotted paths of the keys that are allowed only in problems on a chart.
pub(super) const OF_CHARTS: [&str; 9] = [
    "killing",
    "embedding",
    "initial.normalize",
    "initial.solve",
    "initial.root",
    "forces.mass",
    "forces.charge",
    "forces.A",
    "forces.F",
];

/// The dotted paths of the keys that are not allowed in problems on a chart.
pub(super) const NOT_ON_CHARTS: [&str; 22] = [
    "transport",
    "invariance",
    "inertia",
    "prescribed",
    "hamiltonian",
    "constraints",
    "velocity_constraints",
    "initial.element",
    "initial.restore",
    "initial.coordinates",
    "initial.quaternion",
    "initial.parts",
    "initial.spatial_velocity",
    "initial.momentum",
    "initial.spatial_momentum",
    "integrator.absolute_tolerance",
    "forces.body",
    "forces.spatial",
    "forces.table",
    "forces.table_in",
    "forces.columns",
    "forces.interpolation",
];

/// The dotted paths of the keys that are allowed only in joint coordinates.
#[cfg(feature = "mechanisms")]
pub(super) const OF_TREES: [&str; 2] = ["springs", "contacts"];

/// The dotted paths of the keys of constraints that are formulas.
#[cfg(feature = "mechanisms")]
pub(super) const OF_CONSTRAINTS: [&str; 2] = ["constraints", "velocity_constraints"];

/// The dotted paths of the keys that are not allowed in problems with bodies and joints. The keys of
/// [`OF_CHARTS`] and [`OF_HOMOGENEOUS`] are not allowed either.
#[cfg(feature = "mechanisms")]
pub(super) const NOT_WITH_BODIES: [&str; 18] = [
    "space",
    "definition",
    "invariance",
    "metric",
    "inertia",
    "connection",
    "prescribed",
    "hamiltonian",
    "flow",
    "initial.element",
    "initial.restore",
    "initial.coordinates",
    "initial.quaternion",
    "initial.position",
    "initial.parts",
    "initial.spatial_velocity",
    "initial.momentum",
    "initial.spatial_momentum",
];

/// The dotted paths of the keys that are allowed only in problems on a homogeneous space.
pub(super) const OF_HOMOGENEOUS: [&str; 1] = ["transport"];

/// The dotted paths of the keys that are not allowed in problems on a homogeneous space.
pub(super) const NOT_ON_HOMOGENEOUS: [&str; 12] = [
    "invariance",
    "inertia",
    "prescribed",
    "hamiltonian",
    "constraints",
    "velocity_constraints",
    "forces",
    "killing",
    "embedding",
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
    #[cfg(feature = "mechanisms")]
    pub urdf: Option<Text>,
    #[cfg(feature = "mechanisms")]
    pub bodies: Option<Vec<BodyKeys>>,
    #[cfg(feature = "mechanisms")]
    pub joints: Option<Vec<JointKeys>>,
    #[cfg(feature = "mechanisms")]
    pub springs: Option<Vec<SpringKeys>>,
    #[cfg(feature = "mechanisms")]
    pub contacts: Option<Vec<ContactKeys>>,
    #[cfg(feature = "mechanisms")]
    pub gravity: Option<Vec<Number>>,
    #[cfg(feature = "mechanisms")]
    pub coordinates: Option<Text>,
    pub metric: Option<MetricText>,
    pub inertia: Option<OneOrEach<InertiaKeys>>,
    pub connection: Option<Text>,
    pub invariance: Option<Text>,
    pub parameters: Option<Entries<Text, Number>>,
    pub flow: Option<FlowKeys>,
    #[serde(default)]
    pub initial: InitialKeys,
    pub prescribed: Option<PrescribedKeys>,
    pub hamiltonian: Option<Text>,
    pub constraints: Option<Vec<Text>>,
    #[cfg(feature = "mechanisms")]
    pub velocity_constraints: Option<Vec<Text>>,
    #[serde(default)]
    pub forces: ForceKeys,
    #[serde(default)]
    pub integrator: IntegratorKeys,
    /// Motions need this table, but not trees.
    pub output: Option<OutputKeys>,
    #[serde(default)]
    pub killing: KillingKeys,
    pub embedding: Option<Vec<Text>>,
    pub transport: Option<Entries<Text, VectorText>>,
    pub quantities: Option<Formulas>,
    pub events: Option<Formulas>,
    pub ensemble: Option<EnsembleKeys>,
}

/// The table `[integrator]`.
#[derive(Deserialize, Default)]
#[serde(deny_unknown_fields)]
pub(super) struct IntegratorKeys {
    pub method: Option<Text>,
    pub step: Option<Number>,
    pub tolerance: Option<Number>,
    pub absolute_tolerance: Option<OneOrMore>,
    pub max_step: Option<Number>,
    pub max_steps: Option<usize>,
}

/// The table `[flow]`: an isospectral flow of matrices.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct FlowKeys {
    pub kind: Text,
    pub positions: Option<Vec<Number>>,
    pub momenta: Option<Vec<Number>>,
    pub masses: Option<Vec<Number>>,
    pub momentum: Option<Vec<Vec<Number>>>,
    pub size: Option<usize>,
    pub modes: Option<Vec<Vec<Number>>>,
    pub seed: Option<u64>,
    pub degree: Option<usize>,
}

/// The table `[output]`.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct OutputKeys {
    pub end: Option<Number>,
    pub every: Option<Number>,
    pub times: Option<Vec<Number>>,
    pub columns: Option<Vec<Text>>,
    pub stop: Option<Text>,
    pub section: Option<Text>,
}

/// The table `[killing]`: Killing fields and Killing tensors of a chart.
#[derive(Deserialize, Default)]
#[serde(deny_unknown_fields)]
pub(super) struct KillingKeys {
    pub fields: Option<Formulas>,
    pub tensors: Option<Entries<Text, MetricText>>,
}

/// The table `[prescribed]`: a prescribed velocity.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct PrescribedKeys {
    pub velocity: Option<Vec<Number>>,
    pub spatial_velocity: Option<Vec<Number>>,
}

impl Keys {
    /// The formulas of the constraints on the velocity.
    pub fn velocity_constraints(&self) -> &[Text] {
        #[cfg(feature = "mechanisms")]
        return self.velocity_constraints.as_deref().unwrap_or(&[]);
        #[cfg(not(feature = "mechanisms"))]
        &[]
    }
}
