//! Accurate derivatives of functions that are given by their values.

use nalgebra::DVector;
use std::f64::consts::PI;

/// The number of pairs of nodes of a Chebyshev series.
const PAIRS: usize = 12;

/// The derivative of an analytic function at 0, from its Chebyshev series on the interval from `-half`
/// to `half`. The interval begins with the first value of `widths`. It is halved until the series ends
/// within rounding errors, but not below the second value. The interval with the smallest estimated
/// error counts. Values may be NaN far from 0.
///
/// L. N. Trefethen, *Approximation Theory and Approximation Practice* (2013), chapter 8.
pub(crate) fn derivative(
    value: impl Fn(f64) -> DVector<f64>,
    [widest, narrowest]: [f64; 2],
) -> DVector<f64> {
    let angles: [f64; PAIRS] = std::array::from_fn(|j| PI * (j as f64 + 0.5) / (2 * PAIRS) as f64);
    let (mut half, mut least, mut best) = (widest, f64::INFINITY, None);
    while half >= narrowest {
        let mut size = 0.0_f64;
        let odd = angles.map(|angle| {
            let [after, before] = [1.0, -1.0].map(|sign| value(sign * half * angle.cos()));
            size = size.max(after.amax()).max(before.amax());
            (after - before) * 0.5
        });
        let mut slope = DVector::zeros(odd[0].len());
        let mut tail = 0.0_f64;
        // the derivative of the polynomial T_k at 0 is k for k = 1, 5, ... and -k for k = 3, 7, ...
        for k in (1..2 * PAIRS).step_by(2) {
            let terms = odd.iter().zip(&angles).map(|(odd, angle)| odd * (k as f64 * angle).cos());
            let coefficient = terms.sum::<DVector<f64>>() * (2.0 / PAIRS as f64);
            let sign = if k % 4 == 1 { 1.0 } else { -1.0 };
            slope += &coefficient * (sign * k as f64 / half);
            if k + 4 > 2 * PAIRS {
                tail = tail.max(coefficient.amax());
            }
        }
        let error = (tail + f64::EPSILON * size) / half;
        let is_finite = slope.iter().all(|slope| slope.is_finite());
        if best.is_none() || (is_finite && error < least) {
            least = if is_finite { error } else { f64::INFINITY };
            best = Some(slope);
        }
        if is_finite && tail <= 8.0 * f64::EPSILON * size {
            break;
        }
        half *= 0.5;
    }
    best.unwrap_or_else(|| value(0.0) * f64::NAN)
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::dvector;

    /// Functions with singularities at different distances, and one that is not defined everywhere.
    #[test]
    fn derivatives_of_known_functions() {
        let value = |x: f64| {
            dvector![
                (3.0 * x).sin(),
                1.0 / (0.4 - x),
                (0.02 + x).sqrt(),
                5.0 - 2.0 * x,
                (x * x * 400.0 + 1.0).recip()
            ]
        };
        let expected = [3.0, 6.25, 0.5 / 0.02_f64.sqrt(), -2.0, 0.0];
        let found = derivative(value, [0.5, 1e-3]);
        for (found, expected) in found.iter().zip(expected) {
            assert!((found - expected).abs() < 1e-11, "{found}, {expected}");
        }
        // a function without a value next to 0
        assert!(derivative(|x| dvector![(x - 1.0).sqrt()], [0.5, 1e-3])[0].is_nan());
    }
}
