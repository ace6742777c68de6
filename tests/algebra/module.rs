//! Modules and their cohomology against published dimensions and theorems.

use crate::common::algebras::catalogued;
use affinor::algebra::structure::{StructureTheory, Subspace};
use affinor::algebra::{LieAlgebra, Module};
use affinor::{Error, Law, Rational};
use affinor_tensors::linear::Matrix;

type Algebra = LieAlgebra<Rational>;

fn numbers(algebra: &Algebra, module: &Module<Rational>) -> Vec<u64> {
    StructureTheory::new(algebra.clone()).cohomology(module).unwrap().unwrap().0
}

/// The matrices of a module, checked again.
fn checked(module: &Module<Rational>) {
    let matrices = (0..module.algebra().dimension()).map(|j| module.matrix(j)).collect();
    let again = Module::new(module.algebra(), module.labels(), matrices).unwrap();
    assert_eq!(again, *module);
}

#[test]
fn constructions_are_modules() {
    for name in ["so(3)", "sl(2)", "heisenberg(3)", "se(2)", "aff(1)", "so(3,1)"] {
        let algebra = catalogued(name);
        let n = algebra.dimension();
        let adjoint = Module::adjoint(&algebra);
        let square = adjoint.tensor(&adjoint).unwrap();
        let symmetric = adjoint.symmetric_power(2).unwrap();
        let exterior = adjoint.exterior_power(2).unwrap();
        assert_eq!(square.dimension(), n * n);
        assert_eq!(
            [symmetric.dimension(), exterior.dimension()],
            [n * (n + 1) / 2, n * (n - 1) / 2]
        );
        for module in [
            &adjoint,
            &Module::coadjoint(&algebra),
            &square,
            &symmetric,
            &exterior,
            &symmetric.dual(),
            &adjoint.symmetric_power(3).unwrap(),
            &adjoint.exterior_power(n).unwrap(),
            &Module::trivial(&algebra, 2),
        ] {
            checked(module);
        }
        // the square is the sum of the symmetric and the exterior square
        let dimension = |module: &Module<Rational>| module.invariants().unwrap().dimension();
        assert_eq!(dimension(&square), dimension(&symmetric) + dimension(&exterior), "{name}");
        assert_eq!(adjoint.dual().dual().matrix(0), adjoint.matrix(0));
        assert_eq!(adjoint.symmetric_power(0).unwrap().dimension(), 1);
        assert!(adjoint.exterior_power(n + 1).unwrap().dimension() == 0);
    }
    let su2 = Module::adjoint(&catalogued("so(3)"));
    // the volume is invariant, and the fourth power of the vectors contains one invariant
    assert!(su2.exterior_power(3).unwrap().is_trivial());
    assert_eq!(su2.symmetric_power(4).unwrap().invariants().unwrap().dimension(), 1);
}

#[test]
fn other_matrices_and_subspaces_are_rejected() {
    let algebra = catalogued("so(3)");
    let identity = || Matrix::<Rational>::identity(2);
    let labels = ["u".to_string(), "v".to_string()];
    let error = Module::new(&algebra, labels.clone(), vec![identity(), identity()]).unwrap_err();
    assert!(matches!(error, Error::Shape { .. }), "{error}");
    let matrices = vec![identity(), identity(), identity()];
    let error = Module::new(&algebra, labels, matrices).unwrap_err();
    assert!(matches!(error, Error::Broken { law: Law::Action, .. }), "{error}");
    let line = Subspace::span(3, [vec![(0, Rational::from(1))]]);
    let error = Module::adjoint(&algebra).quotient(&line).unwrap_err();
    assert!(matches!(error, Error::Broken { law: Law::Submodule, .. }), "{error}");
    let theory = StructureTheory::new(catalogued("sl(2)"));
    assert!(theory.cohomology(&Module::adjoint(&algebra)).is_err());
    let one = Module::adjoint(&algebra);
    assert!(one.tensor(&Module::adjoint(theory.algebra())).is_err());
    assert!(one.symmetric_power(100).is_err());
}

/// The first and the second lemma of Whitehead: a semisimple algebra has no cohomology in an
/// irreducible module that is not trivial (N. Jacobson, *Lie Algebras*, III.10).
#[test]
fn lemmas_of_whitehead() {
    for name in ["so(3)", "sl(2)", "so(3,1)", "su(3)"] {
        let algebra = catalogued(name);
        let adjoint = Module::adjoint(&algebra);
        assert!(numbers(&algebra, &adjoint).iter().all(|dimension| *dimension == 0), "{name}");
        // the square of the adjoint module contains invariants, which have the Betti numbers
        let square = adjoint.symmetric_power(2).unwrap();
        let invariants = square.invariants().unwrap().dimension() as u64;
        let betti = StructureTheory::new(algebra.clone()).betti_numbers().unwrap().0;
        let expected: Vec<u64> = betti.iter().map(|b| b * invariants).collect();
        if algebra.dimension() < 8 {
            assert_eq!(numbers(&algebra, &square), expected, "{name}");
        }
    }
    let e8 = catalogued("E8");
    assert!(numbers(&e8, &Module::adjoint(&e8)).iter().all(|dimension| *dimension == 0));
}

/// Infinitesimal deformations `H^2(g, g)`: the only deformations of the Poincare algebra are the de
/// Sitter algebras (M. Levy-Nahas, *J. Math. Phys.* 8 (1967) 1211-1222). The other degrees follow from
/// the factorization of G. Hochschild and J.-P. Serre, `H(s) tensor H(V, g)^s`, by invariants of
/// rotations: `(t + t^2)(1 + t^3)` and `(t + t^2)(1 + t^3)^2`. Heisenberg algebra: Euler
/// characteristic and duality determine the numbers from the centre and the 6 derivations. The algebra
/// of the affine line is rigid.
#[test]
fn adjoint_coefficients() {
    for (name, expected) in [
        ("se(3)", &[0, 1, 1, 0, 1, 1, 0][..]),
        ("iso(3,1)", &[0, 1, 1, 0, 2, 2, 0, 1, 1, 0, 0]),
        ("heisenberg(3)", &[1, 4, 5, 2]),
        ("R^3", &[3, 9, 9, 3]),
        ("aff(1)", &[0, 0, 0]),
    ] {
        let algebra = catalogued(name);
        assert_eq!(numbers(&algebra, &Module::adjoint(&algebra)), expected, "{name}");
    }
}

/// `H^0` is the centre, `H^1` are the derivations modulo inner ones, the alternating sum vanishes; for
/// unimodular algebras `H^k(g, V)` and `H^(n-k)(g, V*)` are dual (M. Hazewinkel, *J. Algebra* 16
/// (1970) 11-16).
#[test]
fn laws_of_cohomology() {
    for name in ["heisenberg(5)", "se(2)", "se(3)", "bianchi(IV)", "bianchi(V)", "gl(2)", "aff(2)"]
    {
        let algebra = catalogued(name);
        let theory = StructureTheory::new(algebra.clone());
        let n = theory.dimension();
        let adjoint = numbers(&algebra, &Module::adjoint(&algebra));
        let centre = theory.centre().dimension();
        assert_eq!(adjoint[0], centre as u64, "{name}");
        let derivations = theory.derivation_dimension().unwrap().dimension;
        assert_eq!(adjoint[1], (derivations - (n - centre)) as u64, "{name}");
        let coadjoint = numbers(&algebra, &Module::coadjoint(&algebra));
        for numbers in [&adjoint, &coadjoint] {
            let signed = numbers.iter().enumerate();
            let sum: i64 =
                signed.map(|(k, b)| if k % 2 == 0 { *b as i64 } else { -(*b as i64) }).sum();
            assert_eq!(sum, 0, "{name}");
        }
        if theory.is_unimodular() {
            let reversed: Vec<u64> = coadjoint.iter().rev().copied().collect();
            assert_eq!(adjoint, reversed, "{name}");
        }
        // trivial coefficients: multiples of the Betti numbers, also by the relative complex
        let betti = theory.betti_numbers().unwrap().0;
        let twice: Vec<u64> = betti.iter().map(|b| 2 * b).collect();
        assert_eq!(numbers(&algebra, &Module::trivial(&algebra, 2)), twice, "{name}");
        let zero = Subspace::zero(n);
        for (module, expected) in
            [(Module::trivial(&algebra, 1), &betti), (Module::coadjoint(&algebra), &coadjoint)]
        {
            let found = theory.relative_cohomology(&zero, &module).unwrap().betti;
            assert_eq!(found.iter().map(|b| *b as u64).collect::<Vec<_>>(), *expected, "{name}");
        }
    }
}

/// The cohomology of a homogeneous space of a compact group vanishes for coefficients in a nontrivial
/// irreducible module. The cochains are counted by multiplicities of the isotropy group. For the sphere,
/// vectors restrict to `1 + R^2`.
#[test]
fn relative_cohomology_with_coefficients() {
    let algebra = catalogued("so(3)");
    let theory = StructureTheory::new(algebra.clone());
    let axis = Subspace::span(3, [vec![(0, Rational::from(1)), (2, Rational::from(2))]]);
    let found = theory.relative_cohomology(&axis, &Module::adjoint(&algebra)).unwrap();
    assert_eq!((found.cochains, found.betti), (vec![1, 2, 1], vec![0, 0, 0]));
    let sphere = theory.relative_cohomology(&axis, &Module::trivial(&algebra, 1)).unwrap();
    assert_eq!(sphere.betti, [1, 0, 1]);
    // S^3 = SO(4)/SO(3), CP^2 = SU(3)/U(2) by its Levi subalgebra, SU(3)/T
    let plane = Subspace::span(3, (0..2).map(|at| vec![(at, Rational::from(1))]));
    assert!(theory.relative_cohomology(&plane, &Module::adjoint(&algebra)).is_err());
    let su3 = catalogued("su(3)");
    let theory = StructureTheory::new(su3.clone());
    let torus = theory.cartan_subalgebra().clone();
    let flags = theory.relative_cohomology(&torus, &Module::trivial(&su3, 1)).unwrap();
    assert_eq!(flags.betti, [1, 0, 2, 0, 2, 0, 1]);
    let adjoint = theory.relative_cohomology(&torus, &Module::adjoint(&su3)).unwrap();
    assert_eq!(adjoint.betti, [0; 7]);
    // cochains of degree 0: the torus; of degree 1: one complex number for each root
    assert_eq!(adjoint.cochains[..2], [2, 6]);
}
