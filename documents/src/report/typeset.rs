//! Reports as formulas: components, brackets and equations of tables.

use super::Quantity;
use super::components::{Group, index_names, needs_commas, plain, runs, with_names};
use super::head::conventions;
use crate::Coefficient;
use crate::formula::lines::chain;
use crate::formula::{Node, Row, formula, label, sum, value};
use affinor_tensors::{CommonFactors, Tensor, Up};
use std::collections::BTreeMap;

/// A summary of the conventions.
pub(super) fn convention_formulas() -> Vec<Row> {
    conventions().split("; ").map(formula).collect()
}

/// The symbol of a quantity with its index letters: `R^i_jkl`.
pub(super) fn general<S: Coefficient>(quantity: Quantity, tensor: &Tensor<S>) -> Row {
    let letters = quantity.letters();
    with_scripts(
        &formula(quantity.symbol()),
        0,
        tensor,
        letters.chars().map(String::from).collect(),
    )
}

/// The sides of `R^1_212 = -R^1_221 = ... = 1/4`, optionally with names as indices.
pub(super) fn sides<S: Coefficient>(
    symbol: &[Node],
    tensor: &Tensor<S>,
    group: &Group<S>,
    factors: &CommonFactors,
    names: Option<&[String]>,
) -> Vec<Row> {
    let members = group.members.iter().map(|(at, negative)| {
        let mut side = with_scripts(symbol, tensor.dimension(), tensor, index_names(at, names));
        if *negative {
            side.insert(0, Node::Sign("−"));
        }
        side
    });
    members.chain([value(&with_names(&group.value, factors))]).collect()
}

/// The equation `R^1_212 = -R^1_221 = ... = 1/4`.
pub(super) fn equation<S: Coefficient>(
    quantity: Quantity,
    tensor: &Tensor<S>,
    group: &Group<S>,
    factors: &CommonFactors,
    names: Option<&[String]>,
) -> Row {
    chain(sides(&formula(quantity.symbol()), tensor, group, factors, names))
}

/// The brackets of the basis vectors, `[e1, e2] = e3`.
pub(super) fn brackets<S: Coefficient>(structure: &Tensor<S>, labels: &[String]) -> Vec<Row> {
    let labels: Vec<Node> = labels.iter().map(|name| label(name)).collect();
    brackets_of(structure, &labels)
}

/// The [`brackets`] of basis vectors with typeset names.
pub(super) fn brackets_of<S: Coefficient>(structure: &Tensor<S>, labels: &[Node]) -> Vec<Row> {
    let mut brackets: BTreeMap<_, Vec<_>> = BTreeMap::new();
    for (at, coefficient) in structure.components().filter(|(at, _)| at[1] < at[2]) {
        let term = (value(&plain(coefficient)), vec![labels[at[0]].clone()]);
        brackets.entry((at[1], at[2])).or_default().push(term);
    }
    let pair = |(j, k): (usize, usize)| {
        let pair = vec![labels[j].clone(), Node::Sign(","), labels[k].clone()];
        vec![Node::Group(crate::formula::Brackets::Square, pair)]
    };
    brackets.into_iter().map(|(at, terms)| chain([pair(at), sum(terms)])).collect()
}

/// The symbol with its indices. Commas separate indices above dimension 9, and names that are not one
/// symbol: `theta` is one, and a comma before an index would mean a derivative.
pub(super) fn with_scripts<S: Coefficient>(
    symbol: &[Node],
    dimension: usize,
    tensor: &Tensor<S>,
    indices: Vec<String>,
) -> Row {
    let is_number = |index: &str| index.bytes().all(|b| b.is_ascii_digit());
    let single = |index: &String| match index.as_str() {
        number if is_number(number) => vec![Node::Number(number.into())],
        name if name.len() == 1 => formula(name),
        name => vec![label(name)],
    };
    let is_symbol = |row: &[Node]| matches!(row, [Node::Letter(_) | Node::Scripts(..)]);
    let run = |(variance, run): (_, Vec<String>)| {
        let nodes = match run.len() {
            1 => single(&run[0]),
            _ if needs_commas(dimension, &run) => {
                let rows: Vec<_> = run.iter().map(single).collect();
                match rows.iter().all(|row| is_symbol(row)) {
                    true => rows.concat(),
                    false => rows.join(&Node::Sign(",")),
                }
            }
            _ if run.iter().all(|index| index.is_ascii()) => vec![Node::Indices(run.concat())],
            _ => run.iter().flat_map(single).collect(),
        };
        (variance == Up, nodes)
    };
    let scripts: Vec<_> = runs(tensor.slots(), indices).into_iter().map(run).collect();
    match symbol.split_last() {
        Some((last, rest)) if !scripts.is_empty() => {
            [rest, &[Node::Scripts(Box::new(last.clone()), scripts)]].concat()
        }
        _ => symbol.to_vec(),
    }
}
