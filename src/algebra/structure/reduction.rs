//! A Lie algebra modulo a prime: brackets of residues, for ranks.
//!
//! The rank of a matrix modulo a prime is at most the rank of the matrix, and equal to it for all
//! but finitely many primes.

use super::{GroundField, StructureTheory};
use crate::algebra::SparseBracket;
use affinor_tensors::linear::modular::{Prime, ResidueMatrix, primes};

/// The structure constants of an algebra modulo a prime.
#[derive(Clone, Debug)]
pub struct ModularAlgebra {
    prime: Prime,
    constants: SparseBracket<u64>,
}

/// A generator of pseudorandom residues. The residues are the same in every run.
#[derive(Clone, Debug)]
pub struct PseudoRandom(u64);

impl PseudoRandom {
    /// The sequence of residues with the number `seed`.
    pub fn new(seed: u64) -> Self {
        PseudoRandom(seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) | 1)
    }

    /// The next residue.
    pub fn residue(&mut self, prime: Prime) -> u64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 >> 33) % prime.get()
    }

    /// A vector of residues.
    pub fn vector(&mut self, prime: Prime, length: usize) -> Vec<u64> {
        (0..length).map(|_| self.residue(prime)).collect()
    }
}

impl ModularAlgebra {
    /// Reduces an algebra modulo a prime. Returns `None` if the prime divides a denominator or a
    /// structure constant.
    pub fn new<S: GroundField>(structure: &StructureTheory<S>, prime: Prime) -> Option<Self> {
        let residue = |value: &S| value.residue(prime).filter(|residue| *residue != 0);
        Some(ModularAlgebra { prime, constants: structure.products.map(residue)? })
    }

    /// The algebra whose structure constants are the residues of these integers. Returns `None` if
    /// the prime divides one of them.
    pub(crate) fn of_integers(prime: Prime, constants: &SparseBracket<i64>) -> Option<Self> {
        let constants = constants.map(|value| Some(prime.integer(*value)))?;
        Some(ModularAlgebra { prime, constants })
    }

    /// The prime.
    pub fn prime(&self) -> Prime {
        self.prime
    }

    /// The dimension.
    pub fn dimension(&self) -> usize {
        self.constants.dimension()
    }

    /// The constants `(k, i, c^i_jk)` of `[e_j, .]`.
    pub fn of(&self, j: usize) -> &[(usize, usize, u64)] {
        self.constants.of(j)
    }

    /// The matrix of `[x, .]`, with rows `i` and columns `k`.
    pub fn ad(&self, x: &[u64]) -> ResidueMatrix {
        let (n, p) = (self.dimension(), self.prime);
        let mut rows = vec![vec![0; n]; n];
        for (j, &factor) in x.iter().enumerate().filter(|(_, factor)| **factor != 0) {
            for &(k, i, value) in self.of(j) {
                rows[i][k] = p.reduce(rows[i][k] + factor * value);
            }
        }
        ResidueMatrix::new(p, n, rows)
    }

    /// The bracket of two vectors.
    pub fn bracket(&self, x: &[u64], y: &[u64]) -> Vec<u64> {
        self.constants.bracket(x, y, 0, self.fused())
    }

    /// A function that computes `sum + a b` for residues.
    fn fused(&self) -> impl Fn(u64, u64, u64) -> u64 + use<> {
        let p = self.prime;
        move |sum, a, b| p.reduce(sum + a * b)
    }

    /// The matrix of the Killing form.
    pub fn killing(&self) -> ResidueMatrix {
        let rows = self.constants.killing(0, self.fused());
        ResidueMatrix::new(self.prime, self.dimension(), rows)
    }

    /// A few vectors that generate the algebra. They are pseudorandom vectors, or the basis vectors
    /// if the number of pseudorandom vectors would not be smaller.
    pub(super) fn generators(&self) -> Vec<Vec<u64>> {
        let (n, p) = (self.dimension(), self.prime);
        let mut draw = PseudoRandom::new(2);
        let mut generators = vec![];
        while generators.len() + 1 < n {
            generators.push(draw.vector(p, n));
            if generators.len() > 1 && self.generates(&generators) {
                return generators;
            }
        }
        (0..n).map(|at| (0..n).map(|i| u64::from(i == at)).collect()).collect()
    }

    /// Whether the vectors generate the algebra.
    pub(crate) fn generates(&self, generators: &[Vec<u64>]) -> bool {
        let (n, p) = (self.dimension(), self.prime);
        let ads: Vec<ResidueMatrix> = generators.iter().map(|x| self.ad(x)).collect();
        let mut layer = generators.to_vec();
        let mut span = ResidueMatrix::new(p, n, generators.to_vec());
        let mut rank = span.reduce().len();
        while rank < n {
            let images = layer.iter().flat_map(|x| ads.iter().map(|ad| ad.apply(x)));
            let images: Vec<Vec<u64>> = images.collect();
            let mut next = ResidueMatrix::new(p, n, [span.rows(), &images].concat());
            let grown = next.reduce().len();
            if grown == rank {
                return false;
            }
            // continues with the reduced rows if there are many images: these rows span the images
            // too, and are at most n
            layer = match images.len() > 2 * n {
                true => next.rows().to_vec(),
                false => images,
            };
            (span, rank) = (next, grown);
        }
        true
    }
}

impl<S: GroundField> StructureTheory<S> {
    /// The endless sequence of reductions modulo primes that divide neither a denominator nor a
    /// structure constant.
    pub fn reductions(&self) -> impl Iterator<Item = ModularAlgebra> {
        primes().filter_map(|prime| ModularAlgebra::new(self, prime))
    }

    /// The reductions of a semisimple algebra with a nondegenerate Killing form. They have the same
    /// types as the algebra. The sequence is empty for other algebras.
    pub(super) fn semisimple_reductions(&self) -> impl Iterator<Item = ModularAlgebra> {
        let regular = |prime: &Prime| self.has_regular_killing_form(*prime) == Some(true);
        let candidates = primes().take_while(|_| self.is_semisimple()).filter(regular);
        candidates.filter_map(|prime| ModularAlgebra::new(self, prime))
    }
}
