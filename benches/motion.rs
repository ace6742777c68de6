//! The free rigid body: a step, and an exact state.
//!
//! `cargo bench --bench motion`: nanoseconds per 1000 steps of the discrete Moser-Veselov algorithm and per 1000 exact states.

use affinor::dynamics::moser_veselov::Order;
use affinor::dynamics::{BodyState, FreeBody, Inertia, MoserVeselov};
use criterion::{Criterion, criterion_group, criterion_main};
use nalgebra::{UnitQuaternion, Vector3};
use std::hint::black_box;

const COUNT: usize = 1000;

fn free_body(criterion: &mut Criterion) {
    let inertia = Inertia::diagonal(&Vector3::new(0.6, 0.8, 1.0)).expect("an inertia");
    let attitude = UnitQuaternion::identity();
    let start = BodyState { attitude, momentum: Vector3::new(1.8, 0.4, -0.9) };
    let mut group = criterion.benchmark_group("free body");
    for (name, order) in [("DMV2", Order::Two), ("DMV6", Order::Six), ("DMV10", Order::Ten)] {
        let method = MoserVeselov::new(&inertia, order);
        group.bench_function(name, |b| b.iter(|| method.steps(black_box(&start), 0.05, COUNT)));
    }
    let method = MoserVeselov::new(&inertia, Order::Six);
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

criterion_group!(benches, free_body);
criterion_main!(benches);
