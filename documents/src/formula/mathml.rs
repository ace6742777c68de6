//! Formulas as MathML, which browsers draw without a script.

use super::{Accent, Node, parse, parse_value};
use std::fmt::Write;

/// An element `math` within a line.
pub(crate) fn inline(formula: &str) -> String {
    format!("<math alttext=\"{}\">{}</math>", escaped(formula), row(&parse(formula)))
}

/// An element `math` for a computed value, in which a run of letters is the name of one parameter.
pub(crate) fn value(text: &str) -> String {
    format!("<math alttext=\"{}\">{}</math>", escaped(text), row(&parse_value(text)))
}

/// A chain of equations, which may be broken in front of each sign.
pub(crate) fn chain(equations: &str, written: impl Fn(&str) -> String) -> String {
    let parts = equations.split(" = ").enumerate();
    let parts = parts.map(|(at, part)| written(&[["= ", ""][usize::from(at == 0)], part].concat()));
    parts.collect::<Vec<_>>().join(" ")
}

/// An element `math` on a line of its own, with gaps between its equations.
pub(crate) fn display(formula: &str) -> String {
    let (mut depth, mut pieces) = (0, String::new());
    for node in parse(formula) {
        depth += match node {
            Node::Operator("(" | "[" | "⟨") => 1,
            Node::Operator(")" | "]" | "⟩") => -1,
            _ => 0,
        };
        pieces += &piece(&node);
        if depth == 0 && node == Node::Operator(",") {
            pieces += "<mspace width=\"1em\"/>";
        }
    }
    let plain = escaped(formula);
    format!("<math display=\"block\" alttext=\"{plain}\"><mrow>{pieces}</mrow></math>")
}

/// Pieces in a row; a single piece needs none.
fn row(nodes: &[Node]) -> String {
    let pieces: String = nodes.iter().map(piece).collect();
    if nodes.len() == 1 { pieces } else { format!("<mrow>{pieces}</mrow>") }
}

fn piece(node: &Node) -> String {
    match node {
        Node::Letter(letter) => match letter {
            '∇' | '∑' | '∂' => format!("<mo>{letter}</mo>"),
            _ => format!("<mi>{letter}</mi>"),
        },
        Node::Function(name) => format!("<mi>{name}</mi><mspace width=\"0.1em\"/>"),
        Node::Number(number) => format!("<mn>{number}</mn>"),
        Node::Operator(sign @ ("(" | ")" | "[" | "]" | "⟨" | "⟩" | "|")) => {
            format!("<mo stretchy=\"false\">{sign}</mo>")
        }
        Node::Operator(sign @ ("," | ";")) => format!("<mo separator=\"true\">{sign}</mo>"),
        Node::Operator(sign) => format!("<mo>{sign}</mo>"),
        Node::Text(text) => format!("<mtext> {} </mtext>", escaped(text)),
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
