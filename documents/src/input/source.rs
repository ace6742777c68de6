//! Texts that were read, and locations in them.

use super::Files;
use super::forms::Text;
use super::literal;
use std::collections::BTreeMap;
use std::ops::Range;
use std::sync::Arc;
use toml::de::{DeTable, DeValue};

/// A text that was read, with its name for messages.
#[derive(Clone, Debug)]
pub struct Source {
    /// The file's path, or `<standard input>`, `--metric`, ...
    pub name: String,
    /// The text.
    pub text: Arc<str>,
    /// The byte ranges of the keys of a file, by their dotted paths.
    keys: Arc<BTreeMap<String, Range<usize>>>,
    /// The dotted path, with a final dot, of the table in which keys are looked up.
    table: Arc<str>,
    /// The string of the file that is being read; `None` for the whole text.
    excerpt: Option<Arc<Excerpt>>,
    /// The number of files through which this one was included.
    pub(crate) depth: usize,
    /// The cache of files.
    pub(crate) files: Files,
}

/// A string or a number of a file.
#[derive(Debug)]
struct Excerpt {
    text: Text,
    /// The positions of its bytes in its literal; `None` for a number that is written differently.
    places: Option<Vec<usize>>,
}

impl Excerpt {
    /// Converts a byte range of the excerpt to a byte range of the file.
    fn span(&self, inside: Range<usize>) -> Range<usize> {
        let Some(places) = &self.places else { return self.text.span.clone() };
        let at = |byte: usize| self.text.span.start + places[byte.min(places.len() - 1)];
        at(inside.start)..at(inside.end)
    }
}

impl Source {
    /// A source.
    pub fn new(name: impl Into<String>, text: &str) -> Self {
        Source {
            name: name.into(),
            text: text.into(),
            keys: Arc::default(),
            table: "".into(),
            excerpt: None,
            depth: 0,
            files: Files::default(),
        }
    }

    /// The same text, included through `depth` files, with a cache of files.
    pub(crate) fn below(self, depth: usize, files: &Files) -> Self {
        Source { depth, files: files.clone(), ..self }
    }

    /// The same text with the locations of its keys, as found by the parser.
    pub(crate) fn with_keys(&self, table: &DeTable) -> Self {
        let mut keys = BTreeMap::new();
        collect(table, "", &mut keys);
        Source { keys: Arc::new(keys), ..self.clone() }
    }

    /// The same source, with keys looked up in the table of a key.
    pub(crate) fn table(&self, key: &str) -> Self {
        Source { table: format!("{}{key}.", self.table).into(), ..self.clone() }
    }

    /// A string of this file as a separate source: pieces of its [`content`](Self::content) have
    /// locations in the file.
    pub(crate) fn excerpt(&self, text: &Text) -> Self {
        let literal = self.text.get(text.span.clone()).unwrap_or_default();
        let places = literal::places(literal, &text.content);
        let excerpt = Excerpt { text: text.clone(), places };
        Source { excerpt: Some(Arc::new(excerpt)), ..self.clone() }
    }

    /// The text whose pieces have locations: the excerpt, or the whole text.
    pub(crate) fn content(&self) -> &str {
        self.excerpt.as_ref().map_or(&self.text, |excerpt| &excerpt.text.content)
    }

    /// The location of `part`, a piece of the [`content`](Self::content), with the byte range
    /// `inside` relative to it.
    ///
    /// A piece is identified by its address; a copy has no byte range, only a source.
    pub(crate) fn find(&self, part: &str, inside: Range<usize>) -> Place {
        let span = offset(self.content(), part)
            .map(|start| start + inside.start..start + inside.end)
            .map(|span| match &self.excerpt {
                Some(excerpt) => excerpt.span(span),
                None => span,
            });
        self.place(span)
    }

    /// The location of the whole of `part`.
    pub(crate) fn whole(&self, part: &str) -> Place {
        self.find(part, 0..part.len())
    }

    /// The location of a string or a number of this file, without its quotes.
    pub(crate) fn at(&self, text: &Text) -> Place {
        let excerpt = self.excerpt(text);
        excerpt.whole(excerpt.content())
    }

    /// The location of a key, given by its dotted path, such as `initial.velocity`; or of the table
    /// around it.
    pub(crate) fn key(&self, path: &str) -> Place {
        let mut path = format!("{}{path}", self.table);
        loop {
            if let Some(span) = self.keys.get(&path) {
                return self.place(Some(span.clone()));
            }
            let Some(dot) = path.rfind('.') else { return self.place(None) };
            path.truncate(dot);
        }
    }

    /// Whether a key is given, by its dotted path.
    pub(crate) fn has_key(&self, path: &str) -> bool {
        self.keys.contains_key(&format!("{}{path}", self.table))
    }

    fn place(&self, span: Option<Range<usize>>) -> Place {
        Place { source: self.clone(), span }
    }
}

/// Collects the keys of a table and of its nested tables; items of lists count from 0.
fn collect(table: &DeTable, path: &str, keys: &mut BTreeMap<String, Range<usize>>) {
    for (key, value) in table {
        let path = format!("{path}{}", key.get_ref());
        match value.get_ref() {
            DeValue::Table(table) => collect(table, &format!("{path}."), keys),
            DeValue::Array(items) => {
                for (at, item) in items.iter().enumerate() {
                    if let DeValue::Table(table) = item.get_ref() {
                        collect(table, &format!("{path}.{at}."), keys);
                        keys.insert(format!("{path}.{at}"), item.span());
                    }
                }
            }
            _ => {}
        }
        keys.insert(path, key.span());
    }
}

/// The offset of `part` in `text`, if it is a slice of the text and not only an equal string.
fn offset(text: &str, part: &str) -> Option<usize> {
    let start = (part.as_ptr() as usize).checked_sub(text.as_ptr() as usize)?;
    (start + part.len() <= text.len()).then_some(start)
}

/// A location in a source.
#[derive(Clone, Debug)]
pub struct Place {
    /// The source.
    pub source: Source,
    /// The byte range in the text, if it is known.
    pub span: Option<Range<usize>>,
}

impl Place {
    /// A location without a byte range.
    pub fn within(source: Source) -> Self {
        Place { source, span: None }
    }

    /// The text at the location.
    pub fn text(&self) -> Option<&str> {
        self.source.text.get(self.span.clone()?)
    }
}
