//! Metrics: symmetric, non-degenerate bilinear forms.

use crate::algebra::frame::{expect_numbers, expect_slots, formula};
use crate::algebra::{LieAlgebra, inverse, to_matrix};
use crate::{Error, Law};
use affinor_tensors::stop::stage;
use affinor_tensors::text::{combination, written};
use affinor_tensors::{Down, Field, Scalar, Tensor, Up};
use std::fmt;

/// A metric `g_ij` of any signature, with its inverse `g^ij`.
#[derive(Clone, Debug, PartialEq)]
pub struct Metric<S> {
    components: Tensor<S>,
    inverse: Tensor<S>,
}

/// Writes the metric in the notation of definitions: `diag(1, 2, 3)`, or rows `[[2, 1], [1, 2]]`.
impl<S: Field + Scalar> fmt::Display for Metric<S> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (g, n) = (&self.components, self.components.dimension());
        let list = |values: Vec<String>| values.join(", ");
        if g.components().all(|(at, _)| at[0] == at[1]) {
            return write!(
                f,
                "diag({})",
                list((0..n).map(|i| g.get(&[i, i]).to_string()).collect())
            );
        }
        let row = |i: usize| list((0..n).map(|j| g.get(&[i, j]).to_string()).collect());
        write!(f, "[{}]", list((0..n).map(|i| format!("[{}]", row(i))).collect()))
    }
}

impl<S: Field + Scalar> Metric<S> {
    /// A metric with these components, slots `[Down, Down]`.
    ///
    /// ```
    /// use affinor::{Down, Metric, Rational, Tensor};
    /// let lorentz = Tensor::from_fn(2, [Down, Down], |at| match at {
    ///     [0, 0] => Rational::from(-1),
    ///     [1, 1] => Rational::from(1),
    ///     _ => Rational::from(0),
    /// })?;
    /// let metric = Metric::new(["t", "x"], lorentz)?;
    /// assert_eq!(metric.inverse().get(&[0, 0]), (-1).into());
    /// # Ok::<(), affinor::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::Shape`]; [`Error::NotFinite`]; [`Law::SymmetricMetric`]; [`Error::Degenerate`] with
    /// a vector of the kernel.
    #[doc(alias("inner product"))]
    pub fn new(
        labels: impl IntoIterator<Item: AsRef<str>>,
        components: Tensor<S>,
    ) -> Result<Self, Error> {
        let labels = labels.into_iter().map(|label| label.as_ref().to_string());
        Self::labelled(&labels.collect::<Vec<_>>(), components)
    }

    fn labelled(labels: &[String], components: Tensor<S>) -> Result<Self, Error> {
        let _stage = stage("metric");
        let label = |i: usize| labels[i].clone();
        expect_slots("the metric", &components, labels.len(), &[Down, Down])?;
        expect_numbers("the metric", &components)?;
        let skew = formula("g_ij - g_ji -> _ij", &[("g", &components)]);
        if let Some((at, residual)) = skew.components().next() {
            let at = [label(at[0]), label(at[1])];
            return Err(Law::SymmetricMetric.broken(at, written(residual)));
        }
        let tolerance = components.tolerance();
        let Some(entries) = inverse(&components) else {
            let kernel = to_matrix(&components).nullspace().ok();
            let row = kernel.as_ref().filter(|kernel| kernel.rows() > 0);
            let row = row.map_or(&[][..], |kernel| kernel.row(0));
            return Err(Error::Degenerate {
                null: combination(row.iter().map(|(i, v)| (v, label(*i)))),
                components: row.iter().map(|(i, v)| (i + 1, written(v))).collect(),
            });
        };
        // mirrors the upper half, so that the matrix is exactly symmetric, also in floats
        let upper = entries.into_iter().filter(|([i, j], _)| i <= j);
        let both = upper.flat_map(|([i, j], v)| {
            let mirrored = (i < j).then(|| ([j, i], v.clone()));
            [Some(([i, j], v)), mirrored].into_iter().flatten()
        });
        let inverse = Tensor::from_components(labels.len(), &[Up, Up], both)?;
        Ok(Metric { components, inverse: inverse.with_tolerance(tolerance) })
    }

    /// The metric `diag(values)`. In messages, the basis vectors have the names `e1 ...`.
    ///
    /// ```
    /// use affinor::{Metric, Rational};
    /// let metric = Metric::diagonal([1, 2, 3].map(Rational::from))?;
    /// assert_eq!(Some(metric.inverse().get(&[2, 2])), Rational::new(1, 3));
    /// # Ok::<(), affinor::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::NotFinite`]; [`Error::Degenerate`] for a value without an inverse.
    #[doc(alias("diagonal metric"))]
    pub fn diagonal(values: impl IntoIterator<Item = S>) -> Result<Self, Error> {
        let entries = values.into_iter().enumerate().map(|(i, value)| ([i, i], value));
        let entries: Vec<_> = entries.collect();
        let labels = (1..=entries.len()).map(|i| format!("e{i}"));
        let components = Tensor::from_components(entries.len(), &[Down, Down], entries)?;
        Self::new(labels, components)
    }

    /// The metric of an orthonormal basis, `g_ij = delta_ij`.
    ///
    /// # Errors
    /// [`Error::Tensor`] if the dimension is too large for the indices of a tensor, 64 bits.
    pub fn identity(dimension: usize) -> Result<Self, Error> {
        Self::diagonal(vec![S::one(); dimension])
    }

    /// The components `g_ij`.
    pub fn components(&self) -> &Tensor<S> {
        &self.components
    }

    /// The inverse `g^ij`.
    pub fn inverse(&self) -> &Tensor<S> {
        &self.inverse
    }

    /// The trace `g^jl t_jl` of a bilinear form with the slots `_jl`.
    ///
    /// # Errors
    /// [`Error::Shape`] unless the form has two lower slots and its dimension is the dimension of
    /// the metric.
    pub fn trace(&self, form: &Tensor<S>) -> Result<S, Error> {
        expect_slots("the form", form, self.components.dimension(), &[Down, Down])?;
        let trace = formula("g^jl t_jl ->", &[("g", &self.inverse), ("t", form)]);
        Ok(trace.to_scalar().expect("a tensor of rank 0"))
    }

    /// The variation of the metric under `ad_{e_k}`, slots `_kij`: `g_mj c^m_ki + g_im c^m_kj`. It
    /// vanishes for a bi-invariant metric.
    ///
    /// # Errors
    /// [`Error::Shape`] if the dimensions differ.
    pub fn ad_invariance_defect(&self, algebra: &LieAlgebra<S>) -> Result<Tensor<S>, Error> {
        self.expect_dimension(algebra.dimension())?;
        let operands = [("g", &self.components), ("c", algebra.structure_constants())];
        Ok(formula("g_mj c^m_ki + g_im c^m_kj -> _kij", &operands))
    }

    /// Checks that the metric has this dimension.
    pub(crate) fn expect_dimension(&self, dimension: usize) -> Result<(), Error> {
        expect_slots("the metric", &self.components, dimension, &[Down, Down])
    }

    /// The covector `v_i = g_ij v^j`, equation (97).
    ///
    /// ```
    /// use affinor::{Metric, Rational};
    /// let metric = Metric::diagonal([1, 2, 3].map(Rational::from))?;
    /// assert_eq!(metric.lower(&[1, 1, 1].map(Rational::from))?, [1, 2, 3].map(Rational::from));
    /// # Ok::<(), affinor::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::Shape`] unless the number of components of `v` is the dimension of the metric.
    #[doc(alias("flat", "lower an index"))]
    pub fn lower(&self, v: &[S]) -> Result<Vec<S>, Error> {
        let v = Tensor::vector(v, Up);
        expect_slots("the vector", &v, self.components.dimension(), &[Up])?;
        let lowered = formula("g_ij v^j -> _i", &[("g", &self.components), ("v", &v)]);
        Ok(lowered.to_vector().expect("a tensor of rank 1"))
    }
}
