//! Runge-Kutta methods in canonical coordinates around the present element.

use super::{Integrator, expect_finite};
use crate::Error;
use crate::dynamics::euler_poincare::{EulerPoincare, Rates, State, Torque};
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
    pub(super) fn advanced<G: LieGroup, M: Torque<G>>(
        &self,
        system: &EulerPoincare<G, M>,
        state: &State<G>,
        h: f64,
    ) -> Result<(State<G>, f64), Error> {
        let slopes = self.slopes(system, state, h, STAGES)?;
        let next = self.end(system, state, h, &slopes)?;
        let zero = G::Vector::zeros(system.group().dimension());
        let scale = state.spatial.largest().max(f64::MIN_POSITIVE);
        let [a, b] = [0, 1].map(|which| {
            let off = moved::<G>(&slopes, &self.errors[which], h, &zero);
            off.velocity.largest().max(off.spatial.largest() / scale)
        });
        Ok((next, if a > 0.0 { a * (a / a.hypot(0.1 * b)) } else { a }))
    }

    /// `u'` and `h'` at some stages.
    #[inline]
    fn slopes<G: LieGroup, M: Torque<G>>(
        &self,
        system: &EulerPoincare<G, M>,
        state: &State<G>,
        h: f64,
        stages: usize,
    ) -> Result<[Rates<G::Vector>; STAGES], Error> {
        let group = system.group();
        // u = 0
        let first = system.rates(state);
        let mut slopes: [Rates<G::Vector>; STAGES] = std::array::from_fn(|_| first.clone());
        for stage in 1..stages {
            let at = moved::<G>(&slopes[..stage], &self.a[stage], h, &state.spatial);
            let rates = system.rates(&State {
                time: state.time + self.c[stage] * h,
                element: group.compose(&state.element, &group.exp(&at.velocity)),
                spatial: at.spatial,
            });
            let velocity = match group.tangent_left_inverse(&at.velocity, &rates.velocity) {
                Ok(velocity) => velocity,
                Err(error) => {
                    return Err(expect_finite(state.time, &[&at.velocity]).err().unwrap_or(error));
                }
            };
            slopes[stage] = Rates { velocity, spatial: rates.spatial };
        }
        Ok(slopes)
    }

    /// The state after a step, from its slopes.
    #[inline]
    fn end<G: LieGroup, M: Torque<G>>(
        &self,
        system: &EulerPoincare<G, M>,
        state: &State<G>,
        h: f64,
        slopes: &[Rates<G::Vector>],
    ) -> Result<State<G>, Error> {
        let group = system.group();
        let at = moved::<G>(slopes, &self.b, h, &state.spatial);
        expect_finite(state.time, &[&at.velocity, &at.spatial])?;
        let element = group.compose(&state.element, &group.exp(&at.velocity));
        let (time, spatial) = (state.time + h, at.spatial);
        Ok(State { time, element: group.restored(element), spatial })
    }
}

/// `h` times the weighted slopes: the coordinates, and a spatial momentum moved by its part.
#[inline]
fn moved<G: LieGroup>(
    slopes: &[Rates<G::Vector>],
    weights: &[f64],
    h: f64,
    spatial: &G::Vector,
) -> Rates<G::Vector> {
    let start =
        Rates { velocity: G::Vector::zeros(spatial.components().len()), spatial: spatial.clone() };
    let weighted = slopes.iter().zip(weights).filter(|(_, weight)| **weight != 0.0);
    weighted.fold(start, |sum, (slope, weight)| Rates {
        velocity: sum.velocity + slope.velocity.clone() * (h * weight),
        spatial: sum.spatial + slope.spatial.clone() * (h * weight),
    })
}

impl<const STAGES: usize, G: LieGroup, M: Torque<G>> Integrator<EulerPoincare<G, M>>
    for MuntheKaas<STAGES>
{
    fn step(
        &self,
        system: &EulerPoincare<G, M>,
        state: &mut State<G>,
        h: f64,
    ) -> Result<(), Error> {
        let slopes = self.slopes(system, state, h, self.needed)?;
        *state = self.end(system, state, h, &slopes)?;
        Ok(())
    }
}
