//! Kernels of SO(3). Elements are quaternions `w, x, y, z`, and matrices are listed row by row.

use super::rows::Formula;
use crate::Error;
use crate::group::groups::so3::logarithm;
use crate::group::rotation::formulas::{matrix, shepperd};
use crate::group::{LieGroup, MatrixNotation, So3};
use crate::numerics::lanes::Lane;
use crate::numerics::stumpff::{self, SERIES};
use nalgebra::{DMatrix, Matrix3, Quaternion, UnitQuaternion, Vector3};

/// The kernel that converts elements to rotation matrices.
#[derive(Clone, Copy, Debug)]
pub struct RotationMatrix;
/// The kernel that rotates points.
#[derive(Clone, Copy, Debug)]
pub struct RotatedPoint;
/// The kernel that inverts rotations.
#[derive(Clone, Copy, Debug)]
pub struct InverseRotation;
/// The kernel that converts matrices to rotations. If the flag is set, it checks the matrices.
#[derive(Clone, Copy, Debug)]
pub struct RotationOfMatrix(pub bool);
/// The kernel that computes a Jacobian matrix of exp, or the inverse of a Jacobian matrix.
#[derive(Clone, Copy, Debug)]
pub struct Jacobian(pub JacobianKind);

/// The side of a Jacobian of exp, and whether the Jacobian is inverted. The sides are defined by
/// `exp(x + dx) = exp(J_left dx + ...) exp(x) = exp(x) exp(J_right dx + ...)`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum JacobianKind {
    /// The matrix of [`LieGroup::jacobian_left`].
    Left,
    /// The matrix of [`LieGroup::jacobian_right`].
    Right,
    /// The matrix of [`LieGroup::jacobian_left_inverse`].
    LeftInverse,
    /// The matrix of [`LieGroup::jacobian_right_inverse`].
    RightInverse,
}

impl JacobianKind {
    /// The sign of the side: 1 for left, -1 for right.
    #[inline(always)]
    pub(super) fn sign(self) -> f64 {
        if matches!(self, JacobianKind::Left | JacobianKind::LeftInverse) { 1.0 } else { -1.0 }
    }

    #[inline(always)]
    pub(super) fn is_inverse(self) -> bool {
        matches!(self, JacobianKind::LeftInverse | JacobianKind::RightInverse)
    }

    /// The Jacobian matrix of a group at a vector.
    ///
    /// # Errors
    /// The errors of [`LieGroup::tangent_left_inverse`], if the Jacobian is inverted.
    pub fn of<G: LieGroup>(
        self,
        group: &G,
        x: &G::Vector,
    ) -> Result<<G::Vector as crate::group::Coordinates>::Matrix, Error> {
        match self {
            JacobianKind::Left => Ok(group.jacobian_left(x)),
            JacobianKind::Right => Ok(group.jacobian_right(x)),
            JacobianKind::LeftInverse => group.jacobian_left_inverse(x),
            JacobianKind::RightInverse => group.jacobian_right_inverse(x),
        }
    }
}

/// The product of the matrix and a vector.
#[inline(always)]
pub(super) fn times<T: Lane>(m: &[T; 9], [x, y, z]: [T; 3]) -> [T; 3] {
    [m[0] * x + m[1] * y + m[2] * z, m[3] * x + m[4] * y + m[5] * z, m[6] * x + m[7] * y + m[8] * z]
}

#[inline(always)]
pub(super) fn dot<T: Lane>(a: [T; 3], b: [T; 3]) -> T {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

#[inline(always)]
pub(super) fn cross<T: Lane>(a: [T; 3], b: [T; 3]) -> [T; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// A linear combination of three vectors.
#[inline(always)]
pub(super) fn combination<T: Lane, const N: usize>(terms: [(T, [T; 3]); N]) -> [T; 3] {
    let mut sum = [T::splat(0.0); 3];
    for (k, (factor, vector)) in terms.into_iter().enumerate() {
        for (own, value) in sum.iter_mut().zip(vector) {
            *own = if k == 0 { factor * value } else { *own + factor * value };
        }
    }
    sum
}

/// The matrix `d 1 + s spin(v) + p w w^T + m (w v^T + v w^T)`, row by row.
#[inline(always)]
pub(super) fn assembled<T: Lane>(
    diagonal: T,
    spin: [T; 3],
    outer: T,
    w: [T; 3],
    mixed: Option<(T, [T; 3])>,
) -> [T; 9] {
    let symmetric = |i: usize, k: usize| {
        let own = outer * (w[i] * w[k]);
        match mixed {
            None => own,
            Some((factor, v)) => own + factor * (w[i] * v[k] + v[i] * w[k]),
        }
    };
    let [xy, xz, yz] = [symmetric(0, 1), symmetric(0, 2), symmetric(1, 2)];
    [
        diagonal + symmetric(0, 0),
        xy - spin[2],
        xz + spin[1],
        xy + spin[2],
        diagonal + symmetric(1, 1),
        yz - spin[0],
        xz - spin[1],
        yz + spin[0],
        diagonal + symmetric(2, 2),
    ]
}

#[inline(always)]
pub(super) fn scaled<T: Lane>(factor: T, [x, y, z]: [T; 3]) -> [T; 3] {
    [factor * x, factor * y, factor * z]
}

/// The matrix `c_1 1 + s c_2 spin(w) + c_3 w w^T`, where `c_k` are Stumpff functions. It is the
/// left Jacobian for `s = 1`, and the right Jacobian for `s = -1`.
#[inline(always)]
pub(super) fn jacobian<T: Lane>(w: [T; 3], sign: f64, c: &stumpff::Series<T>) -> [T; 9] {
    assembled(c.c1, scaled(T::splat(sign) * c.c2, w), c.c3, w, None)
}

/// The inverse Jacobian, `(1 - d |w|^2) 1 - s/2 spin(w) + d w w^T`.
#[inline(always)]
pub(super) fn jacobian_inverse<T: Lane>(w: [T; 3], sign: f64, z: T, d: T) -> [T; 9] {
    assembled(T::splat(1.0) - d * z, scaled(T::splat(-0.5 * sign), w), d, w, None)
}

/// The unit quaternion of a rotation matrix.
#[inline(always)]
pub(super) fn quaternion<T: Lane>(r: &[T; 9]) -> [T; 4] {
    let q = shepperd(r);
    let norm = (q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]).sqrt();
    let unit = T::splat(1.0) / norm;
    q.map(|component| component * unit)
}

/// The largest entry of `|R^T R - 1|`. For reflections, the result is at least 1.
#[inline(always)]
pub(super) fn defect<T: Lane>(r: &[T; 9]) -> T {
    let column = |k: usize| [r[k], r[3 + k], r[6 + k]];
    let one = T::splat(1.0);
    let mut most = T::splat(0.0);
    for i in 0..3 {
        for k in i..3 {
            let entry = dot(column(i), column(k));
            most = most.larger(if i == k { (entry - one).abs() } else { entry.abs() });
        }
    }
    most.larger((dot(cross(column(0), column(1)), column(2)) - one).abs())
}

/// A matrix whose defect is below this limit needs no further check.
pub(super) const ORTHOGONAL: f64 = 1e-9;

impl Formula<4, 0, 9> for RotationMatrix {
    #[inline(always)]
    fn formula<T: Lane>(&self, q: [T; 4], _: [T; 0]) -> ([T; 9], T) {
        (matrix(q), T::splat(0.0))
    }
}

impl Formula<4, 3, 3> for RotatedPoint {
    #[inline(always)]
    fn formula<T: Lane>(&self, q: [T; 4], p: [T; 3]) -> ([T; 3], T) {
        (times(&matrix(q), p), T::splat(0.0))
    }
}

impl Formula<4, 0, 4> for InverseRotation {
    #[inline(always)]
    fn formula<T: Lane>(&self, [w, x, y, z]: [T; 4], _: [T; 0]) -> ([T; 4], T) {
        ([w, -x, -y, -z], T::splat(0.0))
    }
}

impl Formula<9, 0, 4> for RotationOfMatrix {
    const LIMIT: f64 = ORTHOGONAL;
    // computes the whole block at once, because branches on the largest component are hard to
    // predict
    const SIDE_BY_SIDE: bool = true;

    #[inline(always)]
    fn formula<T: Lane>(&self, r: [T; 9], _: [T; 0]) -> ([T; 4], T) {
        (quaternion(&r), if self.0 { defect(&r) } else { T::splat(0.0) })
    }

    fn alone(&self, r: [f64; 9], _: [f64; 0]) -> Result<[f64; 4], Error> {
        let g = So3.read(&DMatrix::from_row_slice(3, 3, &r))?;
        Ok([g.w, g.i, g.j, g.k])
    }
}

impl Formula<3, 0, 9> for Jacobian {
    const LIMIT: f64 = SERIES;
    const SIDE_BY_SIDE: bool = true;

    #[inline(always)]
    fn formula<T: Lane>(&self, w: [T; 3], _: [T; 0]) -> ([T; 9], T) {
        let z = dot(w, w);
        let sign = self.0.sign();
        let found = if self.0.is_inverse() {
            jacobian_inverse(w, sign, z, stumpff::inverse_series(z).0)
        } else {
            jacobian(w, sign, &stumpff::Series::at(z))
        };
        (found, z)
    }

    fn alone(&self, w: [f64; 3], _: [f64; 0]) -> Result<[f64; 9], Error> {
        let found: Matrix3<f64> = self.0.of(&So3, &Vector3::from(w))?;
        Ok(std::array::from_fn(|at| found[(at / 3, at % 3)]))
    }
}

/// The logarithm of a quaternion whose length is near 1, and the deviation of its squared length
/// from 1.
#[inline(always)]
pub(super) fn log<T: Lane>([w, x, y, z]: [T; 4]) -> ([T; 3], T) {
    let square = x * x + y * y + z * z;
    let norm = w * w + square;
    let factor = logarithm([x, y, z, w], square, norm);
    ([x * factor, y * factor, z * factor], (norm - T::splat(1.0)).abs())
}

/// The element that a row `w, x, y, z` represents.
pub(super) fn element([w, x, y, z]: [f64; 4]) -> UnitQuaternion<f64> {
    UnitQuaternion::new_unchecked(Quaternion::new(w, x, y, z))
}
