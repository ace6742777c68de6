//! Parameters are rational invariants of the action, even if eigenvalues and isomorphisms are
//! irrational.

use super::respects_under_roots;
use crate::algebra::structure::scrambled;
use crate::common::algebras::catalogued;
use crate::common::labels;
use affinor::algebra::structure::{Identification, StructureTheory};
use affinor::{Bracket, LieAlgebra, Rational};
use affinor_tensors::Field;

type Algebra = LieAlgebra<Rational>;

/// `e_n` acts on the vectors before it by the columns of a matrix; `[e_1, e_2] = e_3` if they are a Heisenberg algebra.
fn extension(rows: &[&[i64]], heisenberg: bool) -> Algebra {
    let m = rows.len();
    let mut constants: Vec<_> = (0..m * m)
        .filter(|at| rows[at / m][at % m] != 0)
        .map(|at| (m, at % m, at / m, Rational::from(rows[at / m][at % m])))
        .collect();
    if heisenberg {
        constants.push((0, 1, 2, Rational::from(1)));
    }
    Bracket::from_constants(labels(m + 1), constants).unwrap().try_into().unwrap()
}

/// The names in several dense bases agree.
fn identified(algebra: &Algebra) -> Identification {
    let plain = StructureTheory::new(algebra.clone()).identify().unwrap();
    for seed in 0..4 {
        let found = StructureTheory::new(scrambled(algebra, seed)).identify().unwrap();
        assert_eq!((&found.names, &found.parameter), (&plain.names, &plain.parameter));
        assert_eq!(found.root, plain.root);
    }
    plain
}

/// Numbers with their square-free parts, which are not 1.
const NUMBERS: [(i64, i64); 9] =
    [(2, 2), (3, 3), (5, 5), (8, 2), (12, 3), (18, 2), (30, 30), (45, 5), (1_000_003, 1_000_003)];

/// The eigenvalues `+-i sqrt(c)` and `+-sqrt(c)` have the ratio -1: the Newton-Hooke algebras.
#[test]
fn eigenvalues_with_the_ratio_minus_one() {
    for (c, root) in NUMBERS {
        let root = Some(Rational::from(root));
        let rotation = extension(&[&[0, -c], &[1, 0]], false);
        let found = identified(&rotation);
        assert_eq!((found.names[0].as_str(), found.parameter), ("bianchi(VII,h=0)", None));
        for algebra in [rotation.clone(), scrambled(&rotation, c)] {
            let found = StructureTheory::new(algebra.clone()).identify().unwrap();
            let (images, roots) = (found.isomorphism.unwrap(), found.under_root.unwrap());
            respects_under_roots(&algebra, &images, &roots, &catalogued("bianchi(VII,h=0)"));
        }
        let boost = identified(&extension(&[&[0, c], &[1, 0]], false));
        assert_eq!((boost.names[0].as_str(), boost.parameter), ("bianchi(VI,h=-1)", None));
        assert_eq!((boost.isomorphism, boost.root.as_ref()), (None, root.as_ref()));
        for (sign, name) in [(-1, "bianchi(VII,h=0)+R^1"), (1, "bianchi(VI,h=-1)+R^1")] {
            let line: [&[i64]; 3] = [&[0, sign * c, 0], &[1, 0, 0], &[0, 0, 0]];
            let found = identified(&extension(&line, false));
            assert_eq!((found.names[0].as_str(), &found.parameter), (name, &None));
            assert_eq!((found.isomorphism, found.root.as_ref()), (None, root.as_ref()));
        }
        // on the Heisenberg algebra; the names have no parameter
        for (sign, name) in [(-1, "patera(4,10)"), (1, "patera(4,8)")] {
            let found = identified(&extension(&[&[0, sign * c, 0], &[1, 0, 0], &[0, 0, 0]], true));
            assert_eq!((found.names[0].as_str(), &found.parameter), (name, &None));
            assert_eq!((found.isomorphism, found.root.as_ref()), (None, root.as_ref()));
        }
    }
}

/// If the squares are rational, no root is needed.
#[test]
fn rational_eigenvalues_with_the_ratio_minus_one() {
    for c in [1, 4, 9, 49] {
        for (sign, name) in [(-1, "bianchi(VII,h=0)"), (1, "bianchi(VI,h=-1)")] {
            let found = identified(&extension(&[&[0, sign * c], &[1, 0]], false));
            assert_eq!(found.names, [name]);
            assert!(found.isomorphism.is_some() && found.under_root.is_none());
            let line: [&[i64]; 3] = [&[0, sign * c, 0], &[1, 0, 0], &[0, 0, 0]];
            let found = identified(&extension(&line, false));
            assert_eq!(found.names, [format!("{name}+R^1")]);
            assert!(found.isomorphism.is_some() && found.root.is_none());
        }
    }
}

/// Two vectors act on a plane by `h = 1` and `k` with `k^2 = c`.
#[test]
fn two_vectors_on_a_plane() {
    for (c, root) in NUMBERS {
        for (sign, name) in [(-1, "patera(4,12)"), (1, "aff(1)+aff(1)")] {
            let one = || Rational::from(1);
            let constants = [
                (2, 0, 0, one()),
                (2, 1, 1, one()),
                (3, 0, 1, one()),
                (3, 1, 0, Rational::from(sign * c)),
            ];
            let bracket = Bracket::from_constants(labels(4), constants).unwrap();
            let found = identified(&bracket.try_into().unwrap());
            assert_eq!((found.names[0].as_str(), found.parameter), (name, None));
            assert_eq!((found.isomorphism, found.root), (None, Some(Rational::from(root))));
        }
    }
}

/// The parameter of a nilpotent family is determined up to squares.
#[test]
fn nilpotent_families() {
    for family in [19, 21, 22, 24] {
        for (c, root) in NUMBERS.into_iter().take(6) {
            for sign in [1, -1] {
                let name = format!("degraaf(6,{family},e={})", sign * c);
                let found = StructureTheory::new(catalogued(&name)).identify().unwrap();
                assert_eq!(found.names, [format!("degraaf(6,{family},e={sign})")]);
                assert_eq!((found.isomorphism, found.root), (None, Some(Rational::from(root))));
            }
        }
    }
}

/// Eigenvalues 1 +- sqrt(2) and 1/2 +- i sqrt(7)/2, with a third eigenvalue 0 or 1, and on the
/// Heisenberg algebra. The parameters are irrational, but their squares or sums are rational.
#[test]
fn equations_of_irrational_parameters() {
    let rows = [
        ([1, 2, 1, 1], 0, "bianchi(VI)+R^1", "h + 1/h = -6"),
        ([0, -2, 1, 1], 0, "bianchi(VII)+R^1", "h^2 = 1/7"),
        ([0, -2, 1, 1], 1, "patera(4,6)", "a^2 = 4/7, b/a = 1/2"),
        ([0, -2, 1, 0], 1, "patera(4,6)", "a^2 = 1/2, b = 0"),
    ];
    for ([a, b, c, d], simple, name, equation) in rows {
        for factor in [1, -3] {
            let matrix = [[a, b, 0], [c, d, 0], [0, 0, simple]].map(|row| row.map(|v| v * factor));
            let found = identified(&extension(&[&matrix[0], &matrix[1], &matrix[2]], false));
            assert_eq!(
                (found.names[0].as_str(), found.parameter.as_deref()),
                (name, Some(equation))
            );
            assert_eq!(found.root, None);
        }
    }
    let heisenberg = [
        ([1, 2, 1, 1], "patera(4,9)", "b + 1/b = -6"),
        ([0, -2, 1, 1], "patera(4,11)", "a^2 = 1/7"),
    ];
    for ([a, b, c, d], name, equation) in heisenberg {
        for factor in [1, -3] {
            let matrix =
                [[a, b, 0], [c, d, 0], [0, 0, a + d]].map(|row: [i64; 3]| row.map(|v| v * factor));
            let found = identified(&extension(&[&matrix[0], &matrix[1], &matrix[2]], true));
            assert_eq!(
                (found.names[0].as_str(), found.parameter.as_deref()),
                (name, Some(equation))
            );
        }
    }
}

/// Scaling the acting vector and changing the basis do not change the parameters.
#[test]
fn multiples_of_the_acting_vector() {
    let names = [
        "bianchi(VI,h=-1/2)",
        "bianchi(VI,h=-1)",
        "bianchi(VII,h=0)",
        "bianchi(VII,h=2)",
        "bianchi(VI,h=1/3)+R^1",
        "bianchi(VII,h=1/2)+R^1",
        "patera(4,2,a=3)",
        "patera(4,5,a=-1/2,b=1/3)",
        "patera(4,6,a=-2,b=1)",
        "patera(4,9,b=-1/2)",
        "patera(4,11,a=1/2)",
    ];
    for name in names {
        for (above, below) in [(2, 1), (-3, 1), (5, 7), (-1, 2)] {
            let factor = Rational::from(above) * &Rational::from(below).recip().unwrap();
            let algebra = catalogued(name).map(|value| value.clone() * &factor).unwrap();
            assert_eq!(identified(&algebra).names, [name]);
        }
    }
}
