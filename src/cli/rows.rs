//! Rows of numbers: from arguments or, line by line, from standard input; to text, CSV or JSON lines.

use super::failure::Failure;
use super::note::note;
use super::options::Output;
use super::output::deliver;
use affinor::definition::{InputError, Source, numbers};
use affinor::report::Format;
use nalgebra::DMatrix;
use std::io::{self, BufRead, Write};

/// A vector, as the one row of a matrix.
pub fn vector(values: &[f64]) -> DMatrix<f64> {
    DMatrix::from_row_slice(1, values.len(), values)
}

/// How many numbers an input row has, and what they are.
pub struct Expected {
    pub numbers: usize,
    pub what: String,
}

/// Maps every row of the arguments, or of standard input where there are none.
///
/// A first line in which nothing is a number is taken for the head of a table.
pub fn map_rows(
    arguments: &[String],
    expected: &Expected,
    output: &Output,
    mut map: impl FnMut(&[f64]) -> Result<DMatrix<f64>, Failure>,
) -> Result<(), Failure> {
    write_rows(output, |write| {
        let mut each = |name: &str, row: &str| write(map(&read(name, row, expected)?)?);
        if !arguments.is_empty() {
            return arguments.iter().try_for_each(|row| each("VECTOR", row));
        }
        lines(|number, line| {
            if number == 1 && is_head(line) {
                note("the first line has no numbers, and is taken for the head of a table");
                return Ok(());
            }
            each(&format!("<standard input>, line {number}"), line)
        })
    })
}

/// Writes the matrices that `rows` makes, each as soon as it is there.
pub fn write_rows(
    output: &Output,
    rows: impl FnOnce(&mut dyn FnMut(DMatrix<f64>) -> Result<(), Failure>) -> Result<(), Failure>,
) -> Result<(), Failure> {
    let write: fn(&mut dyn Write, &DMatrix<f64>) -> io::Result<()> = match output.format {
        Format::Text => text,
        Format::Csv => csv,
        Format::Json => json,
        Format::Markdown | Format::Latex => {
            let message = "rows of numbers are written as text, csv or json";
            return Err(InputError::usage(message).help("give --format one of these").into());
        }
    };
    let mut refused = None;
    let done = deliver(output.file.as_deref(), &[], |out| {
        let mut each = |values: DMatrix<f64>| {
            finite(&values)?;
            write(out, &values).map_err(|error| Failure::Output(error, String::new()))
        };
        match rows(&mut each) {
            Ok(()) => Ok(()),
            Err(Failure::Output(error, _)) => Err(error),
            Err(refusal) => {
                refused = Some(refusal);
                Err(io::ErrorKind::InvalidData.into())
            }
        }
    });
    // a row that is refused is told as such, not as a failure of writing
    refused.map_or(done, Err)
}

fn finite(values: &DMatrix<f64>) -> Result<(), Failure> {
    match values.iter().position(|value| !value.is_finite()) {
        None => Ok(()),
        Some(at) => {
            let (row, column) = (at % values.nrows() + 1, at / values.nrows() + 1);
            let value = values[at];
            let message = format!("row {row}, column {column} of the result is {value}");
            Err(InputError::mathematics(message).help("the input is too large for floats").into())
        }
    }
}

fn is_head(line: &str) -> bool {
    let mut words = line.split([',', ';', ' ', '\t']);
    numbers(&Source::new("", line)).is_err() && words.all(|word| word.parse::<f64>().is_err())
}

/// Calls `each` with the number and text of every line of standard input that is not empty.
fn lines(mut each: impl FnMut(usize, &str) -> Result<(), Failure>) -> Result<(), Failure> {
    for (at, line) in io::stdin().lock().lines().enumerate() {
        let line = line.map_err(|error| {
            let message = format!("cannot read standard input, line {}: {error}", at + 1);
            Failure::from(InputError::usage(message))
        })?;
        let text = line.trim();
        if !text.is_empty() && !text.starts_with('#') {
            each(at + 1, text)?;
        }
    }
    Ok(())
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
fn text(out: &mut dyn Write, values: &DMatrix<f64>) -> io::Result<()> {
    let cells = cells(values, briefly);
    let width = cells.iter().map(String::len).max().unwrap_or(0);
    for line in cells.chunks(values.ncols().max(1)) {
        if values.nrows() == 1 {
            writeln!(out, "{}", line.join(" "))?;
        } else {
            let line: Vec<String> = line.iter().map(|cell| format!("{cell:>width$}")).collect();
            writeln!(out, "{}", line.join("  "))?;
        }
    }
    if values.nrows() > 1 { writeln!(out) } else { Ok(()) }
}

/// All numbers in one line, a matrix row by row.
fn csv(out: &mut dyn Write, values: &DMatrix<f64>) -> io::Result<()> {
    writeln!(out, "{}", cells(values, exactly).join(","))
}

/// An array in one line; a matrix as an array of its rows.
fn json(out: &mut dyn Write, values: &DMatrix<f64>) -> io::Result<()> {
    let cells = cells(values, exactly);
    let lines = cells.chunks(values.ncols().max(1)).map(|line| format!("[{}]", line.join(",")));
    let lines: Vec<String> = lines.collect();
    match lines.as_slice() {
        [line] if values.nrows() == 1 => writeln!(out, "{line}"),
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
