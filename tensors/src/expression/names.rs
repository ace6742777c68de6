//! Names in expressions. They consist of letters of any script, digits and `_`.

use std::borrow::Cow;

/// Whether the text is a valid name. A name begins with a letter of any script or `_`, followed by
/// letters, ASCII digits, subscript digits and `_`.
///
/// A name must be in its [`canonical_name`] form, so that equal names have equal texts. It must not
/// look like a Latin name unless it is one.
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

/// Whether a name may contain this character after its first character.
///
/// ```
/// use affinor_tensors::expression::is_name_character;
/// assert!(['x', '_', '7', 'é', 'θ'].into_iter().all(is_name_character));
/// assert!(!is_name_character('²') && !is_name_character('·'));
/// ```
pub fn is_name_character(c: char) -> bool {
    // excludes the superscripts ⁱ and ⁿ, which Unicode counts as letters: they are powers, not
    // parts of a name
    let power = ('\u{2070}'..='\u{207f}').contains(&c);
    let letter = c.is_alphabetic() && !power && canonical(c) == c;
    letter || c == '_' || is_digit(c)
}

fn is_digit(c: char) -> bool {
    c.is_ascii_digit() || ('\u{2080}'..='\u{2089}').contains(&c)
}

/// Whether the parser accepts this character at the beginning of a name. The name may be in a form
/// that is not canonical.
pub(super) fn begins_name(c: char) -> bool {
    continues_name(c) && !is_digit(c)
}

/// Whether the parser accepts this character inside a name. The name may be in a form that is not
/// canonical.
pub(super) fn continues_name(c: char) -> bool {
    is_name_character(canonical(c))
}

/// The canonical form of a name. Unit signs are replaced by the Greek letters that look like them;
/// the signs of kelvin and angstrom are replaced by Latin letters.
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

/// Cyrillic and Greek letters that look like Latin letters.
const LOOKALIKES: &str = "асԁеһіјорѕухАВСЕНІЈКМОРЅТХΑΒΕΖΗΙΚΜΝΟΡΤΥΧο";

/// Whether all non-ASCII letters of a text look like Latin letters, so that the text can be
/// mistaken for another text.
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

/// Whether a message can show the character itself. Control characters are excluded, and so is
/// white space except ` `.
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

/// The form of a character in messages: the character itself, or its code point.
pub(super) fn shown(c: char) -> String {
    match is_printable(c) && !looks_latin(&c.to_string()) {
        true => format!("`{c}`"),
        false => format!("the character {}", c.escape_unicode()),
    }
}
