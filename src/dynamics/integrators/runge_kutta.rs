//! Runge-Kutta methods in coordinates around the present element.

use super::departure::Departure;
use super::tableaux::{Classical, DormandPrince, DormandPrince8, Tableau, Tabulated};
use super::tolerance::Allowed;
use super::{Integrator, expect_finite};
use crate::Error;
use crate::dynamics::cotangent::{CotangentSystem, State, Vector};
use crate::group::{Coordinates, LieGroup};
use std::marker::PhantomData;

/// Coordinates `y` of the elements near a given one, in which a step is made.
pub trait LocalCoordinates<G: LieGroup> {
    /// What `y` is.
    type Numbers: Coordinates;

    /// Those of the given element.
    fn origin(group: &G, at: &G::Element) -> Self::Numbers;

    /// The element of coordinates.
    fn element(group: &G, at: &G::Element, y: &Self::Numbers) -> G::Element;

    /// The element at the end of a step, on the group to rounding however many steps there were.
    fn end(group: &G, at: &G::Element, y: &Self::Numbers) -> G::Element;

    /// `Ad*_k p` for the [`turn`](LieGroup::turn) `k` from the given element to that of coordinates.
    fn carried(group: &G, at: &G::Element, y: &Self::Numbers, momentum: &G::Vector) -> G::Vector;

    /// `Ad*_(k^-1) F`, the reverse.
    fn carried_back(group: &G, at: &G::Element, y: &Self::Numbers, force: &G::Vector) -> G::Vector;

    /// The largest of the numbers that turn, and of those that are translations.
    fn sizes(group: &G, y: &Self::Numbers) -> [f64; 2];

    /// `y'` for `g' = g velocity` at the origin.
    fn first_rate(group: &G, at: &G::Element, velocity: &G::Vector) -> Self::Numbers;

    /// `y'` for `g' = g velocity`, to the accuracy that a method of an order asks for.
    ///
    /// # Errors
    /// [`Error::SingularTangent`] at the end of their reach.
    fn rate(
        group: &G,
        at: &G::Element,
        y: &Self::Numbers,
        velocity: &G::Vector,
        order: u32,
    ) -> Result<Self::Numbers, Error>;
}

/// The Runge-Kutta method `T` for `y'` and `p'`, with `y` the coordinates `C` and `p` the momentum:
/// [`MuntheKaas`](super::MuntheKaas) or [`Projected`](super::Projected).
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
    /// The method, of any tableau.
    pub const fn new() -> Self {
        RungeKutta(PhantomData)
    }
}

impl<const STAGES: usize, T: Tabulated<STAGES>, C> RungeKutta<STAGES, T, C> {
    /// The order of the error of a motion.
    pub fn order(&self) -> u32 {
        T::TABLEAU.order
    }

    /// The state after a step, and its estimated error in units of what the tolerance `allows`.
    ///
    /// With two estimates it is `a^2/sqrt(a^2 + b^2/100)`: of order 7 where they are of order 5 and 3.
    ///
    /// # Errors
    /// [`Error::Integration`], [`Error::SingularTangent`].
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
        // a motion that starts from rest has its momentum at the end
        let momenta = momentum.as_ref().map(|momentum| {
            let [before, after] = [&stages.start.momentum, momentum].map(|p| parts(group, p));
            [0, 1].map(|part| before[part].max(after[part]))
        });
        let [a, b] = T::TABLEAU.errors.map(|weights| {
            let coordinates =
                allowed.of_coordinates(sizes(&weighted(&stages.slopes, &weights, h)), lengths);
            let drifts = stages.drifts.as_ref().zip(momenta);
            let drift = drifts.map_or(0.0, |(drifts, momenta)| {
                allowed.of_momentum(parts(group, &weighted(drifts, &weights, h)), momenta)
            });
            coordinates.max(drift)
        });
        Ok((next, if a > 0.0 { a * (a / a.hypot(0.1 * b)) } else { a }))
    }
}

impl<const STAGES: usize, T: Tabulated<STAGES>, S: CotangentSystem, C> Integrator<S>
    for RungeKutta<STAGES, T, C>
where
    C: LocalCoordinates<S::Group>,
{
    #[inline]
    fn step(&self, system: &S, state: &mut State<S::Group>, h: f64) -> Result<(), Error> {
        let mut stages = Stages::<_, C, STAGES>::begin(system, state, h);
        stages.make::<T>(T::TABLEAU.needed)?;
        let (y, momentum) = stages.moved(&T::TABLEAU.b)?;
        *state = stages.end(&y, momentum.as_ref())?;
        Ok(())
    }
}

/// The stages of a step.
struct Stages<'s, S: CotangentSystem, C: LocalCoordinates<S::Group>, const STAGES: usize> {
    start: Departure<'s, S>,
    h: f64,
    origin: C::Numbers,
    /// `y'`.
    slopes: [C::Numbers; STAGES],
    /// `p'`, unless it is zero.
    drifts: Option<[Vector<S>; STAGES]>,
}

impl<'s, S: CotangentSystem, C: LocalCoordinates<S::Group>, const STAGES: usize>
    Stages<'s, S, C, STAGES>
{
    /// With the first stage made.
    #[inline]
    fn begin(system: &'s S, state: &'s State<S::Group>, h: f64) -> Self {
        let start = Departure::new(system, state);
        let (group, at) = (system.group(), &*start.element);
        let velocity = system.velocity_at_centre(&start.momentum);
        let drifts = (!start.is_free()).then(|| {
            let drift = start.push(state.time, at, &velocity, &start.momentum);
            std::array::from_fn(|_| drift.clone())
        });
        let slope = C::first_rate(group, at, &velocity);
        let slopes = std::array::from_fn(|_| slope.clone());
        let origin = C::origin(group, at);
        Stages { start, h, origin, slopes, drifts }
    }

    /// All up to a number of them.
    #[inline]
    fn make<T: Tabulated<STAGES>>(&mut self, count: usize) -> Result<(), Error> {
        if STAGES == 4 {
            // few slopes stay in registers
            self.advance::<T>(1)?;
            self.advance::<T>(2)?;
            self.advance::<T>(3)
        } else {
            (1..count).try_for_each(|stage| self.advance::<T>(stage))
        }
    }

    #[inline(always)]
    fn advance<T: Tabulated<STAGES>>(&mut self, stage: usize) -> Result<(), Error> {
        let Tableau { a, c, order, .. } = T::TABLEAU;
        let Departure { system, state, element, momentum: start } = &self.start;
        let (group, at, h) = (system.group(), &**element, self.h);
        // or the next stage asks for a torque at no place
        expect_finite(state.time, &self.slopes[stage - 1])?;
        let y = moved(&self.origin, &self.slopes[..stage], &a[stage], h);
        let velocity = match &mut self.drifts {
            None => system.velocity_at_centre(&C::carried(group, at, &y, start)),
            Some(drifts) => {
                expect_finite(state.time, &drifts[stage - 1])?;
                let momentum = moved(start, &drifts[..stage], &a[stage], h);
                let momentum = C::carried(group, at, &y, &momentum);
                let velocity = system.velocity_at_centre(&momentum);
                let element = C::element(group, at, &y);
                let time = state.time + c[stage] * h;
                let push = self.start.push(time, &element, &velocity, &momentum);
                drifts[stage] = C::carried_back(group, at, &y, &push);
                velocity
            }
        };
        self.slopes[stage] = C::rate(group, at, &y, &velocity, order)?;
        Ok(())
    }

    /// The coordinates after the step, and the momentum, unless it stays.
    #[inline]
    fn moved(&self, weights: &[f64; STAGES]) -> Result<(C::Numbers, Option<Vector<S>>), Error> {
        let Departure { state, momentum, .. } = &self.start;
        let y = moved(&self.origin, &self.slopes, weights, self.h);
        expect_finite(state.time, &y)?;
        let drifts = self.drifts.as_ref();
        Ok((y, drifts.map(|drifts| moved(momentum, drifts, weights, self.h))))
    }

    /// The state after the step.
    #[inline]
    fn end(&self, y: &C::Numbers, momentum: Option<&Vector<S>>) -> Result<State<S::Group>, Error> {
        let Departure { system, element, momentum: start, .. } = &self.start;
        let (group, at) = (system.group(), &**element);
        let in_body = || C::carried(group, at, y, momentum.unwrap_or(start));
        self.start.end(self.h, C::end(group, at, y), momentum, in_body)
    }
}

/// `h` times the weighted slopes, from a start.
#[inline]
fn moved<V: Coordinates>(start: &V, slopes: &[V], weights: &[f64], h: f64) -> V {
    let weighted = slopes.iter().zip(weights).filter(|(_, weight)| **weight != 0.0);
    weighted.fold(start.clone(), |sum, (slope, weight)| sum + slope.clone() * (h * weight))
}

/// `h` times the weighted slopes.
fn weighted<V: Coordinates>(slopes: &[V], weights: &[f64], h: f64) -> V {
    moved(&(slopes[0].clone() * 0.0), slopes, weights, h)
}

/// The largest component of a covector along turns, and along translations.
fn parts<G: LieGroup>(group: &G, momentum: &G::Vector) -> [f64; 2] {
    let zero = G::Vector::zeros(group.dimension());
    if group.translation(&zero).is_none() {
        return [momentum.largest(), 0.0];
    }
    let along = G::Vector::from_fn(group.dimension(), |i| {
        let translation = group.translation(&group.unit(i)).unwrap_or_else(|| zero.clone());
        let products = momentum.components().iter().zip(translation.components());
        products.map(|(p, x)| p * x).sum()
    });
    [(momentum.clone() - along.clone()).largest(), along.largest()]
}
