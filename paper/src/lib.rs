//! The paper of Paraskevopoulos and Natsiavas, *Int. J. Solids and Structures* 50 (2013) 57-72,
//! equation by equation: the statement of each equation, and its check by the engine.
//!
//! In reading order: a [`Paper`] is a list of [`Section`]s, which are lists of [`Row`]s. Each row
//! has [`Finding`]s, which are computed by [`Paper::read`]. The rows of each section of the paper
//! are in their own file. `lab` contains the groups and geometries of the checks. `html`,
//! `markdown` and `latex` write the document.
//!
//! ```
//! use affinor_paper::{Paper, PaperFormat};
//! let paper = Paper::read()?;
//! let rows: Vec<_> = paper.sections.iter().flat_map(|section| &section.rows).collect();
//! let affinities = rows.iter().find(|row| row.equation == "(38)").unwrap();
//! assert!(affinities.findings.iter().all(|finding| finding.is_expected()));
//! let mut html = Vec::new();
//! paper.write(PaperFormat::Html, &[], &mut html)?;
//! assert!(html.starts_with(b"<!DOCTYPE html>"));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod appendices;
mod bodies;
mod coordinates;
mod dynamics;
mod finding;
mod groups;
mod html;
mod lab;
mod latex;
mod m3;
mod markdown;
mod so3;

pub use finding::{Finding, Outcome};

use affinor::{CanonicalConnection, Error, LieAlgebra};
use affinor_documents::Coefficient;
use affinor_documents::report::grouped_in_text;
use affinor_tensors::{Rational, Tensor};
use lab::Lab;
use std::io::{self, Write};

/// The recomputed paper.
#[derive(Clone, Debug)]
pub struct Paper {
    /// The sections, in the order of the paper.
    pub sections: Vec<Section>,
}

/// A section of the paper.
#[derive(Clone, Debug)]
pub struct Section {
    /// The number and the title of the section, in our words.
    pub title: &'static str,
    /// The contents of the section. Formulas are written between backticks.
    pub about: &'static str,
    /// The equations and claims.
    pub rows: Vec<Row>,
}

/// An equation or a claim of the paper.
#[derive(Clone, Debug)]
pub struct Row {
    /// The number of the equation, such as `(38)` or `after (38)`.
    pub equation: &'static str,
    /// The topic of the equation, in a few words. No two entries share a name.
    pub name: &'static str,
    /// The formula, in the notation of this project.
    pub formula: &'static str,
    /// The statement in words. Formulas are written between backticks.
    pub says: &'static str,
    /// The assessment of the equation as printed.
    pub status: Status,
    /// The functions of the library that compute the equation.
    pub functions: Vec<&'static str>,
    /// The computed checks and values.
    pub findings: Vec<Finding>,
}

/// The assessment of an equation as the paper prints it. Formulas are written between backticks.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Status {
    /// Correct as printed.
    Right,
    /// Correct under a convention that the paper does not state.
    Convention(&'static str),
    /// A misprint, with the correction.
    Misprint(&'static str),
    /// True, but under stronger conditions than the paper states.
    TooStrong(&'static str),
}

impl Status {
    /// The assessment in one or two words.
    pub fn word(self) -> &'static str {
        match self {
            Status::Right => "right",
            Status::Convention(_) => "by convention",
            Status::Misprint(_) => "corrected",
            Status::TooStrong(_) => "too strong",
        }
    }

    /// The convention, the correction or the conditions.
    pub fn remark(self) -> Option<&'static str> {
        match self {
            Status::Right => None,
            Status::Convention(remark) | Status::Misprint(remark) | Status::TooStrong(remark) => {
                Some(remark)
            }
        }
    }
}

/// The format of the document.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PaperFormat {
    /// One HTML file without scripts, with formulas in MathML.
    Html,
    /// Markdown with tables, as GitHub renders them.
    Markdown,
    /// A document for pdfLaTeX.
    Latex,
}

/// A figure of the document.
#[derive(Clone, Debug)]
pub struct PaperFigure {
    /// The title, with the number of the figure in the paper.
    pub title: String,
    /// A description of the figure, in one sentence.
    pub about: String,
    /// The picture, as an element `svg`.
    pub svg: String,
}

impl Paper {
    /// Computes the whole document.
    ///
    /// # Errors
    /// Errors of the library; no error is expected.
    pub fn read() -> Result<Self, Error> {
        let lab = Lab::new()?;
        let sections = vec![
            bodies::section(&lab)?,
            groups::section(&lab)?,
            m3::section(&lab)?,
            so3::section(&lab)?,
            coordinates::section(&lab)?,
            dynamics::section(&lab)?,
            appendices::section(&lab)?,
        ];
        Ok(Paper { sections })
    }

    /// The numbers of equations, of findings, and of findings with the expected outcome.
    pub fn summary(&self) -> String {
        let rows = || self.sections.iter().flat_map(|section| &section.rows);
        let findings = || rows().flat_map(|row| &row.findings);
        let expected = findings().filter(|finding| finding.is_expected()).count();
        let refuted = findings().filter(|finding| finding.refuted).count();
        format!(
            "{} entries with {} findings; {expected} have the expected outcome, {refuted} of them refute a statement that the paper prints or suggests.",
            rows().count(),
            findings().count()
        )
    }

    /// Writes the document. Only HTML contains the figures.
    ///
    /// # Errors
    /// Errors of `out`.
    pub fn write(
        &self,
        format: PaperFormat,
        figures: &[PaperFigure],
        out: &mut dyn Write,
    ) -> io::Result<()> {
        match format {
            PaperFormat::Html => html::write(self, figures, out),
            PaperFormat::Markdown => markdown::write(self, out),
            PaperFormat::Latex => latex::write(self, out),
        }
    }
}

impl Row {
    /// A row for an equation that is correct as printed, without findings.
    fn new(
        equation: &'static str,
        name: &'static str,
        formula: &'static str,
        says: &'static str,
    ) -> Self {
        let status = Status::Right;
        Row { equation, name, formula, says, status, functions: vec![], findings: vec![] }
    }

    fn by(mut self, functions: &[&'static str]) -> Self {
        self.functions.extend(functions);
        self
    }

    fn status(mut self, status: Status) -> Self {
        self.status = status;
        self
    }

    fn find(mut self, finding: impl IntoIterator<Item = Finding>) -> Self {
        self.findings.extend(finding);
        self
    }

    /// Adds the values of a tensor as findings. Components that are equal up to sign are on the
    /// same line.
    fn components<S: Coefficient>(self, symbol: &str, tensor: &Tensor<S>) -> Self {
        let lines = grouped_in_text(symbol, tensor);
        self.find(lines.iter().map(|line| Finding::value(line)))
    }

    /// Adds a check that a tensor is zero on each of the algebras.
    fn on_algebras(
        self,
        lab: &Lab,
        claim: &str,
        difference: impl Fn(&LieAlgebra<Rational>) -> Result<Tensor<Rational>, Error>,
    ) -> Result<Self, Error> {
        let findings = lab
            .named()
            .map(|(name, algebra)| Ok((name, Finding::exact("", &difference(algebra)?))));
        let findings = findings.collect::<Result<Vec<_>, Error>>()?;
        Ok(self.find(Finding::everywhere(claim, findings)))
    }
}

/// A part of a text.
enum Part<'a> {
    Words(&'a str),
    Formula(&'a str),
    /// A name in this program, such as the name of a connection.
    Name(&'a str),
}

/// Splits a text into words, formulas, and names of connections. Formulas and names are written
/// between backticks.
fn parts(text: &str) -> impl Iterator<Item = Part<'_>> {
    let names = [CanonicalConnection::Plus, CanonicalConnection::Zero, CanonicalConnection::Minus]
        .map(CanonicalConnection::name);
    let parts = text.split('`').enumerate().filter(|(_, part)| !part.is_empty());
    parts.map(move |(at, part)| match at % 2 {
        0 => Part::Words(part),
        _ if names.contains(&part) => Part::Name(part),
        _ => Part::Formula(part),
    })
}

const TITLE: &str = "Finite rotations on a Lie group";
const ABOUT: &str = "A group has no connection and no metric of its own: they are chosen. M(3) and SO(3) are the rotation group with two choices. \
    This document goes through E. Paraskevopoulos and S. Natsiavas, \
    Int. J. Solids and Structures 50 (2013) 57-72, doi 10.1016/j.ijsolstr.2012.09.001, equation by equation. Each entry states the equation in our notation, \
    computes it, and says where it holds and where the paper must be read with a correction. \
    Exact values are computed over the rationals or with symbols. Statements about motions and group elements are computed in floats, \
    with the bound that they satisfy.";
const GROUPS: &str = "Because many wrong signs cancel on so(3), general statements are computed on SO(3), SE(2), SE(3), SL(2), \
    the Heisenberg group and the affine group of the line.";
