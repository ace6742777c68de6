//! Writes runs in CSV. Each number has the fewest digits that parse to the same float.

use super::{Head, Rows};
use std::fmt::Write as _;
use std::io::{self, Write};

pub(super) fn write(head: &Head, rows: &mut Rows, out: &mut dyn Write) -> io::Result<()> {
    let mut out = csv::Writer::from_writer(out);
    out.write_record(&head.columns).map_err(failed)?;
    let mut text = String::new();
    for row in rows {
        for value in row? {
            text.clear();
            write!(text, "{value:?}").map_err(io::Error::other)?;
            out.write_field(text.strip_suffix(".0").unwrap_or(&text)).map_err(failed)?;
        }
        out.write_record(None::<&[u8]>).map_err(failed)?;
    }
    out.flush()
}

/// Extracts the I/O error from a CSV error, so that a closed pipe ends the program without a
/// message.
pub(crate) fn failed(error: csv::Error) -> io::Error {
    match error.into_kind() {
        csv::ErrorKind::Io(error) => error,
        other => io::Error::other(format!("{other:?}")),
    }
}
