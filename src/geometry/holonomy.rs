//! The holonomy algebra of an invariant connection.

use crate::Error;
use crate::algebra::frame::formula;
use crate::geometry::connection::Connection;
use crate::geometry::metric::Metric;
use affinor_tensors::linear::{Echelon, Row};
use affinor_tensors::stop::stage;
use affinor_tensors::{Down, Field, Indices, Scalar, Tensor, Up};

/// The Lie algebra of the holonomy group, which is a subalgebra of gl(n), with a reduced basis.
#[derive(Clone, Debug)]
pub struct Holonomy<S> {
    dimension: usize,
    /// The basis matrices, as rows of `n * n` entries.
    span: Echelon<S>,
}

impl<S: Field + Scalar> Connection<S> {
    /// The holonomy algebra of a connection with constant components in the frame of a group or of a
    /// homogeneous space. It is
    /// the smallest space of matrices `A^i_j` that satisfies two conditions: it contains all
    /// `R(e_k, e_l)`, and with each matrix `A` it contains all `[Lambda_m, A]`, where
    /// `(Lambda_m)^i_j = Lambda^i_mj`.
    ///
    /// This space is closed under the commutator (K. Nomizu, *Amer. J. Math.* 76 (1954) 33-65;
    /// Kobayashi and Nomizu, *Foundations II*, section X.4). If there are parameters, the result is
    /// the algebra for generic values. Over floats, the dimension depends on the tolerance.
    ///
    /// # Errors
    /// [`Error::Unsupported`] in a frame on a chart; [`Error::Linear`] over a ring that
    /// is not a field.
    ///
    /// ```
    /// use affinor::algebra::catalogue;
    /// use affinor::{Connection, Metric, Rational};
    /// // the Heisenberg group with a left-invariant metric has the holonomy group SO(3)
    /// let algebra = catalogue::algebra::<Rational>("heisenberg(3)")?;
    /// let metric = Metric::identity(3)?;
    /// let levi_civita = Connection::levi_civita(algebra.left_frame(), &metric)?;
    /// assert_eq!(levi_civita.holonomy()?.dimension(), 3);
    /// # Ok::<(), affinor::Error>(())
    /// ```
    #[doc(alias("holonomy algebra"))]
    pub fn holonomy(&self) -> Result<Holonomy<S>, Error> {
        let n = self.frame().dimension();
        self.holonomy_up_to(n * n)
    }

    /// The holonomy algebra as in [`holonomy`](Self::holonomy), but computed faster if the
    /// connection preserves the metric. The matrices are then antisymmetric with respect to the
    /// metric, so the search ends when it has found `n(n-1)/2` of them.
    ///
    /// ```
    /// use affinor::{Connection, Metric, Rational};
    /// use affinor::algebra::catalogue;
    /// let algebra = catalogue::algebra::<Rational>("heisenberg(5)")?;
    /// let metric = Metric::identity(5)?;
    /// let levi_civita = Connection::levi_civita(algebra.left_frame(), &metric)?;
    /// assert_eq!(levi_civita.holonomy_beside(&metric)?.dimension(), levi_civita.holonomy()?.dimension());
    /// # Ok::<(), affinor::Error>(())
    /// ```
    ///
    /// # Errors
    /// The errors of [`holonomy`](Self::holonomy); [`Error::Shape`] if the dimensions differ.
    pub fn holonomy_beside(&self, metric: &Metric<S>) -> Result<Holonomy<S>, Error> {
        let n = self.frame().dimension();
        match self.metric_compatible(metric)?.holds() {
            Some(()) => self.holonomy_up_to(n * n.saturating_sub(1) / 2),
            None => self.holonomy(),
        }
    }

    /// The holonomy algebra, whose dimension must be at most `largest`.
    fn holonomy_up_to(&self, largest: usize) -> Result<Holonomy<S>, Error> {
        let _stage = stage("holonomy");
        if !self.frame().is_homogeneous() {
            return Err(Error::Unsupported("the holonomy algebra needs an invariant frame".into()));
        }
        let n = self.frame().dimension();
        let tolerance = self.affinities().tolerance();
        let mut span = Echelon::new().with_tolerance(tolerance);
        // collects the matrices R(e_k, e_l): slots 2 and 3 are k and l, and slots 0 and 1 are the
        // row and the column of each matrix
        let mut open = matrices(self.curvature(), [0, 1], &[2, 3])?;
        // proceeds level by level, because matrices of later levels have longer entries
        while !open.is_empty() {
            let mut found = vec![];
            for matrix in open {
                if span.rank() >= largest {
                    return Ok(Holonomy { dimension: n, span });
                }
                if span.insert(matrix.to_row())? {
                    found.push(matrix);
                }
            }
            open = vec![];
            for matrix in found.iter().filter(|_| span.rank() < largest) {
                let moved = formula(
                    "L^i_mp A^p_j - A^i_p L^p_mj -> ^i_mj",
                    &[("L", self.affinities()), ("A", matrix)],
                );
                open.extend(matrices(&moved, [0, 2], &[1])?);
            }
        }
        Ok(Holonomy { dimension: n, span })
    }
}

impl<S: Field + Scalar> Holonomy<S> {
    /// The dimension of the algebra.
    pub fn dimension(&self) -> usize {
        self.span.rank()
    }

    /// The reduced basis: matrices `A^i_j`, slots `[Up, Down]`.
    ///
    /// # Errors
    /// [`Error::Tensor`] if the dimension is too large for a tensor. This error cannot occur for
    /// the dimension of a connection.
    pub fn basis(&self) -> Result<Vec<Tensor<S>>, Error> {
        let matrix =
            |row: &Row<S>| Ok(Tensor::from_row(self.dimension, &[Up, Down], row.iter().cloned())?);
        self.span.rows().iter().map(matrix).collect()
    }

    /// Whether the algebra contains a matrix `A^i_j`, slots `[Up, Down]`.
    pub fn contains(&self, matrix: &Tensor<S>) -> bool {
        let fits = matrix.slots() == [Up, Down] && matrix.dimension() == self.dimension;
        fits && self.span.contains(matrix.to_row())
    }
}

/// The nonzero matrices that the two slots `of` form, one for each value of the other slots.
fn matrices<S: Scalar>(
    tensor: &Tensor<S>,
    of: [usize; 2],
    apart: &[usize],
) -> Result<Vec<Tensor<S>>, Error> {
    let key = |at: &Indices| apart.iter().map(|&slot| at[slot]).collect::<Vec<_>>();
    let mut entries = std::collections::BTreeMap::<_, Vec<_>>::new();
    for (at, value) in tensor.components() {
        entries.entry(key(&at)).or_default().push((of.map(|slot| at[slot]), value.clone()));
    }
    let matrix = |entries| Tensor::from_components(tensor.dimension(), &[Up, Down], entries);
    let matrices = entries.into_values().map(|entries: Vec<([usize; 2], S)>| matrix(entries));
    Ok(matrices.collect::<Result<_, _>>()?)
}
