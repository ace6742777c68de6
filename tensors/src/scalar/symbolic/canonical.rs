//! The unique form of values with functions.
//!
//! Functions of `u/2` and of `u/3` are functions of `u/6`. Before values meet, every product `u` is brought into common
//! parts; afterwards into as few parts as the result allows. So `2 sin(x/2) cos(x/2)` is `sin(x)`.
//!
//! The variable `v = sqrt(p)` has the relation `v^2 = p`. It occurs in no denominator, and at most once
//! in a term of a numerator. Irreducible polynomials and primes are independent modulo squares, so are
//! their roots over the rational functions, and this form is unique.

use super::denominator::Denominator;
use super::elementary::{Variable, exponential, half_tangent};
use super::fraction::{Fraction, lowest_terms};
use super::polynomial::{Polynomial, constant, content, power, product, select};
use super::variables::{Name, Variables, places};
use super::{Form, Rational, Symbolic};
use crate::scalar::Field;
use num_integer::Integer;
use num_traits::{One, Zero};
use polycore::{Monomial, Order, Poly};
use std::collections::BTreeMap;
use std::sync::Arc;

use Variable::{Exponential, HalfTangent, Root};

/// What is common to the functions of all parts of a product: their kind, and the product.
fn family(variable: &str) -> Option<((bool, &str), u32)> {
    let variable = Variable::of(variable);
    let (product, parts) = variable.parts()?;
    Some(((matches!(variable, HalfTangent { .. }), product), parts))
}

/// The parts in which the functions of each product meet; `None` if no product is in different parts.
pub(super) fn common_parts<'f>(
    fractions: impl Iterator<Item = &'f Arc<Fraction>>,
) -> Option<BTreeMap<(bool, &'f str), u32>> {
    let mut finest = BTreeMap::new();
    let mut different = false;
    for f in fractions.filter(|f| f.has_functions()) {
        for (family, parts) in f.variables.iter().filter_map(|name| family(name)) {
            let known = finest.entry(family).or_insert(parts);
            different |= *known != parts;
            *known = known.lcm(&parts);
        }
    }
    different.then_some(finest)
}

/// The fraction with its products in these parts.
pub(super) fn in_parts(f: &Arc<Fraction>, parts: &BTreeMap<(bool, &str), u32>) -> Arc<Fraction> {
    let mut refined = f.clone();
    while let Some((at, k)) = refined.variables.iter().enumerate().find_map(|(at, name)| {
        let (family, own) = family(name)?;
        Some((at, parts.get(&family)? / own)).filter(|(_, k)| *k > 1)
    }) {
        refined = Arc::new(in_more_parts(&refined, at, k));
    }
    refined
}

/// The value in its unique form.
pub(super) fn settled(value: Symbolic) -> Symbolic {
    let Form::Fraction(f) = &value.0 else { return value };
    if !f.has_functions() {
        return value;
    }
    for (at, name) in f.variables.iter().enumerate() {
        match Variable::of(name) {
            Root(p) if f.numerator.degrees()[at] > 1 => return without_squares(f, at, p),
            HalfTangent { parts, .. } | Exponential { parts, .. } => {
                let divisors = (2..=parts).filter(|k| parts % k == 0);
                if let Some(coarse) = divisors.filter_map(|k| in_fewer_parts(f, at, k)).next() {
                    return settled(coarse.into());
                }
            }
            _ => {}
        }
    }
    value
}

/// `1 / f`, without roots in the denominator: `1/(a + b v) = (a - b v)/(a^2 - b^2 p)`.
pub(super) fn reciprocal(f: &Fraction) -> Option<Symbolic> {
    let roots = f.variables.iter().enumerate().filter(|_| f.has_functions());
    let mut root = roots.filter_map(|(at, name)| match Variable::of(name) {
        Root(p) => Some((at, p)),
        _ => None,
    });
    let Some((at, p)) = root.next_back() else { return f.recip().map(Symbolic::from) };
    let p: Symbolic = p.parse().ok()?;
    let mut parts = by_power(&f.numerator, at);
    let [a, b] =
        [0, 1].map(|e| parts.remove(&e).map_or_else(Symbolic::zero, |part| f.polynomial(&part)));
    let norm = a.clone() * &a - &(b.clone() * &b * &p);
    let conjugate = a - &(b * &Symbolic::parameter(&f.variables[at]));
    Some(conjugate * &f.polynomial(&f.expanded_denominator()) * &norm.recip()?)
}

/// The parts of a polynomial by the power of a variable, without that variable.
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

/// The value with powers of the root of `p` replaced by powers of `p`.
fn without_squares(f: &Fraction, at: usize, p: &str) -> Symbolic {
    // a variable that was read has a polynomial
    let Ok(p) = p.parse::<Symbolic>() else { return f.clone().into() };
    let root = Symbolic::parameter(&f.variables[at]);
    let one = constant(Rational::one(), f.variables.len());
    let below = lowest_terms(&f.variables, one, f.denominator.clone());
    let term = |(e, part): (u32, Polynomial)| {
        let part = f.polynomial(&part) * &num_traits::pow(p.clone(), e as usize / 2);
        if e % 2 == 1 { part * &root } else { part }
    };
    let terms = by_power(&f.numerator, at).into_iter().map(term);
    settled(terms.fold(Symbolic::zero(), |sum, term| sum + &term) * &below)
}

/// Numerator and denominator of `tan(k x)` for `tan(x) = t`, or of `t^k`; `t` is the variable at a place.
fn multiple(variable: Variable, at: usize, n: usize, k: u32) -> [Polynomial; 2] {
    let t: Polynomial = Poly::var(at, n, Order::GrLex);
    let [zero, one] = [Rational::zero(), Rational::one()].map(|c| constant(c, n));
    match variable {
        HalfTangent { .. } => {
            (0..k).fold([zero, one], |[q, p], _| [&q + &product(&p, &t), &p - &product(&q, &t)])
        }
        _ => [power(&t, k), one],
    }
}

/// The fraction with the product of a variable in `k` times as many parts.
fn in_more_parts(f: &Fraction, at: usize, k: u32) -> Fraction {
    let variable = Variable::of(&f.variables[at]);
    let n = f.variables.len();
    let [q, p] = multiple(variable, at, n, k);
    let below = f.expanded_denominator();
    let degree = f.numerator.degrees()[at].max(below.degrees()[at]);
    let image = |f: &Polynomial| {
        let zero = constant(Rational::zero(), n);
        by_power(f, at).into_iter().fold(zero, |sum, (e, part)| {
            &sum + &product(&part, &product(&power(&q, e), &power(&p, degree - e)))
        })
    };
    let parts = variable.parts().map_or(1, |(_, parts)| parts * k);
    quotient(f, at, parts, image(&f.numerator), image(&below))
}

/// The fraction with the product of a variable in a `k`th of its parts, if it is a function of that.
fn in_fewer_parts(f: &Fraction, at: usize, k: u32) -> Option<Fraction> {
    let variable = Variable::of(&f.variables[at]);
    let (_, parts) = variable.parts()?;
    let in_factors = f.denominator.factors.iter().map(|(factor, e)| {
        let place = places(&factor.variables, &f.variables).iter().position(|own| *own == at);
        place.map_or(0, |place| factor.polynomial.degrees()[place] * e)
    });
    let below = in_factors.sum::<u32>() + f.denominator.exponent(at);
    let degree = f.numerator.degrees()[at].max(below);
    if !degree.is_multiple_of(k) {
        return None;
    }
    let coarse = |g: &Polynomial| match variable {
        HalfTangent { .. } => in_multiples(g, at, k, degree / k),
        _ => in_powers(g, at, k),
    };
    let above = coarse(&f.numerator)?;
    Some(quotient(f, at, parts / k, above, coarse(&f.expanded_denominator())?))
}

/// The polynomial in `t^k`, as one in `t`.
fn in_powers(g: &Polynomial, at: usize, k: u32) -> Option<Polynomial> {
    let term = |(m, c): &(Monomial, Rational)| {
        let mut exponents = m.exps().to_vec();
        let e = exponents[at];
        exponents[at] = e / k;
        e.is_multiple_of(k).then(|| (Monomial::new(exponents), c.clone()))
    };
    Some(Poly::new(g.terms.iter().map(term).collect::<Option<_>>()?, g.nvars, Order::GrLex))
}

/// The polynomial `sum_e g_e t^e` from `sum_e g_e q^e p^(m - e)`, with `tan(k x) = q/p`.
fn in_multiples(g: &Polynomial, at: usize, k: u32, m: u32) -> Option<Polynomial> {
    let n = g.nvars;
    let [q, p] = multiple(HalfTangent { product: "", parts: 1 }, at, n, k);
    let t: Polynomial = Poly::var(at, n, Order::GrLex);
    let (mut rest, mut sum) = (g.clone(), constant(Rational::zero(), n));
    for e in 0..=m {
        // q = k t + ..., p = 1 + ...
        let Some(part) = by_power(&rest, at).remove(&e) else { continue };
        let part = part.scale(&Rational::new(1, i64::from(k).checked_pow(e)?)?);
        rest = &rest - &product(&part, &product(&power(&q, e), &power(&p, m - e)));
        sum = &sum + &product(&part, &power(&t, e));
    }
    rest.is_zero().then_some(sum)
}

/// The quotient of coprime polynomials, in the variables of `f`, but for one that has other parts.
fn quotient(f: &Fraction, at: usize, parts: u32, above: Polynomial, below: Polynomial) -> Fraction {
    let mut names: Vec<(usize, Name)> = f.variables.iter().copied().enumerate().collect();
    names[at].1 = match Variable::of(&f.variables[at]) {
        HalfTangent { product, .. } => Name::new(&half_tangent(product, parts)),
        Exponential { product, .. } => Name::new(&exponential(product, parts)),
        _ => f.variables[at],
    };
    names.sort_by_key(|(_, name)| *name);
    let columns: Vec<_> = names.iter().map(|(at, _)| Some(*at)).collect();
    let variables: Variables = names.into_iter().map(|(_, name)| name).collect();
    // another order of the variables is another order of the terms
    let [numerator, below] = [above, below].map(|f| {
        let f = select(&f, &columns);
        Poly::new(f.terms, f.nvars, Order::GrLex)
    });
    // the content has the sign of the first coefficient
    let unit = Rational::one() / &content(&below);
    let denominator = Denominator::of(&variables, &below.scale(&unit));
    Fraction::new(variables, numerator.scale(&unit), denominator)
}
