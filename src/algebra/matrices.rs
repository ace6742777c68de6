//! Lie algebras of matrices: structure constants from a basis.

use super::Bracket;
use crate::{Error, Law};
use affinor_tensors::linear::{Echelon, Matrix};
use affinor_tensors::text::{combination, written};
use affinor_tensors::{Down, Field, Scalar, Tensor, Tolerance};
use nalgebra::DMatrix;

/// A complex number over a real scalar.
#[derive(Clone, Debug, PartialEq)]
pub struct Complex<S> {
    /// The real part.
    pub re: S,
    /// The imaginary part.
    pub im: S,
}

impl<S: Field + Scalar> Complex<S> {
    /// A real number.
    pub fn real(re: S) -> Self {
        Complex { re, im: S::zero() }
    }
}

/// Square matrices that are linearly independent over the reals. They are a basis of a matrix Lie
/// algebra if their span is closed under the commutator.
///
/// A complex matrix `A + iB` is stored as the real matrix `[[A, -B], [B, A]]`, because these
/// matrices have the same products. Independence, closure and span are therefore over the reals.
#[derive(Clone, Debug)]
pub struct MatrixBasis<S> {
    labels: Vec<String>,
    matrices: Vec<Matrix<S>>,
    /// The largest entry of each matrix. Floats that are small relative to this entry count as
    /// zero.
    scales: Vec<S>,
    complex: bool,
    tolerance: Tolerance,
    /// The rows of the echelon form: the entries of a matrix, followed by a unit vector that
    /// identifies the matrix.
    span: Echelon<S>,
}

impl<S: Field + Scalar> MatrixBasis<S> {
    /// The basis of `size` x `size` matrices. Each matrix is a list of its nonzero entries (row,
    /// column, value), with indices from 0.
    ///
    /// # Errors
    /// [`Error::Shape`] for an entry outside the matrix or a wrong number of labels;
    /// [`Error::NotFinite`]; [`Law::Independent`] with a linear combination that vanishes.
    #[doc(alias("matrix Lie algebra"))]
    pub fn new(
        labels: impl IntoIterator<Item: AsRef<str>>,
        size: usize,
        matrices: Vec<Vec<(usize, usize, Complex<S>)>>,
        tolerance: Tolerance,
    ) -> Result<Self, Error> {
        let labels = labels.into_iter().map(|label| label.as_ref().to_string());
        Self::labelled(labels.collect(), size, matrices, tolerance)
    }

    fn labelled(
        labels: Vec<String>,
        size: usize,
        matrices: Vec<Vec<(usize, usize, Complex<S>)>>,
        tolerance: Tolerance,
    ) -> Result<Self, Error> {
        if labels.len() != matrices.len() {
            let (expected, found) = (labels.len().to_string(), matrices.len().to_string());
            return Err(Error::Shape { what: "the number of matrices", expected, found });
        }
        let complex = matrices.iter().flatten().any(|(_, _, value)| !value.im.vanishes());
        let matrices: Vec<_> = matrices
            .into_iter()
            .map(|entries| real_form(size, entries, complex, tolerance))
            .collect::<Result<_, _>>()?;
        let span = Echelon::new().with_tolerance(tolerance);
        let scales: Vec<S> = matrices.iter().map(largest).collect();
        let mut basis = MatrixBasis { labels, matrices, scales, complex, tolerance, span };
        let entries = basis.entries();
        for (at, matrix) in basis.matrices.iter().enumerate() {
            let scale = &basis.scales[at];
            let noise =
                |(column, v): &(usize, S)| *column < entries && v.negligible(scale, tolerance);
            let row = flat(matrix).filter(|entry| !noise(entry)).chain([(entries + at, S::one())]);
            let mut remainder = basis.span.reduce(row);
            remainder.retain(|entry| !noise(entry));
            if remainder.first().is_none_or(|(column, _)| *column >= entries) {
                return Err(Law::Independent.broken([basis.named(&remainder)], "0"));
            }
            let entered = basis.span.insert_heaviest(remainder, entries);
            entered.map_err(|_| Error::SingularBasis)?;
        }
        Ok(basis)
    }

    /// The basis of square matrices of nalgebra that are real and have one size.
    ///
    /// ```
    /// use affinor::{LieAlgebra, MatrixBasis};
    /// use nalgebra::dmatrix;
    /// // upper triangular matrices: [x, y] = y
    /// let (x, y) = (dmatrix![1.0, 0.0; 0.0, 0.0], dmatrix![0.0, 1.0; 0.0, 0.0]);
    /// let algebra = LieAlgebra::try_from(MatrixBasis::from_dmatrices(["x", "y"], [&x, &y])?.bracket()?)?;
    /// assert_eq!(algebra.to_string(), "[x, y] = y");
    /// # Ok::<(), affinor::Error>(())
    /// ```
    ///
    /// # Errors
    /// The errors of [`new`](Self::new), and [`Error::Shape`] for a matrix that is not square or
    /// has another size.
    pub fn from_dmatrices<'m>(
        labels: impl IntoIterator<Item: AsRef<str>>,
        matrices: impl IntoIterator<Item = &'m DMatrix<S>>,
    ) -> Result<Self, Error> {
        let matrices: Vec<_> = matrices.into_iter().collect();
        let size = matrices.first().map_or(0, |matrix| matrix.nrows());
        if let Some(other) = matrices.iter().find(|matrix| matrix.shape() != (size, size)) {
            let (expected, found) = (format!("size {size}"), format!("{:?}", other.shape()));
            return Err(Error::Shape { what: "a matrix", expected, found });
        }
        let entries = |matrix: &DMatrix<S>| {
            let places = (0..size).flat_map(|i| (0..size).map(move |j| (i, j)));
            let entry = |(i, j)| (i, j, Complex::real(matrix[(i, j)].clone()));
            places.map(entry).filter(|(.., value)| !value.re.vanishes()).collect()
        };
        let matrices = matrices.into_iter().map(entries).collect();
        Self::new(labels, size, matrices, Tolerance::default())
    }

    /// The names of the matrices.
    pub fn labels(&self) -> &[String] {
        &self.labels
    }

    /// The matrices. Complex matrices are in their real form of twice the size.
    pub fn matrices(&self) -> &[Matrix<S>] {
        &self.matrices
    }

    /// The bracket of the algebra that the matrices span: `[A, B] = AB - BA` in coordinates of the
    /// basis.
    ///
    /// # Errors
    /// [`Law::Closure`] with the first commutator that leaves the span.
    pub fn bracket(&self) -> Result<Bracket<S>, Error> {
        let (n, entries) = (self.matrices.len(), self.entries());
        let size = self.size();
        let sparse: Vec<Vec<_>> = self.matrices.iter().map(|m| m.entries().collect()).collect();
        let mut constants = Vec::new();
        for (j, k) in (0..n).flat_map(|j| (j + 1..n).map(move |k| (j, k))) {
            // encodes the position (row, column) in the product A B as one number
            let product = |a: usize, b: usize| {
                sparse[a].iter().flat_map(move |&(r, m, x)| {
                    let row = self.matrices[b].row(m).iter();
                    row.map(move |(c, y)| (r * size + c, x.clone() * y))
                })
            };
            let commutator = product(j, k).chain(product(k, j).map(|(at, v)| (at, -v)));
            let scale = self.scales[j].clone() * &self.scales[k];
            for (column, value) in self.span.reduce(commutator) {
                match column.checked_sub(entries) {
                    Some(i) => {
                        let size = value.clone() * &self.scales[i];
                        if !size.negligible(&scale, self.tolerance) {
                            constants.push((j, k, i, -value));
                        }
                    }
                    None if value.negligible(&scale, self.tolerance) => {}
                    None => {
                        let at = [j, k].map(|at| self.labels[at].clone());
                        let entry = self.entry(column / size, column % size, value);
                        return Err(Law::Closure.broken(at, entry));
                    }
                }
            }
        }
        let bracket = Bracket::from_constants(&self.labels, constants)?;
        let structure = bracket.structure_constants().clone().with_tolerance(self.tolerance);
        Bracket::new(&self.labels, structure)
    }

    /// The coordinates of a matrix, given by its nonzero entries (row, column, value) from 0; `None`
    /// for a matrix outside the span.
    ///
    /// # Errors
    /// [`Error::Shape`] for an entry outside the matrix; [`Error::NotFinite`].
    pub fn coordinates(
        &self,
        entries: Vec<(usize, usize, Complex<S>)>,
    ) -> Result<Option<Vec<S>>, Error> {
        if !self.complex && entries.iter().any(|(.., value)| !value.im.vanishes()) {
            return Ok(None);
        }
        let size = if self.complex { self.size() / 2 } else { self.size() };
        let matrix = real_form(size, entries, self.complex, self.tolerance)?;
        let (columns, mut found) = (self.entries(), vec![S::zero(); self.matrices.len()]);
        for (column, value) in self.span.reduce(flat(&matrix)) {
            match column.checked_sub(columns) {
                Some(at) => found[at] = -value,
                None => return Ok(None),
            }
        }
        Ok(Some(found))
    }

    /// The Frobenius product `<A, B> = Re tr(A^* B)`, equation (102), with slots `[Down, Down]`.
    pub fn frobenius(&self) -> Tensor<S> {
        // halves the trace, because the real form counts the trace of a complex matrix twice
        let share = if self.complex { S::from_quotient(1, 2) } else { None }.unwrap_or_else(S::one);
        let product = |a: &Matrix<S>, b: &Matrix<S>| {
            let terms = a.entries().map(|(i, j, v)| b.get(i, j) * v);
            terms.fold(S::zero(), |sum, term| sum + &term) * &share
        };
        let n = self.matrices.len();
        let pairs = (0..n).flat_map(|a| (0..n).map(move |b| [a, b]));
        let values = pairs.map(|[a, b]| ([a, b], product(&self.matrices[a], &self.matrices[b])));
        Tensor::from_components(n, &[Down, Down], values)
            .expect("indices below the dimension")
            .with_tolerance(self.tolerance)
    }

    fn size(&self) -> usize {
        self.matrices.first().map_or(0, Matrix::rows)
    }

    fn entries(&self) -> usize {
        self.size() * self.size()
    }

    /// Writes an entry of the real form `[[A, -B], [B, A]]` as an entry of `A + iB`.
    fn entry(&self, row: usize, column: usize, value: S) -> String {
        let size = if self.complex { self.size() / 2 } else { self.size() };
        let value = match (row < size, column < size) {
            (true, true) | (false, false) => written(&value),
            (true, false) => combination([(-value, "i".to_string())]),
            (false, true) => combination([(value, "i".to_string())]),
        };
        format!("{value} at row {}, column {}", row % size + 1, column % size + 1)
    }

    /// Writes the linear combination of matrices that the unit vectors at the end of a remainder
    /// encode.
    fn named(&self, remainder: &[(usize, S)]) -> String {
        let entries = self.entries();
        combination(remainder.iter().map(|(column, v)| (v, self.labels[column - entries].clone())))
    }
}

fn real_form<S: Field + Scalar>(
    size: usize,
    entries: Vec<(usize, usize, Complex<S>)>,
    complex: bool,
    tolerance: Tolerance,
) -> Result<Matrix<S>, Error> {
    let mut rows = vec![Vec::new(); if complex { 2 * size } else { size }];
    for (i, j, Complex { re, im }) in entries {
        if i >= size || j >= size {
            let found = format!("an entry at row {}, column {}", i + 1, j + 1);
            return Err(Error::Shape { what: "a matrix", expected: format!("size {size}"), found });
        }
        if let Some(value) = [&re, &im].into_iter().find(|value| !value.is_number()) {
            let at = vec![i + 1, j + 1];
            return Err(Error::NotFinite { what: "a matrix", at, value: value.to_string() });
        }
        if complex {
            rows[i + size].extend([(j, im.clone()), (j + size, re.clone())]);
            rows[i].push((j + size, -im));
        }
        rows[i].push((j, re));
    }
    let columns = rows.len();
    let matrix = Matrix::from_rows(columns, rows).expect("columns checked above");
    Ok(matrix.with_tolerance(tolerance))
}

/// The entries of a matrix in one list, row after row.
fn flat<S: Field + Scalar>(matrix: &Matrix<S>) -> impl Iterator<Item = (usize, S)> {
    let columns = matrix.columns();
    matrix.entries().map(move |(i, j, v)| (i * columns + j, v.clone()))
}

/// The entry with the largest pivot weight; the weight of a float is its magnitude. Returns zero
/// for an empty matrix.
fn largest<S: Field + Scalar>(matrix: &Matrix<S>) -> S {
    let entries = matrix.entries().map(|(_, _, value)| value);
    let largest = entries.max_by(|a, b| a.pivot_weight().total_cmp(&b.pivot_weight()));
    largest.cloned().unwrap_or_else(S::zero)
}
