//! The isospectral midpoint method.

use super::Integrator;
use crate::Error;
use crate::mechanics::systems::isospectral::{Isospectral, MatrixEntry, MatrixState, largest};
use nalgebra::ComplexField;

/// The isospectral midpoint method. With `b = h B(X)/2`,
///
/// ```text
/// L_n = (1 - b) X (1 + b),   L_(n+1) = (1 + b) X (1 - b) = L_n + h [B(X), X]
/// ```
///
/// The method is symmetric and of order 2. `L_(n+1)` is similar to `L_n` by the Cayley transform of
/// `b`, so the spectrum is conserved. If `B` is in so(n) or su(n), the matrices remain symmetric,
/// antisymmetric or antihermitian. For a Hamiltonian flow, the step is a Poisson map, and the error
/// of the energy is bounded. `X` is found by fixed-point iteration; each iteration needs one
/// evaluation of `B` and two matrix products. The iteration converges within
/// [`IsospectralMidpoint::ITERATIONS`] if `h` times the norm of `B` is below about 1.
///
/// K. Modin and M. Viviani, *Found. Comput. Math.* 20 (2020) 889-921 and *J. Fluid Mech.* 884
/// (2020) A22.
///
/// ```
/// use affinor::mechanics::{Integrator, IsospectralMidpoint, Toda};
/// let mut state = Toda.state(0.0, Toda::lattice(&[0.0, 0.3, 0.1], &[1.0, 0.5, -1.0])?)?;
/// let before = Toda.spectrum(&state.matrix);
/// for _ in 0..1000 {
///     IsospectralMidpoint.step(&Toda, &mut state, 0.1)?;
/// }
/// let after = Toda.spectrum(&state.matrix);
/// assert!(before.iter().zip(&after).all(|(x, y)| (x - y).abs() < 1e-13));
/// # Ok::<(), affinor::Error>(())
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct IsospectralMidpoint;

/// Rounding errors may cause this relative change in an iteration.
const NOISE: f64 = 1e-13;

impl IsospectralMidpoint {
    /// The largest number of iterations of a step.
    pub const ITERATIONS: usize = 100;

    /// The order of convergence.
    pub fn order(&self) -> u32 {
        2
    }
}

impl<S: Isospectral> Integrator<S> for IsospectralMidpoint {
    fn step(&self, system: &S, state: &mut MatrixState<S::Entry>, h: f64) -> Result<(), Error> {
        let stopped = |reason: String| Err(Error::Integration { t: state.time, reason });
        // projects onto the symmetric part, because otherwise rounding errors would break the
        // symmetry of L and grow
        let kept = |matrix| match system.symmetry() {
            Some(symmetry) => symmetry.part(&matrix),
            None => matrix,
        };
        let start = &state.matrix;
        let size = largest(start);
        let mut middle = start.clone();
        let mut last = f64::INFINITY;
        for _ in 0..Self::ITERATIONS {
            let b = system.generator(&middle) * S::Entry::from_real(0.5 * h);
            let product = S::Entry::product(&b, &middle);
            let left = &middle - &product;
            let change = kept(start - &left - S::Entry::product(&left, &b));
            let off = largest(&change);
            if !off.is_finite() {
                return stopped("a value is not finite".into());
            }
            // accepts the iterate if the change no longer decreases, because it then consists of
            // rounding errors
            if off == 0.0 || (off >= last && off <= NOISE * size) {
                let bracket = kept(product - S::Entry::product(&middle, &b));
                state.matrix += bracket * S::Entry::from_real(2.0);
                state.time += h;
                return Ok(());
            }
            middle += change;
            last = off;
        }
        let limit = Self::ITERATIONS;
        stopped(format!("the equations of a step of {h} have no solution after {limit} iterations"))
    }
}
