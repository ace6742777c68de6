//! CSV: one row for every nonzero component, indices from 1.

use super::Table;
use super::components::append;
use affinor_tensors::{Components, Notation};
use std::io::{self, Write};

/// The index columns, as many as the highest rank shown but at least four.
const COLUMNS: [&str; 8] = ["i", "j", "k", "l", "m", "n", "o", "p"];

pub(super) fn write<S: Notation>(table: &Table<S>, out: &mut dyn Write) -> io::Result<()> {
    rows(table, out).map_err(|error| match error.into_kind() {
        // callers distinguish a closed pipe from a full disk by the kind
        csv::ErrorKind::Io(error) => error,
        other => io::Error::other(format!("{other:?}")),
    })
}

fn rows<S: Notation>(table: &Table<S>, out: &mut dyn Write) -> csv::Result<()> {
    let rank = table.tensors.iter().map(|entry| entry.tensor.rank()).max().unwrap_or(0);
    let columns = &COLUMNS[..rank.max(4)];
    let head = |lines: &mut Lines| lines.write_record([&["tensor"], columns, &["value"]].concat());
    out.write_all(&lines(head)?)?;
    let dimension = table.tensors.iter().map(|entry| entry.tensor.dimension()).max().unwrap_or(0);
    let numbers: Vec<String> = (1..=dimension).map(|index| index.to_string()).collect();
    for entry in &table.tensors {
        let key = entry.quantity.key();
        let rows = |piece: Components<'_, S>, lines: &mut Lines| {
            let mut text = String::new();
            for (at, value) in piece {
                lines.write_field(key)?;
                for &index in at.iter() {
                    lines.write_field(&numbers[index])?;
                }
                for _ in at.len()..columns.len() {
                    lines.write_field("")?;
                }
                text.clear();
                append(&mut text, value);
                lines.write_field(&text)?;
                lines.write_record(None::<&[u8]>)?;
            }
            Ok(())
        };
        let tensor = table.shown(entry);
        tensor.in_pieces(
            |piece| lines(|lines| rows(piece, lines)),
            |lines| -> csv::Result<()> { Ok(out.write_all(&lines?)?) },
        )?;
    }
    Ok(out.flush()?)
}

type Lines = csv::Writer<Vec<u8>>;

fn lines(write: impl FnOnce(&mut Lines) -> csv::Result<()>) -> csv::Result<Vec<u8>> {
    let mut lines = csv::Writer::from_writer(Vec::new());
    write(&mut lines)?;
    lines.into_inner().map_err(|error| error.into_error().into())
}
