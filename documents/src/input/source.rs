//! Sources: texts that were read, and locations in them.

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
    /// The name: the path of the file, or `<standard input>`, `--metric`, ....
    pub name: String,
    /// The text.
    pub text: Arc<str>,
    /// The byte ranges of the keys of a file. The keys are given by their dotted paths.
    keys: Arc<BTreeMap<String, Range<usize>>>,
    /// The path of the table in which keys are looked up: dotted, and with a final dot.
    table: Arc<str>,
    /// The string of the file that is being parsed; `None` if the whole text is parsed.
    excerpt: Option<Arc<Excerpt>>,
    /// Whether names without a declaration are parameters.
    declares_names: bool,
    /// The number of files through which this file was included.
    pub(crate) depth: usize,
    /// The cache of files.
    pub(crate) files: Files,
}

/// A string or a number of a file.
#[derive(Debug)]
struct Excerpt {
    text: Text,
    /// The position of each byte of the string in its literal; `None` for a number that is written
    /// differently.
    places: Option<Vec<usize>>,
}

impl Excerpt {
    /// Converts a byte range of the excerpt to the byte range in the file.
    fn span(&self, inside: Range<usize>) -> Range<usize> {
        let Some(places) = &self.places else { return self.text.span.clone() };
        let at = |byte: usize| self.text.span.start + places[byte.min(places.len() - 1)];
        at(inside.start)..at(inside.end)
    }
}

impl Source {
    /// Creates a source from a text and its name.
    pub fn new(name: impl Into<String>, text: &str) -> Self {
        Source {
            name: name.into(),
            text: text.into(),
            keys: Arc::default(),
            table: "".into(),
            excerpt: None,
            declares_names: false,
            depth: 0,
            files: Files::default(),
        }
    }

    /// Returns the source as one that was included through `depth` files and uses the cache
    /// `files`.
    pub(crate) fn below(self, depth: usize, files: &Files) -> Self {
        Source { depth, files: files.clone(), ..self }
    }

    /// Returns the source with the locations of its keys, as the parser found them.
    pub(crate) fn with_keys(&self, table: &DeTable) -> Self {
        let mut keys = BTreeMap::new();
        collect(table, "", &mut keys);
        Source { keys: Arc::new(keys), ..self.clone() }
    }

    /// Returns the source with keys looked up in the table `key`.
    pub(crate) fn table(&self, key: &str) -> Self {
        Source { table: format!("{}{key}.", self.table).into(), ..self.clone() }
    }

    /// Returns a string of this file as a separate source. Pieces of its [`content`](Self::content)
    /// have locations in the file.
    pub(crate) fn excerpt(&self, text: &Text) -> Self {
        let literal = self.text.get(text.span.clone()).unwrap_or_default();
        let places = literal::places(literal, &text.content);
        let excerpt = Excerpt { text: text.clone(), places };
        Source { excerpt: Some(Arc::new(excerpt)), ..self.clone() }
    }

    /// The same source with a content that was made from its content: `places` has the position
    /// of each byte in the old content, of `length` bytes.
    pub(crate) fn rewritten(&self, content: String, mut places: Vec<usize>, length: usize) -> Self {
        places.push(length);
        let old = |at: usize| match &self.excerpt {
            Some(excerpt) => excerpt.span(at..at).start,
            None => at,
        };
        let places = Some(places.into_iter().map(old).collect());
        let text = Text { content, span: 0..self.text.len() };
        Source { excerpt: Some(Arc::new(Excerpt { text, places })), ..self.clone() }
    }

    /// Whether names without a declaration are parameters, as in a text that is typed into a
    /// field.
    pub(crate) fn declares_names(&self) -> bool {
        self.declares_names
    }

    /// The same text, in which names without a declaration are parameters.
    pub(crate) fn declaring_names(self) -> Self {
        Source { declares_names: true, ..self }
    }

    /// The text whose pieces have locations: the excerpt if there is one, otherwise the whole text.
    pub(crate) fn content(&self) -> &str {
        self.excerpt.as_ref().map_or(&self.text, |excerpt| &excerpt.text.content)
    }

    /// The location of the byte range `inside` of `part`, where `part` is a piece of the
    /// [`content`](Self::content).
    ///
    /// A piece is identified by its address, so a copy of a piece has no byte range, but only a
    /// source.
    pub(crate) fn find(&self, part: &str, inside: Range<usize>) -> Place {
        let span = offset(self.content(), part)
            .map(|start| start + inside.start..start + inside.end)
            .map(|span| match &self.excerpt {
                Some(excerpt) => excerpt.span(span),
                None => span,
            });
        self.place(span)
    }

    /// The location of the whole piece `part`.
    pub(crate) fn whole(&self, part: &str) -> Place {
        self.find(part, 0..part.len())
    }

    /// The location of a string or a number of this file, without its quotes.
    pub(crate) fn at(&self, text: &Text) -> Place {
        let excerpt = self.excerpt(text);
        excerpt.whole(excerpt.content())
    }

    /// The location of a key such as `initial.velocity`, given by its dotted path. If the key is
    /// absent, the location of the table around it.
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

    /// Whether the file contains a key, given by its dotted path.
    pub(crate) fn has_key(&self, path: &str) -> bool {
        self.keys.contains_key(&format!("{}{path}", self.table))
    }

    fn place(&self, span: Option<Range<usize>>) -> Place {
        Place { source: self.clone(), span }
    }
}

/// Collects the locations of the keys of a table and of its nested tables. Items of lists count
/// from 0.
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

/// The offset of `part` in `text`. `None` if `part` is not a slice of `text`, even if it is equal
/// to one.
fn offset(text: &str, part: &str) -> Option<usize> {
    let start = (part.as_ptr() as usize).checked_sub(text.as_ptr() as usize)?;
    (start + part.len() <= text.len()).then_some(start)
}

/// A location in a source.
#[derive(Clone, Debug)]
pub struct Place {
    /// The source.
    pub source: Source,
    /// The byte range in the text; `None` if it is unknown.
    pub span: Option<Range<usize>>,
}

impl Place {
    /// A location whose byte range is unknown.
    pub fn within(source: Source) -> Self {
        Place { source, span: None }
    }

    /// The text at the location.
    pub fn text(&self) -> Option<&str> {
        self.source.text.get(self.span.clone()?)
    }
}
