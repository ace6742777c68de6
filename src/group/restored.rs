//! Finds the element of a group that is nearest to a matrix, for example to a rotation matrix
//! rounded to three digits.

use super::matrices::expect_shape;
use super::{Coordinates, MatrixNotation};
use crate::Error;
use affinor_tensors::stop::checkpoint;
use nalgebra::{DMatrix, DVector};

/// The largest accepted distance of an entry of a matrix from the group, relative to the entry if
/// it exceeds 1.
pub const RESTORABLE: f64 = 0.1;

/// The largest number of steps of the Levenberg-Marquardt method.
const STEPS: usize = 200;

/// The step of the finite differences that approximate derivatives.
const DIFFERENCE: f64 = 1e-6;

/// The length of the vectors whose exponentials serve as further initial guesses. They are needed
/// because the identity may be a stationary point of the distance that is not a minimum, for
/// example for a half turn.
const GUESS: f64 = 2.0;

/// The element of a group whose written form is nearest to a matrix, and the largest difference of
/// an entry.
///
/// The element minimizes the sum of the squares of all differences, by the method of Levenberg and
/// Marquardt. The iterations start from the identity, and from exponentials of basis vectors.
///
/// ```
/// use affinor::group::{restored, So3, LieGroup};
/// use nalgebra::DMatrix;
/// let rounded = DMatrix::from_row_slice(3, 3, &[0.866, -0.5, 0.0, 0.5, 0.866, 0.0, 0.0, 0.0, 1.0]);
/// let (g, distance) = restored(&So3, &rounded)?;
/// assert!(distance < 1e-4 && (So3.log(&g)?.z - 0.5_f64.atan2(0.866)).abs() < 1e-12);
/// # Ok::<(), affinor::Error>(())
/// ```
///
/// # Errors
/// [`Error::Shape`]; [`Error::Invalid`] for entries that are not finite, or, with the distance, if
/// the distance exceeds [`RESTORABLE`].
pub fn restored<G: MatrixNotation>(
    group: &G,
    matrix: &DMatrix<f64>,
) -> Result<(G::Element, f64), Error> {
    expect_shape(matrix, group.write(&group.identity()).shape())?;
    let refused = |reason: String| Err(Error::Invalid { what: "element of the group", reason });
    if let Some(value) = matrix.iter().find(|value| !value.is_finite()) {
        return refused(format!("it has the entry {value}"));
    }
    let directions = group.basis().into_iter().flat_map(|x| [x.clone() * GUESS, x * -GUESS]);
    let guesses = std::iter::once(group.identity()).chain(directions.map(|x| group.exp(&x)));
    let mut least = f64::INFINITY;
    for guess in guesses {
        let nearest = nearest(group, guess, matrix);
        let differences = group.write(&nearest) - matrix;
        let pairs = || differences.iter().zip(matrix);
        // a NaN is not accepted, because the comparison is then false
        if pairs().all(|(off, entry)| off.abs() <= RESTORABLE * entry.abs().max(1.0)) {
            return Ok((nearest, differences.amax()));
        }
        let distance = differences.amax();
        least = if distance < least { distance } else { least };
    }
    refused(format!("the nearest element found differs by {least:.2e} in an entry"))
}

/// A local minimum of the distance `|g - m|`, found from an initial guess.
fn nearest<G: MatrixNotation>(group: &G, guess: G::Element, m: &DMatrix<f64>) -> G::Element {
    let off = |g: &G::Element| DVector::from_column_slice((m - group.write(g)).as_slice());
    let n = group.dimension();
    let (mut g, mut damping) = (guess, 1e-3);
    let mut rest = off(&g);
    for _ in 0..STEPS {
        checkpoint();
        let slopes = slopes(group, &g, rest.len());
        let (square, gradient) = (slopes.tr_mul(&slopes), slopes.tr_mul(&rest));
        let mut damped = square.clone();
        (0..n).for_each(|at| damped[(at, at)] += damping * (square[(at, at)] + f64::EPSILON));
        let Some(step) = damped.cholesky().map(|factors| factors.solve(&gradient)) else {
            damping *= 10.0;
            continue;
        };
        let moved = group.compose(&g, &group.exp(&Coordinates::from_components(step.as_slice())));
        let next = off(&moved);
        // smaller steps change the distance by less than rounding errors
        let settled = step.amax() <= 1e-9;
        if settled || next.norm() < rest.norm() {
            (g, rest, damping) = (moved, next, damping * 0.1);
        } else {
            damping *= 10.0;
        }
        let ends = damping.is_nan() || damping >= 1e12 || (settled && damping < 1e-9);
        if step.amax() <= 4.0 * f64::EPSILON || ends {
            break;
        }
    }
    g
}

/// The derivatives of the written form of `g exp(x)` at `x = 0`, one column for each basis vector.
fn slopes<G: MatrixNotation>(group: &G, g: &G::Element, rows: usize) -> DMatrix<f64> {
    let mut slopes = DMatrix::zeros(rows, group.dimension());
    for (x, mut column) in group.basis().into_iter().zip(slopes.column_iter_mut()) {
        checkpoint();
        let at = |step: f64| group.write(&group.compose(g, &group.exp(&(x.clone() * step))));
        let difference = (at(DIFFERENCE) - at(-DIFFERENCE)) / (2.0 * DIFFERENCE);
        column.copy_from_slice(difference.as_slice());
    }
    slopes
}
