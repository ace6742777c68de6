//! Systems of an element and its momentum: motions on the cotangent bundle of a group.

use super::System;
use crate::group::{Coordinates, LieGroup};

/// A state of a motion.
#[derive(Debug)]
pub struct State<G: LieGroup> {
    /// The time.
    pub time: f64,
    /// The element: of a body the attitude, or the pose.
    pub element: G::Element,
    /// The spatial momentum `h`, a covector.
    pub spatial: G::Vector,
}

// derived, it would ask the group to be `Clone` as well
impl<G: LieGroup> Clone for State<G> {
    fn clone(&self) -> Self {
        let (element, spatial) = (self.element.clone(), self.spatial.clone());
        State { time: self.time, element, spatial }
    }
}

impl<G: LieGroup> State<G> {
    /// With the momentum `H` in body components: `h = Ad*_(g^-1) H`.
    pub fn with_momentum(group: &G, time: f64, element: G::Element, momentum: &G::Vector) -> Self {
        let spatial = group.coadjoint(&group.inverse(&element), momentum);
        State { time, element, spatial }
    }

    /// `H = Ad*_g h`, the momentum in body components (103).
    #[inline]
    pub fn momentum(&self, group: &G) -> G::Vector {
        group.coadjoint(&self.element, &self.spatial)
    }
}

/// The rates of change of a state: `Omega` in body components, and `h'`.
#[derive(Clone, Debug)]
pub struct Rates<V> {
    /// `Omega`.
    pub velocity: V,
    /// `h'`.
    pub spatial: V,
}

/// Equations `g' = g Omega`, `h' = Ad*_{g^-1} F` of an element and its spatial momentum, where `Omega` is a function of
/// the momentum `H = Ad*_g h` in body components.
pub trait CotangentSystem: System<State = State<Self::Group>> {
    /// The group.
    type Group: LieGroup;

    /// The group.
    fn group(&self) -> &Self::Group;

    /// `Omega` of a momentum `H`, in body components.
    fn velocity_of(&self, momentum: &Vector<Self>) -> Vector<Self>;

    /// Whether `F` is zero everywhere, so that `h` stays what it is; no one asks for `F` then.
    fn is_free(&self) -> bool;

    /// `F`, in body components.
    fn force(
        &self,
        time: f64,
        element: &Element<Self>,
        velocity: &Vector<Self>,
        momentum: &Vector<Self>,
    ) -> Vector<Self> {
        let _ = (time, element, velocity, momentum);
        Vector::<Self>::zeros(self.group().dimension())
    }

    /// The rates of change of a state.
    #[inline(always)]
    fn rates(&self, state: &State<Self::Group>) -> Rates<Vector<Self>> {
        let group = self.group();
        let momentum = state.momentum(group);
        let velocity = self.velocity_of(&momentum);
        if self.is_free() {
            return Rates { spatial: Vector::<Self>::zeros(group.dimension()), velocity };
        }
        let force = self.force(state.time, &state.element, &velocity, &momentum);
        Rates { spatial: group.coadjoint(&group.inverse(&state.element), &force), velocity }
    }
}

/// Components in the basis of the algebra.
pub type Vector<S> = <<S as CotangentSystem>::Group as LieGroup>::Vector;

/// An element.
pub type Element<S> = <<S as CotangentSystem>::Group as LieGroup>::Element;
