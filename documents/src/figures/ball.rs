//! Elements, tangent vectors and curves in the ball of rotation vectors.

use crate::input::InputError;
use crate::space::{Request, Space};
use affinor::group::transport::ParallelTranslation;
use affinor::group::{LieGroup, So3};
use affinor::{ConnectionKind, Error};
use affinor_tensors::Tolerance;
use nalgebra::{UnitQuaternion, Vector3};
use std::f64::consts::PI;

/// The radius of the ball: the largest angle of a rotation.
pub const RADIUS: f64 = PI;

/// Parallel transport on the rotation group by the connection with this name. Also returns the
/// title of the connection. `metric` is the metric of `levi-civita`.
///
/// # Errors
/// An error for a connection or a metric that cannot be parsed, and for a parameter without a
/// value.
pub fn connected(
    name: &str,
    metric: Option<&str>,
) -> Result<(String, ParallelTranslation<So3>), InputError> {
    let space = Space::open(&Request {
        space: Some("so3".into()),
        connection: Some(name.into()),
        metric: metric.map(Into::into),
        ..Request::default()
    })?;
    let geometry = space.in_floats()?.geometry(Tolerance::default())?;
    let of_paper = match geometry.kind().name() {
        "plus" => "M(3): ",
        "zero" => "SO(3): ",
        _ => "",
    };
    let kind = match geometry.kind() {
        ConnectionKind::Family(lambda) => format!("lambda = {lambda}"),
        kind => kind.name().into(),
    };
    let title = format!("{of_paper}connection {kind}");
    Ok((title, ParallelTranslation::new(So3, geometry.connection().clone())?))
}

/// The arrow of the tangent vector at `x` whose components in the left-invariant frame are `u`. The
/// arrow is `scale` times as long as `dx = T_left(x)^-1 u`.
///
/// # Errors
/// [`Law::RegularTangent`](affinor::Law::RegularTangent) far outside the ball.
pub fn arrow(x: &Vector3<f64>, u: &Vector3<f64>, scale: f64) -> Result<[Vector3<f64>; 2], Error> {
    Ok([*x, x + So3.tangent_left_inverse(x, u)? * scale])
}

/// The curve through closely spaced elements, in pieces. If the curve leaves the ball, its next
/// piece begins at the opposite point of the sphere.
///
/// # Errors
/// [`Error::Invalid`], which does not occur for rotations.
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

/// The intersection of the sphere with the line from a point inside to a point outside.
fn onto_sphere(inside: &Vector3<f64>, outside: &Vector3<f64>) -> Vector3<f64> {
    let (near, far) = (inside.norm(), outside.norm());
    let share = ((RADIUS - near) / (far - near)).clamp(0.0, 1.0);
    inside.lerp(outside, share).normalize() * RADIUS
}
