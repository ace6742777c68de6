//! Reductive complements of a subalgebra.

use super::ReductivePair;
use crate::algebra::{BasisChange, LieAlgebra};
use crate::geometry::properties::LinearSystem;
use crate::{Error, Law};
use affinor_tensors::linear::Matrix;
use affinor_tensors::{Down, Field, Scalar, Tensor, Up};

impl<S: Field + Scalar> ReductivePair<S> {
    /// A basis of the complement of `h` that is orthogonal under the Killing form, or, if the Killing
    /// form is degenerate on `h`, of some complement `m` that contains `[h, m]`.
    ///
    /// The complements that contain `[h, m]` are the kernels of the projections `P` onto `h` that
    /// commute with `ad_x` for all `x` of `h`. The conditions
    ///
    /// ```text
    /// P(x) = x,    P([x,y]) = [x, P(y)]    for x in h
    /// ```
    ///
    /// are linear equations in `P`.
    ///
    /// ```
    /// use affinor::algebra::catalogue;
    /// use affinor::{Rational, ReductivePair};
    /// // the Killing form of a nilpotent algebra vanishes, but the centre has a complement
    /// let algebra = catalogue::algebra::<Rational>("heisenberg(3)")?;
    /// let h = [[0, 0, 1].map(Rational::from).to_vec()];
    /// let m = ReductivePair::complement(&algebra, &h)?;
    /// assert_eq!(ReductivePair::new(&algebra, &h, &m)?.dimension(), 2);
    /// # Ok::<(), affinor::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Law::ReductiveIsotropy`] if `h` does not span a subalgebra; [`Law::Reductive`] if there is no
    /// such complement; [`Error::SingularBasis`] for dependent vectors; [`Error::Shape`].
    #[doc(alias("reductive decomposition"))]
    pub fn complement(algebra: &LieAlgebra<S>, h: &[Vec<S>]) -> Result<Vec<Vec<S>>, Error> {
        match Self::orthogonal_complement(algebra, h) {
            Err(Error::Broken { law: Law::KillingOnSubalgebra, .. }) => equivariant(algebra, h),
            found => found,
        }
    }
}

/// The kernel of a projection onto `h` that commutes with `h`.
fn equivariant<S: Field + Scalar>(
    algebra: &LieAlgebra<S>,
    h: &[Vec<S>],
) -> Result<Vec<Vec<S>>, Error> {
    let (n, s) = (algebra.dimension(), h.len());
    let tolerance = algebra.structure_constants().tolerance();
    // a basis of the algebra: first h, then basis vectors without a pivot of h
    let reduced = Matrix::from_dense(h)?.with_tolerance(tolerance).row_space()?;
    let first = |row: usize| reduced.row(row).first().map(|(at, _)| *at);
    let pivots: Vec<_> = (0..reduced.rows()).filter_map(first).collect();
    let others: Vec<_> = (0..n).filter(|at| !pivots.contains(at)).collect();
    let unit = |at: usize| (0..n).map(move |i| S::from_i64(i64::from(i == at))).collect::<Vec<_>>();
    let basis: Vec<Vec<S>> = h.iter().cloned().chain(others.into_iter().map(unit)).collect();
    let entries = basis
        .iter()
        .enumerate()
        .flat_map(|(a, x)| x.iter().enumerate().map(move |(i, value)| ([i, a], value.clone())));
    let change = Tensor::from_components(n, &[Up, Down], entries)?.with_tolerance(tolerance);
    let adapted = algebra.change_basis(&BasisChange::new(change)?)?;
    let c = adapted.structure_constants();
    let write = |x: &[S]| algebra.left_frame().write(x.iter().cloned());
    let inside = |at: &[usize]| at[1] < s && at[2] < s && at[0] >= s;
    if let Some((at, _)) = c.components().find(|(at, _)| inside(at)) {
        let (x, y) = (&basis[at[1]], &basis[at[2]]);
        let bracket = algebra.bracket(x, y)?;
        return Err(Law::ReductiveIsotropy.broken([write(x), write(y)], write(&bracket)));
    }
    // the unknowns are the components P^b_j of P(v_j) along h_b; their column is b r + j
    let r = n - s;
    let mut system = LinearSystem::new(s * r, tolerance);
    for a in 0..s {
        for i in 0..r {
            for b in 0..s {
                // the component of P([h_a, v_i]) - [h_a, P(v_i)] along h_b
                let image = (0..r).map(|j| (b * r + j, c.get(&[s + j, a, s + i])));
                let bracket = (0..s).map(|d| (d * r + i, -c.get(&[b, a, d])));
                let constant = c.get(&[b, a, s + i]);
                let equation = image.chain(bracket).filter(|(_, value)| !value.vanishes());
                if let Some(residual) = system.add(equation.collect(), constant)? {
                    let at = [write(&basis[a]), write(&basis[s + i])];
                    return Err(Law::Reductive.broken(at, residual.to_string()));
                }
            }
        }
    }
    let mut complement = basis[s..].to_vec();
    for (column, value) in system.solution() {
        let (b, j) = (column / r, column % r);
        for (entry, part) in complement[j].iter_mut().zip(&h[b]) {
            *entry = entry.clone() - &(value.clone() * part);
        }
    }
    Ok(complement)
}
