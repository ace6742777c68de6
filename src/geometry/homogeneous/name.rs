//! The names of homogeneous spaces.

use crate::Error;
use std::fmt;

/// A factor of G or of H.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Factor {
    Orthogonal(usize),
    /// `SO(p,q)`.
    IndefiniteOrthogonal(usize, usize),
    SpecialUnitary(usize),
    /// `SU(p,q)`.
    IndefiniteUnitary(usize, usize),
    Unitary(usize),
    /// The compact group of quaternionic matrices.
    Symplectic(usize),
    /// `Sp(p,q)`.
    IndefiniteSymplectic(usize, usize),
    /// `SL(n,R)`.
    SpecialLinear(usize),
    /// The rigid motions `SE(n)`.
    Motions(usize),
    /// The maximal torus of G.
    Torus,
    /// The circle `diag(k, l, -k-l)` of `SU(3)`, or the circle of weights `k` and `l` in two factors `SU(2)`.
    Circle(i64, i64),
    /// The stabilizer of a spinor, `Spin(7)` in `Spin(9)`.
    OfSpinor,
    /// The irreducible `SO(3)`, as in `SO(5)/SO(3)_irr`.
    Irreducible,
    /// `SU(2)` or `U(2)` of a long or short root.
    OfRoot {
        /// Whether the torus belongs to the group.
        torus: bool,
        /// Whether the root is long.
        long: bool,
    },
    /// A compact exceptional group, such as `G2`.
    Exceptional(&'static str),
}

/// The factors of G and of H.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Name {
    pub group: Vec<Factor>,
    pub isotropy: Vec<Factor>,
    /// Whether H is written `S(...)`: its elements have determinant 1.
    pub special: bool,
}

/// A family of homogeneous spaces: the form of its names, its spaces, and an example.
#[derive(Clone, Copy, Debug)]
pub struct Family {
    /// The form of the names, such as `S^n`.
    pub pattern: &'static str,
    /// The spaces.
    pub summary: &'static str,
    /// A name.
    pub example: &'static str,
}

const fn of(pattern: &'static str, summary: &'static str, example: &'static str) -> Family {
    Family { pattern, summary, example }
}

/// The families of homogeneous spaces that have names.
pub const FAMILIES: &[Family] = &[
    of("G/H", "homogeneous space: blocks, U(n) in SO(2n), Sp(n) in SU(2n)", "SU(3)/U(2)"),
    of("G/T", "G by its diagonal maximal torus", "Sp(2)/T"),
    of("SU(3)/U(1)_{k,l}", "Aloff-Wallach space, circle diag(k, l, -k-l)", "SU(3)/U(1)_{1,1}"),
    of("T^{p,q}", "SU(2)xSU(2)/U(1)_{q,-p}, a circle bundle over S^2 x S^2", "T^{1,1}"),
    of("SO(5)/SO(3)_irr", "Berger space, SO(3) acts on R^5 irreducibly", "SO(5)/SO(3)_irr"),
    of("SO(9)/Spin(7)", "sphere of the spinors of SO(9)", "S^15 = Spin(9)/Spin(7)"),
    of("G2/U(2)_long", "the torus and one long root; also short, SU(2)", "G2/SU(2)_short"),
    of("GxGxG/G", "products of equal groups by the diagonal", "SU(2)xSU(2)xSU(2)/SU(2)"),
    of("S^n", "sphere SO(n+1)/SO(n)", "S^4"),
    of("H^n", "hyperbolic space SO(n,1)/SO(n)", "H^3"),
    of("dS^n", "de Sitter space SO(n,1)/SO(n-1,1)", "dS^4"),
    of("AdS^n", "anti-de Sitter space SO(n-1,2)/SO(n-1,1)", "AdS^4"),
    of("CP^n", "complex projective space SU(n+1)/S(U(n)xU(1))", "CP^2"),
    of("CH^n", "complex hyperbolic space SU(n,1)/S(U(n)xU(1))", "CH^2"),
    of("HP^n", "quaternionic projective space Sp(n+1)/Sp(n)xSp(1)", "HP^2"),
    of("HH^n", "quaternionic hyperbolic space Sp(n,1)/Sp(n)xSp(1)", "HH^2"),
    of("OP^2", "octonionic projective plane F4/Spin(9)", "OP^2"),
    of("V(k,R^n)", "Stiefel manifold SO(n)/SO(n-k), also C^n, H^n", "V(2,R^5)"),
    of("Gr(k,R^n)", "oriented Grassmannian SO(n)/SO(k)xSO(n-k), also C^n, H^n", "Gr(2,C^4)"),
    of("Fl(n)", "flags SU(n)/T", "Fl(3)"),
];

const EXCEPTIONAL: [&str; 5] = ["G2", "F4", "E6", "E7", "E8"];

impl Name {
    /// Reads a name.
    ///
    /// # Errors
    /// [`Error::Name`] for a text that names no homogeneous space.
    pub fn read(text: &str) -> Result<Self, Error> {
        let named = &compact(text);
        let unknown = || {
            let shown = text.trim().escape_debug();
            Error::Name(format!(
                "`{shown}` is not the name of a homogeneous space: write for instance SU(3)/U(2), S^5 or Gr(2,C^4)"
            ))
        };
        if let Some(name) = family(named) {
            return Ok(name);
        }
        let (group, isotropy) = named.split_once('/').ok_or_else(unknown)?;
        let special = isotropy.strip_prefix("S(").and_then(|rest| rest.strip_suffix(')'));
        let read = |text: &str| factors(text).ok_or_else(unknown);
        let group = read(group)?;
        // the block SO(7) is written as such; the group that covers it acts on spinors
        let of_spinor = isotropy == "Spin(7)" && group == [Factor::Orthogonal(9)];
        let isotropy = match of_spinor {
            true => vec![Factor::OfSpinor],
            false => read(special.unwrap_or(isotropy))?,
        };
        Ok(Name { group, isotropy, special: special.is_some() })
    }

    /// The error for groups of which no embedding is known.
    pub fn without_embedding(&self) -> Error {
        Error::Name(format!(
            "{self}: no embedding of the second group in the first is known by name; \
             give the vectors of the subalgebra"
        ))
    }
}

/// A name without blanks and without a text before `=`.
pub(super) fn compact(text: &str) -> String {
    let named = text.rsplit('=').next().unwrap_or_default();
    named.chars().filter(|c| !c.is_whitespace()).collect()
}

/// The letters with which the name of a group, or of a product of groups, begins.
const LONGEST_HEAD: usize = 4;

/// Whether a text is the name of a family, or `G/H` where both sides look like groups. The name of
/// a group begins with up to four letters, and the first letter is a capital.
pub(super) fn has_form(text: &str) -> bool {
    let named = &compact(text);
    let is_group = |text: &str| {
        let text = text.strip_prefix("S(").unwrap_or(text);
        let head = text.find(|c: char| !c.is_ascii_alphabetic()).unwrap_or(text.len());
        let next = text[head..].chars().next();
        (1..=LONGEST_HEAD).contains(&head)
            && text.starts_with(|c: char| c.is_ascii_uppercase())
            && next.is_none_or(|c| c.is_ascii_digit() || "(^".contains(c))
    };
    let mut sides = named.split('/');
    match (sides.next(), sides.next(), sides.next()) {
        (Some(_), None, _) => family(named).is_some(),
        (Some(group), Some(isotropy), None) => {
            let factors = group.split(['x', '*']).chain(isotropy.split(['x', '*']));
            let numbered = named.contains(|c: char| c.is_ascii_digit());
            numbered && factors.into_iter().all(is_group)
        }
        _ => false,
    }
}

/// The fault of a name that has the form of a family, but numbers of no space, such as `dS^1`.
pub(super) fn fault(text: &str) -> Option<String> {
    let named = &compact(text);
    if family(named).is_some() {
        return None;
    }
    if named.starts_with("T^{") {
        let wanted = "two whole numbers p and q of moderate size, not both zero";
        return Some(format!("T^{{p,q}} needs {wanted}"));
    }
    let (head, n) = named.split_once('^')?;
    let least = match head {
        "S" | "H" | "dS" | "AdS" => 2,
        "CP" | "CH" | "HP" | "HH" => 1,
        "OP" => return Some("OP^n exists for n = 2 only".into()),
        _ => return None,
    };
    let is_number = !n.is_empty() && n.chars().all(|c| c.is_ascii_digit());
    is_number.then(|| format!("{head}^n needs a number n from {least} to {MAX_SIZE}"))
}

/// A name of a family, such as `S^5` or `Gr(2,C^4)`.
fn family(text: &str) -> Option<Name> {
    let of = |group, isotropy: &[Factor], special| {
        Some(Name { group: vec![group], isotropy: isotropy.to_vec(), special })
    };
    use Factor::{IndefiniteOrthogonal, IndefiniteSymplectic, IndefiniteUnitary, Orthogonal};
    use Factor::{SpecialUnitary, Symplectic, Torus, Unitary};
    if let Some(weights) = text.strip_prefix("T^{").and_then(|rest| rest.strip_suffix('}')) {
        let (p, q) = weights.split_once(',')?;
        let circle = circle(q.parse().ok()?, p.parse::<i64>().ok()?.checked_neg()?)?;
        let group = vec![SpecialUnitary(2); 2];
        return Some(Name { group, isotropy: vec![circle], special: false });
    }
    if let Some((head, n)) = text.split_once('^').filter(|(head, _)| !head.contains('(')) {
        let n: usize = n.parse().ok().filter(|n| (1..=MAX_SIZE).contains(n))?;
        return match head {
            "S" if n >= 2 => of(Orthogonal(n + 1), &[Orthogonal(n)], false),
            "H" if n >= 2 => of(IndefiniteOrthogonal(n, 1), &[Orthogonal(n)], false),
            "dS" if n >= 2 => {
                of(IndefiniteOrthogonal(n, 1), &[IndefiniteOrthogonal(n - 1, 1)], false)
            }
            "AdS" if n >= 2 => {
                of(IndefiniteOrthogonal(n - 1, 2), &[IndefiniteOrthogonal(n - 1, 1)], false)
            }
            "CP" => of(SpecialUnitary(n + 1), &[Unitary(n), Unitary(1)], true),
            "CH" => of(IndefiniteUnitary(n, 1), &[Unitary(n), Unitary(1)], true),
            "HP" => of(Symplectic(n + 1), &[Symplectic(n), Symplectic(1)], false),
            "HH" => of(IndefiniteSymplectic(n, 1), &[Symplectic(n), Symplectic(1)], false),
            "OP" if n == 2 => of(Factor::Exceptional("F4"), &[Orthogonal(9)], false),
            _ => None,
        };
    }
    let (head, arguments) = text.strip_suffix(')')?.split_once('(')?;
    if head == "Fl" {
        let n: usize = arguments.parse().ok().filter(|n| (2..=MAX_SIZE).contains(n))?;
        return of(SpecialUnitary(n), &[Torus], false);
    }
    let (k, space) = arguments.split_once(',')?;
    let (field, n) = space.split_once('^')?;
    let n: usize = n.parse().ok().filter(|n| (2..=MAX_SIZE).contains(n))?;
    let k: usize = k.parse().ok().filter(|k| (1..n).contains(k))?;
    let rest = n - k;
    match (head, field) {
        ("V", "R") if rest >= 2 => of(Orthogonal(n), &[Orthogonal(rest)], false),
        ("V", "C") if rest >= 2 => of(SpecialUnitary(n), &[SpecialUnitary(rest)], false),
        ("V", "H") => of(Symplectic(n), &[Symplectic(rest)], false),
        ("Gr", "R") => {
            let factors: Vec<_> =
                [k, rest].into_iter().filter(|n| *n >= 2).map(Orthogonal).collect();
            of(Orthogonal(n), &factors, false)
        }
        ("Gr", "C") => of(SpecialUnitary(n), &[Unitary(k), Unitary(rest)], true),
        ("Gr", "H") => of(Symplectic(n), &[Symplectic(k), Symplectic(rest)], false),
        _ => None,
    }
}

/// The largest size of a matrix group; larger groups exceed the dimensions of the catalogue.
const MAX_SIZE: usize = 40;

/// The factors of a product, separated by `x`.
fn factors(text: &str) -> Option<Vec<Factor>> {
    text.split(['x', '*']).map(factor).collect()
}

/// A circle with two weights of moderate size, which are not both zero.
fn circle(k: i64, l: i64) -> Option<Factor> {
    let moderate = [k, l].iter().all(|weight| weight.unsigned_abs() <= 1_000_000);
    (moderate && (k, l) != (0, 0)).then_some(Factor::Circle(k, l))
}

fn factor(text: &str) -> Option<Factor> {
    if let Some(name) = EXCEPTIONAL.iter().find(|name| **name == text) {
        return Some(Factor::Exceptional(name));
    }
    if text == "T" || text.strip_prefix("T^").is_some_and(|n| n.parse::<usize>().is_ok()) {
        return Some(Factor::Torus);
    }
    if let Some(weights) = text.strip_prefix("U(1)_") {
        let weights = weights.trim_matches(['{', '}']);
        let (k, l) = weights.split_once(',')?;
        return circle(k.parse().ok()?, l.parse().ok()?);
    }
    if text == "SO(3)_irr" {
        return Some(Factor::Irreducible);
    }
    if let Some((head, root)) = text.split_once('_') {
        let torus = ["SU(2)", "U(2)"].iter().position(|name| *name == head)? == 1;
        let long = ["short", "long"].iter().position(|name| *name == root)? == 1;
        return Some(Factor::OfRoot { torus, long });
    }
    let at = text.find(|c: char| !c.is_ascii_alphabetic())?;
    let (head, arguments) = text.split_at(at);
    let arguments = match arguments.strip_prefix('(') {
        Some(rest) => rest.strip_suffix(')')?,
        None => arguments,
    };
    let mut arguments: Vec<&str> = arguments.split(',').collect();
    if head == "SL" && arguments.len() == 2 && arguments[1] == "R" {
        arguments.pop();
    }
    let numbers: Option<Vec<usize>> = arguments.iter().map(|text| text.parse().ok()).collect();
    let numbers = numbers?;
    if numbers.iter().any(|n| *n == 0 || *n > MAX_SIZE) {
        return None;
    }
    Some(match (head, numbers.as_slice()) {
        ("SO" | "O" | "Spin", [n]) if *n >= 2 => Factor::Orthogonal(*n),
        ("SO" | "O" | "Spin", [p, q]) => Factor::IndefiniteOrthogonal(*p, *q),
        ("SU", [n]) if *n >= 2 => Factor::SpecialUnitary(*n),
        ("SU", [p, q]) => Factor::IndefiniteUnitary(*p, *q),
        ("U", [n]) => Factor::Unitary(*n),
        ("Sp", [n]) => Factor::Symplectic(*n),
        ("Sp", [p, q]) => Factor::IndefiniteSymplectic(*p, *q),
        ("SL", [n]) if *n >= 2 => Factor::SpecialLinear(*n),
        ("SE", [n]) if *n >= 2 => Factor::Motions(*n),
        _ => return None,
    })
}

impl Factor {
    /// The name of its Lie algebra in the catalogue.
    pub fn algebra(self) -> String {
        match self {
            Factor::Orthogonal(n) => format!("so({n})"),
            Factor::IndefiniteOrthogonal(p, q) => format!("so({p},{q})"),
            Factor::SpecialUnitary(n) => format!("su({n})"),
            Factor::IndefiniteUnitary(p, q) => format!("su({p},{q})"),
            Factor::Unitary(n) => format!("u({n})"),
            Factor::Symplectic(n) => format!("usp({})", 2 * n),
            Factor::SpecialLinear(n) => format!("sl({n})"),
            Factor::Motions(n) => format!("se({n})"),
            Factor::IndefiniteSymplectic(p, q) => format!("sp({p},{q})"),
            Factor::Torus | Factor::Circle(..) => "R^1".into(),
            Factor::OfSpinor => "so(7)".into(),
            Factor::Irreducible => "so(3)".into(),
            Factor::OfRoot { torus: false, .. } => "su(2)".into(),
            Factor::OfRoot { torus: true, .. } => "u(2)".into(),
            Factor::Exceptional(name) => format!("compact({name})"),
        }
    }
}

impl fmt::Display for Factor {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Factor::Orthogonal(n) => write!(f, "SO({n})"),
            Factor::IndefiniteOrthogonal(p, q) => write!(f, "SO({p},{q})"),
            Factor::SpecialUnitary(n) => write!(f, "SU({n})"),
            Factor::IndefiniteUnitary(p, q) => write!(f, "SU({p},{q})"),
            Factor::Unitary(n) => write!(f, "U({n})"),
            Factor::Symplectic(n) => write!(f, "Sp({n})"),
            Factor::SpecialLinear(n) => write!(f, "SL({n},R)"),
            Factor::Motions(n) => write!(f, "SE({n})"),
            Factor::Torus => write!(f, "T"),
            Factor::IndefiniteSymplectic(p, q) => write!(f, "Sp({p},{q})"),
            Factor::Circle(k, l) => write!(f, "U(1)_{{{k},{l}}}"),
            Factor::OfSpinor => write!(f, "Spin(7)"),
            Factor::Irreducible => write!(f, "SO(3)_irr"),
            Factor::OfRoot { torus, long } => {
                let group = if *torus { "U(2)" } else { "SU(2)" };
                write!(f, "{group}_{}", if *long { "long" } else { "short" })
            }
            Factor::Exceptional(name) => write!(f, "{name}"),
        }
    }
}

impl fmt::Display for Name {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let joined = |factors: &[Factor]| {
            factors.iter().map(Factor::to_string).collect::<Vec<_>>().join("x")
        };
        let isotropy = joined(&self.isotropy);
        let isotropy = if self.special { format!("S({isotropy})") } else { isotropy };
        write!(f, "{}/{isotropy}", joined(&self.group))
    }
}
