//! Writes formulas as text, in the notation of the parser.

use super::{ACCENTS, Brackets, DIFFERENTIALS, LETTERS, Node, SIGNS, is_prefix};

/// Writes the row as text.
pub(crate) fn text(row: &[Node]) -> String {
    let mut text = String::new();
    for (at, node) in row.iter().enumerate() {
        let glued = at == 0
            || is_prefix(row, at - 1)
            || node.is_separator()
            || matches!(node, Node::Sign("∗"));
        text += if glued { "" } else { " " };
        text += &piece(node);
    }
    text
}

fn piece(node: &Node) -> String {
    match node {
        Node::Letter(letter) => {
            let known = LETTERS.iter().find(|(_, known, _)| known == letter);
            known.map_or_else(|| letter.to_string(), |(name, ..)| name.to_string())
        }
        Node::Name(text) | Node::Function(text) | Node::Number(text) | Node::Indices(text) => {
            text.clone()
        }
        Node::Sign(sign) => {
            let known = SIGNS.iter().find(|(_, known)| known == sign);
            known.map_or(*sign, |(text, _)| *text).into()
        }
        Node::Text(words) => format!("\"{words}\""),
        Node::Group(kind, row) => kind.text().join(&text(row)),
        Node::Apply(function, argument) => {
            let glued = match &**function {
                Node::Letter(d) if DIFFERENTIALS.contains(d) => is_symbol(argument),
                _ => false,
            } || matches!(**argument, Node::Group(Brackets::Round, _));
            let gap = if glued { "" } else { " " };
            format!("{}{gap}{}", piece(function), piece(argument))
        }
        Node::Fraction(parts) => parts.each_ref().map(|part| factor(part)).join("/"),
        Node::Root(row) => format!("sqrt({})", text(row)),
        Node::Accent(accent, letter) => {
            let ending = ACCENTS.iter().find(|(_, known)| known == accent);
            piece(letter) + ending.map_or("", |(ending, _)| ending)
        }
        Node::Scripts(base, scripts) => {
            let start = match &**base {
                // puts a base with scripts in braces; in `J11^2` the index is below the power
                inner @ Node::Scripts(..) if numbered(inner).is_none() => {
                    format!("{{{}}}", piece(inner))
                }
                base => piece(base),
            };
            if let Some(numbered) = numbered(node) {
                return numbered;
            }
            scripts.iter().fold(start, |text, (above, row)| text + &script(*above, row))
        }
    }
}

/// Whether the node is a letter or a name, which may have an accent and indices.
fn is_symbol(node: &Node) -> bool {
    match node {
        Node::Scripts(base, _) => is_symbol(base),
        node => matches!(node, Node::Letter(_) | Node::Accent(..)),
    }
}

/// The text, such as `J11`, of a letter or a name whose only index is a number; `None` for other
/// nodes.
fn numbered(node: &Node) -> Option<String> {
    let Node::Scripts(base, scripts) = node else { return None };
    match (&**base, scripts.as_slice()) {
        (Node::Letter(_) | Node::Name(_) | Node::Accent(..), [(false, row)]) => match &row[..] {
            [Node::Number(number)] => Some(piece(base) + number),
            _ => None,
        },
        _ => None,
    }
}

/// Writes a numerator or denominator, in brackets unless it is a single factor.
fn factor(row: &[Node]) -> String {
    match row {
        [Node::Sign(_) | Node::Group(..) | Node::Fraction(_)] => format!("({})", text(row)),
        [node] => piece(node),
        row => format!("({})", text(row)),
    }
}

fn script(above: bool, row: &[Node]) -> String {
    let mark = if above { '^' } else { '_' };
    match row {
        [Node::Sign("′")] => "'".into(),
        [Node::Sign("∗")] => format!("{mark}*"),
        [Node::Sign("−"), Node::Number(n)] => format!("{mark}-{n}"),
        [Node::Letter(c)] if c.is_ascii_alphabetic() => format!("{mark}{c}"),
        [Node::Number(n)] if n.len() == 1 => format!("{mark}{n}"),
        [Node::Indices(indices)] => format!("{mark}{indices}"),
        [Node::Group(Brackets::Round, inner)] => format!("{mark}({})", text(inner)),
        row => format!("{mark}{{{}}}", text(row)),
    }
}
