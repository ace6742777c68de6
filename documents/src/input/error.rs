//! Errors of the input: the fault, its location, and advice.

use super::{Place, Source};
use affinor::{Error, Law};
use affinor_tensors::TensorError;
use affinor_tensors::expression::{is_printable, looks_latin};
use std::fmt;
use std::sync::Arc;

/// The kind of an error, which decides the exit status of the command line.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Refusal {
    /// Valid input without a mathematical answer: exit status 1.
    Mathematics,
    /// Wrong usage or unreadable input: exit status 2.
    Usage,
    /// Input that a build with more features reads: exit status 2.
    Absent,
}

/// An error of the input.
#[derive(Clone, Debug)]
pub struct InputError {
    /// The kind of the error.
    pub refusal: Refusal,
    /// The fault in one sentence, including its witness.
    pub message: String,
    /// The location of the fault.
    pub at: Option<Box<Place>>,
    /// Advice: text to write instead.
    pub help: Option<String>,
    /// Names that may have been meant instead.
    pub suggestions: Vec<String>,
    /// The error of the library from which this error was made.
    pub cause: Option<Arc<Error>>,
}

impl InputError {
    /// An error of wrong usage or unreadable input.
    pub fn usage(message: impl Into<String>) -> Self {
        let message = message.into();
        InputError {
            refusal: Refusal::Usage,
            message,
            at: None,
            help: None,
            suggestions: vec![],
            cause: None,
        }
    }

    /// A mathematical error.
    pub fn mathematics(message: impl Into<String>) -> Self {
        InputError { refusal: Refusal::Mathematics, ..Self::usage(message) }
    }

    /// Adds advice.
    #[must_use]
    pub fn help(mut self, help: impl Into<String>) -> Self {
        self.help = Some(help.into());
        self
    }

    /// Adds a location.
    #[must_use]
    pub(crate) fn at(mut self, place: &Place) -> Self {
        self.at = Some(Box::new(place.clone()));
        self
    }

    /// Adds a location, if it is known and the error has no location yet.
    #[must_use]
    pub(crate) fn or_at<'p>(self, place: impl Into<Option<&'p Place>>) -> Self {
        match place.into() {
            Some(place) if self.at.is_none() => self.at(place),
            _ => self,
        }
    }

    /// Moves a location in an extracted copy back to the file from which the copy was made.
    #[must_use]
    pub(crate) fn moved(mut self, copy: &str, part: &Place) -> Self {
        if let (Some(at), Some(whole)) = (&mut self.at, &part.span)
            && at.source.name == copy
        {
            let inside = at.span.clone().filter(|_| part.text() == Some(&*at.source.text));
            let span = inside.map(|span| whole.start + span.start..whole.start + span.end);
            **at = Place { span: span.or(Some(whole.clone())), ..part.clone() };
        }
        self
    }
}

impl Source {
    /// An error at the location of a key, given by its dotted path.
    pub(crate) fn refused(&self, path: &str, message: impl Into<String>) -> InputError {
        InputError::usage(message).at(&self.key(path))
    }
}

impl fmt::Display for InputError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.message)
    }
}

impl std::error::Error for InputError {
    /// The source of the [`cause`](Self::cause). The cause itself is skipped, because its message
    /// is part of this error.
    fn source(&self) -> Option<&(dyn std::error::Error + 'static)> {
        self.cause.as_ref()?.source()
    }
}

impl From<Error> for InputError {
    fn from(error: Error) -> Self {
        let (message, help) = (error.to_string(), advice(&error).map(String::from));
        InputError { help, cause: Some(Arc::new(error)), ..InputError::mathematics(message) }
    }
}

impl From<TensorError> for InputError {
    fn from(error: TensorError) -> Self {
        let cause = Some(Arc::new(Error::from(error.clone())));
        InputError { cause, ..InputError::usage(error.to_string()) }
    }
}

/// The advice for an error: advice in terms of the command line if there is any, otherwise the
/// advice of the library.
fn advice(error: &Error) -> Option<&'static str> {
    match error {
        Error::NoMetric => Some("give a metric, for instance --metric identity"),
        Error::Broken { law: Law::AdInvariance, .. } => {
            Some("write --frame left, or choose a canonical connection")
        }
        Error::Overflow { .. } | Error::NotFinite { .. } => {
            Some("compute exactly: leave --scalar float out")
        }
        other => other.advice(),
    }
}

/// Prepares a name for a message. Control characters are escaped, and so are non-ASCII letters if
/// the name looks like an ASCII name. Long names are truncated.
pub(crate) fn shown(name: &str) -> String {
    const LONGEST: usize = 64;
    let latin = looks_latin(name);
    let plain = |c: char| is_printable(c) && (c.is_ascii() || !latin);
    let shown = name.chars().take(LONGEST).map(|c| match plain(c) {
        true => c.to_string(),
        false => c.escape_unicode().to_string(),
    });
    let rest = if name.chars().nth(LONGEST).is_some() { "..." } else { "" };
    shown.collect::<String>() + rest
}
