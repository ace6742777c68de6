//! The reduced row echelon form of a subspace, built row by row.

use super::row::{add_multiple, at, collect, finish, open};
use super::{LinearError, Row};
use crate::{Field, Summable, Tolerance};

/// A subspace that is represented by its reduced row echelon basis. The first nonzero component of
/// every basis vector is 1, which is its pivot; the other basis vectors are zero in this column.
///
/// Equal subspaces have equal bases if all vectors are added by [`insert`](Self::insert). A pivot
/// that [`insert_heaviest`](Self::insert_heaviest) chooses need not be the first nonzero component.
///
/// ```
/// use affinor_tensors::{Rational, linear::Echelon};
/// let vector = |x: i64, y: i64| vec![(0, Rational::from(x)), (1, Rational::from(y))];
/// let mut line = Echelon::new();
/// assert!(line.insert(vector(2, 4))?);
/// assert!(!line.insert(vector(-3, -6))?);
/// assert_eq!(line.rows(), [vector(1, 2)]);
/// assert_eq!(line.nullspace(2), [vector(-2, 1)]);
/// # Ok::<(), affinor_tensors::linear::LinearError>(())
/// ```
#[derive(Clone, Debug)]
pub struct Echelon<S> {
    pivots: Vec<usize>,
    rows: Vec<Row<S>>,
    tolerance: Tolerance,
}

impl<S: Field + Summable> Echelon<S> {
    /// The zero subspace, with the default tolerance.
    pub fn new() -> Self {
        Self::default()
    }

    /// The same subspace with another tolerance. Only computations in floats use the tolerance.
    #[must_use]
    pub fn with_tolerance(mut self, tolerance: Tolerance) -> Self {
        self.tolerance = tolerance;
        self
    }

    /// The dimension of the subspace.
    pub fn rank(&self) -> usize {
        self.rows.len()
    }

    /// The pivot columns, in ascending order.
    pub fn pivots(&self) -> &[usize] {
        &self.pivots
    }

    /// The basis, in the order of the pivots.
    pub fn rows(&self) -> &[Row<S>] {
        &self.rows
    }

    /// Adds a vector to the span. Returns whether the vector was linearly independent of the
    /// subspace.
    ///
    /// # Errors
    /// [`LinearError::NotInvertible`] if the leading entry of the remainder is a non-unit.
    pub fn insert(
        &mut self,
        row: impl IntoIterator<Item = (usize, S)>,
    ) -> Result<bool, LinearError> {
        let remainder = self.reduce(row);
        self.insert_at(remainder, |row| row.first())
    }

    /// Adds a vector to the span as in [`insert`](Self::insert), but with another pivot. The pivot
    /// is the component of the remainder with the largest [`Field::pivot_weight`] among the first
    /// `columns`. With this pivot, floats remain accurate, and exact numbers remain short. Returns
    /// `false` if all these components are zero.
    ///
    /// # Errors
    /// [`LinearError::NotInvertible`] if the component with the largest weight is a non-unit.
    pub fn insert_heaviest(
        &mut self,
        row: impl IntoIterator<Item = (usize, S)>,
        columns: usize,
    ) -> Result<bool, LinearError> {
        let remainder = self.reduce(row);
        self.insert_at(remainder, |row| heaviest(row.iter().filter(|(j, _)| *j < columns)))
    }

    /// Adds the remainder of a vector to the span. The function `choose` selects the pivot in the
    /// remainder.
    fn insert_at(
        &mut self,
        remainder: Row<S>,
        choose: impl Fn(&[(usize, S)]) -> Option<&(usize, S)>,
    ) -> Result<bool, LinearError> {
        let Some((column, lead)) = choose(&remainder) else {
            return Ok(false);
        };
        let column = *column;
        let unit = (lead.recip()).ok_or(LinearError::NotInvertible { column })?;
        self.place(column, normalised(&unit, column, remainder));
        Ok(true)
    }

    /// The remainder of a vector modulo the subspace. It is zero in every pivot column.
    pub fn reduce(&self, row: impl IntoIterator<Item = (usize, S)>) -> Row<S> {
        self.remainder(collect(row, self.tolerance))
    }

    fn remainder(&self, row: Row<S>) -> Row<S> {
        // the coordinates are the components of the vector at the pivots, because the basis is
        // reduced
        let parts = (row.iter()).filter_map(|(j, value)| Some((self.led_by(*j)?, value)));
        let sums = parts
            .fold(open(&row), |sums, (basis, value)| add_multiple(sums, &-value.clone(), basis));
        finish(sums, self.tolerance)
    }

    /// Whether the subspace contains the vector.
    pub fn contains(&self, row: impl IntoIterator<Item = (usize, S)>) -> bool {
        self.reduce(row).is_empty()
    }

    /// The coordinates of a vector in the basis [`rows`](Self::rows). Returns `None` if the
    /// subspace does not contain the vector.
    pub fn coordinates(&self, row: impl IntoIterator<Item = (usize, S)>) -> Option<Vec<S>> {
        let row = collect(row, self.tolerance);
        let coordinate = |pivot: &usize| at(&row, *pivot).cloned().unwrap_or_else(S::zero);
        let coordinates = self.pivots.iter().map(coordinate).collect();
        self.contains(row).then_some(coordinates)
    }

    /// A basis of the vectors `x` with `columns` components that satisfy `v_j x_j = 0` for all `v`
    /// of the subspace. There is one vector for each column without a pivot; its component in this
    /// column is 1.
    pub fn nullspace(&self, columns: usize) -> Vec<Row<S>> {
        let mut basis = vec![vec![]; columns];
        for (pivot, row) in self.pivots.iter().zip(&self.rows) {
            for (j, value) in row.iter().filter(|(j, _)| j != pivot && *j < columns) {
                basis[*j].push((*pivot, -value.clone()));
            }
        }
        (basis.into_iter().enumerate())
            .filter(|(j, _)| self.led_by(*j).is_none())
            .map(|(j, mut vector)| {
                vector.push((j, S::one()));
                vector
            })
            .collect()
    }

    /// Adds a remainder whose pivot is 1, and sets the pivot column of the other rows to zero.
    pub(super) fn place(&mut self, column: usize, row: Row<S>) {
        for other in &mut self.rows {
            if let Some(value) = at(other, column) {
                let factor = -value.clone();
                let sums = add_multiple(open(other), &factor, &row);
                *other = finish(sums, self.tolerance);
            }
        }
        let place = self.pivots.partition_point(|pivot| *pivot < column);
        self.pivots.insert(place, column);
        self.rows.insert(place, row);
    }

    fn led_by(&self, column: usize) -> Option<&Row<S>> {
        let place = self.pivots.binary_search(&column).ok()?;
        Some(&self.rows[place])
    }
}

/// Two echelons are equal if their subspaces are equal. The tolerance is ignored.
impl<S: PartialEq> PartialEq for Echelon<S> {
    fn eq(&self, other: &Self) -> bool {
        self.rows == other.rows
    }
}

impl<S> Default for Echelon<S> {
    fn default() -> Self {
        Echelon { pivots: vec![], rows: vec![], tolerance: Tolerance::default() }
    }
}

/// Multiplies a row by the inverse of its pivot entry.
pub(super) fn normalised<S: Summable>(unit: &S, pivot: usize, row: Row<S>) -> Row<S> {
    let scale = |(j, value): (usize, S)| (j, if j == pivot { S::one() } else { value * unit });
    row.into_iter().map(scale).filter(|(_, value)| !value.vanishes()).collect()
}

/// The component with the largest [`Field::pivot_weight`]. If several weights are equal, it is the
/// first of these components.
fn heaviest<'r, S: Field + Summable>(
    components: impl Iterator<Item = &'r (usize, S)>,
) -> Option<&'r (usize, S)> {
    let weigh = |component: &'r (usize, S)| (component, component.1.pivot_weight());
    let best = components.map(weigh).reduce(|best, next| if next.1 > best.1 { next } else { best });
    best.map(|(component, _)| component)
}
