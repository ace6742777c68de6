//! SO(3), the rotations of space, as unit quaternions.

use super::{LieGroup, cubic};
use crate::Error;
use nalgebra::{DMatrix, Quaternion, UnitQuaternion, Vector3};

/// The rotations of space: `R` maps body to spatial components, `Rdot = R spin(Omega)`.
///
/// Elements are unit quaternions `w, x, y, z`, vectors rotation vectors in radians (the canonical
/// coordinates of the first kind (61), (74)), and `[x, y] = x cross y`. The quaternions `q` and `-q` are one rotation.
///
/// ```
/// use affinor::group::{LieGroup, So3};
/// use nalgebra::Vector3;
/// let x = Vector3::new(0.0, 1e-170, 0.0); // its square underflows
/// assert_eq!(So3.log(&So3.exp(&x))?, x);
/// # Ok::<(), affinor::Error>(())
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct So3;

/// Squares of lengths between these neither overflow nor lose digits.
const SQUARES: std::ops::RangeInclusive<f64> = 1e-280..=1e280;

impl LieGroup for So3 {
    type Element = UnitQuaternion<f64>;
    type Vector = Vector3<f64>;

    fn dimension(&self) -> usize {
        3
    }

    fn identity(&self) -> Self::Element {
        UnitQuaternion::identity()
    }

    /// The product of quaternions. It is not normalised again: its norm strays by one rounding a product.
    fn compose(&self, g: &Self::Element, h: &Self::Element) -> Self::Element {
        g * h
    }

    fn inverse(&self, g: &Self::Element) -> Self::Element {
        g.inverse()
    }

    /// `cos(|x|/2) + sin(|x|/2) x/|x|`, (77). An angle beyond `2 pi` is as exact as its own
    /// rounding lets it be: to `|x|` machine epsilons.
    fn exp(&self, x: &Self::Vector) -> Self::Element {
        let square = x.norm_squared();
        let (w, v) = if SQUARES.contains(&square) {
            let angle = square.sqrt();
            let (sin, cos) = (0.5 * angle).sin_cos();
            (cos, x * (sin / angle))
        } else if square < 1.0 {
            (1.0, x * 0.5)
        } else {
            let largest = x.amax();
            let unit = x / largest;
            let length = unit.norm();
            // a length beyond the range of floats is halved where it still fits
            let (sin, cos) = (0.5 * largest * length).sin_cos();
            (cos, unit * (sin / length))
        };
        UnitQuaternion::new_unchecked(Quaternion::from_parts(w, v))
    }

    /// The rotation vector of length at most `pi`, from the quaternion with `w >= 0`. At exactly `pi`
    /// (`w = 0`) its first component that is not zero is positive.
    fn log(&self, g: &Self::Element) -> Result<Self::Vector, Error> {
        Ok(rotation_vector(g))
    }

    fn adjoint(&self, g: &Self::Element, x: &Self::Vector) -> Self::Vector {
        g * x
    }

    fn bracket(&self, x: &Self::Vector, y: &Self::Vector) -> Self::Vector {
        x.cross(y)
    }

    /// The rotation matrix `R`.
    fn matrix(&self, g: &Self::Element) -> DMatrix<f64> {
        let matrix = g.to_rotation_matrix();
        DMatrix::from_column_slice(3, 3, matrix.matrix().as_slice())
    }

    /// `v - c_2 x cross v + c_3 x cross (x cross v)` with the Stumpff functions of `|x|^2`: the
    /// map that stands behind (86).
    fn tangent_left(&self, x: &Self::Vector, v: &Self::Vector) -> Self::Vector {
        cubic::tangent_left(self, Vector3::norm_squared, x, v)
    }

    /// `v + x cross v/2 + d x cross (x cross v)`, `d` of
    /// [`inverse_tangent`](super::stumpff::inverse_tangent); singular at `|x| = 2 pi k`, `k > 0`.
    fn tangent_left_inverse(
        &self,
        x: &Self::Vector,
        v: &Self::Vector,
    ) -> Result<Self::Vector, Error> {
        cubic::tangent_left_inverse(self, Vector3::norm_squared, x, v)
    }
}

impl So3 {
    /// The logarithm nearest to a given rotation vector: `log(g) + 2 pi k n` along its own axis
    /// `n`. It follows a motion past `pi`, where [`LieGroup::log`] jumps.
    ///
    /// ```
    /// use affinor::group::{LieGroup, So3};
    /// use nalgebra::Vector3;
    /// let x = Vector3::new(0.0, 0.0, 10.0); // more than one turn
    /// let before = Vector3::new(0.1, 0.0, 9.8);
    /// assert!((So3.log_near(&So3.exp(&x), &before) - x).norm() < 1e-14);
    /// ```
    pub fn log_near(&self, g: &UnitQuaternion<f64>, near: &Vector3<f64>) -> Vector3<f64> {
        let x = rotation_vector(g);
        let angle = x.norm();
        // at the identity every axis will do
        let axis =
            if angle > 0.0 { x / angle } else { near.try_normalize(0.0).unwrap_or_default() };
        let turns = ((near.dot(&axis) - angle) / std::f64::consts::TAU).round();
        x + axis * (turns * std::f64::consts::TAU)
    }
}

/// The rotation vector of length at most `pi`.
fn rotation_vector(g: &UnitQuaternion<f64>) -> Vector3<f64> {
    let (mut w, mut v) = (g.w, g.imag());
    let points_back = || v.iter().find(|v| **v != 0.0).is_some_and(|v| *v < 0.0);
    if w < 0.0 || (w == 0.0 && points_back()) {
        (w, v) = (-w, -v);
    }
    let square = v.norm_squared();
    if square < 1e-20 {
        return v * (2.0 / w);
    }
    let sin = square.sqrt();
    v * (2.0 * sin.atan2(w) / sin)
}
