//! Dense linear algebra modulo a prime below 2^31: ranks, kernels and polynomials of matrices.
//!
//! The rank modulo a prime is at most the rank over the rationals, and equals it for all but
//! finitely many primes. In this module, primes are below 2^31, so that the sum of four products of
//! residues fits in one machine word. Polynomials are computed by `polycore`, modulo primes of 61
//! bits.

use crate::Rational;
use crate::stop::checkpoint;
use num_bigint::BigInt;
use num_integer::Integer;
use num_rational::{BigRational, Ratio};
use num_traits::ToPrimitive;

/// A prime below 2^31, with its constant for Barrett reduction.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Prime {
    p: u64,
    inverse: u64,
}

/// The six largest primes below 2^31.
pub const PRIMES: [Prime; 6] = [
    Prime::unchecked(2_147_483_647),
    Prime::unchecked(2_147_483_629),
    Prime::unchecked(2_147_483_587),
    Prime::unchecked(2_147_483_579),
    Prime::unchecked(2_147_483_563),
    Prime::unchecked(2_147_483_549),
];

impl Prime {
    const fn unchecked(p: u64) -> Self {
        Prime { p, inverse: u64::MAX / p }
    }

    /// Checks that `p` is an odd prime below 2^31. Returns `None` if it is not.
    pub fn new(p: u64) -> Option<Self> {
        let odd = p > 2 && p < 1 << 31 && polycore::modp::is_prime(p);
        odd.then_some(Self::unchecked(p))
    }

    /// The prime as an integer.
    pub fn get(self) -> u64 {
        self.p
    }

    /// The residue of `x`.
    #[inline]
    pub fn reduce(self, x: u64) -> u64 {
        let quotient = ((u128::from(x) * u128::from(self.inverse)) >> 64) as u64;
        let rest = x - quotient * self.p;
        if rest >= self.p { rest - self.p } else { rest }
    }

    /// The product of two residues.
    #[inline]
    pub fn mul(self, a: u64, b: u64) -> u64 {
        self.reduce(a * b)
    }

    /// The sum `a_i b_i` of the products of residues.
    pub fn dot(self, a: &[u64], b: &[u64]) -> u64 {
        // the sum of four products below 2^62 fits in a machine word
        let sum = |(a, b): (&[u64], &[u64])| {
            let products = a.iter().zip(b).map(|(a, b)| short(*a, *b));
            self.reduce(products.sum())
        };
        self.reduce(a.chunks(4).zip(b.chunks(4)).map(sum).sum())
    }

    /// The sum of two residues.
    #[inline]
    pub fn add(self, a: u64, b: u64) -> u64 {
        let sum = a + b;
        if sum >= self.p { sum - self.p } else { sum }
    }

    /// The residue `-a`.
    #[inline]
    pub fn neg(self, a: u64) -> u64 {
        if a == 0 { 0 } else { self.p - a }
    }

    /// The inverse of a residue; `None` for zero.
    pub fn inv(self, a: u64) -> Option<u64> {
        polycore::modp::try_inv(a, self.p)
    }

    /// The residue of an integer.
    pub fn integer(self, a: i64) -> u64 {
        a.rem_euclid(self.p as i64) as u64
    }

    /// The residue of a rational; `None` if the prime divides its denominator.
    pub fn rational(self, a: &Rational) -> Option<u64> {
        if let Ok(words) = Ratio::<i64>::try_from(a) {
            let numerator = self.integer(*words.numer());
            return match *words.denom() {
                1 => Some(numerator),
                denominator => Some(self.mul(numerator, self.inv(self.integer(denominator))?)),
            };
        }
        let (big, p) = (BigRational::from(a), BigInt::from(self.p));
        let residue = |n: &BigInt| n.mod_floor(&p).to_u64();
        Some(self.mul(residue(big.numer())?, self.inv(residue(big.denom())?)?))
    }
}

/// A dense matrix of residues.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ResidueMatrix {
    prime: Prime,
    columns: usize,
    rows: Vec<Vec<u64>>,
}

impl ResidueMatrix {
    /// The matrix with these rows of residues. Each row must have `columns` entries.
    pub fn new(prime: Prime, columns: usize, rows: Vec<Vec<u64>>) -> Self {
        debug_assert!(rows.iter().all(|row| row.len() == columns));
        ResidueMatrix { prime, columns, rows }
    }

    /// The prime.
    pub fn prime(&self) -> Prime {
        self.prime
    }

    /// The rows.
    pub fn rows(&self) -> &[Vec<u64>] {
        &self.rows
    }

    /// The number of columns.
    pub fn columns(&self) -> usize {
        self.columns
    }

    /// Transforms the matrix to reduced row echelon form, and removes zero rows. Returns the pivot
    /// columns.
    ///
    /// Rows are processed one by one. The latest rows form a block, whose rows are reduced by each
    /// other. When the block is full, the earlier rows are reduced by its pivots, with many
    /// products for each modular reduction.
    pub fn reduce(&mut self) -> Vec<usize> {
        let p = self.prime;
        let (mut done, mut block) = (Reduced::default(), Reduced::default());
        for mut row in std::mem::take(&mut self.rows) {
            if done.rows.len() + block.rows.len() == self.columns {
                break;
            }
            done.clear(p, &mut row);
            block.clear(p, &mut row);
            let Some(pivot) = row.iter().position(|v| *v != 0) else { continue };
            let unit = p.inv(row[pivot]).unwrap_or(1);
            row[pivot..].iter_mut().for_each(|v| *v = p.mul(*v, unit));
            for other in &mut block.rows {
                let factor = p.neg(other[pivot]);
                if factor != 0 {
                    let pairs = other[pivot..].iter_mut().zip(&row[pivot..]);
                    pairs.for_each(|(v, &w)| *v = p.reduce(*v + factor * w));
                }
            }
            block.rows.push(row);
            block.pivots.push(pivot);
            if block.rows.len() == BLOCK {
                done.append(p, &mut block);
            }
        }
        done.append(p, &mut block);
        let mut order: Vec<(usize, Vec<u64>)> = done.pivots.into_iter().zip(done.rows).collect();
        order.sort_unstable_by_key(|(pivot, _)| *pivot);
        let (pivots, rows) = order.into_iter().unzip();
        self.rows = rows;
        pivots
    }

    /// The rank.
    pub fn rank(mut self) -> usize {
        self.reduce().len()
    }

    /// A basis of the vectors `x` with `A x = 0`. It has one vector for each column without a
    /// pivot.
    pub fn kernel(mut self) -> Vec<Vec<u64>> {
        let pivots = self.reduce();
        let free = (0..self.columns).filter(|j| pivots.binary_search(j).is_err());
        let vector = |j: usize| {
            let mut x = vec![0; self.columns];
            x[j] = 1;
            for (row, &pivot) in self.rows.iter().zip(&pivots) {
                x[pivot] = self.prime.neg(row[j]);
            }
            x
        };
        free.map(vector).collect()
    }

    /// The matrix in sparse form, which is faster for many products with vectors.
    pub fn sparse(&self) -> SparseResidues {
        let row = |row: &Vec<u64>| {
            let entries = row.iter().enumerate().filter(|(_, value)| **value != 0);
            entries.map(|(at, value)| (at as u32, *value as u32)).collect()
        };
        SparseResidues { prime: self.prime, rows: self.rows.iter().map(row).collect() }
    }

    /// The vector `A x`.
    pub fn apply(&self, x: &[u64]) -> Vec<u64> {
        checkpoint();
        self.rows.iter().map(|row| self.prime.dot(row, x)).collect()
    }
}

/// A sparse matrix of residues.
#[derive(Clone, Debug)]
pub struct SparseResidues {
    prime: Prime,
    rows: Vec<Vec<(u32, u32)>>,
}

impl SparseResidues {
    /// The vector `A x`.
    pub fn apply(&self, x: &[u64]) -> Vec<u64> {
        checkpoint();
        let p = self.prime;
        let entry = |row: &Vec<(u32, u32)>| {
            // the sum of three products of residues and one residue is below 2^64
            row.chunks(3).fold(0, |sum, pair| {
                let terms = pair.iter().map(|(at, value)| u64::from(*value) * x[*at as usize]);
                p.reduce(sum + terms.sum::<u64>())
            })
        };
        self.rows.iter().map(entry).collect()
    }
}

/// The number of rows in a block. When the block is full, its pivots are eliminated from all other
/// rows.
const BLOCK: usize = 32;

/// Rows in reduced echelon form, in any order, together with their pivots.
#[derive(Default)]
struct Reduced {
    pivots: Vec<usize>,
    rows: Vec<Vec<u64>>,
}

impl Reduced {
    /// Reduces a row, so that it is zero at all pivots. The factors are the entries of the row at
    /// the pivots, because every row is zero at the pivots of the other rows.
    fn clear(&self, p: Prime, row: &mut [u64]) {
        checkpoint();
        let factors = self.pivots.iter().map(|&pivot| p.neg(row[pivot]));
        let factors: Vec<(usize, u64)> =
            factors.enumerate().filter(|(_, factor)| *factor != 0).collect();
        // the sum of three products below 2^62 and one residue fits in a machine word
        for group in factors.chunks(3) {
            let from = group.iter().map(|&(at, _)| self.pivots[at]).min().unwrap_or(0);
            let of = |at: usize| (&self.rows[group[at].0][from..], group[at].1);
            let row = &mut row[from..];
            match group.len() {
                3 => {
                    let ((a, f), (b, g), (c, h)) = (of(0), of(1), of(2));
                    for (((v, a), b), c) in row.iter_mut().zip(a).zip(b).zip(c) {
                        *v = p.reduce(*v + short(*a, f) + short(*b, g) + short(*c, h));
                    }
                }
                _ => {
                    for at in 0..group.len() {
                        let (a, f) = of(at);
                        row.iter_mut().zip(a).for_each(|(v, a)| *v = p.reduce(*v + short(*a, f)));
                    }
                }
            }
        }
    }

    /// Appends rows that are zero at the pivots of the existing rows.
    fn append(&mut self, p: Prime, block: &mut Reduced) {
        self.rows.iter_mut().for_each(|row| block.clear(p, row));
        self.rows.append(&mut block.rows);
        self.pivots.append(&mut block.pivots);
    }
}

/// The product of two numbers below 2^32, which compiles to one vector instruction.
#[inline]
fn short(a: u64, b: u64) -> u64 {
    u64::from(a as u32) * u64::from(b as u32)
}

/// Rational reconstruction, which finds rational numbers from their residues modulo several primes.
/// It succeeds if the numerators and the denominators are below the square root of half the product
/// of the primes.
#[derive(Clone, Debug)]
pub struct RationalReconstruction(polycore::crt::MixedRadixAccumulator);

impl RationalReconstruction {
    /// Begins a reconstruction of `length` numbers, of which no residues are known yet.
    pub fn new(length: usize) -> Self {
        RationalReconstruction(polycore::crt::MixedRadixAccumulator::new(length))
    }

    /// Adds the residues modulo another prime. Returns `false` if the number of residues is wrong.
    pub fn add(&mut self, prime: Prime, residues: &[u64]) -> bool {
        self.0.add(prime.get(), residues).is_ok()
    }

    /// The reconstructed numbers; `None` if there are too few primes.
    pub fn rationals(&self) -> Option<Vec<Rational>> {
        Some(self.0.reconstruct()?.into_iter().map(Rational::from).collect())
    }

    /// The integers of least magnitude that have these residues. They are the reconstructed numbers
    /// if these are integers below half the product of the primes.
    pub fn integers(&self) -> Vec<Rational> {
        let modulus = self.0.modulus();
        let least = |x: &BigInt| polycore::crt::symmetric(x, &modulus);
        self.0.residues().iter().map(|x| BigRational::from_integer(least(x)).into()).collect()
    }
}

/// The primes below 2^31, in descending order.
pub fn primes() -> impl Iterator<Item = Prime> {
    (1..1u64 << 31).rev().step_by(2).filter_map(Prime::new)
}
