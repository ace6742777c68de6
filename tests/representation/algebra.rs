//! Reductive algebras by name.

use crate::representation::common::algebra;
use affinor::representation::{ReductiveAlgebra, RepresentationError};

#[test]
fn names_of_groups_and_types_denote_the_complex_algebra() {
    for (name, written, dimension) in [
        ("SU(5)", "A4", 24),
        ("su5", "A4", 24),
        ("su(2,3)", "A4", 24),
        ("SL(2)", "A1", 3),
        ("SO(3)", "A1", 3),
        ("SO(4)", "A1 + A1", 6),
        ("so(3,1)", "A1 + A1", 6),
        ("SO(6)", "D3", 15),
        ("SO(10)", "D5", 45),
        ("SO(7)", "B3", 21),
        ("Sp(6)", "C3", 21),
        ("Sp(2)", "A1", 3),
        ("U(3)", "A2 + T1", 9),
        ("U(1)", "T1", 1),
        ("SO(2)", "T1", 1),
        ("E8", "E8", 248),
        ("SU(3)xSU(2)xU(1)", "A2 + A1 + T1", 12),
        ("G2+F4", "G2 + F4", 66),
    ] {
        let algebra = algebra(name);
        assert_eq!((algebra.to_string().as_str(), algebra.dimension()), (written, dimension));
        assert_eq!(written.parse::<ReductiveAlgebra>().unwrap(), algebra);
    }
}

#[test]
fn other_names_are_rejected_with_the_reason() {
    for (name, reason) in [
        ("E9", "there is no simple Lie algebra E9: En needs n = 6, 7, 8"),
        ("Sp(5)", "the argument of Sp must be even"),
        ("SU(0)", "n must be positive"),
        ("heisenberg(3)", "write a sum of names such as E6, A4, SU(5), SO(10), Sp(6), U(1)"),
        ("", "write a sum of names such as E6, A4, SU(5), SO(10), Sp(6), U(1)"),
        ("A2 + ", "write a sum of names such as E6, A4, SU(5), SO(10), Sp(6), U(1)"),
        ("SU(99999999999999999999)", "write a sum"),
    ] {
        let error = name.parse::<ReductiveAlgebra>().unwrap_err();
        assert!(error.to_string().contains(reason), "{name}: {error}");
    }
    let many = ["U(1)"; 70].join(" x ");
    assert!(matches!(many.parse::<ReductiveAlgebra>(), Err(RepresentationError::TooLarge { .. })));
}
