//! All metrics that are bi-invariant, or parallel under a connection.

use crate::Error;
use crate::algebra::LieAlgebra;
use crate::algebra::invariants::invariant_tensors;
use crate::geometry::connection::Connection;
use crate::geometry::metric::Metric;
use affinor_tensors::linear::Echelon;
use affinor_tensors::stop::stage;
use affinor_tensors::{Down, Field, Scalar, Tensor, Up};

impl<S: Field + Scalar> Metric<S> {
    /// A basis of the bi-invariant symmetric forms `g_ij`. They are the solutions of
    /// `g_mj c^m_ki + g_im c^m_kj = 0`. The bi-invariant metrics are the nondegenerate solutions.
    ///
    /// ```
    /// use affinor::algebra::catalogue;
    /// use affinor::{Metric, Rational};
    /// // multiples of the Killing form
    /// let algebra = catalogue::algebra::<Rational>("so(3)")?;
    /// assert_eq!(Metric::bi_invariant_forms(&algebra)?.len(), 1);
    /// # Ok::<(), affinor::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::Size`] for more than [`MAX_UNKNOWNS`](crate::algebra::invariants::MAX_UNKNOWNS)
    /// components.
    pub fn bi_invariant_forms(algebra: &LieAlgebra<S>) -> Result<Vec<Tensor<S>>, Error> {
        let _stage = stage("invariant forms");
        let ads = algebra.basis().map(|x| algebra.ad(&x)).collect::<Result<Vec<_>, _>>()?;
        symmetric_invariants(algebra.dimension(), &ads)
    }
}

impl<S: Field + Scalar> Connection<S> {
    /// A basis of the parallel symmetric forms with constant components. They are the solutions of
    /// `(nabla_k g)_ij = 0`. The nondegenerate solutions are the left-invariant metrics with which
    /// the connection is compatible.
    ///
    /// # Errors
    /// [`Error::Unsupported`] in a frame that is not invariant; [`Error::Size`] as for
    /// [`bi_invariant_forms`](Metric::bi_invariant_forms).
    pub fn parallel_forms(&self) -> Result<Vec<Tensor<S>>, Error> {
        let _stage = stage("parallel forms");
        if !self.frame().is_invariant() {
            return Err(Error::Unsupported("parallel forms need an invariant frame".into()));
        }
        let n = self.frame().dimension();
        // on constant components, nabla_k acts as the endomorphism Lambda^i_kj
        let mut entries = vec![vec![]; n];
        for (at, value) in self.affinities().components() {
            entries[at[1]].push(([at[0], at[2]], value.clone()));
        }
        let endomorphism = |entries| Tensor::from_components(n, &[Up, Down], entries);
        let endomorphisms = entries.into_iter().map(endomorphism).collect::<Result<Vec<_>, _>>()?;
        symmetric_invariants(n, &endomorphisms)
    }
}

/// A basis of the symmetric forms that all endomorphisms annihilate. The transpose of an invariant
/// form is invariant, so the symmetric parts of all invariant forms span this space.
pub(in crate::geometry) fn symmetric_invariants<S: Field + Scalar>(
    n: usize,
    endomorphisms: &[Tensor<S>],
) -> Result<Vec<Tensor<S>>, Error> {
    let slots = [Down, Down];
    let mut span = Echelon::new();
    for form in invariant_tensors(n, &slots, endomorphisms)? {
        let sum = form.components().flat_map(|(at, value)| {
            let value = value.clone();
            [(at[0] * n + at[1], value.clone()), (at[1] * n + at[0], value)]
        });
        span.insert(sum)?;
    }
    span.rows().iter().map(|row| Ok(Tensor::from_row(n, &slots, row.iter().cloned())?)).collect()
}
