//! Runge-Kutta methods in canonical coordinates.

use super::runge_kutta::{LocalCoordinates, RungeKutta};
use crate::Error;
use crate::group::{Coordinates, TranslationSplit};

/// The Runge-Kutta-Munthe-Kaas method. With `g = g_0 exp(u)`, the method solves
/// `u' = T_left(u)^-1 Omega` together with the equation of the momentum, starting from `u = 0`.
/// [Translations](TranslationSplit::translational_part) `y` are additive coordinates:
/// `g = g_0 exp(y) exp(u)`, `y' = Ad_exp(u) P Omega`.
///
/// H. Munthe-Kaas, *BIT* 38 (1998) 92-111. Up to order 4, two brackets approximate the inverse
/// tangent operator, as in this article. For higher orders, the operator of the group is used. The
/// order of the method is the order of the tableau.
pub type MuntheKaas<const STAGES: usize, T> = RungeKutta<STAGES, T, ExponentialCoordinates>;

/// Canonical coordinates around `g_0`: `g = g_0 exp(u)`. If the group has translations `y`,
/// `g = g_0 exp(y) exp(u)`, and the translations are added like vectors.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct ExponentialCoordinates;

/// Splits a vector into its rotational part and its translational part.
#[inline(always)]
fn split<G: TranslationSplit>(group: &G, x: &G::Vector) -> (G::Vector, Option<G::Vector>) {
    match group.translational_part(x) {
        Some(translation) => (x.clone() - translation.clone(), Some(translation)),
        None => (x.clone(), None),
    }
}

/// Data of a stage, computed once from the canonical coordinates of the stage.
#[derive(Clone, Copy, Debug)]
pub struct CanonicalPoint<V, E> {
    /// The canonical coordinate `u`.
    u: V,
    /// The translation `y` and the element `exp(u)`, if the group has translations.
    translated: Option<(V, E)>,
}

impl<G: TranslationSplit> LocalCoordinates<G> for ExponentialCoordinates {
    type Numbers = G::Vector;
    type Point = CanonicalPoint<G::Vector, G::Element>;

    #[inline(always)]
    fn origin(group: &G, _: &G::Element) -> G::Vector {
        G::Vector::zeros(group.dimension())
    }

    #[inline(always)]
    fn point(group: &G, _: &G::Element, x: &G::Vector) -> Self::Point {
        let (u, y) = split(group, x);
        let translated = y.map(|y| (y, group.exp(&u)));
        CanonicalPoint { u, translated }
    }

    #[inline(always)]
    fn element(group: &G, at: &G::Element, point: &Self::Point) -> G::Element {
        match &point.translated {
            Some((y, turn)) => group.compose(&group.compose(at, &group.exp(y)), turn),
            None => group.compose(at, &group.exp(&point.u)),
        }
    }

    /// Computes the end of a step. The start is projected onto the group; a processor can compute
    /// this projection in parallel with the stages.
    #[inline(always)]
    fn end(group: &G, at: &G::Element, x: &G::Vector) -> G::Element {
        let start = group.project(at.clone());
        Self::element(group, &start, &Self::point(group, at, x))
    }

    #[inline(always)]
    fn carried(group: &G, point: &Self::Point, momentum: &G::Vector) -> G::Vector {
        match &point.translated {
            Some((_, turn)) => group.coadjoint(turn, momentum),
            None => group.coadjoint_exp(&point.u, momentum),
        }
    }

    #[inline(always)]
    fn carried_back(group: &G, point: &Self::Point, force: &G::Vector) -> G::Vector {
        match &point.translated {
            Some((_, turn)) => group.coadjoint_inverse(turn, force),
            None => group.coadjoint_exp(&-point.u.clone(), force),
        }
    }

    fn sizes(group: &G, x: &G::Vector) -> [f64; 2] {
        let (u, y) = split(group, x);
        [u.largest(), y.map_or(0.0, |y| y.largest())]
    }

    #[inline(always)]
    fn first_rate(_: &G, _: &G::Element, velocity: &G::Vector) -> G::Vector {
        velocity.clone()
    }

    #[inline(always)]
    fn rate(
        group: &G,
        point: &Self::Point,
        velocity: &G::Vector,
        order: u32,
    ) -> Result<G::Vector, Error> {
        let u = &point.u;
        let (velocity, translation) = split(group, velocity);
        let turning = if order > 4 {
            group.tangent_left_inverse(u, &velocity)?
        } else {
            // two brackets suffice, because the cubic term of the series in ad_u is zero, and u is
            // of the size of a step
            let once = group.bracket(u, &velocity);
            let twice = group.bracket(u, &once);
            velocity + once * 0.5 + twice * (1.0 / 12.0)
        };
        Ok(match (translation, &point.translated) {
            (Some(translation), Some((_, turn))) => turning + group.adjoint(turn, &translation),
            _ => turning,
        })
    }
}
