//! Writes formulas as MathML, which browsers render without scripts.

use super::lines::lines;
use super::{Accent, Brackets, Node, is_prefix, text};
use std::fmt::Write;

/// The largest number of characters of a formula within a line of text.
const INLINE: usize = 44;
/// The largest number of characters in a displayed line.
pub const WIDE: usize = 64;
/// The largest number of characters in a line of a table cell.
pub(crate) const NARROW: usize = 26;

/// A formula within a line of text: one `math` element for each piece between possible line breaks.
pub fn inline(formula: &[Node]) -> String {
    math(formula, INLINE, "").join("<wbr/>")
}

/// A formula after a label. It is broken like a formula within text, but in display style.
pub fn alone(formula: &[Node]) -> String {
    math(formula, INLINE, " displaystyle=\"true\"").join("<wbr/>")
}

/// A displayed formula: one `math` element in display style for each line.
pub fn block(formula: &[Node], most: usize) -> String {
    math(formula, most, " display=\"block\"").concat()
}

/// One `math` element for each line.
fn math(formula: &[Node], most: usize, attributes: &str) -> Vec<String> {
    let gap = if attributes.contains("block") { "<mspace width=\"1em\"/>" } else { "" };
    let element = |(number, line): (usize, &[Node])| {
        let (mut alternative, mut content) = (text(line), String::new());
        for (at, node) in line.iter().enumerate() {
            match node {
                // at the beginning of a new line, a sign is an operator between terms
                Node::Sign(sign) if at == 0 && number > 0 && node.is_sign_of_term() => {
                    content = format!("<mo form=\"infix\">{sign}</mo>");
                    alternative = format!("{} {}", text(&line[..1]), text(&line[1..]));
                }
                _ => content += &piece_of_row(line, at),
            }
            content += if node.is_separator() && at + 1 < line.len() { gap } else { "" };
        }
        if line.len() != 1 {
            content = format!("<mrow>{content}</mrow>");
        }
        format!("<math{attributes} alttext=\"{}\">{content}</math>", escaped(&alternative))
    };
    lines(formula, most).into_iter().enumerate().map(element).collect()
}

/// A sequence of elements, wrapped in `mrow` unless there is only one.
pub(crate) fn row(nodes: &[Node]) -> String {
    match nodes {
        [node] => piece(node),
        _ => format!("<mrow>{}</mrow>", pieces(nodes)),
    }
}

fn pieces(nodes: &[Node]) -> String {
    (0..nodes.len()).map(|at| piece_of_row(nodes, at)).collect()
}

/// The element of a node. It has a gap between a word and its neighbour, and a sign has an explicit
/// form.
fn piece_of_row(nodes: &[Node], at: usize) -> String {
    let node = &nodes[at];
    if node.is_sign_of_term()
        && let Node::Sign(sign) = node
    {
        // sets the form, because a browser would derive it from the position within an `mrow`
        let form = if is_prefix(nodes, at) { "prefix" } else { "infix" };
        return format!("<mo form=\"{form}\">{sign}</mo>");
    }
    let signs = |pair: &[Node]| pair.iter().any(|node| matches!(node, Node::Sign(_)));
    let gap = match at.checked_sub(1).map(|before| &nodes[before..=at]) {
        Some(pair) => !signs(pair) && pair.iter().any(is_word),
        None => false,
    };
    let gap = if gap { "<mspace width=\"0.17em\"/>" } else { "" };
    gap.to_string() + &piece(node)
}

/// Whether the node is a word, or begins with a word.
fn is_word(node: &Node) -> bool {
    match node {
        Node::Name(_) | Node::Function(_) => true,
        Node::Apply(base, _) | Node::Scripts(base, _) => is_word(base),
        _ => false,
    }
}

fn piece(node: &Node) -> String {
    match node {
        Node::Letter(letter @ ('∇' | '∂')) => format!("<mo>{letter}</mo>"),
        Node::Letter(letter) => format!("<mi>{letter}</mi>"),
        Node::Name(name) | Node::Function(name) => format!("<mi>{name}</mi>"),
        Node::Number(number) => format!("<mn>{number}</mn>"),
        Node::Indices(indices) => {
            let index = |c: char| match c.is_ascii_digit() {
                true => format!("<mn>{c}</mn>"),
                false => format!("<mi>{c}</mi>"),
            };
            format!("<mrow>{}</mrow>", indices.chars().map(index).collect::<String>())
        }
        Node::Sign(sign @ ("," | ";")) => format!("<mo separator=\"true\">{sign}</mo>"),
        Node::Sign(sign @ "∗") => format!("<mo lspace=\"0\" rspace=\"0\">{sign}</mo>"),
        Node::Sign(sign) => format!("<mo>{sign}</mo>"),
        Node::Text(words) => format!("<mtext>{}</mtext>", escaped(words)),
        Node::Group(brackets, row) => {
            let [open, close] = match brackets {
                Brackets::Angle => ["⟨", "⟩"],
                brackets => brackets.text(),
            };
            let stretchy = row.iter().any(Node::is_tall);
            let [open, close] =
                [open, close].map(|sign| format!("<mo stretchy=\"{stretchy}\">{sign}</mo>"));
            format!("<mrow>{open}{}{close}</mrow>", pieces(row))
        }
        Node::Apply(function, argument) => {
            let gap = match (&**function, &**argument) {
                (Node::Letter(_), _) | (_, Node::Group(..)) => "",
                _ => "<mspace width=\"0.17em\"/>",
            };
            let [function, argument] = [function, argument].map(|node| piece(node));
            format!("<mrow>{function}<mo>&#x2061;</mo>{gap}{argument}</mrow>")
        }
        Node::Root(inner) => format!("<msqrt>{}</msqrt>", pieces(inner)),
        Node::Fraction([above, below]) => format!("<mfrac>{}{}</mfrac>", row(above), row(below)),
        Node::Accent(accent, letter) => {
            let sign = match accent {
                Accent::Tilde => '~',
                Accent::Dot => '˙',
                Accent::Bar => '¯',
                Accent::Hat => '^',
            };
            format!("<mover accent=\"true\">{}<mo>{sign}</mo></mover>", piece(letter))
        }
        Node::Scripts(base, scripts) => self::scripts(base, scripts),
    }
}

fn scripts(base: &Node, scripts: &[(bool, Vec<Node>)]) -> String {
    match (base, scripts) {
        // writes a power above the index of its base
        (Node::Scripts(inner, indices), [(true, power)])
            if matches!(&indices[..], [(false, _)]) =>
        {
            format!("<msubsup>{}{}{}</msubsup>", piece(inner), row(&indices[0].1), row(power))
        }
        (base, [(true, power)]) => format!("<msup>{}{}</msup>", piece(base), row(power)),
        (base, [(false, index)]) => format!("<msub>{}{}</msub>", piece(base), row(index)),
        (base, several) => {
            let mut text = format!("<mmultiscripts>{}", piece(base));
            for (above, script) in several {
                let script = row(script);
                let empty = "<mrow></mrow>".to_string();
                let [below, above] = if *above { [empty, script] } else { [script, empty] };
                // ignores the result: writing to a string cannot fail
                let _ = write!(text, "{below}{above}");
            }
            text + "</mmultiscripts>"
        }
    }
}

/// Escapes text for an element or an attribute.
pub fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}
