//! Steps as long as a tolerance allows.

use super::MuntheKaas;
use crate::Error;
use crate::dynamics::euler_poincare::{EulerPoincare, State, Torque};
use crate::group::LieGroup;

/// The pair of Dormand and Prince with its step size under control.
///
/// A step is kept if its estimated error, of the coordinates of the group and relative of the momentum, is below
/// the tolerance.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Adaptive {
    /// What the error of a step may be.
    pub tolerance: f64,
    /// The most steps between two times.
    pub max_steps: usize,
}

impl Adaptive {
    /// With a tolerance, and at most a million steps.
    pub fn new(tolerance: f64) -> Self {
        Adaptive { tolerance, max_steps: 1_000_000 }
    }

    /// The states at the given times, in their order; each ends a step.
    ///
    /// # Errors
    /// [`Error::Integration`] with the time that was reached.
    pub fn states<G: LieGroup, M: Torque<G>>(
        &self,
        system: &EulerPoincare<G, M>,
        start: &State<G>,
        times: &[f64],
    ) -> Result<Vec<State<G>>, Error> {
        let mut state = start.clone();
        // a first guess that the control corrects at once
        let mut step = self.tolerance.powf(0.2).min(0.1);
        let mut states = Vec::with_capacity(times.len());
        for &end in times {
            let mut steps = 0;
            while state.time != end {
                let left = end - state.time;
                let last = step >= left.abs();
                let h = if last { left } else { step.copysign(left) };
                let stopped =
                    |reason: &str| Error::Integration { t: state.time, reason: reason.to_string() };
                if !h.is_finite() || state.time + h == state.time {
                    return Err(stopped("the steps become too small"));
                }
                if steps == self.max_steps {
                    return Err(stopped("too many steps"));
                }
                steps += 1;
                let (next, error) = match MuntheKaas::DORMAND_PRINCE.advanced(system, &state, h) {
                    Ok((next, error)) if error.is_finite() => (next, error / self.tolerance),
                    // a shorter step may still be possible
                    _ => {
                        step = 0.2 * h.abs();
                        continue;
                    }
                };
                let factor = (0.9 * error.powf(-0.2)).clamp(0.2, 5.0);
                if error <= 1.0 {
                    state = State { time: if last { end } else { next.time }, ..next };
                }
                if !last || error > 1.0 {
                    step = h.abs() * factor;
                }
            }
            states.push(state.clone());
        }
        Ok(states)
    }
}
