//! Ordinary differential equations to a tolerance, by Dormand and Prince's method of order 8.

use crate::Error;
use differential_equations::error::Error as OdeError;
use differential_equations::prelude::{ExplicitRungeKutta, IVP};
use nalgebra::DVector;

/// The most steps between two times.
const MAX_STEPS: usize = 50_000;

/// The solution of `y' = f(t, y)`, `y(start) = y0`, at the given times, in their order.
///
/// Each time ends a step, so that the values are as good as the steps, and `tolerance` bounds the
/// error of a step, relative and absolute. Times may run backwards.
///
/// ```
/// use affinor::ode::solve;
/// use nalgebra::dvector;
/// let f = |_: f64, y: &nalgebra::DVector<f64>| dvector![y[1], -y[0]];
/// let half_turn = solve(f, 0.0, dvector![1.0, 0.0], &[std::f64::consts::PI], 1e-12)?;
/// assert!((half_turn[0][0] + 1.0).abs() < 1e-11);
/// # Ok::<(), affinor::Error>(())
/// ```
///
/// # Errors
/// [`Error::Integration`] with the time where it stops: the solution grows without bound, the problem is stiff,
/// or a value is not finite.
pub fn solve(
    f: impl Fn(f64, &DVector<f64>) -> DVector<f64>,
    start: f64,
    y0: DVector<f64>,
    times: &[f64],
    tolerance: f64,
) -> Result<Vec<DVector<f64>>, Error> {
    let (mut t, mut y) = (start, y0);
    let mut values = Vec::with_capacity(times.len());
    for &end in times {
        if !end.is_finite() {
            return Err(Error::Integration { t, reason: format!("{end} is no time") });
        }
        if end != t {
            y = step(&f, t, end, y, tolerance)?;
            t = end;
        }
        values.push(y.clone());
    }
    Ok(values)
}

fn step(
    f: &impl Fn(f64, &DVector<f64>) -> DVector<f64>,
    start: f64,
    end: f64,
    y0: DVector<f64>,
    tolerance: f64,
) -> Result<DVector<f64>, Error> {
    let right = |t: f64, y: &DVector<f64>, slope: &mut DVector<f64>| slope.copy_from(&f(t, y));
    let method = ExplicitRungeKutta::dop853().rtol(tolerance).atol(tolerance).max_steps(MAX_STEPS);
    let stop = |t: f64, reason: &str| Error::Integration { t, reason: reason.into() };
    if f(start, &y0).iter().any(|slope| !slope.is_finite()) {
        return Err(stop(start, "the right side is not finite"));
    }
    let solution = IVP::ode_from_fn(right, start, end, y0).method(method).solve();
    let solution = solution.map_err(|error| match error {
        OdeError::MaxSteps { t, .. } => stop(t, "too many steps"),
        OdeError::StepSize { t, .. } => stop(t, "the steps become too small: a pole"),
        OdeError::Stiffness { t, .. } => stop(t, "the equations are stiff"),
        other => stop(start, &format!("{other:?}")),
    })?;
    match solution.y.last() {
        Some(y) if y.iter().all(|y| y.is_finite()) => Ok(y.clone()),
        _ => Err(stop(end, "the solution is not finite")),
    }
}
