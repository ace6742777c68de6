//! Magnus methods for linear equations on a group.

use super::{Integrator, expect_finite};
use crate::Error;
use crate::group::LieGroup;
use crate::mechanics::systems::System;

/// The equation `g' = g A(t)`. The prescribed velocity `A(t)` is in body components.
///
/// ```
/// use affinor::mechanics::Integrator;
/// use affinor::mechanics::integrators::{PrescribedVelocity, Magnus, KinematicState};
/// use affinor::group::{LieGroup, So3};
/// use nalgebra::Vector3;
/// // turns about the x axis in space and the z axis of the body at once
/// let rate = |t: f64| Vector3::new((2.0 * t).cos(), -(2.0 * t).sin(), 2.0);
/// let body = PrescribedVelocity { group: So3, velocity: rate };
/// let mut place = KinematicState { time: 0.0, element: So3.identity() };
/// for _ in 0..20 {
///     Magnus::Six.step(&body, &mut place, 0.05)?;
/// }
/// let exact = So3.compose(&So3.exp(&Vector3::x()), &So3.exp(&(Vector3::z() * 2.0)));
/// assert!(exact.angle_to(&place.element) < 1e-10);
/// # Ok::<(), affinor::Error>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct PrescribedVelocity<G, F> {
    /// The group.
    pub group: G,
    /// The velocity `A(t)`.
    pub velocity: F,
}

/// The state of a kinematic equation: an element and the time.
#[derive(Debug)]
pub struct KinematicState<G: LieGroup> {
    /// The time.
    pub time: f64,
    /// The element.
    pub element: G::Element,
}

// implemented by hand, because derived implementations would require `G: Clone` and `G: PartialEq`
impl<G: LieGroup<Element: PartialEq>> PartialEq for KinematicState<G> {
    fn eq(&self, other: &Self) -> bool {
        self.time == other.time && self.element == other.element
    }
}

impl<G: LieGroup> Clone for KinematicState<G> {
    fn clone(&self) -> Self {
        KinematicState { time: self.time, element: self.element.clone() }
    }
}

impl<G: LieGroup, F: Fn(f64) -> G::Vector> System for PrescribedVelocity<G, F> {
    type State = KinematicState<G>;

    fn time(&self, state: &KinematicState<G>) -> f64 {
        state.time
    }
}

/// A step `g exp(u)`, where `u` is the truncated Magnus series. Gauss quadrature integrates `A`.
///
/// Let `A_i` be the values at the Gauss points, and `{x, y} = -[x, y]` the brackets with the
/// opposite sign, because `A` multiplies `g` from the right:
///
/// ```text
/// order 4   u = h (A_1 + A_2)/2 - sqrt(3) h^2/12 {A_1, A_2}
/// order 6   u = a + c/12 + {-20 a - c + p, b + q}/240
///           a = h A_2,  b = sqrt(15) h (A_3 - A_1)/3,  c = 10 h (A_3 - 2 A_2 + A_1)/3
///           p = {a, b},  q = -{a, 2 c + p}/60
/// ```
///
/// Steps stay on the group. They are exact if the values of `A` at different times commute, and `A`
/// is a polynomial of a degree below the order. S. Blanes, F. Casas, J. A. Oteo and J. Ros, *Phys.
/// Rep.* 470 (2009) 151-238, section 5.4.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Magnus {
    /// Order 4, with two values of `A` and one bracket.
    Four,
    /// Order 6, with three values of `A` and three brackets.
    Six,
}

impl Magnus {
    /// The order of convergence.
    pub fn order(&self) -> u32 {
        match self {
            Magnus::Four => 4,
            Magnus::Six => 6,
        }
    }

    /// The truncated series `u`.
    fn coordinates<G: LieGroup>(
        self,
        group: &G,
        velocity: impl Fn(f64) -> G::Vector,
        middle: f64,
        h: f64,
    ) -> G::Vector {
        let bracket = |x: &G::Vector, y: &G::Vector| -group.bracket(x, y);
        match self {
            Magnus::Four => {
                let off = 3.0_f64.sqrt() / 6.0 * h;
                let (first, second) = (velocity(middle - off) * h, velocity(middle + off) * h);
                let turn = bracket(&first, &second) * (3.0_f64.sqrt() / 12.0);
                (first + second) * 0.5 - turn
            }
            Magnus::Six => {
                let off = 15.0_f64.sqrt() / 10.0 * h;
                let (before, after) = (velocity(middle - off), velocity(middle + off));
                let a = velocity(middle) * h;
                let b = (after.clone() - before.clone()) * (15.0_f64.sqrt() / 3.0 * h);
                let c = (after + before) * (10.0 / 3.0 * h) - a.clone() * (20.0 / 3.0);
                let p = bracket(&a, &b);
                let q = bracket(&a, &(c.clone() * 2.0 + p.clone())) * (-1.0 / 60.0);
                let left = p - a.clone() * 20.0 - c.clone();
                a + c * (1.0 / 12.0) + bracket(&left, &(b + q)) * (1.0 / 240.0)
            }
        }
    }
}

impl<G: LieGroup, F: Fn(f64) -> G::Vector> Integrator<PrescribedVelocity<G, F>> for Magnus {
    fn step(
        &self,
        system: &PrescribedVelocity<G, F>,
        state: &mut KinematicState<G>,
        h: f64,
    ) -> Result<(), Error> {
        let group = &system.group;
        let u = self.coordinates(group, &system.velocity, state.time + 0.5 * h, h);
        expect_finite(state.time, &u)?;
        let element = group.project(group.compose(&state.element, &group.exp(&u)));
        *state = KinematicState { time: state.time + h, element };
        Ok(())
    }
}
