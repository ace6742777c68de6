//! Isospectral flows: states compared with references of 30 digits, orders, conserved spectra, and
//! other descriptions of the same motion.

use crate::common::algebras::catalogued;
use crate::common::steps::{expect_order, run};
use affinor::group::{LieGroup, MatrixGroup};
use affinor::mechanics::systems::isospectral::{Flow, MatrixEntry, Symmetry, spectrum};
use affinor::mechanics::{
    Adaptive, Composed, EulerPoincare, Integrator, Isospectral, IsospectralMidpoint, Manakov,
    MatrixState, Toda, Zeitlin,
};
use affinor::{CanonicalConnection, Connection, Error, LieAlgebra, Metric};
use affinor_tensors::{Down, Tensor};
use nalgebra::{Complex, ComplexField, DMatrix, DVector};

const MIDPOINT: IsospectralMidpoint = IsospectralMidpoint;
const FOURTH: Composed<IsospectralMidpoint> = Composed(IsospectralMidpoint);

/// The size, time and numbers of the references with this name.
fn references(name: &str) -> Vec<(usize, f64, Vec<f64>)> {
    let lines = include_str!("../../data/isospectral.txt").lines();
    let lines = lines.filter_map(|line| line.strip_prefix(name));
    let found: Vec<_> = lines
        .map(|line| {
            let mut words = line.split_whitespace();
            let size = words.next().unwrap().parse().unwrap();
            let mut numbers = words.map(|word| word.parse::<f64>().unwrap());
            (size, numbers.next().unwrap(), numbers.collect())
        })
        .collect();
    assert!(found.len() >= 6, "{name}");
    found
}

fn distance<T: MatrixEntry>(x: &MatrixState<T>, y: &DMatrix<T>) -> f64 {
    (&x.matrix - y).norm()
}

/// Observed orders 2 and 4 over four halvings.
fn orders<S: Isospectral>(
    system: &S,
    start: &MatrixState<S::Entry>,
    exact: &DMatrix<S::Entry>,
    time: f64,
    steps: usize,
) {
    let midpoint = |n| distance(&run(&MIDPOINT, system, start, time, n), exact);
    expect_order("midpoint", MIDPOINT.order(), 4 * steps, 4, midpoint);
    let composed = |n| distance(&run(&FOURTH, system, start, time, n), exact);
    expect_order("composed", FOURTH.order(), steps, 4, composed);
}

fn drift(before: &[f64], after: &[f64]) -> f64 {
    let size = before.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
    let off = before.iter().zip(after).map(|(x, y)| (x - y).abs());
    off.fold(0.0, f64::max) / size
}

fn tridiagonal(diagonal: &[f64], beside: &[f64]) -> DMatrix<f64> {
    let n = diagonal.len();
    DMatrix::from_fn(n, n, |i, j| match i.abs_diff(j) {
        0 => diagonal[i],
        1 => beside[i.min(j)],
        _ => 0.0,
    })
}

#[test]
fn toda_states_are_exact() {
    for (n, time, numbers) in references("toda") {
        let matrix = |numbers: &[f64]| tridiagonal(&numbers[..n], &numbers[n..]);
        let (start, end) = numbers.split_at(2 * n - 1);
        let start = Toda.state(0.0, matrix(start)).unwrap();
        let found = Toda.exact(&start, time).unwrap();
        assert_eq!(found.time, time);
        assert!(distance(&found, &matrix(end)) < 2e-15 * (10.0 + time), "{n} at {time}");
        // and back again
        let back = Toda.exact(&found, 0.0).unwrap();
        assert!(distance(&back, &start.matrix) < 1e-13 || time > 2.0, "{n} from {time}");
        if time == 2.0 {
            orders(&Toda, &start, &matrix(end), time, 8);
        }
    }
}

/// Newton's equations of the Toda chain; the particles finally have the velocities of the sorted
/// eigenvalues.
#[test]
fn toda_is_a_chain_of_particles() {
    let (q, p) = ([0.3, -0.2, 0.5, 0.1], [0.4, -0.7, 0.2, 0.9]);
    let start = Toda.state(0.0, Toda::lattice(&q, &p).unwrap()).unwrap();
    let force = |k: usize| if k < 3 { (q[k] - q[k + 1]).exp() } else { 0.0 };
    let h = 1e-5;
    let [before, after] = [-h, h].map(|t| Toda.exact(&start, t).unwrap().matrix);
    for k in 0..4 {
        let slope = (after[(k, k)] - before[(k, k)]) / (2.0 * h);
        let acceleration = if k > 0 { force(k - 1) } else { 0.0 } - force(k);
        assert!((-2.0 * slope - acceleration).abs() < 1e-9);
    }
    // (exp((q_k - q_(k+1))/2)/2)'
    for k in 0..3 {
        let rate = (after[(k, k + 1)] - before[(k, k + 1)]) / (2.0 * h);
        let expected = 0.5 * (p[k] - p[k + 1]) * start.matrix[(k, k + 1)];
        assert!((rate - expected).abs() < 1e-9, "{k}: {rate} {expected}");
    }
    let kinetic: f64 = p.iter().map(|p| 0.5 * p * p).sum();
    let energy = kinetic + (0..3).map(force).sum::<f64>();
    assert!((Toda.energy(&start.matrix) - energy).abs() < 1e-14);
    let end = Toda.exact(&start, 200.0).unwrap().matrix;
    let mut descending = Toda.spectrum(&start.matrix);
    descending.reverse();
    assert!(drift(&descending, end.diagonal().as_slice()) < 1e-13);
}

#[test]
fn toda_of_fifty_particles() {
    let momenta: Vec<f64> = (0..50).map(|k| (1.3 * k as f64).sin()).collect();
    let start = Toda.state(0.0, Toda::lattice(&[0.0; 50], &momenta).unwrap()).unwrap();
    let exact = Toda.exact(&start, 1.0).unwrap();
    let end = run(&FOURTH, &Toda, &start, 1.0, 64);
    assert!(distance(&end, &exact.matrix) < 1e-6, "{}", distance(&end, &exact.matrix));
    assert!(drift(&Toda.spectrum(&start.matrix), &Toda.spectrum(&end.matrix)) < 1e-13);
}

fn antisymmetric(n: usize, numbers: &[f64]) -> DMatrix<f64> {
    let mut m = DMatrix::zeros(n, n);
    let pairs = (0..n).flat_map(|i| (i + 1..n).map(move |j| (i, j)));
    for ((i, j), x) in pairs.zip(numbers) {
        (m[(i, j)], m[(j, i)]) = (*x, -x);
    }
    m
}

#[test]
fn manakov_orders_and_integrals() {
    for (n, time, numbers) in references("manakov") {
        let (masses, numbers) = numbers.split_at(n);
        let (start, end) = numbers.split_at(n * (n - 1) / 2);
        let body = Manakov::new(masses).unwrap();
        let start = body.state(0.0, antisymmetric(n, start)).unwrap();
        let exact = antisymmetric(n, end);
        // of the exact motion, from the reference
        let integrals = |m: &DMatrix<f64>| {
            let powers = (2..=5).flat_map(|power| (0..power).map(move |degree| (power, degree)));
            let mut values: Vec<f64> = powers.map(|(p, d)| body.integral(m, p, d)).collect();
            values.extend([body.energy(m), body.norm_squared(m), body.pfaffian(m)]);
            values
        };
        assert!(drift(&integrals(&start.matrix), &integrals(&exact)) < 1e-14, "{n} {time}");
        if time == 1.0 {
            orders(&body, &start, &exact, time, 8);
        }
        let found = run(&FOURTH, &body, &start, time, 400);
        assert!(distance(&found, &exact) < 1e-4, "{n} {time}: {}", distance(&found, &exact));
        let casimirs = |m: &DMatrix<f64>| vec![body.norm_squared(m), body.pfaffian(m)];
        assert!(drift(&casimirs(&start.matrix), &casimirs(&found.matrix)) < 1e-13);
        assert!(drift(&body.spectrum(&start.matrix), &body.spectrum(&found.matrix)) < 1e-13);
    }
}

/// The integrals agree with their formulas. With the mass tensor `A` instead of `A^2` the formulas
/// are not conserved.
#[test]
fn manakov_integrals_have_squares_of_masses() {
    let masses = [1.0, 1.5, 2.5, 4.0];
    let body = Manakov::new(&masses).unwrap();
    let a = DMatrix::from_diagonal(&DVector::from_column_slice(&masses));
    let start = antisymmetric(4, &[0.9, -0.4, 0.7, 1.1, -0.6, 0.3]);
    let by_formula = |m: &DMatrix<f64>, a: &DMatrix<f64>| {
        (m * m * a * a).trace() + 0.5 * (m * a * m * a).trace()
    };
    let squares = &a * &a;
    let value = by_formula(&start, &squares);
    assert!((body.integral(&start, 4, 2) / 4.0 - value).abs() < 1e-12);
    assert!(
        (body.integral(&start, 3, 1) - 3.0 * (&start * &start * &squares).trace()).abs() < 1e-12
    );
    assert!((body.integral(&start, 2, 0) + 2.0 * body.norm_squared(&start)).abs() < 1e-13);
    let pfaffian = 0.9 * 0.3 - (-0.4) * (-0.6) + 0.7 * 1.1;
    assert!((body.pfaffian(&start) - pfaffian).abs() < 1e-15);
    let end = run(&FOURTH, &body, &body.state(0.0, start.clone()).unwrap(), 5.0, 2000).matrix;
    assert!((by_formula(&end, &squares) / value - 1.0).abs() < 1e-9);
    assert!((by_formula(&end, &a) / by_formula(&start, &a) - 1.0).abs() > 1e-3);
    // Pf^2 = det, by elimination with pivots, in six dimensions
    let body = Manakov::new(&[1.0; 6]).unwrap();
    let numbers: Vec<f64> =
        (0..15).map(|k| if k == 0 { 0.0 } else { (2.7 * k as f64).sin() }).collect();
    let m = antisymmetric(6, &numbers);
    assert!((body.pfaffian(&m).powi(2) / m.determinant() - 1.0).abs() < 1e-12);
    assert!(body.pfaffian(&m) != 0.0);
}

/// The same motion by structure constants on the group, with another integrator.
#[test]
fn manakov_is_euler_poincare() {
    for (n, time, numbers) in references("manakov").into_iter().filter(|(_, t, _)| *t <= 5.0) {
        let (masses, numbers) = numbers.split_at(n);
        let (start, end) = numbers.split_at(n * (n - 1) / 2);
        // the basis of the catalogue: (-1)^(i+j) (E_ij - E_ji), the last pair first
        let pairs: Vec<_> = (0..n).flat_map(|i| (i + 1..n).map(move |j| (i, j))).rev().collect();
        let unit = |&(i, j): &(usize, usize)| {
            let mut unit = DMatrix::zeros(n, n);
            unit[(i, j)] = if (i + j) % 2 == 0 { 1.0 } else { -1.0 };
            unit[(j, i)] = -unit[(i, j)];
            unit
        };
        let basis: Vec<_> = pairs.iter().map(unit).collect();
        let group = MatrixGroup::new(&basis).unwrap();
        let algebra = group.algebra().unwrap();
        let named: LieAlgebra<f64> = catalogued(&format!("so({n})")).map(|v| v.to_f64()).unwrap();
        assert_eq!(algebra.structure_constants(), named.structure_constants());
        let moments = pairs.iter().map(|&(i, j)| masses[i] + masses[j]).enumerate();
        let moments: Vec<_> = moments.map(|(k, sum)| ([k, k], sum)).collect();
        let metric = Tensor::from_components(pairs.len(), &[Down, Down], moments).unwrap();
        let metric = Metric::new(algebra.labels(), metric).unwrap();
        let plus = Connection::canonical(&algebra, CanonicalConnection::Plus);
        let motion = EulerPoincare::free(group.clone(), &plus, &metric).unwrap();
        let body = Manakov::new(masses).unwrap();
        let momentum = antisymmetric(n, start);
        let velocity = group.components(&body.velocity(&momentum));
        let state = motion.state(0.0, group.identity(), &velocity);
        let end_state = Adaptive::new(1e-11).states(&motion, &state, &[time]).unwrap().remove(0);
        let found = group.generator(&motion.momentum(&end_state));
        let off = (&found - antisymmetric(n, end)).norm();
        assert!(off < 1e-8, "{n} {time}: {off:e}");
        assert!((motion.energy(&end_state) - body.energy(&momentum)).abs() < 1e-8);
        // M = g^-1 m g
        let g = &end_state.element;
        assert!((g.transpose() * momentum * g - found).norm() < 1e-8);
    }
}

fn coefficients(fluid: &Zeitlin, w: &DMatrix<Complex<f64>>) -> Vec<f64> {
    let orders = (1..fluid.size()).flat_map(|l| (-(l as i64)..=l as i64).map(move |m| (l, m)));
    orders.map(|(l, m)| fluid.coefficient(w, l, m).unwrap()).collect()
}

fn vorticity(fluid: &Zeitlin, values: &[f64]) -> DMatrix<Complex<f64>> {
    let orders = (1..fluid.size()).flat_map(|l| (-(l as i64)..=l as i64).map(move |m| (l, m)));
    let terms: Vec<_> = orders.zip(values).map(|((l, m), w)| (l, m, *w)).collect();
    fluid.vorticity(&terms).unwrap()
}

#[test]
fn zeitlin_states_are_exact() {
    for (n, time, numbers) in references("zeitlin") {
        let fluid = Zeitlin::new(n).unwrap();
        let (start, end) = numbers.split_at(n * n - 1);
        let state = fluid.state(0.0, vorticity(&fluid, start)).unwrap();
        let exact = vorticity(&fluid, end);
        assert!(drift(start, &coefficients(&fluid, &state.matrix)) < 1e-14);
        if time == 1.0 {
            orders(&fluid, &state, &exact, time, 4);
        }
        let found = run(&FOURTH, &fluid, &state, time, 400);
        let off = drift(end, &coefficients(&fluid, &found.matrix));
        assert!(off < 1e-6, "{n} {time}: {off:e}");
        // quantities of the field, by Parseval
        let degrees = (1..n).flat_map(|l| std::iter::repeat_n(l as f64, 2 * l + 1));
        let energy: f64 = degrees.zip(start).map(|(l, w)| 0.5 * w * w / (l * (l + 1.0))).sum();
        assert!((fluid.energy(&state.matrix) / energy - 1.0).abs() < 1e-13);
        let enstrophy: f64 = start.iter().map(|w| w * w).sum();
        assert!((fluid.enstrophy(&state.matrix) / enstrophy - 1.0).abs() < 1e-13);
        let moment = |w: &DMatrix<_>| fluid.angular_momentum(w).to_vec();
        assert!(drift(&moment(&state.matrix), &moment(&found.matrix)) < 1e-13);
    }
}

/// `Y_lm` is a basis of eigenvectors; the bracket with `Y_10` is a rotation about the axis.
#[test]
fn harmonics_are_eigenvectors() {
    for (n, degrees) in
        [(5, vec![1, 2, 3, 4]), (33, vec![1, 2, 16, 31, 32]), (129, vec![1, 40, 128])]
    {
        let fluid = Zeitlin::new(n).unwrap();
        for l in degrees {
            let orders = [0, 1, l as i64 / 2, l as i64];
            for m in orders.into_iter().flat_map(|m| [m, -m]) {
                let y = fluid.harmonic(l, m).unwrap();
                assert!((&y - y.adjoint()).norm() < 1e-15 && (y.norm() - 1.0).abs() < 1e-14);
                let eigenvalue = -((l * (l + 1)) as f64);
                let off = (fluid.laplacian(&y) - &y * Complex::from(eigenvalue)).norm();
                let size = (n * n) as f64;
                assert!(off < 1e-14 * size, "{n} {l} {m}: {off:e}");
                let iy = &y * Complex::i();
                let off = (fluid.stream(&iy) * Complex::from(eigenvalue) - &iy).norm();
                assert!(off < 1e-12, "{n} {l} {m}: {off:e}");
                let top = y[(0, m.unsigned_abs() as usize)];
                assert!(if m < 0 { top.im < 0.0 } else { top.re > 0.0 }, "{n} {l} {m}: {top}");
            }
        }
        let (one, other) = (fluid.harmonic(4, 2).unwrap(), fluid.harmonic(3, 2).unwrap());
        assert!(one.dotc(&other).norm() < 1e-14);
    }
}

/// The Rossby-Haurwitz wave: on a rotation by `O` a harmonic rotates by `O (1 - 2/(l(l+1)))`, for
/// all `N`.
#[test]
fn rossby_haurwitz_waves_turn() {
    let (rotation, l, m) = (0.7, 4, 3);
    let scale = (4.0 * std::f64::consts::PI / 3.0).sqrt();
    for n in [5, 17, 24] {
        let fluid = Zeitlin::new(n).unwrap();
        let start = [(1, 0, 2.0 * rotation * scale), (l, m, 0.8)];
        let start = fluid.state(0.0, fluid.vorticity(&start).unwrap()).unwrap();
        let time = 1.5;
        let angle = rotation * (1.0 - 2.0 / (l * (l + 1)) as f64) * time * m as f64;
        let end =
            [(1, 0, 2.0 * rotation * scale), (l, m, 0.8 * angle.cos()), (l, -m, 0.8 * angle.sin())];
        let end = fluid.vorticity(&end).unwrap();
        let found = run(&FOURTH, &fluid, &start, time, 8 * n);
        assert!(distance(&found, &end) / end.norm() < 1e-6, "{n}: {}", distance(&found, &end));
        // a rotation of the sphere has the angular momentum 8 pi/3 O
        let [x, y, z] = fluid.angular_momentum(&found.matrix);
        let moment = 2.0 * rotation * scale * scale;
        assert!(x.abs().max(y.abs()) < 1e-13 && (z / moment - 1.0).abs() < 1e-13);
    }
}

/// After ten thousand steps, spectrum and angular momentum have rounding errors only, and the
/// energy is bounded without a drift.
#[test]
fn long_runs_keep_the_spectrum() {
    let fluid = Zeitlin::new(9).unwrap();
    let mut state = fluid.state(0.0, fluid.random(1, 4).unwrap()).unwrap();
    let (before, energy) = (fluid.spectrum(&state.matrix), fluid.energy(&state.matrix));
    let moment = fluid.angular_momentum(&state.matrix);
    let mut worst = [0.0_f64; 2];
    for step in 0..12_000 {
        MIDPOINT.step(&fluid, &mut state, 0.1).unwrap();
        let half = &mut worst[step / 6_000];
        *half = half.max((fluid.energy(&state.matrix) / energy - 1.0).abs());
    }
    assert!(drift(&before, &fluid.spectrum(&state.matrix)) < 1e-13);
    assert!(drift(&moment, &fluid.angular_momentum(&state.matrix)) < 1e-13);
    assert!(worst[0] < 1e-4 && worst[1] < 2.0 * worst[0], "{worst:?}");

    let body = Manakov::new(&[1.0, 1.5, 2.5, 4.0]).unwrap();
    let start = antisymmetric(4, &[0.9, -0.4, 0.7, 1.1, -0.6, 0.3]);
    let mut state = body.state(0.0, start.clone()).unwrap();
    for _ in 0..20_000 {
        MIDPOINT.step(&body, &mut state, 0.1).unwrap();
    }
    assert!(drift(&body.spectrum(&start), &body.spectrum(&state.matrix)) < 1e-13);
    assert!((body.pfaffian(&state.matrix) / body.pfaffian(&start) - 1.0).abs() < 1e-12);
    assert!((body.energy(&state.matrix) / body.energy(&start) - 1.0).abs() < 1e-3);
    assert!((&state.matrix + state.matrix.transpose()).norm() < 1e-12);
    assert!((&state.matrix - start).norm() > 0.1);
}

#[test]
fn larger_fluids() {
    for (n, degree, steps) in [(17, 6, 200), (33, 8, 40), (129, 10, 3)] {
        let fluid = Zeitlin::new(n).unwrap();
        let mut state = fluid.state(0.0, fluid.random(5, degree).unwrap()).unwrap();
        let start = state.clone();
        for _ in 0..steps {
            MIDPOINT.step(&fluid, &mut state, 0.05).unwrap();
        }
        assert!(
            drift(&fluid.spectrum(&start.matrix), &fluid.spectrum(&state.matrix)) < 1e-13,
            "{n}"
        );
        let moment = |w: &DMatrix<_>| fluid.angular_momentum(w).to_vec();
        assert!(drift(&moment(&start.matrix), &moment(&state.matrix)) < 1e-13, "{n}");
        let [before, after] = [&start, &state].map(|state| fluid.energy(&state.matrix));
        assert!((after / before - 1.0).abs() < 1e-4, "{n}: {before} {after}");
        let [before, after] = [&start, &state].map(|state| fluid.enstrophy(&state.matrix));
        assert!((after / before - 1.0).abs() < 1e-13, "{n}: {before} {after}");
        assert!((&state.matrix - &start.matrix).norm() > 1e-2 * start.matrix.norm());
        // there and back again
        for _ in 0..steps.min(20) {
            MIDPOINT.step(&fluid, &mut state, -0.05).unwrap();
        }
        if steps <= 20 {
            assert!(distance(&state, &start.matrix) < 1e-12 * start.matrix.norm());
        }
    }
    // the first numbers of SplitMix64 from 1234567, as published
    let fluid = Zeitlin::new(5).unwrap();
    let random = fluid.random(1234567, 2).unwrap();
    for (m, bits) in
        [(-1, 6457827717110365317_u64), (0, 3203168211198807973), (1, 9817491932198370423)]
    {
        let expected = bits as f64 / 2.0_f64.powi(63) - 1.0;
        assert!((fluid.coefficient(&random, 1, m).unwrap() - expected).abs() < 1e-14);
    }
    // a seed gives the same field for all N
    let [small, large] = [9, 40].map(|n| Zeitlin::new(n).unwrap());
    let [a, b] = [&small, &large].map(|fluid| fluid.enstrophy(&fluid.random(3, 8).unwrap()));
    assert!((a / b - 1.0).abs() < 1e-13);
}

/// Matrices without symmetry, whose spectrum is complex: traces of powers are conserved.
#[test]
fn any_matrix_flows() {
    let flow = Flow::new(|l: &DMatrix<f64>| l.map(f64::sin) * 0.5);
    let matrix = DMatrix::from_fn(4, 4, |i, j| ((3 * i + 5 * j + 1) as f64).sin());
    let start = flow.state(0.0, matrix).unwrap();
    let traces = |m: &DMatrix<f64>| (1..=4).map(|k| m.pow(k).trace()).collect::<Vec<_>>();
    let end = run(&MIDPOINT, &flow, &start, 2.0, 50);
    assert!(drift(&traces(&start.matrix), &traces(&end.matrix)) < 1e-13);
    assert!(distance(&end, &start.matrix) > 0.1);
    let exact = run(&FOURTH, &flow, &start, 1.0, 1000);
    orders(&flow, &start, &exact.matrix, 1.0, 8);
    let hermitian =
        DMatrix::from_fn(3, 3, |i, j| Complex::new((i + j) as f64, i as f64 - j as f64));
    // Brockett's flow of complex matrices converges to the sorted spectrum
    let d = DMatrix::from_diagonal(&DVector::from_fn(3, |i, _| Complex::from(i as f64)));
    let flow = Flow::new(move |l: &DMatrix<Complex<f64>>| &d * l - l * &d);
    let flow = flow.on(Symmetry::Hermitian);
    let start = flow.state(0.0, hermitian.clone()).unwrap();
    let end = run(&MIDPOINT, &flow, &start, 60.0, 2400).matrix;
    assert_eq!(end, end.adjoint());
    let diagonal: Vec<f64> = end.diagonal().iter().map(|z| z.re).collect();
    assert!(drift(&spectrum(&hermitian), &diagonal) < 1e-12, "{end}");
    let roots = spectrum(&hermitian);
    assert!((roots.iter().sum::<f64>() - 6.0).abs() < 1e-13 && roots.is_sorted());
}

#[test]
fn what_is_no_state_is_refused() {
    let shape = |error: Result<MatrixState<f64>, Error>| {
        assert!(matches!(error, Err(Error::Shape { .. })), "{error:?}")
    };
    fn reason<T: std::fmt::Debug>(error: Result<T, Error>) -> String {
        match error {
            Err(Error::Invalid { what: "state", reason }) => reason,
            other => panic!("{other:?}"),
        }
    }
    shape(Toda.state(0.0, DMatrix::zeros(2, 3)));
    shape(Toda.state(0.0, DMatrix::zeros(0, 0)));
    assert!(matches!(Toda::lattice(&[0.0], &[]), Err(Error::Shape { .. })));
    assert!(matches!(Toda::lattice(&[], &[]), Err(Error::Shape { .. })));
    let crooked = DMatrix::from_row_slice(2, 2, &[0.0, 1.0, 2.0, 0.0]);
    assert!(reason(Toda.state(0.0, crooked.clone())).contains("L_12 = 1"));
    let nan = DMatrix::from_row_slice(2, 2, &[0.0, f64::NAN, 0.0, 0.0]);
    assert_eq!(reason(Toda.state(0.0, nan.clone())), "the entry L_12 is NaN, which is not finite");
    let start = Toda.state(0.0, DMatrix::identity(2, 2)).unwrap();
    for time in [f64::NAN, f64::INFINITY, 1e300] {
        assert!(matches!(Toda.exact(&start, time), Err(Error::Integration { .. })));
    }

    let body = Manakov::new(&[1.0, 2.0]).unwrap();
    shape(body.state(0.0, DMatrix::zeros(3, 3)));
    assert!(reason(body.state(0.0, crooked)).contains("antihermitian"));
    for masses in [&[1.0][..], &[1.0, -1.0], &[1.0, f64::NAN], &[f64::MAX, f64::MAX]] {
        assert!(
            matches!(Manakov::new(masses), Err(Error::Invalid { what: "inertia", .. })),
            "{masses:?}"
        );
    }

    let fluid = Zeitlin::new(3).unwrap();
    assert!(matches!(Zeitlin::new(1), Err(Error::Shape { .. })));
    assert!(matches!(Zeitlin::new(1 << 40), Err(Error::Size { .. })));
    let hermitian =
        DMatrix::from_fn(3, 3, |i, j| Complex::new((i + j) as f64, i as f64 - j as f64));
    assert!(reason(fluid.state(0.0, hermitian.clone())).contains("antihermitian"));
    let with_trace = hermitian * Complex::i();
    assert_eq!(reason(fluid.state(0.0, with_trace)), "the trace of W is 6i, not 0");
    assert!(matches!(fluid.state(0.0, DMatrix::zeros(2, 2)), Err(Error::Shape { .. })));
    for (l, m) in [(3, 0), (2, 3), (2, -3), (2, i64::MIN)] {
        assert!(matches!(fluid.harmonic(l, m), Err(Error::Shape { .. })), "{l} {m}");
    }
    assert!(matches!(fluid.random(1, 3), Err(Error::Shape { .. })));
    assert!(matches!(fluid.random(1, usize::MAX), Err(Error::Shape { .. })));
    assert!(matches!(fluid.vorticity(&[(0, 0, 1.0)]), Err(Error::Shape { .. })));

    let flow = Flow::new(|l: &DMatrix<f64>| l.columns(0, 1).into_owned());
    shape(flow.state(0.0, DMatrix::identity(2, 2)));
    assert!(spectrum(&nan).iter().all(|x| x.is_nan()));
}

#[test]
fn the_smallest_and_what_is_at_rest() {
    let one = Toda.state(0.0, Toda::lattice(&[1.0], &[3.0]).unwrap()).unwrap();
    assert_eq!(Toda.exact(&one, 5.0).unwrap().matrix, one.matrix);
    assert_eq!(run(&FOURTH, &Toda, &one, 5.0, 3).matrix, one.matrix);
    // su(2): a rotation of the sphere is at rest
    let fluid = Zeitlin::new(2).unwrap();
    let start = fluid.state(0.0, fluid.random(9, 1).unwrap()).unwrap();
    let end = run(&MIDPOINT, &fluid, &start, 3.0, 5);
    assert!(distance(&end, &start.matrix) < 1e-15);
    assert!((fluid.energy(&start.matrix) / fluid.enstrophy(&start.matrix) - 0.25).abs() < 1e-15);
    let still = fluid.state(0.0, fluid.vorticity(&[]).unwrap()).unwrap();
    assert_eq!(run(&FOURTH, &fluid, &still, 1.0, 2).matrix, still.matrix);
    // the planar body rotates steadily
    let body = Manakov::new(&[1.0, 2.0]).unwrap();
    let start = body.state(0.0, antisymmetric(2, &[0.7])).unwrap();
    assert_eq!(run(&MIDPOINT, &body, &start, 1.0, 2).matrix, start.matrix);
    assert_eq!(body.pfaffian(&start.matrix), 0.7);
}

#[test]
fn steps_that_are_too_long_leave_the_state() {
    let fluid = Zeitlin::new(9).unwrap();
    let start = fluid.state(0.5, fluid.random(1, 4).unwrap()).unwrap();
    for h in [100.0, -1e3, 1e200, f64::NAN, f64::INFINITY] {
        let mut state = start.clone();
        let stopped = MIDPOINT.step(&fluid, &mut state, h);
        assert!(matches!(stopped, Err(Error::Integration { t: 0.5, .. })), "{h}: {stopped:?}");
        assert_eq!(state, start);
        assert!(FOURTH.step(&fluid, &mut state, h).is_err());
        assert_eq!(state, start);
    }
    // an error within a composition, too
    let count = std::cell::Cell::new(0);
    let flow = Flow::new(move |l: &DMatrix<f64>| {
        count.set(count.get() + 1);
        if count.get() > 40 { l * f64::NAN } else { l.upper_triangle() }
    });
    let mut state = flow.state(0.0, DMatrix::from_row_slice(2, 2, &[1.0, 0.5, 0.2, -1.0])).unwrap();
    let before = state.clone();
    assert!(FOURTH.step(&flow, &mut state, 0.1).is_err());
    assert_eq!(state, before);
    assert_eq!(state.matrix.map(ComplexField::modulus), before.matrix.map(f64::abs));
}
