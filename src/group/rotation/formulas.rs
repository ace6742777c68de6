//! Formulas of quaternions `w, x, y, z` and matrices row by row, for one rotation and for several side by side.

use crate::numerics::lanes::Lane;

/// The product of two quaternions.
#[inline(always)]
pub(crate) fn product<T: Lane>([a, b, c, d]: [T; 4], [e, f, g, h]: [T; 4]) -> [T; 4] {
    [
        a * e - b * f - c * g - d * h,
        a * f + b * e + c * h - d * g,
        a * g - b * h + c * e + d * f,
        a * h + b * g - c * f + d * e,
    ]
}

/// The rotation matrix `1 + s (w spin(v) + spin(v)^2)` with `s = 2/|q|^2`: homogeneous of degree 0 in the quaternion.
#[inline(always)]
pub(crate) fn matrix<T: Lane>([w, x, y, z]: [T; 4]) -> [T; 9] {
    let one = T::splat(1.0);
    let s = T::splat(2.0) / ((w * w + x * x) + (y * y + z * z));
    let [sx, sy, sz] = [s * x, s * y, s * z];
    let [xx, xy, xz] = [sx * x, sx * y, sx * z];
    let [yy, yz, zz] = [sy * y, sy * z, sz * z];
    let [wx, wy, wz] = [sx * w, sy * w, sz * w];
    [
        one - (yy + zz),
        xy - wz,
        xz + wy,
        xy + wz,
        one - (xx + zz),
        yz - wx,
        xz - wy,
        yz + wx,
        one - (xx + yy),
    ]
}

/// The quaternion of a rotation matrix, times four times its largest component, so that no difference of near equals is divided by:
/// S. W. Shepperd, *J. Guidance and Control* 1 (1978) 223-224.
#[inline(always)]
pub(crate) fn shepperd<T: Lane>(r: &[T; 9]) -> [T; 4] {
    let [a, b, c] = [r[0], r[4], r[8]];
    let one = T::splat(1.0);
    let trace = a + b + c;
    let [w, x, y] = [r[7] - r[5], r[2] - r[6], r[3] - r[1]];
    let [xy, xz, yz] = [r[1] + r[3], r[2] + r[6], r[5] + r[7]];
    let choose = |first: T, second: T, a: [T; 4], b: [T; 4]| -> [T; 4] {
        std::array::from_fn(|i| first.if_above(second, a[i], b[i]))
    };
    let of_b = [x, xy, one + b - c - a, yz];
    let of_c = [y, xz, yz, one + c - a - b];
    let of_a = [w, one + a - b - c, xy, xz];
    let of_w = [one + trace, w, x, y];
    let lower = choose(c, b, of_c, of_b);
    let rest = choose(b.larger(c), a, lower, of_a);
    choose(a.larger(b.larger(c)), trace, rest, of_w)
}
