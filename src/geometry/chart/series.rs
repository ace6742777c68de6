//! `exp` of a matrix and its integral, by their series.

use super::canonical::Entire;
use crate::Error;
use affinor_tensors::linear::Matrix;
use affinor_tensors::{Field, Tolerance};

/// The number of terms of the series for a norm of at most 1/2; it suffices for the second
/// derivatives.
const TERMS: i64 = 20;

/// The largest spectral radius; beyond it the repeated squarings lose too many digits.
const LARGEST: f64 = (1 << 20) as f64;

/// The scaling of a matrix for its series.
pub(super) struct Scaling {
    /// The number of halvings.
    halvings: u32,
    /// The tolerance after the squarings, relative to the terms of a sum.
    pub(super) tolerance: Tolerance,
}

impl Scaling {
    /// The scaling for a matrix.
    pub(super) fn of(m: &Matrix<f64>) -> Result<Self, Error> {
        let norm = |m: &Matrix<f64>| {
            let row = |i: usize| m.row(i).iter().map(|(_, value)| value.abs()).sum::<f64>();
            // not `max`, which forgets NaN
            (0..m.rows()).map(row).fold(0.0, |a, b| if b > a || b.is_nan() { b } else { a })
        };
        let size = norm(m);
        let overflow = |what: &str, value: f64| {
            let component = format!("the {what} of ad_x");
            Error::Overflow { component, value: value.to_string() }
        };
        if !size.is_finite() {
            return Err(overflow("norm", size));
        }
        if size == 0.0 {
            return Ok(Scaling { halvings: 0, tolerance: Tolerance::default() });
        }
        // |M^8|^(1/8) bounds it, and is 0 where M is nilpotent
        let unit = m.map(|value| value / size);
        let eighth = (0..3).try_fold(unit, |power, _| power.mul(&power))?;
        let radius = size * norm(&eighth).powf(0.125);
        if radius > LARGEST {
            return Err(overflow("spectral radius", radius));
        }
        let halvings = (size.log2().ceil() + 1.0).max(0.0) as u32;
        let tolerance = Tolerance::default().relative() * radius.max(1.0);
        let tolerance = Tolerance::new(tolerance).unwrap_or_default();
        Ok(Scaling { halvings, tolerance })
    }
}

/// The function of a matrix: its series for `M/2^h`, doubled by `exp(2M) = exp(M)^2` and
/// `T(2M) = T(M) (1 + exp(M))/2`, where `T = sum M^k/(k+1)!` is the integral.
pub(super) fn series<S: Field>(
    function: Entire,
    m: &Matrix<S>,
    scaling: &Scaling,
) -> Result<Matrix<S>, Error> {
    let n = m.rows();
    let share = |k: i64| S::from_i64(k).recip().expect("a field of characteristic 0");
    let scaled = |m: &Matrix<S>, by: &S| m.map(|value| value.clone() * by);
    let one = Matrix::identity(n).with_tolerance(scaling.tolerance);
    let half = share(2);
    let small = (0..scaling.halvings).fold(m.clone(), |m, _| scaled(&m, &half));
    let (mut integral, mut term) = (one.clone(), one.clone());
    for k in 1..TERMS {
        term = scaled(&term.mul(&small)?, &share(k + 1));
        integral = integral.add(&term)?;
    }
    let mut exp = one.add(&small.mul(&integral)?)?;
    for _ in 0..scaling.halvings {
        integral = scaled(&integral.mul(&one.add(&exp)?)?, &half);
        exp = exp.mul(&exp)?;
    }
    Ok(match function {
        Entire::Exponential => exp,
        Entire::Integral => integral,
    })
}
