//! Invariant metrics of homogeneous spaces: normal metrics against Casimir constants, factors of
//! isotropy summands, natural reductivity, and independence of bases.

use crate::common::{fraction, integer, invertible, property::properties};
use affinor::geometry::homogeneous::{Embedding, HomogeneousSpace};
use affinor::geometry::properties::Property;
use affinor::{BasisChange, Metric, ReductivePair};
use affinor_tensors::linear::Matrix;
use affinor_tensors::{Field, Rational, Tensor};
use proptest::prelude::*;

type Pair = ReductivePair<Rational>;

fn find(name: &str) -> HomogeneousSpace {
    HomogeneousSpace::find(name).unwrap_or_else(|error| panic!("{name}: {error}"))
}

fn metric(pair: &Pair, factors: &[Rational]) -> Metric<Rational> {
    let forms = pair.summand_forms().unwrap();
    assert_eq!(forms.len(), factors.len());
    let zero = forms[0].scale(&integer(0));
    let sum = forms.iter().zip(factors).fold(zero, |sum, (form, x)| {
        let operands = [("a", &sum), ("b", &form.scale(x))];
        affinor_tensors::contract("a_ij + b_ij -> _ij", &operands).unwrap()
    });
    Metric::new(pair.frame().labels(), sum).unwrap()
}

fn ricci(pair: &Pair, metric: &Metric<Rational>) -> Tensor<Rational> {
    pair.levi_civita(metric).unwrap().ricci().raise(0, metric.inverse()).unwrap()
}

/// The eigenvalues of the Ricci endomorphism on the isotropy components, in order.
fn eigenvalues(pair: &Pair, metric: &Metric<Rational>) -> Vec<Rational> {
    let endomorphism = ricci(pair, metric);
    let components = pair.isotropy_components().unwrap();
    let eigenvalue = |x: &Vec<Rational>| {
        let image = |i: usize| {
            x.iter()
                .enumerate()
                .fold(integer(0), |sum, (j, x)| sum + &(endomorphism.get(&[i, j]) * x))
        };
        let at = x.iter().position(|x| *x != integer(0)).unwrap();
        let value = image(at) * &x[at].recip().unwrap();
        for (i, x) in x.iter().enumerate() {
            assert_eq!(image(i), value.clone() * x);
        }
        value
    };
    let each = components.iter().map(|component| {
        let vectors = component.subspace.dense();
        let values: Vec<_> = vectors.iter().map(eigenvalue).collect();
        assert!(values.iter().all(|value| *value == values[0]));
        values[0].clone()
    });
    each.collect()
}

/// The metric `-B` of a compact group has `Ric = 1/4 + c/2` on a summand with the Casimir constant `c`
/// with respect to `-B` on `h` (M. Wang, W. Ziller, *Ann. Sci. ENS* 18 (1985) 563-633). The trace of
/// the Casimir operators over the algebra is the dimension of `h`, which gives `c`:
///
/// - symmetric spaces: `c = 1/2`;
/// - `V(2,R^n)`: 0 on the line, and `(n-3)/(2(n-2))`;
/// - `S^7 = Sp(2)/Sp(1)`: 0 on three dimensions, and 1/4;
/// - the circle `diag(k, l, m)` in SU(3): `(k-l)^2/N`, `(k-m)^2/N`, `(l-m)^2/N` and 0, where
///   `N = 6(k^2 + l^2 + m^2)`;
/// - the diagonal of three equal groups: 1/3;
/// - the flags of three lines: 1/3.
#[test]
fn normal_metrics_have_the_ricci_curvature_of_their_casimir_constants() {
    let stiefel = |n: i64| vec![integer(0), fraction(n - 3, 2 * (n - 2))];
    let circle = |k: i64, l: i64| {
        let m = -k - l;
        let n = 6 * (k * k + l * l + m * m);
        let mut constants: Vec<_> =
            [k - l, k - m, l - m].iter().map(|weight| fraction(weight * weight, n)).collect();
        constants.push(integer(0));
        constants
    };
    let cases: Vec<(String, Vec<Rational>)> = vec![
        ("S^4".into(), vec![fraction(1, 2)]),
        ("CP^2".into(), vec![fraction(1, 2)]),
        ("Gr(2,R^5)".into(), vec![fraction(1, 2)]),
        ("SU(3)/SO(3)".into(), vec![fraction(1, 2)]),
        ("V(2,R^5)".into(), stiefel(5)),
        ("V(2,R^6)".into(), stiefel(6)),
        ("V(2,R^7)".into(), stiefel(7)),
        ("S^7 = Sp(2)/Sp(1)".into(), vec![integer(0), fraction(1, 4)]),
        ("SU(3)/U(1)_{1,2}".into(), circle(1, 2)),
        ("SU(3)/U(1)_{2,3}".into(), circle(2, 3)),
        ("SU(3)/U(1)_{1,-3}".into(), circle(1, -3)),
        ("SU(2)xSU(2)xSU(2)/SU(2)".into(), vec![fraction(1, 3)]),
        ("SU(3)xSU(3)/SU(3)".into(), vec![fraction(1, 2)]),
        ("Fl(3)".into(), vec![fraction(1, 3); 3]),
    ];
    for (name, constants) in cases {
        let space = find(&name);
        let normal = space.pair().killing_metric().unwrap();
        let mut found = eigenvalues(space.pair(), &normal);
        let expected = constants.iter().map(|c| fraction(1, 4) + &(c.clone() * &fraction(1, 2)));
        let mut expected: Vec<_> = expected.collect();
        // the order of components with equal dimensions is not part of the claim
        found.sort_by(|a, b| a.to_f64().total_cmp(&b.to_f64()));
        expected.sort_by(|a, b| a.to_f64().total_cmp(&b.to_f64()));
        assert_eq!(found, expected, "{name}");
    }
}

/// Flags of three lines with the metric `x1 B + x2 B + x3 B`: `Ric = 1/(2 x_i) + (x_i/(x_j x_k) -
/// x_j/(x_i x_k) - x_k/(x_i x_j))/12` on the summand `i` (J.-S. Park, Y. Sakane, *Tokyo J. Math.* 20
/// (1997) 51-61). The Einstein metrics are (1,1,1) and the three Kaehler-Einstein metrics (1,1,2).
#[test]
fn flags_with_a_factor_for_each_summand() {
    let space = find("Fl(3)");
    let pair = space.pair();
    for factors in [[1, 1, 1], [1, 1, 2], [2, 1, 1], [1, 2, 1], [1, 2, 3], [5, 1, 7]] {
        let x = factors.map(integer);
        let g = metric(pair, &x);
        let over = |a: &Rational, b: &Rational| a.clone() * &b.recip().unwrap();
        let expected = [[0, 1, 2], [1, 0, 2], [2, 0, 1]].map(|[i, j, k]| {
            let (a, b, c) = (&x[i], &x[j], &x[k]);
            let products =
                over(a, &(b.clone() * c)) - &over(b, &(a.clone() * c)) - &over(c, &(a.clone() * b));
            over(&fraction(1, 2), a) + &(products * &fraction(1, 12))
        });
        assert_eq!(eigenvalues(pair, &g), expected);
        let mut sorted = factors;
        sorted.sort_unstable();
        let einstein = [[1, 1, 1], [1, 1, 2]].contains(&sorted);
        let found = pair.levi_civita(&g).unwrap().einstein_constant(&g).unwrap();
        assert_eq!(found.holds().is_some(), einstein, "{factors:?}");
        let reductive = pair.naturally_reductive(&g).unwrap();
        assert_eq!(reductive.holds().is_some(), factors == [1, 1, 1], "{factors:?}");
    }
}

/// The metrics `-B` on the base and `-t B` on the fibre of `S^7 = Sp(2)/Sp(1)`: one is round, and the
/// metric with a fifth of its fibre is Einstein too (G. R. Jensen, *J. Diff. Geom.* 8 (1973) 599-614).
#[test]
fn round_and_squashed_spheres_of_dimension_7() {
    let space = find("S^7 = Sp(2)/Sp(1)");
    let pair = space.pair();
    let normal = pair.killing_metric().unwrap();
    let fibre = &pair.isotropy_components().unwrap()[0];
    assert_eq!((fibre.subspace.dimension(), fibre.metrics()), (3, Some(6)));
    let vertical = fibre.subspace.dense();
    let is_vertical = |i: usize| vertical.iter().any(|x| x[i] != integer(0));
    let scaled = |t: &Rational| {
        let form = normal.components().components();
        let form = form.map(|(at, value)| {
            let factor = if is_vertical(at[0]) { t.clone() } else { integer(1) };
            ([at[0], at[1]], value.clone() * &factor)
        });
        let slots = [affinor_tensors::Down; 2];
        let form = Tensor::from_components(7, &slots, form.collect::<Vec<_>>()).unwrap();
        Metric::new(pair.frame().labels(), form).unwrap()
    };
    let mut round = vec![];
    for t in [(1, 4), (1, 2), (1, 1), (2, 1), (4, 1)].map(|(n, d)| fraction(n, d)) {
        let g = scaled(&t);
        if let Property::Holds(k) = pair.levi_civita(&g).unwrap().constant_curvature(&g).unwrap() {
            assert!(k.to_f64() > 0.0);
            round.push(t);
        }
    }
    let [t] = &round[..] else { panic!("{round:?}") };
    for (factor, is_einstein) in [(1, true), (5, true), (2, false), (3, false)] {
        let g = scaled(&(t.clone() * &fraction(1, factor)));
        let einstein = pair.levi_civita(&g).unwrap().einstein_constant(&g).unwrap();
        assert_eq!(einstein.holds().is_some(), is_einstein, "{factor}");
    }
}

/// Round spheres and hyperbolic spaces have the curvature `±1/(2(n-1))` with the metric of the Killing
/// form; on `CP^n` the planes of a complex line have four times the least curvature.
#[test]
fn symmetric_spaces_of_rank_1() {
    for (name, n, sign) in [("S^2", 2, 1), ("S^5", 5, 1), ("H^2", 2, -1), ("H^4", 4, -1)] {
        let space = find(name);
        let g = space.pair().killing_metric().unwrap();
        let curvature = space.pair().levi_civita(&g).unwrap().constant_curvature(&g).unwrap();
        assert_eq!(curvature.holds(), Some(fraction(sign, 2 * (n - 1))), "{name}");
    }
    for (name, sign) in [("CP^2", 1), ("CP^3", 1), ("CH^2", -1), ("HP^1", 0)] {
        let space = find(name);
        let g = space.pair().killing_metric().unwrap();
        let [least, most] = g.sectional_extremes_in(space.pair().frame()).unwrap().unwrap();
        let four = integer(4);
        match sign {
            1 => assert_eq!(most.curvature, least.curvature * &four, "{name}"),
            -1 => assert_eq!(least.curvature, most.curvature * &four, "{name}"),
            _ => assert_eq!(least.curvature, most.curvature, "{name}"),
        }
    }
}

/// Summands that are equivalent have no factors of their own.
#[test]
fn equivalent_summands_have_no_factors() {
    for name in ["V(2,R^5)", "S^7 = Sp(2)/Sp(1)", "SU(2)xSU(2)xSU(2)/SU(2)"] {
        let refused = find(name).pair().summand_forms().unwrap_err().to_string();
        assert!(refused.contains("equivalent summands"), "{name}: {refused}");
    }
    for (name, count) in [("CP^2", 1), ("Gr(2,R^4)", 2), ("Fl(3)", 3), ("Sp(2)/T", 4)] {
        let forms = find(name).pair().summand_forms().unwrap();
        assert_eq!(forms.len(), count, "{name}");
        assert_eq!(find(name).pair().invariant_forms().unwrap().len(), count, "{name}");
    }
}

properties! {
    #![cases(12)]

    /// The scalar curvature and the Kretschmann scalar of the normal metric depend neither on the
    /// basis of the algebra nor on the bases of `h` and of the complement.
    #[test]
    fn another_basis(
        at in 0usize..3,
        (whole, inner, outer) in (invertible(6), invertible(6), invertible(6)),
    ) {
        let (name, s) = [("SO(4)/SO(3)", 3), ("SO(4)/SO(2)", 1), ("SU(2)xSU(2)/SU(2)", 3)][at];
        let Embedding { algebra, vectors, .. } = Embedding::find(name).unwrap();
        let invariants = |pair: &Pair| {
            let g = pair.killing_metric().unwrap();
            let connection = pair.levi_civita(&g).unwrap();
            (connection.scalar_curvature(&g).unwrap(), connection.kretschmann(&g).unwrap())
        };
        let expected = invariants(&Pair::orthogonal(&algebra, &vectors).unwrap());
        let changed = algebra.change_basis(&BasisChange::new(whole.clone()).unwrap()).unwrap();
        // components in the new basis: the inverse matrix
        let rows = |matrix: &Tensor<Rational>, n: usize| {
            let row = |i| (0..n).map(|j| matrix.get(&[i, j])).collect::<Vec<_>>();
            Matrix::from_dense(&(0..n).map(row).collect::<Vec<_>>()).unwrap()
        };
        let inverse = rows(&whole, 6).inverse().unwrap();
        // leading blocks of an invertible product of triangular matrices are invertible
        let mixed = |vectors: &[Vec<Rational>], by: &Tensor<Rational>| {
            let moved: Vec<_> = vectors.iter().map(|x| inverse.apply(x).unwrap()).collect();
            let by = rows(by, vectors.len());
            by.mul(&Matrix::from_dense(&moved).unwrap()).unwrap().to_dense()
        };
        let m = Pair::complement(&algebra, &vectors).unwrap();
        prop_assert_eq!(vectors.len(), s);
        let pair = Pair::new(&changed, &mixed(&vectors, &inner), &mixed(&m, &outer)).unwrap();
        prop_assert_eq!(invariants(&pair), expected);
    }
}
