//! Frames by closures in floats agree with the exact functions at the same point.

use crate::common::charts::{Moved, constant, euler_angles, value};
use crate::common::labels;
use affinor::{Connection, Error, Frame, Metric};
use affinor_tensors::{Down, Jet, Ring, Symbolic, Tensor, Variance};

const POINT: [f64; 3] = [0.4, 1.1, -0.7];

fn euler(x: &[Jet], at: [usize; 2]) -> Jet {
    let ([st, ct], [sp, cp]) = ([x[1].sin(), x[1].cos()], [x[2].sin(), x[2].cos()]);
    let zero = Jet::constant(0.0);
    let rows = [
        [sp.clone() / &st, cp.clone() / &st, zero.clone()],
        [cp.clone(), -sp.clone(), zero],
        [-ct.clone() * &sp / &st, -ct * &cp / &st, Jet::constant(1.0)],
    ];
    rows[at[0]][at[1]].clone()
}

/// Expects equal components, up to rounding errors.
fn same(here: &Tensor<Jet>, exact: &Tensor<Symbolic>) {
    let at = |name: &str| ["phi", "theta", "psi"].iter().position(|n| *n == name).map(|a| POINT[a]);
    let all = (0..here.dimension().pow(here.rank() as u32)).map(|key| {
        (0..here.rank()).map(|slot| key / 3usize.pow(slot as u32) % 3).collect::<Vec<_>>()
    });
    for indices in all {
        let (u, v) = (here.get(&indices).value(), exact.get(&indices).evaluate(at).unwrap());
        assert!((u - v).abs() <= 1e-12 * (1.0 + v.abs()), "{indices:?}: {u}, {v}");
    }
}

#[test]
fn invariant_fields_by_closures() {
    let frame = Frame::at_point(labels(3), &POINT, euler).unwrap();
    let group = euler_angles();
    same(frame.structure_functions(), group.algebra.structure_constants());
    let g = |[i, j]: [usize; 2]| [[2, 1, 0], [1, 3, 0], [0, 0, 1]][i][j];
    let exact = Tensor::from_fn(3, [Down, Down], |at| constant(g(at))).unwrap();
    let exact = Metric::new(labels(3), exact).unwrap();
    let exact = Connection::levi_civita(group.algebra.left_frame(), &exact).unwrap();
    let metric = Tensor::from_fn(3, [Down, Down], |at| Jet::from_i64(g(at))).unwrap();
    let metric = Metric::new(labels(3), metric).unwrap();
    let here = Connection::levi_civita(&frame, &metric).unwrap();
    same(here.affinities(), exact.affinities());
    same(here.curvature(), exact.curvature());
    same(&here.bianchi_first(), &Tensor::zero(3, exact.curvature().slots()).unwrap());
}

/// A frame and a metric of functions: derivatives of both.
#[test]
fn functions_by_closures() {
    let group = euler_angles();
    let scales = ["exp(phi)", "1 + psi^2", "1"].map(value);
    let moved = Moved::scaled(&group, &scales, value("phi"));
    let frame = Frame::at_point(labels(3), &POINT, |x, [a, b]| {
        let one = Jet::constant(1.0);
        let scales = [x[0].exp(), one + &(x[2].clone() * &x[2]), Jet::constant(1.0)];
        let mixed = if b == 1 { x[0].clone() * &euler(x, [a, 0]) } else { Jet::constant(0.0) };
        euler(x, [a, b]) * &scales[b] + &mixed
    });
    let frame = frame.unwrap();
    same(frame.structure_functions(), &moved.structure_functions());
    let x: Vec<Jet> = (0..3).map(|a| Jet::coordinate(POINT[a], a, 3)).collect();
    let slots: [Variance; 2] = [Down, Down];
    let g = Tensor::from_fn(3, slots, |[i, j]| match (i, j) {
        (0, 0) => x[1].cos() + &Jet::constant(3.0),
        (0, 1) | (1, 0) => x[0].clone(),
        (1, 1) | (2, 2) => x[2].exp(),
        _ => Jet::constant(0.0),
    });
    let exact = Tensor::from_fn(3, slots, |[i, j]| match (i, j) {
        (0, 0) => value("cos(theta) + 3"),
        (0, 1) | (1, 0) => value("phi"),
        (1, 1) | (2, 2) => value("exp(psi)"),
        _ => constant(0),
    });
    let here = Connection::levi_civita(&frame, &Metric::new(labels(3), g.unwrap()).unwrap());
    let exact = Metric::new(labels(3), exact.unwrap()).unwrap();
    let exact = Connection::levi_civita(&moved.frame(), &exact).unwrap();
    let here = here.unwrap();
    same(here.affinities(), exact.affinities());
    same(here.curvature(), exact.curvature());
    same(&here.ricci(), &exact.ricci());
}

#[test]
fn fields_that_meet_at_the_point_are_refused() {
    let meet =
        |x: &[Jet], at: [usize; 2]| if at[1] == 0 { x[at[0]].clone() } else { Jet::constant(1.0) };
    let refused = Frame::at_point(labels(2), &[1.0, 1.0], meet);
    assert!(matches!(refused, Err(Error::SingularBasis)));
    assert!(Frame::at_point(labels(2), &[1.0, 2.0], meet).is_ok());
    assert!(matches!(Frame::at_point(labels(3), &[1.0, 2.0], meet), Err(Error::Shape { .. })));
}

/// A function of the coordinates.
type Function = fn(&[Jet]) -> Jet;

/// Two derivatives of the functions are known, and the curvature uses both. So its own derivatives
/// are unknown, even where it vanishes at the point.
#[test]
fn derivatives_of_a_curvature_that_vanishes_are_unknown() {
    fn one() -> Jet {
        Jet::constant(1.0)
    }
    let at = |metric: Function, n: usize| {
        let frame = Frame::at_point(labels(n), &vec![0.0; n], |_, at| {
            Jet::from_i64(i64::from(at[0] == at[1]))
        });
        let x: Vec<Jet> = (0..n).map(|a| Jet::coordinate(0.0, a, n)).collect();
        let metric =
            Metric::diagonal((0..n).map(|i| if i == 1 { metric(&x) } else { one() })).unwrap();
        (Connection::levi_civita(&frame.unwrap(), &metric).unwrap(), metric)
    };
    // (1 + x^3)^2: K = -6 x/(1 + x^3); 1 + x^4; a plane in other coordinates
    let functions: [Function; 3] = [
        |x| num_traits::pow(one() + &num_traits::pow(x[0].clone(), 3), 2),
        |x| one() + &num_traits::pow(x[0].clone(), 4),
        |x| num_traits::pow(one() + &x[0], 2),
    ];
    for (which, function) in functions.into_iter().enumerate() {
        for n in [2, 3] {
            let (connection, metric) = at(function, n);
            assert!(connection.torsion_free().holds().is_some());
            assert!(connection.metric_compatible(&metric).unwrap().holds().is_some());
            assert!(connection.bianchi_first().is_empty());
            assert!(connection.flat().holds().is_some(), "{which}");
            assert!(connection.nabla_curvature().get(&[0, 0, 1, 0, 1]).value().is_nan());
            let witness = connection.locally_symmetric().witness().unwrap();
            assert!(witness.residual.value().is_nan(), "{witness}");
            // zero at the point, but perhaps not nearby
            for property in
                [connection.einstein_constant(&metric), connection.constant_curvature(&metric)]
            {
                assert!(property.unwrap().witness().unwrap().residual.value().is_nan());
            }
        }
        let (connection, metric) = at(function, 3);
        assert!(connection.cotton(&metric).unwrap().components().all(|(_, v)| v.value().is_nan()));
        assert!(!connection.cotton(&metric).unwrap().is_empty());
    }
    // all derivatives of constants are known
    let (connection, metric) = at(|_| Jet::constant(2.0), 3);
    assert!(connection.locally_symmetric().holds().is_some());
    assert!(connection.constant_curvature(&metric).unwrap().holds().is_some());
    assert!(connection.cotton(&metric).unwrap().is_empty());
}
