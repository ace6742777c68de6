//! Rows of numbers, read from arguments or standard input, and written as text, CSV or JSON lines.

use super::color::ColorOption;
use super::columns::Expected;
use super::failure::Failure;
use super::note::{counted, note};
use super::output::{deliver, ending};
use affinor_documents::input::{InputError, Source, numbers};
use clap::{Args, ValueEnum};
use nalgebra::DMatrix;
use std::io::{self, BufRead, Write};
use std::path::PathBuf;

/// The format and file of rows, and the colours of messages.
#[derive(Args)]
pub struct RowOutput {
    /// The format of the rows [default: by the ending of the output file, otherwise text]
    #[arg(long, value_enum)]
    format: Option<RowFormat>,
    /// Write to this file; if the run fails, the file remains unchanged
    #[arg(short = 'o', long = "output", value_name = "FILE")]
    file: Option<PathBuf>,
    /// At an invalid input row: stop, or skip the row and report its line and the reason
    #[arg(long, value_enum, default_value_t = OnError::Stop)]
    on_error: OnError,
    #[command(flatten)]
    color: ColorOption,
}

#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
enum OnError {
    Stop,
    Skip,
}

#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
enum RowFormat {
    Text,
    Csv,
    Json,
}

impl RowOutput {
    /// The format of `--format`, otherwise that of the ending of the output file, otherwise text.
    fn format(&self) -> RowFormat {
        self.format.unwrap_or(match ending(self.file.as_deref()).as_str() {
            "csv" => RowFormat::Csv,
            "json" | "jsonl" => RowFormat::Json,
            _ => RowFormat::Text,
        })
    }
}

/// Returns a vector as a matrix with one row.
pub fn vector(values: &[f64]) -> DMatrix<f64> {
    DMatrix::from_row_slice(1, values.len(), values)
}

/// Maps each row of the arguments, or of standard input if there are no arguments, and writes the
/// results.
///
/// If the first line contains no number, its words are the names of the columns
/// ([`Expected::order`]). `head` is as in [`write_rows`].
pub fn map_rows(
    arguments: &[String],
    expected: &Expected,
    head: &str,
    output: &RowOutput,
    mut map: impl FnMut(&[f64]) -> Result<DMatrix<f64>, Failure>,
) -> Result<(), Failure> {
    let (mut rows, mut skipped, mut order) = (0, 0, expected.unnamed.clone());
    write_rows(output, head, |write| {
        let mut each = |name: &str, row: &str, order: Option<&Vec<usize>>| {
            rows += 1;
            let read = read(name, row, expected).map(|row| match order {
                Some(order) => order.iter().map(|at| row[*at]).collect(),
                None => row,
            });
            match read.and_then(|row| write(map(&row)?)) {
                Err(Failure::Input(error)) if output.on_error == OnError::Skip => {
                    skipped += 1;
                    let message = error.message.strip_prefix(&format!("{name}: "));
                    let message = message.unwrap_or(&error.message);
                    note(&format!("{name} is left out: {message}"));
                    Ok(())
                }
                done => done,
            }
        };
        if !arguments.is_empty() {
            let mut numbered = (1..).zip(arguments);
            return numbered
                .try_for_each(|(number, row)| each(&format!("row {number}"), row, order.as_ref()));
        }
        lines(|number, line| {
            let place = format!("<standard input>, line {number}");
            if number == 1 && is_header(line) {
                order = Some(expected.order(&place, &fields(line))?);
                return Ok(());
            }
            each(&place, line, order.as_ref())
        })
    })?;
    if skipped > 0 {
        note(&format!("{skipped} of {} left out", counted(rows, "row")));
    }
    Ok(())
}

/// Writes each matrix as soon as `rows` hands it over.
///
/// `head` names the columns of CSV: a list such as `w,x,y,z`, or a letter, to which the numbers of
/// row and column are appended.
pub fn write_rows(
    output: &RowOutput,
    head: &str,
    rows: impl FnOnce(&mut dyn FnMut(DMatrix<f64>) -> Result<(), Failure>) -> Result<(), Failure>,
) -> Result<(), Failure> {
    let write: fn(&mut dyn Write, &DMatrix<f64>) -> io::Result<()> = match output.format() {
        RowFormat::Text => text,
        RowFormat::Csv => csv,
        RowFormat::Json => json,
    };
    let (mut refused, mut first) = (None, output.format() == RowFormat::Csv);
    let done = deliver(output.file.as_deref(), &[], |out| {
        let mut each = |values: DMatrix<f64>| {
            finite(&values)?;
            let begun = if first { writeln!(out, "{}", columns(head, &values)) } else { Ok(()) };
            first = false;
            let done = begun.and_then(|()| write(out, &values));
            done.map_err(|error| Failure::Output(error, String::new()))
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
    // returns the error of an invalid row itself, because it is not an error of the output
    refused.map_or(done, Err)
}

fn finite(values: &DMatrix<f64>) -> Result<(), Failure> {
    match values.iter().position(|value| !value.is_finite()) {
        None => Ok(()),
        Some(at) => {
            let (row, column) = (at % values.nrows() + 1, at / values.nrows() + 1);
            let value = values[at];
            let message = format!("row {row}, column {column} of the result is {value}");
            Err(InputError::mathematics(message)
                .help("give smaller numbers: the result exceeds the range of floats")
                .into())
        }
    }
}

/// Whether a line is a header: all its words begin with a letter, and no word is a number or means
/// a missing value.
fn is_header(line: &str) -> bool {
    let no_names = ["nan", "inf", "infinity", "null", "none", "na", "n/a", "pi", "tau"];
    let is_name = |word: &str| {
        let word = word.trim_matches('"').trim();
        word.starts_with(|c: char| c.is_alphabetic() || c == '_')
            && !no_names.contains(&&*word.to_lowercase())
    };
    numbers(&Source::new("", line)).is_err() && fields(line).into_iter().all(is_name)
}

/// Splits a line at commas, semicolons and tabs; if the line has none, at spaces.
fn fields(line: &str) -> Vec<&str> {
    let signs = [',', ';', '\t'];
    match line.contains(signs) {
        true => line.split(signs).map(str::trim).collect(),
        false => line.split_whitespace().collect(),
    }
}

/// Calls `each` with the number and the text of every line of standard input. Empty lines and
/// comments are skipped.
fn lines(mut each: impl FnMut(usize, &str) -> Result<(), Failure>) -> Result<(), Failure> {
    for (at, line) in io::stdin().lock().lines().enumerate() {
        let line = line.map_err(|error| {
            let message = format!("cannot read standard input, line {}: {error}", at + 1);
            Failure::from(InputError::usage(message))
        })?;
        let text = line.trim();
        let text = if at == 0 { text.trim_start_matches('\u{feff}') } else { text };
        if !text.is_empty() && !text.starts_with('#') {
            each(at + 1, text)?;
        }
    }
    Ok(())
}

/// Reads the numbers of one row.
pub fn read(name: &str, line: &str, expected: &Expected) -> Result<Vec<f64>, Failure> {
    let source = Source::new(name, line);
    let row = numbers(&source)?;
    if row.len() == expected.numbers {
        return Ok(row);
    }
    let (found, Expected { numbers, what, .. }) = (row.len(), expected);
    let message = format!("{name}: {what} has {numbers} numbers, not {found}");
    Err(InputError::usage(message).help(format!("it reads `{}`", line.escape_debug())).into())
}

/// Writes numbers with twelve digits: a vector on one line, a matrix in aligned rows and a final
/// empty line.
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

/// The names of the columns of CSV.
fn columns(head: &str, values: &DMatrix<f64>) -> String {
    if head.contains(',') {
        return head.into();
    }
    let (rows, columns) = values.shape();
    let between = if rows.max(columns) < 10 { "" } else { "_" };
    let name = |at: usize| match rows {
        1 => format!("{head}{}", at + 1),
        _ => format!("{head}{}{between}{}", at / columns + 1, at % columns + 1),
    };
    (0..rows * columns).map(name).collect::<Vec<_>>().join(",")
}

/// Writes all numbers on one line, a matrix in row-major order.
fn csv(out: &mut dyn Write, values: &DMatrix<f64>) -> io::Result<()> {
    writeln!(out, "{}", cells(values, exactly).join(","))
}

/// Writes an array on one line; a matrix is an array of its rows.
fn json(out: &mut dyn Write, values: &DMatrix<f64>) -> io::Result<()> {
    let cells = cells(values, exactly);
    let lines = cells.chunks(values.ncols().max(1)).map(|line| format!("[{}]", line.join(",")));
    let lines: Vec<String> = lines.collect();
    match lines.as_slice() {
        [line] if values.nrows() == 1 => writeln!(out, "{line}"),
        lines => writeln!(out, "[{}]", lines.join(",")),
    }
}

/// The entries of a matrix as text, row by row.
fn cells(values: &DMatrix<f64>, write: fn(f64) -> String) -> Vec<String> {
    let rows = values.row_iter();
    rows.flat_map(|row| row.iter().map(|value| write(*value)).collect::<Vec<_>>()).collect()
}

/// Writes a number with the shortest digits that parse to the same number, without a negative zero
/// and without a final `.0`.
fn exactly(value: f64) -> String {
    let written = format!("{:?}", value + 0.0);
    written.strip_suffix(".0").map(str::to_string).unwrap_or(written)
}

/// Writes a number with at most twelve significant digits.
fn briefly(value: f64) -> String {
    exactly(format!("{value:.11e}").parse().unwrap_or(value))
}
