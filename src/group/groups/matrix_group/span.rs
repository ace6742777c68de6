//! The span of sparse matrices in floats, and the nearest matrix in the span.

use crate::Error;
use crate::numerics::double::Double;
use nalgebra::{DMatrix, DVector};
use std::collections::BTreeMap;

/// The nonzero entries `(position, value)` of a matrix. Positions are counted column by column.
type Entries = Vec<(usize, f64)>;

/// Linearly independent matrices `B_i` of one size, stored as their nonzero entries.
#[derive(Clone, Debug)]
pub(super) struct Span {
    size: usize,
    basis: Vec<Entries>,
    /// For each `i`, the linear form on matrices whose value is the coordinate `x^i` of the nearest
    /// matrix `x^j B_j`.
    nearest: Vec<Entries>,
}

impl Span {
    /// The span of square matrices. Each matrix is a list of its entries `(row, column, value)`.
    ///
    /// # Errors
    /// [`Error::SingularBasis`] for matrices that are linearly dependent up to rounding errors.
    pub fn new<I>(size: usize, matrices: impl IntoIterator<Item = I>) -> Result<Self, Error>
    where
        I: IntoIterator<Item = (usize, usize, f64)>,
    {
        let entries = |matrix: I| {
            let places = matrix.into_iter().map(|(i, j, value)| (j * size + i, value));
            let mut entries: Entries = places.filter(|(_, value)| *value != 0.0).collect();
            entries.sort_unstable_by_key(|(place, _)| *place);
            entries
        };
        let basis: Vec<Entries> = matrices.into_iter().map(entries).collect();
        let mut nearest = vec![vec![]; basis.len()];
        for block in blocks(&basis) {
            nearest_in_block(&basis, &block, &mut nearest)?;
        }
        Ok(Span { size, basis, nearest })
    }

    /// The number of rows of the matrices.
    pub fn size(&self) -> usize {
        self.size
    }

    /// The number of matrices.
    pub fn dimension(&self) -> usize {
        self.basis.len()
    }

    /// The linear combination `x^i B_i`.
    pub fn combination(&self, x: &DVector<f64>) -> DMatrix<f64> {
        let mut sum = DMatrix::zeros(self.size, self.size);
        let places = sum.as_mut_slice();
        for (entries, x) in self.basis.iter().zip(x.iter()) {
            entries.iter().for_each(|(place, value)| places[*place] += value * x);
        }
        sum
    }

    /// The combination as in [`combination`](Self::combination), but in double-double arithmetic,
    /// so that sums of entries have no rounding errors.
    pub fn double_combination(&self, x: &DVector<f64>) -> DMatrix<Double> {
        let mut sum = DMatrix::zeros(self.size, self.size);
        let places = sum.as_mut_slice();
        for (entries, x) in self.basis.iter().zip(x.iter()) {
            let x = Double::from(*x);
            entries.iter().for_each(|(place, value)| places[*place] += Double::from(*value) * x);
        }
        sum
    }

    /// The basis matrix at an index.
    pub fn matrix(&self, at: usize) -> DMatrix<f64> {
        let mut matrix = DMatrix::zeros(self.size, self.size);
        let places = matrix.as_mut_slice();
        self.basis[at].iter().for_each(|(place, value)| places[*place] = *value);
        matrix
    }

    /// The trace of a basis matrix.
    pub fn trace(&self, at: usize) -> f64 {
        let diagonal =
            self.basis[at].iter().filter(|(place, _)| place / self.size == place % self.size);
        diagonal.map(|(_, value)| value).sum()
    }

    /// The norm of a basis matrix.
    pub fn norm(&self, at: usize) -> f64 {
        self.basis[at].iter().map(|(_, value)| value * value).sum::<f64>().sqrt()
    }

    /// The product `g B_i h`.
    pub fn between(&self, g: &DMatrix<f64>, at: usize, h: &DMatrix<f64>) -> DMatrix<f64> {
        let n = self.size;
        // computes only the nonzero columns of g B_i, and the corresponding rows of h
        let entries = &self.basis[at];
        let columns: Vec<&[(usize, f64)]> = entries.chunk_by(|a, b| a.0 / n == b.0 / n).collect();
        let mut left = DMatrix::zeros(n, columns.len());
        let mut right = DMatrix::zeros(columns.len(), n);
        for (column, entries) in columns.iter().enumerate() {
            for (place, value) in *entries {
                left.column_mut(column).axpy(*value, &g.column(place % n), 1.0);
            }
            right.row_mut(column).copy_from(&h.row(entries[0].0 / n));
        }
        left * right
    }

    /// The coordinates of the matrix in the span that is nearest to `m` in the Frobenius norm.
    pub fn coordinates(&self, m: &DMatrix<f64>) -> DVector<f64> {
        let places = m.as_slice();
        let value = |form: &Entries| form.iter().map(|(place, v)| v * places[*place]).sum();
        DVector::from_iterator(self.dimension(), self.nearest.iter().map(value))
    }
}

/// Partitions the matrices into sorted sets. Matrices of different sets have no common nonzero
/// position.
fn blocks(basis: &[Entries]) -> Vec<Vec<usize>> {
    // each set of matrices is stored as a tree, whose root is the smallest index
    let mut above: Vec<usize> = (0..basis.len()).collect();
    fn root(above: &mut [usize], mut at: usize) -> usize {
        while above[at] != at {
            above[at] = above[above[at]];
            at = above[at];
        }
        at
    }
    let mut owner: BTreeMap<usize, usize> = BTreeMap::new();
    for (at, entries) in basis.iter().enumerate() {
        for (place, _) in entries {
            let (a, b) = (root(&mut above, at), *owner.entry(*place).or_insert(at));
            let b = root(&mut above, b);
            above[a.max(b)] = a.min(b);
        }
    }
    let mut blocks: BTreeMap<usize, Vec<usize>> = BTreeMap::new();
    for at in 0..basis.len() {
        blocks.entry(root(&mut above, at)).or_default().push(at);
    }
    blocks.into_values().collect()
}

/// The linear forms of the matrices of a block: the rows of the pseudoinverse, computed by QR.
fn nearest_in_block(
    basis: &[Entries],
    block: &[usize],
    nearest: &mut [Entries],
) -> Result<(), Error> {
    let mut places: Vec<usize> =
        block.iter().flat_map(|&at| basis[at].iter().map(|(place, _)| *place)).collect();
    places.sort_unstable();
    places.dedup();
    let mut columns = DMatrix::zeros(places.len(), block.len());
    for (column, &at) in block.iter().enumerate() {
        for (place, value) in &basis[at] {
            if let Ok(row) = places.binary_search(place) {
                columns[(row, column)] = *value;
            }
        }
    }
    if places.len() < block.len() {
        return Err(Error::SingularBasis);
    }
    let (q, r) = columns.clone().qr().unpack();
    let forms = r.solve_upper_triangular(&q.transpose()).ok_or(Error::SingularBasis)?;
    // If translations are large (kilometres), QR computes the rotations only to the rounding error
    // of a kilometre. One Newton step for the equation `forms * columns = 1` corrects each entry to
    // its own rounding error.
    let residual = DMatrix::identity(block.len(), block.len()) - &forms * &columns;
    let forms = &forms + residual * &forms;
    for (row, &at) in block.iter().enumerate() {
        let values =
            places.iter().enumerate().map(|(column, place)| (*place, forms[(row, column)]));
        nearest[at] = values.filter(|(_, value)| *value != 0.0).collect();
    }
    Ok(())
}
