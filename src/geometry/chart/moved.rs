//! Changes of frame by a matrix of functions.

use crate::Error;
use crate::algebra::BasisChange;
use crate::algebra::frame::{Frame, formula};
use crate::geometry::connection::Connection;
use affinor_tensors::{Field, Scalar, Tensor};
use std::sync::Arc;

impl<S: Field + Scalar> Frame<S> {
    /// The frame `e'_a = A^i_a e_i`. Its derivatives are `e'_a(f) = A^j_a e_j(f)`, and its brackets
    /// `[e'_a, e'_b] = (A^j_a e_j(A^i_b) - A^j_b e_j(A^i_a) + c^i_jk A^j_a A^k_b) e_i` (A6). On a
    /// homogeneous space, `A` must be constant, and the isotropy transforms as a tensor.
    ///
    /// # Errors
    /// [`Error::Shape`] when the dimensions differ.
    pub fn moved(
        &self,
        labels: impl IntoIterator<Item: AsRef<str>>,
        change: &BasisChange<S>,
    ) -> Result<Self, Error> {
        let constant = change.apply(self.structure_functions())?;
        let h = inhomogeneous(self, change)?;
        let operands = [("c", &constant), ("h", &h)];
        // the notation [jk] makes the result exactly antisymmetric, also in floats
        let structure = formula("c^i_jk + h^i_jk - h^i_kj -> ^i_[jk]", &operands);
        let isotropy = change.apply(&self.isotropy()?)?;
        let (frame, matrix) = (self.clone(), change.matrix().clone());
        let columns: Vec<Vec<(usize, S)>> = (0..self.dimension())
            .map(|a| {
                let column = matrix.components().filter(|(at, _)| at[1] == a);
                column.map(|(at, value)| (at[0], value.clone())).collect()
            })
            .collect();
        let derive = move |a: usize, f: &S| {
            let along = columns[a].iter().map(|(j, value)| frame.derive(*j, f) * value);
            along.fold(S::zero(), |sum, term| sum + &term)
        };
        self.with_vectors(labels, structure, isotropy, Arc::new(derive))
    }
}

impl<S: Field + Scalar> Connection<S> {
    /// The same connection in the frame `e'_a = A^i_a e_i`. If `B` is the inverse of `A`,
    /// `Lambda'^c_ab = B^c_i (Lambda^i_jk A^j_a A^k_b + A^j_a e_j(A^i_b))`.
    ///
    /// # Errors
    /// [`Error::Shape`] when the dimensions differ.
    pub fn moved(
        &self,
        labels: impl IntoIterator<Item: AsRef<str>>,
        change: &BasisChange<S>,
    ) -> Result<Self, Error> {
        let homogeneous = change.apply(self.affinities())?;
        let h = inhomogeneous(self.frame(), change)?;
        let operands = [("L", &homogeneous), ("h", &h)];
        let gamma = formula("L^i_jk + h^i_jk -> ^i_jk", &operands);
        Connection::new(self.frame().moved(labels, change)?, gamma)
    }
}

/// The inhomogeneous term `h^c_ab = B^c_i A^j_a e_j(A^i_b)`.
fn inhomogeneous<S: Field + Scalar>(
    frame: &Frame<S>,
    change: &BasisChange<S>,
) -> Result<Tensor<S>, Error> {
    let derivative = frame.derivative(change.matrix())?;
    let along = formula("A^j_a d_j^i_b -> ^i_ab", &[("A", change.matrix()), ("d", &derivative)]);
    Ok(formula("B^c_i h^i_ab -> ^c_ab", &[("B", change.inverse()), ("h", &along)]))
}
