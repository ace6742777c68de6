//! Gaussian elimination. It computes the rank, the nullspace, solutions, the inverse and the
//! determinant.

use super::echelon::normalised;
use super::row::{add_multiple, finish, open};
use super::{Echelon, LinearError, Matrix, Row};
use crate::{Field, Sum, Summable, Tolerance};
use std::collections::BTreeMap;

impl<S: Field + Summable> Matrix<S> {
    /// The reduced row echelon form.
    ///
    /// # Errors
    /// [`LinearError::NotInvertible`] if a pivot has no inverse. This error cannot occur over a
    /// field.
    pub fn echelon(&self) -> Result<Echelon<S>, LinearError> {
        let pivots = eliminate(self.rows.iter().cloned(), &self.row_scales(), self.tolerance)?;
        Ok(reduced(pivots, self.tolerance))
    }

    /// The rank.
    ///
    /// # Errors
    /// The errors of [`echelon`](Self::echelon).
    pub fn rank(&self) -> Result<usize, LinearError> {
        Ok(eliminate(self.rows.iter().cloned(), &self.row_scales(), self.tolerance)?.len())
    }

    /// A basis of `{x : A x = 0}`, as the rows of a matrix.
    ///
    /// # Errors
    /// The errors of [`echelon`](Self::echelon).
    pub fn nullspace(&self) -> Result<Self, LinearError> {
        Ok(self.spanned(self.echelon()?.nullspace(self.columns)))
    }

    /// The reduced row echelon basis of the span of the rows, as the rows of a matrix.
    ///
    /// # Errors
    /// The errors of [`echelon`](Self::echelon).
    pub fn row_space(&self) -> Result<Self, LinearError> {
        Ok(self.spanned(self.echelon()?.rows().to_vec()))
    }

    /// The solution of `A x = b` whose components in columns without a pivot are zero. Returns
    /// `None` if there is no solution. The difference of two solutions is an element of the
    /// [`nullspace`](Self::nullspace).
    ///
    /// # Errors
    /// [`LinearError::Shape`] unless `b` has one component for each row of `A`. The other errors
    /// are those of [`echelon`](Self::echelon).
    pub fn solve(&self, b: &[S]) -> Result<Option<Vec<S>>, LinearError> {
        if b.len() != self.rows() {
            return Err(self.mismatch(b.len(), 1));
        }
        let column = b.iter().map(|value| match value.vanishes() {
            true => vec![],
            false => vec![(0, value.clone())],
        });
        let right = Matrix { columns: 1, rows: column.collect(), tolerance: self.tolerance };
        let square = self.rows() == self.columns;
        if let Some(x) = square.then(|| S::solved(self, &right)).flatten() {
            return Ok(Some(x.to_dense().concat()));
        }
        let pivots = match eliminate(self.beside(right.rows), &self.row_scales(), self.tolerance) {
            // a pivot in the last column means an equation `0 = b` with nonzero `b`
            Err(LinearError::NotInvertible { column }) if column == self.columns => {
                return Ok(None);
            }
            pivots => pivots?,
        };
        if pivots.last().is_some_and(|pivot| pivot.column == self.columns) {
            return Ok(None);
        }
        let echelon = reduced(pivots, self.tolerance);
        let mut x = vec![S::zero(); self.columns];
        for (pivot, row) in echelon.pivots().iter().zip(echelon.rows()) {
            if let Some((_, value)) = row.last().filter(|(j, _)| *j == self.columns) {
                x[*pivot] = value.clone();
            }
        }
        Ok(Some(x))
    }

    /// The inverse of the matrix. Returns `None` unless the matrix is square and its determinant is
    /// a unit.
    ///
    /// Over a ring that is not local, such as Z/6, the result is also `None` if a column has no
    /// unit that could be a pivot.
    pub fn inverse(&self) -> Option<Self> {
        if self.rows() != self.columns {
            return None;
        }
        let right = Self::identity(self.columns);
        if let Some(inverse) = S::solved(self, &right) {
            return Some(inverse.with_tolerance(self.tolerance));
        }
        let rows = self.beside(right.rows);
        let pivots = eliminate(rows, &self.row_scales(), self.tolerance).ok()?;
        if pivots.last().is_some_and(|pivot| pivot.column >= self.columns) {
            return None;
        }
        let right = |row: &Row<S>| {
            let entries = row.iter().filter(|(j, _)| *j >= self.columns);
            entries.map(|(j, value)| (j - self.columns, value.clone())).collect()
        };
        let echelon = reduced(pivots, self.tolerance);
        Some(self.spanned(echelon.rows().iter().map(right).collect()))
    }

    /// The determinant. It is computed by elimination or, if a column contains only non-units,
    /// without divisions.
    ///
    /// # Errors
    /// [`LinearError::NotSquare`] if the matrix is not square.
    pub fn determinant(&self) -> Result<S, LinearError> {
        let (rows, columns) = (self.rows(), self.columns);
        if rows != columns {
            return Err(LinearError::NotSquare { rows, columns });
        }
        let pivots = eliminate(self.rows.iter().cloned(), &self.row_scales(), self.tolerance);
        let Ok(pivots) = pivots else {
            return self.division_free_determinant();
        };
        if pivots.len() < rows {
            return Ok(S::zero());
        }
        let product = (pivots.iter()).fold(S::one(), |product, pivot| product * &pivot.value);
        let origins: Vec<_> = pivots.iter().map(|pivot| pivot.origin).collect();
        Ok(if is_odd(&origins) { -product } else { product })
    }

    /// The determinant over any commutative ring (R. S. Bird, *Inform. Process. Lett.* 111 (2011)
    /// 1072-1074). The method begins with `F = A`, and replaces `F <- mu(F) A` `n - 1` times. Here
    /// `mu(F)` is the strictly upper triangle of `F` with the diagonal
    /// `-(F_{i+1,i+1} + ... + F_nn)`. The determinant is `(-1)^{n-1} F_11`.
    fn division_free_determinant(&self) -> Result<S, LinearError> {
        let mut power = self.clone();
        for _ in 1..self.rows() {
            let mut below = S::Sum::term(&S::zero());
            let mut rows = Vec::with_capacity(self.rows());
            for (i, row) in power.rows.iter().enumerate().rev() {
                let trace = below.finish(self.tolerance).map(|value| (i, -value));
                let upper = row.iter().filter(|(j, _)| *j > i).cloned();
                rows.push(trace.into_iter().chain(upper).collect());
                below.add_term(&power.get(i, i));
            }
            rows.reverse();
            power = self.spanned(rows).mul(self)?;
        }
        Ok(match self.rows() {
            0 => S::one(),
            n if n.is_multiple_of(2) => -power.get(0, 0),
            _ => power.get(0, 0),
        })
    }

    /// Scale factors of the rows. Together with factors of the columns, they scale the largest
    /// entry of each row and column to about 1 (D. Ruiz, report RAL-TR-2001-034). For a definite
    /// matrix, they scale the diagonal to about 1, for any units of the basis. The list is empty
    /// for scalars whose [weights](Field::pivot_weight) are not magnitudes.
    fn row_scales(&self) -> Vec<f64> {
        let Some((_, _, first)) = self.entries().next() else { return vec![] };
        if first.pivot_weight() <= 0.0 {
            return vec![];
        }
        let sizes: Vec<_> = self
            .entries()
            .map(|(i, j, value)| (i, j, value.pivot_weight()))
            .filter(|(_, _, size)| *size > 0.0 && size.is_finite())
            .collect();
        let (mut rows, mut columns) = (vec![1.0_f64; self.rows()], vec![1.0_f64; self.columns]);
        for _ in 0..SWEEPS {
            let (mut of_rows, mut of_columns) =
                (vec![0.0_f64; self.rows()], vec![0.0_f64; self.columns]);
            for &(i, j, size) in &sizes {
                let scaled = rows[i] * size * columns[j];
                of_rows[i] = of_rows[i].max(scaled);
                of_columns[j] = of_columns[j].max(scaled);
            }
            let scale = |factors: &mut [f64], largest: &[f64]| {
                let pairs = factors.iter_mut().zip(largest).filter(|(_, largest)| **largest > 0.0);
                pairs.for_each(|(factor, largest)| *factor /= largest.sqrt());
            };
            scale(&mut rows, &of_rows);
            scale(&mut columns, &of_columns);
            if of_rows.iter().chain(&of_columns).all(|x| *x == 0.0 || (0.5..=2.0).contains(x)) {
                break;
            }
        }
        rows
    }

    /// A matrix with these rows, which has the columns and the tolerance of this matrix.
    fn spanned(&self, rows: Vec<Row<S>>) -> Self {
        Matrix { columns: self.columns, rows, tolerance: self.tolerance }
    }
}

/// The largest number of sweeps of the scaling. Each sweep divides by the square roots of the
/// largest entries.
const SWEEPS: usize = 12;

/// A row that is a pivot row. It has been divided by its leading entry `value`.
struct Pivot<S> {
    column: usize,
    value: S,
    row: Row<S>,
    /// The index of this row in the matrix before the elimination.
    origin: usize,
}

/// A row during the elimination: its leading entry, and the sums of the later entries.
struct Candidate<S: Summable> {
    lead: S,
    weight: f64,
    rest: Row<S::Sum>,
    origin: usize,
}

/// The rows that are not yet pivot rows, grouped by their leading columns.
struct Waiting<'s, S: Summable> {
    candidates: BTreeMap<usize, Vec<Candidate<S>>>,
    /// A factor for the weights of each row. The list is empty if weights are compared without
    /// scaling.
    scales: &'s [f64],
    tolerance: Tolerance,
}

impl<S: Field + Summable> Waiting<'_, S> {
    fn push(&mut self, sums: Row<S::Sum>, origin: usize) {
        let value = |(j, sum): (usize, S::Sum)| Some((j, sum.finish(self.tolerance)?, sum));
        let mut entries = sums.into_iter().filter_map(value);
        if let Some((column, lead, _)) = entries.next() {
            let rest = entries.map(|(j, _, sum)| (j, sum)).collect();
            let weight = lead.pivot_weight() * self.scales.get(origin).unwrap_or(&1.0);
            let candidate = Candidate { weight, lead, rest, origin };
            self.candidates.entry(column).or_default().push(candidate);
        }
    }
}

/// Eliminates without back substitution. Returns the pivot rows, sorted by column. Every row is
/// zero before its pivot.
fn eliminate<S: Field + Summable>(
    rows: impl Iterator<Item = Row<S>>,
    scales: &[f64],
    tolerance: Tolerance,
) -> Result<Vec<Pivot<S>>, LinearError> {
    let mut waiting = Waiting::<S> { candidates: BTreeMap::new(), scales, tolerance };
    for (origin, row) in rows.enumerate() {
        waiting.push(open(&row), origin);
    }
    let mut pivots = vec![];
    while let Some((column, candidates)) = waiting.candidates.pop_first() {
        let (pivot, others) = choose(column, candidates, tolerance)?;
        for other in others {
            let sums = add_multiple(other.rest, &-other.lead, &pivot.row[1..]);
            waiting.push(sums, other.origin);
        }
        pivots.push(pivot);
    }
    Ok(pivots)
}

/// Selects the best candidate for the pivot row. Returns this row, normalized, and the other
/// candidates.
///
/// The best candidate has the largest [`Field::pivot_weight`], which for floats is scaled partial
/// pivoting. If several weights are equal, the row with the fewest entries is the best.
fn choose<S: Field + Summable>(
    column: usize,
    mut candidates: Vec<Candidate<S>>,
    tolerance: Tolerance,
) -> Result<(Pivot<S>, Vec<Candidate<S>>), LinearError> {
    candidates.sort_by(|a, b| {
        (b.weight.total_cmp(&a.weight))
            .then(a.rest.len().cmp(&b.rest.len()))
            .then(a.origin.cmp(&b.origin))
    });
    let (place, unit) = (candidates.iter().enumerate())
        .find_map(|(place, candidate)| Some((place, candidate.lead.recip()?)))
        .ok_or(LinearError::NotInvertible { column })?;
    let Candidate { lead, rest, origin, .. } = candidates.remove(place);
    let mut row = vec![(column, lead.clone())];
    row.extend(finish::<S>(rest, tolerance));
    let row = normalised(&unit, column, row);
    let pivot = Pivot { column, value: lead, row, origin };
    Ok((pivot, candidates))
}

/// Substitutes back, from the last pivot to the first, so that every row is reduced only once.
fn reduced<S: Field + Summable>(pivots: Vec<Pivot<S>>, tolerance: Tolerance) -> Echelon<S> {
    let mut echelon = Echelon::new().with_tolerance(tolerance);
    for pivot in pivots.into_iter().rev() {
        let row = echelon.reduce(pivot.row);
        echelon.place(pivot.column, row);
    }
    echelon
}

/// Whether a permutation is odd. It is odd if its length minus the number of its cycles is odd.
fn is_odd(permutation: &[usize]) -> bool {
    let mut seen = vec![false; permutation.len()];
    let mut odd = false;
    for start in 0..permutation.len() {
        let mut i = start;
        while !std::mem::replace(&mut seen[i], true) {
            i = permutation[i];
            odd ^= i != start;
        }
    }
    odd
}
