//! SO(3), the rotations of space, as unit quaternions.

use crate::group::TranslationSplit;
use crate::group::matrices::{MatrixNotation, TOLERANCE, checked, replace, spins};
use crate::group::rotation;
use crate::group::{Embedded, LieGroup};
use crate::numerics::lanes::Lane;
use crate::numerics::stumpff::{FAR, Stumpff, first_two, inverse_tangent, polynomial, turning};
use crate::{Error, Law};
use nalgebra::{DMatrix, Quaternion, UnitQuaternion, Vector3, Vector4};

/// The group of rotations of space: `R` maps body to spatial components, and
/// `Rdot = R spin(Omega)`.
///
/// Elements are nalgebra's `UnitQuaternion<f64>`; [`rotation`] converts them from and to matrices,
/// Euler angles and other coordinates. Vectors are rotation vectors in radians, which are canonical
/// coordinates of the first kind (equations (61), (74)); the bracket is `[x, y] = x cross y`. The
/// quaternions `q` and `-q` represent the same rotation.
///
/// ```
/// use affinor::group::{LieGroup, So3};
/// use nalgebra::Vector3;
/// let x = Vector3::new(0.0, 1e-170, 0.0); // its square underflows
/// assert_eq!(So3.log(&So3.exp(&x))?, x);
/// # Ok::<(), affinor::Error>(())
/// ```
#[doc(alias("rotation group", "quaternion", "SO(3)"))]
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct So3;

/// Below this squared length, the common formula of the exponential is used. The value is far below
/// the largest float, so the squared length has not overflowed.
const LARGE: f64 = 1e280;

impl LieGroup for So3 {
    type Element = UnitQuaternion<f64>;
    type Vector = Vector3<f64>;

    #[inline]
    fn dimension(&self) -> usize {
        3
    }

    fn identity(&self) -> Self::Element {
        UnitQuaternion::identity()
    }

    /// The product of quaternions. The product is not normalized: its norm drifts by one rounding
    /// error per product.
    #[inline]
    fn compose(&self, g: &Self::Element, h: &Self::Element) -> Self::Element {
        g * h
    }

    #[inline]
    fn inverse(&self, g: &Self::Element) -> Self::Element {
        g.inverse()
    }

    /// Returns `cos(|x|/2) + sin(|x|/2) x/|x|`, equation (77). The result is accurate up to a few
    /// rounding errors. For `|x| > 2 pi`, the rounding of the angle causes an error of about `|x|`
    /// rounding errors.
    #[inline]
    fn exp(&self, x: &Self::Vector) -> Self::Element {
        let square = x.norm_squared();
        if square < LARGE {
            let (cos, sin) = first_two(0.25 * square);
            return UnitQuaternion::new_unchecked(Quaternion::from_parts(cos, x * (0.5 * sin)));
        }
        exp_far(x)
    }

    /// The rotation vector, whose length is at most `pi`. It is computed from the quaternion with
    /// `w >= 0`. If the length is exactly `pi` (`w = 0`), the first nonzero component is positive.
    /// The quaternion need not be normalized.
    #[inline]
    fn log(&self, g: &Self::Element) -> Result<Self::Vector, Error> {
        let v = g.imag();
        let square = v.norm_squared();
        let norm = g.w * g.w + square;
        if is_unit(norm) {
            return Ok(v * logarithm(g.coords.into(), square, norm));
        }
        let unit = rotation::from_wxyz([g.w, g.i, g.j, g.k])?;
        let square = unit.imag().norm_squared();
        Ok(unit.imag() * logarithm(unit.coords.into(), square, 1.0))
    }

    #[inline]
    fn adjoint(&self, g: &Self::Element, x: &Self::Vector) -> Self::Vector {
        g * x
    }

    /// Returns `R^T h`.
    #[inline]
    fn coadjoint(&self, g: &Self::Element, h: &Self::Vector) -> Self::Vector {
        g.to_rotation_matrix().matrix().tr_mul(h)
    }

    /// Returns `h - c_1 x cross h + c_2 x cross (x cross h)` with the Stumpff functions of `|x|^2`.
    #[inline(always)]
    fn coadjoint_exp(&self, x: &Self::Vector, h: &Self::Vector) -> Self::Vector {
        let square = x.norm_squared();
        if square < FAR {
            let (c1, c2) = turning(square);
            let turned = x.cross(h);
            return (h - turned * c1) + x.cross(&turned) * c2;
        }
        exp_far(x).inverse_transform_vector(h)
    }

    #[inline]
    fn bracket(&self, x: &Self::Vector, y: &Self::Vector) -> Self::Vector {
        x.cross(y)
    }

    /// Normalizes the quaternion without bias. The code computes the squared length minus 1
    /// directly. Floats below 1 are finer than floats above 1, so the rounding of the squared
    /// length itself would cause a bias over a million steps.
    #[inline]
    fn project(&self, g: Self::Element) -> Self::Element {
        let q = g.into_inner();
        let off = q.w * q.w - 1.0 + q.i * q.i + q.j * q.j + q.k * q.k;
        if off.abs() < 1e-8 {
            return UnitQuaternion::new_unchecked(q - q * (0.5 * off));
        }
        UnitQuaternion::new_unchecked(q * (1.0 / q.norm_squared().sqrt()))
    }

    /// The rotation matrix `R`.
    fn matrix(&self, g: &Self::Element) -> DMatrix<f64> {
        DMatrix::from_column_slice(3, 3, rotation::matrix(g).as_slice())
    }

    /// Returns `c_1 v - c_2 x cross v + c_3 x (x . v)` with the Stumpff functions of `|x|^2`, which
    /// is the map of equation (86).
    #[inline]
    fn tangent_left(&self, x: &Self::Vector, v: &Self::Vector) -> Self::Vector {
        let square = x.norm_squared();
        in_range(v, |v| {
            if square > FAR {
                // for a large angle, only the component along x is significant
                let unit = (x / x.amax()).normalize();
                return unit * unit.dot(v);
            }
            let c = Stumpff::at(square);
            v * c.c1 - x.cross(v) * c.c2 + x * (c.c3 * x.dot(v))
        })
    }

    /// Returns `(1 - d |x|^2) v + x cross v/2 + d x (x . v)` , where `inverse_tangent` computes
    /// `d`. The operator is singular at `|x| = 2 pi k`, `k > 0`. Returns an error if the distance
    /// of the length from these values is less than its rounding error.
    #[inline]
    fn tangent_left_inverse(
        &self,
        x: &Self::Vector,
        v: &Self::Vector,
    ) -> Result<Self::Vector, Error> {
        let square = x.norm_squared();
        let singular = || Law::RegularTangent.broken([format!("{:?}", x.as_slice())], "0");
        let d = inverse_tangent(square, square).filter(|_| square <= 1e30);
        let d = d.ok_or_else(singular)?;
        Ok(in_range(v, |v| v * (1.0 - d * square) + x.cross(v) * 0.5 + x * (d * x.dot(v))))
    }
}

impl TranslationSplit for So3 {
    #[inline]
    fn coadjoint_inverse(&self, g: &Self::Element, h: &Self::Vector) -> Self::Vector {
        g.to_rotation_matrix().matrix() * h
    }

    fn has_bounded_adjoint(&self) -> bool {
        true
    }
}

impl So3 {
    /// The logarithm that is nearest to a given rotation vector. It is `log(g) + 2 pi k n`, where
    /// `n` is the axis. Along a trajectory, it remains continuous beyond `pi`, where
    /// [`LieGroup::log`] is discontinuous.
    ///
    /// ```
    /// use affinor::group::{LieGroup, So3};
    /// use nalgebra::Vector3;
    /// let x = Vector3::new(0.0, 0.0, 10.0); // more than one turn
    /// let before = Vector3::new(0.1, 0.0, 9.8);
    /// assert!((So3.log_near(&So3.exp(&x), &before)? - x).norm() < 1e-14);
    /// # Ok::<(), affinor::Error>(())
    /// ```
    ///
    /// # Errors
    /// The errors of [`LieGroup::log`] for rotations.
    pub fn log_near(
        &self,
        g: &UnitQuaternion<f64>,
        near: &Vector3<f64>,
    ) -> Result<Vector3<f64>, Error> {
        let x = self.log(g)?;
        let angle = x.norm();
        // at the identity, the axis is arbitrary, so the axis of `near` is used
        let axis =
            if angle > 0.0 { x / angle } else { near.try_normalize(0.0).unwrap_or_default() };
        let turns = ((near.dot(&axis) - angle) / std::f64::consts::TAU).round();
        Ok(x + axis * (turns * std::f64::consts::TAU))
    }
}

/// The exponential for vectors whose squared length may overflow.
#[inline(never)]
fn exp_far(x: &Vector3<f64>) -> UnitQuaternion<f64> {
    let largest = x.amax();
    let unit = x / largest;
    let length = unit.norm();
    // computes only half of the length, because the length may overflow
    let (sin, cos) = (0.5 * largest * length).sin_cos();
    UnitQuaternion::new_unchecked(Quaternion::from_parts(cos, unit * (sin / length)))
}

/// Whether a squared length `|q|^2` is so close to 1 that `|q| = (1 + |q|^2)/2` up to rounding
/// errors.
#[inline(always)]
pub(in crate::group) fn is_unit(norm: f64) -> bool {
    (norm - 1.0).abs() < 1e-8
}

/// The ratio of the rotation vector to the vector part of the quaternion `x, y, z, w`, where
/// `|v|^2` is `square` and `|q|^2` is `norm`. The parameter `norm` must satisfy [`is_unit`]. The
/// ratio is `4 atan(tan(angle/4))` over the sine, where `tan(angle/4) = |v|/(|q| + |w|)` is at
/// most 1. This formula needs no case distinction, neither at the identity nor at `pi`.
#[inline(always)]
pub(in crate::group) fn logarithm<T: Lane>([x, y, z, w]: [T; 4], square: T, norm: T) -> T {
    let half = T::splat(0.5);
    let scale = T::splat(1.0) / (w.abs() + (half + half * norm));
    let size = T::splat(4.0) * scale * polynomial(&ARCTANGENT, square * scale * scale);
    size.copysign(w.or(x.or(y.or(z))))
}

/// Coefficients of `atan(t)/t` in powers of `t^2` for `0 <= t <= 1`. Their error is `1.3e-17`
/// (Remez exchange with 60 digits, then rounded); `tests/references/arctangent.py` computes them.
const ARCTANGENT: [f64; 21] = [
    1.0,
    -0.3333333333333293,
    0.19999999999939716,
    -0.142857142821016,
    0.1111111099612908,
    -0.09090906842695927,
    0.07692278222149111,
    -0.06666392330223347,
    0.058804646597232064,
    -0.052532601728577696,
    0.047215065126498396,
    -0.04217172066984876,
    0.03660324238370174,
    -0.029845505440520413,
    0.021916242313747603,
    -0.013838426098453758,
    0.007154037171825575,
    -0.0028637457133265987,
    0.0008240586806444397,
    -0.00015062887261108076,
    1.3075348495791475e-05,
];

/// Applies a linear map to `v`, scaled so that products neither overflow nor underflow.
#[inline]
fn in_range(v: &Vector3<f64>, map: impl Fn(&Vector3<f64>) -> Vector3<f64>) -> Vector3<f64> {
    let largest = v.amax();
    if (1e-150..1e150).contains(&largest) || largest == 0.0 {
        return map(v);
    }
    map(&(v / largest)) * largest
}

/// The embedding coordinates are `x, y, z, w`. Their time derivative is `q (0, v)/2`.
impl Embedded for So3 {
    type Ambient = Vector4<f64>;

    #[inline]
    fn coordinates(&self, g: &Self::Element) -> Vector4<f64> {
        g.coords
    }

    #[inline]
    fn from_coordinates(&self, y: &Vector4<f64>) -> Self::Element {
        UnitQuaternion::new_unchecked(Quaternion::from(*y))
    }

    #[inline]
    fn rate(&self, g: &Self::Element, v: &Self::Vector) -> Vector4<f64> {
        let half = v * 0.5;
        let turn = half * g.w + g.imag().cross(&half);
        Vector4::new(turn.x, turn.y, turn.z, -g.imag().dot(&half))
    }
}

/// The written form is the rotation matrix. The components `w, x, y, z` of the quaternion are named
/// coordinates.
impl MatrixNotation for So3 {
    fn read(&self, matrix: &DMatrix<f64>) -> Result<Self::Element, Error> {
        checked(self, matrix, |m| {
            rotation::from_matrix(&m.fixed_view::<3, 3>(0, 0).into_owned(), TOLERANCE)
        })
    }

    fn is_angle(&self, _: usize) -> bool {
        true
    }

    fn names(&self) -> &'static [&'static str] {
        &["qw", "qx", "qy", "qz"]
    }

    fn named(&self, q: &Self::Element, k: usize) -> f64 {
        [q.w, q.i, q.j, q.k][k]
    }

    fn entries(&self, g: &Self::Element, entries: &mut Vec<f64>) {
        replace(entries, rotation::matrix(g).as_slice());
    }

    fn generators(&self) -> Vec<DMatrix<f64>> {
        spins(3).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The two formulas of the exponential agree near their threshold, for lengths whose squares
    /// are near overflow.
    #[test]
    fn both_exponentials_by_the_half_angle() {
        let axis = Vector3::new(2.0, -3.0, 6.0) / 7.0;
        for angle in [1e-140_f64, 1e-8, 0.1, 1.0, 3.0, 30.0, 1e4] {
            let (sin, cos) = (0.5 * angle).sin_cos();
            let expected = Quaternion::from_parts(cos, axis * sin);
            for found in [So3.exp(&(axis * angle)), exp_far(&(axis * angle))] {
                let off = (found.coords - expected.coords).amax();
                assert!(off <= 2.0 * f64::EPSILON * (1.0 + angle), "{angle}: off by {off:e}");
            }
        }
        // beyond the threshold, the angle consists only of rounding errors, but the quaternion has
        // length one
        for length in [0.9, 1.1].map(|ratio: f64| ratio * LARGE.sqrt()) {
            assert!((So3.exp(&(axis * length)).norm() - 1.0).abs() < 1e-15);
        }
    }
}
