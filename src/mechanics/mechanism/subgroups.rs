//! Mobility by subgroups of SE(3) (J. M. Herve, *Mech. Mach. Theory* 13 (1978) 437-450).

use super::joint::rigid_motions;
use super::twist::{Twist, sparse};
use crate::algebra::structure::Subspace;
use crate::{Error, Field, Notation, Scalar};

/// The smallest subalgebra of se(3) that contains twists.
///
/// # Errors
/// Those of the catalogue.
pub fn generated<'t, S: Field + Scalar + Notation>(
    twists: impl IntoIterator<Item = &'t Twist<S>>,
) -> Result<Subspace<S>, Error> {
    let algebra = rigid_motions::<S>()?;
    let mut span = Subspace::span(6, twists.into_iter().map(|twist| sparse(twist)));
    loop {
        let (before, basis) = (span.dimension(), span.dense());
        for (i, first) in basis.iter().enumerate() {
            for second in &basis[i + 1..] {
                span.add(sparse(&algebra.bracket(first, second)?));
            }
        }
        if span.dimension() == before {
            return Ok(span);
        }
    }
}

/// A division of a loop into two chains, each of which reaches all of a subgroup.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Division {
    /// The dimensions of the subgroups of both chains.
    pub dimensions: [usize; 2],
    /// The dimension of the intersection of the subgroups.
    pub common: usize,
    /// The mobility of the loop.
    pub mobility: usize,
}

/// A division of a loop into two chains whose twists span the subalgebras that they generate. The
/// closed positions are then a smooth manifold. The manifold has the dimension of the intersection,
/// plus the redundant freedoms of both chains. Returns `None` for a loop that does not divide in
/// this way.
///
/// # Errors
/// Those of the catalogue.
pub fn division<S: Field + Scalar + Notation>(
    chain: &[Twist<S>],
) -> Result<Option<Division>, Error> {
    let n = chain.len();
    let filled = |twists: &[Twist<S>]| -> Result<Option<Subspace<S>>, Error> {
        let algebra = generated(twists)?;
        let rank = Subspace::span(6, twists.iter().map(|twist| sparse(twist))).dimension();
        Ok((rank == algebra.dimension()).then_some(algebra))
    };
    for length in (0..=n / 2).rev() {
        for start in 0..n {
            let mut turned = chain.to_vec();
            turned.rotate_left(start);
            let (first, second) = turned.split_at(length);
            let (Some(a), Some(b)) = (filled(first)?, filled(second)?) else { continue };
            let dimensions = [a.dimension(), b.dimension()];
            let common = dimensions[0] + dimensions[1] - a.sum(&b).dimension();
            let mobility = common + n - dimensions[0] - dimensions[1];
            return Ok(Some(Division { dimensions, common, mobility }));
        }
    }
    Ok(None)
}
