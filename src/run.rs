//! Runs: the rows that a motion leaves, and their formats.

mod csv;
mod json;
#[cfg(feature = "parquet")]
mod parquet;

use std::io::{self, Write};

/// What is said of all rows.
#[derive(Clone, Debug, PartialEq)]
pub struct Head {
    /// The name of the problem.
    pub name: String,
    /// The method of integration.
    pub method: String,
    /// Names of the columns.
    pub columns: Vec<String>,
}

/// Rows, one after the other.
pub type Rows<'r> = dyn Iterator<Item = io::Result<Vec<f64>>> + 'r;

/// How a run is written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RunFormat {
    /// A head of names, then a line for each row.
    Csv,
    /// One object: `affinor.run/1`.
    Json,
    /// Columns of doubles.
    #[cfg(feature = "parquet")]
    Parquet,
}

impl RunFormat {
    /// All of them.
    pub const ALL: &'static [RunFormat] = &[
        RunFormat::Csv,
        RunFormat::Json,
        #[cfg(feature = "parquet")]
        RunFormat::Parquet,
    ];

    /// The name, which is also the ending of files.
    pub fn name(self) -> &'static str {
        match self {
            RunFormat::Csv => "csv",
            RunFormat::Json => "json",
            #[cfg(feature = "parquet")]
            RunFormat::Parquet => "parquet",
        }
    }

    /// The format of a name.
    pub fn from_name(name: &str) -> Option<Self> {
        Self::ALL.iter().copied().find(|format| format.name() == name)
    }

    /// Writes a run.
    ///
    /// # Errors
    /// What reading the rows or writing refuses.
    pub fn write(self, head: &Head, rows: &mut Rows, out: &mut dyn Write) -> io::Result<()> {
        match self {
            RunFormat::Csv => csv::write(head, rows, out),
            RunFormat::Json => json::write(head, rows, out),
            #[cfg(feature = "parquet")]
            RunFormat::Parquet => parquet::write(head, rows, out),
        }
    }
}
