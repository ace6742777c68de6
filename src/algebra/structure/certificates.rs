//! Dimensions of solution spaces, proved over the rationals.
//!
//! Modulo a prime, the solution space of a linear system with integer coefficients is at least as
//! large as over the rationals. The dimensions are equal if a basis modulo primes lifts to rational
//! vectors that satisfy the system.

use super::reduction::ModularAlgebra;
use super::{GroundField, StructureTheory};
use affinor_tensors::Rational;
use affinor_tensors::linear::Row;
use affinor_tensors::linear::modular::{RationalReconstruction, primes};
use num_traits::Zero;

/// The maximum number of primes for the reconstruction of long rational numbers: for few unknowns,
/// and for many unknowns.
const PRIMES: [usize; 2] = [16, 4];
/// The number of unknowns from which the second entry of `PRIMES` applies.
const MANY: usize = 150;

/// A dimension, and whether it is proved.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Certified {
    /// The dimension.
    pub dimension: usize,
    /// Whether the dimension is proved over the rationals. Otherwise, the dimension follows from a
    /// rank modulo at least two primes.
    pub proved: bool,
}

impl Certified {
    /// A dimension that a theorem proves.
    pub(super) fn theorem(dimension: usize) -> Self {
        Certified { dimension, proved: true }
    }
}

impl<S: GroundField> StructureTheory<S> {
    /// The dimension of the solution space of linear equations. The function `kernel` computes a
    /// basis in reduced echelon form modulo a prime, or returns `None` for an unsuitable prime; `holds` checks whether a rational vector
    /// satisfies the equations.
    pub(super) fn counted(
        &self,
        length: usize,
        kernel: impl Fn(&ModularAlgebra) -> Option<Vec<Vec<u64>>>,
        holds: impl Fn(&StructureTheory<Rational>, &Row<Rational>) -> bool,
    ) -> Certified {
        let rational = self.over_the_rationals();
        let most = match rational {
            Some(_) => PRIMES[usize::from(length > MANY)],
            None => 2,
        };
        let mut found: Option<(usize, RationalReconstruction)> = None;
        let reductions = primes().filter_map(|prime| {
            let reduction = ModularAlgebra::new(self, prime)?;
            Some((kernel(&reduction)?, reduction.prime()))
        });
        for (vectors, prime) in reductions.take(most) {
            let dimension = vectors.len();
            if dimension == 0 {
                return Certified::theorem(0);
            }
            let (known, mut images) = match found.take() {
                Some((known, images)) if known <= dimension => (known, images),
                // starts again with this prime: the earlier primes divide a minor, so their
                // dimension was too large
                _ => (dimension, RationalReconstruction::new(dimension * length)),
            };
            if known == dimension {
                images.add(prime, &vectors.concat());
                let lifted = rational.as_ref().zip(images.rationals());
                let multiplied_out = |(structure, numbers): (_, Vec<Rational>)| {
                    numbers.chunks(length).all(|vector| holds(structure, &sparse(vector)))
                };
                if lifted.is_some_and(multiplied_out) {
                    return Certified::theorem(dimension);
                }
            }
            found = Some((known, images));
        }
        Certified { dimension: found.map_or(length, |(known, _)| known), proved: false }
    }
}

fn sparse(vector: &[Rational]) -> Row<Rational> {
    let nonzero = vector.iter().enumerate().filter(|(_, value)| !value.is_zero());
    nonzero.map(|(at, value)| (at, value.clone())).collect()
}
