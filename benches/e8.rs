//! E8, dimension 248: the engine, exact and in floats, compared with hand-written integer loops.
//!
//! `cargo bench -p affinor-benches --bench e8`; one thread. Compare the ratio of a row to the
//! hand-written loop in the same run, not the absolute times.

use affinor::algebra::roots::{CartanType, RootSystem, Series, chevalley_constants};
use affinor::{Bracket, CanonicalConnection, Connection, LieAlgebra, Metric};
use affinor_tensors::{Down, Rational, Scalar, Tensor};
use criterion::{BatchSize, Bencher, Criterion, criterion_group, criterion_main};
use std::hint::black_box;

fn constants() -> Vec<(usize, usize, usize, i64)> {
    let e8 = CartanType::new(Series::E, 8).expect("E8 exists");
    chevalley_constants(&RootSystem::new(e8))
}

fn bracket() -> Bracket<Rational> {
    let labels = (1..=248).map(|i| format!("e{i}"));
    let constants = constants().into_iter().map(|(j, k, i, v)| (j, k, i, Rational::from(v)));
    Bracket::from_constants(labels, constants).expect("E8 is antisymmetric")
}

/// The curvature of a connection that has not computed it yet.
fn curvature<S: Scalar>(bencher: &mut Bencher, connection: &Connection<S>) {
    let fresh = || {
        let (frame, gamma) = (connection.frame().clone(), connection.affinities().clone());
        Connection::new(frame, gamma).expect("the affinities of a connection")
    };
    let computed = |connection: Connection<S>| {
        black_box(connection.curvature());
        connection
    };
    bencher.iter_batched(fresh, computed, BatchSize::PerIteration);
}

fn e8(criterion: &mut Criterion) {
    rayon::ThreadPoolBuilder::new().num_threads(1).build_global().expect("one thread");
    let entries = constants();
    let floor = floor::Constants::new(248, &entries);
    let bracket = bracket();
    let algebra = LieAlgebra::try_from(bracket.clone()).expect("E8 is a Lie algebra");
    let zero = Connection::canonical(&algebra, CanonicalConnection::Zero);
    let float = algebra.map(Rational::to_f64).expect("E8 in floats");
    let zero_float = Connection::canonical(&float, CanonicalConnection::Zero);
    assert_eq!(zero.curvature().len(), 2 * floor.curvature());

    let mut group = criterion.benchmark_group("E8");
    group.sample_size(20);
    group.bench_function("constants from roots", |b| b.iter(constants));
    group.bench_function("bracket from roots", |b| b.iter(crate::bracket));
    group.bench_function("jacobi/floor", |b| b.iter(|| black_box(&floor).jacobi()));
    group.bench_function("jacobi/exact", |b| b.iter(|| black_box(&bracket).jacobi()));
    group.bench_function("killing/floor", |b| b.iter(|| black_box(&floor).killing()));
    group.bench_function("killing/exact", |b| b.iter(|| black_box(&algebra).killing_form()));
    group.bench_function("curvature/floor", |b| b.iter(|| black_box(&floor).curvature()));
    group.bench_function("curvature/exact", |b| curvature(b, &zero));
    group.bench_function("curvature/f64", |b| curvature(b, &zero_float));
    // the Levi-Civita connection of diag(1, ..., 248): 8.1 million components
    let diagonal = (0..248).map(|i| ([i, i], Rational::from(i as i64 + 1)));
    let diagonal = Tensor::from_components(248, &[Down, Down], diagonal).expect("a square");
    let metric = Metric::new(algebra.labels(), diagonal).expect("a metric");
    let exact = Connection::levi_civita(algebra.left_frame(), &metric).expect("one frame");
    let float =
        Connection::new(float.left_frame().clone(), exact.affinities().map(Rational::to_f64));
    let float = float.expect("affinities in floats");
    group.sample_size(10);
    group.bench_function("levi-civita curvature/exact", |b| curvature(b, &exact));
    group.bench_function("levi-civita curvature/f64", |b| curvature(b, &float));
    group.finish();
}

criterion_group!(benches, e8);
criterion_main!(benches);
