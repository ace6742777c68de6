//! Tangent operators of any group, through the series in `ad` as a matrix function.

use super::{Coordinates, LieGroup};
use crate::Error;
use nalgebra::{DMatrix, DVector};

/// `sum M^k/(k+1)! = int_0^1 exp(s M) ds`, as the upper right block of the exponential of
/// `[[M, 1], [0, 0]]`.
///
/// C. F. Van Loan, *IEEE Transactions on Automatic Control* 23 (1978) 395-404.
///
/// ```
/// use affinor::group::series::phi1;
/// let m = nalgebra::dmatrix![0.0, 2.0; 0.0, 0.0];
/// assert_eq!(phi1(&m), nalgebra::dmatrix![1.0, 1.0; 0.0, 1.0]);
/// ```
pub fn phi1(m: &DMatrix<f64>) -> DMatrix<f64> {
    let n = m.nrows();
    let mut block = DMatrix::zeros(2 * n, 2 * n);
    block.view_mut((0, 0), (n, n)).copy_from(m);
    block.view_mut((0, n), (n, n)).fill_with_identity();
    block.exp().view((0, n), (n, n)).into_owned()
}

/// The matrix of `T_left(x)`.
fn operator<G: LieGroup + ?Sized>(group: &G, x: &G::Vector) -> DMatrix<f64> {
    let columns: Vec<G::Vector> = group.basis().iter().map(|e| group.bracket(e, x)).collect();
    let n = group.dimension();
    phi1(&DMatrix::from_fn(n, n, |i, k| columns[k].components()[i]))
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
