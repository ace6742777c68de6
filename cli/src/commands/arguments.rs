//! Preprocessing of the arguments of the program, before clap parses them.

use clap::{ArgMatches, Command, Error};
use std::ffi::OsString;

/// Parses the arguments of the program; the first argument is the name of the program.
///
/// # Errors
/// The error to print, or the help text if the arguments ask for help.
pub fn parse(command: fn() -> Command, arguments: &[OsString]) -> Result<ArgMatches, Error> {
    let parsed = |escaped: fn(&str) -> Option<OsString>| {
        let arguments = arguments.iter().map(|argument| match argument.to_str() {
            Some(text) => escaped(text).unwrap_or_else(|| shielded(argument)),
            None => argument.clone(),
        });
        command().try_get_matches_from(arguments)
    };
    parsed(|_| None).map_err(|error| {
        // clap repeats arguments in its messages, so control characters in arguments are escaped
        // first
        let escaped = parsed(|text| {
            text.contains(char::is_control).then(|| text.escape_debug().to_string().into())
        });
        escaped.err().unwrap_or(error)
    })
}

/// Prints an error of the arguments, or the requested help. Returns the exit status.
pub fn report(error: &Error) -> u8 {
    // ignores errors of printing: if the stream is closed, nobody reads the text
    let _ = error.print();
    u8::try_from(error.exit_code()).unwrap_or(2)
}

/// Puts a space before a row of numbers that begins with a minus, because clap would read the row
/// as an option.
fn shielded(argument: &OsString) -> OsString {
    let number = |text: &&str| {
        let constant = text.starts_with("pi") || text.starts_with("tau");
        let digit = text.starts_with(|c: char| c.is_ascii_digit() || c == '.');
        // leaves a single negative number unchanged, because clap accepts it
        constant || (digit && text.contains([',', ' ', '/', '*']))
    };
    match argument.to_str().and_then(|text| text.strip_prefix('-')).filter(number) {
        Some(row) => format!(" -{row}").into(),
        None => argument.clone(),
    }
}
