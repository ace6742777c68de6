//! Dimensions of solution spaces, proved over the rationals.
//!
//! Modulo a prime the solutions of a linear system with integer coefficients have at least the dimension that they have over
//! the rationals. A basis modulo primes, lifted to rational numbers and multiplied out, shows that they have no more.

use super::reduction::ModularAlgebra;
use super::{GroundField, StructureTheory};
use affinor_tensors::Rational;
use affinor_tensors::linear::Row;
use affinor_tensors::linear::modular::{RationalReconstruction, primes};
use num_traits::Zero;

/// Primes for a basis of long rational numbers, with few and with many unknowns.
const PRIMES: [usize; 2] = [16, 4];
/// From here on the unknowns are many.
const MANY: usize = 150;

/// A dimension, and whether it is proved.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Certified {
    /// The dimension.
    pub dimension: usize,
    /// Whether it is proved over the rationals. Otherwise it is what a rank modulo two primes at least says.
    pub proved: bool,
}

impl Certified {
    /// A dimension that follows from a theorem.
    pub(super) fn theorem(dimension: usize) -> Self {
        Certified { dimension, proved: true }
    }
}

impl<S: GroundField> StructureTheory<S> {
    /// The dimension of the vectors of a length that satisfy equations: `kernel` is a basis in reduced echelon form modulo
    /// a prime, `holds` multiplies a rational vector out.
    pub(super) fn counted(
        &self,
        length: usize,
        kernel: impl Fn(&ModularAlgebra) -> Vec<Vec<u64>>,
        holds: impl Fn(&StructureTheory<Rational>, &Row<Rational>) -> bool,
    ) -> Certified {
        let rational = self.over_the_rationals();
        let most = match rational {
            Some(_) => PRIMES[usize::from(length > MANY)],
            None => 2,
        };
        let mut found: Option<(usize, RationalReconstruction)> = None;
        let reductions = primes().filter_map(|prime| ModularAlgebra::new(self, prime));
        for reduction in reductions.take(most) {
            let vectors = kernel(&reduction);
            let dimension = vectors.len();
            if dimension == 0 {
                return Certified::theorem(0);
            }
            let (known, mut images) = match found.take() {
                Some((known, images)) if known <= dimension => (known, images),
                // the primes before divide a minor
                _ => (dimension, RationalReconstruction::new(dimension * length)),
            };
            if known == dimension {
                images.add(reduction.prime(), &vectors.concat());
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
