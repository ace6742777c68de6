//! Lie-Poisson systems: any Hamiltonian on the dual of an algebra, with the reconstruction of the
//! element on the group.

use super::System;
use super::cotangent::{CotangentSystem, State};
use crate::group::TranslationSplit;

/// The system of a Hamiltonian `E(H)`, which is a function of the body momentum:
///
/// ```text
/// H' = ad*_Omega H,   Omega = dE/dH,   g' = g Omega
/// ```
///
/// The spatial momentum `h`, with `H = Ad*_g h`, and all Casimir functions are conserved up to
/// rounding errors. The element solves `g' = g Omega`. With the kinetic energy `E = H . J^-1 H/2`,
/// the system is [`EulerPoincare`](super::EulerPoincare). The heavy top is an example on se(3), in
/// which the second half of the momentum is the vertical direction in body components. J. E.
/// Marsden and T. S. Ratiu, *Introduction to Mechanics and Symmetry* (1999), 13.
///
/// ```
/// use affinor::mechanics::{Adaptive, LiePoissonSystem};
/// use affinor::group::{LieGroup, Se3};
/// use nalgebra::Vector6;
/// // E = P . J^-1 P/2 + G_3: a top of moments 1, 1, 1/2 in gravity
/// let gradient = |h: &Vector6<f64>| Vector6::new(h[0], h[1], 2.0 * h[2], 0.0, 0.0, 1.0);
/// let top = LiePoissonSystem { group: Se3, gradient };
/// let start = top.state(0.0, Se3.identity(), &Vector6::new(0.1, 0.0, 2.0, 0.6, 0.0, 0.8));
/// let end = Adaptive::new(1e-12).states(&top, &start, &[5.0])?.remove(0);
/// // the length of the vertical, and the momentum about the axis of symmetry
/// let h = top.momentum(&end);
/// assert!((h.fixed_rows::<3>(3).norm() - 1.0).abs() < 1e-14 && (h[2] - 2.0).abs() < 1e-11);
/// # Ok::<(), affinor::Error>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct LiePoissonSystem<G, F> {
    /// The group.
    pub group: G,
    /// The gradient `dE/dH`, which is a vector, as a function of the covector `H`.
    pub gradient: F,
}

impl<G: TranslationSplit, F: Fn(&G::Vector) -> G::Vector> LiePoissonSystem<G, F> {
    /// The state with this element, and with the momentum `H` in body components.
    pub fn state(&self, time: f64, element: G::Element, momentum: &G::Vector) -> State<G> {
        State::with_momentum(&self.group, time, element, momentum)
    }

    /// The momentum `H` in body components.
    pub fn momentum(&self, state: &State<G>) -> G::Vector {
        state.momentum(&self.group)
    }

    /// The velocity `Omega = dE/dH` in body components.
    pub fn velocity(&self, state: &State<G>) -> G::Vector {
        (self.gradient)(&self.momentum(state))
    }
}

impl<G: TranslationSplit, F: Fn(&G::Vector) -> G::Vector> System for LiePoissonSystem<G, F> {
    type State = State<G>;

    fn time(&self, state: &State<G>) -> f64 {
        state.time
    }
}

impl<G: TranslationSplit, F: Fn(&G::Vector) -> G::Vector> CotangentSystem
    for LiePoissonSystem<G, F>
{
    type Group = G;

    fn group(&self) -> &G {
        &self.group
    }

    fn velocity_of(&self, momentum: &G::Vector) -> G::Vector {
        (self.gradient)(momentum)
    }

    fn is_free(&self) -> bool {
        true
    }
}
