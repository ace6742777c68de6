//! The different factors of a polynomial.
//!
//! Contents, repeated factors and quadratic factors are found by greatest common divisors and
//! square roots. Polynomials in one variable, homogeneous polynomials in two variables, and small
//! polynomials in several variables (by Kronecker's substitution) are factored completely. The
//! results of the room do not depend on irreducibility.

use super::{Polynomial, Univariate};
use crate::Rational;
use crate::scalar::polynomial_factors;
use crate::stop::{checkpoint, detached};
use num_rational::BigRational;
use num_traits::{One, Zero};
use polycore::{Monomial, Order, Poly, Uni};

/// The largest degree of the image of a polynomial under Kronecker's substitution.
const MAX_KRONECKER: u32 = 48;
/// Above this degree, a factorization may need more than a few milliseconds.
const LONG: usize = 16;

/// The polynomial with coprime integer coefficients and a positive leading coefficient that has the
/// same zeros.
pub(super) fn primitive(f: &Polynomial) -> Polynomial {
    if f.is_zero() {
        return f.clone();
    }
    let content = Rational::content(f.terms.iter().map(|(_, c)| c));
    f.scale(&(Rational::one() / &content))
}

/// The different factors of a nonzero polynomial, except for constants. Each is primitive.
pub(super) fn distinct_factors(f: &Polynomial) -> Vec<Polynomial> {
    checkpoint();
    let graded = primitive(&f.reorder(Order::GrLex));
    let mut found: Vec<Polynomial> = vec![];
    for (part, irreducible) in polynomial_factors(&graded) {
        let parts = if irreducible { vec![part] } else { split(&part) };
        for part in parts.iter().map(|part| primitive(&part.reorder(f.order.clone()))) {
            if !found.contains(&part) {
                found.push(part);
            }
        }
    }
    found.sort_by_key(|part| (part.total_degree(), part.terms.len()));
    found
}

/// The variables that occur in a polynomial.
pub(super) fn variables(f: &Polynomial) -> Vec<usize> {
    f.degrees().iter().enumerate().filter(|(_, degree)| **degree > 0).map(|(at, _)| at).collect()
}

/// Whether all terms have the same degree.
pub(super) fn is_homogeneous(f: &Polynomial) -> bool {
    f.terms.iter().all(|(m, _)| m.degree() == f.total_degree())
}

/// The different irreducible factors of a polynomial in one variable.
pub(super) fn univariate_factors(f: &Univariate) -> Vec<Univariate> {
    let big: Uni<BigRational> = f.map(|c| BigRational::from(c));
    let factors = match big.deg() {
        0..=LONG => polyfactor::factor(&big),
        _ => detached(move || polyfactor::factor(&big)),
    };
    factors.into_iter().map(|(factor, _)| factor.map(|c| Rational::from(c.clone()))).collect()
}

/// Splits a polynomial without multiple factors that the symbolic scalars do not split.
fn split(f: &Polynomial) -> Vec<Polynomial> {
    match variables(f)[..] {
        [] => vec![],
        [x] => match Uni::from_poly(f, x) {
            Some(image) => {
                let factors = univariate_factors(&image);
                factors.iter().map(|factor| factor.to_poly(x, f.nvars, f.order.clone())).collect()
            }
            None => vec![f.clone()],
        },
        [x, ..] if is_homogeneous(f) => {
            let factors = split(&f.eval_var(x, &Rational::one()));
            factors.iter().map(|factor| homogenized(factor, x)).collect()
        }
        _ => kronecker(f),
    }
}

/// Multiplies each term by a power of a variable, so that all terms have the same degree.
pub(super) fn homogenized(f: &Polynomial, x: usize) -> Polynomial {
    let degree = f.total_degree();
    let terms = f.terms.iter().map(|(m, c)| {
        let mut exponents = m.exps().to_vec();
        exponents[x] += degree - m.degree();
        (Monomial::new(exponents), c.clone())
    });
    Poly::new(terms.collect(), f.nvars, f.order.clone())
}

/// Factors a polynomial by Kronecker's substitution of powers of one variable, whose exponents are
/// the digits of a number. Combinations of factors of the image are tried as divisors.
fn kronecker(f: &Polynomial) -> Vec<Polynomial> {
    let bases: Vec<u32> = f.degrees().iter().map(|degree| degree + 1).collect();
    let size = bases.iter().fold(1u32, |size, base| size.saturating_mul(*base));
    if size > MAX_KRONECKER {
        return vec![f.clone()];
    }
    let code = |m: &Monomial| {
        let digits = m.exps().iter().zip(&bases).rev();
        digits.fold(0, |code, (digit, base)| code * base + digit) as usize
    };
    let mut coefficients = vec![Rational::zero(); size as usize];
    for (m, c) in &f.terms {
        coefficients[code(m)] = c.clone();
    }
    let image = Uni::new(coefficients.iter().map(BigRational::from).collect());
    let mut pool: Vec<Univariate> = vec![];
    for (factor, multiplicity) in polyfactor::factor(&image) {
        let factor = factor.map(|c| Rational::from(c.clone()));
        pool.extend((0..multiplicity).map(|_| factor.clone()));
    }
    if pool.len() > 12 {
        return vec![f.clone()];
    }
    let decoded = |g: &Univariate| {
        let terms = g.0.iter().enumerate().map(|(at, c)| {
            let mut rest = at as u32;
            let digits = bases.iter().map(|base| {
                let digit = rest % base;
                rest /= base;
                digit
            });
            (Monomial::new(digits.collect::<Vec<_>>()), c.clone())
        });
        Poly::new(terms.collect(), f.nvars, f.order.clone())
    };
    let (mut rest, mut found, mut size) = (f.clone(), vec![], 1);
    'search: while 2 * size <= pool.len() {
        for mask in (1..1usize << pool.len()).filter(|mask| mask.count_ones() as usize == size) {
            checkpoint();
            let chosen = (0..pool.len()).filter(|at| mask >> at & 1 == 1);
            let product = chosen.fold(Uni::constant(Rational::one()), |p, at| &p * &pool[at]);
            let divisor = decoded(&product);
            if let Some(quotient) = rest.exact(&divisor).filter(|q| !q.is_constant()) {
                found.push(divisor);
                rest = quotient;
                let kept = (0..pool.len()).filter(|at| mask >> at & 1 == 0);
                pool = kept.map(|at| pool[at].clone()).collect();
                continue 'search;
            }
        }
        size += 1;
    }
    found.push(rest);
    found
}
