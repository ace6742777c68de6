//! Comparisons of two geometries.

use super::claims::Claim;
use super::components::groups;
use super::grid::{Cell, Grid, head_of_grid, pretty};
use super::{Format, Quantity, Report, head, html, latex, text, typeset};
use crate::Coefficient;
use crate::formula::lines::chain;
use crate::formula::mathml::{self, NARROW, escaped};
use crate::formula::{Row, formula, notation, sum, tex, value};
use crate::page::page;
use affinor::geometry::conditions::conditions;
use affinor::geometry::properties::Property;
use affinor::{ConnectionKind, Error, Geometry};
use affinor_tensors::contract;
use affinor_tensors::text::combination;
use affinor_tensors::{CommonFactors, Kind, Tensor};
use serde_json::{Value, json};
use std::io::{self, Write};

/// The largest number of components of a tensor that are listed; for more components, only their
/// number is shown.
const LISTED: usize = 24;
/// The largest number of basis vectors that are listed; of more vectors, only the first and the
/// last are shown.
const LABELLED: usize = 12;

/// The outcome of a claim; `None` if the claim is about a metric and the geometry has none.
type Verdict = Option<Property<String>>;
/// The reason why a claim does not apply.
const NO_METRIC: &str = "no metric";

/// One side of a comparison: a geometry, ready for output.
#[derive(Clone, Debug)]
pub struct ComparedSide {
    name: String,
    connection: String,
    rows: Vec<(&'static str, Cell)>,
    verdicts: Vec<(Claim, Verdict)>,
    /// The rule by which a float counts as zero.
    zero: Option<String>,
}

/// A comparison of two geometries.
#[derive(Clone, Debug)]
pub struct Comparison {
    sides: [ComparedSide; 2],
}

impl ComparedSide {
    /// Computes one side of a comparison.
    ///
    /// # Errors
    /// [`Law::Constant`](affinor::Law::Constant) if the structure functions are not constant.
    pub fn new<S: Coefficient>(geometry: &Geometry<S>) -> Result<Self, Error> {
        let kind = geometry.kind();
        let structure = geometry.frame_origin().constant_structure("a comparison")?;
        let basis = basis(geometry.frame().labels());
        let connection = geometry.describe_connection();
        let mut rows = vec![("basis", basis.into()), ("connection", connection.into())];
        let shown = [
            ("structure constants", Quantity::Structure),
            ("affinities", Quantity::Affinities),
            ("torsion (B10)", Quantity::Torsion),
            ("curvature (B14)", Quantity::Curvature),
            ("metric", Quantity::Metric),
        ];
        for (title, quantity) in shown {
            let tensor = quantity.of(geometry)?;
            rows.push((title, tensor.map_or("none".into(), |tensor| listed(quantity, &tensor))));
        }
        rows.push(("compatibility", compatibility(geometry)?));
        rows.push(("transport along n", transport(geometry, structure)));
        let verdict = |claim: Claim| Ok((claim, claim.holds(geometry)?));
        let verdicts = Claim::ALL.into_iter().map(verdict).collect::<Result<_, Error>>()?;
        let connection = match kind {
            ConnectionKind::Family(lambda) => format!("lambda={lambda}"),
            _ => geometry.connection_name().into(),
        };
        let tolerance = geometry.frame().structure_functions().tolerance();
        let zero = (S::KIND == Kind::Float).then(|| head::zero(tolerance));
        Ok(ComparedSide { name: geometry.name().into(), connection, rows, verdicts, zero })
    }
}

impl Comparison {
    /// Compares two sides. If both sides have the same name, their connections are added to the
    /// names; if these are equal too, numbers are added.
    pub fn new(mut left: ComparedSide, mut right: ComparedSide) -> Self {
        if left.name == right.name {
            for side in [&mut left, &mut right] {
                side.name = format!("{}@{}", side.name, side.connection);
            }
        }
        if left.name == right.name {
            left.name += " (1)";
            right.name += " (2)";
        }
        Comparison { sides: [left, right] }
    }

    fn tensors(&self) -> Grid {
        let [left, right] = &self.sides;
        let rows = left.rows.iter().zip(&right.rows);
        let rows = rows.map(|((title, a), (_, b))| vec![(*title).into(), a.clone(), b.clone()]);
        let title = format!("{} and {}", left.name, right.name);
        Grid::new(title, &["", &left.name, &right.name], rows.collect(), Value::Null)
            .with_head(head_of_grid(left.zero.as_deref()))
    }

    fn claims(&self) -> Grid {
        let [left, right] = &self.sides;
        let verdicts = left.verdicts.iter().zip(&right.verdicts);
        let rows = verdicts.map(|((claim, a), (_, b))| {
            let words = format!("{} {}", claim.equation(), claim.statement());
            let about = match claim.about() {
                [one] => *one,
                _ => "both",
            };
            vec![words.into(), about.into(), written(a), written(b)]
        });
        let title = "Claims of the paper, and where they hold";
        let header = ["claim", "about", &left.name, &right.name];
        Grid::new(title, &header, rows.collect(), Value::Null)
    }

    /// A single grid of the tensors and the claims.
    fn one_grid(&self) -> Grid {
        let mut grid = self.tensors();
        grid.rows.iter_mut().for_each(|row| row.insert(1, "".into()));
        let claims = self.claims();
        grid.header = claims.header;
        grid.header[0] = "row".into();
        grid.rows.extend(claims.rows);
        grid
    }

    fn json(&self) -> Value {
        let [left, right] = &self.sides;
        let rows = left
            .rows
            .iter()
            .zip(&right.rows)
            .map(|((title, a), (_, b))| json!({ "title": title, "cells": [a.text, b.text] }));
        let verdict = |verdict: &Verdict| match verdict {
            Some(Property::Holds(())) => json!({ "holds": true }),
            Some(Property::Fails(witness)) => {
                json!({ "holds": false, "residual": witness.to_string() })
            }
            None => json!({ "holds": null, "reason": NO_METRIC }),
        };
        let claims = left.verdicts.iter().zip(&right.verdicts).map(|((claim, a), (_, b))| {
            json!({
                "equation": claim.equation(),
                "statement": claim.statement(),
                "about": claim.about(),
                "verdicts": [verdict(a), verdict(b)],
            })
        });
        json!({
            "schema": "affinor.compare/1",
            "spaces": [left.name, right.name],
            "conventions": head::conventions_in_json(left.zero.as_deref()),
            "rows": rows.collect::<Vec<_>>(),
            "claims": claims.collect::<Vec<_>>(),
        })
    }
}

impl Report for Comparison {
    /// Writes the comparison. JSON has the schema `affinor.compare/1`; CSV is a single table.
    fn write(&self, format: Format, out: &mut dyn Write) -> io::Result<()> {
        match format {
            Format::Json => pretty(&self.json(), out),
            Format::Csv => self.one_grid().write(format, out),
            Format::Html => {
                let [tensors, claims] = [self.tensors(), self.claims()];
                page(&tensors.title, out, |out| {
                    writeln!(out, "<main>\n<h1>{}</h1>", escaped(&tensors.title))?;
                    tensors.table(out)?;
                    writeln!(out, "<h2>{}</h2>", escaped(&claims.title))?;
                    claims.table(out)?;
                    writeln!(out, "</main>")
                })
            }
            _ => {
                self.tensors().write(format, out)?;
                writeln!(out)?;
                self.claims().write(format, out)
            }
        }
    }
}

fn written(verdict: &Verdict) -> Cell {
    let witness = match verdict {
        None => return format!("({NO_METRIC})").into(),
        Some(Property::Holds(())) => return "yes".into(),
        Some(Property::Fails(witness)) => witness,
    };
    let text = format!("no: {witness}");
    // writes a witness that is not an equation as plain text
    let Ok(left) = notation(&witness.equation) else { return text.into() };
    let (right, n) = match witness.residual.split_once(" for n = ") {
        Some((right, n)) => (right, Some(n)),
        None => (witness.residual.as_str(), None),
    };
    let mut line = vec![Part::Words("no: "), Part::Formula(chain([left, value(right)]))];
    if let Some(n) = n {
        line.extend([Part::Words(" for "), Part::Formula(chain([formula("n"), value(n)]))]);
    }
    Cell { text: vec![text], ..typeset(&[line]) }
}

/// The names of the basis vectors; of many vectors, the first and the last name, and the number.
fn basis(labels: &[String]) -> String {
    match labels {
        [first, .., last] if labels.len() > LABELLED => {
            format!("{first}, .., {last} ({} vectors)", labels.len())
        }
        _ => labels.join(", "),
    }
}

/// The components of a tensor, grouped by value; of many components, only their number.
fn listed<S: Coefficient>(quantity: Quantity, tensor: &Tensor<S>) -> Cell {
    if tensor.is_empty() {
        return "0".into();
    }
    if tensor.len() > LISTED {
        return format!("{} nonzero components, listed by `affinor table`", tensor.len()).into();
    }
    let none = CommonFactors::default();
    let groups = groups(tensor);
    let text = groups.iter().map(|group| {
        text::equation(group, &none, |at| text::component(quantity, tensor, at)).join(" ")
    });
    let formulas =
        groups.iter().map(|group| typeset::equation(quantity, tensor, group, &none, None));
    let formulas: Vec<Row> = formulas.collect();
    // writes separate paragraphs, so that each paragraph has its own hanging indent
    let latex: Vec<String> = formulas.iter().map(|formula| latex::paragraph(formula)).collect();
    Cell {
        text: text.collect(),
        latex: Some(vec![latex.join(" \\par ")]),
        html: Some(vec![html::list(&formulas, NARROW)]),
        ..Cell::default()
    }
}

/// Whether the connection preserves the metric. If it does not, the conditions on the parameters
/// under which it does.
fn compatibility<S: Coefficient>(geometry: &Geometry<S>) -> Result<Cell, Error> {
    let Some(metric) = geometry.metric() else {
        return Ok("no metric".into());
    };
    let nonmetricity = geometry.connection().nonmetricity(metric)?;
    if nonmetricity.is_empty() {
        return Ok(line("nabla g = 0", vec![Part::Formula(formula("nabla g = 0"))]));
    }
    let conditions = conditions(&nonmetricity);
    let possible = !conditions.is_empty() && conditions.iter().all(|e| !e.parameters().is_empty());
    if possible {
        let text: Vec<String> = conditions.iter().map(|e| format!("{e} = 0")).collect();
        let mut formulas = vec![];
        for condition in &conditions {
            formulas.extend((!formulas.is_empty()).then_some(Part::Words(", ")));
            formulas.push(Part::Formula(chain([value(&condition.to_string()), value("0")])));
        }
        let first = vec![Part::Formula(formula("nabla g = 0")), Part::Words(" only if")];
        let text = vec!["nabla g = 0 only if".into(), text.join(", ")];
        return Ok(Cell { text, ..typeset(&[first, formulas]) });
    }
    let count = format!(" has {} nonzero components", nonmetricity.len());
    let formula = Part::Formula(formula("nabla g"));
    Ok(line(&format!("nabla g{count}"), vec![formula, Part::Words(&count)]))
}

/// The generator of parallel transport along an autoparallel, written as a multiple of `ad_n` if it
/// is a multiple.
fn transport<S: Coefficient>(geometry: &Geometry<S>, c: &Tensor<S>) -> Cell {
    let gamma = geometry.connection().affinities();
    let generator = |text: &str, parts: Vec<Part>| {
        let law = [Part::Formula(formula("du/dt = G u")), Part::Words(", ")];
        line(&format!("du/dt = G u, {text}"), law.into_iter().chain(parts).collect())
    };
    if gamma.is_empty() {
        return generator("G = 0", vec![Part::Formula(formula("G = 0"))]);
    }
    let share = c.components().next().and_then(|(at, value)| {
        let share = gamma.get(&at) * &value.recip()?;
        let operands = [("L", gamma), ("c", &c.scale(&share))];
        contract("L^i_jk - c^i_jk -> ^i_jk", &operands).ok()?.is_empty().then_some(-share)
    });
    let ad = formula("ad_n");
    match share.map(|share| share.to_string()) {
        Some(share) => {
            let written = combination([(&share, "ad_n".to_string())]).replace('*', " ");
            let equation = chain([formula("G"), sum([(value(&share), ad)])]);
            generator(&format!("G = {written}"), vec![Part::Formula(equation)])
        }
        None => generator(
            "no multiple of ad_n",
            vec![Part::Words("no multiple of "), Part::Formula(ad)],
        ),
    }
}

/// A part of a line.
enum Part<'a> {
    Words(&'a str),
    Formula(Row),
}

/// A line as plain text, and as words and formulas.
fn line(text: &str, parts: Vec<Part>) -> Cell {
    Cell { text: vec![text.into()], ..typeset(&[parts]) }
}

/// Lines of words and formulas, without their plain text.
fn typeset(lines: &[Vec<Part>]) -> Cell {
    let of = |formula: &dyn Fn(&[crate::formula::Node]) -> String,
              words: &dyn Fn(&str) -> String| {
        let part = |part: &Part| match part {
            Part::Words(text) => words(text),
            Part::Formula(row) => formula(row),
        };
        Some(lines.iter().map(|line| line.iter().map(part).collect()).collect())
    };
    Cell {
        latex: of(&|row| format!("${}$", tex::breakable(row)), &tex::escaped),
        html: of(&mathml::inline, &escaped),
        ..Cell::default()
    }
}
