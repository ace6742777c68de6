//! Runs: the rows of a motion, written to a file (one module per format), or sampled densely enough
//! to draw a curve.

mod csv;
mod dense;
mod json;
#[cfg(feature = "parquet")]
mod parquet;
mod run;

pub(crate) use csv::failed;
pub use dense::DenseRows;
pub use run::{RunRows, column_of};

use std::io::{self, Write};

/// The name, the method and the columns of a run.
#[derive(Clone, Debug, PartialEq)]
pub struct Head {
    /// The name of the problem.
    pub name: String,
    /// The method of integration.
    pub method: String,
    /// Names of the columns.
    pub columns: Vec<String>,
}

/// The rows of a run, in order.
pub type Rows<'r> = dyn Iterator<Item = io::Result<Vec<f64>>> + 'r;

/// The format of a run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RunFormat {
    /// A header with the names of the columns, then one line for each row.
    Csv,
    /// One object with the schema `affinor.run/1`.
    Json,
    /// Columns of doubles.
    #[cfg(feature = "parquet")]
    Parquet,
}

impl RunFormat {
    /// All formats.
    pub const ALL: &'static [RunFormat] = &[
        RunFormat::Csv,
        RunFormat::Json,
        #[cfg(feature = "parquet")]
        RunFormat::Parquet,
    ];

    /// The name of the format, which is also the file name extension.
    pub fn name(self) -> &'static str {
        match self {
            RunFormat::Csv => "csv",
            RunFormat::Json => "json",
            #[cfg(feature = "parquet")]
            RunFormat::Parquet => "parquet",
        }
    }

    /// The format with this name.
    pub fn from_name(name: &str) -> Option<Self> {
        Self::ALL.iter().copied().find(|format| format.name() == name)
    }

    /// Writes a run.
    ///
    /// # Errors
    /// Errors of the rows and of `out`.
    pub fn write(self, head: &Head, rows: &mut Rows, out: &mut dyn Write) -> io::Result<()> {
        match self {
            RunFormat::Csv => csv::write(head, rows, out),
            RunFormat::Json => json::write(head, rows, out),
            #[cfg(feature = "parquet")]
            RunFormat::Parquet => parquet::write(head, rows, out),
        }
    }
}
