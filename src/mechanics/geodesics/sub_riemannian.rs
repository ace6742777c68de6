//! Geodesics of left-invariant distributions: extremals, conjugate times, and geodesics between two
//! points.

mod abnormal;
mod jacobi;
mod shooting;

pub use abnormal::AbnormalExtremal;
pub use jacobi::Conjugacy;
pub use shooting::{HorizontalGeodesic, HorizontalShooting};

use crate::Error;
use crate::algebra::structure::Subspace;
use crate::geometry::SubRiemannian;
use crate::group::{AnyGroup, LieGroup};
use crate::mechanics::{Adaptive, LiePoissonSystem, State};
use nalgebra::{DMatrix, DVector};

/// The tolerance of a step of an extremal.
const TOLERANCE: f64 = 1e-13;
/// The largest number of steps of one curve.
const STEPS: usize = 20_000;
/// Brackets of the algebra and of the group agree up to this difference, relative to their size.
const AGREEMENT: f64 = 1e-9;

/// A group with a left-invariant distribution and an inner product on it, in floats.
///
/// ```
/// use affinor::algebra::catalogue;
/// use affinor::geometry::SubRiemannian;
/// use affinor::group::{AnyGroup, LieGroup};
/// use affinor::mechanics::geodesics::SubRiemannianGroup;
/// use nalgebra::dvector;
/// // the Heisenberg group: a circle encloses the area 1/(4 pi) per squared length
/// let algebra = catalogue::algebra::<f64>("heisenberg(3)")?;
/// let plane = SubRiemannian::orthonormal(&algebra, [0, 1].map(|at| vec![(at, 1.0)]))?;
/// let group = AnyGroup::named("heisenberg(3)")?;
/// let space = SubRiemannianGroup::new(group.clone(), &plane)?;
/// let p = dvector![1.0, 0.0, std::f64::consts::TAU];
/// let end = space.extremal(&group.identity(), &p, &[1.0])?.remove(0);
/// let x = group.log(&end.element)?;
/// assert!((x - dvector![0.0, 0.0, 0.25 / std::f64::consts::PI]).amax() < 1e-11);
/// # Ok::<(), affinor::Error>(())
/// ```
#[derive(Clone, Debug)]
pub struct SubRiemannianGroup {
    group: AnyGroup,
    /// The cometric `Q^ij`.
    cometric: DMatrix<f64>,
    /// The vectors that span the distribution, as columns.
    vectors: DMatrix<f64>,
    /// The inner products of these vectors.
    products: DMatrix<f64>,
    /// The matrices of `ad_(e_k)`.
    ad: Vec<DMatrix<f64>>,
    /// A basis that is adapted to the flag of the distribution, as columns, and the weight of each
    /// vector: 1 in the distribution, 2 for its brackets, and so on.
    adapted: (DMatrix<f64>, Vec<i32>),
    /// The growth vector.
    growth: Vec<usize>,
}

/// A point of an extremal.
#[derive(Clone, Debug, PartialEq)]
pub struct ExtremalPoint {
    /// The time.
    pub time: f64,
    /// The element, as embedding coordinates.
    pub element: DVector<f64>,
    /// The covector in the left-invariant basis.
    pub covector: DVector<f64>,
}

impl SubRiemannianGroup {
    /// The structure on a group whose algebra is the algebra of the structure, in the same basis.
    ///
    /// # Errors
    /// [`Error::Shape`] if the dimensions differ; [`Error::Invalid`] if the inner product is not
    /// positive definite, or if the brackets of the group are not those of the algebra.
    pub fn new(group: AnyGroup, structure: &SubRiemannian<f64>) -> Result<Self, Error> {
        let n = structure.dimension();
        if group.dimension() != n {
            return Err(Error::Shape {
                what: "the group",
                expected: format!("dimension {n}"),
                found: format!("dimension {}", group.dimension()),
            });
        }
        let ad: Vec<_> =
            group.basis().iter().map(|x| group.operator_matrix(|y| group.bracket(x, y))).collect();
        expect_same_brackets(&ad, structure)?;
        let r = structure.vectors().len();
        let inverse = DMatrix::from_fn(r, r, |a, b| structure.inverse_product(a, b));
        let products = inverse.cholesky().map(|factor| factor.inverse());
        let products = products.ok_or_else(|| Error::Invalid {
            what: "distribution",
            reason: "the inner product on it is not positive definite".into(),
        })?;
        let growth = structure.distribution().growth_vector();
        let cometric = DMatrix::from_fn(n, n, |i, j| structure.cometric().get(&[i, j]));
        let vectors = dense(n, structure.vectors());
        let adapted = adapted(structure, &growth);
        Ok(SubRiemannianGroup { group, cometric, vectors, products, ad, adapted, growth })
    }

    /// The group.
    pub fn group(&self) -> &AnyGroup {
        &self.group
    }

    /// The growth vector of the distribution.
    pub fn growth_vector(&self) -> &[usize] {
        &self.growth
    }

    /// Whether the distribution generates the algebra, so that it joins all elements.
    pub fn is_bracket_generating(&self) -> bool {
        self.growth.last() == Some(&self.group.dimension())
    }

    /// The velocity `u = Q p` of the normal extremal with the covector `p`.
    pub fn velocity(&self, covector: &DVector<f64>) -> DVector<f64> {
        &self.cometric * covector
    }

    /// The speed `sqrt(Q^ij p_i p_j)`, which is constant along a normal extremal.
    pub fn speed(&self, covector: &DVector<f64>) -> f64 {
        covector.dot(&self.velocity(covector)).max(0.0).sqrt()
    }

    /// The points of a normal extremal at the given times. It begins at the element `start` at the
    /// time 0, with the covector `p`. From the identity, the element at the time `t` is the
    /// exponential map of `t p`.
    ///
    /// # Errors
    /// [`Error::Invalid`] if the covector annihilates the distribution, because its extremal is
    /// constant; [`Error::Shape`] for a covector of another dimension; [`Error::Integration`].
    pub fn extremal(
        &self,
        start: &DVector<f64>,
        covector: &DVector<f64>,
        times: &[f64],
    ) -> Result<Vec<ExtremalPoint>, Error> {
        self.expect_moving(covector)?;
        self.normal(start, covector, times, TOLERANCE, STEPS)
    }

    fn normal(
        &self,
        start: &DVector<f64>,
        covector: &DVector<f64>,
        times: &[f64],
        tolerance: f64,
        steps: usize,
    ) -> Result<Vec<ExtremalPoint>, Error> {
        let gradient = |p: &DVector<f64>| self.velocity(p);
        let system = LiePoissonSystem { group: self.group.clone(), gradient };
        let first = system.state(0.0, start.clone(), covector);
        let control = Adaptive { max_steps: steps, ..Adaptive::of_order_8(tolerance) };
        let states = control.states(&system, &first, times)?;
        Ok(states.into_iter().map(|state| self.point(state)).collect())
    }

    fn point(&self, state: State<AnyGroup>) -> ExtremalPoint {
        let covector = state.momentum(&self.group);
        ExtremalPoint { time: state.time, element: state.element, covector }
    }

    fn expect_covector(&self, covector: &DVector<f64>) -> Result<(), Error> {
        let n = self.group.dimension();
        match covector.len() == n {
            true => Ok(()),
            false => Err(Error::Shape {
                what: "the covector",
                expected: format!("{n} components"),
                found: covector.len().to_string(),
            }),
        }
    }

    fn expect_moving(&self, covector: &DVector<f64>) -> Result<(), Error> {
        self.expect_covector(covector)?;
        if self.speed(covector) > 0.0 {
            return Ok(());
        }
        Err(Error::Invalid {
            what: "covector",
            reason: "it annihilates the distribution, so its normal extremal is constant".into(),
        })
    }

    /// The matrix of `ad_x`.
    fn ad(&self, x: &DVector<f64>) -> DMatrix<f64> {
        combination(&self.ad, x)
    }
}

/// The sum `x_k m_k` of matrices.
fn combination(matrices: &[DMatrix<f64>], x: &DVector<f64>) -> DMatrix<f64> {
    let zero = DMatrix::zeros(x.len(), x.len());
    matrices.iter().zip(x.iter()).filter(|(_, x)| **x != 0.0).fold(zero, |sum, (m, x)| sum + m * *x)
}

/// Rows of nonzero components as the columns of a matrix.
fn dense(n: usize, vectors: &[Vec<(usize, f64)>]) -> DMatrix<f64> {
    let mut matrix = DMatrix::zeros(n, vectors.len());
    for (a, vector) in vectors.iter().enumerate() {
        vector.iter().for_each(|(i, value)| matrix[(*i, a)] = *value);
    }
    matrix
}

fn expect_same_brackets(ad: &[DMatrix<f64>], structure: &SubRiemannian<f64>) -> Result<(), Error> {
    let constants = structure.distribution().structure_constants();
    let size = ad.iter().fold(1.0_f64, |size, matrix| size.max(matrix.amax()));
    for (j, matrix) in ad.iter().enumerate() {
        for (at, found) in matrix.iter().enumerate() {
            let (k, i) = (at / ad.len(), at % ad.len());
            let expected = constants.get(&[i, j, k]);
            if (found - expected).abs() > AGREEMENT * size {
                let [i, j, k] = [i, j, k].map(|index| index + 1);
                let reason = format!(
                    "its structure constant ^{i}_{j}{k} is {found}, but the algebra has {expected}"
                );
                return Err(Error::Invalid { what: "group", reason });
            }
        }
    }
    Ok(())
}

/// A basis whose first vectors span the distribution, followed by brackets that span the terms of
/// its flag, and by vectors outside the last term. The weights are the numbers of the terms.
fn adapted(structure: &SubRiemannian<f64>, growth: &[usize]) -> (DMatrix<f64>, Vec<i32>) {
    let n = structure.dimension();
    let distribution = structure.distribution();
    let brackets = distribution.generating_brackets().into_iter().map(|witness| witness.bracket);
    let mut rows: Vec<_> = structure.vectors().iter().cloned().chain(brackets).collect();
    let mut span = Subspace::span(n, rows.clone());
    for at in 0..n {
        let unit = vec![(at, 1.0)];
        if span.add(unit.clone()) {
            rows.push(unit);
        }
    }
    let weight = |at: usize| {
        let term = growth.iter().position(|dimension| at < *dimension);
        term.unwrap_or(growth.len()) as i32 + 1
    };
    (dense(n, &rows), (0..n).map(weight).collect())
}
