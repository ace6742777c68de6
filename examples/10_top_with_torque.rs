//! How do I integrate a body with a user-defined torque?
//!
//! A torque is a closure: a function of the time, the attitude and the body velocity. It returns a
//! covector in body components.

use affinor::group::{LieGroup, So3};
use affinor::mechanics::{Adaptive, EulerPoincare, Integrator, MuntheKaas};
use affinor::{CanonicalConnection, Connection, Metric};
use nalgebra::{UnitQuaternion, Vector3};

/// Integrates a heavy top with and without air drag.
pub fn main() -> Result<(), Box<dyn std::error::Error>> {
    let so3 = So3.algebra()?;
    let plus = Connection::canonical(&so3, CanonicalConnection::Plus);
    let inertia = Metric::diagonal([2.0, 2.0, 1.0])?;
    let weight = 1.0; // the weight times the distance of the centre of mass from the tip

    // gravity acts at the centre of mass, which is on the third body axis; drag slows the spin
    let torque = |drag: f64| {
        move |_: f64, attitude: &UnitQuaternion<f64>, velocity: &Vector3<f64>| {
            let down = attitude.inverse_transform_vector(&-Vector3::z());
            Vector3::z().cross(&down) * weight - velocity * drag
        }
    };
    let start = (
        UnitQuaternion::from_scaled_axis(Vector3::new(0.3, 0.0, 0.0)),
        Vector3::new(0.0, 0.0, 5.0),
    );
    let height = |attitude: &UnitQuaternion<f64>| (attitude * Vector3::z()).z;

    // without drag, the energy, the spin and the vertical momentum are conserved
    let top = EulerPoincare::new(So3, &plus, &inertia, torque(0.0))?;
    let begin = top.state(0.0, start.0, &start.1);
    let end = Adaptive::of_order_8(1e-12).states(&top, &begin, &[10.0])?.remove(0);
    let energy = |state| top.energy(state) + weight * height(&state.element);
    let vertical = |state: &affinor::mechanics::State<So3>| state.spatial_momentum(&So3).z;
    println!("energy {:.12} -> {:.12}", energy(&begin), energy(&end));
    assert!((energy(&end) - energy(&begin)).abs() < 1e-10);
    assert!((vertical(&end) - vertical(&begin)).abs() < 1e-10);
    assert!((top.momentum(&end).z - 5.0).abs() < 1e-10);

    // with drag, this integrates with fixed steps
    let slowed = EulerPoincare::new(So3, &plus, &inertia, torque(0.05))?;
    let mut state = slowed.state(0.0, start.0, &start.1);
    for _ in 0..1000 {
        MuntheKaas::RK4.step(&slowed, &mut state, 0.01)?;
    }
    // the third axis is the symmetry axis, so the spin about it decays as exp(-drag t/J3)
    let spin = slowed.velocity(&state).z;
    println!("spin with drag: {spin:.6}, expected {:.6}", 5.0 * (-0.5_f64).exp());
    assert!((spin - 5.0 * (-0.5_f64).exp()).abs() < 1e-6);
    Ok(())
}
