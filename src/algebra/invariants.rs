//! Tensors that are invariant under a Lie algebra of endomorphisms.

use crate::Error;
use crate::algebra::LieAlgebra;
use crate::algebra::lie_derivative::act;
use affinor_tensors::linear::{Matrix, Row};
use affinor_tensors::{Field, Scalar, Tensor, Tolerance, Variance};

/// The largest number of unknowns in a search for invariants.
///
/// The time depends on the basis. With few structure constants, as in the catalogue, a search with
/// this number of unknowns needs seconds. In a dense basis the numbers become long, and a search
/// with a thousand unknowns needs minutes.
pub const MAX_UNKNOWNS: usize = 1 << 16;

/// A basis of the tensors with `slots` that every endomorphism `A^i_j` annihilates,
/// `A^i_p T^p_j - A^p_j T^i_p = 0`. The basis is in reduced row echelon form; its columns are the
/// components.
///
/// ```
/// use affinor::algebra::invariants::invariant_tensors;
/// use affinor::{Down, Rational, Tensor, Up};
/// // a quarter turn of the plane preserves the metric and the area
/// let turn = [([0, 1], Rational::from(-1)), ([1, 0], Rational::from(1))];
/// let turn = Tensor::from_components(2, &[Up, Down], turn)?;
/// assert_eq!(invariant_tensors(2, &[Down, Down], &[turn])?.len(), 2);
/// # Ok::<(), affinor::Error>(())
/// ```
///
/// # Errors
/// [`Error::Shape`]; [`Error::Size`] for more than [`MAX_UNKNOWNS`] components.
pub fn invariant_tensors<S: Field + Scalar>(
    dimension: usize,
    slots: &[Variance],
    endomorphisms: &[Tensor<S>],
) -> Result<Vec<Tensor<S>>, Error> {
    let size = dimension.saturating_pow(slots.len() as u32);
    let tolerances = endomorphisms.iter().map(Tensor::tolerance);
    let tolerance = tolerances.reduce(Tolerance::weaker).unwrap_or_default();
    let of_row = |row: &[(usize, S)]| {
        let tensor = Tensor::from_row(dimension, slots, row.iter().cloned())?;
        Ok(tensor.with_tolerance(tolerance))
    };
    let image = |endomorphism: &Tensor<S>, row: &[(usize, S)]| {
        Ok(act(endomorphism, &of_row(row)?)?.to_row())
    };
    let kernel = common_kernel("components of a tensor", size, tolerance, endomorphisms, image)?;
    (0..kernel.rows()).map(|at| of_row(kernel.row(at))).collect()
}

/// The common kernel of the maps on vectors with `unknowns` components, in reduced row echelon
/// form.
///
/// Each map is applied only to the common kernel of the previous maps, so that few vectors remain
/// for the last maps. No map is stored as a matrix.
pub(crate) fn common_kernel<S: Field + Scalar, M: Copy>(
    what: &'static str,
    unknowns: usize,
    tolerance: Tolerance,
    maps: impl IntoIterator<Item = M>,
    image: impl Fn(M, &[(usize, S)]) -> Result<Row<S>, Error>,
) -> Result<Matrix<S>, Error> {
    if unknowns > MAX_UNKNOWNS {
        return Err(Error::Size { what, size: unknowns, limit: MAX_UNKNOWNS });
    }
    let mut kernel = Matrix::identity(unknowns).with_tolerance(tolerance);
    for map in maps {
        let images = (0..kernel.rows()).map(|at| image(map, kernel.row(at)));
        let images = images.collect::<Result<Vec<_>, _>>()?;
        let images = Matrix::from_rows(unknowns, images)?.with_tolerance(tolerance);
        kernel = images.transpose().nullspace()?.mul(&kernel)?;
    }
    Ok(kernel.row_space()?)
}

impl<S: Field + Scalar> LieAlgebra<S> {
    /// A basis of the tensors with `slots` that satisfy `L_x T = 0` for all `directions`: the
    /// tensors invariant under the subalgebra that the directions generate.
    ///
    /// # Errors
    /// The errors of [`invariant_tensors`].
    pub fn invariant_tensors(
        &self,
        slots: &[Variance],
        directions: &[Vec<S>],
    ) -> Result<Vec<Tensor<S>>, Error> {
        let endomorphisms = directions.iter().map(|x| self.ad(x));
        let endomorphisms = endomorphisms.collect::<Result<Vec<_>, _>>()?;
        invariant_tensors(self.dimension(), slots, &endomorphisms)
    }
}
