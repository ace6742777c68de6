//! The nearest vector that satisfies linear equations which may be redundant: `y = f - Y mu` with
//! `Y^T y = r`. The columns of `Y` have at most the length 1.

use nalgebra::linalg::{Cholesky, PermutationSequence};
use nalgebra::{DMatrix, DVector, Dyn};
use nalgebra_sparse::factorization::CscCholesky;
use nalgebra_sparse::{CooMatrix, CscMatrix};

/// An equation counts as redundant if its part that is independent of others is at most this
/// multiple of its size.
pub(super) const DEPENDENT: f64 = 1e-6;

/// The factorization `Y P = Q R` with pivoting, whose leading columns span all equations that are
/// independent.
#[derive(Debug)]
pub(super) struct Pivoted {
    /// The columns of `Q` that span the independent equations, and their rows of `R`.
    directions: DMatrix<f64>,
    triangle: DMatrix<f64>,
    order: PermutationSequence<Dyn>,
}

impl Pivoted {
    pub fn new(columns: DMatrix<f64>) -> Self {
        if columns.is_empty() {
            // an empty matrix cannot be factorized
            let order = PermutationSequence::identity_generic(Dyn(0));
            let directions = DMatrix::zeros(columns.nrows(), 0);
            return Pivoted { directions, triangle: DMatrix::zeros(0, 0), order };
        }
        let (directions, triangle, order) = columns.col_piv_qr().unpack();
        let pivots = (0..triangle.nrows()).map(|k| triangle[(k, k)].abs());
        let rank = pivots.take_while(|pivot| *pivot > DEPENDENT).count();
        let directions = directions.columns(0, rank).into_owned();
        Pivoted { directions, triangle: triangle.rows(0, rank).into_owned(), order }
    }

    pub fn rank(&self) -> usize {
        self.triangle.nrows()
    }

    pub fn nearest(&self, free: DVector<f64>, target: DVector<f64>) -> DVector<f64> {
        let along = self.along(&free, target);
        free - &self.directions * along
    }

    /// The multipliers `mu` of the smallest norm.
    pub fn multipliers(&self, free: &DVector<f64>, target: DVector<f64>) -> DVector<f64> {
        let count = target.len();
        let along = self.along(free, target);
        let square = &self.triangle * self.triangle.transpose();
        let mut found = match Cholesky::new(square) {
            Some(square) if self.rank() > 0 => self.triangle.tr_mul(&square.solve(&along)),
            _ => DVector::zeros(count),
        };
        self.order.inv_permute_rows(&mut found);
        found
    }

    /// The part of `Y mu` along each column of `Q`.
    fn along(&self, free: &DVector<f64>, mut target: DVector<f64>) -> DVector<f64> {
        self.order.permute_rows(&mut target);
        let mut target = target.rows(0, self.rank()).into_owned();
        self.triangle.columns(0, self.rank()).tr_solve_upper_triangular_mut(&mut target);
        self.directions.tr_mul(free) - target
    }
}

/// The sparse factorization of `Y^T Y + e`, with a number `e` that is small against the squares of
/// the columns. Equations that are redundant have no solution without it.
///
/// The iteration `mu := mu + (Y^T Y + e)^-1 (Y^T (f - Y mu) - r)`, the method of augmented Lagrangians,
/// leads to the solution without `e`. It converges at the rate `e/(s^2 + e)`, for the singular values
/// `s` of `Y`.
#[derive(Debug)]
pub(super) struct Regularized {
    /// For each column of `Y`, its rows with their entries.
    columns: Vec<Vec<(usize, f64)>>,
    /// The number of rows of `Y`.
    height: usize,
    factor: CscCholesky<f64>,
    /// The column of `Y` at each place of the factorization.
    order: Vec<usize>,
}

/// The number `e`.
const SHIFT: f64 = DEPENDENT * DEPENDENT;
/// The largest number of steps of the iteration.
const STEPS: usize = 8;

impl Regularized {
    /// Returns `None` if an entry is not finite.
    pub fn new(columns: Vec<Vec<(usize, f64)>>, height: usize) -> Option<Self> {
        let count = columns.len();
        let mut by_row = vec![vec![]; height];
        for (at, column) in columns.iter().enumerate() {
            column.iter().for_each(|(row, entry)| by_row[*row].push((at, *entry)));
        }
        // the columns of the square
        let mut sums = vec![0.0; count];
        let mut is_reached = vec![false; count];
        let square = columns.iter().map(|column| {
            let mut reached = vec![];
            for (row, entry) in column {
                for (other, own) in &by_row[*row] {
                    if !std::mem::replace(&mut is_reached[*other], true) {
                        reached.push(*other);
                    }
                    sums[*other] += entry * own;
                }
            }
            reached.sort_unstable();
            reached.iter().for_each(|other| is_reached[*other] = false);
            let entries = reached.iter().map(|other| (*other, std::mem::take(&mut sums[*other])));
            entries.collect::<Vec<(usize, f64)>>()
        });
        let square: Vec<Vec<(usize, f64)>> = square.collect();
        let order = fill_reducing(&square)?;
        let mut place = vec![0; count];
        order.iter().enumerate().for_each(|(at, column)| place[*column] = at);
        let mut ordered = CooMatrix::new(count, count);
        for (column, entries) in square.iter().enumerate() {
            ordered.push(place[column], place[column], SHIFT);
            entries.iter().for_each(|(row, x)| ordered.push(place[*row], place[column], *x));
        }
        let factor = CscCholesky::factor(&CscMatrix::from(&ordered)).ok()?;
        Some(Regularized { columns, height, factor, order })
    }

    /// The number of singular values that are larger than those of redundant equations.
    pub fn rank(&self) -> usize {
        let lower = self.factor.l();
        let pivots = (0..lower.ncols()).map(|at| lower.col(at).values()[0]);
        pivots.filter(|pivot| *pivot > 10.0 * DEPENDENT).count()
    }

    pub fn nearest(&self, free: DVector<f64>, target: &DVector<f64>) -> DVector<f64> {
        self.iterate(free, target).0
    }

    /// The multipliers `mu` of the smallest norm.
    pub fn multipliers(&self, free: &DVector<f64>, target: &DVector<f64>) -> DVector<f64> {
        let found = self.iterate(free.clone(), target).1;
        // the factor `g = s^2/(s^2 + e)` is near 0 for redundant equations, and near 1 for the others;
        // `3 g^2 - 2 g^3` is nearer
        let kept = |x: &DVector<f64>| self.along_columns(&self.combined(&self.shifted_solution(x)));
        let square = kept(&kept(&found));
        let cube = kept(&square);
        square * 3.0 - cube * 2.0
    }

    /// The nearest vector, and multipliers that need not have the smallest norm.
    fn iterate(&self, free: DVector<f64>, target: &DVector<f64>) -> (DVector<f64>, DVector<f64>) {
        let mut multipliers = DVector::zeros(target.len());
        let (mut y, mut last) = (free.clone(), f64::INFINITY);
        for _ in 0..STEPS {
            let off = self.along_columns(&y) - target;
            let size = off.amax();
            if size > 0.25 * last {
                break;
            }
            last = size;
            multipliers += self.shifted_solution(&off);
            y = &free - self.combined(&multipliers);
        }
        (y, multipliers)
    }

    /// The products `Y^T y`.
    fn along_columns(&self, y: &DVector<f64>) -> DVector<f64> {
        let product =
            |column: &Vec<(usize, f64)>| column.iter().map(|(row, entry)| entry * y[*row]).sum();
        DVector::from_iterator(self.columns.len(), self.columns.iter().map(product))
    }

    /// The product `Y mu`.
    fn combined(&self, multipliers: &DVector<f64>) -> DVector<f64> {
        let mut sum = DVector::zeros(self.height);
        for (column, multiplier) in self.columns.iter().zip(multipliers) {
            column.iter().for_each(|(row, entry)| sum[*row] += entry * multiplier);
        }
        sum
    }

    /// The product `(Y^T Y + e)^-1 x`.
    fn shifted_solution(&self, x: &DVector<f64>) -> DVector<f64> {
        let mut ordered = x.select_rows(&self.order);
        self.factor.solve_mut(&mut ordered);
        let mut solution = DVector::zeros(x.len());
        self.order.iter().zip(&ordered).for_each(|(at, value)| solution[*at] = *value);
        solution
    }
}

/// An order of the columns of a symmetric matrix in which its factorization has few entries.
fn fill_reducing(columns: &[Vec<(usize, f64)>]) -> Option<Vec<usize>> {
    let (mut starts, mut rows) = (vec![0], vec![]);
    for column in columns {
        rows.extend(column.iter().map(|(row, _)| *row as i64));
        starts.push(rows.len() as i64);
    }
    let settings = amd::Control::default();
    let (order, _, _) = amd::order(columns.len() as i64, &starts, &rows, &settings).ok()?;
    Some(order.into_iter().map(|at| at as usize).collect())
}
