//! What a run kept and what not: quantities at the start, at the end, and how far they went.

use super::super::note::line;
use super::spool::Spool;
use affinor::definition::Column;
use affinor::run::Head;
use comfy_table::{CellAlignment, ColumnConstraint, ContentArrangement, Table, presets};
use std::io;

/// The widest line, with the blank at its end that is not written: formulas go on in the next.
const WIDTH: u16 = 80 + 1;
/// Larger numbers are written with an exponent.
const LARGE: f64 = 1e6;

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
    table.set_content_arrangement(ContentArrangement::Dynamic).set_width(WIDTH);
    table.set_header(["", "start", "end", "largest change"]);
    for ([first, last, most], column) in seen.iter().flatten().zip(columns) {
        if column.watched {
            let name = match &column.formula {
                Some(formula) => format!("{} = {formula}", column.name),
                None => column.name.clone(),
            };
            table.add_row([name, written(*first), written(*last), format!("{most:.1e}")]);
        }
    }
    for at in 1..4 {
        if let Some(column) = table.column_mut(at) {
            column.set_cell_alignment(CellAlignment::Right);
            column.set_constraint(ColumnConstraint::ContentWidth);
        }
    }
    line(&format!("{}: method {}", head.name, head.method));
    if !table.is_empty() {
        line(&table.trim_fmt());
    }
    Ok(())
}

fn written(value: f64) -> String {
    if value.abs() < LARGE { format!("{value:.12}") } else { format!("{value:.12e}") }
}
