//! Ends of steps: momenta that do not change are conserved to the last bit.

use affinor::group::{LieGroup, Se3};
use affinor::mechanics::{Integrator, LiePoissonSystem, MuntheKaas, Projected};
use nalgebra::Vector6;

/// A Hamiltonian of the body momentum conserves the spatial momentum: its translations exactly, as velocities transfer momentum
/// to the rotations alone.
#[test]
fn translational_momenta_are_conserved_exactly() {
    let gradient = |h: &Vector6<f64>| {
        Vector6::new(h[0], 0.7 * h[1], 2.0 * h[2] + h[3], 0.3 + h[2], 0.2 - h[4], 1.0 + 0.5 * h[5])
    };
    let system = LiePoissonSystem { group: Se3, gradient };
    let start = Se3.exp(&Vector6::new(0.3, -0.5, 0.2, 1.0, 2.0, -3.0));
    let start = system.state(0.0, start, &Vector6::new(0.3, -0.1, 0.5, 0.6, 0.1, 0.8));
    let methods: [&dyn Integrator<_>; 4] = [
        &Projected::RK4,
        &Projected::DORMAND_PRINCE,
        &MuntheKaas::RK4,
        &MuntheKaas::DORMAND_PRINCE,
    ];
    for (at, method) in methods.into_iter().enumerate() {
        let mut state = start.clone();
        for _ in 0..200 {
            method.step(&system, &mut state, 0.05).unwrap();
        }
        assert!((state.element.translation.vector - start.element.translation.vector).norm() > 0.1);
        assert_eq!(state.spatial.fixed_rows::<3>(3), start.spatial.fixed_rows::<3>(3), "{at}");
        let turning = (state.spatial - start.spatial).fixed_rows::<3>(0).norm();
        assert!(turning > 0.01, "{at}: {turning}");
    }
}
