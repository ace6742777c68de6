//! Tables of numbers in CSV.

use super::file::read;
use super::numbers::numbers_in;
use super::{InputError, Source, shown};

/// Reads the names and the rows of a CSV table. Its values are numbers, `NaN`, `inf` and `-inf`.
///
/// # Errors
/// An error with its location: for a file that cannot be read, for a header of numbers or with a
/// duplicate name, and for a value that is missing or is not a number.
pub fn read_rows(path: &str) -> Result<(Vec<String>, Vec<Vec<f64>>), InputError> {
    read_columns(path, |_| true)
}

/// Like [`read_rows`], but columns for which `is_used` is false may contain any values, which
/// become NaN.
pub(crate) fn read_columns(
    path: &str,
    is_used: impl Fn(&str) -> bool,
) -> Result<(Vec<String>, Vec<Vec<f64>>), InputError> {
    let file = read(path)?;
    let mut lines = file.text.lines();
    let first = lines.next().unwrap_or("");
    if numbers_in(first, &file).is_ok_and(|row| !row.is_empty()) {
        let message = "the first line of the table must name its columns, but it has numbers";
        let help = "add a first line with names, such as `t,a,b,c`";
        return Err(InputError::usage(message).at(&file.whole(first)).help(help));
    }
    let names: Vec<String> =
        first.split(',').map(|name| name.trim().trim_matches('"').to_string()).collect();
    let used: Vec<bool> = names.iter().map(|name| is_used(name)).collect();
    if let Some((_, name)) = names.iter().enumerate().find(|(at, name)| names[..*at].contains(name))
    {
        let message = format!("two columns have the name `{}`", shown(name));
        return Err(InputError::usage(message).at(&file.whole(first)));
    }
    let mut rows = Vec::new();
    for line in lines.filter(|line| !line.trim().is_empty()) {
        let words = line.split(',').enumerate();
        let row = words.map(|(at, word)| match used.get(at) {
            Some(false) => Ok(f64::NAN),
            _ => value(word.trim(), line, &file),
        });
        let row = row.collect::<Result<Vec<_>, _>>()?;
        if row.len() != names.len() {
            let (found, expected) = (row.len(), names.len());
            let message = format!(
                "a row of {found} numbers does not match the {expected} names of the header"
            );
            return Err(InputError::usage(message).at(&file.whole(line)));
        }
        rows.push(row);
    }
    Ok((names, rows))
}

/// Parses a value in a line of CSV.
fn value(word: &str, line: &str, file: &Source) -> Result<f64, InputError> {
    match word {
        "NaN" => Ok(f64::NAN),
        "inf" => Ok(f64::INFINITY),
        "-inf" => Ok(f64::NEG_INFINITY),
        "" => Err(InputError::usage("a value is missing").at(&file.whole(line))),
        _ => match numbers_in(word, file)?[..] {
            [value] => Ok(value),
            _ => {
                let message = format!("`{}` is not a single number", shown(word));
                Err(InputError::usage(message).at(&file.whole(line)))
            }
        },
    }
}
