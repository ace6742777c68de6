//! Alternative signs: typographic signs, which occur in pasted text, and `**`.

/// The typographic minus sign.
pub(super) const MINUS: char = '\u{2212}';

/// The ASCII character of the grammar that corresponds to a typographic character.
pub(super) fn plain(c: char) -> char {
    match c {
        MINUS => '-',
        '\u{b7}' | '\u{d7}' | '\u{22c5}' | '\u{2219}' => '*',
        _ => c,
    }
}

/// The length of `^` or `**` at the beginning of a text. Returns zero if there is neither.
pub(super) fn caret(text: &str) -> usize {
    match text.as_bytes() {
        [b'^', ..] => 1,
        [b'*', b'*', ..] => 2,
        _ => 0,
    }
}

/// Reads an integer in superscript digits, such as `⁻²`, at the beginning of a text. Returns the
/// integer, and the length of the digits.
pub(super) fn superscript(text: &str) -> Option<(String, usize)> {
    let mut value = String::new();
    let mut width = 0;
    for c in text.chars() {
        value.push(match c {
            '\u{207b}' | '\u{207a}' if value.is_empty() => {
                if c == '\u{207b}' {
                    '-'
                } else {
                    '+'
                }
            }
            _ => match superscript_digit(c) {
                Some(digit) => digit,
                None => break,
            },
        });
        width += c.len_utf8();
    }
    value.ends_with(|c: char| c.is_ascii_digit()).then_some((value, width))
}

/// The digit that corresponds to a superscript digit.
fn superscript_digit(c: char) -> Option<char> {
    let value = match c {
        '\u{b9}' => 1,
        '\u{b2}' => 2,
        '\u{b3}' => 3,
        '\u{2070}' | '\u{2074}'..='\u{2079}' => u32::from(c) - 0x2070,
        _ => return None,
    };
    char::from_digit(value, 10)
}
