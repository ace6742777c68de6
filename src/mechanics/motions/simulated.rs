//! Groups as configuration spaces of motions, with the methods of integration that they have.

use super::Method;
use super::drive::Drive;
use super::forces::Forces;
use super::snapshot::Saved;
use crate::Error;
use crate::group::{
    AnyGroup, Embedded, MatrixGroup, Nilpotent, Opposite, Se2, Se3, Sl2, So2, So3, Written,
};
use crate::mechanics::integrators::kick::FreeMotion;
use crate::mechanics::integrators::moser_veselov::Order;
use crate::mechanics::stopped;
use crate::mechanics::{
    Adaptive, BodyState, CotangentSystem, EulerPoincare, FreeBody, Inertia, Kick, MoserVeselov,
    Projected, SimoWong, Splitting, State,
};
use nalgebra::DMatrix;
use std::fmt::Debug;

/// An Euler-Poincare system with forces as formulas.
pub type Body<G> = EulerPoincare<G, Forces<G>>;

/// A group whose elements are the configurations of a motion.
pub trait SimulationGroup:
    Written<Element: Saved + Send + Sync, Vector: Saved + Send + Sync>
    + Clone
    + Debug
    + Send
    + Sync
    + 'static
{
    /// Whether its left-invariant frame is the right-invariant frame of the group it is the [`Opposite`] of.
    fn is_right(&self) -> bool {
        false
    }

    /// Whether an element that was read has the shape of an element of this group.
    fn has_shape(&self, g: &Self::Element) -> bool {
        self.write(g).shape() == self.write(&self.identity()).shape()
    }

    /// The drive of a projection method; `None` if the group has none, or for other methods.
    fn projected<S: CotangentSystem<Group = Self> + 'static>(
        &self,
        method: Method,
        step: f64,
        control: Adaptive,
    ) -> Option<Drive<S>> {
        match method {
            _ if !self.has_projection() => None,
            Method::Projected => Some(Drive::fixed(Projected::RK4, step)),
            Method::ProjectedAdaptive(pair) => {
                Some(Drive::controlled(pair, control, Adaptive::projected))
            }
            _ => None,
        }
    }

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

impl SimulationGroup for So2 {}
impl SimulationGroup for Se2 {}
impl SimulationGroup for Se3 {}
impl SimulationGroup for Sl2 {}
impl SimulationGroup for MatrixGroup {}
impl SimulationGroup for Nilpotent<f64> {}

impl SimulationGroup for AnyGroup {
    fn is_right(&self) -> bool {
        self.downcast_ref::<Opposite<AnyGroup>>().is_some()
    }

    fn has_shape(&self, g: &Self::Element) -> bool {
        g.len() == self.number_count()
    }
}

impl<G: SimulationGroup> SimulationGroup for Opposite<G> {
    fn is_right(&self) -> bool {
        true
    }

    fn has_shape(&self, g: &Self::Element) -> bool {
        self.0.has_shape(g)
    }

    fn projected<S: CotangentSystem<Group = Self> + 'static>(
        &self,
        _: Method,
        _: f64,
        _: Adaptive,
    ) -> Option<Drive<S>> {
        None
    }
}

impl SimulationGroup for So3 {
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
        Some(Ok(match method {
            Method::Exact => {
                let body = match FreeBody::new(inertia, &BodyState { attitude, momentum }) {
                    Ok(body) => body,
                    Err(error) => return Some(Err(error)),
                };
                let rate = body.rate();
                let at = move |t: f64| {
                    expect_phase(rate, t, t - time)?;
                    Ok(State { time: t, element: body.at(t - time).attitude, spatial })
                };
                Drive::Exact { at: Box::new(at), rate }
            }
            Method::MoserVeselov(order) => Drive::fixed(MoserVeselov::new(inertia, order), step),
            Method::Splitting(composition) => {
                Drive::fixed(Splitting::new(inertia, composition), step)
            }
            Method::SimoWong => Drive::fixed(SimoWong::new(inertia), step),
            Method::Kick(order) => {
                let motion = FreeMotion::MoserVeselov(Order::Ten);
                Drive::fixed(Kick::new(inertia, order, motion), step)
            }
            _ => return None,
        }))
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
    Err(stopped(
        t,
        format!("the time is too long: its rounding alone turns the body by {turn:.1e} radians"),
    ))
}
