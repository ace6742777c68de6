//! SE(3), the rigid motions of space.

use super::semidirect_so3::SemidirectSo3;
use nalgebra::{Isometry3, SVector, UnitQuaternion, Vector3, Vector6};

/// The group of rigid motions of space, `p -> R p + t`, which map body coordinates to spatial
/// coordinates.
///
/// Elements are nalgebra's `Isometry3<f64>`, a unit quaternion and a translation. Vectors are
/// twists `(w, u)`, with the angular velocity first. The basis is the basis of `se(3)` in the
/// catalogue: `[(w, u), (w', u')] = (w cross w', w cross u' + u cross w')`.
///
/// ```
/// use affinor::group::{LieGroup, Se3};
/// use nalgebra::Vector6;
/// // half a turn about z with 2 units along it: a screw
/// let x = Vector6::new(0.0, 0.0, std::f64::consts::PI, 0.0, 0.0, 2.0);
/// let g = Se3.exp(&x);
/// assert_eq!(g.translation.z, 2.0);
/// assert!((Se3.log(&g)? - x).norm() < 1e-14);
/// # Ok::<(), affinor::Error>(())
/// ```
#[doc(alias("rigid motions", "pose", "screw", "SE(3)", "twist"))]
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Se3;

impl SemidirectSo3 for Se3 {
    type Pose = Isometry3<f64>;
    type Vectors = [Vector3<f64>; 1];
    type Components = Vector6<f64>;
    type Coordinates = SVector<f64, 7>;
    const NAMES: &'static [&'static str] = &["qw", "qx", "qy", "qz", "x", "y", "z"];

    #[inline(always)]
    fn parts(g: &Isometry3<f64>) -> (UnitQuaternion<f64>, [Vector3<f64>; 1]) {
        (g.rotation, [g.translation.vector])
    }

    #[inline(always)]
    fn whole(rotation: UnitQuaternion<f64>, [t]: [Vector3<f64>; 1]) -> Isometry3<f64> {
        Isometry3::from_parts(t.into(), rotation)
    }
}
