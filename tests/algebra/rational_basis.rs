//! Bases in which structure constants with square roots are rational.
//!
//! An algebra over Q whose basis vectors are multiplied by square roots of rational numbers is
//! isomorphic over R to the original algebra. The invariants in the basis that is found must agree
//! with the invariants before the scaling.

use crate::algebra::structure::invariants;
use crate::common::algebras::catalogued;
use crate::common::property::properties;
use affinor::algebra::RationalBasis;
use affinor::algebra::structure::{GroundField, StructureTheory};
use affinor::{BasisChange, Bracket, Down, Error, Law, LieAlgebra, Rational, Symbolic, Tensor, Up};
use affinor_tensors::Field;
use affinor_tensors::linear::modular::{PRIMES, primes};
use affinor_tensors::scalar::PositiveFactors;
use proptest::prelude::*;
use std::cmp::Ordering;

fn value(text: &str) -> Symbolic {
    text.parse().unwrap()
}

fn root(n: i64, d: i64) -> Symbolic {
    let number = Symbolic::constant(Rational::new(n, d).unwrap());
    PositiveFactors::default().function("sqrt", &number).unwrap()
}

fn diagonal(entries: impl IntoIterator<Item = Symbolic>) -> BasisChange<Symbolic> {
    BasisChange::new(Tensor::diagonal(entries, [Up, Down])).unwrap()
}

/// The algebra in the basis `sqrt(n_i/d_i) e_i`.
fn scaled(algebra: &LieAlgebra<Rational>, by: &[(i64, i64)]) -> LieAlgebra<Symbolic> {
    let symbolic = algebra.map(|value| Symbolic::constant(value.clone())).unwrap();
    symbolic.change_basis(&diagonal(by.iter().map(|(n, d)| root(*n, *d)))).unwrap()
}

/// The algebra of three vectors whose brackets `[x, y]`, `[y, z]`, `[z, x]` are multiples of `z`,
/// `x`, `y`.
fn three(values: [&str; 3]) -> LieAlgebra<Symbolic> {
    let at = [(0, 1, 2), (1, 2, 0), (2, 0, 1)];
    let constants = at.iter().zip(values).map(|(&(j, k, i), text)| (j, k, i, value(text)));
    Bracket::from_constants(["x", "y", "z"], constants).unwrap().try_into().unwrap()
}

const NAMES: [&str; 8] =
    ["sl(2)", "so(4)", "G2", "sl(3)", "se(3)", "bianchi(V)", "heisenberg(5)", "so(3)+R^2"];

properties! {
    #![cases(40)]

    #[test]
    fn invariants_of_algebras_scaled_by_roots_are_those_of_the_algebras(
        name in prop::sample::select(NAMES.to_vec()),
        by in prop::collection::vec((1i64..40, 1i64..9), 14),
    ) {
        let algebra = catalogued(name);
        let given = scaled(&algebra, &by[..algebra.dimension()]);
        let basis = RationalBasis::of(&given).unwrap();
        // the divisors have rational squares and lead to this basis
        let back = given.change_basis(&diagonal(basis.divisors().iter().map(|d| d.recip().unwrap())));
        let back = back.unwrap();
        prop_assert_eq!(back.structure_constants(), basis.algebra().structure_constants());
        for divisor in basis.divisors() {
            prop_assert!((divisor.clone() * divisor).as_constant().is_some(), "{}", divisor);
        }
        let rational = basis.over_the_rationals().unwrap();
        let names = |algebra: &LieAlgebra<Rational>| {
            let found = StructureTheory::new(algebra.clone()).identify();
            found.map(|found| found.names)
        };
        if algebra.dimension() <= 6 {
            prop_assert_eq!(names(&rational), names(&algebra));
        }
        prop_assert_eq!(invariants(rational), invariants(algebra));
    }

    #[test]
    fn residues_and_signs_of_sums_of_roots_are_those_of_a_field(
        terms in prop::collection::vec((-9i64..10, 1i64..30), 4),
        more in prop::collection::vec((-9i64..10, 1i64..30), 4),
    ) {
        let sum = |terms: &[(i64, i64)]| terms.iter().fold(Symbolic::from(0), |sum, (c, n)| {
            sum + &(root(*n, 1) * &Symbolic::from(*c))
        });
        let float = |terms: &[(i64, i64)]| -> f64 {
            terms.iter().map(|(c, n)| *c as f64 * (*n as f64).sqrt()).sum()
        };
        let (a, b) = (sum(&terms), sum(&more));
        let expected = match float(&terms) {
            x if x.abs() < 1e-9 => None,
            x if x > 0.0 => Some(Ordering::Greater),
            _ => Some(Ordering::Less),
        };
        if expected.is_some() {
            prop_assert_eq!(a.sign(), expected);
        }
        let mut known = 0;
        for prime in primes().take(400) {
            let Some((x, y)) = a.residue(prime).zip(b.residue(prime)) else { continue };
            known += 1;
            let product = (a.clone() * &b).residue(prime);
            prop_assert!(product.is_none_or(|product| product == prime.mul(x, y)));
            let total = (a.clone() + &b).residue(prime);
            prop_assert!(total.is_none_or(|total| total == prime.add(x, y)));
        }
        prop_assert!(known > 0);
    }
}

/// The square of the residue of a root is the residue of its argument, for numbers and for polynomials.
#[test]
fn residues_of_roots_are_roots_of_residues() {
    for argument in ["2", "3", "7/5", "a^2 + 1", "a^2 + b^4 + 2"] {
        let argument = value(argument);
        let root = PositiveFactors::default().function("sqrt", &argument).unwrap();
        let known: Vec<_> =
            primes().take(200).filter_map(|p| Some((p, root.residue(p)?))).collect();
        assert!(known.len() > 20, "{argument}");
        for (prime, residue) in known {
            assert_eq!(Some(prime.mul(residue, residue)), argument.residue(prime), "{argument}");
        }
    }
    let power = |of: i64, n: i64| {
        let exponent = Symbolic::constant(Rational::new(1, n).unwrap());
        PositiveFactors::default().power(&Symbolic::from(of), &exponent).unwrap()
    };
    for prime in primes().take(200) {
        let roots =
            (power(2, 4).residue(prime), power(2, 2).residue(prime), power(2, 8).residue(prime));
        if let (Some(fourth), Some(second), Some(eighth)) = roots {
            assert_eq!(prime.mul(fourth, fourth), second);
            assert_eq!(prime.mul(eighth, eighth), fourth);
        }
    }
    assert!(PRIMES.iter().any(|prime| power(2, 2).residue(*prime).is_some()));
}

/// As few basis vectors as possible are scaled, and rational tables are unchanged.
#[test]
fn few_basis_vectors_are_divided() {
    let labels = |algebra: &LieAlgebra<Symbolic>| {
        RationalBasis::of(algebra).unwrap().algebra().labels().to_vec()
    };
    assert_eq!(labels(&three(["1", "2", "a"])), ["x", "y", "z"]);
    assert_eq!(labels(&three(["sqrt(2)", "sqrt(2)", "sqrt(2)"])), ["x/sqrt(2)", "y", "z"]);
    assert_eq!(labels(&three(["sqrt(2)", "0", "0"])).iter().filter(|l| l.contains('/')).count(), 1);
    assert_eq!(labels(&three(["sqrt(6)", "sqrt(6)/3", "sqrt(6)"])), ["x/sqrt(6)", "y", "z"]);
    // with parameters
    let basis =
        RationalBasis::of(&three(["a*sqrt(a^2 + 1)", "sqrt(a^2 + 1)", "3*sqrt(a^2 + 1)/(a + 2)"]));
    let basis = basis.unwrap();
    assert!(basis.is_new() && basis.over_the_rationals().is_none());
    let values =
        basis.algebra().structure_constants().components().map(|(_, value)| value.to_string());
    assert!(values.into_iter().all(|text| !text.contains("sqrt")));
}

#[test]
fn other_numbers_and_contradictions_are_refused_with_the_constant() {
    let refused = |values: [&str; 3]| match RationalBasis::of(&three(values)) {
        Err(Error::Broken { law: Law::RationalConstants, at, residual }) => {
            at.join(" ") + " " + &residual
        }
        other => panic!("{values:?}: {other:?}"),
    };
    assert_eq!(refused(["1 + sqrt(3)", "0", "0"]), "x y z sqrt(3) + 1");
    assert_eq!(refused(["0", "pi", "0"]), "y z x pi");
    assert_eq!(refused(["0", "0", "2^(1/3)"]), "x z y -2^(1/3)");
    assert_eq!(refused(["a", "b + a*sqrt(2)", "1"]), "y z x a*sqrt(2) + b");
    // d/dt acts on the plane with two eigenvalues of ratio sqrt(2)
    let constants = [(0, 1, 1, value("1")), (0, 2, 2, value("sqrt(2)"))];
    let algebra = Bracket::from_constants(["t", "x", "y"], constants).unwrap().try_into().unwrap();
    let at = ["t", "y", "y"].map(String::from);
    let expected = Law::RationalConstants.broken(at, "sqrt(2)");
    assert_eq!(RationalBasis::of(&algebra).unwrap_err(), expected);
}
