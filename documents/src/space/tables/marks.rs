//! Marks of other systems in tables of brackets: LaTeX, and products without a sign.
//!
//! [`plain`] rewrites `\left[e_{1}, e_2\right] = 2 a e_3` as `[e_1, e_2] = 2*a*e_3`. Each byte of
//! the result has a position in the original text, so that messages point to the original.

use crate::input::Source;

/// Commands of LaTeX and their meaning; other commands lose their backslash, as in `\alpha`.
const COMMANDS: [(&str, &str); 16] = [
    ("\\left", ""),
    ("\\right", ""),
    ("\\cdot", "*"),
    ("\\wedge", "∧"),
    ("\\quad", " "),
    ("\\qquad", " "),
    ("\\lbrack", "["),
    ("\\rbrack", "]"),
    ("\\mathbf", ""),
    ("\\mathrm", ""),
    ("\\,", " "),
    ("\\;", " "),
    ("\\!", ""),
    ("\\ ", " "),
    ("\\\\", "\n"),
    ("\\", ""),
];

/// A text with the position of each byte in the text that it was made from.
struct Rewritten {
    text: String,
    places: Vec<usize>,
}

impl Rewritten {
    fn push(&mut self, part: &str, from: usize) {
        self.text.push_str(part);
        self.places.extend((0..part.len()).map(|_| from));
    }
}

/// The source without marks of LaTeX, and with a sign in each product. Other texts are unchanged.
pub(super) fn plain(source: &Source) -> Source {
    let original = source.content();
    let first = without_latex(original);
    let second = with_products(&first);
    if second.text == original {
        return source.clone();
    }
    source.rewritten(second.text, second.places, original.len())
}

/// Replaces commands, and drops dollar signs, alignment marks and the braces of indices.
fn without_latex(text: &str) -> Rewritten {
    let mut out = Rewritten { text: String::new(), places: vec![] };
    let (mut at, mut braces) = (0, 0);
    while let Some(symbol) = text[at..].chars().next() {
        let rest = &text[at..];
        let after = |text: &str| out.text.ends_with(text);
        let (part, length) = match symbol {
            '\\' => {
                let command = COMMANDS.iter().find(|(command, _)| {
                    let word = command.ends_with(|c: char| c.is_ascii_alphabetic());
                    let behind = rest.strip_prefix(command);
                    let ends = |rest: &str| !rest.starts_with(|c: char| c.is_ascii_alphabetic());
                    behind.is_some_and(|behind| !word || ends(behind))
                });
                command.map_or(("", 1), |(command, meaning)| (*meaning, command.len()))
            }
            '{' if after("_") || after("^") || braces > 0 => {
                braces += 1;
                ("", 1)
            }
            '}' if braces > 0 => {
                braces -= 1;
                ("", 1)
            }
            '$' | '&' => ("", 1),
            _ => (&rest[..symbol.len_utf8()], symbol.len_utf8()),
        };
        out.push(part, at);
        at += length;
    }
    out
}

/// Inserts `*` between a factor and a name, and a line end before a bracket that follows a sum.
fn with_products(text: &Rewritten) -> Rewritten {
    let mut out = Rewritten { text: String::new(), places: vec![] };
    let (mut depth, mut right) = (0i64, false);
    let is_name = |c: char| c.is_alphanumeric() || c == '_' || c == '\'';
    // a line may end with a comment
    let mut comment = false;
    for (at, symbol) in text.text.char_indices() {
        let (from, rest) = (text.places[at], &text.text[at..]);
        let before = out.text.trim_end_matches([' ', '\t']).chars().next_back();
        let glued = out.text.chars().next_back() == before;
        comment = symbol == '#' || comment && symbol != '\n';
        match symbol {
            _ if comment => {}
            '\n' | ';' | ',' if depth == 0 => right = false,
            '=' => right = true,
            '[' if right && depth == 0 && before.is_some_and(|c| is_name(c) || c == ')') => {
                let joined = out.text.trim_end_matches([' ', '\t']);
                if let Some(kept) = joined.strip_suffix("and").filter(|kept| kept.ends_with(' ')) {
                    let length = kept.len();
                    out.text.truncate(length);
                    out.places.truncate(length);
                }
                out.push("\n", from);
                right = false;
            }
            _ if right && (is_name(symbol) || symbol == '(') => {
                let number = before.is_some_and(|c| c.is_ascii_digit()) && in_number(&out.text);
                let exponent = number && is_exponent(rest);
                let joins = match before {
                    Some(')') => true,
                    Some(c) if glued => number && is_name(c) && symbol.is_alphabetic() && !exponent,
                    Some(c) => is_name(c) && !(number && symbol == '(') && !is_word(rest),
                    None => false,
                };
                if joins {
                    let length = out.text.trim_end_matches([' ', '\t']).len();
                    out.text.truncate(length);
                    out.places.truncate(length);
                    out.push("*", from);
                }
            }
            _ => {}
        }
        depth += i64::from("([".contains(symbol)) - i64::from(")]".contains(symbol));
        let length = symbol.len_utf8();
        out.push(&rest[..length], from);
    }
    out
}

/// Whether a text ends with the digits of a number, and not of a name.
fn in_number(text: &str) -> bool {
    let text = text.trim_end();
    let start = text.trim_end_matches(|c: char| c.is_ascii_digit() || c == '.');
    let name = start.ends_with(|c: char| c.is_alphanumeric() || c == '_' || c == '\'');
    start.len() < text.len() && !name
}

/// Whether a text begins with the exponent of a number, as in `1e-3`.
fn is_exponent(text: &str) -> bool {
    let behind = text.strip_prefix(['e', 'E']).map(|rest| rest.trim_start_matches(['+', '-']));
    behind.is_some_and(|behind| behind.starts_with(|c: char| c.is_ascii_digit()))
}

/// Whether a text begins with the word that joins two brackets.
fn is_word(text: &str) -> bool {
    text.strip_prefix("and").is_some_and(|rest| rest.trim_start().starts_with(['[', '\\']))
}
