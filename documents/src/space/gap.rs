//! Tables of structure constants of GAP: as a program of `SetEntrySCTable`, or as the list that GAP prints.

use crate::input::{InputError, Source, shown};
use crate::space::{Definition, Given, Origin, Pairs, check_dimension, notation::Names};
use affinor_tensors::{Ring, Symbolic};
use std::collections::BTreeMap;

/// Whether a text is a table of GAP.
pub(super) fn is_table(text: &str) -> bool {
    text.contains("EmptySCTable")
        || (text.trim_start().starts_with("[ [") && list_end(text).is_some())
}

/// What a printed table ends with: the symmetry and the zero.
fn list_end(text: &str) -> Option<&str> {
    let inside = text.trim().trim_end_matches(';').trim_end().strip_suffix(']')?;
    inside.rsplit_once(']').map(|(_, end)| end).filter(|end| end.matches(',').count() == 2)
}

/// The algebra of a table.
pub(super) fn definition(source: &Source) -> Result<Definition, InputError> {
    let text = source.content();
    let (dimension, entries) = match text.contains("EmptySCTable") {
        true => program(source, text)?,
        false => list(source, text)?,
    };
    let n = check_dimension(dimension)?;
    let labels: Vec<String> = (1..=n).map(|at| format!("e{at}")).collect();
    let none = BTreeMap::new();
    let names = Names::open(&none, None);
    let mut given = Pairs::new();
    for Entry { j, k, i, value, place } in entries {
        let index = |at: &str| {
            let number: Option<usize> = at.trim().parse().ok();
            number.filter(|at| (1..=n).contains(at)).map(|at| at - 1).ok_or_else(|| {
                let message = format!("the index {} is not in 1..{n}", shown(at));
                InputError::usage(message).at(&source.whole(place))
            })
        };
        let (j, k, i) = (index(&j)?, index(&k)?, index(i)?);
        let value = names.scalar(value.trim(), source)?;
        let pair = given
            .entry((j, k))
            .or_insert_with(|| Given { value: BTreeMap::new(), place: source.whole(place) });
        let sum = pair.value.remove(&i).unwrap_or_else(|| Symbolic::from_i64(0));
        pair.value.insert(i, sum + &value);
    }
    let name = source.name.rsplit('/').next().unwrap_or_default().to_string();
    let mut definition = Definition::new(name, labels, Origin::Brackets(given));
    definition.source = Some(source.clone());
    Ok(definition)
}

/// One constant as written: `[e_j, e_k] = .. + value e_i`.
struct Entry<'t> {
    j: String,
    k: String,
    i: &'t str,
    value: &'t str,
    place: &'t str,
}

type Table<'t> = (usize, Vec<Entry<'t>>);

fn refuse<T>(source: &Source, part: &str, message: &str) -> Result<T, InputError> {
    Err(InputError::usage(message).at(&source.whole(part)))
}

/// `EmptySCTable( n, .. )` and lines `SetEntrySCTable( T, j, k, [ v, i, .. ] )`.
fn program<'t>(source: &Source, text: &'t str) -> Result<Table<'t>, InputError> {
    const HEAD: &str = "EmptySCTable";
    const ENTRY: &str = "SetEntrySCTable";
    let behind = text.split_once(HEAD).map_or("", |(_, behind)| behind);
    let number = behind.trim_start().strip_prefix('(').and_then(|rest| rest.split_once(','));
    let number = number.map_or("", |(number, _)| number).trim();
    let Ok(dimension) = number.parse() else {
        return refuse(source, number, "EmptySCTable begins with the dimension");
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
            j: j.to_string(),
            k: k.to_string(),
            i: pair[1],
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

/// `[ [ [ [ i, .. ], [ v, .. ] ], .. ], .., symmetry, 0 ]`: row `j`, column `k`.
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
                    "an entry is a list of indices and a list of values",
                );
            };
            if indices.len() != values.len() {
                return refuse(source, column, "as many values as indices are needed");
            }
            entries.extend(indices.iter().zip(values).map(|(i, value)| Entry {
                j: (j + 1).to_string(),
                k: (k + 1).to_string(),
                i,
                value,
                place: column,
            }));
        }
    }
    Ok((dimension, entries))
}

/// The items of a list in brackets.
fn items(text: &str) -> Option<Vec<&str>> {
    let inside = text.trim().strip_prefix('[')?.strip_suffix(']')?;
    let (mut depth, mut from, mut items) = (0i64, 0, vec![]);
    for (at, symbol) in inside.char_indices() {
        match symbol {
            '[' => depth += 1,
            ']' => depth -= 1,
            ',' if depth == 0 => {
                items.push(inside[from..at].trim());
                from = at + 1;
            }
            _ => {}
        }
    }
    let last = inside[from..].trim();
    if !(last.is_empty() && items.is_empty()) {
        items.push(last);
    }
    Some(items)
}
