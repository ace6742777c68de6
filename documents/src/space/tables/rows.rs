//! Structure constants in CSV: a row `i,j,k,value` means `[e_j, e_k] = ... + value e_i`. The tables
//! of affinor have this order of columns.
//!
//! A header may name the columns `i`, `j`, `k` and `value` (or `c`) in any order. If there is a
//! column `tensor`, only rows with the value `structure` are used. Columns are separated by commas,
//! semicolons, tabs or spaces.

use super::{Entry, first_line, numbered, refuse};
use crate::input::{InputError, Source, shown};
use crate::space::Definition;
use std::collections::BTreeSet;

/// Names that a header may use for the column of values.
const VALUE: [&str; 5] = ["value", "c", "v", "coefficient", "constant"];

/// Whether the first line is a header that names `i`, `j` and `k`, or a row of at least four
/// columns without brackets and `=`.
pub(super) fn is_table(text: &str) -> bool {
    let first = first_line(text);
    let fields = fields(first, separator(first));
    let separated =
        first.contains([',', ';', '\t']) || fields.iter().take(3).all(|field| is_index(field));
    !first.contains(['(', '[', '{', '=', '<']) && fields.len() >= 4 && separated
}

/// The positions of the columns.
struct Columns {
    tensor: Option<usize>,
    /// The positions of `i`, `j` and `k`.
    indices: [usize; 3],
    value: usize,
    /// The positions of all columns of indices, including those that only tensors of higher rank
    /// use.
    all: Vec<usize>,
    count: usize,
}

impl Columns {
    /// The order of columns in tables without a header.
    fn default() -> Self {
        Columns { tensor: None, indices: [0, 1, 2], value: 3, all: vec![0, 1, 2], count: 4 }
    }

    /// The positions that a header gives.
    fn named(head: &[&str], line: &str, source: &Source) -> Result<Self, InputError> {
        let names: Vec<String> = head.iter().map(|name| name.to_lowercase()).collect();
        let find = |name: &str| names.iter().position(|other| other == name);
        let value = VALUE.iter().find_map(|name| find(name));
        let (Some(i), Some(j), Some(k), Some(value)) = (find("i"), find("j"), find("k"), value)
        else {
            let message = format!("the columns are named {}", shown(&head.join(", ")));
            return Err(InputError::usage(message)
                .at(&source.whole(line))
                .help("name them i, j, k and value: [e_j, e_k] = value e_i"));
        };
        let is_column = |at: &usize| matches!(names[*at].as_bytes(), [b'i'..=b'p']);
        let all = (0..names.len()).filter(is_column).collect();
        Ok(Columns { tensor: find("tensor"), indices: [i, j, k], value, all, count: names.len() })
    }
}

/// Reads the algebra from the rows. Its dimension is the highest index.
pub(super) fn definition(source: &Source) -> Result<Definition, InputError> {
    let text = source.content();
    let first = first_line(text);
    let separator = separator(first);
    let head = fields(first, separator);
    let is_head = !is_index(head[0]);
    let columns = match is_head {
        true => Columns::named(&head, first, source)?,
        false => Columns::default(),
    };
    let lines =
        text.lines().map(str::trim).filter(|line| !(line.is_empty() || line.starts_with('#')));
    let (mut entries, mut seen, mut dimension, mut others) = (vec![], BTreeSet::new(), 0, false);
    for line in lines.skip(usize::from(is_head)) {
        let row = fields(line, separator);
        if row.len() != columns.count {
            let message = format!("a row has {} columns, not {}", columns.count, row.len());
            return refuse(source, line, message);
        }
        for &at in &columns.all {
            let index: usize = match row[at].parse() {
                Ok(index) if index > 0 => index,
                _ if row[at].is_empty() && columns.tensor.is_some() => continue,
                _ => {
                    let message = format!("`{}` is not an index from 1", shown(row[at]));
                    return refuse(source, line, message);
                }
            };
            dimension = dimension.max(index);
        }
        if columns.tensor.is_some_and(|at| row[at] != "structure") {
            others = true;
            continue;
        }
        let [i, j, k] = columns.indices.map(|at| row[at]);
        if !seen.insert([i, j, k]) {
            return refuse(source, line, "this component is given twice");
        }
        let value = row[columns.value];
        entries.push(Entry {
            i: i.into(),
            j: j.into(),
            k: k.into(),
            negative: false,
            value,
            place: line,
        });
    }
    if entries.is_empty() {
        let error =
            InputError::usage("the table has no structure constants, so its dimension is unknown");
        return Err(error.at(&source.whole(first)).help("write it with --show structure"));
    }
    let mut definition = numbered(source, dimension, &entries)?;
    let notes = &mut definition.notes;
    if columns.tensor.is_none() {
        let rule = "columns are read as [e_j, e_k] = value e_i, where the head names i, j and k";
        let order = "rows are read as i,j,k,value: [e_j, e_k] = value e_i; a head such as j,k,i,value names another order";
        notes.push(if is_head { rule } else { order }.into());
    }
    notes.push(format!("the dimension {dimension} is the highest index of the table"));
    if others {
        notes.push("only the structure constants of the table are read".into());
    }
    Ok(definition)
}

fn is_index(field: &str) -> bool {
    field.starts_with(|c: char| c.is_ascii_digit())
}

/// The separator of columns: a tab, a semicolon or a comma, whichever occurs first in this list;
/// otherwise spaces.
fn separator(line: &str) -> char {
    ['\t', ';', ','].into_iter().find(|separator| line.contains(*separator)).unwrap_or(' ')
}

/// Splits a line into its fields, and removes their quotes.
fn fields(line: &str, separator: char) -> Vec<&str> {
    if separator == ' ' {
        return line.split_whitespace().collect();
    }
    let (mut quoted, mut from, mut fields) = (false, 0, vec![]);
    for (at, symbol) in line.char_indices() {
        match symbol {
            '"' => quoted = !quoted,
            _ if symbol == separator && !quoted => {
                fields.push(&line[from..at]);
                from = at + symbol.len_utf8();
            }
            _ => {}
        }
    }
    fields.push(&line[from..]);
    fields.into_iter().map(|field| field.trim().trim_matches('"').trim()).collect()
}
