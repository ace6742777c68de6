//! Kernels of dense matrices, lifted from residues modulo primes and multiplied out.
//!
//! Modulo a prime the kernel has at least the dimension that it has over the rationals. As many rational vectors in echelon form that the
//! matrix sends to zero are a basis of the kernel.

use super::subspace::denominator;
use super::{GroundField, Subspace};
use affinor_tensors::linear::Row;
use affinor_tensors::linear::modular::{Prime, RationalReconstruction, ResidueMatrix, primes};
use affinor_tensors::{Rational, Ring};
use num_traits::Zero;

/// How many primes are tried.
const PRIMES: usize = 2000;

impl<S: GroundField> Subspace<S> {
    /// [`kernel`](Self::kernel) of rows of dense bases, whose entries are long where they are rational.
    pub(super) fn kernel_of_long(ambient: usize, rows: Vec<Row<S>>) -> Self {
        Self::lifted_kernel(ambient, &rows).unwrap_or_else(|| Self::kernel(ambient, rows))
    }

    /// The vectors `x` with `v_i x_i = 0` for all given rows `v`, as [`kernel`](Self::kernel), faster where numbers grow long; `None` if a
    /// component is not rational, or after a number of primes.
    pub(super) fn lifted_kernel(ambient: usize, rows: &[Row<S>]) -> Option<Self> {
        let rational = |row: &Row<S>| {
            row.iter().map(|(at, value)| Some((*at, value.rational()?))).collect::<Option<_>>()
        };
        let rows: Vec<Row<Rational>> = rows.iter().map(rational).collect::<Option<_>>()?;
        let mut found: Option<(Vec<usize>, RationalReconstruction)> = None;
        let mut taken = 0;
        for prime in primes().take(PRIMES) {
            let Some(kernel) = kernel_modulo(prime, ambient, &rows) else { continue };
            let pivots: Vec<usize> =
                kernel.iter().filter_map(|row| row.iter().position(|v| *v != 0)).collect();
            if pivots.is_empty() {
                return Some(Self::zero(ambient));
            }
            let (known, mut images) = match found.take() {
                Some((known, images)) if known.len() < pivots.len() => {
                    found = Some((known, images));
                    continue;
                }
                Some((known, images)) if known == pivots => (known, images),
                // the primes before divide a minor
                _ => {
                    taken = 0;
                    (pivots.clone(), RationalReconstruction::new(pivots.len() * ambient))
                }
            };
            images.add(prime, &kernel.concat());
            taken += 1;
            // a reconstruction takes longer than a prime
            if taken % (1 + taken / 8) == 0
                && let Some(numbers) = images.rationals()
            {
                let vectors: Vec<&[Rational]> = numbers.chunks(ambient).collect();
                if vectors.iter().all(|vector| sent_to_zero(&rows, vector)) {
                    let entries = |vector: &[Rational]| {
                        let entries = vector.iter().cloned().enumerate();
                        entries
                            .filter(|(_, v)| !v.vanishes())
                            .map(|(at, v)| (at, S::from_rational(v)))
                            .collect()
                    };
                    return Some(Self::span(ambient, vectors.into_iter().map(entries)));
                }
            }
            found = Some((known, images));
        }
        None
    }
}

/// The kernel modulo a prime in reduced row echelon form; `None` if the prime divides a denominator.
fn kernel_modulo(prime: Prime, ambient: usize, rows: &[Row<Rational>]) -> Option<Vec<Vec<u64>>> {
    // in the opposite order of the columns the last component of a kernel vector is its pivot
    let residues = rows.iter().map(|row| {
        let mut dense = vec![0; ambient];
        for (at, value) in row {
            dense[ambient - 1 - at] = prime.rational(value)?;
        }
        Some(dense)
    });
    let mut kernel = ResidueMatrix::new(prime, ambient, residues.collect::<Option<_>>()?).kernel();
    kernel.iter_mut().for_each(|row| row.reverse());
    kernel.reverse();
    Some(kernel)
}

/// Whether all products with a vector are zero.
fn sent_to_zero(rows: &[Row<Rational>], vector: &[Rational]) -> bool {
    let denominator = denominator(vector.iter());
    let integers: Vec<Rational> = vector.iter().map(|value| value.clone() * &denominator).collect();
    rows.iter().all(|row| {
        let terms = row.iter().map(|(at, value)| value.clone() * &integers[*at]);
        terms.fold(Rational::from(0), |sum, term| sum + &term).is_zero()
    })
}
