//! The reading of an input: the space, its letters, and the assumptions.

use super::{Answer, Refusal};
use affinor::Metric;
use affinor::algebra::catalogue::families;
use affinor_documents::over_kind;
use affinor_documents::space::{
    NamedChart, ScalarChoice, Space, Typed, notations, proper_names, typed,
};
use affinor_tensors::Tolerance;
use serde_json::{Value, json};

/// The largest dimension at which the Killing form is tried as a metric.
const KILLING: usize = 80;
/// The largest dimension of a metric that the page shows as a grid.
const GRID: usize = 8;

/// The reading of an input: schema `affinor.reading/1`.
///
/// # Errors
/// Those of the input; brackets that violate the Jacobi identity.
pub(super) fn reading(input: &str, space: &Space) -> Result<Answer, Refusal> {
    let definition = &space.definition;
    let (kind, notation) = match typed(input) {
        Ok((_, Typed::Table(notation))) => ("table", Some(notation)),
        _ if definition.is_on_chart() => ("chart", None),
        Ok((_, Typed::Keys)) => ("keys", None),
        _ => ("name", None),
    };
    let mut notes: Vec<String> = definition.notes().to_vec();
    if ["M(3)", "SO(3)"].contains(&definition.name.as_str()) {
        notes.push(format!(
            "{} is a geometry of the paper on the rotation group: its connection and its metric \
             are set. The algebra alone is so(3).",
            definition.name
        ));
    }
    let large = definition.dimension() > GRID;
    let (metric, connection, killing, frame) = over_kind!(space.kind(ScalarChoice::Exact)?, S => {
        let geometry = definition.geometry::<S>(Tolerance::default())?;
        let n = definition.dimension();
        let rows = |metric: &Metric<S>| -> Vec<Vec<String>> {
            let entry = |i, j| metric.components().get(&[i, j]).to_string();
            (0..n).map(|i| (0..n).map(|j| entry(i, j)).collect()).collect()
        };
        let metric = geometry.metric().filter(|_| !large).map(rows);
        let killing = match geometry.algebra() {
            Some(algebra) if n <= KILLING => {
                Metric::new(algebra.labels(), algebra.killing_form()).is_ok()
            }
            _ => false,
        };
        (metric, geometry.connection_name().to_string(), killing, geometry.frame_name())
    });
    let name = match kind {
        "table" => "your algebra",
        _ => &definition.name,
    };
    let json = json!({
        "schema": "affinor.reading/1",
        "name": name,
        "dimension": definition.dimension(),
        "kind": kind,
        "notation": notation,
        "basis": definition.labels,
        "parameters": definition.parameters(),
        "coordinates": definition.coordinates(),
        "introduced": space.introduced,
        "has_metric": definition.has_metric(),
        "connection_is_default": definition.connection_is_default(),
        "connection": connection,
        "metric": metric,
        "killing": killing,
        "frame": frame,
        "notes": notes,
    });
    written(&json)
}

/// Names for the completion of the input: schema `affinor.names/1`.
///
/// # Errors
/// None, because a list of names is short.
pub(super) fn names() -> Result<Answer, Refusal> {
    let mut spaces = proper_names();
    spaces.extend(families().iter().map(|family| family.example));
    written(&json!({
        "schema": "affinor.names/1",
        "spaces": spaces,
        "charts": NamedChart::all().map(NamedChart::name).collect::<Vec<_>>(),
        "notations": notations(),
    }))
}

/// The answer that consists of JSON.
pub(super) fn written(json: &Value) -> Result<Answer, Refusal> {
    Answer::written(vec![], |out| out.write_all(json.to_string().as_bytes()))
}
