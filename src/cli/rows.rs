//! Rows of numbers: from arguments or, line by line, from standard input; to text, CSV or JSON lines.

use super::failure::Failure;
use super::note::note;
use super::options::Output;
use super::output::deliver;
use affinor::definition::{InputError, Source, numbers};
use affinor::report::Format;
use nalgebra::DMatrix;
use std::cell::Cell;
use std::io::{self, BufRead, Write};

/// What one row of input becomes.
pub struct Row {
    /// The numbers; a vector is one row.
    pub values: DMatrix<f64>,
}

impl Row {
    /// A vector.
    pub fn vector(values: &[f64]) -> Self {
        Row { values: DMatrix::from_row_slice(1, values.len(), values) }
    }

    /// A matrix.
    pub fn matrix(values: DMatrix<f64>) -> Self {
        Row { values }
    }
}

/// How many numbers an input row has, and what they are.
pub struct Expected {
    pub numbers: usize,
    pub what: String,
}

/// Maps every row of the arguments, or of standard input where there are none.
///
/// A first line that is no row of numbers is taken for the head of a table.
pub fn map_rows(
    arguments: &[String],
    expected: &Expected,
    output: &Output,
    mut map: impl FnMut(&[f64]) -> Result<Row, Failure>,
) -> Result<(), Failure> {
    let write: fn(&mut dyn Write, &Row) -> io::Result<()> = match output.format {
        Format::Text => text,
        Format::Csv => csv,
        Format::Json => json,
        Format::Markdown | Format::Latex => {
            let message = "rows of numbers are written as text, csv or json";
            return Err(InputError::usage(message).help("give --format one of these").into());
        }
    };
    let failure = Cell::new(None);
    let done = deliver(output.file.as_deref(), &[], |out| {
        let mut each = |name: &str, line: &str| -> io::Result<()> {
            let row = read(name, line, expected).and_then(|numbers| map(&numbers));
            match row {
                Ok(row) => write(out, &row),
                Err(error) => {
                    failure.set(Some(error));
                    Err(io::ErrorKind::InvalidData.into())
                }
            }
        };
        if !arguments.is_empty() {
            return arguments.iter().try_for_each(|row| each("VECTOR", row));
        }
        lines(|number, line| {
            let is_head = number == 1 && numbers(&Source::new("", line)).is_err();
            if is_head {
                note("the first line is no row of numbers, and taken for the head of a table");
                return Ok(());
            }
            each(&format!("<standard input>, line {number}"), line)
        })
    });
    // a failure of a row is told as such, not as one of writing
    match failure.take() {
        Some(failure) => Err(failure),
        None => done,
    }
}

/// Calls `each` with the number and text of every line of standard input that is not empty.
fn lines(mut each: impl FnMut(usize, &str) -> io::Result<()>) -> io::Result<()> {
    let (mut input, mut line, mut number) = (io::stdin().lock(), String::new(), 0);
    loop {
        line.clear();
        if input.read_line(&mut line)? == 0 {
            return Ok(());
        }
        number += 1;
        let text = line.trim();
        if !text.is_empty() && !text.starts_with('#') {
            each(number, text)?;
        }
    }
}

/// The numbers of one row.
pub fn read(name: &str, line: &str, expected: &Expected) -> Result<Vec<f64>, Failure> {
    let source = Source::new(name, line);
    let row = numbers(&source)?;
    if row.len() == expected.numbers {
        return Ok(row);
    }
    let (found, Expected { numbers, what }) = (row.len(), expected);
    let message = format!("{name}: {what} has {numbers} numbers, not {found}");
    Err(InputError::usage(message).help(format!("it reads `{}`", line.escape_debug())).into())
}

/// To twelve digits: a vector in one line, a matrix in aligned rows behind an empty line.
fn text(out: &mut dyn Write, row: &Row) -> io::Result<()> {
    let cells = cells(&row.values, briefly);
    let width = cells.iter().map(String::len).max().unwrap_or(0);
    for line in cells.chunks(row.values.ncols().max(1)) {
        if row.values.nrows() == 1 {
            writeln!(out, "{}", line.join(" "))?;
        } else {
            let line: Vec<String> = line.iter().map(|cell| format!("{cell:>width$}")).collect();
            writeln!(out, "{}", line.join("  "))?;
        }
    }
    if row.values.nrows() > 1 { writeln!(out) } else { Ok(()) }
}

/// All numbers in one line, a matrix row by row.
fn csv(out: &mut dyn Write, row: &Row) -> io::Result<()> {
    writeln!(out, "{}", cells(&row.values, exactly).join(","))
}

/// An array in one line; a matrix as an array of its rows.
fn json(out: &mut dyn Write, row: &Row) -> io::Result<()> {
    let cells = cells(&row.values, exactly);
    let lines = cells.chunks(row.values.ncols().max(1)).map(|line| format!("[{}]", line.join(",")));
    let lines: Vec<String> = lines.collect();
    match lines.as_slice() {
        [line] if row.values.nrows() == 1 => writeln!(out, "{line}"),
        lines => writeln!(out, "[{}]", lines.join(",")),
    }
}

/// The entries, row by row.
fn cells(values: &DMatrix<f64>, write: fn(f64) -> String) -> Vec<String> {
    let rows = values.row_iter();
    rows.flat_map(|row| row.iter().map(|value| write(*value)).collect::<Vec<_>>()).collect()
}

/// As many digits as it takes to read the number back; no negative zero, and no `.0` behind whole
/// numbers.
fn exactly(value: f64) -> String {
    let written = format!("{:?}", value + 0.0);
    written.strip_suffix(".0").map(str::to_string).unwrap_or(written)
}

/// For people: the twelve digits that rounding leaves alone.
fn briefly(value: f64) -> String {
    exactly(format!("{value:.11e}").parse().unwrap_or(value))
}
