//! Changes of basis.

use crate::Error;
use crate::frame::{expect_slots, formula};
use affinor_tensors::contraction;
use affinor_tensors::linear::Matrix;
use affinor_tensors::{Down, Field, Tensor, Up};

/// A change of basis `e'_a = A^i_a e_i` with invertible `A`: constants, or functions over a chart.
#[derive(Clone, Debug)]
pub struct BasisChange<S> {
    matrix: Tensor<S>,
    inverse: Tensor<S>,
}

impl<S: Field> BasisChange<S> {
    /// The change with the matrix `A^i_a`, slots `[Up, Down]`: column `a` is the new `e'_a`.
    ///
    /// # Errors
    /// [`Error::Shape`]; [`Error::SingularBasis`] when `A` has no inverse.
    pub fn new(matrix: Tensor<S>) -> Result<Self, Error> {
        expect_slots("the change of basis", &matrix, matrix.dimension(), &[Up, Down])?;
        let inverse = inverse(&matrix).ok_or(Error::SingularBasis)?;
        let inverse = Tensor::from_components(matrix.dimension(), &[Up, Down], inverse)?;
        let inverse = inverse.with_tolerance(matrix.tolerance());
        Ok(BasisChange { matrix, inverse })
    }

    /// The matrix `A^i_a`.
    pub fn matrix(&self) -> &Tensor<S> {
        &self.matrix
    }

    /// The inverse `B^a_i`.
    pub fn inverse(&self) -> &Tensor<S> {
        &self.inverse
    }

    /// The components in the new basis: `A^-1` on every upper slot, `A` on every lower one.
    ///
    /// # Errors
    /// [`Error::Shape`] when the dimensions differ.
    pub fn apply(&self, tensor: &Tensor<S>) -> Result<Tensor<S>, Error> {
        expect_slots("the tensor", tensor, self.matrix.dimension(), tensor.slots())?;
        let letters = &LETTERS[..tensor.rank()];
        let mut result = tensor.clone();
        for (at, letter) in letters.chars().enumerate() {
            let old = letters.replace(letter, "p");
            let (before, after) = (indices(&old, &result), indices(letters, &result));
            result = match result.slots()[at] {
                Up => formula(
                    &format!("T{before} B^{letter}_p -> {after}"),
                    &[("T", &result), ("B", &self.inverse)],
                ),
                Down => formula(
                    &format!("T{before} A^p_{letter} -> {after}"),
                    &[("T", &result), ("A", &self.matrix)],
                ),
            };
        }
        Ok(result)
    }
}

/// The letters of the slots of a tensor; `m` and `p` are left for sums.
pub(crate) const LETTERS: &str = "abcdefgh";

/// One letter a slot, as the notation of contractions writes them.
pub(crate) fn indices<S: affinor_tensors::Ring>(letters: &str, tensor: &Tensor<S>) -> String {
    contraction::indices(letters.chars().zip(tensor.slots().iter().copied()))
}

/// The entries of the inverse of a tensor of rank 2 read as a matrix.
pub(crate) fn inverse<S: Field>(tensor: &Tensor<S>) -> Option<Vec<([usize; 2], S)>> {
    let inverse = to_matrix(tensor).inverse()?;
    Some(inverse.entries().map(|(i, j, v)| ([i, j], v.clone())).collect())
}

/// A tensor of rank 2 as a matrix: the first index is the row.
pub(crate) fn to_matrix<S: affinor_tensors::Ring>(tensor: &Tensor<S>) -> Matrix<S> {
    let n = tensor.dimension();
    let mut rows = vec![Vec::new(); n];
    for (at, value) in tensor.components() {
        rows[at[0]].push((at[1], value.clone()));
    }
    Matrix::from_rows(n, rows)
        .expect("columns of a square matrix")
        .with_tolerance(tensor.tolerance())
}
