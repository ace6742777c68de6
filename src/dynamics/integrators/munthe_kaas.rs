//! Runge-Kutta methods in canonical coordinates around the present element.

use super::Integrator;
use crate::Error;
use crate::dynamics::euler_poincare::{EulerPoincare, State, Torque};
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
        let group = system.group();
        let stopped =
            || Error::Integration { t: state.time, reason: "a value is not finite".into() };
        let zero = G::Vector::zeros(group.dimension());
        let mut slopes: [(G::Vector, G::Vector); STAGES] =
            std::array::from_fn(|_| (zero.clone(), zero.clone()));
        let at = |time: f64, u: &G::Vector, spatial: G::Vector| State {
            time,
            element: group.compose(&state.element, &group.exp(u)),
            spatial,
        };
        for stage in 0..self.stages {
            let (u, spatial) = self.moved(&slopes[..stage], &self.a[stage], h, state, &zero);
            let rates = system.rates(&at(state.time + self.c[stage] * h, &u, spatial));
            if !rates.velocity.is_finite() || !rates.spatial.is_finite() {
                return Err(stopped());
            }
            slopes[stage] = (group.tangent_left_inverse(&u, &rates.velocity)?, rates.spatial);
        }
        let (u, spatial) = self.moved(&slopes, &self.b, h, state, &zero);
        let mut next = at(state.time + h, &u, spatial);
        next.element = group.restored(next.element);
        let origin = State { spatial: zero.clone(), ..state.clone() };
        let (off, off_spatial) = self.moved(&slopes, &self.error, h, &origin, &zero);
        if !u.is_finite() || !next.spatial.is_finite() {
            return Err(stopped());
        }
        let scale = state.spatial.largest().max(f64::MIN_POSITIVE);
        Ok((next, off.largest().max(off_spatial.largest() / scale)))
    }

    /// `h` times the weighted slopes: the coordinates, and the spatial momentum moved by its part.
    fn moved<G: LieGroup>(
        &self,
        slopes: &[(G::Vector, G::Vector)],
        weights: &[f64],
        h: f64,
        from: &State<G>,
        zero: &G::Vector,
    ) -> (G::Vector, G::Vector) {
        let weighted = slopes.iter().zip(weights).filter(|(_, weight)| **weight != 0.0);
        let start = (zero.clone(), from.spatial.clone());
        weighted.fold(start, |(u, spatial), ((du, d_spatial), weight)| {
            (u + du.clone() * (h * weight), spatial + d_spatial.clone() * (h * weight))
        })
    }
}

impl<G: LieGroup, M: Torque<G>> Integrator<EulerPoincare<G, M>> for MuntheKaas {
    fn step(
        &self,
        system: &EulerPoincare<G, M>,
        state: &mut State<G>,
        h: f64,
    ) -> Result<(), Error> {
        *state = self.advanced(system, state, h)?.0;
        Ok(())
    }
}
