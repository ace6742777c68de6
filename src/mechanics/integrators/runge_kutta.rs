//! Runge-Kutta methods in local coordinates of a group.

use super::step_start::{StepStart, parts};
use super::tolerance::Allowed;
use super::{Integrator, expect_finite};
use crate::Error;
use crate::group::{Coordinates, LieGroup, TranslationSplit};
use crate::mechanics::stopped;
use crate::mechanics::systems::cotangent::{CotangentSystem, Element, State, Vector};
use crate::numerics::tableaux::{
    Classical, DormandPrince, DormandPrince8, Tableau, Tabulated, combined_error,
};
use std::marker::PhantomData;

/// Local coordinates `y` of a group around a base point. A step is computed in these coordinates.
pub trait LocalCoordinates<G: LieGroup> {
    /// The type of `y`.
    type Numbers: Coordinates;

    /// The type of a point: the element with coordinates `y`, and data of a stage that are computed
    /// once from `y`, such as an exponential.
    type Point;

    /// Whether a point contains its element. In this case, applying `Ad*` of the displacement in a
    /// step is faster than integrating the momentum of a free system.
    const HAS_ELEMENT: bool = false;

    /// Whether these coordinates exist on the group.
    fn exist(group: &G) -> bool {
        let _ = group;
        true
    }

    /// The coordinates of the base point `at`.
    fn origin(group: &G, at: &G::Element) -> Self::Numbers;

    /// The point with coordinates `y` around the base point `at`.
    fn point(group: &G, at: &G::Element, y: &Self::Numbers) -> Self::Point;

    /// The element of a point.
    fn element(group: &G, at: &G::Element, point: &Self::Point) -> G::Element;

    /// The element at the end of a step. It is on the group up to rounding errors, without drift.
    fn end(group: &G, at: &G::Element, y: &Self::Numbers) -> G::Element;

    /// The momentum `Ad*_k p`, where `k` is the rotation from the base point to a point
    /// ([`linear_part`](crate::group::TranslationSplit::linear_part)).
    fn carried(group: &G, point: &Self::Point, momentum: &G::Vector) -> G::Vector;

    /// The covector `Ad*_(k^-1) F`, which is the inverse of [`carried`](Self::carried).
    fn carried_back(group: &G, point: &Self::Point, force: &G::Vector) -> G::Vector;

    /// The largest coordinate of rotations, and the largest coordinate of translations.
    fn sizes(group: &G, y: &Self::Numbers) -> [f64; 2];

    /// The time derivative `y'` for `g' = g velocity` at the base point.
    fn first_rate(group: &G, at: &G::Element, velocity: &G::Vector) -> Self::Numbers;

    /// The time derivative `y'` for `g' = g velocity` at a point. Its accuracy suffices for a
    /// method of order `order`.
    ///
    /// # Errors
    /// [`Law::RegularTangent`](crate::Law::RegularTangent) where the coordinates are singular.
    fn rate(
        group: &G,
        point: &Self::Point,
        velocity: &G::Vector,
        order: u32,
    ) -> Result<Self::Numbers, Error>;
}

/// Checks that a group has the coordinates of a method.
///
/// # Errors
/// [`Error::Integration`] if the coordinates do not exist on the group.
#[inline(always)]
pub(super) fn expect_coordinates<G: LieGroup, C: LocalCoordinates<G>>(
    group: &G,
    time: f64,
) -> Result<(), Error> {
    if C::exist(group) {
        return Ok(());
    }
    Err(stopped(
        time,
        "the method needs a projection of points onto the group, but this group has no projection",
    ))
}

/// The Runge-Kutta method with the tableau `T` for `y'` and `p'`, where `y` are the coordinates
/// `C`, and `p` is the momentum. See [`MuntheKaas`](super::MuntheKaas) and
/// [`Projected`](super::Projected).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct RungeKutta<const STAGES: usize, T, C>(PhantomData<(T, C)>);

impl<C> RungeKutta<4, Classical, C> {
    /// The classical method of order 4.
    pub const RK4: Self = RungeKutta::new();
}

impl<C> RungeKutta<7, DormandPrince, C> {
    /// The pair of orders 5 and 4 of Dormand and Prince.
    pub const DORMAND_PRINCE: Self = RungeKutta::new();
}

impl<C> RungeKutta<12, DormandPrince8, C> {
    /// The method of order 8 of Dormand and Prince.
    pub const DORMAND_PRINCE_8: Self = RungeKutta::new();
}

impl<const STAGES: usize, T, C> RungeKutta<STAGES, T, C> {
    /// The method of the tableau `T`.
    pub const fn new() -> Self {
        RungeKutta(PhantomData)
    }
}

impl<const STAGES: usize, T: Tabulated<STAGES>, C> RungeKutta<STAGES, T, C> {
    /// The order of convergence.
    pub fn order(&self) -> u32 {
        T::TABLEAU.order
    }

    /// Computes the state after a step, and its estimated error in units of the tolerance.
    ///
    /// # Errors
    /// [`Error::Integration`], [`Law::RegularTangent`](crate::Law::RegularTangent).
    pub(super) fn advanced<S: CotangentSystem>(
        &self,
        system: &S,
        state: &State<S::Group>,
        h: f64,
        allowed: &Allowed,
    ) -> Result<(State<S::Group>, f64), Error>
    where
        C: LocalCoordinates<S::Group>,
    {
        let group = system.group();
        let mut stages = Stages::<_, C, STAGES>::begin(system, state, h);
        stages.make::<T>(STAGES)?;
        let (y, momentum) = stages.moved(&T::TABLEAU.b)?;
        let next = stages.end(&y, momentum.as_ref())?;
        let sizes = |y: &C::Numbers| C::sizes(group, y);
        let [first, last] = [0, STAGES - 1].map(|stage| sizes(&stages.slopes[stage]));
        let lengths = [0, 1].map(|part| first[part].max(last[part]) * h.abs());
        // the scale is the larger momentum of start and end, because the momentum at the start may
        // be zero
        let momenta = momentum.as_ref().map(|momentum| {
            let [before, after] = [&stages.start.momentum, momentum].map(|p| parts(group, p));
            [0, 1].map(|part| before[part].max(after[part]))
        });
        let errors = T::TABLEAU.errors.map(|weights| {
            let coordinates =
                allowed.of_coordinates(sizes(&weighted(&stages.slopes, &weights, h)), lengths);
            let drifts = stages.drifts.as_ref().zip(momenta);
            let drift = drifts.map_or(0.0, |(drifts, momenta)| {
                allowed.of_momentum(parts(group, &weighted(drifts, &weights, h)), momenta)
            });
            coordinates.max(drift)
        });
        Ok((next, combined_error(errors)))
    }
}

impl<const STAGES: usize, T: Tabulated<STAGES>, S: CotangentSystem, C> Integrator<S>
    for RungeKutta<STAGES, T, C>
where
    C: LocalCoordinates<S::Group>,
{
    #[inline]
    fn step(&self, system: &S, state: &mut State<S::Group>, h: f64) -> Result<(), Error> {
        expect_coordinates::<_, C>(system.group(), state.time)?;
        let mut stages = Stages::<_, C, STAGES>::begin(system, state, h);
        stages.make::<T>(T::TABLEAU.needed)?;
        let (y, momentum) = stages.moved(&T::TABLEAU.b)?;
        *state = stages.end(&y, momentum.as_ref())?;
        Ok(())
    }
}

/// The stages of a step.
struct Stages<'s, S: CotangentSystem, C: LocalCoordinates<S::Group>, const STAGES: usize> {
    start: StepStart<'s, S>,
    /// The identity, which is the base point if the step is computed for the displacement
    /// `g_0^-1 g`. The momentum `H = Ad*_(g_0^-1 g) H_0` of a free system then needs no equations.
    identity: Option<Element<S>>,
    h: f64,
    origin: C::Numbers,
    /// The slopes `y'` of the stages.
    slopes: [C::Numbers; STAGES],
    /// The slopes `p'` of the stages, unless they are zero.
    drifts: Option<[Vector<S>; STAGES]>,
}

impl<'s, S: CotangentSystem, C: LocalCoordinates<S::Group>, const STAGES: usize>
    Stages<'s, S, C, STAGES>
{
    /// Begins a step: computes its first stage.
    #[inline]
    fn begin(system: &'s S, state: &'s State<S::Group>, h: f64) -> Self {
        let start = StepStart::new(system, state);
        let group = system.group();
        let is_displaced = C::HAS_ELEMENT && system.is_free() && system.transfers();
        let identity = is_displaced.then(|| group.identity());
        let at = identity.as_ref().unwrap_or(&start.element);
        let velocity = system.velocity_at_centre(&start.momentum);
        let drifts = (!is_displaced && !start.is_free()).then(|| {
            let drift = start.push(state.time, || at.clone(), &velocity, &start.momentum);
            std::array::from_fn(|_| drift.clone())
        });
        let slope = C::first_rate(group, at, &velocity);
        let slopes = std::array::from_fn(|_| slope.clone());
        let origin = C::origin(group, at);
        Stages { start, identity, h, origin, slopes, drifts }
    }

    /// Computes the stages up to the number `count`.
    #[inline]
    fn make<T: Tabulated<STAGES>>(&mut self, count: usize) -> Result<(), Error> {
        if STAGES == 4 {
            // unrolls the loop, so that a few slopes remain in registers
            self.advance::<T>(1)?;
            self.advance::<T>(2)?;
            self.advance::<T>(3)
        } else {
            (1..count).try_for_each(|stage| self.advance::<T>(stage))
        }
    }

    #[inline(always)]
    fn advance<T: Tabulated<STAGES>>(&mut self, stage: usize) -> Result<(), Error> {
        let Tableau { a, c, order, .. } = const { &T::TABLEAU };
        let StepStart { system, state, element, momentum: start } = &self.start;
        let (group, at, h) = (system.group(), &**element, self.h);
        let y = || moved(&self.origin, &self.slopes[..stage], &a[stage], h);
        if let Some(identity) = &self.identity
            && C::HAS_ELEMENT
            && group.has_translations()
        {
            let point = C::point(group, identity, &y());
            let momentum = group.coadjoint(&C::element(group, identity, &point), start);
            let velocity = system.velocity_at_centre(&momentum);
            self.slopes[stage] = C::rate(group, &point, &velocity, *order)?;
            return Ok(());
        }
        // checks the slopes, because forces must be evaluated only at finite elements
        expect_finite(state.time, &self.slopes[stage - 1])?;
        let point = C::point(group, at, &y());
        let velocity = match &mut self.drifts {
            None => system.velocity_at_centre(&C::carried(group, &point, start)),
            Some(drifts) => {
                expect_finite(state.time, &drifts[stage - 1])?;
                let momentum = moved(start, &drifts[..stage], &a[stage], h);
                let momentum = C::carried(group, &point, &momentum);
                let velocity = system.velocity_at_centre(&momentum);
                let (time, element) = (state.time + c[stage] * h, || C::element(group, at, &point));
                let push = self.start.push(time, element, &velocity, &momentum);
                drifts[stage] = C::carried_back(group, &point, &push);
                velocity
            }
        };
        self.slopes[stage] = C::rate(group, &point, &velocity, *order)?;
        Ok(())
    }

    /// The coordinates after the step, and the momentum if it is not constant.
    #[inline]
    fn moved(&self, weights: &[f64; STAGES]) -> Result<(C::Numbers, Option<Vector<S>>), Error> {
        let StepStart { state, momentum, .. } = &self.start;
        let y = moved(&self.origin, &self.slopes, weights, self.h);
        expect_finite(state.time, &y)?;
        let drifts = self.drifts.as_ref();
        Ok((y, drifts.map(|drifts| moved(momentum, drifts, weights, self.h))))
    }

    /// The state after the step.
    #[inline]
    fn end(&self, y: &C::Numbers, momentum: Option<&Vector<S>>) -> Result<State<S::Group>, Error> {
        let StepStart { system, element: from, momentum: start, .. } = &self.start;
        let group = system.group();
        let displacement = self.identity.as_ref().map(|identity| {
            let point = C::point(group, identity, y);
            C::element(group, identity, &point)
        });
        let element = match &displacement {
            Some(by) => group.project(group.compose(from, by)),
            None => C::end(group, from, y),
        };
        let in_body = || match &displacement {
            Some(by) => group.coadjoint(by, start),
            None => C::carried(group, &C::point(group, from, y), momentum.unwrap_or(start)),
        };
        self.start.end(self.h, element, momentum, in_body)
    }
}

/// The sum of the start and `h` times the weighted sum of the slopes.
#[inline]
fn moved<V: Coordinates>(start: &V, slopes: &[V], weights: &[f64], h: f64) -> V {
    let weighted = slopes.iter().zip(weights).filter(|(_, weight)| **weight != 0.0);
    weighted.fold(start.clone(), |sum, (slope, weight)| sum + slope.clone() * (h * weight))
}

/// The weighted sum of the slopes, times `h`.
fn weighted<V: Coordinates>(slopes: &[V], weights: &[f64], h: f64) -> V {
    moved(&(slopes[0].clone() * 0.0), slopes, weights, h)
}
