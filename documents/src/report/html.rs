//! Pages of HTML, with formulas in MathML.

use super::components::{GROUPED, groups_with, summary, with_names};
use super::head::printable;
use super::text::named;
use super::typeset::{brackets, convention_formulas, equation, general};
use super::{Quantity, Table, TableEntry};
use crate::Coefficient;
use crate::formula::lines::chain;
use crate::formula::mathml::{self, WIDE, escaped};
use crate::formula::{Row, value};
use crate::page::page;
use affinor_tensors::CommonFactors;
use std::io::{self, Write};

pub(super) fn write<S: Coefficient>(table: &Table<S>, out: &mut dyn Write) -> io::Result<()> {
    let name = printable(&table.name);
    page(&name, out, |out| {
        writeln!(out, "<main>\n<h1>{}</h1>", escaped(&name))?;
        let lines = table.head().into_iter().map(|(title, line)| (title, escaped(&line)));
        let named = table.factors();
        let factors = named.lines.iter().map(|line| {
            let is = [line.is_in_formulas(), vec![value(&line.text)]].concat();
            ("where", mathml::inline(&chain(is)))
        });
        let conventions = [("conventions", conventions())];
        head(lines.chain(conventions).chain(factors), out)?;
        table.tensors.iter().try_for_each(|entry| tensor(table, entry, &named.factors, out))?;
        writeln!(out, "</main>")
    })
}

/// Lines with labels, in HTML.
pub(super) fn head(
    lines: impl Iterator<Item = (&'static str, String)>,
    out: &mut dyn Write,
) -> io::Result<()> {
    writeln!(out, "<dl>")?;
    for (title, line) in lines {
        writeln!(out, "<dt>{title}</dt><dd>{line}</dd>")?;
    }
    writeln!(out, "</dl>")
}

/// A summary of the conventions.
pub(super) fn conventions() -> String {
    let formulas = convention_formulas();
    formulas.iter().map(|formula| mathml::inline(formula)).collect::<Vec<_>>().join("; ")
}

/// A list of formulas, in lines of at most `width` characters.
pub(super) fn list(formulas: &[Row], width: usize) -> String {
    let item = |formula: &Row| format!("<li>{}</li>\n", mathml::block(formula, width));
    let items: String = formulas.iter().map(item).collect();
    format!("<ul class=\"components\" tabindex=\"0\">\n{items}</ul>")
}

fn tensor<S: Coefficient>(
    table: &Table<S>,
    entry: &TableEntry<S>,
    factors: &CommonFactors,
    out: &mut dyn Write,
) -> io::Result<()> {
    let (shown, names) = (table.shown(entry), table.index_names.as_deref());
    writeln!(out, "<section>\n<h2>{}</h2>", escaped(table.title(entry.quantity)))?;
    if shown.is_empty() {
        let zero = chain([general(entry.quantity, &shown), value("0")]);
        return writeln!(out, "<p>{}</p>\n</section>", mathml::inline(&zero));
    }
    if shown.len() > GROUPED {
        // writes plain text, because a browser could not render a million components as formulas
        writeln!(out, "<pre tabindex=\"0\">")?;
        for (at, value) in shown.components() {
            let name = named(entry.quantity.symbol(), &shown, &at, names);
            let line = format!("{name} = {}", with_names(value, factors));
            writeln!(out, "{}", escaped(&line))?;
        }
        writeln!(out, "</pre>")?;
    } else {
        let mut formulas = vec![];
        if entry.quantity == Quantity::Structure {
            let labels: Vec<String> = table.labels.iter().map(|label| printable(label)).collect();
            formulas.extend(brackets(&entry.tensor, &labels));
        }
        let groups = groups_with(&shown, factors);
        formulas.extend(
            groups.iter().map(|group| equation(entry.quantity, &shown, group, factors, names)),
        );
        writeln!(out, "{}", list(&formulas, WIDE))?;
    }
    if let Some(summary) = summary(&entry.tensor, &shown) {
        writeln!(out, "<p>{summary}</p>")?;
    }
    writeln!(out, "</section>")
}
