//! Logarithms of matrices by inverse scaling and squaring.
//!
//! The logarithm is `log(A) = 2^k log(A^(1/2^k))`. Square roots move the matrix close to 1, where a
//! Pade approximant is accurate up to rounding errors. N. J. Higham, *Functions of Matrices*
//! (2008), chapter 11.

use super::double::{self, Double, mapped, rounded};
use super::exponential::{balance, balanced, balanced_by, exp, unbalanced};
use crate::Error;
use affinor_tensors::stop::checkpoint;
use nalgebra::linalg::Schur;
use nalgebra::{ClosedAddAssign, ClosedMulAssign, ClosedSubAssign, DMatrix, Scalar};
use num_traits::{One, Zero};

/// If the norm is at most this value, the approximant with [`NODES`] nodes is accurate up to
/// rounding errors (Higham, Table 11.1).
const NEAR: f64 = 0.25;
const NODES: usize = 8;
/// The largest number of square roots. The next two limits are for the iterations of one root, and
/// for the corrections of the sum.
const ROOTS: usize = 64;
const STEPS: usize = 60;
const CORRECTIONS: usize = 4;
/// If the relative error of the exponential of the result exceeds this value, the sum is corrected.
const COARSE: f64 = 1e-13;
/// The largest accepted relative error of the exponential of the result.
const OFF: f64 = 1e-9;

/// The principal logarithm. The imaginary parts of its eigenvalues are between `-pi` and `pi`.
pub(crate) fn logarithm(a: &DMatrix<f64>) -> Result<DMatrix<f64>, Error> {
    expect_finite(a)?;
    let (a, exponents) = balanced(a);
    Ok(unbalanced(&rooted_to(&a, NEAR)?, &exponents))
}

/// The principal logarithm of `1 + x`. It is accurate up to rounding errors of the result.
///
/// The condition number of the logarithm is about `|a| |a^-1|` for `a = 1 + x`. Square roots are
/// computed in double-double arithmetic, which has twice the precision of floats; the logarithm of
/// the root near 1 is well-conditioned.
pub(crate) fn logarithm_of_double(x: &DMatrix<Double>) -> Result<DMatrix<f64>, Error> {
    let rounded_x = rounded(x);
    expect_finite(&rounded_x)?;
    if rounded_x.norm() <= NEAR {
        return near_identity(&rounded_x);
    }
    let one = DMatrix::identity(x.nrows(), x.nrows());
    let exponents = balance(&rounded_x);
    let mut less_one = mapped(x, |x| balanced_by(x, &exponents));
    let a = rounded(&(&less_one + &one));
    // tests with a tolerance, because small eigenvalues may be smaller than the rounding error
    off_the_negative_axis(&a, rounding(&a))?;
    let mut squarings = 0;
    while rounded(&less_one).norm() > NEAR {
        checkpoint();
        if squarings == ROOTS {
            return Err(too_many_roots());
        }
        less_one = square_root(&(less_one + &one))? - &one;
        squarings += 1;
    }
    let log = near_identity(&rounded(&less_one))? * 2.0_f64.powi(squarings as i32);
    Ok(unbalanced(&log, &exponents))
}

/// The logarithm as in [`logarithm`]. Square roots are computed until the distance of the matrix
/// from 1 is at most `near`.
fn rooted_to(a: &DMatrix<f64>, near: f64) -> Result<DMatrix<f64>, Error> {
    off_the_negative_axis(a, 0.0)?;
    if let Some(log) = unipotent(a) {
        return Ok(log);
    }
    let (mut root, mut squarings) = (a.clone(), 0);
    while less_identity(&root).norm() > near {
        checkpoint();
        if squarings == ROOTS {
            return Err(too_many_roots());
        }
        root = square_root(&root)?;
        squarings += 1;
    }
    let mut log = near_identity(&less_identity(&root))? * 2.0_f64.powi(squarings as i32);
    let distance = |log: &DMatrix<f64>| (exp(log) - a).norm() / a.norm();
    let mut off = distance(&log);
    // corrects the sum by log A = L + log(exp(-L) A), because roots of eigenvalues near the
    // negative axis are inaccurate; L commutes with A
    for _ in 0..CORRECTIONS {
        if off <= COARSE {
            break;
        }
        let rest = less_identity(&(exp(&-&log) * a));
        if rest.norm() > near {
            break;
        }
        let next = &log + near_identity(&rest)?;
        let (corrected, before) = (distance(&next), off);
        if corrected < before {
            (log, off) = (next, corrected);
        }
        if corrected >= 0.5 * before {
            break;
        }
    }
    // the comparison `<=` also rejects NaN
    if off <= OFF {
        return Ok(log);
    }
    Err(refused(format!(
        "the series does not converge: its exponential differs from the matrix by {off:e}"
    )))
}

/// The logarithm `sum -(-X)^k/k` of `a = 1 + X`, if `X` is nilpotent. In this case, the sum is
/// finite.
fn unipotent(a: &DMatrix<f64>) -> Option<DMatrix<f64>> {
    let x = less_identity(a);
    let (mut power, mut sum) = (x.clone(), x.clone());
    for k in 2..=a.nrows() {
        power = -(&power * &x);
        sum += &power / k as f64;
    }
    (power * x).iter().all(|entry| *entry == 0.0).then_some(sum)
}

fn refused(reason: String) -> Error {
    Error::Invalid { what: "logarithm", reason }
}

fn expect_finite(a: &DMatrix<f64>) -> Result<(), Error> {
    match a.iter().find(|value| !value.is_finite()) {
        Some(value) => Err(refused(format!("an entry is {value}"))),
        None => Ok(()),
    }
}

fn too_many_roots() -> Error {
    refused(format!("the matrix is not near 1 after {ROOTS} square roots"))
}

fn less_identity(a: &DMatrix<f64>) -> DMatrix<f64> {
    a - DMatrix::identity(a.nrows(), a.nrows())
}

/// The rounding error of the eigenvalues of a normal matrix.
fn rounding(a: &DMatrix<f64>) -> f64 {
    a.nrows() as f64 * f64::EPSILON * a.norm()
}

/// Returns an error if an eigenvalue is on the negative axis and is at most `-known`.
fn off_the_negative_axis(a: &DMatrix<f64>, known: f64) -> Result<(), Error> {
    let n = a.nrows();
    let Some(schur) = Schur::try_new(a.clone(), 4.0 * f64::EPSILON, 100 * n) else {
        // returns no error if the eigenvalues are unknown, because the square roots then do not
        // converge either
        return Ok(());
    };
    let rounding = rounding(a);
    for value in schur.complex_eigenvalues().iter() {
        if value.re <= -known && value.im.abs() <= rounding {
            let value = value.re;
            let reason = format!("the eigenvalue {value} is on the closed negative axis");
            return Err(refused(reason));
        }
    }
    Ok(())
}

/// The entries of matrices whose square roots are computed.
trait Entry:
    Scalar + Zero + One + ClosedAddAssign + ClosedSubAssign + ClosedMulAssign + From<f64>
{
    /// The relative precision.
    const EPSILON: f64;

    /// The float that is nearest to the entry.
    fn rounded(&self) -> f64;

    /// A scale of about this `size`. Its square and its reciprocal have no rounding errors beyond
    /// [`EPSILON`](Self::EPSILON).
    fn scale(size: f64) -> f64;

    /// The approximate determinant, and the inverse; `None` if the matrix is singular.
    fn inverse(m: &DMatrix<Self>) -> (f64, Option<DMatrix<Self>>);
}

impl Entry for f64 {
    const EPSILON: f64 = f64::EPSILON;

    fn rounded(&self) -> f64 {
        *self
    }

    fn scale(size: f64) -> f64 {
        size
    }

    fn inverse(m: &DMatrix<f64>) -> (f64, Option<DMatrix<f64>>) {
        let lu = m.clone().lu();
        (lu.determinant(), lu.try_inverse())
    }
}

impl Entry for Double {
    const EPSILON: f64 = Double::EPSILON;

    fn rounded(&self) -> f64 {
        Double::rounded(*self)
    }

    fn scale(size: f64) -> f64 {
        size.log2().round().exp2()
    }

    fn inverse(m: &DMatrix<Double>) -> (f64, Option<DMatrix<Double>>) {
        (rounded(m).determinant(), double::inverse(m))
    }
}

/// The principal square root, computed by the product form of the Denman-Beavers iteration, which
/// is scaled by the determinant: `X -> A^(1/2)`, `M -> 1`. S. H. Cheng, N. J. Higham, C. S. Kenney
/// and A. J. Laub, *SIAM J. Matrix Anal. Appl.* 22 (2001) 1112-1125.
fn square_root<T: Entry>(a: &DMatrix<T>) -> Result<DMatrix<T>, Error> {
    let n = a.nrows();
    let one = DMatrix::<T>::identity(n, n);
    let (mut m, mut x) = (a.clone(), a.clone());
    let mut before = f64::INFINITY;
    for _ in 0..STEPS {
        let (determinant, inverse) = T::inverse(&m);
        let size = determinant.abs().powf(-0.5 / n as f64);
        // does not scale near the limit, where scaling would slow down the convergence
        let scale = if before < 0.01 || !size.is_normal() { 1.0 } else { T::scale(size) };
        let singular = || refused("a square root does not converge".into());
        let square = T::from(scale * scale);
        let inverse = inverse.ok_or_else(singular)? * T::from((scale * scale).recip());
        x = &x * (&one + &inverse) * T::from(0.5 * scale);
        m = (&one + (m * square + inverse) * T::from(0.5)) * T::from(0.5);
        let distance = (&m - &one).map(|value| value.rounded()).norm();
        let settled = distance <= n as f64 * T::EPSILON;
        if settled || (distance < 1e-6 && distance >= before) {
            return Ok(x);
        }
        before = distance;
    }
    Err(refused(format!("a square root does not converge: it is off by {before:e}")))
}

/// The logarithm `log(1 + X) = int_0^1 X (1 + s X)^-1 ds`, computed by Gauss-Legendre quadrature.
/// For `|X| <= 1/4`, it is the diagonal Pade approximant (L. Dieci, B. Morini and A. Papini, *SIAM
/// J. Matrix Anal. Appl.* 17 (1996) 570-593).
pub(crate) fn near_identity(x: &DMatrix<f64>) -> Result<DMatrix<f64>, Error> {
    let n = x.nrows();
    let mut sum = DMatrix::zeros(n, n);
    for (node, weight) in nodes() {
        let denominator = DMatrix::identity(n, n) + x * node;
        let term = denominator.lu().solve(x);
        sum += term.ok_or_else(|| refused("the series does not converge".into()))? * weight;
    }
    Ok(sum)
}

/// The nodes and weights of Gauss-Legendre quadrature between 0 and 1. The nodes are the zeros `t`
/// of the Legendre polynomial `P`, computed by Newton's method. The weights are
/// `2/((1 - t^2) P'(t)^2)`, scaled to the interval.
fn nodes() -> [(f64, f64); NODES] {
    let n = NODES as f64;
    std::array::from_fn(|at| {
        let mut t = (std::f64::consts::PI * (at as f64 + 0.75) / (n + 0.5)).cos();
        let mut slope = 1.0;
        for _ in 0..8 {
            let (mut before, mut value) = (1.0, t);
            for k in 2..=NODES {
                let k = k as f64;
                (before, value) = (value, ((2.0 * k - 1.0) * t * value - (k - 1.0) * before) / k);
            }
            slope = n * (t * value - before) / (t * t - 1.0);
            t -= value / slope;
        }
        (0.5 * (1.0 + t), 1.0 / ((1.0 - t * t) * slope * slope))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Logarithms of rotations are accurate for angles around the threshold for square roots, also
    /// with more square roots than needed.
    #[test]
    fn logarithms_with_and_without_roots() -> Result<(), Error> {
        // the threshold follows from |R - 1| = 2 sqrt(2) sin(angle/2)
        let threshold = 2.0 * (NEAR / 8.0_f64.sqrt()).asin();
        let around = [0.5, 0.99, 1.0 - 1e-9, 1.0 + 1e-9, 1.01, 2.0, 10.0];
        for angle in around.map(|ratio| ratio * threshold) {
            let (sin, cos) = angle.sin_cos();
            let turn = DMatrix::from_row_slice(2, 2, &[cos, -sin, sin, cos]);
            let exact = DMatrix::from_row_slice(2, 2, &[0.0, -angle, angle, 0.0]);
            for near in [NEAR, 0.1 * NEAR, 1e-3] {
                let off = (rooted_to(&turn, near)? - &exact).amax() / angle;
                // the tolerance grows with the number of roots: each root halves the distance from
                // 1, and so doubles its relative rounding error
                assert!(off <= 8.0 * f64::EPSILON / near.min(angle), "{angle}, {near}: {off:e}");
            }
        }
        Ok(())
    }

    /// Logarithms of `[[exp(a), c], [0, 1]]` are accurate for `c` of any size. They are
    /// `[[a, a c/(exp(a) - 1)], [0, 0]]`.
    #[test]
    fn logarithms_with_long_translations() -> Result<(), Error> {
        let a = 0.5_f64;
        for c in [1e-3, 1.0, 1e4, 1e6, 1e7, 4e7, 1e12, 1e18, 1e150] {
            let log = logarithm(&DMatrix::from_row_slice(2, 2, &[a.exp(), c, 0.0, 1.0]))?;
            assert!((log[(0, 0)] - a).abs() <= 1e-14, "{c:e}: {log}");
            let off = (log[(0, 1)] / (c * a / a.exp_m1()) - 1.0).abs();
            assert!(off <= 1e-14, "{c:e}: {off:e}");
        }
        Ok(())
    }

    /// The exponential of a logarithm is the matrix, for the eigenvalues `3/2 exp(+-i (pi - gap))`
    /// and `1/2` in increasingly skewed bases. If the basis is well-conditioned, the logarithm is
    /// found at every distance from the negative axis. It is rejected if the rounding errors of the
    /// basis exceed the tolerance.
    #[test]
    fn logarithms_lead_back_up_to_the_negative_axis() {
        let mut rejected = 0;
        for skew in (-1..8).map(|power| 2.0_f64.powi(power)) {
            let upper =
                DMatrix::from_row_slice(3, 3, &[1.0, skew, skew, 0.0, 1.0, skew, 0.0, 0.0, 1.0]);
            let lower =
                DMatrix::from_row_slice(3, 3, &[1.0, 0.0, 0.0, 0.5, 1.0, 0.0, -0.25, 0.75, 1.0]);
            let basis = upper * lower;
            let back = basis.clone().try_inverse().expect("determinant 1");
            for gap in (0..10).map(|power| 0.1_f64.powi(power)) {
                let (sin, cos) = gap.sin_cos();
                let plane =
                    [-1.5 * cos, -1.5 * sin, 0.0, 1.5 * sin, -1.5 * cos, 0.0, 0.0, 0.0, 0.5];
                let a = &basis * DMatrix::from_row_slice(3, 3, &plane) * &back;
                match logarithm(&a) {
                    Ok(log) => {
                        let off = (exp(&log) - &a).norm() / a.norm();
                        assert!(off <= 10.0 * OFF, "{skew}, {gap:e}: {off:e}");
                    }
                    Err(error) => {
                        assert!(skew > 2.0, "{skew}, {gap:e}: {error}");
                        rejected += 1;
                    }
                }
            }
        }
        assert!(rejected > 0);
    }
}
