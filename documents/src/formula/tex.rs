//! Formulas in LaTeX's mathematics mode.

use super::{Accent, Node, parse};
use crate::report::latex_escaped;

/// The formula in LaTeX's mathematics mode.
pub(crate) fn formula(formula: &str) -> String {
    pieces(&parse(formula))
}

fn pieces(nodes: &[Node]) -> String {
    let pieces: Vec<String> = nodes.iter().map(piece).collect();
    pieces.join(" ")
}

fn piece(node: &Node) -> String {
    match node {
        Node::Letter(letter) => greek(*letter).map_or(letter.to_string(), Into::into),
        Node::Function(name) => match name.as_str() {
            "exp" | "log" | "sin" | "cos" | "det" => format!("\\{name}"),
            "sqrt" => "\\operatorname{sqrt}".into(),
            _ => format!("\\operatorname{{{name}}}"),
        },
        Node::Number(number) => number.clone(),
        Node::Operator(sign) => operator(sign).into(),
        Node::Text(text) => format!("\\text{{ {} }}", latex_escaped(text)),
        Node::Root(inner) => format!("\\sqrt{{{}}}", pieces(inner)),
        Node::Fraction([above, below]) => {
            format!("\\frac{{{}}}{{{}}}", pieces(above), pieces(below))
        }
        Node::Accent(accent, letter) => {
            let name = match accent {
                Accent::Tilde => "tilde",
                Accent::Dot => "dot",
                Accent::Bar => "bar",
                Accent::Hat => "hat",
            };
            format!("\\{name}{{{}}}", piece(letter))
        }
        Node::Scripts(base, scripts) => {
            let mut text = piece(base);
            for (at, (above, script)) in scripts.iter().enumerate() {
                let gap = if at > 0 { "{}" } else { "" };
                let mark = if *above { '^' } else { '_' };
                text += &format!("{gap}{mark}{{{}}}", pieces(script));
            }
            text
        }
    }
}

fn greek(letter: char) -> Option<&'static str> {
    Some(match letter {
        'Λ' => "\\Lambda",
        'λ' => "\\lambda",
        'Ω' => "\\Omega",
        'ω' => "\\omega",
        'Γ' => "\\Gamma",
        'Φ' => "\\Phi",
        'Ψ' => "\\Psi",
        'Θ' => "\\Theta",
        'θ' => "\\theta",
        'τ' => "\\tau",
        '∇' => "\\nabla",
        'δ' => "\\delta",
        'ε' => "\\varepsilon",
        'η' => "\\eta",
        'γ' => "\\gamma",
        '∂' => "\\partial",
        'μ' => "\\mu",
        'ψ' => "\\psi",
        'π' => "\\pi",
        '∑' => "\\sum",
        _ => return None,
    })
}

fn operator(sign: &'static str) -> &'static str {
    match sign {
        "→" => "\\to",
        "≤" => "\\le",
        "≥" => "\\ge",
        "≠" => "\\ne",
        "±" => "\\pm",
        "…" => "\\dots",
        "⟨" => "\\langle",
        "⟩" => "\\rangle",
        "−" => "-",
        "×" => "\\times",
        "∗" => "*",
        "′" => "'",
        "∘" => "\\circ",
        "°" => "^{\\circ}",
        "%" => "\\%",
        sign => sign,
    }
}
