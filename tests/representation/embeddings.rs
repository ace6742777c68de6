//! Subalgebras of the classical algebras by the restriction of the defining representation.

use crate::representation::common::{algebra, representation};
use affinor::representation::{Decomposition, HighestWeight, Subalgebra};

fn sum(name: &str, parts: &[&str]) -> Decomposition {
    let mut parts = parts.iter().map(|part| representation(name, part));
    let first = parts.next().unwrap();
    parts.fold(first, |sum, part| sum.plus(&part, 1).unwrap())
}

#[test]
fn branching_rules_of_classical_subalgebras() {
    for (ambient, sub, defining, weight, expected) in [
        ("SU(5)", "SO(5)", &["5"][..], "10", "10"),
        ("SU(4)", "Sp(4)", &["4"], "6", "1 + 5"),
        ("SU(6)", "SU(3) x SU(2)", &["(3,2)"], "35", "(1,3) + (8,1) + (8,3)"),
        (
            "SU(6)",
            "SU(4) x SU(2) x U(1)",
            &["(4,1)(1)", "(1,2)(-2)"],
            "15",
            "(1,1)(-4) + (6,1)(2) + (4,2)(-1)",
        ),
        ("SO(7)", "G2", &["7"], "8", "1 + 7"),
        ("SO(7)", "G2", &["7"], "21", "7 + 14"),
        ("SO(9)", "SO(3) x SO(3)", &["(3,3)"], "16", "(4,2) + (2,4)"),
        ("SO(8)", "SO(7)", &["7", "1"], "8'", "8"),
        ("SO(8)", "SO(5) x SO(3)", &["(5,1)", "(1,3)"], "8'", "(4,2)"),
        ("SO(8)", "SU(3)", &["8"], "8'", "8"),
        ("Sp(6)", "SU(2) x SO(3)", &["(2,3)"], "14'", "(4,1) + (2,5)"),
        ("SO(26)", "F4", &["26"], "325", "52 + 273"),
    ] {
        let subalgebra =
            Subalgebra::by_representation(&algebra(ambient), &sum(sub, defining)).unwrap();
        let weight = HighestWeight::parse(subalgebra.ambient(), weight).unwrap();
        let found = subalgebra.branch(&weight).unwrap();
        assert_eq!(found.to_string(), expected, "{ambient} {sub}");
    }
}

#[test]
fn other_representations_are_rejected() {
    for (ambient, sub, defining, reason) in [
        ("SU(5)", "SU(2)", &["4"][..], "the dimension of 4 is 4"),
        ("SO(7)", "SU(3)", &["3", "3", "1"], "has no invariant symmetric form"),
        ("SO(6)", "SU(2)", &["6"], "has no invariant symmetric form"),
        ("SU(3)", "SU(2) x U(1)", &["2(1)", "1(1)"], "have a trace"),
        ("SO(4) x U(1)", "SU(2)", &["4"], "a defining representation needs"),
        ("E6", "A2", &["10", "15", "1", "1"], "does not extend"),
        ("G2", "A1", &["5", "1", "1"], "does not extend"),
        ("E7", "F4", &["52", "1", "1", "1", "1"], "has no invariant antisymmetric form"),
        ("SU(3)", "SU(2)", &["1", "1", "1"], "does not contain"),
        ("SO(4)", "SU(2)", &["4"], "a defining representation needs"),
        ("SO(6)", "U(1)", &["(1)", "(-1)", "(0)", "(0)", "(0)", "(0)"], "double the charges"),
    ] {
        let defining = sum(sub, defining);
        let error = Subalgebra::by_representation(&algebra(ambient), &defining).unwrap_err();
        assert!(error.to_string().contains(reason), "{ambient} {sub}: {error}");
    }
    // a symplectic representation twice is orthogonal
    let quaternions =
        Decomposition::irreducible(&HighestWeight::parse(&algebra("SU(2)"), "2").unwrap());
    let twice = quaternions.plus(&quaternions, 1).unwrap();
    let with_line = twice.plus(&representation("SU(2)", "1"), 1).unwrap();
    assert!(Subalgebra::by_representation(&algebra("SO(5)"), &with_line).is_ok());
}

/// The maximal subalgebras of the exceptional algebras that are not regular, with the restrictions
/// of the smallest and of the adjoint representation (E. Dynkin, *Mat. Sb.* 30 (1952) 349-462, table
/// 25; McKay and Patera).
#[test]
fn maximal_subalgebras_of_exceptional_algebras() {
    for (ambient, sub, defining, adjoint, index) in [
        ("G2", "A1", &["7"][..], "3 + 11", &[28][..]),
        ("F4", "A1", &["17", "9"], "3 + 11 + 15 + 23", &[156]),
        ("F4", "A1 + G2", &["(5,1)", "(3,7)"], "(3,1) + (5,7) + (1,14)", &[8, 1]),
        ("E6", "A2", &["27"], "8 + 35 + 35bar", &[9]),
        ("E6", "G2", &["27"], "14 + 64", &[3]),
        ("E6", "C4", &["27"], "36 + 42", &[1]),
        ("E6", "F4", &["26", "1"], "26 + 52", &[1]),
        ("E6", "A2 + G2", &["(6,1)", "(3bar,7)"], "(8,1) + (8,7) + (1,14)", &[2, 1]),
        ("E7", "A2", &["28", "28bar"], "8 + 125", &[21]),
        ("E7", "C3 + G2", &["(14',1)", "(6,7)"], "(21,1) + (14,7) + (1,14)", &[1, 1]),
        ("E7", "A1 + F4", &["(4,1)", "(2,26)"], "(3,1) + (3,26) + (1,52)", &[3, 1]),
        ("E7", "A1 + G2", &["(4,7)", "(2,14)"], "(3,1) + (5,7) + (1,14) + (3,27)", &[7, 2]),
        ("E8", "F4 + G2", &["(52,1)", "(26,7)", "(1,14)"], "(1,14) + (52,1) + (26,7)", &[1, 1]),
    ] {
        let ambient = algebra(ambient);
        let subalgebra = Subalgebra::by_representation(&ambient, &sum(sub, defining)).unwrap();
        let sorted = |text: &str| {
            let mut terms: Vec<String> = text.split(" + ").map(str::to_string).collect();
            terms.sort();
            terms
        };
        let highest = HighestWeight::adjoint(&ambient).remove(0);
        let found = subalgebra.branch(&highest).unwrap().to_string();
        assert_eq!(sorted(&found), sorted(adjoint), "{ambient} {sub}: {found}");
        let rows: Vec<i64> = subalgebra.embedding_index().iter().map(|row| row[0]).collect();
        assert_eq!(rows, index, "{ambient} {sub}");
    }
}
