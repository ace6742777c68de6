//! Tables of structure constants for GAP: a program with `SetEntrySCTable`, or a list as GAP prints
//! it.

use super::{Entry, expect_characteristic_0, list as items, numbered, refuse};
use crate::input::{InputError, Source};
use crate::space::Definition;

/// Whether a text is a table for GAP.
pub(super) fn is_table(text: &str) -> bool {
    text.contains("EmptySCTable")
        || (text.trim_start().starts_with("[ [") && list_end(text).is_some())
}

/// The end of a printed table, which contains the symmetry and the zero of the field.
fn list_end(text: &str) -> Option<&str> {
    let inside = text.trim().trim_end_matches(';').trim_end().strip_suffix(']')?;
    inside.rsplit_once(']').map(|(_, end)| end).filter(|end| end.matches(',').count() == 2)
}

/// Reads the algebra from a table.
pub(super) fn definition(source: &Source) -> Result<Definition, InputError> {
    expect_characteristic_0(source)?;
    let text = source.content();
    let (dimension, entries) = match text.contains("EmptySCTable") {
        true => program(source, text)?,
        false => list(source, text)?,
    };
    numbered(source, dimension, &entries)
}

type Table<'t> = (usize, Vec<Entry<'t>>);

/// Parses a program: `EmptySCTable( n, ... )` and lines `SetEntrySCTable( T, j, k, [ v, i, ... ]
/// )`.
fn program<'t>(source: &Source, text: &'t str) -> Result<Table<'t>, InputError> {
    const HEAD: &str = "EmptySCTable";
    const ENTRY: &str = "SetEntrySCTable";
    let behind = text.split_once(HEAD).map_or("", |(_, behind)| behind);
    let number = behind.trim_start().strip_prefix('(').and_then(|rest| rest.split_once(','));
    let number = number.map_or("", |(number, _)| number).trim();
    let Ok(dimension) = number.parse() else {
        return refuse(source, number, "the first argument of EmptySCTable must be the dimension");
    };
    let mut entries = vec![];
    for statement in text.split(';').filter(|statement| !is_comment(statement)) {
        let Some((_, call)) = statement.split_once(ENTRY) else { continue };
        let parts = call.trim().strip_prefix('(').and_then(|call| call.strip_suffix(')'));
        let parts = parts.and_then(|parts| parts.split_once('['));
        let Some((head, terms)) = parts else {
            return refuse(source, statement.trim(), "write SetEntrySCTable( T, j, k, [ v, i ] )");
        };
        let head: Vec<&str> = head.split(',').map(str::trim).collect();
        let terms = terms.trim_end().trim_end_matches(']');
        let terms: Vec<&str> = terms.split(',').map(str::trim).filter(|t| !t.is_empty()).collect();
        let ([_, j, k, ..], true) = (&head[..], terms.len().is_multiple_of(2)) else {
            return refuse(source, statement.trim(), "write SetEntrySCTable( T, j, k, [ v, i ] )");
        };
        entries.extend(terms.chunks(2).map(|pair| Entry {
            j: (*j).into(),
            k: (*k).into(),
            i: pair[1].into(),
            negative: false,
            value: pair[0],
            place: statement.trim(),
        }));
    }
    Ok((dimension, entries))
}

/// Whether all lines of a statement are comments.
fn is_comment(statement: &str) -> bool {
    statement.lines().all(|line| line.trim().is_empty() || line.trim_start().starts_with('#'))
}

/// Parses a list `[ [ [ [ i, ... ], [ v, ... ] ], ... ], ..., symmetry, 0 ]`, where `j` is the row
/// and `k` is the column.
fn list<'t>(source: &Source, text: &'t str) -> Result<Table<'t>, InputError> {
    let trimmed = text.trim().trim_end_matches(';').trim();
    let rows = items(trimmed).unwrap_or_default();
    let dimension = rows.len().saturating_sub(2);
    let mut entries = vec![];
    for (j, row) in rows.iter().take(dimension).enumerate() {
        let columns = items(row).unwrap_or_default();
        if columns.len() != dimension {
            let message = format!("row {} has {} entries, not {dimension}", j + 1, columns.len());
            return refuse(source, row, &message);
        }
        for (k, column) in columns.iter().enumerate() {
            let pair = items(column).unwrap_or_default();
            let lists: Vec<Vec<&str>> =
                pair.iter().map(|part| items(part).unwrap_or_default()).collect();
            let [indices, values] = &lists[..] else {
                return refuse(
                    source,
                    column,
                    "an entry must be a list of indices and a list of values",
                );
            };
            if indices.len() != values.len() {
                return refuse(source, column, "the numbers of indices and values differ");
            }
            entries.extend(indices.iter().zip(values).map(|(i, value)| Entry {
                j: (j + 1).to_string().into(),
                k: (k + 1).to_string().into(),
                i: (*i).into(),
                negative: false,
                value,
                place: column,
            }));
        }
    }
    Ok((dimension, entries))
}
