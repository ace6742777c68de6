//! Mathematical formulas as trees, parsed from text and written as text, LaTeX and MathML.
//!
//! A [`Row`] is a list of [`Node`]s. [`formula()`] parses handwritten statements. Computed values
//! are parsed with the grammar of [expressions](affinor_tensors::expression). [`tex`] and
//! [`mathml`] are the writers.
//!
//! ```
//! use affinor_documents::formula::{formula, mathml, tex};
//! let equation = formula("Lambda^i_jk = 1/2 c^i_jk");
//! assert_eq!(tex::formula(&equation), r"\Lambda^{i}{}_{jk} = \frac{1}{2} c^{i}{}_{jk}");
//! assert!(mathml::inline(&equation).starts_with("<math"));
//! ```
//!
//! # Grammar of the notation
//!
//! ```text
//! row      = { sign | product }            signs: + - = != <= >= -> +- ... , ; : and " x ", the cross product
//! product  = quotient { " " quotient }     a product without a sign
//! quotient = factor { "*" factor | "/" factor }      without spaces, from left to right
//! factor   = atom { script } [ group { script } ]      f(x), e_k(f)
//!          | function { script } " " factor          sin x, D H, det g
//! script   = ( "^" | "_" ) ( "{" row "}" | "(" indices ")" | indices ) | "'"
//! indices  = [ "-" | "+" | "*" ] { letter | digit }
//! atom     = number | word | group | "{" row "}" | '"' text '"'
//! group    = "(" row ")" | "[" row "]" | "<" row ">"
//! word     = ( Greek letter | letter | name ) [ "~" | "dot" | "bar" | "hat" ] [ digits ] | ( "d" | "D" ) word
//! ```
//!
//! - `/` binds as tightly as `*`, and both bind tighter than a space: `1/2 a b` is half of `a b`,
//!   `a*b/c` has the numerator `a*b`, and `a/b/c` the denominator `b c`.
//! - A function binds tightest: `sin x/x` is the quotient of `sin x` and `x`, and `D v/Dt` is the
//!   quotient of `D v` and `Dt`.
//! - Brackets around a whole numerator or denominator are removed.
//! - Each letter and digit of an index is a separate index: `R^i_jkl`. Digits after a word are a
//!   single lower index: `J11`.
//! - A word of several letters is one of these: a Greek letter, a function, a differential `dx`,
//!   the name of a quantity.
//! - Anything else is an error.

pub(crate) mod lines;
pub mod mathml;
mod notation;
pub(crate) mod prose;
pub mod tex;
mod text;
mod value;

use affinor_tensors::scalar::Function;
pub use notation::formula;
pub(crate) use notation::notation;
pub(crate) use text::text;
pub(crate) use value::{label, name, sum, value};

/// A sequence of formulas.
pub type Row = Vec<Node>;

/// A piece of a formula.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Node {
    /// A letter, as a character of Unicode.
    Letter(char),
    /// The name of a quantity, of several letters: `mass`, `Ric`.
    Name(String),
    /// The name of a function, such as `sin`.
    Function(String),
    /// A number.
    Number(String),
    /// Indices of one character each: `jkl`.
    Indices(String),
    /// A sign before or between terms, as a Unicode character.
    Sign(&'static str),
    /// Words in a formula.
    Text(String),
    /// A row of nodes in brackets.
    Group(Brackets, Row),
    /// A function and its argument, which is a group, or a single node without brackets.
    Apply(Box<Node>, Box<Node>),
    /// A fraction: the numerator and the denominator.
    Fraction([Row; 2]),
    /// A square root.
    Root(Row),
    /// An accent over a letter.
    Accent(Accent, Box<Node>),
    /// A node with indices and powers, in order. The flag of a script is true if the script is
    /// upper. A power of a node with an index, as in `J11^2`, is a separate node around the indexed
    /// node, so that the power is written above the index.
    Scripts(Box<Node>, Vec<(bool, Row)>),
}

/// A kind of brackets.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Brackets {
    /// `(a)`.
    Round,
    /// `[a]`.
    Square,
    /// `<a>`.
    Angle,
}

impl Brackets {
    /// The opening and the closing bracket in text.
    fn text(self) -> [&'static str; 2] {
        match self {
            Brackets::Round => ["(", ")"],
            Brackets::Square => ["[", "]"],
            Brackets::Angle => ["<", ">"],
        }
    }
}

/// An accent on a letter.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Accent {
    /// `Omega~`: the matrix `spin(Omega)`.
    Tilde,
    /// The dot in `Hdot`: the time derivative.
    Dot,
    /// The bar in `Vbar`.
    Bar,
    /// The hat in `ehat`.
    Hat,
}

/// Named letters: the name in text, the Unicode character, and the LaTeX command if it differs from
/// the name.
const LETTERS: [(&str, char, &str); 43] = [
    ("alpha", 'α', ""),
    ("beta", 'β', ""),
    ("gamma", 'γ', ""),
    ("delta", 'δ', ""),
    ("epsilon", 'ϵ', ""),
    ("varepsilon", 'ɛ', ""),
    ("eps", 'ε', "varepsilon"),
    ("zeta", 'ζ', ""),
    ("eta", 'η', ""),
    ("theta", 'θ', ""),
    ("vartheta", 'ϑ', ""),
    ("iota", 'ι', ""),
    ("kappa", 'κ', ""),
    ("lambda", 'λ', ""),
    ("mu", 'μ', ""),
    ("nu", 'ν', ""),
    ("xi", 'ξ', ""),
    ("pi", 'π', ""),
    ("varpi", 'ϖ', ""),
    ("rho", 'ρ', ""),
    ("varrho", 'ϱ', ""),
    ("sigma", 'σ', ""),
    ("varsigma", 'ς', ""),
    ("tau", 'τ', ""),
    ("upsilon", 'υ', ""),
    ("phi", 'ϕ', ""),
    ("varphi", 'φ', ""),
    ("chi", 'χ', ""),
    ("psi", 'ψ', ""),
    ("omega", 'ω', ""),
    ("Gamma", 'Γ', ""),
    ("Delta", 'Δ', ""),
    ("Theta", 'Θ', ""),
    ("Lambda", 'Λ', ""),
    ("Xi", 'Ξ', ""),
    ("Pi", 'Π', ""),
    ("Sigma", 'Σ', ""),
    ("Upsilon", 'Υ', ""),
    ("Phi", 'Φ', ""),
    ("Psi", 'Ψ', ""),
    ("Omega", 'Ω', ""),
    ("nabla", '∇', ""),
    ("partial", '∂', ""),
];
/// Names of functions, in addition to the elementary functions.
const FUNCTIONS: [&str; 9] = ["cot", "det", "tr", "ad", "Ad", "spin", "vect", "norm", "diag"];

/// Whether the name is a function, whose argument may be written without brackets.
fn is_function(name: &str) -> bool {
    FUNCTIONS.contains(&name) || Function::from_name(name).is_some()
}

/// Letters that form a differential with the letter or name after them, as in `dx` and `DH`.
const DIFFERENTIALS: [char; 2] = ['d', 'D'];
const ACCENTS: [(&str, Accent); 4] =
    [("~", Accent::Tilde), ("dot", Accent::Dot), ("bar", Accent::Bar), ("hat", Accent::Hat)];
/// Signs in text and in Unicode, longer signs first. A star may also end an index: `L_{g*}`.
const SIGNS: [(&str, &str); 15] = [
    ("->", "→"),
    ("<=", "≤"),
    (">=", "≥"),
    ("!=", "≠"),
    ("+-", "±"),
    ("...", "…"),
    ("+", "+"),
    ("-", "−"),
    ("=", "="),
    (",", ","),
    (";", ";"),
    (":", ":"),
    ("*", "∗"),
    ("'", "′"),
    ("x", "×"),
];

/// The letter with this name.
fn letter(name: &str) -> Option<char> {
    let mut letters = name.chars();
    match (letters.next(), letters.next()) {
        (Some(letter), None) => Some(letter),
        _ => LETTERS.iter().find(|(known, ..)| *known == name).map(|(_, letter, _)| *letter),
    }
}

/// The letter with this name, if there is one; otherwise the name itself.
fn symbol(name: &str) -> Node {
    letter(name).map_or_else(|| Node::Name(name.into()), Node::Letter)
}

/// Removes brackets around a whole numerator or denominator.
fn bare(row: Row) -> Row {
    match <[Node; 1]>::try_from(row) {
        Ok([Node::Group(Brackets::Round, inner)]) => inner,
        Ok([node]) => vec![node],
        Err(row) => row,
    }
}

/// Divides one row by another. Dividing a quotient again extends its denominator, so the result is
/// a single fraction.
fn fraction(above: Row, below: Row) -> Row {
    match <[Node; 1]>::try_from(above) {
        Ok([Node::Fraction([above, mut first])]) => {
            if first.iter().any(|node| matches!(node, Node::Sign(_))) {
                first = vec![Node::Group(Brackets::Round, first)];
            }
            first.extend(below);
            vec![Node::Fraction([above, first])]
        }
        Ok(above) => vec![Node::Fraction([above.to_vec(), below].map(bare))],
        Err(above) => vec![Node::Fraction([above, below].map(bare))],
    }
}

impl Node {
    /// Whether the sign is a relation between two sides.
    fn is_relation(&self) -> bool {
        matches!(self, Node::Sign("=" | "≠" | "≤" | "≥" | "→"))
    }

    /// Whether the sign separates items of a list.
    fn is_separator(&self) -> bool {
        matches!(self, Node::Sign("," | ";" | ":"))
    }

    /// Whether the sign may occur before a term as well as between two terms.
    fn is_sign_of_term(&self) -> bool {
        matches!(self, Node::Sign("+" | "−" | "±"))
    }

    /// Whether the node is higher than a line of letters, as a fraction is.
    fn is_tall(&self) -> bool {
        let tall = |row: &Row| row.iter().any(Node::is_tall);
        match self {
            Node::Fraction(_) | Node::Root(_) => true,
            Node::Group(_, row) => tall(row),
            Node::Apply(f, x) => f.is_tall() || x.is_tall(),
            Node::Scripts(base, _) => base.is_tall(),
            _ => false,
        }
    }
}

/// Whether the node at `at` is a sign before a term, and not an operator between two terms.
fn is_prefix(row: &[Node], at: usize) -> bool {
    let before = at.checked_sub(1).and_then(|before| row.get(before));
    row[at].is_sign_of_term() && before.is_none_or(|before| matches!(before, Node::Sign(_)))
}

#[cfg(test)]
mod tests;
