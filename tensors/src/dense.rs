//! Conversions between tensors and dense matrices or arrays of other crates.

use crate::{Summable, Tensor, TensorError, Variance};

/// The largest number of components of a dense array.
#[cfg(feature = "ndarray")]
const MAX_ARRAY: u64 = 1 << 24;

#[cfg(feature = "nalgebra")]
impl<S: Summable> Tensor<S> {
    /// Converts a tensor of rank 2 to a matrix of nalgebra. The first index is the row, as in
    /// `(ad_n)^i_k`.
    ///
    /// ```
    /// use affinor_tensors::{Tensor, Up, Down};
    /// // ad_x of the Heisenberg algebra, [x, y] = z: the adjoint of exp(x) is exp(ad_x) = 1 + ad_x
    /// let ad_x = Tensor::from_components(3, &[Up, Down], [([2, 1], 1.0)])?;
    /// assert_eq!(ad_x.to_dmatrix()?.exp()[(2, 1)], 1.0);
    /// # Ok::<(), affinor_tensors::TensorError>(())
    /// ```
    ///
    /// # Errors
    /// [`TensorError::Rank`] unless the tensor has rank 2.
    pub fn to_dmatrix(&self) -> Result<nalgebra::DMatrix<S>, TensorError> {
        if self.rank() != 2 {
            return Err(TensorError::Rank { rank: self.rank(), given: 2 });
        }
        let n = self.dimension();
        Ok(nalgebra::DMatrix::from_fn(n, n, |i, j| self[[i, j]].clone()))
    }

    /// Converts a square matrix of nalgebra to a tensor with these slots. The row is the first
    /// index.
    ///
    /// # Errors
    /// [`TensorError::NotSquare`] if the matrix is not square.
    pub fn from_dmatrix(
        matrix: &nalgebra::DMatrix<S>,
        slots: [Variance; 2],
    ) -> Result<Self, TensorError> {
        if !matrix.is_square() {
            return Err(TensorError::NotSquare { shape: vec![matrix.nrows(), matrix.ncols()] });
        }
        Tensor::from_fn(matrix.nrows(), slots, |[i, j]| matrix[(i, j)].clone())
    }
}

#[cfg(feature = "ndarray")]
impl<S: Summable> Tensor<S> {
    /// Converts the tensor to an array of ndarray with one axis for each slot. Components that are
    /// zero are included.
    ///
    /// ```
    /// use affinor_tensors::{Down, Tensor, Up};
    /// let tensor = Tensor::from_components(2, &[Up, Down, Down], [([0, 1, 1], 5.0)])?;
    /// let array = tensor.to_array()?;
    /// assert_eq!(array[[0, 1, 1]], 5.0);
    /// assert_eq!(Tensor::from_array(&array, &[Up, Down, Down])?, tensor);
    /// # Ok::<(), affinor_tensors::TensorError>(())
    /// ```
    ///
    /// # Errors
    /// [`TensorError::TooLarge`] if the array has more than 2^24 components.
    pub fn to_array(&self) -> Result<ndarray::ArrayD<S>, TensorError> {
        let (dimension, rank) = (self.dimension(), self.rank());
        if (dimension as u64).saturating_pow(rank as u32) > MAX_ARRAY {
            return Err(TensorError::TooLarge { dimension, rank });
        }
        let component = |at: ndarray::IxDyn| self[ndarray::Dimension::slice(&at)].clone();
        Ok(ndarray::ArrayD::from_shape_fn(vec![dimension; rank], component))
    }

    /// Converts an array of ndarray to a tensor. All axes must have the same length.
    ///
    /// An array without axes becomes a tensor of rank 0 in dimension 0.
    ///
    /// # Errors
    /// [`TensorError::NotSquare`] if axes have different lengths; [`TensorError::Rank`] unless
    /// there is one slot for each axis; [`TensorError::TooLarge`].
    pub fn from_array(array: &ndarray::ArrayD<S>, slots: &[Variance]) -> Result<Self, TensorError> {
        let shape = array.shape();
        if shape.len() != slots.len() {
            return Err(TensorError::Rank { rank: slots.len(), given: shape.len() });
        }
        if shape.windows(2).any(|pair| pair[0] != pair[1]) {
            return Err(TensorError::NotSquare { shape: shape.to_vec() });
        }
        // uses the iteration of the array, which follows the order of the indices for every memory
        // layout
        let row = array.iter().cloned().enumerate().filter(|(_, value)| !value.vanishes());
        Tensor::from_row(shape.first().copied().unwrap_or(0), slots, row)
    }
}
