//! Texts that are typed into a field: a name, brackets, matrices, or the keys of a definition.

use super::document::Document;
use super::named::named_space;
use super::tables::{self, TYPED};
use super::{Definition, spelling};
use crate::input::{InputError, Source, known_keys, parse_keys};

/// The kind of a typed text.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Typed {
    /// A name of the catalogue, or a sum of names.
    Name,
    /// A table in the notation with this name, such as `brackets`.
    Table(&'static str),
    /// The keys of a definition, in TOML or JSON.
    Keys,
}

/// The definition in a text that is typed into a field, which is not a path, and the kind of the
/// text. Names without a declaration become parameters.
///
/// ```
/// use affinor_documents::space::{Typed, typed};
/// let (definition, kind) = typed("SU(2)")?;
/// assert_eq!((definition.name.as_str(), kind), ("su(2)", Typed::Name));
/// let (definition, _) = typed(r"\left[x, y\right] = 2 a z")?;
/// assert_eq!(definition.parameters(), ["a"]);
/// # Ok::<(), affinor_documents::input::InputError>(())
/// ```
///
/// # Errors
/// An error with its location, for a text that cannot be read.
pub fn definition(text: &str) -> Result<(Definition, Typed), InputError> {
    let source = Source::new(TYPED, text).declaring_names();
    if text.trim().is_empty() {
        let error = InputError::usage("the field is empty");
        return Err(error.help("write a name such as so(3), or brackets such as [x, y] = z"));
    }
    if has_keys(text) {
        let (keys, source) = parse_keys::<Document>(&source, "give a basis and brackets")?;
        let mut definition = keys.define(&source)?;
        // without a name of its own a definition has that of its source
        if definition.name == TYPED {
            definition.name = "your space".into();
        }
        return Ok((definition, Typed::Keys));
    }
    if let Some(read) = tables::typed(&source) {
        return read.map(|(definition, notation)| (definition, Typed::Table(notation)));
    }
    let folded = spelling::folded(text);
    // positions in the text hold only in a text that has not changed
    let source = if folded == text { source } else { Source::new(TYPED, &folded) };
    Ok((named_space(&source)?, Typed::Name))
}

/// Whether a text consists of keys: an object of JSON, a table head, or a known key and `=`.
fn has_keys(text: &str) -> bool {
    let first = tables::first_line(text);
    let object = first.strip_prefix('{').map(str::trim_start);
    let next = text.trim_start().strip_prefix('{').map(str::trim_start);
    let head = first.strip_prefix('[').and_then(|rest| rest.split_once(']'));
    let keys = known_keys::<Document>();
    let is_key = |word: &str| keys.contains(&word.trim().trim_matches(['"', '\'']));
    object.is_some_and(|_| next.is_some_and(|next| next.starts_with('"')))
        || head.is_some_and(|(key, behind)| behind.trim().is_empty() && is_key(key))
        || first.split_once('=').is_some_and(|(key, _)| is_key(key.split('.').next().unwrap_or("")))
}
