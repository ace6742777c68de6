//! Other assembled positions, found by Newton's method in floats.

use super::graph::Mechanism;
use crate::group::{LieGroup, Se3};
use crate::tensors::stop::checkpoint;
use nalgebra::{DMatrix, DVector, Isometry3, Vector6};

/// The closure errors and their derivatives at joint coordinates.
struct Closure {
    errors: DVector<f64>,
    jacobian: DMatrix<f64>,
}

/// An assembled position.
#[derive(Clone, Debug)]
pub struct Position {
    /// The joint coordinates, as differences from the given position.
    pub coordinates: DVector<f64>,
    /// The dimension of the rates.
    pub rates: usize,
    /// The ratio of the last nonzero singular value of the closure equations to the next one,
    /// bounded below by the rounding error. A large ratio certifies the rank.
    pub gap: f64,
}

/// The largest closure error of an assembled position, relative to the size of the mechanism.
const CLOSED: f64 = 1e-11;
/// The largest relative size of a singular value that counts as zero.
const ZERO: f64 = 1e-7;
/// The limit of Newton steps.
const STEPS: usize = 60;

impl Mechanism<f64> {
    fn closure(&self, q: &DVector<f64>) -> Option<Closure> {
        let count = self.loops().len();
        let mut errors = DVector::zeros(6 * count);
        let mut jacobian = DMatrix::zeros(6 * count, self.freedom());
        for (own, at) in self.loops().iter().zip(0..) {
            let mut pose = Isometry3::identity();
            for (k, twist) in self.chain(own) {
                let twist = Vector6::from(twist);
                let mut block = jacobian.fixed_view_mut::<6, 1>(6 * at, k);
                block += Se3.adjoint(&pose, &twist);
                pose = Se3.compose(&pose, &Se3.exp(&(twist * q[k])));
            }
            errors.fixed_rows_mut::<6>(6 * at).copy_from(&Se3.log(&pose).ok()?);
        }
        Some(Closure { errors, jacobian })
    }

    /// An assembled position near joint coordinates, if Newton's method finds one.
    pub fn assembled(&self, start: &DVector<f64>) -> Option<Position> {
        let mut q = start.clone();
        for _ in 0..STEPS {
            checkpoint();
            let Closure { errors, jacobian } = self.closure(&q)?;
            let size = jacobian.amax().max(1.0);
            let svd = jacobian.svd(true, true);
            if errors.amax() <= CLOSED * size {
                let mut values: Vec<f64> = svd.singular_values.iter().copied().collect();
                values.sort_by(|a, b| b.total_cmp(a));
                let largest = values.first().copied().unwrap_or(0.0);
                let rank = values.iter().filter(|value| **value > ZERO * largest).count();
                let next = values.get(rank).copied().unwrap_or(0.0);
                let floor = f64::EPSILON * largest;
                let last = if rank == 0 { 1.0 } else { values[rank - 1] };
                let gap = last / next.max(floor);
                let rates = q.len() - rank;
                return Some(Position { coordinates: q, rates, gap });
            }
            q -= svd.solve(&errors, ZERO * size).ok()?;
            if !q.iter().all(|value| value.is_finite()) {
                return None;
            }
        }
        None
    }

    /// Assembled positions near the given position: Newton's method starts at displacements along
    /// the rates, whose size is `reach`. Pseudo-random numbers with a fixed seed choose them.
    pub fn positions(&self, count: usize, reach: f64) -> Vec<Position> {
        let zero = DVector::zeros(self.freedom());
        let Some(Closure { jacobian, .. }) = self.closure(&zero) else { return vec![] };
        if jacobian.is_empty() {
            return vec![];
        }
        // the projector on the rates
        let square = jacobian.tr_mul(&jacobian).symmetric_eigen();
        let largest = square.eigenvalues.amax().max(f64::MIN_POSITIVE);
        let rates: Vec<_> = (0..self.freedom())
            .filter(|k| square.eigenvalues[*k] <= ZERO * largest)
            .map(|k| square.eigenvectors.column(k).into_owned())
            .collect();
        let mut seed = 0x2545_f491_4f6c_dd1d_u64;
        let mut random = || {
            seed ^= seed << 13;
            seed ^= seed >> 7;
            seed ^= seed << 17;
            (seed >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
        };
        let mut found = vec![];
        for _ in 0..count {
            let mut start = zero.clone();
            rates.iter().for_each(|rate| start += rate * (random() * reach));
            let moved = |position: &Position| position.coordinates.norm() > 1e-3 * reach;
            found.extend(self.assembled(&start).filter(moved));
        }
        found
    }
}
