//! The parser of the notation of formulas.

use super::{
    ACCENTS, Accent, Brackets, DIFFERENTIALS, LETTERS, Node, Row, SIGNS, fraction, is_function,
    symbol,
};

/// The deepest nesting of brackets.
const DEEPEST: usize = 64;

/// Parses a formula.
///
/// # Errors
/// The rest of the text, starting where the parser failed.
pub(crate) fn notation(text: &str) -> Result<Row, String> {
    let mut reader = Reader { rest: text, depth: 0 };
    let row = reader.row("");
    match row {
        Some(row) if reader.rest.is_empty() => Ok(row),
        _ => Err(reader.rest.into()),
    }
}

/// Parses a formula. A text that the grammar does not allow becomes a node of words.
///
/// ```
/// use affinor_documents::formula::{Node, formula};
/// assert_eq!(formula("theta = 0")[1], Node::Sign("="));
/// assert_eq!(formula("(a"), [Node::Text("(a".into())]);
/// ```
pub fn formula(text: &str) -> Row {
    notation(text).unwrap_or_else(|_| vec![Node::Text(text.into())])
}

#[derive(Clone)]
struct Reader<'a> {
    rest: &'a str,
    /// The number of open brackets and braces.
    depth: usize,
}

impl<'a> Reader<'a> {
    /// Consumes `text` if the rest begins with it.
    fn take(&mut self, text: &str) -> bool {
        self.rest.strip_prefix(text).map(|rest| self.rest = rest).is_some()
    }

    /// Consumes the longest run of characters that `of` accepts; the run may be empty.
    fn run(&mut self, of: impl Fn(char) -> bool) -> &'a str {
        let end = self.rest.find(|c| !of(c)).unwrap_or(self.rest.len());
        let (run, rest) = self.rest.split_at(end);
        self.rest = rest;
        run
    }

    /// Whether the rest begins with a factor.
    fn begins_factor(&self) -> bool {
        self.rest.starts_with(|c: char| c.is_ascii_alphanumeric() || "([<{\"".contains(c))
            && !self.rest.starts_with("<=")
    }

    /// Parses signs and products up to a closing bracket.
    fn row(&mut self, end: &str) -> Option<Row> {
        let mut row = vec![];
        loop {
            let before = self.rest.len();
            self.rest = self.rest.trim_start_matches([' ', '\n']);
            let spaced = self.rest.len() < before;
            if end.is_empty() && self.rest.is_empty() || !end.is_empty() && self.take(end) {
                return Some(row);
            }
            if spaced && self.rest.starts_with("x ") {
                self.rest = &self.rest[1..];
                row.push(Node::Sign("×"));
                continue;
            }
            let sign = SIGNS.iter().find(|(sign, _)| self.rest.starts_with(sign));
            match sign.filter(|(sign, _)| !["'", "x"].contains(sign)) {
                Some((sign, shown)) => {
                    self.rest = &self.rest[sign.len()..];
                    row.push(Node::Sign(shown));
                }
                None => row.extend(self.quotient()?),
            }
        }
    }

    /// Parses a row in brackets, after the opening bracket.
    fn inside(&mut self, end: &str) -> Option<Row> {
        self.depth += 1;
        let row = (self.depth <= DEEPEST).then(|| self.row(end)).flatten();
        self.depth -= 1;
        row
    }

    /// Parses factors that are separated by `*` and `/`.
    fn quotient(&mut self) -> Option<Row> {
        let mut row = self.factor()?;
        loop {
            let mut ahead = Reader { rest: self.rest.get(1..).unwrap_or_default(), ..*self };
            let divides = self.rest.starts_with('/');
            if !(divides || self.rest.starts_with('*')) || !ahead.begins_factor() {
                return Some(row);
            }
            let factor = ahead.factor()?;
            *self = ahead;
            match divides {
                true => row = fraction(row, factor),
                false => row.extend(factor),
            }
        }
    }

    /// Parses a node with its scripts and its argument. Braces may contain several nodes.
    fn factor(&mut self) -> Option<Row> {
        if self.take("{") {
            let mut row = self.inside("}")?;
            let last = row.pop()?;
            row.push(self.scripts(last)?);
            return Some(row);
        }
        let atom = self.atom()?;
        let mut node = self.scripts(atom)?;
        let base = match &node {
            Node::Scripts(base, _) => base,
            node => node,
        };
        let number = matches!(base, Node::Number(_) | Node::Text(_));
        let differential = matches!(base, Node::Letter(c) if *c == 'D');
        let function = differential || matches!(base, Node::Function(_));
        if self.rest.starts_with('(') && !number {
            self.take("(");
            let argument = self.inside(")")?;
            node = match node {
                Node::Function(name) if name == "sqrt" => Node::Root(argument),
                node => apply(node, Node::Group(Brackets::Round, argument)),
            };
            node = self.scripts(node)?;
        } else if let Some(rest) = self.rest.strip_prefix(' ').filter(|_| function) {
            let mut ahead = Reader { rest, depth: self.depth + 1 };
            if ahead.begins_factor() && !rest.starts_with("x ") && ahead.depth <= DEEPEST {
                let [argument] = <[Node; 1]>::try_from(ahead.factor()?).ok()?;
                self.rest = ahead.rest;
                node = apply(node, argument);
            }
        }
        Some(vec![node])
    }

    fn atom(&mut self) -> Option<Node> {
        if self.rest.starts_with(|c: char| c.is_ascii_alphabetic()) {
            let word = self.run(|c| c.is_ascii_alphabetic());
            return self.word(word);
        }
        if self.rest.starts_with(|c: char| c.is_ascii_digit()) {
            let mut number = self.run(|c| c.is_ascii_digit()).to_string();
            let decimals = self.rest.strip_prefix('.').unwrap_or_default();
            if decimals.starts_with(|c: char| c.is_ascii_digit()) {
                self.rest = decimals;
                number = number + "." + self.run(|c| c.is_ascii_digit());
            }
            return Some(Node::Number(number));
        }
        if self.take("\"") {
            let (words, rest) = self.rest.split_once('"')?;
            self.rest = rest;
            return Some(Node::Text(words.into()));
        }
        let kinds = [Brackets::Round, Brackets::Square, Brackets::Angle];
        let kind = kinds.into_iter().find(|kind| self.rest.starts_with(kind.text()[0]))?;
        let [open, close] = kind.text();
        self.take(open);
        Some(Node::Group(kind, self.inside(close)?))
    }

    /// Converts a word to a letter, a function or a name with an accent and digits, or to a
    /// differential of one of them.
    fn word(&mut self, word: &str) -> Option<Node> {
        if is_function(word) {
            return Some(Node::Function(word.into()));
        }
        let known = |word: &str| word.len() == 1 || LETTERS.iter().any(|(name, ..)| *name == word);
        let split = |word: &'_ str| -> (usize, Option<Accent>) {
            let ending = ACCENTS[1..]
                .iter()
                .find(|(ending, _)| word.strip_suffix(ending).is_some_and(|name| !name.is_empty()));
            ending.map_or((word.len(), None), |(e, accent)| (word.len() - e.len(), Some(*accent)))
        };
        let (length, ending) = split(word);
        let stem = &word[..length];
        let (stem, accent) = match known(stem) {
            _ if self.take("~") => (word, Some(Accent::Tilde)),
            true => (stem, ending),
            false => (word, None),
        };
        let inner = DIFFERENTIALS.into_iter().find_map(|d| {
            let inner = stem.strip_prefix(d).filter(|inner| known(inner))?;
            (!known(stem)).then_some((d, inner))
        });
        let (differential, stem) = inner.map_or((None, stem), |(d, inner)| (Some(d), inner));
        let mut node = symbol(stem);
        if let Some(accent) = accent {
            node = Node::Accent(accent, Box::new(node));
        }
        let digits = self.run(|c| c.is_ascii_digit());
        if !digits.is_empty() {
            let index = vec![Node::Number(digits.into())];
            node = Node::Scripts(Box::new(node), vec![(false, index)]);
        }
        match differential {
            Some(d) => {
                let argument = self.scripts(node)?;
                Some(apply(Node::Letter(d), argument))
            }
            None => Some(node),
        }
    }

    /// Parses the indices and powers after a node.
    fn scripts(&mut self, base: Node) -> Option<Node> {
        let mut scripts = vec![];
        loop {
            let script = match self.rest.chars().next() {
                Some('\'') => {
                    self.rest = &self.rest[1..];
                    (true, vec![Node::Sign("′")])
                }
                Some(mark @ ('^' | '_')) => {
                    self.rest = &self.rest[1..];
                    let script = if self.take("{") {
                        self.inside("}")?
                    } else if self.take("(") {
                        let indices = self.indices()?;
                        self.take(")").then(|| vec![Node::Group(Brackets::Round, indices)])?
                    } else {
                        self.indices()?
                    };
                    (mark == '^', script)
                }
                _ if scripts.is_empty() => return Some(base),
                _ => return Some(Node::Scripts(Box::new(base), scripts)),
            };
            scripts.push(script);
        }
    }

    /// Parses indices of one character each. A signed number such as `-1`, and `*`, may occur as
    /// the only index.
    fn indices(&mut self) -> Option<Row> {
        let sign = SIGNS.iter().find(|(sign, _)| self.rest.starts_with(sign));
        let sign = sign.filter(|(sign, _)| ["-", "+", "*"].contains(sign));
        let mut row = vec![];
        if let Some((sign, shown)) = sign {
            self.take(sign);
            row.push(Node::Sign(shown));
        }
        let run = self.run(|c| c.is_ascii_alphanumeric());
        if sign.is_some() && run.bytes().all(|b| b.is_ascii_digit()) && !run.is_empty() {
            // a signed power such as -12 is a single number
            row.push(Node::Number(run.into()));
            return Some(row);
        }
        let mut letters = run.chars();
        row.extend(match (letters.next(), letters.next()) {
            (None, _) => None,
            (Some(c), None) if c.is_ascii_digit() => Some(Node::Number(c.into())),
            (Some(c), None) => Some(Node::Letter(c)),
            _ => Some(Node::Indices(run.into())),
        });
        (!row.is_empty()).then_some(row)
    }
}

fn apply(function: Node, argument: Node) -> Node {
    Node::Apply(Box::new(function), Box::new(argument))
}
