//! Motions of a body that are products of uniform rotations.

use affinor::group::{LieGroup, So3};
use nalgebra::{UnitQuaternion, Vector3};

/// The motion `g(t) = exp(t x_1) exp(t x_2) ...` from the identity, `0 <= t <= 1`.
///
/// Two factors give a steady precession: about `x_1` in space, and about `x_2` in the body.
#[derive(Clone, Debug, PartialEq)]
pub struct Path {
    /// The rotation vectors `x_1, x_2, ...`. The first rotation is about an axis fixed in space;
    /// the last rotation is about an axis fixed in the body.
    pub factors: Vec<Vector3<f64>>,
}

impl Path {
    /// The element `g(t)`.
    pub fn element(&self, t: f64) -> UnitQuaternion<f64> {
        let factors = self.factors.iter().map(|x| So3.exp(&(x * t)));
        factors.fold(So3.identity(), |g, h| So3.compose(&g, &h))
    }

    /// The body angular velocity `Omega(t) = g^-1 g'`. It is computed factor by factor: each factor
    /// `h = exp(t x)` maps it to `Ad_h^-1 Omega + x`.
    pub fn velocity(&self, t: f64) -> Vector3<f64> {
        let carry =
            |omega: Vector3<f64>, x: &Vector3<f64>| So3.adjoint(&So3.exp(&(x * -t)), &omega) + x;
        self.factors.iter().fold(Vector3::zeros(), carry)
    }
}
