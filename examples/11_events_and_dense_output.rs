//! When does an event occur, and where is the body between two steps?
//!
//! `Adaptive::run` returns a trajectory. Its events are sign changes of functions, and its method
//! `at` returns the state at any time with the accuracy of the integration method.

use affinor::group::{LieGroup, So3};
use affinor::mechanics::events::{AfterEvent, Direction, Event};
use affinor::mechanics::{Adaptive, BodyState, EulerPoincare, FreeBody, Inertia, State};
use affinor::{CanonicalConnection, Connection, Metric};
use nalgebra::Vector3;

/// Finds the flips of a body that starts near its intermediate axis.
pub fn main() -> Result<(), Box<dyn std::error::Error>> {
    let moments = [1.0, 2.0, 3.0];
    let plus = Connection::canonical(&So3.algebra()?, CanonicalConnection::Plus);
    let body = EulerPoincare::free(So3, &plus, &Metric::diagonal(moments)?)?;
    let start = body.state(0.0, So3.identity(), &Vector3::new(0.0, 1.0, 0.01));

    // a flip is a sign change of the second velocity component; the flip back ends the run
    let omega = |state: &State<So3>| body.velocity(state).y;
    let events = vec![
        Event::new(omega, Direction::Falling, AfterEvent::GoOn),
        Event::new(omega, Direction::Rising, AfterEvent::Stop),
    ];
    let trajectory = Adaptive::of_order_8(1e-12).run(&body, &start, 100.0, events)?;
    let flips: Vec<f64> = trajectory.events().iter().map(|event| event.state.time).collect();
    println!("flips at {flips:.6?}");

    // the closed form in elliptic functions: the time between two flips is half a period
    let momentum = body.momentum(&start);
    let inertia = Inertia::diagonal(&Vector3::from(moments))?;
    let exact = FreeBody::new(&inertia, &BodyState { attitude: So3.identity(), momentum })?;
    let period = exact.period().ok_or("a body that tumbles has a period")?;
    assert!(flips.len() == 2 && (flips[1] - flips[0] - 0.5 * period).abs() < 1e-8);

    // dense output: a state within a step agrees with the closed form
    let time = 0.5 * flips[0];
    let (found, expected) = (trajectory.at(time)?, exact.at(time));
    let off = (body.momentum(&found) - expected.momentum).norm();
    println!("{} steps; at t = {time:.4} off by {off:.1e}", trajectory.states().len() - 1);
    assert!(off < 1e-9 && found.element.angle_to(&expected.attitude) < 1e-9);
    Ok(())
}
