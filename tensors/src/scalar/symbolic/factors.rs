//! Partial factorization of polynomials. It uses greatest common divisors and square roots.
//!
//! The factorization finds contents in each variable, repeated factors, and the two factors of a
//! quadratic polynomial whose discriminant is a square. It may be incomplete, so each part has a
//! flag that tells whether it is known to be irreducible.

use super::super::Rational;
use super::polynomial::{Polynomial, certainly_coprime, cofactors, constant, primitive};
use num_traits::One;
use polycore::{Monomial, Order, Poly};
use std::cmp::{Ordering, Reverse};

/// The largest number of terms of a polynomial that is factored. The factors of longer polynomials
/// take long to find, and are too long to read.
const MAX_TERMS: usize = 60;
const MAX_DEGREE: u32 = 24;

/// If a polynomial of degree one in a variable has more terms than this, it is split only if the
/// parts are quickly proved to be coprime.
const MAX_LINEAR_TERMS: usize = 2000;

/// The product `content * f^e * g^d * ...`. The factors are different primitive polynomials with
/// positive leading coefficients.
pub(super) struct Factors {
    pub content: Rational,
    pub factors: Vec<(Polynomial, u32)>,
}

/// A primitive factor with a positive leading coefficient.
pub(super) struct Part {
    pub polynomial: Polynomial,
    /// Whether the factor is known to be irreducible over the rationals.
    pub irreducible: bool,
}

/// The factors of a nonzero polynomial. If the polynomial exceeds the limits, the only factor is
/// the primitive polynomial itself.
pub(super) fn factors(f: &Polynomial) -> Factors {
    let (content, primitive) = primitive(f);
    if !within_limits(f) {
        return Factors { content, factors: vec![(primitive, 1)] };
    }
    let mut factors: Vec<(Polynomial, u32)> = Vec::new();
    for Part { polynomial: part, .. } in parts(&primitive) {
        match factors.iter_mut().find(|(other, _)| *other == part) {
            Some((_, exponent)) => *exponent += 1,
            None => factors.push((part, 1)),
        }
    }
    // sorts the factors: first single variables, then sums with few terms
    factors.sort_by_key(|(factor, exponent)| (factor.terms.len(), *exponent));
    Factors { content, factors }
}

/// Whether the polynomial is small enough to be factored.
pub(super) fn within_limits(f: &Polynomial) -> bool {
    f.terms.len() <= MAX_TERMS && f.total_degree() <= MAX_DEGREE
}

/// The result of [`factors`] for a product, computed from the irreducible factors of the product.
/// Returns `None` if [`factors`] might not find all of them.
///
/// Factors that depend on different sets of variables are separated by their contents.
pub(super) fn known(content: Rational, factors: &[(Polynomial, u32)]) -> Option<Factors> {
    let sets: Vec<Vec<bool>> =
        factors.iter().map(|(f, _)| f.degrees().into_iter().map(|d| d > 0).collect()).collect();
    let different = |at: usize| {
        let sum = |at: usize| factors[at].0.terms.len() > 1;
        (0..at).all(|other| sets[at] != sets[other] || !sum(at) || !sum(other))
    };
    if !(0..factors.len()).all(different) {
        return None;
    }
    let mut order = Vec::new();
    separate((0..factors.len()).collect(), &sets, &mut order);
    let mut factors: Vec<_> = order.into_iter().map(|at| factors[at].clone()).collect();
    // sorts single variables in the order of the variables
    factors.sort_by_key(|(f, _)| (f.terms.len() == 1).then(|| Reverse(f.degrees())));
    factors.sort_by_key(|(factor, exponent)| (factor.terms.len(), *exponent));
    Some(Factors { content, factors })
}

/// Appends the factors in the order in which [`split`] finds them. Factors without the first
/// variable come before the others.
fn separate(all: Vec<usize>, sets: &[Vec<bool>], order: &mut Vec<usize>) {
    let variables = 0..sets.first().map_or(0, Vec::len);
    let parts = variables.map(|x| all.iter().partition(|&&at| !sets[at][x]));
    let proper =
        |(without, with): &(Vec<usize>, Vec<usize>)| !without.is_empty() && !with.is_empty();
    match parts.into_iter().find(proper) {
        Some((without, with)) => {
            separate(without, sets, order);
            separate(with, sets, order);
        }
        None => order.extend(all),
    }
}

/// Sorts factors in an order that depends only on the factors: first single variables, then sums
/// with few terms.
pub(super) fn sort(factors: &mut [(Polynomial, u32)]) {
    let terms = |f: &Polynomial, g: &Polynomial| {
        let pairs = f.terms.iter().zip(&g.terms);
        let orders = pairs.map(|((m, a), (n, b))| n.cmp(m).then_with(|| b.cmp(a)));
        orders.fold(Ordering::Equal, Ordering::then)
    };
    factors.sort_by(|(f, d), (g, e)| {
        (f.terms.len(), d).cmp(&(g.terms.len(), e)).then_with(|| terms(f, g))
    });
}

/// The factors of a primitive polynomial with a positive leading coefficient. Each factor is
/// repeated by its multiplicity.
pub(super) fn parts(f: &Polynomial) -> Vec<Part> {
    let mut parts = Vec::new();
    split(f, &mut parts);
    parts
}

/// Appends the factors of a primitive polynomial with a positive leading coefficient.
///
/// A polynomial `a x + b` is irreducible if `a` and `b` are coprime. A polynomial of degree two in
/// `x` is irreducible if its coefficients are coprime, and its discriminant is not a square. Both
/// conditions hold if no [`divisor`] is found.
fn split(f: &Polynomial, parts: &mut Vec<Part>) {
    if f.is_constant() {
        return;
    }
    let mut push = |polynomial, irreducible| parts.push(Part { polynomial, irreducible });
    let degrees = f.degrees();
    let terms = |x: usize| f.terms.iter().filter(|(m, _)| m.exps()[x] > 0).count();
    let linear = (0..f.nvars).filter(|&x| degrees[x] == 1).min_by_key(|&x| terms(x));
    if let Some(x) = linear {
        let [b, a] = [0, 1].map(|power| primitive(&coefficient(f, x, power)).1);
        if a.is_constant() || !b.is_zero() && certainly_coprime(&a, &b) {
            return push(f.clone(), true);
        }
        if !within_limits(f) && f.terms.len() <= MAX_LINEAR_TERMS {
            let common = if b.is_zero() { a } else { cofactors(&a, &b).0 };
            let (_, rest, _) = cofactors(f, &common);
            push(rest, true);
            return split(&common, parts);
        }
    }
    if !within_limits(f) {
        return push(f.clone(), false);
    }
    match divisor(f) {
        None => push(f.clone(), degrees.iter().any(|d| matches!(d, 1 | 2))),
        Some(divisor) => {
            let (common, rest, _) = cofactors(f, &divisor);
            split(&common, parts);
            split(&rest, parts);
        }
    }
}

/// A proper divisor of the polynomial. Returns `None` if no divisor is found.
fn divisor(f: &Polynomial) -> Option<Polynomial> {
    let degrees = f.degrees();
    let proper = |g: &Polynomial| !g.is_constant() && g.total_degree() < f.total_degree();
    let variables = || (0..f.nvars).filter(|&x| degrees[x] > 0);
    let contents = variables().map(|x| {
        let coefficients = (0..=degrees[x]).map(|power| coefficient(f, x, power));
        let common = |a: Polynomial, b: Polynomial| match (a.is_zero(), b.is_zero()) {
            (true, _) => b,
            (_, true) => a,
            _ => common_divisor(&a, &b),
        };
        coefficients.reduce(common).unwrap_or_else(|| constant(Rational::one(), f.nvars))
    });
    let monomials = variables().map(|x| Poly::monomial(Monomial::var(x, f.nvars), Order::GrLex));
    let monomials = monomials.filter(|x| f.exact(x).is_some());
    let repeated =
        variables().filter(|&x| degrees[x] > 1).map(|x| common_divisor(f, &f.derivative(x)));
    let quadratic = variables().filter(|&x| degrees[x] == 2).filter_map(|x| {
        let [c, b, a] = [0, 1, 2].map(|power| coefficient(f, x, power));
        let four = Rational::from(4);
        let root = square_root(&(&(&b * &b) - &(&a * &c).scale(&four)))?;
        let x = Poly::var(x, f.nvars, Order::GrLex);
        let linear = &(&(&a * &x).scale(&Rational::from(2)) + &b) + &root;
        Some(common_divisor(f, &linear))
    });
    monomials.chain(contents).chain(repeated).chain(quadratic).find(proper)
}

/// The greatest common divisor. It is primitive and has a positive leading coefficient.
fn common_divisor(f: &Polynomial, g: &Polynomial) -> Polynomial {
    if f.is_zero() || g.is_zero() {
        return constant(Rational::one(), f.nvars);
    }
    cofactors(f, &primitive(g).1).0
}

/// The coefficient of `x^power`, which is a polynomial in the other variables.
fn coefficient(f: &Polynomial, x: usize, power: u32) -> Polynomial {
    let terms = f.terms.iter().filter(|(m, _)| m.exps()[x] == power).map(|(m, c)| {
        let mut exponents = m.exps().to_vec();
        exponents[x] = 0;
        (Monomial::new(exponents), c.clone())
    });
    Poly::new(terms.collect(), f.nvars, Order::GrLex)
}

/// The square root. Its terms are found one by one, the highest first. Returns `None` if the root
/// is not a polynomial.
fn square_root(f: &Polynomial) -> Option<Polynomial> {
    let Some((m, c)) = f.terms.first() else { return Some(f.clone()) };
    let half: Option<Vec<u32>> =
        m.exps().iter().map(|e| e.is_multiple_of(2).then_some(e / 2)).collect();
    let lead = Poly::new(vec![(Monomial::new(half?), c.sqrt()?)], f.nvars, Order::GrLex);
    let (lead_monomial, lead_value) = lead.terms.first().cloned()?;
    let twice = lead_value * Rational::from(2);
    let mut square_root = lead;
    // limits the steps: every step finds a term of the root, and the root has at most as many terms
    // as the square
    for _ in 0..=f.terms.len() {
        let rest = f - &(&square_root * &square_root);
        let Some((m, c)) = rest.terms.first() else { return Some(square_root) };
        let term = vec![(m.quo(&lead_monomial)?, c.clone() / &twice)];
        square_root = &square_root + &Poly::new(term, f.nvars, Order::GrLex);
    }
    None
}
