//! Geodesics between two points, by shooting.
//!
//! The unknown is the initial velocity `v` of a curve with the parameter from 0 to 1. Newton's
//! method with damping makes the end of the curve the given point. The derivative of the end is
//! computed by differences of the velocity. [`chart`] has curves on charts, and
//! [`homogeneous`] curves on groups and homogeneous spaces. [`sub_riemannian`] has the extremals of
//! distributions on groups; their unknown is the initial covector, and their derivative is exact.

pub mod chart;
pub mod homogeneous;
pub mod sub_riemannian;

pub use chart::ChartShooting;
pub use homogeneous::HomogeneousShooting;
pub use sub_riemannian::{HorizontalGeodesic, HorizontalShooting, SubRiemannianGroup};

use crate::Error;
use crate::numerics::shooting::{Equations, newton};
use nalgebra::{DMatrix, DVector};

/// The rounding error of an end, relative to the size of its numbers.
const ROUNDING: f64 = 1e-13;
/// The tolerance of a step of the curves: near a geodesic, and before.
const TOLERANCE: f64 = 1e-13;
const COARSE: f64 = 1e-9;
/// The largest miss of a geodesic that counts as found, relative to the size of its velocity.
const FOUND: f64 = 1e-9;
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
    /// The square `g(v, v)` of the initial velocity; `None` where the length is `None`.
    pub square: Option<f64>,
    /// The length, the integral of `sqrt|g(v, v)|`. On a group or a homogeneous space it is `None`
    /// unless `g(v, v)` is constant along all curves. Without a metric, it is `None`.
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

impl Connecting for Geodesic {
    fn start(&self) -> &DVector<f64> {
        &self.velocity
    }

    fn size(&self) -> f64 {
        self.length.unwrap_or_else(|| self.velocity.norm())
    }

    fn residual(&self) -> f64 {
        self.residual
    }
}

/// A curve between two points that a search has found.
pub trait Connecting {
    /// The initial values that distinguish the curve from others: a velocity or a covector.
    fn start(&self) -> &DVector<f64>;

    /// The length, or another size by which curves are sorted.
    fn size(&self) -> f64;

    /// The distance between the computed and the given end.
    fn residual(&self) -> f64;
}

/// A problem with two end points. The unknowns are the initial velocity and, if necessary, further
/// numbers.
pub trait Shooting {
    /// The type of the curves.
    type Curve: Connecting;

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
    ) -> Result<Self::Curve, Error>;

    /// The derivative of the miss by the unknowns in units of their [`sizes`](Self::sizes), if it is
    /// known. Otherwise, it is computed by differences.
    ///
    /// # Errors
    /// The errors of [`miss`](Self::miss).
    fn derivative(
        &self,
        unknowns: &DVector<f64>,
        tolerance: f64,
    ) -> Result<Option<DMatrix<f64>>, Error> {
        let _ = (unknowns, tolerance);
        Ok(None)
    }

    /// The unknowns from which the search begins, the most promising ones first.
    fn starts(&self, count: usize) -> Vec<DVector<f64>>;

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
pub fn find<P: Shooting>(problem: &P, count: Option<usize>) -> Result<Vec<P::Curve>, Error> {
    let mut found: Vec<P::Curve> = vec![];
    let (mut nearest, mut reason) = (f64::INFINITY, None);
    for start in problem.starts(count.unwrap_or(TRIES)) {
        if count.is_none() && !found.is_empty() {
            break;
        }
        match solve(problem, start) {
            Ok(Solution::Found(geodesic)) => {
                let size = geodesic.start().amax();
                let is_same =
                    |other: &P::Curve| (other.start() - geodesic.start()).amax() <= SAME * size;
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
    found.sort_by(|a, b| a.size().total_cmp(&b.size()));
    Ok(found)
}

/// The outcome of the iteration from one start.
enum Solution<C> {
    Found(C),
    /// The size of the smallest miss.
    Missed(f64),
}

/// Newton's method from one start.
fn solve<P: Shooting>(problem: &P, start: DVector<f64>) -> Result<Solution<P::Curve>, Error> {
    let end = Ends(problem);
    let reached = newton(&end, start)?;
    let geodesic = problem.geodesic(&reached.unknowns, &reached.miss, reached.regularity)?;
    let residual = geodesic.residual();
    Ok(match residual <= end.allowed(&reached.unknowns) {
        true => Solution::Found(geodesic),
        false => Solution::Missed(residual),
    })
}

/// The equations for the end of a curve.
struct Ends<'p, P>(&'p P);

impl<P: Shooting> Equations for Ends<'_, P> {
    fn miss(&self, unknowns: &DVector<f64>, tolerance: f64) -> Result<DVector<f64>, Error> {
        self.0.miss(unknowns, tolerance)
    }

    fn derivative(
        &self,
        unknowns: &DVector<f64>,
        tolerance: f64,
    ) -> Result<Option<DMatrix<f64>>, Error> {
        self.0.derivative(unknowns, tolerance)
    }

    fn sizes(&self) -> DVector<f64> {
        self.0.sizes()
    }

    fn allowed(&self, unknowns: &DVector<f64>) -> f64 {
        (FOUND * self.size(unknowns)).max(self.0.resolution())
    }

    fn tolerances(&self) -> [f64; 2] {
        [COARSE, TOLERANCE]
    }
}

/// The error for two equal points.
fn equal_points() -> Error {
    Error::EndPoint { reason: "is the start point, so the geodesic is constant".into() }
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
