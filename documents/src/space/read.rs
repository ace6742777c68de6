//! Definitions read from files.

use super::document::Document;
use super::{Definition, tables};
use crate::input::file::{name, read};
use crate::input::{Files, InputError, Source, parse_keys};

impl Definition {
    /// Reads a definition from a file, or from standard input for `-`.
    ///
    /// # Errors
    /// An error with its location if the file cannot be read, or if its content is invalid.
    pub fn read(path: &str) -> Result<Self, InputError> {
        Self::read_part(path, 0, &Files::default())
    }

    /// Reads a definition that was included through `depth` files.
    pub(crate) fn read_part(path: &str, depth: usize, files: &Files) -> Result<Self, InputError> {
        let source = match files.content(path) {
            Some(text) => Source::new(name(path), &text),
            None => read(path)?,
        };
        files.keep(path, &source.text);
        Self::of_source(&source.below(depth, files))
    }

    /// Reads a definition from the text of a file, which messages call `name`.
    ///
    /// ```
    /// use affinor_documents::space::Definition;
    /// let plane = "basis = ['x', 'y']\nbrackets = '[x, y] = 1/2 x'";
    /// assert_eq!(Definition::parse("plane.toml", plane)?.dimension(), 2);
    ///
    /// let error = Definition::parse("plane.toml", &plane.replace("2 x", "0 x")).unwrap_err();
    /// assert_eq!(error.to_string(), "division by zero");
    /// # Ok::<(), affinor_documents::input::InputError>(())
    /// ```
    ///
    /// # Errors
    /// An error with its location if the text is invalid.
    pub fn parse(name: &str, text: &str) -> Result<Self, InputError> {
        Self::parse_part(name, text, &Files::default())
    }

    /// Reads a definition from a text that may refer to other files.
    pub(crate) fn parse_part(name: &str, text: &str, files: &Files) -> Result<Self, InputError> {
        let source = Source::new(name.escape_debug().to_string(), text);
        Self::of_source(&source.below(0, files))
    }

    /// Reads the definition in a text: a table if the text is one, otherwise keys.
    fn of_source(source: &Source) -> Result<Self, InputError> {
        if let Some(table) = tables::definition(source) {
            return table;
        }
        // for a file that should contain keys, the error of the parser is the clearest
        let has_keys = [".toml", ".json"].iter().any(|ending| source.name.ends_with(ending));
        if !has_keys && !is_document(source.content()) {
            return Err(tables::unknown(source));
        }
        let (keys, source) = parse_keys::<Document>(source, "give a basis and brackets")?;
        keys.define(&source)
    }
}

/// Whether a text consists of keys. Such a text is empty, a JSON object, or begins with a key and
/// `=`, or with the header of a table.
fn is_document(text: &str) -> bool {
    let first = tables::first_line(text);
    first.is_empty() || first.starts_with(['{', '[']) || first.contains('=')
}
