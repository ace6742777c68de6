//! The structure theory recognizes the families of the catalogue.
//!
//! Guards `algebra::catalogue` and `StructureTheory::{identify, dynkin_type, simple_ideals}`.

use crate::algebra::structure::{invariants, stored};
use crate::common::algebras::catalogued;
use affinor::Rational;
use affinor::algebra::catalogue;
use affinor::algebra::structure::StructureTheory;

fn structure(name: &str) -> StructureTheory<Rational> {
    StructureTheory::new(catalogued(name))
}

/// The names of the real simple ideals of the Levi subalgebra, and the dimensions of algebra and radical.
fn shape(name: &str) -> String {
    let all = structure(name);
    let levi = all.levi().unwrap();
    let mut parts = vec![];
    if !levi.is_zero() {
        let ideals = all.subalgebra(levi).unwrap().simple_ideals().unwrap().unwrap();
        parts.extend(ideals.real.iter().map(|ideal| ideal.names.join(" or ")));
        parts.sort();
    }
    format!("{} {} {}", parts.join(" + "), all.radical().dimension(), all.nilradical().dimension())
}

#[test]
fn have_the_real_forms_of_their_names() {
    let rows = "\
su(2,1): su(2,1) 0 0
su(1,1): sl(2,R) 0 0
su(3,1): su(3,1) 0 0
su(2,2): su(2,2) 0 0
u(2): su(2) 1 1
u(1):  1 1
so*(4): sl(2,R) + su(2) 0 0
so*(6): su(3,1) 0 0
so*(8): so(6,2) 0 0
sl(1,H): su(2) 0 0
sl(2,H): su*(4) 0 0
sl(2,C): sl(2,C) 0 0
sl(3,C): sl(3,C) 0 0
so(3,C): sl(2,C) 0 0
so(5,C): so(5,C) 0 0
sp(4,C): so(5,C) 0 0
sp(1,1): so(4,1) 0 0
sp(2,1): sp(2,1) 0 0
usp(2): su(2) 0 0
usp(4): so(5) 0 0
usp(6): usp(6) 0 0
iso(3,1): sl(2,C) 4 4
iso(1,1):  3 2
galilei(3): su(2) 7 7
se_2(3): su(2) 6 6
compact(G2): g2(-14) 0 0
compact(A2): su(3) 0 0
compact(B3): so(7) 0 0
sim(2):  4 2
sim(3): su(2) 4 3
hom(3):  4 3
conformal(3,1): su(2,2) 0 0
conformal(1,1): sl(2,R) + sl(2,R) 0 0
schroedinger(1): sl(2,R) 3 3
schroedinger(3): sl(2,R) + su(2) 7 7
oscillator(4):  4 3
oscillator(6):  6 5
t(3):  6 4
n(4):  6 6
borel(A2):  5 3
parabolic(A3,2): sl(2,R) + sl(2,R) 5 4
parabolic(A3,1,3): sl(2,R) 7 5
parabolic(C3,1): so(3,2) 6 5
free_nilpotent(2,4):  8 8
filiform(7):  7 7
filiform_q(6):  6 6
damek_ricci(1,2):  7 6";
    for row in rows.lines() {
        let (name, expected) = row.split_once(": ").unwrap();
        assert_eq!(shape(name), expected, "{name}");
    }
}

/// The Killing forms of compact algebras are negative definite.
#[test]
fn compact_forms_are_compact() {
    let names =
        ["so(5)", "su(3)", "usp(6)", "compact(A1)", "compact(B2)", "compact(C3)", "compact(D4)"];
    for name in names.into_iter().chain(["compact(G2)", "compact(F4)"]) {
        let all = structure(name);
        assert_eq!(all.killing().signature(), Some([0, all.dimension(), 0]), "{name}");
    }
}

/// A table of the literature has the invariants that are stored under its name.
#[test]
fn tables_have_the_stored_invariants() {
    let mut count = 0;
    for (_, entry) in stored() {
        let name = entry["name"].as_str().unwrap();
        let Some((head, arguments)) = name.split_once(',') else { continue };
        let arguments = arguments.trim_end_matches(')').replace('(', ",");
        let family = match head {
            "A4" => format!("patera(4,{arguments})"),
            "L5" => format!("degraaf(5,{arguments})"),
            "L6" => format!("degraaf(6,{})", arguments.replace(',', ",e=")),
            _ => continue,
        };
        if name.contains('+') {
            continue;
        }
        let found = invariants(catalogued(&family));
        crate::algebra::structure::expect(&found, &entry, &family);
        count += 1;
    }
    assert_eq!(count, 59);
}

/// Free nilpotent algebras have the dimensions of Witt's formula, in every degree.
#[test]
fn free_nilpotent_algebras_are_free() {
    for (name, layers) in [
        ("free_nilpotent(2,5)", &[2, 1, 2, 3, 6][..]),
        ("free_nilpotent(3,4)", &[3, 3, 8, 18]),
        ("free_nilpotent(4,2)", &[4, 6]),
    ] {
        let all = structure(name);
        let series = all.lower_central_series();
        let steps: Vec<usize> =
            series.windows(2).map(|two| two[0].dimension() - two[1].dimension()).collect();
        assert_eq!(steps, layers, "{name}");
        assert!(series.last().unwrap().is_zero());
    }
}

/// `tr ad_a = dim v/2 + dim z`, the volume growth of a Damek-Ricci space.
#[test]
fn damek_ricci_algebras_are_of_type_h() {
    for (name, trace) in [("damek_ricci(1,1)", 3), ("damek_ricci(2,3)", 7)] {
        let algebra = catalogued(name);
        let n = algebra.dimension();
        let sum = (0..n)
            .fold(Rational::from(0), |sum, i| sum + &algebra.structure_constants().get(&[i, 0, i]));
        assert_eq!(sum, Rational::from(trace), "{name}");
        // the map v -> [v,w] is onto the centre for every v: here for the first
        let structure = StructureTheory::new(algebra);
        assert_eq!(structure.derived_series().len(), 4, "{name}");
    }
}

/// The laws hold for names that are sums of families or have parameters; the command line resolves
/// these names.
#[test]
fn every_example_satisfies_the_jacobi_identity() {
    for family in catalogue::families() {
        let entry = catalogue::find(family.example).unwrap();
        let bracket = entry.bracket::<_, affinor::Error>(|value| Ok(value.clone())).unwrap();
        assert!(bracket.jacobi_violation().is_none(), "{}", family.example);
    }
}

/// Derivations and invariant forms of `s + R^z`, by linear equations in low dimension and by theory
/// above it.
#[test]
fn reductive_algebras_on_both_sides_of_the_largest_dimension() {
    for (name, factors, z) in [
        ("A2+R^2", 1, 2),
        ("so(3,1)+R^3", 2, 3),
        ("A2+A1+R^1", 2, 1),
        ("A2+A4+R^2", 2, 2),
        ("so(3,1)+A4+R^3", 3, 3),
        ("sl(3,C)+A3+R^1", 3, 1),
        ("E6", 1, 0),
    ] {
        let all = structure(name);
        let n = all.dimension();
        assert_eq!(
            all.derivation_dimension().map(|all| all.dimension),
            Some(n - z + z * z),
            "{name}"
        );
        assert_eq!(
            all.invariant_form_dimension().map(|all| all.dimension),
            Some(factors + z * (z + 1) / 2),
            "{name}"
        );
    }
    assert_eq!(structure("se(8)").invariant_form_dimension(), None);
}

/// Betti numbers of the abelian algebras are binomial coefficients, also where floats no longer
/// represent all integers.
#[test]
fn betti_numbers_beyond_the_whole_numbers_of_a_float() {
    let betti = structure("R^56").betti_numbers().unwrap().0;
    assert_eq!((betti[1], betti[2], betti[28]), (56, 1540, 7_648_690_600_760_440));
    for name in ["R^57", "R^100", "so(3)+R^67"] {
        assert_eq!(structure(name).betti_numbers(), None, "{name}");
    }
}

/// Members of the tables are indecomposable over the reals, except those that the summary names.
#[test]
fn tables_of_indecomposable_algebras() {
    let sums = |name: &str| {
        let zero = |letter: &str| name.contains(&format!("{letter}=0"));
        let member =
            |all: &[&str]| all.iter().any(|start| name.starts_with(&format!("patera({start},")));
        zero("a") && member(&["3,5", "4,2", "4,5", "4,6"])
            || zero("b") && member(&["4,5"])
            || name.starts_with("degraaf(6,22,e=") && !name.contains("e=-") && !zero("e")
    };
    let tables = ["patera(", "degraaf("];
    let names =
        (2..7).flat_map(catalogue::names).filter(|name| tables.iter().any(|t| name.starts_with(t)));
    let mut count = 0;
    for name in names {
        let mut members = vec![name.trim_end_matches(')').to_string()];
        for parameter in catalogue::find(&name).unwrap().parameters {
            let values = ["-2", "-1", "0", "1", "2", "4", "9/4"];
            let with = |name: &String| values.map(|value| format!("{name},{parameter}={value}"));
            members = members.iter().flat_map(with).collect();
        }
        for member in members {
            let ideals = structure(&format!("{member})")).indecomposable_ideals().unwrap().unwrap();
            let parts: usize = ideals.iter().map(|part| part.real_parts).sum();
            assert_eq!(parts > 1, sums(&member), "{member}: {parts} parts");
            count += 1;
        }
    }
    assert!(count > 150, "{count}");
}
