//! Homogeneous spaces by name: dimensions, isotropy and invariant metrics against the literature.

use affinor::geometry::homogeneous::{FAMILIES, HomogeneousSpace, has_form, nearest};
use affinor::{Metric, ReductivePair};
use affinor_tensors::{Down, Rational, Tensor};

/// A name, the dimension of the space, whether the pair is symmetric, and the dimension of the cone of
/// invariant metrics. The last one follows from the isotropy representation: a sum of `k` equivalent
/// summands gives `k(k+1)/2` (real type), `k^2` (complex type) or `k(2k-1)` (quaternionic type). Isotropy
/// representations: A. L. Besse, *Einstein Manifolds* (1987), 7.H and 9.K; M. Wang, W. Ziller, *J. Diff.
/// Geom.* 31 (1990) 215-248.
const SPACES: [(&str, usize, bool, usize); 76] = [
    ("S^2", 2, true, 1),
    ("S^3", 3, true, 1),
    ("S^7", 7, true, 1),
    ("H^3", 3, true, 1),
    ("CP^2", 4, true, 1),
    ("CP^3", 6, true, 1),
    ("CH^2", 4, true, 1),
    ("HP^2", 8, true, 1),
    ("OP^2", 16, true, 1),
    ("SO(3)/SO(2)", 2, true, 1),
    ("SU(2)/U(1)", 2, true, 1),
    ("SU(3)/U(2)", 4, true, 1),
    ("SU(3)/SO(3)", 5, true, 1),
    ("SU(4)/SO(4)", 9, true, 1),
    ("SU(4)/Sp(2)", 5, true, 1),
    ("SO(4)/U(2)", 2, true, 1),
    ("SO(6)/U(3)", 6, true, 1),
    ("SO(8)/U(4)", 12, true, 1),
    ("Sp(2)/U(2)", 6, true, 1),
    ("Sp(3)/U(3)", 12, true, 1),
    ("Gr(2,R^5)", 6, true, 1),
    // the four-dimensional representation splits under SO(2)xSO(2): a product of two spheres
    ("Gr(2,R^4)", 4, true, 2),
    ("Gr(2,C^4)", 8, true, 1),
    ("Gr(1,H^2)", 4, true, 1),
    ("SL(3,R)/SO(3)", 5, true, 1),
    ("SL(2,R)/SO(2)", 2, true, 1),
    ("SE(3)/SO(3)", 3, true, 1),
    ("SO(3,1)/SO(3)", 3, true, 1),
    ("G2/SO(4)", 8, true, 1),
    ("F4/Sp(3)xSU(2)", 28, true, 1),
    ("SU(2)xSU(2)/SU(2)", 3, true, 1),
    ("SU(3)xSU(3)/SU(3)", 8, true, 1),
    // strictly nearly Kaehler, and nearly parallel G2: irreducible, but not symmetric
    ("S^6 = G2/SU(3)", 6, false, 1),
    ("S^7 = Spin(7)/G2", 7, false, 1),
    ("S^5 = SU(3)/SU(2)", 5, false, 2),
    ("S^7 = SU(4)/SU(3)", 7, false, 2),
    ("S^7 = Sp(2)/Sp(1)", 7, false, 7),
    ("S^11 = Sp(3)/Sp(2)", 11, false, 7),
    ("CP^3 = Sp(2)/Sp(1)xU(1)", 6, false, 2),
    ("Fl(3)", 6, false, 3),
    ("SU(3)/T^2", 6, false, 3),
    ("SU(4)/T", 12, false, 6),
    ("Sp(2)/T", 8, false, 4),
    ("SO(5)/T", 8, false, 4),
    ("V(2,R^5)", 7, false, 4),
    ("V(2,R^4)", 5, false, 5),
    ("SU(3)/U(1)_{1,2}", 7, false, 4),
    ("SU(3)/U(1)_{1,1}", 7, false, 10),
    ("SU(2)xSU(2)xSU(2)/SU(2)", 6, false, 3),
    ("SU(4)/S(U(2)xU(1)xU(1))", 10, false, 3),
    ("dS^4", 4, true, 1),
    ("AdS^4", 4, true, 1),
    ("AdS^2", 2, true, 1),
    ("HH^1", 4, true, 1),
    ("HH^2", 8, true, 1),
    ("E6/SO(10)xU(1)", 32, true, 1),
    ("E6/SU(6)xSU(2)", 40, true, 1),
    ("E7/E6xU(1)", 54, true, 1),
    ("E7/SO(12)xSU(2)", 64, true, 1),
    ("E7/SU(8)", 70, true, 1),
    ("F4/Spin(8)", 24, false, 3),
    ("S^15 = Spin(9)/Spin(7)", 15, false, 2),
    // isotropy irreducible, but not symmetric
    ("SO(5)/SO(3)_irr", 7, false, 1),
    // one of the two planes has the weight p, the other has q
    ("T^{1,1}", 5, false, 5),
    ("T^{1,2}", 5, false, 3),
    ("T^{1,0}", 5, false, 7),
    // the summands of a flag manifold with one circle are the values of the coefficient of its simple root
    ("G2/U(2)_long", 10, false, 3),
    ("G2/U(2)_short", 10, false, 2),
    ("G2/T", 12, false, 6),
    // fixed vectors of dimension 3, and the four-dimensional representation twice; or the one of dimension 8
    ("G2/SU(2)_long", 11, false, 12),
    ("G2/SU(2)_short", 11, false, 7),
    ("Sp(3)/Sp(1)xSp(1)xSp(1)", 12, false, 3),
    ("SO(7)/U(3)", 12, false, 2),
    ("V(3,R^5)", 9, false, 15),
    ("V(2,C^4)", 12, false, 16),
    ("SU(3)/U(1)_{2,3}", 7, false, 4),
];

fn invariant_metrics(pair: &ReductivePair<Rational>) -> Vec<Tensor<Rational>> {
    let forms = pair.invariant_tensors(&[Down, Down]).unwrap();
    let symmetric =
        |form: &Tensor<Rational>| form.components().all(|(at, x)| form.get(&[at[1], at[0]]) == *x);
    // symmetric and antisymmetric forms are separate invariants
    let sum = |form: &Tensor<Rational>| {
        let n = form.dimension();
        Tensor::from_fn(n, [Down, Down], |[i, j]| form.get(&[i, j]) + &form.get(&[j, i])).unwrap()
    };
    let mut found: Vec<Tensor<Rational>> = vec![];
    let mut span = affinor_tensors::linear::Echelon::new();
    for form in forms.iter().map(|form| if symmetric(form) { form.clone() } else { sum(form) }) {
        let n = form.dimension();
        let row = form.components().map(|(at, x)| (at[0] * n + at[1], x.clone()));
        if span.insert(row).unwrap() {
            found.push(form);
        }
    }
    found
}

#[test]
fn dimensions_isotropy_and_invariant_metrics() {
    for (name, dimension, symmetric, metrics) in SPACES {
        let space = HomogeneousSpace::find(name).unwrap_or_else(|error| panic!("{name}: {error}"));
        let pair = space.pair();
        assert_eq!((pair.dimension(), pair.is_symmetric()), (dimension, symmetric), "{name}");
        if dimension <= 12 {
            assert_eq!(invariant_metrics(pair).len(), metrics, "{name}: {}", space.embedding());
        }
    }
}

/// The Ricci tensor of an invariant metric of a unimodular group over a compact subgroup, in a basis `e_a` of `m`:
/// `Ric(x, y) = -1/2 g^ab <[x,e_a]_m, [y,e_b]_m> - 1/2 tr(pr ad_x pr ad_y) - tr_m(ad_x pr_h ad_y)
/// + 1/4 g^ab g^cd <[e_a,e_c], x> <[e_b,e_d], y>`, made symmetric (A. L. Besse, *Einstein Manifolds* (1987), 7.38).
fn ricci_of_besse(pair: &ReductivePair<Rational>, metric: &Metric<Rational>) -> Tensor<Rational> {
    let (r, n) = (pair.dimension(), pair.algebra().dimension());
    let c = |i: usize, j: usize, k: usize| pair.algebra().structure_constants().get(&[i, j, k]);
    let (g, inverse) = (metric.components(), metric.inverse());
    let sum = |terms: &mut dyn Iterator<Item = Rational>| {
        terms
            .filter(|term| *term != Rational::from(0))
            .fold(Rational::from(0), |sum, term| sum + &term)
    };
    let at = |x: usize, a: usize, b: usize| (x * r + a) * r + b;
    let indices = || (0..r * r * r).map(|key| (key / (r * r), key / r % r, key % r));
    let lower: Vec<_> =
        indices().map(|(x, a, b)| sum(&mut (0..r).map(|m| g.get(&[x, m]) * &c(m, a, b)))).collect();
    let half: Vec<_> = indices()
        .map(|(x, a, b)| {
            sum(&mut (0..r).map(|d| lower[at(x, a, d)].clone() * &inverse.get(&[d, b])))
        })
        .collect();
    let upper: Vec<_> = indices()
        .map(
            |(x, a, b)| sum(&mut (0..r).map(|d| half[at(x, d, b)].clone() * &inverse.get(&[d, a]))),
        )
        .collect();
    // <[x,e_a]_m, e_d> g^ab c^d_yb
    let first: Vec<_> = indices()
        .map(|(d, x, b)| {
            sum(&mut (0..r).map(|a| lower[at(d, x, a)].clone() * &inverse.get(&[a, b])))
        })
        .collect();
    let value = |x: usize, y: usize| {
        let pairs = || (0..r * r).map(|key| (key / r, key % r));
        let products = sum(&mut pairs().map(|(d, b)| first[at(d, x, b)].clone() * &c(d, y, b)));
        let inner = sum(&mut pairs().map(|(a, b)| c(a, x, b) * &c(b, y, a)));
        let outer = (r..n).flat_map(|h| (0..r).map(move |a| (a, h)));
        let vertical = sum(&mut outer.map(|(a, h)| c(a, x, h) * &c(h, y, a)));
        let last = sum(&mut pairs().map(|(a, b)| lower[at(x, a, b)].clone() * &upper[at(y, a, b)]));
        let quarter = Rational::new(1, 4).unwrap();
        (last - &((products + &inner) * &Rational::from(2)) - &(vertical * &Rational::from(4)))
            * &quarter
    };
    let symmetric =
        |[x, y]: [usize; 2]| (value(x, y) + &value(y, x)) * &Rational::new(1, 2).unwrap();
    Tensor::from_fn(r, [Down, Down], symmetric).unwrap()
}

/// The Ricci tensor is that of the second formula. The metric is a sum of all invariant forms with
/// different factors.
#[test]
fn the_ricci_tensor_by_a_second_formula() {
    for (name, dimension, ..) in SPACES {
        if dimension > 12 {
            continue;
        }
        let space = HomogeneousSpace::find(name).unwrap();
        let pair = space.pair();
        let forms = invariant_metrics(pair);
        let mut form = pair.killing_form().unwrap().scale(&Rational::from(40));
        for (term, factor) in forms.iter().zip(1..) {
            let operands = [("a", &form), ("b", &term.scale(&Rational::from(factor)))];
            form = affinor_tensors::contract("a_ij + b_ij -> _ij", &operands).unwrap();
        }
        let metric = Metric::new(pair.frame().labels(), form)
            .unwrap_or_else(|error| panic!("{name}: {error}"));
        let found = pair.levi_civita(&metric).unwrap().ricci();
        assert_eq!(found, ricci_of_besse(pair, &metric), "{name}");
    }
}

/// Irreducible isotropy makes the metric Einstein; spheres and projective spaces have their curvatures.
#[test]
fn irreducible_spaces_are_einstein() {
    for (name, _, _, metrics) in SPACES.into_iter().filter(|space| space.1 <= 8) {
        if metrics > 1 {
            continue;
        }
        let space = HomogeneousSpace::find(name).unwrap();
        let form = invariant_metrics(space.pair()).remove(0);
        let metric = Metric::new(space.pair().frame().labels(), form).unwrap();
        let connection = space.pair().levi_civita(&metric).unwrap();
        assert!(connection.einstein_constant(&metric).unwrap().holds().is_some(), "{name}");
        let constant = connection.constant_curvature(&metric).unwrap().holds().is_some();
        let sphere = name.starts_with(['S', 'H']) && name[1..].starts_with('^')
            || name.contains("dS^")
            || space.pair().dimension() <= 3
            || ["SU(4)/Sp(2)", "Gr(1,H^2)", "HH^1"].contains(&name);
        assert_eq!(constant, sphere, "{name}");
    }
}

#[test]
fn names_that_are_refused() {
    for name in [
        "SU(3)",
        "SU(3)/SU(4)",
        "SU(3)/",
        "/U(1)",
        "S^0",
        "Gr(4,C^4)",
        "SO(5)/E8",
        "SO(4,1)/SO(1,2)",
        "S^16 = Spin(9)/Spin(7)",
        "CP^2 = S^5",
        "x/y",
        "SU(99)/T",
        "",
    ] {
        assert!(HomogeneousSpace::find(name).is_err(), "{name}");
    }
}

/// A misspelt name has the nearest names that can be read; texts of other forms have none.
#[test]
fn nearest_names_are_suggested() {
    for (text, name) in [
        ("su(3)/u(2)", "SU(3)/U(2)"),
        ("so(5)/so(3)", "SO(5)/SO(3)"),
        ("SP(2)/Sp(1)", "Sp(2)/Sp(1)"),
        ("SUU(3)/U(2)", "SU(3)/U(2)"),
        ("su(3)/s(u(2)xu(1))", "SU(3)/S(U(2)xU(1))"),
        ("cp^2", "CP^2"),
        ("GR(2,C^4)", "Gr(2,C^4)"),
        ("v(2,R^5)", "V(2,R^5)"),
        ("fl(3)", "Fl(3)"),
        ("g2/su(3)", "G2/SU(3)"),
    ] {
        assert_eq!(nearest(text).first().map(String::as_str), Some(name), "{text}");
    }
    for text in ["so(3)", "data/so3", "SU(3)/U(2)", "", "x", "a/b/c", "E8", "\u{1d530}/2"] {
        assert!(nearest(text).is_empty(), "{text}: {:?}", nearest(text));
    }
}

#[test]
fn the_form_of_a_name() {
    for (name, ..) in SPACES {
        assert!(has_form(name), "{name}");
    }
    for family in FAMILIES {
        assert!(has_form(family.example), "{}", family.pattern);
        HomogeneousSpace::find(family.example).unwrap();
    }
    for text in ["so(3)", "a/b", "Data/so3", "data/SO3.toml", "./SU3", "so(3)+R^2", "x/y/z", "R^3"]
    {
        assert!(!has_form(text), "{text}");
    }
}
