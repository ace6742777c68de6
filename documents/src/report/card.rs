//! Cards: one tensor of a space for a page, short enough to read.
//!
//! A card shows one component for each set that is related by symmetry, and says which symmetries
//! relate the others. Long tensors are summarized, and listed for given indices.

mod eigenvalues;
mod symmetry;

use super::components::{groups, index_names, plain};
use super::computation::Computation;
use super::head::printable;
use super::html::list;
use super::typeset::{brackets_of, equation, general, with_scripts};
use super::{Quantity, Selection};
use crate::formula::lines::chain;
use crate::formula::mathml::{self, WIDE, escaped};
use crate::formula::{Node, Row, formula, label, prose, sum, value};
use crate::input::InputError;
use crate::{Coefficient, over_kind};
use affinor::Geometry;
use affinor_tensors::{CommonFactors, Field, Tensor, contract};
use eigenvalues::eigenvalues;
use std::collections::BTreeMap;
use symmetry::Symmetries;

/// The largest number of components that are listed without a filter.
const LISTED: usize = 80;
/// The largest number of components that are listed with a filter.
const FILTERED: usize = 400;
/// The largest number of names in one equation.
const CHAINED: usize = 12;
/// The largest matrix that is drawn.
const MATRIX: usize = 10;
/// The largest width of a matrix in characters; a wider one is listed entry by entry.
const MATRIX_WIDTH: usize = 60;
/// The largest number of distinct values in a summary.
const VALUES: usize = 8;

/// A tensor for a page.
#[derive(Clone, Debug)]
pub struct Card {
    /// The heading.
    pub title: &'static str,
    /// The content in HTML, with formulas in MathML.
    pub html: String,
    /// The definition, with its conventions, in HTML.
    pub definition: String,
    /// The letters of the indices.
    pub letters: String,
    /// The number of nonzero components.
    pub count: usize,
    /// Whether the components were summarized, so that a filter lists more of them.
    pub summarized: bool,
}

/// The content of a card.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CardKind {
    /// The brackets of the basis vectors, or of the fields on a chart, and the structure equations.
    Brackets,
    /// A tensor.
    Tensor(Quantity),
}

impl Computation<'_> {
    /// The card of a tensor; `None` if the tensor is not defined for the space. The filter has an
    /// index, from 1, or nothing for each slot: `1,,2,` lists `T_1j2l`.
    ///
    /// # Errors
    /// An error for an invalid space, and for a filter that does not fit the tensor.
    pub fn card(&self, kind: CardKind, filter: &str) -> Result<Option<Card>, InputError> {
        over_kind!(self.kind()?, S => {
            card(&self.geometry::<S>(&Selection::default())?, kind, filter)
        })
    }
}

fn card<S: Coefficient + Field>(
    geometry: &Geometry<S>,
    kind: CardKind,
    filter: &str,
) -> Result<Option<Card>, InputError> {
    let quantity = match kind {
        CardKind::Brackets => Quantity::Structure,
        CardKind::Tensor(quantity) => quantity,
    };
    let Some(tensor) = quantity.of(geometry)? else { return Ok(None) };
    let filter = read_filter(filter, &tensor)?;
    let labels: Vec<Node> = match geometry.frame_origin().fields() {
        // the fields of coordinates are partial derivatives
        Some(fields) if geometry.frame_name() == "coordinate" => {
            fields.chart().coordinates().iter().map(|name| derivative(name)).collect()
        }
        _ => geometry.frame().labels().iter().map(|name| label(&printable(name))).collect(),
    };
    let fixed = filter.iter().any(Option::is_some);
    let kept = match fixed {
        true => tensor.filter_map(|at, value| {
            let fits = filter.iter().zip(at).all(|(wanted, at)| wanted.is_none_or(|w| w == *at));
            fits.then(|| value.clone())
        }),
        false => tensor.clone(),
    };
    let most = if fixed { FILTERED } else { LISTED };
    let content = match kind {
        CardKind::Brackets if !fixed => bracket_lines(&kept, &labels, most),
        CardKind::Tensor(Quantity::Affinities) => derivative_lines(&kept, &labels, most),
        CardKind::Tensor(Quantity::Ricci) if !fixed => ricci(&kept, geometry)?,
        CardKind::Tensor(Quantity::Metric | Quantity::Killing | Quantity::InverseMetric)
            if !fixed =>
        {
            matrix(quantity, &kept)
        }
        _ => None,
    };
    let content = content.or_else(|| components(quantity, &kept, fixed, most));
    let summarized = content.is_none();
    let title = match kind {
        CardKind::Brackets => "Brackets",
        CardKind::Tensor(Quantity::Affinities) => "Connection",
        CardKind::Tensor(quantity) => quantity.title(),
    };
    Ok(Some(Card {
        title,
        html: content.unwrap_or_else(|| summary(&kept)),
        definition: format!("<p>{}</p>", prose::html(&quantity.definition())),
        letters: quantity.letters(),
        count: kept.len(),
        summarized,
    }))
}

/// The index of each slot, from 0, or `None` for every index.
fn read_filter<S: Coefficient>(
    text: &str,
    tensor: &Tensor<S>,
) -> Result<Vec<Option<usize>>, InputError> {
    if text.trim().is_empty() {
        return Ok(vec![]);
    }
    let n = tensor.dimension();
    let index = |part: &str| match part.trim() {
        "" | "*" => Ok(None),
        number => match number.parse::<usize>().ok().filter(|at| (1..=n).contains(at)) {
            Some(at) => Ok(Some(at - 1)),
            None => Err(InputError::usage(format!("the index {number} is not in 1 to {n}"))),
        },
    };
    let filter = text.split(',').map(index).collect::<Result<Vec<_>, _>>()?;
    match filter.len() == tensor.rank() {
        true => Ok(filter),
        false => Err(InputError::usage(format!("the tensor has {} indices", tensor.rank()))),
    }
}

/// The brackets, and the structure equations of the dual basis; `None` if they are too many.
fn bracket_lines<S: Coefficient>(
    structure: &Tensor<S>,
    labels: &[Node],
    most: usize,
) -> Option<String> {
    let lines = brackets_of(structure, labels);
    if lines.len() > most {
        return None;
    }
    if lines.is_empty() {
        return Some("<p>All brackets of the basis vectors are zero.</p>".into());
    }
    let equations = structure_equations(structure);
    Some(format!(
        "{}\n<p class=\"rest\">All other brackets of basis vectors are zero.</p>\n\
         <details><summary>as structure equations</summary>{}</details>",
        list(&lines, WIDE),
        list(&equations, WIDE)
    ))
}

/// The partial derivative `∂_x` by a coordinate.
fn derivative(coordinate: &str) -> Node {
    Node::Scripts(Box::new(Node::Letter('∂')), vec![(false, vec![label(coordinate)])])
}

/// The structure equations `d e^i = -c^i_jk e^j ∧ e^k`, over `j < k`.
fn structure_equations<S: Coefficient>(structure: &Tensor<S>) -> Vec<Row> {
    let form = |at: usize| {
        Node::Scripts(
            Box::new(Node::Letter('e')),
            vec![(true, vec![Node::Number((at + 1).to_string())])],
        )
    };
    let mut terms: BTreeMap<usize, Vec<(Row, Row)>> = BTreeMap::new();
    for (at, coefficient) in structure.components().filter(|(at, _)| at[1] < at[2]) {
        let product = vec![form(at[1]), Node::Sign("∧"), form(at[2])];
        let term = (value(&plain(&-coefficient.clone())), product);
        terms.entry(at[0]).or_default().push(term);
    }
    let line = |(i, terms): (usize, Vec<(Row, Row)>)| {
        chain([vec![Node::Letter('d'), form(i)], sum(terms)])
    };
    terms.into_iter().map(line).collect()
}

/// The derivatives `∇_{e_j} e_k`; `None` if they are too many.
fn derivative_lines<S: Coefficient>(
    affinities: &Tensor<S>,
    labels: &[Node],
    most: usize,
) -> Option<String> {
    let mut lines: BTreeMap<(usize, usize), Vec<(Row, Row)>> = BTreeMap::new();
    for (at, coefficient) in affinities.components() {
        let term = (value(&plain(coefficient)), vec![labels[at[0]].clone()]);
        lines.entry((at[1], at[2])).or_default().push(term);
    }
    if lines.len() > most {
        return None;
    }
    if lines.is_empty() {
        return Some("<p>All derivatives of the basis fields are zero.</p>".into());
    }
    let nabla = |(j, k): (usize, usize)| {
        let direction = vec![(false, vec![labels[j].clone()])];
        vec![Node::Scripts(Box::new(Node::Letter('∇')), direction), labels[k].clone()]
    };
    let lines: Vec<Row> =
        lines.into_iter().map(|(at, terms)| chain([nabla(at), sum(terms)])).collect();
    Some(format!(
        "{}\n<p class=\"rest\">All other derivatives of basis fields are zero.</p>",
        list(&lines, WIDE)
    ))
}

/// The Ricci tensor as a matrix, and the eigenvalues of its operator.
fn ricci<S: Coefficient + Field>(
    ricci: &Tensor<S>,
    geometry: &Geometry<S>,
) -> Result<Option<String>, InputError> {
    let listed = || components(Quantity::Ricci, ricci, false, LISTED);
    let Some(drawn) = matrix(Quantity::Ricci, ricci).or_else(listed) else { return Ok(None) };
    if ricci.is_empty() {
        return Ok(Some(drawn));
    }
    let Some(metric) = geometry.metric() else {
        return Ok(Some(drawn + "<p class=\"rest\">Eigenvalues need a metric.</p>"));
    };
    let operator = contract("g^ik r_kj -> ^i_j", &[("g", metric.inverse()), ("r", ricci)])
        .map_err(affinor::Error::from)?;
    let operator_name = formula("g^ik Ric_kj");
    let name = mathml::inline(&operator_name);
    let eigenvalues = match eigenvalues(&operator) {
        Some(all) => {
            let each = all.iter().map(|eigenvalue| {
                let sign = if eigenvalue.approximate { "≈ " } else { "" };
                let times = match eigenvalue.multiplicity {
                    1 => String::new(),
                    many => format!(" ({many} times)"),
                };
                format!("{sign}{}{times}", mathml::inline(&value(&eigenvalue.text)))
            });
            format!("Eigenvalues of {name}: {}", each.collect::<Vec<_>>().join(", "))
        }
        None => {
            format!("The eigenvalues of {name} have no short formula; give the letters values.")
        }
    };
    Ok(Some(format!("{drawn}<p>{eigenvalues}</p>")))
}

/// A tensor with two indices as a matrix; `None` if it is too large or too wide.
fn matrix<S: Coefficient>(quantity: Quantity, tensor: &Tensor<S>) -> Option<String> {
    let n = tensor.dimension();
    let symbol = mathml::inline(&general(quantity, tensor));
    if tensor.is_empty() {
        let zero = chain([general(quantity, tensor), value("0")]);
        return Some(format!("<p>{}</p>", mathml::inline(&zero)));
    }
    if n > MATRIX {
        return None;
    }
    let row = |i: usize| (0..n).map(|j| plain(&tensor.get(&[i, j]))).collect();
    let entries: Vec<Vec<String>> = (0..n).map(row).collect();
    /// Characters between two columns.
    const GAP: usize = 2;
    let width = |j: usize| entries.iter().map(|row| row[j].chars().count()).max().unwrap_or(0);
    if (0..n).map(|j| width(j) + GAP).sum::<usize>() > MATRIX_WIDTH {
        return None;
    }
    let entry = |text: &String| format!("<mtd>{}</mtd>", mathml::row(&value(text)));
    let row =
        |row: &Vec<String>| format!("<mtr>{}</mtr>", row.iter().map(entry).collect::<String>());
    let rows: String = entries.iter().map(row).collect();
    let text: Vec<String> = entries.iter().map(|row| row.join(", ")).collect();
    Some(format!(
        "<div class=\"matrix\" tabindex=\"0\">{symbol}<math display=\"block\" alttext=\"[{}]\"><mrow><mo>=</mo>\
         <mo stretchy=\"true\">(</mo><mtable displaystyle=\"true\">{rows}</mtable>\
         <mo stretchy=\"true\">)</mo></mrow></math></div>",
        escaped(&text.join("; "))
    ))
}

/// One component of each set that is related by symmetry; `None` if they are too many.
fn components<S: Coefficient>(
    quantity: Quantity,
    tensor: &Tensor<S>,
    fixed: bool,
    most: usize,
) -> Option<String> {
    if tensor.is_empty() {
        let zero = match fixed {
            true => return Some("<p>All components with these indices are zero.</p>".into()),
            false => chain([general(quantity, tensor), value("0")]),
        };
        return Some(format!("<p>{}</p>", mathml::inline(&zero)));
    }
    // components with given indices are listed one by one
    let symmetries = (!fixed).then(|| Symmetries::of(tensor));
    let shown = match &symmetries {
        Some(symmetries) => {
            tensor.filter_map(|at, value| symmetries.represents(at).then(|| value.clone()))
        }
        None => tensor.clone(),
    };
    if shown.len() > most {
        return None;
    }
    let factors = CommonFactors::default();
    let all = groups(&shown);
    let short = all.iter().map(|group| match group.members.len() {
        ..=CHAINED => equation(quantity, &shown, group, &factors, None),
        _ => {
            let mut first = group.clone();
            first.members.truncate(CHAINED - 1);
            let mut names: Vec<Row> = first
                .members
                .iter()
                .map(|(at, negative)| {
                    let symbol = formula(quantity.symbol());
                    let mut name =
                        with_scripts(&symbol, shown.dimension(), &shown, index_names(at, None));
                    if *negative {
                        name.insert(0, Node::Sign("−"));
                    }
                    name
                })
                .collect();
            names.push(vec![Node::Sign("…")]);
            names.push(value(&plain(&group.value)));
            chain(names)
        }
    });
    let lines = list(&short.collect::<Vec<_>>(), WIDE);
    let words = symmetries.as_ref().and_then(|symmetries| symmetries.words(&quantity.letters()));
    let rest = match words {
        _ if tensor.rank() == 0 => String::new(),
        Some(words) => format!("{words}; all other components are zero."),
        None => "All other components are zero.".into(),
    };
    let capital = rest.chars().next().map(|c| c.to_uppercase().to_string() + &rest[c.len_utf8()..]);
    Some(format!("{lines}\n<p class=\"rest\">{}</p>", capital.unwrap_or_default()))
}

/// The number of components and their values.
fn summary<S: Coefficient>(tensor: &Tensor<S>) -> String {
    let mut values: Vec<String> = vec![];
    for (_, value) in tensor.components() {
        let text = plain(value);
        let size = text.strip_prefix('-').unwrap_or(&text);
        if !values.iter().any(|known| known == size) {
            values.push(size.into());
        }
        if values.len() > VALUES {
            break;
        }
    }
    let written: Vec<String> =
        values.iter().take(VALUES).map(|text| mathml::inline(&value(text))).collect();
    let more = if values.len() > VALUES { ", …" } else { "" };
    format!(
        "<p><strong>{}</strong> nonzero components. Their values up to sign: {}{more}. Choose \
         indices to list them.</p>",
        grouped(tensor.len()),
        written.join(", ")
    )
}

/// A number with thin spaces between groups of three digits.
fn grouped(number: usize) -> String {
    let digits = number.to_string();
    let mut out = String::new();
    for (at, digit) in digits.chars().enumerate() {
        if at > 0 && (digits.len() - at).is_multiple_of(3) {
            out.push('\u{2009}');
        }
        out.push(digit);
    }
    out
}
