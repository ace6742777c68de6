//! Adaptive steps: a step is accepted within the tolerance, whatever length was tried first.

use super::full;
use affinor::group::{Coordinates, Embedded, LieGroup, Se2, Se3, Sl2, So3, TranslationSplit};
use affinor::mechanics::integrators::runge_kutta::LocalCoordinates;
use affinor::mechanics::{Adaptive, EulerPoincare};
use affinor::{CanonicalConnection, Connection};
use nalgebra::Vector3;

/// After a step of length `h` with the error `e`, in units of the tolerance, the next one is `0.9 h e^(-1/order)`, between a fifth
/// and five times `h`. So it is at least `0.9 h` if the step was within the tolerance.
fn accepted_within_the_tolerance<G, C>(group: G, velocity: &[f64], method: &Adaptive<C>)
where
    G: Embedded + TranslationSplit + Clone,
    C: LocalCoordinates<G> + Copy,
{
    let n = group.dimension();
    let plus = Connection::canonical(&group.algebra().unwrap(), CanonicalConnection::Plus);
    let torque = |time: f64, _: &G::Element, _: &G::Vector| {
        G::Vector::from_components(
            &(0..n).map(|i| (3.0 * time + i as f64).sin()).collect::<Vec<_>>(),
        )
    };
    let system = EulerPoincare::new(group.clone(), &plus, &full(&group), torque).unwrap();
    let start = system.state(0.0, group.identity(), &G::Vector::from_components(velocity));
    let mut rejected = 0;
    for tried in (-40..=8).map(|power| 10.0_f64.powf(0.05 * f64::from(power))) {
        let (mut state, mut next) = (start.clone(), tried);
        method.step(&system, &mut state, &mut next, 1e3).unwrap();
        let taken = state.time;
        assert!(next >= 0.9 * taken, "{tried}: {next} after {taken}");
        rejected += usize::from(taken < tried);
    }
    // steps of both kinds occur
    assert!((5..45).contains(&rejected), "{rejected}");
}

#[test]
fn steps_are_accepted_within_the_tolerance() {
    for method in [Adaptive::new(1e-6), Adaptive::of_order_8(1e-9)] {
        accepted_within_the_tolerance(So3, &[0.5, -0.3, 0.6], &method);
        accepted_within_the_tolerance(Se2, &[1.2, 0.8, -0.6], &method);
        accepted_within_the_tolerance(Se3, &[0.5, -0.3, 0.6, 0.4, 0.2, -0.5], &method);
        accepted_within_the_tolerance(Sl2, &[0.5, -0.3, 0.6], &method);
        accepted_within_the_tolerance(So3, &[0.5, -0.3, 0.6], &method.projected());
    }
}

/// A run takes at most the allowed number of steps to each output time.
#[test]
fn a_run_takes_no_more_steps_than_allowed() {
    let plus = Connection::canonical(&So3.algebra().unwrap(), CanonicalConnection::Plus);
    let system = EulerPoincare::free(So3, &plus, &full(&So3)).unwrap();
    let start = system.state(0.0, So3.identity(), &Vector3::new(0.5, -0.3, 0.6));
    let method = Adaptive::new(1e-9);
    let (mut state, mut next, mut steps) = (start.clone(), method.first_step(), 0);
    while state.time != 2.0 {
        method.step(&system, &mut state, &mut next, 2.0).unwrap();
        steps += 1;
    }
    assert!(steps > 5, "{steps}");
    let run = |max_steps| Adaptive { max_steps, ..method }.states(&system, &start, &[2.0]);
    assert_eq!(run(steps).unwrap()[0].time, 2.0);
    assert!(run(steps - 1).unwrap_err().to_string().contains("too many steps"));
}

/// A step that reaches the output time ends at it to the last bit, although the sum of time and step is rounded. A step that is
/// a rounding error of the time is rejected.
#[test]
fn steps_end_at_output_times_and_exceed_rounding() {
    let plus = Connection::canonical(&So3.algebra().unwrap(), CanonicalConnection::Plus);
    let system = EulerPoincare::free(So3, &plus, &full(&So3)).unwrap();
    let method = Adaptive::new(1e-9);
    let step = |method: &Adaptive, from: f64, end: f64| {
        let mut state = system.state(from, So3.identity(), &(Vector3::new(0.5, -0.3, 0.6) * 1e-6));
        method.step(&system, &mut state, &mut 1e3, end).map(|()| state.time)
    };
    let mut rounded = 0;
    for (from, end) in (1..40).map(|k| (f64::from(k) / 7.0, 1.0 / f64::from(k))) {
        rounded += usize::from(from + (end - from) != end);
        assert_eq!(step(&method, from, end).unwrap(), end);
    }
    assert!(rounded > 5, "{rounded}");
    for from in [1.0, 1e9, -1e-9] {
        let of = |max_step: f64| step(&Adaptive { max_step, ..method }, from, 2.0 * from.abs());
        assert!(of(1e-13 * from.abs()).is_ok(), "{from}");
        let lost = of(4.0 * f64::EPSILON * from.abs()).unwrap_err().to_string();
        assert!(lost.contains("too small"), "{from}: {lost}");
    }
}
