//! Splitting methods for the free body: rotations about its principal axes.

use super::composed::fractions;
use super::{Integrator, expect_finite};
use crate::Error;
use crate::group::So3;
use crate::mechanics::State;
use crate::mechanics::integrators::principal::Principal;
use crate::mechanics::systems::euler_poincare::{EulerPoincare, Torque};
use crate::mechanics::{BodyState, Inertia};
use nalgebra::{Quaternion, UnitQuaternion};

/// A composition of rotations about the principal axes.
///
/// `X` rotates about the axes 1, 2, 3 and `X*` about 3, 2, 1. A step is `X X* X X* ..`, each factor for a fraction of `h`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Composition {
    /// Order 2, five rotations: both halves of the step.
    Strang,
    /// Order 4, 21 rotations: five steps of order 2, the middle one backwards. M. Suzuki, *Phys. Lett. A* 146 (1990)
    /// 319-323.
    Suzuki,
}

impl Composition {
    /// The order of convergence.
    pub fn order(self) -> u32 {
        if self == Composition::Strang { 2 } else { 4 }
    }

    /// The fractions of `X`, `X*`, `X`, ...
    fn shares(self) -> Vec<f64> {
        match self {
            Composition::Strang => vec![0.5; 2],
            Composition::Suzuki => fractions().iter().flat_map(|w| [0.5 * w; 2]).collect(),
        }
    }
}

/// Steps of the free body by exact rotations: the Hamiltonian `H_i^2/(2 J_i)` rotates the body about its axis `i` at the rate
/// `H_i/J_i`.
///
/// They are explicit, conserve the spatial momentum to the last bit, and are symplectic, so that the error of the energy is
/// bounded. R. I. McLachlan, *Phys. Rev. Lett.* 71 (1993) 3043-3046; F. Fasso, *J. Comput.
/// Phys.* 189 (2003) 527-538.
#[derive(Clone, Debug, PartialEq)]
pub struct Splitting {
    body: Principal,
    composition: Composition,
    /// Axes and fractions of the step; successive rotations about one axis are merged.
    turns: Vec<(usize, f64)>,
}

impl Splitting {
    /// Steps of a body.
    pub fn new(inertia: &Inertia, composition: Composition) -> Self {
        let mut turns: Vec<(usize, f64)> = vec![];
        for (at, share) in composition.shares().into_iter().enumerate() {
            for axis in if at % 2 == 0 { [0, 1, 2] } else { [2, 1, 0] } {
                match turns.last_mut() {
                    Some((last, sum)) if *last == axis => *sum += share,
                    _ => turns.push((axis, share)),
                }
            }
        }
        Splitting { body: Principal::new(inertia), composition, turns }
    }

    /// The order of convergence.
    pub fn order(&self) -> u32 {
        self.composition.order()
    }
}

impl<M: Torque<So3>> Integrator<EulerPoincare<So3, M>> for Splitting {
    /// # Errors
    /// Also [`Error::Invalid`] for a system of another body, [`Error::Integration`] for one with a torque.
    fn step(
        &self,
        system: &EulerPoincare<So3, M>,
        state: &mut State<So3>,
        h: f64,
    ) -> Result<(), Error> {
        let BodyState { attitude, mut momentum } = self.body.free_state(system, state)?;
        let moments = self.body.moments();
        let mut turn = Quaternion::identity();
        for &(axis, share) in &self.turns {
            let half = 0.5 * share * h * momentum[axis] / moments[axis];
            let (sin, cos) = half.sin_cos();
            let mut quaternion = Quaternion::new(cos, 0.0, 0.0, 0.0);
            quaternion.coords[axis] = sin;
            turn *= quaternion;
            // the momentum in body components rotates in the opposite sense
            let (j, k) = ((axis + 1) % 3, (axis + 2) % 3);
            let (sin, cos) = (2.0 * sin * cos, 1.0 - 2.0 * sin * sin);
            (momentum[j], momentum[k]) =
                (cos * momentum[j] + sin * momentum[k], cos * momentum[k] - sin * momentum[j]);
        }
        expect_finite(state.time, &turn.coords)?;
        state.element = self.body.attitude(attitude * UnitQuaternion::new_unchecked(turn));
        state.time += h;
        Ok(())
    }
}
