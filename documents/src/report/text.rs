//! Plain text: groups of equal components in lines of at most 80 columns, in the style of
//! Paraskevopoulos and Natsiavas (2013).

use super::components::{
    GROUPED, Group, count, groups_with, index_names, others, plain, scripts, with_names,
};
use super::head::{conventions, printable};
use super::{Quantity, Table, TableEntry};
use crate::Coefficient;
use affinor_tensors::text::combination;
use affinor_tensors::{CommonFactors, Tensor, Up, Variance};
use std::collections::BTreeMap;
use std::io::{self, Write};
use unicode_width::UnicodeWidthStr;

/// The width of a line.
const WIDTH: usize = 80;
/// The width of the labels in the header.
const TITLE: usize = 13;

pub(super) fn write<S: Coefficient>(table: &Table<S>, out: &mut dyn Write) -> io::Result<()> {
    fill(out, "", &[printable(&table.name)])?;
    let labels: Vec<String> = table.labels.iter().map(|label| printable(label)).collect();
    let mut lines = table.head();
    lines.push(("conventions", conventions()));
    for (title, line) in lines {
        head_line(title, &[line], out)?;
    }
    let named = table.factors();
    for line in &named.lines {
        head_line("where", &[format!("{} =", line.is().join(" = ")), line.text.clone()], out)?;
    }
    for entry in &table.tensors {
        writeln!(out)?;
        tensor(table, entry, (&labels, &named.factors), out)?;
    }
    Ok(())
}

/// Writes a line of the header with its label.
pub(super) fn head_line(title: &str, pieces: &[String], out: &mut dyn Write) -> io::Result<()> {
    fill(out, &format!("  {title:TITLE$}"), pieces)
}

/// A component of a quantity: `R^1_212`.
pub(super) fn component<S: Coefficient>(
    quantity: Quantity,
    tensor: &Tensor<S>,
    indices: &[usize],
) -> String {
    named(quantity.symbol(), tensor, indices, None)
}

/// A component with a given symbol and, optionally, with names as indices: `Lambda^t_tr`.
pub(super) fn named<S: Coefficient>(
    symbol: &str,
    tensor: &Tensor<S>,
    indices: &[usize],
    names: Option<&[String]>,
) -> String {
    join(symbol, scripts(tensor.dimension(), tensor.slots(), index_names(indices, names)))
}

/// Writes the components of a tensor with a given symbol, as in a table: `T^1_2 = T^2_1 = 1/2`, in
/// lines of at most 80 columns.
///
/// ```
/// use affinor_documents::report::{components_in_latex, components_in_text};
/// use affinor::tensors::{Down, Rational, Tensor};
/// let form = Tensor::diagonal([1, 2].map(Rational::from), [Down, Down]);
/// assert_eq!(components_in_text("g", &form), "  g_11 = 1\n  g_22 = 2\n");
/// assert_eq!(components_in_latex("g", &form), ["g_{11} &= 1", "g_{22} &= 2"]);
/// ```
pub fn components_in_text<S: Coefficient>(symbol: &str, tensor: &Tensor<S>) -> String {
    labelled_in_text(symbol, tensor, None)
}

/// Like [`components_in_text`], but indices may be names instead of numbers.
///
/// ```
/// use affinor_documents::report::labelled_in_text;
/// use affinor::tensors::{Down, Rational, Tensor};
/// let form = Tensor::diagonal([1, 2].map(Rational::from), [Down, Down]);
/// let names = ["r", "theta"].map(String::from);
/// assert_eq!(labelled_in_text("g", &form, Some(&names)), "  g_rr = 1\n  g_theta,theta = 2\n");
/// ```
pub fn labelled_in_text<S: Coefficient>(
    symbol: &str,
    tensor: &Tensor<S>,
    names: Option<&[String]>,
) -> String {
    let mut text = Vec::new();
    // ignores the result: writing to a vector cannot fail
    let _ = components(symbol, tensor, &CommonFactors::default(), names, &mut text);
    String::from_utf8_lossy(&text).into_owned()
}

/// Writes groups of components; of a tensor with many components, one component per line.
fn components<S: Coefficient>(
    symbol: &str,
    tensor: &Tensor<S>,
    factors: &CommonFactors,
    names: Option<&[String]>,
    out: &mut dyn Write,
) -> io::Result<()> {
    let name = |at: &[usize]| named(symbol, tensor, at, names);
    if tensor.len() > GROUPED {
        return tensor.components().try_for_each(|(at, value)| {
            fill(out, "  ", &[name(&at), format!("= {}", with_names(value, factors))])
        });
    }
    groups_with(tensor, factors)
        .iter()
        .try_for_each(|group| fill(out, "  ", &equation(group, factors, name)))
}

/// The symbol of a quantity with its index letters: `R^i_jkl`.
pub(super) fn general<S: Coefficient>(quantity: Quantity, tensor: &Tensor<S>) -> String {
    join(
        quantity.symbol(),
        scripts(0, tensor.slots(), quantity.letters().chars().map(String::from)),
    )
}

fn tensor<S: Coefficient>(
    table: &Table<S>,
    entry: &TableEntry<S>,
    (labels, factors): (&[String], &CommonFactors),
    out: &mut dyn Write,
) -> io::Result<()> {
    let (quantity, title) = (entry.quantity, table.title(entry.quantity));
    let shown = table.shown(entry);
    if shown.is_empty() {
        writeln!(out, "{title}")?;
        return writeln!(out, "  {} = 0", general(quantity, &shown));
    }
    let grouped = shown.len() <= GROUPED;
    let style = if grouped { "" } else { ", one per line" };
    match count(&entry.tensor, &shown) {
        Some(count) => writeln!(out, "{title}: {count}{style}")?,
        None => writeln!(out, "{title}")?,
    }
    if grouped && quantity == Quantity::Structure && labels.len() == shown.dimension() {
        for (left, right) in brackets(&entry.tensor, labels, plain) {
            fill(out, "  ", &[format!("{left} ="), right])?;
        }
    }
    components(quantity.symbol(), &shown, factors, table.index_names.as_deref(), out)?;
    others(&entry.tensor, &shown).map_or(Ok(()), |others| writeln!(out, "  {others}"))
}

/// The brackets of the basis vectors, as pairs such as `[e1, e2]` and `e3`. `written` writes a
/// value.
pub(super) fn brackets<S: Coefficient>(
    structure: &Tensor<S>,
    labels: &[String],
    written: impl Fn(&S) -> String,
) -> Vec<(String, String)> {
    let mut brackets: BTreeMap<_, Vec<_>> = BTreeMap::new();
    for (at, value) in structure.components().filter(|(at, _)| at[1] < at[2]) {
        brackets.entry((at[1], at[2])).or_default().push((written(value), labels[at[0]].clone()));
    }
    let pair = |(j, k): (usize, usize)| format!("[{}, {}]", labels[j], labels[k]);
    brackets.into_iter().map(|(at, terms)| (pair(at), combination(terms))).collect()
}

/// The components of a tensor with a given symbol. Components that are equal up to sign are on one
/// line: `tau^1_23 = -tau^1_32 = 1`.
pub fn grouped_in_text<S: Coefficient>(symbol: &str, tensor: &Tensor<S>) -> Vec<String> {
    let name = |at: &[usize]| named(symbol, tensor, at, None);
    let none = CommonFactors::default();
    let groups = groups_with(tensor, &none);
    groups.iter().map(|group| equation(group, &none, name).join(" ")).collect()
}

/// The pieces of an equation, between which a line may be broken: `R^1_212`, `= -R^1_221`, ..., `=
/// 1/4`.
pub(super) fn equation<S: Coefficient>(
    group: &Group<S>,
    factors: &CommonFactors,
    name: impl Fn(&[usize]) -> String,
) -> Vec<String> {
    let mut pieces = group.names(name);
    pieces.push(with_names(&group.value, factors));
    pieces[1..].iter_mut().for_each(|piece| piece.insert_str(0, "= "));
    pieces
}

/// The symbol followed by its indices, with `^` before upper indices and `_` before lower indices.
pub(super) fn join(symbol: &str, scripts: Vec<(Variance, String)>) -> String {
    scripts.into_iter().fold(symbol.into(), |text, (variance, indices)| {
        text + if variance == Up { "^" } else { "_" } + &indices
    })
}

/// Writes pieces, separated by spaces, in lines of at most [`WIDTH`] columns. The first line begins
/// with `start`. Further lines are indented by the width of `start` plus two. A piece that is wider
/// than a line is broken at its spaces, but not within words.
pub(super) fn fill(out: &mut dyn Write, start: &str, pieces: &[String]) -> io::Result<()> {
    let indent = " ".repeat(start.width() + if start.trim().is_empty() { 2 } else { 0 });
    let mut line = start.to_string();
    let mut fresh = true;
    let mut put = |word: &str| {
        let space = usize::from(!fresh);
        if !fresh && line.width() + space + word.width() > WIDTH {
            writeln!(out, "{line}")?;
            line.clone_from(&indent);
            fresh = true;
        }
        if !fresh {
            line.push(' ');
        }
        line.push_str(word);
        fresh = false;
        io::Result::Ok(())
    };
    for piece in pieces {
        if indent.len() + piece.width() > WIDTH {
            piece.split(' ').try_for_each(&mut put)?;
        } else {
            put(piece)?;
        }
    }
    writeln!(out, "{line}")
}
