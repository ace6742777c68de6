//! Errors of the input: what, where, why, and what to do.

use super::escapes::Unescaped;
use crate::Error;
use affinor_tensors::TensorError;
use std::fmt;
use std::ops::Range;
use std::sync::Arc;

/// A text that was read, with the name it goes by in messages.
#[derive(Clone, Debug)]
pub struct Source {
    /// The file's path, or `<standard input>`, `--metric`, ...
    pub name: String,
    /// The text.
    pub text: Arc<str>,
    /// A string of the text that had to be unescaped, whose pieces have places too.
    unescaped: Option<Arc<Unescaped>>,
}

impl Source {
    /// A source.
    pub fn new(name: impl Into<String>, text: &str) -> Self {
        Source { name: name.into(), text: text.into(), unescaped: None }
    }

    /// This source, knowing the places of the pieces of `string`, which was read from it.
    pub(super) fn holding(&self, string: &str) -> Self {
        let verbatim = self.verbatim(string).is_some();
        let unescaped = (!verbatim).then(|| Unescaped::find(&self.text, string));
        Source { unescaped: unescaped.flatten().map(Arc::new), ..self.clone() }
    }

    /// The piece of this source that reads as `string`; a copy only where there is none.
    pub(super) fn own<'s>(&'s self, string: &'s str) -> &'s str {
        match (self.verbatim(string), &self.unescaped) {
            (Some(at), _) => &self.text[at..at + string.len()],
            (None, Some(unescaped)) => &unescaped.text,
            (None, None) => string,
        }
    }

    /// Where `string` stands in quotes, without escapes.
    fn verbatim(&self, string: &str) -> Option<usize> {
        offset(&self.text, string).or_else(|| {
            let quoted = |at: &usize| {
                let before = self.text[..*at].trim_end_matches(['\n', '\r']);
                before.ends_with(['"', '\''])
                    && self.text[at + string.len()..].starts_with(['"', '\''])
            };
            let places = self.text.match_indices(string).map(|(at, _)| at);
            places.into_iter().find(quoted)
        })
    }

    /// The place of `part`, a piece of this text, with `inside` relative to it.
    ///
    /// A piece is known by its address; a copy has no place, only a source.
    pub(super) fn find(&self, part: &str, inside: Range<usize>) -> Place {
        let shifted = |start: usize| start + inside.start..start + inside.end;
        let span = offset(&self.text, part).map(shifted).or_else(|| {
            let unescaped = self.unescaped.as_ref()?;
            let span = shifted(offset(&unescaped.text, part)?);
            Some(*unescaped.places.get(span.start)?..*unescaped.places.get(span.end)?)
        });
        self.place(span)
    }

    /// The place of the whole of `part`.
    pub(super) fn whole(&self, part: &str) -> Place {
        self.find(part, 0..part.len())
    }

    /// The place of a key of a definition, by itself or dotted.
    pub(super) fn key(&self, key: &str) -> Place {
        let at = self.text.match_indices(key).find_map(|(at, _)| {
            let before = self.text[..at].trim_end_matches(['"', '\'', '[', ' ', '\t']);
            let behind = &self.text[at + key.len()..];
            let behind = behind.trim_start_matches(['"', '\'', ']', ' ', '\t']);
            let begins = before.is_empty() || before.ends_with(['\n', '{', ',', '.']);
            (begins && behind.starts_with(['=', ':', '\n', '\r', '.'])).then_some(at)
        });
        self.place(at.map(|at| at..at + key.len()))
    }

    fn place(&self, span: Option<Range<usize>>) -> Place {
        Place { source: self.clone(), span }
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

    /// What stands there.
    pub fn text(&self) -> Option<&str> {
        self.source.text.get(self.span.clone()?)
    }
}

/// Whose fault an error is: the exit status of the command line.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Refusal {
    /// The mathematics refuses: exit status 1.
    Mathematics,
    /// Wrong usage or unreadable input: exit status 2.
    Usage,
}

/// An error of the input.
#[derive(Clone, Debug)]
pub struct InputError {
    /// The kind.
    pub refusal: Refusal,
    /// What is wrong, in one sentence, with the witness.
    pub message: String,
    /// The text it stands in, and where.
    pub at: Option<Box<Place>>,
    /// What to do.
    pub help: Option<String>,
}

impl InputError {
    /// Wrong usage or unreadable input.
    pub fn usage(message: impl Into<String>) -> Self {
        let message = message.into();
        InputError { refusal: Refusal::Usage, message, at: None, help: None }
    }

    /// A refusal of the mathematics.
    pub fn mathematics(message: impl Into<String>) -> Self {
        InputError { refusal: Refusal::Mathematics, ..Self::usage(message) }
    }

    /// With advice.
    #[must_use]
    pub fn help(mut self, help: impl Into<String>) -> Self {
        self.help = Some(help.into());
        self
    }

    /// With a place.
    #[must_use]
    pub(super) fn at(mut self, place: &Place) -> Self {
        self.at = Some(Box::new(place.clone()));
        self
    }

    /// With a place, unless it has one.
    #[must_use]
    pub(super) fn or_at(self, place: &Place) -> Self {
        if self.at.is_some() { self } else { self.at(place) }
    }

    /// With the place of what stands around it, unless its own is known.
    #[must_use]
    pub(super) fn or_near(self, place: &Place) -> Self {
        let known = self.at.as_ref().is_some_and(|at| at.span.is_some());
        if known { self } else { self.at(place) }
    }

    /// With the place of a part of a file, if it stands in a copy of this part.
    #[must_use]
    pub(super) fn moved(mut self, copy: &str, part: &Place) -> Self {
        if let (Some(at), Some(whole)) = (&mut self.at, &part.span)
            && at.source.name == copy
        {
            let inside = at.span.clone().filter(|_| part.text() == Some(&*at.source.text));
            let span = inside.map(|span| whole.start + span.start..whole.start + span.end);
            **at = Place { span: span.or(Some(whole.clone())), ..part.clone() };
        }
        self
    }

    /// With a place that may be unknown, unless it has one.
    #[must_use]
    pub(super) fn or_at_some(self, place: Option<&Place>) -> Self {
        match place {
            Some(place) => self.or_at(place),
            None => self,
        }
    }
}

impl fmt::Display for InputError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.message)
    }
}

impl std::error::Error for InputError {}

impl From<Error> for InputError {
    fn from(error: Error) -> Self {
        let refused = InputError::mathematics(error.to_string());
        match advice(&error) {
            Some(advice) => refused.help(advice),
            None => refused,
        }
    }
}

impl From<TensorError> for InputError {
    fn from(error: TensorError) -> Self {
        InputError::usage(error.to_string())
    }
}

/// What to do about a refusal of the mathematics.
fn advice(error: &Error) -> Option<&'static str> {
    match error {
        Error::NotAntisymmetric { .. } | Error::OrdersDisagree { .. } => {
            Some("[y,x] must be -[x,y], and [x,x] zero")
        }
        Error::Jacobi { .. } => Some("look at the brackets of these three basis vectors"),
        Error::NotClosed { .. } => Some("add the missing matrices to the basis"),
        Error::Dependent { .. } => Some("a basis has no such relation: leave a matrix out"),
        Error::NotSymmetric { .. } => Some("write the same value at both places"),
        Error::Degenerate { .. } => Some("a metric has an inverse: change it, or take another"),
        Error::NoMetric => Some("give a metric, for instance --metric identity"),
        Error::NotInvariant { .. } => Some("take --frame left, or a canonical connection"),
        Error::Overflow { .. } => Some("compute exactly: without --scalar float"),
        _ => None,
    }
}

/// The characters that can be shown as they are; all others stand there escaped, lookalikes too,
/// and an endless name is cut.
pub(super) fn shown(name: &str) -> String {
    const LONGEST: usize = 64;
    let plain = |c: &char| c.is_ascii_graphic() || *c == ' ';
    let shown = name.chars().take(LONGEST).map(|c| match plain(&c) {
        true => c.to_string(),
        false => c.escape_unicode().to_string(),
    });
    let rest = if name.chars().nth(LONGEST).is_some() { "..." } else { "" };
    shown.collect::<String>() + rest
}
