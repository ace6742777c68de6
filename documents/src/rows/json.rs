//! Writes a run in JSON: names and columns, then the rows as lists.

use super::{Head, Rows};
use serde_json::{Value, json};
use std::io::{self, Write};

/// The name of the schema.
const SCHEMA: &str = "affinor.run/1";

pub(super) fn write(head: &Head, rows: &mut Rows, out: &mut dyn Write) -> io::Result<()> {
    let Head { name, method, columns } = head;
    let [name, method, columns] = [json!(name), json!(method), json!(columns)];
    write!(out, "{{\"schema\":\"{SCHEMA}\",\"name\":{name},\"method\":{method},")?;
    write!(out, "\"columns\":{columns},\"rows\":[")?;
    for (at, row) in rows.enumerate() {
        // infinities and NaN are written as null
        let row = Value::from(row?);
        write!(out, "{}\n{row}", if at == 0 { "" } else { "," })?;
    }
    writeln!(out, "\n]}}")
}
