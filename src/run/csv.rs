//! Runs as CSV: numbers in the fewest digits that read back as themselves.

use super::{Head, Rows};
use std::io::{self, Write};

pub(super) fn write(head: &Head, rows: &mut Rows, out: &mut dyn Write) -> io::Result<()> {
    writeln!(out, "{}", head.columns.join(","))?;
    for row in rows {
        for (at, value) in row?.iter().enumerate() {
            let before = if at == 0 { "" } else { "," };
            let text = format!("{value:?}");
            write!(out, "{before}{}", text.strip_suffix(".0").unwrap_or(&text))?;
        }
        writeln!(out)?;
    }
    Ok(())
}
