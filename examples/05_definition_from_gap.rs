//! How do I use a bracket table from GAP or another program on the command line?
//!
//! This program converts lines `i j k v`, which mean `[e_i, e_j] = ... + v e_k`, to a definition
//! file. It prints the definition, or writes it to the file that the argument names:
//!
//! ```text
//! cargo run --example 05_definition_from_gap -- E8.toml
//! cargo run --release -- check E8.toml
//! ```

use std::error::Error;
use std::fmt::Write;

/// The table of E8 from GAP: 248 basis vectors, and one line for each structure constant with `i <
/// j`.
pub const E8: &str = include_str!("data/E8.txt");

/// Converts the table of E8.
pub fn main() -> Result<(), Box<dyn Error>> {
    let text = definition("E8, basis of GAP", 248, E8)?;
    match std::env::args_os().nth(1) {
        Some(path) => std::fs::write(path, text)?,
        None => print!("{text}"),
    }
    Ok(())
}

/// Converts a table to a definition file. In the table, `#` begins a comment.
pub fn definition(name: &str, dimension: usize, table: &str) -> Result<String, Box<dyn Error>> {
    let mut text = String::new();
    writeln!(text, "name = {name:?}")?;
    writeln!(text, "dimension = {dimension}")?;
    writeln!(text, "structure_constants = [")?;
    for line in table.lines().filter(|line| !line.starts_with('#') && !line.trim().is_empty()) {
        let [i, j, k, value] = line.split_whitespace().collect::<Vec<_>>()[..] else {
            return Err(format!("`{line}` is not i j k v").into());
        };
        writeln!(text, "  [{i}, {j}, {k}, \"{value}\"],")?;
    }
    writeln!(text, "]")?;
    Ok(text)
}
