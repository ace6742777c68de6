//! Subalgebras by text.

use crate::representation::common::algebra;
use affinor::representation::{HighestWeight, Subalgebra};

#[test]
fn names_find_the_subalgebras_of_physics() {
    for (ambient, text, description, weight, expected) in [
        (
            "SU(5)",
            "SU(3)xSU(2)xU(1)",
            "Levi subalgebra without node 2",
            "5",
            "(1,2)(3) + (3,1)(-2)",
        ),
        (
            "SU(5)",
            "SU(2) x SU(3) x U(1)",
            "Levi subalgebra without node 2",
            "5",
            "(2,1)(3) + (1,3)(-2)",
        ),
        ("SO(10)", "SU(5) x U(1)", "Levi subalgebra without node 4", "10", "5(2) + 5bar(-2)"),
        (
            "SO(10)",
            "SU(4) x SU(2) x SU(2)",
            "extended diagram without node 2",
            "10",
            "(1,2,2) + (6,1,1)",
        ),
        ("SO(10)", "SO(9)", "defining representation 1 + 9", "16", "16"),
        ("E6", "SO(10) x U(1)", "Levi subalgebra without node 1", "27", ""),
        ("E6", "SU(3) x SU(3) x SU(3)", "extended diagram without node 4", "27", ""),
        ("E8", "E6 x SU(3)", "extended diagram without node 7", "248", ""),
        ("E6", "F4", "defining representation 1 + 26", "27", "1 + 26"),
        ("E6", "Sp(8)", "defining representation 27", "27", "27"),
        ("E7", "A1 + F4: (4,1); (2,26)", "", "56", "(4,1) + (2,26)"),
        ("E8", "SU(5) x SU(5)", "extended diagram without node 5", "248", ""),
        ("F4", "SO(9)", "extended diagram without node 4", "26", "1 + 9 + 16"),
        ("SU(6)", "SU(3) x SU(2)", "defining representation (3,2)", "6", "(3,2)"),
        ("SU(4)", "Sp(4)", "defining representation 4", "6", "1 + 5"),
        ("SU(3)", "SO(3)", "defining representation 3", "8", "3 + 5"),
        ("SO(7)", "G2", "defining representation 7", "8", "1 + 7"),
        ("SO(8)", "SO(5) x SO(3)", "", "8", "(4,2)"),
        ("SO(6)", "SU(3) x U(1)", "Levi subalgebra without node 2", "6", "3(2) + 3bar(-2)"),
        ("SU(3)", "SU(2) x U(1)", "Levi subalgebra without node 1", "3", ""),
        ("E7", "principal", "weighted diagram 2,2,2,2,2,2,2", "56", "10 + 18 + 28"),
        ("G2", "sl2 0,2", "weighted diagram 0,2", "7", "1 + 2 (3)"),
        ("G2", "extended 1", "extended diagram without node 1", "7", "1 + 3 + 3bar"),
        ("A1 + G2", "extended 2", "extended diagram without node 2", "(1,7)", ""),
        ("E6", "levi 6", "Levi subalgebra without node 6", "27", ""),
        ("SU(3)", "A1: [[2,2]]", "projection", "3", "3"),
        ("SU(4)", "A1 + A1: [[1,0,1],[1,2,1]]", "projection", "4", "(2,2)"),
        ("SU(5)", "SU(3)xSU(2): (3,1); (1,2)", "defining representation (3,1) + (1,2)", "5", ""),
    ] {
        let subalgebra = Subalgebra::parse(&algebra(ambient), text)
            .unwrap_or_else(|error| panic!("{ambient} {text}: {error}"));
        let weight = HighestWeight::parse(subalgebra.ambient(), weight).unwrap();
        let found = subalgebra.branch(&weight).unwrap();
        if !expected.is_empty() {
            let sorted = |text: &str| {
                let mut terms: Vec<String> = text.split(" + ").map(str::to_string).collect();
                terms.sort();
                terms
            };
            assert_eq!(sorted(&found.to_string()), sorted(expected), "{ambient} {text}: {found}");
        }
        if !description.is_empty() && !description.starts_with("defining") {
            assert_eq!(subalgebra.description(), description, "{ambient} {text}");
        }
        assert_eq!(found.dimension(), weight.dimension().into());
    }
}

/// The labels of the subalgebra are in the order of the name.
#[test]
fn isomorphic_names_give_the_same_branching_rules() {
    for (ambient, names) in [
        ("SU(4)", ["B2", "C2"]),
        ("SO(8)", ["SU(4) x U(1)", "SO(6) x U(1)"]),
        ("E8", ["A4 + A4", "SU(5) x SU(5)"]),
        ("E7", ["SO(12) x SU(2)", "SU(2) x SO(12)"]),
    ] {
        let algebra = algebra(ambient);
        let adjoint = HighestWeight::adjoint(&algebra).remove(0);
        let dimensions = names.map(|name| {
            let subalgebra = Subalgebra::parse(&algebra, name).unwrap();
            assert_eq!(*subalgebra.algebra(), name.parse().unwrap());
            let branched = subalgebra.branch(&adjoint).unwrap();
            let mut all: Vec<_> = branched.components().map(|(w, m)| (w.dimension(), m)).collect();
            all.sort();
            all
        });
        assert_eq!(dimensions[0], dimensions[1], "{ambient}");
    }
}

#[test]
fn other_texts_are_rejected_with_the_forms() {
    let su3 = algebra("SU(3)");
    for text in [
        "",
        "levi",
        "levi x",
        "levi 1,,2",
        "levi 3",
        "extended",
        "extended 0",
        "extended 3",
        "extended 1,2",
        "sl2 1",
        "sl2 3,0",
        "principal 3",
        "E6",
        "SU(3)xSU(3)",
        "A1: [[1",
        "A1: [[1,2]]",
        "A1: [[2,2],[2,2]]",
        "A1: 4",
        "A1: x",
        "A1:",
        "?: 3",
        "levi 99999999999999",
    ] {
        let error = Subalgebra::parse(&su3, text).unwrap_err().to_string();
        assert!(error.len() > 20, "{text}: {error}");
    }
}
