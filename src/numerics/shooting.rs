//! Newton's method with damping for equations whose values are computed to a tolerance, such as the
//! ends of curves.

use super::least_squares::least_squares_with_ratio;
use crate::Error;
use affinor_tensors::stop::checkpoint;
use nalgebra::{DMatrix, DVector};

/// If the miss is smaller than this multiple of the largest allowed miss, the fine tolerance is used.
const NEAR: f64 = 1e5;
/// The change of the unknowns in central differences, relative to their size.
const DIFFERENCE: f64 = 1e-4;
/// The largest number of iterations from one start, and of halvings in one iteration.
const ITERATIONS: usize = 25;
const HALVINGS: usize = 12;
/// The iteration ends after this number of consecutive iterations in which the miss shrinks by less
/// than a tenth.
const SLOW: usize = 5;

/// Equations: a miss that depends on unknowns and should vanish.
pub(crate) trait Equations {
    /// The miss for these unknowns, computed to a tolerance.
    ///
    /// # Errors
    /// An error if the miss does not exist.
    fn miss(&self, unknowns: &DVector<f64>, tolerance: f64) -> Result<DVector<f64>, Error>;

    /// The derivative of the miss by the unknowns in units of their sizes, if it is known. Otherwise,
    /// it is computed by differences.
    ///
    /// # Errors
    /// An error if the miss does not exist.
    fn derivative(
        &self,
        _unknowns: &DVector<f64>,
        _tolerance: f64,
    ) -> Result<Option<DMatrix<f64>>, Error> {
        Ok(None)
    }

    /// The sizes of the unit vectors of the unknowns.
    fn sizes(&self) -> DVector<f64>;

    /// The largest miss that solves the equations, for these unknowns.
    fn allowed(&self, unknowns: &DVector<f64>) -> f64;

    /// The tolerances of the miss: far from a solution, and near it.
    fn tolerances(&self) -> [f64; 2];

    /// Whether the iteration may end with this miss, before the derivative is computed.
    fn is_solved(&self, _miss: &DVector<f64>) -> bool {
        false
    }

    /// The size of the unknowns.
    fn size(&self, unknowns: &DVector<f64>) -> f64 {
        unknowns.component_mul(&self.sizes()).norm()
    }
}

/// The unknowns with the smallest miss that the iteration reaches.
pub(crate) struct Reached {
    pub unknowns: DVector<f64>,
    pub miss: DVector<f64>,
    /// The ratio of the smallest to the largest singular value of the derivative.
    pub regularity: f64,
}

/// Newton's method from one start.
///
/// # Errors
/// An error if the miss does not exist at the start, or near a point of the iteration.
pub(crate) fn newton(problem: &impl Equations, start: DVector<f64>) -> Result<Reached, Error> {
    let [coarse, fine] = problem.tolerances();
    let (mut unknowns, mut tolerance) = (start, coarse);
    let mut miss = problem.miss(&unknowns, tolerance)?;
    let (mut regularity, mut slow) = (0.0, 0);
    for _ in 0..ITERATIONS {
        checkpoint();
        if problem.is_solved(&miss) {
            break;
        }
        if tolerance > fine && miss.norm() < NEAR * problem.allowed(&unknowns) {
            tolerance = fine;
            miss = problem.miss(&unknowns, tolerance)?;
        }
        let derivative = match problem.derivative(&unknowns, tolerance)? {
            Some(derivative) => derivative,
            // far from a solution, differences to one side are accurate enough
            None => {
                let one_side = (tolerance > fine).then_some(&miss);
                by_differences(problem, &unknowns, one_side, tolerance)?
            }
        };
        let correction;
        (correction, regularity) = least_squares_with_ratio(&derivative, &miss);
        let correction = correction.component_div(&problem.sizes());
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
        let shrinks_by = other.norm() / miss.norm();
        let is_exact = shrinks_by > 0.5 && miss.norm() < problem.allowed(&unknowns);
        slow = if shrinks_by > 0.9 { slow + 1 } else { 0 };
        (unknowns, miss) = (next, other);
        if is_exact || slow == SLOW || miss.norm() == 0.0 {
            break;
        }
    }
    Ok(Reached { unknowns, miss, regularity })
}

/// The derivative of the miss by the unknowns in units of their sizes, so that singular values do
/// not depend on units. It is computed by central differences, or, if the miss at the point is
/// given, by differences to one side.
fn by_differences(
    problem: &impl Equations,
    unknowns: &DVector<f64>,
    miss: Option<&DVector<f64>>,
    tolerance: f64,
) -> Result<DMatrix<f64>, Error> {
    let (sizes, whole) = (problem.sizes(), problem.size(unknowns));
    let change = DIFFERENCE * if whole > 0.0 { whole } else { 1.0 };
    let columns = (0..unknowns.len()).map(|i| {
        let moved = |by: f64| {
            let mut moved = unknowns.clone();
            moved[i] += by / sizes[i];
            problem.miss(&moved, tolerance)
        };
        match miss {
            Some(miss) => Ok((moved(change)? - miss) / change),
            None => Ok((moved(change)? - moved(-change)?) / (2.0 * change)),
        }
    });
    Ok(DMatrix::from_columns(&columns.collect::<Result<Vec<_>, Error>>()?))
}
