//! Converts JSON to a table of the TOML parser, with the location of every key and value.

use super::forms::Entries;
use serde::de::Deserialize;
use serde_json::value::{RawValue, Value};
use std::borrow::Cow;
use std::ops::Range;
use toml::Spanned;
use toml::de::{DeArray, DeTable, DeValue};

/// The message of the JSON parser for a number beyond the range of floats.
const OUT_OF_RANGE: &str = "number out of range";
/// The deepest nesting, which equals the limit of the JSON parser.
const MAX_DEPTH: usize = 128;

/// An error message, and its location.
type Refused = (String, Range<usize>);

/// Converts a JSON object to a table. A key with the value `null` counts as absent.
pub(crate) fn table(text: &str) -> Result<Spanned<DeTable<'_>>, Refused> {
    // parses with serde_json first, because it limits nesting and the size of numbers, and has
    // better messages than the parser of this module
    match serde_json::from_str::<Value>(text) {
        // ignores this error, because the number may be a large integer, which is allowed
        Err(error) if error.to_string().starts_with(OUT_OF_RANGE) => {}
        checked => drop(checked.map_err(|error| refused(&error, text, 0))?),
    }
    let json = Json(text);
    let raw: &RawValue = json.parse_from(text, 0)?;
    let span = json.span(raw);
    match json.value(raw, 0)?.map(Spanned::into_inner) {
        Some(DeValue::Table(table)) => Ok(Spanned::new(span, table)),
        _ => Err(("a JSON definition must be an object of keys, {...}".into(), span)),
    }
}

/// The whole text, in which slices have positions.
#[derive(Clone, Copy)]
struct Json<'t>(&'t str);

impl<'t> Json<'t> {
    fn span(self, raw: &RawValue) -> Range<usize> {
        let start = raw.get().as_ptr() as usize - self.0.as_ptr() as usize;
        start..start + raw.get().len()
    }

    /// Converts one value; `None` for `null`.
    fn value(
        self,
        raw: &'t RawValue,
        depth: usize,
    ) -> Result<Option<Spanned<DeValue<'t>>>, Refused> {
        let (span, written) = (self.span(raw), raw.get());
        if depth > MAX_DEPTH {
            return Err(("recursion limit exceeded".into(), span));
        }
        let value = match written.as_bytes().first() {
            Some(b'{') => {
                let Entries::<&RawValue, &RawValue>(entries) = self.parse(raw)?;
                let mut table = DeTable::new();
                for (key, value) in entries {
                    let place = self.span(key);
                    let key: String = self.parse(key)?;
                    if table.contains_key(key.as_str()) {
                        return Err((format!("duplicate field `{key}`"), place));
                    }
                    if let Some(value) = self.value(value, depth + 1)? {
                        table.insert(Spanned::new(place, Cow::Owned(key)), value);
                    }
                }
                DeValue::Table(table)
            }
            Some(b'[') => {
                let mut array = DeArray::new();
                for item in self.parse::<Vec<&RawValue>>(raw)? {
                    let value = self.value(item, depth + 1)?;
                    let null = || ("invalid type: null, expected a value".into(), self.span(item));
                    array.push(value.ok_or_else(null)?);
                }
                DeValue::Array(array)
            }
            Some(b'"') => DeValue::String(Cow::Owned(self.parse(raw)?)),
            Some(b't' | b'f') => DeValue::Boolean(self.parse(raw)?),
            Some(b'n') => return Ok(None),
            // parses a number as TOML, because the syntax of every JSON number is valid in TOML
            _ => {
                let number = DeValue::parse(written);
                let number = number.map_err(|error| (error.message().into(), span.clone()))?;
                if matches!(number.get_ref(), DeValue::Float(_))
                    && written.parse().is_ok_and(f64::is_infinite)
                {
                    return Err((OUT_OF_RANGE.into(), span));
                }
                number.into_inner()
            }
        };
        Ok(Some(Spanned::new(span, value)))
    }

    fn parse<T: Deserialize<'t>>(self, raw: &'t RawValue) -> Result<T, Refused> {
        self.parse_from(raw.get(), self.span(raw).start)
    }

    fn parse_from<T: Deserialize<'t>>(self, part: &'t str, start: usize) -> Result<T, Refused> {
        serde_json::from_str(part).map_err(|error| refused(&error, self.0, start))
    }
}

/// Converts an error in the part of `text` that begins at `start`. The columns of JSON errors count
/// bytes.
fn refused(error: &serde_json::Error, text: &str, start: usize) -> Refused {
    let lines = text[start..].split_inclusive('\n').take(error.line().saturating_sub(1));
    let before: usize = lines.map(str::len).sum();
    let mut at = (start + before + error.column().saturating_sub(1)).min(text.len());
    while !text.is_char_boundary(at) {
        at -= 1;
    }
    (error.to_string(), at..at)
}
