//! Irreducible factors of polynomials over the rationals.

use affinor_tensors::stop::detached;
use num_rational::BigRational;
use polycore::Uni;

/// Above this degree, a factorization may need more than a few milliseconds.
const LONG: usize = 16;

/// The irreducible factors of a polynomial with their multiplicities.
pub(crate) fn irreducible_factors(polynomial: &Uni<BigRational>) -> Vec<(Uni<BigRational>, u32)> {
    if polynomial.deg() <= LONG {
        return polyfactor::factor(polynomial);
    }
    let polynomial = polynomial.clone();
    detached(move || polyfactor::factor(&polynomial))
}
