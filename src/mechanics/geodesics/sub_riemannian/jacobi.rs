//! The differential of the exponential map by the exact Jacobi equations, and conjugate times.

use super::{STEPS, SubRiemannianGroup, combination};
use crate::Error;
use crate::numerics::ode;
use affinor_tensors::stop::checkpoint;
use nalgebra::{Complex, DMatrix, DVector};
use std::f64::consts::TAU;

/// The tolerance of the Jacobi equations.
const TOLERANCE: f64 = 1e-12;
/// The largest number of halvings of the time in the search for the first conjugate time.
const WINDOWS: i32 = 60;
/// The relative accuracy of a conjugate time, and the relative distance of the times at which the
/// multiplicity is counted.
const ACCURACY: f64 = 1e-13;
const AROUND: f64 = 1e-5;
/// The part of the last time by which a conjugate time may exceed it.
const END: f64 = 1e-10;
/// The largest defect of a unitary matrix whose eigenvalues are counted.
const UNITARY: f64 = 1e-5;
/// If the ratio of the eigenvalues of the Gramian is smaller, the extremal counts as abnormal.
const SINGULAR: f64 = 1e-10;

/// The smallest unit of length. Its powers do not underflow.
const LEAST: f64 = 1e-20;

/// The answer to the question for the first conjugate time of a normal extremal.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Conjugacy {
    /// No time is conjugate up to this time. It is the given time, unless the equations need too many
    /// steps.
    None {
        /// The time up to which the search succeeded.
        until: f64,
    },
    /// The first conjugate time.
    At {
        /// The time at which the differential of the exponential map becomes singular. After this
        /// time, the extremal is not locally shortest.
        time: f64,
        /// The dimension of its kernel.
        multiplicity: usize,
    },
    /// The extremal is also abnormal: the differential is singular at all times.
    Abnormal,
}

impl SubRiemannianGroup {
    /// The differential of the exponential map: the matrix `X^i_j` such that a change `dp_j` of the
    /// initial covector moves the element `g` at the time `t` by `g X dp`. Row `i` is a component in
    /// the left-invariant basis.
    ///
    /// With the covector `p` and the velocity `u = Q p` at the time `t`, `X` and the change `D` of the
    /// covector satisfy the Jacobi equations
    ///
    /// ```text
    /// X' = Q D - ad_u X,   D' = (ad_u^T + F Q) D,   F_ij = p([e_j, e_i])
    /// ```
    ///
    /// from `X = 0` and `D = 1`.
    ///
    /// # Errors
    /// The errors of [`extremal`](Self::extremal).
    pub fn differential(&self, covector: &DVector<f64>, time: f64) -> Result<DMatrix<f64>, Error> {
        self.expect_moving(covector)?;
        self.varied(covector, time, TOLERANCE, STEPS)
    }

    pub(super) fn varied(
        &self,
        covector: &DVector<f64>,
        time: f64,
        tolerance: f64,
        steps: usize,
    ) -> Result<DMatrix<f64>, Error> {
        let jacobi = Jacobi::new(self, covector, time);
        let n = jacobi.dimension();
        let start = jacobi.unknowns(&[DMatrix::zeros(n, n), DMatrix::identity(n, n)], 0);
        let slope = |unknowns: &DVector<f64>| jacobi.linear_slope(unknowns);
        let end = jacobi.solve(slope, [0.0, 1.0], start, tolerance, steps)?;
        Ok(&jacobi.basis * jacobi.block(&end, 0) * jacobi.basis.transpose() * (time / jacobi.unit))
    }

    /// The determinant of the [differential](Self::differential) of the exponential map, which is
    /// zero at conjugate times.
    ///
    /// # Errors
    /// The errors of [`differential`](Self::differential).
    pub fn distortion(&self, covector: &DVector<f64>, time: f64) -> Result<f64, Error> {
        Ok(self.differential(covector, time)?.determinant())
    }

    /// The first conjugate time of a normal extremal that is not later than `end`.
    ///
    /// The Jacobi equations move a Lagrangian subspace, with the frame `(Y, X)`, `Y = D - F X/2`. In
    /// this frame, the symplectic form is the standard one:
    ///
    /// ```text
    /// Y' = a Y + b X,   X' = Q Y - a^T X,   a = ad_u^T + F Q/2,   b = F Q F/4
    /// ```
    ///
    /// The subspace is determined by the unitary matrix `U = (Y + iX)(Y - iX)^-1`, which satisfies a
    /// Riccati equation and is bounded, even where `X` grows exponentially. Its eigenvalues pass
    /// through 1 in one direction, and each passage is a conjugate time. The number of passages follows
    /// from the phase of the determinant, so that no zero is missed, whatever its multiplicity.
    ///
    /// # Errors
    /// The errors of [`extremal`](Self::extremal); [`Error::Invalid`] unless the time is positive.
    pub fn first_conjugate(&self, covector: &DVector<f64>, end: f64) -> Result<Conjugacy, Error> {
        self.expect_moving(covector)?;
        if !end.is_finite() || end <= 0.0 {
            return Err(Error::Invalid {
                what: "time",
                reason: format!("{end} is not positive and finite"),
            });
        }
        // a short window resolves the slowest eigenvalues; each window doubles the time
        let rate = Jacobi::rate(self, covector);
        let halvings = (end * rate).log2().ceil().clamp(0.0, f64::from(WINDOWS)) as i32;
        let mut until = 0.0;
        for window in (0..=halvings).rev() {
            let time = end * 0.5_f64.powi(window);
            let jacobi = Jacobi::new(self, covector, time);
            let is_first = window == halvings;
            let before = if is_first { 0.0 } else { 0.5 };
            // the end may be a conjugate time up to rounding
            let to = if window == 0 { 1.0 + END } else { 1.0 };
            if is_first && jacobi.is_abnormal()? {
                return Ok(Conjugacy::Abnormal);
            }
            let Ok(start) = jacobi.rotate([0.0, before], jacobi.start()) else { break };
            let Ok(last) = jacobi.rotate([before, to], start.clone()) else { break };
            match jacobi.passages(&last) {
                None => break,
                Some(0) => until = time,
                Some(_) => return jacobi.locate(before, start, to),
            }
        }
        Ok(Conjugacy::None { until })
    }
}

/// The Jacobi equations of an extremal in a basis in which they have the time 1 and the size 1. The
/// unknowns are the covector and two matrices, and, for conjugate times, the phase of a determinant.
struct Jacobi {
    /// The basis, as columns of components.
    basis: DMatrix<f64>,
    /// The unit of covectors.
    unit: f64,
    /// The time that corresponds to 1.
    time: f64,
    ad: Vec<DMatrix<f64>>,
    cometric: DMatrix<f64>,
    covector: DVector<f64>,
}

impl Jacobi {
    fn new(space: &SubRiemannianGroup, covector: &DVector<f64>, time: f64) -> Self {
        let (adapted, weights) = &space.adapted;
        let size = (space.speed(covector) * time.abs()).clamp(LEAST, 1.0);
        let mut basis = adapted.clone();
        for (mut column, weight) in basis.column_iter_mut().zip(weights) {
            column *= size.powi(*weight);
        }
        let inverse = basis.clone().lu().try_inverse().expect("the vectors of a basis");
        let ad = basis.column_iter().map(|x| &inverse * space.ad(&x.into()) * &basis);
        let ad: Vec<_> = ad.collect();
        // the unit of covectors makes the cometric of the size 1
        let unit = size * size;
        let cometric = &inverse * &space.cometric * inverse.transpose() * unit;
        let covector = basis.transpose() * covector * (time / unit);
        Jacobi { basis, unit, time, ad, cometric, covector }
    }

    /// The largest rate of the equations at the start, per unit of time.
    fn rate(space: &SubRiemannianGroup, covector: &DVector<f64>) -> f64 {
        let turning = space.ad(&space.velocity(covector)).norm();
        turning.max((&space.cometric * form(&space.ad, covector)).norm())
    }

    fn dimension(&self) -> usize {
        self.ad.len()
    }

    /// The initial covector, two matrices, and further unknowns that are zero.
    fn unknowns(&self, matrices: &[DMatrix<f64>; 2], further: usize) -> DVector<f64> {
        self.joined(&self.covector, matrices, further)
    }

    fn joined(
        &self,
        covector: &DVector<f64>,
        matrices: &[DMatrix<f64>; 2],
        further: usize,
    ) -> DVector<f64> {
        let [first, second] = matrices;
        let entries = covector.iter().chain(first.iter()).chain(second.iter()).copied();
        let total = covector.len() + first.len() + second.len() + further;
        DVector::from_iterator(total, entries.chain(std::iter::repeat_n(0.0, further)))
    }

    /// The matrix at an index among the unknowns.
    fn block(&self, unknowns: &DVector<f64>, at: usize) -> DMatrix<f64> {
        let n = self.dimension();
        let first = n + at * n * n;
        DMatrix::from_column_slice(n, n, &unknowns.as_slice()[first..first + n * n])
    }

    /// The covector among the unknowns, with the matrices `ad_u` and `F`.
    fn moving(&self, unknowns: &DVector<f64>) -> (DVector<f64>, DMatrix<f64>, DMatrix<f64>) {
        let covector = unknowns.rows(0, self.dimension()).into_owned();
        let (turning, form) =
            (combination(&self.ad, &(&self.cometric * &covector)), form(&self.ad, &covector));
        (covector, turning, form)
    }

    /// The slope of `p`, `X` and `D`.
    fn linear_slope(&self, unknowns: &DVector<f64>) -> DVector<f64> {
        let (covector, turning, form) = self.moving(unknowns);
        let (moved, changed) = (self.block(unknowns, 0), self.block(unknowns, 1));
        let faster = &self.cometric * &changed;
        let slopes = [&faster - &turning * &moved, turning.tr_mul(&changed) + &form * &faster];
        self.joined(&turning.tr_mul(&covector), &slopes, 0)
    }

    /// The slope of `p`, `A = Ad_g` and the Gramian `C` of the velocities, transported to the start:
    /// `A' = A ad_u` and `C' = A Q A^T`.
    fn gramian_slope(&self, unknowns: &DVector<f64>) -> DVector<f64> {
        let (covector, turning, _) = self.moving(unknowns);
        let adjoint = self.block(unknowns, 0);
        let slopes = [&adjoint * &turning, &adjoint * &self.cometric * adjoint.transpose()];
        self.joined(&turning.tr_mul(&covector), &slopes, 0)
    }

    /// The slope of `p`, of the real and the imaginary part of `U`, and of the phase of its
    /// determinant. With `Z = Y + iX`, `Z' = m Z + n conj(Z)`, so that
    /// `U' = m U + n - U conj(m) - U conj(n) U`.
    fn unitary_slope(&self, unknowns: &DVector<f64>) -> DVector<f64> {
        let (covector, turning, form) = self.moving(unknowns);
        let bent = &form * &self.cometric;
        let a = turning.transpose() + &bent * 0.5;
        let b = &bent * &form * 0.25;
        let m = complex(&((&a - a.transpose()) * 0.5), &((&self.cometric - &b) * 0.5));
        let n = complex(&((&a + a.transpose()) * 0.5), &((&self.cometric + &b) * 0.5));
        let unitary = self.unitary(unknowns);
        let slope = &m * &unitary + &n - &unitary * (m.conjugate() + n.conjugate() * &unitary);
        let phase = 2.0 * (m.trace() + unitary.adjoint().dot(&n.transpose())).im;
        let parts = [slope.map(|entry| entry.re), slope.map(|entry| entry.im)];
        let mut slope = self.joined(&turning.tr_mul(&covector), &parts, 1);
        slope[unknowns.len() - 1] = phase;
        slope
    }

    fn unitary(&self, unknowns: &DVector<f64>) -> DMatrix<Complex<f64>> {
        complex(&self.block(unknowns, 0), &self.block(unknowns, 1))
    }

    fn solve(
        &self,
        slope: impl Fn(&DVector<f64>) -> DVector<f64>,
        [from, to]: [f64; 2],
        start: DVector<f64>,
        tolerance: f64,
        steps: usize,
    ) -> Result<DVector<f64>, Error> {
        let slope = |_: f64, unknowns: &DVector<f64>| slope(unknowns);
        let ends = ode::solve_within(steps, slope, from, start, &[to], tolerance);
        let mut ends = ends.map_err(|error| match error {
            Error::Integration { t, reason } => Error::Integration { t: t * self.time, reason },
            other => other,
        })?;
        Ok(ends.remove(0))
    }

    /// The unknowns with the matrix `U`, at the time 0.
    fn start(&self) -> DVector<f64> {
        let n = self.dimension();
        self.unknowns(&[DMatrix::identity(n, n), DMatrix::zeros(n, n)], 1)
    }

    /// The unknowns with the matrix `U`, at a later time.
    fn rotate(&self, times: [f64; 2], start: DVector<f64>) -> Result<DVector<f64>, Error> {
        self.solve(|unknowns| self.unitary_slope(unknowns), times, start, TOLERANCE, STEPS)
    }

    /// Whether the Gramian is singular: then some covector annihilates all velocities, transported to
    /// the start.
    fn is_abnormal(&self) -> Result<bool, Error> {
        let n = self.dimension();
        let start = self.unknowns(&[DMatrix::identity(n, n), DMatrix::zeros(n, n)], 0);
        let slope = |unknowns: &DVector<f64>| self.gramian_slope(unknowns);
        let gram = self.block(&self.solve(slope, [0.0, 1.0], start, TOLERANCE, STEPS)?, 1);
        let sizes = gram.diagonal().map(|square| if square > 0.0 { square.sqrt() } else { 1.0 });
        let scaled = gram.map_with_location(|i, j, entry| entry / (sizes[i] * sizes[j]));
        let eigenvalues = scaled.symmetric_eigenvalues();
        Ok(eigenvalues.min() <= SINGULAR * eigenvalues.max())
    }

    /// The number of conjugate times up to now, with multiplicity. Returns `None` if the matrix is not
    /// unitary up to rounding.
    fn passages(&self, unknowns: &DVector<f64>) -> Option<usize> {
        let n = self.dimension();
        let unitary = self.unitary(unknowns);
        let defect = &unitary * unitary.adjoint() - DMatrix::identity(n, n);
        if !defect.iter().all(|entry| entry.norm() <= UNITARY) {
            return None;
        }
        let (_, triangle) = unitary.schur().unpack();
        let angles: f64 = triangle.diagonal().iter().map(|value| value.arg().rem_euclid(TAU)).sum();
        Some(((unknowns[unknowns.len() - 1] - angles) / TAU).round().max(0.0) as usize)
    }

    /// The first conjugate time from `before` to `end`, by bisection.
    fn locate(&self, before: f64, start: DVector<f64>, end: f64) -> Result<Conjugacy, Error> {
        let (mut low, mut high) = ((before, start), end);
        while high - low.0 > ACCURACY * high {
            checkpoint();
            let middle = 0.5 * (low.0 + high);
            let unknowns = self.rotate([low.0, middle], low.1.clone())?;
            match self.passages(&unknowns) {
                Some(0) => low = (middle, unknowns),
                _ => high = middle,
            }
        }
        let time = 0.5 * (low.0 + high);
        let past = self.rotate([low.0, time * (1.0 + AROUND)], low.1)?;
        let multiplicity = self.passages(&past).unwrap_or(1).max(1);
        Ok(Conjugacy::At { time: time * self.time, multiplicity })
    }
}

/// The matrix `F_ij = p([e_j, e_i])` of a covector.
fn form(ad: &[DMatrix<f64>], covector: &DVector<f64>) -> DMatrix<f64> {
    let rows: Vec<_> = ad.iter().map(|ad| ad.tr_mul(covector)).collect();
    DMatrix::from_fn(ad.len(), ad.len(), |i, j| rows[j][i])
}

fn complex(real: &DMatrix<f64>, imaginary: &DMatrix<f64>) -> DMatrix<Complex<f64>> {
    real.zip_map(imaginary, Complex::new)
}
