//! Values of letters for which a geometry has a property, against published classifications.

use affinor::algebra::catalogue;
use affinor::geometry::conditions::{
    Condition, ConditionSolutions, ParametricGeometry, SolutionPoint,
};
use affinor::geometry::homogeneous::HomogeneousSpace;
use affinor::tensors::polynomial::RealNumber;
use affinor::{Connection, LieAlgebra, Metric, ReductivePair};
use affinor_tensors::linear::Echelon;
use affinor_tensors::{Down, Rational, Ring, Symbolic, Tensor};
use std::collections::BTreeSet;

type Form = Tensor<Symbolic>;

fn parse(text: &str) -> Symbolic {
    text.parse().unwrap()
}

/// The metric with these entries, in the notation of rows: `a,0; 0,b`.
fn form(rows: &str) -> Form {
    let rows: Vec<Vec<Symbolic>> = rows
        .split(';')
        .map(|row| row.split(',').map(|entry| parse(entry.trim())).collect())
        .collect();
    Tensor::from_fn(rows.len(), [Down, Down], |[i, j]| rows[i][j].clone()).unwrap()
}

fn diagonal(entries: &str) -> Form {
    let entries: Vec<Symbolic> = entries.split(',').map(|entry| parse(entry.trim())).collect();
    Tensor::from_fn(entries.len(), [Down, Down], |[i, j]| match i == j {
        true => entries[i].clone(),
        false => Symbolic::from_i64(0),
    })
    .unwrap()
}

fn on_algebra(algebra: &LieAlgebra<Symbolic>, g: Form, condition: Condition) -> ConditionSolutions {
    let metric = Metric::new(algebra.labels(), g).unwrap();
    let connection = Connection::levi_civita(algebra.left_frame(), &metric).unwrap();
    let geometry = ParametricGeometry::new(&connection, Some(&metric), Some(algebra)).unwrap();
    ConditionSolutions::of(geometry, condition).unwrap()
}

fn on_group(name: &str, g: Form, condition: Condition) -> ConditionSolutions {
    on_algebra(&catalogue::algebra(name).unwrap(), g, condition)
}

/// The values of a point in the order of the letters, as text.
fn text(point: &SolutionPoint) -> String {
    point.values.iter().map(|(_, value)| value.to_string()).collect::<Vec<_>>().join(",")
}

fn points(found: &ConditionSolutions) -> BTreeSet<String> {
    found.points.iter().map(text).collect()
}

fn set(points: &[&str]) -> BTreeSet<String> {
    points.iter().map(|point| point.to_string()).collect()
}

/// The equations of the families.
fn families(found: &ConditionSolutions) -> BTreeSet<String> {
    let text = |family: &Vec<Symbolic>| {
        family.iter().map(Symbolic::to_string).collect::<Vec<_>>().join(", ")
    };
    found.families.iter().map(|family| text(&family.equations)).collect()
}

/// J. Milnor, *Adv. Math.* 21 (1976) 293-329: left-invariant metrics of unimodular groups of dimension
/// 3 in an orthogonal Milnor basis.
#[test]
fn milnor_metrics_of_dimension_three() {
    let g = || diagonal("a,b,c");
    let einstein = |name| on_group(name, g(), Condition::Einstein);
    // the sphere is round
    let round = einstein("so3");
    assert_eq!((points(&round), round.families.len()), (set(&["1,1,1"]), 0));
    assert_eq!(round.points[0].signature, Some([3, 0]));
    assert_eq!(round.points[0].constant.as_ref().unwrap().to_string(), "1/2");
    // Heisenberg and Sol have no Einstein metric
    assert!(einstein("heisenberg(3)").is_empty());
    let sol = on_group("bianchi(VI,h=-1)", g(), Condition::Einstein);
    assert!(sol.points.iter().all(|point| point.is_definite() == Some(false)));
    // the flat metrics of E(2) have two equal moments
    let flat = on_group("se2", g(), Condition::Flat);
    assert_eq!((points(&flat).len(), families(&flat)), (0, set(&["b - c"])));
    let sample = flat.families[0].sample.as_ref().unwrap();
    assert_eq!(sample.is_definite(), Some(true));
    // the anti-de Sitter metric: Lorentzian
    let sl2 = on_group("so(2,1)", g(), Condition::ConstantCurvature);
    assert_eq!((sl2.points.len(), sl2.families.len()), (1, 0));
    assert_eq!(sl2.points[0].is_definite(), Some(false));
    // every left-invariant metric of the Heisenberg group is a nilsoliton (J. Lauret)
    let nil = on_group("heisenberg(3)", g(), Condition::RicciSoliton);
    assert_eq!((families(&nil), nil.equations.len()), (set(&[""]), 0));
    assert_eq!(points(&on_group("so3", g(), Condition::BiInvariant)), set(&["1,1,1"]));
    assert!(on_group("so3", g(), Condition::Flat).is_empty());
    assert!(on_group("so3", g(), Condition::RicciFlat).is_empty());
}

const SU2: &str = "a,0,0,c,0,0; 0,a,0,0,c,0; 0,0,a,0,0,c; c,0,0,b,0,0; 0,c,0,0,b,0; 0,0,c,0,0,b";

/// SU(2)xSU(2) with the metrics that are invariant under the diagonal SU(2). The Einstein metrics are
/// the product of spheres with its two images under automorphisms, and the nearly Kaehler metric.
/// J. E. D'Atri, W. Ziller, *Mem. AMS* 215 (1979). Yu. G. Nikonorov, E. D. Rodionov, *Siberian Math.
/// J.* 44 (2003) 1-23.
#[test]
fn the_second_einstein_metric_of_a_product_of_spheres() {
    let so3: LieAlgebra<Symbolic> = catalogue::algebra("so3").unwrap();
    let sum = so3.direct_sum(&so3).unwrap();
    let found = on_algebra(&sum, form(SU2), Condition::Einstein);
    let expected = set(&["1,1,0", "1,1,-1/2", "1,2,-1", "1,1/2,-1/2"]);
    assert_eq!((points(&found), found.families.len()), (expected, 0));
    assert!(found.points.iter().all(|point| point.is_definite() == Some(true)));
    let symmetric = on_algebra(&sum, form(SU2), Condition::LocallySymmetric);
    // the nearly Kaehler metric is the only one that is not symmetric
    let product = |text: &str| text != "1,1,-1/2";
    let einstein = points(&found).into_iter().filter(|text| product(text));
    let covered =
        einstein.filter(|text| points(&symmetric).contains(text) || !symmetric.families.is_empty());
    assert_eq!(covered.count(), 3);
    assert!(!points(&symmetric).contains("1,1,-1/2"));
}

/// The pair of a homogeneous space with symbolic scalars.
fn pair(name: &str) -> ReductivePair<Symbolic> {
    let space = HomogeneousSpace::find(name).unwrap();
    let rational = space.pair();
    let algebra = rational.algebra().map(|x| Symbolic::constant(x.clone())).unwrap();
    let (n, r) = (algebra.dimension(), rational.dimension());
    let unit = |at: usize| (0..n).map(|i| Symbolic::from_i64(i64::from(i == at))).collect();
    let m: Vec<Vec<Symbolic>> = (0..r).map(unit).collect();
    let h: Vec<Vec<Symbolic>> = (r..n).map(unit).collect();
    ReductivePair::new(&algebra, &h, &m).unwrap()
}

/// The Killing form on `m` with a letter for each block of indices that `letter` chooses. The sign
/// is such that the form is positive definite on a compact group.
fn blocks(pair: &ReductivePair<Symbolic>, letter: impl Fn(usize) -> &'static str) -> Form {
    let killing = pair.algebra().killing_form();
    Tensor::from_fn(pair.dimension(), [Down, Down], |[i, j]| match letter(i) == letter(j) {
        true => -killing.get(&[i, j]) * &Symbolic::parameter(letter(i)),
        false => {
            assert!(killing.get(&[i, j]).vanishes(), "{i} {j}");
            Symbolic::from_i64(0)
        }
    })
    .unwrap()
}

fn on_space(pair: &ReductivePair<Symbolic>, g: Form, condition: Condition) -> ConditionSolutions {
    let metric = Metric::new(pair.frame().labels(), g).unwrap();
    let connection = pair.levi_civita(&metric).unwrap();
    let geometry = ParametricGeometry::new(&connection, Some(&metric), None).unwrap();
    ConditionSolutions::of(geometry, condition).unwrap()
}

/// The isotropy orbit of each index: the smallest sets of indices that the isotropy preserves.
fn summand(pair: &ReductivePair<Symbolic>, at: usize) -> BTreeSet<usize> {
    let mut set = BTreeSet::from([at]);
    loop {
        let linked = |i: usize, j: usize| {
            pair.isotropy().iter().any(|x| !x.get(&[i, j]).vanishes() || !x.get(&[j, i]).vanishes())
        };
        let next =
            (0..pair.dimension()).find(|i| !set.contains(i) && set.iter().any(|j| linked(*i, *j)));
        match next {
            Some(next) => drop(set.insert(next)),
            None => return set,
        }
    }
}

/// Letters in the order in which summands occur.
fn by_summand(pair: &ReductivePair<Symbolic>) -> Vec<&'static str> {
    let mut known: Vec<BTreeSet<usize>> = vec![];
    (0..pair.dimension())
        .map(|at| {
            let own = summand(pair, at);
            let found = known.iter().position(|other| *other == own).unwrap_or_else(|| {
                known.push(own);
                known.len() - 1
            });
            ["a", "b", "c", "d", "e", "f"][found]
        })
        .collect()
}

/// Letters for the fixed vectors of the isotropy, `t`, and for the other vectors, `s`.
fn by_fixed(pair: &ReductivePair<Symbolic>) -> Vec<&'static str> {
    (0..pair.dimension()).map(|at| if summand(pair, at).len() == 1 { "t" } else { "s" }).collect()
}

/// The values of the second letter where the first one is 1.
fn second(found: &ConditionSolutions) -> Vec<Rational> {
    assert!(found.families.is_empty());
    let values = found.points.iter().map(|point| {
        assert_eq!(point.values[0].1.rational(), Some(1.into()));
        assert_eq!(point.is_definite(), Some(true));
        point.values[1].1.rational().unwrap()
    });
    values.collect()
}

/// SU(3)/T has four Einstein metrics up to scale: the normal metric and three Kaehler metrics (A.
/// Arvanitoyeorgos, *Trans. AMS* 337 (1993) 981-995; M. Wang, W. Ziller).
#[test]
fn full_flags() {
    let flags = pair("SU(3)/T");
    let letters = by_summand(&flags);
    let g = blocks(&flags, |at| letters[at]);
    let found = on_space(&flags, g, Condition::Einstein);
    let expected = set(&["1,1,1", "1,1,2", "1,2,1", "1,1/2,1/2"]);
    assert_eq!((points(&found), found.families.len()), (expected, 0));
}

/// S^7, S^11 and S^15 as Sp(n+1)/Sp(n): the round metric, and the one of G. R. Jensen (*J. Diff.
/// Geom.* 8 (1973) 599-614), whose fibres are shorter by `1/(2n+3)` in dimension `4n+3`.
#[test]
fn jensen_spheres() {
    for (name, n) in [("Sp(2)/Sp(1)", 1), ("Sp(3)/Sp(2)", 2), ("Sp(4)/Sp(3)", 3)] {
        let sphere = pair(name);
        let letters = by_fixed(&sphere);
        let g = || blocks(&sphere, |at| letters[at]);
        let einstein = second(&on_space(&sphere, g(), Condition::Einstein));
        let round = second(&on_space(&sphere, g(), Condition::ConstantCurvature));
        let squashed = round[0].clone() / &Rational::from(2 * n + 3);
        assert_eq!((round.len(), einstein), (1, vec![squashed, round[0].clone()]), "{name}");
    }
}

/// CP^3 = Sp(2)/Sp(1)xU(1): the symmetric metric and the nearly Kaehler metric, whose fibres are
/// shorter by 1/2 (W. Ziller, *Math. Ann.* 259 (1982) 351-358).
#[test]
fn complex_projective_space() {
    let space = pair("Sp(2)/Sp(1)xU(1)");
    let letters = by_summand(&space);
    let g = || blocks(&space, |at| letters[at]);
    let einstein = second(&on_space(&space, g(), Condition::Einstein));
    let symmetric = second(&on_space(&space, g(), Condition::LocallySymmetric));
    assert_eq!((einstein.len(), symmetric.len()), (2, 1));
    assert!(einstein.contains(&symmetric[0]));
    let ratio = einstein[1].clone() / &einstein[0];
    assert_eq!(ratio, 2.into());
}

/// The general invariant metric, with a letter for each form of a basis, and the number of letters.
fn general(pair: &ReductivePair<Symbolic>) -> (Form, usize) {
    let n = pair.dimension();
    let mut span = Echelon::new();
    for form in pair.invariant_tensors(&[Down, Down]).unwrap() {
        let sum = form
            .components()
            .flat_map(|(at, x)| [(at[0] * n + at[1], x.clone()), (at[1] * n + at[0], x.clone())]);
        span.insert(sum).unwrap();
    }
    let letters = ["a", "b", "c", "d", "e", "f", "p", "q", "r", "s"];
    let entry = |[i, j]: [usize; 2]| {
        let rows = span.rows().iter().zip(letters);
        rows.fold(Symbolic::from_i64(0), |sum, (row, letter)| {
            let found = row.iter().find(|(at, _)| *at == i * n + j);
            found.map_or(sum.clone(), |(_, x)| sum + &(Symbolic::parameter(letter) * x))
        })
    };
    (Tensor::from_fn(n, [Down, Down], entry).unwrap(), span.rank())
}

/// V(2,R^5) has one Einstein metric among all invariant metrics (A. Back, W. Y. Hsiang, *Trans. AMS*
/// 300 (1987) 499-509; M. Kerr, *Tohoku Math. J.* 50 (1998) 445-465).
#[test]
fn stiefel_manifolds() {
    let space = pair("V(2,R^5)");
    let (g, letters) = general(&space);
    assert_eq!(letters, 4);
    let found = on_space(&space, g, Condition::Einstein);
    let definite = found.points.iter().filter(|point| point.is_definite() == Some(true));
    assert_eq!(definite.count(), 1);
    let samples = found.families.iter().filter_map(|family| family.sample.as_ref());
    assert!(samples.into_iter().all(|sample| sample.is_definite() == Some(false)));
}

/// The Aloff-Wallach space SU(3)/U(1)_{1,2} has two invariant Einstein metrics (L. Castellani, L. J.
/// Romans, *Nucl. Phys.* B 238 (1984) 683-701; D. N. Page, C. N. Pope, *Phys. Lett.* B 147 (1984)
/// 55-60). Their ratios are irrational.
#[test]
fn aloff_wallach() {
    let space = pair("SU(3)/U(1)_{1,2}");
    let (g, letters) = general(&space);
    assert_eq!(letters, 4);
    let found = on_space(&space, g, Condition::Einstein);
    assert_eq!((found.points.len(), found.families.len()), (2, 0));
    for point in &found.points {
        assert_eq!(point.is_definite(), Some(true));
        assert!(point.values[1].1.rational().is_none());
    }
}

/// The space of Ledger and Obata SU(2)^3/SU(2) is the group SU(2)xSU(2), with the same metrics.
#[test]
fn ledger_and_obata() {
    let space = pair("SU(2)xSU(2)xSU(2)/SU(2)");
    let (g, letters) = general(&space);
    assert_eq!(letters, 3);
    let found = on_space(&space, g, Condition::Einstein);
    let definite = found.points.iter().filter(|point| point.is_definite() == Some(true));
    assert_eq!((definite.count(), found.families.len()), (4, 0));
}

/// Solutions do not depend on the basis of the algebra, the names of the letters, or their scale.
#[test]
fn changes_of_basis_and_of_letters() {
    let so3: LieAlgebra<Symbolic> = catalogue::algebra("so3").unwrap();
    let reference = on_algebra(&so3, diagonal("a,b,c"), Condition::Einstein);
    // e1' = e1 + e2, with the metric in the new basis
    let change = Tensor::from_fn(3, [affinor_tensors::Up, Down], |[i, j]| {
        Symbolic::from_i64(i64::from(i == j || (i, j) == (1, 0)))
    });
    let change = affinor::algebra::BasisChange::new(change.unwrap()).unwrap();
    let moved = so3.change_basis(&change).unwrap();
    let g = change.apply(&diagonal("a,b,c")).unwrap();
    assert_eq!(points(&on_algebra(&moved, g, Condition::Einstein)), points(&reference));
    for (entries, expected) in
        [("c,a,b", "1,1,1"), ("2*a,3*b,5*c", "1,2/3,2/5"), ("-a,b,c", "1,-1,-1")]
    {
        let found = on_algebra(&so3, diagonal(entries), Condition::Einstein);
        assert_eq!(points(&found), set(&[expected]), "{entries}");
    }
    // letters that are not factors of the determinant: all strata are searched
    let split = "a+b,0,0; 0,a-b,0; 0,0,c";
    let found = on_algebra(&so3, form(split), Condition::Einstein);
    assert_eq!((points(&found), found.families.len()), (set(&["1,0,1"]), 0));
}

/// A random metric of SU(2), conjugated from a diagonal one, is Einstein only if it is round.
#[test]
fn all_metrics_of_the_three_sphere() {
    let all = "a,d,e; d,b,f; e,f,c";
    let found = on_group("so3", form(all), Condition::BiInvariant);
    assert_eq!(points(&found), set(&["1,1,1,0,0,0"]));
    let found = on_group("so3", form("a,d,0; d,b,0; 0,0,c"), Condition::Einstein);
    assert_eq!((points(&found), found.families.len()), (set(&["1,1,1,0"]), 0));
}

/// Letters in brackets: the unimodular and the hyperbolic members of a family.
#[test]
fn letters_in_brackets() {
    let bracket = affinor::Bracket::from_fn(&["x", "y", "z"], |j, k| match (j, k) {
        (0, 1) => vec![(1, parse("p"))],
        (0, 2) => vec![(2, parse("q"))],
        _ => vec![],
    });
    let algebra = LieAlgebra::try_from(bracket.unwrap()).unwrap();
    let found = on_algebra(&algebra, diagonal("1,1,1"), Condition::ConstantCurvature);
    assert_eq!((points(&found).len(), families(&found)), (0, set(&["p - q"])));
    let flat = on_algebra(&algebra, diagonal("1,1,1"), Condition::Flat);
    assert_eq!((points(&flat), flat.families.len()), (set(&["0,0"]), 0));
    assert!(flat.scaled.is_empty());
    // the metric is scaled, the brackets are not
    let einstein = on_algebra(&algebra, diagonal("a,b,c"), Condition::Einstein);
    assert_eq!((families(&einstein), einstein.scaled.len()), (set(&["p - q"]), 3));
}

#[test]
fn invalid_input() {
    let so3: LieAlgebra<Symbolic> = catalogue::algebra("so3").unwrap();
    let solve = |g: Form, condition| {
        let metric = Metric::new(so3.labels(), g).unwrap();
        let connection = Connection::levi_civita(so3.left_frame(), &metric).unwrap();
        let geometry = ParametricGeometry::new(&connection, Some(&metric), None).unwrap();
        ConditionSolutions::of(geometry, condition).map(|_| ()).unwrap_err().to_string()
    };
    assert!(solve(diagonal("1,2,3"), Condition::Einstein).starts_with("nothing to solve for"));
    assert!(solve(diagonal("a,b,c"), Condition::BiInvariant).contains("algebra of a group"));
    assert!(solve(diagonal("sqrt(a),b,c"), Condition::Einstein).contains("functions"));
    let plus = Connection::canonical(&so3, affinor::CanonicalConnection::Plus);
    let metric = Metric::new(so3.labels(), diagonal("a,b,c")).unwrap();
    let geometry = ParametricGeometry::new(&plus, None, Some(&so3)).unwrap();
    assert!(ConditionSolutions::of(geometry, Condition::Flat).is_err());
    // a limit of the effort
    let connection = Connection::levi_civita(so3.left_frame(), &metric).unwrap();
    let geometry = ParametricGeometry::new(&connection, Some(&metric), Some(&so3)).unwrap();
    let limited = ConditionSolutions::within(geometry, Condition::Einstein, Some(1));
    assert!(limited.unwrap_err().to_string().contains("too large"));
}

/// Irrational solutions are isolated, and satisfy the equations.
#[test]
fn irrational_values() {
    // 2 a = b on the letters: an Einstein metric with b^2 = 2
    let so3: LieAlgebra<Symbolic> = catalogue::algebra("so3").unwrap();
    let found = on_algebra(&so3, diagonal("1,p^2 - 1,q^3 - q - 4"), Condition::Einstein);
    let expected = RealNumber::roots(&[-5, -1, 0, 1].map(Rational::from));
    assert_eq!(found.points.len(), 2);
    for point in &found.points {
        assert_eq!(point.values[0].1.polynomial(), [-2, 0, 1].map(Rational::from));
        assert!(point.values[1].1 == expected[0]);
    }
}
