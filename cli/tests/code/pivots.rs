//! Programs of metrics whose leading minors nearly vanish: compiled, and compared with exact values
//! at the same numbers.

use crate::common::root;
use crate::compiled;
use crate::program::stdout;
use affinor::geometry::Geometry;
use affinor::geometry::equations::{EquationKind, Equations};
use affinor_documents::report::{Language, Quantity};
use affinor_documents::space::{Request, Space};
use affinor_tensors::linear::Matrix;
use affinor_tensors::{Rational, Tensor, Tolerance};
use num_traits::One;
use std::path::Path;

const SPACES: [(&str, usize); 5] =
    [("aff1", 2), ("sl(2)", 3), ("aff1+aff1", 4), ("heisenberg(5)", 5), ("se(3)", 6)];

/// The Schur complement of one diagonal entry, relative to the other entries.
const SMALL: [f64; 4] = [1e-2, 1e-5, 1e-9, 1e-12];

/// A symmetric matrix of numbers that are floats.
type Numbers = Vec<Vec<Rational>>;

/// The name of an entry: `J12`.
fn name(i: usize, j: usize) -> String {
    format!("J{}{}", i.min(j) + 1, i.max(j) + 1)
}

/// The full symmetric matrix of parameters, as an option.
fn full(n: usize) -> String {
    let row = |i| format!("[{}]", (0..n).map(|j| name(i, j)).collect::<Vec<_>>().join(","));
    format!("[{}]", (0..n).map(row).collect::<Vec<_>>().join(","))
}

/// An indefinite matrix in which the minor of the first `k + 1` rows nearly vanishes; `seed` chooses the numbers.
fn nearly_singular_corner(n: usize, k: usize, small: f64, seed: u64) -> Numbers {
    let mut state = seed;
    let mut draw = || {
        state =
            state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        Rational::new((state >> 33) as i64 % 8191 - 4095, 1024).unwrap()
    };
    let below: Numbers = (0..n).map(|i| (0..=i).map(|_| draw()).collect()).collect();
    let entry = |i: usize, j: usize| below[i.max(j)][i.min(j)].clone();
    let mut numbers: Numbers = (0..n).map(|i| (0..n).map(|j| entry(i, j)).collect()).collect();
    let corner: Numbers = numbers[..=k].iter().map(|row| row[..=k].to_vec()).collect();
    if let Some(inverse) = Matrix::from_dense(&corner).unwrap().inverse() {
        let schur = Rational::one() / &inverse.get(k, k);
        let entry = numbers[k][k].clone() - &schur;
        numbers[k][k] = Rational::from_f64(entry.to_f64() + small).unwrap();
    }
    numbers
}

/// The metrics of a space: each corner for each size of its Schur complement.
fn metrics(n: usize) -> Vec<Numbers> {
    let cases = SMALL.iter().enumerate().flat_map(|(at, small)| {
        (0..n - 1).map(move |k| nearly_singular_corner(n, k, *small, (at * n + k) as u64 + 1))
    });
    cases.collect()
}

/// The number of the parameter of that name.
fn value(numbers: &Numbers, name: &str) -> f64 {
    let index = |at: usize| usize::from(name.as_bytes()[at] - b'1');
    numbers[index(1)][index(2)].to_f64()
}

fn geometry(space: &str, numbers: &Numbers) -> Geometry<Rational> {
    let row =
        |row: &Vec<Rational>| row.iter().map(Rational::to_string).collect::<Vec<_>>().join(",");
    let rows: Vec<String> = numbers.iter().map(|own| format!("[{}]", row(own))).collect();
    let metric = Some(format!("[{}]", rows.join(",")));
    let request = Request { space: Some(space.into()), metric, ..Request::default() };
    Space::open(&request).unwrap().definition.geometry::<Rational>(Tolerance::default()).unwrap()
}

fn scalar_curvature(space: &str, numbers: &Numbers) -> Rational {
    let quantity = Quantity::from_key("scalar_curvature").unwrap();
    quantity.of(&geometry(space, numbers)).unwrap().unwrap().get(&[])
}

/// The largest size of the entries.
fn size(rows: &[Vec<f64>]) -> f64 {
    rows.iter().flatten().fold(0.0, |size, x| size.max(x.abs()))
}

fn floats(rows: &Numbers) -> Vec<Vec<f64>> {
    rows.iter().map(|row| row.iter().map(Rational::to_f64).collect()).collect()
}

fn dense(tensor: &Tensor<Rational>, n: usize) -> Vec<Vec<f64>> {
    (0..n).map(|i| (0..n).map(|j| tensor.get(&[i, j]).to_f64()).collect()).collect()
}

/// `|S|`, and the largest change of `S` for relative changes of the metric, `sum |dS/dg_ij| max
/// |g|`, by exact differentiation.
fn condition(space: &str, numbers: &Numbers, exact: &Rational) -> f64 {
    let step = Rational::from_f64(1e-40).unwrap();
    let mut sum = 0.0;
    for i in 0..numbers.len() {
        for j in 0..=i {
            let mut moved = numbers.clone();
            moved[i][j] += &step;
            moved[j][i] = moved[i][j].clone();
            let difference = scalar_curvature(space, &moved) - exact;
            sum += (difference / &step).to_f64().abs();
        }
    }
    exact.to_f64().abs() + sum * size(&floats(numbers))
}

fn code(arguments: &[&str], language: Language) -> String {
    stdout(root(), &[arguments, &["--code", language.name()]].concat())
}

/// The arrays of a program for several metrics, one after another.
fn run(
    folder: &Path,
    language: Language,
    source: &str,
    vectors: &[&[f64]],
    metrics: &[Numbers],
    shapes: &[Vec<usize>],
) -> Option<Vec<Vec<f64>>> {
    let points: Vec<_> = metrics.iter().map(|own| move |name: &str| value(own, name)).collect();
    let points: Vec<&dyn Fn(&str) -> f64> = points.iter().map(|own| own as _).collect();
    let found = compiled::run_at(folder, language, source, vectors, &points, shapes)?;
    Some(found.chunks(found.len() / metrics.len()).map(<[f64]>::to_vec).collect())
}

/// The largest error of a scalar curvature, in units of the machine precision and the condition
/// number. The terms of its formula are large and cancel if the inverse metric is large.
const LARGEST: f64 = 1000.0;

/// Inverse metrics and scalar curvatures are as accurate as their condition numbers allow, in
/// programs of one tensor and of several.
#[test]
fn tensors_are_accurate_for_indefinite_metrics() {
    let folder = tempfile::tempdir().unwrap();
    for (space, n) in SPACES {
        let (matrix, metrics) = (full(n), metrics(n));
        let exact: Vec<_> = metrics
            .iter()
            .map(|numbers| {
                let inverse = geometry(space, numbers).metric().unwrap().inverse().clone();
                let curvature = scalar_curvature(space, numbers);
                (dense(&inverse, n), condition(space, numbers, &curvature), curvature)
            })
            .collect();
        for language in [Language::C, Language::Python] {
            let program =
                |show: &str| code(&["table", space, "--metric", &matrix, "--show", show], language);
            let (alone, beside) = (
                program("scalar_curvature"),
                program("affinities,ricci,inverse_metric,scalar_curvature"),
            );
            let shapes = [vec![n; 3], vec![n; 2], vec![n; 2], vec![]];
            let found = run(folder.path(), language, &alone, &[], &metrics, &[vec![]]);
            let all = run(folder.path(), language, &beside, &[], &metrics, &shapes);
            let (Some(found), Some(all)) = (found, all) else { continue };
            for (at, (inverse, condition, curvature)) in exact.iter().enumerate() {
                let (found, all, numbers) = (found[at][0], &all[at], &metrics[at]);
                let (last, rest) = all.split_last().unwrap();
                let own = rest[rest.len() - n * n..].iter().zip(inverse.iter().flatten());
                let error = own.fold(0.0, |error: f64, (a, b)| error.max((a - b).abs()));
                let norm = size(inverse) * n as f64;
                let units = error / norm / norm / size(&floats(numbers)) / n as f64 / f64::EPSILON;
                assert!(units < 4.0, "{space}, {language:?}: {units}\n{numbers:?}");
                for found in [found, *last] {
                    let difference = Rational::from_f64(found).unwrap() - curvature;
                    let units = difference.to_f64().abs() / condition / f64::EPSILON;
                    assert!(units < LARGEST, "{space}, {language:?}: {units}\n{numbers:?}");
                }
                let units = (found - last).abs() / condition / f64::EPSILON;
                assert!(units < 1.0, "{space}, {language:?}: {found} {last}\n{numbers:?}");
            }
        }
    }
}

/// The accelerations of equations of motion solve a linear system with the metric.
#[test]
fn rates_are_accurate_for_indefinite_metrics() {
    let folder = tempfile::tempdir().unwrap();
    for (space, n) in SPACES {
        let metrics = metrics(n);
        let vector = |scale: f64| (0..n).map(|i| (i as f64 - 1.75) * scale).collect::<Vec<f64>>();
        let (state, force) = (vector(0.5), vector(-1.25));
        let exact =
            |x: &[f64]| x.iter().map(|x| Rational::from_f64(*x).unwrap()).collect::<Vec<_>>();
        for language in [Language::C, Language::Python] {
            let source = code(&["equations", space, "--metric", &full(n)], language);
            let vectors: [&[f64]; 2] = [&state, &force];
            let found = run(folder.path(), language, &source, &vectors, &metrics, &[vec![n]]);
            for (numbers, found) in metrics.iter().zip(found.into_iter().flatten()) {
                let geometry = geometry(space, numbers);
                let (connection, metric) = (geometry.connection(), geometry.metric());
                let kind = EquationKind::EulerPoincare;
                let equations = Equations::new(kind, connection, metric).unwrap();
                let rates = equations.rate(&exact(&state), &exact(&force)).unwrap();
                let inverse = size(&dense(metric.unwrap().inverse(), n)) * n as f64;
                // the sizes of the terms of A x and of b
                let largest = rates.iter().fold(0.0, |size: f64, x| size.max(x.to_f64().abs()));
                let momentum = size(&floats(numbers)) * n as f64;
                let terms = momentum * largest + momentum * 10.0 + 6.0;
                for (found, rate) in found.iter().zip(&rates) {
                    let error = (Rational::from_f64(*found).unwrap() - rate).to_f64().abs();
                    let units = error / inverse / terms / f64::EPSILON;
                    assert!(units < 4.0, "{space}, {language:?}: {units}\n{numbers:?}");
                }
            }
        }
    }
}

/// A value does not depend on the other tensors of the program, for a metric with formulas as
/// entries.
#[test]
fn scalar_curvature_does_not_depend_on_other_tensors() {
    let folder = tempfile::tempdir().unwrap();
    let metric = "[[1/(a+c),a^2,d,a],[a^2,1/(a+c),c,0],[d,c,b,2],[a,0,2,b/c]]";
    let value = |name: &str| match name {
        "a" => 14.0,
        "b" => -5.0 / 7.0,
        "c" => 29.0,
        _ => 0.6,
    };
    for language in Language::ALL {
        for (show, shapes) in [
            ("scalar_curvature", vec![vec![]]),
            ("curvature,ricci,scalar_curvature", vec![vec![4; 4], vec![4; 2], vec![]]),
        ] {
            let source =
                code(&["table", "aff1+aff1", "--metric", metric, "--show", show], language);
            let found = compiled::run(folder.path(), language, &source, &[], &value, &shapes);
            if let Some(found) = found {
                // by rational arithmetic
                let error = found.last().unwrap() / 2.545703421294757 - 1.0;
                assert!(error.abs() < 1e-13, "{language:?}, {show}: {error:e}");
            }
        }
    }
}
