//! SE_2(3), attitude, velocity and position together.

use super::screws::{self, join, split};
use super::{LieGroup, So3, Stored};
use crate::Error;
use nalgebra::{DMatrix, SVector, UnitQuaternion, Vector3};

/// The extended poses of inertial navigation: matrices `[[R, v, p], [0, 1]]` of size 5.
///
/// Vectors are `(w, a, u)`: rotation, then what becomes velocity, then position; rotations act on
/// both, and both commute. A. Barrau and S. Bonnabel, *IEEE Transactions on Automatic Control* 62
/// (2017) 1797-1812.
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
    /// `R`, body to spatial components.
    pub attitude: UnitQuaternion<f64>,
    /// `v`, in spatial components.
    pub velocity: Vector3<f64>,
    /// `p`, in spatial components.
    pub position: Vector3<f64>,
}

fn parts(g: &ExtendedPose) -> (UnitQuaternion<f64>, [Vector3<f64>; 2]) {
    (g.attitude, [g.velocity, g.position])
}

fn whole(
    (attitude, [velocity, position]): (UnitQuaternion<f64>, [Vector3<f64>; 2]),
) -> ExtendedPose {
    ExtendedPose { attitude, velocity, position }
}

impl LieGroup for Se23 {
    type Element = ExtendedPose;
    type Vector = SVector<f64, 9>;

    fn dimension(&self) -> usize {
        9
    }

    fn identity(&self) -> Self::Element {
        whole((UnitQuaternion::identity(), [Vector3::zeros(); 2]))
    }

    fn compose(&self, g: &Self::Element, h: &Self::Element) -> Self::Element {
        whole(screws::compose(parts(g), parts(h)))
    }

    fn inverse(&self, g: &Self::Element) -> Self::Element {
        whole(screws::inverse(parts(g)))
    }

    /// `R = exp(w)`, `v = T_right(w) a`, `p = T_right(w) u`.
    fn exp(&self, x: &Self::Vector) -> Self::Element {
        whole(screws::exp(split(x)))
    }

    /// With a rotation vector of length at most `pi`.
    fn log(&self, g: &Self::Element) -> Result<Self::Vector, Error> {
        screws::log(parts(g)).map(join)
    }

    fn adjoint(&self, g: &Self::Element, x: &Self::Vector) -> Self::Vector {
        join(screws::adjoint(parts(g), split(x)))
    }

    /// `(R^T (m + f cross t), R^T f)`.
    fn coadjoint(&self, g: &Self::Element, h: &Self::Vector) -> Self::Vector {
        join(screws::coadjoint(parts(g), split(h)))
    }

    fn coadjoint_exp(&self, x: &Self::Vector, h: &Self::Vector) -> Self::Vector {
        join(screws::coadjoint_exp::<2>(split(x), split(h)))
    }

    fn restored(&self, g: Self::Element) -> Self::Element {
        let (rotation, vectors) = parts(&g);
        whole((So3.restored(rotation), vectors))
    }

    fn translation(&self, x: &Self::Vector) -> Option<Self::Vector> {
        Some(join(screws::translation::<2>(split(x))))
    }

    fn turn(&self, g: &Self::Element) -> Self::Element {
        whole(screws::turn::<2>(parts(g)))
    }

    fn has_bounded_turns(&self) -> bool {
        true
    }

    fn bracket(&self, x: &Self::Vector, y: &Self::Vector) -> Self::Vector {
        join(screws::bracket::<2>(split(x), split(y)))
    }

    /// Of size 5, homogeneous.
    fn matrix(&self, g: &Self::Element) -> DMatrix<f64> {
        screws::matrix(parts(g))
    }

    fn tangent_left(&self, x: &Self::Vector, v: &Self::Vector) -> Self::Vector {
        join(screws::tangent_left::<2>(split(x), split(v)))
    }

    fn tangent_left_inverse(
        &self,
        x: &Self::Vector,
        v: &Self::Vector,
    ) -> Result<Self::Vector, Error> {
        screws::tangent_left_inverse::<2>(split(x), split(v)).map(join)
    }
}

/// Those of the rotation, then `v` and `p` with the rates `R a` and `R u`.
impl Stored for Se23 {
    type Numbers = SVector<f64, 10>;

    fn numbers(&self, g: &Self::Element) -> SVector<f64, 10> {
        screws::numbers(parts(g))
    }

    fn from_numbers(&self, y: &SVector<f64, 10>) -> Self::Element {
        whole(screws::from_numbers(y))
    }

    fn rate(&self, g: &Self::Element, v: &Self::Vector) -> SVector<f64, 10> {
        screws::rate(parts(g), split(v))
    }

    fn places(&self) -> usize {
        6
    }
}
