//! The exponential of a matrix and its integral, in closed form.
//!
//! Let a polynomial `mu` of degree `d` annihilate `M`. Then `exp(sM)` is `sum f_j(s) M^j` over
//! `j < d`. The functions `f_j` solve `mu(d/ds) f = 0`, and for `i < d`, the `i`-th derivative of
//! `f_j` at 0 is 1 if `i = j` and 0 otherwise. All solutions are combinations of
//! `s^p e^(as) cos(bs)` and `s^p e^(as) sin(bs)` for the roots `a + ib` of `mu` (I. E. Leonard,
//! *SIAM Review* 38 (1996) 507-512). Here `a` and `b` are linear forms of the coordinates.

use super::canonical::{Entire, Side};
use super::eigenvalues::{Eigenvalue, eigenvalues, multiplied, refusal};
use crate::Error;
use affinor_tensors::linear::Matrix;
use affinor_tensors::{Notation, Ring, Symbolic};
use num_traits::{One, Zero};

/// A function of `-ad_x` (left) or `ad_x` (right), where `x` are the coordinates along `labels`.
pub(super) fn closed_form(
    function: Entire,
    side: Side,
    ad_x: &Matrix<Symbolic>,
    coordinates: &[String],
    labels: &[String],
) -> Result<Matrix<Symbolic>, Error> {
    let x: Vec<Symbolic> = coordinates.iter().map(|name| Symbolic::parameter(name)).collect();
    let found = eigenvalues(ad_x, coordinates, labels)?;
    let mut roots: Vec<Eigenvalue> = match side {
        Side::Left => found.into_iter().map(Eigenvalue::opposite).collect(),
        Side::Right => found,
    };
    let mu = roots.iter().fold(vec![Symbolic::one()], |mu, root| {
        let factor = root.factor(&x);
        (0..root.multiplicity).fold(mu, |mu, _| multiplied(&mu, &factor))
    });
    let m = side.signed(ad_x);
    let mut powers = vec![Matrix::identity(m.rows())];
    for _ in 1..mu.len() {
        powers.push(m.mul(&powers[powers.len() - 1])?);
    }
    let at_m = |coefficients: &[Symbolic]| {
        let zero = Matrix::zero(m.rows(), m.rows());
        powers
            .iter()
            .zip(coefficients)
            .try_fold(zero, |sum, (power, f)| sum.add(&power.map(|value| value.clone() * f)))
    };
    // proves that mu annihilates M for all x, because the roots were found only at sample points
    if at_m(&mu)?.entries().next().is_some() {
        return Err(refusal("x", &mu));
    }
    // if f is the remainder of e^z modulo z mu, the remainder of the integral modulo mu is (f -
    // 1)/z
    let skipped = match function {
        Entire::Exponential => 0,
        Entire::Integral => {
            match roots.iter_mut().find(|root| root.is_zero()) {
                Some(root) => root.multiplicity += 1,
                None => roots.push(Eigenvalue::zero(x.len())),
            }
            1
        }
    };
    let remainder = remainder(&roots, &x).ok_or_else(|| refusal("x", &mu))?;
    Ok(at_m(&remainder[skipped..])?)
}

/// The remainder of `e^z` modulo the polynomial with these roots. Its coefficients are the values
/// `f_j(1)`. Returns `None` if the exponential of a form is unknown.
fn remainder(roots: &[Eigenvalue], x: &[Symbolic]) -> Option<Vec<Symbolic>> {
    let parts = |root: &Eigenvalue| if root.at(x)[1].vanishes() { 1 } else { 2 };
    let degree = roots.iter().map(|root| root.multiplicity * parts(root)).sum();
    let (mut derivatives, mut values) = (Vec::new(), Vec::new());
    for root in roots {
        let [a, b] = root.at(x);
        let mut growth = Symbolic::function("exp", &a).ok()?;
        let waves = ["cos", "sin"].map(|wave| Symbolic::function(wave, &b));
        // the derivatives of s^p/p! e^((a+ib)s) at 0, each as real and imaginary part
        let mut before = vec![[Symbolic::zero(), Symbolic::zero()]; degree];
        for p in 0..root.multiplicity {
            let first = if p == 0 { Symbolic::one() } else { Symbolic::zero() };
            let mut own = vec![[first, Symbolic::zero()]];
            for i in 1..degree {
                let ([re, im], [more_re, more_im]) = (own[i - 1].clone(), &before[i - 1]);
                let next_re = a.clone() * &re - &(b.clone() * &im) + more_re;
                let next_im = a.clone() * &im + &(b.clone() * &re) + more_im;
                own.push([next_re, next_im]);
            }
            for (part, wave) in waves.iter().enumerate().take(parts(root)) {
                derivatives.push(own.iter().map(|pair| pair[part].clone()).collect());
                values.push(wave.clone().ok()? * &growth);
            }
            growth /= &Symbolic::from_i64(p as i64 + 1);
            before = own;
        }
    }
    let inverse = Matrix::from_dense(&derivatives).expect("as many derivatives of each").inverse();
    Some(inverse.expect("independent solutions").apply(&values).expect("as many values"))
}
