//! SE_2(3), attitude, velocity and position together.

use super::registry::Family;
use super::screws::{self, join, split};
use super::written::{Written, checked};
use super::{AnyGroup, Embedded, LieGroup, So3};
use crate::Error;
use nalgebra::{DMatrix, SVector, UnitQuaternion, Vector3};

/// The extended poses of inertial navigation: matrices `[[R, v, p], [0, 1]]` of size 5.
///
/// Vectors are `(w, a, u)`: rotation, velocity part and position part. Rotations act on `a` and `u`, which commute. A. Barrau and S. Bonnabel, *IEEE Transactions on Automatic Control* 62
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

pub(super) const FAMILY: Family = Family {
    pattern: "se_2(3)",
    summary: "matrices [[R, v, p], [0, 1]] of size 5",
    build: |_| AnyGroup::new(Se23),
};

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

#[inline(always)]
fn parts(g: &ExtendedPose) -> (UnitQuaternion<f64>, [Vector3<f64>; 2]) {
    (g.attitude, [g.velocity, g.position])
}

#[inline(always)]
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

    #[inline]
    fn along_translations(&self, h: &Self::Vector) -> Option<Self::Vector> {
        Some(join(screws::translation::<2>(split(h))))
    }

    fn turn(&self, g: &Self::Element) -> Self::Element {
        whole(screws::turn::<2>(parts(g)))
    }

    #[inline]
    fn coadjoint_back(&self, turn: &Self::Element, h: &Self::Vector) -> Self::Vector {
        join(screws::coadjoint_back::<2>(parts(turn), split(h)))
    }

    #[inline]
    fn turn_between(&self, g: &Self::Element, h: &Self::Element) -> Self::Element {
        whole(screws::turn_between::<2>(parts(g), parts(h)))
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

/// The quaternion of the rotation, then `v` and `p`, with the rates `R a` and `R u`.
impl Embedded for Se23 {
    type Numbers = SVector<f64, 10>;

    fn numbers(&self, g: &Self::Element) -> SVector<f64, 10> {
        screws::numbers(parts(g))
    }

    fn from_numbers(&self, y: &SVector<f64, 10>) -> Self::Element {
        whole(screws::from_numbers(y))
    }

    fn rate(&self, g: &Self::Element, v: &Self::Vector) -> SVector<f64, 10> {
        self.rate_near(g, &self.restored(*g), v)
    }

    #[inline(always)]
    fn rate_near(
        &self,
        point: &Self::Element,
        projected: &Self::Element,
        v: &Self::Vector,
    ) -> SVector<f64, 10> {
        screws::rate(parts(point), parts(projected), split(v))
    }

    #[inline]
    fn is_place(&self, at: usize) -> bool {
        at >= 4
    }
}

/// The matrix of size 5; quaternion, velocity and position by names.
impl Written for Se23 {
    fn read(&self, matrix: &DMatrix<f64>) -> Result<Self::Element, Error> {
        checked(self, matrix, |m| screws::read(m).map(whole))
    }

    fn is_angle(&self, at: usize) -> bool {
        at < 3
    }

    fn names(&self) -> &'static [&'static str] {
        &["qw", "qx", "qy", "qz", "vx", "vy", "vz", "x", "y", "z"]
    }

    fn named(&self, g: &Self::Element, k: usize) -> f64 {
        screws::named(parts(g), k)
    }

    fn entries(&self, g: &Self::Element, entries: &mut Vec<f64>) {
        screws::entries(parts(g), entries);
    }

    fn generators(&self) -> Vec<DMatrix<f64>> {
        screws::generators::<2>()
    }
}
