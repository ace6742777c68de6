//! The algorithm of Simo and Wong, which conserves energy and momentum.

use super::{Integrator, expect_finite};
use crate::Error;
use crate::group::{LieGroup, So3};
use crate::mechanics::State;
use crate::mechanics::integrators::principal::Principal;
use crate::mechanics::stopped;
use crate::mechanics::systems::euler_poincare::{EulerPoincare, Torque};
use crate::mechanics::{BodyState, Inertia};
use nalgebra::{Matrix3, Vector3};

/// The largest number of Newton iterations. Three or four iterations normally suffice, but a torque
/// that changes much within a step requires more.
const ITERATIONS: usize = 60;
/// A correction below this size that no longer decreases is a rounding error.
const ROUNDING: f64 = 1e-11;

/// Steps `R exp(u)` of a rigid body with `u = h (Omega_0 + Omega_1)/2`:
///
/// ```text
/// J Omega_1 = exp(-u) J Omega_0 + h exp(-u/2) M(t + h/2, R exp(u/2), u/h)
/// ```
///
/// Without a torque, `u . J (Omega_1 - Omega_0) = 0`. Therefore, the energy is conserved up to
/// rounding errors, and the spatial momentum is conserved exactly. The method is symmetric and of
/// order 2. A torque is evaluated at the midpoint, so that the momentum about the axis of a
/// symmetric potential is conserved. The energy in a potential drifts, because the step is not
/// symplectic; [`Kick`](super::Kick) is more suitable for a potential.
///
/// J. C. Simo and K. K. Wong, *Int. J. Numer. Methods Eng.* 31 (1991) 19-52.
#[derive(Clone, Debug, PartialEq)]
pub struct SimoWong {
    body: Principal,
}

impl SimoWong {
    /// The algorithm for a body with this inertia.
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
    /// In addition, [`Error::Invalid`] if the system is another body.
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
            // the residual is divided by h, because the unknown is multiplied by h J
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
