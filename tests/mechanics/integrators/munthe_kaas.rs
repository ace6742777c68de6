//! Rates of canonical coordinates against the inverse of the tangent operator.

use affinor::group::{LieGroup, So3};
use affinor::mechanics::integrators::munthe_kaas::ExponentialCoordinates;
use affinor::mechanics::integrators::runge_kutta::LocalCoordinates;
use nalgebra::Vector3;

/// Methods beyond order 4 use the whole series. Others leave out the terms from `ad_u^4 v/720` on, which a step of the length of
/// `u` multiplies once more.
#[test]
fn rates_have_the_order_of_the_method() {
    let velocity = Vector3::new(0.3, -0.7, 0.5);
    for size in [0.05, 0.1, 0.4] {
        let u = Vector3::new(0.6, 0.0, 0.8) * size;
        let point = ExponentialCoordinates::point(&So3, &So3.identity(), &u);
        let exact = So3.tangent_left_inverse(&u, &velocity).unwrap();
        for order in 1..=8 {
            let rate = ExponentialCoordinates::rate(&So3, &point, &velocity, order).unwrap();
            let off = (rate - exact).norm();
            let bound = if order > 4 { 0.0 } else { velocity.norm() * size.powi(4) / 700.0 };
            assert!(off <= bound + 4.0 * f64::EPSILON, "{size} {order}: {off:e}");
        }
    }
}
