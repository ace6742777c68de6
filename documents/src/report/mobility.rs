//! The mobility of a mechanism, with witnesses and proofs.

use super::grid::{Cell, Grid};
use super::head::{printable, printable_list};
use super::{Format, Report};
use crate::Coefficient;
use crate::input::InputError;
use crate::mechanism::MechanismFile;
use affinor::mechanism::positions::Position;
use affinor::mechanism::{Mechanism, Mobility, Reason};
use affinor_tensors::{Kind, Rational, Symbolic};
use serde_json::{Value, json};
use std::io::{self, Write};

/// The name of the schema.
const SCHEMA: &str = "affinor.mobility/1";
/// The number of other positions that are tried.
const TRIALS: usize = 8;
/// The size of the displacements to other positions.
const REACH: f64 = 0.4;
/// The number of characters above which a value is written in JSON only.
const LONGEST: usize = 300;

/// The mobility of a mechanism, ready for output.
#[derive(Clone, Debug)]
pub struct MobilityReport(Grid);

impl MobilityReport {
    /// Determines the mobility of a mechanism.
    ///
    /// # Errors
    /// Those of [`Mechanism::mobility`].
    pub fn of(file: &MechanismFile) -> Result<Self, InputError> {
        match file.kind() {
            Kind::Exact => Self::over::<Rational>(file),
            _ => Self::over::<Symbolic>(file),
        }
    }

    fn over<S: Coefficient>(file: &MechanismFile) -> Result<Self, InputError> {
        let mechanism = file.mechanism.map(S::read)?;
        let mobility = mechanism.mobility()?;
        let positions = match file.parameters.is_empty() {
            true => file.mechanism.map(f64::read)?.positions(TRIALS, REACH),
            false => vec![],
        };
        Ok(MobilityReport(grid(file, &mechanism, &mobility, &positions)))
    }
}

/// The names of the joint coordinates: joints, with numbers if a joint has several.
fn coordinate_names<S>(mechanism: &Mechanism<S>) -> Vec<String> {
    let names = mechanism.joints().iter().flat_map(|joint| {
        let count = joint.freedom();
        (1..=count).map(move |k| match count {
            1 => joint.name.clone(),
            _ => format!("{}.{k}", joint.name),
        })
    });
    names.collect()
}

/// A proof in words.
fn in_words(reason: &Reason) -> String {
    match reason {
        Reason::NoRates => "the rates vanish, because the joint screws are independent".into(),
        Reason::Independent(dimensions) => {
            let list: Vec<String> = dimensions.iter().map(usize::to_string).collect();
            format!(
                "the closure equations are independent in subgroups of dimension {}",
                list.join(", ")
            )
        }
        Reason::Division(found) => format!(
            "the loop is two chains that reach subgroups of dimension {} and {}, whose \
             intersection has dimension {}",
            found.dimensions[0], found.dimensions[1], found.common
        ),
        Reason::Symmetry(found) => {
            let order = if found.reverses { "reverses" } else { "shifts" };
            format!(
                "symmetry: a {} {order} the loop; {} symmetric coordinates satisfy {} independent \
                 equations",
                found.involution.name(),
                found.coordinates,
                found.equations
            )
        }
        Reason::Curve(degree) => format!(
            "coordinates that are rational functions of degree {degree} satisfy the closure \
             equations identically"
        ),
        Reason::Obstructed(order) => format!("order {order} of the closure equations obstructs"),
        Reason::Rates(count) => format!("at most the {count}-dimensional space of rates"),
    }
}

fn grid<S: Coefficient>(
    file: &MechanismFile,
    mechanism: &Mechanism<S>,
    mobility: &Mobility<S>,
    positions: &[Position],
) -> Grid {
    let names = coordinate_names(mechanism);
    let mut rows: Vec<Vec<Cell>> = vec![];
    let mut row = |notion: &str, value: String, remark: String| {
        let value = match value.chars().count() {
            0..=LONGEST => value,
            _ => "in --format json".into(),
        };
        rows.push(vec![notion.into(), value.into(), remark.into()]);
    };
    let loops = mechanism.loops().len();
    let verdict = &mobility.verdict;
    let value = match verdict.exact() {
        Some(exact) => exact.to_string(),
        None => format!("{} to {}", verdict.lower, verdict.upper),
    };
    let generic = if file.parameters.is_empty() { "proved" } else { "for generic parameters" };
    row("mobility", value, generic.into());
    for reason in &verdict.reasons {
        row("proof", in_words(reason), String::new());
    }
    row(
        "count",
        mechanism.kutzbach().to_string(),
        format!("Gruebler-Kutzbach: {} - 6*{loops}", mechanism.freedom()),
    );
    row(
        "first order",
        match mobility.rates.len() {
            1 => "1 rate".into(),
            count => format!("{count} independent rates"),
        },
        format!("rank {} of {} equations", mobility.rank, mobility.equations),
    );
    for rates in &mobility.rates {
        let terms = rates.iter().map(|value| value.to_string());
        row("rates", terms.collect::<Vec<_>>().join(", "), "witness".into());
    }
    if mobility.rates.len() > 1
        && let Some(form) = mobility.forms.iter().find(|form| !vanishes(form))
    {
        let entries = form.iter().map(|row| {
            let row: Vec<String> = row.iter().map(S::to_string).collect();
            format!("[{}]", row.join(", "))
        });
        let remark = "form whose zeros continue to order 2";
        row("second order", entries.collect::<Vec<_>>().join("\n"), remark.into());
    }
    if mobility.tested > 1 {
        let value = format!("no obstruction to order {}", mobility.tested);
        row("higher order", value, "of the closure equations".into());
    }
    let redundant = mobility.equations - mobility.rank;
    row("redundant", redundant.to_string(), "equations that follow from the others".into());
    let determined = mobility.determined(mechanism);
    let undetermined: Vec<String> = mechanism
        .joints()
        .iter()
        .zip(&determined)
        .filter(|(_, determined)| !**determined)
        .map(|(joint, _)| printable(&joint.name))
        .collect();
    if !undetermined.is_empty() {
        row("undetermined", undetermined.join(", "), "reactions of these joints".into());
    }
    let idle: Vec<String> = mobility.idle().into_iter().map(|at| printable(&names[at])).collect();
    if !idle.is_empty() {
        row("idle", idle.join(", "), "joint coordinates at rest".into());
    }
    if let Some(sampled) = sampled(positions) {
        let gap = positions.iter().map(|position| position.gap).fold(f64::INFINITY, f64::min);
        row(
            "nearby",
            sampled,
            format!("rates at {} other positions in floats, gap {gap:.0e}", positions.len()),
        );
    }
    let head: Vec<(&'static str, Cell)> = vec![
        ("bodies", printable_list(mechanism.bodies()).into()),
        ("coordinates", printable_list(&names).into()),
    ];
    let title = format!("Mobility of {}", printable(&file.name));
    let json = document(file, mechanism, mobility, positions, &names, &determined);
    Grid::new(title, &["notion", "value", "remark"], rows, json).with_head(head)
}

fn vanishes<S: Coefficient>(form: &[Vec<S>]) -> bool {
    form.iter().flatten().all(S::vanishes)
}

/// The different numbers of rates at other positions; `None` for an empty list.
fn sampled(positions: &[Position]) -> Option<String> {
    let mut counts: Vec<usize> = positions.iter().map(|position| position.rates).collect();
    counts.sort_unstable();
    counts.dedup();
    let counts: Vec<String> = counts.iter().map(usize::to_string).collect();
    (!counts.is_empty()).then(|| counts.join(", "))
}

/// The report in JSON.
fn document<S: Coefficient>(
    file: &MechanismFile,
    mechanism: &Mechanism<S>,
    mobility: &Mobility<S>,
    positions: &[Position],
    names: &[String],
    determined: &[bool],
) -> Value {
    let texts = |values: &[S]| values.iter().map(S::to_string).collect::<Vec<_>>();
    let list = |rows: &[Vec<S>]| rows.iter().map(|row| texts(row)).collect::<Vec<_>>();
    let verdict = &mobility.verdict;
    let joints = mechanism.joints().iter().zip(determined).map(|(joint, determined)| {
        let bodies = joint.bodies.map(|at| &mechanism.bodies()[at]);
        json!({
            "name": joint.name,
            "type": joint.kind().name(),
            "bodies": bodies,
            "determined": determined,
        })
    });
    let loops = mechanism.loops().iter().zip(&mobility.subgroups).map(|(own, dimension)| {
        let joints = own.joints.iter().map(|(at, _)| &mechanism.joints()[*at].name);
        json!({ "joints": joints.collect::<Vec<_>>(), "subgroup": dimension })
    });
    let curve = mobility.curve.as_ref().map(|curve| {
        let quotients = curve.coordinates.iter();
        quotients.map(|quotient| quotient.each_ref().map(|part| texts(part))).collect::<Vec<_>>()
    });
    let positions = positions.iter().map(|position| {
        json!({
            "coordinates": position.coordinates.as_slice(),
            "rates": position.rates,
            "gap": position.gap,
        })
    });
    json!({
        "schema": SCHEMA,
        "name": file.name,
        "parameters": file.parameters,
        "bodies": mechanism.bodies(),
        "coordinates": names,
        "joints": joints.collect::<Vec<_>>(),
        "loops": loops.collect::<Vec<_>>(),
        "mobility": verdict.exact(),
        "lower": verdict.lower,
        "upper": verdict.upper,
        "proofs": verdict.reasons.iter().map(in_words).collect::<Vec<_>>(),
        "kutzbach": mechanism.kutzbach(),
        "equations": mobility.equations,
        "rank": mobility.rank,
        "rates": list(&mobility.rates),
        "relations": list(&mobility.relations),
        "forms": mobility.forms.iter().map(|form| list(form)).collect::<Vec<_>>(),
        "tested_order": mobility.tested,
        "curve": curve,
        "idle": mobility.idle().into_iter().map(|at| &names[at]).collect::<Vec<_>>(),
        "positions": positions.collect::<Vec<_>>(),
    })
}

impl Report for MobilityReport {
    fn write(&self, format: Format, out: &mut dyn Write) -> io::Result<()> {
        self.0.write(format, out)
    }
}
