//! The ball of rotation vectors: where elements, tangent vectors and curves are drawn.

use crate::Error;
use crate::group::{LieGroup, So3};
use nalgebra::{UnitQuaternion, Vector3};
use std::f64::consts::PI;

/// Rotations by this angle are the sphere; its opposite points are one rotation.
pub const RADIUS: f64 = PI;

/// The tangent vector at `x` with the left components `u`, as an arrow: `dx = T_left(x)^-1 u`, drawn
/// `scale` times as long.
///
/// # Errors
/// [`Error::SingularTangent`], far outside of the ball.
pub fn arrow(x: &Vector3<f64>, u: &Vector3<f64>, scale: f64) -> Result<[Vector3<f64>; 2], Error> {
    Ok([*x, x + So3.tangent_left_inverse(x, u)? * scale])
}

/// A curve through elements, close to each other: a piece for each stay in the ball. Where it leaves
/// through the sphere it comes back at the opposite point.
///
/// # Errors
/// [`Error::NoLogarithm`], which rotations always have.
pub fn curve(elements: &[UnitQuaternion<f64>]) -> Result<Vec<Vec<Vector3<f64>>>, Error> {
    let mut pieces: Vec<Vec<Vector3<f64>>> = vec![];
    for g in elements {
        let inside = So3.log(g)?;
        let Some(piece) = pieces.last_mut() else {
            pieces.push(vec![inside]);
            continue;
        };
        let before = piece.last().copied().unwrap_or_default();
        let onward = So3.log_near(g, &before)?;
        if onward.norm() <= RADIUS * (1.0 + 1e-12) {
            piece.push(onward);
            continue;
        }
        let exit = onto_sphere(&before, &onward);
        piece.push(exit);
        pieces.push(vec![-exit, inside]);
    }
    Ok(pieces)
}

/// The point of the sphere between one inside and one outside.
fn onto_sphere(inside: &Vector3<f64>, outside: &Vector3<f64>) -> Vector3<f64> {
    let (near, far) = (inside.norm(), outside.norm());
    let share = ((RADIUS - near) / (far - near)).clamp(0.0, 1.0);
    inside.lerp(outside, share).normalize() * RADIUS
}
