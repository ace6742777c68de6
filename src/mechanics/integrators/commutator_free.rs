//! The commutator-free method of order 4.

use super::step_start::{Increment, StepStart};
use super::{Integrator, expect_finite};
use crate::Error;
use crate::mechanics::systems::cotangent::{CotangentSystem, State, Vector};

/// The classical Runge-Kutta method, with products of exponentials instead of sums. The fourth
/// stage has two exponentials, and the step has two. The method needs neither the inverse tangent
/// operator nor brackets.
///
/// E. Celledoni, A. Marthinsen and B. Owren, *Future Generation Computer Systems* 19 (2003)
/// 341-352.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct CommutatorFree;

impl CommutatorFree {
    /// The order of convergence.
    pub fn order(&self) -> u32 {
        4
    }
}

impl<S: CotangentSystem> Integrator<S> for CommutatorFree {
    fn step(&self, system: &S, state: &mut State<S::Group>, h: f64) -> Result<(), Error> {
        let group = system.group();
        let start = StepStart::new(system, state);
        let drifted = |slope: &Option<Vector<S>>, share: f64| match slope {
            Some(slope) => start.momentum.clone() + slope.clone() * (share * h),
            None => start.momentum.clone(),
        };
        let none = Increment::none(group);
        let k1 = start.rates(0.0, &none, &start.momentum);
        let half = none.moved(group, k1.velocity.clone() * (0.5 * h));
        let k2 = start.rates(0.5 * h, &half, &drifted(&k1.momentum, 0.5));
        let middle = none.moved(group, k2.velocity.clone() * (0.5 * h));
        let k3 = start.rates(0.5 * h, &middle, &drifted(&k2.momentum, 0.5));
        let end = half.moved(group, (k3.velocity.clone() - k1.velocity.clone() * 0.5) * h);
        let k4 = start.rates(h, &end, &drifted(&k3.momentum, 1.0));
        expect_finite(state.time, &k4.velocity)?;
        let both = (k2.velocity.clone() + k3.velocity.clone()) * 2.0;
        let twelfth = |first: &Vector<S>, last: &Vector<S>| {
            (first.clone() * 3.0 + both.clone() - last.clone()) * (h / 12.0)
        };
        let first = none.moved(group, twelfth(&k1.velocity, &k4.velocity));
        let end = first.moved(group, twelfth(&k4.velocity, &k1.velocity));
        let slopes = [(&k1, 1.0), (&k2, 2.0), (&k3, 2.0), (&k4, 1.0)];
        let momentum = slopes.iter().try_fold(start.momentum.clone(), |sum, (k, weight)| {
            Some(sum + k.momentum.clone()? * (weight * h / 6.0))
        });
        *state = start.arrive(h, &end, momentum.as_ref())?;
        Ok(())
    }
}
