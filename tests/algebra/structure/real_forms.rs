//! Names of real forms and of identified algebras, read back by the catalogue.

use crate::common::algebras::catalogued;
use affinor::algebra::catalogue;
use affinor::algebra::roots::{CartanType, Series};
use affinor::algebra::structure::real_forms::real_forms;
use affinor::algebra::structure::{StructureTheory, Subspace};
use affinor::{Error, LieAlgebra, Rational};

/// Invariants that do not depend on the basis.
fn invariants(structure: &StructureTheory<Rational>) -> impl PartialEq + std::fmt::Debug + use<> {
    let dimensions = |series: &[Subspace<Rational>]| -> Vec<usize> {
        series.iter().map(Subspace::dimension).collect()
    };
    (
        structure.dimension(),
        structure.dynkin_type().map(|types| {
            let mut names: Vec<String> = types.iter().map(ToString::to_string).collect();
            names.sort();
            names
        }),
        structure.killing().signature(),
        structure.centre().dimension(),
        dimensions(structure.derived_series()),
        dimensions(structure.lower_central_series()),
    )
}

/// The algebra of an entry without parameters.
fn without_parameters(name: &str) -> Option<LieAlgebra<Rational>> {
    let entry = catalogue::find(name).ok().filter(|entry| entry.parameters.is_empty())?;
    let bracket = entry.bracket::<_, Error>(|value| Ok(value.as_constant().cloned().unwrap()));
    Some(bracket.ok()?.try_into().unwrap())
}

/// Names of algebras of the catalogue, and of their simple ideals, denote isomorphic algebras.
#[test]
fn names_are_those_of_the_catalogue() {
    let (mut named, mut ideals) = (0, 0);
    for name in (1..=20).flat_map(catalogue::names) {
        let Some(algebra) = without_parameters(&name) else { continue };
        let structure = StructureTheory::new(algebra);
        if let Some(found) = structure.identify()
            && found.parameter.is_none()
        {
            for other in &found.names {
                let same = StructureTheory::new(catalogued(other));
                assert_eq!(invariants(&same), invariants(&structure), "{name} is {other}");
                named += 1;
            }
        }
        let levi = structure.levi().unwrap();
        if levi.is_zero() {
            continue;
        }
        for ideal in structure.subalgebra(levi).unwrap().simple_ideals().unwrap().unwrap().real {
            for other in &ideal.names {
                let same = StructureTheory::new(catalogued(other));
                let [plus, minus, zero] = same.killing().signature().unwrap();
                assert_eq!(([plus, minus], zero), (ideal.signature, 0), "{other} in {name}");
                let types = same.dynkin_type().unwrap();
                assert!(types.iter().all(|one| *one == ideal.cartan_type), "{other} in {name}");
                ideals += 1;
            }
        }
    }
    assert!(named > 100 && ideals > 100, "{named}, {ideals}");
}

/// The compact form of `Cn` has a separate name: `sp(2n)` is the split form.
#[test]
fn compact_symplectic_forms() {
    for rank in 3..=6 {
        let cartan_type = CartanType::new(Series::C, rank).unwrap();
        let names = real_forms(cartan_type, cartan_type.dimension());
        assert_eq!(names, [format!("usp({})", 2 * rank)]);
        let structure = StructureTheory::new(catalogued(&names[0]));
        assert_eq!(structure.killing().signature(), Some([0, cartan_type.dimension(), 0]));
        assert_eq!(structure.dynkin_type().unwrap(), [cartan_type]);
    }
}

/// A direct sum of named algebras is identified by their names, in any order of the basis.
#[test]
fn sums_are_named_by_their_parts() {
    for (sum, name) in [
        ("so(3,1)+heisenberg(3)", "sl(2,C) + heisenberg(3)"),
        ("heisenberg(5)+so(3)+R^2", "su(2) + heisenberg(5) + R^2"),
        ("so(5)+so(2,1)", "sl(2,R) + so(5)"),
        ("G2+R^1", "g2(2) + R^1"),
        ("usp(8)+R^1", "usp(8) + R^1"),
    ] {
        let found = StructureTheory::new(catalogued(sum)).identify().unwrap();
        assert_eq!((found.names, found.proved), (vec![name.to_string()], true), "{sum}");
    }
    // a summand without a name
    assert!(StructureTheory::new(catalogued("se(3)+so(3)")).identify().is_none());
}
