//! Changes of basis.

use crate::Error;
use crate::algebra::frame::{expect_numbers, expect_slots, formula};
use affinor_tensors::contraction;
use affinor_tensors::linear::Matrix;
use affinor_tensors::{Down, Field, Scalar, Tensor, Up};
use std::collections::BTreeMap;

/// A change of basis `e'_a = A^i_a e_i` with an invertible matrix `A`. Over a chart, the entries of
/// `A` may be functions.
#[doc(alias("change of basis"))]
#[derive(Clone, Debug, PartialEq)]
pub struct BasisChange<S> {
    matrix: Tensor<S>,
    inverse: Tensor<S>,
}

impl<S: Field + Scalar> BasisChange<S> {
    /// The change with the matrix `A^i_a`, slots `[Up, Down]`: column `a` is the new `e'_a`.
    ///
    /// # Errors
    /// [`Error::Shape`]; [`Error::NotFinite`]; [`Error::SingularBasis`] if `A` has no inverse.
    pub fn new(matrix: Tensor<S>) -> Result<Self, Error> {
        expect_slots("the change of basis", &matrix, matrix.dimension(), &[Up, Down])?;
        expect_numbers("the change of basis", &matrix)?;
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

    /// The change back to the old basis.
    #[must_use]
    pub fn inverted(&self) -> Self {
        BasisChange { matrix: self.inverse.clone(), inverse: self.matrix.clone() }
    }

    /// The components in the new basis: `A^-1` on every upper slot, `A` on every lower slot.
    ///
    /// If the tensor is symmetric or antisymmetric in two slots of equal variance, the result has
    /// exactly the same symmetry, in spite of rounding errors.
    ///
    /// # Errors
    /// [`Error::Shape`] if the dimensions differ.
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
        Ok(with_symmetries(&symmetries(tensor), result))
    }
}

/// Two slots, and the sign of a tensor under their exchange.
type Symmetry = (usize, usize, i64);

/// Finds the pairs of slots in which a tensor is symmetric or antisymmetric.
fn symmetries<S: Scalar>(tensor: &Tensor<S>) -> Vec<Symmetry> {
    let pairs = (0..tensor.rank()).flat_map(|a| (a + 1..tensor.rank()).map(move |b| (a, b)));
    pairs.filter_map(|(a, b)| Some((a, b, tensor.pair_symmetry(a, b)?))).collect()
}

/// Restores the symmetries exactly: computes all components from those with ordered indices.
fn with_symmetries<S: Scalar>(symmetries: &[Symmetry], tensor: Tensor<S>) -> Tensor<S> {
    if symmetries.is_empty() {
        return tensor;
    }
    let ordered = |at: &[usize]| symmetries.iter().all(|(a, b, _)| at[*a] <= at[*b]);
    let mut components = Vec::with_capacity(tensor.len());
    for (at, value) in tensor.components().filter(|(at, _)| ordered(at)) {
        // collects all arrangements of the indices by exchanging two slots at a time; each
        // arrangement occurs once
        let mut orbit = BTreeMap::from([(at.to_vec(), 1)]);
        let mut open = vec![(at.to_vec(), 1)];
        let mut vanishes = false;
        while let Some((at, sign)) = open.pop() {
            for (a, b, exchange) in symmetries {
                let (mut image, sign) = (at.clone(), sign * exchange);
                image.swap(*a, *b);
                match orbit.get(&image) {
                    Some(known) => vanishes |= *known != sign,
                    None => {
                        orbit.insert(image.clone(), sign);
                        open.push((image, sign));
                    }
                }
            }
        }
        if !vanishes {
            let signed = |sign| if sign < 0 { -value.clone() } else { value.clone() };
            components.extend(orbit.into_iter().map(|(at, sign)| (at, signed(sign))));
        }
    }
    Tensor::from_components(tensor.dimension(), tensor.slots(), components)
        .expect("indices of a tensor")
        .with_tolerance(tensor.tolerance())
}

/// The index letters of the slots of a tensor. The letters `m` and `p` are reserved for summation.
pub(crate) const LETTERS: &str = "abcdefgh";

/// The index notation of a tensor, with one letter per slot.
pub(crate) fn indices<S: Scalar>(letters: &str, tensor: &Tensor<S>) -> String {
    contraction::indices(letters.chars().zip(tensor.slots().iter().copied()))
}

/// The nonzero entries of the inverse of a tensor of rank 2, which is read as a matrix.
pub(crate) fn inverse<S: Field + Scalar>(tensor: &Tensor<S>) -> Option<Vec<([usize; 2], S)>> {
    let inverse = to_matrix(tensor).inverse()?;
    Some(inverse.entries().map(|(i, j, v)| ([i, j], v.clone())).collect())
}

/// A tensor of rank 2 as a matrix: the first index is the row.
pub(crate) fn to_matrix<S: Scalar>(tensor: &Tensor<S>) -> Matrix<S> {
    let n = tensor.dimension();
    let mut rows = vec![Vec::new(); n];
    for (at, value) in tensor.components() {
        rows[at[0]].push((at[1], value.clone()));
    }
    Matrix::from_rows(n, rows)
        .expect("columns of a square matrix")
        .with_tolerance(tensor.tolerance())
}
