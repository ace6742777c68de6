//! Exact linear algebra over any [`Field`](crate::Field): sparse matrices and their echelon form.
//!
//! The same code computes with rationals, rational functions and floats. Exact scalars are stored
//! in lowest terms. Every intermediate number is therefore a quotient of minors of the matrix, and
//! its size is bounded (E. H. Bareiss, *Math. Comp.* 22 (1968) 565-578). Whether a float counts as
//! zero is decided by its [`Sum`] and the [`Tolerance`] of the matrix.
//!
//! The ring of scalars may contain non-units other than zero. Determinants are correct over any
//! commutative ring. Inverses are correct over local rings such as the dual numbers. An elimination
//! that needs the inverse of a non-unit returns [`LinearError::NotInvertible`].

mod balance;
mod echelon;
mod elimination;
pub mod modular;
mod row;

use crate::{Sum, Summable, Tolerance};
use std::fmt;

pub use balance::balancing;
pub use echelon::Echelon;
pub use row::Row;
use row::{add_multiple, at, collect, finish};

/// A rectangular matrix, stored as sparse rows without zeros.
///
/// ```
/// use affinor_tensors::{Rational, linear::Matrix};
/// let entry = |n: i64| Rational::from(n);
/// let a = Matrix::from_dense(&[vec![entry(2), entry(1)], vec![entry(5), entry(3)]])?;
/// let inverse = a.inverse().expect("the determinant is 1");
/// assert_eq!(inverse.to_string(), "[3, -1]\n[-5, 2]");
/// assert_eq!(a.mul(&inverse)?, Matrix::identity(2));
/// # Ok::<(), affinor_tensors::linear::LinearError>(())
/// ```
#[derive(Clone, Debug)]
pub struct Matrix<S> {
    columns: usize,
    rows: Vec<Row<S>>,
    tolerance: Tolerance,
}

/// An error of linear algebra.
#[non_exhaustive]
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum LinearError {
    /// A row of a dense matrix is longer or shorter than the first.
    #[error("row {row} has {found} entries, the first row {expected}")]
    Ragged {
        /// The offending row, from 0.
        row: usize,
        /// The length of the first row.
        expected: usize,
        /// The length of the offending row.
        found: usize,
    },
    /// An entry is outside the matrix.
    #[error("column {column} is out of range for {columns} columns")]
    Column {
        /// The column of the entry, from 0.
        column: usize,
        /// The number of columns.
        columns: usize,
    },
    /// The shapes (rows, columns) of two terms or two factors, or of the two sides of a system, do
    /// not match.
    #[error("shapes {}x{} and {}x{} do not match", .left.0, .left.1, .right.0, .right.1)]
    Shape {
        /// The numbers of rows and columns of the left operand.
        left: (usize, usize),
        /// The numbers of rows and columns of the right operand.
        right: (usize, usize),
    },
    /// The determinant of a matrix that is not square was requested.
    #[error("a {rows}x{columns} matrix is not square")]
    NotSquare {
        /// The number of rows.
        rows: usize,
        /// The number of columns.
        columns: usize,
    },
    /// None of the possible pivots is a unit, but some of them are not zero. This error cannot
    /// occur in a field.
    #[error("none of the nonzero entries left in column {column} can be inverted")]
    NotInvertible {
        /// The column in which the pivot is missing, from 0.
        column: usize,
    },
}

impl<S: Summable> Matrix<S> {
    /// The matrix with these rows. A row is a list of entries `(column, value)` in any order.
    /// Entries in the same column are added.
    ///
    /// # Errors
    /// [`LinearError::Column`] if an entry is outside the matrix.
    pub fn from_rows<R: IntoIterator<Item = (usize, S)>>(
        columns: usize,
        rows: impl IntoIterator<Item = R>,
    ) -> Result<Self, LinearError> {
        let tolerance = Tolerance::default();
        let mut matrix = Matrix { columns, rows: vec![], tolerance };
        for row in rows {
            let row = collect(row, tolerance);
            match row.last() {
                Some(&(column, _)) if column >= columns => {
                    return Err(LinearError::Column { column, columns });
                }
                _ => matrix.rows.push(row),
            }
        }
        Ok(matrix)
    }

    /// The matrix with these dense rows. If there are no rows, it has no columns either.
    ///
    /// # Errors
    /// [`LinearError::Ragged`] if the rows have different lengths.
    pub fn from_dense(rows: &[Vec<S>]) -> Result<Self, LinearError> {
        let expected = rows.first().map_or(0, Vec::len);
        if let Some(row) = rows.iter().position(|row| row.len() != expected) {
            let found = rows[row].len();
            return Err(LinearError::Ragged { row, expected, found });
        }
        Self::from_rows(expected, rows.iter().map(|row| row.iter().cloned().enumerate()))
    }

    /// The square matrix with this diagonal.
    pub fn diagonal(entries: impl IntoIterator<Item = S>) -> Self {
        let tolerance = Tolerance::default();
        let rows: Vec<_> =
            (entries.into_iter().enumerate()).map(|entry| collect([entry], tolerance)).collect();
        Matrix { columns: rows.len(), rows, tolerance }
    }

    /// The identity matrix with `n` rows.
    pub fn identity(n: usize) -> Self {
        Self::diagonal(std::iter::repeat_n(S::one(), n))
    }

    /// The zero matrix.
    pub fn zero(rows: usize, columns: usize) -> Self {
        Matrix { columns, rows: vec![vec![]; rows], tolerance: Tolerance::default() }
    }

    /// The same matrix with another tolerance. Only computations in floats use the tolerance.
    #[must_use]
    pub fn with_tolerance(mut self, tolerance: Tolerance) -> Self {
        self.tolerance = tolerance;
        self
    }

    /// The number of rows.
    pub fn rows(&self) -> usize {
        self.rows.len()
    }

    /// The number of columns.
    pub fn columns(&self) -> usize {
        self.columns
    }

    /// The tolerance that computations with this matrix use.
    pub fn tolerance(&self) -> Tolerance {
        self.tolerance
    }

    /// The entry in row `i` and column `j`, from 0; zero if it is not stored.
    pub fn get(&self, i: usize, j: usize) -> S {
        at(self.row(i), j).cloned().unwrap_or_else(S::zero)
    }

    /// The nonzero entries `(column, value)` of row `i`. The list is empty if the matrix has no
    /// such row.
    pub fn row(&self, i: usize) -> &[(usize, S)] {
        self.rows.get(i).map_or(&[], Vec::as_slice)
    }

    /// The nonzero entries `(row, column, value)`, row by row.
    pub fn entries(&self) -> impl Iterator<Item = (usize, usize, &S)> {
        (self.rows.iter().enumerate())
            .flat_map(|(i, row)| row.iter().map(move |(j, value)| (i, *j, value)))
    }

    /// All entries, row by row. Zeros are included.
    pub fn to_dense(&self) -> Vec<Vec<S>> {
        let dense = |row: &Row<S>| {
            let mut entries = vec![S::zero(); self.columns];
            (row.iter()).for_each(|(j, value)| entries[*j] = value.clone());
            entries
        };
        self.rows.iter().map(dense).collect()
    }

    /// The transpose, in which the entry `(i, j)` is the entry `(j, i)` of this matrix.
    #[must_use]
    pub fn transpose(&self) -> Self {
        let mut rows = vec![vec![]; self.columns];
        for (i, j, value) in self.entries() {
            rows[j].push((i, value.clone()));
        }
        Matrix { columns: self.rows(), rows, tolerance: self.tolerance }
    }

    /// Maps the entries of the matrix into another ring. The tolerance remains the same. The
    /// function `f` must map zero to zero, because it is called only for nonzero entries.
    pub fn map<T: Summable>(&self, f: impl Fn(&S) -> T) -> Matrix<T> {
        let mapped = |row: &Row<S>| {
            let values = row.iter().map(|(j, value)| (*j, f(value)));
            values.filter(|(_, value)| !value.vanishes()).collect()
        };
        Matrix {
            columns: self.columns,
            rows: self.rows.iter().map(mapped).collect(),
            tolerance: self.tolerance,
        }
    }

    /// The sum `A + B`.
    ///
    /// # Errors
    /// [`LinearError::Shape`] unless `A` and `B` have the same shape.
    pub fn add(&self, other: &Self) -> Result<Self, LinearError> {
        if (self.rows(), self.columns) != (other.rows(), other.columns) {
            return Err(self.mismatch(other.rows(), other.columns));
        }
        let tolerance = self.tolerance.weaker(other.tolerance);
        let sum = |(a, b): (&Row<S>, &Row<S>)| collect(a.iter().chain(b).cloned(), tolerance);
        let rows = self.rows.iter().zip(&other.rows).map(sum).collect();
        Ok(Matrix { columns: self.columns, rows, tolerance })
    }

    /// The product `A B`, with `(AB)_ij = A_ik B_kj`.
    ///
    /// # Errors
    /// [`LinearError::Shape`] unless the number of rows of `B` is the number of columns of `A`.
    pub fn mul(&self, other: &Self) -> Result<Self, LinearError> {
        if self.columns != other.rows() {
            return Err(self.mismatch(other.rows(), other.columns));
        }
        let tolerance = self.tolerance.weaker(other.tolerance);
        let product = |row: &Row<S>| {
            let sums = (row.iter())
                .fold(vec![], |sums, (k, value)| add_multiple(sums, value, other.row(*k)));
            finish(sums, tolerance)
        };
        Ok(Matrix {
            columns: other.columns,
            rows: self.rows.iter().map(product).collect(),
            tolerance,
        })
    }

    /// The vector `A x`, with `(A x)_i = A_ij x_j`.
    ///
    /// # Errors
    /// [`LinearError::Shape`] unless `x` has one component for each column of `A`.
    pub fn apply(&self, x: &[S]) -> Result<Vec<S>, LinearError> {
        if self.columns != x.len() {
            return Err(self.mismatch(x.len(), 1));
        }
        let component = |row: &Row<S>| {
            let mut sum = S::Sum::term(&S::zero());
            (row.iter()).for_each(|(j, value)| sum.add_product(value, &x[*j]));
            sum.finish(self.tolerance).unwrap_or_else(S::zero)
        };
        Ok(self.rows.iter().map(component).collect())
    }

    /// The rows of `[A | B]`, where `A` is this matrix, and `B` is an additional block of columns
    /// on its right.
    fn beside(&self, block: impl IntoIterator<Item = Row<S>>) -> impl Iterator<Item = Row<S>> {
        self.rows.iter().zip(block).map(|(row, right)| {
            let shifted = right.into_iter().map(|(j, value)| (j + self.columns, value));
            row.iter().cloned().chain(shifted).collect()
        })
    }

    fn mismatch(&self, rows: usize, columns: usize) -> LinearError {
        LinearError::Shape { left: (self.rows(), self.columns), right: (rows, columns) }
    }
}

/// Two matrices are equal if their shapes and entries are equal. The tolerance is ignored.
impl<S: PartialEq> PartialEq for Matrix<S> {
    fn eq(&self, other: &Self) -> bool {
        self.columns == other.columns && self.rows == other.rows
    }
}

/// Writes all entries, with one row per line: `[1, 0]`.
impl<S: Summable> fmt::Display for Matrix<S> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (i, row) in self.to_dense().iter().enumerate() {
            let entries: Vec<_> = row.iter().map(S::to_string).collect();
            let end = if i + 1 < self.rows() { "\n" } else { "" };
            write!(f, "[{}]{end}", entries.join(", "))?;
        }
        Ok(())
    }
}
