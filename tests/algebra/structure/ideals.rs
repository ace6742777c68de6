//! The ideals and subalgebras that the structure theory finds, checked with the bracket alone.

use crate::algebra::structure::{regular, scrambled, stored};
use crate::common::algebras::{by_table, catalogued};
use affinor::algebra::roots::{CartanType, Series};
use affinor::algebra::structure::real_forms::real_forms;
use affinor::algebra::structure::{StructureTheory, Subspace};
use affinor::{Error, Law, LieAlgebra, Rational};
use affinor_tensors::Ring;
use affinor_tensors::linear::{Echelon, Matrix};
use serde_json::Value;

type Vector = Vec<Rational>;

/// The echelon form of the brackets of two lists of vectors.
fn brackets(algebra: &LieAlgebra<Rational>, v: &[Vector], w: &[Vector]) -> Echelon<Rational> {
    let mut span = Echelon::new();
    for x in v {
        for y in w {
            let bracket = algebra.bracket(x, y).unwrap();
            span.insert(bracket.into_iter().enumerate()).unwrap();
        }
    }
    span
}

fn within(span: &Echelon<Rational>, subspace: &Subspace<Rational>) -> bool {
    span.rows().iter().all(|row| subspace.contains(row))
}

fn dense(span: &Echelon<Rational>, n: usize) -> Vec<Vector> {
    let vector = |row: &Vec<(usize, Rational)>| {
        let mut vector = vec![Rational::from(0); n];
        row.iter().for_each(|(at, value)| vector[*at] = value.clone());
        vector
    };
    span.rows().iter().map(vector).collect()
}

/// Whether repeated brackets with `by` lead to zero.
fn dies(algebra: &LieAlgebra<Rational>, start: &[Vector], by: Option<&[Vector]>) -> bool {
    let mut layer = start.to_vec();
    for _ in 0..=start.len() {
        let next = brackets(algebra, &layer, by.unwrap_or(&layer));
        layer = dense(&next, algebra.dimension());
    }
    layer.is_empty()
}

fn killing_on(algebra: &LieAlgebra<Rational>, vectors: &[Vector]) -> Matrix<Rational> {
    let rows = Matrix::from_dense(vectors).unwrap();
    let form = algebra.killing_form();
    let n = algebra.dimension();
    let all = (0..n).map(|i| (0..n).map(|j| form.get(&[i, j])).collect()).collect::<Vec<Vector>>();
    let form = Matrix::from_dense(&all).unwrap();
    rows.mul(&form).unwrap().mul(&rows.transpose()).unwrap()
}

fn multiply_out(algebra: LieAlgebra<Rational>, name: &str) {
    let structure = StructureTheory::new(algebra);
    let (algebra, n) = (structure.algebra(), structure.dimension());
    let all = structure.whole().dense();

    let radical = structure.radical();
    assert!(within(&brackets(algebra, &all, &radical.dense()), radical), "ideal: {name}");
    assert!(dies(algebra, &radical.dense(), None), "solvable: {name}");

    let nilradical = structure.nilradical();
    assert!(within(&brackets(algebra, &all, &nilradical.dense()), &nilradical), "{name}");
    assert!(dies(algebra, &nilradical.dense(), Some(&nilradical.dense())), "nilpotent: {name}");

    let centre = structure.centre();
    assert_eq!(brackets(algebra, &all, &centre.dense()).rank(), 0, "{name}");

    let cartan = structure.cartan_subalgebra();
    let h = cartan.dense();
    assert!(within(&brackets(algebra, &h, &h), &cartan) && dies(algebra, &h, Some(&h)), "{name}");
    assert_eq!(structure.normalizer(&cartan), cartan, "{name}");

    let levi = structure.levi().unwrap();
    let s = levi.dense();
    assert!(within(&brackets(algebra, &s, &s), levi), "closed: {name}");
    assert_eq!(levi.dimension() + radical.dimension(), n, "{name}");
    assert!(regular(&[levi.dense(), radical.dense()].concat()), "complement: {name}");
    if !levi.is_zero() {
        // the radical of the Killing form of the algebra is in the solvable radical
        let form = killing_on(algebra, &s);
        assert_eq!(form.rank().unwrap(), levi.dimension(), "semisimple: {name}");
    }

    let killing = structure.killing();
    let basis: Vec<Vector> = killing
        .basis
        .iter()
        .map(|row| Subspace::span(n, [row.clone()]).dense().remove(0))
        .collect();
    let diagonal = killing_on(algebra, &basis);
    assert!(diagonal.entries().all(|(i, j, value)| i == j && !value.vanishes()), "{name}");
    assert!(regular(&basis), "{name}");
}

#[test]
fn stored_algebras() {
    for (algebra, entry) in stored() {
        multiply_out(algebra, entry["name"].as_str().unwrap());
    }
}

#[test]
fn dense_bases() {
    for (at, (algebra, entry)) in stored().into_iter().enumerate() {
        if algebra.dimension() <= 8 {
            multiply_out(scrambled(&algebra, at as i64), entry["name"].as_str().unwrap());
        }
    }
}

/// The dimensions of the indecomposable ideals. The ideals must commute and span the algebra.
#[test]
fn indecomposable_ideals() {
    let decompose = |algebra: LieAlgebra<Rational>| {
        let structure = StructureTheory::new(algebra);
        let found = structure.indecomposable_ideals().unwrap().unwrap();
        for (at, one) in found.iter().enumerate() {
            for other in &found[at + 1..] {
                let both = brackets(structure.algebra(), &one.ideal.dense(), &other.ideal.dense());
                assert_eq!(both.rank(), 0);
            }
        }
        let all: Vec<Vector> = found.iter().flat_map(|one| one.ideal.dense()).collect();
        assert!(regular(&all) && all.len() == structure.dimension());
        let mut dimensions: Vec<usize> = found.iter().map(|one| one.ideal.dimension()).collect();
        dimensions.sort_unstable();
        (dimensions, found.iter().map(|one| one.real_parts).sum::<usize>())
    };
    for (at, (algebra, entry)) in stored().into_iter().enumerate() {
        if algebra.dimension() > 10 {
            continue;
        }
        let mut expected: Vec<usize> =
            serde_json::from_value(entry["indecomposable_over_Q"].clone()).unwrap();
        expected.sort_unstable();
        assert_eq!(decompose(algebra.clone()).0, expected, "{}", entry["name"]);
        if algebra.dimension() <= 6 {
            let moved = decompose(scrambled(&algebra, at as i64));
            assert_eq!(moved.0, expected, "{}", entry["name"]);
        }
    }
    let named = |wanted: &str| {
        let found = stored().into_iter().find(|(_, entry)| entry["name"] == wanted);
        decompose(found.unwrap_or_else(|| panic!("{wanted}")).0)
    };
    assert_eq!(named("L6,22(2)"), (vec![6], 2));
    assert_eq!(named("L6,22(-1)"), (vec![6], 1));
    assert_eq!(named("sl(2) over Q(sqrt 2)"), (vec![6], 2));
    assert_eq!(named("so(3,1)"), (vec![6], 1));
}

/// The names of the real simple ideals, sorted.
fn ideals(algebra: LieAlgebra<Rational>) -> Vec<String> {
    let structure = StructureTheory::new(algebra);
    let found = structure.simple_ideals().unwrap().unwrap();
    let (all, n) = (structure.whole().dense(), structure.dimension());
    let mut rows = vec![];
    for (at, ideal) in found.rational.iter().enumerate() {
        assert!(within(&brackets(structure.algebra(), &all, &ideal.dense()), ideal));
        let real = found.real.iter().filter(|real| real.within == at);
        assert_eq!(real.map(|real| real.dimension()).sum::<usize>(), ideal.dimension());
        rows.extend(ideal.dense());
    }
    assert!(rows.len() == n && regular(&rows));
    let mut names: Vec<String> = found.real.iter().map(|real| real.names.join(" or ")).collect();
    names.sort();
    names
}

#[test]
fn simple_ideals_over_the_reals() {
    let cases = [
        ("so(4)", vec!["su(2)", "su(2)"]),
        ("so(3,1)", vec!["sl(2,C)"]),
        ("so(2,2)", vec!["sl(2,R)", "sl(2,R)"]),
        ("sl(3)+so(3)", vec!["sl(3,R)", "su(2)"]),
        ("so(3,1)+so(3,1)", vec!["sl(2,C)", "sl(2,C)"]),
        ("so(4,1)+sp(6)", vec!["so(4,1)", "sp(6,R)"]),
        ("so(7)", vec!["so(7)"]),
        ("so(4,2)", vec!["su(2,2)"]),
        ("so(5,1)", vec!["su*(4)"]),
        ("so(3,3)", vec!["sl(4,R)"]),
        ("G2", vec!["g2(2)"]),
        ("sp(6)+so(4,3)", vec!["so(4,3)", "sp(6,R)"]),
    ];
    for (name, expected) in cases {
        assert_eq!(ideals(catalogued(name)), expected, "{name}");
        if name.len() < 9 {
            assert_eq!(ideals(scrambled(&catalogued(name), 1)), expected, "{name}");
        }
    }
}

/// Algebras whose ideals over the rationals differ from those over the reals.
#[test]
fn ideals_that_depend_on_the_field() {
    let named = |wanted: &str| {
        let found = stored().into_iter().find(|(_, entry)| entry["name"] == wanted);
        ideals(found.unwrap_or_else(|| panic!("{wanted}")).0)
    };
    assert_eq!(named("sl(2) over Q(sqrt 2)"), ["sl(2,R)", "sl(2,R)"]);
    assert_eq!(named("sl(2) over Q(i)"), ["sl(2,C)"]);
    assert_eq!(named("so(x^2+y^2+sqrt2 z^2) over Q(sqrt 2)"), ["sl(2,R)", "su(2)"]);
    assert_eq!(named("so(x^2+y^2+z^2+2w^2)"), ["su(2)", "su(2)"]);
    assert_eq!(named("so(x^2+y^2-3z^2)"), ["sl(2,R)"]);
}

/// The names of all real forms of rank up to 8 and 10 are found from type and signature.
#[test]
fn names_of_real_forms() {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/data/structure/real_forms.json");
    let data: Value = serde_json::from_str(&std::fs::read_to_string(path).unwrap()).unwrap();
    let other = |name: &str| match name {
        "su(1,1)" => "sl(2,R)".to_string(),
        // the catalogue's sp(n) is the split form of another type
        name => match name.strip_prefix("sp(").and_then(|rest| rest.strip_suffix(",0)")) {
            Some(n) => format!("usp({})", 2 * n.parse::<usize>().unwrap()),
            None => name.replace(",0)", ")"),
        },
    };
    let mut count = 0;
    for form in data["real_forms"].as_array().unwrap() {
        let name = form["name"].as_str().unwrap();
        let text = form["type"].as_str().unwrap();
        let series = [Series::A, Series::B, Series::C, Series::D, Series::E, Series::F, Series::G];
        let series = series.into_iter().find(|s| s.to_string() == text[..1]).unwrap();
        let cartan_type = CartanType::new(series, text[1..].parse().unwrap()).unwrap();
        let compact = form["maximal_compact"].as_u64().unwrap() as usize;
        let names = real_forms(cartan_type, compact);
        assert!(!names.is_empty(), "{name}");
        if !(text.starts_with('E') || text.starts_with('F') || text.starts_with('G')) {
            let known =
                names.contains(&other(name)) || text == "D3" || text == "D4" || text == "C2";
            assert!(known, "{name}: {names:?}");
        }
        count += 1;
    }
    assert!(count > 150);
    // the two families in which type and signature allow two forms
    let a13 = CartanType::new(Series::A, 13).unwrap();
    assert_eq!(real_forms(a13, 105), ["su(9,5)", "su*(14)"]);
    let d9 = CartanType::new(Series::D, 9).unwrap();
    assert_eq!(real_forms(d9, 81), ["so(12,6)", "so*(18)"]);
}

/// Arguments that do not belong to an algebra, or belong to another one.
#[test]
fn constructions_refuse_what_does_not_fit() {
    let plane = StructureTheory::new(catalogued("R^2"));
    let one = || Rational::from(1);
    // the index 2 would be the new vector, which would not be central then
    for at in [(0, 2), (2, 1), (0, usize::MAX)] {
        let extended = plane.central_extension(&["z".into()], [(at.0, at.1, 0, one())]);
        assert!(matches!(extended, Err(Error::Shape { .. })), "{extended:?}");
    }
    let extended = plane.central_extension(&["z".into()], [(0, 1, 0, one())]).unwrap();
    assert_eq!(StructureTheory::new(extended).centre().dimension(), 1);
    let other = Subspace::span(3, [vec![(2, one())]]);
    assert!(matches!(plane.quotient(&other), Err(Error::Shape { .. })));
    // weights w_j + w_k > w_i lead to an abelian limit, however large they are
    let so3 = StructureTheory::new(catalogued("so(3)"));
    for weight in [1, i64::MAX] {
        assert!(
            so3.inonu_wigner_contraction(&[weight; 3]).unwrap().structure_constants().is_empty()
        );
        assert!(matches!(
            so3.inonu_wigner_contraction(&[-weight; 3]),
            Err(Error::Broken { law: Law::Limit, .. })
        ));
    }
}

/// Rotations of the form `diag(1, 1, a)` over the field of `a^3 = 3 a - 1`, whose roots are -1.88, 0.35 and 1.53: two ideals over
/// the reals are compact, one is not.
#[test]
fn a_field_with_three_real_places() {
    let power = |k: usize| {
        let mut value = [1, 0, 0];
        (0..k).for_each(|_| value = [-value[2], value[0] + 3 * value[2], value[1]]);
        value
    };
    let mut brackets = vec![];
    for (j, k) in (0..3).flat_map(|j| (0..3).map(move |k| (j, k))) {
        // [e_1, e_2] = e_3, [e_2, e_3] = a e_1, [e_3, e_1] = a e_2
        for (first, second, third, factor) in [(0, 1, 2, 0), (1, 2, 0, 1), (2, 0, 1, 1)] {
            let terms = power(j + k + factor).into_iter().enumerate().filter(|(_, v)| *v != 0);
            brackets.extend(terms.map(|(l, value)| {
                (3 * first + j + 1, 3 * second + k + 1, 3 * third + l + 1, value)
            }));
        }
    }
    let structure = StructureTheory::new(by_table(9, &brackets));
    let ideals = structure.simple_ideals().unwrap().unwrap();
    assert_eq!(ideals.rational.len(), 1);
    let mut signatures: Vec<_> = ideals.real.iter().map(|ideal| ideal.signature).collect();
    signatures.sort_unstable();
    assert_eq!(signatures, [[0, 3], [0, 3], [2, 1]]);
}
