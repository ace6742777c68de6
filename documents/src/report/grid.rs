//! Grids of short cells, for reports other than tables of tensors.

mod html;

use super::head::{conventions, float};
use super::latex::{self, verbatim};
use super::markdown;
use super::text::{fill, head_line};
use super::{Format, Report};
use crate::formula::{prose, tex};
use crate::rows::failed;
use comfy_table::presets::UTF8_BORDERS_ONLY;
use comfy_table::{ContentArrangement, Table};
use serde_json::Value;
use std::io::{self, Write};

/// The width of a line in a terminal.
const WIDTH: u16 = 80;

/// A grid: a title, a header, and rows of cells; a cell may have several lines.
#[derive(Clone, Debug)]
pub(super) struct Grid {
    pub title: String,
    /// Lines between the title and the rows, each with a label.
    pub head: Vec<(&'static str, Cell)>,
    /// One heading for each column.
    pub header: Vec<String>,
    /// The rows, each with one cell per column.
    pub rows: Vec<Vec<Cell>>,
    /// The JSON form of the report.
    pub json: Value,
}

/// A cell in plain text, LaTeX and HTML.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(super) struct Cell {
    /// Lines of plain text.
    pub text: Vec<String>,
    /// The lines in LaTeX, if they differ from the escaped text.
    pub latex: Option<Vec<String>>,
    /// The lines in HTML, if they differ from the escaped text.
    pub html: Option<Vec<String>>,
    /// Whether the text is prose that contains formulas.
    pub is_prose: bool,
    /// Whether the characters must be aligned vertically, as in a diagram or a matrix.
    pub is_drawn: bool,
}

impl From<&str> for Cell {
    fn from(text: &str) -> Self {
        Cell { text: text.lines().map(str::to_string).collect(), ..Cell::default() }
    }
}

impl From<String> for Cell {
    fn from(text: String) -> Self {
        text.as_str().into()
    }
}

impl Cell {
    /// A cell with a diagram or a matrix, whose characters are aligned vertically.
    pub fn drawn(text: &str) -> Self {
        Cell { is_drawn: true, ..text.into() }
    }

    /// Words that contain formulas, which LaTeX and HTML typeset.
    pub fn prose(text: &str) -> Self {
        Cell { is_prose: true, ..text.into() }
    }

    /// The lines in LaTeX.
    fn in_latex(&self) -> Vec<String> {
        if self.is_drawn && self.latex.is_none() {
            return self.lines(verbatim);
        }
        let escape = if self.is_prose { prose::latex } else { tex::escaped };
        self.latex.clone().unwrap_or_else(|| self.lines(escape))
    }

    /// The lines of plain text, in which `escape` escapes the special characters of a format.
    fn lines(&self, escape: impl Fn(&str) -> String) -> Vec<String> {
        self.text.iter().map(|text| escape(text)).collect()
    }
}

impl Report for Grid {
    fn write(&self, format: Format, out: &mut dyn Write) -> io::Result<()> {
        match format {
            Format::Text => self.text(out),
            Format::Markdown => self.markdown(out),
            Format::Latex => self.latex(out),
            Format::Csv => self.csv(out),
            Format::Json => pretty(&self.json, out),
            Format::Html => self.html(out),
        }
    }
}

/// The header of a grid: a summary of the conventions, and the rule by which a float counts as
/// zero.
pub(super) fn head_of_grid(zero: Option<&str>) -> Vec<(&'static str, Cell)> {
    let conventions = Cell {
        text: vec![conventions()],
        latex: Some(vec![latex::conventions()]),
        html: Some(vec![super::html::conventions()]),
        ..Cell::default()
    };
    let scalar = zero.map(|zero| ("scalar", float(zero).into()));
    [("conventions", conventions)].into_iter().chain(scalar).collect()
}

/// Writes JSON with indentation.
pub(super) fn pretty(json: &Value, out: &mut dyn Write) -> io::Result<()> {
    serde_json::to_writer_pretty(&mut *out, json)?;
    writeln!(out)
}

impl Grid {
    pub fn new(
        title: impl Into<String>,
        header: &[&str],
        rows: Vec<Vec<Cell>>,
        json: Value,
    ) -> Self {
        let header = header.iter().map(|name| name.to_string()).collect();
        Grid { title: title.into(), head: vec![], header, rows, json }
    }

    pub fn with_head(self, head: Vec<(&'static str, Cell)>) -> Self {
        Grid { head, ..self }
    }

    fn text(&self, out: &mut dyn Write) -> io::Result<()> {
        let mut table = Table::new();
        table.load_style(UTF8_BORDERS_ONLY);
        table.set_content_arrangement(ContentArrangement::Dynamic).set_width(WIDTH);
        table.set_header(&self.header);
        for row in &self.rows {
            table.add_row(row.iter().map(|cell| cell.text.join("\n")));
        }
        fill(out, "", std::slice::from_ref(&self.title))?;
        self.head.iter().try_for_each(|(title, cell)| head_line(title, &cell.text, out))?;
        writeln!(out, "{table}")
    }

    fn markdown(&self, out: &mut dyn Write) -> io::Result<()> {
        let escape = |text: &str| markdown::escaped(text, r"|*_`<>[]\^");
        writeln!(out, "## {}\n", escape(&self.title))?;
        for (title, cell) in &self.head {
            writeln!(out, "- {title}: {}", cell.lines(escape).join(" "))?;
        }
        if !self.head.is_empty() {
            writeln!(out)?;
        }
        let line = |cells: Vec<String>| format!("| {} |", cells.join(" | "));
        writeln!(out, "{}", line(self.header.iter().map(|text| escape(text)).collect()))?;
        writeln!(out, "{}", line(vec!["---".into(); self.header.len()]))?;
        for row in &self.rows {
            let cell = |cell: &Cell| cell.lines(escape).join("<br>");
            writeln!(out, "{}", line(row.iter().map(cell).collect()))?;
        }
        Ok(())
    }

    fn latex(&self, out: &mut dyn Write) -> io::Result<()> {
        let columns = self.header.len().max(1);
        let share = 0.92 / columns as f64;
        let column = format!(">{{\\raggedright\\arraybackslash}}p{{{share:.2}\\textwidth}}");
        writeln!(out, "% A fragment: it needs \\usepackage{{amsmath,array,longtable}}.")?;
        writeln!(out, "\\section*{{{}}}", tex::escaped(&self.title))?;
        for (title, cell) in &self.head {
            writeln!(out, "{title}: {}\\par", cell.in_latex().join(" "))?;
        }
        writeln!(out, "\\begin{{longtable}}{{@{{}}{}@{{}}}}", column.repeat(columns))?;
        let header: Vec<_> = self.header.iter().map(|text| tex::escaped(text)).collect();
        writeln!(out, "\\hline\n{} \\\\\n\\hline\\endhead", header.join(" & "))?;
        for row in &self.rows {
            let cell = |cell: &Cell| cell.in_latex().join(" \\newline ");
            writeln!(out, "{} \\\\", row.iter().map(cell).collect::<Vec<_>>().join(" & "))?;
        }
        writeln!(out, "\\hline\n\\end{{longtable}}")
    }

    fn csv(&self, out: &mut dyn Write) -> io::Result<()> {
        let mut writer = csv::Writer::from_writer(out);
        writer.write_record(&self.header).map_err(failed)?;
        let empty = vec![""; self.header.len().saturating_sub(2)];
        for (title, cell) in &self.head {
            writer
                .write_record([&[*title, &cell.text.join("; ")], &empty[..]].concat())
                .map_err(failed)?;
        }
        for row in &self.rows {
            writer.write_record(row.iter().map(|cell| cell.text.join("; "))).map_err(failed)?;
        }
        writer.flush()
    }
}
