//! The midpoint method that keeps the spectrum.

use super::Integrator;
use crate::Error;
use crate::dynamics::isospectral::{Entry, Isospectral, MatrixState, largest};
use nalgebra::ComplexField;

/// The isospectral midpoint method: with `b = h B(X)/2`,
///
/// ```text
/// L_n = (1 - b) X (1 + b),   L_(n+1) = (1 + b) X (1 - b) = L_n + h [B(X), X]
/// ```
///
/// Symmetric and of order 2. `L_(n+1)` is similar to `L_n` by Cayley's transform of `b`, so the spectrum stays,
/// and with it every quadratic group that `B` is in: for `B` in so(n) or su(n) the flow stays symmetric,
/// antisymmetric or antihermitian. For a Hamiltonian flow it is a Poisson map, and the energy is bounded. `X`
/// comes by fixed-point iteration, a `B` and two products of matrices each, until it stands still: at most
/// [`IsospectralMidpoint::ITERATIONS`], which is for steps with `h` times the norm of `B` below about 1.
///
/// K. Modin and M. Viviani, *Found. Comput. Math.* 20 (2020) 889-921 and *J. Fluid Mech.* 884 (2020) A22.
///
/// ```
/// use affinor::dynamics::{Integrator, IsospectralMidpoint, Toda};
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

/// A change of this size, relatively, may be noise.
const NOISE: f64 = 1e-13;

impl IsospectralMidpoint {
    /// The most iterations of a step.
    pub const ITERATIONS: usize = 100;

    /// The order of the error of a motion.
    pub fn order(&self) -> u32 {
        2
    }
}

impl<S: Isospectral> Integrator<S> for IsospectralMidpoint {
    fn step(&self, system: &S, state: &mut MatrixState<S::Entry>, h: f64) -> Result<(), Error> {
        let stopped = |reason: String| Err(Error::Integration { t: state.time, reason });
        // rounding would leave the symmetry of L, and then grow
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
            // what is left is rounding, and no longer shrinks
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
