//! The method of Crouch and Grossman of order 3.

use super::step_start::{Increment, Rates, StepStart};
use super::{Integrator, expect_finite};
use crate::Error;
use crate::mechanics::systems::cotangent::{CotangentSystem, State, Vector};

/// `c_i`, rows `a_ij` and `b_j`.
const NODES: [f64; 3] = [0.0, 3.0 / 4.0, 17.0 / 24.0];
const STAGES: [[f64; 2]; 3] = [[0.0, 0.0], [3.0 / 4.0, 0.0], [119.0 / 216.0, 17.0 / 108.0]];
const WEIGHTS: [f64; 3] = [13.0 / 51.0, -2.0 / 3.0, 24.0 / 17.0];

/// A Runge-Kutta method of order 3 with products of exponentials instead of sums:
/// `g_i = g exp(h a_i1 Omega_1) exp(h a_i2 Omega_2) ..`, and likewise the step with the weights `b`.
///
/// It needs six exponentials a step, and neither brackets nor tangent operators. It serves for comparison:
/// [`CommutatorFree`](super::CommutatorFree) has order 4 with five exponentials. P. E. Crouch and R. Grossman, *J. Nonlinear
/// Sci.* 3 (1993) 1-33; B. Owren and A. Marthinsen, *BIT* 39 (1999) 116-142.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct CrouchGrossman;

impl CrouchGrossman {
    /// The order of convergence.
    pub fn order(&self) -> u32 {
        3
    }
}

impl<S: CotangentSystem> Integrator<S> for CrouchGrossman {
    fn step(&self, system: &S, state: &mut State<S::Group>, h: f64) -> Result<(), Error> {
        let group = system.group();
        let start = StepStart::new(system, state);
        let moved = |slopes: &[&Rates<Vector<S>>], weights: &[f64]| {
            let begin = (Increment::none(group), start.momentum.clone());
            slopes.iter().zip(weights).fold(begin, |(at, momentum), (k, weight)| {
                let momentum = match &k.momentum {
                    Some(change) => momentum + change.clone() * (weight * h),
                    None => momentum,
                };
                (at.moved(group, k.velocity.clone() * (weight * h)), momentum)
            })
        };
        let rates = |slopes: &[&Rates<Vector<S>>], stage: usize| {
            let (at, momentum) = moved(slopes, &STAGES[stage]);
            start.rates(NODES[stage] * h, &at, &momentum)
        };
        let k1 = rates(&[], 0);
        let k2 = rates(&[&k1], 1);
        let k3 = rates(&[&k1, &k2], 2);
        expect_finite(state.time, &k3.velocity)?;
        let (end, momentum) = moved(&[&k1, &k2, &k3], &WEIGHTS);
        *state = start.arrive(h, &end, k1.momentum.is_some().then_some(&momentum))?;
        Ok(())
    }
}
