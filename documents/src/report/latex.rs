//! LaTeX: a fragment with one `align*` for every tensor.

use super::components::{GROUPED, Group, groups, groups_with, scripts, summary};
use super::head::printable;
use super::text::brackets;
use super::{Quantity, Table, TableEntry};
use affinor_tensors::{CommonFactors, Notation, Symbolic, Tensor, Up, Variance};
use std::io::{self, Write};

/// The approximate number of letters in a line.
pub(super) const WIDTH: usize = 58;

/// The conventions in brief.
pub(super) const CONVENTIONS: &str = "$[e_j, e_k] = c^{i}{}_{jk} e_i$, \
    $\\nabla_{e_j} e_k = \\Lambda^{i}{}_{jk} e_i$, $R(e_k, e_l) e_j = R^{i}{}_{jkl} e_i$";

pub(super) fn write<S: Notation>(table: &Table<S>, out: &mut dyn Write) -> io::Result<()> {
    writeln!(out, "% A fragment: it needs \\usepackage{{amsmath}}.")?;
    writeln!(out, "% Names beyond ASCII need LuaLaTeX or XeLaTeX and a font that has them.")?;
    writeln!(
        out,
        "\\begingroup\\allowdisplaybreaks\\raggedright\\setlength{{\\parindent}}{{0pt}}"
    )?;
    writeln!(out, "\\section*{{{}}}", escape(&printable(&table.name)))?;
    let labels: Vec<String> = table.labels.iter().map(|label| label_name(label)).collect();
    let mut lines: Vec<_> =
        table.head().into_iter().map(|(title, line)| (title, escape(&line))).collect();
    lines[1].1 = labels.join(", ");
    lines.push(("conventions", CONVENTIONS.into()));
    for (title, line) in lines {
        writeln!(out, "{title}: {line}\\par")?;
    }
    let named = table.factors();
    for line in &named.lines {
        let equation = Equation { members: line.is_in_latex(), value: line.latex.clone() };
        writeln!(out, "where: {}", equation.inline())?;
    }
    for entry in &table.tensors {
        tensor(table, entry, &named.factors, out)?;
    }
    writeln!(out, "\\endgroup")
}

fn tensor<S: Notation>(
    table: &Table<S>,
    entry: &TableEntry<S>,
    factors: &CommonFactors,
    out: &mut dyn Write,
) -> io::Result<()> {
    let (quantity, shown) = (entry.quantity, table.shown(entry));
    let symbol = quantity.latex();
    writeln!(out, "\\subsection*{{{}}}", table.title(quantity))?;
    if shown.is_empty() {
        let letters = quantity.letters();
        let letters = letters.chars().map(String::from);
        let general = join(&symbol, scripts(0, shown.slots(), letters));
        return writeln!(out, "\\begin{{align*}}\n{general} &= 0\n\\end{{align*}}");
    }
    if shown.len() <= GROUPED {
        if quantity == Quantity::Structure {
            let labels: Vec<String> = table.labels.iter().map(|label| in_formula(label)).collect();
            for (left, right) in brackets(&entry.tensor, &labels, Notation::latex) {
                writeln!(out, "\\hangindent=2em ${left} = {}$\\par", right.replace('*', " "))?;
            }
        }
        let groups = groups_with(&shown, factors);
        let equation = |group: &Group<S>| Equation::new(&symbol, &shown, group, factors);
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
        // TeX reads a whole align* into memory before it sets it; paragraphs have no such limit
        for (at, value) in shown.components() {
            let group = Group { value: value.clone(), members: vec![(at.to_vec(), false)] };
            writeln!(out, "{}", Equation::new(&symbol, &shown, &group, factors).inline())?;
        }
    }
    summary(&entry.tensor, &shown).map_or(Ok(()), |summary| writeln!(out, "{summary}\\par"))
}

/// `first = second = ... = value` in pieces.
struct Equation {
    members: Vec<String>,
    value: String,
}

impl Equation {
    fn new<S: Notation>(
        symbol: &str,
        tensor: &Tensor<S>,
        group: &Group<S>,
        factors: &CommonFactors,
    ) -> Self {
        let members = group.names(|at| {
            let numbers = at.iter().map(|index| (index + 1).to_string());
            join(symbol, scripts(tensor.dimension(), tensor.slots(), numbers))
        });
        Equation { members, value: group.value.latex_with(factors) }
    }

    /// Whether the value is too wide for a display.
    fn is_long(&self) -> bool {
        self.value_width() > WIDTH
    }

    /// The width of the value; of a fraction that of its wider part.
    fn value_width(&self) -> usize {
        let bar = fraction(&self.value).map(|(_, above, below)| width(above).max(width(below)));
        bar.unwrap_or_else(|| width(&self.value))
    }

    /// Lines of an `align*`, broken in front of `=`.
    fn aligned(&self) -> String {
        let mut text = self.members[0].clone();
        let mut column = width(&text);
        let members = self.members[1..].iter().map(|member| (member, width(member)));
        let pieces = members.chain([(&self.value, self.value_width())]);
        for (position, (piece, piece_width)) in pieces.enumerate() {
            let full = column + 3 + piece_width > WIDTH;
            text.push_str(match (position, full) {
                (0, _) => " &= ",
                // the star keeps the lines of one equation on one page
                (_, true) => " \\\\*\n&= ",
                (_, false) => " = ",
            });
            column = if full && position > 0 { 8 } else { column } + 3 + piece_width;
            text.push_str(piece);
        }
        text
    }

    /// A paragraph, which TeX breaks at relations and signs. A fraction is written with a slash, because TeX cannot break
    /// a fraction bar.
    fn inline(&self) -> String {
        let value = match fraction(&self.value).filter(|_| self.is_long()) {
            Some((sign, above, below)) => format!("{sign}({above})/({below})"),
            None => self.value.clone(),
        };
        // TeX breaks no line between \left and \right
        let value = value.replace("\\left(", "(").replace("\\right)", ")");
        format!("\\hangindent=2em ${} = {value}$\\par", self.members.join(" = "))
    }
}

/// The symbol with its indices: `R^{1}{}_{212}`.
fn join(symbol: &str, scripts: Vec<(Variance, String)>) -> String {
    let scripts = scripts.into_iter().map(|(variance, indices)| {
        let mark = if variance == Up { '^' } else { '_' };
        format!("{mark}{{{indices}}}")
    });
    symbol.to_string() + &scripts.collect::<Vec<_>>().join("{}")
}

/// The sign and the two parts of `-\frac{a}{b}`; `None` for anything but one fraction.
fn fraction(value: &str) -> Option<(&str, &str, &str)> {
    let (sign, rest) = value.split_once("\\frac{")?;
    let (above, rest) = rest.split_at(closing(rest)?);
    let below = rest.strip_prefix("}{")?;
    let end = closing(below)?;
    let whole = end + 1 == below.len() && matches!(sign, "" | "-");
    whole.then(|| (sign, above, &below[..end]))
}

/// The position of the brace that closes the one at the start.
fn closing(text: &str) -> Option<usize> {
    let mut depth = 0usize;
    for (at, c) in text.char_indices() {
        match c {
            '{' => depth += 1,
            '}' if depth == 0 => return Some(at),
            '}' => depth -= 1,
            _ => {}
        }
    }
    None
}

/// The approximate width of a formula in letters.
pub(super) fn width(latex: &str) -> usize {
    let mut width = 0;
    let mut command = false;
    for c in latex.chars() {
        let letter = command && c.is_ascii_alphabetic();
        width += usize::from(!letter && !matches!(c, '{' | '}' | '^' | '_'));
        command = letter || c == '\\';
    }
    width
}

/// A basis vector: `e1` is `$e_{1}$`; a label that is no identifier stays text.
fn label_name(label: &str) -> String {
    match <Symbolic as Notation>::parameter(label) {
        Some(name) => format!("${}$", name.latex()),
        None => escape(&printable(label)),
    }
}

/// A basis vector within a formula.
fn in_formula(label: &str) -> String {
    match <Symbolic as Notation>::parameter(label) {
        Some(name) => name.latex(),
        None => format!("\\text{{{}}}", escape(&printable(label))),
    }
}

/// The groups of components of a tensor with a symbol of its own, as lines of an `align*`.
pub fn components_in_latex<S: Notation>(symbol: &str, tensor: &Tensor<S>) -> Vec<String> {
    let none = CommonFactors::default();
    let aligned = |group: &Group<S>| Equation::new(symbol, tensor, group, &none).aligned();
    groups(tensor).iter().map(aligned).collect()
}

/// One group of components as a formula within text.
pub(super) fn equation<S: Notation>(
    quantity: Quantity,
    tensor: &Tensor<S>,
    group: &Group<S>,
) -> String {
    let none = CommonFactors::default();
    let equation = Equation::new(&quantity.latex(), tensor, group, &none);
    equation.inline().trim_end_matches("\\par").into()
}

/// A line in which every space counts: a box, at whose start TeX drops none.
pub(super) fn verbatim(line: &str) -> String {
    format!("\\mbox{{\\footnotesize\\ttfamily {}}}", escape(line).replace(' ', "~"))
}

/// Text in which no character is a command.
pub(crate) fn escape(text: &str) -> String {
    let mut escaped = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '\\' => escaped.push_str("\\textbackslash{}"),
            '^' => escaped.push_str("\\textasciicircum{}"),
            '~' => escaped.push_str("\\textasciitilde{}"),
            '<' => escaped.push_str("\\textless{}"),
            '>' => escaped.push_str("\\textgreater{}"),
            '|' => escaped.push_str("\\textbar{}"),
            '{' | '}' | '#' | '$' | '%' | '&' | '_' => escaped.extend(['\\', c]),
            _ => escaped.push(c),
        }
    }
    escaped
}
