//! A step on a group whose vectors have a fixed size does not allocate.
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use affinor::group::{
    AnyGroup, Coordinates, Embedded, LieGroup, Se2, Se3, Sl2, So3, TranslationSplit,
};
use affinor::mechanics::events::{AfterEvent, Direction, Event, EventDetector};
use affinor::mechanics::integrators::dense_output::DenseStep;
use affinor::mechanics::integrators::kick::{FreeMotion, KickOrder};
use affinor::mechanics::integrators::moser_veselov::MoserVeselovOrder;
use affinor::mechanics::simulation::quantities::SymbolTable;
use affinor::mechanics::simulation::{
    ColumnFormulas, Crossings, EulerPoincareSpec, ForceFrame, ForceTable, Forces, Hamiltonian,
    Integration, LiePoissonSpec, Method, Motion, Observables, PrescribedVelocitySpec,
    SimulationGroup, VelocityFormulas,
};
use affinor::mechanics::systems::euler_poincare::{Free, Torque};
use affinor::mechanics::{
    Adaptive, BodyState, CommutatorFree, EulerPoincare, FreeBody, Inertia, Integrator, Kick,
    KinematicState, Magnus, MassProperties, MoserVeselov, MuntheKaas, PrescribedVelocity,
    Projected, SimoWong, State, System,
};
use affinor::mechanism::{Joint, Mechanism, MovingTree, Tree};
use affinor::{CanonicalConnection, Connection, Metric};
use affinor_tensors::{Down, Tensor};
use allocation_counter::measure;
use nalgebra::{DVector, Isometry3, UnitQuaternion, Vector3, dvector};

/// Counts allocations in single steps, and expects none.
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

fn inertia([i, j]: [usize; 2]) -> f64 {
    if i == j { 1.0 + 0.5 * i as f64 } else { 0.05 }
}

fn body<G: TranslationSplit, M: Torque<G>>(
    group: G,
    which: CanonicalConnection,
    torque: M,
) -> EulerPoincare<G, M> {
    let algebra = group.algebra().unwrap();
    let metric = Tensor::from_fn(group.dimension(), [Down, Down], inertia).unwrap();
    let metric = Metric::new(algebra.labels(), metric).unwrap();
    EulerPoincare::new(group, &Connection::canonical(&algebra, which), &metric, torque).unwrap()
}

fn any_group<G: Embedded + TranslationSplit + Clone>(name: &str, group: G) {
    let n = group.dimension();
    let torque = move |time: f64, _: &G::Element, omega: &G::Vector| {
        omega.clone() * -0.1 + G::Vector::from_fn(n, |i| (time + i as f64).sin())
    };
    for which in [CanonicalConnection::Plus, CanonicalConnection::Zero] {
        let system = body(group.clone(), which, torque);
        let velocity = G::Vector::from_fn(n, |i| 0.3 - 0.1 * i as f64);
        let start = system.state(0.0, group.exp(&velocity), &velocity);
        let methods: [&dyn Integrator<EulerPoincare<G, _>>; 5] = [
            &MuntheKaas::RK4,
            &MuntheKaas::DORMAND_PRINCE,
            &Projected::RK4,
            &Projected::DORMAND_PRINCE_8,
            &CommutatorFree,
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
    let start = KinematicState { time: 0.0, element: group.identity() };
    let system = PrescribedVelocity { group, velocity };
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
    let system = body(So3, CanonicalConnection::Plus, Free);
    let start = system.state(0.0, So3.identity(), &Vector3::new(1.0, 0.4, -0.9));
    let inertia = Inertia::new(&nalgebra::Matrix3::from_fn(|i, j| inertia([i, j]))).unwrap();
    let weight = |_: f64, g: &UnitQuaternion<f64>, _: &Vector3<f64>| {
        g.inverse_transform_vector(&Vector3::y())
    };
    let heavy = body(So3, CanonicalConnection::Plus, weight);
    let ten = FreeMotion::MoserVeselov(MoserVeselovOrder::Ten);
    assert_none("DMV", &system, &MoserVeselov::new(&inertia, MoserVeselovOrder::Ten), &start);
    assert_none("Simo-Wong", &heavy, &SimoWong::new(&inertia), &start);
    assert_none("kicks", &heavy, &Kick::new(&inertia, KickOrder::Four, ten), &start);
    let exact = Kick::new(&inertia, KickOrder::Two, FreeMotion::Exact);
    assert_none("kicks, exact", &heavy, &exact, &start);

    let method = MoserVeselov::new(&inertia, MoserVeselovOrder::Six);
    let at = BodyState { attitude: start.element, momentum: start.spatial };
    assert_eq!(measure(|| assert!(method.steps(&at, 0.01, 100).is_ok())).count_total, 0);
    let motion = FreeBody::new(&inertia, &at).unwrap();
    assert_eq!(measure(|| assert!(motion.at(10.0).momentum.norm() > 0.0)).count_total, 0);

    // an event that does not occur
    let never = Event::new(|_: &State<So3>| 1.0, Direction::Both, AfterEvent::GoOn);
    let mut watch = EventDetector::new(vec![never], &system, &start).unwrap();
    let mut state = start.clone();
    let step = DenseStep { system: &system, method: &method, start, length: 0.01 };
    let counted = measure(|| drop(watch.advance(&step, &mut state).unwrap()));
    assert_eq!(counted.count_total, 0);
}

/// The number of allocations in ten steps of a motion, after the first three, with checks for sign
/// changes of all columns.
fn allocations(motion: &mut dyn Motion) -> u64 {
    let mut crossings = Crossings::new(motion, 0..motion.column_count());
    let mut steps = |count| {
        for _ in 0..count {
            assert!(crossings.step(motion, 1000.0).unwrap().1.is_empty());
        }
    };
    steps(3);
    measure(|| steps(10)).count_total
}

/// Quantities of all kinds that stay positive.
fn columns(names: &SymbolTable, formulas: &[&str]) -> ColumnFormulas {
    let mut columns = ColumnFormulas::default();
    for text in formulas {
        columns.formulas.push(columns.scope.read(text, names, &|_| true).unwrap());
    }
    columns
}

const QUANTITIES: [&str; 5] = [
    "Omega1 + omega2 + 100",
    "H1 + h2 + 100",
    "energy + kinetic*potential + power + 1000",
    "t^2 + sin(g11) + 2",
    "1",
];

fn list(x: &impl Coordinates) -> DVector<f64> {
    DVector::from_column_slice(x.components())
}

fn how(method: Method) -> Integration {
    Integration { method: Some(method), step: Some(0.01), control: Adaptive::new(1e-9) }
}

fn forced<G: SimulationGroup>(
    group: &G,
    method: Method,
    formulas: &[&str],
    load: impl Fn(&mut Forces),
) -> Box<dyn Motion> {
    let system = body(group.clone(), CanonicalConnection::Plus, Free);
    let n = group.dimension();
    let matrix = nalgebra::DMatrix::from_fn(n, n, |i, j| inertia([i, j]));
    let mut forces = Forces::none(group, matrix, vec![("a".into(), 0.5)]);
    load(&mut forces);
    let algebra = group.algebra().unwrap();
    let metric = Tensor::from_fn(n, [Down, Down], inertia).unwrap();
    let momentum = G::Vector::from_fn(n, |i| 0.3 - 0.1 * i as f64);
    let spec = EulerPoincareSpec {
        connection: &Connection::canonical(&algebra, CanonicalConnection::Plus),
        metric: &Metric::new(algebra.labels(), metric).unwrap(),
        columns: columns(forces.names(), formulas),
        forces,
        time: 0.0,
        element: list(&group.coordinates(&system.group().exp(&momentum))),
        momentum: list(&momentum),
        integration: how(method),
    };
    spec.start(&AnyGroup::new(group.clone())).unwrap().motion
}

/// Methods for all groups, with events, forces and potentials as formulas.
#[test]
fn steps_of_motions() {
    fn any_group<G: SimulationGroup>(name: &str, group: G, methods: &[Method]) {
        for &method in methods {
            let none: &dyn Fn(&mut Forces) = &|_| ();
            let force: &dyn Fn(&mut Forces) = &|forces| {
                forces.add(ForceFrame::Body, 0, "-a*Omega1 + 0.1*sin(t)").unwrap();
                forces.add(ForceFrame::Spatial, 1, "0.1*g12*omega1").unwrap();
                let rows = (0..3).map(|i| {
                    let row = (0..=group.dimension()).map(|k| (i * 1000 + k) as f64);
                    row.collect()
                });
                forces.set_table(ForceFrame::Body, ForceTable::new(rows.collect()).unwrap());
            };
            let potential: &dyn Fn(&mut Forces) =
                &|forces| forces.set_potential("a*g11^2 + g21*cos(g12)").unwrap();
            for load in [none, force, potential] {
                let mut motion = forced(&group, method, &QUANTITIES, load);
                assert_eq!(allocations(motion.as_mut()), 0, "{name}, {method}");
            }
        }
    }
    let fixed = [Method::MuntheKaas4, Method::CommutatorFree4];
    let controlled = [Method::MuntheKaas54, Method::Projected853];
    any_group("SO(3)", So3, &[&fixed[..], &controlled, &[Method::SimoWong]].concat());
    any_group("SE(2)", Se2, &[&fixed[..], &controlled].concat());
    any_group("SL(2)", Sl2, &[&fixed[..], &controlled].concat());
    any_group("SE(3)", Se3, &[&fixed[..], &[Method::Projected4]].concat());
}

/// Methods for bodies, free and in a potential; motions of a Hamiltonian, and with a prescribed
/// velocity.
#[test]
fn steps_of_other_motions() {
    for method in [Method::Exact, Method::MoserVeselov10] {
        let mut motion = forced(&So3, method, &QUANTITIES, |_| ());
        assert_eq!(allocations(motion.as_mut()), 0, "{method}");
    }
    let top = |forces: &mut Forces| forces.set_potential("a*g33").unwrap();
    let mut motion = forced(&So3, Method::Kick4, &QUANTITIES, top);
    assert_eq!(allocations(motion.as_mut()), 0);

    let so3 = AnyGroup::new(So3);
    let observables = || Observables::new(&So3, None, vec![("a".into(), 0.5)]);
    let (names, element) = (observables().names().clone(), list(&So3.coordinates(&So3.identity())));
    let spec = LiePoissonSpec {
        observables: observables(),
        hamiltonian: Hamiltonian::read("H1^2/2 + a*H2^2 + sin(H3)", &observables()).unwrap(),
        time: 0.0,
        element: element.clone(),
        momentum: dvector![1.0, 0.4, -0.9],
        integration: how(Method::MuntheKaas4),
        columns: columns(&names, &["energy + h1 + 100"]),
    };
    assert_eq!(allocations(spec.start(&so3).unwrap().motion.as_mut()), 0);

    let mut velocity = VelocityFormulas::default();
    ["sin(t)", "a", "t"].into_iter().for_each(|text| velocity.add(text, &names).unwrap());
    let spec = PrescribedVelocitySpec {
        velocity,
        observables: observables(),
        time: 0.0,
        element,
        method: Method::Magnus6,
        step: 0.01,
        columns: columns(&names, &["omega1 + g11 + 2000"]),
    };
    assert_eq!(allocations(spec.start(&so3).unwrap().as_mut()), 0);
}

/// The counter counts allocations of lists.
#[test]
fn lists_are_seen() {
    assert_eq!(measure(|| drop(vec![1.0, 2.0])).count_total, 1);
}

/// The recursions of a tree of bodies allocate nothing once their buffers exist.
#[test]
fn recursions_of_trees() {
    let mut joints = vec![Joint::free(&[0.0; 3]).unwrap().between("base", [0, 1])];
    let mut bodies = vec![None, Some(MassProperties::ball(0.5).unwrap())];
    for k in 1..5 {
        let at = k as f64;
        let hinge = Joint::revolute(&[at, 0.0, 0.0], &[0.0, 1.0, at]).unwrap();
        joints.push(hinge.between(format!("J{k}"), [k, k + 1]));
        let centre = Isometry3::translation(at + 0.5, 0.0, 0.0);
        bodies.push(Some(MassProperties::ball(0.2).unwrap().moved(&centre)));
    }
    let names = (0..6).map(|k| format!("B{k}")).collect();
    let mechanism = Mechanism::new(names, &[0], joints).unwrap();
    let tree = Tree::new(&mechanism, &bodies, &-Vector3::z()).unwrap();
    let (numbers, mut slopes) = (tree.home(), tree.home());
    let mut moving = MovingTree::new(tree.into());
    let (rates, mut forces, mut accelerations) = ([0.1; 10], [0.2; 10], [0.0; 10]);
    let counted = measure(|| {
        moving.place(&numbers, &rates);
        moving.tree().slopes(&numbers, &rates, &mut slopes);
        moving.forward(&forces, &mut accelerations).unwrap();
        moving.inverse(&accelerations, &mut forces);
    });
    assert_eq!(counted.count_total, 0);
    assert!(forces.iter().all(|force| (force - 0.2).abs() < 1e-12));
}
