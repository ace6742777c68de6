//! Formulas in the plain notation of the project, `R^i_jkl = 1/4 (d_ik d_jl - d_il d_jk)`, as a tree.
//!
//! - A run of letters is a Greek letter, a function such as `exp`, or else letters that are multiplied: `DH`. Digits
//!   after letters are a lower index: `J11`. A final `~` or `dot` is an accent: `omega~`, `Hdot`.
//! - `^` and `_` begin indices or a power: a run of letters and digits, each an index of its own, or anything in braces.
//! - `a/b` without spaces is a fraction, `"text"` is text, and `*` is a product without a sign.
//! - `->`, `<=`, `!=`, `!`, `x` between spaces (the cross product), `+-` and the usual signs are operators.

pub(crate) mod mathml;
pub(crate) mod tex;

/// A piece of a formula.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum Node {
    /// A letter, as a character of Unicode.
    Letter(char),
    /// The name of a function, upright.
    Function(String),
    /// A number.
    Number(String),
    /// An operator, a bracket or a comma.
    Operator(&'static str),
    /// Words.
    Text(String),
    /// A fraction: what is above and below the bar.
    Fraction([Vec<Node>; 2]),
    /// A square root.
    Root(Vec<Node>),
    /// An accent over a letter.
    Accent(Accent, Box<Node>),
    /// Indices and powers, in order: whether each run is above, and its pieces.
    Scripts(Box<Node>, Vec<(bool, Vec<Node>)>),
}

/// A sign over a letter.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Accent {
    /// `Omega~`: the matrix `spin(Omega)`.
    Tilde,
    /// `Hdot`: the derivative by time.
    Dot,
    /// `Vbar`.
    Bar,
    /// `ehat`.
    Hat,
}

/// Greek letters by their names.
const GREEK: [(&str, char); 20] = [
    ("Lambda", 'Λ'),
    ("lambda", 'λ'),
    ("Omega", 'Ω'),
    ("omega", 'ω'),
    ("Gamma", 'Γ'),
    ("Phi", 'Φ'),
    ("Psi", 'Ψ'),
    ("Theta", 'Θ'),
    ("theta", 'θ'),
    ("tau", 'τ'),
    ("nabla", '∇'),
    ("delta", 'δ'),
    ("eps", 'ε'),
    ("eta", 'η'),
    ("gamma", 'γ'),
    ("partial", '∂'),
    ("mu", 'μ'),
    ("psi", 'ψ'),
    ("pi", 'π'),
    ("sum", '∑'),
];
const FUNCTIONS: [&str; 14] = [
    "exp", "log", "sin", "cos", "sqrt", "det", "tr", "ad", "Ad", "spin", "vect", "norm", "Ric",
    "SO",
];
/// English words among computed values.
const WORDS: [&str; 3] = ["only", "if", "for"];
const ACCENTS: [(&str, Accent); 3] =
    [("dot", Accent::Dot), ("bar", Accent::Bar), ("hat", Accent::Hat)];
/// Signs of several characters first.
const OPERATORS: [(&str, &str); 25] = [
    ("->", "→"),
    ("<=", "≤"),
    (">=", "≥"),
    ("!=", "≠"),
    ("+-", "±"),
    ("...", "…"),
    ("..", "…"),
    ("<", "⟨"),
    (">", "⟩"),
    ("+", "+"),
    ("-", "−"),
    ("=", "="),
    ("(", "("),
    (")", ")"),
    ("[", "["),
    ("]", "]"),
    (",", ","),
    (";", ";"),
    (":", ":"),
    (".", "."),
    ("'", "′"),
    ("|", "|"),
    ("/", "/"),
    ("°", "°"),
    ("%", "%"),
];

/// A group without its brackets.
fn without_brackets(nodes: Vec<Node>) -> Vec<Node> {
    match nodes.as_slice() {
        [Node::Operator("("), inner @ .., Node::Operator(")")] => inner.to_vec(),
        _ => nodes,
    }
}

/// The Greek letter of a name.
fn greek(name: &str) -> Option<char> {
    GREEK.iter().find(|(known, _)| *known == name).map(|(_, letter)| *letter)
}

/// The tree of a formula. Whatever is not understood is kept as text.
pub(crate) fn parse(formula: &str) -> Vec<Node> {
    Reader { rest: formula, names: false, depth: 0 }.sequence(None)
}

/// The tree of a computed value, in which a run of letters is the name of one parameter.
pub(crate) fn parse_value(value: &str) -> Vec<Node> {
    Reader { rest: value, names: true, depth: 0 }.sequence(None)
}

struct Reader<'a> {
    rest: &'a str,
    /// Whether a run of letters is one name.
    names: bool,
    /// How many brackets and braces are open.
    depth: usize,
}

/// Brackets and braces within more than these are signs like others.
const DEEPEST: usize = 64;

impl<'a> Reader<'a> {
    /// Pieces up to the end, or to a closing brace.
    fn sequence(&mut self, end: Option<char>) -> Vec<Node> {
        let mut nodes = vec![];
        loop {
            let before = self.rest.len();
            self.rest = self.rest.trim_start_matches([' ', '\n', '*']);
            let spaced = self.rest.len() < before;
            let Some(first) = self.rest.chars().next() else { return nodes };
            if Some(first) == end {
                self.rest = &self.rest[first.len_utf8()..];
                return nodes;
            }
            if spaced && self.rest.starts_with("x ") {
                self.rest = &self.rest[1..];
                nodes.push(Node::Operator("×"));
                continue;
            }
            let above = self.scripted(first);
            nodes.extend(self.over(above));
        }
    }

    /// Pieces up to a closing bracket.
    fn inner(&mut self, end: char) -> Vec<Node> {
        self.depth += 1;
        let nodes = self.sequence(Some(end));
        self.depth -= 1;
        nodes
    }

    /// The pieces that begin with a character, with the indices and powers of the last one.
    fn scripted(&mut self, first: char) -> Vec<Node> {
        let mut atoms = self.atoms(first);
        let open = self.names && self.rest.starts_with('(') && self.depth < DEEPEST;
        if open && let Some(Node::Function(name)) = atoms.last() {
            // a function of values is one piece with its argument, also above and below a bar
            let root = name == "sqrt";
            let group = self.group();
            if root {
                atoms.pop();
                atoms.push(Node::Root(without_brackets(group)));
            } else {
                atoms.extend(group);
            }
        }
        if let Some(base) = atoms.pop() {
            let name = match &base {
                Node::Scripts(base, _) => matches!(**base, Node::Letter(_)),
                base => matches!(base, Node::Letter(_)),
            };
            let last = self.scripts(base);
            atoms.push(last);
            // a letter, or the derivative of a function: `a_t(t)^2`
            if self.names && name && self.rest.starts_with('(') && self.depth < DEEPEST {
                atoms.extend(self.group());
                if let Some(bracket) = atoms.pop() {
                    let last = self.scripts(bracket);
                    atoms.push(last);
                }
            }
        }
        atoms
    }

    /// The pieces that begin with a character.
    fn atoms(&mut self, first: char) -> Vec<Node> {
        if first.is_ascii_alphabetic() {
            let word = self.run(|c| c.is_ascii_alphabetic());
            return self.word(word);
        }
        if first.is_ascii_digit() {
            return vec![Node::Number(self.number())];
        }
        if first == '(' && self.names && self.depth < DEEPEST {
            return self.group();
        }
        if first == '"' {
            let (text, rest) = self.rest[1..].split_once('"').unwrap_or((&self.rest[1..], ""));
            let text = Node::Text(text.into());
            self.rest = rest;
            return vec![text];
        }
        if let Some((sign, shown)) = OPERATORS.iter().find(|(sign, _)| self.rest.starts_with(sign))
        {
            self.rest = &self.rest[sign.len()..];
            return vec![Node::Operator(shown)];
        }
        self.rest = &self.rest[first.len_utf8()..];
        vec![Node::Text(first.into())]
    }

    /// What stands in brackets, with them.
    fn group(&mut self) -> Vec<Node> {
        self.rest = &self.rest[1..];
        let mut nodes = vec![Node::Operator("(")];
        nodes.extend(self.inner(')'));
        nodes.push(Node::Operator(")"));
        nodes
    }

    /// A letter, a function, or a product of letters with the accent and the digits of the last one.
    fn word(&mut self, mut word: &str) -> Vec<Node> {
        if FUNCTIONS.contains(&word) {
            return vec![Node::Function(word.into())];
        }
        if self.names && WORDS.contains(&word) {
            return vec![Node::Text(word.into())];
        }
        let differential =
            word.strip_prefix('d').is_some_and(|x| x.len() == 1 || greek(x).is_some());
        if self.names && word.len() > 1 && greek(word).is_none() && !differential {
            // the digits stay in the name
            let digits = self.run(|c| c.is_ascii_alphanumeric() || c == '_');
            return vec![Node::Function(format!("{word}{digits}"))];
        }
        let accent = match self.rest.strip_prefix('~') {
            Some(rest) => {
                self.rest = rest;
                Some(Accent::Tilde)
            }
            None => ACCENTS.iter().find_map(|(ending, accent)| {
                word = word.strip_suffix(ending).filter(|letters| !letters.is_empty())?;
                Some(*accent)
            }),
        };
        let mut letters = vec![];
        while let Some(first) = word.chars().next() {
            let named = GREEK.iter().find(|(name, _)| word.starts_with(name));
            let (length, letter) = named.map_or((1, first), |(name, letter)| (name.len(), *letter));
            letters.push(Node::Letter(letter));
            word = &word[length..];
        }
        if let Some(accent) = accent
            && let Some(last) = letters.pop()
        {
            letters.push(Node::Accent(accent, Box::new(last)));
        }
        let digits = self.run(|c| c.is_ascii_digit());
        if !digits.is_empty()
            && let Some(last) = letters.pop()
        {
            let index = vec![Node::Number(digits.into())];
            letters.push(Node::Scripts(Box::new(last), vec![(false, index)]));
        }
        letters
    }

    /// `12`, `0.5` or `1e-12`.
    fn number(&mut self) -> String {
        let mut number = self.run(|c| c.is_ascii_digit()).to_string();
        let fraction = self.rest.strip_prefix('.');
        if fraction.is_some_and(|rest| rest.starts_with(|c: char| c.is_ascii_digit())) {
            self.rest = &self.rest[1..];
            number = number + "." + self.run(|c| c.is_ascii_digit());
        }
        // an exponent such as e-7, if it has digits
        let exponent = self.rest.strip_prefix('e').map(|rest| rest.trim_start_matches('-'));
        if exponent.is_some_and(|rest| rest.starts_with(|c: char| c.is_ascii_digit())) {
            self.rest = &self.rest[1..];
            number += "e";
            number += self.run(|c| c == '-');
            number += self.run(|c| c.is_ascii_digit());
        }
        number
    }

    /// The piece with the indices and powers that follow it.
    fn scripts(&mut self, base: Node) -> Node {
        let (base, mut scripts) = match base {
            // the digits of a name are its first index
            Node::Scripts(base, scripts) => (base, scripts),
            base => (Box::new(base), vec![]),
        };
        while let Some(mark) = self.rest.chars().next().filter(|c| "^_".contains(*c)) {
            self.rest = &self.rest[1..];
            let script = match self.rest.strip_prefix('{') {
                Some(rest) if self.depth < DEEPEST => {
                    self.rest = rest;
                    self.inner('}')
                }
                _ => self.indices(),
            };
            scripts.push((mark == '^', script));
        }
        if scripts.is_empty() { *base } else { Node::Scripts(base, scripts) }
    }

    /// Letters and digits, each an index; `-1` and `*` may stand alone.
    fn indices(&mut self) -> Vec<Node> {
        let mut nodes = vec![];
        for (sign, shown) in [("-", "−"), ("*", "∗"), ("+", "+")] {
            if let Some(rest) = self.rest.strip_prefix(sign) {
                self.rest = rest;
                nodes.push(Node::Operator(shown));
            }
        }
        let run = self.run(|c| c.is_ascii_alphanumeric());
        if self.names
            && let Some(letter) = greek(run)
        {
            nodes.push(Node::Letter(letter));
            return nodes;
        }
        if !nodes.is_empty() && run.parse::<u32>().is_ok() {
            // a power such as -12 is one number
            nodes.push(Node::Number(run.into()));
            return nodes;
        }
        nodes.extend(run.chars().map(|c| match c.is_ascii_digit() {
            true => Node::Number(c.into()),
            false => Node::Letter(c),
        }));
        nodes
    }

    /// A fraction, if a bar follows at once and a letter or a number behind it; between values also a group in brackets,
    /// which the bar replaces.
    fn over(&mut self, above: Vec<Node>) -> Vec<Node> {
        let mut ahead = Reader { rest: self.rest.strip_prefix('/').unwrap_or_default(), ..*self };
        let begins = |c: &char| c.is_ascii_alphanumeric() || self.names && *c == '(';
        let Some(first) = ahead.rest.chars().next().filter(begins) else {
            return above;
        };
        let below = ahead.scripted(first);
        self.rest = ahead.rest;
        vec![Node::Fraction([above, below].map(without_brackets))]
    }

    /// The longest run of such characters, which may be empty.
    fn run(&mut self, of: impl Fn(char) -> bool) -> &'a str {
        let end = self.rest.find(|c| !of(c)).unwrap_or(self.rest.len());
        let (run, rest) = self.rest.split_at(end);
        self.rest = rest;
        run
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn letter(c: char) -> Node {
        Node::Letter(c)
    }

    #[test]
    fn indices_keep_their_order() {
        let indices = |text: &str| text.chars().map(Node::Letter).collect::<Vec<_>>();
        let scripts = vec![(true, indices("i")), (false, indices("jkl"))];
        assert_eq!(parse("R^i_jkl"), [Node::Scripts(Box::new(letter('R')), scripts)]);
    }

    #[test]
    fn words_accents_and_fractions() {
        assert_eq!(parse("DH"), [letter('D'), letter('H')]);
        assert_eq!(parse("DH/Dt")[0], Node::Fraction(["DH", "Dt"].map(parse)));
        assert_eq!(parse("omega~"), [Node::Accent(Accent::Tilde, Box::new(letter('ω')))]);
        assert_eq!(parse("dOmega1/dt")[0], Node::Fraction(["dOmega1", "dt"].map(parse)));
        assert_eq!(parse("Omega x H")[1], Node::Operator("×"));
        assert_eq!(parse("-1/4")[1], Node::Fraction(["1", "4"].map(parse)));
    }

    #[test]
    fn values_have_names_and_bars() {
        let names = |text: &str| Node::Function(text.into());
        assert_eq!(parse_value("mass"), [names("mass")]);
        assert_eq!(parse_value("mu*k"), [letter('μ'), letter('k')]);
        let value = parse_value("(a - 3*b)/(4*a^2)");
        assert_eq!(value, [Node::Fraction([parse_value("a - 3*b"), parse_value("4*a^2")])]);
        assert_eq!(parse_value("2.5e-7"), [Node::Number("2.5e-7".into())]);
        // a function keeps its argument
        let tangent = parse_value("sin(x)/cos(x)");
        assert_eq!(tangent, [Node::Fraction([parse_value("sin(x)"), parse_value("cos(x)")])]);
        let root = Node::Root(parse_value("r - 2*M"));
        assert_eq!(parse_value("sqrt(r - 2*M)/r")[0], Node::Fraction([vec![root], parse("r")]));
        assert_eq!(parse_value("sin(x)^2").len(), 4);
        for text in [
            "a(t)",
            "a_t(t)",
            "f_r_theta(r,theta)",
            "a_t_t(t)^2",
            "f1(r)",
            "f1_r(r)",
            "mu(r)",
            "nu_r(r)",
        ] {
            let quotient = parse_value(&format!("{text}/b_x(x)"));
            assert_eq!(quotient, [Node::Fraction([text, "b_x(x)"].map(parse_value))], "{text}");
        }
        let theta = (false, vec![letter('θ')]);
        let derivative = Node::Scripts(Box::new(letter('f')), vec![theta]);
        assert_eq!(parse_value("f_theta(theta)")[0], derivative);
        // a power keeps its brackets
        let Node::Fraction([above, _]) = &parse_value("(a + b)^2/c")[0] else { panic!() };
        assert_eq!(above[0], Node::Operator("("));
    }

    #[test]
    fn whatever_is_not_understood_is_text() {
        assert_eq!(parse("§{"), [Node::Text("§".into()), Node::Text("{".into())]);
        for odd in ["(", "_{", "^{", "/(", "a/"] {
            parse_value(&odd.repeat(10_000));
        }
    }
}
