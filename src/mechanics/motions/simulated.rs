//! The methods of integration that a group has.

use super::Method;
use super::configuration::ConfigurationGroup;
use super::drive::{Drive, EmbeddedMethods};
use super::forces::Forces;
use crate::Error;
use crate::group::{AnyGroup, MatrixGroup, Nilpotent, Opposite, Se2, Se3, Sl2, So2, So3};
use crate::mechanics::integrators::kick::FreeMotion;
use crate::mechanics::integrators::moser_veselov::Order;
use crate::mechanics::integrators::projected::Projection;
use crate::mechanics::systems::euler_poincare::Free;
use crate::mechanics::{
    BodyState, EulerPoincare, FreeBody, Inertia, Integrator, Kick, MoserVeselov, SimoWong,
    Splitting, State,
};
use nalgebra::DMatrix;

/// An Euler-Poincare system with forces as formulas.
pub type Body<G> = EulerPoincare<G, Forces<G>>;

/// A configuration group with the methods of integration that it has beside those of all groups.
pub trait SimulationGroup: ConfigurationGroup {
    /// Its projection methods: [`Projection`], if [`has_projection`](crate::group::Embedded::has_projection), or `()`.
    type Embedding: EmbeddedMethods<Self>;

    /// The inertia of a body with a metric, if the group is that of rotations.
    fn body(&self, inertia: &DMatrix<f64>) -> Option<Result<Inertia, Error>> {
        let _ = inertia;
        None
    }

    /// The drive of a method for bodies; `None` if the group has no such method.
    fn body_drive(
        &self,
        method: Method,
        system: &Body<Self>,
        inertia: &Inertia,
        start: &State<Self>,
        step: f64,
    ) -> Option<Result<Drive<Body<Self>>, Error>> {
        let _ = (method, system, inertia, start, step);
        None
    }
}

impl SimulationGroup for So2 {
    type Embedding = Projection;
}

impl SimulationGroup for Se2 {
    type Embedding = Projection;
}

impl SimulationGroup for Se3 {
    type Embedding = Projection;
}

impl SimulationGroup for Sl2 {
    type Embedding = Projection;
}

impl SimulationGroup for MatrixGroup {
    type Embedding = ();
}

impl SimulationGroup for Nilpotent<f64> {
    type Embedding = Projection;
}

impl SimulationGroup for AnyGroup {
    type Embedding = Projection;
}

impl<G: ConfigurationGroup> SimulationGroup for Opposite<G> {
    type Embedding = ();
}

impl SimulationGroup for So3 {
    type Embedding = Projection;

    fn body(&self, inertia: &DMatrix<f64>) -> Option<Result<Inertia, Error>> {
        Some(Inertia::new(&inertia.fixed_view::<3, 3>(0, 0).into_owned()))
    }

    fn body_drive(
        &self,
        method: Method,
        system: &Body<Self>,
        inertia: &Inertia,
        start: &State<Self>,
        step: f64,
    ) -> Option<Result<Drive<Body<Self>>, Error>> {
        let State { time, element: attitude, spatial } = *start;
        let momentum = system.momentum(start);
        match method {
            Method::Exact => {
                let body = FreeBody::new(inertia, &BodyState { attitude, momentum });
                Some(body.map(|body| {
                    let rate = body.rate();
                    let at = move |t: f64| {
                        expect_phase(rate, t, t - time)?;
                        Ok(State { time: t, element: body.at(t - time).attitude, spatial })
                    };
                    Drive::Exact { at: Box::new(at), rate }
                }))
            }
            Method::MoserVeselov(order) => free(MoserVeselov::new(inertia, order), system, step),
            Method::Splitting(composition) => {
                free(Splitting::new(inertia, composition), system, step)
            }
            Method::SimoWong => Some(Ok(Drive::fixed(SimoWong::new(inertia), step))),
            Method::Kick(order) => {
                let motion = FreeMotion::MoserVeselov(Order::Ten);
                Some(Ok(Drive::fixed(Kick::new(inertia, order, motion), step)))
            }
            _ => None,
        }
    }
}

/// The largest rotation, in radians, by the rounding of a time.
const PHASE: f64 = 1e-3;

/// Checks that the rounding of a time leaves the attitude of a body determined, at a bound of its angular velocity.
fn expect_phase(rate: f64, t: f64, elapsed: f64) -> Result<(), Error> {
    let turn = f64::EPSILON * rate * t.abs().max(elapsed.abs());
    if turn <= PHASE {
        return Ok(());
    }
    let reason =
        format!("the time is too long: its rounding alone turns the body by {turn:.1e} radians");
    Err(Error::Integration { t, reason })
}

/// Steps of a method for free bodies.
fn free(
    integrator: impl Integrator<EulerPoincare<So3, Free>> + Send + 'static,
    system: &Body<So3>,
    step: f64,
) -> Option<Result<Drive<Body<So3>>, Error>> {
    let integrator = Unforced { system: system.clone_with(Free), integrator };
    Some(Ok(Drive::fixed(integrator, step)))
}

/// A method for the system without forces, as one for a system whose forces are empty.
struct Unforced<I> {
    system: EulerPoincare<So3, Free>,
    integrator: I,
}

impl<I> Integrator<Body<So3>> for Unforced<I>
where
    I: Integrator<EulerPoincare<So3, Free>>,
{
    fn step(&self, _: &Body<So3>, state: &mut State<So3>, h: f64) -> Result<(), Error> {
        self.integrator.step(&self.system, state, h)
    }
}
