//! A step on a group whose vectors have a fixed size allocates nothing.
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use affinor::dynamics::dense::Step;
use affinor::dynamics::euler_poincare::{Free, Torque};
use affinor::dynamics::events::{Direction, Event, Then, Watch};
use affinor::dynamics::integrators::kick::{FreeMotion, Order as KickOrder};
use affinor::dynamics::integrators::splitting::Composition;
use affinor::dynamics::moser_veselov::Order;
use affinor::dynamics::{
    Adaptive, BodyState, CommutatorFree, CrouchGrossman, EulerPoincare, FreeBody, Inertia,
    Integrator, Kick, Linear, Magnus, MoserVeselov, MuntheKaas, Place, Projected, SimoWong,
    Splitting, State, System,
};
use affinor::group::{Coordinates, LieGroup, Se2, Se3, Sl2, So3, Stored};
use affinor::{Canonical, Connection, Metric};
use affinor_tensors::{Down, Tensor};
use allocation_counter::measure;
use nalgebra::{UnitQuaternion, Vector3};

/// Steps one by one, counted.
fn assert_none<S: System>(name: &str, system: &S, method: &dyn Integrator<S>, start: &S::State) {
    let mut state = start.clone();
    let counted = measure(|| {
        for _ in 0..10 {
            method.step(system, &mut state, 0.01).unwrap();
        }
    });
    assert_eq!(counted.count_total, 0, "{name}");
    assert!(system.time(&state) > system.time(start));
}

fn body<G: LieGroup, M: Torque<G>>(group: G, which: Canonical, torque: M) -> EulerPoincare<G, M> {
    let algebra = group.algebra().unwrap();
    let entry = |[i, j]: [usize; 2]| if i == j { 1.0 + 0.5 * i as f64 } else { 0.05 };
    let metric = Tensor::from_fn(group.dimension(), [Down, Down], entry).unwrap();
    let metric = Metric::new(algebra.labels(), metric).unwrap();
    EulerPoincare::new(group, &Connection::canonical(&algebra, which), &metric, torque).unwrap()
}

fn any_group<G: Stored + Clone>(name: &str, group: G) {
    let n = group.dimension();
    let torque = move |time: f64, _: &G::Element, omega: &G::Vector| {
        omega.clone() * -0.1 + G::Vector::from_fn(n, |i| (time + i as f64).sin())
    };
    for which in [Canonical::Plus, Canonical::Zero] {
        let system = body(group.clone(), which, torque);
        let velocity = G::Vector::from_fn(n, |i| 0.3 - 0.1 * i as f64);
        let start = system.state(0.0, group.exp(&velocity), &velocity);
        let methods: [&dyn Integrator<EulerPoincare<G, _>>; 6] = [
            &MuntheKaas::RK4,
            &MuntheKaas::DORMAND_PRINCE,
            &Projected::RK4,
            &Projected::DORMAND_PRINCE_8,
            &CommutatorFree,
            &CrouchGrossman,
        ];
        for method in methods {
            assert_none(name, &system, method, &start);
        }
        let (mut state, mut next) = (start, 0.01);
        let counted = measure(|| {
            for _ in 0..10 {
                Adaptive::new(1e-9).step(&system, &mut state, &mut next, 10.0).unwrap();
            }
        });
        assert_eq!(counted.count_total, 0, "{name}");
    }
    let velocity = move |time: f64| G::Vector::from_fn(n, |i| (time + i as f64).sin());
    let start = Place { time: 0.0, element: group.identity() };
    let system = Linear { group, velocity };
    assert_none(name, &system, &Magnus::Four, &start);
    assert_none(name, &system, &Magnus::Six, &start);
}

#[test]
fn steps_on_groups() {
    any_group("SO(3)", So3);
    any_group("SE(3)", Se3);
    any_group("SE(2)", Se2);
    any_group("SL(2)", Sl2);
}

#[test]
fn steps_of_a_body() {
    let system = body(So3, Canonical::Plus, Free);
    let start = system.state(0.0, So3.identity(), &Vector3::new(1.0, 0.4, -0.9));
    let entry = |i, j| if i == j { 1.0 + 0.5 * i as f64 } else { 0.05 };
    let inertia = Inertia::new(&nalgebra::Matrix3::from_fn(entry)).unwrap();
    let weight = |_: f64, g: &UnitQuaternion<f64>, _: &Vector3<f64>| {
        g.inverse_transform_vector(&Vector3::y())
    };
    let heavy = body(So3, Canonical::Plus, weight);
    let ten = FreeMotion::MoserVeselov(Order::Ten);
    assert_none("DMV", &system, &MoserVeselov::new(&inertia, Order::Ten), &start);
    assert_none("Suzuki", &system, &Splitting::new(&inertia, Composition::Suzuki), &start);
    assert_none("Simo-Wong", &heavy, &SimoWong::new(&inertia), &start);
    assert_none("kicks", &heavy, &Kick::new(&inertia, KickOrder::Four, ten), &start);
    let exact = Kick::new(&inertia, KickOrder::Two, FreeMotion::Exact);
    assert_none("kicks, exact", &heavy, &exact, &start);

    let method = MoserVeselov::new(&inertia, Order::Six);
    let at = BodyState { attitude: start.element, momentum: start.spatial };
    assert_eq!(measure(|| assert!(method.steps(&at, 0.01, 100).is_ok())).count_total, 0);
    let motion = FreeBody::new(&inertia, &at).unwrap();
    assert_eq!(measure(|| assert!(motion.at(10.0).momentum.norm() > 0.0)).count_total, 0);

    // events that do not happen: only the list of values
    let never = Event::new(|_: &State<So3>| 1.0, Direction::Both, Then::GoOn);
    let mut watch = Watch::new(vec![never], &system, &start).unwrap();
    let mut state = start.clone();
    let step = Step { system: &system, method: &method, start, length: 0.01 };
    let counted = measure(|| drop(watch.advance(&step, &mut state).unwrap()));
    assert_eq!(counted.count_total, 1);
}

/// The counter counts.
#[test]
fn lists_are_seen() {
    assert_eq!(measure(|| drop(vec![1.0, 2.0])).count_total, 1);
}
