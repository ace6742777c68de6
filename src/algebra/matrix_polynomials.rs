//! Polynomials of matrices over the rationals.

use affinor_tensors::Rational;
use affinor_tensors::linear::Matrix;
use num_rational::BigRational;
use polycore::Uni;

/// The polynomial `t^m - sum of s_k t^k` that belongs to a relation `x^m = sum of s_k x^k`.
pub(crate) fn monic(relation: &[Rational]) -> Uni<BigRational> {
    let coefficients = relation.iter().map(|value| -BigRational::from(value));
    Uni::new(coefficients.chain([BigRational::from_integer(1.into())]).collect())
}

/// The minimal polynomial of a matrix, which is the relation for the first power that depends on
/// lower powers.
pub(crate) fn minimal_polynomial(matrix: &Matrix<Rational>) -> Option<Uni<BigRational>> {
    let n = matrix.rows();
    let flat = |m: &Matrix<Rational>| m.to_dense().concat();
    let mut power = Matrix::identity(n);
    let mut powers = vec![];
    loop {
        let next = flat(&power);
        if !powers.is_empty() {
            let system = Matrix::from_dense(&powers).ok()?.transpose();
            if let Some(solution) = system.solve(&next).ok()? {
                return Some(monic(&solution));
            }
        }
        powers.push(next);
        power = power.mul(matrix).ok()?;
    }
}

/// The value of a polynomial at a matrix.
pub(crate) fn evaluate(
    matrix: &Matrix<Rational>,
    polynomial: &Uni<BigRational>,
) -> Matrix<Rational> {
    let n = matrix.rows();
    let square = "square matrices of one size";
    polynomial.0.iter().rev().fold(Matrix::zero(n, n), |value, coefficient| {
        let constant = Rational::from(coefficient.clone());
        let shift = Matrix::diagonal(std::iter::repeat_n(constant, n));
        value.mul(matrix).expect(square).add(&shift).expect(square)
    })
}
