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
    /// That a step needs; its error has all.
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
        stages: 6,
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
        let slopes = self.slopes::<STAGES, _, _>(system, state, h)?;
        let next = self.end(system, state, h, &slopes)?;
        let zero = G::Vector::zeros(system.group().dimension());
        let [off, of_spatial] =
            slopes.map(|slopes| moved(&zero, &slopes, &self.error, h).largest());
        let scale = state.spatial.largest().max(f64::MIN_POSITIVE);
        Ok((next, off.max(of_spatial / scale)))
    }

    /// `u'` at the first `N` stages, and `h'`.
    #[inline]
    fn slopes<const N: usize, G: LieGroup, M: Torque<G>>(
        &self,
        system: &EulerPoincare<G, M>,
        state: &State<G>,
        h: f64,
    ) -> Result<[[G::Vector; N]; 2], Error> {
        let group = system.group();
        let zero = G::Vector::zeros(group.dimension());
        let mut slopes: [G::Vector; N] = std::array::from_fn(|_| zero.clone());
        let mut of_spatial: [G::Vector; N] = std::array::from_fn(|_| zero.clone());
        // u = 0
        Rates { velocity: slopes[0], spatial: of_spatial[0] } = system.rates(state);
        for stage in 1..N {
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
    fn end<const N: usize, G: LieGroup, M: Torque<G>>(
        &self,
        system: &EulerPoincare<G, M>,
        state: &State<G>,
        h: f64,
        [slopes, of_spatial]: &[[G::Vector; N]; 2],
    ) -> Result<State<G>, Error> {
        let group = system.group();
        let u = moved(&G::Vector::zeros(group.dimension()), slopes, &self.b, h);
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

impl<G: LieGroup, M: Torque<G>> Integrator<EulerPoincare<G, M>> for MuntheKaas {
    fn step(
        &self,
        system: &EulerPoincare<G, M>,
        state: &mut State<G>,
        h: f64,
    ) -> Result<(), Error> {
        *state = match self.stages {
            4 => self.end(system, state, h, &self.slopes::<4, _, _>(system, state, h)?)?,
            _ => self.end(system, state, h, &self.slopes::<6, _, _>(system, state, h)?)?,
        };
        Ok(())
    }
}
