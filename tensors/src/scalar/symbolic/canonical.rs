//! The unique form of values that contain functions.
//!
//! Functions of `u/2` and of `u/3` are functions of `u/6`. Before values are combined, every
//! argument `u` is divided into parts that are common to all functions. Afterwards it is divided
//! into as few parts as the result allows. For example, `2 sin(x/2) cos(x/2)` is `sin(x)`.
//!
//! The variable `v = p^(1/n)` has the relation `v^n = p`. In the unique form, it does not occur in
//! the denominator, and its exponents in the numerator are below `n`. Irreducible polynomials and
//! primes are independent modulo powers, so their roots are independent over the rational
//! functions, and this form is unique.

use super::denominator::Denominator;
use super::fraction::{Fraction, lowest_terms};
use super::polynomial::{Polynomial, constant, content, power, product, select};
use super::variable::{Kind, Part, Variable, Variables, places};
use super::{Form, Rational, Symbolic};
use crate::linear::Matrix;
use crate::scalar::Field;
use num_integer::Integer;
use num_traits::{One, Zero};
use polycore::{Monomial, Order, Poly};
use std::collections::BTreeMap;
use std::sync::Arc;

/// For each family of functions of one argument: one function, and the number of parts of the
/// argument that all functions of the family use.
pub(super) type Parts = Vec<(&'static Kind, u32)>;

/// The functions in a fraction, each with the number of parts of its argument.
fn functions(f: &Fraction) -> impl Iterator<Item = (usize, &'static Kind, u32)> {
    let last = if f.has_functions() { f.variables.len() } else { 0 };
    let kinds = f.variables[..last].iter().map(|variable| variable.kind()).enumerate();
    kinds.filter_map(|(at, kind)| Some((at, kind, kind.part()?.parts)))
}

/// The common number of parts for the functions of each argument. Returns `None` if the functions
/// of each argument already have the same number of parts.
pub(super) fn common_parts<'f>(
    fractions: impl Iterator<Item = &'f Arc<Fraction>>,
) -> Option<Parts> {
    let mut finest = Parts::new();
    let mut different = false;
    for f in fractions.filter(|f| f.has_functions()) {
        for (_, kind, parts) in functions(f) {
            let related = |(other, _): &&mut (&'static Kind, u32)| {
                std::ptr::eq(*other, kind) || other.is_related(kind)
            };
            match finest.iter_mut().find(related) {
                None => finest.push((kind, parts)),
                Some((_, known)) => {
                    different |= *known != parts;
                    *known = known.lcm(&parts);
                }
            }
        }
    }
    different.then_some(finest)
}

/// The fraction, with its functions rewritten for these numbers of parts.
pub(super) fn in_parts(f: &Arc<Fraction>, parts: &Parts) -> Arc<Fraction> {
    let mut refined = f.clone();
    let coarse = |f: &Fraction| {
        functions(f).find_map(|(at, kind, own)| {
            let (_, parts) = parts.iter().find(|(other, _)| other.is_related(kind))?;
            Some((at, parts / own)).filter(|(_, k)| *k > 1)
        })
    };
    while let Some((at, k)) = coarse(&refined) {
        refined = Arc::new(in_more_parts(&refined, at, k));
    }
    refined
}

/// The unique form of a value.
pub(super) fn settled(value: Symbolic) -> Symbolic {
    let Form::Fraction(f) = &value.0 else { return value };
    for (at, kind, parts) in functions(f) {
        if let Kind::Root(part) = kind
            && f.numerator.degrees()[at] >= parts
        {
            return without_powers(f, at, part);
        }
        if let Some(coarse) = primes(parts).find_map(|k| in_fewer_parts(f, at, k)) {
            return settled(coarse.into());
        }
    }
    value
}

/// The prime divisors of a number, with repetitions.
fn primes(n: u32) -> impl Iterator<Item = u32> {
    let (mut rest, mut k) = (n, 2);
    std::iter::from_fn(move || {
        while rest > 1 && !rest.is_multiple_of(k) {
            k = if k.saturating_mul(k) > rest { rest } else { k + 1 };
        }
        (rest > 1).then(|| {
            rest /= k;
            k
        })
    })
}

/// The reciprocal `1 / f` without roots in the denominator. For a square root,
/// `1/(a + b v) = (a - b v)/(a^2 - b^2 p)`.
pub(super) fn reciprocal(f: &Fraction) -> Option<Symbolic> {
    let root = functions(f).filter_map(|(at, kind, _)| match kind {
        Kind::Root(part) => Some((at, part)),
        _ => None,
    });
    let Some((at, Part { of: p, parts: n })) = root.last() else {
        return f.recip().map(Symbolic::from);
    };
    let v = Symbolic::variable(f.variables[at]);
    let below = f.polynomial(&f.expanded_denominator());
    let mut powers = by_power(&f.numerator, at);
    let n = *n as usize;
    let coefficients: Vec<Symbolic> = (0..n as u32)
        .map(|e| powers.remove(&e).map_or_else(Symbolic::zero, |part| f.polynomial(&part)))
        .collect();
    let mut present = (0..n).filter(|e| !coefficients[*e].is_zero());
    if let (Some(e @ 1..), None) = (present.next(), present.next()) {
        // inverts a single power of the root
        let inverse = coefficients[e].recip()? / p;
        return Some(num_traits::pow(v, n - e) * &below * &inverse);
    }
    if let [a, b] = &coefficients[..] {
        let norm = a.clone() * a - &(b.clone() * b * p);
        return Some((a.clone() - &(b.clone() * &v)) * &below * &norm.recip()?);
    }
    // otherwise, solves for the coefficients of the inverse; the matrix is the multiplication by f
    let entry = |row: usize, column: usize| match row.checked_sub(column) {
        Some(e) => coefficients[e].clone(),
        None => coefficients[n + row - column].clone() * p,
    };
    let rows: Vec<Vec<Symbolic>> =
        (0..n).map(|row| (0..n).map(|column| entry(row, column)).collect()).collect();
    let mut one = vec![Symbolic::zero(); n];
    one[0] = Symbolic::one();
    let inverse = Matrix::from_dense(&rows).ok()?.solve(&one).ok()??;
    let terms = inverse.into_iter().enumerate();
    let terms = terms.map(|(e, value)| value * &num_traits::pow(v.clone(), e));
    Some(terms.fold(Symbolic::zero(), |sum, term| sum + &term) * &below)
}
/// The coefficients of a polynomial in one variable. Each is stored with its exponent.
fn by_power(f: &Polynomial, at: usize) -> BTreeMap<u32, Polynomial> {
    let mut parts: BTreeMap<u32, Vec<(Monomial, Rational)>> = BTreeMap::new();
    for (m, c) in &f.terms {
        let mut exponents = m.exps().to_vec();
        let e = std::mem::take(&mut exponents[at]);
        parts.entry(e).or_default().push((Monomial::new(exponents), c.clone()));
    }
    let part = |terms| Poly::new(terms, f.nvars, Order::GrLex);
    parts.into_iter().map(|(e, terms)| (e, part(terms))).collect()
}

/// The value, in which high powers of a root of `p` are replaced by powers of `p`.
fn without_powers(f: &Fraction, at: usize, Part { of: p, parts: n }: &Part) -> Symbolic {
    let root = Symbolic::variable(f.variables[at]);
    let one = constant(Rational::one(), f.variables.len());
    let below = lowest_terms(&f.variables, one, f.denominator.clone());
    let term = |(e, part): (u32, Polynomial)| {
        let part = f.polynomial(&part) * &num_traits::pow(p.clone(), (e / n) as usize);
        if e % n > 0 { part * &num_traits::pow(root.clone(), (e % n) as usize) } else { part }
    };
    let terms = by_power(&f.numerator, at).into_iter().map(term);
    settled(terms.fold(Symbolic::zero(), |sum, term| sum + &term) * &below)
}

/// The numerator and the denominator of `tan(k x)` for `tan(x) = t`, or of `t^k`. Here `t` is the
/// variable at the position `at`.
fn multiple(kind: &Kind, at: usize, n: usize, k: u32) -> [Polynomial; 2] {
    let t: Polynomial = Poly::var(at, n, Order::GrLex);
    let [zero, one] = [Rational::zero(), Rational::one()].map(|c| constant(c, n));
    match kind {
        Kind::HalfTangent(_) => {
            (0..k).fold([zero, one], |[q, p], _| [&q + &product(&p, &t), &p - &product(&q, &t)])
        }
        _ => [power(&t, k), one],
    }
}

/// The fraction, with the argument of a function divided into `k` times as many parts.
fn in_more_parts(f: &Fraction, at: usize, k: u32) -> Fraction {
    let kind = f.variables[at].kind();
    let n = f.variables.len();
    let [q, p] = multiple(kind, at, n, k);
    let below = f.expanded_denominator();
    let degree = f.numerator.degrees()[at].max(below.degrees()[at]);
    let image = |f: &Polynomial| {
        let zero = constant(Rational::zero(), n);
        by_power(f, at).into_iter().fold(zero, |sum, (e, part)| {
            &sum + &product(&part, &product(&power(&q, e), &power(&p, degree - e)))
        })
    };
    let parts = kind.part().map_or(1, |part| part.parts * k);
    quotient(f, at, parts, image(&f.numerator), image(&below))
}

/// The fraction, with the argument of a function divided into `k` times fewer parts. Returns `None`
/// if this is impossible.
fn in_fewer_parts(f: &Fraction, at: usize, k: u32) -> Option<Fraction> {
    let kind = f.variables[at].kind();
    let parts = kind.part()?.parts;
    let in_factors = f.denominator.factors.iter().map(|(factor, e)| {
        let place = places(&factor.variables, &f.variables).iter().position(|own| *own == at);
        place.map_or(0, |place| factor.polynomial.degrees()[place] * e)
    });
    let below = in_factors.sum::<u32>() + f.denominator.exponent(at);
    let degree = f.numerator.degrees()[at].max(below);
    if !degree.is_multiple_of(k) {
        return None;
    }
    let coarse = |g: &Polynomial| match kind {
        Kind::HalfTangent(_) => in_multiples(kind, g, at, k, degree / k),
        _ => in_powers(g, at, k),
    };
    let above = coarse(&f.numerator)?;
    Some(quotient(f, at, parts / k, above, coarse(&f.expanded_denominator())?))
}

/// Rewrites a polynomial in `t^k` as a polynomial in `t`. Returns `None` if it is not a polynomial
/// in `t^k`.
fn in_powers(g: &Polynomial, at: usize, k: u32) -> Option<Polynomial> {
    let term = |(m, c): &(Monomial, Rational)| {
        let mut exponents = m.exps().to_vec();
        let e = exponents[at];
        exponents[at] = e / k;
        e.is_multiple_of(k).then(|| (Monomial::new(exponents), c.clone()))
    };
    Some(Poly::new(g.terms.iter().map(term).collect::<Option<_>>()?, g.nvars, Order::GrLex))
}

/// Computes the polynomial `sum_e g_e t^e` from `sum_e g_e q^e p^(m - e)`, where `tan(k x) = q/p`.
fn in_multiples(kind: &Kind, g: &Polynomial, at: usize, k: u32, m: u32) -> Option<Polynomial> {
    let n = g.nvars;
    let [q, p] = multiple(kind, at, n, k);
    let t: Polynomial = Poly::var(at, n, Order::GrLex);
    let (mut rest, mut sum) = (g.clone(), constant(Rational::zero(), n));
    for e in 0..=m {
        // determines g_e from the term in t^e, because q = k t + ... and p = 1 + ...
        let Some(part) = by_power(&rest, at).remove(&e) else { continue };
        let part = part.scale(&Rational::new(1, i64::from(k).checked_pow(e)?)?);
        rest = &rest - &product(&part, &product(&power(&q, e), &power(&p, m - e)));
        sum = &sum + &product(&part, &power(&t, e));
    }
    rest.is_zero().then_some(sum)
}

/// The quotient of coprime polynomials in the variables of `f`. The variable at the position `at`
/// has a new number of parts.
fn quotient(f: &Fraction, at: usize, parts: u32, above: Polynomial, below: Polynomial) -> Fraction {
    let mut all: Vec<(usize, Variable)> = f.variables.iter().copied().enumerate().collect();
    if let Some(kind) = f.variables[at].kind().in_parts(parts) {
        all[at].1 = Variable::function(kind);
    }
    all.sort_by_key(|(_, variable)| *variable);
    let columns: Vec<_> = all.iter().map(|(at, _)| Some(*at)).collect();
    let variables: Variables = all.into_iter().map(|(_, variable)| variable).collect();
    // sorts the terms again, because their order depends on the order of the variables
    let [numerator, below] = [above, below].map(|f| {
        let f = select(&f, &columns);
        Poly::new(f.terms, f.nvars, Order::GrLex)
    });
    // divides by the content, which has the sign of the first coefficient, so this coefficient
    // becomes positive
    let unit = Rational::one() / &content(&below);
    let denominator = Denominator::of(&variables, &below.scale(&unit));
    Fraction::new(variables, numerator.scale(&unit), denominator)
}
