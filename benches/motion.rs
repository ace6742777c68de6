//! Steps of rigid bodies and on groups, and exact states.
//!
//! `cargo bench -p affinor-benches --bench motion`: nanoseconds per 1000 steps, or exact states.

use affinor::group::{AnyGroup, Coordinates, LieGroup, Se3, So3, TranslationSplit};
use affinor::mechanics::integrators::kick::{FreeMotion, KickOrder};
use affinor::mechanics::integrators::moser_veselov::MoserVeselovOrder;
use affinor::mechanics::simulation::{
    ColumnFormulas, Crossings, EulerPoincareSpec, Forces, Integration, Method, Motion,
};
use affinor::mechanics::systems::euler_poincare::{Free, Torque};
use affinor::mechanics::{
    Adaptive, BodyState, CommutatorFree, EulerPoincare, FreeBody, Inertia, Integrator, Kick,
    MoserVeselov, MuntheKaas, SimoWong,
};
use affinor::{CanonicalConnection, Connection, Metric};
use affinor_tensors::{Down, Tensor};
use criterion::measurement::WallTime;
use criterion::{BenchmarkGroup, Criterion, criterion_group, criterion_main};
use nalgebra::{DMatrix, UnitQuaternion, Vector3, dvector};
use std::hint::black_box;

const COUNT: usize = 1000;

fn free_body(criterion: &mut Criterion) {
    let inertia = Inertia::diagonal(&Vector3::new(0.6, 0.8, 1.0)).expect("an inertia");
    let attitude = UnitQuaternion::identity();
    let start = BodyState { attitude, momentum: Vector3::new(1.8, 0.4, -0.9) };
    let mut group = criterion.benchmark_group("free body");
    for (name, order) in [
        ("DMV2", MoserVeselovOrder::Two),
        ("DMV6", MoserVeselovOrder::Six),
        ("DMV10", MoserVeselovOrder::Ten),
    ] {
        let method = MoserVeselov::new(&inertia, order);
        group.bench_function(name, |b| b.iter(|| method.steps(black_box(&start), 0.05, COUNT)));
    }
    let method = MoserVeselov::new(&inertia, MoserVeselovOrder::Six);
    group.bench_function("DMV6, preprocessed each step", |b| {
        b.iter(|| (0..COUNT).try_fold(black_box(start), |state, _| method.step(&state, 0.05)));
    });
    let body = FreeBody::new(&inertia, &start).expect("a state");
    group.bench_function("exact", |b| {
        b.iter(|| {
            for i in 0..COUNT {
                black_box(body.at(black_box(0.05 * i as f64)));
            }
        });
    });
    group.bench_function("exact, prepared", |b| {
        b.iter(|| {
            for _ in 0..COUNT {
                black_box(FreeBody::new(&inertia, black_box(&start)).is_ok());
            }
        });
    });
    group.finish();
}

/// A body with the moments 0.6, 0.8, ...
fn system<G: TranslationSplit, M: Torque<G>>(group: G, torque: M) -> EulerPoincare<G, M> {
    let algebra = group.algebra().expect("an algebra");
    let moments = (0..group.dimension()).map(|i| ([i, i], 0.6 + 0.2 * i as f64));
    let metric = Tensor::from_components(group.dimension(), &[Down, Down], moments);
    let metric = Metric::new(algebra.labels(), metric.expect("a matrix")).expect("a metric");
    let plus = Connection::canonical(&algebra, CanonicalConnection::Plus);
    EulerPoincare::new(group, &plus, &metric, torque).expect("a system")
}

fn steps<G: TranslationSplit, M: Torque<G>>(
    benches: &mut BenchmarkGroup<WallTime>,
    name: &str,
    system: &EulerPoincare<G, M>,
    method: &impl Integrator<EulerPoincare<G, M>>,
) {
    let n = system.group().dimension();
    let velocity = G::Vector::from_fn(n, |i| [1.8, 0.4, -0.9][i % 3]);
    let start = system.state(0.0, system.group().identity(), &velocity);
    benches.bench_function(name, |b| {
        b.iter(|| {
            let mut state = black_box(start.clone());
            (0..COUNT).try_for_each(|_| method.step(system, &mut state, 0.05)).map(|()| state)
        });
    });
}

fn integrators(criterion: &mut Criterion) {
    let inertia = Inertia::diagonal(&Vector3::new(0.6, 0.8, 1.0)).expect("an inertia");
    let (free, rigid) = (system(So3, Free), system(Se3, Free));
    let mut group = criterion.benchmark_group("SO(3)");
    steps(&mut group, "RKMK4", &free, &MuntheKaas::RK4);
    steps(&mut group, "DP5", &free, &MuntheKaas::DORMAND_PRINCE);
    steps(&mut group, "CF4", &free, &CommutatorFree);
    steps(&mut group, "Simo-Wong", &free, &SimoWong::new(&inertia));
    steps(&mut group, "DMV6", &free, &MoserVeselov::new(&inertia, MoserVeselovOrder::Six));
    let heavy = system(So3, |_: f64, g: &UnitQuaternion<f64>, _: &Vector3<f64>| {
        Vector3::z().cross(&g.inverse_transform_vector(&Vector3::new(0.0, 0.0, -1.0)))
    });
    for (name, motion) in [
        ("exact", FreeMotion::Exact),
        ("DMV6", FreeMotion::MoserVeselov(MoserVeselovOrder::Six)),
        ("DMV10", FreeMotion::MoserVeselov(MoserVeselovOrder::Ten)),
    ] {
        let kick = Kick::new(&inertia, KickOrder::Two, motion);
        steps(&mut group, &format!("kicks, {name}"), &heavy, &kick);
    }
    steps(&mut group, "RKMK4, with a torque", &heavy, &MuntheKaas::RK4);
    group.finish();
    let mut group = criterion.benchmark_group("SE(3)");
    steps(&mut group, "RKMK4", &rigid, &MuntheKaas::RK4);
    steps(&mut group, "CF4", &rigid, &CommutatorFree);
    group.finish();
}

/// A motion from formulas, with one column.
fn motion(potential: Option<&str>, column: &str) -> Box<dyn Motion> {
    let algebra = So3.algebra().expect("an algebra");
    let moment = |[i, j]: [usize; 2]| if i == j { 0.6 + 0.2 * i as f64 } else { 0.0 };
    let matrix = DMatrix::from_fn(3, 3, |i, j| moment([i, j]));
    let mut forces = Forces::none(&So3, matrix, vec![]);
    if let Some(potential) = potential {
        forces.set_potential(potential).expect("a formula");
    }
    let mut columns = ColumnFormulas::default();
    let formula = columns.scope.read(column, forces.names(), &|_| true).expect("a formula");
    columns.formulas.push(formula);
    let metric = Tensor::from_fn(3, [Down, Down], moment).expect("a matrix");
    let spec = EulerPoincareSpec {
        connection: &Connection::canonical(&algebra, CanonicalConnection::Plus),
        metric: &Metric::new(algebra.labels(), metric).expect("a metric"),
        forces,
        time: 0.0,
        element: dvector![0.0, 0.0, 0.0, 1.0],
        momentum: dvector![1.8, 0.4, -0.9],
        integration: Integration {
            method: Some(Method::MuntheKaas4),
            step: Some(0.05),
            control: Adaptive::new(1e-9),
        },
        columns,
    };
    spec.start(&AnyGroup::new(So3)).expect("a motion").motion
}

/// Steps of RKMK4 from formulas: an event that never happens costs little, and a potential little more than the closure
/// `RKMK4, with a torque`.
fn formulas(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("formulas");
    for (name, potential, events) in
        [("free", None, 0), ("with an event", None, 1), ("with a potential", Some("g33"), 0)]
    {
        let mut motion = motion(potential, "H1 + 100");
        let mut crossings = Crossings::new(motion.as_ref(), 0..events);
        group.bench_function(name, |b| {
            b.iter(|| (0..COUNT).try_for_each(|_| crossings.step(motion.as_mut(), 1e9).map(drop)));
        });
    }
    group.finish();
}

criterion_group!(benches, free_body, integrators, formulas);
criterion_main!(benches);
