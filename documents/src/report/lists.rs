//! Short lists: the conventions, the catalogue, and the checks of a certificate.

use super::grid::{Grid, head_of_grid};
use super::{Report, head};
use crate::certificate::Check;
use affinor::algebra::catalogue::families;
use affinor_tensors::Tolerance;
use serde_json::{Map, Value, json};

/// The conventions of signs and indices. JSON has the schema `affinor.conventions/1`.
pub fn conventions() -> impl Report {
    let all = affinor::conventions::ALL;
    let rows = all.iter().map(|(object, lines)| vec![(*object).into(), lines.join("\n").into()]);
    let lines: Map<String, Value> =
        all.iter().map(|(object, lines)| (object.to_string(), json!(lines))).collect();
    let json = json!({ "schema": "affinor.conventions/1", "conventions": lines });
    Grid::new("Conventions", &["object", "convention"], rows.collect(), json)
}

/// The spaces with a name that contain a text, in upper or lower case; none if there is no such space. JSON has the schema
/// `affinor.list/1`.
pub fn catalogue(pattern: &str) -> Option<impl Report + use<>> {
    let mut rows = vec![
        ["M(3)", "the paper's rotations: plus, metric J", "M3"],
        ["SO(3)", "the paper's other reading: zero, metric 2 delta", "SO3"],
    ];
    rows.extend(families().iter().map(|family| [family.pattern, family.summary, family.example]));
    let pattern = pattern.to_lowercase();
    rows.retain(|row| row.iter().any(|cell| cell.to_lowercase().contains(&pattern)));
    let entry = |[name, summary, example]: &[&str; 3]| json!({ "name": name, "summary": summary, "example": example });
    let entries: Vec<Value> = rows.iter().map(entry).collect();
    let json = json!({ "schema": "affinor.list/1", "spaces": entries });
    let cells = rows.iter().map(|row| row.map(Into::into).to_vec()).collect();
    let header = ["name", "space and basis", "example"];
    (!rows.is_empty()).then(|| Grid::new("Catalogue; + forms direct sums", &header, cells, json))
}

/// The checks of a definition of this name, with their tolerance if they were made in floats. JSON has the schema
/// `affinor.check/1`.
pub fn certificate(
    name: &str,
    checks: &[Check],
    tolerance: Option<Tolerance>,
) -> impl Report + use<> {
    let zero = tolerance.map(head::zero);
    let rows = checks.iter().map(|check| {
        let verdict = if check.ok { "ok" } else { "FAILS" };
        vec![check.name.into(), verdict.into(), check.detail.as_str().into()]
    });
    let object = |check: &Check| {
        let mut object = json!({ "name": check.name, "ok": check.ok, "detail": check.detail });
        if let Some(witness) = &check.witness {
            object["witness"] = json!({ "indices": witness.indices, "residual": witness.residual });
        }
        object
    };
    let json = json!({
        "schema": "affinor.check/1",
        "name": name,
        "ok": checks.iter().all(|check| check.ok),
        "conventions": head::conventions_in_json(zero.as_deref()),
        "checks": checks.iter().map(object).collect::<Vec<_>>(),
    });
    let name: String = name.chars().flat_map(char::escape_debug).collect();
    Grid::new(
        format!("Certificate of {name}"),
        &["check", "verdict", "detail"],
        rows.collect(),
        json,
    )
    .with_head(head_of_grid(zero.as_deref()))
}
