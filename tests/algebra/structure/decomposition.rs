//! The summands of random sums of indecomposable algebras are found again (Krull and Schmidt), in
//! dense bases too.

use crate::algebra::structure::{regular, scrambled, stored};
use crate::common::algebras::{by_table, catalogued};
use affinor::algebra::structure::{Indecomposable, StructureTheory, Subspace};
use affinor::{LieAlgebra, Rational};
use affinor_tensors::linear::Echelon;

type Algebra = LieAlgebra<Rational>;

/// Algebras that are indecomposable over the rationals, by theorems or by their tables.
const SUMMANDS: [&str; 29] = [
    "R^1",
    "aff(1)",
    "heisenberg(3)",
    "so(3)",
    "sl(2)",
    "bianchi(IV)",
    "bianchi(V)",
    "bianchi(VI,h=-1)",
    "bianchi(VI,h=-1/2)",
    "bianchi(VII,h=0)",
    "bianchi(VII,h=2)",
    "filiform(4)",
    "oscillator(4)",
    "patera(4,7)",
    "patera(4,9,b=1)",
    "patera(4,12)",
    "heisenberg(5)",
    "free_nilpotent(2,3)",
    "filiform(5)",
    "degraaf(5,6)",
    "degraaf(5,8)",
    "degraaf(6,10)",
    "degraaf(6,22,e=-1)",
    "free_nilpotent(3,2)",
    "so(3,1)",
    "se(3)",
    "borel(A2)",
    "gong(7,17)",
    "sl(3)",
];

/// Algebras over number fields: indecomposable over the rationals, and sums of two over the reals.
const OVER_FIELDS: [&str; 2] = ["L6,22(2)", "sl(2) over Q(sqrt 2)"];

/// Invariants that distinguish the summands.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
struct Kind {
    dimension: usize,
    real_parts: usize,
    derived: Vec<usize>,
    lower: Vec<usize>,
    centre: usize,
    killing: Option<[usize; 3]>,
}

fn kind(structure: &StructureTheory<Rational>, real_parts: usize) -> Kind {
    let dimensions =
        |series: &[Subspace<Rational>]| series.iter().map(Subspace::dimension).collect();
    Kind {
        dimension: structure.dimension(),
        real_parts,
        derived: dimensions(structure.derived_series()),
        lower: dimensions(structure.lower_central_series()),
        centre: structure.centre().dimension(),
        killing: structure.killing().signature(),
    }
}

/// The kinds of the ideals found. The ideals must commute and span the algebra.
fn kinds(algebra: Algebra) -> Vec<Kind> {
    let structure = StructureTheory::new(algebra);
    let found = structure.indecomposable_ideals().unwrap().unwrap();
    let dense = |one: &Indecomposable| one.ideal.dense();
    for (at, one) in found.iter().enumerate() {
        for other in &found[at + 1..] {
            let mut span = Echelon::new();
            for (x, y) in
                dense(one).iter().flat_map(|x| dense(other).into_iter().map(move |y| (x, y)))
            {
                let bracket = structure.algebra().bracket(x, &y).unwrap();
                span.insert(bracket.into_iter().enumerate()).unwrap();
            }
            assert_eq!(span.rank(), 0);
        }
    }
    let all: Vec<Vec<Rational>> = found.iter().flat_map(dense).collect();
    assert!(regular(&all) && all.len() == structure.dimension());
    let part =
        |one: &Indecomposable| kind(&structure.subalgebra(&one.ideal).unwrap(), one.real_parts);
    let mut kinds: Vec<Kind> = found.iter().map(part).collect();
    kinds.sort();
    kinds
}

/// Integers below a bound, the same in every run.
struct Numbers(u64);

impl Numbers {
    fn below(&mut self, bound: usize) -> usize {
        self.0 =
            self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 33) as usize % bound
    }
}

/// Sums up to dimension 12. Few kinds occur in each, so that many summands are equal; every second
/// sum is in a dense basis.
fn random_sums(seed: u64, count: usize) {
    let mut all: Vec<(String, Algebra, usize)> =
        SUMMANDS.iter().map(|name| (name.to_string(), catalogued(name), 1)).collect();
    for (algebra, entry) in stored() {
        let name = entry["name"].as_str().unwrap();
        if OVER_FIELDS.contains(&name) {
            all.push((name.into(), algebra, 2));
        }
    }
    assert_eq!(all.len(), SUMMANDS.len() + OVER_FIELDS.len());
    let known: Vec<Kind> = all
        .iter()
        .map(|(_, algebra, parts)| kind(&StructureTheory::new(algebra.clone()), *parts))
        .collect();
    let mut numbers = Numbers(seed);
    for at in 0..count {
        let kinds_of_sum: Vec<usize> =
            (0..1 + numbers.below(4)).map(|_| numbers.below(all.len())).collect();
        let mut chosen = vec![kinds_of_sum[0]];
        let dimension =
            |chosen: &[usize]| chosen.iter().map(|one| all[*one].1.dimension()).sum::<usize>();
        for _ in 0..12 {
            let next = kinds_of_sum[numbers.below(kinds_of_sum.len())];
            if dimension(&chosen) + all[next].1.dimension() <= 12 {
                chosen.push(next);
            }
        }
        let names: Vec<&str> = chosen.iter().map(|one| all[*one].0.as_str()).collect();
        let summands = chosen.iter().map(|one| all[*one].1.clone());
        let sum = summands.reduce(|sum, one| sum.direct_sum(&one).unwrap()).unwrap();
        let sum = if at % 2 == 0 { sum } else { scrambled(&sum, at as i64) };
        let mut expected: Vec<Kind> = chosen.iter().map(|one| known[*one].clone()).collect();
        expected.sort();
        assert_eq!(kinds(sum), expected, "{} (number {at})", names.join(" + "));
    }
}

#[test]
fn random_sums_have_their_summands_back() {
    random_sums(1, 100);
}

#[test]
#[ignore = "a minute"]
fn many_random_sums_have_their_summands_back() {
    random_sums(2, 1500);
}

/// Sums with equal parts for which three fixed elements of the centroid were not generic.
#[test]
fn sums_with_equal_parts() {
    for (name, dimensions) in [
        ("heisenberg(3)+degraaf(5,8)+heisenberg(3)", vec![3, 3, 5]),
        ("free_nilpotent(2,3)+so(3)+aff(1)+aff(1)", vec![2, 2, 3, 5]),
        ("heisenberg(5)+free_nilpotent(2,3)+aff(1)", vec![2, 5, 5]),
        ("aff(1)+aff(1)+aff(1)+aff(1)+aff(1)+aff(1)", vec![2; 6]),
    ] {
        let found: Vec<usize> = kinds(catalogued(name)).iter().map(|one| one.dimension).collect();
        assert_eq!(found, dimensions, "{name}");
    }
}

/// `L` over the field `Q[x]/(p)`, as an algebra over the rationals: `p` is monic, given by its lower coefficients, and the vector
/// `e_i x^a` has the number `i d + a`.
fn over_field(algebra: &Algebra, p: &[i64]) -> Algebra {
    let (n, d) = (algebra.dimension(), p.len());
    // x^k modulo p
    let mut powers: Vec<Vec<i64>> =
        (0..d).map(|k| (0..d).map(|a| i64::from(a == k)).collect()).collect();
    for k in d..2 * d {
        let before = powers[k - 1].clone();
        let carry = before[d - 1];
        powers
            .push((0..d).map(|a| if a == 0 { 0 } else { before[a - 1] } - carry * p[a]).collect());
    }
    let c = algebra.structure_constants();
    let mut table = vec![];
    for (at, value) in c.components().filter(|(at, _)| at[1] < at[2]) {
        let value: i64 = value.to_string().parse().unwrap();
        for (a, b) in (0..d).flat_map(|a| (0..d).map(move |b| (a, b))) {
            for (m, share) in powers[a + b].iter().enumerate().filter(|(_, share)| **share != 0) {
                table.push((
                    at[1] * d + a + 1,
                    at[2] * d + b + 1,
                    at[0] * d + m + 1,
                    value * share,
                ));
            }
        }
    }
    by_table(n * d, &table)
}

/// Over a number field with `r` real and `s` pairs of complex embeddings an algebra falls into `r + s` parts over the reals.
#[test]
fn algebras_over_fields_with_complex_embeddings() {
    // x^2 + 1, x^2 - 2, x^3 - 2, x^3 - 3 x + 1, x^4 - 2, x^4 + 1
    let fields: [(&[i64], usize); 6] = [
        (&[1, 0], 1),
        (&[-2, 0], 2),
        (&[-2, 0, 0], 2),
        (&[1, -3, 0], 3),
        (&[-2, 0, 0, 0], 3),
        (&[1, 0, 0, 0], 2),
    ];
    for (p, parts) in fields {
        for name in ["heisenberg(3)", "sl(2)", "aff(1)"] {
            let algebra = over_field(&catalogued(name), p);
            for algebra in [scrambled(&algebra, 5), algebra] {
                let found = kinds(algebra);
                assert_eq!(found.len(), 1, "{name} over {p:?}");
                assert_eq!(found[0].real_parts, parts, "{name} over {p:?}");
            }
        }
    }
}
