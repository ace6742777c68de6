//! Sentences that contain formulas in plain text, such as `Ric = c g fails at i = 1`.
//!
//! A run of words that the notation of formulas accepts, with at least one mark of mathematics, is a
//! formula; other words are text. Words are recognized by their letters: `Lambda` and `mu1` are
//! mathematics, `dimension` and `Levi-Civita` are not.

use super::{Node, Row, is_function, letter, mathml, notation, tex};
use affinor_tensors::expression::is_name;

/// A piece of a sentence: its text, and its formula if it is one.
type Piece<'t> = (&'t str, Option<Row>);

/// The sentence in HTML.
pub(crate) fn html(text: &str) -> String {
    let write = |piece: &Piece| match piece {
        (words, None) => mathml::escaped(words),
        (_, Some(row)) => mathml::inline(row),
    };
    pieces(text).iter().map(write).collect()
}

/// The sentence in LaTeX.
pub(crate) fn latex(text: &str) -> String {
    let write = |piece: &Piece| match piece {
        (words, None) => tex::escaped(words),
        (_, Some(row)) => format!("${}$", tex::breakable(row)),
    };
    pieces(text).iter().map(write).collect()
}

/// Words of two or more letters that are names of quantities.
const QUANTITIES: [&str; 8] = ["Ric", "symRic", "altRic", "tfRic", "Kr", "dt", "dw", "du"];
/// Letters that are words on their own.
const ARTICLES: [&str; 2] = ["a", "A"];

/// The formulas and the words between them.
fn pieces(text: &str) -> Vec<Piece<'_>> {
    let mut pieces = vec![];
    // the beginnings of the words that are not yet in a piece, and of the present run of formulas
    let (mut done, mut run) = (0, None);
    let mut at = 0;
    for token in text.split_inclusive(' ') {
        let word = token.trim_end();
        if !is_word(word) && run.is_none() {
            run = Some(at);
        }
        let end = at + word.len();
        let ends = is_word(word) || word.ends_with([';', ':']);
        if let Some(from) = run.filter(|_| ends) {
            let to = if is_word(word) { at } else { end };
            add(text, &mut done, from, to, &mut pieces);
            run = None;
        }
        at += token.len();
    }
    if let Some(from) = run {
        add(text, &mut done, from, text.len(), &mut pieces);
    }
    if done < text.len() {
        pieces.push((&text[done..], None));
    }
    pieces
}

/// Adds the run between two positions as a formula, if it is one, with the words before it.
fn add<'t>(text: &'t str, done: &mut usize, from: usize, to: usize, pieces: &mut Vec<Piece<'t>>) {
    let run = text[from..to].trim_end().trim_end_matches([',', ';', ':', '.', ' ']);
    let start = from + (run.len() - run.trim_start_matches(['"']).len());
    let run = run.trim_start_matches(['"']);
    if let Some(row) = formula(run) {
        if *done < start {
            pieces.push((&text[*done..start], None));
        }
        pieces.push((run, Some(row)));
        *done = start + run.len();
    }
}

/// The formula of a run, which contains a mark of mathematics.
fn formula(run: &str) -> Option<Row> {
    let marks = |c: char| "=^_*<>{".contains(c);
    let named = run.split([' ', ',', '(', ')', '[', ']']).any(|word| {
        let name = word.trim_matches(['-', '+', '\'']);
        is_name(name) && (!ARTICLES.contains(&name) || run.contains(marks))
    });
    let operators = run.contains(marks) || named;
    let alone = run.chars().all(|c| "=+-*/,.:;<>() ".contains(c));
    if !operators || alone {
        return None;
    }
    // the notation reads a star as a product, but that of a dual vector, `e2* + e7*`, is a mark
    if run.ends_with('*') || run.contains("* ") || run.contains("*,") {
        return None;
    }
    let row = notation(&run.replace("nabla[", "nabla [")).ok()?;
    // words in a formula mean that it is text
    (!row.iter().any(|node| matches!(node, Node::Text(_)))).then_some(row)
}

/// Whether a word of a sentence is not mathematics.
fn is_word(word: &str) -> bool {
    let bare = word.trim_matches([',', ';', ':', '.', '(', ')', '"']);
    let letters = bare.split(['-', '\'']).all(|part| {
        part.is_empty() || part.chars().count() > 1 && part.chars().all(char::is_alphabetic)
    });
    let name = bare.split('-').next().unwrap_or_default();
    let mathematical = bare.split('-').count() == 1
        && (letter(name).is_some() && name.len() > 1 || QUANTITIES.contains(&name))
        || is_function(name) && !["max", "min", "re", "im", "arg"].contains(&name);
    letters && !mathematical && bare.contains(char::is_alphabetic)
}

#[cfg(test)]
mod tests {
    use super::pieces;

    fn formulas(text: &str) -> Vec<&str> {
        let pieces = pieces(text);
        let written: String = pieces.iter().map(|(text, _)| *text).collect();
        assert_eq!(written, text);
        let found = pieces.iter().filter(|(_, formula)| formula.is_some());
        found.map(|(text, _)| *text).collect()
    }

    #[test]
    fn formulas_are_found_between_words() {
        for (text, expected) in [
            ("R^i_jkl = 1/4 at i = 1, j = 2", &["R^i_jkl = 1/4", "i = 1, j = 2"][..]),
            ("dimension 3: p1, p2, p3", &["p1, p2, p3"]),
            ("dimension 3: a radical", &[]),
            ("mu1*mu4 + mu2*mu5, mu4^2", &["mu1*mu4 + mu2*mu5, mu4^2"]),
            ("orthogonal to [L, L] for the Killing form", &["[L, L]"]),
            ("mu9^2 - mu10^2", &["mu9^2 - mu10^2"]),
            ("Levi-Civita, in dimension n >= 3", &["n >= 3"]),
            ("1, 0, 0, 2, 0, 0, 1", &[]),
            ("rank 3, signature (0, 3, 3), determinant 0", &[]),
            ("Einstein (Ric = c g)", &["(Ric = c g)"]),
            ("constant curvature K", &["K"]),
            ("-", &[]),
            ("e2* + e7*, e8*", &[]),
            ("for matrices AB - BA", &[]),
        ] {
            assert_eq!(formulas(text), expected, "{text}");
        }
    }
}
