//! Rotations: affinor compared with nalgebra, glam and the formulas of Sophus and manif, in one
//! run.
//!
//! `cargo bench -p affinor-benches --bench rotations`: nanoseconds per 1000 independent operations, arguments and results in
//! memory; then batches of a million. Compare ratios within one run, not absolute times.

use affinor::group::batch;
use affinor::group::{LieGroup, So3};
use criterion::{
    BenchmarkGroup, Criterion, criterion_group, criterion_main, measurement::WallTime,
};
use glam::{DQuat, DVec3};
use nalgebra::{Rotation3, UnitQuaternion, Vector3};
use std::hint::black_box;
use std::time::Duration;

#[path = "../tests/common/rotation_peers.rs"]
mod rotation_peers;

const SINGLE: usize = 1000;
const BATCH: usize = 1_000_000;

/// Vectors in a box, so angles up to 2.9.
fn vectors(count: usize, mut seed: u64) -> Vec<Vector3<f64>> {
    let mut number = || {
        seed = seed.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        ((seed >> 11) as f64 / (1u64 << 53) as f64 - 0.5) * 3.4
    };
    (0..count).map(|_| Vector3::new(number(), number(), number())).collect()
}

/// One operation on every element.
fn map<X, Y: Clone>(
    group: &mut BenchmarkGroup<'_, WallTime>,
    name: &str,
    inputs: &[X],
    operation: impl Fn(&X) -> Y,
) {
    let mut outputs: Vec<Y> = inputs.iter().map(&operation).collect();
    group.bench_function(name, |b| {
        b.iter(|| {
            for (output, input) in outputs.iter_mut().zip(black_box(inputs)) {
                *output = operation(input);
            }
            black_box(&mut outputs);
        });
    });
}

fn single(criterion: &mut Criterion) {
    let (x, v) = (vectors(SINGLE, 1), vectors(SINGLE, 2));
    let q: Vec<UnitQuaternion<f64>> = x.iter().map(|x| So3.exp(x)).collect();
    let r: Vec<Rotation3<f64>> = x.iter().map(|x| Rotation3::from_scaled_axis(*x)).collect();
    let gx: Vec<DVec3> = x.iter().map(|x| DVec3::new(x.x, x.y, x.z)).collect();
    let gq: Vec<DQuat> = gx.iter().map(|x| DQuat::from_scaled_axis(*x)).collect();
    let plain = |g: &UnitQuaternion<f64>| [g.w, g.i, g.j, g.k];

    let mut group = criterion.benchmark_group("exp");
    map(&mut group, "affinor", &x, |x| So3.exp(x));
    map(&mut group, "nalgebra UnitQuaternion", &x, |x| UnitQuaternion::from_scaled_axis(*x));
    map(&mut group, "nalgebra Rotation3", &x, |x| Rotation3::from_scaled_axis(*x));
    map(&mut group, "glam DQuat", &gx, |x| DQuat::from_scaled_axis(*x));
    map(&mut group, "Sophus", &x, |x| rotation_peers::sophus_exp((*x).into()));
    map(&mut group, "manif", &x, |x| rotation_peers::manif_exp((*x).into()));
    group.finish();

    let mut group = criterion.benchmark_group("log");
    map(&mut group, "affinor", &q, |q| So3.log(q));
    map(&mut group, "nalgebra UnitQuaternion", &q, |q| q.scaled_axis());
    map(&mut group, "nalgebra Rotation3", &r, |r| r.scaled_axis());
    map(&mut group, "glam DQuat", &gq, |q| q.to_scaled_axis());
    map(&mut group, "Sophus", &q, |q| rotation_peers::sophus_log(*q));
    map(&mut group, "manif", &q, |q| rotation_peers::manif_log(*q));
    group.finish();

    let mut group = criterion.benchmark_group("compose");
    let turned: Vec<_> = q.iter().copied().zip(q.iter().rev().copied()).collect();
    map(&mut group, "affinor", &turned, |(p, q)| So3.compose(p, q));
    map(&mut group, "nalgebra UnitQuaternion", &turned, |(p, q)| p * q);
    let turned: Vec<_> = r.iter().copied().zip(r.iter().rev().copied()).collect();
    map(&mut group, "nalgebra Rotation3", &turned, |(p, q)| p * q);
    let turned: Vec<_> = gq.iter().copied().zip(gq.iter().rev().copied()).collect();
    map(&mut group, "glam DQuat", &turned, |(p, q)| *p * *q);
    group.finish();

    let pairs: Vec<_> = x.iter().copied().zip(v).collect();
    let mut group = criterion.benchmark_group("T_left");
    map(&mut group, "affinor", &pairs, |(x, v)| So3.tangent_left(x, v));
    for peer in &rotation_peers::PEERS[1..] {
        if let Some(left) = peer.left {
            map(&mut group, peer.name, &pairs, |(x, v)| left((*x).into(), (*v).into()));
        }
    }
    group.finish();
    let mut group = criterion.benchmark_group("T_left inverse");
    map(&mut group, "affinor", &pairs, |(x, v)| So3.tangent_left_inverse(x, v));
    for peer in &rotation_peers::PEERS[1..] {
        if let Some(inverse) = peer.inverse {
            map(&mut group, peer.name, &pairs, |(x, v)| inverse((*x).into(), (*v).into()));
        }
    }
    group.finish();
    black_box(plain(&q[0]));
}

fn batches(criterion: &mut Criterion) {
    let x = vectors(BATCH, 3);
    let mut q: Vec<UnitQuaternion<f64>> = x.iter().map(|x| So3.exp(x)).collect();
    let mut back = x.clone();
    let rows: Vec<[f64; 3]> = x.iter().map(|x| (*x).into()).collect();
    let mut rotations = vec![[0.0; 4]; BATCH];
    batch::exp_rows(&rows, &mut rotations);
    let (other, mut product, mut logarithms) = (rotations.clone(), rotations.clone(), rows.clone());

    let mut group = criterion.benchmark_group("a million");
    group.sample_size(20).measurement_time(Duration::from_secs(2));
    group.bench_function("exp/affinor, rows", |b| {
        b.iter(|| batch::exp_rows(black_box(&rows), &mut rotations));
    });
    group.bench_function("exp/affinor, one by one", |b| {
        b.iter(|| q.iter_mut().zip(&x).for_each(|(q, x)| *q = So3.exp(x)));
    });
    group.bench_function("exp/nalgebra, one by one", |b| {
        b.iter(|| {
            q.iter_mut().zip(&x).for_each(|(q, x)| *q = UnitQuaternion::from_scaled_axis(*x))
        });
    });
    group.bench_function("log/affinor, rows", |b| {
        b.iter(|| batch::log_rows(black_box(&rotations), &mut logarithms));
    });
    group.bench_function("log/nalgebra, one by one", |b| {
        b.iter(|| back.iter_mut().zip(&q).for_each(|(x, q)| *x = q.scaled_axis()));
    });
    group.bench_function("compose/affinor, rows", |b| {
        b.iter(|| batch::compose_rows(black_box(&rotations), &other, &mut product));
    });
    group.bench_function("compose/nalgebra, one by one", |b| {
        let mut product = q.clone();
        b.iter(|| {
            product.iter_mut().zip(&q).zip(q.iter().rev()).for_each(|((r, p), q)| *r = p * q)
        });
    });
    group.bench_function("copy of the rows", |b| {
        b.iter(|| product.clone_from(black_box(&other)));
    });
    group.finish();
}

criterion_group!(benches, single, batches);
criterion_main!(benches);
