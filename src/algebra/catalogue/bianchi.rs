//! The three-dimensional algebras in Bianchi's list.
//!
//! A bracket in three dimensions is given by a symmetric matrix and a vector,
//! `c^i_jk = eps_jkl n^li + delta^i_k a_j - delta^i_j a_k`, and the Jacobi identity is
//! `n^ij a_j = 0`. If `a` is along e3, the types are:
//!
//! | type | n^11 | n^22 | n^33 | n^12 | a_3 | bracket |
//! |---|---|---|---|---|---|---|
//! | I | 0 | 0 | 0 | 0 | 0 | abelian |
//! | II | 1 | 0 | 0 | 0 | 0 | `[e2,e3] = e1` |
//! | III | 0 | 0 | 0 | -1/2 | -1/2 | `[e1,e3] = e1` |
//! | IV | 1 | 0 | 0 | 0 | -1 | `[e1,e3] = e1`, `[e2,e3] = e1 + e2` |
//! | V | 0 | 0 | 0 | 0 | -1 | `[e1,e3] = e1`, `[e2,e3] = e2` |
//! | VI | 0 | 0 | 0 | (h-1)/2 | -(1+h)/2 | `[e1,e3] = e1`, `[e2,e3] = h e2` |
//! | VII | 1 | 1 | 0 | 0 | -h | `[e1,e3] = h e1 - e2`, `[e2,e3] = e1 + h e2` |
//! | VIII | 1 | 1 | -1 | 0 | 0 | `[e2,e3] = e1`, `[e3,e1] = e2`, `[e1,e2] = -e3` |
//! | IX | 1 | 1 | 1 | 0 | 0 | `[e2,e3] = e1`, `[e3,e1] = e2`, `[e1,e2] = e3` |
//!
//! G. F. R. Ellis and M. A. H. MacCallum, *Commun. Math. Phys.* 12 (1969) 108-141; L. D. Landau and
//! E. M. Lifshitz, *The Classical Theory of Fields*, section 116. They diagonalize `n`, take `a`
//! along the first axis, and choose the parameter `h_EM = a^2 / (n^2 n^3)`, with which the brackets
//! contain square roots. Here, the brackets are rational in `h`. In type VI, `h` is the ratio of
//! the two eigenvalues, `h_EM = -((1+h)/(1-h))^2`. In type VII, `h` is the ratio of the real to the
//! imaginary part of the eigenvalues, `h_EM = h^2`.
//!
//! Therefore type VI_0 of the literature has `h = -1`, and type VII_0 has `h = 0`. In type VI, `h`
//! and `1/h` give the same algebra; `h = 0` gives type III (`h_EM = -1`), and `h = 1` gives type V.

use super::name::{Argument, rule};
use super::{CatalogueError, Entry, Family, Reader, numbered};
use affinor_tensors::expression::{Expression, ExpressionError, Scalars, no_function};
use affinor_tensors::{Notation, Ring, Symbolic};

/// Bianchi's types.
pub(super) const FAMILY: Family = Family {
    pattern: "bianchi(TYPE,h=v)",
    needs: "a TYPE from I to IX in capitals, and `h=v` in VI and VII only",
    summary: "three dimensions, basis e1,e2,e3; VI: [e1,e3] = e1, [e2,e3] = h*e2 (VI_0 is h=-1, \
              III is h=0); VII: [e1,e3] = h*e1 - e2, [e2,e3] = e1 + h*e2; h is a parameter if not given",
    example: "bianchi(IX)",
    reader: Reader::Words(read),
};

fn read(name: &str, arguments: &[Argument]) -> Result<Entry, CatalogueError> {
    let refused = || {
        let name = name.trim().to_string();
        Err(CatalogueError::NoSuchAlgebra { name, rule: rule(&[&FAMILY]) })
    };
    let (kind, given) = match arguments {
        [kind] => (kind.text, None),
        [kind @ Argument { text: "VI" | "VII", .. }, h] => match h.text.split_once('=') {
            Some((letter, value)) if letter.trim_end() == "h" => {
                let value = h.from(h.text.len() - value.len());
                (kind.text, Some(evaluate(name, value)?))
            }
            _ => return refused(),
        },
        _ => return refused(),
    };
    let full = match &given {
        Some(h) => format!("bianchi({kind},h={h})"),
        None => format!("bianchi({kind})"),
    };
    let h = given.unwrap_or_else(|| Symbolic::parameter("h"));
    let integer = Symbolic::from_i64;
    let diagonal = |n: [i64; 3], a: Symbolic| (n.map(integer), integer(0), a);
    let two_eigenvalues = |h: Symbolic| {
        let half = |value: Symbolic| value / &integer(2);
        let zeros = [0, 0, 0].map(integer);
        (zeros, half(h.clone() - &integer(1)), half(-(h + &integer(1))))
    };
    let (n, n12, a) = match kind {
        "I" => diagonal([0, 0, 0], integer(0)),
        "II" => diagonal([1, 0, 0], integer(0)),
        "III" => two_eigenvalues(integer(0)),
        "IV" => diagonal([1, 0, 0], integer(-1)),
        "V" => diagonal([0, 0, 0], integer(-1)),
        "VI" => two_eigenvalues(h),
        "VII" => diagonal([1, 1, 0], -h),
        "VIII" => diagonal([1, 1, -1], integer(0)),
        "IX" => diagonal([1, 1, 1], integer(0)),
        _ => return refused(),
    };
    Ok(Entry::new(full, numbered("e", 3), constants(n, n12, a)))
}

/// The names of all types.
pub(super) fn names() -> Vec<String> {
    let types = ["I", "II", "III", "IV", "V", "VI", "VII", "VIII", "IX"];
    types.map(|name| format!("bianchi({name})")).to_vec()
}

/// Evaluates the value of a parameter. The positions in errors refer to the whole name.
pub(super) fn evaluate(name: &str, value: Argument) -> Result<Symbolic, CatalogueError> {
    let parameter = |name: &str| Notation::parameter(name).ok_or("this is not a name".to_string());
    let result = Expression::parse(value.text)
        .and_then(|expression| expression.evaluate(&Scalars(parameter, no_function)));
    result.map_err(|ExpressionError { span, reason }| {
        let span = value.at + span.start..value.at + span.end;
        CatalogueError::Value { name: name.into(), source: ExpressionError { span, reason } }
    })
}

/// The constants `c^i_jk = eps_jkl n^li + delta^i_k a_j - delta^i_j a_k` for `j < k`. `n` is
/// diagonal except for `n^12`, and `a` is along e3.
fn constants(
    [n11, n22, n33]: [Symbolic; 3],
    n12: Symbolic,
    a3: Symbolic,
) -> impl Iterator<Item = (usize, usize, usize, Symbolic)> {
    let zero = || Symbolic::from_i64(0);
    let n = [[n11, n12.clone(), zero()], [n12, n22, zero()], [zero(), zero(), n33]];
    let a = [zero(), zero(), a3];
    let cases = [(0, 1, 2, 1), (0, 2, 1, -1), (1, 2, 0, 1)];
    cases.into_iter().flat_map(move |(j, k, l, eps)| {
        let (n, a) = (n.clone(), a.clone());
        (0..3).map(move |i| {
            let mut value = n[l][i].clone() * &Symbolic::from_i64(eps);
            if i == k {
                value += &a[j];
            }
            if i == j {
                value -= &a[k];
            }
            (j, k, i, value)
        })
    })
}
