//! Markdown as rendered by GitHub: a heading and a table for every tensor.

use super::components::{GROUPED, groups_with, plain, summary, with_names};
use super::head::{conventions, printable};
use super::text::{brackets, general, named};
use super::{Quantity, Table, TableEntry};
use crate::Coefficient;
use affinor_tensors::CommonFactors;
use std::io::{self, Write};

pub(super) fn write<S: Coefficient>(table: &Table<S>, out: &mut dyn Write) -> io::Result<()> {
    writeln!(out, "# {}\n", escape(&printable(&table.name)))?;
    for (title, line) in table.head() {
        writeln!(out, "- {title}: {}", escape(&line))?;
    }
    writeln!(out, "- conventions: `{}`", conventions().replace("; ", "`, `"))?;
    let named = table.factors();
    for line in &named.lines {
        writeln!(out, "- where `{}` = `{}`", line.is().join("` = `"), line.text)?;
    }
    table.tensors.iter().try_for_each(|entry| tensor(table, entry, &named.factors, out))
}

fn tensor<S: Coefficient>(
    table: &Table<S>,
    entry: &TableEntry<S>,
    factors: &CommonFactors,
    out: &mut dyn Write,
) -> io::Result<()> {
    let shown = table.shown(entry);
    let names = table.index_names.as_deref();
    let name = |at: &[usize]| named(entry.quantity.symbol(), &shown, at, names);
    writeln!(out, "\n## {}\n", table.title(entry.quantity))?;
    if shown.is_empty() {
        return writeln!(out, "`{} = 0`", general(entry.quantity, &shown));
    }
    let grouped = shown.len() <= GROUPED;
    if grouped && entry.quantity == Quantity::Structure {
        let labels: Vec<String> = table.labels.iter().map(|label| printable(label)).collect();
        for (left, right) in brackets(&entry.tensor, &labels, plain) {
            writeln!(out, "- `{left} = {right}`")?;
        }
        writeln!(out)?;
    }
    writeln!(out, "| component | value |\n| --- | --- |")?;
    if grouped {
        for group in groups_with(&shown, factors) {
            let members = group.names(name).join("` = `");
            writeln!(out, "| `{members}` | `{}` |", with_names(&group.value, factors))?;
        }
    } else {
        for (at, value) in shown.components() {
            writeln!(out, "| `{}` | `{}` |", name(&at), with_names(value, factors))?;
        }
    }
    summary(&entry.tensor, &shown).map_or(Ok(()), |summary| writeln!(out, "\n{summary}"))
}

/// Escapes all markup characters.
fn escape(text: &str) -> String {
    escaped(text, "\\`*_[]<>#|^~$&")
}

/// Puts a backslash before each of the `special` characters.
pub(super) fn escaped(text: &str, special: &str) -> String {
    let mut escaped = String::with_capacity(text.len());
    for c in text.chars() {
        if special.contains(c) {
            escaped.push('\\');
        }
        escaped.push(c);
    }
    escaped
}
