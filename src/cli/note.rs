//! Remarks beside the results.

use std::io::{self, Write};

/// Says something on standard error; nothing is left to do when that is closed.
pub fn note(text: &str) {
    line(&format!("note: {text}"));
}

/// A line on standard error.
pub fn line(text: &str) {
    let _ = writeln!(io::stderr(), "{text}");
}
