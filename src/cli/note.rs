//! Remarks beside the results.

use affinor::definition::Definition;
use std::io::{self, Write};

/// Says something on standard error; nothing is left to do when that is closed.
pub fn note(text: &str) {
    line(&format!("note: {text}"));
}

/// A line on standard error.
pub fn line(text: &str) {
    let _ = writeln!(io::stderr(), "{text}");
}

/// Says which connection is taken where none is named.
pub fn note_default_connection(definition: &Definition) {
    if !definition.connection_is_default() {
        return;
    }
    if definition.has_metric() {
        note("no connection is named, and there is a metric: levi-civita");
    } else if !definition.is_on_chart() {
        note("no connection is named, and there is no metric: zero");
    }
}
