//! Texts that were read, and places in them.

use super::Files;
use super::forms::Text;
use super::literal;
use std::collections::BTreeMap;
use std::ops::Range;
use std::sync::Arc;
use toml::de::{DeTable, DeValue};

/// A text that was read, with the name it goes by in messages.
#[derive(Clone, Debug)]
pub struct Source {
    /// The file's path, or `<standard input>`, `--metric`, ...
    pub name: String,
    /// The text.
    pub text: Arc<str>,
    /// Where the keys of a file stand, by their dotted paths.
    keys: Arc<BTreeMap<String, Range<usize>>>,
    /// The dotted path, with its last dot, of the table that keys are sought in.
    table: Arc<str>,
    /// The string of the file that is being read, if it is not the whole text.
    excerpt: Option<Arc<Excerpt>>,
    /// How many files led to this one.
    pub(crate) depth: usize,
    /// The files that were read.
    pub(crate) files: Files,
}

/// A string or a number of a file.
#[derive(Debug)]
struct Excerpt {
    text: Text,
    /// The places of its bytes in its literal; none for a number that is written in another way.
    places: Option<Vec<usize>>,
}

impl Excerpt {
    /// Bytes of the excerpt as bytes of the file.
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

    /// The same text, `depth` files below the first, with the files that were read.
    pub(crate) fn below(self, depth: usize, files: &Files) -> Self {
        Source { depth, files: files.clone(), ..self }
    }

    /// The same text with the places of its keys, as the parser found them.
    pub(crate) fn with_keys(&self, table: &DeTable) -> Self {
        let mut keys = BTreeMap::new();
        collect(table, "", &mut keys);
        Source { keys: Arc::new(keys), ..self.clone() }
    }

    /// The same source, keys of which are sought in the table of a key.
    pub(crate) fn table(&self, key: &str) -> Self {
        Source { table: format!("{}{key}.", self.table).into(), ..self.clone() }
    }

    /// A string of this file as a source of its own: pieces of its [`content`](Self::content) have places in the file.
    pub(crate) fn excerpt(&self, text: &Text) -> Self {
        let literal = self.text.get(text.span.clone()).unwrap_or_default();
        let places = literal::places(literal, &text.content);
        let excerpt = Excerpt { text: text.clone(), places };
        Source { excerpt: Some(Arc::new(excerpt)), ..self.clone() }
    }

    /// The text whose pieces have places: the excerpt, or all of it.
    pub(crate) fn content(&self) -> &str {
        self.excerpt.as_ref().map_or(&self.text, |excerpt| &excerpt.text.content)
    }

    /// The place of `part`, a piece of the [`content`](Self::content), with `inside` relative to it.
    ///
    /// A piece is known by its address; a copy has no place, only a source.
    pub(crate) fn find(&self, part: &str, inside: Range<usize>) -> Place {
        let span = offset(self.content(), part)
            .map(|start| start + inside.start..start + inside.end)
            .map(|span| match &self.excerpt {
                Some(excerpt) => excerpt.span(span),
                None => span,
            });
        self.place(span)
    }

    /// The place of the whole of `part`.
    pub(crate) fn whole(&self, part: &str) -> Place {
        self.find(part, 0..part.len())
    }

    /// The place of a string or a number of this file, without its quotes.
    pub(crate) fn at(&self, text: &Text) -> Place {
        let excerpt = self.excerpt(text);
        excerpt.whole(excerpt.content())
    }

    /// The place of a key by its dotted path, such as `initial.velocity`, or of the table around it.
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

/// Takes up the keys of a table and of the tables in it; items of lists count from 0.
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

/// Where `part` begins in `text`, if it is a piece of it and not only equal to one.
fn offset(text: &str, part: &str) -> Option<usize> {
    let start = (part.as_ptr() as usize).checked_sub(text.as_ptr() as usize)?;
    (start + part.len() <= text.len()).then_some(start)
}

/// Where in a source something stands.
#[derive(Clone, Debug)]
pub struct Place {
    /// The source.
    pub source: Source,
    /// The bytes of its text, where they are known.
    pub span: Option<Range<usize>>,
}

impl Place {
    /// Somewhere in a source.
    pub fn within(source: Source) -> Self {
        Place { source, span: None }
    }

    /// The text at the place.
    pub fn text(&self) -> Option<&str> {
        self.source.text.get(self.span.clone()?)
    }
}
