//! The commutator-free method of order 4.

use super::Integrator;
use crate::Error;
use crate::dynamics::cotangent::{CotangentSystem, Element, State, Vector};
use crate::group::{Coordinates, LieGroup};

/// The classical Runge-Kutta method with exponentials in the place of sums, of which the fourth
/// stage and the step have two: no inverse tangent operator, no brackets.
///
/// E. Celledoni, A. Marthinsen and B. Owren, *Future Generation Computer Systems* 19 (2003) 341-352.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct CommutatorFree;

impl CommutatorFree {
    /// The order of the error of a motion.
    pub fn order(&self) -> u32 {
        4
    }
}

impl<S: CotangentSystem> Integrator<S> for CommutatorFree {
    fn step(&self, system: &S, state: &mut State<S::Group>, h: f64) -> Result<(), Error> {
        let group = system.group();
        let moved = |g: &Element<S>, x: Vector<S>| group.compose(g, &group.exp(&(x * h)));
        let drifted =
            |slope: &Vector<S>, share: f64| state.spatial.clone() + slope.clone() * (share * h);
        let at = |share: f64, element: Element<S>, spatial: Vector<S>| State {
            time: state.time + share * h,
            element,
            spatial,
        };
        let k1 = system.rates(state);
        let half = moved(&state.element, k1.velocity.clone() * 0.5);
        let k2 = system.rates(&at(0.5, half.clone(), drifted(&k1.spatial, 0.5)));
        let middle = moved(&state.element, k2.velocity.clone() * 0.5);
        let k3 = system.rates(&at(0.5, middle, drifted(&k2.spatial, 0.5)));
        let end = moved(&half, k3.velocity.clone() - k1.velocity.clone() * 0.5);
        let k4 = system.rates(&at(1.0, end, drifted(&k3.spatial, 1.0)));
        let both = (k2.velocity.clone() + k3.velocity.clone()) * 2.0;
        let twelfth = |first: &Vector<S>, last: &Vector<S>| {
            (first.clone() * 3.0 + both.clone() - last.clone()) * (1.0 / 12.0)
        };
        let first = moved(&state.element, twelfth(&k1.velocity, &k4.velocity));
        let element = group.restored(moved(&first, twelfth(&k4.velocity, &k1.velocity)));
        let slopes = [(&k1, 1.0), (&k2, 2.0), (&k3, 2.0), (&k4, 1.0)];
        let spatial = slopes.iter().fold(state.spatial.clone(), |sum, (k, weight)| {
            sum + k.spatial.clone() * (weight * h / 6.0)
        });
        if !k4.velocity.is_finite() || !spatial.is_finite() {
            let reason = "a value is not finite".into();
            return Err(Error::Integration { t: state.time, reason });
        }
        *state = State { time: state.time + h, element, spatial };
        Ok(())
    }
}
