//! Quaternions as four numbers.

use crate::Error;
use nalgebra::{Quaternion, UnitQuaternion};

/// `w, x, y, z` with the first that is not zero positive: one list for one rotation.
pub fn wxyz(g: &UnitQuaternion<f64>) -> [f64; 4] {
    let q = [g.w, g.i, g.j, g.k];
    let negative = q.iter().find(|q| **q != 0.0).is_some_and(|q| *q < 0.0);
    if negative { q.map(|q| 0.0 - q) } else { q.map(|q| q + 0.0) }
}

/// The rotation of a quaternion `w, x, y, z` of any length but zero.
///
/// ```
/// use affinor::group::rotation::{from_wxyz, wxyz};
/// assert_eq!(wxyz(&from_wxyz([0.0, -3e200, 0.0, 4e200])?), [0.0, 0.6, 0.0, -0.8]);
/// assert!(from_wxyz([0.0; 4]).is_err());
/// # Ok::<(), affinor::Error>(())
/// ```
///
/// # Errors
/// [`Error::Invalid`] if it is zero or not finite.
pub fn from_wxyz([w, x, y, z]: [f64; 4]) -> Result<UnitQuaternion<f64>, Error> {
    let q = Quaternion::new(w, x, y, z);
    let largest = q.coords.amax();
    if !(largest > 0.0 && q.coords.iter().all(|q| q.is_finite())) {
        let reason = format!("the quaternion {w}, {x}, {y}, {z} has no direction");
        return Err(Error::Invalid { what: "rotation", reason });
    }
    // denormal components need two steps
    let scaled = if largest < 1e-300 { q * 1e300 } else { q };
    let unit = scaled / scaled.coords.amax();
    Ok(UnitQuaternion::new_unchecked(unit / unit.norm()))
}
