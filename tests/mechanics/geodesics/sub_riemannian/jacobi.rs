//! The differential of the exponential map and conjugate times: closed forms on the Heisenberg group,
//! SO(3) and SL(2), and elliptic functions on SE(2). Other tests use differences, and extremals without
//! regular times.

use super::*;
use affinor::mechanics::geodesics::sub_riemannian::Conjugacy;
use std::f64::consts::{PI, TAU};

fn first(space: &SubRiemannianGroup, p: &DVector<f64>, end: f64) -> Option<(f64, usize)> {
    match space.first_conjugate(p, end).unwrap() {
        Conjugacy::At { time, multiplicity } => Some((time, multiplicity)),
        Conjugacy::None { until } => {
            assert_eq!(until, end, "the search for {p} ended early");
            None
        }
        Conjugacy::Abnormal => panic!("the extremal of {p} is not abnormal"),
    }
}

fn assert_conjugate(space: &SubRiemannianGroup, p: &DVector<f64>, expected: f64, count: usize) {
    let found = first(space, p, 3.0 * expected);
    let (time, multiplicity) = found.unwrap_or_else(|| panic!("no conjugate time for {p}"));
    assert!((time / expected - 1.0).abs() < 1e-10, "{time} is not {expected}, for {p}");
    assert_eq!(multiplicity, count, "{p}");
    // the time is included, and a shorter time is not conjugate
    assert!(first(space, p, expected).is_some() && first(space, p, 0.999 * expected).is_none());
    let [there, before] = [1.0, 0.8].map(|part| space.distortion(p, part * expected).unwrap());
    assert!(there.abs() < 1e-9 * before.abs(), "{there} and {before}");
}

/// On the Heisenberg group, the first conjugate time is `2 pi/|p3|`.
#[test]
fn full_circles() {
    let space = first_two("heisenberg(3)");
    for p in [[1.0, 0.0, 1.0], [0.3, -0.4, -5.0], [10.0, 2.0, 0.01], [1e-3, 0.0, 2.0]] {
        assert_conjugate(&space, &DVector::from_row_slice(&p), TAU / p[2].abs(), 1);
    }
    assert_eq!(first(&space, &dvector![1.0, 2.0, 0.0], 1e3), None);
}

/// On the Heisenberg group, the determinant is `r^2 t^5 (2 - 2 cos a - a sin a)/a^4`, where `a = p3 t`
/// (R. Monti, *Calc. Var.* 12 (2001)).
#[test]
fn volume_distortion_of_the_heisenberg_group() {
    let space = first_two("heisenberg(3)");
    for (p, t) in [([0.6_f64, 0.9, 2.0], 1.0), ([1.0, -1.0, 0.4], 5.0), ([0.1, 0.0, -3.0], 2.5)] {
        let a: f64 = p[2] * t;
        let shape = (2.0 - 2.0 * a.cos() - a * a.sin()) / a.powi(4);
        let expected = (p[0] * p[0] + p[1] * p[1]) * t.powi(5) * shape;
        let found = space.distortion(&DVector::from_row_slice(&p), t).unwrap();
        assert!((found - expected).abs() < 1e-10 * expected.abs(), "{found} is not {expected}");
    }
}

/// On SO(3) with two orthonormal axes, the first conjugate time is `2 pi/|p|`: then
/// `exp(t p) = 1` for all covectors of this length.
#[test]
fn rotations() {
    let space = first_two("so(3)");
    for p in [dvector![1.0, 0.0, 0.0], dvector![0.6, 0.8, 1.5]] {
        let found = first(&space, &p, 20.0).unwrap();
        assert!((found.0 - TAU / p.norm()).abs() < 1e-10, "{found:?}");
        assert_conjugate(&space, &p, TAU / p.norm(), 1);
    }
}

/// On SL(2) with the symmetric matrices, `x = a - k` is elliptic if `p_k^2 > |a|^2`, with the period
/// `pi/sqrt(p_k^2 - |a|^2)` up to the centre; the same time is conjugate. Otherwise, no time is.
#[test]
fn symmetric_matrices() {
    let space = space("sl(2)", &[&[(0, 1.0), (1, 1.0)], &[(2, 1.0)]]);
    let covector = |x: f64, h: f64, k: f64| dvector![0.5 * (x + k), 0.5 * (x - k), h];
    for (x, h, k) in [(0.6, 0.8, 1.5), (0.2, 0.1, -0.7)] {
        let rate = f64::sqrt(k * k - x * x - h * h);
        assert_conjugate(&space, &covector(x, h, k), PI / rate, 1);
    }
    assert_eq!(first(&space, &covector(0.6, 0.8, 0.9), 20.0), None);
}

/// A Riemannian metric is the case of the whole algebra. On SO(3) with the bi-invariant metric, all
/// directions across the curve are conjugate after a full turn.
#[test]
fn multiplicity_of_a_riemannian_metric() {
    let so3 = space("so(3)", &[&[(0, 1.0)], &[(1, 1.0)], &[(2, 1.0)]]);
    assert_conjugate(&so3, &dvector![0.0, 0.6, 0.8], TAU, 2);
    let plane = space("R^2", &[&[(0, 1.0)], &[(1, 1.0)]]);
    assert_eq!(first(&plane, &dvector![1.0, 1.0], 100.0), None);
}

/// Zeros of the derivative of elliptic functions; see tests/references/sub_riemannian.py.
#[test]
fn conjugate_times_of_elliptic_functions() {
    let space = first_two("se(2)");
    for (p, expected) in [
        (
            [
                0.9324889607607620411335152,
                -0.3611984746082325170110724,
                -1.196676924629486623772584,
            ],
            4.805660501804943890245316,
        ),
        (
            [0.7957882308235568883838431, 0.6055750091299287940747076, -1.552757768003452763753485],
            3.828963156429710663744924,
        ),
    ] {
        assert_conjugate(&space, &DVector::from_row_slice(&p), expected, 1);
    }
    for p in [
        [0.972174183501504011548567, -0.2342591661668418159649647, -0.7649330971181832674932879],
        [0.900262861131486571399117, -0.435346736369241345299385, -0.2459130316446248745220972],
    ] {
        assert_eq!(first(&space, &DVector::from_row_slice(&p), 12.0), None);
    }
}

/// The differential agrees with central differences, on all groups.
#[test]
fn differences() {
    for space in all() {
        let (group, p) = (space.group(), covector(space.group().dimension()));
        let back = group.inverse(&end(&space, &p, 0.5));
        let found = space.differential(&p, 0.5).unwrap();
        for j in 0..p.len() {
            let moved = |by: f64| {
                let mut other = p.clone();
                other[j] += by;
                group.log(&group.compose(&back, &end(&space, &other, 0.5))).unwrap()
            };
            let expected = (moved(1e-4) - moved(-1e-4)) / 2e-4;
            assert_close(&found.column(j).into(), &expected, 1e-7 * found.amax().max(1.0));
        }
    }
}

/// Straight lines of the Engel group along `X2` and all straight lines of the Cartan group are
/// abnormal as well: the differential is singular at all times.
#[test]
fn extremals_that_are_also_abnormal() {
    let engel = first_two("filiform(4)");
    let line = dvector![0.0, 2.0, 0.0, 0.0];
    assert_eq!(engel.first_conjugate(&line, 10.0).unwrap(), Conjugacy::Abnormal);
    assert!(engel.distortion(&line, 3.0).unwrap().abs() < 1e-12);
    assert_eq!(first(&engel, &dvector![2.0, 0.0, 0.0, 0.0], 10.0), None);
    assert!(engel.distortion(&dvector![2.0, 0.0, 0.0, 0.0], 3.0).unwrap().abs() > 1e-3);
    let cartan = first_two("free_nilpotent(2,3)");
    for p in [dvector![1.0, 0.0, 0.0, 0.0, 0.0], dvector![0.6, -0.8, 0.0, 0.0, 0.0]] {
        assert_eq!(cartan.first_conjugate(&p, 2.0).unwrap(), Conjugacy::Abnormal);
        assert_eq!(cartan.first_conjugate(&p, 1e-3).unwrap(), Conjugacy::Abnormal);
    }
    // a distribution that does not generate the algebra
    let line = space("se(2)", &[&[(0, 1.0)]]);
    assert_eq!(line.first_conjugate(&dvector![1.0, 0.0, 0.0], 1.0).unwrap(), Conjugacy::Abnormal);
}

/// Conjugate times scale with the covector, and depend on no other orthonormal basis.
#[test]
fn conjugate_times_scale() {
    for space in [first_two("filiform(4)"), first_two("free_nilpotent(2,3)"), first_two("se(2)")] {
        let p = covector(space.group().dimension());
        let (time, multiplicity) = first(&space, &p, 20.0).unwrap();
        for factor in [1e-3, 0.5, 40.0] {
            let (other, count) = first(&space, &(&p * factor), 20.0 / factor).unwrap();
            assert!(
                (other * factor / time - 1.0).abs() < 1e-9,
                "{other} times {factor} is not {time}"
            );
            assert_eq!(count, multiplicity);
        }
        let [before, after] = [0.99, 1.01].map(|part| space.distortion(&p, part * time).unwrap());
        assert!(before * after < 0.0, "{before} and {after} have the same sign");
    }
}

#[test]
fn invalid_times() {
    let space = first_two("se(2)");
    for time in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let error = space.first_conjugate(&covector(3), time).unwrap_err();
        assert!(error.to_string().contains("invalid time"), "{error}");
    }
}
