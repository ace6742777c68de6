//! Formulas as MathML, which browsers draw without a script.

use super::formula::{Accent, Node, parse};
use super::html::escaped;
use std::fmt::Write;

/// An element `math` within a line.
pub(super) fn inline(formula: &str) -> String {
    format!("<math>{}</math>", row(&parse(formula)))
}

/// An element `math` on a line of its own, with gaps between its equations.
pub(super) fn display(formula: &str) -> String {
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
    format!("<math display=\"block\"><mrow>{pieces}</mrow></math>")
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
