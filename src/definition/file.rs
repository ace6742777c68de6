//! Definition files: TOML, or JSON with the same keys.

use super::document::Document;
use super::input::{InputError, Place, Source};
use super::{Definition, numbers};
use serde::Deserialize;
use std::fs::File;
use std::io::{self, Read};
use std::ops::Range;
use std::path::Path;

/// The most bytes a file may have.
const MAX_BYTES: u64 = 1 << 28;

/// What a file holds, or standard input for `-`, with the name it goes by in messages.
pub(super) fn bytes(path: &str) -> Result<(String, Vec<u8>), InputError> {
    let name = match path {
        "-" => "<standard input>".to_string(),
        path => path.escape_debug().to_string(),
    };
    let mut bytes = Vec::new();
    let length = match path {
        "-" => io::stdin().lock().take(MAX_BYTES + 1).read_to_end(&mut bytes),
        path => File::open(path).and_then(|file| file.take(MAX_BYTES + 1).read_to_end(&mut bytes)),
    };
    let length =
        length.map_err(|error| InputError::usage(format!("cannot read {name}: {error}")))?;
    if length as u64 > MAX_BYTES {
        let message = format!("{name} has more than {MAX_BYTES} bytes");
        return Err(InputError::usage(message));
    }
    Ok((name, bytes))
}

/// A number of what a file holds, to see whether it is still the same: FNV-1a, against
/// mistakes and not against malice. Of what is no regular file, such as a pipe, it is 0.
///
/// # Errors
/// What cannot be read.
pub fn fingerprint(path: &str) -> Result<u64, InputError> {
    if !Path::new(path).is_file() {
        return Ok(0);
    }
    let mix = |hash: u64, byte: &u8| (hash ^ u64::from(*byte)).wrapping_mul(0x0100_0000_01b3);
    Ok(bytes(path)?.1.iter().fold(0xcbf2_9ce4_8422_2325, mix))
}

impl Definition {
    /// Reads a definition from a file, or from standard input for `-`.
    ///
    /// # Errors
    /// What cannot be read, parsed or understood, with its place.
    pub fn read(path: &str) -> Result<Self, InputError> {
        Self::of_source(&read(path)?)
    }

    /// Reads a definition from the text of a file; `name` is what messages call it.
    ///
    /// ```
    /// use affinor::definition::Definition;
    /// let plane = "basis = ['x', 'y']\nbrackets = '[x, y] = 1/2 x'";
    /// assert_eq!(Definition::parse("plane.toml", plane)?.dimension(), 2);
    ///
    /// let error = Definition::parse("plane.toml", &plane.replace("2 x", "0 x")).unwrap_err();
    /// assert_eq!(error.to_string(), "division by zero");
    /// # Ok::<(), affinor::definition::InputError>(())
    /// ```
    ///
    /// # Errors
    /// What cannot be parsed or understood, with its place.
    pub fn parse(name: &str, text: &str) -> Result<Self, InputError> {
        Self::of_source(&Source::new(name.escape_debug().to_string(), text))
    }

    fn of_source(source: &Source) -> Result<Self, InputError> {
        keys::<Document>(source, "a definition has a basis and brackets")?.define(source)
    }
}

/// The text of a file, or of standard input for `-`.
///
/// # Errors
/// What cannot be read, or is not UTF-8.
pub(super) fn read(path: &str) -> Result<Source, InputError> {
    let (name, bytes) = bytes(path)?;
    decode(&name, &bytes)
}

fn decode(name: &str, bytes: &[u8]) -> Result<Source, InputError> {
    if bytes.starts_with(&[0xff, 0xfe]) || bytes.starts_with(&[0xfe, 0xff]) {
        let error = InputError::usage(format!("{name} is UTF-16"));
        return Err(error.help("save it as UTF-8"));
    }
    let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    match std::str::from_utf8(bytes) {
        Ok(text) => Ok(Source::new(name, text)),
        Err(error) => {
            let at = error.valid_up_to();
            let (message, source) = (
                format!("{name} is not text: byte {} is not UTF-8", at + 1),
                Source::new(name, &String::from_utf8_lossy(bytes)),
            );
            let span = Some(at..at + char::REPLACEMENT_CHARACTER.len_utf8());
            Err(InputError::usage(message).at(&Place { source, span }))
        }
    }
}

/// The names and the rows of a table in CSV.
///
/// # Errors
/// What cannot be read, names that are numbers, and what is no number, with its place.
pub fn read_rows(path: &str) -> Result<(Vec<String>, Vec<Vec<f64>>), InputError> {
    const ROW: &str = "a row";
    let file = read(path)?;
    let mut lines = file.text.lines();
    let first = lines.next().unwrap_or("");
    if numbers(&Source::new(ROW, first)).is_ok_and(|row| !row.is_empty()) {
        let message = "the first line of a table names its columns, and this one has numbers";
        let help = "put a line of names before it, as `t,a,b,c`";
        return Err(InputError::usage(message).at(&file.whole(first)).help(help));
    }
    let names: Vec<String> = first.split(',').map(|name| name.trim().to_string()).collect();
    let mut rows = Vec::new();
    for line in lines.filter(|line| !line.trim().is_empty()) {
        let row = numbers(&Source::new(ROW, line));
        let row = row.map_err(|error| error.moved(ROW, &file.whole(line)))?;
        if row.len() != names.len() {
            let (found, expected) = (row.len(), names.len());
            let message = format!("a row of {found} numbers stands below {expected} names");
            return Err(InputError::usage(message).at(&file.whole(line)));
        }
        rows.push(row);
    }
    Ok((names, rows))
}

/// The keys of a file: JSON if the text begins with `{`, else TOML.
///
/// # Errors
/// What cannot be parsed, with its place; an empty file, with what belongs there.
pub(super) fn keys<'t, T: Deserialize<'t>>(
    source: &'t Source,
    content: &str,
) -> Result<T, InputError> {
    let text = &*source.text;
    let start = text.trim_start();
    if start.is_empty() {
        let error = InputError::usage(format!("{} is empty", source.name));
        return Err(error.help(content));
    }
    let (message, span) = if start.starts_with('{') {
        match serde_json::from_str(text) {
            Ok(keys) => return Ok(keys),
            Err(error) => (error.to_string(), Some(position(&error, text))),
        }
    } else if source.name.ends_with(".json") {
        let at = text.len() - start.len();
        ("a JSON definition is an object of keys, {...}".into(), Some(at..at))
    } else {
        match toml::from_str(text) {
            Ok(keys) => return Ok(keys),
            Err(error) => (error.message().into(), error.span()),
        }
    };
    let source = source.clone();
    Err(syntax(&message).at(&Place { source, span }))
}

/// Where a JSON error stands: its columns count bytes.
fn position(error: &serde_json::Error, text: &str) -> Range<usize> {
    let lines = text.split_inclusive('\n').take(error.line().saturating_sub(1));
    let before: usize = lines.map(str::len).sum();
    let mut at = (before + error.column().saturating_sub(1)).min(text.len());
    while !text.is_char_boundary(at) {
        at -= 1;
    }
    at..at
}

/// An error of the parser in the words of definitions, without the place.
fn syntax(message: &str) -> InputError {
    let message = message.split(" at line ").next().unwrap_or(message);
    let message = message
        .replace("unknown field", "unknown key")
        .replace("duplicate field", "duplicate key")
        .replace("expected i64", "expected an integer");
    match message.split_once(", expected one of ") {
        Some((what, keys)) => {
            let keys = keys.replace('`', "");
            let unknown = what.split('`').nth(1).unwrap_or("");
            let distance = |key: &&str| strsim::damerau_levenshtein(key, unknown);
            // longer words are no slips of the hand
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
