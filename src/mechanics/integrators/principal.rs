//! Steps of bodies in their principal axes.

use crate::Error;
use crate::group::{LieGroup, So3};
use crate::mechanics::bodies::{BodyState, Inertia};
use crate::mechanics::stopped;
use crate::mechanics::systems::State;
use crate::mechanics::systems::euler_poincare::{EulerPoincare, Torque};
use nalgebra::{Matrix3, Rotation3, UnitQuaternion, Vector3};

/// The transformation between body axes and principal axes, in terms of quaternions.
///
/// A matrix of axes is orthogonal only up to rounding errors, which would accumulate over a million
/// steps. The error of a quaternion only changes its length, which cancels.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Principal {
    moments: Vector3<f64>,
    inertia: Matrix3<f64>,
    axes: UnitQuaternion<f64>,
}

impl Principal {
    pub(super) fn new(inertia: &Inertia) -> Self {
        let axes = Rotation3::from_matrix_unchecked(*inertia.axes());
        let axes = UnitQuaternion::from_rotation_matrix(&axes);
        Principal {
            moments: *inertia.principal_moments(),
            inertia: inertia.matrix(),
            axes: So3.project(axes),
        }
    }

    /// The principal moments.
    pub(super) fn principal_moments(&self) -> &Vector3<f64> {
        &self.moments
    }

    /// The attitude of the principal axes, and the momentum along them.
    ///
    /// # Errors
    /// [`Error::Invalid`] if the system is another body.
    #[inline]
    pub(super) fn state<M: Torque<So3>>(
        &self,
        system: &EulerPoincare<So3, M>,
        state: &State<So3>,
    ) -> Result<BodyState, Error> {
        system.expect_body(&self.inertia)?;
        let attitude = So3.project(state.element * self.axes);
        Ok(BodyState { attitude, momentum: attitude.inverse_transform_vector(&state.spatial) })
    }

    /// The attitude of the principal axes and the momentum along them, for a free body.
    ///
    /// # Errors
    /// [`Error::Invalid`] if the system is another body, and [`Error::Integration`] if it has a
    /// torque.
    #[inline]
    pub(super) fn free_state<M: Torque<So3>>(
        &self,
        system: &EulerPoincare<So3, M>,
        state: &State<So3>,
    ) -> Result<BodyState, Error> {
        if !system.torque().is_absent() {
            return Err(stopped(state.time, "the method is for a free body, but a torque acts"));
        }
        self.state(system, state)
    }

    /// The attitude of the body, computed from the attitude of its principal axes.
    #[inline]
    pub(super) fn attitude(&self, axes: UnitQuaternion<f64>) -> UnitQuaternion<f64> {
        So3.project(axes * self.axes.inverse())
    }

    /// The torque in spatial components, for an attitude of the principal axes.
    pub(super) fn torque<M: Torque<So3>>(
        &self,
        system: &EulerPoincare<So3, M>,
        time: f64,
        axes: UnitQuaternion<f64>,
        velocity: &Vector3<f64>,
    ) -> Vector3<f64> {
        let element = self.attitude(axes);
        element * system.moment(time, &element, &(self.axes * velocity))
    }
}
