//! Systems of an element and its momentum, which are motions on the cotangent bundle of a group.

use super::System;
use crate::group::{Coordinates, LieGroup, TranslationSplit};

/// A state of a motion.
///
/// With the feature `serde`, states can be serialized if the elements of the group can be
/// serialized. A state that is read is not checked, because an element may have drifted off the
/// group.
#[derive(Debug)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(
        deny_unknown_fields,
        bound(
            serialize = "G::Element: serde::Serialize, G::Vector: serde::Serialize",
            deserialize = "G::Element: serde::Deserialize<'de>, G::Vector: serde::Deserialize<'de>"
        )
    )
)]
pub struct State<G: LieGroup> {
    /// The time.
    pub time: f64,
    /// The element, such as the attitude or the pose of a body.
    pub element: G::Element,
    /// The momentum about the body in spatial axes. It is the covector `m` with `H = Ad*_k m`,
    /// where `H` is the momentum in body components, and `k` is the rotation of the element
    /// ([`linear_part`](TranslationSplit::linear_part)).
    ///
    /// On SO(3), it is the spatial momentum `h`. On SE(3), it consists of the angular momentum
    /// about the origin of the body and the linear momentum, both in spatial axes. It is therefore
    /// independent of the origin of space. On a group without [bounded
    /// adjoint](TranslationSplit::has_bounded_adjoint), it is `H` itself.
    pub spatial: G::Vector,
}

// implemented by hand, because derived implementations would require `G: Clone` and `G: PartialEq`
impl<G: LieGroup<Element: PartialEq>> PartialEq for State<G> {
    fn eq(&self, other: &Self) -> bool {
        self.time == other.time && self.element == other.element && self.spatial == other.spatial
    }
}

impl<G: LieGroup> Clone for State<G> {
    fn clone(&self) -> Self {
        let (element, spatial) = (self.element.clone(), self.spatial.clone());
        State { time: self.time, element, spatial }
    }
}

impl<G: TranslationSplit> State<G> {
    /// The state with the momentum `H` in body components.
    pub fn with_momentum(group: &G, time: f64, element: G::Element, momentum: &G::Vector) -> Self {
        let spatial = in_axes(group, &element, momentum);
        State { time, element, spatial }
    }

    /// The momentum `H` in body components (103).
    #[inline]
    pub fn momentum(&self, group: &G) -> G::Vector {
        if !group.has_bounded_adjoint() {
            return self.spatial.clone();
        }
        group.coadjoint(&group.linear_part(&self.element), &self.spatial)
    }

    /// The spatial momentum `h = Ad*_(g^-1) H`, which a free system conserves. Far from the origin
    /// of space, this value suffers from cancellation.
    pub fn spatial_momentum(&self, group: &G) -> G::Vector {
        group.coadjoint(&group.inverse(&self.element), &self.momentum(group))
    }
}

/// Transforms a covector from body components to the axes of [`State::spatial`].
#[inline]
pub(in crate::mechanics) fn in_axes<G: TranslationSplit>(
    group: &G,
    element: &G::Element,
    momentum: &G::Vector,
) -> G::Vector {
    if !group.has_bounded_adjoint() {
        return momentum.clone();
    }
    group.coadjoint_inverse(&group.linear_part(element), momentum)
}

/// Scales of a system, derived from its inertia.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sizes {
    /// The largest moment of inertia of rotations, and the largest mass of translations.
    pub inertia: [f64; 2],
    /// The radius of gyration. It is 1 if there are no rotations or no translations.
    pub length: f64,
}

/// The equations `g' = g Omega`, `H' = ad*_Omega H + F` of an element and its momentum `H` in body
/// components. The velocity `Omega` is a function of `H`, and
/// `(ad*_Omega H)_i = c^j_ki Omega^k H_j`.
pub trait CotangentSystem: System<State = State<Self::Group>> {
    /// The type of the group.
    type Group: TranslationSplit;

    /// The group.
    fn group(&self) -> &Self::Group;

    /// The velocity `Omega` for a momentum `H`, in body components.
    fn velocity_of(&self, momentum: &Vector<Self>) -> Vector<Self>;

    /// Whether the force `F` is zero everywhere. In this case, [`force`](Self::force) is not
    /// called.
    fn is_free(&self) -> bool;

    /// The force `F`, in body components.
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

    /// The translation `c` to the centre. `None` means that the centre is the origin of the body.
    /// In the variables
    ///
    /// ```text
    /// g~ = g c,   Omega~ = Ad_(c^-1) Omega,   H~ = Ad*_c H
    /// ```
    ///
    /// rotations and translations are decoupled. On SE(3), the centre is the centre of mass. Steps
    /// are computed in these variables, so that a uniform motion of the frame does not affect the
    /// angular momentum.
    fn centre(&self) -> Option<&Element<Self>> {
        None
    }

    /// The velocity `Omega~` for a momentum `H~`. Both refer to the [`centre`](Self::centre).
    fn velocity_at_centre(&self, momentum: &Vector<Self>) -> Vector<Self> {
        let Some(centre) = self.centre() else { return self.velocity_of(momentum) };
        let (group, back) = (self.group(), self.group().inverse(centre));
        group.adjoint(&back, &self.velocity_of(&group.coadjoint(&back, momentum)))
    }

    /// Whether [`transfer`](Self::transfer) may differ from zero.
    fn transfers(&self) -> bool {
        self.group().has_translations()
    }

    /// The covector `ad*_(P Omega) H`, computed from the velocity and the momentum at the centre.
    /// It is the change of the momentum about the centre that the
    /// [`translational_part`](TranslationSplit::translational_part) `P Omega` causes. On SE(3), it
    /// is the moment `p cross u` of the linear momentum `p`.
    fn transfer(&self, velocity: &Vector<Self>, momentum: &Vector<Self>) -> Vector<Self> {
        let group = self.group();
        let Some(translation) = group.translational_part(velocity) else {
            return Vector::<Self>::zeros(group.dimension());
        };
        Vector::<Self>::from_fn(group.dimension(), |i| {
            let moved = group.bracket(&translation, &group.basis_vector(i));
            moved.components().iter().zip(momentum.components()).map(|(x, h)| x * h).sum()
        })
    }

    /// The sizes of a state, if the system has an inertia.
    fn sizes(&self) -> Option<Sizes> {
        None
    }
}

/// A vector of the algebra, as components.
pub type Vector<S> = <<S as CotangentSystem>::Group as LieGroup>::Vector;

/// An element of the group.
pub type Element<S> = <<S as CotangentSystem>::Group as LieGroup>::Element;
