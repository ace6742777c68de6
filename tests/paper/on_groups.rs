//! The groups of the library beside matrices of their algebras, written down by hand.

use crate::paper::matrices::{self, Basis};
use affinor::group::transport::ParallelTranslation;
use affinor::group::{Coordinates, LieGroup, MatrixGroup};
use affinor::{Canonical, Connection};
use nalgebra::{DMatrix, DVector};

/// A law for SO(3), SE(2), SE(3), SL(2,R), the Heisenberg group and the affine group of the line.
macro_rules! on_every_group {
    ($law:ident) => {{
        use affinor::group::{Heisenberg, Se2, Se3, Sl2, So3};
        use $crate::paper::{matrices, on_groups};
        $law("SO(3)", &So3, &matrices::so3());
        $law("SE(2)", &Se2, &matrices::se2());
        $law("SE(3)", &Se3, &matrices::se3());
        $law("SL(2,R)", &Sl2, &on_groups::sl2());
        $law("Heisenberg", &Heisenberg::<nalgebra::Const<3>>::new(), &matrices::heisenberg());
        $law("Aff(1)", &on_groups::affine(), &matrices::affine());
    }};
}
pub(crate) use on_every_group;

pub const CANONICAL: [Canonical; 3] = [Canonical::Plus, Canonical::Zero, Canonical::Minus];

/// `E, F, H`, the order of the library.
pub fn sl2() -> Basis {
    let [h, e, f] = <[_; 3]>::try_from(matrices::sl2().0).unwrap();
    Basis(vec![e, f, h])
}

pub fn affine() -> MatrixGroup {
    MatrixGroup::new(&matrices::affine().0).unwrap()
}

/// Three vectors without a pattern, of length about 1.
pub fn vectors<G: LieGroup>(group: &G) -> [G::Vector; 3] {
    [0.0, 1.0, 2.0].map(|a| {
        let components =
            (0..group.dimension()).map(|i| 0.9 * (1.3 + 2.1 * i as f64 + 1.7 * a).sin());
        G::Vector::from_components(&components.collect::<Vec<_>>())
    })
}

/// A curve that is no one-parameter group, with all components of its velocity.
pub fn path<G: LieGroup>(group: &G) -> impl Fn(f64) -> G::Element {
    let [x, y, z] = vectors(group);
    move |t| {
        let factors = [z.clone() * 0.4, x.clone() * t.sin(), y.clone() * (t * t)];
        factors.iter().fold(group.identity(), |g, x| group.compose(&g, &group.exp(x)))
    }
}

pub fn column<V: Coordinates>(x: &V) -> DVector<f64> {
    DVector::from_column_slice(x.components())
}

pub fn hat<V: Coordinates>(basis: &Basis, x: &V) -> DMatrix<f64> {
    basis.combine(x.components())
}

/// The commutator of the matrices of `x` and `y`, in components.
pub fn commutator<V: Coordinates>(basis: &Basis, x: &V, y: &V) -> DVector<f64> {
    let (x, y) = (hat(basis, x), hat(basis, y));
    basis.components(&(&x * &y - &y * &x))
}

/// The derivative at `t`: central differences, extrapolated to order 6.
pub fn rate(curve: impl Fn(f64) -> DMatrix<f64>, t: f64) -> DMatrix<f64> {
    let difference = |h: f64| (curve(t + h) - curve(t - h)) / (2.0 * h);
    let [coarse, half, quarter] = [0.02, 0.01, 0.005].map(difference);
    let (first, second) = ((&half * 4.0 - coarse) / 3.0, (quarter * 4.0 - half) / 3.0);
    (second * 16.0 - first) / 15.0
}

/// The derivative at `t` of components.
pub fn slope(curve: impl Fn(f64) -> DVector<f64>, t: f64) -> DVector<f64> {
    let as_matrix = |t: f64| {
        let value = curve(t);
        DMatrix::from_column_slice(value.len(), 1, value.as_slice())
    };
    rate(as_matrix, t).column(0).into_owned()
}

pub fn translation<G: LieGroup + Clone>(group: &G, which: Canonical) -> ParallelTranslation<G> {
    let connection = Connection::canonical(&group.algebra().unwrap(), which);
    ParallelTranslation::new(group.clone(), connection).unwrap()
}

/// How far two matrices are apart, beside their size.
pub fn distance(found: &DMatrix<f64>, expected: &DMatrix<f64>) -> f64 {
    (found - expected).amax() / (1.0 + expected.amax())
}

#[track_caller]
pub fn same(found: &DMatrix<f64>, expected: &DMatrix<f64>, what: &str) {
    let off = distance(found, expected);
    assert!(off < 1e-11, "{what}: {off:e}\n{found}{expected}");
}

#[track_caller]
pub fn equal(found: &DVector<f64>, expected: &DVector<f64>, what: &str) {
    let off = (found - expected).amax() / (1.0 + expected.amax());
    assert!(off < 1e-11, "{what}: {off:e}\n{found}{expected}");
}

/// That a wrong formula is seen to be wrong.
#[track_caller]
pub fn differ(wrong: &DVector<f64>, right: &DVector<f64>, what: &str) {
    assert!((wrong - right).amax() > 0.01, "{what}: {wrong}{right}");
}
