//! Canonical coordinates of any algebra at points in floats: constants, closed forms, curvature.

use crate::common::algebras::{algebras, by_table, catalogued};
use crate::common::{inverse, labels, metrics, property::properties, transform};
use affinor::geometry::chart::{CanonicalCoordinates, Chart, Side};
use affinor::{BasisChange, Connection, Error, Frame, Law, LieAlgebra, Metric};
use affinor_tensors::{Down, Jet, Rational, Ring, Symbolic, Tensor, Up, contract};
use proptest::collection::vec;
use proptest::prelude::*;
use std::f64::consts::{PI, TAU};

const KINDS: [CanonicalCoordinates; 2] =
    [CanonicalCoordinates::First, CanonicalCoordinates::Second];
const SIDES: [Side; 2] = [Side::Left, Side::Right];

fn floats(algebra: &LieAlgebra<Rational>) -> LieAlgebra<f64> {
    algebra.map(Rational::to_f64).unwrap()
}

fn jets(tensor: &Tensor<Rational>) -> Tensor<Jet> {
    tensor.map(|v| Jet::constant(v.to_f64()))
}

/// Expects equal values, up to rounding errors.
fn close(here: &Tensor<Jet>, expected: &Tensor<Jet>, tolerance: f64) {
    let size = |t: &Tensor<Jet>| t.components().map(|(_, v)| v.value().abs()).fold(0.0, f64::max);
    let bound = tolerance * (1.0 + size(expected));
    let keys = here.components().chain(expected.components());
    for (at, _) in keys {
        let (u, v) = (here.get(&at).value(), expected.get(&at).value());
        assert!((u - v).abs() <= bound, "{at:?}: {u}, {v}");
    }
}

fn point(n: usize, size: f64) -> Vec<f64> {
    (0..n).map(|a| size * ((7 * a + 3) as f64).sin()).collect()
}

fn sign(side: Side) -> Jet {
    Jet::from_i64(if side == Side::Left { 1 } else { -1 })
}

const SIMPLE_AND_NOT: [&str; 7] =
    ["so(3)", "sl(2)", "so(4)", "sl(3)", "se(3)", "so(3,1)", "aff(1)"];

#[test]
fn structure_functions_are_the_constants() {
    for name in SIMPLE_AND_NOT {
        let algebra = catalogued(name);
        let x = point(algebra.dimension(), 0.7);
        for (kind, side) in KINDS.into_iter().flat_map(|kind| SIDES.map(|side| (kind, side))) {
            let frame = Frame::canonical_at_point(&floats(&algebra), kind, side, &x).unwrap();
            close(
                frame.structure_functions(),
                &jets(algebra.structure_constants()).scale(&sign(side)),
                1e-12,
            );
        }
    }
}

/// `T_left = 1 - (1 - cos t)/t^2 q~ + (t - sin t)/t^3 q~^2`, Rodrigues; `T_right` its transpose.
#[test]
fn rotation_vectors_by_the_formula_of_rodrigues() {
    let so3 = floats(&catalogued("so(3)"));
    for q in [[0.3, -1.2, 0.4], [1e-2, 2e-2, 0.0], [3.0, 1.0, 2.0], [-20.0, 5.0, 31.0]] {
        let t = q.iter().map(|v| v * v).sum::<f64>().sqrt();
        let spin = [[0.0, -q[2], q[1]], [q[2], 0.0, -q[0]], [-q[1], q[0], 0.0]];
        let [u, v] = [(1.0 - t.cos()) / (t * t), (t - t.sin()) / (t * t * t)];
        let forms =
            SIDES.map(|side| so3.canonical_forms(CanonicalCoordinates::First, side, &q).unwrap());
        for (i, j) in (0..3).flat_map(|i| (0..3).map(move |j| (i, j))) {
            let square: f64 = (0..3).map(|k| spin[i][k] * spin[k][j]).sum();
            let expected = f64::from(i == j) - u * spin[i][j] + v * square;
            let [left, right] =
                [forms[0].get(&[i, j]), forms[1].get(&[j, i])].map(|form| form.value());
            assert!((left - expected).abs() < 1e-12, "{q:?}: {left}, {expected}");
            assert!((right - expected).abs() < 1e-12, "{q:?}: {right}, {expected}");
        }
    }
}

/// If the fields have a closed form, the values at a point agree with it, and so do the
/// derivatives.
#[test]
fn exact_fields_at_points() {
    let algebras = [
        by_table(2, &[(1, 2, 2, 1)]),
        by_table(3, &[(1, 2, 3, 1), (1, 3, 2, -1)]),
        by_table(3, &[(1, 2, 2, 1), (1, 2, 3, 1), (1, 3, 2, -1), (1, 3, 3, 1)]),
        by_table(4, &[(1, 2, 2, 1), (1, 3, 3, 1), (1, 4, 4, 2), (2, 3, 4, 1)]),
    ];
    for algebra in algebras {
        let n = algebra.dimension();
        let names: Vec<String> = (1..=n).map(|a| format!("x{a}")).collect();
        let chart = Chart::new(&names).unwrap();
        let x = point(n, 1.3);
        let at = |name: &str| names.iter().position(|other| other == name).map(|a| x[a]);
        let symbolic = algebra.map(|v| Symbolic::constant(v.clone())).unwrap();
        for (kind, side) in KINDS.into_iter().flat_map(|kind| SIDES.map(|side| (kind, side))) {
            let exact = chart.invariant_fields(&symbolic, kind, side).unwrap();
            let exact = exact.change().inverse();
            let forms = floats(&algebra).canonical_forms(kind, side, &x).unwrap();
            for (i, a) in (0..n).flat_map(|i| (0..n).map(move |a| (i, a))) {
                let (form, exact) = (forms.get(&[i, a]), exact.get(&[i, a]));
                let same = |here: Jet, exact: Symbolic| {
                    let (u, v) = (here.value(), exact.evaluate(at).unwrap());
                    assert!((u - v).abs() < 1e-11 * (1.0 + v.abs()), "{i}, {a}: {u}, {v}");
                };
                same(form.clone(), exact.clone());
                for (b, name) in names.iter().enumerate() {
                    same(form.derivative(b), exact.derivative(name));
                    let second = exact.derivative(name).derivative(&names[0]);
                    same(form.derivative(b).derivative(0), second);
                }
            }
        }
    }
}

/// The curvature from the fields, and from a metric of functions in the coordinates, agrees with
/// the curvature from the structure constants.
fn curvature_both_ways(
    algebra: &LieAlgebra<Rational>,
    metric: &Metric<Rational>,
    kind: CanonicalCoordinates,
    x: &[f64],
    tolerance: f64,
) {
    let n = algebra.dimension();
    let real = floats(algebra);
    let constants = Connection::levi_civita(algebra.left_frame(), metric).unwrap();
    let constants = jets(constants.curvature());
    let g = jets(metric.components());
    let left = Frame::canonical_at_point(&real, kind, Side::Left, x).unwrap();
    let by_fields = Metric::new(left.labels(), g.clone()).unwrap();
    let by_fields = Connection::levi_civita(&left, &by_fields).unwrap();
    close(by_fields.curvature(), &constants, tolerance);

    let forms = real.canonical_forms(kind, Side::Left, x).unwrap();
    let coordinates = Frame::at_point(labels(n), x, |_, [a, i]| Jet::from_i64((a == i).into()));
    let coordinates = coordinates.unwrap();
    let here = contract("f^i_a g_ij -> _aj", &[("f", &forms), ("g", &g)]).unwrap();
    let here = contract("h_aj f^j_b -> _ab", &[("f", &forms), ("h", &here)]).unwrap();
    let here = Tensor::from_fn(n, [Down, Down], |[a, b]| here.get(&[a.min(b), a.max(b)])).unwrap();
    let here = Metric::new(coordinates.labels(), here).unwrap();
    let computed = Connection::levi_civita(&coordinates, &here).unwrap();
    let expected = transform(&constants, &forms, &inverse(&forms));
    close(computed.curvature(), &expected, tolerance);

    // the canonical connections, from the left and from the right fields
    let right = Frame::canonical_at_point(&real, kind, Side::Right, x).unwrap();
    let right_forms = real.canonical_forms(kind, Side::Right, x).unwrap();
    let c = jets(algebra.structure_constants());
    for twice in 0..=2 {
        let lambda = Jet::constant(f64::from(twice) / 2.0);
        let moved = |frame: &Frame<Jet>, share: Jet, forms: &Tensor<Jet>| {
            let invariant = Connection::new(frame.clone(), c.scale(&share)).unwrap();
            invariant.moved(labels(n), &BasisChange::new(forms.clone()).unwrap()).unwrap()
        };
        let of_left = moved(&left, lambda.clone(), &forms);
        let of_right = moved(&right, lambda.clone() - &Jet::from_i64(1), &right_forms);
        close(of_left.affinities(), of_right.affinities(), tolerance);
        let lambda = Rational::new(twice.into(), 2).unwrap();
        let constants = jets(Connection::cartan_schouten(algebra, &lambda).curvature());
        let expected = transform(&constants, &forms, &inverse(&forms));
        close(of_left.curvature(), &expected, tolerance);
    }
}

#[test]
fn curvature_of_metrics_that_are_not_diagonal() {
    for name in SIMPLE_AND_NOT {
        let algebra = catalogued(name);
        let n = algebra.dimension();
        let g = Tensor::from_fn(n, [Down, Down], |[i, j]| {
            Rational::from(if i == j { 4 } else { i64::from(i.abs_diff(j) == 1) })
        });
        let metric = Metric::new(algebra.labels(), g.unwrap()).unwrap();
        for kind in KINDS {
            curvature_both_ways(&algebra, &metric, kind, &point(n, 0.4), 1e-9);
        }
    }
}

/// (75): at the pole `Gam^i_(jk) = 0`, and the antisymmetric part is half the torsion. Off the
/// pole `Gam^i_jk q^j q^k = 0`: rays are autoparallel.
#[test]
fn eq_75_affinities_in_canonical_coordinates() {
    let mut off_the_pole = 0;
    for name in SIMPLE_AND_NOT.into_iter().chain(["heisenberg(3)", "bianchi(IV)", "se(2)"]) {
        let algebra = catalogued(name);
        let (n, real) = (algebra.dimension(), floats(&algebra));
        for (q, lambda) in [0.0, 0.8].into_iter().flat_map(|q| [0.0, 0.5, 1.0].map(|l| (q, l))) {
            let x = point(n, q);
            let left =
                Frame::canonical_at_point(&real, CanonicalCoordinates::First, Side::Left, &x)
                    .unwrap();
            let gamma = jets(algebra.structure_constants()).scale(&Jet::constant(lambda));
            let forms = real.canonical_forms(CanonicalCoordinates::First, Side::Left, &x).unwrap();
            let change = BasisChange::new(forms).unwrap();
            let left = Connection::new(left, gamma).unwrap();
            let here = left.moved(labels(n), &change).unwrap();
            let part = |sign: i64| {
                let text = format!("G^i_jk + {sign} G^i_kj -> ^i_jk");
                contract(&text, &[("G", here.affinities())]).unwrap()
            };
            close(&part(-1), &here.torsion(), 1e-12);
            let zero = Tensor::zero(n, &[Up, Down, Down]).unwrap();
            let jets: Vec<Jet> = x.iter().map(|v| Jet::constant(*v)).collect();
            let ray = Tensor::vector(&jets, Up);
            if q == 0.0 {
                close(&part(1), &zero, 1e-14);
            } else {
                let turned =
                    contract("G^i_jk n^j -> ^i_k", &[("G", here.affinities()), ("n", &ray)]);
                let turned =
                    contract("G^i_k n^k -> ^i", &[("G", &turned.unwrap()), ("n", &ray)]).unwrap();
                close(&turned, &Tensor::zero(n, &[Up]).unwrap(), 1e-12);
                off_the_pole += usize::from(part(1).components().any(|(_, v)| v.value() > 1e-3));
            }
        }
    }
    assert!(off_the_pole > 20, "{off_the_pole}");
}

#[test]
fn singular_points_are_refused() {
    let so3 = floats(&catalogued("so(3)"));
    let first =
        |x: &[f64]| Frame::canonical_at_point(&so3, CanonicalCoordinates::First, Side::Left, x);
    for turns in 1..40 {
        let t = TAU * f64::from(turns);
        for x in [[t, 0.0, 0.0], [0.6 * t, 0.0, 0.8 * t], [t / 3.0, -2.0 * t / 3.0, 2.0 * t / 3.0]]
        {
            assert!(
                matches!(first(&x), Err(Error::Broken { law: Law::RegularPoint, .. })),
                "{x:?}"
            );
        }
        assert!(first(&[t - 1e-3, 0.0, 0.0]).is_ok());
    }
    // the forms exist there, and vanish across the axis
    let refused = first(&[0.0, 0.0, TAU]).unwrap_err().to_string();
    assert!(refused.ends_with("vanish on d_1"), "{refused}");
    let second = Frame::canonical_at_point(
        &so3,
        CanonicalCoordinates::Second,
        Side::Right,
        &[0.3, PI / 2.0, 1.0],
    );
    assert!(matches!(second, Err(Error::Broken { law: Law::RegularPoint, .. })));
    let sl2 = floats(&catalogued("sl(2)"));
    let sl2 =
        |x: &[f64]| Frame::canonical_at_point(&sl2, CanonicalCoordinates::First, Side::Left, x);
    // h, e, f: eigenvalues 2 pi i at pi (e - f)
    assert!(sl2(&[0.0, 3.0, -3.0]).is_ok());
    let found = (0..3).filter(|axis| {
        let pair = [[PI, -PI, 0.0], [PI, 0.0, -PI], [0.0, PI, -PI]][*axis];
        matches!(sl2(&pair), Err(Error::Broken { law: Law::RegularPoint, .. }))
    });
    assert_eq!(found.count(), 1);
}

#[test]
fn points_far_out() {
    let so3 = floats(&catalogued("so(3)"));
    for x in [1e8, 1e160, f64::MAX, f64::INFINITY, f64::NAN] {
        for (kind, side) in KINDS.into_iter().flat_map(|kind| SIDES.map(|side| (kind, side))) {
            let far = Frame::canonical_at_point(&so3, kind, side, &[x, 0.1, x]);
            assert!(matches!(far, Err(Error::Overflow { .. })), "{x}: {far:?}");
        }
    }
    let affine = floats(&catalogued("aff(1)"));
    let far =
        Frame::canonical_at_point(&affine, CanonicalCoordinates::First, Side::Left, &[-800.0, 1.0]);
    assert!(matches!(far, Err(Error::Overflow { .. })), "exp(800)");
    let short =
        Frame::canonical_at_point(&so3, CanonicalCoordinates::First, Side::Left, &[0.0, 1.0]);
    assert!(matches!(short, Err(Error::Shape { .. })));
    // all functions are polynomials
    let heisenberg = catalogued("heisenberg(3)");
    for kind in KINDS {
        let x = [1e9, -2e9, 3e9];
        let frame = Frame::canonical_at_point(&floats(&heisenberg), kind, Side::Left, &x).unwrap();
        close(frame.structure_functions(), &jets(heisenberg.structure_constants()), 1e-12);
    }
}

properties! {
    #![cases(24)]

    #[test]
    fn random_algebras_in_random_bases(
        (algebra, x) in algebras(5).prop_flat_map(|algebra| {
            let n = algebra.dimension();
            (Just(algebra), vec(-0.2f64..0.2, n))
        }),
    ) {
        for (kind, side) in KINDS.into_iter().flat_map(|kind| SIDES.map(|side| (kind, side))) {
            let frame = Frame::canonical_at_point(&floats(&algebra), kind, side, &x);
            // no accuracy is guaranteed near a singular point, but these eigenvalues are small
            let largest = algebra.structure_constants().components().map(|(_, v)| v.to_f64().abs());
            prop_assume!(largest.fold(0.0, f64::max) < 20.0);
            close(frame.unwrap().structure_functions(), &jets(algebra.structure_constants()).scale(&sign(side)), 1e-6);
        }
    }

    #[test]
    fn curvature_of_simple_algebras(
        which in 0usize..3,
        metric in metrics(3),
        x in vec(-0.9f64..0.9, 3),
        kind in 0usize..2,
    ) {
        let algebra = catalogued(["so(3)", "sl(2)", "so(2,1)"][which]);
        curvature_both_ways(&algebra, &metric, KINDS[kind], &x, 1e-7);
    }
}
