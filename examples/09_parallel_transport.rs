//! How does a vector change under parallel transport along a curve of a group?
//!
//! The connection determines the change. With `plus`, the result depends only on the end points.
//! With `zero`, transport along a loop rotates the vector.

use affinor::group::transport::ParallelTranslation;
use affinor::group::{LieGroup, So3};
use affinor::{CanonicalConnection, Connection, Metric};
use nalgebra::{Matrix3, Vector3};
use std::f64::consts::TAU;

/// Transports vectors along loops on the rotation group, and along a geodesic of a body.
pub fn main() -> Result<(), Box<dyn std::error::Error>> {
    let so3 = So3.algebra()?;
    let on = |which| ParallelTranslation::new(So3, Connection::canonical(&so3, which));

    // a full turn about z: transport is the identity, or a half turn
    let loop_about_z = Vector3::new(0.0, 0.0, TAU);
    for (which, trace) in [
        (CanonicalConnection::Plus, 3.0),
        (CanonicalConnection::Zero, -1.0),
        (CanonicalConnection::Minus, 3.0),
    ] {
        let carried = on(which)?.along_subgroup(&loop_about_z)?;
        println!("{}: trace {:.3} after a closed subgroup", which.name(), carried.trace());
        assert!((carried.trace() - trace).abs() < 1e-14);
    }

    // a contractible loop: two arcs forth, and a third arc back to the start
    let (x, y) = (Vector3::new(0.3, 0.0, 0.0), Vector3::new(0.0, 0.4, 0.0));
    let back = -So3.log(&So3.compose(&So3.exp(&x), &So3.exp(&y)))?;
    let plus = on(CanonicalConnection::Plus)?.along_arcs(&[x, y, back])?;
    assert!((&plus - Matrix3::identity()).norm() < 1e-15); // because the curvature is zero
    let zero = on(CanonicalConnection::Zero)?.along_arcs(&[x, y, back])?;
    println!("zero: the loop rotates by {:.5}", ((zero.trace() - 1.0) / 2.0).acos());
    assert!((zero.trace() - 3.0).abs() > 1e-4);

    // the free motion of a body is a geodesic of its inertia, so its velocity is transported along
    // itself
    let inertia = Metric::diagonal([1.0, 2.0, 3.0])?;
    let body = ParallelTranslation::new(So3, Connection::levi_civita(so3.left_frame(), &inertia)?)?;
    let start = Vector3::new(0.1, 1.0, 0.2);
    let reached = body.autoparallel(&So3.identity(), &start, &[5.0], 1e-12)?.remove(0);
    let momentum = |at: &nalgebra::UnitQuaternion<f64>, v: &Vector3<f64>| {
        at * v.component_mul(&Vector3::new(1.0, 2.0, 3.0))
    };
    let drift = momentum(&reached.base, &reached.left) - momentum(&So3.identity(), &start);
    println!("spatial momentum drifts by {:.1e}", drift.norm());
    assert!(drift.norm() < 1e-10);
    Ok(())
}
