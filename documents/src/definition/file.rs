//! Definition files: TOML, or JSON with the same keys.

use super::document::Document;
use super::files::Files;
use super::input::{InputError, shown};
use super::numbers::numbers_in;
use super::source::{Place, Source};
use super::{Definition, gap, json};
use serde::de::DeserializeOwned;
use std::fs::File;
use std::io::{self, Read};
use std::path::Path;
use toml::de::{DeTable, DeValue};

/// The largest size of a file in bytes.
pub(crate) const MAX_BYTES: u64 = 1 << 28;

/// The name of a file in messages.
fn name(path: &str) -> String {
    match path {
        "-" => "<standard input>".to_string(),
        path => path.escape_debug().to_string(),
    }
}

/// The content of a file, or of standard input for `-`, with the name for messages.
pub(crate) fn bytes(path: &str, limit: u64) -> Result<(String, Vec<u8>), InputError> {
    let name = name(path);
    let mut bytes = Vec::new();
    let length = match path {
        "-" => io::stdin().lock().take(limit + 1).read_to_end(&mut bytes),
        path => File::open(path).and_then(|file| file.take(limit + 1).read_to_end(&mut bytes)),
    };
    match length {
        Err(error) => return Err(InputError::usage(format!("cannot read {name}: {error}"))),
        Ok(length) if length as u64 > limit => {
            return Err(InputError::usage(format!("{name} has more than {limit} bytes")));
        }
        Ok(_) => {}
    }
    Ok((name, bytes))
}

/// A hash of the content of a file (FNV-1a), which shows accidental changes. It is 0 for a pipe or another file that is
/// not regular.
///
/// # Errors
/// A file that cannot be read.
pub fn fingerprint(path: &str) -> Result<u64, InputError> {
    if !Path::new(path).is_file() {
        return Ok(0);
    }
    let mix = |hash: u64, byte: &u8| (hash ^ u64::from(*byte)).wrapping_mul(0x0100_0000_01b3);
    Ok(bytes(path, MAX_BYTES)?.1.iter().fold(0xcbf2_9ce4_8422_2325, mix))
}

impl Definition {
    /// Reads a definition from a file, or from standard input for `-`.
    ///
    /// # Errors
    /// A file that cannot be read, parsed or understood, with the place.
    pub fn read(path: &str) -> Result<Self, InputError> {
        Self::read_part(path, 0, &Files::default())
    }

    /// Reads a definition that a file contains, `depth` files below the first.
    pub(super) fn read_part(path: &str, depth: usize, files: &Files) -> Result<Self, InputError> {
        let source = match files.content(path) {
            Some(text) => Source::new(name(path), &text),
            None => read(path)?,
        };
        files.keep(path, &source.text);
        Self::of_source(&source.below(depth, files))
    }

    /// Reads a definition from the text of a file; messages call it `name`.
    ///
    /// ```
    /// use affinor_documents::definition::Definition;
    /// let plane = "basis = ['x', 'y']\nbrackets = '[x, y] = 1/2 x'";
    /// assert_eq!(Definition::parse("plane.toml", plane)?.dimension(), 2);
    ///
    /// let error = Definition::parse("plane.toml", &plane.replace("2 x", "0 x")).unwrap_err();
    /// assert_eq!(error.to_string(), "division by zero");
    /// # Ok::<(), affinor_documents::definition::InputError>(())
    /// ```
    ///
    /// # Errors
    /// A text that cannot be parsed or understood, with the place.
    pub fn parse(name: &str, text: &str) -> Result<Self, InputError> {
        Self::parse_part(name, text, &Files::default())
    }

    /// Reads a definition from a text that may name files.
    pub(super) fn parse_part(name: &str, text: &str, files: &Files) -> Result<Self, InputError> {
        let source = Source::new(name.escape_debug().to_string(), text);
        Self::of_source(&source.below(0, files))
    }

    fn of_source(source: &Source) -> Result<Self, InputError> {
        if gap::is_table(&source.text) {
            return gap::definition(source);
        }
        let (keys, source) = keys::<Document>(source, "a definition has a basis and brackets")?;
        keys.define(&source)
    }
}

/// The text of a file in UTF-8, or of standard input for `-`.
pub(crate) fn read(path: &str) -> Result<Source, InputError> {
    let (name, bytes) = bytes(path, MAX_BYTES)?;
    decode(&name, &bytes)
}

pub(crate) fn decode(name: &str, bytes: &[u8]) -> Result<Source, InputError> {
    if bytes.starts_with(&[0xff, 0xfe]) || bytes.starts_with(&[0xfe, 0xff]) {
        let error = InputError::usage(format!("{name} is UTF-16"));
        return Err(error.help("save it as UTF-8"));
    }
    let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    match std::str::from_utf8(bytes) {
        Ok(text) => Ok(Source::new(name, text)),
        Err(error) => {
            let at = error.valid_up_to();
            let message = format!("{name} is not text: byte {} is not UTF-8", at + 1);
            let source = Source::new(name, &String::from_utf8_lossy(bytes));
            let span = Some(at..at + char::REPLACEMENT_CHARACTER.len_utf8());
            Err(InputError::usage(message).at(&Place { source, span }))
        }
    }
}

/// The names and the rows of a table in CSV. Its values are numbers, `NaN`, `inf` and `-inf`.
///
/// # Errors
/// A file that cannot be read, a header of numbers, a name that stands twice, a missing value or one that is no number: with the
/// place.
pub fn read_rows(path: &str) -> Result<(Vec<String>, Vec<Vec<f64>>), InputError> {
    let file = read(path)?;
    let mut lines = file.text.lines();
    let first = lines.next().unwrap_or("");
    if numbers_in(first, &file).is_ok_and(|row| !row.is_empty()) {
        let message = "the first line of a table names its columns, and this one has numbers";
        let help = "put a line of names before it, as `t,a,b,c`";
        return Err(InputError::usage(message).at(&file.whole(first)).help(help));
    }
    let names: Vec<String> = first.split(',').map(|name| name.trim().to_string()).collect();
    if let Some((_, name)) = names.iter().enumerate().find(|(at, name)| names[..*at].contains(name))
    {
        let message = format!("two columns have the name `{}`", shown(name));
        return Err(InputError::usage(message).at(&file.whole(first)));
    }
    let mut rows = Vec::new();
    for line in lines.filter(|line| !line.trim().is_empty()) {
        let row = line.split(',').map(|word| value(word.trim(), line, &file));
        let row = row.collect::<Result<Vec<_>, _>>()?;
        if row.len() != names.len() {
            let (found, expected) = (row.len(), names.len());
            let message = format!("a row of {found} numbers stands below {expected} names");
            return Err(InputError::usage(message).at(&file.whole(line)));
        }
        rows.push(row);
    }
    Ok((names, rows))
}

/// A value in a line of CSV.
fn value(word: &str, line: &str, file: &Source) -> Result<f64, InputError> {
    match word {
        "NaN" => Ok(f64::NAN),
        "inf" => Ok(f64::INFINITY),
        "-inf" => Ok(f64::NEG_INFINITY),
        "" => Err(InputError::usage("a value is missing").at(&file.whole(line))),
        _ => match numbers_in(word, file)?[..] {
            [value] => Ok(value),
            _ => {
                let message = format!("`{}` is not one number", shown(word));
                Err(InputError::usage(message).at(&file.whole(line)))
            }
        },
    }
}

/// The keys of a file, and the file with their places: JSON if the text begins with `{`, else TOML.
pub(crate) fn keys<T: DeserializeOwned>(
    source: &Source,
    content: &str,
) -> Result<(T, Source), InputError> {
    let text = &*source.text;
    let start = text.trim_start();
    if start.is_empty() {
        let error = InputError::usage(format!("{} is empty", source.name));
        return Err(error.help(content));
    }
    let refused =
        |message: &str, span| Err(syntax(message).at(&Place { source: source.clone(), span }));
    let table = if start.starts_with('{') {
        json::table(text).map_err(|(message, span)| (message, Some(span)))
    } else if source.name.ends_with(".json") {
        let at = text.len() - start.len();
        return refused("a JSON definition is an object of keys, {...}", Some(at..at));
    } else {
        DeTable::parse(text).map_err(|error| (error.message().into(), error.span()))
    };
    let mut table = match table {
        Ok(table) => table,
        Err((message, span)) => return refused(&message, span),
    };
    let placed = source.with_keys(table.get_ref());
    table.get_mut().iter_mut().for_each(|(_, value)| quote_huge(value.get_mut()));
    match T::deserialize(toml::Deserializer::from(table)) {
        Ok(keys) => Ok((keys, placed)),
        Err(error) => {
            let written = error.span().and_then(|span| text.get(span)).unwrap_or_default();
            let digits =
                written.trim_start_matches(['+', '-']).starts_with(|c: char| c.is_ascii_digit());
            // an integer of which `quote_huge` made a string
            let overflow = digits && error.message().starts_with("invalid type: string");
            let message = if overflow { "the integer overflows 64 bits" } else { error.message() };
            refused(message, error.span())
        }
    }
}

/// Makes strings of the decimal integers beyond 64 bits, which the parser would refuse.
fn quote_huge(value: &mut DeValue) {
    match value {
        DeValue::Integer(number)
            if number.radix() == 10
                && number.as_str().parse::<i64>().is_err()
                && number.as_str().parse::<u64>().is_err() =>
        {
            *value = DeValue::String(number.as_str().to_string().into());
        }
        DeValue::Array(items) => items.iter_mut().for_each(|item| quote_huge(item.get_mut())),
        DeValue::Table(table) => {
            table.iter_mut().for_each(|(_, value)| quote_huge(value.get_mut()));
        }
        _ => {}
    }
}

/// Keys of problem files that have new names.
const RENAMED: [(&str, &str); 6] = [
    ("space_velocity", "spatial_velocity"),
    ("space_momentum", "spatial_momentum"),
    ("space", "spatial"),
    ("given", "prescribed"),
    ("at", "position"),
    ("turn", "rotation"),
];

/// An error of the parser in the terms of definition files, without a place.
fn syntax(message: &str) -> InputError {
    let message = message.split(" at line ").next().unwrap_or(message);
    if let Some((what, keys)) = message.split_once(", expected ")
        && let Some(unknown) = what.strip_prefix("unknown field ")
        && let Some((old, new)) = RENAMED
            .iter()
            .find(|(old, new)| unknown == format!("`{old}`") && keys.contains(&format!("`{new}`")))
    {
        return InputError::usage(format!("`{old}` is now `{new}`")).help(format!("write `{new}`"));
    }
    let message = message
        .replace("unknown field", "unknown key")
        .replace("duplicate field", "duplicate key")
        .replace("expected i64", "expected an integer");
    match message.split_once(", expected one of ") {
        Some((what, keys)) => {
            let keys = keys.replace('`', "");
            let unknown = what.split('`').nth(1).unwrap_or("");
            let distance = |key: &&str| strsim::damerau_levenshtein(key, unknown);
            // longer words are no typing errors
            let nearest = keys.split(", ").filter(|key| unknown.len() < 32 && distance(key) < 3);
            let help = match nearest.min_by_key(distance) {
                Some(key) => format!("did you mean `{key}`?"),
                None => format!("the keys are {keys}"),
            };
            InputError::usage(what).help(help)
        }
        None => InputError::usage(message),
    }
}
