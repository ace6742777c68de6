//! Minimal polynomials in finite-dimensional algebras over the rationals.

use super::real_roots::squarefree;
use super::{Budget, TooLarge, Univariate};
use crate::linear::{Echelon, Matrix};
use crate::{Rational, Ring};
use num_traits::{One, Zero};
use polycore::Uni;

/// The minimal polynomial of the element 1 under a matrix, whose first component belongs to 1, and
/// the powers of the matrix applied to 1.
pub(super) fn minimal_polynomial(
    matrix: &Matrix<Rational>,
    budget: &mut Budget,
) -> Result<(Univariate, Vec<Vec<Rational>>), TooLarge> {
    let failed = TooLarge("it has no minimal polynomial");
    let n = matrix.rows();
    let mut power: Vec<Rational> = (0..n).map(|at| Rational::from(i64::from(at == 0))).collect();
    let mut powers: Vec<Vec<Rational>> = vec![];
    let mut span = Echelon::new();
    loop {
        budget.spend(n * n)?;
        let row = power.iter().cloned().enumerate().filter(|(_, v)| !v.vanishes());
        if !span.insert(row.collect::<Vec<_>>()).map_err(|_| failed)? {
            let columns = Matrix::from_dense(&powers).map_err(|_| failed)?.transpose();
            let solution = columns.solve(&power).ok().flatten().ok_or(failed)?;
            let coefficients = solution.into_iter().map(|c| -c).chain([Rational::one()]);
            return Ok((Uni::new(coefficients.collect()), powers));
        }
        let next = matrix.apply(&power).map_err(|_| failed)?;
        powers.push(std::mem::replace(&mut power, next));
    }
}

/// The minimal polynomial of the residue class of `h` modulo `f`.
pub(super) fn minimal_polynomial_of(
    h: &Univariate,
    f: &Univariate,
    budget: &mut Budget,
) -> Result<Univariate, TooLarge> {
    let n = f.deg();
    let column = |at: usize| {
        let image =
            &(h * &Uni::new([vec![Rational::zero(); at], vec![Rational::one()]].concat())) % f;
        (0..n).map(|i| image.0.get(i).cloned().unwrap_or_default()).collect::<Vec<_>>()
    };
    let columns: Vec<Vec<Rational>> = (0..n).map(column).collect();
    let failed = TooLarge("a coordinate has no minimal polynomial");
    let matrix = Matrix::from_dense(&columns).map_err(|_| failed)?.transpose();
    Ok(squarefree(&minimal_polynomial(&matrix, budget)?.0))
}
