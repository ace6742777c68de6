//! Definitions read from files.

use super::{Definition, tables};
use crate::input::file::{name, read};
use crate::input::{Files, InputError, Source};

impl Definition {
    /// Reads a definition from a file, or from standard input for `-`.
    ///
    /// # Errors
    /// A file that cannot be read, parsed or understood, with the place.
    pub fn read(path: &str) -> Result<Self, InputError> {
        Self::read_part(path, 0, &Files::default())
    }

    /// Reads a definition that a file contains, `depth` files below the first.
    pub(crate) fn read_part(path: &str, depth: usize, files: &Files) -> Result<Self, InputError> {
        let source = match files.content(path) {
            Some(text) => Source::new(name(path), &text),
            None => read(path)?,
        };
        files.keep(path, &source.text);
        tables::definition(&source.below(depth, files))
    }

    /// Reads a definition from the text of a file; messages call it `name`.
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
    /// A text that cannot be parsed or understood, with the place.
    pub fn parse(name: &str, text: &str) -> Result<Self, InputError> {
        Self::parse_part(name, text, &Files::default())
    }

    /// Reads a definition from a text that may name files.
    pub(crate) fn parse_part(name: &str, text: &str, files: &Files) -> Result<Self, InputError> {
        let source = Source::new(name.escape_debug().to_string(), text);
        tables::definition(&source.below(0, files))
    }
}
