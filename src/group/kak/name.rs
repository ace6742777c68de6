//! Names of symmetric pairs, such as `SU(4)/SO(4)` and `Sp(4,R)`.

use super::pair::{Field, Kind, SymmetricPair};
use crate::Error;
use std::fmt;
use std::str::FromStr;

/// A factor of a name, such as `Sp(2)`: its letters and its arguments.
fn factor(text: &str) -> Option<(&str, Vec<&str>)> {
    let (letters, rest) = text.split_once('(')?;
    Some((letters, rest.strip_suffix(')')?.split(',').collect()))
}

/// The number of a factor with one argument, such as 3 of `O(3)`.
fn number(text: &str, letters: &str) -> Option<usize> {
    let (found, arguments) = factor(text)?;
    match &arguments[..] {
        [one] if found == letters => one.parse().ok(),
        _ => None,
    }
}

/// The numbers of a product, such as 3 and 2 of `O(3)xO(2)`.
fn numbers(text: &str, letters: &str) -> Option<[usize; 2]> {
    let (a, b) = text.split_once('x')?;
    Some([number(a, letters)?, number(b, letters)?])
}

/// The largest size of matrices.
const MAX_SIZE: usize = 512;

fn read(text: &str) -> Option<SymmetricPair> {
    use Field::{Complex, Quaternion, Real};
    let Some((group, isotropy)) = text.split_once('/') else {
        let (letters, arguments) = factor(text)?;
        let [a, b] = arguments[..] else { return None };
        let is_special = letters.starts_with('S') && letters != "Sp";
        if letters == "Sp" && b == "R" {
            let size: usize = a.parse().ok().filter(|size| size % 2 == 0)?;
            return Some(SymmetricPair {
                kind: Kind::RealSymplectic,
                counts: [size / 2, 0],
                is_special,
            });
        }
        let (kind, counts) = if let "GL" | "SL" = letters {
            let field = match b {
                "R" => Real,
                "C" => Complex,
                "H" => Quaternion,
                _ => return None,
            };
            (Kind::Linear(field), [a.parse().ok()?, 0])
        } else {
            let field = match letters {
                "O" | "SO" => Real,
                "U" | "SU" => Complex,
                "Sp" => Quaternion,
                _ => return None,
            };
            (Kind::Indefinite(field), [a.parse().ok()?, b.parse().ok()?])
        };
        return Some(SymmetricPair { kind, counts, is_special });
    };
    let (letters, arguments) = factor(group)?;
    let [n] = arguments[..] else { return None };
    let n: usize = n.parse().ok()?;
    let special = isotropy.strip_prefix("S(").and_then(|rest| rest.strip_suffix(')'));
    let blocks = |letters| numbers(isotropy, letters);
    let special_blocks = |letters| special.and_then(|text| numbers(text, letters));
    let (kind, counts, size) = match letters {
        "U" | "SU" => {
            let orthogonal = if letters == "U" { "O" } else { "SO" };
            let grading = if letters == "U" { blocks("U") } else { special_blocks("U") };
            if let Some(m) = number(isotropy, orthogonal) {
                (Kind::Conjugation(Real), [m, 0], m)
            } else if let Some(m) = number(isotropy, "Sp") {
                (Kind::Conjugation(Quaternion), [m, 0], m.checked_mul(2)?)
            } else {
                let [p, q] = grading?;
                (Kind::Grading(Complex), [p, q], p.checked_add(q)?)
            }
        }
        "O" | "SO" => {
            let grading = if letters == "O" { blocks("O") } else { special_blocks("O") };
            match number(isotropy, "U").filter(|_| letters == "SO") {
                Some(m) => (Kind::ComplexStructure(Real), [m, 0], m.checked_mul(2)?),
                None => {
                    let [p, q] = grading?;
                    (Kind::Grading(Real), [p, q], p.checked_add(q)?)
                }
            }
        }
        "Sp" => match number(isotropy, "U") {
            Some(m) => (Kind::ComplexStructure(Quaternion), [m, 0], m),
            None => {
                let [p, q] = blocks("Sp")?;
                (Kind::Grading(Quaternion), [p, q], p.checked_add(q)?)
            }
        },
        _ => return None,
    };
    let is_special = matches!(letters, "SU" | "SO");
    (size == n).then_some(SymmetricPair { kind, counts, is_special })
}

impl FromStr for SymmetricPair {
    type Err = Error;

    fn from_str(text: &str) -> Result<Self, Error> {
        let name: String = text.split_whitespace().collect();
        let found = read(&name).filter(|pair| {
            let [p, q] = pair.counts;
            p.max(q) <= MAX_SIZE && (1..=MAX_SIZE).contains(&pair.size())
        });
        found.ok_or_else(|| {
            Error::Name(format!(
                "`{text}` is not the name of a symmetric pair with at most {MAX_SIZE} rows. Write a \
                 compact pair such as SU(4)/SO(4), or a noncompact group such as SL(3,R)"
            ))
        })
    }
}

impl fmt::Display for SymmetricPair {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [p, q] = self.counts;
        let n = p + q;
        let special = if self.is_special { "S" } else { "" };
        let letters = |field: Field| match field {
            Field::Real => "O",
            Field::Complex => "U",
            Field::Quaternion => "Sp",
        };
        match self.kind {
            Kind::Conjugation(Field::Quaternion) => write!(f, "{special}U({})/Sp({n})", 2 * n),
            Kind::Conjugation(_) => write!(f, "{special}U({n})/{special}O({n})"),
            Kind::Grading(field) => {
                let (letters, open, end) = (
                    letters(field),
                    if self.is_special { "S(" } else { "" },
                    if self.is_special { ")" } else { "" },
                );
                write!(f, "{special}{letters}({n})/{open}{letters}({p})x{letters}({q}){end}")
            }
            Kind::ComplexStructure(Field::Real) => write!(f, "SO({})/U({n})", 2 * n),
            Kind::ComplexStructure(_) => write!(f, "Sp({n})/U({n})"),
            Kind::Linear(field) => {
                let letter = match field {
                    Field::Real => "R",
                    Field::Complex => "C",
                    Field::Quaternion => "H",
                };
                write!(f, "{}L({n},{letter})", if self.is_special { "S" } else { "G" })
            }
            Kind::Indefinite(field) => write!(f, "{special}{}({p},{q})", letters(field)),
            Kind::RealSymplectic => write!(f, "Sp({},R)", 2 * n),
        }
    }
}
