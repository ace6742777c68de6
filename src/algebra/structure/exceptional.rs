//! Values of a parameter at which an answer may differ from the answer for generic values.
//!
//! Generic answers follow from ranks of matrices over rational functions. An elimination is valid
//! for every value at which no numerator or denominator of a pivot vanishes. The roots of these
//! polynomials therefore include all exceptional values.

use super::StructureTheory;
use super::subspace::collected;
use crate::algebra::cochains::{differential, sets};
use crate::algebra::irreducible_factors;
use affinor_tensors::linear::{Matrix, Row};
use affinor_tensors::scalar::divisors_of;
use affinor_tensors::{Rational, Ring, Symbolic};
use num_rational::BigRational;
use num_traits::Zero;
use polycore::Uni;
use std::collections::BTreeMap;

/// The largest dimension at which ranks are computed over rational functions to find exceptional
/// values. Generic answers need only ranks modulo primes.
pub const MAX_DIMENSION: usize = 6;
/// The largest degree of a polynomial that is factored.
const MAX_DEGREE: usize = 60;

/// Candidates for exceptional values of a parameter.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Candidates {
    /// The rational roots of the polynomials, in increasing order.
    pub values: Vec<Rational>,
    /// Irreducible polynomials with irrational real roots, and expressions whose roots are unknown.
    pub open: Vec<String>,
}

impl Candidates {
    /// Finds the roots of numerators and denominators of values that are functions of a parameter.
    /// If a polynomial contains other variables, the common roots of its coefficients are used.
    pub fn new(parameter: &str, values: &[Symbolic]) -> Self {
        let mut found = Candidates::default();
        for part in values.iter().flat_map(|value| [value.numerator(), value.denominator()]) {
            match common_factor(parameter, &part) {
                Some(polynomial) if polynomial.deg() <= MAX_DEGREE => {
                    found.add(parameter, &polynomial);
                }
                _ => found.open.push(part.to_string()),
            }
        }
        found.values.sort_by(|a, b| BigRational::from(a).cmp(&BigRational::from(b)));
        found.values.dedup();
        found.open.sort();
        found.open.dedup();
        found
    }

    fn add(&mut self, parameter: &str, polynomial: &Uni<BigRational>) {
        if polynomial.deg() == 0 {
            return;
        }
        for (factor, _) in irreducible_factors(polynomial) {
            if factor.deg() == 1 {
                self.values.push(-Rational::from(&factor.0[0] / &factor.0[1]));
            } else if !factor.isolate().is_empty() {
                let h = Symbolic::parameter(parameter);
                let written = factor.0.iter().rev().fold(Symbolic::zero(), |sum, coefficient| {
                    sum * &h + &Symbolic::constant(Rational::from(coefficient.clone()))
                });
                self.open.push(written.numerator().to_string());
            }
        }
    }
}

/// The greatest common divisor of the coefficients of `polynomial`, which is regarded as a
/// polynomial in the other variables. Returns `None` if a variable is a function of the parameter.
fn common_factor(parameter: &str, polynomial: &Symbolic) -> Option<Uni<BigRational>> {
    let mut coefficients: BTreeMap<String, BTreeMap<usize, Rational>> = BTreeMap::new();
    for (powers, coefficient) in polynomial.terms() {
        let (mut degree, mut others) = (0, String::new());
        for (variable, power) in powers {
            if variable.text() == parameter {
                degree = power as usize;
            } else if Symbolic::variable(variable).parameters().iter().any(|own| own == parameter) {
                return None;
            } else {
                others += &format!("{}^{power} ", variable.text());
            }
        }
        coefficients.entry(others).or_default().insert(degree, coefficient);
    }
    let polynomials = coefficients.into_values().map(|terms| {
        let degree = terms.keys().last().copied().unwrap_or(0);
        let value = |at| terms.get(&at).map_or_else(BigRational::zero, BigRational::from);
        Uni::new((0..=degree).map(value).collect())
    });
    polynomials.reduce(|a, b| a.gcd(&b))
}

impl StructureTheory<Symbolic> {
    /// The expressions whose zeros may change an answer; at generic values, the answers are
    /// computed modulo primes. The expressions are the traces of `ad`, and the pivots of several
    /// systems of equations. These systems are for derivations, invariant forms, closed forms of
    /// all degrees, the general forms `f([x, y])`, the same forms bordered by `f`, and the general
    /// closed 2-form. Beyond [`MAX_DIMENSION`], only the traces are returned.
    pub fn deciding_expressions(&self) -> Vec<Symbolic> {
        let n = self.dimension();
        let trace = |j: usize| {
            let diagonal = self.products.of(j).iter().filter(|(k, i, _)| k == i);
            diagonal.fold(Symbolic::zero(), |sum, (.., value)| sum + value)
        };
        let mut found: Vec<Symbolic> = (0..n).map(trace).filter(|v| !v.vanishes()).collect();
        if n <= MAX_DIMENSION {
            found.extend(divisors_of(|| self.eliminate()).1);
        }
        found
    }

    /// Eliminates the systems of equations, so that their pivots are recorded.
    fn eliminate(&self) {
        let n = self.dimension();
        let rank = |columns: usize, rows: Vec<Row<Symbolic>>| {
            let rows = rows.into_iter().map(collected).filter(|row| !row.is_empty());
            // the rank is not needed, because the elimination records its pivots; errors of shape
            // cannot occur
            Matrix::from_rows(columns, rows.collect::<Vec<_>>()).map(|matrix| matrix.rank()).ok();
        };
        let mut maps = vec![];
        let mut forms = vec![];
        let pair = |a: usize, b: usize| a.min(b) * n + a.max(b);
        for (j, k) in (0..n).flat_map(|j| (0..n).map(move |k| (j, k))) {
            let ad = self.products.of(j);
            let of = |at: usize| ad.iter().filter(move |(to, ..)| *to == at);
            for i in 0..n {
                // the terms of component i of D [e_j, e_k] - [D e_j, e_k] - [e_j, D e_k]
                let first = of(k).map(|(_, m, c)| (i * n + m, c.clone()));
                let second = self.products.of(k).iter().filter(|(_, to, _)| *to == i);
                let second = second.map(|(m, _, c)| (m * n + j, c.clone()));
                let third = ad.iter().filter(|(_, to, _)| *to == i);
                let third = third.map(|(m, _, c)| (m * n + k, -c.clone()));
                maps.push(first.chain(second).chain(third).collect());
                // the terms of B([e_j, e_k], e_i) + B(e_k, [e_j, e_i])
                let left = of(k).map(|(_, m, c)| (pair(*m, i), c.clone()));
                let right = of(i).map(|(_, m, c)| (pair(k, *m), c.clone()));
                forms.push(left.chain(right).collect());
            }
        }
        rank(n * n, maps);
        rank(n * n, forms);
        for degree in 1..n {
            let row = |set| {
                let terms = differential(n, |j| self.products.of(j), |_| &[], set, 0).into_iter();
                terms
                    .map(|(to, _, minus, c)| {
                        (to as usize, if minus { -c.clone() } else { c.clone() })
                    })
                    .collect()
            };
            rank(1 << n, sets(n, degree).into_iter().map(row).collect());
        }
        // the parameters of general forms begin with a space, so they differ from all parameters of
        // the algebra
        let general = |rows: &[Row<Symbolic>]| {
            let mut general = vec![vec![]; n + 1];
            for (at, row) in rows.iter().enumerate() {
                let t = Symbolic::parameter(&format!(" t{at}"));
                for (place, value) in row {
                    let (i, j, value) = (place / n, place % n, value.clone() * &t);
                    general[i].push((j, value.clone()));
                    general[j].push((i, -value));
                }
            }
            general
        };
        let unit = |i: usize| self.differential(&[(i, Symbolic::from_i64(1))]);
        let mut exact = general(&(0..n).map(unit).collect::<Vec<_>>());
        rank(n + 1, exact.clone());
        for i in 0..n {
            let t = Symbolic::parameter(&format!(" t{i}"));
            exact[i].push((n, -t.clone()));
            exact[n].push((i, t));
        }
        rank(n + 1, exact);
        if let Some(forms) = self.two_forms() {
            rank(n + 1, general(forms.closed.basis()));
        }
    }
}
