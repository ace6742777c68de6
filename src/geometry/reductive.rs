//! Reductive homogeneous spaces G/H, with their canonical and invariant connections.

mod cohomology;
mod complement;
mod isotropy;
mod metrics;
mod rank;

pub use cohomology::{InvariantForms, MAX_FORMS};
pub use isotropy::{IsotropyComponent, RealType};

use crate::algebra::frame::{Frame, expect_slots, formula};
use crate::algebra::invariants::invariant_tensors;
use crate::algebra::lie_derivative::act;
use crate::algebra::{BasisChange, LieAlgebra};
use crate::geometry::connection::Connection;
use crate::geometry::metric::Metric;
use crate::{Error, Law};
use affinor_tensors::linear::Matrix;
use affinor_tensors::{Down, Field, Scalar, Tensor, TensorError, Up, Variance};

/// An algebra `g = m + h` with a subalgebra `h` and a complement `m` such that `m` contains
/// `[h, m]`. The pair describes the homogeneous space G/H at its origin, where `m` is the tangent
/// space.
///
/// An invariant connection on G/H is an `h`-invariant bilinear map `Lambda^i_jk` on `m`. Its
/// torsion and curvature are (K. Nomizu, *Amer. J. Math.* 76 (1954) 33-65)
///
/// ```text
/// T(x,y)  = Lambda(x) y - Lambda(y) x - [x,y]_m
/// R(x,y)z = Lambda(x) Lambda(y) z - Lambda(y) Lambda(x) z - Lambda([x,y]_m) z - [[x,y]_h, z]
/// ```
///
/// These formulas are the torsion (B10) and the curvature (B14) over [`frame`](Self::frame). An
/// invariant connection is therefore a [`Connection`], so `nabla` of invariant tensors, the Ricci
/// tensor, the Bianchi identities and the scalar curvature are available.
///
/// ```
/// use affinor::algebra::catalogue;
/// use affinor::{Rational, ReductivePair};
/// let so3 = catalogue::algebra("so(3)")?;
/// // rotations about the third axis: the sphere
/// let h = [0, 0, 1].map(Rational::from).to_vec();
/// let sphere = ReductivePair::orthogonal(&so3, &[h])?;
/// assert!(sphere.is_symmetric());
/// // R^1_212
/// assert_eq!(sphere.canonical().curvature().get(&[0, 1, 0, 1]), 1.into());
/// # Ok::<(), affinor::Error>(())
/// ```
#[doc(alias("homogeneous space", "coset", "quotient", "symmetric space"))]
#[derive(Clone, Debug, PartialEq)]
pub struct ReductivePair<S> {
    algebra: LieAlgebra<S>,
    frame: Frame<S>,
    /// The action of `ad_x` on `m` for each basis vector `x` of `h`, slots `^i_j`.
    isotropy: Vec<Tensor<S>>,
}

impl<S: Field + Scalar> ReductivePair<S> {
    /// The pair with these bases of `h` and `m`. The vectors have components in the basis of
    /// `algebra`.
    ///
    /// # Errors
    /// [`Error::Shape`]; [`Error::SingularBasis`] unless the vectors of `h` and `m` together are a
    /// basis; [`Law::ReductiveIsotropy`] or [`Law::ReductiveComplement`] with the first bracket
    /// that violates the condition.
    pub fn new(algebra: &LieAlgebra<S>, h: &[Vec<S>], m: &[Vec<S>]) -> Result<Self, Error> {
        let (n, r) = (algebra.dimension(), m.len());
        let basis: Vec<_> = m.iter().chain(h).collect();
        if basis.len() != n {
            let (expected, found) = (format!("{n} vectors"), format!("{} vectors", basis.len()));
            return Err(Error::Shape { what: "the bases of m and h", expected, found });
        }
        let basis = basis.into_iter().map(|x| algebra.vector(x)).collect::<Result<Vec<_>, _>>()?;
        let columns = basis.iter().enumerate();
        let entries = columns
            .flat_map(|(a, x)| x.components().map(move |(i, value)| ([i[0], a], value.clone())));
        let change = Tensor::from_components(n, &[Up, Down], entries)?;
        let change = change.with_tolerance(algebra.structure_constants().tolerance());
        let adapted = algebra.in_basis(&BasisChange::new(change)?, labels(r, n - r))?;
        // states brackets that escape in the given basis
        if let Some((law, [j, k])) = escaping(&adapted, r) {
            let vector = |k: usize| basis[k].to_vector().unwrap_or_default();
            let (x, y) = (vector(j), vector(k));
            let bracket = algebra.bracket(&x, &y)?;
            let [x, y, bracket] = [x, y, bracket].map(|v| algebra.left_frame().write(v));
            return Err(law.broken([x, y], bracket));
        }
        Self::adapted(adapted, r)
    }

    /// The pair of an algebra whose first `r` basis vectors span `m`, and whose other basis vectors
    /// span `h`.
    ///
    /// ```
    /// use affinor::algebra::catalogue;
    /// use affinor::{Rational, ReductivePair};
    /// let so3 = catalogue::algebra::<Rational>("so(3)")?;
    /// assert!(ReductivePair::adapted(so3, 2)?.is_symmetric());
    /// # Ok::<(), affinor::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Law::ReductiveIsotropy`] or [`Law::ReductiveComplement`] with the first bracket that
    /// violates the condition; [`Error::Shape`] if `r` exceeds the dimension of the algebra.
    pub fn adapted(algebra: LieAlgebra<S>, r: usize) -> Result<Self, Error> {
        let n = algebra.dimension();
        if r > n {
            let (expected, found) = (format!("at most {n} vectors"), format!("{r} vectors"));
            return Err(Error::Shape { what: "the basis of m", expected, found });
        }
        if let Some((law, at)) = escaping(&algebra, r) {
            let unit =
                |at: usize| (0..n).map(|i| S::from_i64(i64::from(i == at))).collect::<Vec<_>>();
            let bracket = algebra.bracket(&unit(at[0]), &unit(at[1]))?;
            let vectors = at.map(|at| algebra.labels()[at].clone());
            return Err(law.broken(vectors, algebra.left_frame().write(bracket)));
        }
        let c = algebra.structure_constants();
        // the components of the brackets in h: [x, y]_h
        let vertical = part(c, r, [true, false, false]);
        let curving = formula("v^a_kl c^i_aj -> ^i_j[kl]", &[("v", &vertical), ("c", c)]);
        let labels = &algebra.labels()[..r];
        let frame = Frame::reductive(labels, restricted(c, r)?, restricted(&curving, r)?)?;
        let acting = part(c, r, [false, true, false]);
        let isotropy = (r..n).map(|a| {
            let ad = acting.components().filter(|(at, _)| at[1] == a);
            let ad = ad.map(|(at, value)| ([at[0], at[2]], value.clone()));
            Ok(Tensor::from_components(r, &[Up, Down], ad)?.with_tolerance(c.tolerance()))
        });
        let isotropy = isotropy.collect::<Result<_, Error>>()?;
        Ok(ReductivePair { algebra, frame, isotropy })
    }

    /// The pair of `h` and the complement that is orthogonal to `h` under the Killing form.
    ///
    /// # Errors
    /// [`Law::KillingOnSubalgebra`] if the Killing form is degenerate on `h`. In this case, the
    /// orthogonal space is not a complement, but other complements may exist.
    /// [`Error::SingularBasis`] for dependent vectors. The other errors are those of
    /// [`new`](Self::new).
    pub fn orthogonal(algebra: &LieAlgebra<S>, h: &[Vec<S>]) -> Result<Self, Error> {
        Self::new(algebra, h, &Self::orthogonal_complement(algebra, h)?)
    }

    fn orthogonal_complement(algebra: &LieAlgebra<S>, h: &[Vec<S>]) -> Result<Vec<Vec<S>>, Error> {
        let killing = algebra.killing_form();
        let rows = h.iter().map(|x| {
            let x = algebra.vector(x)?;
            let row = formula("K_ij x^i -> _j", &[("K", &killing), ("x", &x)]);
            Ok(row.components().map(|(j, value)| (j[0], value.clone())).collect())
        });
        let rows = rows.collect::<Result<Vec<Vec<_>>, Error>>()?;
        let tolerance = killing.tolerance();
        let products = Matrix::from_rows(algebra.dimension(), rows)?.with_tolerance(tolerance);
        if !h.is_empty() {
            let vectors = Matrix::from_dense(h)?.with_tolerance(tolerance);
            if vectors.rank()? < h.len() {
                return Err(Error::SingularBasis);
            }
            // the kernel of the Killing form restricted to h
            let null = products.mul(&vectors.transpose())?.nullspace()?;
            if null.rows() > 0 {
                let x = vectors.transpose().apply(&null.to_dense()[0])?;
                let null = algebra.left_frame().write(x);
                return Err(Law::KillingOnSubalgebra.broken([null], "0"));
            }
        }
        Ok(products.nullspace()?.to_dense())
    }

    /// The second canonical connection, `Lambda = 0`. Invariant tensors are parallel. The torsion
    /// is `T(x,y) = -[x,y]_m`, and the curvature is `R(x,y)z = -[[x,y]_h, z]`.
    pub fn canonical(&self) -> Connection<S> {
        Connection::in_frame(&self.frame, &S::zero())
    }

    /// The first canonical connection, which is the torsion-free natural one:
    /// `Lambda(x) y = [x,y]_m / 2`. It has the same geodesics as [`canonical`](Self::canonical).
    ///
    /// # Errors
    /// [`Error::Tensor`] if 2 has no inverse in the scalars.
    pub fn natural(&self) -> Result<Connection<S>, Error> {
        let half = S::from_i64(2).recip().ok_or(TensorError::NotInvertible(2))?;
        Ok(Connection::in_frame(&self.frame, &half))
    }

    /// The invariant connection with the affinities `Lambda^i_jk` on `m`.
    ///
    /// # Errors
    /// [`Error::Shape`]; [`Law::IsotropyInvariance`] unless the affinities are invariant under `h`.
    pub fn connection(&self, gamma: Tensor<S>) -> Result<Connection<S>, Error> {
        let connection = Connection::new(self.frame.clone(), gamma)?;
        self.expect_invariant("the affinities", connection.affinities())?;
        Ok(connection)
    }

    /// The Levi-Civita connection of an invariant metric `g_ij` on `m`:
    /// `Lambda(x) y = [x,y]_m / 2 + U(x,y)`.
    ///
    /// ```
    /// use affinor::algebra::catalogue;
    /// use affinor::{Metric, Rational, ReductivePair};
    /// let so3 = catalogue::algebra("so(3)")?;
    /// let sphere = ReductivePair::orthogonal(&so3, &[[0, 0, 1].map(Rational::from).to_vec()])?;
    /// let round = Metric::identity(2)?;
    /// assert_eq!(sphere.levi_civita(&round)?.scalar_curvature(&round)?, 2.into());
    /// # Ok::<(), affinor::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::Shape`]; [`Law::IsotropyInvariance`] unless the metric is invariant under `h`.
    #[doc(alias("Levi-Civita"))]
    pub fn levi_civita(&self, metric: &Metric<S>) -> Result<Connection<S>, Error> {
        let slots = [Down, Down];
        expect_slots("the metric", metric.components(), self.dimension(), &slots)?;
        self.expect_invariant("the metric", metric.components())?;
        Connection::levi_civita(&self.frame, metric)
    }

    /// A basis of the `h`-invariant tensors on `m`, which are the invariant tensor fields of G/H.
    /// If H is connected, the tensors with the slots `^i_jk` are the invariant connections (H.-C.
    /// Wang, *Nagoya Math. J.* 13 (1958) 1-19).
    ///
    /// # Errors
    /// The errors of [`invariant_tensors`].
    pub fn invariant_tensors(&self, slots: &[Variance]) -> Result<Vec<Tensor<S>>, Error> {
        invariant_tensors(self.dimension(), slots, &self.isotropy)
    }

    /// Checks that a tensor on `m` is invariant under `h`; `what` is its name in the error.
    ///
    /// # Errors
    /// [`Law::IsotropyInvariance`].
    pub(crate) fn expect_invariant(
        &self,
        what: &'static str,
        tensor: &Tensor<S>,
    ) -> Result<(), Error> {
        for (a, endomorphism) in self.isotropy.iter().enumerate() {
            if let Some((at, residual)) = act(endomorphism, tensor)?.components().next() {
                let direction = self.algebra.labels()[self.dimension() + a].clone();
                let at = [
                    what.into(),
                    direction,
                    crate::error::indices(at.iter().map(|index| index + 1)),
                ];
                return Err(Law::IsotropyInvariance.broken(at, residual.to_string()));
            }
        }
        Ok(())
    }
}

impl<S: Scalar> ReductivePair<S> {
    /// The Lie algebra in the adapted basis: first the basis of `m`, then the basis of `h`.
    pub fn algebra(&self) -> &LieAlgebra<S> {
        &self.algebra
    }

    /// The frame of `m`. Its structure is `[e_j, e_k]_m`; its isotropy `[[e_k, e_l]_h, .]` occurs
    /// in every curvature.
    pub fn frame(&self) -> &Frame<S> {
        &self.frame
    }

    /// The dimension of G/H.
    pub fn dimension(&self) -> usize {
        self.frame.dimension()
    }

    /// The isotropy representation. For each basis vector `x` of `h`, the list contains `ad_x` on
    /// `m`, slots `^i_j`.
    pub fn isotropy(&self) -> &[Tensor<S>] {
        &self.isotropy
    }

    /// Whether `h` contains `[m, m]`. In this case, the two canonical connections coincide, are
    /// torsion-free, and have parallel curvature.
    pub fn is_symmetric(&self) -> bool {
        self.frame.structure_functions().is_empty()
    }
}

/// The labels `m1, ..., h1, ...` of an adapted basis.
fn labels(m: usize, h: usize) -> Vec<String> {
    let numbered = |letter: &'static str, count| (1..=count).map(move |at| format!("{letter}{at}"));
    numbered("m", m).chain(numbered("h", h)).collect()
}

/// The constants `c^i_jk` whose indices belong to `h` where `of_h` is true, and to `m` elsewhere.
fn part<S: Scalar>(c: &Tensor<S>, r: usize, of_h: [bool; 3]) -> Tensor<S> {
    c.filter_map(|at, value| at.iter().map(|i| *i >= r).eq(of_h).then(|| value.clone()))
}

/// The first bracket of basis vectors that violates a condition of a reductive pair in an adapted
/// basis, with the condition.
fn escaping<S: Scalar>(algebra: &LieAlgebra<S>, r: usize) -> Option<(Law, [usize; 2])> {
    let conditions = [
        (Law::ReductiveIsotropy, [false, true, true]),
        (Law::ReductiveComplement, [true, true, false]),
    ];
    conditions.into_iter().find_map(|(law, of_h)| {
        let escaped = part(algebra.structure_constants(), r, of_h);
        escaped.components().next().map(|(at, _)| (law, [at[1], at[2]]))
    })
}

/// The components whose indices are all below `r`, as a tensor of dimension `r`.
fn restricted<S: Scalar>(tensor: &Tensor<S>, r: usize) -> Result<Tensor<S>, Error> {
    let inside = tensor.components().filter(|(at, _)| at.iter().all(|index| *index < r));
    let inside = inside.map(|(at, value)| (at, value.clone()));
    let result = Tensor::from_components(r, tensor.slots(), inside)?;
    Ok(result.with_tolerance(tensor.tolerance()))
}
