//! Kernels of matrices, lifted from residues modulo primes and verified.
//!
//! Modulo a prime, the kernel is at least as large as over the rationals. If all vectors of its
//! echelon basis lift to rational vectors that the matrix annihilates, they are a basis of the
//! kernel.

use super::subspace::denominator;
use super::{GroundField, Subspace};
use affinor_tensors::linear::Row;
use affinor_tensors::linear::modular::{Prime, RationalReconstruction, ResidueMatrix, primes};
use affinor_tensors::stop::checkpoint;
use affinor_tensors::{Rational, Ring};
use num_traits::Zero;
use polycore::Lead;
use polycore::modp_echelon::Echelon;

/// The largest number of primes that are tried.
const PRIMES: usize = 2000;
/// The number of unknowns above which sparse equations are eliminated in sparse form.
const MANY: usize = 150;
const SPARSE: usize = 12;

impl<S: GroundField> Subspace<S> {
    /// The kernel as in [`kernel`](Self::kernel), for rows in a dense basis, whose rational entries
    /// are long.
    pub(super) fn kernel_of_long(ambient: usize, rows: Vec<Row<S>>) -> Self {
        Self::lifted_kernel(ambient, &rows).unwrap_or_else(|| Self::kernel(ambient, rows))
    }

    /// The vectors `x` with `v_i x_i = 0` for all given rows `v`, as in [`kernel`](Self::kernel).
    /// This function is faster if the numbers become long. Returns `None` if a component is
    /// irrational, or if the lifting fails for all primes that are tried.
    pub(super) fn lifted_kernel(ambient: usize, rows: &[Row<S>]) -> Option<Self> {
        let rational = |row: &Row<S>| {
            row.iter().map(|(at, value)| Some((*at, value.rational()?))).collect::<Option<_>>()
        };
        let rows: Vec<Row<Rational>> = rows.iter().map(rational).collect::<Option<_>>()?;
        // the positions of the nonzero entries of each vector, and the residues of the entries
        let mut found: Option<(Vec<Vec<usize>>, RationalReconstruction)> = None;
        let mut taken = 0;
        for prime in primes().take(PRIMES) {
            let Some(kernel) = kernel_modulo(prime, ambient, &rows) else { continue };
            if kernel.is_empty() {
                return Some(Self::zero(ambient));
            }
            let of = |row: &SparseRow| row.iter().map(|(at, _)| *at).collect::<Vec<usize>>();
            let places: Vec<Vec<usize>> = kernel.iter().map(of).collect();
            let entries = |places: &[Vec<usize>]| places.iter().map(Vec::len).sum::<usize>();
            // prefers the better prime: a prime that divides a minor yields more vectors or other
            // pivots, and a prime that divides an entry yields fewer entries
            let size = |places: &[Vec<usize>]| (places.len(), usize::MAX - entries(places));
            let (known, mut images) = match found.take() {
                Some((known, images)) if known == places => (known, images),
                Some((known, images)) if size(&known) < size(&places) => {
                    found = Some((known, images));
                    continue;
                }
                _ => {
                    taken = 0;
                    let length = entries(&places);
                    (places, RationalReconstruction::new(length))
                }
            };
            let residues: Vec<u64> = kernel.iter().flatten().map(|(_, value)| *value).collect();
            images.add(prime, &residues);
            taken += 1;
            // reconstructs only after some primes, because a reconstruction takes longer than
            // another prime
            if taken % (1 + taken / 8) == 0
                && let Some(numbers) = images.rationals()
            {
                let mut numbers = numbers.into_iter();
                let vectors: Vec<Row<Rational>> = known
                    .iter()
                    .map(|places| places.iter().copied().zip(numbers.by_ref()).collect())
                    .collect();
                if vectors.iter().all(|vector| sent_to_zero(ambient, &rows, vector)) {
                    let entries = |vector: Row<Rational>| {
                        let entries = vector.into_iter().filter(|(_, v)| !v.vanishes());
                        entries.map(|(at, v)| (at, S::from_rational(v))).collect()
                    };
                    return Some(Self::span(ambient, vectors.into_iter().map(entries)));
                }
            }
            found = Some((known, images));
        }
        None
    }
}

type SparseRow = Vec<(usize, u64)>;

/// The kernel modulo a prime, in reduced row echelon form. Returns `None` if the prime divides a
/// denominator.
fn kernel_modulo(prime: Prime, ambient: usize, rows: &[Row<Rational>]) -> Option<Vec<SparseRow>> {
    if ambient > MANY && rows.iter().map(Vec::len).sum::<usize>() < SPARSE * rows.len() {
        let mut echelon = Echelon::new(Lead::High, prime.get());
        for row in rows {
            checkpoint();
            let residue = |(at, value): &(usize, Rational)| Some((*at, prime.rational(value)?));
            let row: SparseRow = row.iter().map(residue).collect::<Option<_>>()?;
            echelon.insert(&row.into_iter().filter(|(_, v)| *v != 0).collect::<Vec<_>>());
        }
        return Some(echelon.nullspace(ambient));
    }
    // reverses the columns, so that the last component of a kernel vector is its pivot
    let residues = rows.iter().map(|row| {
        let mut dense = vec![0; ambient];
        for (at, value) in row {
            dense[ambient - 1 - at] = prime.rational(value)?;
        }
        Some(dense)
    });
    let kernel = ResidueMatrix::new(prime, ambient, residues.collect::<Option<_>>()?).kernel();
    let sparse = |row: &Vec<u64>| {
        let entries = row.iter().rev().copied().enumerate();
        entries.filter(|(_, value)| *value != 0).collect()
    };
    Some(kernel.iter().rev().map(sparse).collect())
}

/// Whether all rows map the vector to zero.
fn sent_to_zero(ambient: usize, rows: &[Row<Rational>], vector: &Row<Rational>) -> bool {
    let denominator = denominator(vector.iter().map(|(_, value)| value));
    let mut integers = vec![Rational::from(0); ambient];
    for (at, value) in vector {
        integers[*at] = value.clone() * &denominator;
    }
    rows.iter().all(|row| {
        checkpoint();
        let terms = row.iter().filter(|(at, _)| !integers[*at].is_zero());
        let terms = terms.map(|(at, value)| value.clone() * &integers[*at]);
        terms.fold(Rational::from(0), |sum, term| sum + &term).is_zero()
    })
}
