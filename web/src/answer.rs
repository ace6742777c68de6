//! The answers to requests of the page.

use super::words;
use affinor::Error;
use affinor::algebra::roots::CartanType;
use affinor_documents::input::{self, InputError, Place};
use affinor_documents::picture::{Picture, svg};
use affinor_documents::report::{Format, Report};
use serde_json::{Value, json};
use std::io::{self, Write};

/// The largest size of a report for the page.
const LONGEST: usize = 16 << 20;

/// A report in a format.
#[derive(Clone, Debug)]
pub struct Answer {
    text: String,
    notes: Vec<String>,
    pictures: Vec<Picture>,
    /// The types of simple factors, of which the page offers representations.
    types: Vec<CartanType>,
}

/// An error message for the page.
#[derive(Clone, Debug)]
pub struct Refusal {
    message: String,
    place: Option<Box<Value>>,
    help: Option<String>,
    suggestions: Vec<String>,
    /// Whether the module with all features may answer.
    elsewhere: bool,
}

impl Answer {
    /// The answer with a written report.
    ///
    /// # Errors
    /// An error for a report that is too long for the page.
    pub fn new(report: &dyn Report, format: Format, notes: Vec<String>) -> Result<Self, Refusal> {
        Self::written(notes, |out| report.write(format, out))
    }

    /// The answer with the output of a function.
    ///
    /// # Errors
    /// Those of [`new`](Self::new).
    pub fn written(
        notes: Vec<String>,
        write: impl FnOnce(&mut dyn Write) -> io::Result<()>,
    ) -> Result<Self, Refusal> {
        let mut out = Limited(vec![]);
        match write(&mut out) {
            Ok(()) => Ok(Answer {
                text: String::from_utf8_lossy(&out.0).into_owned(),
                notes,
                pictures: vec![],
                types: vec![],
            }),
            Err(error) => Err(Refusal {
                message: format!("the report cannot be written: {error}"),
                place: None,
                help: Some(
                    "choose fewer tensors, or fewer rows or methods of a motion, or use the program \
                     `affinor`"
                        .into(),
                ),
                suggestions: vec![],
                elsewhere: false,
            }),
        }
    }

    /// The same answer with pictures, and with the types of the simple factors of an algebra.
    #[must_use]
    pub fn with(self, pictures: Vec<Picture>, types: &[CartanType]) -> Self {
        Answer { pictures, types: types.to_vec(), ..self }
    }

    pub(super) fn json(&self) -> Value {
        let drawn = |picture: &Picture| json!({ "title": picture.title, "svg": svg(picture, picture.width.ceil() as u32) });
        let pictures: Vec<Value> = self.pictures.iter().map(drawn).collect();
        let types: Vec<String> = self.types.iter().map(CartanType::to_string).collect();
        json!({ "text": self.text, "notes": self.notes, "pictures": pictures, "types": types })
    }
}

impl Refusal {
    /// An error with this message.
    pub fn new(message: impl Into<String>) -> Self {
        Refusal {
            message: message.into(),
            place: None,
            help: None,
            suggestions: vec![],
            elsewhere: false,
        }
    }

    pub(super) fn json(&self) -> Value {
        let Refusal { message, place, help, suggestions, elsewhere } = self;
        json!({
            "message": message,
            "place": place,
            "help": help,
            "suggestions": suggestions,
            "elsewhere": elsewhere,
        })
    }
}

impl From<InputError> for Refusal {
    fn from(error: InputError) -> Self {
        let place = error.at.as_deref().map(|at| Box::new(place(at)));
        let help = error.help.as_deref().and_then(words::advice);
        let message = words::message(&error.message);
        let elsewhere = error.refusal == input::Refusal::Absent;
        Refusal { place, message, help, suggestions: error.suggestions, elsewhere }
    }
}

impl From<Error> for Refusal {
    fn from(error: Error) -> Self {
        InputError::from(error).into()
    }
}

/// The source of a location, its line, from 1, the text of the line, and the range in it in units
/// of UTF-16, in which scripts count.
fn place(place: &Place) -> Value {
    let (source, text) = (words::source(&place.source.name), &*place.source.text);
    let Some(span) = place.span.clone().filter(|span| text.get(span.clone()).is_some()) else {
        return json!({ "source": source });
    };
    let start = text[..span.start].rfind('\n').map_or(0, |at| at + 1);
    let end = text[span.start..].find('\n').map_or(text.len(), |at| span.start + at);
    let units = |part: &str| part.encode_utf16().count();
    json!({
        "source": source,
        "line": text[..span.start].matches('\n').count() + 1,
        "text": &text[start..end],
        "from": units(&text[start..span.start]),
        "to": units(&text[start..span.end.min(end)]),
        "selection": [units(&text[..span.start]), units(&text[..span.end])],
    })
}

/// A buffer of bytes with a limit.
struct Limited(Vec<u8>);

impl Write for Limited {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        if self.0.len() + bytes.len() > LONGEST {
            let message = format!("it is longer than {} MB", LONGEST >> 20);
            return Err(io::Error::new(io::ErrorKind::FileTooLarge, message));
        }
        self.0.extend_from_slice(bytes);
        Ok(bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}
