//! Writes the document for pdfLaTeX.

use crate::{ABOUT, Paper, Part, Row, TITLE, parts};
use affinor_documents::formula::{Node, formula, tex};
use std::io::{self, Write};

pub(crate) fn write(paper: &Paper, out: &mut dyn Write) -> io::Result<()> {
    writeln!(
        out,
        "\\documentclass[11pt]{{article}}\n\\usepackage[T1]{{fontenc}}\\usepackage{{lmodern}}\n\\usepackage[utf8]{{inputenc}}\n\\usepackage{{amsmath,amssymb,geometry}}\n\
         \\geometry{{margin=25mm}}\n\\setlength{{\\parindent}}{{0pt}}\\setlength{{\\parskip}}{{4pt}}\\emergencystretch=3em\\raggedright\n\
         \\title{{{TITLE}}}\\author{{}}\\date{{}}\n\\begin{{document}}\n\\maketitle\n{}\n\n{}\n\\tableofcontents",
        text(ABOUT),
        text(&paper.summary())
    )?;
    for section in &paper.sections {
        writeln!(
            out,
            "\n\\section*{{{0}}}\\addcontentsline{{toc}}{{section}}{{{0}}}\n{1}",
            tex::escaped(section.title),
            text(section.about)
        )?;
        section.rows.iter().try_for_each(|row| equation(row, out))?;
    }
    writeln!(out, "\\end{{document}}")
}

fn equation(row: &Row, out: &mut dyn Write) -> io::Result<()> {
    writeln!(
        out,
        "\n\\paragraph{{{}}} \\textit{{{}}}.",
        tex::escaped(row.equation),
        row.status.word()
    )?;
    if !row.formula.is_empty() {
        writeln!(out, "{}.", display(row.formula))?;
    }
    writeln!(out, "{}", text(row.says))?;
    if let Some(remark) = row.status.remark() {
        writeln!(out, "\\textbf{{{}}}", text(remark))?;
    }
    writeln!(out, "\\begin{{itemize}}\\setlength{{\\itemsep}}{{0pt}}")?;
    for finding in &row.findings {
        let words = finding.words();
        let words = if words.is_empty() { words } else { format!(" ({})", text(&words)) };
        let mark = if finding.refuted { "[$\\times$]" } else { "" };
        let mut parts = parts(&finding.claim);
        let claim = match (parts.next(), parts.next()) {
            (Some(Part::Formula(alone)), None) => display(alone),
            _ => text(&finding.claim),
        };
        writeln!(out, "\\item{mark} {claim}{words}")?;
    }
    let functions: Vec<String> =
        row.functions.iter().map(|name| format!("\\texttt{{{}}}", tex::escaped(name))).collect();
    writeln!(out, "\\end{{itemize}}\nComputed by {}.", functions.join(", "))
}

/// Writes a displayed formula, with line breaks at commas, relations and signs.
fn display(text: &str) -> String {
    let formula = formula(text);
    let parts = formula.split(|node| *node == Node::Sign(","));
    let part = |part: &[Node]| format!("$\\displaystyle {}$", tex::breakable(part));
    parts.map(part).collect::<Vec<_>>().join(", ")
}

/// Writes a text with its formulas in the mathematics mode.
fn text(text: &str) -> String {
    let part = |part| match part {
        Part::Words(words) => tex::escaped(words),
        Part::Formula(text) => format!("${}$", tex::breakable(&formula(text))),
        Part::Name(name) => format!("\\texttt{{{name}}}"),
    };
    parts(text).map(part).collect()
}
