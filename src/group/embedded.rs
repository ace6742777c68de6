//! Groups as embedded submanifolds of R^N.

use super::{Coordinates, LieGroup};

/// A group with embedding coordinates. The group is an embedded submanifold of some `R^N`, as the
/// unit quaternions are a submanifold of `R^4`.
///
/// [`LieGroup::project`] projects points near the submanifold back onto it.
///
/// ```
/// use affinor::group::{Embedded, LieGroup, So3};
/// use nalgebra::Vector3;
/// let g = So3.exp(&Vector3::new(0.3, 1.0, -0.2));
/// let omega = Vector3::new(0.5, 0.1, 0.7);
/// let [after, before] = [1e-5, -1e-5].map(|t| So3.coordinates(&So3.compose(&g, &So3.exp(&(omega * t)))));
/// assert!(((after - before) / 2e-5 - So3.rate(&g, &omega)).amax() < 1e-10);
/// ```
pub trait Embedded: LieGroup {
    /// The type of the `N` embedding coordinates.
    type Ambient: Coordinates;

    /// The embedding coordinates of an element.
    fn coordinates(&self, g: &Self::Element) -> Self::Ambient;

    /// The point with these coordinates. It is an element of the group only if the coordinates
    /// belong to the submanifold.
    #[allow(clippy::wrong_self_convention, reason = "the group makes its elements")]
    fn from_coordinates(&self, y: &Self::Ambient) -> Self::Element;

    /// The time derivative of the coordinates for `g' = g v`. The derivative is also defined for
    /// `g` near the submanifold.
    fn rate(&self, g: &Self::Element, v: &Self::Vector) -> Self::Ambient;

    /// The [`rate`](Self::rate) at a point near the submanifold, for a caller that already has the
    /// projected element [`project(point)`](LieGroup::project).
    #[inline(always)]
    fn rate_at_projected(
        &self,
        point: &Self::Element,
        projected: &Self::Element,
        v: &Self::Vector,
    ) -> Self::Ambient {
        let _ = projected;
        self.rate(point, v)
    }

    /// The number `N` of coordinates.
    fn embedding_dimension(&self) -> usize {
        self.coordinates(&self.identity()).components().len()
    }

    /// Whether the coordinate at the index `at`, from 0, belongs to a
    /// [translation](super::TranslationSplit::translational_part).
    fn is_translation_coordinate(&self, at: usize) -> bool {
        let _ = at;
        false
    }

    /// Whether projection methods can be used. This requires that [`LieGroup::project`] maps any
    /// point near the group to an element.
    fn has_projection(&self) -> bool {
        true
    }
}
