//! The extremes of sectional curvature agree with closed forms; the spaces of invariant metrics.

use crate::common::algebras::catalogued;
use crate::common::spaces::{named, rational};
use crate::common::{fraction, integer};
use affinor::algebra::structure::StructureTheory;
use affinor::geometry::properties::{Extreme, MAX_SEARCHED};
use affinor::{
    BasisChange, CanonicalConnection, Connection, Error, Frame, Geometry, Metric, Rational,
};
use affinor_tensors::{Down, Symbolic, Tensor, Up, contract};
use nalgebra::DMatrix;

/// The smallest and the largest curvature. Each is the curvature of its plane, and no coordinate
/// plane exceeds a proved extreme.
fn extremes(space: &Geometry<Rational>) -> [Extreme; 2] {
    let (metric, algebra) = (space.metric().unwrap(), space.algebra().unwrap());
    let found = metric.sectional_extremes(algebra).unwrap().unwrap();
    let curvature = |x: &[Rational], y: &[Rational]| {
        space.connection().sectional_curvature(metric, x, y).unwrap().unwrap()
    };
    for extreme in &found {
        let [x, y] = &extreme.plane;
        assert_eq!(curvature(x, y), extreme.curvature);
    }
    let n = algebra.dimension();
    let unit = |at: usize| (0..n).map(|i| integer(i64::from(i == at))).collect::<Vec<_>>();
    for (i, j) in (0..n).flat_map(|i| (i + 1..n).map(move |j| (i, j))) {
        let value = curvature(&unit(i), &unit(j));
        let below = value.clone() - &found[0].curvature;
        let above = found[1].curvature.clone() - &value;
        assert!(!below.is_negative() && !above.is_negative(), "{value} at {i}, {j}");
    }
    found
}

fn values(found: &[Extreme; 2]) -> [Rational; 2] {
    [found[0].curvature.clone(), found[1].curvature.clone()]
}

/// J. Milnor, *Adv. Math.* 21 (1976), section 4: a unimodular group with `[e2,e3] = l1 e1`, and
/// cyclically, for orthonormal `e_i`.
#[test]
fn of_groups_of_dimension_three() {
    let heisenberg = extremes(&named("heisenberg(3)", "identity"));
    assert_eq!(values(&heisenberg), [fraction(-3, 4), fraction(1, 4)]);
    assert!(heisenberg.iter().all(|extreme| extreme.proved));
    // a sphere: the curvature is constant
    let round = extremes(&named("so3", "identity"));
    assert_eq!(values(&round), [fraction(1, 4), fraction(1, 4)]);
    // Berger's sphere with the fibre scaled by 1/4: K = s/4 of planes with the fibre, 1 - 3 s/4 of the other
    let berger = extremes(&named("so3", "diag(1,1,1/4)"));
    assert_eq!(values(&berger), [fraction(1, 16), fraction(13, 16)]);
    assert!(berger.iter().all(|extreme| extreme.proved));
}

/// `-1 <= K <= -1/4` on the complex hyperbolic plane; the search finds both.
#[test]
fn of_the_complex_hyperbolic_plane() {
    let found = extremes(&rational("complex_hyperbolic_plane.toml", ""));
    assert_eq!(values(&found), [integer(-1), fraction(-1, 4)]);
    assert!(found.iter().all(|extreme| !extreme.proved));
}

/// S. Helgason, VII.11: the largest curvature of a compact simple group with the metric `-K` is a
/// quarter of the squared length of the highest root. It equals `1/(4 h)` with the dual Coxeter
/// number `h`. Here the metric is `K`, which changes the sign.
#[test]
fn of_bi_invariant_metrics() {
    for (name, coxeter) in [("su3", 3), ("so5", 3), ("so(6)", 4)] {
        let space = named(name, "killing");
        if space.algebra().unwrap().dimension() > MAX_SEARCHED {
            let metric = space.metric().unwrap();
            assert_eq!(metric.sectional_extremes(space.algebra().unwrap()).unwrap(), None);
            continue;
        }
        let found = extremes(&space);
        assert_eq!(values(&found), [fraction(-1, 4 * coxeter), integer(0)], "{name}");
        assert!(!found[0].proved && found[1].proved, "{name}");
    }
    let indefinite = named("sl2", "killing");
    let metric = indefinite.metric().unwrap();
    assert_eq!(metric.sectional_extremes(indefinite.algebra().unwrap()).unwrap(), None);
}

/// The number of bi-invariant forms is the upper bound by ranks modulo primes.
#[test]
fn bi_invariant_forms() {
    for name in ["so3", "so4", "heisenberg(3)", "se(3)", "sl(2)+R^2", "bianchi(V)", "R^3"] {
        let algebra = catalogued(name);
        let forms = Metric::bi_invariant_forms(&algebra).unwrap();
        assert_eq!(
            Some(forms.len()),
            StructureTheory::new(algebra.clone())
                .invariant_form_dimension()
                .map(|all| all.dimension),
            "{name}"
        );
        for form in forms {
            let varied = affinor_tensors::contract(
                "g_mj c^m_ki + g_im c^m_kj -> _kij",
                &[("g", &form), ("c", algebra.structure_constants())],
            );
            assert!(varied.unwrap().is_empty(), "{name}");
        }
    }
}

/// `plus` differentiates by `ad`, and derivatives by `minus` vanish. The metric of a Levi-Civita
/// connection is parallel.
#[test]
fn parallel_forms() {
    let algebra = catalogued("so3");
    let count = |family: CanonicalConnection| {
        Connection::canonical(&algebra, family).parallel_forms().unwrap().len()
    };
    assert_eq!([count(CanonicalConnection::Plus), count(CanonicalConnection::Minus)], [1, 6]);
    // constant components are invariant in an invariant frame only, not in a frame of coordinates
    let coordinates = Frame::coordinates(&["x", "y"]).unwrap();
    let plane = Metric::<Symbolic>::identity(2).unwrap();
    let plane = Connection::levi_civita(&coordinates, &plane).unwrap();
    assert!(matches!(plane.parallel_forms(), Err(Error::Unsupported(_))));
    let space = named("so3", "diag(1,2,3)");
    let forms = space.connection().parallel_forms().unwrap();
    let [only] = &forms[..] else { panic!("an irreducible holonomy leaves one metric") };
    assert_eq!(
        &only.scale(&space.metric().unwrap().components().get(&[0, 0])),
        space.metric().unwrap().components()
    );
}

/// The round sphere in floats: planes of nearly parallel vectors have its curvature, and parallel
/// vectors are an error. Also with null vectors and a connection that is not metric, exactly.
#[test]
fn planes_in_floats() {
    let so3 = catalogued("so(3)");
    let space = so3.map(|value| value.to_f64()).unwrap();
    let metric = Metric::identity(3).unwrap();
    let levi_civita = Connection::levi_civita(space.left_frame(), &metric).unwrap();
    let curvature = |x: &[f64], y: &[f64]| levi_civita.sectional_curvature(&metric, x, y).unwrap();
    let x = [0.3, 0.5, -0.7];
    for thin in [1.0, 1e-3, 1e-6, 1e-8] {
        let found = curvature(&x, &[x[0], x[1] + thin, x[2]]).unwrap();
        assert!((found - 0.25).abs() < 1e-14 / thin, "{thin}: {found}");
    }
    for k in 1..200 {
        let y = x.map(|x| x * f64::from(k) / 7.0);
        assert_eq!(curvature(&x, &y), None, "{k}");
    }
    // a null vector, and one that is nearly null, in an indefinite metric
    let sl2 = catalogued("sl(2)");
    let killing = Metric::new(sl2.labels(), sl2.killing_form()).unwrap();
    let exact = Connection::levi_civita(sl2.left_frame(), &killing).unwrap();
    let plane = |y: i64| [[integer(1), fraction(y, 1 << 40), integer(0)], [3, 1, 2].map(integer)];
    let floats = sl2.map(|value| value.to_f64()).unwrap();
    let metric = Metric::new(sl2.labels(), floats.killing_form()).unwrap();
    let connection = Connection::levi_civita(floats.left_frame(), &metric).unwrap();
    for y in [0, 1] {
        let [x, z] = plane(y);
        let expected = exact.sectional_curvature(&killing, &x, &z).unwrap().unwrap().to_f64();
        let [x, z] = [x, z].map(|v| v.map(|value| value.to_f64()));
        let found = connection.sectional_curvature(&metric, &x, &z).unwrap().unwrap();
        assert!((found - expected).abs() < 1e-13, "{found} {expected}");
    }
    // g(R(x,y)y, x) over the area, for null vectors x and for connections whose curvature depends
    // on more than the plane
    for connection in [
        Connection::levi_civita(sl2.left_frame(), &killing).unwrap(),
        Connection::canonical(&sl2, CanonicalConnection::Zero),
    ] {
        let null = [1, 0, 0].map(integer);
        let across = [3, 1, 2].map(integer);
        let one = connection.sectional_curvature(&killing, &null, &across).unwrap();
        let other = connection.sectional_curvature(&killing, &across, &null).unwrap();
        assert!(one.is_some());
        assert_eq!(one, other);
    }
}

/// Multiples of a metric have the same extreme planes; the curvatures are divided by the factor.
#[test]
fn do_not_depend_on_the_scale() {
    let metric = |factor: &str| format!("diag({factor},2*{factor},3*{factor},5*{factor})");
    let of = |factor: &str| extremes(&named("patera(4,7)", &metric(factor)));
    let plain = of("1");
    assert_ne!(plain[0].plane, plain[1].plane);
    for (factor, value) in [("10^18", 18), ("10^30", 30), ("10^-18", -18)] {
        let scaled = of(factor);
        let ten = |power: u32| (0..power).fold(integer(1), |value, _| value * &integer(10));
        for (a, b) in plain.iter().zip(&scaled) {
            let factor = ten(i32::unsigned_abs(value));
            let (left, right) = match value > 0 {
                true => (a.curvature.clone(), b.curvature.clone() * &factor),
                false => (a.curvature.clone() * &factor, b.curvature.clone()),
            };
            let (left, right) = (left.to_f64(), right.to_f64());
            assert!((left - right).abs() <= 1e-12 * left.abs().max(right.abs()), "{value}");
        }
    }
}

/// Random planes, each improved by small random steps, do not exceed the extremes of random
/// metrics, except by rounding errors.
#[test]
fn no_plane_lies_beyond() {
    let mut state = 7_u64;
    let mut draw = move || {
        state =
            state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 33) as i64
    };
    for name in ["patera(4,7)", "so(3)+R^1", "degraaf(5,6)", "heisenberg(5)"] {
        for _ in 0..2 {
            let n = catalogued(name).dimension();
            // A^T A + 1
            let a: Vec<Vec<i64>> =
                (0..n).map(|_| (0..n).map(|_| draw() % 5 - 2).collect()).collect();
            let entry = |i: usize, j: usize| {
                (0..n).map(|k| a[k][i] * a[k][j]).sum::<i64>() + i64::from(i == j)
            };
            let algebra = catalogued(name);
            let components =
                Tensor::from_fn(n, [Down, Down], |[i, j]| integer(entry(i, j))).unwrap();
            let metric = Metric::new(algebra.labels(), components).unwrap();
            let connection = Connection::levi_civita(algebra.left_frame(), &metric).unwrap();
            let curvature = lowered(&connection, &metric);
            let found = metric.sectional_extremes(&algebra).unwrap().unwrap();
            let curvature = |x: &[f64], y: &[f64]| curvature_of(&curvature, &metric, x, y);
            let [least, most] = [&found[0], &found[1]].map(|extreme| extreme.curvature.to_f64());
            for (side, limit) in [(-1.0, least), (1.0, most)] {
                for _ in 0..6 {
                    let mut plane: Vec<f64> =
                        (0..2 * n).map(|_| draw() as f64 / 1e9 - 1.0).collect();
                    let value = |plane: &[f64]| side * curvature(&plane[..n], &plane[n..]);
                    let (mut best, mut step) = (value(&plane), 0.5);
                    while step > 1e-6 {
                        let next: Vec<f64> =
                            plane.iter().map(|v| v + step * (draw() as f64 / 1e9 - 1.0)).collect();
                        let new = value(&next);
                        match new > best {
                            true => (plane, best) = (next, new),
                            false => step *= 0.97,
                        }
                    }
                    let scale = least.abs().max(most.abs());
                    assert!(best <= side * limit + 1e-9 * scale, "{name}: {best} beyond {limit}");
                }
            }
        }
    }
}

type Entries = Vec<([usize; 4], f64)>;

/// The components `R_ijkl` in floats.
fn lowered(connection: &Connection<Rational>, metric: &Metric<Rational>) -> Entries {
    let lowered = connection.curvature().lower(0, metric.components()).unwrap();
    lowered.components().map(|(at, r)| ([at[0], at[1], at[2], at[3]], r.to_f64())).collect()
}

/// The sectional curvature of a plane in floats; NaN for vectors that are nearly parallel.
fn curvature_of(curvature: &Entries, metric: &Metric<Rational>, x: &[f64], y: &[f64]) -> f64 {
    let form = |x: &[f64], y: &[f64]| {
        let terms = metric.components().components();
        terms.map(|(at, g)| g.to_f64() * x[at[0]] * y[at[1]]).sum::<f64>()
    };
    let above: f64 =
        curvature.iter().map(|([i, j, k, l], r)| r * x[*i] * y[*j] * x[*k] * y[*l]).sum();
    let below = form(x, x) * form(y, y) - form(x, y) * form(x, y);
    if below > 1e-9 { above / below } else { f64::NAN }
}

/// Extremes are searched up to the largest dimension, and not beyond it.
#[test]
fn are_searched_up_to_a_dimension() {
    for (n, found) in [(1, false), (2, true), (MAX_SEARCHED, true), (MAX_SEARCHED + 1, false)] {
        let algebra = catalogued(&format!("R^{n}"));
        let extremes = Metric::identity(n).unwrap().sectional_extremes(&algebra).unwrap();
        assert_eq!(extremes.is_some(), found, "{n}");
    }
}

/// In dimension 3 the extremes are `S/2 - r` for the largest and the smallest eigenvalue `r` of the Ricci endomorphism. They
/// are proved if these are rational.
#[test]
fn by_eigenvalues_of_the_ricci_endomorphism() {
    let (mut rational, mut irrational) = (0, 0);
    for name in ["so3", "sl2", "heisenberg(3)", "bianchi(IV)", "bianchi(V)", "bianchi(VI,h=-1/2)"] {
        let algebra = catalogued(name);
        for [a, b, c] in [[0, 0, 0], [1, 0, 0], [1, -1, 2], [0, 1, 1]] {
            let entries = [[4, a, b], [a, 5, c], [b, c, 7]];
            let g = Tensor::from_fn(3, [Down, Down], |[i, j]| integer(entries[i][j])).unwrap();
            let metric = Metric::new(algebra.labels(), g).unwrap();
            let found = metric.sectional_extremes(&algebra).unwrap().unwrap();
            let connection = Connection::levi_civita(algebra.left_frame(), &metric).unwrap();
            let ricci = connection.ricci().raise(0, metric.inverse()).unwrap();
            let ricci = DMatrix::from_fn(3, 3, |i, j| ricci.get(&[i, j]).to_f64());
            // symmetric in the metric: the eigenvalues are real
            let mut values: Vec<f64> =
                ricci.complex_eigenvalues().iter().map(|value| value.re).collect();
            values.sort_by(f64::total_cmp);
            let half = 0.5 * values.iter().sum::<f64>();
            for (extreme, value) in found.iter().zip([values[2], values[0]]) {
                let off = (extreme.curvature.to_f64() - (half - value)).abs();
                assert!(off < 1e-7, "{name} {entries:?}: {extreme:?} {value}");
            }
            match found[0].proved {
                true => rational += 1,
                false => irrational += 1,
            }
        }
    }
    assert!(rational > 3 && irrational > 3, "{rational} {irrational}");
}

/// Of two spheres the more curved one has the largest curvature, by however little; planes between them are flat.
#[test]
fn of_products_of_nearly_equal_spheres() {
    let found = extremes(&named("so3+so3", "diag(1,1,1,499/500,499/500,499/500)"));
    assert_eq!(values(&found), [integer(0), fraction(125, 499)]);
}

/// A bound is proved only if the plane found attains it. In a skewed basis with simple fractions the planes are found exactly.
#[test]
fn in_skewed_bases() {
    for (name, diagonal) in [("so(3)+R^1", [1, 2, 3, 1]), ("so(3)+R^1", [1, 1, 1, 1])] {
        let algebra = catalogued(name);
        let entry = |[i, j]: [usize; 2]| integer(if i == j { diagonal[i] } else { 0 });
        let g = Tensor::from_fn(4, [Down, Down], entry).unwrap();
        let plain = Metric::new(algebra.labels(), g.clone()).unwrap();
        let plain = plain.sectional_extremes(&algebra).unwrap().unwrap();
        for (a, b) in [((1, 3), (1, 2)), ((-1, 4), (2, 3)), ((17, 1009), (-5, 997))] {
            let is_simple = a.1 < 10 && diagonal[1] != diagonal[0];
            let skew = Tensor::from_fn(4, [Up, Down], |[i, j]| match (i, j) {
                (0, 3) | (2, 1) => fraction(a.0, a.1),
                (1, 3) => fraction(b.0, b.1),
                _ => integer(i64::from(i == j)),
            })
            .unwrap();
            let moved = contract("A^p_i A^q_k g_pq -> _ik", &[("A", &skew), ("g", &g)]).unwrap();
            let moved_algebra = algebra.change_basis(&BasisChange::new(skew).unwrap()).unwrap();
            let metric = Metric::new(moved_algebra.labels(), moved).unwrap();
            let found = metric.sectional_extremes(&moved_algebra).unwrap().unwrap();
            for (found, plain) in found.iter().zip(&plain) {
                let off = found.curvature.to_f64() - plain.curvature.to_f64();
                assert!(off.abs() < 1e-12, "{name} {a:?}: {off}");
                assert!(!found.proved || found.curvature == plain.curvature, "{name} {a:?}");
                assert!(!is_simple || found.curvature == plain.curvature, "{name} {a:?}");
            }
        }
    }
}
