//! Widths of formulas, and line breaks in formulas.

use super::{Node, Row, is_prefix};

/// The approximate width of a row in characters, including spaces.
pub(crate) fn width(row: &[Node]) -> usize {
    let glued = |at: usize| at == 0 || is_prefix(row, at - 1) || row[at].is_separator();
    row.iter().enumerate().map(|(at, node)| usize::from(!glued(at)) + piece(node)).sum()
}

fn piece(node: &Node) -> usize {
    match node {
        Node::Letter(_) | Node::Sign(_) => 1,
        Node::Name(text)
        | Node::Function(text)
        | Node::Number(text)
        | Node::Indices(text)
        | Node::Text(text) => text.chars().count(),
        // adds the gaps around the brackets of a sum and around fraction bars
        Node::Group(_, row) => {
            width(row) + if row.iter().any(Node::is_sign_of_term) { 4 } else { 2 }
        }
        Node::Apply(function, argument) => {
            let gap = usize::from(!matches!(**argument, Node::Group(..)));
            piece(function) + gap + piece(argument)
        }
        Node::Fraction([above, below]) => width(above).max(width(below)) + 2,
        Node::Root(row) => width(row) + 1,
        Node::Accent(_, letter) => piece(letter),
        Node::Scripts(base, scripts) => {
            piece(base) + scripts.iter().map(|(_, row)| width(row)).sum::<usize>()
        }
    }
}

/// The pieces of a row. A line may be broken between them: before relations, before signs between
/// terms, and after commas.
pub(crate) fn pieces(row: &[Node]) -> Vec<&[Node]> {
    let mut cuts: Vec<usize> = (1..row.len())
        .filter(|&at| {
            let sign = row[at].is_sign_of_term() && !is_prefix(row, at);
            row[at].is_relation() || sign || row[at - 1].is_separator()
        })
        .collect();
    cuts.insert(0, 0);
    cuts.push(row.len());
    cuts.windows(2).map(|cut| &row[cut[0]..cut[1]]).collect()
}

/// The number of characters at the beginning of a line in which no line break is allowed.
const SHORT: usize = 10;

/// Breaks the row between its pieces into lines of about `most` characters.
pub(crate) fn lines(row: &[Node], most: usize) -> Vec<&[Node]> {
    let (mut lines, mut start, mut end, mut column): (Vec<&[Node]>, _, _, _) = (vec![], 0, 0, 0);
    for piece in pieces(row) {
        // adds a gap before the piece and a gap after its sign
        let more = width(piece) + 2;
        if column > SHORT && column + more > most {
            lines.push(&row[start..end]);
            (start, column) = (end, 0);
        }
        (end, column) = (end + piece.len(), column + more);
    }
    lines.push(&row[start..]);
    lines
}

/// An equation with several sides, joined by equals signs.
pub(crate) fn chain(sides: impl IntoIterator<Item = Row>) -> Row {
    sides.into_iter().collect::<Vec<_>>().join(&Node::Sign("="))
}
