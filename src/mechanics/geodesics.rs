//! Geodesics between two points, by shooting.
//!
//! The unknown is the initial velocity `v` of a curve with the parameter from 0 to 1. Newton's
//! method with damping makes the end of the curve the given point. The derivative of the end is
//! computed by central differences of the velocity. [`chart`] has curves on charts, and
//! [`homogeneous`] curves on groups and homogeneous spaces.

pub mod chart;
pub mod homogeneous;

pub use chart::ChartShooting;
pub use homogeneous::HomogeneousShooting;

use crate::Error;
use affinor_tensors::stop::checkpoint;
use nalgebra::{DMatrix, DVector};

/// The rounding error of an end, relative to the size of its numbers.
const ROUNDING: f64 = 1e-13;
/// The tolerance of a step of the curves: near a geodesic, and before.
const TOLERANCE: f64 = 1e-13;
const COARSE: f64 = 1e-9;
/// If the miss is smaller than this multiple of the velocity, the fine tolerance is used.
const NEAR: f64 = 1e-4;
/// The change of the unknowns in central differences, relative to their size.
const DIFFERENCE: f64 = 1e-4;
/// The largest miss of a geodesic that counts as found, relative to the size of its velocity.
const FOUND: f64 = 1e-9;
/// The largest number of iterations from one start, and of halvings in one iteration.
const ITERATIONS: usize = 25;
const HALVINGS: usize = 12;
/// If the ratio of the smallest to the largest singular value of the derivative is smaller, the
/// points count as conjugate.
const SINGULAR: f64 = 1e-6;
/// Two geodesics are the same if their velocities differ by less than this multiple.
const SAME: f64 = 1e-6;

/// A geodesic between two points.
#[derive(Clone, Debug, PartialEq)]
pub struct Geodesic {
    /// The initial velocity, for a parameter from 0 to 1.
    pub velocity: DVector<f64>,
    /// The velocity at the end.
    pub end_velocity: DVector<f64>,
    /// The square `g(v, v)` of the initial velocity; `None` without a metric.
    pub square: Option<f64>,
    /// The length, the integral of `sqrt|g(v, v)|`; `None` without a metric.
    pub length: Option<f64>,
    /// The distance between the computed and the given end.
    pub residual: f64,
    /// The ratio of the smallest to the largest singular value of the derivative of the end by the
    /// velocity. It is 0 if the points are conjugate along the geodesic.
    pub regularity: f64,
}

impl Geodesic {
    /// Whether the end is conjugate to the start along the geodesic, up to rounding. Then the
    /// geodesic is not isolated, or its velocity is ill-conditioned.
    pub fn is_conjugate(&self) -> bool {
        self.regularity < SINGULAR
    }
}

/// A problem with two end points. The unknowns are the initial velocity and, if necessary, further
/// numbers.
pub trait Shooting {
    /// The difference between the end of the curve and the given end, for these unknowns. The
    /// curve is computed to a tolerance.
    ///
    /// # Errors
    /// An error if the curve does not exist up to its end.
    fn miss(&self, unknowns: &DVector<f64>, tolerance: f64) -> Result<DVector<f64>, Error>;

    /// The geodesic for these unknowns, whose miss and derivative are known.
    ///
    /// # Errors
    /// An error if the curve does not exist up to its end.
    fn geodesic(
        &self,
        unknowns: &DVector<f64>,
        miss: &DVector<f64>,
        regularity: f64,
    ) -> Result<Geodesic, Error>;

    /// The unknowns from which the search begins, the most promising ones first.
    fn starts(&self, count: usize) -> Vec<DVector<f64>>;

    /// The size of the velocity.
    fn size(&self, unknowns: &DVector<f64>) -> f64 {
        unknowns.component_mul(&self.sizes()).norm()
    }

    /// The sizes of the unknowns at the start, in which singular values are measured.
    fn sizes(&self) -> DVector<f64>;

    /// The size of the rounding error of a miss.
    fn resolution(&self) -> f64;
}

/// The number of starts after which a search for one geodesic ends.
const TRIES: usize = 8;

/// The geodesics that are found from the number `count` of starts, by increasing length. Others may
/// exist. Without a number, the search ends at the first geodesic.
///
/// # Errors
/// [`Error::NoGeodesic`] if none is found: with the smallest miss.
pub fn find(problem: &impl Shooting, count: Option<usize>) -> Result<Vec<Geodesic>, Error> {
    let mut found: Vec<Geodesic> = vec![];
    let (mut nearest, mut reason) = (f64::INFINITY, None);
    for start in problem.starts(count.unwrap_or(TRIES)) {
        if count.is_none() && !found.is_empty() {
            break;
        }
        match solve(problem, start) {
            Ok(Solution::Found(geodesic)) => {
                let size = geodesic.velocity.amax();
                let is_same =
                    |other: &Geodesic| (&other.velocity - &geodesic.velocity).amax() <= SAME * size;
                if !found.iter().any(is_same) {
                    found.push(geodesic);
                }
            }
            Ok(Solution::Missed(miss)) => nearest = nearest.min(miss),
            Err(error) => reason = Some(error),
        }
    }
    if found.is_empty() {
        let reason = match reason {
            Some(error) if nearest.is_infinite() => error.to_string(),
            _ => format!("the nearest curve ends at a distance of {nearest:.1e}"),
        };
        return Err(Error::NoGeodesic { reason });
    }
    let size = |geodesic: &Geodesic| geodesic.length.unwrap_or_else(|| geodesic.velocity.norm());
    found.sort_by(|a, b| size(a).total_cmp(&size(b)));
    Ok(found)
}

/// The outcome of the iteration from one start.
enum Solution {
    Found(Geodesic),
    /// The size of the smallest miss.
    Missed(f64),
}

/// Newton's method from one start.
fn solve(problem: &impl Shooting, start: DVector<f64>) -> Result<Solution, Error> {
    let (mut unknowns, mut tolerance) = (start, COARSE);
    let mut miss = problem.miss(&unknowns, tolerance)?;
    let mut regularity = None;
    for _ in 0..ITERATIONS {
        checkpoint();
        if tolerance > TOLERANCE && miss.norm() < NEAR * problem.size(&unknowns) {
            tolerance = TOLERANCE;
            miss = problem.miss(&unknowns, tolerance)?;
        }
        let derivative = derivative(problem, &unknowns, tolerance)?;
        let (correction, ratio) = correction(&derivative, &miss, &problem.sizes());
        regularity = Some(ratio);
        let mut step = None;
        for halving in 0..HALVINGS {
            let next = &unknowns - &correction * 0.5_f64.powi(halving as i32);
            let Ok(other) = problem.miss(&next, tolerance) else { continue };
            if other.norm() < miss.norm() {
                step = Some((next, other));
                break;
            }
        }
        // stops where rounding prevents a smaller miss
        let Some((next, other)) = step else { break };
        let is_slow = other.norm() > 0.5 * miss.norm() && miss.norm() < allowed(problem, &unknowns);
        (unknowns, miss) = (next, other);
        if is_slow || miss.norm() == 0.0 {
            break;
        }
    }
    let ratio = regularity.unwrap_or(0.0);
    let geodesic = problem.geodesic(&unknowns, &miss, ratio)?;
    Ok(match geodesic.residual <= allowed(problem, &unknowns) {
        true => Solution::Found(geodesic),
        false => Solution::Missed(geodesic.residual),
    })
}

/// The largest miss that counts as found.
fn allowed(problem: &impl Shooting, unknowns: &DVector<f64>) -> f64 {
    (FOUND * problem.size(unknowns)).max(problem.resolution())
}

/// The derivative of the miss by the unknowns.
fn derivative(
    problem: &impl Shooting,
    unknowns: &DVector<f64>,
    tolerance: f64,
) -> Result<DMatrix<f64>, Error> {
    let sizes = problem.sizes();
    let whole = problem.size(unknowns);
    let columns = (0..unknowns.len()).map(|i| {
        let h = DIFFERENCE * if whole > 0.0 { whole } else { 1.0 } / sizes[i];
        let moved = |by: f64| {
            let mut moved = unknowns.clone();
            moved[i] += by;
            problem.miss(&moved, tolerance)
        };
        Ok((moved(h)? - moved(-h)?) / (2.0 * h))
    });
    Ok(DMatrix::from_columns(&columns.collect::<Result<Vec<_>, Error>>()?))
}

/// The correction that makes the linear approximation of the miss smallest, and the ratio of the
/// singular values.
fn correction(
    derivative: &DMatrix<f64>,
    miss: &DVector<f64>,
    sizes: &DVector<f64>,
) -> (DVector<f64>, f64) {
    // columns in units of the sizes, so that singular values do not depend on units
    let scaled = DMatrix::from_fn(derivative.nrows(), derivative.ncols(), |i, j| {
        derivative[(i, j)] / sizes[j]
    });
    let svd = scaled.svd(true, true);
    let (largest, smallest) = (svd.singular_values.max(), svd.singular_values.min());
    let solved = svd.solve(miss, 1e-9 * largest).unwrap_or_else(|_| miss.clone() * 0.0);
    let ratio = if largest > 0.0 { smallest / largest } else { 0.0 };
    (solved.component_div(sizes), ratio)
}

/// Numbers between -1 and 1 that fill the cube evenly: multiples of the powers of the root of
/// `x^(n + 1) = x + 1`, modulo 1.
fn spread(index: usize, dimension: usize) -> DVector<f64> {
    let exponent = 1.0 / (dimension as f64 + 1.0);
    let root = (0..64).fold(2.0_f64, |root, _| (1.0 + root).powf(exponent));
    DVector::from_fn(dimension, |i, _| {
        let step = root.powf(-(i as f64 + 1.0));
        2.0 * ((index + 1) as f64 * step + 0.5).fract() - 1.0
    })
}
