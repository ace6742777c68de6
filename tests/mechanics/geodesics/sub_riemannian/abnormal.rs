//! Abnormal extremals of distributions of rank 2.

use super::*;

/// The abnormal extremals of the Engel group are the lines along `X2`.
#[test]
fn lines_of_the_engel_group() {
    let engel = first_two("filiform(4)");
    let start = engel.group().exp(&dvector![0.1, 0.2, -0.3, 0.4]);
    for (p4, sign) in [(1.0, -1.0), (-3.0, 1.0)] {
        let found = engel.abnormal(&start, &dvector![0.0, 0.0, 0.0, p4], &[1.0, 2.0]).unwrap();
        assert_eq!((found.points.len(), found.vanishes), (2, None));
        let line = engel.group().exp(&dvector![0.0, 2.0 * sign, 0.0, 0.0]);
        assert_close(&found.points[1].element, &engel.group().compose(&start, &line), 1e-13);
        // the opposite direction
        let back = engel.abnormal(&start, &dvector![0.0, 0.0, 0.0, p4], &[-2.0]).unwrap();
        let line = engel.group().exp(&dvector![0.0, -2.0 * sign, 0.0, 0.0]);
        assert_close(&back.points[0].element, &engel.group().compose(&start, &line), 1e-13);
    }
}

/// On the free group with the growth (2, 3, 5), abnormal extremals are straight lines, which are
/// also normal: none is strictly abnormal.
#[test]
fn no_strictly_abnormal_extremal_of_the_cartan_group() {
    let cartan = first_two("free_nilpotent(2,3)");
    let identity = cartan.group().identity();
    for (a, b) in [(1.0, 0.0), (0.3, -0.9), (-2.0, 5.0)] {
        let p = dvector![0.0, 0.0, 0.0, a, b];
        let found = cartan.abnormal(&identity, &p, &[1.5]).unwrap().points.remove(0);
        // in the Lyndon basis, h_112 = a and h_122 = -b
        let normal = dvector![-b, -a, 0.0, 0.0, 0.0] / f64::hypot(a, b);
        assert_close(&found.element, &end(&cartan, &normal, 1.5), 1e-12);
    }
}

/// On se(2) + R with a distribution of growth (2, 3, 4), the extremal satisfies the equations of abnormal
/// extremals, and has unit speed. Its direction does not depend on the basis.
#[test]
fn the_equations_hold_along_the_extremal() {
    let vectors: Vectors = &[&[(0, 1.0)], &[(1, 1.0), (3, 1.0)]];
    let space = space("se(2)+R^1", vectors);
    assert_eq!(space.growth_vector(), [2, 3, 4]);
    // p annihilates e1, p1 + z and p2
    let p = dvector![0.0, 1.0, 0.0, -1.0];
    let identity = space.group().identity();
    let found = space.abnormal(&identity, &p, &[0.5, 1.0, 3.0]).unwrap();
    assert_eq!(found.vanishes, None);
    for point in &found.points {
        let h = &point.covector;
        for value in [h[0], h[1] + h[3], h[2]] {
            assert!(value.abs() < 1e-12, "{h}");
        }
    }
    let swapped = self::space("se(2)+R^1", &[vectors[1], vectors[0]]);
    let other = swapped.abnormal(&identity, &p, &[0.5, 1.0, 3.0]).unwrap();
    for (point, other) in found.points.iter().zip(&other.points) {
        assert_close(&point.element, &other.element, 1e-12);
    }
}

/// On the free group of step 4, `h_112 = 1 - t` and `h_122 = 0` for a suitable covector: both vanish
/// at the time 1.
#[test]
fn a_time_at_which_the_direction_is_open() {
    let free = first_two("free_nilpotent(2,4)");
    let p = dvector![0.0, 0.0, 0.0, 1.0, 0.0, 0.0, -1.0, 0.0];
    let identity = free.group().identity();
    let found = free.abnormal(&identity, &p, &[0.5, 0.9, 2.0]).unwrap();
    assert_eq!(found.points.len(), 2);
    assert!((found.points[0].covector[3] - 0.5).abs() < 1e-12);
    assert!((found.vanishes.unwrap() - 1.0).abs() < 1e-6, "{:?}", found.vanishes);
    // and not in the opposite direction
    let back = free.abnormal(&identity, &p, &[-2.0]).unwrap();
    assert!(back.vanishes.is_none() && (back.points[0].covector[3] - 3.0).abs() < 1e-11);
}

#[test]
fn errors_of_abnormal_extremals() {
    let message = |space: &SubRiemannianGroup, p: DVector<f64>| {
        space.abnormal(&space.group().identity(), &p, &[1.0]).unwrap_err().to_string()
    };
    let engel = first_two("filiform(4)");
    for (p, expected) in [
        (dvector![1.0, 0.0, 0.0, 1.0], "h_1 = 1"),
        (dvector![0.0, 0.0, 2.0, 1.0], "h_12 = 2"),
        (dvector![0.0, 0.0, 0.0, 0.0], "it is zero"),
    ] {
        let found = message(&engel, p);
        assert!(found.contains(expected), "{found}");
    }
    let filiform = first_two("filiform(5)");
    let open = message(&filiform, dvector![0.0, 0.0, 0.0, 0.0, 1.0]);
    assert!(open.contains("leaves the direction open"), "{open}");
    let three = space("filiform(4)", &[&[(0, 1.0)], &[(1, 1.0)], &[(2, 1.0)]]);
    let rank = message(&three, dvector![0.0, 0.0, 0.0, 1.0]);
    assert!(rank.contains("rank 2 only") && rank.contains("the rank is 3"), "{rank}");
}
