//! Runge-Kutta methods in canonical coordinates around the present element.

use super::{Integrator, expect_finite};
use crate::Error;
use crate::dynamics::euler_poincare::{EulerPoincare, Rates, State, Torque};
use crate::group::{Coordinates, LieGroup};

/// The most stages of a method here.
const STAGES: usize = 7;

/// Runge-Kutta-Munthe-Kaas: with `g = g_0 exp(u)`, the method solves `u' = T_left(u)^-1 Omega` and
/// `h'` together, from `u = 0`.
///
/// H. Munthe-Kaas, *BIT* 38 (1998) 92-111. The inverse tangent operator is the group's own and not a
/// truncated series, so the order is that of the tableau.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MuntheKaas {
    order: u32,
    stages: usize,
    /// Rows of the tableau, below the diagonal.
    a: [[f64; STAGES - 1]; STAGES],
    b: [f64; STAGES],
    /// The difference of `b` and the weights of the embedded method.
    error: [f64; STAGES],
    c: [f64; STAGES],
}

impl MuntheKaas {
    /// The classical method of order 4.
    pub const RK4: MuntheKaas = MuntheKaas {
        order: 4,
        stages: 4,
        a: [
            [0.0; 6],
            [0.5, 0.0, 0.0, 0.0, 0.0, 0.0],
            [0.0, 0.5, 0.0, 0.0, 0.0, 0.0],
            [0.0, 0.0, 1.0, 0.0, 0.0, 0.0],
            [0.0; 6],
            [0.0; 6],
            [0.0; 6],
        ],
        b: [1.0 / 6.0, 1.0 / 3.0, 1.0 / 3.0, 1.0 / 6.0, 0.0, 0.0, 0.0],
        error: [0.0; STAGES],
        c: [0.0, 0.5, 0.5, 1.0, 0.0, 0.0, 0.0],
    };

    /// The pair of orders 5 and 4 of J. R. Dormand and P. J. Prince, *J. Comput. Appl. Math.* 6
    /// (1980) 19-26.
    pub const DORMAND_PRINCE: MuntheKaas = MuntheKaas {
        order: 5,
        stages: 7,
        a: [
            [0.0; 6],
            [1.0 / 5.0, 0.0, 0.0, 0.0, 0.0, 0.0],
            [3.0 / 40.0, 9.0 / 40.0, 0.0, 0.0, 0.0, 0.0],
            [44.0 / 45.0, -56.0 / 15.0, 32.0 / 9.0, 0.0, 0.0, 0.0],
            [19372.0 / 6561.0, -25360.0 / 2187.0, 64448.0 / 6561.0, -212.0 / 729.0, 0.0, 0.0],
            [
                9017.0 / 3168.0,
                -355.0 / 33.0,
                46732.0 / 5247.0,
                49.0 / 176.0,
                -5103.0 / 18656.0,
                0.0,
            ],
            [35.0 / 384.0, 0.0, 500.0 / 1113.0, 125.0 / 192.0, -2187.0 / 6784.0, 11.0 / 84.0],
        ],
        b: [35.0 / 384.0, 0.0, 500.0 / 1113.0, 125.0 / 192.0, -2187.0 / 6784.0, 11.0 / 84.0, 0.0],
        error: [
            71.0 / 57600.0,
            0.0,
            -71.0 / 16695.0,
            71.0 / 1920.0,
            -17253.0 / 339200.0,
            22.0 / 525.0,
            -1.0 / 40.0,
        ],
        c: [0.0, 0.2, 0.3, 0.8, 8.0 / 9.0, 1.0, 1.0],
    };

    /// The order of the error of a motion.
    pub fn order(&self) -> u32 {
        self.order
    }

    /// The state after a step, and the size of its estimated error.
    ///
    /// # Errors
    /// [`Error::Integration`], [`Error::SingularTangent`].
    pub(super) fn advanced<G: LieGroup, M: Torque<G>>(
        &self,
        system: &EulerPoincare<G, M>,
        state: &State<G>,
        h: f64,
    ) -> Result<(State<G>, f64), Error> {
        let slopes = self.slopes(system, state, h, self.stages)?;
        let next = self.end(system, state, h, &slopes)?;
        let zero = G::Vector::zeros(system.group().dimension());
        let off = moved::<G>(&slopes, &self.error, h, &zero);
        let scale = state.spatial.largest().max(f64::MIN_POSITIVE);
        Ok((next, off.velocity.largest().max(off.spatial.largest() / scale)))
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
        let zero = G::Vector::zeros(group.dimension());
        let mut slopes: [Rates<G::Vector>; STAGES] =
            std::array::from_fn(|_| Rates { velocity: zero.clone(), spatial: zero.clone() });
        // u = 0
        slopes[0] = system.rates(state);
        expect_finite(state.time, &[&slopes[0].velocity, &slopes[0].spatial])?;
        for stage in 1..stages {
            let at = moved::<G>(&slopes[..stage], &self.a[stage], h, &state.spatial);
            let rates = system.rates(&State {
                time: state.time + self.c[stage] * h,
                element: group.compose(&state.element, &group.exp(&at.velocity)),
                spatial: at.spatial,
            });
            expect_finite(state.time, &[&rates.velocity, &rates.spatial])?;
            let velocity = group.tangent_left_inverse(&at.velocity, &rates.velocity)?;
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

impl<G: LieGroup, M: Torque<G>> Integrator<EulerPoincare<G, M>> for MuntheKaas {
    fn step(
        &self,
        system: &EulerPoincare<G, M>,
        state: &mut State<G>,
        h: f64,
    ) -> Result<(), Error> {
        // the last stage of a pair may serve its error only
        let stages = self.stages - usize::from(self.b[self.stages - 1] == 0.0);
        let slopes = self.slopes(system, state, h, stages)?;
        *state = self.end(system, state, h, &slopes)?;
        Ok(())
    }
}
