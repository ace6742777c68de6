//! Notations for tables of structure constants. They are recognized by their content.
//!
//! [`definition`] chooses a [`Notation`] from the text alone. The parser of this notation then
//! reports every error with its location. Each parser is a file in the folder `tables`, and its
//! module documentation describes the grammar.

mod brackets;
mod equations;
mod gap;
mod json;
mod maple;
mod marks;
pub(crate) mod matrices;
mod rows;
mod sage;
mod salamon;

use super::notation::Names;
use super::{Definition, Given, Origin, Pairs, add, check_dimension};
use crate::input::{InputError, Place, Source, shown};
use affinor_tensors::expression::canonical_name;
use affinor_tensors::{Ring, Symbolic};
use std::borrow::Cow;
use std::collections::BTreeMap;

/// The name of the source of a text that is typed into a field.
pub(super) const TYPED: &str = "the input";

/// The name of the notation of brackets.
const BRACKETS: &str = "brackets";

/// A notation in which a space can be written.
struct Notation {
    /// The name of the notation.
    name: &'static str,
    /// A table in the notation; empty for the output of a program.
    example: &'static str,
    /// Whether a text is in this notation. The first characters decide, or a word that occurs only
    /// in this notation.
    recognises: fn(&str) -> bool,
    /// Parses a text in this notation.
    read: fn(&Source) -> Result<Definition, InputError>,
    /// Whether the SPACE of a command line may be a text in this notation.
    inline: bool,
}

/// All notations. A text is parsed by the first notation that recognizes it.
const NOTATIONS: [Notation; 9] = [
    Notation {
        name: "JSON of `affinor table`",
        example: "",
        recognises: json::is_table,
        read: json::definition,
        inline: false,
    },
    Notation {
        name: "GAP",
        example: "",
        recognises: gap::is_table,
        read: gap::definition,
        inline: false,
    },
    Notation {
        name: "Maple",
        example: "",
        recognises: maple::is_table,
        read: maple::definition,
        inline: false,
    },
    Notation {
        name: "Sage",
        example: "",
        recognises: sage::is_table,
        read: sage::definition,
        inline: false,
    },
    Notation {
        name: "matrices",
        example: "[[0, 1], [0, 0]]",
        recognises: matrices::is_table,
        read: matrices::definition,
        inline: true,
    },
    Notation {
        name: "structure equations",
        example: "de3 = -e1^e2",
        recognises: equations::is_table,
        read: equations::definition,
        inline: true,
    },
    Notation {
        name: "Salamon's list of de^i",
        example: "(0,0,12)",
        recognises: salamon::is_table,
        read: salamon::definition,
        inline: true,
    },
    Notation {
        name: BRACKETS,
        example: "[x, y] = z",
        recognises: brackets::is_table,
        read: brackets::definition,
        inline: true,
    },
    Notation {
        name: "CSV rows",
        example: "i,j,k,value",
        recognises: rows::is_table,
        read: rows::definition,
        inline: false,
    },
];

/// The names of the notations that may be typed, each with a table in it.
pub fn notations() -> Vec<(&'static str, &'static str)> {
    let typed = NOTATIONS.iter().filter(|notation| notation.inline);
    typed.map(|notation| (notation.name, notation.example)).collect()
}

/// Reads the algebra from a text in one of the notations; `None` for other texts.
///
/// # Errors
/// Errors of the parser, with their locations.
pub(super) fn definition(source: &Source) -> Option<Result<Definition, InputError>> {
    let notation = notation(source.content())?;
    Some((notation.read)(source))
}

/// The notation that recognizes a text.
fn notation(text: &str) -> Option<&'static Notation> {
    NOTATIONS.iter().find(|notation| (notation.recognises)(text))
}

/// The algebra of a text that is typed into a field, with the name of its notation. A text with
/// brackets and `=` in no notation is read as brackets, whose messages fit best. A list whose
/// bracket is not closed is an error.
///
/// # Errors
/// Those of [`definition`].
pub(super) fn typed(source: &Source) -> Option<Result<(Definition, &'static str), InputError>> {
    let text = source.content();
    let looks_like_brackets = || text.contains('[') && text.contains([',', '=']);
    let (read, name) = match notation(text) {
        Some(notation) => (notation.read, notation.name),
        None if text.trim_start().starts_with(['(', '[']) && fault(source).is_some() => {
            return fault(source).map(Err);
        }
        None if looks_like_brackets() => (brackets::definition as fn(&Source) -> _, BRACKETS),
        None => return None,
    };
    let read: Result<Definition, InputError> = read(source);
    Some(read.map(|definition| (definition, name)))
}

/// The error for a bracket that is not closed, or that separates two names by a semicolon.
fn fault(source: &Source) -> Option<InputError> {
    let text = source.content();
    let refused = |part: &str, message: String, help: &str| {
        Some(InputError::usage(message).at(&source.whole(part)).help(help))
    };
    let closing = |open: char| if open == '(' { ')' } else { ']' };
    let help = |open: char| match open {
        '(' => "write a list such as (0,0,12)",
        _ => "brackets are written [e1,e2] = e3",
    };
    let mut open: Vec<(usize, char)> = vec![];
    for (at, symbol) in text.char_indices() {
        match symbol {
            '(' | '[' => open.push((at, symbol)),
            ')' | ']' => match open.pop() {
                Some((from, '[')) if symbol == ']' => {
                    let inside = &text[from + 1..at];
                    if inside.contains(';') && !inside.contains([',', '[', ' ']) {
                        let message = "a comma separates the two basis vectors of a bracket";
                        return refused(inside, message.into(), help('['));
                    }
                }
                Some((_, first)) if symbol == closing(first) => {}
                Some((from, first)) => {
                    let message = format!("a `{}` is missing before `{symbol}`", closing(first));
                    return refused(&text[from..=at], message, help(first));
                }
                None => {
                    let message = format!("the `{symbol}` closes no bracket");
                    return refused(&text[at..=at], message, help('['));
                }
            },
            _ => {}
        }
    }
    let (from, first) = open.pop()?;
    refused(text[from..].trim_end(), format!("a `{}` is missing", closing(first)), help(first))
}

/// Reads the algebra from a SPACE that is itself a table, as in [`is_inline`]; `None` for other
/// texts.
///
/// # Errors
/// Those of [`definition`].
pub(super) fn inline(source: &Source) -> Option<Result<Definition, InputError>> {
    is_inline(source.content()).then(|| definition(source)).flatten()
}

/// Whether the SPACE of a command line is itself a table, and not a name or a path.
pub(super) fn is_inline(space: &str) -> bool {
    let mut inline = NOTATIONS.iter().filter(|notation| notation.inline);
    space.trim_start().starts_with(['(', '[', '\\', 'd', '{'])
        && inline.any(|notation| (notation.recognises)(space))
}

/// The error for a text in an unknown notation, with a guess at its format.
pub(super) fn unknown(source: &Source) -> InputError {
    const GUESSES: [(&str, &str); 8] = [
        (
            "MutableDenseNDimArray",
            "a program for SymPy: write the table for GAP, Sage or Maple instead",
        ),
        ("\\begin", "LaTeX"),
        ("\\documentclass", "LaTeX"),
        ("%PDF", "PDF"),
        ("<html", "HTML"),
        ("<?xml", "XML"),
        ("Rule[", "Mathematica"),
        ("import ", "a program in Python"),
    ];
    let text = source.content();
    let known = NOTATIONS.iter().map(|notation| format!("{} {}", notation.name, notation.example));
    let mut names: Vec<String> = known.map(|name| name.trim_end().into()).collect();
    names.push("keys in TOML or JSON".into());
    let seems = GUESSES.iter().find(|(sign, _)| text.contains(sign));
    let seems = seems.map_or(String::new(), |(_, what)| format!("; it seems to be {what}"));
    let message = format!("{} is not a definition of a space{seems}", source.name);
    let help = format!("these can be read (docs/formats.md): {}", names.join(", "));
    InputError::usage(message).at(&source.whole(first_line(text))).help(help)
}

/// The first line that is neither blank nor a comment (`#`, `//`), without white space at its ends.
pub(super) fn first_line(text: &str) -> &str {
    let mut lines = text.lines().map(str::trim);
    lines
        .find(|line| !(line.is_empty() || line.starts_with('#') || line.starts_with("//")))
        .unwrap_or("")
}

/// A structure constant of a table, which adds `value e_i` to `[e_j, e_k]`. `place` is the piece of
/// the text for messages.
struct Entry<'t> {
    j: Cow<'t, str>,
    k: Cow<'t, str>,
    i: Cow<'t, str>,
    /// Whether the value is subtracted.
    negative: bool,
    value: &'t str,
    place: &'t str,
}

/// The algebra with the basis `labels` and these structure constants. Several constants for one
/// component are added. `index` returns the index of a basis vector, from 0, or the reason why the
/// text does not mean a basis vector.
fn algebra(
    source: &Source,
    labels: Vec<String>,
    entries: &[Entry],
    index: impl Fn(&str) -> Result<usize, String>,
) -> Result<Definition, InputError> {
    let (none, mut given) = (BTreeMap::new(), Pairs::new());
    for Entry { j, k, i, negative, value, place } in entries {
        let place = source.whole(place);
        let index =
            |at: &str| index(at.trim()).map_err(|reason| InputError::usage(reason).at(&place));
        let at = [index(i)?, index(j)?, index(k)?];
        let value = Names::open(&none, None).scalar(value.trim(), source)?;
        add_constant(&mut given, at, if *negative { -value } else { value }, &place);
    }
    Ok(of_brackets(source, labels, given))
}

/// Adds `value e_i` to `[e_j, e_k]`; the indices count from 0.
fn add_constant(given: &mut Pairs, [i, j, k]: [usize; 3], value: Symbolic, place: &Place) {
    let pair = given
        .entry((j, k))
        .or_insert_with(|| Given { value: BTreeMap::new(), place: place.clone() });
    let sum = pair.value.remove(&i).unwrap_or_else(|| Symbolic::from_i64(0));
    pair.value.insert(i, sum + &value);
}

/// Like [`algebra`], for the basis `e1`, ..., `en` and indices that count from 1.
fn numbered(source: &Source, n: usize, entries: &[Entry]) -> Result<Definition, InputError> {
    let place = source.whole(first_line(source.content()));
    let n = check_dimension(n).map_err(|error| error.or_at(&place))?;
    let labels = (1..=n).map(|at| format!("e{at}")).collect();
    algebra(source, labels, entries, |at| number(at, n))
}

/// Converts a number from 1 to `n` to an index that counts from 0.
fn number(at: &str, n: usize) -> Result<usize, String> {
    let number = at.parse().ok().filter(|at| (1..=n).contains(at));
    number.map(|at| at - 1).ok_or_else(|| format!("the index {} is not in 1..{n}", shown(at)))
}

/// The algebra with these brackets. It is named after the file.
fn of_brackets(source: &Source, labels: Vec<String>, given: Pairs) -> Definition {
    let name = match source.name.as_str() {
        "SPACE" | TYPED => "inline algebra",
        path => path.rsplit('/').next().unwrap_or_default(),
    };
    let mut definition = Definition::new(name, labels, Origin::Brackets(given));
    definition.source = Some(source.clone());
    definition
}

fn refuse<T>(source: &Source, part: &str, message: impl Into<String>) -> Result<T, InputError> {
    Err(InputError::usage(message).at(&source.whole(part)))
}

/// Converts the names of basis vectors to their canonical form.
fn basis_vectors(names: &[&str]) -> Vec<String> {
    names.iter().map(|name| canonical_name(name).into_owned()).collect()
}

/// Splits a text at commas outside brackets and quotes. The pieces have no white space at their
/// ends and no comments before them.
fn items(inside: &str) -> Vec<&str> {
    split_at_top(inside, &[',']).into_iter().map(uncommented).collect()
}

/// Splits a text at `separators` outside brackets and quotes. A blank last piece is dropped.
fn split_at_top<'t>(inside: &'t str, separators: &[char]) -> Vec<&'t str> {
    let (mut depth, mut from, mut pieces, mut quote) = (0i64, 0, vec![], None);
    for (at, symbol) in inside.char_indices() {
        match symbol {
            '\'' | '"' if quote.is_none() => quote = Some(symbol),
            _ if quote.is_some() => quote = quote.filter(|open| *open != symbol),
            '(' | '[' | '{' => depth += 1,
            ')' | ']' | '}' => depth -= 1,
            _ if separators.contains(&symbol) && depth == 0 => {
                pieces.push(&inside[from..at]);
                from = at + symbol.len_utf8();
            }
            _ => {}
        }
    }
    if !inside[from..].trim().is_empty() {
        pieces.push(&inside[from..]);
    }
    pieces
}

/// The text inside the bracket with which `text` begins, up to its closing bracket.
fn enclosed(text: &str) -> Option<&str> {
    let (mut depth, mut quote) = (0i64, None);
    for (at, symbol) in text.char_indices() {
        match symbol {
            '\'' | '"' if quote.is_none() => quote = Some(symbol),
            _ if quote.is_some() => quote = quote.filter(|open| *open != symbol),
            '(' | '[' | '{' => depth += 1,
            ')' | ']' | '}' => depth -= 1,
            _ => {}
        }
        if depth == 0 {
            return (at > 0).then(|| &text[1..at]);
        }
    }
    None
}

/// The items of a list in brackets, if the list is the whole text.
fn list(text: &str) -> Option<Vec<&str>> {
    let text = text.trim();
    let inside = text.starts_with(['[', '(']).then(|| enclosed(text)).flatten()?;
    (inside.len() + 2 == text.len()).then(|| items(inside))
}

/// Removes the quotes around a text.
fn unquoted(text: &str) -> &str {
    text.trim().trim_matches(['\'', '"']).trim()
}

/// Removes comments before a piece, and white space at its ends.
fn uncommented(piece: &str) -> &str {
    let mut piece = piece.trim();
    while piece.starts_with('#') {
        piece = piece.split_once('\n').map_or("", |(_, rest)| rest).trim();
    }
    piece
}

/// Returns an error for a table over a finite field, which programs write as `GF(2)`, `Z(3)` or
/// `Zmod(5)`.
fn expect_characteristic_0(source: &Source) -> Result<(), InputError> {
    const FIELDS: [&str; 8] =
        ["GF", "GaloisField", "FiniteField", "Z", "Zmod", "ZmodnZ", "IntegerModRing", "Integers"];
    for line in source.content().lines() {
        let code = line.split('#').next().unwrap_or_default();
        for (at, _) in code.match_indices('(') {
            let name = code[..at].trim_end();
            let is_name = |c: char| c.is_alphanumeric() || c == '_';
            let from = name.trim_end_matches(is_name).len();
            if FIELDS.contains(&&name[from..]) {
                let end = code[at..].find(')').map_or(code.len(), |end| at + end + 1);
                let field = &code[from..end];
                let message = format!("the table is over the finite field {}", shown(field));
                return Err(InputError::usage(message)
                    .at(&source.whole(field))
                    .help("affinor computes over the rational numbers and their extensions only"));
            }
        }
    }
    Ok(())
}
