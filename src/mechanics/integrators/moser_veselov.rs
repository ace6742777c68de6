//! The discrete Moser-Veselov algorithm with preprocessed moments.
//!
//! One step rotates the body by the quaternion `(1, c)/sqrt(1 + |c|^2)`. In principal axes, `c`
//! satisfies
//!
//! ```text
//! c_i = (1 + |c|^2) h H_i/(2 J_i) + (J_j - J_k)/J_i c_j c_k        (i, j, k) cyclic
//! H_i += 4 (J_j - J_k) c_j c_k/(h (1 + |c|^2))
//! ```
//!
//! The step conserves the energy, `R H` and the symplectic form. If the moments are modified by
//! `1/J -> s/J + d`, the step has any even order. Here `s` and `d` are series in `h^2` whose
//! coefficients depend on the invariants (E. Hairer and G. Vilmart, J. Phys. A 39 (2006)
//! 13225-13235, after R. McLachlan and A. Zanna, Found. Comput. Math. 5 (2005) 87-123).

use super::Integrator;
use super::compensated::Sum;
use super::principal::Principal;
use crate::Error;
use crate::group::{LieGroup, So3};
use crate::mechanics::bodies::{BodyState, Inertia};
use crate::mechanics::stopped;
use crate::mechanics::systems::State;
use crate::mechanics::systems::euler_poincare::{EulerPoincare, Torque};
use nalgebra::{Quaternion, UnitQuaternion, Vector3};

/// The order of a step.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum MoserVeselovOrder {
    /// The moments are not preprocessed.
    Two,
    /// The moments are preprocessed up to `h^2`.
    Four,
    /// The moments are preprocessed up to `h^4`.
    Six,
    /// The moments are preprocessed up to `h^6`.
    Eight,
    /// The moments are preprocessed up to `h^8`.
    Ten,
}

/// The discrete Moser-Veselov method for the free rigid body.
///
/// All orders need the same time per step, because the moments are preprocessed once for many
/// steps.
///
/// ```
/// use affinor::mechanics::{BodyState, FreeBody, Inertia, MoserVeselov};
/// use affinor::mechanics::integrators::moser_veselov::MoserVeselovOrder;
/// use nalgebra::{UnitQuaternion, Vector3};
/// let inertia = Inertia::diagonal(&Vector3::new(0.6, 0.8, 1.0))?;
/// let attitude = UnitQuaternion::identity();
/// let start = BodyState { attitude, momentum: Vector3::new(1.8, 0.4, -0.9) };
/// let end = MoserVeselov::new(&inertia, MoserVeselovOrder::Ten).steps(&start, 0.05, 200)?;
/// let exact = FreeBody::new(&inertia, &start)?.at(10.0);
/// assert!((end.momentum - exact.momentum).norm() < 1e-11);
/// assert!(end.attitude.angle_to(&exact.attitude) < 1e-11);
/// # Ok::<(), affinor::Error>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct MoserVeselov {
    inertia: Inertia,
    body: Principal,
    /// The largest moment, which is the unit of `moments`.
    unit: f64,
    moments: [f64; 3],
    /// The coefficients of `|H|^{2(n - j)} (2E)^j` in `s` and `d`, listed by the degree `n`, which
    /// begins at 1.
    series: [[Coefficients; 2]; 4],
    degrees: usize,
}

/// The coefficients for `j` from 0 to at most 4.
type Coefficients = [f64; 5];

/// Newton's method ends if a correction is smaller than this value, because the next correction
/// would be a rounding error.
const NEWTON: f64 = 1e-8;
/// The largest number of Newton iterations. Two or three iterations normally suffice.
const ITERATIONS: usize = 30;
const TOO_LONG: &str = "the step is too long";

impl MoserVeselov {
    /// Steps of order `order` for a body.
    pub fn new(inertia: &Inertia, order: MoserVeselovOrder) -> Self {
        let unit = inertia.principal_moments().max();
        let moments = (inertia.principal_moments() / unit).into();
        let degrees = order as usize;
        let (inertia, body) = (inertia.clone(), Principal::new(inertia));
        MoserVeselov { inertia, body, unit, moments, series: series(moments), degrees }
    }

    /// The order of convergence.
    pub fn order(&self) -> u32 {
        2 * (1 + self.degrees as u32)
    }

    /// The state after `count` steps of length `step`, which may be negative. Momentum and attitude
    /// are computed by compensated summation.
    ///
    /// # Errors
    /// [`Error::Integration`] if a step is too long, so that its equations have no solution near
    /// the start.
    pub fn steps(&self, start: &BodyState, step: f64, count: usize) -> Result<BodyState, Error> {
        let axes = self.inertia.axes();
        // scales h H to units of the largest moment, in which it is dimensionless
        let scale = step / self.unit;
        let mut y = Sum::new(axes.tr_mul(&start.momentum) * scale);
        let mut turn = Sum::new(Quaternion::identity().coords);
        let too_long = |taken: usize| stopped(step * taken as f64, TOO_LONG);
        let stage = self.stage(&y.value).ok_or_else(|| too_long(0))?;
        for taken in 0..count {
            let c = stage.solve(&y.value).ok_or_else(|| too_long(taken))?;
            let square = 1.0 + c.norm_squared();
            let length = square.sqrt();
            // the quaternion minus 1; it equals (1, c)/length - 1
            let less = Quaternion::from_parts(-c.norm_squared() / (1.0 + length), c);
            let product = Quaternion::from(turn.value) * less;
            turn.add(&(product.coords / length));
            y.add(&(stage.products(&c, &stage.differences) * (4.0 / square)));
        }
        if count == 0 || scale == 0.0 {
            return Ok(*start);
        }
        let turn = Quaternion::from(turn.value);
        let turn = Quaternion::from_parts(turn.w, axes * turn.imag());
        Ok(BodyState {
            attitude: So3.project(start.attitude * UnitQuaternion::new_unchecked(turn)),
            momentum: axes * y.value / scale,
        })
    }

    /// Makes one step.
    ///
    /// # Errors
    /// The errors of [`steps`](Self::steps).
    pub fn step(&self, state: &BodyState, step: f64) -> Result<BodyState, Error> {
        self.steps(state, step, 1)
    }

    /// The preprocessed moments for a momentum. They depend only on quantities that the steps
    /// conserve.
    fn stage(&self, y: &Vector3<f64>) -> Option<Stage> {
        let square = 0.5 * y.norm_squared();
        let energy = 0.5 * (0..3).map(|i| y[i] * y[i] / self.moments[i]).sum::<f64>();
        let mut sums = [1.0, 0.0];
        for (degree, both) in self.series.iter().enumerate().take(self.degrees) {
            for (sum, coefficients) in sums.iter_mut().zip(both) {
                *sum += homogeneous(&coefficients[..degree + 2], square, energy);
            }
        }
        let inverse = self.moments.map(|moment| sums[0] / moment + sums[1]);
        if !inverse.iter().all(|inverse| *inverse > 0.0 && inverse.is_finite()) {
            return None;
        }
        let [j1, j2, j3] = inverse.map(|inverse| 1.0 / inverse);
        let differences = Vector3::new(j2 - j3, j3 - j1, j1 - j2);
        let inverse = Vector3::from(inverse);
        Some(Stage { inverse, differences, ratios: differences.component_mul(&inverse) })
    }
}

impl<M: Torque<So3>> Integrator<EulerPoincare<So3, M>> for MoserVeselov {
    /// Advances the state; the spatial momentum, which is a part of the state, remains unchanged.
    ///
    /// # Errors
    /// The errors of [`steps`](Self::steps); [`Error::Invalid`] if the system is another body;
    /// [`Error::Integration`] if it has a torque.
    fn step(
        &self,
        system: &EulerPoincare<So3, M>,
        state: &mut State<So3>,
        h: f64,
    ) -> Result<(), Error> {
        let start = self.body.free_state(system, state)?;
        let y = start.momentum * (h / self.unit);
        let c = self.stage(&y).and_then(|stage| stage.solve(&y));
        let c = c.ok_or_else(|| stopped(state.time, TOO_LONG))?;
        let turn = UnitQuaternion::new_unchecked(Quaternion::from_parts(1.0, c));
        state.element = self.body.attitude(start.attitude * turn);
        state.time += h;
        Ok(())
    }
}

/// The sum `sum_j a_j x^(n - j) y^j`.
fn homogeneous(coefficients: &[f64], x: f64, y: f64) -> f64 {
    let mut power = 1.0;
    coefficients.iter().rev().fold(0.0, |sum, a| {
        let sum = sum * y + a * power;
        power *= x;
        sum
    })
}

/// The constants in the equations of a step.
struct Stage {
    /// The values `1/J_i`.
    inverse: Vector3<f64>,
    /// The differences `J_j - J_k`.
    differences: Vector3<f64>,
    /// The ratios `(J_j - J_k)/J_i`.
    ratios: Vector3<f64>,
}

impl Stage {
    /// The products `f_i c_j c_k`.
    #[inline]
    fn products(&self, c: &Vector3<f64>, f: &Vector3<f64>) -> Vector3<f64> {
        Vector3::new(f.x * c.y * c.z, f.y * c.z * c.x, f.z * c.x * c.y)
    }

    /// Solves the equations for `c` by Newton's method.
    #[inline]
    fn solve(&self, y: &Vector3<f64>) -> Option<Vector3<f64>> {
        let (half, f) = (0.5 * y.component_mul(&self.inverse), &self.ratios);
        let right = |c: &Vector3<f64>| half * (1.0 + c.norm_squared()) + self.products(c, f);
        let mut c = right(&(half + self.products(&half, f)));
        for _ in 0..ITERATIONS {
            let residual = right(&c) - c;
            // the Jacobian matrix of c minus the right-hand side, row by row
            let (a, c2) = (half, c + c);
            let (d1, d2, d3) = (1.0 - a.x * c2.x, 1.0 - a.y * c2.y, 1.0 - a.z * c2.z);
            let (r1, r2, r3) = (
                Vector3::new(d1, -a.x * c2.y - f.x * c.z, -a.x * c2.z - f.x * c.y),
                Vector3::new(-a.y * c2.x - f.y * c.z, d2, -a.y * c2.z - f.y * c.x),
                Vector3::new(-a.z * c2.x - f.z * c.y, -a.z * c2.y - f.z * c.x, d3),
            );
            // solves by Cramer's rule, from the rows of the matrix
            let (p1, p2, p3) = (r2.cross(&r3), r3.cross(&r1), r1.cross(&r2));
            let scale = 1.0 / r1.dot(&p1);
            let correction = (p1 * residual.x + p2 * residual.y + p3 * residual.z) * scale;
            c += correction;
            if correction.norm_squared() <= NEWTON * NEWTON * c.norm_squared() {
                return Some(c);
            }
        }
        None
    }
}

/// The coefficients of Hairer and Vilmart for the moments `J`. They are the coefficients of
/// `C^(n - j) E^j` in `s` and in `d`, where `C = |H|^2/2`, and `E` is the energy.
fn series(moments: [f64; 3]) -> [[Coefficients; 2]; 4] {
    let [a, b, c] = moments;
    let det = a * b * c;
    let (det2, det3, det4) = (det.powi(2), det.powi(3), det.powi(4));
    // p sums powers of the moments; q sums powers of moments that are divided by powers of another
    // moment
    let p = |n: i32| moments.iter().map(|x| x.powi(n)).sum::<f64>();
    let q = |n: i32, m: i32| moments.iter().map(|x| (p(n) - x.powi(n)) * x.powi(-m)).sum::<f64>();
    [
        [
            [p(1) / (6.0 * det), -p(-1) / 3.0, 0.0, 0.0, 0.0],
            [-1.0 / (3.0 * det), p(1) / (6.0 * det), 0.0, 0.0, 0.0],
        ],
        [
            [
                (p(2) / det - p(-1)) / (30.0 * det),
                (1.0 - q(1, 1)) / (30.0 * det),
                (3.0 * p(1) / det + 2.0 * p(-2)) / 60.0,
                0.0,
                0.0,
            ],
            [
                -p(1) / (60.0 * det2),
                p(-1) / (10.0 * det) - p(2) / (60.0 * det2),
                -(9.0 + q(1, 1)) / (60.0 * det),
                0.0,
                0.0,
            ],
        ],
        [
            [
                (4.0 * det + 17.0 * p(3) - 15.0 * det * q(1, 1)) / (2520.0 * det3),
                (9.0 * p(1) + 10.0 * det * p(-2) - 6.0 * q(2, 1)) / (420.0 * det2),
                ((6.0 * q(1, 2) - 100.0 * p(-1)) * det + 53.0 * p(2)) / (2520.0 * det2),
                (15.0 - det * p(-3) - 2.0 * q(1, 1)) / (630.0 * det),
                0.0,
            ],
            [
                (34.0 * det * p(-1) - 19.0 * p(2)) / (2520.0 * det3),
                (p(3) + 2.0 * det * q(1, 1) - 85.0 * det) / (1260.0 * det3),
                (47.0 * p(1) + 13.0 * q(2, 1) - 38.0 * det * p(-2)) / (2520.0 * det2),
                (9.0 * det * p(-1) + det * q(1, 2) - 11.0 * p(2)) / (1260.0 * det2),
                0.0,
            ],
        ],
        [
            [
                (62.0 * p(4) - 94.0 * det * q(2, 1) + 66.0 * det2 * p(-2) + 81.0 * det * p(1))
                    / (45360.0 * det4),
                (-77.0 * q(3, 1) + 75.0 * det * q(1, 2) + 214.0 * p(2) - 240.0 * det * p(-1))
                    / (22680.0 * det3),
                (26.0 * det * q(2, 2) + 55.0 * p(3) + 204.0 * det
                    - 50.0 * det2 * p(-3)
                    - 59.0 * det * q(1, 1))
                    / (7560.0 * det3),
                (137.0 * det * p(-2) - det * q(1, 3) + 3.0 * p(1) - 69.0 * q(2, 1))
                    / (11340.0 * det2),
                (2.0 * det2 * p(-4) + 5.0 * det * q(1, 2) - 171.0 * det * p(-1) + 159.0 * p(2))
                    / (45360.0 * det2),
            ],
            [
                (60.0 * q(1, 1) * det - 61.0 * p(3) - 247.0 * det) / (45360.0 * det4),
                (54.0 * det * p(1) - p(4) + 218.0 * det * q(2, 1) - 426.0 * det2 * p(-2))
                    / (45360.0 * det4),
                (125.0 * det * p(-1) - 5.0 * q(3, 1) - 130.0 * p(2) + 4.0 * det * q(1, 2))
                    / (7560.0 * det3),
                (67.0 * p(3) - 735.0 * det - 15.0 * det * q(2, 2)
                    + 87.0 * det * q(1, 1)
                    + 34.0 * det2 * p(-3))
                    / (22680.0 * det3),
                (165.0 * p(1) - det * q(1, 3) - 9.0 * q(2, 1) - 145.0 * det * p(-2))
                    / (45360.0 * det2),
            ],
        ],
    ]
}
