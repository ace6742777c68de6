//! Invariant forms of a representation by matrices.

use super::{MatrixRepresentation, image};
use affinor_tensors::Rational;
use affinor_tensors::linear::{Matrix, Row};

impl MatrixRepresentation {
    /// The contravariant form `S` of Shapovalov: `S(f_i v, w) = S(v, e_i w)`, with the value 1 on
    /// the highest weight vector. It is symmetric and positive definite, so the Hermitian form with
    /// the same matrix is invariant under the compact real form, which `e_i - f_i`, `i (e_i + f_i)`
    /// and `i h_i` generate.
    ///
    /// ```
    /// use affinor::representation::{HighestWeight, MatrixRepresentation, ReductiveAlgebra};
    /// let su2: ReductiveAlgebra = "SU(2)".parse()?;
    /// let triplet = MatrixRepresentation::new(&HighestWeight::new(&su2, [2])?)?;
    /// assert_eq!(triplet.contravariant_form().to_string(), "[1, 0, 0]\n[0, 2, 0]\n[0, 0, 1]");
    /// # Ok::<(), affinor::representation::RepresentationError>(())
    /// ```
    #[doc(alias = "Shapovalov form")]
    pub fn contravariant_form(&self) -> Matrix<Rational> {
        self.form(0, &self.raising, 1)
    }

    /// The invariant bilinear form `B(x v, w) + B(v, x w) = 0`, with the value 1 on the first and
    /// the last basis vector. `None` if the representation is not isomorphic to its dual.
    ///
    /// The form is symmetric for a real and antisymmetric for a quaternionic representation.
    ///
    /// ```
    /// use affinor::representation::{HighestWeight, MatrixRepresentation, ReductiveAlgebra};
    /// let su2: ReductiveAlgebra = "SU(2)".parse()?;
    /// let doublet = MatrixRepresentation::new(&HighestWeight::new(&su2, [1])?)?;
    /// let form = doublet.invariant_form().expect("the doublet is self-dual");
    /// assert_eq!(form.to_string(), "[0, 1]\n[-1, 0]");
    /// # Ok::<(), affinor::representation::RepresentationError>(())
    /// ```
    pub fn invariant_form(&self) -> Option<Matrix<Rational>> {
        let dual = self.highest_weight().dual();
        let lowest = self.dimension() - 1;
        (dual == *self.highest_weight()).then(|| self.form(lowest, &self.lowering, -1))
    }

    /// The form in which the highest weight vector has the value 1 with the basis vector `partner`,
    /// and `B(f_i v, w) = sign B(v, x_i w)` for the matrices `x_i`.
    fn form(&self, partner: usize, matrices: &[Matrix<Rational>], sign: i64) -> Matrix<Rational> {
        let n = self.dimension();
        let mut rows: Vec<Row<Rational>> = vec![vec![(partner, Rational::from(1))]];
        for vector in &self.basis[1..] {
            // a monomial that is not the highest weight vector has a first factor
            let (i, power) = vector.factors.first().copied().unwrap_or((0, 1));
            let factor = Rational::new(sign, power.into()).unwrap_or_default();
            rows.push(image(&rows[vector.parent], &matrices[i], &factor));
        }
        Matrix::from_rows(n, rows).expect("columns are numbers of basis vectors")
    }
}
