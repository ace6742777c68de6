//! Matrices of a report: only their nonzero entries are stored, but all entries are written.

use affinor_tensors::Scalar;
use serde_json::Value;
use std::io::{self, Write};

/// A matrix of numbers in text form, which is written as the last entry of a JSON object.
#[derive(Clone, Debug)]
pub(super) struct Rows {
    key: &'static str,
    columns: usize,
    rows: Vec<Vec<(usize, String)>>,
}

impl Rows {
    /// A matrix with `columns` columns, given by sparse rows.
    pub fn new<'a, S: Scalar + 'a>(
        key: &'static str,
        columns: usize,
        rows: impl Iterator<Item = &'a [(usize, S)]>,
    ) -> Self {
        let row = |row: &[(usize, S)]| row.iter().map(|(at, v)| (*at, v.to_string())).collect();
        Rows { key, columns, rows: rows.map(row).collect() }
    }

    /// Writes a JSON object and the matrix as its last entry: first the object without its last
    /// brace, such as `{"dimension":1`, then `,"key":[["1","0"]]}`.
    pub fn write_into(&self, object: &Value, out: &mut dyn Write) -> io::Result<()> {
        let object = object.to_string();
        write!(out, "{},{}:[", object.strip_suffix('}').unwrap_or(&object), Value::from(self.key))?;
        for (at, row) in self.rows.iter().enumerate() {
            out.write_all(if at == 0 { b"[" } else { b",[" })?;
            let mut entries = row.iter().peekable();
            for column in 0..self.columns {
                if column > 0 {
                    out.write_all(b",")?;
                }
                match entries.next_if(|(place, _)| *place == column) {
                    Some((_, value)) => write!(out, "{}", Value::from(value.as_str()))?,
                    None => out.write_all(b"\"0\"")?,
                }
            }
            out.write_all(b"]")?;
        }
        out.write_all(b"]}")
    }
}
