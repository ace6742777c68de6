//! Grids of cells in HTML.

use super::super::html::head;
use super::{Cell, Grid};
use crate::formula::{mathml::escaped, prose};
use crate::page::page;
use std::io::{self, Write};

impl Grid {
    /// Writes a page that contains only this grid.
    pub(in crate::report) fn html(&self, out: &mut dyn Write) -> io::Result<()> {
        page(&self.title, out, |out| {
            writeln!(out, "<main>\n<h1>{}</h1>", escaped(&self.title))?;
            self.table(out)?;
            writeln!(out, "</main>")
        })
    }

    /// Writes the header and the table.
    pub(in crate::report) fn table(&self, out: &mut dyn Write) -> io::Result<()> {
        if !self.head.is_empty() {
            head(self.head.iter().map(|(title, cell)| (*title, lines(cell))), out)?;
        }
        writeln!(
            out,
            "<div class=\"table\" tabindex=\"0\" role=\"group\" aria-label=\"table\">\n<table>\n<thead><tr>"
        )?;
        for title in &self.header {
            // writes an empty heading as an ordinary cell
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

/// The lines of a cell in HTML.
fn lines(cell: &Cell) -> String {
    if cell.is_drawn {
        return format!("<pre>{}</pre>", escaped(&cell.text.join("\n")));
    }
    let escape = if cell.is_prose { prose::html } else { escaped };
    let lines = cell.html.clone();
    let lines = lines.unwrap_or_else(|| cell.text.iter().map(|line| escape(line)).collect());
    lines.join("<br/>")
}
