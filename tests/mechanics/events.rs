//! Events: each is found once, at its time, and the state within a step is as accurate as at its
//! end.

use crate::common::property::properties;
use affinor::group::{LieGroup, So3};
use affinor::mechanics::events::{AfterEvent, Direction, Event, EventDetector};
use affinor::mechanics::integrators::dense_output::DenseStep;
use affinor::mechanics::integrators::moser_veselov::MoserVeselovOrder;
use affinor::mechanics::systems::euler_poincare::Free;
use affinor::mechanics::{
    Adaptive, BodyState, EulerPoincare, FreeBody, Inertia, Integrator, MoserVeselov, MuntheKaas,
    SimoWong, State, System,
};
use affinor::{CanonicalConnection, Connection, Error, Metric};
use affinor_tensors::{Down, Tensor};
use nalgebra::Vector3;
use proptest::prelude::*;
use std::cell::Cell;

/// A system in which only time changes.
struct Clock;

impl System for Clock {
    type State = f64;

    fn time(&self, state: &f64) -> f64 {
        *state
    }
}

/// Time as its state, in units of a power of 2.
struct Tick;

impl Integrator<Clock> for Tick {
    fn step(&self, _: &Clock, state: &mut f64, h: f64) -> Result<(), Error> {
        *state += h;
        Ok(())
    }
}

/// The events of a clock: their numbers and times.
fn events(
    watched: Vec<Event<f64>>,
    start: f64,
    length: f64,
    count: usize,
) -> (Vec<(usize, f64)>, f64) {
    let mut state = start;
    let mut watch = EventDetector::new(watched, &Clock, &state).unwrap();
    let mut found = vec![];
    for _ in 0..count {
        let step = DenseStep { system: &Clock, method: &Tick, start: state, length };
        let crossings = watch.advance(&step, &mut state).unwrap();
        found.extend(crossings.iter().map(|crossing| (crossing.event, crossing.state)));
        if crossings.iter().any(|crossing| crossing.then == AfterEvent::Stop) {
            break;
        }
    }
    (found, state)
}

fn at<'a>(f: impl Fn(f64) -> f64 + 'a, direction: Direction, then: AfterEvent) -> Event<'a, f64> {
    Event::new(move |t: &f64| f(*t), direction, then)
}

#[test]
fn a_zero_at_the_end_of_a_step_counts_once() {
    let zero = |direction| vec![at(|t| t - 1.0, direction, AfterEvent::GoOn)];
    assert_eq!(events(zero(Direction::Both), 0.0, 0.25, 20).0, [(0, 1.0)]);
    assert_eq!(events(zero(Direction::Rising), 0.0, 0.25, 20).0, [(0, 1.0)]);
    assert_eq!(events(zero(Direction::Falling), 0.0, 0.25, 20).0, []);
    // backwards in time, the function still rises with time
    assert_eq!(events(zero(Direction::Rising), 3.0, -0.25, 20).0, [(0, 1.0)]);
    // a run that starts there, forwards or backwards, has not crossed it
    assert_eq!(events(zero(Direction::Both), 1.0, 0.25, 20).0, []);
    assert_eq!(events(zero(Direction::Both), 1.0, -0.25, 20).0, []);
    // also in the last step
    assert_eq!(events(zero(Direction::Both), 0.0, 0.25, 4).0, [(0, 1.0)]);
}

#[test]
fn directions_and_ends() {
    use std::f64::consts::PI;
    let sine = |direction, then| at(|t: f64| t.sin(), direction, then);
    let (found, _) = events(vec![sine(Direction::Both, AfterEvent::GoOn)], 0.5, 0.1, 200);
    let times: Vec<f64> = (1..=6).map(|k| f64::from(k) * PI).collect();
    assert_eq!(found.len(), times.len());
    for ((_, found), time) in found.iter().zip(&times) {
        assert!((found - time).abs() <= 4e-16 * time, "{found} {time}");
    }
    let (rising, _) = events(vec![sine(Direction::Rising, AfterEvent::GoOn)], 0.5, 0.1, 200);
    assert_eq!(rising.len(), 3);
    // the first event that stops ends the run; later events of the step remain for a run that
    // continues
    let watched = || {
        vec![
            at(|t: f64| t - 1.03, Direction::Both, AfterEvent::GoOn),
            at(|t: f64| t - 1.02, Direction::Both, AfterEvent::Stop),
            at(|t: f64| 1.01 - t, Direction::Both, AfterEvent::GoOn),
            at(|t: f64| t - 1.02, Direction::Both, AfterEvent::GoOn),
        ]
    };
    let (found, end) = events(watched(), 0.0, 0.25, 20);
    let numbers: Vec<usize> = found.iter().map(|(number, _)| *number).collect();
    assert_eq!((numbers, end), (vec![2, 1], 1.02));
    let mut state = 0.75;
    let mut watch = EventDetector::new(watched(), &Clock, &state).unwrap();
    let mut numbers = vec![];
    for _ in 0..2 {
        let step = DenseStep { system: &Clock, method: &Tick, start: state, length: 0.25 };
        watch.advance(&step, &mut state).unwrap();
    }
    assert_eq!(state, 1.02);
    for _ in 0..2 {
        let step = DenseStep { system: &Clock, method: &Tick, start: state, length: 0.25 };
        numbers.extend(watch.advance(&step, &mut state).unwrap().iter().map(|c| c.event));
    }
    // a zero at the time at which the run stopped has been passed
    assert_eq!(numbers, [0]);
}

/// The events of a step come in the order of the motion: backwards from the late ones to the early ones.
#[test]
fn events_of_a_step_are_sorted() {
    let watched =
        || [1.25, 1.75, 1.5].map(|place| at(move |t| t - place, Direction::Both, AfterEvent::GoOn));
    let forward = events(watched().into(), 1.0, 1.0, 1).0;
    assert_eq!(forward, [(0, 1.25), (2, 1.5), (1, 1.75)]);
    let backward = events(watched().into(), 2.0, -1.0, 1).0;
    assert_eq!(backward, [(1, 1.75), (2, 1.5), (0, 1.25)]);
}

/// An event takes at most two evaluations more than bisection of the step to the rounding of time, however flat or steep the
/// function is.
#[test]
fn events_take_no_more_evaluations_than_bisection() {
    type Function = fn(f64) -> f64;
    let functions: [(&str, Function); 5] = [
        ("flat", |x| x.powi(9)),
        ("steep", |x| x.cbrt()),
        ("one-sided", |x| (40.0 * x).exp_m1()),
        ("the other side", |x| -(-40.0 * x).exp_m1()),
        ("a jump", |x| if x < 0.0 { -1.0 } else { 1e6 }),
    ];
    for (what, function) in functions {
        for place in [0.3, 1.0 / 3.0, 0.7, 0.93] {
            let count = Cell::new(0);
            let counted = |t: f64| {
                count.set(count.get() + 1);
                function(t - place)
            };
            let event = at(counted, Direction::Both, AfterEvent::GoOn);
            assert_eq!(events(vec![event], 0.0, 1.0, 1).0.len(), 1, "{what} {place}");
            // at both ends of the step, and 52 bisections
            assert!(count.get() <= 2 + 52 + 2, "{what} {place}: {}", count.get());
        }
    }
}

/// A sign changes without a zero at a pole, and where an angle begins again; a jump between values that stay is an event.
#[test]
fn poles_are_no_zeros() {
    let pole = |p: f64| move |t: f64| 1.0 / (t - p);
    for p in [0.25, 0.3, 1.0, 1.0 / 3.0, 1.999_999_9, 2.000_000_1] {
        let found = events(vec![at(pole(p), Direction::Both, AfterEvent::Stop)], 0.0, 1.0, 4);
        assert_eq!(found, (vec![], 4.0), "{p}");
        let cubic = move |t: f64| (t - p).powi(-3);
        assert!(
            events(vec![at(cubic, Direction::Both, AfterEvent::GoOn)], 0.0, 1.0, 4).0.is_empty()
        );
        let root = move |t: f64| (t - p).cbrt();
        assert_eq!(
            events(vec![at(root, Direction::Both, AfterEvent::GoOn)], 0.0, 1.0, 4).0.len(),
            1
        );
        let jump = move |t: f64| (t - p).signum();
        assert_eq!(
            events(vec![at(jump, Direction::Both, AfterEvent::GoOn)], 0.0, 1.0, 4).0.len(),
            1
        );
    }
    // zeros at multiples of pi, with poles between them
    let found = events(vec![at(f64::tan, Direction::Both, AfterEvent::GoOn)], 0.5, 0.25, 80).0;
    let zeros: Vec<f64> = found.iter().map(|(_, t)| t / std::f64::consts::PI).collect();
    assert_eq!(zeros.len(), 6, "{zeros:?}");
    assert!(zeros.iter().enumerate().all(|(k, z)| (z - (k + 1) as f64).abs() < 1e-14));
    let wrapped = |t: f64| t.sin().atan2(t.cos()) - 1.0;
    let found = events(vec![at(wrapped, Direction::Both, AfterEvent::GoOn)], 0.0, 0.25, 80).0;
    let turns: Vec<f64> = found.iter().map(|(_, t)| (t - 1.0) / std::f64::consts::TAU).collect();
    assert_eq!(turns.len(), 4, "{turns:?}");
    assert!(turns.iter().enumerate().all(|(k, turn)| (turn - k as f64).abs() < 1e-14));
}

/// The event is where the function becomes zero, whatever the steps; where it stops being zero
/// there is no event.
#[test]
fn functions_that_stay_zero() {
    let start = std::f64::consts::FRAC_PI_3;
    for length in [0.1_f64, 0.25, 0.3, 1.0, -0.125] {
        let origin = if length > 0.0 { 0.0 } else { 2.5 };
        let direction = length.signum();
        let falls = move |t: f64| (direction * (start - t)).max(0.0);
        let rises = move |t: f64| -(direction * (start - t)).max(0.0).sqrt();
        let stairs = move |t: f64| (2.0 * direction * (start - t)).ceil().clamp(0.0, 1.0);
        for f in [&falls as &dyn Fn(f64) -> f64, &rises, &stairs] {
            let event = at(f, Direction::Both, AfterEvent::GoOn);
            let found = events(vec![event], origin, length, 40).0;
            let [(0, time)] = found[..] else { panic!("{found:?}") };
            assert!((time - start).abs() <= 4e-16 && f(time) == 0.0, "{length}: {time}");
        }
    }
    let leaves = at(|t| (t - 1.0).max(0.0), Direction::Both, AfterEvent::GoOn);
    assert_eq!(events(vec![leaves], 0.0, 0.3, 10).0, []);
}

#[test]
fn what_is_no_number_is_refused() {
    let event = || vec![at(|t: f64| (1.0 - t).sqrt(), Direction::Both, AfterEvent::GoOn)];
    assert!(matches!(
        EventDetector::new(event(), &Clock, &2.0),
        Err(Error::Integration { t: 2.0, .. })
    ));
    let mut state = 0.9;
    let mut watch = EventDetector::new(event(), &Clock, &state).unwrap();
    let step = DenseStep { system: &Clock, method: &Tick, start: state, length: 0.25 };
    assert!(matches!(watch.advance(&step, &mut state), Err(Error::Integration { .. })));
    assert_eq!(state, 0.9);
}

properties! {
    #![cases(256)]

    /// Steep, flat and one-sided functions: each sign change is found once, to the rounding error
    /// of time.
    #[test]
    fn times_are_exact(place in 0.01..9.99_f64, power in 0_i32..4, scale in -12..12_i32, lean in -3.0..3.0_f64) {
        let function = |t: f64| {
            let x = t - place;
            x.powi(2 * power + 1) * 10.0_f64.powi(scale) * (lean * x).exp()
        };
        for length in [0.1, 0.37, 10.0] {
            let watched = vec![at(function, Direction::Rising, AfterEvent::GoOn)];
            let (found, _) = events(watched, 0.0, length, (10.0 / length).ceil() as usize);
            prop_assert_eq!(found.len(), 1);
            prop_assert!((found[0].1 - place).abs() < 4e-15, "{} {}", found[0].1, place);
        }
    }
}

fn body() -> (Inertia, EulerPoincare<So3, Free>, State<So3>) {
    let moments = Vector3::new(0.6, 0.8, 1.0);
    let metric = Tensor::from_components(3, &[Down, Down], (0..3).map(|i| ([i, i], moments[i])));
    let metric = Metric::new(So3.algebra().unwrap().labels(), metric.unwrap()).unwrap();
    let plus = Connection::canonical(&So3.algebra().unwrap(), CanonicalConnection::Plus);
    let system = EulerPoincare::free(So3, &plus, &metric).unwrap();
    let velocity = Vector3::new(1.8, 0.4, -0.9).component_div(&moments);
    let start = system.state(0.0, So3.identity(), &velocity);
    (Inertia::diagonal(&moments).unwrap(), system, start)
}

/// The momentum crosses a plane once per period, which is known by elliptic functions.
#[test]
fn a_section_is_crossed_once_a_period() {
    let (inertia, system, start) = body();
    let exact = BodyState { attitude: start.element, momentum: start.spatial };
    let exact = FreeBody::new(&inertia, &exact).unwrap();
    let period = exact.period().unwrap();
    let section =
        || Event::new(|s: &State<So3>| system.momentum(s).y, Direction::Rising, AfterEvent::GoOn);
    let check = |states: &[State<So3>], tolerance: f64| {
        assert_eq!(states.len(), 10);
        for (k, state) in states.iter().enumerate() {
            let time = states[0].time + k as f64 * period;
            assert!((state.time / time - 1.0).abs() < tolerance, "{k}: {} {time}", state.time);
            assert!(exact.at(state.time).momentum.y.abs() < 10.0 * tolerance);
        }
    };
    let method = MoserVeselov::new(&inertia, MoserVeselovOrder::Ten);
    let (mut state, mut found) = (start.clone(), vec![]);
    let mut watch = EventDetector::new(vec![section()], &system, &state).unwrap();
    while state.time < 10.0 * period {
        let step =
            DenseStep { system: &system, method: &method, start: state.clone(), length: 0.05 };
        found.extend(watch.advance(&step, &mut state).unwrap().into_iter().map(|c| c.state));
    }
    check(&found, 1e-12);
    let first = found[0].time;
    let run = |end: f64, events| Adaptive::new(1e-13).run(&system, &start, end, events).unwrap();
    let trajectory = run(10.0 * period, vec![section()]);
    let found = trajectory.events().iter().map(|crossing| crossing.state.clone());
    check(&found.collect::<Vec<_>>(), 1e-11);
    // between steps the momentum is as accurate as at their ends, in both directions of time
    for (trajectory, period) in [(trajectory, period), (run(-10.0 * period, vec![]), -period)] {
        for k in 0..=100 {
            let state = trajectory.at(0.1 * f64::from(k) * period).unwrap();
            let reference = exact.at(state.time);
            let off = (system.momentum(&state) - reference.momentum).norm();
            let off = off.max(state.element.angle_to(&reference.attitude));
            assert!(off < 1e-9, "{}: {off:e}", state.time);
        }
        assert_eq!(trajectory.at(0.0).unwrap().spatial, start.spatial);
        assert_eq!(trajectory.at(trajectory.end().time).unwrap().time, trajectory.end().time);
        for outside in [10.1 * period, -0.1 * period, f64::NAN] {
            assert!(matches!(trajectory.at(outside), Err(Error::Integration { .. })));
        }
    }
    let stop =
        Event::new(|s: &State<So3>| system.momentum(s).y, Direction::Rising, AfterEvent::Stop);
    let stopped = run(10.0 * period, vec![stop]);
    assert_eq!(stopped.end().time, stopped.events()[0].state.time);
    assert!((stopped.end().time - first).abs() < 1e-10);
}

/// States within steps have the order of the method.
#[test]
fn states_within_a_step_have_its_order() {
    let (inertia, system, start) = body();
    let exact = BodyState { attitude: start.element, momentum: start.spatial };
    let exact = FreeBody::new(&inertia, &exact).unwrap();
    fn error<I: Integrator<EulerPoincare<So3, Free>>>(
        (method, steps): (&I, usize),
        (system, start): (&EulerPoincare<So3, Free>, &State<So3>),
        exact: &FreeBody,
    ) -> f64 {
        let length = 1.0 / steps as f64;
        let (mut state, mut largest) = (start.clone(), 0.0_f64);
        for _ in 0..steps {
            let step = DenseStep { system, method, start: state.clone(), length };
            let within = step.at(state.time + 0.37 * length).unwrap();
            let off = system.momentum(&within) - exact.at(within.time).momentum;
            largest = largest.max(off.norm());
            state = step.after(length).unwrap();
        }
        largest
    }
    let wong = SimoWong::new(&inertia);
    let ratio = |n| {
        let of = (&system, &start);
        error((&wong, n), of, &exact) / error((&wong, 2 * n), of, &exact)
    };
    assert!((ratio(64).log2() - 2.0).abs() < 0.1);
    let ratio = |n| {
        let (of, method) = ((&system, &start), &MuntheKaas::RK4);
        error((method, n), of, &exact) / error((method, 2 * n), of, &exact)
    };
    assert!((ratio(64).log2() - 4.0).abs() < 0.1);
}
