//! The exponential of a matrix and its integral, computed by series.

use super::canonical::Entire;
use crate::Error;
use affinor_tensors::linear::{Matrix, balancing};
use affinor_tensors::{Field, Scalar, Tolerance};

/// The number of terms of the series for a norm of at most 1/2. This number is also sufficient for
/// the second derivatives.
const TERMS: i64 = 20;

/// The largest spectral radius. If the radius exceeds this limit, the repeated squarings lose too
/// much accuracy.
const LARGEST: f64 = (1 << 20) as f64;

/// The scaling that makes a matrix small enough for the series.
pub(super) struct Scaling {
    /// The exponents of a [`balancing`], and the number of halvings of the balanced matrix.
    exponents: Vec<i32>,
    halvings: u32,
    /// The tolerance after the squarings, relative to the terms of a sum.
    pub(super) tolerance: Tolerance,
}

impl Scaling {
    /// Computes the scaling for a matrix.
    pub(super) fn of(m: &Matrix<f64>) -> Result<Self, Error> {
        let norm = |m: &Matrix<f64>| {
            let row = |i: usize| m.row(i).iter().map(|(_, value)| value.abs()).sum::<f64>();
            // computes the maximum without `max`, which would ignore NaN
            (0..m.rows()).map(row).fold(0.0, |a, b| if b > a || b.is_nan() { b } else { a })
        };
        let size = norm(m);
        let n = m.rows();
        let overflow = |what: &str, value: f64| {
            let component = format!("the {what} of ad_x");
            Error::Overflow { component, value: value.to_string() }
        };
        if !size.is_finite() {
            return Err(overflow("norm", size));
        }
        if size == 0.0 {
            let exponents = vec![0; n];
            return Ok(Scaling { exponents, halvings: 0, tolerance: Tolerance::default() });
        }
        let rows = (0..n).flat_map(|i| m.row(i).iter().map(move |(k, value)| (i, *k, *value)));
        let exponents = balancing(n, rows);
        let m = &conjugated(m, &exponents);
        let size = norm(m);
        // |M^8|^(1/8) is an upper bound of the spectral radius, and is 0 if M^8 = 0
        let unit = m.map(|value| value / size);
        let eighth = (0..3).try_fold(unit, |power, _| power.mul(&power))?;
        let radius = size * norm(&eighth).powf(0.125);
        if radius > LARGEST {
            return Err(overflow("spectral radius", radius));
        }
        let halvings = (size.log2().ceil() + 1.0).max(0.0) as u32;
        let tolerance = Tolerance::default().relative() * radius.max(1.0);
        let tolerance = Tolerance::new(tolerance).unwrap_or_default();
        Ok(Scaling { exponents, halvings, tolerance })
    }
}

/// The balanced matrix with the entries `m_ik 2^(e_k - e_i)`.
fn conjugated<S: Field + Scalar>(m: &Matrix<S>, exponents: &[i32]) -> Matrix<S> {
    let two = S::from_i64(2);
    let half = two.recip().expect("a field of characteristic 0");
    let power = |k: i32| {
        let base = if k < 0 { &half } else { &two };
        (0..k.unsigned_abs()).fold(S::one(), |power, _| power * base)
    };
    let row = |i: usize| {
        let entry =
            |(k, value): &(usize, S)| (*k, value.clone() * &power(exponents[*k] - exponents[i]));
        m.row(i).iter().map(entry).collect::<Vec<_>>()
    };
    let rows = (0..m.rows()).map(row).collect::<Vec<_>>();
    Matrix::from_rows(m.columns(), rows)
        .expect("columns of the matrix")
        .with_tolerance(m.tolerance())
}

/// The function of a matrix. The series computes the function of `M/2^h`, and the argument is then
/// doubled repeatedly: `exp(2M) = exp(M)^2` and `T(2M) = T(M) (1 + exp(M))/2`, where
/// `T = sum M^k/(k+1)!` is the integral.
pub(super) fn series<S: Field + Scalar>(
    function: Entire,
    m: &Matrix<S>,
    scaling: &Scaling,
) -> Result<Matrix<S>, Error> {
    let n = m.rows();
    let share = |k: i64| S::from_i64(k).recip().expect("a field of characteristic 0");
    let scaled = |m: &Matrix<S>, by: &S| m.map(|value| value.clone() * by);
    let one = Matrix::identity(n).with_tolerance(scaling.tolerance);
    let half = share(2);
    let balanced = conjugated(m, &scaling.exponents);
    let small = (0..scaling.halvings).fold(balanced, |m, _| scaled(&m, &half));
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
    let back: Vec<i32> = scaling.exponents.iter().map(|e| -e).collect();
    Ok(match function {
        Entire::Exponential => conjugated(&exp, &back),
        Entire::Integral => conjugated(&integral, &back),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The functions of `[[a, b], [0, 0]]` are accurate for `b` of any size.
    #[test]
    fn functions_with_long_translations() -> Result<(), Error> {
        let a = 0.5_f64;
        let integral = [a.exp_m1() / a, (a.exp_m1() - a) / (a * a)];
        for b in [1.0, 1e4, 1e9, 1e17, 1e150] {
            let m = Matrix::from_dense(&[vec![a, b], vec![0.0, 0.0]])?;
            let found = series(Entire::Integral, &m, &Scaling::of(&m)?)?.to_dense();
            for (found, expected) in found[0].iter().zip([integral[0], b * integral[1]]) {
                assert!((found / expected - 1.0).abs() <= 1e-14, "{b:e}: {found} {expected}");
            }
        }
        Ok(())
    }
}
