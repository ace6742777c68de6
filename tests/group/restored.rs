//! The nearest elements of groups agree with the polar decomposition, near the origin of space and
//! far from it.

use crate::common::property::properties;
use affinor::group::{LieGroup, MatrixNotation, Se3, So3, restored};
use nalgebra::{DMatrix, Matrix3, Vector3, Vector6};
use proptest::prelude::*;

/// The nearest rotation to a matrix with a positive determinant: `U V^T` of its singular value decomposition `U S V^T`.
fn polar(m: &Matrix3<f64>) -> Matrix3<f64> {
    let svd = m.svd(true, true);
    svd.u.unwrap() * svd.v_t.unwrap()
}

fn errors() -> impl Strategy<Value = Matrix3<f64>> {
    (-8i32..-1, proptest::array::uniform9(-1.0..1.0f64))
        .prop_map(|(power, entries)| Matrix3::from_row_slice(&entries) * 10f64.powi(power) * 0.5)
}

properties! {
    #![cases(64)]

    #[test]
    fn of_rotations_is_the_polar_factor(x in proptest::array::uniform3(-2.5..2.5f64), error in errors()) {
        let g = So3.exp(&Vector3::from(x));
        let m = g.to_rotation_matrix().into_inner() + error;
        let (nearest, distance) = restored(&So3, &DMatrix::from_column_slice(3, 3, m.as_slice())).unwrap();
        let nearest = nearest.to_rotation_matrix().into_inner();
        prop_assert!((nearest - polar(&m)).amax() < 1e-10, "{}", (nearest - polar(&m)).amax());
        prop_assert!((distance - (nearest - m).amax()).abs() < 1e-14);
    }

    /// The rotation is the nearest one to the block, and the translation does not change, wherever
    /// the body is and in any unit of length.
    #[test]
    fn of_poses_keeps_the_translation(
        x in proptest::array::uniform3(-2.0..2.0f64),
        error in errors(),
        place in proptest::array::uniform3(-1.0..1.0f64),
        power in -9i32..10,
    ) {
        let p = Vector3::from(place) * 10f64.powi(power);
        let pose = Se3.exp(&Vector6::new(x[0], x[1], x[2], 0.0, 0.0, 0.0));
        let mut m = Se3.write(&pose);
        let block = m.fixed_view::<3, 3>(0, 0) + error;
        m.fixed_view_mut::<3, 3>(0, 0).copy_from(&block);
        m.fixed_view_mut::<3, 1>(0, 3).copy_from(&p);
        let nearest = Se3.write(&restored(&Se3, &m).unwrap().0);
        let off = (nearest.fixed_view::<3, 3>(0, 0) - polar(&block)).amax();
        // finite differences lose accuracy next to large translations
        prop_assert!(off < 1e-9, "{power}: {off:e}");
        prop_assert!((nearest.fixed_view::<3, 1>(0, 3) - p).norm() < 1e-9 * p.norm().max(1.0));
    }
}

#[test]
fn reflections_have_no_nearest_rotation() {
    let reflection =
        DMatrix::from_diagonal(&Vector3::new(-1.0, 1.0, 1.0).as_slice().to_vec().into());
    let error = restored(&So3, &reflection).unwrap_err().to_string();
    assert!(error.contains("the nearest element found differs by"), "{error}");
}
