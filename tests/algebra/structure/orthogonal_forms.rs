//! Real forms of equal type and signature, in dense bases.

use crate::common::algebras::catalogued;
use affinor::algebra::roots::{CartanType, Series};
use affinor::algebra::structure::StructureTheory;
use affinor::algebra::structure::real_forms::real_forms;
use affinor::{BasisChange, LieAlgebra, Rational, Tensor};
use affinor_tensors::{Down, Up};

/// The algebra after changes `e_a += e_b` or `e_a -= e_b` of its basis.
pub fn changed(algebra: &LieAlgebra<Rational>, changes: usize) -> LieAlgebra<Rational> {
    let n = algebra.dimension();
    let mut seed = 1u64;
    let mut draw = |below: usize| {
        seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (seed >> 33) as usize % below
    };
    let mut columns: Vec<Vec<i64>> =
        (0..n).map(|a| (0..n).map(|i| i64::from(i == a)).collect()).collect();
    for _ in 0..changes {
        let (a, b, sign) = (draw(n), draw(n), [1, -1][draw(2)]);
        if a != b {
            let other = columns[b].clone();
            columns[a].iter_mut().zip(other).for_each(|(v, w)| *v += sign * w);
        }
    }
    let matrix = Tensor::from_fn(n, [Up, Down], |[i, a]| Rational::from(columns[a][i])).unwrap();
    algebra.change_basis(&BasisChange::new(matrix).unwrap()).unwrap()
}

/// Up to rank 9 type and signature allow two forms in one case, up to rank 13 in two.
#[test]
fn types_with_two_forms() {
    use Series::{A, B, C, D};
    let classical = [A, B, C, D]
        .into_iter()
        .flat_map(|series| (1..=13).filter_map(move |rank| CartanType::new(series, rank).ok()));
    let two = classical.flat_map(|one| {
        (0..=one.dimension()).filter_map(move |compact| {
            let names = real_forms(one, compact);
            (names.len() > 1).then_some(names.join(" "))
        })
    });
    assert_eq!(two.collect::<Vec<_>>(), ["su(9,5) su*(14)", "so(12,6) so*(18)"]);
}

/// The two forms are distinguished in the basis of the catalogue and in a dense one; the last pair
/// by the full search for simple ideals.
#[test]
fn forms_of_equal_signature_in_dense_bases() {
    for (name, form) in [
        ("so*(18)", "so*(18)"),
        ("so(12,6)", "so(12,6)"),
        ("sl(7,H)", "su*(14)"),
        ("su(9,5)", "su(9,5)"),
    ] {
        let algebra = catalogued(name);
        let dense = changed(&algebra, 3 * algebra.dimension() / 4);
        assert!(dense.structure_constants().len() > 3 * algebra.structure_constants().len());
        for algebra in [algebra, dense] {
            let found = StructureTheory::new(algebra).simple_ideals().unwrap().unwrap();
            assert_eq!(found.real.len(), 1);
            assert_eq!(found.real[0].names, [form]);
        }
    }
}

/// The criterion by a regular element agrees with the signature where the signature decides.
#[test]
fn orthogonal_forms_of_low_rank() {
    let quaternionic = |algebra| StructureTheory::new(algebra).is_quaternionic_orthogonal();
    for r in 5..7 {
        let name = format!("so*({})", 2 * r);
        assert_eq!(quaternionic(catalogued(&name)), Some(true), "{name}");
        assert_eq!(quaternionic(changed(&catalogued(&name), 100)), Some(true), "{name}");
        for q in 0..=r {
            let p = 2 * r - q;
            let name = if q == 0 { format!("so({p})") } else { format!("so({p},{q})") };
            assert_eq!(quaternionic(catalogued(&name)), Some(false), "{name}");
            assert_eq!(quaternionic(changed(&catalogued(&name), 100)), Some(false), "{name}");
        }
    }
    // other types, and D4 with its three eight-dimensional representations
    for name in ["so(4,4)", "so(7,2)", "su(4,2)", "iso(6,4)"] {
        assert_eq!(quaternionic(catalogued(name)), None, "{name}");
    }
}
