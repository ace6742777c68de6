//! The groups, algebras and geometries on which the equations are checked.

use affinor::algebra::catalogue;
use affinor::group::transport::ParallelTranslation;
use affinor::group::{AnyGroup, LieGroup, So3, Velocity};
use affinor::{CanonicalConnection, Connection, Error, Geometry, LieAlgebra, Metric};
use affinor_documents::space::paper;
use affinor_tensors::{Down, Rational, Symbolic, Tensor, Up};
use nalgebra::{DMatrix, DVector, Matrix3, Vector3};

/// The objects of the checks: the two geometries of the paper, the algebra of rotations, and the
/// groups on which general statements are checked.
pub(crate) struct Lab {
    /// M(3): the rotation group with the connection `plus` and the inertia as its metric.
    pub m3: Geometry<Symbolic>,
    /// "SO(3)": the rotation group with the connection `zero` and the bi-invariant metric (102).
    pub so3: Geometry<Rational>,
    /// The algebra so(3) over symbolic expressions.
    pub rotations: LieAlgebra<Symbolic>,
    /// SO(3), SE(2), SE(3), SL(2), the Heisenberg group and the affine group of the line.
    pub groups: Vec<AnyGroup>,
    /// The algebras of these groups over the rational numbers.
    pub algebras: Vec<LieAlgebra<Rational>>,
}

/// The names of the groups and of their algebras.
const NAMES: [&str; 6] = ["so(3)", "se(2)", "se(3)", "sl(2)", "heisenberg(3)", "aff(1)"];

impl Lab {
    pub fn new() -> Result<Self, Error> {
        Ok(Lab {
            m3: paper::m3()?,
            so3: paper::so3()?,
            rotations: catalogue::algebra("so(3)")?,
            groups: NAMES.iter().map(|name| AnyGroup::named(name)).collect::<Result<_, _>>()?,
            algebras: NAMES
                .iter()
                .map(|name| catalogue::algebra(name))
                .collect::<Result<_, _>>()?,
        })
    }

    /// The inertia `J_ij` with symbolic entries.
    pub fn inertia(&self) -> Result<&Metric<Symbolic>, Error> {
        self.m3.metric().ok_or(Error::NoMetric)
    }

    /// A canonical connection on the rotation group, over symbolic expressions.
    pub fn canonical(&self, which: CanonicalConnection) -> Connection<Symbolic> {
        Connection::canonical(&self.rotations, which)
    }

    /// The algebras with their names.
    pub fn named(&self) -> impl Iterator<Item = (&'static str, &LieAlgebra<Rational>)> {
        NAMES.into_iter().zip(&self.algebras)
    }

    /// The largest error of a law among all groups.
    pub fn on_groups(&self, law: impl Fn(&AnyGroup) -> Result<f64, Error>) -> Result<f64, Error> {
        self.groups.iter().try_fold(0.0, |worst: f64, group| Ok(worst.max(law(group)?)))
    }

    /// The smallest error of a law among all groups, for laws that should fail on every group.
    pub fn least_on_groups(
        &self,
        law: impl Fn(&AnyGroup) -> Result<f64, Error>,
    ) -> Result<f64, Error> {
        self.groups.iter().try_fold(f64::INFINITY, |least, group| Ok(f64::min(least, law(group)?)))
    }
}

/// Three vectors of length about 1, without symmetries.
pub(crate) fn vectors(group: &AnyGroup) -> [DVector<f64>; 3] {
    let n = group.dimension();
    [0.0, 1.0, 2.0]
        .map(|a| DVector::from_fn(n, |i, _| 0.9 * (1.3 + 2.1 * i as f64 + 1.7 * a).sin()))
}

/// A motion that is not a one-parameter group. All components of its velocity are nonzero.
pub(crate) fn motion(group: &AnyGroup) -> impl Fn(f64) -> DVector<f64> {
    let [x, y, z] = vectors(group);
    move |t| {
        let factors = [&z * 0.4, &x * t.sin(), &y * (t * t)];
        factors.iter().fold(group.identity(), |g, x| group.compose(&g, &group.exp(x)))
    }
}

/// A motion on the rotation group.
pub(crate) fn rotation(t: f64) -> nalgebra::UnitQuaternion<f64> {
    let factors = [
        Vector3::new(0.3, -0.1, 0.2),
        Vector3::new(0.9, -0.4, 0.5) * t.sin(),
        Vector3::new(-0.2, 0.7, 0.6) * (t * t),
    ];
    factors.iter().fold(So3.identity(), |g, x| So3.compose(&g, &So3.exp(x)))
}

/// The velocity of a motion, by central differences of its elements.
pub(crate) fn velocity(group: &AnyGroup, t: f64) -> Result<Velocity<DVector<f64>>, Error> {
    Velocity::of_path(group, motion(group), t, 0.02)
}

/// Parallel transport by a canonical connection.
pub(crate) fn translation<G: LieGroup + Clone>(
    group: &G,
    which: CanonicalConnection,
) -> Result<ParallelTranslation<G>, Error> {
    ParallelTranslation::new(group.clone(), Connection::canonical(&group.algebra()?, which))
}

/// The derivative of a curve at `t`, by central differences that are extrapolated to order 6.
pub(crate) fn rate(curve: impl Fn(f64) -> DMatrix<f64>, t: f64) -> DMatrix<f64> {
    let difference = |h: f64| (curve(t + h) - curve(t - h)) / (2.0 * h);
    let [coarse, half, quarter] = [0.02, 0.01, 0.005].map(difference);
    let (first, second) = ((&half * 4.0 - coarse) / 3.0, (quarter * 4.0 - half) / 3.0);
    (second * 16.0 - first) / 15.0
}

/// The matrix of a vector of the algebra: the derivative of its one-parameter group at the identity.
pub(crate) fn hat(group: &AnyGroup, x: &DVector<f64>) -> DMatrix<f64> {
    rate(|t| group.matrix(&group.exp(&(x * t))), 0.0)
}

/// The difference of two matrices, relative to their size.
pub(crate) fn distance(found: &DMatrix<f64>, expected: &DMatrix<f64>) -> f64 {
    (found - expected).amax() / (1.0 + expected.amax())
}

/// The difference of two vectors, relative to their size.
pub(crate) fn apart(found: &DVector<f64>, expected: &DVector<f64>) -> f64 {
    (found - expected).amax() / (1.0 + expected.amax())
}

/// `ad_x` of a group; the upper index is the row.
pub(crate) fn ad(group: &AnyGroup, x: &DVector<f64>) -> DMatrix<f64> {
    group.operator_matrix(|v| group.bracket(x, v))
}

/// The matrix with the rows `[0, -w3, w2], [w3, 0, -w1], [-w2, w1, 0]`, (6).
pub(crate) fn spin(w: &Vector3<f64>) -> Matrix3<f64> {
    w.cross_matrix()
}

/// The symbols `w1`, `w2`, ... for the name `w`.
pub(crate) fn symbols(name: &str, n: usize) -> Vec<Symbolic> {
    (1..=n).map(|i| Symbolic::parameter(&format!("{name}{i}"))).collect()
}

/// The components of the cross product `a x b`.
pub(crate) fn cross(a: &[Symbolic], b: &[Symbolic]) -> Vec<Symbolic> {
    let term = |i: usize, j: usize| a[i].clone() * &b[j] - &(a[j].clone() * &b[i]);
    vec![term(1, 2), term(2, 0), term(0, 1)]
}

/// The alternating tensor, with slots like those of structure constants.
pub(crate) fn epsilon() -> Result<Tensor<Rational>, Error> {
    let sign = |at: [usize; 3]| match at {
        [0, 1, 2] | [1, 2, 0] | [2, 0, 1] => 1,
        [0, 2, 1] | [2, 1, 0] | [1, 0, 2] => -1,
        _ => 0,
    };
    Ok(Tensor::from_fn(3, [Up, Down, Down], |at| Rational::from(sign(at)))?)
}
