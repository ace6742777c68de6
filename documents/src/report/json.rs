//! JSON with the schema `affinor.table/1`: one object, with one component per line.

use super::components::append;
use super::factors::{NamedFactor, NamedFactors};
use super::head::{ISOTROPY, kind_name};
use super::{OnChart, OnHomogeneousSpace, Quantity, Table, TableEntry};
use crate::Coefficient;
use affinor_tensors::{CommonFactors, Kind, Up, Variance};
use serde_json::{Value, json};
use std::io::{self, Write};

/// The name of the schema.
const SCHEMA: &str = "affinor.table/1";

pub(super) fn write<S: Coefficient>(table: &Table<S>, out: &mut dyn Write) -> io::Result<()> {
    let algebra = json!({
        "name": table.algebra,
        "dimension": table.labels.len(),
        "basis": table.labels,
        "parameters": table.parameters,
    });
    let mut connection = json!({ "name": table.connection });
    if let Some(lambda) = &table.lambda {
        let mut json = Vec::new();
        append_scalar(&mut json, &mut String::new(), lambda, &CommonFactors::default())?;
        connection["lambda"] = serde_json::from_slice(&json)?;
    }
    let head = [
        ("schema", SCHEMA.into()),
        ("name", table.name.as_str().into()),
        ("algebra", algebra),
        ("connection", connection),
        ("scalar", kind_name(S::KIND).into()),
    ];
    writeln!(out, "{{")?;
    for (key, value) in head {
        writeln!(out, "  \"{key}\": {value},")?;
    }
    if let Some(OnChart { coordinates, fields }) = &table.chart {
        writeln!(out, "  \"chart\": {},", json!({ "coordinates": coordinates, "fields": fields }))?;
    }
    if let Some(OnHomogeneousSpace { embedding, complement }) = &table.homogeneous {
        let json = json!({ "embedding": embedding, "complement": complement });
        writeln!(out, "  \"homogeneous\": {json},")?;
    }
    if !table.point.is_empty() {
        let point = table.point.iter().map(|(name, value)| (name.clone(), Value::from(*value)));
        writeln!(out, "  \"point\": {},", Value::Object(point.collect()))?;
    }
    write!(out, "  \"conventions\": {{")?;
    for (position, (key, text)) in conventions(table).into_iter().enumerate() {
        out.write_all(if position == 0 { b"\n" } else { b",\n" })?;
        write!(out, "    \"{key}\": {}", Value::from(text))?;
    }
    let named = if table.common_factors { table.factors() } else { NamedFactors::default() };
    write!(out, "\n  }},\n")?;
    if !named.lines.is_empty() {
        let line =
            |line: &NamedFactor| format!("\n    \"{}\": {}", line.name, Value::from(&*line.text));
        let lines: Vec<String> = named.lines.iter().map(line).collect();
        writeln!(out, "  \"where\": {{{}\n  }},", lines.join(","))?;
    }
    write!(out, "  \"tensors\": {{")?;
    for (position, entry) in table.tensors.iter().enumerate() {
        out.write_all(if position == 0 { b"\n" } else { b",\n" })?;
        tensor(table, entry, &named.factors, out)?;
    }
    writeln!(out, "\n  }}\n}}")
}

/// The variances of slots as JSON, `["up","down"]`.
pub(super) fn variances(slots: &[Variance]) -> Value {
    slots.iter().map(|slot| if *slot == Up { "up" } else { "down" }).collect()
}

/// Writes one tensor directly, because a tree of JSON values for a million components would use
/// much memory.
fn tensor<S: Coefficient>(
    table: &Table<S>,
    entry: &TableEntry<S>,
    factors: &CommonFactors,
    out: &mut dyn Write,
) -> io::Result<()> {
    let (quantity, shown) = (entry.quantity, table.shown(entry));
    let slots = variances(shown.slots());
    let (key, symbol) = (quantity.key(), quantity.symbol());
    write!(
        out,
        "    \"{key}\": {{\"symbol\": \"{symbol}\", \"indices\": {slots}, \"components\": ["
    )?;
    let numbers: Vec<String> = (1..=shown.dimension()).map(|index| index.to_string()).collect();
    let mut line = Vec::new();
    let mut text = String::new();
    for (position, (at, value)) in shown.components().enumerate() {
        line.clear();
        line.extend_from_slice(if position == 0 { b"\n      [[" } else { b",\n      [[" });
        for (slot, &index) in at.iter().enumerate() {
            line.extend_from_slice(if slot == 0 { b"" } else { b"," });
            line.extend_from_slice(numbers[index].as_bytes());
        }
        line.extend_from_slice(b"],");
        append_scalar(&mut line, &mut text, value, factors)?;
        line.push(b']');
        out.write_all(&line)?;
    }
    out.write_all(if shown.is_empty() { b"]}" } else { b"\n    ]}" })
}

/// The formulas of the basic quantities, and of all tensors in the table.
fn conventions<S: Coefficient>(table: &Table<S>) -> Vec<(&'static str, String)> {
    let mut conventions = vec![("indices", "from 1".into())];
    conventions.push(("frame", table.frame.into()));
    if table.homogeneous.is_some() {
        conventions.push(("isotropy", ISOTROPY.into()));
    }
    conventions.extend(table.zero_line().map(|zero| ("zero", zero)));
    if table.independent {
        conventions.push(("components", "one of each set that is equal by symmetry".into()));
    }
    let shown = |quantity: &Quantity| {
        Quantity::BASIC.contains(quantity)
            || table.tensors.iter().any(|entry| entry.quantity == *quantity)
    };
    let formulas = Quantity::ALL.into_iter().filter(shown);
    conventions.extend(formulas.map(|quantity| (quantity.key(), quantity.definition())));
    conventions
}

/// Appends a value: exact and symbolic values as strings, floats as numbers. `text` is a buffer.
fn append_scalar<S: Coefficient>(
    json: &mut Vec<u8>,
    text: &mut String,
    value: &S,
    factors: &CommonFactors,
) -> io::Result<()> {
    if S::KIND == Kind::Float {
        let number = value.to_f64().filter(|x| x.is_finite()).ok_or_else(|| {
            let message = format!("the value {value} is not finite, so JSON cannot represent it");
            io::Error::new(io::ErrorKind::InvalidData, message)
        })?;
        return Ok(serde_json::to_writer(json, &number)?);
    }
    text.clear();
    if factors.is_empty() {
        append(text, value);
    } else {
        text.push_str(&value.text_with(factors));
    }
    Ok(serde_json::to_writer(json, text.as_str())?)
}
