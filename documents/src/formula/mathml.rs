//! Formulas as MathML, which browsers draw without a script.

use super::{Accent, Node, parse, parse_value};
use std::fmt::Write;

/// Formulas with more letters are broken in front of signs.
const UNBROKEN: usize = 44;

/// A formula within a line.
pub(crate) fn inline(formula: &str) -> String {
    in_pieces(formula, parse)
}

/// A computed value within a line, in which a run of letters is the name of one parameter. A chain of equations may be broken in
/// front of each `=`.
pub(crate) fn value(text: &str) -> String {
    in_pieces(text, parse_value)
}

/// An element `math` for each piece between which a line may break.
fn in_pieces(formula: &str, tree: impl Fn(&str) -> Vec<Node>) -> String {
    let signs = if formula.len() > UNBROKEN { &["=", "+", "-"][..] } else { &[] };
    let chain = formula.matches(" = ").count() > 1;
    let (mut words, mut depth): (Vec<String>, usize) = (vec![], 0);
    for word in formula.split(' ') {
        let sign = signs.contains(&word) || chain && word == "=";
        match words.last_mut() {
            Some(piece) if depth > 0 || !sign => *piece += &format!(" {word}"),
            _ => words.push(word.into()),
        }
        depth += word.matches(['(', '[', '{', '"']).count();
        depth = depth.saturating_sub(word.matches([')', ']', '}']).count());
    }
    let pieces = words.iter().map(|piece| {
        let nodes = tree(piece);
        // a sign at the start has the space of one between terms
        let written = match nodes.as_slice() {
            [Node::Operator(sign @ ("+" | "−")), rest @ ..]
                if piece.starts_with([('+'), '-']) && piece[1..].starts_with(' ') =>
            {
                format!("<mrow><mo form=\"infix\">{sign}</mo>{}</mrow>", self::pieces(rest))
            }
            nodes => row(nodes),
        };
        format!("<math alttext=\"{}\">{written}</math>", escaped(piece))
    });
    pieces.collect::<Vec<_>>().join(" ")
}

/// An element `math` on a line of its own, with gaps between its equations.
pub(crate) fn display(formula: &str) -> String {
    let nodes = parse(formula);
    let (mut depth, mut start, mut text) = (0, 0, String::new());
    for (at, node) in nodes.iter().enumerate() {
        depth += match node {
            Node::Operator("(" | "[" | "⟨") => 1,
            Node::Operator(")" | "]" | "⟩") => -1,
            _ => 0,
        };
        if depth == 0 && *node == Node::Operator(",") {
            text += &(pieces(&nodes[start..=at]) + "<mspace width=\"1em\"/>");
            start = at + 1;
        }
    }
    text += &pieces(&nodes[start..]);
    let plain = escaped(formula);
    format!("<math display=\"block\" alttext=\"{plain}\"><mrow>{text}</mrow></math>")
}

/// Pieces in a row; a single piece needs none.
fn row(nodes: &[Node]) -> String {
    match nodes {
        [node] => piece(node),
        _ => format!("<mrow>{}</mrow>", pieces(nodes)),
    }
}

/// Pieces one after the other, with a gap between a function and an argument without brackets.
fn pieces(nodes: &[Node]) -> String {
    let mut text = String::new();
    for (at, node) in nodes.iter().enumerate() {
        text += &piece(node);
        let argument = nodes.get(at + 1).is_some_and(|next| !matches!(next, Node::Operator(_)));
        let function = match node {
            Node::Scripts(base, _) => matches!(**base, Node::Function(_)),
            node => matches!(node, Node::Function(_)),
        };
        if function && argument {
            text += "<mspace width=\"0.17em\"/>";
        }
    }
    text
}

fn piece(node: &Node) -> String {
    match node {
        Node::Letter(letter) => match letter {
            '∇' | '∑' | '∂' => format!("<mo>{letter}</mo>"),
            _ => format!("<mi>{letter}</mi>"),
        },
        Node::Function(name) => format!("<mi>{name}</mi>"),
        Node::Number(number) => format!("<mn>{number}</mn>"),
        Node::Operator(sign @ ("(" | ")" | "[" | "]" | "⟨" | "⟩" | "|")) => {
            format!("<mo stretchy=\"false\">{sign}</mo>")
        }
        Node::Operator(sign @ ("," | ";")) => format!("<mo separator=\"true\">{sign}</mo>"),
        Node::Operator(sign) => format!("<mo>{sign}</mo>"),
        Node::Text(text) => format!("<mtext> {} </mtext>", escaped(text)),
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
        Node::Scripts(base, scripts) => match scripts.as_slice() {
            [(true, power)] => format!("<msup>{}{}</msup>", piece(base), row(power)),
            [(false, index)] => format!("<msub>{}{}</msub>", piece(base), row(index)),
            several => {
                let mut text = format!("<mmultiscripts>{}", piece(base));
                for (above, script) in several {
                    let script = row(script);
                    let pair = if *above {
                        ["<mrow></mrow>", &script]
                    } else {
                        [&script, "<mrow></mrow>"]
                    };
                    // a string takes every text
                    let _ = write!(text, "{}{}", pair[0], pair[1]);
                }
                text + "</mmultiscripts>"
            }
        },
    }
}

/// Text as it stands in an element or an attribute.
pub(crate) fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}
