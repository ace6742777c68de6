//! Regular subalgebras agree with the tables of branching rules.

use crate::representation::common::{algebra, representation};
use affinor::representation::{HighestWeight, Subalgebra};

fn restriction(subalgebra: &Subalgebra, weight: &str) -> String {
    let weight = HighestWeight::parse(subalgebra.ambient(), weight).unwrap();
    subalgebra.branch(&weight).unwrap().to_string()
}

#[test]
fn levi_subalgebras_of_grand_unification() {
    let standard_model = Subalgebra::levi(&algebra("SU(5)"), &[3]).unwrap();
    assert_eq!(standard_model.algebra().to_string(), "A2 + A1 + T1");
    // six times the hypercharge is -1 times the charge
    assert_eq!(restriction(&standard_model, "5"), "(1,2)(-3) + (3,1)(2)");
    assert_eq!(restriction(&standard_model, "10"), "(1,1)(-6) + (3bar,1)(4) + (3,2)(-1)");
    let su5 = Subalgebra::levi(&algebra("SO(10)"), &[5]).unwrap();
    assert_eq!(su5.algebra().to_string(), "A4 + T1");
    let sixteen = su5.branch(&HighestWeight::parse(&algebra("SO(10)"), "16").unwrap()).unwrap();
    let dimensions: Vec<_> = sixteen.components().map(|(w, _)| w.dimension()).collect();
    assert_eq!(dimensions.len(), 3);
    assert_eq!(
        restriction(&Subalgebra::levi(&algebra("E6"), &[6]).unwrap(), "78"),
        "1(0) + 16bar(3) + 16(-3) + 45(0)"
    );
}

#[test]
fn subalgebras_of_borel_and_de_siebenthal() {
    for (name, node, sub, weight, expected) in [
        ("G2", 2, "A1 + A1", "7", ""),
        ("G2", 1, "A2", "7", "1 + 3 + 3bar"),
        ("F4", 1, "C3 + A1", "26", "(6,2) + (14,1)"),
        ("F4", 4, "B4", "26", "1 + 9 + 16"),
        ("F4", 4, "B4", "52", "16 + 36"),
        ("F4", 2, "A2 + A2", "26", ""),
        ("E6", 4, "A2 + A2 + A2", "27", ""),
        ("E6", 2, "A5 + A1", "27", ""),
        ("E7", 2, "A7", "56", "28 + 28bar"),
        ("E7", 2, "A7", "133", "63 + 70"),
        ("E7", 1, "D6 + A1", "56", ""),
        ("E7", 3, "A5 + A2", "56", ""),
        ("E8", 1, "D8", "248", "120 + 128'"),
        ("E8", 2, "A8", "248", "80 + 84 + 84bar"),
        ("E8", 8, "E7 + A1", "248", "(1,3) + (56,2) + (133,1)"),
        ("E8", 7, "E6 + A2", "248", ""),
        ("E8", 5, "A4 + A4", "248", ""),
        ("B4", 4, "D4", "9", "1 + 8'"),
        ("C3", 1, "B2 + A1", "6", ""),
    ] {
        let subalgebra = Subalgebra::borel_de_siebenthal(&algebra(name), 0, node).unwrap();
        assert_eq!(subalgebra.algebra().to_string(), sub, "{name} {node}");
        let found = restriction(&subalgebra, weight);
        if !expected.is_empty() {
            assert_eq!(found, expected, "{name} {node}");
        }
        // regular subalgebras of maximal rank contain all long roots of some factor
        assert!(subalgebra.embedding_index().iter().any(|row| row[0] == 1));
    }
    assert!(Subalgebra::borel_de_siebenthal(&algebra("E8"), 0, 9).is_err());
    assert!(Subalgebra::borel_de_siebenthal(&algebra("E8"), 0, 0).is_err());
    assert!(Subalgebra::borel_de_siebenthal(&algebra("E8"), 1, 1).is_err());
    assert!(Subalgebra::levi(&algebra("E8"), &[9]).is_err());
    assert!(Subalgebra::levi(&algebra("T1"), &[1]).is_err());
}

/// The adjoint representation has one component of dimension `2 e + 1` for each exponent `e`.
#[test]
fn principal_subalgebras_have_the_exponents() {
    use affinor::algebra::structure::dynkin::exponents;
    for name in ["A5", "B4", "C4", "D5", "D6", "E6", "E7", "E8", "F4", "G2"] {
        let algebra = algebra(name);
        let principal = Subalgebra::principal_sl2(&algebra).unwrap();
        let adjoint = HighestWeight::adjoint(&algebra).remove(0);
        let mut found = vec![];
        for (weight, multiplicity) in principal.branch(&adjoint).unwrap().components() {
            found.extend((0..multiplicity).map(|_| weight.labels()[0] as usize / 2));
        }
        found.sort_unstable();
        let mut expected = exponents(algebra.simple_factors()[0]);
        expected.sort_unstable();
        assert_eq!(found, expected, "{name}");
    }
}

#[test]
fn weighted_diagrams_of_other_values_are_rejected() {
    let g2 = algebra("G2");
    // the diagrams of the nilpotent orbits of G2
    let orbits = [[0, 1], [1, 0], [0, 2], [2, 2]];
    let mut found = vec![];
    for values in (0..3).flat_map(|a| (0..3).map(move |b| [a, b])) {
        if Subalgebra::sl2(&g2, &values).is_ok() {
            found.push(values);
        }
    }
    for orbit in orbits {
        assert!(found.contains(&orbit), "{orbit:?}");
    }
    assert!(!found.contains(&[0, 0]));
    assert!(Subalgebra::sl2(&g2, &[3, 0]).is_err());
    assert!(Subalgebra::sl2(&g2, &[1]).is_err());
    assert!(Subalgebra::principal_sl2(&algebra("T1")).is_err());
    assert_eq!(representation("G2", "7").dimension(), 7.into());
}
