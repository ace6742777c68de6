//! SE_2(3): attitude, velocity and position together.

use super::semidirect_so3::SemidirectSo3;
use nalgebra::{SVector, UnitQuaternion, Vector3};

/// The group of extended poses of inertial navigation. Its elements are matrices
/// `[[R, v, p], [0, 1]]` of size 5.
///
/// Vectors `(w, a, u)` consist of a rotation part, a velocity part and a position part. Rotations
/// act on `a` and `u`, which commute with each other. A. Barrau and S. Bonnabel, *IEEE Transactions
/// on Automatic Control* 62 (2017) 1797-1812.
///
/// ```
/// use affinor::group::{LieGroup, Se23};
/// use nalgebra::SVector;
/// let x = SVector::from([0.0, 0.0, 0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0]);
/// let g = Se23.exp(&x); // without a rotation nothing couples
/// assert_eq!((g.velocity.x, g.position.z), (1.0, 6.0));
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Se23;

/// An element of [`Se23`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ExtendedPose {
    /// The attitude `R`, which maps body components to spatial components.
    pub attitude: UnitQuaternion<f64>,
    /// The velocity `v`, in spatial components.
    pub velocity: Vector3<f64>,
    /// The position `p`, in spatial components.
    pub position: Vector3<f64>,
}

impl SemidirectSo3 for Se23 {
    type Pose = ExtendedPose;
    type Vectors = [Vector3<f64>; 2];
    type Components = SVector<f64, 9>;
    type Coordinates = SVector<f64, 10>;
    const NAMES: &'static [&'static str] =
        &["qw", "qx", "qy", "qz", "vx", "vy", "vz", "x", "y", "z"];

    #[inline(always)]
    fn parts(g: &ExtendedPose) -> (UnitQuaternion<f64>, [Vector3<f64>; 2]) {
        (g.attitude, [g.velocity, g.position])
    }

    #[inline(always)]
    fn whole(attitude: UnitQuaternion<f64>, vectors: [Vector3<f64>; 2]) -> ExtendedPose {
        let [velocity, position] = vectors;
        ExtendedPose { attitude, velocity, position }
    }
}
