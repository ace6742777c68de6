//! Writes the document in Markdown.

use crate::{ABOUT, Paper, Row, TITLE};
use std::io::{self, Write};

pub(crate) fn write(paper: &Paper, out: &mut dyn Write) -> io::Result<()> {
    writeln!(out, "# {TITLE}\n\n{ABOUT}\n\n{}", paper.summary())?;
    for section in &paper.sections {
        writeln!(out, "\n## {}\n\n{}\n", section.title, section.about)?;
        writeln!(out, "| equation | what it says | computed now | here |\n|---|---|---|---|")?;
        for row in &section.rows {
            writeln!(
                out,
                "| {} | {} | {} | {} |",
                row.equation,
                says(row),
                findings(row),
                functions(row)
            )?;
        }
    }
    Ok(())
}

fn says(row: &Row) -> String {
    let formula =
        if row.formula.is_empty() { String::new() } else { format!("`{}`<br>", row.formula) };
    let remark =
        row.status.remark().map(|remark| format!("<br>**{}:** {remark}", row.status.word()));
    cell(&format!("{formula}{}{}", row.says, remark.unwrap_or_default()))
}

fn findings(row: &Row) -> String {
    let lines = row.findings.iter().map(|finding| {
        let mark = if finding.refuted { "✗ " } else { "" };
        let words = finding.words();
        let words = if words.is_empty() { words } else { format!(" ({words})") };
        cell(&format!("{mark}{}{words}", finding.claim))
    });
    lines.collect::<Vec<_>>().join("<br>")
}

fn functions(row: &Row) -> String {
    let functions: Vec<String> = row.functions.iter().map(|name| format!("`{name}`")).collect();
    functions.join(", ")
}

/// Escapes `|`, which would end a table cell.
fn cell(text: &str) -> String {
    text.replace('|', "\\|")
}
