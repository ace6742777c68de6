//! One implementation for three scalars: floats agree with exact values, and parameters that are
//! set later give the same values as numbers from the start.
//!
//! Guards `Connection`, `Metric` and `MatrixBasis` over `Rational`, `Symbolic` and `f64`.

use crate::common::algebras::seeds;
use crate::common::{Space, fraction, integer, property::properties, spaces, stored};
use affinor::algebra::Complex;
use affinor::{Connection, LieAlgebra, MatrixBasis, Metric};
use affinor_tensors::{Down, Rational, Symbolic, Tensor, Tolerance, Up};
use proptest::prelude::*;
use std::collections::BTreeMap;

/// The three connections of a space, in floats.
fn floats(space: &Space) -> (LieAlgebra<f64>, Metric<f64>, [Connection<f64>; 3]) {
    let algebra = space.algebra.map(Rational::to_f64).unwrap();
    let metric = space.metric.components().map(Rational::to_f64);
    let metric = Metric::new(algebra.labels(), metric).unwrap();
    let frame = algebra.left_frame();
    let any = Connection::new(frame.clone(), space.affinities.map(Rational::to_f64)).unwrap();
    let family = Connection::cartan_schouten(&algebra, &space.lambda.to_f64());
    let levi_civita = Connection::levi_civita(frame, &metric).unwrap();
    (algebra, metric, [any, family, levi_civita])
}

fn largest(tensor: &Tensor<f64>) -> f64 {
    tensor.components().fold(0.0, |largest, (_, value)| value.abs().max(largest))
}

/// Compares component by component, within `error` relative to the possible size of the terms.
fn near(float: &Tensor<f64>, exact: &Tensor<Rational>, error: f64) -> Result<(), TestCaseError> {
    prop_assert_eq!(float.slots(), exact.slots());
    let expected = exact.map(Rational::to_f64);
    let places =
        float.components().map(|(at, _)| at).chain(expected.components().map(|(at, _)| at));
    for at in places {
        let difference = (float.get(&at) - expected.get(&at)).abs();
        prop_assert!(difference <= error, "{at:?}: {} for {}", float.get(&at), expected.get(&at));
    }
    Ok(())
}

properties! {
    #![cases(48)]

    #[test]
    fn floats_follow_exact_values(space in spaces(5)) {
        let (algebra, metric, connections) = floats(&space);
        prop_assert_eq!(algebra.labels(), space.algebra.labels());
        prop_assert_eq!(connections[0].frame().labels(), space.algebra.labels());
        let c = largest(algebra.structure_constants());
        near(&algebra.killing_form(), &space.algebra.killing_form(), 1e-12 * (1.0 + c * c))?;
        // a metric that is nearly degenerate has additional errors
        let condition = 1.0 + largest(metric.inverse()) * largest(metric.components());
        near(metric.inverse(), space.metric.inverse(), 1e-12 * condition * condition)?;
        for (float, exact) in connections.iter().zip(&space.connections()) {
            let size = 1.0 + c + largest(float.affinities());
            let error = 1e-12 * condition * condition * size * size;
            near(float.affinities(), exact.affinities(), error)?;
            near(&float.torsion(), &exact.torsion(), error)?;
            near(float.curvature(), exact.curvature(), error)?;
            near(&float.ricci(), &exact.ricci(), error)?;
            let (q, g) = (float.nonmetricity(&metric)?, 1.0 + largest(metric.components()));
            near(&q, &exact.nonmetricity(&space.metric)?, error * g)?;
        }
    }
}

/// With small integers and their halves, thirds and fifths, a float is zero where the exact value is.
#[test]
fn zeros_agree_where_all_is_well_scaled() {
    for (name, algebra) in seeds() {
        let n = algebra.dimension();
        let g = Tensor::from_fn(n, [Down, Down], |[i, j]| match i == j {
            true => fraction(i as i64 + 1, 3),
            false => integer(0),
        });
        let metric = Metric::new(algebra.labels(), g.unwrap()).unwrap();
        let affinities = Tensor::from_fn(n, [Up, Down, Down], |[i, j, k]| {
            fraction((i * 5 + j * 3 + k) as i64 % 4 - 1, 5)
        });
        let affinities = affinities.unwrap();
        for lambda in [integer(0), integer(1), fraction(1, 2), fraction(1, 3), fraction(-7, 5)] {
            let (metric, affinities) = (metric.clone(), affinities.clone());
            let space = Space { algebra: algebra.clone(), lambda, metric, affinities };
            let (_, _, connections) = floats(&space);
            let places = |tensor: &Tensor<f64>| {
                stored(tensor).into_iter().map(|(at, _)| at).collect::<Vec<_>>()
            };
            for (float, exact) in connections.iter().zip(&space.connections()) {
                let exactly = |tensor: &Tensor<Rational>| places(&tensor.map(Rational::to_f64));
                assert_eq!(places(float.affinities()), exactly(exact.affinities()), "{name}");
                assert_eq!(places(&float.torsion()), exactly(&exact.torsion()), "{name}");
                assert_eq!(places(float.curvature()), exactly(exact.curvature()), "{name}");
                assert_eq!(places(&float.ricci()), exactly(&exact.ricci()), "{name}");
                assert!(float.bianchi_first().is_empty(), "{name}");
                assert!(float.bianchi_second().is_empty(), "{name}");
            }
        }
    }
}

properties! {
    #![cases(16)]

    /// A metric `diag(J1, J2, ...)` with parameters that are set afterwards.
    #[test]
    fn parameters_may_be_set_late(
        (name, algebra) in prop::sample::select(seeds()).prop_filter("small", |(_, a)| a.dimension() <= 4),
        moments in proptest::collection::vec((1i64..6, 1i64..4), 4),
        lambda in -3i64..4,
    ) {
        let n = algebra.dimension();
        let numbers: Vec<_> = moments.iter().map(|&(p, q)| fraction(p, q)).collect();
        let diagonal = |at: [usize; 2]| (at[0] == at[1]).then_some(at[0]);
        let names: Vec<_> = (1..=n).map(|at| format!("J{at}")).collect();
        let symbol = |at: usize| Symbolic::parameter(&names[at]);
        let mut values: BTreeMap<_, _> = names
            .iter()
            .cloned()
            .zip(numbers.iter().map(|v| Symbolic::constant(v.clone())))
            .collect();
        values.insert("lambda".into(), Symbolic::constant(integer(lambda)));
        let set = |tensor: &Tensor<Symbolic>| tensor.map(|v| v.substitute(&values).unwrap());
        let constant = |tensor: &Tensor<Rational>| tensor.map(|v| Symbolic::constant(v.clone()));

        let exact_g = Tensor::from_fn(n, [Down, Down], |at| {
            diagonal(at).map_or(integer(0), |i| numbers[i].clone())
        })?;
        let exact_metric = Metric::new(algebra.labels(), exact_g).unwrap();
        let exact = Connection::levi_civita(algebra.left_frame(), &exact_metric).unwrap();
        let symbolic = algebra.map(|v| Symbolic::constant(v.clone())).unwrap();
        let g = Tensor::from_fn(n, [Down, Down], |at| {
            diagonal(at).map_or(Symbolic::constant(integer(0)), symbol)
        })?;
        let metric = Metric::new(symbolic.labels(), g).unwrap();
        let late = Connection::levi_civita(symbolic.left_frame(), &metric).unwrap();
        prop_assert_eq!(set(late.affinities()), constant(exact.affinities()), "{}", name);
        prop_assert_eq!(set(late.curvature()), constant(exact.curvature()), "{}", name);
        let scalar = late.scalar_curvature(&metric).unwrap().substitute(&values);
        let expected = exact.scalar_curvature(&exact_metric).unwrap();
        prop_assert_eq!(scalar, Some(Symbolic::constant(expected)));

        let family = Connection::cartan_schouten(&symbolic, &Symbolic::parameter("lambda"));
        let number = Connection::cartan_schouten(&algebra, &integer(lambda));
        prop_assert_eq!(set(family.curvature()), constant(number.curvature()));
        prop_assert_eq!(set(&family.torsion()), constant(&number.torsion()));
    }
}

properties! {
    #![cases(48)]

    /// The Levi-Civita connection has no torsion in floats either, not even rounding errors.
    #[test]
    fn levi_civita_in_floats_has_no_torsion(space in spaces(6)) {
        let (_, metric, [_, _, levi_civita]) = floats(&space);
        prop_assert!(levi_civita.torsion().is_empty(), "{:?}", levi_civita.torsion());
        let mirrored = metric.inverse().permute(&[1, 0]).unwrap();
        prop_assert_eq!(metric.inverse(), &mirrored);
    }

    /// Matrices whose zeros are only approximate: so(3), sl(2) and sl(3) conjugated by rotations in
    /// every plane. The structure constants do not change.
    #[test]
    fn rotated_matrices_close_in_floats(
        angles in prop::collection::vec(-3.0..3.0f64, 3),
        which in 0..3usize,
    ) {
        let unit = |i: usize, j: usize, n: usize| {
            let mut matrix = nalgebra::DMatrix::<f64>::zeros(n, n);
            matrix[(i, j)] = 1.0;
            matrix
        };
        let pairs = |n: usize| (0..n).flat_map(move |i| (0..n).map(move |j| (i, j)));
        let n = [3, 2, 3][which];
        let basis: Vec<_> = match which {
            0 => pairs(n).filter(|(i, j)| i < j).map(|(i, j)| unit(i, j, n) - unit(j, i, n)).collect(),
            _ => pairs(n).filter(|&at| at != (n - 1, n - 1)).map(|(i, j)| match i == j {
                true => unit(i, i, n) - unit(i + 1, i + 1, n),
                false => unit(i, j, n),
            }).collect(),
        };
        let mut rotation = nalgebra::DMatrix::<f64>::identity(n, n);
        for ((i, j), angle) in pairs(n).filter(|(i, j)| i < j).zip(&angles) {
            let (sin, cos) = angle.sin_cos();
            let mut plane = nalgebra::DMatrix::identity(n, n);
            (plane[(i, i)], plane[(j, j)], plane[(i, j)], plane[(j, i)]) = (cos, cos, -sin, sin);
            rotation *= plane;
        }
        let structure = |basis: &[nalgebra::DMatrix<f64>]| {
            let entries = basis.iter().map(|matrix| {
                pairs(n).map(|(i, j)| (i, j, Complex::real(matrix[(i, j)]))).collect()
            });
            let names: Vec<String> = (1..=basis.len()).map(|i| format!("e{i}")).collect();
            let basis = MatrixBasis::new(names, n, entries.collect(), Tolerance::default());
            LieAlgebra::try_from(basis.unwrap().bracket().unwrap()).unwrap().structure_constants().clone()
        };
        let rotated: Vec<_> =
            basis.iter().map(|matrix| &rotation * matrix * rotation.transpose()).collect();
        let (expected, found) = (structure(&basis), structure(&rotated));
        prop_assert_eq!(found.len(), expected.len(), "{:?}", found);
        for (at, value) in expected.components() {
            prop_assert!((found.get(&at) - value).abs() < 1e-12);
        }
    }
}
