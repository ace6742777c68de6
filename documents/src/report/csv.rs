//! CSV: one row for every nonzero component, with indices from 1.

use super::Table;
use super::components::append;
use crate::Coefficient;
use affinor_tensors::Components;
use std::io::{self, Write};

/// The names of the index columns. A table has as many of them as the highest rank shown, but at
/// least four.
const COLUMNS: [&str; 8] = ["i", "j", "k", "l", "m", "n", "o", "p"];

pub(super) fn write<S: Coefficient>(table: &Table<S>, out: &mut dyn Write) -> io::Result<()> {
    let rank = table.tensors.iter().map(|entry| entry.tensor.rank()).max().unwrap_or(0);
    let columns = &COLUMNS[..rank.max(4)];
    writeln!(out, "tensor,{},value", columns.join(","))?;
    let dimension = table.tensors.iter().map(|entry| entry.tensor.dimension()).max().unwrap_or(0);
    let numbers: Vec<String> = (1..=dimension).map(|index| format!(",{index}")).collect();
    for entry in &table.tensors {
        let key = entry.quantity.key();
        // writes the fields directly: the package csv would check every field of millions of lines
        // for quotes, but only values may need them
        let rows = |piece: Components<'_, S>| {
            let (mut lines, mut text) = (String::new(), String::new());
            for (at, value) in piece {
                lines.push_str(key);
                at.iter().for_each(|&index| lines.push_str(&numbers[index]));
                lines.extend((at.len()..=columns.len()).map(|_| ','));
                text.clear();
                append(&mut text, value);
                if text.contains([',', '"', '\r', '\n']) {
                    lines.extend(["\"", &text.replace('"', "\"\""), "\""]);
                } else {
                    lines.push_str(&text);
                }
                lines.push('\n');
            }
            lines
        };
        let tensor = table.shown(entry);
        tensor.in_pieces(rows, |lines| out.write_all(lines.as_bytes()))?;
    }
    out.flush()
}
