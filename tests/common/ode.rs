//! An independent reference for motions: DOP853 of the crate `differential-equations`.

use differential_equations::prelude::{ExplicitRungeKutta, IVP};
use nalgebra::DVector;

/// The solution of `y' = f(t, y)`, `y(start) = y0`, at the given times. Each of the times ends a
/// step.
pub fn solve(
    f: impl Fn(f64, &DVector<f64>) -> DVector<f64>,
    start: f64,
    y0: DVector<f64>,
    times: &[f64],
    tolerance: f64,
) -> Vec<DVector<f64>> {
    let right = |t: f64, y: &DVector<f64>, slope: &mut DVector<f64>| slope.copy_from(&f(t, y));
    let (mut t, mut y) = (start, y0);
    let to = |&end: &f64| {
        if end != t {
            let method = ExplicitRungeKutta::dop853().rtol(tolerance).atol(tolerance);
            let method = method.max_steps(50_000);
            let solved = IVP::ode_from_fn(right, t, end, y.clone()).method(method).solve().unwrap();
            (t, y) = (end, solved.y.last().unwrap().clone());
        }
        y.clone()
    };
    times.iter().map(to).collect()
}
