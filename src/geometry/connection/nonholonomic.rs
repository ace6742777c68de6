//! The nonholonomic connection of a metric and a distribution.

use super::Connection;
use crate::algebra::frame::{expect_slots, formula};
use crate::algebra::structure::Subspace;
use crate::{Error, Metric};
use affinor_tensors::linear::{Matrix, Row};
use affinor_tensors::{Down, Field, Scalar, Tensor, Up};

/// The orthogonal projector `P'^i_j` onto the orthogonal complement of a subspace, slots
/// `[Up, Down]`: `P' = 1 - D (D^T g D)^-1 D^T g`, where the columns of `D` are a basis of the
/// subspace.
///
/// ```
/// use affinor::algebra::structure::Subspace;
/// use affinor::geometry::complement_projector;
/// use affinor::{Metric, Rational};
/// let plane = Subspace::span(3, [0, 1].map(|at| vec![(at, Rational::from(1))]));
/// let projector = complement_projector(&Metric::diagonal([1, 2, 3].map(Rational::from))?, &plane)?;
/// assert_eq!(projector.get(&[2, 2]), 1.into());
/// assert_eq!(projector.components().count(), 1);
/// # Ok::<(), affinor::Error>(())
/// ```
///
/// # Errors
/// [`Error::Shape`] if the dimensions differ; [`Error::Invalid`] if the metric is degenerate on the
/// subspace.
pub fn complement_projector<S: Field + Scalar>(
    metric: &Metric<S>,
    subspace: &Subspace<S>,
) -> Result<Tensor<S>, Error> {
    let (n, r) = (subspace.ambient(), subspace.dimension());
    let g = metric.components();
    expect_slots("the metric", g, n, &[Down, Down])?;
    let basis = columns(n, subspace.basis())?;
    let inverse = inverse_gram(g, &basis, r)?.ok_or_else(|| Error::Invalid {
        what: "distribution",
        reason: "the metric is degenerate on it, so it has no orthogonal complement".into(),
    })?;
    let one = Tensor::identity(n);
    let operands = [("d", &one), ("D", &basis), ("K", &inverse), ("g", g)];
    Ok(formula("d^i_j - D^i_a K^ab D^k_b g_kj -> ^i_j", &operands).with_tolerance(g.tolerance()))
}

/// The matrix `D^i_a` whose columns are vectors of dimension `n`, slots `[Up, Down]`. The columns
/// after the last vector are zero.
pub(in crate::geometry) fn columns<S: Scalar>(
    n: usize,
    vectors: &[Row<S>],
) -> Result<Tensor<S>, Error> {
    let entries = vectors
        .iter()
        .enumerate()
        .flat_map(|(a, row)| row.iter().map(move |(i, value)| ([*i, a], value.clone())));
    Ok(Tensor::from_components(n, &[Up, Down], entries)?)
}

/// The inverse `K^ab` of the matrix `D^i_a g_ij D^j_b` of a metric on the first `r` columns of `D`,
/// slots `[Up, Up]`. Returns `None` if the metric is degenerate on them.
pub(in crate::geometry) fn inverse_gram<S: Field + Scalar>(
    g: &Tensor<S>,
    basis: &Tensor<S>,
    r: usize,
) -> Result<Option<Tensor<S>>, Error> {
    let gram = formula("D^i_a g_ij D^j_b -> _ab", &[("D", basis), ("g", g)]);
    let mut rows = vec![vec![]; r];
    for (at, value) in gram.components() {
        rows[at[0]].push((at[1], value.clone()));
    }
    let gram = Matrix::from_rows(r, rows).expect("columns of a square matrix");
    let Some(inverse) = gram.with_tolerance(g.tolerance()).inverse() else { return Ok(None) };
    let inverse = inverse.entries().map(|(a, b, value)| ([a, b], value.clone()));
    Ok(Some(Tensor::from_components(basis.dimension(), &[Up, Up], inverse)?))
}

impl<S: Scalar> Connection<S> {
    /// The nonholonomic connection `nabla_X Y + (nabla_X P')(Y)` of this connection and of the
    /// projector `P'` onto the orthogonal complement of a distribution:
    /// `Lambda^i_jk + nabla_j P'^i_k`.
    ///
    /// If this is the Levi-Civita connection of a kinetic energy, the geodesics with a velocity in
    /// the distribution are the motions with these constraints. For `Y` in the distribution,
    /// `nabla_X Y` is projected onto the distribution.
    ///
    /// A. D. Lewis, *Rep. Math. Phys.* 42 (1998) 135-164; F. Bullo and A. D. Lewis, *Geometric
    /// Control of Mechanical Systems* (2005), section 4.5.
    ///
    /// ```
    /// use affinor::algebra::{catalogue, structure::Subspace};
    /// use affinor::geometry::complement_projector;
    /// use affinor::{Connection, Metric, Rational};
    /// // a round body that cannot rotate about its axis 3
    /// let so3 = catalogue::algebra::<Rational>("so(3)")?;
    /// let metric = Metric::identity(3)?;
    /// let plane = Subspace::span(3, [0, 1].map(|at| vec![(at, Rational::from(1))]));
    /// let projector = complement_projector(&metric, &plane)?;
    /// let free = Connection::levi_civita(so3.left_frame(), &metric)?;
    /// let constrained = free.nonholonomic(&projector)?;
    /// // nabla_1 e_2 = e_3/2 of the free body is projected to zero
    /// assert_eq!(constrained.affinities().get(&[2, 0, 1]), 0.into());
    /// # Ok::<(), affinor::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::Shape`] unless the projector has slots `[Up, Down]` and the dimension of the frame;
    /// [`Error::Invalid`] unless `P' P' = P'`; the errors of [`nabla`](Self::nabla).
    pub fn nonholonomic(&self, projector: &Tensor<S>) -> Result<Self, Error> {
        expect_slots("the projector", projector, self.frame.dimension(), &[Up, Down])?;
        let defect = formula("P^i_k P^k_j - P^i_j -> ^i_j", &[("P", projector)]);
        if let Some((at, value)) = defect.components().next() {
            let [i, j] = [at[0] + 1, at[1] + 1];
            let reason = format!("the component ^{i}_{j} of P P - P is {value}, not 0");
            return Err(Error::Invalid { what: "projector", reason });
        }
        let change = self.nabla(projector)?;
        let operands = [("L", &self.gamma), ("P", &change)];
        Connection::new(self.frame.clone(), formula("L^i_jk + P^i_jk -> ^i_jk", &operands))
    }
}
