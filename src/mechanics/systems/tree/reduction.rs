//! Linear equations with a mass matrix and constraints that may be redundant.

use super::multipliers::{DEPENDENT, Pivoted, Regularized};
use super::rows::Rows;
use crate::mechanism::tree::MassFactor;
use nalgebra::{DMatrix, DVector};

/// The number of equations from which sparse factorizations are faster.
const MANY: usize = 120;

/// The mass matrix `M = L^T L` with constraints `G x = r`, which may be redundant.
///
/// The columns of the matrix `Y = L^-T G^T` belong to the rows of `G`. All columns of a constraint
/// are divided by the length of its longest column. With `y = L x` and `f = L^-T forces`, the
/// solution is `y = f - Y mu` with `Y^T y = r`.
#[derive(Debug)]
pub(super) struct Reduction {
    mass: MassFactor,
    /// The rows of `G` that do not vanish, and the factor of each.
    kept: Vec<usize>,
    scales: DVector<f64>,
    /// The number of rows of `G`.
    count: usize,
    solver: Solver,
}

/// The factorization of `Y`.
#[derive(Debug)]
enum Solver {
    Pivoted(Pivoted),
    Regularized(Regularized),
}

impl Reduction {
    /// Returns `None` if a number is not finite.
    pub fn new(mass: MassFactor, rows: &Rows) -> Option<Self> {
        let is_sparse = rows.entries.len() >= MANY;
        Self::with(mass, rows, is_sparse)
    }

    /// The equations with sparse factorizations or without.
    fn with(mass: MassFactor, rows: &Rows, is_sparse: bool) -> Option<Self> {
        if !rows.entries.iter().flatten().all(|(_, entry)| entry.is_finite()) {
            return None;
        }
        let columns = mass.sparse_solutions(&rows.entries);
        let norm = |own: &Vec<(usize, f64)>| own.iter().map(|(_, x)| x * x).sum::<f64>().sqrt();
        let norms: Vec<f64> = columns.iter().map(norm).collect();
        let mut longest = vec![0.0_f64; columns.len()];
        for (norm, first) in norms.iter().zip(&rows.first) {
            longest[*first] = longest[*first].max(*norm);
        }
        let size = |row: usize| longest[rows.first[row]];
        let count = columns.len();
        let kept: Vec<usize> =
            (0..count).filter(|row| norms[*row] > DEPENDENT * size(*row)).collect();
        let scales = DVector::from_iterator(kept.len(), kept.iter().map(|row| 1.0 / size(*row)));
        let mut columns: Vec<Vec<(usize, f64)>> =
            kept.iter().map(|row| columns[*row].clone()).collect();
        for (scale, column) in scales.iter().zip(&mut columns) {
            column.iter_mut().for_each(|(_, entry)| *entry *= scale);
        }
        let solver = if is_sparse {
            Solver::Regularized(Regularized::new(columns, rows.freedom())?)
        } else {
            let mut matrix = DMatrix::zeros(rows.freedom(), columns.len());
            for (at, column) in columns.iter().enumerate() {
                column.iter().for_each(|(rate, entry)| matrix[(*rate, at)] = *entry);
            }
            Solver::Pivoted(Pivoted::new(matrix))
        };
        Some(Reduction { mass, kept, scales, count, solver })
    }

    /// The number of independent constraints.
    pub fn rank(&self) -> usize {
        match &self.solver {
            Solver::Pivoted(solver) => solver.rank(),
            Solver::Regularized(solver) => solver.rank(),
        }
    }

    /// The vector `x` with `G x = right` that is nearest to `M^-1 forces`, in the metric `M`.
    pub fn nearest(&self, forces: &DVector<f64>, right: &DVector<f64>) -> DVector<f64> {
        let (free, target) = self.parts(forces, right);
        let y = match &self.solver {
            Solver::Pivoted(solver) => solver.nearest(free, target),
            Solver::Regularized(solver) => solver.nearest(free, &target),
        };
        self.mass.solution(&y)
    }

    /// The shortest vector `x` with `G x = right`, in the metric `M`.
    pub fn shortest(&self, right: &DVector<f64>) -> DVector<f64> {
        self.nearest(&DVector::zeros(self.mass.freedom()), right)
    }

    /// The vector `M^-1 forces`.
    pub fn unbound(&self, forces: &DVector<f64>) -> DVector<f64> {
        self.mass.solution(&self.mass.transposed_solution(forces))
    }

    /// The multipliers `lambda` of this solution, `M x = forces - G^T lambda`. If constraints are
    /// redundant, they are those of the smallest norm, with constraints of the same size in the
    /// metric of the kinetic energy.
    pub fn multipliers(&self, forces: &DVector<f64>, right: &DVector<f64>) -> DVector<f64> {
        let (free, target) = self.parts(forces, right);
        let found = match &self.solver {
            Solver::Pivoted(solver) => solver.multipliers(&free, target),
            Solver::Regularized(solver) => solver.multipliers(&free, &target),
        };
        let mut all = DVector::zeros(self.count);
        for ((row, scale), value) in self.kept.iter().zip(&self.scales).zip(&found) {
            all[*row] = scale * value;
        }
        all
    }

    /// The vector `L^-T forces`, and the right sides for the kept rows.
    fn parts(&self, forces: &DVector<f64>, right: &DVector<f64>) -> (DVector<f64>, DVector<f64>) {
        let target = right.select_rows(&self.kept).component_mul(&self.scales);
        (self.mass.transposed_solution(forces), target)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Loops of four rates each, the neighbours of which share two, with six equations of rank three.
    /// Two loops are nearly singular.
    fn chain(loops: usize) -> (MassFactor, Rows) {
        let freedom = 2 * loops + 2;
        let mut rows = Rows::new(6 * loops, freedom);
        for k in 0..loops {
            let first = rows.begin(1.0);
            let entry = |i: usize, j: usize| ((7 * k + 3 * i + 5 * j) as f64).sin();
            let small = if k % 5 == 2 { 1e-3 } else { 1.0 };
            for i in 0..6 {
                rows.push(Some(0.0), 0.0, 0.0);
                for j in 0..4 {
                    let own = |i: usize| {
                        // the third row is nearly a combination of the others
                        if i == 2 { entry(0, j) + small * entry(2, j) } else { entry(i, j) }
                    };
                    let value = if i < 3 { own(i) } else { own(i - 3) - 0.5 * own((i + 1) % 3) };
                    rows.add(first + i, 2 * k + j, value);
                }
            }
        }
        let weights = (0..freedom).map(|k| 1.0 + 0.5 * (k as f64).cos());
        (MassFactor::diagonal(weights), rows.complete())
    }

    /// Dense and sparse factorizations, for systems on both sides of the threshold.
    #[test]
    fn sparse_and_dense_solutions_agree() {
        for loops in [1, 3, 12, MANY / 6, MANY / 2] {
            let (mass, rows) = chain(loops);
            let [dense, sparse] = [false, true].map(|is_sparse| {
                Reduction::with(mass.clone(), &rows, is_sparse).expect("finite numbers")
            });
            assert_eq!(dense.rank(), sparse.rank(), "{loops}");
            let n = rows.freedom();
            let forces = DVector::from_fn(n, |k, _| (0.3 * k as f64).sin());
            // a right side that is consistent
            let right = rows.product(&DVector::from_fn(n, |k, _| (1.0 + k as f64).cos()));
            let [x, y] = [&dense, &sparse].map(|own| own.nearest(&forces, &right));
            assert!((&x - &y).amax() < 1e-9, "{loops}: {}", (&x - &y).amax());
            assert!((rows.product(&y) - &right).amax() < 1e-12);
            let [x, y] = [&dense, &sparse].map(|own| own.multipliers(&forces, &right));
            let size = x.amax();
            assert!((&x - &y).amax() < 1e-6 * size, "{loops}: {} of {size}", (&x - &y).amax());
        }
    }
}
