//! Projected steps: free motions compared with the equations of their momentum, and groups without
//! a projection.

use super::{affine_line, full};
use affinor::group::{
    Coordinates, Embedded, LieGroup, Product, Se2, Se3, Se23, So3, TranslationSplit,
};
use affinor::mechanics::systems::euler_poincare::Torque;
use affinor::mechanics::{Adaptive, EulerPoincare, Integrator, Projected};
use affinor::{CanonicalConnection, Connection};
use nalgebra::{DMatrix, DVector};

/// A free motion computes its momentum from the displacement in a step; with a torque of zeros the
/// momentum is integrated too.
fn free_as_with_a_torque_of_zeros<G: Embedded + TranslationSplit + Clone>(
    group: G,
    velocity: &[f64],
) {
    let n = group.dimension();
    let plus = Connection::canonical(&group.algebra().unwrap(), CanonicalConnection::Plus);
    let zeros = |_: f64, _: &G::Element, _: &G::Vector| G::Vector::zeros(n);
    let free = EulerPoincare::free(group.clone(), &plus, &full(&group)).unwrap();
    let forced = EulerPoincare::new(group.clone(), &plus, &full(&group), zeros).unwrap();
    let velocity = G::Vector::from_components(velocity);
    let start = group.exp(&(velocity.clone() * 3.0));
    fn end<G: Embedded + TranslationSplit, M: Torque<G>>(
        system: &EulerPoincare<G, M>,
        method: &impl Integrator<EulerPoincare<G, M>>,
        (start, velocity): (&G::Element, &G::Vector),
    ) -> (DMatrix<f64>, G::Vector) {
        let mut state = system.state(0.0, start.clone(), velocity);
        for _ in 0..20 {
            method.step(system, &mut state, 0.1).unwrap();
        }
        (system.group().matrix(&state.element), system.momentum(&state))
    }
    macro_rules! compare {
        ($($method:expr),*) => {$(
            let [(g, p), (h, q)] = [
                end(&free, &$method, (&start, &velocity)),
                end(&forced, &$method, (&start, &velocity)),
            ];
            assert!((&g - &h).amax() < 1e-12 * h.amax(), "{g} {h}");
            assert!((p - q.clone()).largest() < 1e-12 * q.largest());
        )*};
    }
    compare!(Projected::RK4, Projected::DORMAND_PRINCE, Projected::DORMAND_PRINCE_8);
}

#[test]
fn free_motions_as_with_a_torque_of_zeros() {
    free_as_with_a_torque_of_zeros(Se2, &[1.2, 0.8, -0.6]);
    free_as_with_a_torque_of_zeros(Se3, &[0.5, -0.3, 0.6, 0.4, 0.2, -0.5]);
    let long = [0.5, -0.3, 0.6, 0.4, 0.2, -0.5, 0.1, 0.7, -0.2];
    free_as_with_a_torque_of_zeros(Se23, &long);
    free_as_with_a_torque_of_zeros(Product(So3, Se2), &[0.5, -0.3, 0.6, 1.2, 0.8, -0.6]);
}

/// Points near a group of matrices are not projected, and the factors of its elements without a
/// translation are an error.
#[test]
fn a_group_without_a_projection_is_refused() {
    let group = affine_line();
    let plus = Connection::canonical(&group.algebra().unwrap(), CanonicalConnection::Plus);
    let system = EulerPoincare::free(group.clone(), &plus, &full(&group)).unwrap();
    let start = system.state(0.0, group.identity(), &DVector::from_vec(vec![0.6, 0.8]));
    let mut state = start.clone();
    let error = Projected::RK4.step(&system, &mut state, 0.1).unwrap_err();
    assert!(error.to_string().contains("no projection"), "{error}");
    assert_eq!(state.spatial, start.spatial);
    let mut next = 0.1;
    let adaptive = Adaptive::new(1e-6).projected();
    let error = adaptive.step(&system, &mut state, &mut next, 1.0).unwrap_err();
    assert!(error.to_string().contains("no projection"), "{error}");
}
