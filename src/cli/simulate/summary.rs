//! What a run kept and what not: quantities at the start, at the end, and how far they went.

use super::super::note::line;
use super::spool::Spool;
use affinor::definition::Column;
use affinor::run::Head;
use comfy_table::{CellAlignment, Table, presets};
use std::io;

/// Shows the watched columns on standard error.
pub fn show(head: &Head, columns: &[Column], spool: &mut Spool) -> io::Result<()> {
    let mut seen: Option<Vec<[f64; 3]>> = None;
    for row in spool.rows()? {
        let row = row?;
        match &mut seen {
            None => seen = Some(row.iter().map(|value| [*value, *value, 0.0]).collect()),
            Some(seen) => {
                for ([first, last, most], value) in seen.iter_mut().zip(row) {
                    *last = value;
                    let change = (value - *first).abs();
                    if change > *most || change.is_nan() {
                        *most = change;
                    }
                }
            }
        }
    }
    let mut table = Table::new();
    table.load_style(presets::NOTHING);
    table.set_header(["", "start", "end", "largest change"]);
    for ([first, last, most], column) in seen.iter().flatten().zip(columns) {
        if column.watched {
            let name = match &column.formula {
                Some(formula) => format!("{} = {formula}", column.name),
                None => column.name.clone(),
            };
            table.add_row([
                name,
                format!("{first:.12}"),
                format!("{last:.12}"),
                format!("{most:.1e}"),
            ]);
        }
    }
    for at in 1..4 {
        if let Some(column) = table.column_mut(at) {
            column.set_cell_alignment(CellAlignment::Right);
        }
    }
    line(&format!("{}: method {}", head.name, head.method));
    if !table.is_empty() {
        line(&table.trim_fmt());
    }
    Ok(())
}
