//! Sums with common factors of their terms taken out: `a*(b + c) + d`.
//!
//! The factor is the variable that saves most letters, with all that its terms share; then the
//! same is done for the terms that have it and for the rest (a greedy Horner scheme). The part
//! with the leading term stands first, so that the sum begins with the sign of its expanded form.

use super::super::Rational;
use super::polynomial::{Polynomial, content, lowered};
use super::variables::Variables;
use num_traits::One;
use polycore::{Monomial, Order, Poly};

/// A deeper nesting is not begun. Expressions may be nested
/// [`MAX_DEPTH`](crate::expression::MAX_DEPTH) deep.
const MAX_NESTING: usize = 40;

/// `coefficient * monomial * (inner)`; without parentheses if there are no inner parts.
pub(super) struct Part {
    pub coefficient: Rational,
    pub monomial: Monomial,
    pub inner: Vec<Part>,
}

/// The parts of a nonzero sum of terms; a single term has one part.
pub(super) fn parts(sum: &Polynomial, variables: &Variables) -> Vec<Part> {
    let lengths: Vec<usize> = variables.iter().map(|name| name.len()).collect();
    let (parts, _) = collect(sum.clone(), &lengths, 0);
    parts
}

/// The parts, and the letters of their text.
fn collect(sum: Polynomial, lengths: &[usize], nesting: usize) -> (Vec<Part>, usize) {
    let expanded = |sum: &Polynomial| -> usize {
        let terms = sum.terms.iter().map(|(m, c)| SIGN + letters(c, m, lengths));
        terms.sum::<usize>().saturating_sub(SIGN)
    };
    let length = expanded(&sum);
    let split = Some(&sum).filter(|_| nesting < MAX_NESTING && sum.terms.len() > 1);
    let split = split.and_then(|sum| shared(sum, lengths));
    let Some(Shared { factor, with, without, leads }) = split else { return (single(sum), length) };
    let unit = content(&with);
    let quotient = with.scale(&(Rational::one() / &unit));
    let outside = letters(&unit, &factor, lengths);
    let (inner, inside) = collect(quotient, lengths, nesting + 1);
    let product = Part { coefficient: unit, monomial: factor, inner };
    let (rest, more) = match without.is_zero() {
        true => (Vec::new(), 0),
        false => collect(without, lengths, nesting),
    };
    let collected = outside + inside + "*()".len() + if more > 0 { SIGN + more } else { 0 };
    if collected >= length {
        return (single(sum), length);
    }
    let mut parts = vec![product];
    if leads {
        parts.extend(rest);
    } else {
        parts.splice(0..0, rest);
    }
    (parts, collected)
}

/// The letters of a sign between terms, with its spaces.
const SIGN: usize = 3;

/// The terms, each a part.
fn single(sum: Polynomial) -> Vec<Part> {
    let part = |(monomial, coefficient)| Part { coefficient, monomial, inner: Vec::new() };
    sum.terms.into_iter().map(part).collect()
}

/// The letters of a term without its sign.
fn letters(coefficient: &Rational, monomial: &Monomial, lengths: &[usize]) -> usize {
    let powers = monomial.exps().iter().zip(lengths).filter(|(e, _)| **e > 0);
    let exponent = |e: u32| if e > 1 { 2 + e.ilog10() as usize } else { 0 };
    let powers = powers.map(|(e, length)| 1 + length + exponent(*e));
    let size = coefficient.clone().abs();
    let number = if size.is_one() { 0 } else { 1 + size.to_string().len() };
    (number + powers.sum::<usize>()).saturating_sub(1).max(1)
}

/// `factor * with + without`.
struct Shared {
    factor: Monomial,
    with: Polynomial,
    without: Polynomial,
    /// Whether the leading term has the factor.
    leads: bool,
}

/// The factor to take out of the terms that have its variable.
fn shared(sum: &Polynomial, lengths: &[usize]) -> Option<Shared> {
    let count = |at: usize| sum.terms.iter().filter(|(m, _)| m.exps()[at] > 0).count();
    let gain = |at: usize| (count(at) * lengths[at], usize::MAX - at);
    let at = (0..sum.nvars).filter(|&at| count(at) > 1).max_by_key(|&at| gain(at))?;
    let (with, without): (Vec<_>, Vec<_>) =
        sum.terms.iter().cloned().partition(|(m, _)| m.exps()[at] > 0);
    let part = |terms| Poly { terms, nvars: sum.nvars, order: Order::GrLex };
    let with = part(with);
    let factor = with.min_exps();
    let leads = sum.terms[0].0.exps()[at] > 0;
    Some(Shared { with: lowered(&with, &factor), factor, without: part(without), leads })
}
