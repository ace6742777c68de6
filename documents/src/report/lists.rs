//! Short lists: the conventions, the catalogue, and the checks of a certificate.

use super::grid::{Cell, Grid, head_of_grid};
use super::{Report, chart_list, head};
use crate::certificate::Check;
use crate::input::InputError;
use affinor::algebra::catalogue::{Family, families};
use affinor::algebra::structure::StructureTheory;
use affinor_tensors::{Symbolic, Tolerance};
use serde_json::{Map, Value, json};

/// The conventions of signs and indices. JSON has the schema `affinor.conventions/1`.
pub fn conventions() -> impl Report {
    let all = affinor::conventions::ALL;
    let rows =
        all.iter().map(|(object, lines)| vec![(*object).into(), Cell::prose(&lines.join("\n"))]);
    let lines: Map<String, Value> =
        all.iter().map(|(object, lines)| (object.to_string(), json!(lines))).collect();
    let json = json!({ "schema": "affinor.conventions/1", "conventions": lines });
    Grid::new("Conventions", &["object", "convention"], rows.collect(), json)
}

/// A report with a title, a header and rows of short cells; `json` is its JSON form.
pub fn listing(
    title: &str,
    header: &[&str],
    rows: Vec<Vec<String>>,
    json: Value,
) -> impl Report + use<> {
    let cells = rows.into_iter().map(|row| row.into_iter().map(Into::into).collect());
    Grid::new(title, header, cells.collect(), json)
}

/// The list of all spaces whose name contains `pattern`, ignoring case; `None` if there are none.
/// JSON has the schema `affinor.list/1`.
pub fn catalogue(pattern: &str) -> Option<impl Report + use<>> {
    let mut rows = vec![
        ["M(3)", "the paper's rotations: plus, metric J", "M3"].map(String::from),
        ["SO(3)", "the paper's other reading: zero, metric 2 delta", "SO3"].map(String::from),
    ];
    let algebra = |family: &Family| [family.pattern, family.summary, family.example];
    rows.extend(families().iter().map(|family| algebra(family).map(String::from)));
    let homogeneous = affinor::geometry::homogeneous::FAMILIES.iter();
    let homogeneous = homogeneous
        .map(|family| [family.pattern, family.summary, family.example].map(String::from));
    rows.extend(homogeneous);
    rows.extend(chart_list::rows());
    let pattern = pattern.to_lowercase();
    rows.retain(|row| row.iter().any(|cell| cell.to_lowercase().contains(&pattern)));
    let entry = |[name, summary, example]: &[String; 3]| json!({ "name": name, "summary": summary, "example": example });
    let entries: Vec<Value> = rows.iter().map(entry).collect();
    let json = json!({ "schema": "affinor.list/1", "spaces": entries });
    let cells = rows.iter().map(|row| row.iter().map(|cell| cell.as_str().into()).collect());
    let header = ["name", "space and basis", "example"];
    (!rows.is_empty()).then(|| {
        Grid::new("Catalogue; + forms direct sums of algebras", &header, cells.collect(), json)
    })
}

/// The list of all algebras of the catalogue that have the properties in a condition, such as
/// `dimension=4, nilpotent, not abelian`, or of all charts, as for `spacetime, Ricci-flat`; `None`
/// if there are none. JSON has the schema `affinor.list/1`.
///
/// # Errors
/// An error for a condition that cannot be parsed.
pub fn catalogue_where(condition: &str) -> Result<Option<Box<dyn Report>>, InputError> {
    let Conditions { dimensions, isometries, properties } = conditions(condition)?;
    if isometries.is_some() || properties.iter().any(|(name, _)| !ALGEBRAS.contains(&&**name)) {
        let dimension = |n| dimensions.as_ref().is_none_or(|wanted| wanted.contains(&n));
        let wanted =
            chart_list::Wanted { dimension: &dimension, isometries, properties: &properties };
        let found = chart_list::charts_where(condition, &wanted)?;
        return Ok(found.map(|list| Box::new(list) as Box<dyn Report>));
    }
    let (mut rows, mut entries) = (vec![], vec![]);
    for name in dimensions.unwrap_or(1..=6).flat_map(affinor::algebra::catalogue::names) {
        let structure =
            StructureTheory::new(affinor::algebra::catalogue::algebra::<Symbolic>(&name)?);
        let holds = |property: &str| match property {
            "abelian" => structure.is_abelian(),
            "nilpotent" => structure.is_nilpotent(),
            "solvable" => structure.is_solvable(),
            "unimodular" => structure.is_unimodular(),
            "perfect" => structure.is_perfect(),
            "reductive" => structure.is_reductive(),
            _ => structure.is_semisimple(),
        };
        if properties.iter().all(|(property, wanted)| holds(property) == *wanted) {
            let words: Vec<&str> = ALGEBRAS.iter().filter(|p| holds(p)).copied().collect();
            let dimension = structure.dimension();
            entries.push(json!({ "name": name, "dimension": dimension, "properties": words }));
            let words = if words.is_empty() { "-".into() } else { words.join(", ") };
            rows.push(vec![name.into(), dimension.to_string().into(), words.into()]);
        }
    }
    let json = json!({ "schema": "affinor.list/1", "where": condition, "spaces": entries });
    let header = ["name", "dimension", "properties"];
    let title = format!("Catalogue: {}", super::head::printable(condition));
    let list = (!rows.is_empty()).then(|| Grid::new(title, &header, rows, json));
    Ok(list.map(|list| Box::new(list) as Box<dyn Report>))
}

/// The properties of algebras that a condition may name.
const ALGEBRAS: [&str; 7] =
    ["abelian", "nilpotent", "solvable", "unimodular", "perfect", "reductive", "semisimple"];
/// The dimensions that a condition may name.
const SEARCHED: std::ops::RangeInclusive<usize> = 1..=10;

/// A condition in its parts.
#[derive(Default)]
struct Conditions {
    dimensions: Option<std::ops::RangeInclusive<usize>>,
    /// The dimension of the algebra of Killing fields.
    isometries: Option<usize>,
    /// Each property, and whether it is required or excluded.
    properties: Vec<(String, bool)>,
}

/// Parses a condition. All properties of a condition belong to algebras, or all to charts.
fn conditions(text: &str) -> Result<Conditions, InputError> {
    let (low, high) = (SEARCHED.start(), SEARCHED.end());
    let refuse = |part: &str| {
        let message = format!("`{}` is not a condition", part.escape_debug());
        let help = format!(
            "write dimension=n with n from {low} to {high}, dimension<=n, isometries=n, or a property with \
             or without `not`: of algebras {}; of charts {}",
            ALGEBRAS.join(", "),
            chart_list::PROPERTIES.join(", ")
        );
        InputError::usage(message).help(help)
    };
    let mut read = Conditions::default();
    for part in text.split(',').map(str::trim) {
        let (name, wanted) =
            part.strip_prefix("not ").map_or((part, true), |rest| (rest.trim(), false));
        let dimension = |text: &str| {
            let n: Option<usize> = text.trim().parse().ok();
            n.filter(|n| SEARCHED.contains(n)).ok_or_else(|| refuse(part))
        };
        let value = part.split_once('=').map(|(key, n)| (key.trim(), n.trim()));
        if let Some(n) = part.strip_prefix("dimension<=") {
            read.dimensions = Some(1..=dimension(n)?);
        } else if let Some(("dimension", n)) = value {
            let n = dimension(n)?;
            read.dimensions = Some(n..=n);
        } else if let Some(("isometries", n)) = value {
            read.isometries = Some(n.parse().map_err(|_| refuse(part))?);
        } else if ALGEBRAS.contains(&name) || chart_list::PROPERTIES.contains(&name) {
            read.properties.push((name.to_string(), wanted));
        } else {
            return Err(refuse(part));
        }
    }
    let of = |known: &[&str]| read.properties.iter().find(|(name, _)| known.contains(&&**name));
    if let (Some((algebra, _)), Some((chart, _))) = (of(&ALGEBRAS), of(&chart_list::PROPERTIES)) {
        let message = format!("`{algebra}` is a property of algebras, but `{chart}` of charts");
        return Err(InputError::usage(message).help("ask for one kind of spaces"));
    }
    Ok(read)
}

/// The report of the checks of a definition with this name. If the checks were made in floats, it
/// contains their tolerance. JSON has the schema `affinor.check/1`.
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
