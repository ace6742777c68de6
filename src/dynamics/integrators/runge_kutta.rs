//! Runge-Kutta methods in coordinates around the present element.

use super::tableaux::{Classical, DormandPrince, DormandPrince8, Tableau, Tabulated};
use super::{Integrator, expect_finite};
use crate::Error;
use crate::dynamics::cotangent::{CotangentSystem, State, Vector};
use crate::group::{Coordinates, LieGroup};
use std::marker::PhantomData;

/// The error of a step that is longer than this in its coordinates is relative to it.
const LONG: f64 = 10.0;

/// Coordinates `y` of the elements near a given one, in which a step is made.
pub trait LocalCoordinates<G: LieGroup> {
    /// What `y` is.
    type Numbers: Coordinates;

    /// Those of the given element.
    fn origin(group: &G, at: &G::Element) -> Self::Numbers;

    /// The element of coordinates, perhaps as far off the group as a stage is off the motion.
    fn element(group: &G, at: &G::Element, y: &Self::Numbers) -> G::Element;

    /// The element at the end of a step, on the group to rounding however many steps there were.
    fn end(group: &G, at: &G::Element, y: &Self::Numbers) -> G::Element;

    /// `H = Ad*_g h` at the element `g` of coordinates, from the state around which they are and its own `H`.
    fn momentum(group: &G, state: &State<G>, momentum: &G::Vector, y: &Self::Numbers) -> G::Vector;

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

/// The Runge-Kutta method `T` for `y'` and `h'`, with `y` the coordinates `C`:
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

    /// The state after a step, and the size of its estimated error.
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
    ) -> Result<(State<S::Group>, f64), Error>
    where
        C: LocalCoordinates<S::Group>,
    {
        let mut stages = Stages::<_, C, STAGES>::begin(system, state, h);
        stages.make::<T>(STAGES)?;
        let next = stages.end(&T::TABLEAU.b)?;
        // a motion that starts from rest has its momentum at the end
        let largest = state.spatial.largest().max(next.spatial.largest());
        let scale = largest.max(f64::MIN_POSITIVE);
        // or a step that is long in the group would have to be exact beyond its rounding
        let fastest = stages.slopes[0].largest().max(stages.slopes[STAGES - 1].largest());
        let unit = (fastest * h.abs() / LONG).max(1.0);
        let [a, b] = T::TABLEAU.errors.map(|weights| {
            let drift = stages.drifts.as_ref().map_or(0.0, |drifts| size(drifts, &weights, h));
            (size(&stages.slopes, &weights, h) / unit).max(drift / scale)
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
        *state = stages.end(&T::TABLEAU.b)?;
        Ok(())
    }
}

/// The stages of a step.
struct Stages<'s, S: CotangentSystem, C: LocalCoordinates<S::Group>, const STAGES: usize> {
    system: &'s S,
    state: &'s State<S::Group>,
    h: f64,
    /// `H` at the start.
    momentum: Vector<S>,
    origin: C::Numbers,
    /// `y'`.
    slopes: [C::Numbers; STAGES],
    /// `h'`, unless it is zero.
    drifts: Option<[Vector<S>; STAGES]>,
}

impl<'s, S: CotangentSystem, C: LocalCoordinates<S::Group>, const STAGES: usize>
    Stages<'s, S, C, STAGES>
{
    /// With the first stage made.
    #[inline]
    fn begin(system: &'s S, state: &'s State<S::Group>, h: f64) -> Self {
        let (group, at) = (system.group(), &state.element);
        let momentum = state.momentum(group);
        let velocity = system.velocity_of(&momentum);
        let drifts = (!system.is_free()).then(|| {
            let force = system.force(state.time, at, &velocity, &momentum);
            let drift = group.coadjoint(&group.inverse(at), &force);
            std::array::from_fn(|_| drift.clone())
        });
        let slope = C::first_rate(group, at, &velocity);
        let slopes = std::array::from_fn(|_| slope.clone());
        let origin = C::origin(group, at);
        Stages { system, state, h, momentum, origin, slopes, drifts }
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
        let (group, state, h) = (self.system.group(), self.state, self.h);
        // or the next stage asks for a torque at no place
        expect_finite(state.time, &self.slopes[stage - 1])?;
        let y = moved(&self.origin, &self.slopes[..stage], &a[stage], h);
        let velocity = match &mut self.drifts {
            None => {
                let momentum = C::momentum(group, state, &self.momentum, &y);
                self.system.velocity_of(&momentum)
            }
            Some(drifts) => {
                expect_finite(state.time, &drifts[stage - 1])?;
                let rates = self.system.rates(&State {
                    time: state.time + c[stage] * h,
                    element: C::element(group, &state.element, &y),
                    spatial: moved(&state.spatial, &drifts[..stage], &a[stage], h),
                });
                drifts[stage] = rates.spatial;
                rates.velocity
            }
        };
        self.slopes[stage] = C::rate(group, &state.element, &y, &velocity, order)?;
        Ok(())
    }

    /// The state after the step.
    #[inline]
    fn end(&self, weights: &[f64; STAGES]) -> Result<State<S::Group>, Error> {
        let Stages { state, h, .. } = *self;
        let y = moved(&self.origin, &self.slopes, weights, h);
        expect_finite(state.time, &y)?;
        let spatial = match &self.drifts {
            None => state.spatial.clone(),
            Some(drifts) => moved(&state.spatial, drifts, weights, h),
        };
        expect_finite(state.time, &spatial)?;
        let element = C::end(self.system.group(), &state.element, &y);
        Ok(State { time: state.time + h, element, spatial })
    }
}

/// `h` times the weighted slopes, from a start.
#[inline]
fn moved<V: Coordinates>(start: &V, slopes: &[V], weights: &[f64], h: f64) -> V {
    let weighted = slopes.iter().zip(weights).filter(|(_, weight)| **weight != 0.0);
    weighted.fold(start.clone(), |sum, (slope, weight)| sum + slope.clone() * (h * weight))
}

/// The largest component of the weighted slopes times `h`.
fn size<V: Coordinates>(slopes: &[V], weights: &[f64], h: f64) -> f64 {
    moved(&(slopes[0].clone() * 0.0), slopes, weights, h).largest()
}
