//! Autoparallels of invariant connections on homogeneous spaces G/H, with parallel transport.

use super::System;
use super::cotangent::{CotangentSystem, State};
use crate::group::{AnyGroup, LieGroup, Product, Translations};
use crate::{Connection, Error, Metric};
use nalgebra::{DMatrix, DMatrixView, DVector, Dyn};
use std::borrow::Cow;

/// If a coefficient is at most this multiple of the sizes of its terms, it is a rounding error.
const ROUNDING: f64 = 1e-12;

/// Curves on G/H whose velocity is parallel to itself under an invariant connection. On the
/// complement `m` of the isotropy algebra, with `nabla_{e_j} e_k = Lambda^i_jk e_i`:
///
/// ```text
/// g' = g v,   v'^i = -Lambda^i_jk v^j v^k,   u'^i = -Lambda^i_jk v^j u^k
/// ```
///
/// The curve is the horizontal lift `g` of a curve in G/H; its point is the coset `g H`. The
/// vectors `u` are parallel along the curve. For the Levi-Civita connection the curves are the
/// geodesics, for the canonical and the natural connection they are the orbits of `exp(t v)`.
///
/// The unknowns are `g` and a covector `H` on the algebra: `H = J v` on `m`, and `H = 0` on the
/// isotropy algebra. Here `J` is the metric, or the identity without a metric. Then
/// `H' = ad*_v H + F`, so that every method for systems of an element and a momentum applies. For
/// geodesics `F = 0`, and `h = Ad*_(g^-1) H` is conserved (Noether). Vectors `u` are momenta of an
/// additional factor `R^n` of the group.
///
/// Source: K. Nomizu, *Amer. J. Math.* 76 (1954) 33-65.
///
/// ```
/// use affinor::group::{AnyGroup, LieGroup, MatrixNotation};
/// use affinor::mechanics::{Adaptive, systems::HomogeneousSystem};
/// use affinor::{ReductivePair, algebra::catalogue};
/// use nalgebra::{DMatrix, dvector};
/// // the sphere: rotations, with the isotropy group of the third axis
/// let sphere = ReductivePair::adapted(catalogue::algebra::<f64>("so(3)")?, 2)?;
/// let (group, basis) = (AnyGroup::named("so(3)")?, DMatrix::identity(3, 3));
/// let system = HomogeneousSystem::new(&group, &basis, &sphere.natural()?, None, 0)?;
/// let start = system.state(0.0, &group.identity(), &dvector![1.0, 0.0], &[]);
/// let end = Adaptive::of_order_8(1e-12).states(&system, &start, &[1.0])?.remove(0);
/// // a rotation about the first axis
/// let g = group.write(&system.element(&end));
/// assert!((g[(1, 2)] + 1_f64.sin()).abs() < 1e-12);
/// # Ok::<(), affinor::Error>(())
/// ```
#[doc(alias("geodesic", "parallel transport", "Nomizu map"))]
#[derive(Clone, Debug)]
pub struct HomogeneousSystem {
    /// The group G.
    base: AnyGroup,
    /// The group of the equations: G, times `R^n` for each vector `u`.
    group: AnyGroup,
    /// The adapted basis, first of `m` and then of the isotropy algebra, as columns of components in
    /// the basis of the algebra of G.
    basis: DMatrix<f64>,
    /// The coordinates in the adapted basis: the inverse of the matrix of the adapted basis.
    coordinates: DMatrix<f64>,
    metric: DMatrix<f64>,
    inverse: DMatrix<f64>,
    has_metric: bool,
    /// The components `Lambda^i_jk`, each with its indices.
    affinities: Vec<([usize; 3], f64)>,
    /// The force `F_a = F_akl v^k v^l` in the adapted basis, with `k <= l`.
    force: Vec<([usize; 3], f64)>,
    conserves_energy: bool,
    is_metric: bool,
    vectors: usize,
}

impl HomogeneousSystem {
    /// The system of an invariant connection, and of the number `vectors` of vectors `u`. The
    /// columns of `basis` are the adapted basis, first of `m` and then of the isotropy algebra, in
    /// the basis of the group.
    ///
    /// # Errors
    /// [`Error::Shape`] unless the basis and the connection belong to the group;
    /// [`Error::SingularBasis`].
    pub fn new(
        group: &AnyGroup,
        basis: &DMatrix<f64>,
        connection: &Connection<f64>,
        metric: Option<&Metric<f64>>,
        vectors: usize,
    ) -> Result<Self, Error> {
        let (all, n) = (group.dimension(), connection.frame().dimension());
        let shape = |what, expected: String, found: String| Error::Shape { what, expected, found };
        if basis.shape() != (all, all) || n > all {
            let found = format!("{} x {}", basis.nrows(), basis.ncols());
            return Err(shape("the adapted basis", format!("{all} x {all}"), found));
        }
        let coordinates = basis.clone().try_inverse().ok_or(Error::SingularBasis)?;
        let has_metric = metric.is_some();
        let (metric, inverse) = match metric {
            None => (DMatrix::identity(n, n), DMatrix::identity(n, n)),
            Some(metric) => (metric.components().to_dmatrix()?, metric.inverse().to_dmatrix()?),
        };
        if metric.nrows() != n {
            let found = format!("dimension {}", metric.nrows());
            return Err(shape("the metric", format!("dimension {n}"), found));
        }
        // the brackets [m_k, e_a] in the adapted basis, for each k and each vector e_a
        let bracket = |k: usize, a: usize| {
            let image = group.bracket(&basis.column(k).into(), &basis.column(a).into());
            &coordinates * image
        };
        let brackets: Vec<Vec<DVector<f64>>> =
            (0..n).map(|k| (0..all).map(|a| bracket(k, a)).collect()).collect();
        let structure = connection.frame().structure_functions();
        let size = brackets.iter().flatten().map(|x| x.amax()).fold(0.0, f64::max);
        let differs = (0..n * n * n).map(|at| [at / (n * n), at / n % n, at % n]).find(|at| {
            let [i, j, k] = *at;
            (brackets[j][k][i] - structure.get(&[i, j, k])).abs() > 1e-9 * size
        });
        if let Some([i, j, k]) = differs {
            let expected = format!("{} in the frame of the connection", structure.get(&[i, j, k]));
            let found = brackets[j][k][i].to_string();
            return Err(shape("a bracket of the adapted basis", expected, found));
        }
        let components = connection.affinities().components();
        let affinities: Vec<([usize; 3], f64)> =
            components.map(|(at, value)| ([at[0], at[1], at[2]], *value)).collect();
        let (force, conserves_energy) = forces(&brackets, &metric, &affinities);
        let is_metric = is_metric(&metric, &affinities);
        let factor = |n: usize| AnyGroup::new(Translations(Dyn(n)));
        let whole = match vectors {
            0 => group.clone(),
            count => AnyGroup::new(Product(group.clone(), factor(n * count))),
        };
        Ok(HomogeneousSystem {
            base: group.clone(),
            group: whole,
            basis: basis.clone(),
            coordinates,
            metric,
            inverse,
            has_metric,
            affinities,
            force,
            conserves_energy,
            is_metric,
            vectors,
        })
    }

    /// The group G.
    pub fn base(&self) -> &AnyGroup {
        &self.base
    }

    /// The dimension of G/H.
    pub fn dimension(&self) -> usize {
        self.metric.nrows()
    }

    /// Whether a metric is given.
    pub fn has_metric(&self) -> bool {
        self.has_metric
    }

    /// The components of a vector of the algebra of G in the adapted basis.
    pub fn adapted(&self, x: &DVector<f64>) -> DVector<f64> {
        &self.coordinates * x
    }

    /// The basis of `m`, as columns of components in the basis of the algebra of G.
    fn complement(&self) -> DMatrixView<'_, f64> {
        self.basis.columns(0, self.dimension())
    }

    /// The basis of the isotropy algebra, in the same form.
    pub(crate) fn isotropy(&self) -> DMatrixView<'_, f64> {
        let n = self.dimension();
        self.basis.columns(n, self.basis.ncols() - n)
    }

    /// Whether the curves are the geodesics of the metric, so that the spatial momentum is
    /// conserved.
    pub fn is_geodesic(&self) -> bool {
        self.force.is_empty()
    }

    /// Whether `J(v, v)` is constant along all curves.
    pub fn conserves_energy(&self) -> bool {
        self.conserves_energy
    }

    /// Whether `J(u, u)` is constant for parallel vectors: the metric is parallel.
    pub fn is_metric(&self) -> bool {
        self.is_metric
    }

    /// The state with an element of G, a velocity in `m`, and vectors in `m` to transport.
    pub fn state(
        &self,
        time: f64,
        element: &DVector<f64>,
        velocity: &DVector<f64>,
        vectors: &[DVector<f64>],
    ) -> State<AnyGroup> {
        let (n, all) = (self.dimension(), self.base.dimension());
        let zeros = vec![0.0; n * vectors.len()];
        let element = DVector::from_vec([element.as_slice(), &zeros].concat());
        let mut adapted = DVector::zeros(all);
        adapted.rows_mut(0, n).copy_from(&(&self.metric * velocity));
        let momentum = self.coordinates.tr_mul(&adapted);
        let parts = [&momentum].into_iter().chain(vectors).map(|part| part.as_slice());
        let momentum = DVector::from_vec(parts.collect::<Vec<_>>().concat());
        State::with_momentum(&self.group, time, element, &momentum)
    }

    /// The element `g`, as embedding coordinates of G.
    pub fn element<'s>(&self, state: &'s State<AnyGroup>) -> Cow<'s, DVector<f64>> {
        let count = state.element.len() - self.dimension() * self.vectors;
        match self.vectors {
            0 => Cow::Borrowed(&state.element),
            _ => Cow::Owned(state.element.rows(0, count).into()),
        }
    }

    /// The velocity `v` in the basis of `m`.
    pub fn velocity(&self, state: &State<AnyGroup>) -> DVector<f64> {
        self.along(&state.momentum(&self.group))
    }

    /// The spatial momentum `h = Ad*_(g^-1) H`, in the basis of the group.
    pub fn spatial_momentum(&self, state: &State<AnyGroup>) -> DVector<f64> {
        let momentum = state.spatial_momentum(&self.group);
        momentum.rows(0, self.base.dimension()).into()
    }

    /// The parallel vector with this index.
    pub fn vector(&self, state: &State<AnyGroup>, at: usize) -> DVector<f64> {
        let momentum = state.momentum(&self.group);
        momentum.rows(self.base.dimension() + at * self.dimension(), self.dimension()).into()
    }

    /// The product `J(x, y)` of vectors of `m`.
    pub fn product(&self, x: &DVector<f64>, y: &DVector<f64>) -> f64 {
        x.dot(&(&self.metric * y))
    }

    /// The velocity in `m` for a momentum.
    fn along(&self, momentum: &DVector<f64>) -> DVector<f64> {
        let momentum = momentum.rows(0, self.base.dimension());
        &self.inverse * self.complement().tr_mul(&momentum)
    }

    /// Subtracts `Lambda(v) u` from `out`.
    fn transport(&self, v: &DVector<f64>, u: &[f64], out: &mut [f64]) {
        for ([i, j, k], value) in &self.affinities {
            out[*i] -= value * v[*j] * u[*k];
        }
    }
}

/// The force `F_akl`, symmetric in `k` and `l`, and whether the energy is conserved:
///
/// ```text
/// F_akl v^k v^l = -J_aj Lambda^j_kl v^k v^l - J([v, e_a]_m, v)
/// ```
///
/// The first term is absent for vectors `e_a` of the isotropy algebra.
fn forces(
    brackets: &[Vec<DVector<f64>>],
    metric: &DMatrix<f64>,
    affinities: &[([usize; 3], f64)],
) -> (Vec<([usize; 3], f64)>, bool) {
    let n = metric.nrows();
    let all = brackets.first().map_or(0, Vec::len);
    let at = |a: usize, k: usize, l: usize| (a * n + k.min(l)) * n + k.max(l);
    // each sum together with the sum of the sizes of its terms
    let mut sums = vec![(0.0, 0.0); all * n * n];
    let mut along = vec![0.0_f64; n * n * n];
    let mut add = |place: usize, term: f64| {
        sums[place].0 += term;
        sums[place].1 += term.abs();
    };
    for ([j, k, l], value) in affinities {
        for a in 0..n {
            let term = -metric[(a, *j)] * value;
            add(at(a, *k, *l), term);
            let mut order = [a, *k, *l];
            order.sort_unstable();
            along[(order[0] * n + order[1]) * n + order[2]] += term;
        }
    }
    let power = affinities.iter().map(|(_, value)| value.abs()).fold(0.0, f64::max) * metric.amax();
    let conserves_energy = along.iter().all(|sum| sum.abs() <= ROUNDING * power);
    for (k, row) in brackets.iter().enumerate() {
        for (a, image) in row.iter().enumerate() {
            for l in 0..n {
                for j in 0..n {
                    add(at(a, k, l), -image[j] * metric[(j, l)]);
                }
            }
        }
    }
    let largest = sums.iter().map(|(_, size)| *size).fold(0.0, f64::max);
    let places = sums.into_iter().enumerate();
    let nonzero = places.filter(|(_, (sum, _))| sum.abs() > ROUNDING * largest);
    let index = |place: usize| [place / (n * n), place / n % n, place % n];
    (nonzero.map(|(place, (sum, _))| (index(place), sum)).collect(), conserves_energy)
}

/// Whether `J_il Lambda^l_jk` is antisymmetric in `i` and `k`.
fn is_metric(metric: &DMatrix<f64>, affinities: &[([usize; 3], f64)]) -> bool {
    let n = metric.nrows();
    let mut sums = vec![0.0_f64; n * n * n];
    let mut largest = 0.0_f64;
    for ([l, j, k], value) in affinities {
        for i in 0..n {
            let term = metric[(i, *l)] * value;
            largest = largest.max(term.abs());
            sums[(i * n + k) * n + j] += term;
            sums[(k * n + i) * n + j] += term;
        }
    }
    sums.iter().all(|sum| sum.abs() <= ROUNDING * largest)
}

impl System for HomogeneousSystem {
    type State = State<AnyGroup>;

    fn time(&self, state: &State<AnyGroup>) -> f64 {
        state.time
    }
}

impl CotangentSystem for HomogeneousSystem {
    type Group = AnyGroup;

    fn group(&self) -> &AnyGroup {
        &self.group
    }

    fn velocity_of(&self, momentum: &DVector<f64>) -> DVector<f64> {
        let mut velocity = DVector::zeros(momentum.len());
        let along = self.complement() * self.along(momentum);
        velocity.rows_mut(0, self.base.dimension()).copy_from(&along);
        velocity
    }

    fn is_free(&self) -> bool {
        self.force.is_empty() && self.vectors == 0
    }

    fn force(
        &self,
        _: f64,
        _: &DVector<f64>,
        _: &DVector<f64>,
        momentum: &DVector<f64>,
    ) -> DVector<f64> {
        let (n, all) = (self.dimension(), self.base.dimension());
        let v = self.along(momentum);
        let mut adapted = DVector::zeros(all);
        for ([a, k, l], value) in &self.force {
            adapted[*a] += value * v[*k] * v[*l];
        }
        let mut force = DVector::zeros(momentum.len());
        force.rows_mut(0, all).copy_from(&self.coordinates.tr_mul(&adapted));
        for at in 0..self.vectors {
            let rows = all + at * n..all + (at + 1) * n;
            let out = &mut force.as_mut_slice()[rows.clone()];
            self.transport(&v, &momentum.as_slice()[rows], out);
        }
        force
    }
}
