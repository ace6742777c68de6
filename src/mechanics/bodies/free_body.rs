//! The torque-free rigid body at any time, in closed form.
//!
//! The momentum is scaled to length 1; the frequencies are `w_i = |H|/J_i`. Let `c` be the
//! principal axis about which the momentum circulates, whose moment is the largest or the smallest,
//! and let `b` be the axis of the middle moment:
//!
//! ```text
//! m_a = A_a cn(u, k)   m_b = A_b sn(u, k)   m_c = +-A_c dn(u, k)   u = u0 + l t
//! ```
//!
//! The attitude is `R = R_0 P_0^-1 exp(psi n) P`, where `n = +-e_c`, and `P` is the shortest
//! rotation from `m` to `n`. Then `psi' = w_c + (2E - w_c)/(1 + A_c dn u)` has no singularity (van
//! Zon and Schofield, J. Comput. Phys. 225 (2007) 145-164; Celledoni, Fasso, Saefstroem and Zanna,
//! SIAM J. Sci. Comput. 30 (2008) 2084-2112). One Gauss transformation, `u = (1 + k1) v`,
//! transforms the integrand to a sum of positive terms,
//!
//! ```text
//! 1/(1 + r dn u) = (1 + (k1 - n) s^2/(1 + n s^2))/(1 + r),    s = sn(v, k1),  n = k1 (1 - r)/(1 + r)
//! ```
//!
//! and its integral is of the third kind, without an additional arctangent. The result is accurate
//! even if moments are nearly equal, or if the momentum is near an axis.

use super::elliptic::{Jacobi, first_kind, gauss, level, raise, third_kind};
use super::{BodyState, Inertia};
use crate::Error;
use crate::group::{LieGroup, So3};
use nalgebra::{Matrix3, Quaternion, UnitQuaternion, Vector3};

/// Momenta within this relative distance from the separatrix count as on the separatrix, because
/// the rounding errors of the data are as large.
const ON_SEPARATRIX: f64 = 4.0 * f64::EPSILON;

/// The motion of a rigid body without torque. The result is accurate up to rounding errors at any
/// time.
///
/// The rounding of the moments alone already changes the attitude by `|H| t/J` times half a machine
/// epsilon; the error of [`at`](Self::at) is a few times as large. The spatial momentum, the energy
/// and `|H|` do not drift.
///
/// ```
/// use affinor::mechanics::{BodyState, FreeBody, Inertia};
/// use nalgebra::{UnitQuaternion, Vector3};
/// // a body that rotates about its middle axis flips (Dzhanibekov)
/// let inertia = Inertia::diagonal(&Vector3::new(3.0, 5.0, 9.0))?;
/// let momentum = Vector3::new(0.0, 2.0, 0.01);
/// let start = BodyState { attitude: UnitQuaternion::identity(), momentum };
/// let body = FreeBody::new(&inertia, &start)?;
/// let period = body.period().unwrap();
/// assert!((period - 118.110887046385744).abs() < 1e-12);
/// let flipped = body.at(period / 2.0);
/// assert!((flipped.momentum - Vector3::new(0.0, -2.0, 0.01)).norm() < 1e-13);
/// assert!((flipped.space_momentum() - momentum).norm() < 1e-14);
/// # Ok::<(), affinor::Error>(())
/// ```
#[doc(alias("Euler top", "torque-free motion", "Dzhanibekov effect", "tennis racket"))]
#[derive(Clone, Debug, PartialEq)]
pub struct FreeBody {
    inertia: Inertia,
    start: BodyState,
    /// The length `|H|` of the momentum.
    length: f64,
    motion: Motion,
}

#[derive(Clone, Debug, PartialEq)]
#[allow(clippy::large_enum_variant, reason = "one a body, and no way to go for its data")]
enum Motion {
    /// A steady rotation, in which momentum and velocity are parallel.
    Steady { velocity: Vector3<f64> },
    /// A motion that is not a steady rotation.
    Turning { frame: Frame, course: Course },
}

/// Data of motions that are not steady rotations.
#[derive(Clone, Debug, PartialEq)]
struct Frame {
    /// The axes a, b, c as columns, in body components.
    axes: Matrix3<f64>,
    /// The amplitudes `A_a` with the sign of `m_a`, `A_b`, and `A_c` with the sign of `m_c`.
    amplitudes: Vector3<f64>,
    /// The inverse of the shortest rotation `P` at the start.
    start: Quaternion<f64>,
    /// The coefficient of the linear part of `psi`, and the factor of the periodic part.
    rate: f64,
    factor: f64,
    /// The value of the periodic part at the start.
    rest: f64,
}

#[derive(Clone, Debug, PartialEq)]
#[allow(clippy::large_enum_variant, reason = "one a body, and no way to go for its data")]
enum Course {
    /// The momentum circulates about the axis c.
    Periodic {
        /// The elliptic functions for the modulus `k1`, and the pair of `k1` and `1 - k1`.
        jacobi: Jacobi,
        modulus: (f64, f64),
        /// The characteristic `n` of the integral of the third kind, and the value of the integral
        /// over a quarter period.
        characteristic: f64,
        quarter: f64,
        /// The coefficients of `v = v0 + v1 t`.
        v: [f64; 2],
        phase: Phase,
    },
    /// The momentum moves on the separatrix: from a rotation about the middle axis to the opposite
    /// rotation, in infinite time.
    Separatrix {
        /// The coefficients of `u = u0 + u1 t`.
        u: [f64; 2],
        /// The value `sqrt((1 - r)/(1 + r))`.
        root: f64,
    },
}

/// The rotation of the attitude in one period. The axis is the constant spatial momentum.
///
/// The rotation `R(t + period) R(t)^-1` has the angle [`total`](Self::total) and the axis `R H`
/// (Montgomery, Am. J. Phys. 59 (1991) 394-398).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Phase {
    /// The period of `H` and `Omega`.
    pub period: f64,
    /// The angle of the rotation, including full turns.
    pub total: f64,
    /// The dynamic phase `2 E T/|H|`.
    pub dynamic: f64,
    /// The geometric phase. Up to its sign and full turns, it is the solid angle that the path of
    /// `H` in the body encloses.
    pub geometric: f64,
}

impl FreeBody {
    /// The motion from a state at time 0. The body components of the state refer to the same axes
    /// as the inertia.
    ///
    /// # Errors
    /// [`Error::Overflow`] for a state that is not finite, or so large that angular velocities are
    /// not finite; [`Error::Invalid`] for an attitude of length zero.
    pub fn new(inertia: &Inertia, start: &BodyState) -> Result<Self, Error> {
        let BodyState { attitude, momentum } = *start;
        let attitude =
            crate::group::rotation::from_wxyz([attitude.w, attitude.i, attitude.j, attitude.k])?;
        let start = BodyState { attitude, momentum };
        let largest = momentum.amax();
        let scale = if largest > 0.0 { largest } else { 1.0 };
        let length = (momentum / scale).norm() * scale;
        let velocity = inertia.velocity(&momentum);
        let rate = length / inertia.principal_moments().min();
        for (what, value) in [("|H|/J", rate), ("Omega", velocity.sum())] {
            if !value.is_finite() {
                let [component, value] = [what.into(), value.to_string()];
                return Err(Error::Overflow { component, value });
            }
        }
        let unit = (momentum / scale).try_normalize(0.0).unwrap_or_default();
        let motion = turning(inertia, &unit, length).unwrap_or(Motion::Steady { velocity });
        Ok(FreeBody { inertia: inertia.clone(), start, length, motion })
    }

    /// The attitude and the momentum at a time, which may be negative.
    pub fn at(&self, time: f64) -> BodyState {
        let (frame, m, rest) = match &self.motion {
            Motion::Steady { velocity } => {
                let turn = So3.exp(&(velocity * time));
                return BodyState { attitude: self.start.attitude * turn, ..self.start };
            }
            Motion::Turning { frame, course } => {
                let ([a, b, c], rest) = course.at(time);
                (frame, Vector3::new(a, b, c).component_mul(&frame.amplitudes), rest)
            }
        };
        let half = 0.5 * (frame.rate * time + frame.factor * (rest - frame.rest));
        let spin = Vector3::new(0.0, 0.0, half.sin() * m.z.signum());
        let turn = frame.start * Quaternion::from_parts(half.cos(), spin) * shortest(&m);
        let turn = Quaternion::from_parts(turn.w, frame.axes * turn.imag());
        BodyState {
            attitude: UnitQuaternion::new_normalize(self.start.attitude.into_inner() * turn),
            momentum: frame.axes * m * self.length,
        }
    }

    /// The angular velocity `Omega` at a time, in body components.
    pub fn velocity(&self, time: f64) -> Vector3<f64> {
        self.inertia.velocity(&self.at(time).momentum)
    }

    /// The period of `H` and `Omega`. Returns `None` if they are constant, or on the separatrix.
    pub fn period(&self) -> Option<f64> {
        self.phase().map(|phase| phase.period)
    }

    /// A bound of the angular velocity, in radians per unit of time. It also bounds the time
    /// derivative of the argument of the elliptic functions.
    pub fn rate(&self) -> f64 {
        let energy = self.start.momentum.dot(&self.inertia.velocity(&self.start.momentum));
        let argument = match &self.motion {
            Motion::Steady { .. } => 0.0,
            // doubles the rate of v, because the argument is u = (1 + k1) v with k1 <= 1
            Motion::Turning { course: Course::Periodic { v, .. }, .. } => 2.0 * v[1].abs(),
            Motion::Turning { course: Course::Separatrix { u, .. }, .. } => u[1].abs(),
        };
        (energy / self.inertia.principal_moments().min()).sqrt().max(argument)
    }

    /// The rotation of the attitude in one period; `None` if there is no [`period`](Self::period).
    pub fn phase(&self) -> Option<Phase> {
        match &self.motion {
            Motion::Turning { course: Course::Periodic { phase, .. }, .. } => Some(*phase),
            _ => None,
        }
    }
}

/// The motion of a momentum of length 1; `None` if it is a steady rotation.
fn turning(inertia: &Inertia, unit: &Vector3<f64>, length: f64) -> Option<Motion> {
    let moments = inertia.principal_moments();
    let mut order = [0, 1, 2];
    order.sort_by(|&i, &j| moments[i].total_cmp(&moments[j]));
    let components = inertia.axes().tr_mul(unit);
    // the difference w_i - w_j
    let gap = |i: usize, j: usize| length * ((moments[j] - moments[i]) / moments[i] / moments[j]);
    // compares |m_c| sqrt(w_b - w_c) for both outer axes; c is the axis with the larger value
    let size = |c: usize| components[c].abs() * gap(order[1], c).abs().sqrt();
    let [mut a, b, mut c] = order;
    if size(a) > size(c) {
        (a, c) = (c, a);
    }
    let (inner, outer) = (size(a), size(c));
    if outer == 0.0 || (components[a] == 0.0 && components[b] == 0.0) {
        return None;
    }
    let (sum, whole, part) = (gap(a, c), gap(a, c).abs(), gap(b, c).abs());
    // both differences, in units of w_a - w_c
    let (upper, lower) = (gap(a, b).abs() / whole, part / whole);
    let column = |i: usize| inertia.axes().column(i).into_owned();
    let mut axes = Matrix3::from_columns(&[column(a), column(b), column(c)]);
    let mut m = Vector3::new(components[a], components[b], components[c]);
    if axes.determinant() < 0.0 {
        axes.column_mut(0).neg_mut();
        m.x = -m.x;
    }
    let amplitudes = Vector3::new(
        m.x.hypot(m.y * lower.sqrt()).copysign(m.x),
        m.y.hypot(m.x / lower.sqrt()),
        m.z.hypot(m.y * upper.sqrt()).copysign(m.z),
    );
    let [first, second, r] = [amplitudes.x.abs(), amplitudes.y, amplitudes.z.abs()];
    let speed =
        sum.signum() * amplitudes.z.signum() * m.x.signum() * whole.sqrt() * part.sqrt() * r;
    let beside = first * first / (1.0 + r); // equals 1 - r
    let start = [m.y / second, m.x.abs() / first, m.z.abs() / r];
    let mut frame = Frame {
        axes,
        amplitudes,
        start: shortest(&m).conjugate(),
        // equals w_c r + w_a (1 - r)
        rate: length * (r / moments[c] + beside / moments[a]),
        factor: 0.0,
        rest: 0.0,
    };
    let course = if outer - inner <= ON_SEPARATRIX * outer {
        let root = first / (1.0 + r);
        frame.rate = length / moments[b];
        frame.factor = -sum * first / speed * 2.0 * r;
        Course::Separatrix { u: [(start[0] / start[1]).asinh(), speed], root }
    } else {
        let complement = (outer - inner).sqrt() * (outer + inner).sqrt() / (r * part.sqrt());
        let modulus = first / r * (upper / lower).sqrt();
        let (k, complement) = gauss(modulus, complement);
        let jacobi = Jacobi::new(k, complement);
        let characteristic = k * beside / (1.0 + r);
        let quarter = third_kind([1.0, 0.0, complement], characteristic);
        frame.factor = sum * first * first / speed * (1.0 + k) * 2.0 * k * r / (1.0 + r).powi(2);
        let v = [first_kind(start) / (1.0 + k), speed / (1.0 + k)];
        let period = 4.0 * jacobi.quarter_period() / v[1].abs();
        let total = frame.rate * period + 4.0 * quarter * frame.factor.copysign(sum);
        let energy = m.x * m.x / moments[a] + m.y * m.y / moments[b] + m.z * m.z / moments[c];
        let dynamic = length * energy * period;
        let phase = Phase { period, total, dynamic, geometric: total - dynamic };
        let modulus = level(k, complement);
        Course::Periodic { jacobi, modulus, characteristic, quarter, v, phase }
    };
    frame.rest = course.at(0.0).1;
    Some(Motion::Turning { frame, course })
}

impl Course {
    /// The values `cn`, `sn`, `dn` at a time, and the periodic part of the integral.
    fn at(&self, time: f64) -> ([f64; 3], f64) {
        match self {
            Course::Periodic { jacobi, modulus, characteristic, quarter, v, .. } => {
                let v = v[0] + v[1] * time;
                let half = 2.0 * jacobi.quarter_period();
                let turns = (v / half).round();
                let sign = if turns.rem_euclid(2.0) == 0.0 { 1.0 } else { -1.0 };
                // limits the argument, because rounding errors may exceed a quarter period at huge
                // times
                let quarter_period = jacobi.quarter_period();
                let reduced = (v - turns * half).max(-quarter_period).min(quarter_period);
                let below = jacobi.at(reduced);
                let rest = 2.0 * turns * quarter + third_kind(below, *characteristic);
                let [sn, cn, dn] = raise(below, *modulus);
                ([sign * cn, sign * sn, dn], rest)
            }
            Course::Separatrix { u, root } => {
                let u = u[0] + u[1] * time;
                let sech = 1.0 / u.cosh();
                ([sech, u.tanh(), sech], (root * (0.5 * u).tanh()).atan())
            }
        }
    }
}

/// The shortest rotation from a vector `m` of length 1 to the third axis, or to the opposite of the
/// third axis if `m_c < 0`.
fn shortest(m: &Vector3<f64>) -> Quaternion<f64> {
    let sign = m.z.signum();
    Quaternion::new(1.0 + m.z.abs(), sign * m.y, -sign * m.x, 0.0).normalize()
}
