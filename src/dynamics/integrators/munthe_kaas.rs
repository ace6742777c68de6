//! Runge-Kutta methods in canonical coordinates.

use super::runge_kutta::{LocalCoordinates, RungeKutta};
use super::tableaux::{Classical, DormandPrince, DormandPrince8};
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

impl MuntheKaas<4, Classical> {
    /// The classical method of order 4.
    pub const RK4: Self = RungeKutta::new(Classical, Canonical);
}

impl MuntheKaas<7, DormandPrince> {
    /// The pair of orders 5 and 4 of Dormand and Prince.
    pub const DORMAND_PRINCE: Self = RungeKutta::new(DormandPrince, Canonical);
}

impl MuntheKaas<12, DormandPrince8> {
    /// The method of order 8 of Dormand and Prince.
    pub const DORMAND_PRINCE_8: Self = RungeKutta::new(DormandPrince8, Canonical);
}

impl<G: LieGroup> LocalCoordinates<G> for Canonical {
    type Numbers = G::Vector;

    #[inline(always)]
    fn origin(&self, group: &G, _: &G::Element) -> G::Vector {
        G::Vector::zeros(group.dimension())
    }

    #[inline(always)]
    fn element(&self, group: &G, at: &G::Element, u: &G::Vector) -> G::Element {
        group.compose(at, &group.exp(u))
    }

    /// It is the start that is restored: a processor does so while the stages are made.
    #[inline(always)]
    fn end(&self, group: &G, at: &G::Element, u: &G::Vector) -> G::Element {
        group.compose(&group.restored(at.clone()), &group.exp(u))
    }

    #[inline(always)]
    fn momentum(&self, group: &G, _: &State<G>, momentum: &G::Vector, u: &G::Vector) -> G::Vector {
        group.coadjoint_exp(u, momentum)
    }

    #[inline(always)]
    fn first_rate(&self, _: &G, _: &G::Element, velocity: &G::Vector) -> G::Vector {
        velocity.clone()
    }

    #[inline(always)]
    fn rate(
        &self,
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
