//! LaTeX: a fragment with one `align*` for every tensor.

use super::components::{GROUPED, Group, groups, groups_with, summary};
use super::head::printable;
use super::typeset::{brackets, convention_formulas, general, sides};
use super::{Quantity, Table, TableEntry};
use crate::Coefficient;
use crate::formula::lines::{chain, width};
use crate::formula::{Brackets, Node, Row, formula, label, tex, value};
use affinor_tensors::{CommonFactors, Tensor};
use std::io::{self, Write};

/// The approximate number of characters in a line.
pub(super) const WIDTH: usize = 58;

pub(super) fn write<S: Coefficient>(table: &Table<S>, out: &mut dyn Write) -> io::Result<()> {
    writeln!(out, "% A fragment: it needs \\usepackage{{amsmath}}.")?;
    writeln!(out, "% Names beyond ASCII need LuaLaTeX or XeLaTeX and a font that has them.")?;
    writeln!(
        out,
        "\\begingroup\\allowdisplaybreaks\\raggedright\\setlength{{\\parindent}}{{0pt}}"
    )?;
    writeln!(out, "\\section*{{{}}}", tex::escaped(&printable(&table.name)))?;
    let label = |text: &String| match label(&printable(text)) {
        Node::Text(words) => tex::escaped(&words),
        name => format!("${}$", tex::formula(&[name])),
    };
    let labels: Vec<String> = table.labels.iter().map(label).collect();
    let mut lines: Vec<_> =
        table.head().into_iter().map(|(title, line)| (title, tex::escaped(&line))).collect();
    lines[1].1 = labels.join(", ");
    lines.push(("conventions", conventions()));
    for (title, line) in lines {
        writeln!(out, "{title}: {line}\\par")?;
    }
    let named = table.factors();
    for line in &named.lines {
        let equation = Equation([line.is_in_formulas(), vec![value(&line.text)]].concat());
        writeln!(out, "where: {}", equation.inline())?;
    }
    for entry in &table.tensors {
        tensor(table, entry, &named.factors, out)?;
    }
    writeln!(out, "\\endgroup")
}

fn tensor<S: Coefficient>(
    table: &Table<S>,
    entry: &TableEntry<S>,
    factors: &CommonFactors,
    out: &mut dyn Write,
) -> io::Result<()> {
    let (quantity, shown) = (entry.quantity, table.shown(entry));
    let (symbol, names) = (formula(quantity.symbol()), table.index_names.as_deref());
    writeln!(out, "\\subsection*{{{}}}", table.title(quantity))?;
    if shown.is_empty() {
        let general = tex::formula(&general(quantity, &shown));
        return writeln!(out, "\\begin{{align*}}\n{general} &= 0\n\\end{{align*}}");
    }
    if shown.len() <= GROUPED {
        if quantity == Quantity::Structure {
            let labels: Vec<String> = table.labels.iter().map(|label| printable(label)).collect();
            for bracket in brackets(&entry.tensor, &labels) {
                writeln!(out, "{}\\par", paragraph(&bracket))?;
            }
        }
        let groups = groups_with(&shown, factors);
        let equation = |group: &Group<S>| Equation(sides(&symbol, &shown, group, factors, names));
        let equations: Vec<Equation> = groups.iter().map(equation).collect();
        for run in equations.chunk_by(|a, b| a.is_long() == b.is_long()) {
            if run[0].is_long() {
                run.iter().try_for_each(|equation| writeln!(out, "{}", equation.inline()))?;
            } else {
                let aligned: Vec<String> = run.iter().map(Equation::aligned).collect();
                let aligned = aligned.join(" \\\\\n");
                writeln!(out, "\\begin{{align*}}\n{aligned}\n\\end{{align*}}")?;
            }
        }
    } else {
        // writes paragraphs, because TeX reads a whole align* into memory before it typesets it
        for (at, value) in shown.components() {
            let group = Group { value: value.clone(), members: vec![(at.to_vec(), false)] };
            writeln!(out, "{}", Equation(sides(&symbol, &shown, &group, factors, names)).inline())?;
        }
    }
    summary(&entry.tensor, &shown).map_or(Ok(()), |summary| writeln!(out, "{summary}\\par"))
}

/// The sides of `first = second = ... = value`.
struct Equation(Vec<Row>);

impl Equation {
    fn value(&self) -> &[Node] {
        self.0.last().map_or(&[], Vec::as_slice)
    }

    /// Whether the value is too wide for a line of a displayed formula.
    fn is_long(&self) -> bool {
        width(self.value()) > WIDTH
    }

    /// The lines of an `align*`, which are broken before `=`.
    fn aligned(&self) -> String {
        let Some((first, sides)) = self.0.split_first() else { return String::new() };
        let (mut text, mut column) = (tex::formula(first), width(first));
        for (position, side) in sides.iter().enumerate() {
            let full = position > 0 && column + 3 + width(side) > WIDTH;
            text.push_str(match (position, full) {
                (0, _) => " &= ",
                // the star prevents a page break within an equation
                (_, true) => " \\\\*\n&= ",
                (_, false) => " = ",
            });
            column = if full { 8 } else { column };
            column += 3 + width(side);
            text.push_str(&tex::formula(side));
        }
        text
    }

    /// A paragraph, in which TeX may break lines at relations and signs. Fractions are written with
    /// a slash, because TeX cannot break fraction bars.
    fn inline(&self) -> String {
        let mut sides = self.0.clone();
        if self.is_long()
            && let Some(value) = sides.last_mut()
            && let Some(Node::Fraction([above, below])) =
                value.pop_if(|last| matches!(last, Node::Fraction(_)))
        {
            let group = |row| Node::Group(Brackets::Round, row);
            value.extend([group(above), Node::Sign("/"), group(below)]);
        }
        format!("{}\\par", paragraph(&chain(sides)))
    }
}

/// A formula as a paragraph, without the end of the paragraph.
pub(super) fn paragraph(formula: &[Node]) -> String {
    format!("\\hangindent=2em ${}$", tex::breakable(formula))
}

/// A summary of the conventions.
pub(super) fn conventions() -> String {
    let formulas = convention_formulas();
    let formulas: Vec<String> =
        formulas.iter().map(|formula| format!("${}$", tex::formula(formula))).collect();
    formulas.join(", ")
}

/// The grouped components of a tensor with a given symbol, in LaTeX, as lines of an `align*`.
pub fn components_in_latex<S: Coefficient>(symbol: &str, tensor: &Tensor<S>) -> Vec<String> {
    labelled_in_latex(symbol, tensor, None)
}

/// Like [`components_in_latex`], but indices may be names instead of numbers.
pub fn labelled_in_latex<S: Coefficient>(
    symbol: &str,
    tensor: &Tensor<S>,
    names: Option<&[String]>,
) -> Vec<String> {
    // writes a placeholder first, because the symbol is already LaTeX and must not be converted
    const SYMBOL: char = '\u{FFFC}';
    let none = CommonFactors::default();
    let aligned = |group: &Group<S>| {
        let sides = sides(&[Node::Letter(SYMBOL)], tensor, group, &none, names);
        Equation(sides).aligned().replace(SYMBOL, symbol)
    };
    groups(tensor).iter().map(aligned).collect()
}

/// A line in which all spaces are preserved; a box at its start prevents TeX from dropping spaces.
pub(super) fn verbatim(line: &str) -> String {
    format!("\\mbox{{\\footnotesize\\ttfamily {}}}", tex::escaped(line).replace(' ', "~"))
}
