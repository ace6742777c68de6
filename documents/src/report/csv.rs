//! CSV: one row for every nonzero component, indices from 1.

use super::Table;
use super::components::append;
use affinor_tensors::Notation;
use std::io::{self, Write};

/// The index columns, as many as the highest rank shown but at least four.
const COLUMNS: [&str; 8] = ["i", "j", "k", "l", "m", "n", "o", "p"];

pub(super) fn write<S: Notation>(table: &Table<S>, out: &mut dyn Write) -> io::Result<()> {
    rows(table, &mut csv::Writer::from_writer(out)).map_err(|error| match error.into_kind() {
        // callers distinguish a closed pipe from a full disk by the kind
        csv::ErrorKind::Io(error) => error,
        other => io::Error::other(format!("{other:?}")),
    })
}

fn rows<S: Notation>(table: &Table<S>, out: &mut csv::Writer<&mut dyn Write>) -> csv::Result<()> {
    let rank = table.tensors.iter().map(|entry| entry.tensor.rank()).max().unwrap_or(0);
    let columns = &COLUMNS[..rank.max(4)];
    out.write_record([&["tensor"], columns, &["value"]].concat())?;
    let dimension = table.tensors.iter().map(|entry| entry.tensor.dimension()).max().unwrap_or(0);
    let numbers: Vec<String> = (1..=dimension).map(|index| index.to_string()).collect();
    let mut text = String::new();
    for entry in &table.tensors {
        let key = entry.quantity.key();
        for (at, value) in table.shown(entry).components() {
            out.write_field(key)?;
            for &index in at.iter() {
                out.write_field(&numbers[index])?;
            }
            for _ in at.len()..columns.len() {
                out.write_field("")?;
            }
            text.clear();
            append(&mut text, value);
            out.write_field(&text)?;
            out.write_record(None::<&[u8]>)?;
        }
    }
    Ok(out.flush()?)
}
