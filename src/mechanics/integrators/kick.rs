//! Splitting methods for a body in a potential. They consist of free motions and kicks.

use super::{Integrator, expect_finite};
use crate::Error;
use crate::group::So3;
use crate::mechanics::State;
use crate::mechanics::integrators::moser_veselov;
use crate::mechanics::integrators::principal::Principal;
use crate::mechanics::systems::euler_poincare::{EulerPoincare, Torque};
use crate::mechanics::{BodyState, FreeBody, Inertia, MoserVeselov};
use nalgebra::{UnitQuaternion, Vector3};

/// The order of a step.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum KickOrder {
    /// One free motion between two half kicks.
    Two,
    /// Six free motions and seven kicks: the method SRKN_6^b of Blanes and Moan.
    Four,
    /// Eleven free motions and twelve kicks: the method SRKN_11^b of Blanes and Moan.
    Six,
}

/// The method that computes the free motions between kicks.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FreeMotion {
    /// Elliptic functions, for steps of any length.
    Exact,
    /// One step of the discrete Moser-Veselov algorithm, which needs a quarter of the time. This
    /// step has its own order. Order 10 is accurate up to rounding errors if the rotations are
    /// below 0.1 radians.
    MoserVeselov(moser_veselov::MoserVeselovOrder),
}

/// The fractions of a step for its first half. The first list contains the fractions of the kicks,
/// and the second contains the fractions of the free motions that follow the kicks.
const FOUR: [[f64; 3]; 2] = [
    [0.0829844064174052, 0.396309801498368, -0.0390563049223486],
    [0.245298957184271, 0.604872665711080, 0.0],
];
const SIX: [[f64; 5]; 2] = [
    [
        0.0414649985182624,
        0.198128671918067,
        -0.0400061921041533,
        0.0752539843015807,
        -0.0115113874206879,
    ],
    [
        0.123229775946271,
        0.290553797799558,
        -0.127049212625417,
        -0.246331761062075,
        0.357208872795928,
    ],
];

impl KickOrder {
    /// The fractions of kicks and free motions, which alternate. The first and the last entry are
    /// kicks.
    fn shares(self) -> Vec<f64> {
        let mut half = match self {
            KickOrder::Two => vec![0.5],
            KickOrder::Four => {
                let [b, a] = FOUR;
                vec![b[0], a[0], b[1], a[1], b[2], 0.5 - a[0] - a[1]]
            }
            KickOrder::Six => {
                let [b, a] = SIX;
                let mut shares: Vec<f64> = b.iter().zip(a).flat_map(|(b, a)| [*b, a]).collect();
                shares.push(0.5 - b.iter().sum::<f64>());
                shares
            }
        };
        // the middle fraction follows from the other fractions, because the fractions of each kind
        // add up to 1
        let kind = half.len() % 2;
        let others: f64 = half.iter().skip(kind).step_by(2).sum();
        half.push(1.0 - 2.0 * others);
        let mirrored: Vec<f64> = half.iter().rev().skip(1).copied().collect();
        half.extend(mirrored);
        half
    }
}

/// Steps of a body with a torque that depends only on time and attitude. Free motions alternate
/// with kicks, which change the spatial momentum at a fixed attitude: `h += h_k R M(t, R)` for a
/// fraction `h_k` of the step.
///
/// Free motions and kicks are exact flows, so the step is symmetric, and symplectic if the torque
/// has a potential. The method conserves the momentum about the axis of a symmetric potential up to
/// rounding errors, and the error of the energy is bounded. The orders 4 and 6 are methods of
/// Runge-Kutta-Nystroem type, for a kinetic energy that is quadratic in the momentum (S. Blanes and
/// P. C. Moan, *J. Comput. Appl. Math.* 142 (2002) 313-330). For bodies, see J. Touma and J.
/// Wisdom, *Astron. J.* 107 (1994) 1189-1202.
///
/// The torque must not depend on the velocity. To check this, the method calls the torque with a
/// velocity of NaN, and a result of NaN is an error.
#[derive(Clone, Debug, PartialEq)]
pub struct Kick {
    body: Principal,
    order: KickOrder,
    /// The inertia, in principal axes.
    inertia: Inertia,
    /// The Moser-Veselov steps of the free motion; `None` if the free motion is computed exactly.
    steps: Option<MoserVeselov>,
    shares: Vec<f64>,
}

impl Kick {
    /// The splitting method for a body with this inertia. `order` is the order of a step, and
    /// `motion` is the method for the free motions between kicks.
    pub fn new(inertia: &Inertia, order: KickOrder, motion: FreeMotion) -> Self {
        let (body, inertia) = (Principal::new(inertia), inertia.in_principal_axes());
        let steps = match motion {
            FreeMotion::Exact => None,
            FreeMotion::MoserVeselov(order) => Some(MoserVeselov::new(&inertia, order)),
        };
        Kick { body, order, inertia, steps, shares: order.shares() }
    }

    /// The order of convergence.
    pub fn order(&self) -> u32 {
        2 * (1 + self.order as u32)
    }

    /// The attitude after a free motion.
    fn moved(
        &self,
        attitude: UnitQuaternion<f64>,
        spatial: &Vector3<f64>,
        time: f64,
    ) -> Result<UnitQuaternion<f64>, Error> {
        let start = BodyState { attitude, momentum: attitude.inverse_transform_vector(spatial) };
        let end = match &self.steps {
            None => FreeBody::new(&self.inertia, &start)?.at(time),
            Some(steps) => steps.step(&start, time)?,
        };
        Ok(end.attitude)
    }
}

impl<M: Torque<So3>> Integrator<EulerPoincare<So3, M>> for Kick {
    /// # Errors
    /// In addition, [`Error::Invalid`] if the system is another body.
    fn step(
        &self,
        system: &EulerPoincare<So3, M>,
        state: &mut State<So3>,
        h: f64,
    ) -> Result<(), Error> {
        let mut axes = self.body.state(system, state)?.attitude;
        let (mut time, mut spatial) = (state.time, state.spatial);
        let unknown = Vector3::repeat(f64::NAN);
        for (at, share) in self.shares.iter().enumerate() {
            if at % 2 == 0 {
                spatial += self.body.torque(system, time, axes, &unknown) * (share * h);
                expect_finite(time, &spatial)?;
            } else {
                axes = self.moved(axes, &spatial, share * h)?;
                time += share * h;
            }
        }
        *state = State { time: state.time + h, element: self.body.attitude(axes), spatial };
        Ok(())
    }
}
