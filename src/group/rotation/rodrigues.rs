//! Rodrigues parameters: the quaternion projected from its centre, or from its south pole.

use crate::Error;
use nalgebra::{Quaternion, UnitQuaternion, Vector3};

/// The vector of Gibbs (Cayley, Rodrigues) `v/w = tan(angle/2) n`.
///
/// ```
/// use affinor::group::rotation::{from_wxyz, gibbs};
/// let third = from_wxyz([0.5, 0.5, 0.5, 0.5])?; // a third of a turn
/// assert_eq!(gibbs(&third)?, nalgebra::Vector3::repeat(1.0));
/// assert!(gibbs(&from_wxyz([0.0, 0.0, 0.0, 1.0])?).is_err());
/// # Ok::<(), affinor::Error>(())
/// ```
///
/// # Errors
/// [`Error::Invalid`] at the angle `pi`, or so near to it that a component leaves the range of floats.
pub fn gibbs(g: &UnitQuaternion<f64>) -> Result<Vector3<f64>, Error> {
    let vector = g.imag() / g.w;
    if vector.iter().all(|c| c.is_finite()) {
        return Ok(vector);
    }
    Err(Error::Invalid { what: "Gibbs vector", reason: "the angle is pi".into() })
}

/// The rotation of a vector of Gibbs: `(1 + r)/sqrt(1 + |r|^2)`.
pub fn from_gibbs(r: &Vector3<f64>) -> UnitQuaternion<f64> {
    let scale = r.amax().max(1.0);
    let (w, v) = (1.0 / scale, r / scale);
    let length = (w * w + v.norm_squared()).sqrt();
    UnitQuaternion::new_unchecked(Quaternion::from_parts(w / length, v / length))
}

/// Modified Rodrigues parameters `v/(1 + w) = tan(angle/4) n` for the angle up to `pi`, where their length
/// reaches 1; at `pi` with the sign of [`wxyz`](super::wxyz).
pub fn modified(g: &UnitQuaternion<f64>) -> Vector3<f64> {
    let [w, x, y, z] = super::wxyz(g);
    Vector3::new(x, y, z) / (w + g.norm())
}

/// The rotation of modified Rodrigues parameters: `(1 - |p|^2 + 2 p)/(1 + |p|^2)`. Those of length above
/// 1 are angles between `pi` and `2 pi`.
pub fn from_modified(p: &Vector3<f64>) -> UnitQuaternion<f64> {
    let scale = p.amax().max(1.0);
    let (one, p) = (1.0 / scale, p / scale);
    let (first, second) = (one * one, p.norm_squared());
    let q = Quaternion::from_parts(first - second, p * (2.0 * one));
    UnitQuaternion::new_unchecked(q / (first + second))
}
