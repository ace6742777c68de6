//! Conversions of rotations from and to quaternion components, matrices and Rodrigues parameters.

use super::formulas;
use crate::Error;
use nalgebra::{Matrix3, Quaternion, UnitQuaternion, Vector3};

/// The components `w, x, y, z` of the quaternion. Its sign is chosen so that the first nonzero
/// component is positive; the components are then unique for a rotation.
pub fn wxyz(g: &UnitQuaternion<f64>) -> [f64; 4] {
    let q = [g.w, g.i, g.j, g.k];
    let negative = q.iter().find(|q| **q != 0.0).is_some_and(|q| *q < 0.0);
    if negative { q.map(|q| 0.0 - q) } else { q.map(|q| q + 0.0) }
}

/// The rotation of a quaternion `w, x, y, z` of any nonzero length.
///
/// ```
/// use affinor::group::rotation::{from_wxyz, wxyz};
/// assert_eq!(wxyz(&from_wxyz([0.0, -3e200, 0.0, 4e200])?), [0.0, 0.6, 0.0, -0.8]);
/// assert!(from_wxyz([0.0; 4]).is_err());
/// # Ok::<(), affinor::Error>(())
/// ```
///
/// # Errors
/// [`Error::Invalid`] if the quaternion is zero or not finite.
pub fn from_wxyz([w, x, y, z]: [f64; 4]) -> Result<UnitQuaternion<f64>, Error> {
    let q = Quaternion::new(w, x, y, z);
    let largest = q.coords.amax();
    if !(largest > 0.0 && q.coords.iter().all(|q| q.is_finite())) {
        let reason = format!("the quaternion {w}, {x}, {y}, {z} is zero or not finite");
        return Err(Error::Invalid { what: "rotation", reason });
    }
    // scales the components first, because the norm of subnormal components is inaccurate
    let scaled = if largest < 1e-300 { q * 1e300 } else { q };
    let unit = scaled / scaled.coords.amax();
    Ok(UnitQuaternion::new_unchecked(unit / unit.norm()))
}

/// The matrix `R = 1 + (2/|q|^2) (w spin(v) + spin(v)^2)`. Its columns are the rotated basis
/// vectors.
///
/// This form is homogeneous of degree 0. Therefore, `R` is orthogonal to 4 machine epsilons even if
/// the length of the quaternion has drifted from 1.
pub fn matrix(g: &UnitQuaternion<f64>) -> Matrix3<f64> {
    Matrix3::from_row_slice(&formulas::matrix([g.w, g.i, g.j, g.k]))
}

/// The rotation of a matrix. Every entry of `R^T R` must agree with 1 up to `tolerance`, and the
/// determinant must be positive.
///
/// The quaternion is computed from its largest component, so that no division amplifies
/// cancellation (S. W. Shepperd, *J. Guidance and Control* 1 (1978) 223-224).
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
/// [`Error::Invalid`] with the deviation of `R^T R` from 1.
pub fn from_matrix(r: &Matrix3<f64>, tolerance: f64) -> Result<UnitQuaternion<f64>, Error> {
    let defect = (r.transpose() * r - Matrix3::identity()).abs();
    // also tests the sum, because the maximum ignores NaN
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
    from_wxyz(formulas::shepperd(&std::array::from_fn(|at| r[(at / 3, at % 3)])))
}

/// The Gibbs vector (Cayley, Rodrigues) `v/w = tan(angle/2) n`.
///
/// ```
/// use affinor::group::rotation::{from_wxyz, rodrigues};
/// let third = from_wxyz([0.5, 0.5, 0.5, 0.5])?; // a third of a turn
/// assert_eq!(rodrigues(&third)?, nalgebra::Vector3::repeat(1.0));
/// assert!(rodrigues(&from_wxyz([0.0, 0.0, 0.0, 1.0])?).is_err());
/// # Ok::<(), affinor::Error>(())
/// ```
///
/// # Errors
/// [`Error::Invalid`] if the angle is `pi`, or so near `pi` that a component overflows.
#[doc(alias("Gibbs vector", "Cayley"))]
pub fn rodrigues(g: &UnitQuaternion<f64>) -> Result<Vector3<f64>, Error> {
    let vector = g.imag() / g.w;
    if vector.iter().all(|c| c.is_finite()) {
        return Ok(vector);
    }
    Err(Error::Invalid { what: "Gibbs vector", reason: "the angle is pi".into() })
}

/// The rotation of a Gibbs vector: `(1 + r)/sqrt(1 + |r|^2)`.
pub fn from_rodrigues(r: &Vector3<f64>) -> UnitQuaternion<f64> {
    let scale = r.amax().max(1.0);
    let (w, v) = (1.0 / scale, r / scale);
    let length = (w * w + v.norm_squared()).sqrt();
    UnitQuaternion::new_unchecked(Quaternion::from_parts(w / length, v / length))
}

/// The modified Rodrigues parameters `v/(1 + w) = tan(angle/4) n` of the angle between 0 and `pi`.
/// Their length is 1 at `pi`, where they have the sign of [`wxyz`].
pub fn modified_rodrigues(g: &UnitQuaternion<f64>) -> Vector3<f64> {
    let [w, x, y, z] = wxyz(g);
    Vector3::new(x, y, z) / (w + g.norm())
}

/// The rotation of modified Rodrigues parameters: `(1 - |p|^2 + 2 p)/(1 + |p|^2)`. Parameters of
/// length above 1 represent angles between `pi` and `2 pi`.
pub fn from_modified_rodrigues(p: &Vector3<f64>) -> UnitQuaternion<f64> {
    let scale = p.amax().max(1.0);
    let (one, p) = (1.0 / scale, p / scale);
    let (first, second) = (one * one, p.norm_squared());
    let q = Quaternion::from_parts(first - second, p * (2.0 * one));
    UnitQuaternion::new_unchecked(q / (first + second))
}
