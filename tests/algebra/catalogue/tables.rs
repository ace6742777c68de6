//! The nilpotent algebras of dimension 7: their number is that of the classification, and the
//! algebras of step 2 are pairwise different.

use crate::algebra::structure::scrambled;
use crate::common::algebras::catalogued;
use affinor::algebra::catalogue;
use affinor::algebra::structure::{Killing, StructureTheory, Subspace};
use affinor::{LieAlgebra, Rational};
use affinor_tensors::linear::Matrix;
use std::collections::{BTreeMap, BTreeSet};

fn all() -> Vec<String> {
    catalogue::names(7).into_iter().filter(|name| name.starts_with("gong(7,")).collect()
}

/// The dimensions of the upper central series, which are the first digits of Gong's numbers.
fn class(name: &str) -> &str {
    let number = &name[7..name.len() - 1];
    number.find(|c: char| c.is_ascii_uppercase()).map_or(number, |letter| &number[..letter])
}

/// The names of the algebras of step 2.
fn names() -> Vec<String> {
    all().into_iter().filter(|name| class(name).len() == 2).collect()
}

/// Gong's list over the real numbers has 140 algebras and 9 families. The first digits of a number
/// are the dimensions of the upper central series. No algebra is a direct sum, and the invariants
/// are the same in a dense basis. If two numbers have equal invariants, they are real forms of one
/// complex algebra, or Gong's proof distinguishes them.
#[test]
fn all_nilpotent_algebras_of_dimension_seven() {
    let families = ["147E", "147E1", "1357M", "1357N", "1357S", "1357QRS1", "12457N", "12457N2"];
    let is_family = |name: &str| families.contains(&name) || name == "123457I";
    let mut known: BTreeMap<_, Vec<String>> = BTreeMap::new();
    let (mut single, mut with_parameter) = (0, 0);
    for name in all() {
        let number = &name[7..name.len() - 1];
        let full = match is_family(number) {
            true => format!("gong(7,{number},a=7/3)"),
            false => name.clone(),
        };
        *if is_family(number) { &mut with_parameter } else { &mut single } += 1;
        let mut found = BTreeSet::new();
        for algebra in [catalogued(&full), scrambled(&catalogued(&full), 2)] {
            let structure = StructureTheory::new(algebra);
            let sizes = |series: &[Subspace<Rational>]| -> Vec<usize> {
                series.iter().map(Subspace::dimension).collect()
            };
            let upper = sizes(&structure.upper_central_series());
            let digits: String = upper[1..].iter().map(usize::to_string).collect();
            assert_eq!(digits, class(&name), "{name}");
            let ideals = structure.indecomposable_ideals().unwrap().unwrap();
            assert_eq!(ideals.iter().map(|i| i.real_parts).collect::<Vec<_>>(), [1], "{name}");
            found.insert((
                upper,
                sizes(structure.lower_central_series()),
                structure.derivation_dimension().unwrap().dimension,
                structure.betti_numbers().unwrap().0,
            ));
        }
        assert_eq!(found.len(), 1, "{name}");
        for invariants in found {
            known.entry(invariants).or_default().push(number.to_string());
        }
    }
    assert_eq!([single, with_parameter], [140, 9]);
    // real forms of one complex algebra
    let together = |one: &str, other: &str| {
        known.values().any(|names| [one, other].iter().all(|n| names.iter().any(|name| name == n)))
    };
    for number in known.values().flatten().filter(|number| number.ends_with('1')) {
        let of = number.trim_end_matches('1');
        assert!(number == "1357QRS1" || together(number, of), "{number}");
    }
    assert!(together("12457N1", "12457N2"));
    assert_eq!(known.len(), 109);
}

/// The signature of the Pfaffian of `f([x, y])` on a complement of the centre of dimension 4. The
/// Pfaffian is a quadratic form in functionals `f` on the centre. Returns the numbers of squares of
/// either sign, the smaller first, because the sign depends on an orientation.
fn pfaffian(algebra: &LieAlgebra<Rational>) -> [usize; 2] {
    let centre = StructureTheory::new(algebra.clone()).centre();
    let outside: Vec<usize> = centre.complement().collect();
    let bracket = |f: &[i64; 3], j: usize, k: usize| {
        let dense = |i: usize| algebra.structure_constants().get(&[i, outside[j], outside[k]]);
        let row = (0..7).map(|i| (i, dense(i))).filter(|(_, v)| *v != Rational::from(0));
        let all = centre.coordinates(&row.collect::<Vec<_>>()).unwrap();
        all.into_iter().fold(Rational::from(0), |sum, (at, v)| sum + &(v * &Rational::from(f[at])))
    };
    let value = |f: [i64; 3]| {
        let product = |a, b, c, d| bracket(&f, a, b) * &bracket(&f, c, d);
        product(0, 1, 2, 3) + &product(0, 3, 1, 2) + &-product(0, 2, 1, 3)
    };
    let unit = |i: usize, j: usize| [0, 1, 2].map(|k| i64::from(i == k) + i64::from(j == k));
    let single = |i: usize| value([0, 1, 2].map(|k| i64::from(i == k)));
    let entry = |i: usize, j: usize| match i == j {
        true => single(i) * &Rational::from(2),
        false => value(unit(i, j)) + &-(single(i) + &single(j)),
    };
    let rows: Vec<Vec<Rational>> = (0..3).map(|i| (0..3).map(|j| entry(i, j)).collect()).collect();
    let form = Killing::new(Matrix::from_dense(&rows).unwrap());
    let [plus, minus, _] = form.signature().unwrap();
    [plus.min(minus), plus.max(minus)]
}

/// Gong's numbers begin with the dimensions of the upper central series; the classes have 1, 2 and 6 algebras. In each basis they are
/// nilpotent of step 2 and indecomposable, also over the real numbers, and have the same invariants, which differ.
#[test]
fn nilpotent_algebras_of_step_two() {
    let count = |class: &str| names().iter().filter(|name| name[7..].starts_with(class)).count();
    assert_eq!([names().len(), count("17"), count("27"), count("37")], [9, 1, 2, 6]);
    let mut known = BTreeSet::new();
    for name in names() {
        let mut found = BTreeSet::new();
        for algebra in
            [catalogued(&name), scrambled(&catalogued(&name), 1), scrambled(&catalogued(&name), 4)]
        {
            let structure = StructureTheory::new(algebra.clone());
            let dimensions: Vec<usize> =
                structure.upper_central_series().iter().map(Subspace::dimension).collect();
            assert_eq!(dimensions, [0, name[7..8].parse().unwrap(), 7], "{name}");
            assert_eq!(structure.lower_central_series().len(), 3, "{name}");
            let ideals = structure.indecomposable_ideals().unwrap().unwrap();
            assert_eq!(
                ideals.iter().map(|part| part.real_parts).collect::<Vec<_>>(),
                [1],
                "{name}"
            );
            let form = (dimensions[1] == 3).then(|| pfaffian(&algebra));
            let derivations = structure.derivation_dimension().unwrap().dimension;
            found.insert((dimensions, form, derivations, structure.betti_numbers().unwrap().0));
        }
        assert_eq!(found.len(), 1, "{name}");
        known.extend(found);
    }
    assert_eq!(known.len(), 9);
    // the Pfaffian in the order of the letters: zero, indefinite or definite of rank 2, rank 1, rank 3
    let forms = names().into_iter().filter(|name| name[7..].starts_with("37"));
    let forms: Vec<[usize; 2]> = forms.map(|name| pfaffian(&catalogued(&name))).collect();
    assert_eq!(forms, [[0, 0], [1, 1], [0, 2], [0, 1], [1, 2], [0, 3]]);
}

/// The quaternionic Heisenberg algebra has rank 3 and a definite Pfaffian. The sum of the complex
/// Heisenberg algebra and a line has an indefinite Pfaffian in two variables.
#[test]
fn algebras_of_other_families() {
    assert_eq!(pfaffian(&catalogued("gong(7,37D1)")), [0, 3]);
    let betti = |name: &str| StructureTheory::new(catalogued(name)).betti_numbers().unwrap().0;
    assert_eq!(betti("gong(7,17)"), betti("heisenberg(7)"));
    assert!(catalogue::algebra::<Rational>("gong(7,47A)").is_err());
}
