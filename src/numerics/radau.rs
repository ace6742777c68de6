//! The method of Radau for stiff equations.

use nalgebra::{DMatrix, DVector, Dyn, LU};

/// The Jacobian matrix of `f(t, y)` with respect to `y`, by differences. A component of `y` changes
/// by a small multiple of its size or of `units`, whichever is larger.
pub(crate) fn jacobian(
    f: &impl Fn(f64, &DVector<f64>) -> DVector<f64>,
    t: f64,
    y: &DVector<f64>,
    units: &DVector<f64>,
) -> DMatrix<f64> {
    let n = y.len();
    let mut matrix = DMatrix::zeros(n, n);
    for k in 0..n {
        let by = NUDGE * y[k].abs().max(units[k]);
        let at = |by: f64| {
            let mut moved = y.clone();
            moved[k] += by;
            f(t, &moved)
        };
        matrix.column_mut(k).copy_from(&((at(by) - at(-by)) / (2.0 * by)));
    }
    matrix
}

/// The relative change in a difference quotient.
const NUDGE: f64 = 1e-6;
/// The largest number of iterations of Newton's method in a step.
const ITERATIONS: usize = 10;

/// The method Radau IIA with three stages, of order 5. Stiff components that decay are damped: the
/// method is L-stable.
///
/// ```text
/// z_i = h sum_j a_ij f(t + c_j h, y + z_j),   y_1 = y + z_3
/// ```
///
/// E. Hairer and G. Wanner, *Solving Ordinary Differential Equations II* (1996), section IV.8.
pub(crate) struct Radau {
    /// The matrix `1 - h A x J` of Newton's method.
    newton: LU<f64, Dyn, Dyn>,
    /// The matrix `1 - h g J` of the error estimate, where `1/g` is the real eigenvalue of `A^-1`.
    filter: LU<f64, Dyn, Dyn>,
    /// The step.
    h: f64,
}

/// The real eigenvalue of the inverse matrix of coefficients.
const REAL: f64 = 3.637_834_252_744_496;

/// The times and the coefficients of the stages.
fn coefficients() -> ([f64; 3], [[f64; 3]; 3]) {
    let root = 6.0_f64.sqrt();
    let times = [(4.0 - root) / 10.0, (4.0 + root) / 10.0, 1.0];
    let matrix = [
        [(88.0 - 7.0 * root) / 360.0, (296.0 - 169.0 * root) / 1800.0, (3.0 * root - 2.0) / 225.0],
        [(296.0 + 169.0 * root) / 1800.0, (88.0 + 7.0 * root) / 360.0, (-2.0 - 3.0 * root) / 225.0],
        [(16.0 - root) / 36.0, (16.0 + root) / 36.0, 1.0 / 9.0],
    ];
    (times, matrix)
}

impl Radau {
    /// A step of length `h`, with a Jacobian matrix.
    pub fn new(jacobian: &DMatrix<f64>, h: f64) -> Self {
        let n = jacobian.nrows();
        let (_, a) = coefficients();
        let newton = DMatrix::from_fn(3 * n, 3 * n, |row, column| {
            let (i, j) = (row / n, column / n);
            f64::from(u8::from(row == column)) - h * a[i][j] * jacobian[(row % n, column % n)]
        });
        let filter = DMatrix::identity(n, n) - jacobian * (h / REAL);
        Radau { newton: newton.lu(), filter: filter.lu(), h }
    }

    /// The value after the step, and the estimated error. The parameter `slope` is `f(t, y)`, and
    /// `is_small` tells whether a change of `y` is negligible. Returns `None` if Newton's method does
    /// not converge.
    pub fn step(
        &self,
        f: &impl Fn(f64, &DVector<f64>) -> DVector<f64>,
        (t, y, slope): (f64, &DVector<f64>, &DVector<f64>),
        is_small: impl Fn(&DVector<f64>) -> bool,
    ) -> Option<(DVector<f64>, DVector<f64>)> {
        let (n, h) = (y.len(), self.h);
        let (times, a) = coefficients();
        let mut stages = DVector::zeros(3 * n);
        let mut last = f64::INFINITY;
        let mut is_done = false;
        for _ in 0..ITERATIONS {
            let slopes: Vec<DVector<f64>> =
                (0..3).map(|j| f(t + times[j] * h, &(y + stages.rows(j * n, n)))).collect();
            let mut residual = -stages.clone();
            for (i, row) in a.iter().enumerate() {
                for (slope, share) in slopes.iter().zip(row) {
                    residual.rows_mut(i * n, n).axpy(h * share, slope, 1.0);
                }
            }
            let change = self.newton.solve(&residual)?;
            stages += &change;
            let size = change.norm();
            is_done = (0..3).all(|j| is_small(&change.rows(j * n, n).into_owned()));
            if is_done || !size.is_finite() || size > 2.0 * last {
                break;
            }
            last = size;
        }
        if !is_done {
            return None;
        }
        let root = 6.0_f64.sqrt();
        let weights = [-13.0 - 7.0 * root, -13.0 + 7.0 * root, -1.0].map(|weight| weight / 3.0);
        let mut error = slope * h;
        for (j, weight) in weights.iter().enumerate() {
            error.axpy(*weight, &stages.rows(j * n, n), 1.0);
        }
        let mut error = self.filter.solve(&(error / REAL))?;
        if !is_small(&error) {
            // removes stiff components of the estimate
            let mut again = f(t, &(y + &error)) * h;
            for (j, weight) in weights.iter().enumerate() {
                again.axpy(*weight, &stages.rows(j * n, n), 1.0);
            }
            error = self.filter.solve(&(again / REAL))?;
        }
        Some((y + stages.rows(2 * n, n), error))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::dvector;

    /// The order is 5 for an equation that is not stiff, and the estimate bounds the error of a stiff
    /// one: `y' = -k (y - cos t) - sin t` with the solution `cos t`.
    #[test]
    fn order_and_stiffness() {
        let run = |k: f64, steps: usize| {
            let f = move |t: f64, y: &DVector<f64>| dvector![-k * (y[0] - t.cos()) - t.sin()];
            let h = 1.0 / steps as f64;
            let mut y = dvector![1.0];
            for step in 0..steps {
                let t = step as f64 * h;
                let radau = Radau::new(&jacobian(&f, t, &y, &dvector![1.0]), h);
                let slope = f(t, &y);
                let small = |x: &DVector<f64>| x.amax() < 1e-14;
                let Some((end, error)) = radau.step(&f, (t, &y, &slope), small) else { panic!() };
                assert!(error.amax() < 1e-2);
                y = end;
            }
            (y[0] - 1.0_f64.cos()).abs()
        };
        let ratio = run(1.0, 4) / run(1.0, 8);
        assert!((24.0..45.0).contains(&ratio), "{ratio}");
        assert!(run(1e6, 10) < 1e-9);
    }
}
