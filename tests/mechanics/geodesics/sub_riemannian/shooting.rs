//! Normal geodesics between two elements: closed distances, round trips, and messages.

use super::*;
use affinor::mechanics::geodesics::sub_riemannian::Conjugacy;
use affinor::mechanics::geodesics::{HorizontalGeodesic, HorizontalShooting, find};

fn problem(space: &SubRiemannianGroup, to: &DVector<f64>) -> HorizontalShooting {
    HorizontalShooting::new(space.clone(), space.group().identity(), to.clone()).unwrap()
}

fn joined(space: &SubRiemannianGroup, to: &DVector<f64>, count: usize) -> Vec<HorizontalGeodesic> {
    find(&problem(space, to), Some(count)).unwrap()
}

/// The distance from the identity to `(x, 0, z)` on the Heisenberg group is `x (a/2)/sin(a/2)`, where
/// `(a - sin a)/(8 sin(a/2)^2) = z/x^2`; to `(0, 0, z)`, it is `2 sqrt(pi |z|)`.
#[test]
fn distances_of_the_heisenberg_group() {
    let space = first_two("heisenberg(3)");
    for (x, a) in [(1.0_f64, 2.0_f64), (0.1, 5.0), (3.0, -1.0)] {
        let half = f64::sin(a / 2.0);
        let z = x * x * (a - a.sin()) / (8.0 * half * half);
        let problem = problem(&space, &space.group().exp(&dvector![x, 0.0, z]));
        let found = find(&problem, Some(32)).unwrap();
        let expected = x * (a / 2.0) / half;
        assert!((found[0].length / expected - 1.0).abs() < 1e-9, "{} for {a}", found[0].length);
        assert!((found[0].covector[2] - a).abs() < 1e-8 * a.abs(), "{}", found[0].covector);
        let conjugacy = problem.conjugacy(&found[0]).unwrap();
        assert_eq!(conjugacy, Conjugacy::None { until: 1.0 });
    }
    let problem = problem(&space, &space.group().exp(&dvector![0.0, 0.0, 0.5]));
    let vertical = find(&problem, Some(32)).unwrap();
    let expected = 2.0 * f64::sqrt(0.5 * std::f64::consts::PI);
    assert!((vertical[0].length / expected - 1.0).abs() < 1e-7, "{}", vertical[0].length);
    let conjugacy = problem.conjugacy(&vertical[0]).unwrap();
    assert!(matches!(conjugacy, Conjugacy::At { time, .. } if (time - 1.0).abs() < 1e-6));
}

/// A short extremal is found again from its end, on all groups.
#[test]
fn short_extremals_are_found_again() {
    for space in all() {
        let p = covector(space.group().dimension()) * 0.8;
        let to = end(&space, &p, 1.0);
        // steps of larger groups are more expensive
        let found = joined(&space, &to, if p.len() == 3 { 8 } else { 2 });
        assert!(found[0].length <= space.speed(&p) * (1.0 + 1e-9), "{}", found[0].length);
        assert!(
            found.iter().any(|geodesic| (&geodesic.covector - &p).amax() < 1e-7),
            "{} is not among {found:?}",
            p.transpose()
        );
        for geodesic in &found {
            let reached = end(&space, &geodesic.covector, 1.0);
            assert!((reached - &to).amax() < 1e-8 || space.group().dimension() == 3);
        }
    }
}

/// The length does not depend on the point from which both ends are seen.
#[test]
fn left_translations() {
    let space = first_two("se(2)");
    let group = space.group();
    let (start, step) = (group.exp(&dvector![0.4, 1.0, -2.0]), group.exp(&dvector![1.0, 0.5, 0.8]));
    let to = group.compose(&start, &step);
    let problem = HorizontalShooting::new(space.clone(), start, to).unwrap();
    let moved = find(&problem, Some(16)).unwrap();
    let found = joined(&space, &step, 16);
    assert!((moved[0].length - found[0].length).abs() < 1e-9);
}

#[test]
fn errors_of_ends() {
    let space = first_two("se(2)");
    let identity = space.group().identity();
    let new = |space: &SubRiemannianGroup, to: &DVector<f64>| {
        HorizontalShooting::new(space.clone(), identity.clone(), to.clone())
            .unwrap_err()
            .to_string()
    };
    let same = new(&space, &identity);
    assert!(same.contains("is the start point"), "{same}");
    let line = self::space("se(2)", &[&[(0, 1.0)]]);
    let unreachable = new(&line, &space.group().exp(&dvector![1.0, 1.0, 0.0]));
    assert!(unreachable.contains("does not generate the algebra"), "{unreachable}");
}
