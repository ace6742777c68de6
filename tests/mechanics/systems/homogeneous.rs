//! Curves on homogeneous spaces: the force is absent exactly for geodesics, and bases are checked.

use affinor::algebra::catalogue;
use affinor::group::{AnyGroup, LieGroup};
use affinor::mechanics::Adaptive;
use affinor::mechanics::systems::HomogeneousSystem;
use affinor::{Error, Metric, ReductivePair};
use affinor_tensors::{Down, Tensor};
use nalgebra::{DMatrix, DVector};

/// The flags of C^3: the vectors e1, ..., e6 of su(3) span the complement.
fn flags() -> ReductivePair<f64> {
    ReductivePair::adapted(catalogue::algebra("su(3)").unwrap(), 6).unwrap()
}

/// The metric with one factor for each pair of basis vectors.
fn metric(factors: [f64; 3]) -> Metric<f64> {
    let entries = (0..6).map(|i| ([i, i], factors[i / 2]));
    let components = Tensor::from_components(6, &[Down, Down], entries).unwrap();
    Metric::new(flags().frame().labels(), components).unwrap()
}

fn group() -> (AnyGroup, DMatrix<f64>) {
    (AnyGroup::named("su(3)").unwrap(), DMatrix::identity(8, 8))
}

/// The Levi-Civita connection has the geodesics of its metric as curves, and the natural connection
/// only if the metric is naturally reductive.
#[test]
fn geodesics_need_no_force() {
    let ((group, basis), pair) = (group(), flags());
    for factors in [[1.0; 3], [1.0, 2.0, 4.0], [3.0, 0.5, 0.1]] {
        let metric = metric(factors);
        let levi_civita = pair.levi_civita(&metric).unwrap();
        let system = HomogeneousSystem::new(&group, &basis, &levi_civita, Some(&metric), 0);
        let system = system.unwrap();
        assert!(system.is_geodesic() && system.conserves_energy() && system.is_metric());
        let natural = pair.natural().unwrap();
        let natural = HomogeneousSystem::new(&group, &basis, &natural, Some(&metric), 0).unwrap();
        assert_eq!(natural.is_geodesic(), factors == [1.0; 3]);
        let canonical = pair.canonical();
        let system = HomogeneousSystem::new(&group, &basis, &canonical, Some(&metric), 0);
        let system = system.unwrap();
        // the canonical connection makes all invariant tensors parallel
        assert!(system.is_metric() && system.conserves_energy());
    }
}

/// The curves of the natural connection are the orbits of `exp(t v)`, also with the force that a
/// metric without these geodesics needs.
#[test]
fn curves_of_the_natural_connection() {
    let ((group, basis), pair, metric) = (group(), flags(), metric([1.0, 2.0, 4.0]));
    let natural = pair.natural().unwrap();
    let system = HomogeneousSystem::new(&group, &basis, &natural, Some(&metric), 1).unwrap();
    let velocity = DVector::from_column_slice(&[0.3, -0.5, 0.7, 0.2, 0.4, -0.1]);
    let start = system.state(0.0, &group.identity(), &velocity, std::slice::from_ref(&velocity));
    let end = Adaptive::of_order_8(1e-12).states(&system, &start, &[2.0]).unwrap().remove(0);
    let tangent = basis.columns(0, 6) * &velocity;
    assert!((&*system.element(&end) - group.exp(&(tangent * 2.0))).amax() < 1e-10);
    // the velocity is parallel along the curve
    assert!((system.velocity(&end) - &velocity).amax() < 1e-10);
    assert!((system.vector(&end, 0) - &velocity).amax() < 1e-10);
}

#[test]
fn bases_are_checked() {
    let ((group, basis), natural) = (group(), flags().natural().unwrap());
    let refused = |basis: &DMatrix<f64>| {
        HomogeneousSystem::new(&group, basis, &natural, None, 0).map(|_| ()).unwrap_err()
    };
    assert!(matches!(refused(&DMatrix::identity(7, 7)), Error::Shape { .. }));
    assert!(matches!(refused(&DMatrix::zeros(8, 8)), Error::SingularBasis));
    // another basis has other brackets
    assert!(matches!(refused(&(basis * 2.0)), Error::Shape { .. }));
}
