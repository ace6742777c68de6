//! Formulas for quaternions `w, x, y, z` and matrices in row-major order. They apply to one
//! rotation, or to several rotations at once.

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

/// The rotation matrix `((w^2 - |v|^2) 1 + 2 w spin(v) + 2 v v^T)/|q|^2`. It is homogeneous of
/// degree 0 in the quaternion, and orthogonal to 4 machine epsilons for a quaternion of any length.
#[inline(always)]
pub(crate) fn matrix<T: Lane>([w, x, y, z]: [T; 4]) -> [T; 9] {
    let [ww, xx, yy, zz] = [w * w, x * x, y * y, z * z];
    let s = T::splat(1.0) / ((ww + xx) + (yy + zz));
    let [sx, sy, d] = [x + x, y + y, w + w];
    let [xy, xz, yz] = [sx * y, sx * z, sy * z];
    let [wx, wy, wz] = [d * x, d * y, d * z];
    [
        s * ((ww + xx) - (yy + zz)),
        s * (xy - wz),
        s * (xz + wy),
        s * (xy + wz),
        s * ((ww + yy) - (xx + zz)),
        s * (yz - wx),
        s * (xz - wy),
        s * (yz + wx),
        s * ((ww + zz) - (xx + yy)),
    ]
}

/// The quaternion of a rotation matrix, multiplied by four times its largest component. In this
/// form, no division amplifies cancellation (S. W. Shepperd, *J. Guidance and Control* 1 (1978)
/// 223-224).
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
