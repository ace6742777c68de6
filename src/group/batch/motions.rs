//! Kernels of SE(3). Elements are rows `w, x, y, z, t_1, t_2, t_3`, vectors are rows `w, u`, and
//! matrices are listed row by row.

use super::rotations::{
    Jacobian, ORTHOGONAL, assembled, combination, cross, defect, dot, element, jacobian,
    jacobian_inverse, log, quaternion, scaled, times,
};
use super::rows::Formula;
use crate::Error;
use crate::group::rotation::formulas::{matrix, product};
use crate::group::{LieGroup, MatrixNotation, Se3};
use crate::numerics::lanes::Lane;
use crate::numerics::stumpff::{self, NEAR, SERIES, Series};
use nalgebra::{DMatrix, Isometry3, Matrix6, Vector6};
use std::array::from_fn;

/// The kernel that computes exponentials of twists.
#[derive(Clone, Copy, Debug)]
pub struct MotionExp;
/// The kernel that computes logarithms of rigid motions.
#[derive(Clone, Copy, Debug)]
pub struct MotionLog;
/// The kernel that computes products of rigid motions.
#[derive(Clone, Copy, Debug)]
pub struct MotionProduct;
/// The kernel that computes inverse rigid motions.
#[derive(Clone, Copy, Debug)]
pub struct InverseMotion;
/// The kernel that converts rigid motions to matrices.
#[derive(Clone, Copy, Debug)]
pub struct MotionMatrix;
/// The kernel that computes the image of a point under a rigid motion.
#[derive(Clone, Copy, Debug)]
pub struct MovedPoint;
/// The kernel that computes the matrices of `Ad_g`.
#[derive(Clone, Copy, Debug)]
pub struct MotionAdjoint;
/// The kernel that converts matrices to rigid motions. If the flag is set, it checks the matrices.
#[derive(Clone, Copy, Debug)]
pub struct MotionOfMatrix(pub bool);

/// Splits a row into its first `A` and its last `B` numbers.
#[inline(always)]
fn split<T: Lane, const N: usize, const A: usize, const B: usize>(row: [T; N]) -> ([T; A], [T; B]) {
    (from_fn(|i| row[i]), from_fn(|i| row[A + i]))
}

#[inline(always)]
fn join<T: Lane, const A: usize, const B: usize, const N: usize>(a: [T; A], b: [T; B]) -> [T; N] {
    from_fn(|i| if i < A { a[i] } else { b[i - A] })
}

/// The vector `v`, rotated by a unit quaternion.
#[inline(always)]
fn rotated<T: Lane>([w, x, y, z]: [T; 4], v: [T; 3]) -> [T; 3] {
    let q = [x, y, z];
    let once = cross(q, v);
    let once: [T; 3] = once.map(|c| c + c);
    let again = cross(q, once);
    from_fn(|i| v[i] + once[i] * w + again[i])
}

fn pose(row: [f64; 7]) -> Isometry3<f64> {
    let (q, t) = split::<_, 7, 4, 3>(row);
    Isometry3::from_parts(t.into(), element(q))
}

fn row(g: &Isometry3<f64>) -> [f64; 7] {
    let (q, t) = (g.rotation, g.translation.vector);
    [q.w, q.i, q.j, q.k, t.x, t.y, t.z]
}

/// A 6 x 6 matrix of three 3 x 3 blocks. The upper right block is zero.
#[inline(always)]
fn lower_triangular<T: Lane>(first: &[T; 9], below: &[T; 9], last: &[T; 9]) -> [T; 36] {
    let mut all = [T::splat(0.0); 36];
    for i in 0..3 {
        for k in 0..3 {
            all[6 * i + k] = first[3 * i + k];
            all[6 * (i + 3) + k] = below[3 * i + k];
            all[6 * (i + 3) + k + 3] = last[3 * i + k];
        }
    }
    all
}

impl Formula<6, 0, 7> for MotionExp {
    /// Below this limit, the series of the half angle is accurate.
    const LIMIT: f64 = 4.0 * NEAR;
    const SIDE_BY_SIDE: bool = true;

    #[inline(always)]
    fn formula<T: Lane>(&self, x: [T; 6], _: [T; 0]) -> ([T; 7], T) {
        let (w, u) = split::<_, 6, 3, 3>(x);
        let z = dot(w, w);
        let (cos, sin) = stumpff::near(T::splat(0.25) * z);
        let half = T::splat(0.5) * sin;
        let c = Series::at(z);
        let t = combination([(c.c1, u), (c.c2, cross(w, u)), (c.c3 * dot(w, u), w)]);
        let [x, y, s] = scaled(half, w);
        (join([cos, x, y, s], t), z)
    }

    fn alone(&self, x: [f64; 6], _: [f64; 0]) -> Result<[f64; 7], Error> {
        Ok(row(&Se3.exp(&Vector6::from(x))))
    }
}

impl Formula<7, 0, 6> for MotionLog {
    /// Below this limit, the length of the quaternion counts as 1.
    const LIMIT: f64 = 1e-8;
    const SIDE_BY_SIDE: bool = true;

    #[inline(always)]
    fn formula<T: Lane>(&self, g: [T; 7], _: [T; 0]) -> ([T; 6], T) {
        let (q, t) = split::<_, 7, 4, 3>(g);
        let (w, off) = log(q);
        let z = dot(w, w);
        let d = stumpff::inverse_series(z).0;
        let u = combination([
            (T::splat(1.0) - d * z, t),
            (T::splat(-0.5), cross(w, t)),
            (d * dot(w, t), w),
        ]);
        (join(w, u), off)
    }

    fn alone(&self, g: [f64; 7], _: [f64; 0]) -> Result<[f64; 6], Error> {
        Ok(Se3.log(&pose(g))?.into())
    }
}

impl Formula<7, 7, 7> for MotionProduct {
    #[inline(always)]
    fn formula<T: Lane>(&self, g: [T; 7], h: [T; 7]) -> ([T; 7], T) {
        let ((r, t), (q, s)) = (split::<_, 7, 4, 3>(g), split::<_, 7, 4, 3>(h));
        let moved = rotated(r, s);
        (join(product(r, q), from_fn::<_, 3, _>(|i| t[i] + moved[i])), T::splat(0.0))
    }
}

impl Formula<7, 0, 7> for InverseMotion {
    #[inline(always)]
    fn formula<T: Lane>(&self, g: [T; 7], _: [T; 0]) -> ([T; 7], T) {
        let ([w, x, y, z], t) = split::<_, 7, 4, 3>(g);
        let back = [w, -x, -y, -z];
        (join(back, rotated(back, t).map(|c| -c)), T::splat(0.0))
    }
}

impl Formula<7, 0, 16> for MotionMatrix {
    #[inline(always)]
    fn formula<T: Lane>(&self, g: [T; 7], _: [T; 0]) -> ([T; 16], T) {
        let (q, t) = split::<_, 7, 4, 3>(g);
        let r = matrix(q);
        let entry = |at: usize| match (at / 4, at % 4) {
            (3, k) => T::splat(if k == 3 { 1.0 } else { 0.0 }),
            (i, 3) => t[i],
            (i, k) => r[3 * i + k],
        };
        (from_fn(entry), T::splat(0.0))
    }
}

impl Formula<7, 3, 3> for MovedPoint {
    #[inline(always)]
    fn formula<T: Lane>(&self, g: [T; 7], p: [T; 3]) -> ([T; 3], T) {
        let (q, t) = split::<_, 7, 4, 3>(g);
        let moved = times(&matrix(q), p);
        (from_fn(|i| moved[i] + t[i]), T::splat(0.0))
    }
}

impl Formula<7, 0, 36> for MotionAdjoint {
    #[inline(always)]
    fn formula<T: Lane>(&self, g: [T; 7], _: [T; 0]) -> ([T; 36], T) {
        let (q, t) = split::<_, 7, 4, 3>(g);
        let r = matrix(q);
        let mut below = [T::splat(0.0); 9];
        for k in 0..3 {
            let column = cross(t, [r[k], r[3 + k], r[6 + k]]);
            for i in 0..3 {
                below[3 * i + k] = column[i];
            }
        }
        (lower_triangular(&r, &below, &r), T::splat(0.0))
    }
}

impl Formula<16, 0, 7> for MotionOfMatrix {
    const LIMIT: f64 = ORTHOGONAL;

    #[inline(always)]
    fn formula<T: Lane>(&self, m: [T; 16], _: [T; 0]) -> ([T; 7], T) {
        let r: [T; 9] = from_fn(|at| m[4 * (at / 3) + at % 3]);
        let found = join(quaternion(&r), [m[3], m[7], m[11]]);
        if !self.0 {
            return (found, T::splat(0.0));
        }
        let last = m[12].abs() + m[13].abs() + m[14].abs() + (m[15] - T::splat(1.0)).abs();
        // adds NaN for an infinite translation, which is then out of range
        let finite = (m[3] + m[7] + m[11]) * T::splat(0.0);
        (found, defect(&r).larger(last) + finite)
    }

    fn alone(&self, m: [f64; 16], _: [f64; 0]) -> Result<[f64; 7], Error> {
        Ok(row(&Se3.read(&DMatrix::from_row_slice(4, 4, &m))?))
    }
}

/// The matrix `[[J, 0], [Q, J]]`, where `Q` is the derivative of `J` at `w` along `u`.
impl Formula<6, 0, 36> for Jacobian {
    const LIMIT: f64 = SERIES;
    const SIDE_BY_SIDE: bool = true;

    #[inline(always)]
    fn formula<T: Lane>(&self, x: [T; 6], _: [T; 0]) -> ([T; 36], T) {
        let (w, u) = split::<_, 6, 3, 3>(x);
        let (z, along, sign) = (dot(w, w), dot(w, u), self.0.sign());
        let twice = along + along;
        let (block, below) = if self.0.is_inverse() {
            let (d, slope) = stumpff::inverse_series(z);
            let slope_z = d + z * slope;
            let spin = scaled(T::splat(-0.5 * sign), u);
            let below = assembled(-(twice * slope_z), spin, twice * slope, w, Some((d, u)));
            (jacobian_inverse(w, sign, z, d), below)
        } else {
            let c = Series::at(z);
            let [slope2, slope3] = c.slopes();
            let s = T::splat(sign);
            let spin = combination([(s * c.c2, u), (s * twice * slope2, w)]);
            let diagonal = along * (c.c3 - c.c2);
            let below = assembled(diagonal, spin, twice * slope3, w, Some((c.c3, u)));
            (jacobian(w, sign, &c), below)
        };
        (lower_triangular(&block, &below, &block), z)
    }

    fn alone(&self, x: [f64; 6], _: [f64; 0]) -> Result<[f64; 36], Error> {
        let found: Matrix6<f64> = self.0.of(&Se3, &Vector6::from(x))?;
        Ok(from_fn(|at| found[(at / 6, at % 6)]))
    }
}
