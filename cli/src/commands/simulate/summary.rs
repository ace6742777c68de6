//! The conservation summary: the initial and the final value of each watched quantity, and its
//! largest change.
//!
//! Watched quantities are the energy, the spatial momentum, Casimir functions and named quantities.
//! Whether a quantity is conserved depends on the forces.

use super::super::note::line;
use super::spool::Spool;
use affinor_documents::problem::Column;
use affinor_documents::rows::Head;
use comfy_table::{CellAlignment, ColumnConstraint, ContentArrangement, Table, presets};
use std::io;

/// The width of the table: 80 columns, plus the blank after the last column, which is not written.
/// Longer formulas are wrapped.
const WIDTH: u16 = 80 + 1;
/// The magnitude from which numbers are written with an exponent.
const LARGE: f64 = 1e6;

/// Prints the summary on standard error.
pub fn show(head: &Head, columns: &[Column], spool: &mut Spool) -> io::Result<()> {
    // for each quantity: the initial value, the final value, and the largest change
    let mut changes: Option<Vec<[f64; 3]>> = None;
    for row in spool.rows()? {
        let row = row?;
        match &mut changes {
            None => changes = Some(row.iter().map(|value| [*value, *value, 0.0]).collect()),
            Some(changes) => {
                for ([first, last, most], value) in changes.iter_mut().zip(row) {
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
    table.set_header(["quantity", "start", "end", "largest change"]);
    for ([first, last, most], column) in changes.iter().flatten().zip(columns) {
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
