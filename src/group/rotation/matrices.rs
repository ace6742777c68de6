//! Rotation matrices.

use super::from_wxyz;
use crate::Error;
use nalgebra::{Matrix3, UnitQuaternion};

/// The matrix `R = ((w^2 - |v|^2) 1 + 2 w spin(v) + 2 v v^T)/|q|^2`: columns are the turned basis vectors.
///
/// In this form, homogeneous of degree 0, `R` is orthogonal to 4 machine epsilons even if the length of the
/// quaternion has drifted from 1.
pub fn matrix(g: &UnitQuaternion<f64>) -> Matrix3<f64> {
    let [x, y, z, w] = g.coords.into();
    let [xx, yy, zz, ww] = [x * x, y * y, z * z, w * w];
    let square = (ww + xx) + (yy + zz);
    Matrix3::new(
        (ww + xx) - (yy + zz),
        2.0 * (x * y - w * z),
        2.0 * (x * z + w * y),
        2.0 * (x * y + w * z),
        (ww + yy) - (xx + zz),
        2.0 * (y * z - w * x),
        2.0 * (x * z - w * y),
        2.0 * (y * z + w * x),
        (ww + zz) - (xx + yy),
    ) / square
}

/// The rotation of a matrix with `R^T R = 1` up to `tolerance` in every entry, and positive
/// determinant.
///
/// S. W. Shepperd, *J. Guidance and Control* 1 (1978) 223-224: the quaternion is read off around its largest
/// component, so no difference of near equals is divided by.
///
/// ```
/// use affinor::group::rotation::{from_matrix, wxyz};
/// let half_turn = nalgebra::Matrix3::from_diagonal(&[-1.0, 1.0, -1.0].into());
/// assert_eq!(wxyz(&from_matrix(&half_turn, 0.0)?), [0.0, 0.0, 1.0, 0.0]);
/// assert!(from_matrix(&-half_turn, 0.0).is_err());
/// # Ok::<(), affinor::Error>(())
/// ```
///
/// # Errors
/// [`Error::Invalid`] with the defect.
pub fn from_matrix(r: &Matrix3<f64>, tolerance: f64) -> Result<UnitQuaternion<f64>, Error> {
    let defect = (r.transpose() * r - Matrix3::identity()).abs();
    // by sum and not by max, in which NaN is lost
    if !(defect.sum().is_finite() && defect.max() <= tolerance) {
        let reason = format!("R^T R differs from 1 by {:e}", defect.max());
        return Err(Error::Invalid { what: "rotation", reason });
    }
    if r.determinant() < 0.0 {
        return Err(Error::Invalid {
            what: "rotation",
            reason: "the matrix is a reflection".into(),
        });
    }
    let [a, b, c] = [r[(0, 0)], r[(1, 1)], r[(2, 2)]];
    let sum = |i: usize, j: usize| r[(i, j)] + r[(j, i)];
    let difference = |i: usize, j: usize| r[(i, j)] - r[(j, i)];
    let (w, x, y, z) = (difference(2, 1), difference(0, 2), difference(1, 0), a + b + c);
    let largest = [z, a, b, c].into_iter().fold(f64::NEG_INFINITY, f64::max);
    // four times one component, times all of them
    from_wxyz(if largest == z {
        [1.0 + z, w, x, y]
    } else if largest == a {
        [w, 1.0 + a - b - c, sum(0, 1), sum(0, 2)]
    } else if largest == b {
        [x, sum(0, 1), 1.0 + b - c - a, sum(1, 2)]
    } else {
        [y, sum(0, 2), sum(1, 2), 1.0 + c - a - b]
    })
}
