//! Runge-Kutta methods in canonical coordinates.

use super::runge_kutta::{LocalCoordinates, RungeKutta};
use crate::Error;
use crate::dynamics::cotangent::State;
use crate::group::{Coordinates, LieGroup};

/// Runge-Kutta-Munthe-Kaas: with `g = g_0 exp(u)`, the method solves `u' = T_left(u)^-1 Omega` and
/// `h'` together, from `u = 0`.
///
/// H. Munthe-Kaas, *BIT* 38 (1998) 92-111. Up to order 4 two brackets stand for the inverse tangent operator, as there;
/// beyond it is the group's own. The order is that of the tableau.
pub type MuntheKaas<const STAGES: usize, T> = RungeKutta<STAGES, T, Canonical>;

/// Canonical coordinates `u` around `g_0`: `g = g_0 exp(u)`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Canonical;

impl<G: LieGroup> LocalCoordinates<G> for Canonical {
    type Numbers = G::Vector;

    #[inline(always)]
    fn origin(group: &G, _: &G::Element) -> G::Vector {
        G::Vector::zeros(group.dimension())
    }

    #[inline(always)]
    fn element(group: &G, at: &G::Element, u: &G::Vector) -> G::Element {
        group.compose(at, &group.exp(u))
    }

    /// It is the start that is restored: a processor does so while the stages are made.
    #[inline(always)]
    fn end(group: &G, at: &G::Element, u: &G::Vector) -> G::Element {
        group.compose(&group.restored(at.clone()), &group.exp(u))
    }

    #[inline(always)]
    fn momentum(group: &G, _: &State<G>, momentum: &G::Vector, u: &G::Vector) -> G::Vector {
        group.coadjoint_exp(u, momentum)
    }

    #[inline(always)]
    fn first_rate(_: &G, _: &G::Element, velocity: &G::Vector) -> G::Vector {
        velocity.clone()
    }

    #[inline(always)]
    fn rate(
        group: &G,
        _: &G::Element,
        u: &G::Vector,
        velocity: &G::Vector,
        order: u32,
    ) -> Result<G::Vector, Error> {
        if order > 4 {
            return group.tangent_left_inverse(u, velocity);
        }
        // of the series in ad_u the cubic term is zero, and u of the size of a step
        let once = group.bracket(u, velocity);
        let twice = group.bracket(u, &once);
        Ok(velocity.clone() + once * 0.5 + twice * (1.0 / 12.0))
    }
}
