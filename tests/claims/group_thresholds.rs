//! Closed forms and series of the groups on both sides of every threshold between them, compared
//! with the series in `ad` in exact fractions.
//!
//! Guards `exp`, `log` and tangent operators in `group::groups`, and `numerics::{exponential, stumpff}`.

use affinor::group::{Coordinates, LieGroup, Opposite, Se2, Se3, Se23, Sl2, So3};
use affinor::numerics::exponential::{exp, phi1};
use affinor_tensors::{Rational, Ring};
use nalgebra::{DMatrix, DVector, Vector3};

/// Squares of angles at which [`Stumpff`](affinor::numerics::stumpff::Stumpff) and related
/// functions change from eight terms to more, and from these to closed forms. For half angles there
/// are four times these squares, too.
const THRESHOLDS: [f64; 7] = [0.4, 1.6, 2.25, 9.0, 10.0, 36.0, 40.0];

type Exact = Vec<Rational>;

fn norm<V: Coordinates>(x: &V) -> f64 {
    DVector::from_column_slice(x.components()).norm()
}

fn exact<V: Coordinates>(x: &V) -> Exact {
    x.components().iter().map(|c| Rational::from_f64(*c).unwrap()).collect()
}

/// The nonzero structure constants.
fn constants<G: LieGroup>(group: &G) -> Vec<([usize; 3], Rational)> {
    let mut constants = vec![];
    for (j, x) in group.basis().iter().enumerate() {
        for (k, y) in group.basis().iter().enumerate() {
            let bracket = exact(&group.bracket(x, y));
            let nonzero = bracket.into_iter().enumerate().filter(|(_, value)| !value.vanishes());
            constants.extend(nonzero.map(|(i, value)| ([i, j, k], value)));
        }
    }
    constants
}

/// `sum_k s^k ad_x^k v/(k + shift)!`: `Ad_exp(x) v` with `s = 1` and no shift, `T_left(x) v` with
/// `s = -1` and shift 1. Terms follow up to 1e-25.
fn series<G: LieGroup>(group: &G, x: &G::Vector, v: &Exact, s: i64, shift: i64) -> Exact {
    let (constants, x) = (constants(group), exact(x));
    let (mut sum, mut term) = (v.clone(), v.clone());
    for k in 1.. {
        let share = Rational::new(s, k + shift).unwrap();
        let mut next = vec![Rational::from(0); v.len()];
        for ([i, j, l], c) in &constants {
            let part = c.clone() * &x[*j] * &term[*l] * &share;
            next[*i] = next[*i].clone() + &part;
        }
        term = next;
        for (sum, term) in sum.iter_mut().zip(&term) {
            *sum = sum.clone() + term;
        }
        if k > 8 && term.iter().all(|c| c.to_f64().abs() < 1e-25) {
            break;
        }
    }
    sum
}

/// The distance in units of the machine precision, relative to `1 + |x|` and to the size of the
/// result and its argument.
fn off<V: Coordinates>(found: &V, expected: &Exact, x: &V, v: &V) -> f64 {
    let floats = expected.iter().map(Rational::to_f64).collect::<Vec<_>>();
    let differences =
        exact(found).into_iter().zip(expected).map(|(a, b)| (a - b).to_f64()).collect::<Vec<_>>();
    let size = DVector::from_vec(floats).norm().max(norm(v));
    DVector::from_vec(differences).norm() / size / (1.0 + norm(x)) / f64::EPSILON
}

/// A number with few digits, so that the fractions of the series remain short.
fn rounded(x: f64) -> f64 {
    (x * f64::from(1 << 20)).round() / f64::from(1 << 20)
}

/// Directions of small integers, scaled to lengths around a threshold of `z`, the square of the
/// angle.
fn around<G: LieGroup>(
    group: &G,
    z: impl Fn(&G::Vector) -> f64,
    threshold: f64,
) -> Vec<(G::Vector, G::Vector)> {
    let n = group.dimension();
    let mut points = vec![];
    for seed in 0..4usize {
        let small =
            |at: usize, seed: usize| ((at * 7 + seed * 5 + at * at * seed) % 7) as f64 - 3.0;
        let direction = G::Vector::from_fn(n, |at| small(at, seed) + 0.5);
        let v = G::Vector::from_fn(n, |at| small(at, seed + 3) + 0.25);
        for ratio in [0.9, 1.0 - 4e-6, 1.0 + 4e-6, 1.1] {
            let length = (threshold * ratio / z(&direction).abs()).sqrt();
            points.push((direction.clone() * rounded(length), v.clone()));
        }
    }
    points
}

/// Compares `off` with a bound.
fn bounded<V: Coordinates>(name: &str, x: &V, off: f64, bound: f64) {
    assert!(off <= bound, "{name} at {:?} is off by {off} eps", x.components());
}

fn on_both_sides<G: LieGroup>(name: &str, group: &G, z: impl Fn(&G::Vector) -> f64) {
    for threshold in THRESHOLDS {
        for (x, v) in around(group, &z, threshold) {
            let exactly = exact(&v);
            let moved = series(group, &x, &exactly, 1, 0);
            let adjoint = group.adjoint(&group.exp(&x), &v);
            bounded(&format!("{name}: Ad_exp"), &x, off(&adjoint, &moved, &x, &v), 4.0);
            let left = series(group, &x, &exactly, -1, 1);
            let tangent = group.tangent_left(&x, &v);
            bounded(&format!("{name}: T_left"), &x, off(&tangent, &left, &x, &v), 4.0);
            // the pairing of Ad*_exp(x) h with v is that of h with Ad_exp(x) v
            let h = G::Vector::from_fn(group.dimension(), |at| (at as f64 - 1.0) * 0.5);
            let pulled = exact(&group.coadjoint_exp(&x, &h));
            let pairing = |a: &Exact, b: &Exact| {
                a.iter().zip(b).fold(Rational::from(0), |sum, (a, b)| sum + &(a.clone() * b))
            };
            let difference = pairing(&pulled, &exactly) - pairing(&exact(&h), &moved);
            let length = moved.iter().map(|c| c.to_f64().powi(2)).sum::<f64>().sqrt();
            let size = norm(&h) * length.max(norm(&v)) * (1.0 + norm(&x)) * f64::EPSILON;
            let pulled = difference.to_f64().abs() / size;
            bounded(&format!("{name}: Ad*_exp"), &x, pulled, 4.0);
            // T_left applied to the result of the inverse is the vector again; near a pole the
            // inverse is large
            let back = group.tangent_left_inverse(&x, &v).unwrap();
            let again = series(group, &x, &exact(&back), -1, 1);
            let condition = (1.0 + norm(&back) / norm(&v)) * (1.0 + norm(&x));
            let back = off(&v, &again, &x, &back) / condition;
            bounded(&format!("{name}: the inverse of T_left"), &x, back, 8.0);
        }
    }
}

#[test]
fn rotations_and_motions() {
    let space = |x: &[f64]| x[..3].iter().map(|c| c * c).sum::<f64>();
    on_both_sides("SO(3)", &So3, |x| space(x.components()));
    on_both_sides("SO(3), opposite", &Opposite(So3), |x| space(x.components()));
    on_both_sides("SE(3)", &Se3, |x| space(x.components()));
    on_both_sides("SE_2(3)", &Se23, |x| space(x.components()));
    on_both_sides("SE(2)", &Se2, |x| x[0] * x[0]);
    on_both_sides("SL(2,R)", &Sl2, |x| 4.0 * (-x[2] * x[2] - x[0] * x[1]));
}

/// Beyond an angle of 1e20 a tangent operator is replaced by its mean over a turn. On both sides of
/// the threshold the operators agree to rounding error, because their terms beyond the mean are
/// below 1e-20.
#[test]
fn very_many_turns() {
    let near = |a: &[f64], b: &[f64], size: f64| {
        let off = a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        assert!(off <= 1e-14 * size, "{a:?} and {b:?}");
    };
    for axis in [Vector3::new(0.6, -0.48, 0.64), Vector3::new(0.0, 1.0, 0.0)] {
        let v = Vector3::new(1.0, 2.0, -3.0);
        let [below, above] =
            [1e20 * (1.0 - 1e-12), 1e20 * (1.0 + 1e-12)].map(|length| axis * length);
        let mean = axis * axis.dot(&v);
        for x in [below, above] {
            near(So3.tangent_left(&x, &v).as_slice(), mean.as_slice(), 4.0);
            let kept = So3.coadjoint_exp(&x, &v);
            assert!(
                (kept.norm() - v.norm()).abs() < 1e-14
                    && (kept.dot(&axis) - v.dot(&axis)).abs() < 1e-14
            );
        }
    }
}

/// A nilpotent matrix has an exponential even if the squares of its entries overflow.
#[test]
fn large_nilpotent_matrices() {
    for entry in [1e149, 1e150, 1.1e150, 1e200, 1e300] {
        for x in [Vector3::new(entry, 0.0, 0.0), Vector3::new(0.0, -entry, 0.0)] {
            let g = Sl2.exp(&x);
            assert_eq!([g[(0, 0)], g[(1, 1)]], [1.0, 1.0]);
            assert_eq!([g[(0, 1)], g[(1, 0)]], [x[0], x[1]]);
            assert_eq!(Sl2.log(&g).unwrap(), x);
        }
    }
}

/// Above a size of 1e8 the matrix is scaled before its exponential is computed: a rotation on both
/// sides of this size.
#[test]
fn exponentials_of_large_matrices() {
    for angle in [4.9e7, 4.999_999e7, 5.000_001e7, 5.1e7, 3e8] {
        let m = DMatrix::from_row_slice(2, 2, &[0.0, -angle, angle, 0.0]);
        let (sin, cos) = f64::sin_cos(angle);
        let rotation = DMatrix::from_row_slice(2, 2, &[cos, -sin, sin, cos]);
        let off = (exp(&m) - rotation).amax();
        assert!(off <= 4.0 * angle * f64::EPSILON, "at {angle:e}: {off:e}");
        let mean = DMatrix::from_row_slice(2, 2, &[sin, cos - 1.0, 1.0 - cos, sin]) / angle;
        let off = (phi1(&m) - mean).amax();
        assert!(off <= 4.0 * angle * f64::EPSILON, "the integral at {angle:e}: {off:e}");
    }
}
