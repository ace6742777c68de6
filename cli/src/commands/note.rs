//! Notes on standard error, in addition to the results.

use affinor_documents::space::Definition;
use std::io::{self, Write};

/// Prints a note on standard error.
pub fn note(text: &str) {
    line(&format!("note: {text}"));
}

/// Prints a line on standard error; errors are ignored.
pub fn line(text: &str) {
    let _ = writeln!(io::stderr(), "{text}");
}

/// A count followed by its noun, in the plural if needed: `1 row`, `2 rows`.
pub fn counted(count: u64, noun: &str) -> String {
    match count {
        1 => format!("1 {noun}"),
        count => format!("{count} {noun}s"),
    }
}

/// Prints a note on the default connection if the definition names no connection.
pub fn note_default_connection(definition: &Definition) {
    if let Some(text) = definition.default_connection_note() {
        note(&text);
    }
}
