//! SE(3), the rigid motions of space.

use super::registry::Family;
use super::screws::{self, join, split};
use super::written::{Written, checked};
use super::{AnyGroup, Embedded, LieGroup, So3};
use crate::Error;
use nalgebra::{DMatrix, Isometry3, SVector, UnitQuaternion, Vector3, Vector6};

/// The rigid motions of space, `p -> R p + t`: body to spatial coordinates.
///
/// Elements are nalgebra's `Isometry3<f64>`, a unit quaternion and a translation.
/// Vectors are twists `(w, u)`, the angular velocity first, in the basis of the catalogue's `se(3)`:
/// `[(w, u), (w', u')] = (w cross w', w cross u' + u cross w')`.
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
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Se3;

pub(super) const FAMILY: Family = Family {
    pattern: "se(3)",
    summary: "homogeneous matrices of size 4",
    build: |_| AnyGroup::new(Se3),
};

#[inline(always)]
fn parts(g: &Isometry3<f64>) -> (UnitQuaternion<f64>, [Vector3<f64>; 1]) {
    (g.rotation, [g.translation.vector])
}

#[inline(always)]
fn whole((rotation, [t]): (UnitQuaternion<f64>, [Vector3<f64>; 1])) -> Isometry3<f64> {
    Isometry3::from_parts(t.into(), rotation)
}

impl LieGroup for Se3 {
    type Element = Isometry3<f64>;
    type Vector = Vector6<f64>;

    #[inline]
    fn dimension(&self) -> usize {
        6
    }

    fn identity(&self) -> Self::Element {
        Isometry3::identity()
    }

    #[inline]
    fn compose(&self, g: &Self::Element, h: &Self::Element) -> Self::Element {
        whole(screws::compose(parts(g), parts(h)))
    }

    #[inline]
    fn inverse(&self, g: &Self::Element) -> Self::Element {
        whole(screws::inverse(parts(g)))
    }

    /// `R = exp(w)`, `t = T_right(w) u`.
    #[inline]
    fn exp(&self, x: &Self::Vector) -> Self::Element {
        whole(screws::exp(split(x)))
    }

    /// With a rotation vector of length at most `pi`, as that of [`So3`].
    fn log(&self, g: &Self::Element) -> Result<Self::Vector, Error> {
        screws::log(parts(g)).map(join)
    }

    /// `(R w, R u + t cross R w)`.
    #[inline]
    fn adjoint(&self, g: &Self::Element, x: &Self::Vector) -> Self::Vector {
        join(screws::adjoint(parts(g), split(x)))
    }

    /// `(R^T (m + f cross t), R^T f)`.
    #[inline]
    fn coadjoint(&self, g: &Self::Element, h: &Self::Vector) -> Self::Vector {
        join(screws::coadjoint(parts(g), split(h)))
    }

    #[inline]
    fn coadjoint_exp(&self, x: &Self::Vector, h: &Self::Vector) -> Self::Vector {
        join(screws::coadjoint_exp::<1>(split(x), split(h)))
    }

    #[inline]
    fn restored(&self, g: Self::Element) -> Self::Element {
        let (rotation, vectors) = parts(&g);
        whole((So3.restored(rotation), vectors))
    }

    #[inline]
    fn translation(&self, x: &Self::Vector) -> Option<Self::Vector> {
        Some(join(screws::translation::<1>(split(x))))
    }

    #[inline]
    fn along_translations(&self, h: &Self::Vector) -> Option<Self::Vector> {
        Some(join(screws::translation::<1>(split(h))))
    }

    #[inline]
    fn turn(&self, g: &Self::Element) -> Self::Element {
        whole(screws::turn::<1>(parts(g)))
    }

    #[inline]
    fn coadjoint_back(&self, turn: &Self::Element, h: &Self::Vector) -> Self::Vector {
        join(screws::coadjoint_back::<1>(parts(turn), split(h)))
    }

    #[inline]
    fn turn_between(&self, g: &Self::Element, h: &Self::Element) -> Self::Element {
        whole(screws::turn_between::<1>(parts(g), parts(h)))
    }

    fn has_bounded_turns(&self) -> bool {
        true
    }

    #[inline]
    fn bracket(&self, x: &Self::Vector, y: &Self::Vector) -> Self::Vector {
        join(screws::bracket::<1>(split(x), split(y)))
    }

    /// Of size 4, homogeneous.
    fn matrix(&self, g: &Self::Element) -> DMatrix<f64> {
        screws::matrix(parts(g))
    }

    /// `[[T, 0], [Q, T]]`, where `T` is that of SO(3) at `w` and `Q` its derivative along `u`.
    #[inline]
    fn tangent_left(&self, x: &Self::Vector, v: &Self::Vector) -> Self::Vector {
        join(screws::tangent_left::<1>(split(x), split(v)))
    }

    /// Singular where that of [`So3`] is.
    #[inline]
    fn tangent_left_inverse(
        &self,
        x: &Self::Vector,
        v: &Self::Vector,
    ) -> Result<Self::Vector, Error> {
        screws::tangent_left_inverse::<1>(split(x), split(v)).map(join)
    }
}

/// The quaternion of the rotation, then `t`, with the rate `R u`.
impl Embedded for Se3 {
    type Numbers = SVector<f64, 7>;

    #[inline]
    fn numbers(&self, g: &Self::Element) -> SVector<f64, 7> {
        screws::numbers(parts(g))
    }

    #[inline]
    fn from_numbers(&self, y: &SVector<f64, 7>) -> Self::Element {
        whole(screws::from_numbers(y))
    }

    #[inline]
    fn rate(&self, g: &Self::Element, v: &Self::Vector) -> SVector<f64, 7> {
        self.rate_near(g, &self.restored(*g), v)
    }

    #[inline(always)]
    fn rate_near(
        &self,
        point: &Self::Element,
        projected: &Self::Element,
        v: &Self::Vector,
    ) -> SVector<f64, 7> {
        screws::rate(parts(point), parts(projected), split(v))
    }

    #[inline]
    fn is_place(&self, at: usize) -> bool {
        at >= 4
    }
}

/// The homogeneous matrix of size 4; quaternion and position by names.
impl Written for Se3 {
    fn read(&self, matrix: &DMatrix<f64>) -> Result<Self::Element, Error> {
        checked(self, matrix, |m| screws::read(m).map(whole))
    }

    fn is_angle(&self, at: usize) -> bool {
        at < 3
    }

    fn names(&self) -> &'static [&'static str] {
        &["qw", "qx", "qy", "qz", "x", "y", "z"]
    }

    fn named(&self, g: &Self::Element, k: usize) -> f64 {
        screws::named(parts(g), k)
    }

    fn entries(&self, g: &Self::Element, entries: &mut Vec<f64>) {
        screws::entries(parts(g), entries);
    }

    fn generators(&self) -> Vec<DMatrix<f64>> {
        screws::generators::<1>()
    }
}
