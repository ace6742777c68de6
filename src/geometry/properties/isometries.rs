//! Right translations that are isometries of a left-invariant metric: Killing fields,
//! bi-invariance, natural reductivity.

use super::linear_system::LinearSystem;
use super::{Property, Witness, vanishing};
use crate::Error;
use crate::algebra::LieAlgebra;
use crate::algebra::frame::formula;
use crate::geometry::metric::Metric;
use affinor_tensors::linear::Matrix;
use affinor_tensors::stop::stage;
use affinor_tensors::{Down, Field, Scalar, Tensor, Up};

impl<S: Field + Scalar> Metric<S> {
    /// The left-invariant fields `x^k e_k` whose flows are isometries; the flows are right
    /// translations. The fields are a reduced basis of the solutions of
    /// `x^k (g_mj c^m_ki + g_im c^m_kj) = 0`, which states that `ad_x` is antisymmetric. The
    /// solutions form a subalgebra, which is the whole algebra if the metric is bi-invariant. The
    /// right-invariant fields are Killing fields of every left-invariant metric.
    ///
    /// ```
    /// use affinor::algebra::catalogue;
    /// use affinor::{Metric, Rational};
    /// let so3 = catalogue::algebra::<Rational>("so(3)")?;
    /// // a body with two equal moments turns about its third axis
    /// let symmetric = Metric::diagonal([1, 1, 3].map(Rational::from))?;
    /// assert_eq!(symmetric.killing_fields(&so3)?, [[0, 0, 1].map(Rational::from)]);
    /// # Ok::<(), affinor::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::Shape`] when the dimensions differ. [`Error::Linear`] over a ring that is
    /// not a field.
    #[doc(alias("Killing vectors", "isometries"))]
    pub fn killing_fields(&self, algebra: &LieAlgebra<S>) -> Result<Vec<Vec<S>>, Error> {
        let _stage = stage("Killing fields");
        let (n, variation) = (algebra.dimension(), self.ad_invariance_defect(algebra)?);
        let mut rows = vec![Vec::new(); n * n];
        for (at, value) in variation.components() {
            rows[at[1] * n + at[2]].push((at[0], value.clone()));
        }
        let equations = Matrix::from_rows(n, rows)?;
        let equations = equations.with_tolerance(variation.tolerance());
        let solutions = equations.nullspace().and_then(|fields| fields.row_space());
        Ok(solutions?.to_dense())
    }

    /// Whether the metric is bi-invariant: `g([z,x],y) + g(x,[z,y]) = 0`.
    ///
    /// ```
    /// use affinor::algebra::catalogue;
    /// use affinor::{Metric, Rational};
    /// let so3 = catalogue::algebra::<Rational>("so(3)")?;
    /// assert!(Metric::identity(3)?.bi_invariant(&so3)?.holds().is_some());
    /// assert!(Metric::diagonal([1, 1, 3].map(Rational::from))?.bi_invariant(&so3)?.holds().is_none());
    /// # Ok::<(), affinor::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::Shape`] when the dimensions differ.
    #[doc(alias("ad-invariant"))]
    pub fn bi_invariant(&self, algebra: &LieAlgebra<S>) -> Result<Property<S>, Error> {
        let equation = "g_mj c^m_ki + g_im c^m_kj".into();
        Ok(vanishing(&self.ad_invariance_defect(algebra)?, equation, "kij"))
    }

    /// Whether the metric is naturally reductive with respect to `G x K`. Here `G` acts by left
    /// translations, and `K` by the right translations that are isometries, with the algebra `k` of
    /// the [`killing_fields`](Self::killing_fields). With respect to `G` only, a metric is
    /// naturally reductive exactly if it is bi-invariant.
    ///
    /// The isotropy algebra is the diagonal of `k`. Its complements are `{(x + phi(x), phi(x))}`
    /// for linear maps `phi` of the algebra into `k`. The method searches for a complement that is
    /// invariant under the isotropy group and satisfies `g([x,y]_m, z) + g(y, [x,z]_m) = 0`:
    ///
    /// ```text
    /// phi([a,x]) = [a, phi(x)]                                            for a in k
    /// g([x,y],z) + g(y,[x,z]) + g([x,phi(y)],z) + g(y,[x,phi(z)]) = 0
    /// ```
    ///
    /// These equations are linear in `phi^i_j`, slots `[Up, Down]`. The value of the property is
    /// `phi`. The witness is the first equation of the second kind that contradicts earlier
    /// equations. Some groups, such as the Heisenberg group, are naturally reductive by isometries
    /// other than translations, which this method does not consider. On a compact simple group, the
    /// method finds all naturally reductive left-invariant metrics (J. E. D'Atri and W. Ziller,
    /// *Mem. Amer. Math. Soc.* 215 (1979)).
    ///
    /// # Errors
    /// The errors of [`killing_fields`](Self::killing_fields).
    pub fn naturally_reductive(
        &self,
        algebra: &LieAlgebra<S>,
    ) -> Result<Property<S, Tensor<S>>, Error> {
        let _stage = stage("naturally reductive");
        let n = algebra.dimension();
        let (g, c) = (self.components(), algebra.structure_constants());
        let variation = self.ad_invariance_defect(algebra)?;
        if variation.is_empty() {
            // returns the solution phi = 0, because the metric is bi-invariant
            return Ok(Property::Holds(Tensor::zero(n, &[Up, Down])?));
        }
        let fields = self.killing_fields(algebra)?;
        // the matrix k^i_a, whose columns are the fields
        let entries = fields.iter().enumerate().flat_map(|(a, field)| {
            field.iter().enumerate().map(move |(i, value)| ([i, a], value.clone()))
        });
        let k = Tensor::from_components(n, &[Up, Down], entries)?;
        let by = formula("c^i_jm k^m_a -> ^i_ja", &[("c", c), ("k", &k)]);
        let within = formula("b^i_ma k^m_b -> ^i_ba", &[("b", &by), ("k", &k)]);
        let lowered = formula("g_im b^m_ja -> _ija", &[("g", g), ("b", &by)]);

        // in phi(e_i) = phi^a_i k_a, the unknown phi^a_i has the column a n + i
        let ranks = 0..fields.len();
        let unknown = |a: usize, i: usize| a * n + i;
        let mut system = LinearSystem::new(fields.len() * n, variation.tolerance());
        for [b, i, q] in triples(fields.len(), n, n) {
            let image = ranks.clone().flat_map(|a| (0..n).map(move |m| (a, m)));
            let image =
                image.map(|(a, m)| (unknown(a, m), -(by.get(&[m, i, b]) * &k.get(&[q, a]))));
            let bracket = ranks.clone().map(|a| (unknown(a, i), -within.get(&[q, b, a])));
            // no constant can remain, because homogeneous equations never contradict each other
            system.add(image.chain(bracket).collect(), S::zero())?;
        }
        for [z, i, j] in triples(n, n, n) {
            let first = ranks.clone().map(|a| (unknown(a, i), lowered.get(&[j, z, a])));
            let second = ranks.clone().map(|a| (unknown(a, j), lowered.get(&[i, z, a])));
            let constant = variation.get(&[z, i, j]);
            if let Some(residual) = system.add(first.chain(second).collect(), constant)? {
                let equation = "g([e_k,e_i],e_j) + g(e_i,[e_k,e_j]) + g([e_k,phi(e_i)],e_j) \
                                + g(e_i,[e_k,phi(e_j)])";
                return Ok(Property::Fails(Witness {
                    equation: equation.into(),
                    letters: "kij",
                    indices: vec![z, i, j],
                    residual,
                }));
            }
        }
        let phi = Tensor::from_row(n, &[Up, Down], system.solution())?;
        Ok(Property::Holds(formula("k^i_a p^a_j -> ^i_j", &[("k", &k), ("p", &phi)])))
    }
}

pub(in crate::geometry) fn triples(
    first: usize,
    second: usize,
    third: usize,
) -> impl Iterator<Item = [usize; 3]> {
    let pairs = move |a| (0..second).flat_map(move |b| (0..third).map(move |c| [a, b, c]));
    (0..first).flat_map(pairs)
}
