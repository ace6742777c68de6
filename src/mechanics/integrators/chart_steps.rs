//! Step-size control for curves on charts.

use super::Adaptive;
use crate::Error;
use crate::mechanics::stopped;
use crate::mechanics::systems::chart::{ChartState, ChartSystem};
use crate::numerics::ode::{LEAST_STEP, stages};
use crate::numerics::tableaux::combined_error;
use nalgebra::DVector;

/// The rounding error of a coordinate, relative to the coordinate.
const ROUNDING: f64 = 4.0 * f64::EPSILON;

/// The method of order 8 of Dormand and Prince for curves on charts, with step-size control.
///
/// Errors are compared by the metric, in the sizes `sqrt|g_ii|` of the coordinate vectors. So steps
/// do not depend on the units of the coordinates and of the parameter, or on the origin. Let `r` be
/// the tolerance. The error of the position is at most `r` of the path in the step, and the error
/// of the velocity at most `r` of the velocity. Coordinates with negative `g_ii` are compared apart
/// from the others, because a slow particle moves much further in time than in space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ChartSteps(pub Adaptive);

impl ChartSteps {
    /// The first step size to try from a state, for a run of length `span`.
    pub(crate) fn first_step(&self, system: &ChartSystem, state: &ChartState) -> f64 {
        let Adaptive { tolerance, span, max_step, .. } = self.0;
        let guess = tolerance.powf(0.125) / system.rate(state);
        let longest = if span.is_finite() { span } else { 1.0 };
        if guess > 0.0 { guess.min(longest).min(max_step) } else { longest.min(max_step) }
    }

    /// Makes one accepted step from a state towards `end`; see [`Adaptive::step`].
    ///
    /// # Errors
    /// [`Error::CurveEnds`] if the curve cannot be continued; [`Error::Integration`] if the end is
    /// not finite.
    pub fn step(
        &self,
        system: &ChartSystem,
        state: &mut ChartState,
        next: &mut f64,
        end: f64,
    ) -> Result<(), Error> {
        let Adaptive { tolerance, max_step, .. } = self.0;
        if !end.is_finite() {
            return Err(stopped(state.parameter, format!("the end is {end}, which is not finite")));
        }
        system.forget();
        let slope = system.slope(&state.numbers);
        let sizes = system.sizes(&state.numbers);
        loop {
            let left = end - state.parameter;
            *next = next.min(max_step);
            let last = *next >= left.abs();
            let h = if last { left } else { next.copysign(left) };
            let is_lost = state.parameter + h == state.parameter;
            let is_rounding = !last && h.abs() < LEAST_STEP * state.parameter.abs();
            if !h.is_finite() || is_lost || is_rounding || *next == 0.0 {
                return Err(system.ends(state));
            }
            let f = |_: f64, numbers: &DVector<f64>| system.slope(numbers);
            let (reached, errors) = stages(&f, state.parameter, &state.numbers, &slope, h);
            let allowed = Allowed::new(&sizes, &state.numbers, &reached, h, tolerance);
            let error = combined_error(errors.map(|error| allowed.ratio(&error)));
            // tries a shorter step, which may still stay on the chart
            if !error.is_finite() || !reached.iter().all(|value| value.is_finite()) {
                *next = 0.2 * h.abs();
                continue;
            }
            if !last || error > 1.0 {
                *next = h.abs() * (0.9 * error.powf(-0.125)).clamp(0.2, 5.0);
            }
            if error <= 1.0 {
                let parameter = if last { end } else { state.parameter + h };
                // a point beyond the edge of the chart is rejected, also at the end of a step
                if !system.slope(&reached)[sizes.len()].is_finite() {
                    *next = 0.2 * h.abs();
                    continue;
                }
                *state = ChartState { parameter, numbers: reached };
                return Ok(());
            }
        }
    }
}

/// The errors that a step may have: of coordinates along which the metric is negative, and of the
/// other coordinates.
struct Allowed<'s> {
    sizes: &'s DVector<f64>,
    position: [f64; 2],
    velocity: [f64; 2],
    length: f64,
}

impl<'s> Allowed<'s> {
    fn new(
        sizes: &'s DVector<f64>,
        start: &DVector<f64>,
        end: &DVector<f64>,
        h: f64,
        tolerance: f64,
    ) -> Self {
        let n = sizes.len();
        let [first, last] = [start, end].map(|numbers| size(sizes, numbers, n));
        let speed = [0, 1].map(|sign| first[sign].max(last[sign]));
        let whole = speed[0].max(speed[1]);
        let rounding = size(sizes, start, 0).map(|size| ROUNDING * size);
        let path = speed.map(|speed| tolerance * h.abs() * speed);
        // the rounding error of a coordinate acts as a force, also on a particle that is at rest in
        // these coordinates
        let noise = rounding.map(|error| (error / h.abs()).min(tolerance * whole));
        let length = ROUNDING * start.get(2 * n).map_or(0.0, |length| length.abs());
        Allowed {
            sizes,
            position: [0, 1].map(|sign| path[sign].max(rounding[sign])),
            velocity: [0, 1].map(|sign| (tolerance * speed[sign]).max(noise[sign])),
            length: (tolerance * h.abs() * whole).max(length),
        }
    }

    /// The error in units of the allowed error.
    fn ratio(&self, error: &DVector<f64>) -> f64 {
        let n = self.sizes.len();
        let part = |error: f64, allowed: f64| if error == 0.0 { 0.0 } else { error / allowed };
        let [position, velocity] = [size(self.sizes, error, 0), size(self.sizes, error, n)];
        let length = error.get(2 * n).map_or(0.0, |error| part(error.abs(), self.length));
        let parts = [0, 1].into_iter().flat_map(|sign| {
            [part(position[sign], self.position[sign]), part(velocity[sign], self.velocity[sign])]
        });
        // a NaN must remain, so that the step is rejected
        parts.fold(length, |most, other| if other > most || other.is_nan() { other } else { most })
    }
}

/// The size of the components from the index `from`: of those with a negative size, and of the
/// others.
fn size(sizes: &DVector<f64>, numbers: &DVector<f64>, from: usize) -> [f64; 2] {
    let mut squares = [0.0, 0.0];
    for (i, size) in sizes.iter().enumerate() {
        squares[usize::from(*size >= 0.0)] += (size * numbers[from + i]).powi(2);
    }
    squares.map(f64::sqrt)
}
