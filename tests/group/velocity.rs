//! Body and spatial velocity of paths agree with differentiated matrices.

use affinor::Error;
use affinor::group::{Coordinates, LieGroup, MatrixGroup, Se3, Sl2, So3, Velocity};
use nalgebra::{DMatrix, DVector, Isometry3, Matrix2, Matrix3, UnitQuaternion, Vector3, Vector6};

/// `R = exp(a e_3) exp(b e_1)`, with `a = t + sin(2t)/2` and `b = 1 + t^2/3`.
fn angles(t: f64) -> ([f64; 2], [f64; 2]) {
    ([t + (2.0 * t).sin() / 2.0, 1.0 + t * t / 3.0], [1.0 + (2.0 * t).cos(), 2.0 * t / 3.0])
}

fn turned(t: f64) -> UnitQuaternion<f64> {
    let ([a, b], _) = angles(t);
    UnitQuaternion::from_axis_angle(&Vector3::z_axis(), a)
        * UnitQuaternion::from_axis_angle(&Vector3::x_axis(), b)
}

/// The matrices `R` and `dR/dt`, entry by entry.
fn matrices(t: f64) -> [Matrix3<f64>; 2] {
    let ([a, b], [da, db]) = angles(t);
    let ((sa, ca), (sb, cb)) = (a.sin_cos(), b.sin_cos());
    let z = Matrix3::new(ca, -sa, 0.0, sa, ca, 0.0, 0.0, 0.0, 1.0);
    let dz = Matrix3::new(-sa, -ca, 0.0, ca, -sa, 0.0, 0.0, 0.0, 0.0) * da;
    let x = Matrix3::new(1.0, 0.0, 0.0, 0.0, cb, -sb, 0.0, sb, cb);
    let dx = Matrix3::new(0.0, 0.0, 0.0, 0.0, -sb, -cb, 0.0, cb, -sb) * db;
    [z * x, dz * x + z * dx]
}

fn vect(m: Matrix3<f64>) -> Vector3<f64> {
    assert!((m + m.transpose()).norm() < 1e-14, "{m} is not skew");
    Vector3::new(m[(2, 1)], m[(0, 2)], m[(1, 0)])
}

/// The velocities `Omega` and `omega` by (5) and (7).
fn rotating(t: f64) -> Velocity<Vector3<f64>> {
    let [r, dr] = matrices(t);
    Velocity { body: vect(r.transpose() * dr), spatial: vect(dr * r.transpose()) }
}

fn position(t: f64) -> [Vector3<f64>; 2] {
    [Vector3::new(t.cos(), t * t, 2.0 - t), Vector3::new(-t.sin(), 2.0 * t, -1.0)]
}

fn moved(t: f64) -> Isometry3<f64> {
    Isometry3::from_parts(position(t)[0].into(), turned(t))
}

/// The twists `(Omega, R^T dp)` and `(omega, dp - omega x p)`: R. M. Murray, Z. Li, S. S. Sastry, *A
/// Mathematical Introduction to Robotic Manipulation* (1994), 2.4, there with the translation first.
fn moving(t: f64) -> Velocity<Vector6<f64>> {
    let (Velocity { body, spatial }, [p, dp]) = (rotating(t), position(t));
    let twist = |w: Vector3<f64>, u: Vector3<f64>| Vector6::new(w.x, w.y, w.z, u.x, u.y, u.z);
    let of_body = twist(body, matrices(t)[0].transpose() * dp);
    Velocity { body: of_body, spatial: twist(spatial, dp - spatial.cross(&p)) }
}

fn error<V: Coordinates>(found: &Velocity<V>, expected: &Velocity<V>) -> f64 {
    let off =
        |a: &V, b: &V| DVector::from_column_slice((a.clone() - b.clone()).components()).amax();
    off(&found.body, &expected.body).max(off(&found.spatial, &expected.spatial))
}

/// Times from 0.3 to 2.3 whose distances differ by factors of up to 3.
fn uneven(n: usize) -> Vec<f64> {
    let at = |i: usize| 0.3 + 2.0 * i as f64 / n as f64;
    (0..=n).map(|i| at(i) + 0.25 * (std::f64::consts::PI * at(i)).sin() / 2.0).collect()
}

fn orders<G: LieGroup>(
    group: &G,
    path: impl Fn(f64) -> G::Element,
    exact: impl Fn(f64) -> Velocity<G::Vector>,
) {
    // paths: order 6
    let of_path = |h: f64| error(&Velocity::of_path(group, &path, 0.7, h).unwrap(), &exact(0.7));
    let order = (of_path(0.4) / of_path(0.2)).log2();
    assert!((order - 6.0).abs() < 0.3, "paths: {order}");
    assert!(of_path(0.02) < 1e-11, "{}", of_path(0.02));
    // samples: order 4, in the interior and at both ends, for equal and unequal distances
    let even = |n: usize| (0..=n).map(|i| 0.3 + 2.0 * i as f64 / n as f64).collect::<Vec<_>>();
    for spaced in [&even as &dyn Fn(usize) -> Vec<f64>, &uneven] {
        let of_samples = |n: usize| -> [f64; 3] {
            let times = spaced(n);
            let samples: Vec<_> = times.iter().map(|t| path(*t)).collect();
            let found = Velocity::of_samples(group, &times, &samples).unwrap();
            assert_eq!(found.len(), times.len());
            let errors: Vec<f64> =
                found.iter().zip(&times).map(|(v, t)| error(v, &exact(*t))).collect();
            let largest = |part: &[f64]| part.iter().copied().fold(0.0, f64::max);
            [largest(&errors[..2]), largest(&errors[2..n - 1]), largest(&errors[n - 1..])]
        };
        let (coarse, fine) = (of_samples(80), of_samples(160));
        for (coarse, fine) in coarse.into_iter().zip(fine) {
            let order = (coarse / fine).log2();
            assert!((3.7..4.6).contains(&order), "samples: {order} from {coarse:e}, {fine:e}");
        }
        assert!(fine.iter().all(|error| *error < 1e-5), "{fine:?}");
    }
}

#[test]
fn rotations() {
    orders(&So3, turned, rotating);
}

#[test]
fn rigid_motions() {
    orders(&Se3, moved, moving);
}

/// `g = [[e^a, t^2], [0, e^-a]]` with `a = sin t`: `g^-1 g'` and `g' g^-1` by hand.
#[test]
fn matrices_of_size_two() {
    let path = |t: f64| Matrix2::new(t.sin().exp(), t * t, 0.0, (-t.sin()).exp());
    // e, f, h of [[h, e], [f, -h]]
    let exact = |t: f64| Velocity {
        body: Vector3::new((-t.sin()).exp() * (2.0 * t + t * t * t.cos()), 0.0, t.cos()),
        spatial: Vector3::new(t.sin().exp() * (2.0 * t - t * t * t.cos()), 0.0, t.cos()),
    };
    orders(&Sl2, path, exact);
    // the same matrices in a matrix group
    let unit = |i, j| DMatrix::from_fn(2, 2, |r, c| f64::from(u8::from((r, c) == (i, j))));
    let triangular = MatrixGroup::new(&[unit(0, 1), unit(0, 0) - unit(1, 1)]).unwrap();
    let path = |t: f64| DMatrix::from_column_slice(2, 2, path(t).as_slice());
    let plane = |v: Vector3<f64>| DVector::from_vec(vec![v[0], v[2]]);
    let exact = |t: f64| Velocity { body: plane(exact(t).body), spatial: plane(exact(t).spatial) };
    let found = Velocity::of_path(&triangular, path, 0.7, 0.02).unwrap();
    assert!(error(&found, &exact(0.7)) < 1e-11);
}

/// The velocities from coordinates and their time derivatives, and from either image to the other.
#[test]
fn given_derivatives() {
    let coordinates = |t: f64| Vector6::new(t, t * t, 0.3, -t, 1.0, t.sin());
    let rate = |t: f64| Vector6::new(1.0, 2.0 * t, 0.0, -1.0, 0.0, t.cos());
    let t = 0.8;
    let given = Velocity::in_coordinates(&Se3, &coordinates(t), &rate(t));
    let path = |t: f64| Se3.exp(&coordinates(t));
    assert!(error(&given, &Velocity::of_path(&Se3, path, t, 0.02).unwrap()) < 1e-11);
    let exact = moving(t);
    let g = moved(t);
    assert!(error(&Velocity::from_body(&Se3, &g, exact.body), &exact) < 1e-14);
    assert!(error(&Velocity::from_spatial(&Se3, &g, exact.spatial), &exact) < 1e-14);
}

/// Coordinates are continued past half a turn, where logarithms jump. Five samples per turn are
/// enough for a steady rotation, also at the ends, four steps from the last sample used.
#[test]
fn fast_spins() {
    let spin = Vector3::new(1.0, -2.0, 2.0) / 3.0;
    let times: Vec<f64> = (0..12).map(|i| i as f64 * 1.25).collect();
    let start = turned(0.4);
    let samples: Vec<_> =
        times.iter().map(|t| So3.compose(&start, &So3.exp(&(spin * *t)))).collect();
    for velocity in Velocity::of_samples(&So3, &times, &samples).unwrap() {
        assert!((velocity.body - spin).norm() < 1e-13);
        assert!((velocity.spatial - start * spin).norm() < 1e-13);
    }
}

#[test]
fn few_samples() {
    let two = Velocity::of_samples(&So3, &[0.0, 0.5], &[So3.identity(), So3.exp(&Vector3::x())]);
    for velocity in two.unwrap() {
        assert!((velocity.body - Vector3::x() * 2.0).norm() < 1e-15);
    }
    // three samples: exact for quadratic coordinates near the middle
    let x = |t: f64| Vector3::new(t + t * t, 0.0, -t);
    let times = [-0.3, 0.0, 0.5];
    let found = Velocity::of_samples(&So3, &times, &times.map(|t| So3.exp(&x(t)))).unwrap();
    assert!((found[1].body - Vector3::new(1.0, 0.0, -1.0)).norm() < 1e-14);
}

#[test]
fn what_is_no_path_is_refused() {
    let g = So3.identity();
    let message = |times: &[f64], n: usize| match Velocity::of_samples(&So3, times, &vec![g; n]) {
        Err(error @ Error::Shape { .. }) => error.to_string(),
        other => panic!("{other:?}"),
    };
    assert!(message(&[0.0], 1).contains("1 samples at 1 times"));
    assert!(message(&[0.0, 1.0, 2.0], 2).contains("2 samples at 3 times"));
    assert!(message(&[0.0, 1.0, 1.0], 3).contains("1 after 1"));
    assert!(message(&[0.0, f64::NAN], 2).contains("NaN after 0"));
    assert!(message(&[f64::NEG_INFINITY, 0.0], 2).contains("0 after -inf"));
    // elements of SL(2,R) such that the element between them has no logarithm
    let far = [Matrix2::identity(), Matrix2::new(-2.0, 0.0, 0.0, -0.5)];
    let refused = Velocity::of_samples(&Sl2, &[0.0, 1.0], &far).unwrap_err();
    assert!(matches!(refused, Error::Invalid { what: "logarithm", .. }), "{refused}");
}
