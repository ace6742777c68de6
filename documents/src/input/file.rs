//! Functions that read files.

use super::{InputError, Place, Source};
use std::fs::File;
use std::io::{self, Read};
use std::path::Path;

/// The largest size of a file in bytes.
pub(crate) const MAX_BYTES: u64 = 1 << 28;

/// The name of a file in messages.
pub(crate) fn name(path: &str) -> String {
    match path {
        "-" => "<standard input>".to_string(),
        path => path.escape_debug().to_string(),
    }
}

/// Reads a file, or standard input for `-`. Returns the name for messages, and the content.
pub(crate) fn bytes(path: &str, limit: u64) -> Result<(String, Vec<u8>), InputError> {
    let name = name(path);
    let mut bytes = Vec::new();
    let length = match path {
        "-" => io::stdin().lock().take(limit + 1).read_to_end(&mut bytes),
        path => File::open(path).and_then(|file| file.take(limit + 1).read_to_end(&mut bytes)),
    };
    match length {
        Err(error) => return Err(InputError::usage(format!("cannot read {name}: {error}"))),
        Ok(length) if length as u64 > limit => {
            return Err(InputError::usage(format!("{name} has more than {limit} bytes")));
        }
        Ok(_) => {}
    }
    Ok((name, bytes))
}

/// A hash of the content of a file (FNV-1a), which detects accidental changes. It is 0 for a pipe
/// or another special file.
///
/// # Errors
/// An error for a file that cannot be read.
pub fn fingerprint(path: &str) -> Result<u64, InputError> {
    if !Path::new(path).is_file() {
        return Ok(0);
    }
    let mix = |hash: u64, byte: &u8| (hash ^ u64::from(*byte)).wrapping_mul(0x0100_0000_01b3);
    Ok(bytes(path, MAX_BYTES)?.1.iter().fold(0xcbf2_9ce4_8422_2325, mix))
}

/// Reads the text of a file in UTF-8, or of standard input for `-`.
pub(crate) fn read(path: &str) -> Result<Source, InputError> {
    let (name, bytes) = bytes(path, MAX_BYTES)?;
    decode(&name, &bytes)
}

pub(crate) fn decode(name: &str, bytes: &[u8]) -> Result<Source, InputError> {
    if bytes.starts_with(&[0xff, 0xfe]) || bytes.starts_with(&[0xfe, 0xff]) {
        let error = InputError::usage(format!("{name} is encoded in UTF-16"));
        return Err(error.help("save the file as UTF-8"));
    }
    let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    match std::str::from_utf8(bytes) {
        Ok(text) => Ok(Source::new(name, text)),
        Err(error) => {
            let at = error.valid_up_to();
            let message = format!("{name} is not text: byte {} is not UTF-8", at + 1);
            let source = Source::new(name, &String::from_utf8_lossy(bytes));
            let span = Some(at..at + char::REPLACEMENT_CHARACTER.len_utf8());
            Err(InputError::usage(message).at(&Place { source, span }))
        }
    }
}
