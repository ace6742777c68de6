//! The construction of the matrices, weight space by weight space.
//!
//! In an irreducible representation, a vector of lower weight is determined by its images under all
//! `e_j`. The images of `f_i w` are `e_j f_i w = f_i e_j w + δ_ij h_i w`, which are known from the
//! weight spaces above. So linear algebra in the images selects a basis among the monomials, and
//! expands the other monomials. It is done modulo primes; the rational entries are reconstructed
//! and verified.

use super::{MatrixRepresentation, Monomial};
use crate::representation::{HighestWeight, RepresentationError};
use affinor_tensors::linear::Matrix;
use affinor_tensors::linear::modular::{Prime, RationalReconstruction, primes};
use affinor_tensors::stop::checkpoint;
use affinor_tensors::{Rational, Ring};
use num_traits::ToPrimitive;
use std::collections::{BTreeMap, HashMap};

/// The largest number of primes that are tried.
const PRIMES: usize = 2000;

pub(super) fn matrices(
    weight: &HighestWeight,
) -> Result<MatrixRepresentation, RepresentationError> {
    let dimension = weight.dimension().to_usize().unwrap_or(usize::MAX);
    let mut found: Option<(Module, RationalReconstruction)> = None;
    for prime in primes().take(PRIMES) {
        let module = Module::new(weight, prime);
        // the matrices of independent monomials modulo a prime are independent over the rationals,
        // so a smaller dimension excludes only the prime
        if module.basis.len() != dimension {
            continue;
        }
        let (known, mut numbers) = match found.take() {
            Some((known, numbers)) if known.has_entries_of(&module) => (known, numbers),
            Some((known, numbers)) if known.size() > module.size() => {
                found = Some((known, numbers));
                continue;
            }
            _ => {
                let numbers = RationalReconstruction::new(module.size());
                (module.clone(), numbers)
            }
        };
        numbers.add(prime, &module.residues().collect::<Vec<_>>());
        if let Some(rationals) = numbers.rationals() {
            let candidate = known.with_entries(weight, rationals);
            if candidate.satisfies_relations() {
                return Ok(candidate);
            }
        }
        found = Some((known, numbers));
    }
    Err(RepresentationError::TooLarge {
        what: format!("the number of digits of the matrices of {weight}"),
        limit: format!("{PRIMES} primes"),
    })
}

/// A vector as sorted pairs of a basis vector and a residue.
type Sparse = Vec<(usize, u64)>;

/// The representation modulo a prime.
#[derive(Clone)]
struct Module {
    basis: Vec<Monomial>,
    /// The images `e_i v_k` at `[i][k]`.
    raised: Vec<Vec<Sparse>>,
    /// The images `f_i v_k` at `[i][k]`.
    lowered: Vec<Vec<Sparse>>,
}

/// The basis vectors of a weight space: the first one and their number.
type Space = (usize, usize);

impl Module {
    fn new(weight: &HighestWeight, prime: Prime) -> Self {
        let algebra = weight.algebra();
        let rank = algebra.semisimple_rank();
        let highest = Monomial { weight: weight.labels().to_vec(), factors: vec![], parent: 0 };
        let mut module = Module {
            basis: vec![highest],
            raised: vec![vec![vec![]]; rank],
            lowered: vec![vec![vec![]]; rank],
        };
        let shifted = |weight: &[i64], i: usize, sign: i64| {
            let mut weight = weight.to_vec();
            weight[i] += 2 * sign;
            algebra.neighbours(i).iter().for_each(|&(j, entry)| weight[j] += sign * entry);
            weight
        };
        let mut spaces: HashMap<Vec<i64>, Space> = HashMap::new();
        let mut level = vec![weight.labels().to_vec()];
        spaces.insert(level[0].clone(), (0, 1));
        while !level.is_empty() {
            // the weights of the next level, in descending lexicographic order
            let mut next: BTreeMap<Vec<i64>, ()> = BTreeMap::new();
            for above in &level {
                next.extend((0..rank).map(|i| (shifted(above, i, -1), ())));
            }
            level.clear();
            for weight in next.into_keys().rev() {
                checkpoint();
                let above: Vec<(usize, Space)> = (0..rank)
                    .filter_map(|i| Some((i, *spaces.get(&shifted(&weight, i, 1))?)))
                    .collect();
                let first = module.basis.len();
                module.add_space(prime, &weight, &above);
                if module.basis.len() > first {
                    spaces.insert(weight.clone(), (first, module.basis.len() - first));
                    level.push(weight);
                }
            }
        }
        module
    }

    /// Adds the weight space below the given spaces `(i, space of weight + α_i)`.
    fn add_space(&mut self, p: Prime, weight: &[i64], above: &[(usize, Space)]) {
        let mut offsets = vec![];
        let mut length = 0;
        for (_, (_, size)) in above {
            offsets.push(length);
            length += size;
        }
        let first = self.basis.len();
        let mut echelon = Echelon::default();
        for &(i, (start, size)) in above {
            for parent in start..start + size {
                let power = match self.basis[parent].factors.first() {
                    Some(&(own, power)) if own == i => power + 1,
                    _ => 1,
                };
                let images = self.images(p, i, parent, above, &offsets, length);
                let multiple = p.integer(power.into());
                let Some(unit) = p.inv(multiple) else { continue };
                let scaled = images.iter().map(|value| p.mul(*value, unit)).collect();
                let (coordinates, is_new) = echelon.insert(p, scaled);
                let terms = coordinates.iter().enumerate().filter(|(_, value)| **value != 0);
                let expansion = terms.map(|(k, value)| (first + k, p.mul(*value, multiple)));
                self.lowered[i][parent] = expansion.collect();
                if !is_new {
                    continue;
                }
                let mut factors = self.basis[parent].factors.clone();
                match factors.first_mut() {
                    Some((own, own_power)) if *own == i => *own_power = power,
                    _ => factors.insert(0, (i, 1)),
                }
                self.basis.push(Monomial { weight: weight.to_vec(), factors, parent });
                self.lowered.iter_mut().for_each(|images| images.push(vec![]));
                self.raised.iter_mut().for_each(|images| images.push(vec![]));
                for (&(j, (from, size)), &offset) in above.iter().zip(&offsets) {
                    let entries = images[offset..offset + size].iter().enumerate();
                    let entries = entries.filter(|(_, value)| **value != 0);
                    let entries = entries.map(|(at, value)| (from + at, p.mul(*value, unit)));
                    self.raised[j][self.basis.len() - 1] = entries.collect();
                }
            }
        }
    }

    /// The images `e_j f_i w = f_i e_j w + δ_ij h_i w` in the weight spaces above.
    fn images(
        &self,
        p: Prime,
        i: usize,
        w: usize,
        above: &[(usize, Space)],
        offsets: &[usize],
        length: usize,
    ) -> Vec<u64> {
        let mut images = vec![0; length];
        for (&(j, (from, _)), &offset) in above.iter().zip(offsets) {
            for &(at, value) in &self.raised[j][w] {
                for &(to, entry) in &self.lowered[i][at] {
                    let place = &mut images[offset + to - from];
                    *place = p.reduce(*place + value * entry);
                }
            }
            if i == j {
                let place = &mut images[offset + w - from];
                *place = p.add(*place, p.integer(self.basis[w].weight[i]));
            }
        }
        images
    }

    /// All entries, in the order of [`with_entries`](Self::with_entries).
    fn entries(&self) -> impl Iterator<Item = &(usize, u64)> {
        self.raised.iter().chain(&self.lowered).flatten().flatten()
    }

    fn residues(&self) -> impl Iterator<Item = u64> {
        self.entries().map(|(_, value)| *value)
    }

    fn size(&self) -> usize {
        self.entries().count()
    }

    /// Whether both modules have the same basis and the same positions of nonzero entries.
    fn has_entries_of(&self, other: &Self) -> bool {
        let rows = |module: &Module| module.entries().map(|(at, _)| *at).collect::<Vec<_>>();
        let lengths = |module: &Module| {
            let lists = module.raised.iter().chain(&module.lowered).flatten();
            lists.map(Vec::len).collect::<Vec<_>>()
        };
        self.basis == other.basis && lengths(self) == lengths(other) && rows(self) == rows(other)
    }

    /// The representation over the rationals with these entries.
    fn with_entries(&self, weight: &HighestWeight, entries: Vec<Rational>) -> MatrixRepresentation {
        let n = self.basis.len();
        let mut entries = entries.into_iter();
        let mut matrix = |columns: &Vec<Sparse>| {
            let mut rows = vec![vec![]; n];
            for (column, images) in columns.iter().enumerate() {
                for ((row, _), value) in images.iter().zip(entries.by_ref()) {
                    if !value.vanishes() {
                        rows[*row].push((column, value));
                    }
                }
            }
            Matrix::from_rows(n, rows).expect("columns are numbers of basis vectors")
        };
        MatrixRepresentation {
            weight: weight.clone(),
            basis: self.basis.clone(),
            raising: self.raised.iter().map(&mut matrix).collect(),
            lowering: self.lowered.iter().map(&mut matrix).collect(),
        }
    }
}

/// Vectors modulo a prime that are inserted one by one, and their expansions in the first linearly
/// independent vectors.
#[derive(Default)]
struct Echelon {
    /// A pivot, a row with 1 at the pivot and 0 at earlier pivots, and its coordinates.
    rows: Vec<(usize, Vec<u64>, Vec<u64>)>,
}

impl Echelon {
    /// The coordinates of the vector in the independent vectors, and whether it is one of these.
    fn insert(&mut self, p: Prime, mut vector: Vec<u64>) -> (Vec<u64>, bool) {
        let count = self.rows.len();
        // the vector is the remainder plus the combination with these coordinates
        let mut coordinates = vec![0; count];
        for (pivot, row, own) in &self.rows {
            let factor = vector[*pivot];
            if factor == 0 {
                continue;
            }
            let minus = p.neg(factor);
            for (value, entry) in vector.iter_mut().zip(row) {
                *value = p.reduce(*value + minus * entry);
            }
            for (value, entry) in coordinates.iter_mut().zip(own) {
                *value = p.reduce(*value + factor * entry);
            }
        }
        let Some(pivot) = vector.iter().position(|value| *value != 0) else {
            return (coordinates, false);
        };
        let unit = p.inv(vector[pivot]).unwrap_or(1);
        vector.iter_mut().for_each(|value| *value = p.mul(*value, unit));
        let mut own: Vec<u64> = coordinates.iter().map(|v| p.mul(p.neg(*v), unit)).collect();
        own.push(unit);
        self.rows.push((pivot, vector, own));
        (std::iter::repeat_n(0, count).chain([1]).collect(), true)
    }
}
