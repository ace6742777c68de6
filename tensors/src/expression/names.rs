//! Names in expressions: letters of any script, digits and `_`.

use std::borrow::Cow;

/// Whether the text is a valid name: a letter of any script or `_`, then letters, ASCII digits, subscript digits and `_`.
///
/// A name is in its [`canonical_name`] form, so that equal names are equal texts, and does not look
/// like a Latin one.
///
/// ```
/// use affinor_tensors::expression::is_name;
/// assert!(is_name("x_1") && is_name("Θ") && is_name("ω₁"));
/// assert!(!is_name("1x") && !is_name("x²") && !is_name("x-y"));
/// ```
pub fn is_name(name: &str) -> bool {
    let begins = name.starts_with(|c| is_name_character(c) && !is_digit(c));
    begins && name.chars().all(is_name_character) && !looks_latin(name)
}

/// Whether a name may contain the character after its first one.
///
/// ```
/// use affinor_tensors::expression::is_name_character;
/// assert!(['x', '_', '7', 'é', 'θ'].into_iter().all(is_name_character));
/// assert!(!is_name_character('²') && !is_name_character('·'));
/// ```
pub fn is_name_character(c: char) -> bool {
    // excludes the superscripts ⁱ and ⁿ, which Unicode counts as letters: they are powers, not parts of a name
    let power = ('\u{2070}'..='\u{207f}').contains(&c);
    let letter = c.is_alphabetic() && !power && canonical(c) == c;
    letter || c == '_' || is_digit(c)
}

fn is_digit(c: char) -> bool {
    c.is_ascii_digit() || ('\u{2080}'..='\u{2089}').contains(&c)
}

/// Whether the parser reads a name that begins with this character, perhaps in a form that is not canonical.
pub(super) fn begins_name(c: char) -> bool {
    continues_name(c) && !is_digit(c)
}

/// Whether the parser accepts this character inside a name, perhaps in a form that is not
/// canonical.
pub(super) fn continues_name(c: char) -> bool {
    is_name_character(canonical(c))
}

/// The canonical form of a name: unit signs become the Greek letters, and the signs of kelvin and
/// angstrom the Latin letters, that look like them.
///
/// ```
/// use affinor_tensors::expression::canonical_name;
/// assert_eq!(canonical_name("\u{2126}_1"), "Ω_1");
/// assert_eq!(canonical_name("\u{b5}"), "\u{3bc}");
/// ```
pub fn canonical_name(name: &str) -> Cow<'_, str> {
    match name.chars().all(|c| canonical(c) == c) {
        true => name.into(),
        false => name.chars().map(canonical).collect(),
    }
}

fn canonical(c: char) -> char {
    match c {
        '\u{b5}' => '\u{3bc}',
        '\u{2126}' => '\u{3a9}',
        '\u{212a}' => 'K',
        '\u{212b}' => '\u{c5}',
        _ => c,
    }
}

/// Cyrillic and Greek letters that look like Latin ones.
const LOOKALIKES: &str = "асԁеһіјорѕухАВСЕНІЈКМОРЅТХΑΒΕΖΗΙΚΜΝΟΡΤΥΧο";

/// Whether all non-ASCII letters of a text look like Latin ones, so that it can be mistaken for
/// another text.
///
/// ```
/// use affinor_tensors::expression::looks_latin;
/// // Cyrillic `x`, and a Russian word that contains it
/// assert!(looks_latin("\u{445}_1") && !looks_latin("вдох"));
/// assert!(!looks_latin("x") && !looks_latin("Θ"));
/// ```
pub fn looks_latin(text: &str) -> bool {
    let mut others = text.chars().filter(|c| !c.is_ascii()).peekable();
    others.peek().is_some() && others.all(|c| LOOKALIKES.contains(c))
}

/// Whether a message can show the character itself: control characters and white space other than `
/// ` are excluded.
///
/// ```
/// use affinor_tensors::expression::is_printable;
/// assert!(is_printable('x') && is_printable(' ') && is_printable('Θ'));
/// // no-break space, escape, right-to-left override
/// assert!(!['\u{a0}', '\u{1b}', '\u{202e}'].into_iter().any(is_printable));
/// ```
pub fn is_printable(c: char) -> bool {
    c.is_ascii_graphic() || c == ' ' || (!c.is_ascii() && c.escape_debug().count() == 1)
}

/// A character as messages show it: itself, or its code point.
pub(super) fn shown(c: char) -> String {
    match is_printable(c) && !looks_latin(&c.to_string()) {
        true => format!("`{c}`"),
        false => format!("the character {}", c.escape_unicode()),
    }
}
