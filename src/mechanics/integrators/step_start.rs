//! The start of a step, to which the stages refer.

use crate::Error;
use crate::group::{Coordinates, LieGroup, TranslationSplit};
use crate::mechanics::systems::cotangent::{CotangentSystem, Element, State, Vector, in_axes};
use std::borrow::Cow;

/// The displacement of an element from the start of a step, `g = g_0 exp(y) k`. It consists of a
/// translation, followed by a rotation.
pub(super) struct Increment<G: LieGroup> {
    /// The rotation `k`.
    turn: G::Element,
    /// The translation `y`, if the group has translations.
    place: Option<G::Vector>,
}

impl<G: TranslationSplit> Increment<G> {
    /// The zero displacement.
    pub(super) fn none(group: &G) -> Self {
        let place = group.translational_part(&G::Vector::zeros(group.dimension()));
        Increment { turn: group.identity(), place }
    }

    /// The displacement, followed by the rotation of `x`. The translation of `x` is added to the
    /// translation of the displacement.
    pub(super) fn moved(&self, group: &G, x: G::Vector) -> Self {
        let (x, place) = match (&self.place, group.translational_part(&x)) {
            (Some(place), Some(translation)) => {
                (x - translation.clone(), Some(place.clone() + translation))
            }
            _ => (x, None),
        };
        Increment { turn: group.compose(&self.turn, &group.exp(&x)), place }
    }

    /// The displaced element, computed from the element at the start.
    pub(super) fn element(&self, group: &G, start: &G::Element) -> G::Element {
        let from = match &self.place {
            Some(place) => &group.compose(start, &group.exp(place)),
            None => start,
        };
        group.compose(from, &self.turn)
    }
}

/// Time derivatives at an [`Increment`]. The derivatives of rotations are in body components. The
/// derivatives of translations and of the momentum are in components of the start.
pub(super) struct Rates<V> {
    pub(super) velocity: V,
    pub(super) momentum: Option<V>,
}

/// The start of a step. The momentum `p` refers to the element at the start: at the element
/// `g_0 exp(y) k`, `H = Ad*_k p`. Then `p' = Ad*_(k^-1) (F + ad*_(P Omega) H)`, so a step does not
/// depend on the position of the start.
///
/// Elements, velocities and momenta refer to the [centre](CotangentSystem::centre) of the system.
pub(super) struct StepStart<'s, S: CotangentSystem> {
    pub(super) system: &'s S,
    pub(super) state: &'s State<S::Group>,
    /// The element at the start.
    pub(super) element: Cow<'s, Element<S>>,
    /// The momentum at the start.
    pub(super) momentum: Vector<S>,
}

impl<'s, S: CotangentSystem> StepStart<'s, S> {
    #[inline]
    pub(super) fn new(system: &'s S, state: &'s State<S::Group>) -> Self {
        let (group, momentum) = (system.group(), state.momentum(system.group()));
        let (element, momentum) = match system.centre() {
            Some(centre) => (
                Cow::Owned(group.compose(&state.element, centre)),
                group.coadjoint(centre, &momentum),
            ),
            None => (Cow::Borrowed(&state.element), momentum),
        };
        StepStart { system, state, element, momentum }
    }

    /// The largest relative time derivative: the angular velocity, or the relative time derivative
    /// of the momentum of rotations or of translations.
    pub(super) fn fastest(&self) -> f64 {
        let StepStart { system, state, element, momentum } = self;
        let group = system.group();
        let velocity = system.velocity_at_centre(momentum);
        let turning = match group.translational_part(&velocity) {
            Some(translation) => (velocity.clone() - translation).largest(),
            None => velocity.largest(),
        };
        if self.is_free() {
            return turning;
        }
        let push = self.push(state.time, || (**element).clone(), &velocity, momentum);
        let [pushed, present] = [&push, momentum].map(|p| parts(group, p));
        let relative = |part: usize| match pushed[part] {
            0.0 => 0.0,
            pushed => pushed / present[part],
        };
        turning.max(relative(0)).max(relative(1))
    }

    /// Whether the momentum `p` is constant.
    #[inline]
    pub(super) fn is_free(&self) -> bool {
        self.system.is_free() && !self.system.transfers()
    }

    /// The covector `F + ad*_(P Omega) H` at an element.
    #[inline(always)]
    pub(super) fn push(
        &self,
        time: f64,
        element: impl FnOnce() -> Element<S>,
        velocity: &Vector<S>,
        momentum: &Vector<S>,
    ) -> Vector<S> {
        let system = self.system;
        match (system.is_free(), system.transfers()) {
            (false, false) => self.force(time, &element(), velocity, momentum),
            (true, _) => system.transfer(velocity, momentum),
            (false, true) => {
                let force = self.force(time, &element(), velocity, momentum);
                force + system.transfer(velocity, momentum)
            }
        }
    }

    /// The force `F`.
    #[inline(always)]
    fn force(
        &self,
        time: f64,
        element: &Element<S>,
        velocity: &Vector<S>,
        momentum: &Vector<S>,
    ) -> Vector<S> {
        let (system, group) = (self.system, self.system.group());
        let Some(centre) = system.centre() else {
            return system.force(time, element, velocity, momentum);
        };
        let back = group.inverse(centre);
        let element = group.compose(element, &back);
        let velocity = group.adjoint(centre, velocity);
        let momentum = group.coadjoint(&back, momentum);
        group.coadjoint(centre, &system.force(time, &element, &velocity, &momentum))
    }

    /// The time derivatives at a time after the start, for the momentum `p`.
    pub(super) fn rates(
        &self,
        elapsed: f64,
        at: &Increment<S::Group>,
        momentum: &Vector<S>,
    ) -> Rates<Vector<S>> {
        let group = self.system.group();
        let momentum = group.coadjoint(&at.turn, momentum);
        let velocity = self.system.velocity_at_centre(&momentum);
        let change = (!self.is_free()).then(|| {
            let element = || at.element(group, &self.element);
            let push = self.push(self.state.time + elapsed, element, &velocity, &momentum);
            group.coadjoint_inverse(&at.turn, &push)
        });
        let velocity = match group.translational_part(&velocity) {
            Some(translation) => {
                velocity - translation.clone() + group.adjoint(&at.turn, &translation)
            }
            None => velocity,
        };
        Rates { velocity, momentum: change }
    }

    /// The state after a step of length `h`. The parameters are the element, the momentum `p` and
    /// the momentum `H` in body components at the end of the step.
    ///
    /// # Errors
    /// [`Error::Integration`] if the momentum is not finite.
    #[inline]
    pub(super) fn end(
        &self,
        h: f64,
        element: Element<S>,
        momentum: Option<&Vector<S>>,
        in_body: impl FnOnce() -> Vector<S>,
    ) -> Result<State<S::Group>, Error> {
        let (group, state) = (self.system.group(), self.state);
        if let Some(centre) = self.system.centre() {
            let back = group.inverse(centre);
            let (element, momentum) =
                (group.compose(&element, &back), group.coadjoint(&back, &in_body()));
            super::expect_finite(state.time, &momentum)?;
            return Ok(State::with_momentum(group, state.time + h, element, &momentum));
        }
        let spatial = match momentum {
            _ if !group.has_bounded_adjoint() => in_body(),
            None if self.system.transfers() => {
                let reached = in_axes(group, &element, &in_body());
                let change = reached - state.spatial.clone();
                // removes the change of the momentum of translations: if `momentum` is `None`, this
                // momentum is conserved exactly
                match group.translational_momentum(&change) {
                    Some(along) => state.spatial.clone() + (change - along),
                    None => state.spatial.clone() + change,
                }
            }
            None => state.spatial.clone(),
            // adds the change of the momentum, so that a momentum without change is conserved
            // exactly
            Some(momentum) => {
                let change = momentum.clone() - self.momentum.clone();
                state.spatial.clone() + in_axes(group, &state.element, &change)
            }
        };
        super::expect_finite(state.time, &spatial)?;
        Ok(State { time: state.time + h, element, spatial })
    }

    /// The state at an increment.
    ///
    /// # Errors
    /// [`Error::Integration`] if a value is not finite.
    pub(super) fn arrive(
        &self,
        h: f64,
        at: &Increment<S::Group>,
        momentum: Option<&Vector<S>>,
    ) -> Result<State<S::Group>, Error> {
        let group = self.system.group();
        let element = group.project(at.element(group, &self.element));
        let in_body = || group.coadjoint(&at.turn, momentum.unwrap_or(&self.momentum));
        self.end(h, element, momentum, in_body)
    }
}

/// The largest component of a covector along rotations, and along translations.
pub(super) fn parts<G: TranslationSplit>(group: &G, momentum: &G::Vector) -> [f64; 2] {
    match group.translational_momentum(momentum) {
        Some(along) => [(momentum.clone() - along.clone()).largest(), along.largest()],
        None => [momentum.largest(), 0.0],
    }
}
