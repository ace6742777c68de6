//! Kernels of many rows agree with the operations of SO(3) and SE(3) on one element, in blocks and alone, at all angles.

use affinor::Error;
use affinor::group::batch::motions::{
    InverseMotion, MotionAdjoint, MotionExp, MotionLog, MotionMatrix, MotionOfMatrix,
    MotionProduct, MovedPoint,
};
use affinor::group::batch::rotations::{
    InverseRotation, Jacobian, JacobianKind, RotatedPoint, RotationMatrix, RotationOfMatrix,
};
use affinor::group::batch::{Kernel, Operand, map, single};
use affinor::group::{LieGroup, Se3, So3, rotation};
use nalgebra::{Isometry3, Matrix3, Matrix6, Point3, Quaternion, UnitQuaternion, Vector3, Vector6};
use std::array::from_fn;
use std::f64::consts::{PI, TAU};

/// Rotation vectors of all angles, each with a second vector.
fn twists() -> Vec<[f64; 6]> {
    let angles = [0.0, 1e-300, 1e-170, 1e-9, 1e-4, 0.1, 0.7, 1.5, 2.9, 2.999, 3.0, 3.001, 3.1, PI];
    let more = [PI - 1e-9, 3.1622, 3.1623, 3.3, 4.0, 6.0, 6.25, 7.0, 30.0, 1e5];
    let axes = [[0.28, -0.96, 0.0], [2.0 / 3.0, 1.0 / 3.0, -2.0 / 3.0], [0.0, 0.0, 1.0]];
    let mut list = vec![];
    for (k, angle) in angles.into_iter().chain(more).enumerate() {
        for axis in axes {
            let [x, y, z] = axis.map(|c| c * angle);
            let k = k as f64;
            list.push([x, y, z, 1.0 - 0.2 * k, 0.5 + 0.1 * k, -2.0 + 0.03 * k * k]);
        }
    }
    list
}

fn quaternion(g: &UnitQuaternion<f64>) -> [f64; 4] {
    [g.w, g.i, g.j, g.k]
}

/// The quaternion with the sign that a matrix gives: its largest component is positive.
fn signed_as(read: [f64; 4], quaternion: [f64; 4]) -> [f64; 4] {
    let [least, most] = [f64::min, f64::max].map(|end| read.into_iter().fold(0.0, end));
    assert!(most >= -least - 1e-15, "{read:?}");
    let dot: f64 = read.iter().zip(quaternion).map(|(a, b)| a * b).sum();
    quaternion.map(|component| component * dot.signum())
}

fn rotation_of([w, x, y, z]: [f64; 4]) -> UnitQuaternion<f64> {
    UnitQuaternion::new_unchecked(Quaternion::new(w, x, y, z))
}

fn pose(g: &Isometry3<f64>) -> [f64; 7] {
    let (q, t) = (quaternion(&g.rotation), g.translation.vector);
    from_fn(|i| if i < 4 { q[i] } else { t[i - 4] })
}

fn close<const N: usize>(what: &str, found: [f64; N], expected: [f64; N], tolerance: f64) {
    let size = expected.iter().fold(1.0_f64, |most, x| most.max(x.abs()));
    for (a, b) in found.iter().zip(expected) {
        assert!((a - b).abs() <= tolerance * size, "{what}: {found:?}, expected {expected:?}");
    }
}

/// A kernel gives the same floats on all rows at once, on parts of any length, and on single rows,
/// close to the expected ones.
fn check<const A: usize, const B: usize, const O: usize>(
    what: &str,
    kernel: impl Kernel<A, B, O>,
    a: &[[f64; A]],
    b: &[[f64; B]],
    expected: impl Fn(usize) -> [f64; O],
    tolerance: f64,
) {
    let mut all = vec![[f64::NAN; O]; a.len()];
    map(&kernel, Operand::Many(a), Operand::Many(b), &mut all).unwrap();
    for (at, row) in all.iter().enumerate() {
        close(&format!("{what} of row {at}"), *row, expected(at), tolerance);
        assert_eq!(single(&kernel, a[at], b[at]).unwrap(), *row, "{what} of row {at} alone");
    }
    for (start, end) in [(0, 1), (1, 8), (3, 11), (2, 19), (5, a.len())] {
        let mut part = vec![[f64::NAN; O]; end - start];
        let (x, y) = (Operand::Many(a), Operand::Many(b));
        map(&kernel, x.part(start, end), y.part(start, end), &mut part).unwrap();
        assert_eq!(part, all[start..end], "{what} of the rows {start}..{end}");
        map(&kernel, Operand::One(a[start]), y.part(start, end), &mut part).unwrap();
        for (at, row) in part.iter().enumerate() {
            assert_eq!(single(&kernel, a[start], b[start + at]).unwrap(), *row, "{what}, one row");
        }
    }
}

#[test]
fn rotations_in_bulk() {
    let twists = twists();
    let none = vec![[0.0; 0]; twists.len()];
    let x: Vec<[f64; 3]> = twists.iter().map(|x| [x[0], x[1], x[2]]).collect();
    let points: Vec<[f64; 3]> = twists.iter().map(|x| [x[3], x[4], x[5]]).collect();
    let elements: Vec<_> = x.iter().map(|x| So3.exp(&Vector3::from(*x))).collect();
    let g: Vec<[f64; 4]> = elements.iter().map(quaternion).collect();
    let rows = |m: &Matrix3<f64>| from_fn(|at| m[(at / 3, at % 3)]);
    let matrix = |at: usize| rows(elements[at].to_rotation_matrix().matrix());
    check("matrix", RotationMatrix, &g, &none, matrix, 1e-15);
    let moved = |at: usize| (elements[at] * Vector3::from(points[at])).into();
    check("point", RotatedPoint, &g, &points, moved, 1e-14);
    check("inverse", InverseRotation, &g, &none, |at| quaternion(&elements[at].inverse()), 0.0);
    let matrices: Vec<[f64; 9]> = (0..g.len()).map(matrix).collect();
    for checked in [true, false] {
        let kernel = RotationOfMatrix(checked);
        let back = |at: usize| {
            let read = single(&kernel, matrices[at], []).unwrap();
            signed_as(read, quaternion(&elements[at]))
        };
        check("of matrix", kernel, &matrices, &none, back, 2e-15);
    }
    for kind in [JacobianKind::Left, JacobianKind::Right] {
        let expected = |at: usize| rows(&kind.of(&So3, &Vector3::from(x[at])).unwrap());
        check("Jacobian", Jacobian(kind), &x, &none, expected, 1e-14);
    }
    for kind in [JacobianKind::LeftInverse, JacobianKind::RightInverse] {
        let expected = |at: usize| rows(&kind.of(&So3, &Vector3::from(x[at])).unwrap());
        check("inverse Jacobian", Jacobian(kind), &x, &none, expected, 1e-10);
    }
}

#[test]
fn rigid_motions_in_bulk() {
    let x = twists();
    let none = vec![[0.0; 0]; x.len()];
    let points: Vec<[f64; 3]> = x.iter().map(|x| [x[4], x[5], x[3]]).collect();
    let elements: Vec<_> = x.iter().map(|x| Se3.exp(&Vector6::from(*x))).collect();
    let g: Vec<[f64; 7]> = elements.iter().map(pose).collect();
    check("exp", MotionExp, &x, &none, |at| pose(&elements[at]), 1e-14);
    let log = |at: usize| Se3.log(&elements[at]).unwrap().into();
    check("log", MotionLog, &g, &none, log, 1e-14);
    let others: Vec<[f64; 7]> = g.iter().rev().copied().collect();
    let product = |at: usize| pose(&(elements[at] * elements[elements.len() - 1 - at]));
    check("product", MotionProduct, &g, &others, product, 1e-14);
    check("inverse", InverseMotion, &g, &none, |at| pose(&elements[at].inverse()), 1e-14);
    let matrix = |at: usize| {
        let m = elements[at].to_homogeneous();
        from_fn(|k| m[(k / 4, k % 4)])
    };
    check("matrix", MotionMatrix, &g, &none, matrix, 1e-15);
    let moved = |at: usize| (elements[at] * Point3::from(points[at])).coords.into();
    check("point", MovedPoint, &g, &points, moved, 1e-14);
    let rows = |m: &Matrix6<f64>| from_fn(|at| m[(at / 6, at % 6)]);
    let adjoint = |at: usize| rows(&Se3.adjoint_matrix(&elements[at]));
    check("adjoint", MotionAdjoint, &g, &none, adjoint, 1e-14);
    let matrices: Vec<[f64; 16]> = (0..g.len()).map(matrix).collect();
    for checked in [true, false] {
        let kernel = MotionOfMatrix(checked);
        let back = |at: usize| {
            let read = single(&kernel, matrices[at], []).unwrap();
            let q = signed_as(from_fn(|i| read[i]), quaternion(&elements[at].rotation));
            from_fn(|i| if i < 4 { q[i] } else { g[at][i] })
        };
        check("of matrix", kernel, &matrices, &none, back, 2e-15);
    }
    for kind in [JacobianKind::Left, JacobianKind::Right] {
        let expected = |at: usize| rows(&kind.of(&Se3, &Vector6::from(x[at])).unwrap());
        check("Jacobian", Jacobian(kind), &x, &none, expected, 1e-14);
    }
    for kind in [JacobianKind::LeftInverse, JacobianKind::RightInverse] {
        let expected = |at: usize| rows(&kind.of(&Se3, &Vector6::from(x[at])).unwrap());
        check("inverse Jacobian", Jacobian(kind), &x, &none, expected, 1e-9);
    }
}

/// The matrices of `Ad` and of the Jacobians satisfy `Ad_exp(x) = J_left(x) J_right(x)^-1`.
#[test]
fn adjoint_by_jacobians() {
    for x in twists().into_iter().filter(|x| x[0].hypot(x[1]).hypot(x[2]) < 6.0) {
        let x = Vector6::from(x);
        let product = Se3.jacobian_left(&x) * Se3.jacobian_right_inverse(&x).unwrap();
        let off = (product - Se3.adjoint_matrix(&Se3.exp(&x))).amax();
        assert!(off < 1e-11 * (1.0 + product.amax()), "{x}: off by {off:e}");
        let one = Se3.jacobian_left_inverse(&x).unwrap() * Se3.jacobian_left(&x);
        assert!((one - Matrix6::identity()).amax() < 1e-11);
    }
}

/// An error names the first row without a result, in blocks and for single rows.
#[test]
fn errors_name_their_row() {
    let fails = |rows: usize, bad: usize| {
        let mut g = vec![[1.0, 0.0, 0.0, 0.0, 1.0, 2.0, 3.0]; rows];
        g[bad] = [0.0; 7];
        map(&MotionLog, Operand::Many(&g), Operand::One([]), &mut vec![[0.0; 6]; rows])
    };
    for (rows, bad) in [(1, 0), (8, 3), (30, 17), (30, 29)] {
        let (at, error) = fails(rows, bad).unwrap_err();
        assert_eq!(at, bad);
        assert!(matches!(error, Error::Invalid { .. }), "{error}");
    }
    let singular = [0.0, TAU, 0.0];
    let inverse = Jacobian(JacobianKind::LeftInverse);
    assert!(single::<3, 0, 9>(&inverse, singular, []).is_err());
    assert!(single::<6, 0, 36>(&inverse, [0.0, 0.0, TAU, 1.0, 2.0, 3.0], []).is_err());
    let nan = single::<3, 0, 9>(&Jacobian(JacobianKind::Left), [f64::NAN, 0.0, 0.0], []).unwrap();
    assert!(nan.iter().any(|entry| entry.is_nan()));
    let turn = rotation::matrix(&rotation_of([0.6, 0.0, 0.8, 0.0]));
    let wrong = [(-turn, "reflection"), (turn * 1.001, "differs"), (turn * f64::NAN, "entry")];
    for (matrix, words) in wrong {
        let rows: [f64; 9] = from_fn(|at| matrix[(at / 3, at % 3)]);
        let error = single(&RotationOfMatrix(true), rows, []).unwrap_err();
        assert!(error.to_string().contains(words), "{error}");
        let mut whole = [0.0; 16];
        (0..9).for_each(|at| whole[4 * (at / 3) + at % 3] = rows[at]);
        whole[15] = 1.0;
        assert!(single(&MotionOfMatrix(true), whole, []).is_err());
    }
    // a matrix with rounded entries is read with the tolerance of elements
    let mut rows: [f64; 9] = from_fn(|at| turn[(at / 3, at % 3)]);
    rows[0] += 3e-7;
    assert!(single(&RotationOfMatrix(true), rows, []).is_ok());
}
