//! Random representations, and characters by brute force.

use crate::common::root;
use affinor::representation::{Decomposition, HighestWeight, ReductiveAlgebra};
use num_bigint::BigUint;
use proptest::prelude::*;
use std::collections::{BTreeMap, BTreeSet};

/// A prime below 2^31.
pub const PRIME: u64 = 2_147_483_629;

pub fn algebra(name: &str) -> ReductiveAlgebra {
    name.parse().unwrap()
}

pub fn weight(name: &str, labels: &[i64]) -> HighestWeight {
    HighestWeight::new(&algebra(name), labels).unwrap()
}

pub fn representation(name: &str, weight: &str) -> Decomposition {
    Decomposition::irreducible(&HighestWeight::parse(&algebra(name), weight).unwrap())
}

/// The simple types of rank at most 8, and some sums.
pub const TYPES: [&str; 37] = [
    "A1",
    "A2",
    "A3",
    "A4",
    "A5",
    "A6",
    "A7",
    "A8",
    "B2",
    "B3",
    "B4",
    "B5",
    "B6",
    "B7",
    "B8",
    "C2",
    "C3",
    "C4",
    "C5",
    "C6",
    "C7",
    "C8",
    "D3",
    "D4",
    "D5",
    "D6",
    "D7",
    "D8",
    "E6",
    "E7",
    "E8",
    "F4",
    "G2",
    "A2 + A1",
    "B2 + G2",
    "A1 + A1 + T1",
    "A2 + T2",
];

/// Random highest weights with few labels and a dimension of at most `limit`.
pub fn weights(limit: u64) -> impl Strategy<Value = HighestWeight> {
    let labels = proptest::collection::vec((any::<prop::sample::Index>(), 0..4_i64), 1..4);
    (0..TYPES.len(), labels).prop_filter_map("a large dimension", move |(at, chosen)| {
        some_weight(TYPES[at], &chosen, limit)
    })
}

/// Random pairs of highest weights of one algebra.
pub fn pairs(limit: u64) -> impl Strategy<Value = (HighestWeight, HighestWeight)> {
    let labels = || proptest::collection::vec((any::<prop::sample::Index>(), 0..4_i64), 1..4);
    (0..TYPES.len(), labels(), labels()).prop_filter_map("a large dimension", move |(at, a, b)| {
        Some((some_weight(TYPES[at], &a, limit)?, some_weight(TYPES[at], &b, limit)?))
    })
}

fn some_weight(
    name: &str,
    chosen: &[(prop::sample::Index, i64)],
    limit: u64,
) -> Option<HighestWeight> {
    let algebra = algebra(name);
    let mut labels = vec![0; algebra.rank()];
    for (index, label) in chosen {
        let at = index.index(labels.len());
        labels[at] = if at < algebra.semisimple_rank() { *label } else { label - 2 };
    }
    let weight = HighestWeight::new(&algebra, labels).unwrap();
    (weight.dimension() <= BigUint::from(limit)).then_some(weight)
}

/// All weights of a representation with their multiplicities. The orbits are closed under the
/// simple reflections, which are written from the Cartan matrices.
pub fn all_weights(representation: &Decomposition) -> BTreeMap<Vec<i64>, i128> {
    let algebra = representation.algebra();
    let mut reflections = vec![];
    for (at, factor) in algebra.simple_factors().iter().enumerate() {
        let start = algebra.positions(at).start;
        for (i, row) in factor.cartan_matrix().into_iter().enumerate() {
            reflections.push((start + i, start, row));
        }
    }
    let mut all = BTreeMap::new();
    for (dominant, multiplicity) in representation.character().unwrap().dominant_weights() {
        let mut orbit = BTreeSet::from([dominant.to_vec()]);
        let mut open = vec![dominant.to_vec()];
        while let Some(weight) = open.pop() {
            for (i, start, root) in &reflections {
                let mut image = weight.clone();
                for (j, entry) in root.iter().enumerate() {
                    image[start + j] -= weight[*i] * entry;
                }
                if orbit.insert(image.clone()) {
                    open.push(image);
                }
            }
        }
        for weight in orbit {
            *all.entry(weight).or_insert(0) += multiplicity;
        }
    }
    all
}

pub fn power(base: u64, exponent: i64) -> u64 {
    let order = (PRIME - 1) as i64;
    let mut exponent = exponent.rem_euclid(order);
    let (mut value, mut square) = (1, base % PRIME);
    while exponent > 0 {
        if exponent % 2 == 1 {
            value = value * square % PRIME;
        }
        square = square * square % PRIME;
        exponent /= 2;
    }
    value
}

/// The value of the character at the torus element with coordinates `t`, modulo a prime: the sum of
/// the multiplicities times `t^(k ν)`.
pub fn character_at(representation: &Decomposition, t: &[u64], k: i64) -> u64 {
    let terms = all_weights(representation).into_iter().map(|(weight, multiplicity)| {
        let value = weight.iter().zip(t).fold(1, |v, (w, t)| v * power(*t, k * w) % PRIME);
        let multiplicity = u64::try_from(multiplicity.rem_euclid(i128::from(PRIME))).unwrap();
        multiplicity * value % PRIME
    });
    terms.fold(0, |sum, term| (sum + term) % PRIME)
}

/// A fixed torus element for an algebra.
pub fn torus(algebra: &ReductiveAlgebra, seed: u64) -> Vec<u64> {
    let next = |state: u64| {
        state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407)
    };
    std::iter::successors(Some(next(seed)), |state| Some(next(*state)))
        .map(|state| (state >> 33) % (PRIME - 1) + 1)
        .take(algebra.rank())
        .collect()
}

/// The rows of a table that GAP computed: the algebra, the highest weights, and labels with
/// multiplicities.
pub type GapRow = (ReductiveAlgebra, Vec<HighestWeight>, BTreeMap<Vec<i64>, i128>);

pub fn gap_table(name: &str) -> Vec<GapRow> {
    let path = root().join("tests/data/representations").join(name);
    let text = std::fs::read_to_string(path).unwrap();
    let labels = |text: &str| text.split(',').map(|l| l.parse().unwrap()).collect::<Vec<i64>>();
    let rows = text.lines().filter(|line| !line.starts_with('#'));
    rows.map(|line| {
        let (head, result) = line.split_once(" : ").unwrap();
        let mut words = head.split(' ');
        let algebra = algebra(words.next().unwrap());
        let weights = words.map(|word| HighestWeight::new(&algebra, labels(word)).unwrap());
        let weights = weights.collect();
        let result = result.split(' ').map(|term| {
            let (word, multiplicity) = term.split_once('*').unwrap();
            (labels(word), multiplicity.parse().unwrap())
        });
        (algebra, weights, result.collect())
    })
    .collect()
}
