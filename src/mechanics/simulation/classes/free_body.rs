//! The free rigid body, whose attitude has a closed form.

use crate::Error;
use crate::group::So3;
use crate::mechanics::simulation::forces::ForcesOn;
use crate::mechanics::simulation::stepper::Stepper;
use crate::mechanics::{BodyState, EulerPoincare, FreeBody, Inertia, State, stopped};
use nalgebra::Vector3;

/// An Euler-Poincare system whose forces are formulas.
pub type Body<G> = EulerPoincare<G, ForcesOn<G>>;

/// The inertia and the initial condition of a body.
pub struct FreeStart {
    /// The inertia.
    pub inertia: Inertia,
    /// The initial state.
    pub state: State<So3>,
    /// The momentum in body components.
    pub momentum: Vector3<f64>,
}

/// The state of a free body at any time.
pub(in crate::mechanics::simulation) fn exact(
    start: &FreeStart,
) -> Result<Stepper<Body<So3>>, Error> {
    let (State { time, element: attitude, spatial }, momentum) =
        (start.state.clone(), start.momentum);
    let body = FreeBody::new(&start.inertia, &BodyState { attitude, momentum })?;
    let rate = body.rate();
    let at = move |t: f64| {
        expect_phase(rate, t, t - time)?;
        Ok(State { time: t, element: body.at(t - time).attitude, spatial })
    };
    Ok(Stepper::exact(at, rate))
}

/// The rounding of a time may cause a rotation of at most this angle, in radians.
const PHASE: f64 = 1e-3;

/// Checks that the attitude of a body is determined in spite of the rounding of the time. The bound
/// of the angular velocity is `rate`.
fn expect_phase(rate: f64, t: f64, elapsed: f64) -> Result<(), Error> {
    let turn = f64::EPSILON * rate * t.abs().max(elapsed.abs());
    if turn <= PHASE {
        return Ok(());
    }
    Err(stopped(
        t,
        format!(
            "the time is too long: its rounding error alone rotates the body by {turn:.1e} radians"
        ),
    ))
}
