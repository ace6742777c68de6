//! Means of group elements.

use super::{Coordinates, LieGroup};
use crate::Error;
use affinor_tensors::stop::checkpoint;

/// The largest number of iterations.
const MAX_STEPS: usize = 100;

/// A step counts as rounding error if its size, relative to the largest logarithm of the first
/// iteration, is at most this value.
const ROUNDING: f64 = 1e-14;

/// Iterates `m <- m exp(sum log(m^-1 g_i)/n)` until the step is of the size of rounding errors.
pub(super) fn mean<G: LieGroup + ?Sized>(
    group: &G,
    elements: &[G::Element],
) -> Result<G::Element, Error> {
    let Some(first) = elements.first() else {
        let (expected, found) = ("at least one".into(), "none".into());
        return Err(Error::Shape { what: "elements of a mean", expected, found });
    };
    let mut mean = first.clone();
    let (mut spread, mut before) = (0.0_f64, f64::INFINITY);
    for step in 0..MAX_STEPS {
        let mut sum = G::Vector::zeros(group.dimension());
        for g in elements {
            checkpoint();
            let log = group.log(&group.between(&mean, g))?;
            if step == 0 {
                spread = spread.max(log.largest());
            }
            sum = sum + log;
        }
        let correction = sum * (1.0 / elements.len() as f64);
        if !correction.is_finite() {
            return Err(no_mean(step + 1, f64::NAN));
        }
        let size = correction.largest();
        // the rounding error of the mean itself, which is large if the elements are far from the
        // identity
        let own = 1e3 * f64::EPSILON * group.matrix(&mean).amax();
        mean = group.project(group.compose(&mean, &group.exp(&correction)));
        // also ends if the steps no longer decrease, because the rounding errors of the logarithms
        // remain
        if size <= ROUNDING * spread || (size <= own.max(1e6 * ROUNDING * spread) && size >= before)
        {
            return Ok(mean);
        }
        before = size;
    }
    Err(no_mean(MAX_STEPS, before))
}

fn no_mean(steps: usize, size: f64) -> Error {
    let reason = format!("after {steps} iterations the mean logarithm still has the size {size:e}");
    Error::Invalid { what: "mean", reason }
}
