//! Logarithms of matrices with rounding errors. The result is the vector of the algebra whose
//! exponential is nearest to the matrix.
//!
//! The principal logarithm of a matrix multiplies rounding errors by `|g| |g^-1|`, which for a
//! boost is the square of the largest entry. Most of these errors are directed away from the group.
//! In the logarithm of the nearest element, the errors are multiplied only by `|g|`.

use super::span::Span;
use crate::group::matrices::TOLERANCE;
use crate::numerics::double::{exp_less_identity, mapped, rounded};
use crate::numerics::exponential::{balance, balanced_by, exp};
use affinor_tensors::stop::checkpoint;
use nalgebra::{DMatrix, DVector};

/// The largest number of Gauss-Newton steps.
const STEPS: usize = 8;

/// The largest number of multiplications for one derivative. If a group needs more of them, the
/// nearest element is not computed.
const WORK: usize = 10_000_000;

/// The iteration ends if the relative length of a step is at most this value.
const SETTLED: f64 = 4.0 * f64::EPSILON;

/// The largest accepted relative distance of the nearest element. It equals the tolerance for
/// matrices that are read as elements.
const OFF: f64 = TOLERANCE;

/// The coordinates `x` that minimize `|exp(x^i B_i) - g|`, starting from an initial guess. Returns
/// `None` if the distance of `g` from the group exceeds the rounding errors, or if the iteration
/// does not converge.
pub(super) fn nearest(span: &Span, g: &DMatrix<f64>, x: &DVector<f64>) -> Option<DVector<f64>> {
    let exponents = balance(g);
    let target = balanced_by(g, &exponents);
    let less_one = &target - DMatrix::identity(g.nrows(), g.ncols());
    let mut x = x.clone();
    let mut before = f64::INFINITY;
    for _ in 0..STEPS {
        checkpoint();
        let generator = balanced_by(&span.combination(&x), &exponents);
        // uses double-double arithmetic, because the difference is of the size of rounding errors
        let exact = span.double_combination(&x);
        let exact = exp_less_identity(&mapped(&exact, |m| balanced_by(m, &exponents)));
        let off = rounded(&(less_one.map(Into::into) - exact));
        let step = pseudoinverse(&derivative(span, &generator, &exponents)?)?
            * DVector::from_column_slice(off.as_slice());
        let length = step.norm();
        x += step;
        if length <= SETTLED * x.norm() || length >= 0.5 * before {
            return (length <= OFF * x.norm() && off.norm() <= OFF * target.norm()).then_some(x);
        }
        before = length;
    }
    None
}

/// A bound on the changes of the coordinates `x` of `log(g)` if each entry of `g` is rounded once.
/// Returns `None` if the exponential is not a local chart at `x`.
pub(super) fn rounding(span: &Span, g: &DMatrix<f64>, x: &DVector<f64>) -> Option<f64> {
    let exponents = balance(g);
    let generator = balanced_by(&span.combination(x), &exponents);
    let inverse = pseudoinverse(&derivative(span, &generator, &exponents)?)?.abs();
    let entries = balanced_by(g, &exponents).abs();
    let changes = inverse * DVector::from_column_slice(entries.as_slice());
    Some(0.5 * f64::EPSILON * changes.amax())
}

/// The derivative of `x -> exp(x^i B_i)`, with one column for each `B_i`. The column is the upper
/// right block of `exp([[X, B_i], [0, X]])`. Returns `None` if the computation needs more than
/// [`WORK`] multiplications.
fn derivative(span: &Span, x: &DMatrix<f64>, exponents: &[i32]) -> Option<DMatrix<f64>> {
    let n = x.nrows();
    if span.dimension().saturating_mul((2 * n).saturating_pow(3)) > WORK {
        return None;
    }
    let mut block = DMatrix::zeros(2 * n, 2 * n);
    [0, n].into_iter().for_each(|at| block.view_mut((at, at), (n, n)).copy_from(x));
    let mut derivative = DMatrix::zeros(n * n, span.dimension());
    for (at, mut column) in derivative.column_iter_mut().enumerate() {
        checkpoint();
        let along = balanced_by(&span.matrix(at), exponents);
        block.view_mut((0, n), (n, n)).copy_from(&along);
        let moved = exp(&block).view((0, n), (n, n)).into_owned();
        column.copy_from_slice(moved.as_slice());
    }
    Some(derivative)
}

/// The pseudoinverse `(J^T J)^-1 J^T`, computed by QR. Returns `None` if the columns are dependent
/// or not finite.
fn pseudoinverse(j: &DMatrix<f64>) -> Option<DMatrix<f64>> {
    let (q, r) = j.clone().qr().unpack();
    let inverse = r.solve_upper_triangular(&q.transpose())?;
    inverse.iter().all(|value| value.is_finite()).then_some(inverse)
}
