//! Writes the document as one HTML file without scripts and external resources, with formulas in
//! MathML.

use crate::{ABOUT, Finding, Outcome, Paper, PaperFigure, Part, Row, TITLE, parts};
use affinor_documents::formula::formula;
use affinor_documents::formula::mathml::{self, WIDE, escaped};
use affinor_documents::page::page;
use std::io::{self, Write};

pub(crate) fn write(paper: &Paper, figures: &[PaperFigure], out: &mut dyn Write) -> io::Result<()> {
    page(TITLE, out, |out| body(paper, figures, out))
}

fn body(paper: &Paper, figures: &[PaperFigure], out: &mut dyn Write) -> io::Result<()> {
    writeln!(
        out,
        "<header>\n<h1>{TITLE}</h1>\n<p>{}</p>\n<p>{}</p>\n</header>\n<nav aria-label=\"Sections\">\n<ul>",
        text(ABOUT),
        text(&paper.summary())
    )?;
    for (at, section) in paper.sections.iter().enumerate() {
        writeln!(out, "<li><a href=\"#section-{}\">{}</a></li>", at + 1, escaped(section.title))?;
    }
    if !figures.is_empty() {
        writeln!(out, "<li><a href=\"#figures\">Figures</a></li>")?;
    }
    writeln!(out, "</ul>\n</nav>\n<main>")?;
    for (at, section) in paper.sections.iter().enumerate() {
        let number = at + 1;
        writeln!(
            out,
            "<section id=\"section-{number}\" aria-labelledby=\"title-{number}\">\n<h2 id=\"title-{number}\">{}</h2>\n<p>{}</p>",
            escaped(section.title),
            text(section.about)
        )?;
        for (place, row) in section.rows.iter().enumerate() {
            equation(row, &format!("eq-{number}-{}", place + 1), out)?;
        }
        writeln!(out, "</section>")?;
    }
    if !figures.is_empty() {
        writeln!(
            out,
            "<section id=\"figures\" aria-labelledby=\"title-figures\">\n<h2 id=\"title-figures\">Figures</h2>"
        )?;
        for figure in figures {
            writeln!(
                out,
                "<figure>\n<div class=\"picture\">{}</div>\n<figcaption><strong>{}.</strong> {}</figcaption>\n</figure>",
                figure.svg,
                escaped(&figure.title),
                text(&figure.about)
            )?;
        }
        writeln!(out, "</section>")?;
    }
    writeln!(out, "</main>")
}

fn equation(row: &Row, id: &str, out: &mut dyn Write) -> io::Result<()> {
    let word = row.status.word();
    let class = word.replace(' ', "-");
    writeln!(
        out,
        "<article id=\"{id}\" aria-labelledby=\"{id}-title\">\n<h3 id=\"{id}-title\"><a href=\"#{id}\">{}</a> <span class=\"name\">{}</span> <span class=\"standing {class}\">{word}</span></h3>",
        escaped(row.equation),
        escaped(row.name)
    )?;
    if !row.formula.is_empty() {
        writeln!(
            out,
            "<div class=\"formula\" tabindex=\"0\" role=\"group\" aria-label=\"formula\">{}</div>",
            mathml::block(&formula(row.formula), WIDE)
        )?;
    }
    writeln!(out, "<p>{}</p>", text(row.says))?;
    if let Some(remark) = row.status.remark() {
        writeln!(out, "<p class=\"remark\">{}</p>", text(remark))?;
    }
    writeln!(out, "<ul class=\"findings\">")?;
    for finding in &row.findings {
        writeln!(out, "<li class=\"{}\">{}</li>", class_of(finding), line(finding))?;
    }
    let code = |name: &&str| format!("<code>{}</code>", escaped(name));
    let functions: Vec<String> = row.functions.iter().map(code).collect();
    writeln!(out, "</ul>\n<p class=\"functions\">Computed by {}.</p>", functions.join(", "))?;
    writeln!(out, "</article>")
}

fn class_of(finding: &Finding) -> &'static str {
    match (&finding.outcome, finding.refuted) {
        (Outcome::Value, _) => "value",
        (Outcome::Fails(_), _) => "fails",
        _ => "holds",
    }
}

fn line(finding: &Finding) -> String {
    let words = finding.words();
    let words = if words.is_empty() {
        words
    } else {
        format!(" <span class=\"outcome\">{}</span>", text(&words))
    };
    let mut parts = parts(&finding.claim);
    let claim = match (parts.next(), parts.next()) {
        (Some(Part::Formula(alone)), None) => mathml::alone(&formula(alone)),
        _ => text(&finding.claim),
    };
    format!("{claim}{words}")
}

/// Writes a text with its formulas in MathML.
fn text(text: &str) -> String {
    let part = |part| match part {
        Part::Words(words) => escaped(words),
        Part::Formula(text) => mathml::inline(&formula(text)),
        Part::Name(name) => format!("<code>{name}</code>"),
    };
    parts(text).map(part).collect()
}
