//! Parser of the keys of a file, which is written in TOML, or in JSON with the same keys.

use super::{InputError, Place, Source, json};
use serde::de::{DeserializeOwned, Error, Visitor, value};
use serde::{Deserializer, forward_to_deserialize_any};
use toml::de::{DeTable, DeValue};

/// Parses the keys of a file: JSON if the text begins with `{`, otherwise TOML. Also returns the
/// file with the locations of its keys.
pub(crate) fn parse_keys<T: DeserializeOwned>(
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
        return refused("a JSON definition must be an object of keys, {...}", Some(at..at));
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
            // `quote_huge` has converted this integer to a string
            let overflow = digits && error.message().starts_with("invalid type: string");
            let message = if overflow { "the integer exceeds 64 bits" } else { error.message() };
            refused(message, error.span())
        }
    }
}

/// The keys that a file with these contents may have.
pub(crate) fn known_keys<T: DeserializeOwned>() -> &'static [&'static str] {
    let mut keys: &'static [&'static str] = &[];
    // the probe stops with an error as soon as it has the names
    let _ = T::deserialize(KeyProbe(&mut keys));
    keys
}

/// A deserializer that contains nothing, and records the names of the fields that are asked for.
struct KeyProbe<'k>(&'k mut &'static [&'static str]);

impl<'de> Deserializer<'de> for KeyProbe<'_> {
    type Error = value::Error;

    fn deserialize_struct<V: Visitor<'de>>(
        self,
        _: &'static str,
        fields: &'static [&'static str],
        visitor: V,
    ) -> Result<V::Value, Self::Error> {
        *self.0 = fields;
        self.deserialize_any(visitor)
    }

    fn deserialize_any<V: Visitor<'de>>(self, _: V) -> Result<V::Value, Self::Error> {
        Err(value::Error::custom("a probe contains no values"))
    }

    forward_to_deserialize_any! {
        bool i8 i16 i32 i64 i128 u8 u16 u32 u64 u128 f32 f64 char str string bytes byte_buf option
        unit unit_struct newtype_struct seq tuple tuple_struct map enum identifier ignored_any
    }
}

/// Converts decimal integers beyond 64 bits to strings, because the parser would reject them.
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

/// Keys of problem files that were renamed.
const RENAMED: [(&str, &str); 6] = [
    ("space_velocity", "spatial_velocity"),
    ("space_momentum", "spatial_momentum"),
    ("space", "spatial"),
    ("given", "prescribed"),
    ("at", "position"),
    ("turn", "rotation"),
];

/// Translates an error of the parser to the terms of definition files, without a location.
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
        .replace("expected i64", "expected an integer")
        .replace("type: map", "type: table")
        .replace("expected a sequence", "expected a list [..]")
        .replace("expected a map", "expected a table {..}");
    match message.split_once(", expected one of ") {
        Some((what, keys)) => {
            let keys = keys.replace('`', "");
            let unknown = what.split('`').nth(1).unwrap_or("");
            let distance = |key: &&str| strsim::damerau_levenshtein(key, unknown);
            // only short words are compared, because a longer word is not a misspelled key
            let nearest = keys.split(", ").filter(|key| unknown.len() < 32 && distance(key) < 3);
            let help = match nearest.min_by_key(distance) {
                // the keys of a space, which are not those of a problem of mechanics
                _ if unknown == "space" && keys.contains("brackets") => {
                    "this is a problem of mechanics: use `affinor simulate`".into()
                }
                Some(key) => format!("did you mean `{key}`?"),
                None => format!("the keys are {keys}"),
            };
            InputError::usage(what).help(help)
        }
        None => InputError::usage(message),
    }
}
