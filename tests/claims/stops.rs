//! Every long computation ends soon after its token is set, and later computations are right:
//! `tensors::stop`, and the checkpoints of the kernels.

use crate::common::labels;
use affinor::algebra::catalogue;
use affinor::algebra::structure::StructureTheory;
use affinor::algebra::{BasisChange, Bracket};
use affinor::geometry::equations::Equations;
use affinor::group::transport::ParallelTranslation;
use affinor::group::{AnyGroup, LieGroup};
use affinor::numerics::exponential;
use affinor::{CanonicalConnection, Chart, Connection, LieAlgebra, LiePoisson, Metric};
use affinor_tensors::linear::Matrix;
use affinor_tensors::linear::modular::{PRIMES, ResidueMatrix};
use affinor_tensors::scalar::clear_caches;
use affinor_tensors::stop::{StopReason, StopToken};
use affinor_tensors::{Down, Field, Notation, Rational, Recorded, Scalar, Symbolic, Tensor, Up};
use nalgebra::{DMatrix, DVector};
use rayon::ThreadPoolBuilder;
use std::hint::black_box;
use std::sync::mpsc;
use std::thread;
use std::time::Duration;

/// A computation that runs for more than ten seconds if it is not stopped. It calls its argument
/// when its data are ready.
type Long = (&'static str, fn(&dyn Fn()));

/// Irregular integers from -3 to 3, always the same.
fn integers() -> impl FnMut() -> i64 {
    let mut state = 7_u64;
    move || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963);
        (state >> 40) as i64 % 7 - 3
    }
}

/// A dense positive definite matrix of integers.
fn dense(n: usize) -> Vec<Vec<i64>> {
    let mut next = integers();
    let m: Vec<Vec<i64>> = (0..n).map(|_| (0..n).map(|_| next()).collect()).collect();
    let product = |i: usize, j: usize| (0..n).map(|k| m[k][i] * m[k][j]).sum::<i64>();
    let entry = |i: usize, j: usize| product(i, j) + if i == j { n as i64 } else { 0 };
    (0..n).map(|i| (0..n).map(|j| entry(i, j)).collect()).collect()
}

fn metric<S: Field + Scalar>(n: usize, entry: impl Fn(usize, usize) -> S) -> Metric<S> {
    let components = Tensor::from_fn(n, [Down, Down], |[i, j]| entry(i, j)).unwrap();
    Metric::new(labels(n), components).unwrap()
}

/// A metric whose components are distinct symbols.
fn full<S: Field + Scalar + Notation>(n: usize) -> Metric<S> {
    metric(n, |i, j| S::parameter(&format!("g{}_{}", i.min(j), i.max(j))).unwrap())
}

fn numeric(n: usize) -> Metric<Rational> {
    let entries = dense(n);
    metric(n, |i, j| Rational::from(entries[i][j]))
}

fn algebra<S: Notation + Scalar>(name: &str) -> LieAlgebra<S> {
    catalogue::algebra(name).unwrap()
}

fn levi_civita<S: Field + Scalar + Notation>(name: &str, metric: &Metric<S>) -> Connection<S> {
    Connection::levi_civita(algebra(name).left_frame(), metric).unwrap()
}

/// An algebra in a dense basis.
fn scrambled(name: &str) -> LieAlgebra<Rational> {
    let algebra: LieAlgebra<Rational> = algebra(name);
    let entries = dense(algebra.dimension());
    let change = |[i, j]: [usize; 2]| Rational::from(entries[i][j]);
    let change = Tensor::from_fn(algebra.dimension(), [Up, Down], change).unwrap();
    algebra.change_basis(&BasisChange::new(change).unwrap()).unwrap()
}

const LONG: [Long; 18] = [
    ("symbolic curvature", |begin| {
        begin();
        black_box(levi_civita("se(3)", &full::<Symbolic>(6)).curvature());
    }),
    ("symbolic inverse", |begin| {
        begin();
        black_box(full::<Symbolic>(9).inverse());
    }),
    ("symbolic power", |begin| {
        begin();
        let sum: Symbolic = "(a + b + c + d)/(1 + e)".parse().unwrap();
        black_box((0..4000).fold(sum.clone(), |power, _| power * &sum));
    }),
    ("symbolic properties", |begin| {
        begin();
        black_box(levi_civita("se(3)", &full::<Symbolic>(6)).locally_symmetric());
    }),
    ("equations solved for derivatives", |begin| {
        begin();
        let connection = Connection::canonical(&algebra("so(5)"), CanonicalConnection::Plus);
        let equations = Equations::euler_poincare(&connection, &full::<Symbolic>(10)).unwrap();
        black_box(equations.solved());
    }),
    ("curvature on a chart", |begin| {
        begin();
        let chart = Chart::new(["x", "y", "z", "t"]).unwrap();
        let entry = |i: usize, j: usize| {
            let text = format!("a{i}{j} + sin(x)*y^{} + exp(z)*t^{}", i + j, i * j + 1);
            let known: Symbolic = text.parse().unwrap();
            known
        };
        let metric = metric(4, |i, j| entry(i.min(j), i.max(j)));
        let connection = Connection::levi_civita(&chart.coordinate_frame().unwrap(), &metric);
        black_box(connection.unwrap().nabla_curvature());
    }),
    ("recorded derivative of the curvature", |begin| {
        begin();
        black_box(levi_civita("so(6)", &full::<Recorded>(15)).nabla_curvature());
    }),
    ("exact curvature of a dense metric", |begin| {
        begin();
        black_box(levi_civita("so(8)", &numeric(28)).curvature());
    }),
    ("exact curvature of E8", |begin| {
        begin();
        let metric = Metric::diagonal((1..=248).map(Rational::from)).unwrap();
        let connection = levi_civita("E8", &metric);
        black_box((0..20).map(|_| connection.bianchi_second()).collect::<Vec<_>>());
    }),
    ("exact determinant", |begin| {
        let rows: Vec<Vec<Rational>> = dense(200)
            .into_iter()
            .map(|row| row.into_iter().map(Rational::from).collect())
            .collect();
        begin();
        black_box(Matrix::from_dense(&rows).unwrap().determinant().unwrap());
    }),
    ("rank modulo a prime", |begin| {
        let (n, mut next) = (4000, integers());
        let row = |_| (0..n).map(|_| PRIMES[0].integer(next() * 1_000_003)).collect();
        let matrix = ResidueMatrix::new(PRIMES[0], n, (0..n).map(row).collect());
        begin();
        black_box(matrix.rank());
    }),
    ("structure in a dense basis", |begin| {
        begin();
        let structure = StructureTheory::new(scrambled("so(9)"));
        black_box((structure.root_spaces(), structure.simple_ideals().unwrap()));
    }),
    ("cohomology", |begin| {
        begin();
        let structure = StructureTheory::new(scrambled("heisenberg(11)"));
        black_box((0..50).map(|_| structure.betti_numbers()).collect::<Vec<_>>());
    }),
    ("Casimir functions", |begin| {
        begin();
        let value = |value: &Rational| Symbolic::constant(value.clone());
        let space = LiePoisson::left(&scrambled("so(5)").map(value).unwrap()).unwrap();
        black_box(space.casimirs(5).unwrap());
    }),
    ("holonomy", |begin| {
        begin();
        black_box(levi_civita("so(6)", &numeric(15)).holonomy().unwrap());
    }),
    ("extremes of the sectional curvature", |begin| {
        begin();
        let (metric, algebra) = (numeric(10), algebra("so(5)"));
        black_box((0..20).map(|_| metric.sectional_extremes(&algebra)).collect::<Vec<_>>());
    }),
    ("transport on a large group", |begin| {
        begin();
        let (group, algebra) = (AnyGroup::named("E7").unwrap(), algebra::<f64>("E7"));
        let x = DVector::from_element(group.dimension(), 0.1);
        let connection = Connection::canonical(&algebra, CanonicalConnection::Zero);
        let translation = ParallelTranslation::new(group, connection).unwrap();
        black_box(translation.along_arcs(&vec![x; 100]).unwrap());
    }),
    ("exponential of a large matrix", |begin| {
        begin();
        let mut next = integers();
        let m = DMatrix::from_fn(400, 400, |_, _| next() as f64 / 100.0);
        (0..100).for_each(|_| drop(black_box(exponential::exp(&m))));
    }),
];

/// The results of computations of several kinds, as text.
fn results() -> Vec<String> {
    let symbolic = levi_civita("so(3)", &full::<Symbolic>(3));
    let exact = levi_civita("so(4)", &numeric(6));
    let structure = StructureTheory::new(scrambled("so(4)"));
    let bracket = Bracket::from_constants(labels(3), [(0, 1, 2, Symbolic::parameter("h"))]);
    let space = LiePoisson::left(&LieAlgebra::try_from(bracket.unwrap()).unwrap()).unwrap();
    vec![
        symbolic.curvature().to_string(),
        exact.ricci().to_string(),
        exact.holonomy().unwrap().dimension().to_string(),
        format!("{:?}", structure.betti_numbers()),
        format!("{:?}", structure.dynkin_type()),
        format!("{:?}", space.casimirs(2).unwrap()),
    ]
}

/// Sets a token 0.3 s after the work has begun. The work must end early; a finished result would be
/// returned as a value.
fn stopped((name, work): Long) {
    let (token, (begun, wait)) = (StopToken::new(), mpsc::channel());
    let watcher = {
        let token = token.clone();
        thread::spawn(move || {
            wait.recv().unwrap();
            thread::sleep(Duration::from_millis(300));
            token.request(StopReason::Interrupted);
        })
    };
    let ended = token.run(|| {
        work(&|| begun.send(()).unwrap());
    });
    assert_eq!(ended.unwrap_err().reason, StopReason::Interrupted, "{name}");
    watcher.join().unwrap();
}

/// Each of the computations is stopped on one thread and on several; afterwards the results are the
/// same as before.
#[test]
fn long_computations_stop_and_leave_no_trace() {
    let expected = thread::spawn(results).join().unwrap();
    for threads in [1, 3] {
        let pool = ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        for long in LONG {
            pool.install(|| stopped(long));
        }
        assert_eq!(pool.install(results), expected);
        pool.broadcast(|_| clear_caches());
        assert_eq!(pool.install(results), expected);
    }
}
