//! Linear equations with a mass matrix and constraints that may be redundant.

use super::constraint::Rows;
use nalgebra::linalg::{Cholesky, PermutationSequence};
use nalgebra::{DMatrix, DVector, Dyn};

/// A constraint counts as redundant if its part that is independent of others is at most this
/// multiple of its size, measured by the kinetic energy.
const DEPENDENT: f64 = 1e-6;

/// The mass matrix `M = L L^T` with constraints `G x = r`, which may be redundant.
///
/// The columns of the matrix `Y = L^-1 G^T` belong to the rows of `G`. All columns of a constraint
/// are divided by the length of its longest column. Then `Y P = Q R` is the factorization with
/// pivoting, whose leading columns span all constraints that are independent.
pub(super) struct Reduction {
    mass: Cholesky<f64, Dyn>,
    /// The columns of `Q` that span the independent constraints, and their rows of `R`.
    directions: DMatrix<f64>,
    triangle: DMatrix<f64>,
    order: PermutationSequence<Dyn>,
    /// The rows of `G` that do not vanish, and the factor of each.
    kept: Vec<usize>,
    scales: DVector<f64>,
    /// The number of rows of `G`.
    count: usize,
}

impl Reduction {
    /// Returns `None` if the mass matrix is not positive definite, or if a number is not finite.
    pub fn new(mass: DMatrix<f64>, rows: &Rows) -> Option<Self> {
        if !rows.matrix.iter().all(|entry| entry.is_finite()) {
            return None;
        }
        let mass = Cholesky::new(mass)?;
        let mut columns = rows.matrix.transpose();
        mass.l_dirty().solve_lower_triangular_mut(&mut columns);
        let count = columns.ncols();
        let norms: Vec<f64> = columns.column_iter().map(|column| column.norm()).collect();
        let mut longest = vec![0.0_f64; count];
        for (norm, first) in norms.iter().zip(&rows.first) {
            longest[*first] = longest[*first].max(*norm);
        }
        let size = |row: usize| longest[rows.first[row]];
        let kept: Vec<usize> =
            (0..count).filter(|row| norms[*row] > DEPENDENT * size(*row)).collect();
        let scales = DVector::from_iterator(kept.len(), kept.iter().map(|row| 1.0 / size(*row)));
        let mut columns = columns.select_columns(&kept);
        for (scale, mut column) in scales.iter().zip(columns.column_iter_mut()) {
            column *= *scale;
        }
        let (directions, triangle, order) = match columns.is_empty() {
            // there is no factorization of an empty matrix
            true => {
                let order = PermutationSequence::identity_generic(Dyn(0));
                (DMatrix::zeros(columns.nrows(), 0), DMatrix::zeros(0, 0), order)
            }
            false => columns.col_piv_qr().unpack(),
        };
        let pivots = (0..triangle.nrows()).map(|k| triangle[(k, k)].abs());
        let rank = pivots.take_while(|pivot| *pivot > DEPENDENT).count();
        let directions = directions.columns(0, rank).into_owned();
        let triangle = triangle.rows(0, rank).into_owned();
        Some(Reduction { mass, directions, triangle, order, kept, scales, count })
    }

    /// The number of independent constraints.
    pub fn rank(&self) -> usize {
        self.triangle.nrows()
    }

    /// The vector `x` with `G x = right` that is nearest to `M^-1 forces`, in the metric `M`.
    pub fn nearest(&self, forces: &DVector<f64>, right: &DVector<f64>) -> DVector<f64> {
        let (mut x, along) = self.parts(forces, right);
        x -= &self.directions * along;
        self.mass.l_dirty().tr_solve_lower_triangular_mut(&mut x);
        x
    }

    /// The multipliers `lambda` of this solution, `M x = forces - G^T lambda`. If constraints are
    /// redundant, they are those of the smallest norm, with constraints of the same size in the
    /// metric of the kinetic energy.
    pub fn multipliers(&self, forces: &DVector<f64>, right: &DVector<f64>) -> DVector<f64> {
        let along = self.parts(forces, right).1;
        let square = &self.triangle * self.triangle.transpose();
        let mut found = match Cholesky::new(square) {
            Some(square) if self.rank() > 0 => self.triangle.tr_mul(&square.solve(&along)),
            _ => DVector::zeros(self.scales.len()),
        };
        self.order.inv_permute_rows(&mut found);
        let mut all = DVector::zeros(self.count);
        for ((row, scale), value) in self.kept.iter().zip(&self.scales).zip(&found) {
            all[*row] = scale * value;
        }
        all
    }

    /// The product `M x`.
    pub fn momentum(&self, x: &DVector<f64>) -> DVector<f64> {
        let l = self.mass.l();
        &l * l.tr_mul(x)
    }

    /// The vector `L^-1 forces`, and the constraint forces along the columns of `Q`.
    fn parts(&self, forces: &DVector<f64>, right: &DVector<f64>) -> (DVector<f64>, DVector<f64>) {
        let mut free = forces.clone();
        self.mass.l_dirty().solve_lower_triangular_mut(&mut free);
        let mut target = right.select_rows(&self.kept).component_mul(&self.scales);
        self.order.permute_rows(&mut target);
        let mut target = target.rows(0, self.rank()).into_owned();
        self.triangle.columns(0, self.rank()).tr_solve_upper_triangular_mut(&mut target);
        let along = self.directions.tr_mul(&free) - target;
        (free, along)
    }
}
