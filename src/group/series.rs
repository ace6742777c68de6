//! Tangent operators of any group, through the series in `ad` as a matrix function.

use super::{Coordinates, LieGroup};
use crate::Error;
use nalgebra::{DMatrix, DVector};

/// The exponential of a square matrix, for entries of any size: what overflows becomes infinite or
/// NaN, and an oscillation of more than `1e16` radians is noise.
///
/// ```
/// use affinor::group::series::exp;
/// use nalgebra::DMatrix;
/// let m = DMatrix::from_row_slice(2, 2, &[0.0, 1e300, 0.0, 0.0]);
/// assert_eq!(exp(&m)[(0, 1)], 1e300);
/// ```
pub fn exp(m: &DMatrix<f64>) -> DMatrix<f64> {
    let size = m.amax() * m.nrows() as f64;
    if m.is_empty() {
        m.clone()
    } else if !m.iter().all(|v| v.is_finite()) {
        DMatrix::from_element(m.nrows(), m.ncols(), f64::NAN)
    } else if size < 1e8 {
        m.exp()
    } else {
        // nalgebra forms sixth powers
        let halvings = size.log2().min(1100.0).ceil() as i32;
        let half =
            m.map(|v| v * 0.5_f64.powi(halvings / 2) * 0.5_f64.powi(halvings - halvings / 2));
        (0..halvings).fold(half.exp(), |e, _| &e * &e)
    }
}

/// `sum M^k/(k+1)! = int_0^1 exp(s M) ds`, as the upper right block of the exponential of
/// `[[M, 1], [0, 0]]`.
///
/// C. F. Van Loan, *IEEE Transactions on Automatic Control* 23 (1978) 395-404.
///
/// ```
/// use affinor::group::series::phi1;
/// use nalgebra::DMatrix;
/// let m = DMatrix::from_row_slice(2, 2, &[0.0, 2.0, 0.0, 0.0]);
/// assert_eq!(phi1(&m), DMatrix::from_row_slice(2, 2, &[1.0, 1.0, 0.0, 1.0]));
/// ```
pub fn phi1(m: &DMatrix<f64>) -> DMatrix<f64> {
    let n = m.nrows();
    let mut block = DMatrix::zeros(2 * n, 2 * n);
    block.view_mut((0, 0), (n, n)).copy_from(m);
    block.view_mut((0, n), (n, n)).fill_with_identity();
    exp(&block).view((0, n), (n, n)).into_owned()
}

/// The matrix of `T_left(x)`.
fn operator<G: LieGroup + ?Sized>(group: &G, x: &G::Vector) -> DMatrix<f64> {
    phi1(&group.operator(|v| group.bracket(v, x)))
}

pub(super) fn tangent_left<G: LieGroup + ?Sized>(
    group: &G,
    x: &G::Vector,
    v: &G::Vector,
) -> G::Vector {
    let v = DVector::from_column_slice(v.components());
    G::Vector::from_components((operator(group, x) * v).as_slice())
}

pub(super) fn tangent_left_inverse<G: LieGroup + ?Sized>(
    group: &G,
    x: &G::Vector,
    v: &G::Vector,
) -> Result<G::Vector, Error> {
    let v = DVector::from_column_slice(v.components());
    let solution = operator(group, x).lu().solve(&v).filter(|u| u.iter().all(|u| u.is_finite()));
    let solution = solution.ok_or_else(|| Error::SingularTangent { x: x.components().to_vec() })?;
    Ok(G::Vector::from_components(solution.as_slice()))
}
