//! Writes formulas in the mathematics mode of LaTeX.

use super::{Accent, Brackets, DIFFERENTIALS, LETTERS, Node, is_prefix};

/// Writes the row with brackets of variable size.
pub fn formula(row: &[Node]) -> String {
    Writer { grows: true }.row(row, " ")
}

/// Writes the row with plain brackets, because TeX can break lines within them.
pub fn breakable(row: &[Node]) -> String {
    Writer { grows: false }.row(row, " ")
}

/// Writes a term of a sum. The sign of the first term is a prefix; other signs are operators.
pub(crate) fn term(row: &[Node], first: bool) -> String {
    match row {
        [Node::Sign(sign), rest @ ..] if !first && row[0].is_sign_of_term() => {
            format!("{} {}", in_tex(sign), formula(rest))
        }
        row => formula(row),
    }
}

/// Names of tensors and groups that are printed upright.
const UPRIGHT: [&str; 6] = ["Ric", "symRic", "altRic", "tfRic", "Kr", "SO"];
/// Functions that have LaTeX commands.
const COMMANDS: [&str; 10] =
    ["exp", "log", "sin", "cos", "tan", "cot", "sinh", "cosh", "tanh", "det"];

#[derive(Clone, Copy)]
struct Writer {
    /// Whether brackets around sums grow, as `\left(` and `\right)` do.
    grows: bool,
}

impl Writer {
    /// Writes nodes with gaps between them; `behind` is written after a separator.
    fn row(self, row: &[Node], behind: &str) -> String {
        let mut text = String::new();
        for (at, node) in row.iter().enumerate() {
            if let Some(before) = at.checked_sub(1).map(|before| &row[before]) {
                // adds a space where a function without brackets ends its argument
                let torn =
                    ends_open(before) && !matches!(node, Node::Sign(_)) && !is_function(node);
                text += match (before, node) {
                    (Node::Sign("/"), _) | (_, Node::Sign("/" | "∗" | "," | ";" | ":")) => "",
                    (before, _) if before.is_separator() => behind,
                    _ if is_prefix(row, at - 1) => "",
                    _ if torn => " \\, ",
                    _ => " ",
                };
            }
            text += &self.piece(node);
        }
        text
    }

    fn piece(self, node: &Node) -> String {
        match node {
            Node::Letter(letter) => match LETTERS.iter().find(|(_, known, _)| known == letter) {
                Some((name, _, "")) | Some((_, _, name)) => format!("\\{name}"),
                None => letter.to_string(),
            },
            Node::Name(name) if UPRIGHT.contains(&name.as_str()) => format!("\\mathrm{{{name}}}"),
            Node::Name(name) => format!("\\mathit{{{}}}", name.replace('_', "\\_")),
            Node::Function(name) if COMMANDS.contains(&name.as_str()) => format!("\\{name}"),
            Node::Function(name) => format!("\\operatorname{{{name}}}"),
            Node::Number(text) | Node::Indices(text) => text.clone(),
            Node::Sign(sign) => in_tex(sign).into(),
            Node::Text(text) => format!("\\text{{{}}}", escaped(text)),
            Node::Group(brackets, row) => {
                let sum = row.iter().any(|node| node.is_sign_of_term());
                let grows = self.grows && sum && *brackets == Brackets::Round;
                self.group(*brackets, row, grows || row.iter().any(Node::is_tall))
            }
            Node::Apply(function, argument) => match &**argument {
                Node::Group(brackets, row) => {
                    let group = self.group(*brackets, row, row.iter().any(Node::is_tall));
                    self.piece(function) + &group
                }
                argument => format!("{} {}", self.piece(function), self.piece(argument)),
            },
            Node::Root(row) => format!("\\sqrt{{{}}}", self.row(row, " ")),
            Node::Fraction(parts) => {
                let [above, below] = parts.each_ref().map(|part| self.row(part, " "));
                format!("\\frac{{{above}}}{{{below}}}")
            }
            Node::Accent(accent, letter) => {
                let name = match accent {
                    Accent::Tilde => "tilde",
                    Accent::Dot => "dot",
                    Accent::Bar => "bar",
                    Accent::Hat => "hat",
                };
                format!("\\{name}{{{}}}", self.piece(letter))
            }
            Node::Scripts(base, scripts) => self.scripts(base, scripts),
        }
    }

    fn group(self, brackets: Brackets, row: &[Node], grows: bool) -> String {
        let [open, close] = match brackets {
            Brackets::Angle => ["\\langle ", " \\rangle"],
            brackets => brackets.text(),
        };
        let row = self.row(row, " ");
        match grows {
            true => format!("\\left{open}{row}\\right{}", close.trim_start()),
            false => format!("{open}{row}{close}"),
        }
    }

    fn scripts(self, base: &Node, scripts: &[(bool, Vec<Node>)]) -> String {
        let mut text = self.piece(base);
        // writes a power above the index of its base, and other scripts next to each other
        if let Node::Scripts(_, inner) = base
            && !matches!((&inner[..], scripts), ([(false, _)], [(true, _)]))
        {
            text = format!("{{{text}}}");
        }
        for (at, (above, row)) in scripts.iter().enumerate() {
            text += if at > 0 { "{}" } else { "" };
            text += &match (above, &row[..]) {
                (true, [Node::Sign("′")]) => "'".into(),
                // writes the exponent of plain brackets without braces
                (true, [Node::Number(n)])
                    if scripts.len() == 1 && text.ends_with(')') && !text.ends_with("\\right)") =>
                {
                    format!("^{n}")
                }
                (true, row) => format!("^{{{}}}", self.row(row, "")),
                (false, row) => format!("_{{{}}}", self.row(row, "")),
            };
        }
        text
    }
}

/// Whether the node is a function, with or without its argument.
fn is_function(node: &Node) -> bool {
    match node {
        Node::Function(_) => true,
        Node::Apply(function, _) => is_function(function),
        Node::Scripts(base, _) => is_function(base),
        _ => false,
    }
}

/// Whether the node ends with an argument that has no brackets.
fn ends_open(node: &Node) -> bool {
    match node {
        Node::Apply(function, argument) => {
            let differential = matches!(**function, Node::Letter(d) if DIFFERENTIALS.contains(&d));
            !differential && !matches!(**argument, Node::Group(..))
        }
        _ => false,
    }
}

fn in_tex(sign: &'static str) -> &'static str {
    match sign {
        "→" => "\\to",
        "≤" => "\\le",
        "≥" => "\\ge",
        "≠" => "\\ne",
        "±" => "\\pm",
        "…" => "\\dots",
        "−" => "-",
        "×" => "\\times",
        "∗" => "*",
        "′" => "'",
        sign => sign,
    }
}

/// Escapes all special characters of LaTeX.
///
/// ```
/// use affinor_documents::formula::tex::escaped;
/// assert_eq!(escaped("x_1 & 50 %"), r"x\_1 \& 50 \%");
/// ```
pub fn escaped(text: &str) -> String {
    let mut plain = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '\\' => plain.push_str("\\textbackslash{}"),
            '^' => plain.push_str("\\textasciicircum{}"),
            '~' => plain.push_str("\\textasciitilde{}"),
            '<' => plain.push_str("\\textless{}"),
            '>' => plain.push_str("\\textgreater{}"),
            '|' => plain.push_str("\\textbar{}"),
            '{' | '}' | '#' | '$' | '%' | '&' | '_' => plain.extend(['\\', c]),
            _ => plain.push(c),
        }
    }
    plain
}
