//! Matrices that span an algebra, `[[0, 1], [0, 0]], [[1, 0], [0, -1]]`, in the order of the basis.
//!
//! Rows are in brackets, parentheses or braces, or separated by semicolons as in MATLAB,
//! `[0 1; 0 0]`. A matrix may have a name, `X = [[0, 1], [0, 0]]`.

use super::{enclosed, items, of_brackets, refuse};
use crate::input::{InputError, Source};
use crate::space::notation::{Names, basis};
use crate::space::{Definition, MatrixEntries, Origin, Pairs, check_dimension};
use affinor_tensors::Ring;
use affinor_tensors::expression::canonical_name;
use std::collections::BTreeMap;

/// A matrix: its name, its rows of entries, and the text.
struct Matrix<'t> {
    name: Option<&'t str>,
    rows: Vec<Vec<&'t str>>,
    place: &'t str,
}

const OPEN: [char; 3] = ['[', '(', '{'];

/// Whether a text begins with a list of lists, optionally with a name, and no equation follows it.
pub(super) fn is_table(text: &str) -> bool {
    let (_, text) = named(text.trim_start());
    let Some(inside) = text.starts_with(OPEN).then(|| enclosed(text)).flatten() else {
        return false;
    };
    let behind = text[inside.len() + 2..].trim_start();
    let nested = inside.trim_start().starts_with(OPEN);
    let rows = text.starts_with('[') && inside.contains(';') && !inside.contains('=');
    (nested || rows)
        && !behind.starts_with(['=', '*', '+', '-'])
        && !inside.contains(['\'', '"', ':'])
}

/// A name before a matrix, and the rest.
fn named(text: &str) -> (Option<&str>, &str) {
    match text.split_once('=') {
        Some((name, rest)) if is_name(name.trim()) => (Some(name.trim()), rest.trim_start()),
        _ => (None, text),
    }
}

/// Whether a text is the name of a matrix, such as `X`, `e1` or `E_12`: one letter, and then digits. A
/// longer word may be the key of a definition, such as `metric`.
fn is_name(text: &str) -> bool {
    let mut letters = text.chars();
    letters.next().is_some_and(char::is_alphabetic)
        && letters.all(|c| c.is_ascii_digit() || c == '_' || c == '\'')
}

/// The algebra that the matrices span.
pub(super) fn definition(source: &Source) -> Result<Definition, InputError> {
    let text = source.content();
    let mut matrices = vec![];
    collect(text, source, &mut matrices)?;
    let n = check_dimension(matrices.len())?;
    let has_names = matrices.iter().all(|matrix| matrix.name.is_some());
    let labels: Vec<String> = match has_names {
        true => matrices.iter().filter_map(|m| m.name).map(|m| canonical_name(m).into()).collect(),
        false => (1..=n).map(|at| format!("e{at}")).collect(),
    };
    let borrowed: Vec<&str> = labels.iter().map(String::as_str).collect();
    basis(&borrowed, &|at| source.whole(matrices[at].place))?;
    let (size, all) = entries(&matrices, source)?;
    let mut definition = of_brackets(source, labels, Pairs::new());
    definition.origin = Origin::Matrices(size, all);
    Ok(definition)
}

/// The size and the entries of square matrices of one size.
pub(crate) fn square_matrices(source: &Source) -> Result<(usize, Vec<MatrixEntries>), InputError> {
    let mut matrices = vec![];
    collect(source.content(), source, &mut matrices)?;
    entries(&matrices, source)
}

fn entries(
    matrices: &[Matrix],
    source: &Source,
) -> Result<(usize, Vec<MatrixEntries>), InputError> {
    let size = matrices.first().map_or(0, |matrix| matrix.rows.len());
    let (none, mut all) = (BTreeMap::new(), vec![]);
    let names = Names::open(&none, None);
    for (at, matrix) in matrices.iter().enumerate() {
        let shape = (matrix.rows.len(), matrix.rows.first().map_or(0, Vec::len));
        if size == 0 || shape != (size, size) || matrix.rows.iter().any(|row| row.len() != size) {
            let (rows, columns) = shape;
            let message = format!("matrix {} is {rows} x {columns}, not {size} x {size}", at + 1);
            return refuse(source, matrix.place, message);
        }
        let mut entries: MatrixEntries = vec![];
        for (i, row) in matrix.rows.iter().enumerate() {
            for (j, entry) in row.iter().enumerate() {
                let value = names.complex(entry, source)?;
                if !(value.re.vanishes() && value.im.vanishes()) {
                    entries.push((i, j, value));
                }
            }
        }
        all.push(entries);
    }
    Ok((size, all))
}

/// Collects the matrices of a text: a sequence of them, or a list that contains them.
fn collect<'t>(
    text: &'t str,
    source: &Source,
    all: &mut Vec<Matrix<'t>>,
) -> Result<(), InputError> {
    let mut rest = text;
    loop {
        rest = rest.trim_start_matches([',', ';', '\n', '\r', ' ', '\t', '.']);
        if rest.is_empty() {
            return Ok(());
        }
        let (name, matrix) = named(rest);
        let Some(inside) = matrix.starts_with(OPEN).then(|| enclosed(matrix)).flatten() else {
            return refuse(source, rest.lines().next().unwrap_or(rest), "this is not a matrix");
        };
        let first = inside.trim_start();
        let deep = first.starts_with(OPEN)
            && enclosed(first).is_some_and(|row| row.trim_start().starts_with(OPEN));
        if deep && name.is_none() {
            collect(inside, source, all)?;
        } else {
            all.push(Matrix { name, rows: rows(inside), place: &matrix[..inside.len() + 2] });
        }
        rest = &matrix[inside.len() + 2..];
    }
}

/// The rows of a matrix.
fn rows(inside: &str) -> Vec<Vec<&str>> {
    if inside.trim_start().starts_with(OPEN) {
        return items(inside).into_iter().map(|row| items(enclosed(row).unwrap_or(row))).collect();
    }
    let entries = |row| match items(row) {
        single if single.len() < 2 => row.split_whitespace().collect(),
        entries => entries,
    };
    inside.split([';', '\n']).filter(|row| !row.trim().is_empty()).map(entries).collect()
}
