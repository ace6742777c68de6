//! How do I interpolate and average poses of a rigid body?
//!
//! A pose is an element of SE(3), the type `Isometry3` of nalgebra. Twists have the rotation first.

use affinor::group::{LieGroup, Se3};
use nalgebra::{Isometry3, Point3, Translation3, UnitQuaternion, Vector3, Vector6};

/// Computes the screw motion between two poses, and the mean of noisy poses.
pub fn main() -> Result<(), Box<dyn std::error::Error>> {
    let pose = |position: [f64; 3], rotation: [f64; 3]| {
        let rotation = UnitQuaternion::from_scaled_axis(Vector3::from(rotation));
        Isometry3::from_parts(Translation3::from(Vector3::from(position)), rotation)
    };

    // moves from the first pose to the second with a constant body twist
    let start = pose([1.0, 0.0, 0.0], [0.0; 3]);
    let end = pose([0.0, 1.0, 1.0], [0.0, 0.0, std::f64::consts::FRAC_PI_2]);
    let twist = Se3.log(&Se3.between(&start, &end))?;
    for step in 0..=4 {
        let t = f64::from(step) / 4.0;
        let at = Se3.interpolate(&start, &end, t)?;
        let p = at.translation.vector;
        println!("t = {t:.2}: position {:.4} {:.4} {:.4}", p.x, p.y, p.z);
        // the expected position: the path is a quarter of a helix about the z axis
        let expected =
            Vector3::new((t * 90_f64.to_radians()).cos(), (t * 90_f64.to_radians()).sin(), t);
        assert!((p - expected).norm() < 1e-15);
        assert!((Se3.exp(&(twist * t)).inverse() * start.inverse() * at).rotation.angle() < 1e-15);
    }

    // the measured poses scatter about the true pose; their mean does not depend on the frame of
    // the laboratory
    let scatter = (0..12).map(|k| {
        let k = f64::from(k);
        Vector6::from_fn(|i, _| 0.1 * (1.7 * k + 2.3 * i as f64).sin())
    });
    let measured: Vec<_> = scatter.map(|x| Se3.compose(&end, &Se3.exp(&x))).collect();
    let mean = Se3.mean(&measured)?;
    let residual = measured.iter().try_fold(Vector6::zeros(), |sum, g| {
        Ok::<_, affinor::Error>(sum + Se3.log(&Se3.between(&mean, g))?)
    })?;
    println!(
        "mean position {:.4}, sum of the deviations {:.1e}",
        mean * Point3::origin(),
        residual.norm()
    );
    assert!(residual.norm() < 1e-13);
    let lab = pose([5.0, -2.0, 1.0], [0.3, 1.0, -0.4]);
    let moved: Vec<_> = measured.iter().map(|g| lab * g).collect();
    let off = Se3.log(&Se3.between(&(lab * mean), &Se3.mean(&moved)?))?;
    assert!(off.norm() < 1e-13);
    Ok(())
}
