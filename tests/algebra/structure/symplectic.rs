//! Closed forms of low degree, symplectic and contact forms: checked by multiplication and against
//! published lists.

use crate::algebra::structure::{scrambled, stored};
use crate::common::algebras::{by_table, catalogued, symbolic};
use affinor::algebra::catalogue;
use affinor::algebra::structure::{Certified, Existence, StructureTheory};
use affinor::{LieAlgebra, LiePoisson, Rational, Symbolic};
use affinor_tensors::Ring;
use affinor_tensors::linear::{Matrix, Row};
use std::collections::{BTreeMap, BTreeSet};

type Dense = Vec<Vec<Rational>>;

fn matrix_of(n: usize, form: &Row<Rational>) -> Dense {
    let mut matrix = vec![vec![Rational::from(0); n]; n];
    for (at, value) in form {
        assert!(at / n < at % n);
        matrix[at / n][at % n] = value.clone();
        matrix[at % n][at / n] = -value.clone();
    }
    matrix
}

fn brackets(algebra: &LieAlgebra<Rational>) -> Vec<Dense> {
    let unit =
        |n: usize, i: usize| (0..n).map(|j| Rational::from(i64::from(i == j))).collect::<Vec<_>>();
    let n = algebra.dimension();
    let row = |i| (0..n).map(|j| algebra.bracket(&unit(n, i), &unit(n, j)).unwrap()).collect();
    (0..n).map(row).collect()
}

fn pairing(a: &[Rational], b: &[Rational]) -> Rational {
    a.iter().zip(b).fold(Rational::from(0), |sum, (a, b)| sum + &(a.clone() * b))
}

/// Checks `b([x, y], z) + b([y, z], x) + b([z, x], y) = 0` on the basis.
fn assert_closed(algebra: &LieAlgebra<Rational>, form: &Dense, name: &str) {
    let (n, c) = (algebra.dimension(), brackets(algebra));
    for (x, y, z) in (0..n).flat_map(|x| (0..n).flat_map(move |y| (0..n).map(move |z| (x, y, z)))) {
        let term = |x: usize, y: usize, z: usize| {
            let column: Vec<Rational> = form.iter().map(|row| row[z].clone()).collect();
            pairing(&c[x][y], &column)
        };
        assert!((term(x, y, z) + &term(y, z, x) + &term(z, x, y)).vanishes(), "{name}");
    }
}

fn differential(algebra: &LieAlgebra<Rational>, form: &[Rational]) -> Dense {
    let values = |row: &Dense| row.iter().map(|bracket| -pairing(bracket, form)).collect();
    brackets(algebra).iter().map(values).collect()
}

fn rank(matrix: &Dense) -> usize {
    Matrix::from_dense(matrix).unwrap().rank().unwrap()
}

fn dense(n: usize, row: &Row<Rational>) -> Vec<Rational> {
    let mut vector = vec![Rational::from(0); n];
    row.iter().for_each(|(at, value)| vector[*at] = value.clone());
    vector
}

/// Whether there is a symplectic form; checks the witness by multiplication.
fn is_symplectic(algebra: LieAlgebra<Rational>, name: &str) -> Option<bool> {
    let structure = StructureTheory::new(algebra);
    let forms = structure.two_forms().unwrap();
    match structure.symplectic_form(&forms) {
        Existence::Witness(form) => {
            let form = matrix_of(structure.dimension(), &form);
            assert_closed(structure.algebra(), &form, name);
            assert_eq!(rank(&form), structure.dimension(), "{name}");
            Some(true)
        }
        Existence::Impossible
        | Existence::Unimodular
        | Existence::Index(_)
        | Existence::Rank(_) => Some(false),
        Existence::Open => None,
    }
}

/// Whether there is a contact form. Checks that `a` is not zero on the kernel of `d a`, a line.
fn is_contact(algebra: LieAlgebra<Rational>, name: &str) -> Option<bool> {
    let structure = StructureTheory::new(algebra);
    let n = structure.dimension();
    match structure.contact_form() {
        Existence::Witness(form) => {
            let form = dense(n, &form);
            let differential = differential(structure.algebra(), &form);
            assert_eq!(rank(&differential), n - 1, "{name}");
            let mut with = differential;
            with.push(form);
            assert_eq!(rank(&with), n, "{name}");
            Some(true)
        }
        Existence::Impossible
        | Existence::Unimodular
        | Existence::Index(_)
        | Existence::Rank(_) => Some(false),
        Existence::Open => None,
    }
}

#[test]
fn cocycles_of_stored_algebras() {
    for (at, (algebra, entry)) in stored().into_iter().enumerate() {
        let name = entry["name"].as_str().unwrap();
        let n = algebra.dimension();
        if n > 7 {
            continue;
        }
        for algebra in [algebra.clone(), scrambled(&algebra, at as i64)] {
            let structure = StructureTheory::new(algebra);
            let betti = structure.betti_numbers().unwrap().0;
            let one = structure.closed_one_forms();
            assert_eq!(one.dimension() as u64, betti[1], "{name}");
            for form in one.dense() {
                assert_eq!(rank(&differential(structure.algebra(), &form)), 0, "{name}");
            }
            let two = structure.two_forms().unwrap().cohomology();
            assert_eq!(two.len() as u64, betti.get(2).copied().unwrap_or(0), "{name}");
            for form in &two {
                assert_closed(structure.algebra(), &matrix_of(n, form), name);
            }
            // f([x, y]) has the generic rank
            let regular = dense(n, &structure.regular_form().unwrap());
            let index = entry["index"].as_u64().unwrap() as usize;
            assert_eq!(rank(&differential(structure.algebra(), &regular)), n - index, "{name}");
            let exact = structure.exact_symplectic_form(&structure.two_forms().unwrap());
            assert_eq!(matches!(exact, Existence::Witness(_)), index == 0, "{name}");
        }
    }
}

/// G. Ovando, *Beitrage Algebra Geom.* 47 (2006) 419-434: the symplectic algebras of dimension 4.
#[test]
fn symplectic_algebras_of_dimension_four() {
    let symplectic = [
        "heisenberg(3)+R^1",
        "aff(1)+R^2",
        "bianchi(VI,h=-1)+R^1",
        "bianchi(VII,h=0)+R^1",
        "aff(1)+aff(1)",
        "patera(4,12)",
        "patera(4,1)",
        "patera(4,3)",
        "patera(4,2,a=-1)",
        "patera(4,5,a=-1,b=1/2)",
        "patera(4,5,a=-1/2,b=1/2)",
        "patera(4,6,a=3,b=0)",
        "patera(4,7)",
        "patera(4,9,b=1)",
        "patera(4,9,b=0)",
        "patera(4,9,b=-1/2)",
        "patera(4,11,a=1)",
        "R^4",
    ];
    let others = [
        "bianchi(VIII)+R^1",
        "bianchi(IX)+R^1",
        "bianchi(IV)+R^1",
        "bianchi(V)+R^1",
        "bianchi(VI,h=1/2)+R^1",
        "bianchi(VII,h=1)+R^1",
        "patera(4,2,a=1)",
        "patera(4,2,a=2)",
        "patera(4,4)",
        "patera(4,5,a=1/2,b=1)",
        "patera(4,6,a=1,b=1)",
        "patera(4,8)",
        "patera(4,10)",
    ];
    for (expected, names) in [(true, &symplectic[..]), (false, &others[..])] {
        for (at, name) in names.iter().enumerate() {
            for algebra in [catalogued(name), scrambled(&catalogued(name), at as i64)] {
                assert_eq!(is_symplectic(algebra, name), Some(expected), "{name}");
            }
        }
    }
}

/// Of the 34 real nilpotent algebras of dimension 6 all but 8 are symplectic: S. Salamon, *J. Pure Appl. Algebra* 157
/// (2001) 311-333; M. Goze and Y. Khakimdjanov, *Nilpotent Lie Algebras* (1996).
#[test]
fn symplectic_nilpotent_algebras_of_dimension_six() {
    let mut names = BTreeSet::from(["R^6".to_string()]);
    for small in 2..=6 {
        for name in catalogue::names(small).into_iter().filter(|name| name.starts_with("degraaf")) {
            let family = ["6,19)", "6,21)", "6,22)", "6,24)"].iter().any(|end| name.ends_with(end));
            let values: &[&str] = if family { &[",e=0", ",e=1", ",e=-1"] } else { &[""] };
            for value in values {
                let name = name.replace(')', &format!("{value})"));
                let rest = if small < 6 { format!("+R^{}", 6 - small) } else { String::new() };
                names.insert(name + &rest);
            }
        }
    }
    assert_eq!(names.len(), 34, "{names:?}");
    let symplectic = names.iter().filter(|name| is_symplectic(catalogued(name), name).unwrap());
    assert_eq!(symplectic.count(), 26);
}

/// Unimodular algebras that are not solvable have no symplectic form; here the Pfaffian is too
/// large to be expanded.
#[test]
fn unimodular_algebras_without_symplectic_forms() {
    for name in ["iso(3,1)", "so(3)+sl(2)+R^4", "galilei(3)"] {
        assert_eq!(is_symplectic(catalogued(name), name), Some(false), "{name}");
    }
    assert_eq!(is_symplectic(catalogued("patera(4,7)+filiform(4)+R^2"), "sum"), Some(true));
}

#[test]
fn contact_algebras() {
    for name in [
        "heisenberg(3)",
        "heisenberg(5)",
        "heisenberg(7)",
        "so(3)",
        "sl(2)",
        "degraaf(5,5)",
        "degraaf(5,6)",
    ] {
        assert_eq!(is_contact(catalogued(name), name), Some(true), "{name}");
        assert_eq!(is_contact(scrambled(&catalogued(name), 3), name), Some(true), "{name}");
    }
    // index at least 3; Bianchi V: the 2-form d a has the factor a modulo the rest
    for name in
        ["R^3", "bianchi(V)", "degraaf(5,7)", "degraaf(5,8)", "degraaf(5,9)", "sl(2)+sl(2)+R^1"]
    {
        assert_eq!(is_contact(catalogued(name), name), Some(false), "{name}");
    }
    // without an expanded Pfaffian, by a proved lower bound of the index
    for name in [
        "so(3)+so(3)+so(3)",
        "heisenberg(3)+heisenberg(3)+heisenberg(3)",
        "iso(3,1)+R^1",
        "filiform(9)",
        "so(4,1)+R^3",
    ] {
        let structure = StructureTheory::new(catalogued(name));
        let index = structure.index().dimension;
        assert!(index >= 3, "{name}");
        assert_eq!(structure.contact_form(), Existence::Index(index), "{name}");
    }
    let structure = StructureTheory::new(catalogued("bianchi(V)+bianchi(V)+aff(1)+R^2"));
    let exact = structure.exact_symplectic_form(&structure.two_forms().unwrap());
    assert_eq!(exact, Existence::Index(structure.index().dimension));
}

#[test]
fn casimir_functions() {
    let degrees = |name: &str, most: u32| -> Vec<usize> {
        let found = StructureTheory::new(catalogued(name)).casimirs(most).unwrap();
        let degree = |polynomial: &affinor::Symbolic| {
            let terms = polynomial.terms();
            terms[0].0.iter().map(|(_, power)| *power as usize).sum::<usize>()
        };
        found.iter().map(degree).collect()
    };
    assert_eq!(degrees("so(3)", 4), [2]);
    assert_eq!(degrees("sl(3)", 3), [2, 3]);
    assert_eq!(degrees("heisenberg(5)", 4), [1]);
    assert_eq!(degrees("iso(2,1)", 3), [2, 2]);
    // invariants x/y and x exp(-y/x)
    assert_eq!(degrees("bianchi(V)", 4), [0usize; 0]);
    assert_eq!(degrees("bianchi(IV)", 4), [0usize; 0]);
    assert_eq!(degrees("patera(4,8)", 3), [1, 2]);
}

/// With parameters the answers hold for generic values: at values that are not exceptional the
/// witness is still valid.
#[test]
fn forms_with_parameters() {
    let at = |name: &str, letter: &str| {
        let value: BTreeMap<String, Symbolic> =
            [(letter.to_string(), Symbolic::constant(Rational::from(3)))].into();
        let generic = StructureTheory::new(catalogue::algebra::<Symbolic>(name).unwrap());
        (generic, move |v: &Symbolic| v.substitute(&value).unwrap().as_constant().cloned().unwrap())
    };
    let special =
        |name: &str, letter: &str| catalogued(&name.replace(')', &format!(",{letter}=3)")));
    for (name, letter) in [("patera(4,9)", "b"), ("degraaf(6,21)", "e"), ("degraaf(6,24)", "e")] {
        let (generic, value) = at(name, letter);
        let forms = generic.two_forms().unwrap();
        let Existence::Witness(form) = generic.symplectic_form(&forms) else { panic!("{name}") };
        let form: Row<Rational> = form.iter().map(|(at, v)| (*at, value(v))).collect();
        let n = generic.dimension();
        assert_closed(&special(name, letter), &matrix_of(n, &form), name);
        assert_eq!(rank(&matrix_of(n, &form)), n, "{name}");
    }
    // a contact form of bianchi(VI): [e1, e3] and [e2, e3] have different eigenvalues
    let (generic, value) = at("bianchi(VI)", "h");
    let Existence::Witness(form) = generic.contact_form() else { panic!("bianchi(VI)") };
    let form: Vec<Rational> = dense(3, &form.iter().map(|(at, v)| (*at, value(v))).collect());
    let mut with = differential(&special("bianchi(VI)", "h"), &form);
    with.push(form);
    assert_eq!(rank(&with), 3);
}

/// A form over a table that is not in the catalogue: so(3) over the square root of 3.
#[test]
fn forms_of_an_anisotropic_algebra() {
    let table = [(1, 2, 3, 1), (2, 3, 1, 3), (3, 1, 2, 1)];
    assert_eq!(is_contact(by_table(3, &table), "anisotropic"), Some(true));
}

/// Whether there is a complex structure. Checks `J^2 = -1` and the Nijenhuis tensor.
fn is_complex(algebra: LieAlgebra<Rational>, name: &str) -> Option<(bool, bool)> {
    let found = StructureTheory::new(algebra.clone()).complex_structure()?;
    let n = algebra.dimension();
    if let Some(images) = &found.images {
        let j = |x: &[Rational]| -> Vec<Rational> {
            (0..n)
                .map(|k| {
                    let column: Vec<Rational> = images.iter().map(|row| row[k].clone()).collect();
                    pairing(x, &column)
                })
                .collect()
        };
        let unit = |i: usize| (0..n).map(|k| Rational::from(i64::from(i == k))).collect::<Vec<_>>();
        for x in (0..n).map(unit) {
            let negative: Vec<Rational> = x.iter().map(|v| -v.clone()).collect();
            assert_eq!(j(&j(&x)), negative, "{name}");
            for y in (0..n).map(unit) {
                let bracket = |x: &[Rational], y: &[Rational]| algebra.bracket(x, y).unwrap();
                let (jx, jy) = (j(&x), j(&y));
                let inner = [bracket(&jx, &y), bracket(&x, &jy)].map(|v| j(&v));
                let (left, plain) = (bracket(&jx, &jy), bracket(&x, &y));
                for k in 0..n {
                    let right = plain[k].clone() + &inner[0][k] + &inner[1][k];
                    assert_eq!(left[k], right, "{name}");
                }
            }
        }
    }
    Some((found.exists, found.images.is_some()))
}

/// J. E. Snow, *Manuscripta Math.* 68 (1990) 397-412, and G. Ovando, *Manuscripta Math.* 103 (2000) 19-30: the solvable
/// algebras of dimension 4 with a complex structure.
#[test]
fn complex_structures_of_dimension_four() {
    let with = [
        "R^4",
        "heisenberg(3)+R^1",
        "aff(1)+R^2",
        "bianchi(V)+R^1",
        "bianchi(VII,h=0)+R^1",
        "bianchi(VII,h=2)+R^1",
        "aff(1)+aff(1)",
        "patera(4,12)",
        "patera(4,2,a=1)",
        "patera(4,5,a=1/2,b=1)",
        "patera(4,5,a=1/2,b=1/2)",
        "patera(4,5,a=1,b=1)",
        "patera(4,6,a=1,b=0)",
        "patera(4,6,a=2,b=1)",
        "patera(4,7)",
        "patera(4,8)",
        "patera(4,9,b=1)",
        "patera(4,9,b=0)",
        "patera(4,9,b=-1/2)",
        "patera(4,10)",
        "patera(4,11,a=1)",
        "bianchi(VIII)+R^1",
        "bianchi(IX)+R^1",
    ];
    let without = [
        "patera(4,1)",
        "bianchi(IV)+R^1",
        "bianchi(VI,h=-1)+R^1",
        "bianchi(VI,h=1/2)+R^1",
        "patera(4,2,a=-2)",
        "patera(4,3)",
        "patera(4,4)",
        "patera(4,5,a=-1/2,b=1/3)",
    ];
    for (expected, names) in [(true, &with[..]), (false, &without[..])] {
        for (at, name) in names.iter().enumerate() {
            for algebra in [catalogued(name), scrambled(&catalogued(name), at as i64)] {
                assert_eq!(is_complex(algebra, name), Some((expected, expected)), "{name}");
            }
        }
    }
    for name in ["R^2", "aff(1)"] {
        assert_eq!(is_complex(catalogued(name), name), Some((true, true)));
    }
    // a rotation of the plane by an angle whose square is 2, in units of the trace
    let irrational = by_table(4, &[(4, 1, 1, 1), (4, 2, 3, 1), (4, 3, 2, -2)]);
    assert_eq!(is_complex(irrational, "irrational"), Some((true, false)));
    assert_eq!(is_complex(catalogued("so(3)"), "so(3)"), None);
}

/// Quaternion algebras with the units `i^2 = a`, `j^2 = b` and a central line: a rational complex
/// structure corresponds to a rational quaternion with the square -1.
#[test]
fn complex_structures_of_quaternions() {
    let quaternions =
        |a: i64, b: i64| by_table(4, &[(1, 2, 3, 2), (2, 3, 1, -2 * b), (3, 1, 2, -2 * a)]);
    for (a, b) in
        [(-1, -1), (-1, -3), (-1, -7), (-4, -11), (1, 3), (-1, 7), (2, 7), (7, -7), (3, 13)]
    {
        let algebra = quaternions(a, b);
        for algebra in [algebra.clone(), scrambled(&algebra, a + b)] {
            assert_eq!(is_complex(algebra, "quaternions"), Some((true, true)), "{a}, {b}");
        }
    }
    // none: modulo 5, -1 is a square, and the quaternions are not a matrix algebra
    assert_eq!(is_complex(quaternions(-2, -5), "quaternions"), Some((true, false)));
}

/// Chu's theorem does not apply to algebras that are neither unimodular nor solvable: `aff(n)` has an exact symplectic form, and
/// sums of symplectic algebras are symplectic.
#[test]
fn symplectic_forms_without_unimodularity() {
    for name in ["aff(2)", "aff(2)+R^2", "aff(2)+aff(1)", "aff(2)+heisenberg(3)+R^1"] {
        assert_eq!(is_symplectic(catalogued(name), name), Some(true), "{name}");
        assert_eq!(is_symplectic(scrambled(&catalogued(name), 5), name), Some(true), "{name}");
    }
}

/// `a + b` is a contact form if `d a` is symplectic on one summand and `b` is a contact form on the other.
#[test]
fn contact_forms_of_large_sums() {
    for name in [
        "aff(2)+heisenberg(3)",
        "aff(1)+aff(1)+heisenberg(5)",
        "heisenberg(11)",
        "aff(2)+aff(1)+aff(1)+heisenberg(3)",
    ] {
        assert_eq!(is_contact(catalogued(name), name), Some(true), "{name}");
    }
}

/// Algebras that are too large for Pfaffians: a 2-step nilpotent one of dimension 14 has closed
/// 2-forms of dimension 42 and of rank at most 12, in any basis.
#[test]
fn no_symplectic_form_by_the_generic_rank() {
    let table = [
        (1, 2, 8, 1),
        (3, 4, 8, 1),
        (1, 6, 8, 1),
        (5, 7, 8, 1),
        (2, 5, 9, 1),
        (2, 6, 10, 1),
        (2, 7, 11, 1),
        (3, 5, 12, 1),
        (3, 6, 13, 1),
        (3, 7, 14, 1),
    ];
    let algebra = by_table(14, &table);
    let structure = StructureTheory::new(algebra.clone());
    let forms = structure.two_forms().unwrap();
    assert_eq!(forms.closed.dimension(), 42);
    let expected = Existence::Rank(Certified { dimension: 12, proved: true });
    assert_eq!(structure.symplectic_form(&forms), expected);
    // the sum of two copies of a symplectic algebra is symplectic
    for name in ["filiform(4)+filiform(4)+filiform(4)+filiform(4)", "aff(1)+R^18"] {
        assert_eq!(is_symplectic(catalogued(name), name), Some(true), "{name}");
    }
    assert_eq!(is_symplectic(catalogued("heisenberg(13)+R^1"), "heisenberg"), Some(false));
}

/// Closed 2-forms of the free nilpotent algebras by Witt's formula: `b_2` is the number of brackets
/// of the next step.
#[test]
fn second_cohomology_of_free_nilpotent_algebras() {
    for (generators, step, next) in
        [(2, 2, 2), (2, 3, 3), (2, 4, 6), (3, 2, 8), (3, 3, 18), (2, 5, 9), (4, 2, 20), (5, 2, 40)]
    {
        let name = format!("free_nilpotent({generators},{step})");
        let structure = StructureTheory::new(catalogued(&name));
        assert_eq!(structure.two_forms().unwrap().cohomology().len(), next, "{name}");
    }
    // filiform: the closed 2-forms e1 e_n and floor((n-1)/2) others
    for n in [20usize, 40, 60] {
        let structure = StructureTheory::new(catalogued(&format!("filiform({n})")));
        assert_eq!(structure.two_forms().unwrap().cohomology().len(), n.div_ceil(2), "{n}");
    }
}

/// Quadratic Casimir functions are invariant; there is one for each simple factor over the complex
/// numbers.
#[test]
fn quadratic_casimirs() {
    for (name, degrees) in [
        ("so(3)", vec![2]),
        ("so(3,1)+R^2", vec![1, 1, 2, 2]),
        ("so(4)", vec![2, 2]),
        ("G2", vec![2]),
        ("sl(3)+so(5)", vec![2, 2]),
        ("gl(4)", vec![1, 2]),
        ("u(3)", vec![1, 2]),
    ] {
        let structure = StructureTheory::new(catalogued(name));
        let found = structure.quadratic_casimirs().unwrap().unwrap();
        let space = LiePoisson::right(&symbolic(structure.algebra())).unwrap();
        for casimir in &found {
            assert!(space.is_casimir(casimir), "{name}: {casimir}");
        }
        let degree = |casimir: &Symbolic| casimir.terms()[0].0.iter().map(|(_, e)| *e).sum::<u32>();
        assert_eq!(found.iter().map(degree).collect::<Vec<_>>(), degrees, "{name}");
        // as many as a search by linear equations finds
        if structure.dimension() <= 10 {
            assert_eq!(structure.casimirs(2).unwrap().len(), found.len(), "{name}");
        }
    }
    let solvable = StructureTheory::new(catalogued("aff(1)"));
    assert_eq!(solvable.quadratic_casimirs().unwrap(), None);
}
