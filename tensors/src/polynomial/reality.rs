//! Consequences of equations over the real numbers: sums of squares vanish only together, and a
//! polynomial without real roots does not vanish.

use super::factors::{distinct_factors, is_homogeneous, primitive, variables};
use super::real_roots::isolate;
use super::{Polynomial, Univariate};
use crate::{Rational, Ring};
use num_traits::One;
use polycore::{Monomial, Poly, Uni};

/// The cases of the equation `f = 0` over the real numbers, where some polynomials do not vanish.
/// In each case, all polynomials of a list vanish. Without cases, the equation has no solution. If
/// `f` is zero, there is one case without equations.
pub(super) fn cases(f: &Polynomial, nonzero: &[Polynomial]) -> Vec<Vec<Polynomial>> {
    if f.is_zero() {
        return vec![vec![]];
    }
    let factors = distinct_factors(f).into_iter().filter(|factor| !nonzero.contains(factor));
    factors.filter_map(|factor| together(&factor)).collect()
}

/// Polynomials that vanish at the same real points as `f` together. Returns `None` if `f` has no
/// real zero.
fn together(f: &Polynomial) -> Option<Vec<Polynomial>> {
    let sign = f.lc().is_some_and(Rational::is_negative);
    let square = |m: &Monomial| m.exps().iter().all(|e| e.is_multiple_of(2));
    if f.terms.iter().all(|(m, c)| square(m) && c.is_negative() == sign) {
        let roots = f.terms.iter().map(|(m, _)| {
            let exponents: Vec<u32> = m.exps().iter().map(|e| (*e).min(1)).collect();
            Poly::monomial(Monomial::new(exponents), f.order.clone())
        });
        return f.terms.iter().all(|(m, _)| !m.is_one()).then(|| roots.collect());
    }
    if f.total_degree() == 2
        && let Some(forms) = squares(f)
    {
        return forms.iter().all(|form| !form.is_constant()).then_some(forms);
    }
    match variables(f)[..] {
        [x] => has_real_root(&Uni::from_poly(f, x)?).then(|| vec![f.clone()]),
        [x, y] if is_homogeneous(f) => {
            let image = Uni::from_poly(&f.eval_var(x, &Rational::one()), y)?;
            match has_real_root(&image) {
                true => Some(vec![f.clone()]),
                false => Some([x, y].map(|at| Poly::var(at, f.nvars, f.order.clone())).to_vec()),
            }
        }
        _ => Some(vec![f.clone()]),
    }
}

/// Whether a polynomial has a real root.
fn has_real_root(f: &Univariate) -> bool {
    f.deg() % 2 == 1 || !isolate(f).is_empty()
}

/// The linear forms whose squares, with coefficients of one sign, have the sum `f` of degree two.
/// Returns `None` if the signs differ.
fn squares(f: &Polynomial) -> Option<Vec<Polynomial>> {
    let mut rest = f.clone();
    let mut forms = vec![];
    let half = Rational::new(1, 2)?;
    let negative = f.lc()?.is_negative();
    // completes the squares; the last square is a constant
    while !rest.is_constant() {
        let place = |x: usize, power| {
            let mut exponents = vec![0; f.nvars];
            exponents[x] = power;
            Monomial::new(exponents)
        };
        let pivot = variables(&rest).into_iter().find_map(|x| {
            let square = rest.terms.iter().find(|(m, _)| *m == place(x, 2))?;
            Some((x, square.1.clone()))
        });
        let (x, c) = pivot.filter(|(_, c)| c.is_negative() == negative)?;
        // f = c x^2 + x l + ..., with the form x + l / (2 c)
        let linear = rest.derivative(x).scale(&(half.clone() / &c));
        rest = &rest - &(&linear * &linear).scale(&c);
        forms.push(primitive(&linear));
    }
    match rest.lc() {
        None => Some(forms),
        Some(c) if c.is_negative() == negative && !c.vanishes() => {
            Some(vec![Poly::constant(Rational::one(), f.nvars, f.order.clone())])
        }
        Some(_) => None,
    }
}
