//! The keys of a problem file.

use crate::definition::document::Document;
use crate::definition::written::{
    Entries, Formulas, MetricText, Number, OneOrMore, PointText, Text,
};
use serde::Deserialize;

/// The dotted paths of the keys that only problems on a group have.
pub(super) const OF_GROUPS: [&str; 11] = [
    "space",
    "definition",
    "invariance",
    "given",
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
    "initial.space_velocity",
    "initial.momentum",
    "initial.space_momentum",
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
    pub given: Option<GivenKeys>,
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

/// The table `[given]`: a velocity over time.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct GivenKeys {
    pub velocity: Option<Vec<Number>>,
    pub space_velocity: Option<Vec<Number>>,
}

/// The table `[initial]`: the initial condition.
#[derive(Deserialize, Default)]
#[serde(deny_unknown_fields)]
pub(super) struct InitialKeys {
    pub time: Option<Number>,
    pub element: Option<Vec<Vec<Number>>>,
    pub coordinates: Option<Vec<Number>>,
    pub quaternion: Option<Vec<Number>>,
    pub position: Option<Vec<Number>>,
    pub velocity: Option<Vec<Number>>,
    pub space_velocity: Option<Vec<Number>>,
    pub momentum: Option<Vec<Number>>,
    pub space_momentum: Option<Vec<Number>>,
}

/// The table `[forces]`.
#[derive(Deserialize, Default)]
#[serde(deny_unknown_fields)]
pub(super) struct ForceKeys {
    pub body: Option<Vec<Number>>,
    pub space: Option<Vec<Number>>,
    pub potential: Option<Text>,
    pub table: Option<Text>,
    pub table_in: Option<Text>,
    pub interpolation: Option<Text>,
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

/// The table `[ensemble]`.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct EnsembleKeys {
    pub grid: Option<Formulas>,
    pub random: Option<Formulas>,
    pub samples: Option<u64>,
    pub seed: Option<u64>,
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

/// The table `[inertia]`: a rigid body.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct InertiaKeys {
    pub about: Option<PointText>,
    pub parts: Option<Vec<PartKeys>>,
    pub moments: Option<Vec<Number>>,
    pub matrix: Option<Vec<Vec<Number>>>,
}

/// A part of a body.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct PartKeys {
    pub shape: Option<Text>,
    pub mesh: Option<Text>,
    pub edges: Option<Vec<Number>>,
    pub half_axes: Option<Vec<Number>>,
    pub radius: Option<Number>,
    pub height: Option<Number>,
    pub length: Option<Number>,
    pub points: Option<Vec<Vec<Number>>>,
    pub mass: Option<Number>,
    pub density: Option<Number>,
    pub at: Option<Vec<Number>>,
    pub turn: Option<Vec<Number>>,
    #[serde(default)]
    pub hole: bool,
}
