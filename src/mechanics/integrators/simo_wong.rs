//! The energy and momentum conserving algorithm of Simo and Wong.

use super::{Integrator, expect_finite};
use crate::Error;
use crate::group::{LieGroup, So3};
use crate::mechanics::State;
use crate::mechanics::integrators::principal::Principal;
use crate::mechanics::stopped;
use crate::mechanics::systems::euler_poincare::{EulerPoincare, Torque};
use crate::mechanics::{BodyState, Inertia};
use nalgebra::{Matrix3, Vector3};

/// The largest number of Newton iterations. Normally three or four are enough; a torque that
/// changes much within a step takes more.
const ITERATIONS: usize = 60;
/// The size below which a correction that no longer decreases is a rounding error.
const ROUNDING: f64 = 1e-11;

/// Steps `R exp(u)` of a rigid body with `u = h (Omega_0 + Omega_1)/2`:
///
/// ```text
/// J Omega_1 = exp(-u) J Omega_0 + h exp(-u/2) M(t + h/2, R exp(u/2), u/h)
/// ```
///
/// Without a torque `u . J (Omega_1 - Omega_0) = 0`, so the energy is conserved up to rounding
/// errors, and the spatial momentum exactly. The method is symmetric and of order 2. A torque is
/// evaluated at the midpoint, so that the momentum about the axis of a symmetric potential is
/// conserved. The energy in a potential drifts, because the step is not symplectic;
/// [`Kick`](super::Kick) is better for a potential.
///
/// J. C. Simo and K. K. Wong, *Int. J. Numer. Methods Eng.* 31 (1991) 19-52.
#[derive(Clone, Debug, PartialEq)]
pub struct SimoWong {
    body: Principal,
}

impl SimoWong {
    /// Steps of a body.
    pub fn new(inertia: &Inertia) -> Self {
        SimoWong { body: Principal::new(inertia) }
    }

    /// The order of convergence.
    pub fn order(&self) -> u32 {
        2
    }
}

impl<M: Torque<So3>> Integrator<EulerPoincare<So3, M>> for SimoWong {
    /// # Errors
    /// Also [`Error::Invalid`] if the system has another body.
    fn step(
        &self,
        system: &EulerPoincare<So3, M>,
        state: &mut State<So3>,
        h: f64,
    ) -> Result<(), Error> {
        let BodyState { attitude, momentum } = self.body.state(system, state)?;
        if h == 0.0 {
            return Ok(());
        }
        let moments = self.body.principal_moments();
        // the impulse over the step, in spatial components
        let impulse = |u: &Vector3<f64>| {
            let middle = attitude * So3.exp(&(u * 0.5));
            self.body.torque(system, state.time + 0.5 * h, middle, &(u / h)) * h
        };
        let start = momentum.component_div(moments) * h;
        let mut u = start;
        let mut last = f64::INFINITY;
        for _ in 0..ITERATIONS {
            let end = attitude * So3.exp(&u);
            let impulse = impulse(&u);
            let pushed = end.inverse_transform_vector(&(state.spatial + impulse));
            // divided by h, because h J multiplies the unknown
            let residual = moments.component_mul(&(u * 2.0 - start)) - pushed * h;
            expect_finite(state.time, &residual)?;
            let slope = |v: Vector3<f64>| pushed.cross(&So3.tangent_left(&u, &v));
            let columns = [Vector3::x(), Vector3::y(), Vector3::z()].map(slope);
            let derivative =
                Matrix3::from_diagonal(moments) * 2.0 - Matrix3::from_columns(&columns) * h;
            let Some(inverse) = derivative.try_inverse() else { break };
            let correction = inverse * residual;
            let (size, length) = (correction.norm(), u.norm());
            if size <= f64::EPSILON * length || (size >= last && size <= ROUNDING * length) {
                let (element, spatial) = (self.body.attitude(end), state.spatial + impulse);
                *state = State { time: state.time + h, element, spatial };
                return Ok(());
            }
            u -= correction;
            last = size;
        }
        Err(stopped(state.time, "the step is too long"))
    }
}
