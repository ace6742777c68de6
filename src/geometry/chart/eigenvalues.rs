//! Eigenvalues that are linear forms of the coordinates.
//!
//! Let the matrix `M(x)` be linear in `x`, and let its eigenvalues be forms `a(x) + ib(x)` with
//! integer coefficients. Then the coefficients of `x^c` are an eigenvalue of `M(e_c)`. Therefore,
//! the forms are found one coordinate after the other, as roots of the minimal polynomial of `M` at
//! generic points. The caller must prove that the polynomial annihilates `M` everywhere.

use crate::{Error, Law};
use affinor_tensors::linear::Matrix;
use affinor_tensors::text::combination;
use affinor_tensors::{Ring, Symbolic};
use num_traits::{One, Zero};

/// The largest absolute value of a coefficient of a form.
const LARGEST: i64 = 12;

/// The largest degree of a minimal polynomial.
const DEGREE: usize = 100;

/// The largest number of matrix entries. A larger matrix, such as the matrix of E8, would take
/// hours.
const ENTRIES: usize = 1000;

/// An eigenvalue `a(x) + ib(x)`, with its multiplicity in the minimal polynomial. One value
/// represents a conjugate pair.
#[derive(Clone, Debug)]
pub(super) struct Eigenvalue {
    /// The coefficients of `a` and `b`.
    form: Vec<[i64; 2]>,
    pub(super) multiplicity: usize,
}

impl Eigenvalue {
    /// The simple eigenvalue zero, for `n` coordinates.
    pub(super) fn zero(n: usize) -> Self {
        Eigenvalue { form: vec![[0, 0]; n], multiplicity: 1 }
    }

    pub(super) fn is_zero(&self) -> bool {
        self.form.iter().all(|part| *part == [0, 0])
    }

    /// The eigenvalue of `-M`.
    #[must_use]
    pub(super) fn opposite(mut self) -> Self {
        self.form.iter_mut().for_each(|[a, b]| (*a, *b) = (-*a, -*b));
        self
    }

    /// The values of `a(x)` and `b(x)`.
    pub(super) fn at(&self, x: &[Symbolic]) -> [Symbolic; 2] {
        [0, 1].map(|part| {
            let terms = self.form.iter().zip(x).filter(|(c, _)| c[part] != 0);
            terms.fold(Symbolic::zero(), |sum, (c, x)| {
                sum + &(x.clone() * &Symbolic::from_i64(c[part]))
            })
        })
    }

    /// The real factor of the minimal polynomial for this eigenvalue, `z - a` or `(z - a)^2 + b^2`.
    /// The coefficients begin with the constant.
    pub(super) fn factor(&self, x: &[Symbolic]) -> Vec<Symbolic> {
        let [a, b] = self.at(x);
        match b.vanishes() {
            true => vec![-a, Symbolic::one()],
            false => {
                let constant = a.clone() * &a + &(b.clone() * &b);
                vec![constant, a * &Symbolic::from_i64(-2), Symbolic::one()]
            }
        }
    }
}

/// The eigenvalues of a matrix that is linear in the coordinates. The matrix is the `ad` of a
/// combination of vectors with the names `labels`.
pub(super) fn eigenvalues(
    m: &Matrix<Symbolic>,
    coordinates: &[String],
    labels: &[String],
) -> Result<Vec<Eigenvalue>, Error> {
    let size = m.entries().count();
    if size > ENTRIES {
        return Err(Error::Size { what: "entries of ad_x", size, limit: ENTRIES });
    }
    let split = |point: &[i64], candidates: Vec<Vec<[i64; 2]>>| {
        let vanishing = coordinates.iter().map(|name| (name.clone(), Symbolic::zero()));
        let mut values: std::collections::BTreeMap<_, _> = vanishing.collect();
        let point: Vec<Symbolic> = point.iter().map(|k| Symbolic::from_i64(*k)).collect();
        values.extend(coordinates.iter().cloned().zip(point.iter().cloned()));
        let here = m.map(|value| value.substitute(&values).expect("linear in the coordinates"));
        let minimal = minimal(&here)?;
        let mut rest = minimal.clone();
        let mut found = Vec::new();
        for form in candidates {
            let mut root = Eigenvalue { form, multiplicity: 0 };
            let factor = root.factor(&point);
            while let Some(quotient) = divided(&rest, &factor) {
                (rest, root.multiplicity) = (quotient, root.multiplicity + 1);
            }
            if root.multiplicity > 0 {
                found.push(root);
            }
        }
        if rest.len() > 1 {
            let vector = point.into_iter().zip(labels.iter().cloned());
            let vector = combination(vector.filter(|(k, _)| !k.vanishes()));
            return Err(refusal(&vector, &minimal));
        }
        Ok(found)
    };
    let mut found = Vec::new();
    for (c, k) in without_pattern().take(coordinates.len()).enumerate() {
        let grid = (0..=LARGEST).flat_map(|b| (-LARGEST..=LARGEST).map(move |a| [a, b]));
        let unit: Vec<i64> = (0..=c).map(|d| i64::from(d == c)).collect();
        let alone = grid.map(|step| [vec![[0, 0]; c], vec![step]].concat()).collect();
        let steps: Vec<[i64; 2]> = split(&unit, alone)?.iter().map(|root| root.form[c]).collect();
        let steps = steps.iter().flat_map(|[a, b]| [[*a, *b], [*a, -b]]);
        let mut steps: Vec<_> = steps.collect();
        steps.dedup();
        let before = match c {
            0 => vec![vec![]],
            _ => found.into_iter().map(|root: Eigenvalue| root.form).collect(),
        };
        let candidates = before.iter().flat_map(|form| {
            steps.iter().map(move |step| form.iter().copied().chain([*step]).collect())
        });
        let point: Vec<i64> = without_pattern().take(c).chain([k]).collect();
        found = split(&point, candidates.collect())?;
    }
    Ok(found)
}

/// The error if the roots of the minimal polynomial of `ad_vector` are not linear forms with
/// integer coefficients.
pub(super) fn refusal(vector: &str, polynomial: &[Symbolic]) -> Error {
    let terms = polynomial.iter().enumerate().rev().map(|(j, a)| match j {
        0 => (a.clone(), "1".to_string()),
        _ => (a.clone(), format!("z^{j}")),
    });
    let polynomial = combination(terms.filter(|(a, _)| !a.vanishes()));
    let x = if vector.contains(' ') { format!("({vector})") } else { vector.into() };
    Law::Eigenvalues.broken([x], polynomial)
}

/// A sequence of integers without small linear or quadratic relations: 1, 102, 10303, 40601, ...
fn without_pattern() -> impl Iterator<Item = i64> {
    std::iter::successors(Some(1), |k| Some((101 * k + 1) % 1_000_003))
}

/// The minimal polynomial, whose coefficients begin with the constant. It is the least common
/// multiple of the annihilating polynomials of the basis vectors.
fn minimal(m: &Matrix<Symbolic>) -> Result<Vec<Symbolic>, Error> {
    let image = |v: &[Symbolic]| m.apply(v).expect("a square matrix");
    let mut minimal = vec![Symbolic::one()];
    for i in 0..m.rows() {
        let unit: Vec<_> = (0..m.rows()).map(|j| Symbolic::from_i64(i64::from(i == j))).collect();
        // applies the least common multiple of the previous polynomials to the vector, by Horner's
        // rule
        let rest = minimal.iter().rev().fold(vec![Symbolic::zero(); m.rows()], |sum, c| {
            let terms = image(&sum).into_iter().zip(&unit);
            terms.map(|(value, e)| value + &(e.clone() * c)).collect()
        });
        let mut powers: Vec<Vec<Symbolic>> = Vec::new();
        let mut next = rest;
        let relation = loop {
            if minimal.len() + powers.len() > DEGREE + 1 {
                let what = "eigenvalues of ad_x";
                return Err(Error::Size { what, size: m.rows(), limit: DEGREE });
            }
            let columns = match powers.is_empty() {
                true => Matrix::zero(m.rows(), 0),
                false => Matrix::from_dense(&powers).expect("vectors of one size").transpose(),
            };
            if let Some(relation) = columns.solve(&next)? {
                break relation;
            }
            let image = image(&next);
            powers.push(std::mem::replace(&mut next, image));
        };
        let own: Vec<_> = relation.into_iter().map(|a| -a).chain([Symbolic::one()]).collect();
        minimal = multiplied(&minimal, &own);
    }
    Ok(minimal)
}

/// The product of two polynomials. Coefficients begin with the constant.
pub(super) fn multiplied(p: &[Symbolic], q: &[Symbolic]) -> Vec<Symbolic> {
    let mut product = vec![Symbolic::zero(); (p.len() + q.len()).saturating_sub(1)];
    for (i, a) in p.iter().enumerate() {
        for (j, b) in q.iter().enumerate() {
            product[i + j] = product[i + j].clone() + &(a.clone() * b);
        }
    }
    product
}

/// The quotient by a polynomial with leading coefficient 1. Coefficients begin with the constant.
/// Returns `None` if there is a remainder.
fn divided(polynomial: &[Symbolic], factor: &[Symbolic]) -> Option<Vec<Symbolic>> {
    let degree = factor.len() - 1;
    let mut rest = polynomial.to_vec();
    let terms = polynomial.len().checked_sub(degree).filter(|terms| *terms > 0)?;
    let mut quotient = vec![Symbolic::zero(); terms];
    for at in (0..terms).rev() {
        let leading = rest[at + degree].clone();
        for (k, c) in factor.iter().enumerate() {
            rest[at + k] = rest[at + k].clone() - &(leading.clone() * c);
        }
        quotient[at] = leading;
    }
    rest.iter().all(Ring::vanishes).then_some(quotient)
}
