//! `exp(x M)` in closed form.
//!
//! With the minimal polynomial `mu` of `M`, of degree `d`, it is `sum f_j(x) M^j`, `j < d`, where the
//! `f_j` solve `mu(d/dx) f = 0` and the `i`-th derivative of `f_j` at 0 is 1 for `i = j < d` and 0
//! for other `i < d`. The solutions are spanned by `x^p e^(ax) cos(bx)` and `x^p e^(ax) sin(bx)`
//! for the roots `a + ib` of `mu`: I. E. Leonard, *SIAM Review* 38 (1996) 507-512.

use crate::Error;
use affinor_tensors::linear::Matrix;
use affinor_tensors::{Notation, Rational, Ring, Symbolic};
use num_traits::{One, Zero, pow};

/// The largest integer that a part of an eigenvalue may be.
const LARGEST: i64 = 12;

/// `exp(x M)` for the parameter `x`; `label` names whose matrix it is.
pub(super) fn exponential(
    m: &Matrix<Symbolic>,
    x: &str,
    label: &str,
) -> Result<Matrix<Symbolic>, Error> {
    let (powers, relation) = minimal(m);
    let refuse = || {
        let terms = relation.iter().enumerate().map(|(j, a)| (-a.clone(), format!("z^{j}")));
        let leading = [(Symbolic::one(), format!("z^{}", relation.len()))];
        let terms = leading.into_iter().chain(terms.rev()).filter(|(a, _)| !a.vanishes());
        let polynomial = crate::error::combination(terms);
        Error::Eigenvalue { x: label.into(), polynomial }
    };
    let constants: Option<Vec<Rational>> =
        relation.iter().map(|a| a.as_constant().map(|a| -a.clone())).collect();
    let mut mu = constants.ok_or_else(refuse)?;
    mu.push(Rational::one());
    let solutions = solutions(mu, x).ok_or_else(refuse)?;
    let d = solutions.len();
    let mut wronskian = Vec::new();
    let mut derivatives = solutions.clone();
    for _ in 0..d {
        wronskian.push(derivatives.iter().map(|f| at_zero(f, x)).collect());
        derivatives = derivatives.iter().map(|f| f.derivative(x)).collect();
    }
    let wronskian = Matrix::from_dense(&wronskian).ok().and_then(|w| w.inverse());
    let coefficients = wronskian.expect("independent solutions");
    powers.iter().enumerate().try_fold(Matrix::zero(m.rows(), m.rows()), |sum, (j, power)| {
        let terms = solutions.iter().enumerate().map(|(k, f)| f.clone() * &coefficients.get(k, j));
        let f = terms.fold(Symbolic::zero(), |sum, term| sum + &term);
        Ok(sum.add(&power.map(|value| value.clone() * &f))?)
    })
}

/// The powers below the degree of the minimal polynomial, and the next as a combination of them.
fn minimal(m: &Matrix<Symbolic>) -> (Vec<Matrix<Symbolic>>, Vec<Symbolic>) {
    let entries = |m: &Matrix<Symbolic>| m.to_dense().concat();
    let mut powers = vec![Matrix::identity(m.rows())];
    loop {
        let next = m.mul(&powers[powers.len() - 1]).expect("square matrices of one size");
        let columns: Vec<_> = powers.iter().map(entries).collect();
        let columns = Matrix::from_dense(&columns).expect("powers of one size").transpose();
        match columns.solve(&entries(&next)).expect("as many entries as rows") {
            Some(relation) => return (powers, relation),
            None => powers.push(next),
        }
    }
}

/// A basis of the solutions of `mu(d/dx) f = 0`; `None` if a root is no small integer `a + ib`.
fn solutions(mut mu: Vec<Rational>, x: &str) -> Option<Vec<Symbolic>> {
    let x = Symbolic::parameter(x);
    let times = |n: i64| x.clone() * &Symbolic::from_i64(n);
    let mut solutions = Vec::new();
    let roots = (0..=LARGEST).flat_map(|b| (-LARGEST..=LARGEST).map(move |a| (a, b)));
    for (a, b) in roots {
        let factor = match b {
            0 => vec![-a, 1],
            _ => vec![a * a + b * b, -2 * a, 1],
        };
        let mut p = 0;
        while let Some(quotient) = divided(&mu, &factor) {
            let growth = Symbolic::function("exp", &times(a)).ok()? * &pow(x.clone(), p);
            let waves: &[&str] = if b == 0 { &["cos"] } else { &["cos", "sin"] };
            for wave in waves {
                solutions.push(Symbolic::function(wave, &times(b)).ok()? * &growth);
            }
            (mu, p) = (quotient, p + 1);
        }
    }
    (mu.len() == 1).then_some(solutions)
}

/// The quotient by a polynomial with leading coefficient 1, if it divides; the constant first.
fn divided(polynomial: &[Rational], factor: &[i64]) -> Option<Vec<Rational>> {
    let degree = factor.len() - 1;
    let mut rest = polynomial.to_vec();
    let mut quotient =
        vec![Rational::zero(); polynomial.len().checked_sub(degree).filter(|n| *n > 0)?];
    for at in (0..quotient.len()).rev() {
        let leading = rest[at + degree].clone();
        for (k, c) in factor.iter().enumerate() {
            let product = leading.clone() * &Rational::from(*c);
            rest[at + k] = rest[at + k].clone() - &product;
        }
        quotient[at] = leading;
    }
    rest.iter().all(Ring::vanishes).then_some(quotient)
}

/// The value at `x = 0`.
fn at_zero(f: &Symbolic, x: &str) -> Symbolic {
    let zero = Symbolic::zero();
    let (tan, exp) = (format!("tan({x}/2)"), format!("exp({x})"));
    let values = [(x.to_string(), zero.clone()), (tan, zero), (exp, Symbolic::one())];
    f.substitute(&values.into()).expect("an entire function")
}
