//! Initial value problems in R^n, solved to a tolerance.

use super::tableaux::{DormandPrince8, Tableau, Tabulated, combined_error};
use crate::Error;
use affinor_tensors::stop::checkpoint;
use nalgebra::DVector;

/// The smallest step, relative to the time. In a shorter step, rounding would make the times of the
/// stages coincide.
pub(crate) const LEAST_STEP: f64 = 16.0 * f64::EPSILON;

/// The largest number of steps between two output times.
const MAX_STEPS: usize = 50_000;

/// Solves `y' = f(t, y)`, `y(start) = y0`. Returns the solution at the given times, in the same
/// order.
///
/// The method is [`DormandPrince8`] with step-size control. The parameter `tolerance` bounds the
/// relative and the absolute error of a step. A step ends at each output time, so no value is
/// interpolated. Times may decrease.
pub(crate) fn solve(
    f: impl Fn(f64, &DVector<f64>) -> DVector<f64>,
    start: f64,
    y0: DVector<f64>,
    times: &[f64],
    tolerance: f64,
) -> Result<Vec<DVector<f64>>, Error> {
    solve_within(MAX_STEPS, f, start, y0, times, tolerance)
}

/// The solution of [`solve`], with at most `steps` steps between two output times.
pub(crate) fn solve_within(
    steps: usize,
    f: impl Fn(f64, &DVector<f64>) -> DVector<f64>,
    start: f64,
    y0: DVector<f64>,
    times: &[f64],
    tolerance: f64,
) -> Result<Vec<DVector<f64>>, Error> {
    if tolerance.is_nan() || tolerance <= 0.0 {
        return Err(stop(start, &format!("the tolerance {tolerance} is not positive")));
    }
    let (mut t, mut y) = (start, y0);
    let mut values = Vec::with_capacity(times.len());
    for &end in times {
        if !end.is_finite() {
            return Err(stop(t, &format!("the time {end} is not finite")));
        }
        if end != t {
            y = advance(steps, &f, t, end, y, tolerance)?;
            t = end;
        }
        values.push(y.clone());
    }
    Ok(values)
}

fn stop(t: f64, reason: &str) -> Error {
    Error::Integration { t, reason: reason.into() }
}

/// Advances the solution to `end`, with as many steps as the tolerance requires.
fn advance(
    steps: usize,
    f: &impl Fn(f64, &DVector<f64>) -> DVector<f64>,
    start: f64,
    end: f64,
    mut y: DVector<f64>,
    tolerance: f64,
) -> Result<DVector<f64>, Error> {
    let mut t = start;
    let mut slope = f(t, &y);
    if !slope.iter().all(|slope| slope.is_finite()) {
        return Err(stop(t, "the right side is not finite"));
    }
    // the first step is a hundredth of the time in which y would change by its own size
    let [size, speed] = [&y, &slope].map(|v| norm(v, &y, &y, tolerance));
    let mut next = if size > 1e-5 && speed > 1e-5 { 0.01 * size / speed } else { 1e-6 };
    for _ in 0..steps {
        checkpoint();
        let left = end - t;
        let last = next >= left.abs();
        let h = if last { left } else { next.copysign(left) };
        if t + h == t || (!last && h.abs() < LEAST_STEP * t.abs()) {
            return Err(stop(t, "the steps become too small: a pole"));
        }
        let (reached, error) = step(f, t, &y, &slope, h, tolerance);
        // tries a shorter step, which may still have finite values
        let factor = if error.is_finite() { 0.9 * error.powf(-0.125) } else { 0.0 };
        next = h.abs() * factor.clamp(0.2, 5.0);
        if error <= 1.0 {
            if last {
                return Ok(reached);
            }
            (t, y) = (t + h, reached);
            slope = f(t, &y);
        }
    }
    Err(stop(t, "too many steps: the equations are stiff, or output times are far apart"))
}

/// The root mean square of the components, in units of their tolerance. The tolerance is for a
/// solution between `y` and `z`.
fn norm(v: &DVector<f64>, y: &DVector<f64>, z: &DVector<f64>, tolerance: f64) -> f64 {
    let scale = |i: usize| tolerance * (1.0 + y[i].abs().max(z[i].abs()));
    let squares = v.iter().enumerate().map(|(i, v)| (v / scale(i)).powi(2));
    (squares.sum::<f64>() / v.len().max(1) as f64).sqrt()
}

/// The value after a step of length `h`, and the estimated error in units of the tolerance.
fn step(
    f: &impl Fn(f64, &DVector<f64>) -> DVector<f64>,
    t: f64,
    y: &DVector<f64>,
    slope: &DVector<f64>,
    h: f64,
    tolerance: f64,
) -> (DVector<f64>, f64) {
    let (reached, errors) = stages(f, t, y, slope, h);
    let errors = errors.map(|error| norm(&error, y, &reached, tolerance));
    (reached, combined_error(errors))
}

/// The value after a step of length `h`, and the differences to the two embedded methods. The
/// parameter `slope` is the right side at the start of the step.
pub(crate) fn stages(
    f: &impl Fn(f64, &DVector<f64>) -> DVector<f64>,
    t: f64,
    y: &DVector<f64>,
    slope: &DVector<f64>,
    h: f64,
) -> (DVector<f64>, [DVector<f64>; 2]) {
    let Tableau { a, b, c, errors, .. } = DormandPrince8::TABLEAU;
    let sum = |slopes: &[DVector<f64>], weights: &[f64], start: DVector<f64>| {
        let terms = slopes.iter().zip(weights).filter(|(_, weight)| **weight != 0.0);
        terms.fold(start, |mut sum, (slope, weight)| {
            sum.axpy(h * weight, slope, 1.0);
            sum
        })
    };
    let mut slopes = vec![slope.clone()];
    for (row, c) in a.iter().zip(c).skip(1) {
        slopes.push(f(t + c * h, &sum(&slopes, row, y.clone())));
    }
    let zero = DVector::zeros(y.len());
    let errors = errors.map(|weights| sum(&slopes, &weights, zero.clone()));
    (sum(&slopes, &b, y.clone()), errors)
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::dvector;

    fn rotation(_: f64, y: &DVector<f64>) -> DVector<f64> {
        dvector![y[1], -y[0]]
    }

    #[test]
    fn a_rotation_to_its_tolerance_forwards_and_backwards() -> Result<(), Error> {
        for (tolerance, bound) in [(1e-6, 1e-5), (1e-9, 1e-8), (1e-13, 1e-11)] {
            let times = [1.0, -20.0, 0.0, 0.0];
            let values = solve(rotation, 0.0, dvector![1.0, 0.0], &times, tolerance)?;
            for (t, y) in times.iter().zip(&values) {
                let off = (y - dvector![t.cos(), -t.sin()]).amax();
                assert!(off < bound, "off by {off:e} at t = {t} with tolerance {tolerance:e}");
            }
        }
        Ok(())
    }

    #[test]
    fn reasons_for_an_early_end() {
        let stop = |f: fn(f64, &DVector<f64>) -> DVector<f64>, end: f64| match solve(
            f,
            0.0,
            dvector![1.0, 0.0],
            &[end],
            1e-9,
        ) {
            Err(Error::Integration { t, reason }) => (t, reason),
            other => panic!("{other:?}"),
        };
        let reason = |f, end| stop(f, end).1;
        assert!(reason(rotation, f64::NAN).contains("not finite"));
        assert!(reason(|_, y| y / 0.0, 1.0).contains("right side"));
        // the solution of y' = y^2 has a pole at t = 1
        let (t, pole) = stop(|_, y| y.component_mul(y), 2.0);
        assert!((t - 1.0).abs() < 1e-8 && pole.contains("a pole"), "{pole} at t = {t}");
        assert!(reason(|t, y| rotation(t, y) * 1e7, 1e3).contains("too many steps"));
    }
}
