//! Compensated sums: the rounding errors of many steps do not add up.

use affinor::group::{LieGroup, So3};
use affinor::mechanics::integrators::moser_veselov::MoserVeselovOrder;
use affinor::mechanics::{BodyState, Inertia, MoserVeselov};
use nalgebra::Vector3;

/// The steps conserve the energy and the momentum in space. After a hundred thousand short steps each is off by a few rounding
/// errors; sums without compensation are off by hundreds.
#[test]
fn invariants_of_many_steps_are_off_by_a_few_rounding_errors() {
    let inertia = Inertia::diagonal(&Vector3::new(0.6, 0.8, 1.0)).unwrap();
    let start = BodyState { attitude: So3.identity(), momentum: Vector3::new(1.8, 0.4, -0.9) };
    for order in [MoserVeselovOrder::Two, MoserVeselovOrder::Ten] {
        let end = MoserVeselov::new(&inertia, order).steps(&start, 1e-3, 100_000).unwrap();
        let energy = inertia.energy(&end.momentum) / inertia.energy(&start.momentum) - 1.0;
        let space = (end.space_momentum() - start.momentum).norm() / start.momentum.norm();
        assert!(energy.abs() <= 16.0 * f64::EPSILON, "{order:?}: {energy:e}");
        assert!(space <= 16.0 * f64::EPSILON, "{order:?}: {space:e}");
    }
}
