//! Polynomials over the rationals. They are the numerators and denominators of fractions.
//!
//! Terms are in descending graded lexicographic order: by total degree, then by the order of the
//! variables. Selecting or inserting variables preserves this order.

use super::super::{Rational, effort};
use crate::stop::detached;
use num_bigint::BigInt;
use num_rational::{BigRational, Ratio};
use num_traits::{One, ToPrimitive};
use polycore::{Field, Gf, Monomial, Order, Poly};

pub(crate) type Polynomial = Poly<Rational>;

/// The constant polynomial `c` in `n` variables.
pub(super) fn constant(c: Rational, n: usize) -> Polynomial {
    Poly::constant(c, n, Order::GrLex)
}

/// The polynomial in other variables. The variable `k` of the result is the variable `columns[k]`
/// of `f`, or a new variable.
pub(super) fn select(f: &Polynomial, columns: &[Option<usize>]) -> Polynomial {
    let exponents = |m: &Monomial| -> Vec<u32> {
        columns.iter().map(|k| k.map_or(0, |k| m.exps()[k])).collect()
    };
    let terms = f.terms.iter().map(|(m, c)| (Monomial::new(exponents(m)), c.clone()));
    Poly { terms: terms.collect(), nvars: columns.len(), order: f.order.clone() }
}

/// The product `f g`.
///
/// # Panics
/// If the total degree of the product exceeds `u32::MAX`, because a wrapped exponent would yield a
/// wrong result.
pub(super) fn product(f: &Polynomial, g: &Polynomial) -> Polynomial {
    match (f.is_constant(), g.is_constant()) {
        (true, _) => scaled(g, f),
        (_, true) => scaled(f, g),
        _ => {
            let degree = f.total_degree().checked_add(g.total_degree());
            degree.expect("total degree of a product passes u32::MAX");
            // the second factor is the longer factor, because it is the outer loop of the product
            if f.terms.len() < g.terms.len() { g * f } else { f * g }
        }
    }
}

/// The product of `f` and the constant polynomial `c`.
fn scaled(f: &Polynomial, c: &Polynomial) -> Polynomial {
    match c.lc() {
        Some(c) if c.is_one() => f.clone(),
        Some(c) => f.scale(c),
        None => c.clone(),
    }
}

/// If the product of the numbers of terms exceeds this value, a gcd may take longer than a few
/// milliseconds.
const LONG: usize = 1 << 14;

/// Returns `(h, f / h, g / h)`, where `h` is the greatest common divisor. It is primitive and has a
/// positive leading coefficient; `g` must also have this form. If `f` or `g` is constant, `h` is 1.
pub(super) fn cofactors(f: &Polynomial, g: &Polynomial) -> (Polynomial, Polynomial, Polynomial) {
    let one = || constant(Rational::one(), f.nvars);
    if f.is_constant() || g.is_constant() || disjoint(f, g) {
        return (one(), f.clone(), g.clone());
    }
    if f == g {
        return (f.clone(), one(), one());
    }
    if f.terms.len() == 1 || g.terms.len() == 1 {
        let (a, b) = (f.min_exps(), g.min_exps());
        let least = a.exps().iter().zip(b.exps()).map(|(a, b)| *a.min(b));
        let common = Monomial::new(least.collect::<Vec<_>>());
        let (f, g) = (lowered(f, &common), lowered(g, &common));
        return (Poly::monomial(common, Order::GrLex), f, g);
    }
    if certainly_coprime(f, g) {
        return (one(), f.clone(), g.clone());
    }
    // tries a division first: repeated denominators often divide each other, and a failure is found
    // quickly
    if let Some(quotient) = f.exact(g) {
        return (g.clone(), quotient, one());
    }
    if !effort::products(f.terms.len().saturating_mul(g.terms.len())) {
        return (one(), f.clone(), g.clone());
    }
    let (big_f, big_g) = (f.map(to_big), g.map(to_big));
    let h = match f.terms.len().saturating_mul(g.terms.len()) {
        ..LONG => zippel_gcd::zippel(&big_f, &big_g),
        _ => detached(move || zippel_gcd::zippel(&big_f, &big_g)),
    };
    let h = h.map(from_big);
    if h.is_constant() {
        return (one(), f.clone(), g.clone());
    }
    let quotient = |f: &Polynomial| f.exact(&h).expect("a common divisor divides");
    let (f, g) = (quotient(f), quotient(g));
    (h, f, g)
}

/// Whether the polynomials have no common variable. In this case, only constants divide both.
fn disjoint(f: &Polynomial, g: &Polynomial) -> bool {
    f.degrees().iter().zip(g.degrees()).all(|(a, b)| *a == 0 || b == 0)
}

/// A quick proof that only constants divide both polynomials. Coprime polynomials are the most
/// frequent case.
///
/// All variables except one are replaced by numbers modulo a prime. The image of a common divisor
/// that depends on the remaining variable has the same degree as the divisor, if this holds for
/// `f`. Therefore, a constant gcd of the images excludes such a divisor. The result `false` proves
/// nothing.
pub(super) fn certainly_coprime(f: &Polynomial, g: &Polynomial) -> bool {
    let residue = |c: &Rational| {
        let c = Ratio::<i64>::try_from(c).ok()?;
        let denominator = Residue::from_i64(*c.denom()).inverse()?;
        Some(Residue::from_i64(*c.numer()) * denominator)
    };
    // skips higher degrees, for which Euclid's algorithm takes longer than the sparse gcd
    if f.total_degree().max(g.total_degree()) > 1000 {
        return false;
    }
    let Some((above, below)) = f.try_map(residue).zip(g.try_map(residue)) else {
        return false;
    };
    let point: Vec<_> = (1..).map(coordinate).take(f.nvars).collect();
    let images = above.univariate_images(&point).into_iter().zip(below.univariate_images(&point));
    let mut degrees = f.degrees().into_iter().zip(g.degrees()).zip(images);
    degrees.all(|((a, b), (image, other))| {
        a == 0 || b == 0 || (image.0.len() > a as usize && image.gcd(&other).0.len() == 1)
    })
}

pub(super) type Residue = Gf<{ (1 << 61) - 1 }>;

/// A coordinate of the point at which polynomials are compared. It is a multiple of the golden
/// ratio times 2^64, so that there are no small relations between coordinates.
pub(super) fn coordinate(k: u64) -> Residue {
    Residue::new(k.wrapping_mul(0x9e37_79b9_7f4a_7c15))
}

/// The quotient `f / m` for a monomial that divides every term.
pub(super) fn lowered(f: &Polynomial, m: &Monomial) -> Polynomial {
    let terms = f.terms.iter().filter_map(|(n, c)| Some((n.quo(m)?, c.clone())));
    Poly { terms: terms.collect(), nvars: f.nvars, order: f.order.clone() }
}

/// The rational `q` for which `f / q` has coprime integer coefficients. It has the sign of the
/// leading coefficient.
pub(super) fn content(f: &Polynomial) -> Rational {
    Rational::content(f.terms.iter().map(|(_, c)| c))
}

/// The content, and the polynomial divided by its content. The content of the zero polynomial is 1.
pub(super) fn primitive(f: &Polynomial) -> (Rational, Polynomial) {
    if f.is_zero() {
        return (Rational::one(), f.clone());
    }
    let content = content(f);
    let part = f.scale(&(Rational::one() / &content));
    (content, part)
}

/// The power of a polynomial.
///
/// # Panics
/// The errors of [`product`].
pub(super) fn power(f: &Polynomial, exponent: u32) -> Polynomial {
    let degree = f.total_degree().checked_mul(exponent);
    degree.expect("total degree of a power passes u32::MAX");
    f.pow(exponent)
}

/// The least common denominator of the coefficients.
pub(super) fn common_denominator(f: &Polynomial) -> Rational {
    let content = to_big(&content(f));
    from_big(&BigRational::from(content.denom().clone()))
}

/// Converts a rational number. Machine words are converted directly, because the general conversion
/// uses bytes.
fn to_big(c: &Rational) -> BigRational {
    match Ratio::<i64>::try_from(c) {
        Ok(c) => Ratio::new_raw(BigInt::from(*c.numer()), BigInt::from(*c.denom())),
        Err(_) => c.into(),
    }
}

fn from_big(c: &BigRational) -> Rational {
    match c.numer().to_i64().zip(c.denom().to_i64()) {
        Some((n, d)) => Ratio::new_raw(n, d).into(),
        None => c.clone().into(),
    }
}
