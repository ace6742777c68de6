//! Coordinates of rotations: round trips, known values, SciPy as an oracle, reported singularities.

use crate::common::property::properties;
use affinor::Error;
use affinor::group::rotation::{
    AxesFrame, Axis, GimbalLock, Sequence, from_matrix, from_modified_rodrigues, from_rodrigues,
    from_wxyz, matrix, modified_rodrigues, rodrigues, wxyz,
};
use affinor::group::{LieGroup, So3};
use nalgebra::{Matrix3, Rotation3, UnitQuaternion, Vector3};
use proptest::prelude::*;
use std::f64::consts::{FRAC_PI_2, FRAC_PI_3, PI, TAU};

const EPS: f64 = f64::EPSILON;

/// The distance of two rotations as quaternions up to sign.
fn distance(g: &UnitQuaternion<f64>, h: &UnitQuaternion<f64>) -> f64 {
    (g.coords - h.coords).norm().min((g.coords + h.coords).norm())
}

fn rotations() -> impl Strategy<Value = UnitQuaternion<f64>> {
    let component = prop_oneof![4 => -1.0..1.0f64, 1 => Just(0.0), 1 => -1e-9..1e-9f64];
    [component.clone(), component.clone(), component.clone(), component]
        .prop_filter_map("zero", |q| from_wxyz(q).ok())
}

properties! {
    #![cases(256)]

    #[test]
    fn matrices_and_back(g in rotations()) {
        let r = matrix(&g);
        prop_assert!((r.transpose() * r - Matrix3::identity()).amax() <= 4.0 * EPS);
        prop_assert!(distance(&from_matrix(&r, 4.0 * EPS).unwrap(), &g) <= 4.0 * EPS);
    }

    /// A quaternion of length other than 1 still has an orthogonal matrix.
    #[test]
    fn matrices_of_strayed_quaternions(g in rotations(), scale in 0.5..2.0f64) {
        let r = matrix(&UnitQuaternion::new_unchecked(g.into_inner() * scale));
        prop_assert!((r.transpose() * r - Matrix3::identity()).amax() <= 4.0 * EPS);
    }

    #[test]
    fn euler_angles_and_back(g in rotations()) {
        for sequence in Sequence::all() {
            let found = sequence.angles(&g);
            let back = sequence.rotation(found.angles);
            prop_assert!(distance(&back, &g) <= 16.0 * EPS, "{sequence:?} {found:?}");
            prop_assert!(found.angles.iter().all(|a| a.abs() <= PI));
            prop_assert!(found.lock.is_none() || found.angles[2] == 0.0);
        }
    }

    /// In gimbal lock, the combination of angles that is reported as determined equals that of the
    /// given angles.
    #[test]
    fn gimbal_lock(a in -3.0..3.0f64, c in -3.0..3.0f64, upper in any::<bool>()) {
        for sequence in Sequence::all() {
            let proper = sequence.angles(&UnitQuaternion::identity()).lock == Some(GimbalLock::Sum);
            let b = match (proper, upper) {
                (true, true) => PI,
                (true, false) => 0.0,
                (false, true) => FRAC_PI_2,
                (false, false) => -FRAC_PI_2,
            };
            let g = sequence.rotation([a, b, c]);
            let found = sequence.angles(&g);
            let kept = match found.lock {
                Some(GimbalLock::Sum) => a + c,
                Some(GimbalLock::Difference) => a - c,
                None => return Err(TestCaseError::fail(format!("{sequence:?} {found:?}"))),
            };
            let turns = (found.angles[0] - kept) / TAU;
            prop_assert!((turns - turns.round()).abs() < 1e-14, "{sequence:?} {found:?} {kept}");
            prop_assert_eq!(found.angles[2], 0.0);
            prop_assert!(distance(&sequence.rotation(found.angles), &g) <= 32.0 * EPS);
        }
    }

    #[test]
    fn rodrigues_parameters_and_back(g in rotations()) {
        prop_assert!(distance(&from_modified_rodrigues(&modified_rodrigues(&g)), &g) <= 4.0 * EPS);
        prop_assert!(modified_rodrigues(&g).norm() <= 1.0 + EPS);
        match rodrigues(&g) {
            Ok(r) => prop_assert!(distance(&from_rodrigues(&r), &g) <= 4.0 * EPS),
            Err(_) => prop_assert_eq!(g.w, 0.0),
        }
    }

    /// Conversions between any two kinds agree with conversions through the rotation vector.
    #[test]
    fn rotation_vectors_agree(x in [-1.8..1.8f64, -1.8..1.8, -1.8..1.8].prop_map(Vector3::from)) {
        let g = So3.exp(&x);
        let angle = x.norm();
        prop_assert!((rodrigues(&g).unwrap() * angle - x * (0.5 * angle).tan()).norm() <= 1e-14 * angle / g.w.abs());
        if angle < PI {
            prop_assert!((modified_rodrigues(&g) * angle - x * (0.25 * angle).tan()).norm() <= 1e-15 * angle);
            let back = So3.log(&from_matrix(&matrix(&g), 4.0 * EPS).unwrap()).unwrap();
            prop_assert!((back - x).norm() <= 8.0 * EPS * angle.max(1.0));
        }
    }

    /// Any finite numbers give a rotation or an error.
    #[test]
    fn nothing_finite_makes_a_nan(bits in any::<[u64; 4]>()) {
        let [a, b, c, d] = bits.map(f64::from_bits);
        prop_assume!([a, b, c, d].iter().all(|a| a.is_finite()));
        let v = Vector3::new(a, b, c);
        for g in [Some(from_rodrigues(&v)), Some(from_modified_rodrigues(&v)), from_wxyz([a, b, c, d]).ok()] {
            prop_assert!(g.is_none_or(|g| (g.norm() - 1.0).abs() < 4.0 * EPS), "{g:?}");
        }
        prop_assert!(So3.log(&UnitQuaternion::new_unchecked([a, b, c, d].into())).is_ok());
    }
}

#[test]
fn sequences() {
    assert_eq!(Sequence::all().count(), 24);
    for text in ["ZYX", "zxz"] {
        let [a, b, c] = [0.1, 0.2, 0.3];
        let r = |axis: Vector3<f64>, angle: f64| Rotation3::new(axis * angle).into_inner();
        let expected = match text {
            "ZYX" => r(Vector3::z(), a) * r(Vector3::y(), b) * r(Vector3::x(), c),
            _ => r(Vector3::z(), c) * r(Vector3::x(), b) * r(Vector3::z(), a),
        };
        let sequence: Sequence = text.parse().unwrap();
        assert!((matrix(&sequence.rotation([a, b, c])) - expected).amax() < 2.0 * EPS, "{text}");
    }
    for text in ["ZZX", "XYx", "XY", "XYZX", "abc", "", "xXy"] {
        assert!(matches!(text.parse::<Sequence>(), Err(Error::Invalid { .. })), "{text}");
    }
    assert!(Sequence::new([Axis::X, Axis::Y, Axis::Y], AxesFrame::Extrinsic).is_err());
}

#[test]
fn known_values() {
    let third = from_wxyz([1.0, 1.0, 1.0, 1.0]).unwrap(); // permutes the axes
    assert_eq!(matrix(&third), Matrix3::new(0.0, 0.0, 1.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0));
    assert_eq!(rodrigues(&third).unwrap(), Vector3::repeat(1.0));
    assert!((modified_rodrigues(&third).norm() - (0.5 * FRAC_PI_3).tan()).abs() < EPS);
    let half = from_wxyz([0.0, 0.0, -2.0, 0.0]).unwrap();
    assert_eq!(wxyz(&half), [0.0, 0.0, 1.0, 0.0]);
    assert_eq!(modified_rodrigues(&half), Vector3::y());
    assert_eq!(So3.log(&half).unwrap(), Vector3::y() * PI);
    let refused = rodrigues(&half).unwrap_err().to_string();
    assert_eq!(refused, "invalid Gibbs vector: the angle is pi");
}

#[test]
fn what_is_no_rotation_is_refused() {
    let mut r = Matrix3::identity();
    r[(0, 1)] = 1e-3;
    let refused = from_matrix(&r, 1e-6).unwrap_err().to_string();
    assert_eq!(refused, "invalid rotation: R^T R differs from 1 by 1e-3");
    assert!(from_matrix(&r, 1e-2).is_ok());
    assert!(from_matrix(&-Matrix3::identity(), 1e-6).is_err());
    for value in [f64::NAN, f64::INFINITY, 1e300] {
        assert!(from_matrix(&Matrix3::repeat(value), 1e-6).is_err());
        let mut r = Matrix3::identity();
        r[(2, 0)] = value;
        assert!(from_matrix(&r, 1e-6).is_err());
    }
    assert!(from_wxyz([f64::NAN, 1.0, 0.0, 0.0]).is_err());
}

/// The stored results of SciPy, from `tests/references/rotation_scipy.py`.
#[test]
fn scipy_agrees() {
    let mut lines = 0;
    for line in include_str!("../data/rotation_scipy.txt").lines() {
        lines += 1;
        let words: Vec<&str> = line.split(' ').collect();
        let numbers: Vec<f64> = words.iter().filter_map(|word| word.parse().ok()).collect();
        let rotation = |at: usize| from_wxyz(numbers[at..at + 4].try_into().unwrap()).unwrap();
        match words[0] {
            "euler" => {
                let found = words[1].parse::<Sequence>().unwrap().angles(&rotation(0)).angles;
                for (found, expected) in found.iter().zip(&numbers[4..]) {
                    let turns = (found - expected) / TAU;
                    assert!((turns - turns.round()).abs() < 1e-14, "{line}: {found}");
                }
            }
            "turned" => {
                let sequence: Sequence = words[1].parse().unwrap();
                let found = sequence.rotation(numbers[..3].try_into().unwrap());
                assert!(distance(&found, &rotation(3)) < 4.0 * EPS, "{line}: {found}");
            }
            _ => {
                let g = rotation(0);
                let expected = Matrix3::from_row_slice(&numbers[4..13]);
                assert!((matrix(&g) - expected).amax() < 4.0 * EPS, "{line}");
                let (vector, mrp) = (&numbers[13..16], &numbers[16..19]);
                let sign = if g.w == 0.0 {
                    So3.log(&g).unwrap().dot(&Vector3::from_row_slice(vector)).signum()
                } else {
                    1.0
                };
                let difference = So3.log(&g).unwrap() - Vector3::from_row_slice(vector) * sign;
                assert!(difference.norm() < 8.0 * EPS * PI, "{line}");
                let difference = modified_rodrigues(&g) - Vector3::from_row_slice(mrp) * sign;
                assert!(difference.norm() < 4.0 * EPS, "{line}");
            }
        }
    }
    assert_eq!(lines, 20 * 25 + 72);
}
