//! Orthonormal bases that are adapted to a subgroup of unitary matrices.
//!
//! Each subgroup `K` of a symmetric pair consists of the unitary matrices that commute with some
//! operators. These are the complex conjugation, the antilinear map `P`, and a sign that separates
//! two groups of coordinates. Here `P(v) = -J conj(v)` with `J = [[0, 1], [-1, 0]]`. The columns of an
//! element of `K` are an orthonormal basis with real vectors, with pairs `v, P(v)`, or with vectors
//! in one of the two coordinate subspaces.
//!
//! nalgebra computes eigenvectors without this structure. [`Structure::extend`] selects adapted
//! vectors from them by Gram-Schmidt steps with pivots. The steps do not add errors at multiple or
//! nearly equal eigenvalues. Let `c` be the product of a computed eigenvector with an accepted
//! vector, and `d` the distance of their eigenvalues. Then `c d` is a rounding error, and so is the
//! residual of the orthogonalized vector.

use affinor_tensors::stop::checkpoint;
use nalgebra::{Complex, DMatrix, DVector};

pub(super) type Matrix = DMatrix<Complex<f64>>;
pub(super) type Vector = DVector<Complex<f64>>;

/// The operators that commute with a subgroup of unitary matrices.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Structure {
    /// The number of columns that determine a matrix: half its size if columns have pairs.
    pub count: usize,
    /// The number of these columns in the first coordinate subspace; `count` without a sign.
    pub first: usize,
    /// Whether the matrices are real.
    pub is_real: bool,
    /// Whether the matrices commute with `P`.
    pub is_paired: bool,
}

/// An eigenvector of a matrix that commutes with the subgroup.
pub(super) struct Eigenvector {
    pub value: f64,
    pub vector: Vector,
    /// Whether the vector is in the first coordinate subspace.
    pub is_first: bool,
}

impl Structure {
    /// The structure with other numbers of columns.
    pub fn with_counts(self, first: usize, second: usize) -> Self {
        Structure { count: first + second, first, ..self }
    }

    /// The number of rows of the matrices.
    pub fn size(&self) -> usize {
        if self.is_paired { 2 * self.count } else { self.count }
    }

    /// The indices of the first or the second coordinate subspace, with those of the pairs.
    pub fn indices(&self, is_first: bool) -> Vec<usize> {
        let own = if is_first { 0..self.first } else { self.first..self.count };
        let pairs = own.clone().map(|i| i + self.count);
        own.clone().chain(pairs.filter(|_| self.is_paired)).collect()
    }

    /// The matrix with these columns, followed by their pairs.
    pub fn assemble(&self, columns: &[Vector], rows: usize) -> Matrix {
        let pairs = columns.iter().filter(|_| self.is_paired).map(paired);
        let all: Vec<Vector> = columns.iter().cloned().chain(pairs).collect();
        match all.is_empty() {
            true => Matrix::zeros(rows, 0),
            false => Matrix::from_columns(&all),
        }
    }

    /// The nearest matrix that commutes with the operators.
    pub fn project(&self, m: &Matrix) -> Matrix {
        let mut m = m.clone();
        if self.is_real {
            m.apply(|value| value.im = 0.0);
        }
        if self.is_paired {
            m = (&m + commuted(&m)).scale(0.5);
        }
        let is_second = |i: usize| i % self.count.max(1) >= self.first;
        Matrix::from_fn(m.nrows(), m.ncols(), |i, j| {
            if is_second(i) == is_second(j) { m[(i, j)] } else { Complex::ZERO }
        })
    }

    /// Adapted eigenvectors of a Hermitian matrix that commutes with the operators: those of the
    /// first coordinate subspace, then those of the second one, each by decreasing eigenvalue.
    pub fn eigen(&self, h: &Matrix) -> Vec<Eigenvector> {
        let mut all = vec![];
        for is_first in [true, false] {
            checkpoint();
            let at = self.indices(is_first);
            let block = h.select_rows(&at).select_columns(&at);
            let inside =
                self.with_counts(if is_first { self.first } else { self.count - self.first }, 0);
            let mut vectors = eigenvectors(&block, self.is_real);
            if self.is_paired {
                let mut basis = vec![];
                inside.extend(&mut basis, vectors, inside.count);
                vectors = basis;
            }
            let value = |v: &Vector| v.dotc(&(&block * v)).re;
            let mut found: Vec<Eigenvector> = vectors
                .into_iter()
                .map(|v| Eigenvector {
                    value: value(&v),
                    vector: embedded(&v, &at, h.nrows()),
                    is_first,
                })
                .collect();
            found.sort_by(|a, b| b.value.total_cmp(&a.value));
            all.extend(found);
        }
        all
    }

    /// Extends an adapted orthonormal basis to `count` vectors by candidates that span the space.
    ///
    /// The next vector is the first candidate whose component orthogonal to the basis is at least
    /// half as large as the largest one.
    pub fn extend(&self, basis: &mut Vec<Vector>, candidates: Vec<Vector>, count: usize) {
        let mut rest = candidates;
        for v in &mut rest {
            basis.iter().for_each(|u| self.remove(v, u));
        }
        while basis.len() < count {
            checkpoint();
            let norms: Vec<f64> = rest.iter().map(|v| v.norm()).collect();
            let largest = norms.iter().copied().fold(0.0, f64::max);
            // a candidate exists, unless an entry is NaN
            let Some(at) = norms.iter().position(|n| *n >= 0.5 * largest && *n > 0.0) else {
                return;
            };
            let v = rest.remove(at);
            let v = self.orthonormal(v, basis);
            rest.iter_mut().for_each(|w| self.remove(w, &v));
            basis.push(v);
        }
    }

    /// Extends an adapted orthonormal basis to `count` vectors by unit vectors.
    pub fn complete(&self, basis: &mut Vec<Vector>, count: usize) {
        let size = self.size();
        self.extend(basis, units(size), count);
    }

    /// Normalizes the component of a vector that is orthogonal to a basis. The second pass removes
    /// the loss of orthogonality by cancellation.
    pub fn orthonormal(&self, v: Vector, basis: &[Vector]) -> Vector {
        let mut v = v;
        for _ in 0..2 {
            let norm = v.norm();
            if norm > 0.0 {
                v.unscale_mut(norm);
            }
            basis.iter().for_each(|u| self.remove(&mut v, u));
        }
        let norm = v.norm();
        v.unscale(norm)
    }

    /// Orthonormalizes vectors in their order. A vector that depends on the previous ones is
    /// replaced by a unit vector.
    pub fn orthonormalize(&self, vectors: &[Vector]) -> Vec<Vector> {
        let mut basis: Vec<Vector> = vec![];
        for v in vectors {
            let next = self.orthonormal(v.clone(), &basis);
            if next.iter().all(|value| value.is_finite()) {
                basis.push(next);
            } else {
                let count = basis.len() + 1;
                self.complete(&mut basis, count);
            }
        }
        basis
    }

    /// Subtracts the components of `v` along `u` and its pair.
    fn remove(&self, v: &mut Vector, u: &Vector) {
        let c = u.dotc(v);
        v.axpy(-c, u, Complex::ONE);
        if self.is_paired {
            let u = paired(u);
            let c = u.dotc(v);
            v.axpy(-c, &u, Complex::ONE);
        }
    }
}

/// The pair `P(v) = -J conj(v)` of a vector.
pub(super) fn paired(v: &Vector) -> Vector {
    let half = v.len() / 2;
    Vector::from_fn(v.len(), |i, _| if i < half { -v[i + half].conj() } else { v[i - half].conj() })
}

/// The matrix `P m P^-1`.
fn commuted(m: &Matrix) -> Matrix {
    let (rows, columns) = (m.nrows() / 2, m.ncols() / 2);
    Matrix::from_fn(m.nrows(), m.ncols(), |i, j| {
        let (row, column) = ((i + rows) % m.nrows(), (j + columns) % m.ncols());
        let value = m[(row, column)].conj();
        if (i < rows) == (j < columns) { value } else { -value }
    })
}

/// The vector with these entries at some indices, and zeros elsewhere.
pub(super) fn embedded(v: &Vector, at: &[usize], size: usize) -> Vector {
    let mut whole = Vector::zeros(size);
    at.iter().zip(v).for_each(|(i, value)| whole[*i] = *value);
    whole
}

/// The unit vectors.
pub(super) fn units(size: usize) -> Vec<Vector> {
    let unit = |i| Vector::from_fn(size, |j, _| Complex::new(f64::from(u8::from(i == j)), 0.0));
    (0..size).map(unit).collect()
}

/// Orthonormal eigenvectors of a Hermitian matrix, by decreasing eigenvalue.
pub(super) fn eigenvectors(h: &Matrix, is_real: bool) -> Vec<Vector> {
    if h.nrows() == 0 {
        return vec![];
    }
    let (values, vectors) = if is_real {
        let eigen = h.map(|value| value.re).symmetric_eigen();
        (eigen.eigenvalues, eigen.eigenvectors.map(|value| Complex::new(value, 0.0)))
    } else {
        let eigen = h.clone().symmetric_eigen();
        (eigen.eigenvalues, eigen.eigenvectors)
    };
    let mut order: Vec<usize> = (0..values.len()).collect();
    order.sort_by(|&i, &j| values[j].total_cmp(&values[i]));
    order.into_iter().map(|i| vectors.column(i).into_owned()).collect()
}
