//! Euler angles, which are canonical coordinates of the second kind. A rotation is a product of
//! rotations about coordinate axes.

use crate::Error;
use nalgebra::{Quaternion, UnitQuaternion};
use std::f64::consts::{FRAC_PI_2, PI, TAU};
use std::str::FromStr;

/// A coordinate axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Axis {
    /// The first axis.
    X,
    /// The second axis.
    Y,
    /// The third axis.
    Z,
}

/// The frame in which the axes of the rotations are fixed: the body or space.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum AxesFrame {
    /// The axes of the body, which the earlier rotations have rotated: `R = R_1(a) R_2(b) R_3(c)`.
    Intrinsic,
    /// The axes of space: `R = R_3(c) R_2(b) R_1(a)`.
    Extrinsic,
}

/// A sequence of three axes, in which consecutive axes differ. There are 12 sequences of axes, and
/// each is intrinsic or extrinsic.
///
/// The intrinsic products `exp(a e_1) exp(b e_2) exp(c e_3)` are the canonical coordinates of the
/// second kind of SO(3). As text, `ZYX` is intrinsic, and `zyx` is extrinsic.
///
/// ```
/// use affinor::group::rotation::{GimbalLock, Sequence, from_wxyz};
/// let aerospace: Sequence = "ZYX".parse()?; // yaw, pitch, roll
/// let found = aerospace.angles(&aerospace.rotation([0.3, -0.2, 0.1]));
/// assert!((found.angles[1] + 0.2).abs() < 1e-15 && found.lock.is_none());
///
/// let up = from_wxyz([1.0, 0.0, 1.0, 0.0])?; // pitch of a quarter turn: gimbal lock
/// assert_eq!(aerospace.angles(&up).lock, Some(GimbalLock::Difference));
/// assert_eq!(aerospace.angles(&up).angles[2], 0.0);
/// # Ok::<(), affinor::Error>(())
/// ```
#[doc(alias("Euler angles", "Cardan angles", "roll pitch yaw"))]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Sequence {
    axes: [Axis; 3],
    turns: AxesFrame,
}

/// Euler angles, with the ambiguity at gimbal lock.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EulerAngles {
    /// The angles in radians, in the order of the sequence. The first and the last angle are in
    /// `[-pi, pi]`. The middle angle is in `[0, pi]` if the first and the last axis are equal;
    /// otherwise it is in `[-pi/2, pi/2]`.
    pub angles: [f64; 3],
    /// The gimbal lock, if the rotation determines only one combination of the first and the last
    /// angle. In this case, the last angle is 0 by convention.
    pub lock: Option<GimbalLock>,
}

/// Gimbal lock, described by the combination of the first and the last angle that the rotation
/// determines.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum GimbalLock {
    /// The sum of the first and the last angle.
    Sum,
    /// The difference of the first and the last angle.
    Difference,
}

/// The rounding error of the sine of half an angle.
const ROUNDING: f64 = 16.0 * f64::EPSILON;

impl Sequence {
    /// A sequence of rotations about these axes.
    ///
    /// # Errors
    /// [`Error::Invalid`] if consecutive axes are equal, because two rotations about one axis
    /// combine to a single rotation.
    pub fn new(axes: [Axis; 3], turns: AxesFrame) -> Result<Self, Error> {
        if axes[0] == axes[1] || axes[1] == axes[2] {
            let reason =
                format!("two consecutive axes of {axes:?} are equal, so two angles act as one");
            return Err(Error::Invalid { what: "Euler angles", reason });
        }
        Ok(Sequence { axes, turns })
    }

    /// All 24 sequences: 12 are intrinsic, and 12 are extrinsic.
    pub fn all() -> impl Iterator<Item = Sequence> {
        let axes = [Axis::X, Axis::Y, Axis::Z];
        let triples = (0..27).map(move |n| [axes[n / 9], axes[n / 3 % 3], axes[n % 3]]);
        triples.flat_map(|axes| {
            [AxesFrame::Intrinsic, AxesFrame::Extrinsic]
                .map(|turns| Sequence::new(axes, turns))
                .into_iter()
                .flatten()
        })
    }

    /// The rotation by the angles `[a, b, c]` in radians: `R_1(a) R_2(b) R_3(c)` for intrinsic
    /// rotations, and `R_3(c) R_2(b) R_1(a)` for extrinsic rotations, where `R_k` rotates about
    /// axis `k` of the sequence.
    pub fn rotation(&self, angles: [f64; 3]) -> UnitQuaternion<f64> {
        let turn = |k: usize| {
            let (sin, cos) = (0.5 * angles[k]).sin_cos();
            let mut q = Quaternion::new(cos, 0.0, 0.0, 0.0);
            q[self.axes[k] as usize] = sin;
            UnitQuaternion::new_unchecked(q)
        };
        match self.turns {
            AxesFrame::Intrinsic => turn(0) * turn(1) * turn(2),
            AxesFrame::Extrinsic => turn(2) * turn(1) * turn(0),
        }
    }

    /// The angles of a rotation.
    ///
    /// The arguments of two complex numbers are half the sum and half the difference of the first
    /// and the last angle. The middle angle follows from the moduli of these numbers (E. Bernardes
    /// and S. Viollet, *PLoS ONE* 17 (2022) e0276302).
    pub fn angles(&self, g: &UnitQuaternion<f64>) -> EulerAngles {
        let intrinsic = self.turns == AxesFrame::Intrinsic;
        // converts intrinsic rotations to extrinsic rotations in the opposite order
        let [first, middle, last] = self.axes.map(|axis| axis as usize);
        let (i, j, end) = if intrinsic { (last, middle, first) } else { (first, middle, last) };
        let proper = i == end;
        let k = 3 - i - j;
        let sign = if (j + 3 - i) % 3 == 1 { 1.0 } else { -1.0 };
        let q = g.coords;
        let (a, b, c, d) = if proper {
            (q[3], q[i], q[j], sign * q[k])
        } else {
            // applies a quarter turn about the middle axis, which yields a sequence whose first and
            // last axes are equal
            (q[3] - q[j], q[i] + sign * q[k], q[j] + q[3], sign * q[k] - q[i])
        };
        let (of_sum, of_difference) = (a.hypot(b), c.hypot(d));
        let (mut sum, mut difference) = (b.atan2(a), d.atan2(c));
        let length = of_sum.hypot(of_difference);
        let mut lock = None;
        if of_difference <= ROUNDING * length {
            difference = if intrinsic { sum } else { -sum };
            lock = Some(GimbalLock::Sum);
        } else if of_sum <= ROUNDING * length {
            sum = if intrinsic { difference } else { -difference };
            lock = Some(GimbalLock::Difference);
        }
        let mut angles = [sum - difference, 2.0 * of_difference.atan2(of_sum), sum + difference];
        if !proper {
            angles[1] -= FRAC_PI_2;
            angles[2] *= sign;
            if sign < 0.0 {
                lock = lock.map(GimbalLock::other);
            }
        }
        if intrinsic {
            angles.swap(0, 2);
        }
        for at in [0, 2] {
            angles[at] = wrapped(angles[at]);
        }
        EulerAngles { angles, lock }
    }
}

impl GimbalLock {
    fn other(self) -> Self {
        match self {
            GimbalLock::Sum => GimbalLock::Difference,
            GimbalLock::Difference => GimbalLock::Sum,
        }
    }
}

/// Wraps an angle to `[-pi, pi]`. The angle must be less than two turns away from this interval.
fn wrapped(angle: f64) -> f64 {
    if angle > PI {
        angle - TAU
    } else if angle < -PI {
        angle + TAU
    } else {
        angle
    }
}

impl FromStr for Sequence {
    type Err = Error;

    fn from_str(text: &str) -> Result<Self, Error> {
        let turns = if text.starts_with(char::is_uppercase) {
            AxesFrame::Intrinsic
        } else {
            AxesFrame::Extrinsic
        };
        let letters = if turns == AxesFrame::Intrinsic { "XYZ" } else { "xyz" };
        let axis = |c: char| letters.find(c).map(|at| [Axis::X, Axis::Y, Axis::Z][at]);
        let axes: Option<Vec<Axis>> = text.chars().map(axis).collect();
        let axes = axes.and_then(|axes| <[Axis; 3]>::try_from(axes).ok());
        let axes = axes.ok_or_else(|| Error::Invalid {
            what: "Euler angles",
            reason: format!(
                "`{text}` is not three letters of XYZ (intrinsic) or of xyz (extrinsic)"
            ),
        })?;
        Sequence::new(axes, turns)
    }
}
