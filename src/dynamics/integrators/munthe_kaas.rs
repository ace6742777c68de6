//! Runge-Kutta methods in canonical coordinates around the present element.

use super::{Integrator, expect_finite};
use crate::Error;
use crate::dynamics::cotangent::{CotangentSystem, Rates, State, Vector};
use crate::group::{Coordinates, LieGroup};

/// Runge-Kutta-Munthe-Kaas: with `g = g_0 exp(u)`, the method solves `u' = T_left(u)^-1 Omega` and
/// `h'` together, from `u = 0`.
///
/// H. Munthe-Kaas, *BIT* 38 (1998) 92-111. The inverse tangent operator is the group's own and not a
/// truncated series, so the order is that of the tableau: [`RK4`](MuntheKaas::RK4), and the pairs
/// [`DORMAND_PRINCE`](MuntheKaas::DORMAND_PRINCE) and [`DORMAND_PRINCE_8`](MuntheKaas::DORMAND_PRINCE_8).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MuntheKaas<const STAGES: usize> {
    pub(super) order: u32,
    /// Stages that a step needs; its error has all.
    pub(super) needed: usize,
    /// Rows of the tableau, below the diagonal.
    pub(super) a: [[f64; STAGES]; STAGES],
    pub(super) b: [f64; STAGES],
    /// Differences of `b` and the weights of embedded methods, the higher order first.
    pub(super) errors: [[f64; STAGES]; 2],
    pub(super) c: [f64; STAGES],
}

impl<const STAGES: usize> MuntheKaas<STAGES> {
    /// The order of the error of a motion.
    pub fn order(&self) -> u32 {
        self.order
    }

    /// `a_ij`, the rows of the tableau.
    pub fn rows(&self) -> &[[f64; STAGES]; STAGES] {
        &self.a
    }

    /// `b_j`, the weights of the step.
    pub fn weights(&self) -> &[f64; STAGES] {
        &self.b
    }

    /// `c_i`, the times of the stages in the step.
    pub fn nodes(&self) -> &[f64; STAGES] {
        &self.c
    }

    /// The differences of `b_j` and the weights of two embedded methods, 0 for none.
    pub fn errors(&self) -> &[[f64; STAGES]; 2] {
        &self.errors
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
    ) -> Result<(State<S::Group>, f64), Error> {
        let [slopes, of_spatial] = self.slopes(system, state, h, STAGES)?;
        let next = self.end(system, state, h, &slopes, &of_spatial)?;
        let zero = Vector::<S>::zeros(system.group().dimension());
        let scale = state.spatial.largest().max(f64::MIN_POSITIVE);
        let [a, b] = [0, 1].map(|which| {
            let off = |slopes| moved(&zero, slopes, &self.errors[which], h).largest();
            off(&slopes).max(off(&of_spatial) / scale)
        });
        Ok((next, if a > 0.0 { a * (a / a.hypot(0.1 * b)) } else { a }))
    }

    /// `u'` at the first stages, and `h'`.
    #[inline]
    fn slopes<S: CotangentSystem>(
        &self,
        system: &S,
        state: &State<S::Group>,
        h: f64,
        stages: usize,
    ) -> Result<[[Vector<S>; STAGES]; 2], Error> {
        let group = system.group();
        let zero = Vector::<S>::zeros(group.dimension());
        let mut slopes: [Vector<S>; STAGES] = std::array::from_fn(|_| zero.clone());
        let mut of_spatial: [Vector<S>; STAGES] = std::array::from_fn(|_| zero.clone());
        // u = 0
        Rates { velocity: slopes[0], spatial: of_spatial[0] } = system.rates(state);
        for stage in 1..stages {
            // or the next stage asks for a torque at no place
            expect_finite(state.time, &[&slopes[stage - 1], &of_spatial[stage - 1]])?;
            let u = moved(&zero, &slopes[..stage], &self.a[stage], h);
            let rates = system.rates(&State {
                time: state.time + self.c[stage] * h,
                element: group.compose(&state.element, &group.exp(&u)),
                spatial: moved(&state.spatial, &of_spatial[..stage], &self.a[stage], h),
            });
            slopes[stage] = group.tangent_left_inverse(&u, &rates.velocity)?;
            of_spatial[stage] = rates.spatial;
        }
        Ok([slopes, of_spatial])
    }

    /// The state after a step, from its slopes.
    #[inline]
    fn end<S: CotangentSystem>(
        &self,
        system: &S,
        state: &State<S::Group>,
        h: f64,
        slopes: &[Vector<S>; STAGES],
        of_spatial: &[Vector<S>; STAGES],
    ) -> Result<State<S::Group>, Error> {
        let group = system.group();
        let u = moved(&Vector::<S>::zeros(group.dimension()), slopes, &self.b, h);
        let spatial = moved(&state.spatial, of_spatial, &self.b, h);
        expect_finite(state.time, &[&u, &spatial])?;
        let element = group.restored(group.compose(&state.element, &group.exp(&u)));
        Ok(State { time: state.time + h, element, spatial })
    }
}

/// `h` times the weighted slopes, from a start.
#[inline]
fn moved<V: Coordinates>(start: &V, slopes: &[V], weights: &[f64], h: f64) -> V {
    let weighted = slopes.iter().zip(weights).filter(|(_, weight)| **weight != 0.0);
    weighted.fold(start.clone(), |sum, (slope, weight)| sum + slope.clone() * (h * weight))
}

impl<const STAGES: usize, S: CotangentSystem> Integrator<S> for MuntheKaas<STAGES> {
    #[inline]
    fn step(&self, system: &S, state: &mut State<S::Group>, h: f64) -> Result<(), Error> {
        let [slopes, of_spatial] = self.slopes(system, state, h, self.needed)?;
        *state = self.end(system, state, h, &slopes, &of_spatial)?;
        Ok(())
    }
}
