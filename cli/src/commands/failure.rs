//! Failures of a command: the error report and the exit status.

use super::color::Color;
use super::note::line;
use affinor::Error;
use affinor_documents::input::{InputError, Refusal};
use annotate_snippets::{AnnotationKind, Group, Level, Origin, Renderer, Snippet};
use std::io::{self, IsTerminal, Write};
use std::ops::Range;

/// The reason why a command failed.
pub enum Failure {
    /// An error of the input, or a mathematical error.
    Input(Box<InputError>),
    /// Several errors of the input, in the order of the input.
    Several(Vec<InputError>),
    /// An error while writing the results to the named target.
    Output(io::Error, String),
    /// The output itself reports the mathematical failure, so no message is needed.
    Refuted,
    /// A signal: its number, and a message if the signal is not reported yet.
    Signal(u8, Option<String>),
}

impl From<InputError> for Failure {
    fn from(error: InputError) -> Self {
        Failure::Input(Box::new(error))
    }
}

impl From<Error> for Failure {
    fn from(error: Error) -> Self {
        InputError::from(error).into()
    }
}

impl Failure {
    /// Reports the failure on standard error. Returns the exit status, which is 0 (success) for a
    /// closed pipe.
    pub fn report(self, color: Color) -> u8 {
        match self {
            Failure::Output(error, _) if error.kind() == io::ErrorKind::BrokenPipe => 0,
            Failure::Refuted => 1,
            // shells use 128 plus the number of a signal as exit status
            Failure::Signal(signal, message) => {
                message.iter().for_each(|message| line(message));
                128 + signal
            }
            Failure::Output(error, target) => {
                show(&InputError::usage(format!("cannot write {target}: {error}")), color);
                2
            }
            Failure::Input(error) => Failure::Several(vec![*error]).report(color),
            Failure::Several(errors) => {
                errors.iter().for_each(|error| show(error, color));
                let usage =
                    errors.iter().any(|error| !matches!(error.refusal, Refusal::Mathematics));
                if usage { 2 } else { 1 }
            }
        }
    }
}

/// The widest line of a snippet.
const WIDTH: usize = 80;
/// The largest number of characters of a message; longer messages are shortened, because a witness
/// may be a huge number.
const LONGEST: usize = 480;

fn show(error: &InputError, color: Color) {
    let colored = match color {
        Color::Always => true,
        Color::Never => false,
        Color::Auto => io::stderr().is_terminal() && std::env::var_os("NO_COLOR").is_none(),
    };
    let renderer = if colored { Renderer::styled() } else { Renderer::plain() };
    let (message, help) = (shortened(&error.message), error.help.as_deref().map(shortened));
    let mut report = Group::with_title(Level::ERROR.primary_title(&message));
    let place = error.at.as_ref().map(|place| (&place.source, place.span.clone()));
    report = match &place {
        Some((source, Some(span))) if !source.text.is_empty() => {
            let (first, lines, span) = excerpt(&source.text, span.clone());
            let snippet = Snippet::source(lines).path(&source.name).line_start(first);
            report.element(snippet.annotation(AnnotationKind::Primary.span(span)))
        }
        Some((source, _)) => report.element(Origin::path(&source.name)),
        None => report,
    };
    if let Some(help) = &help {
        report = report.element(Level::HELP.message(help));
    }
    let text = renderer.term_width(WIDTH).render(&[report]);
    // ignores errors of writing: if standard error is closed, nobody can read the message
    let _ = writeln!(io::stderr(), "{text}");
}

/// The lines that contain a span. Returns the number of the first line, the text of the lines, and
/// the span within this text.
fn excerpt(text: &str, span: Range<usize>) -> (usize, &str, Range<usize>) {
    let (start, end) = (span.start.min(text.len()), span.end.min(text.len()));
    let from = text[..start].rfind('\n').map_or(0, |at| at + 1);
    let to = text[end..].find('\n').map_or(text.len(), |at| end + at);
    let first = text[..from].matches('\n').count() + 1;
    (first, &text[from..to], start - from..end - from)
}

/// Escapes control characters, and leaves out the middle of a long text.
fn shortened(text: &str) -> String {
    let escaped = |c: char| match c {
        '\n' | '"' | '\'' | '\\' => c.to_string(),
        c => c.escape_debug().to_string(),
    };
    let clean: Vec<String> = text.chars().map(escaped).collect();
    if clean.len() <= LONGEST {
        return clean.concat();
    }
    let (head, tail) = (&clean[..LONGEST / 2], &clean[clean.len() - LONGEST / 4..]);
    let all = clean.len();
    format!("{}...{} ({all} characters in all)", head.concat(), tail.concat())
}
