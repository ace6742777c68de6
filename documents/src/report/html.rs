//! Pages of HTML, with formulas in MathML.

use super::components::{GROUPED, groups_with, plain, summary, with_names};
use super::grid::{Cell, Grid};
use super::head::{conventions, printable};
use super::text::{brackets, component, equation, general};
use super::{Quantity, Table, TableEntry};
use crate::formula::mathml::{escaped, value};
use crate::page::page;
use affinor_tensors::{CommonFactors, Notation};
use std::io::{self, Write};

pub(super) fn write<S: Notation>(table: &Table<S>, out: &mut dyn Write) -> io::Result<()> {
    let name = printable(&table.name);
    page(&name, out, |out| {
        writeln!(out, "<main>\n<h1>{}</h1>", escaped(&name))?;
        let lines = table.head().into_iter().map(|(title, line)| (title, escaped(&line)));
        let named = table.factors();
        let factors = named.lines.iter().map(|line| {
            let is = [line.is(), vec![line.text.clone()]].concat();
            ("where", value(&is.join(" = ")))
        });
        let conventions = [("conventions", formulas(&conventions()))];
        head(lines.chain(conventions).chain(factors), out)?;
        table.tensors.iter().try_for_each(|entry| tensor(table, entry, &named.factors, out))?;
        writeln!(out, "</main>")
    })
}

/// Titles and lines of HTML.
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

/// Formulas that are separated by semicolons.
fn formulas(text: &str) -> String {
    text.split("; ").map(value).collect::<Vec<_>>().join("; ")
}

fn tensor<S: Notation>(
    table: &Table<S>,
    entry: &TableEntry<S>,
    factors: &CommonFactors,
    out: &mut dyn Write,
) -> io::Result<()> {
    let shown = table.shown(entry);
    let name = |at: &[usize]| component(entry.quantity, &shown, at);
    writeln!(out, "<section>\n<h2>{}</h2>", escaped(table.title(entry.quantity)))?;
    if shown.is_empty() {
        let zero = value(&format!("{} = 0", general(entry.quantity, &shown)));
        return writeln!(out, "<p>{zero}</p>\n</section>");
    }
    if shown.len() > GROUPED {
        // a formula for each of a million components would be too much for a browser
        writeln!(out, "<pre tabindex=\"0\">")?;
        for (at, value) in shown.components() {
            writeln!(
                out,
                "{}",
                escaped(&format!("{} = {}", name(&at), with_names(value, factors)))
            )?;
        }
        writeln!(out, "</pre>")?;
    } else {
        writeln!(out, "<ul class=\"components\">")?;
        if entry.quantity == Quantity::Structure {
            let labels: Vec<String> = table.labels.iter().map(|label| printable(label)).collect();
            for (left, right) in brackets(&entry.tensor, &labels, plain) {
                writeln!(out, "<li>{}</li>", value(&format!("{left} = {right}")))?;
            }
        }
        for group in groups_with(&shown, factors) {
            writeln!(out, "<li>{}</li>", value(&equation(&group, factors, name).join(" ")))?;
        }
        writeln!(out, "</ul>")?;
    }
    if let Some(summary) = summary(&entry.tensor, &shown) {
        writeln!(out, "<p>{summary}</p>")?;
    }
    writeln!(out, "</section>")
}

impl Grid {
    /// A page with this grid alone.
    pub(super) fn html(&self, out: &mut dyn Write) -> io::Result<()> {
        page(&self.title, out, |out| {
            writeln!(out, "<main>\n<h1>{}</h1>", escaped(&self.title))?;
            self.table(out)?;
            writeln!(out, "</main>")
        })
    }

    /// The head and the table.
    pub(super) fn table(&self, out: &mut dyn Write) -> io::Result<()> {
        if !self.head.is_empty() {
            head(self.head.iter().map(|(title, cell)| (*title, lines(cell))), out)?;
        }
        writeln!(
            out,
            "<div class=\"table\" tabindex=\"0\" role=\"group\" aria-label=\"table\">\n<table>\n<thead><tr>"
        )?;
        for title in &self.header {
            // an empty heading is a cell like the others
            match title.is_empty() {
                true => writeln!(out, "<td></td>")?,
                false => writeln!(out, "<th scope=\"col\">{}</th>", escaped(title))?,
            }
        }
        writeln!(out, "</tr></thead>\n<tbody>")?;
        for row in &self.rows {
            writeln!(out, "<tr>")?;
            for cell in row {
                writeln!(out, "<td>{}</td>", lines(cell))?;
            }
            writeln!(out, "</tr>")?;
        }
        writeln!(out, "</tbody>\n</table>\n</div>")
    }
}

/// The lines of a cell; those with a form of their own in LaTeX are formulas.
fn lines(cell: &Cell) -> String {
    if cell.is_drawn {
        return format!("<pre>{}</pre>", escaped(&cell.text.join("\n")));
    }
    let line = |line: &String| match (&cell.latex, line.strip_prefix("no: ")) {
        (None, _) => escaped(line),
        (Some(_), Some(residual)) => format!("no: {}", value(residual)),
        (Some(_), None) => formulas(line),
    };
    cell.text.iter().map(line).collect::<Vec<_>>().join("<br/>")
}
