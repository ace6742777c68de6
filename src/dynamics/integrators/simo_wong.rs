//! The energy and momentum conserving algorithm of Simo and Wong.

use super::{Integrator, expect_finite};
use crate::Error;
use crate::dynamics::Inertia;
use crate::dynamics::euler_poincare::{EulerPoincare, State, Torque};
use crate::group::{LieGroup, So3};
use nalgebra::{Matrix3, Vector3};

/// Newton's method needs three or four; a torque that changes much within a step takes more.
const ITERATIONS: usize = 60;
/// A correction that does not become smaller any more is rounding, if it is below this.
const ROUNDING: f64 = 1e-11;

/// Steps `R exp(u)` of a rigid body with `u = h (Omega_0 + Omega_1)/2`:
///
/// ```text
/// J Omega_1 = exp(-u) J Omega_0 + h exp(-u/2) M(t + h/2, R exp(u/2), u/h)
/// ```
///
/// so that without a torque `u . J (Omega_1 - Omega_0) = 0`: energy and momentum in space are kept, the one to the
/// rounding of the solution, the other to the last bit. Of order 2 and symmetric. A torque is taken in the middle;
/// the momentum about the axis of a symmetric potential is then kept as well, the energy is not to rounding.
///
/// J. C. Simo and K. K. Wong, *Int. J. Numer. Methods Eng.* 31 (1991) 19-52.
#[derive(Clone, Debug, PartialEq)]
pub struct SimoWong {
    inertia: Inertia,
    matrix: Matrix3<f64>,
}

impl SimoWong {
    /// Steps of a body.
    pub fn new(inertia: &Inertia) -> Self {
        let axes = inertia.axes();
        let matrix = axes * Matrix3::from_diagonal(inertia.moments()) * axes.transpose();
        SimoWong { inertia: inertia.clone(), matrix }
    }

    /// The order of the error of a motion.
    pub fn order(&self) -> u32 {
        2
    }
}

impl<M: Torque<So3>> Integrator<EulerPoincare<So3, M>> for SimoWong {
    /// # Errors
    /// Also [`Error::NoInertia`] for a system of another body.
    fn step(
        &self,
        system: &EulerPoincare<So3, M>,
        state: &mut State<So3>,
        h: f64,
    ) -> Result<(), Error> {
        system.expect_body(&self.inertia)?;
        if h == 0.0 {
            return Ok(());
        }
        let momentum = system.momentum(state);
        let velocity = self.inertia.velocity(&momentum);
        let middle = |u: &Vector3<f64>| {
            let element = state.element * So3.exp(&(u * 0.5));
            let moment = system.moment(state.time + 0.5 * h, &element, &(u / h));
            (element, moment)
        };
        let mut u = velocity * h;
        let mut last = f64::INFINITY;
        for _ in 0..ITERATIONS {
            let back = So3.exp(&u).inverse() * momentum;
            let push = So3.exp(&(u * -0.5)) * middle(&u).1;
            // over h, as h J is what multiplies the unknown
            let residual = self.matrix * (u * 2.0 - velocity * h) - (back + push * h) * h;
            expect_finite(state.time, &[&residual])?;
            let slope = |v: Vector3<f64>| back.cross(&So3.tangent_left(&u, &v));
            let columns = [Vector3::x(), Vector3::y(), Vector3::z()].map(slope);
            let derivative = self.matrix * 2.0 - Matrix3::from_columns(&columns) * h;
            let Some(inverse) = derivative.try_inverse() else { break };
            let correction = inverse * residual;
            u -= correction;
            let (size, length) = (correction.norm(), u.norm());
            if size <= f64::EPSILON * length || (size >= last && size <= ROUNDING * length) {
                let (element, moment) = middle(&u);
                let spatial = state.spatial + element * (moment * h);
                expect_finite(state.time, &[&spatial])?;
                let element = So3.restored(state.element * So3.exp(&u));
                *state = State { time: state.time + h, element, spatial };
                return Ok(());
            }
            last = size;
        }
        let reason = "the step is too long".into();
        Err(Error::Integration { t: state.time, reason })
    }
}
