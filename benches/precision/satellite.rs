//! A satellite in a low orbit, in SI units.

use crate::problem::{Problem, rows};
use crate::sweep::Seen;
use affinor::group::{Se3, So3};
use affinor::mechanics::systems::euler_poincare::Torque;
use affinor::mechanics::{EulerPoincare, State};
use nalgebra::{Isometry3, UnitQuaternion, Vector3, Vector6};

/// The attraction of a point mass, up to the second order in the size of the body (MacCullagh).
#[derive(Clone, Copy)]
pub struct Gravity {
    /// The principal moments of inertia of the body.
    pub moments: Vector3<f64>,
    /// Its mass.
    pub mass: f64,
    mu: f64,
}

impl Gravity {
    pub fn new(problem: &Problem, mu: f64) -> Self {
        let diagonal = problem.diagonal();
        Gravity { moments: Vector3::from_column_slice(&diagonal[..3]), mass: diagonal[3], mu }
    }

    /// The torque and the force in body components: with `n = R^T x/r`,
    /// `3 mu/r^3 n cross J n` and `-(m + 3 (tr J - 5 n.J n)/(2 r^2)) mu/r^2 n - 3 mu/r^4 J n`.
    #[inline]
    pub fn at(
        &self,
        attitude: &UnitQuaternion<f64>,
        position: &Vector3<f64>,
    ) -> (Vector3<f64>, Vector3<f64>) {
        let inverse = 1.0 / position.norm();
        let n = attitude.inverse_transform_vector(position) * inverse;
        let spread = self.moments.component_mul(&n);
        let square = inverse * inverse;
        let (pull, tidal) = (self.mu * square, 3.0 * self.mu * square * inverse);
        let small = 0.5 * inverse * tidal * (self.moments.sum() - 5.0 * n.dot(&spread));
        let force = n * (self.mass * pull + small) + spread * (tidal * inverse);
        (n.cross(&spread) * tidal, -force)
    }

    /// The force of an [`EulerPoincare`] system.
    pub fn torque(self) -> impl Torque<Se3> {
        move |_: f64, g: &Isometry3<f64>, _: &Vector6<f64>| {
            let (torque, force) = self.at(&g.rotation, &g.translation.vector);
            Vector6::new(torque.x, torque.y, torque.z, force.x, force.y, force.z)
        }
    }
}

/// Attitude, spin, position and velocity.
pub fn seen<M: Torque<Se3>>(system: &EulerPoincare<Se3, M>, state: &State<Se3>) -> Seen {
    let (pose, twist) = (&state.element, system.velocity(state));
    let velocity = pose.rotation * Vector3::new(twist[3], twist[4], twist[5]);
    vec![
        rows(&So3, &pose.rotation),
        twist.as_slice()[..3].to_vec(),
        pose.translation.vector.as_slice().to_vec(),
        velocity.as_slice().to_vec(),
    ]
}
