//! Names in expressions.

/// Whether the text is a valid name: an ASCII letter or `_`, then letters, digits and `_`.
pub fn is_name(name: &str) -> bool {
    name.starts_with(begins_name) && name.chars().all(continues_name)
}

pub(super) fn begins_name(c: char) -> bool {
    c.is_ascii_alphabetic() || c == '_'
}

pub(super) fn continues_name(c: char) -> bool {
    c.is_ascii_alphanumeric() || c == '_'
}

/// A character for a message: itself if it is printable, else its number.
pub(super) fn shown(c: char) -> String {
    if c.is_ascii_graphic() {
        format!("`{c}`")
    } else {
        format!("the character {}", c.escape_unicode())
    }
}
