//! Groups as embedded submanifolds of R^N.

use super::{Coordinates, LieGroup};

/// A group with embedding coordinates: it is an embedded submanifold of some `R^N`, as the unit quaternions are of `R^4`.
///
/// [`LieGroup::restored`] projects points near the submanifold back onto it.
///
/// ```
/// use affinor::group::{Embedded, LieGroup, So3};
/// use nalgebra::Vector3;
/// let g = So3.exp(&Vector3::new(0.3, 1.0, -0.2));
/// let omega = Vector3::new(0.5, 0.1, 0.7);
/// let [after, before] = [1e-5, -1e-5].map(|t| So3.numbers(&So3.compose(&g, &So3.exp(&(omega * t)))));
/// assert!(((after - before) / 2e-5 - So3.rate(&g, &omega)).amax() < 1e-10);
/// ```
pub trait Embedded: LieGroup {
    /// The type of the `N` embedding coordinates.
    type Numbers: Coordinates;

    /// The embedding coordinates of an element.
    fn numbers(&self, g: &Self::Element) -> Self::Numbers;

    /// The point with these coordinates. It is an element only if it lies on the submanifold.
    #[allow(clippy::wrong_self_convention, reason = "the group makes its elements")]
    fn from_numbers(&self, y: &Self::Numbers) -> Self::Element;

    /// The rate of change of the coordinates for `g' = g v`, also for `g` near the submanifold.
    fn rate(&self, g: &Self::Element, v: &Self::Vector) -> Self::Numbers;

    /// The [`rate`](Self::rate) at a point near the submanifold, for a caller who has the projected element
    /// [`restored(point)`](LieGroup::restored) already.
    #[inline(always)]
    fn rate_near(
        &self,
        point: &Self::Element,
        projected: &Self::Element,
        v: &Self::Vector,
    ) -> Self::Numbers {
        let _ = projected;
        self.rate(point, v)
    }

    /// The number `N` of coordinates.
    fn number_count(&self) -> usize {
        self.numbers(&self.identity()).components().len()
    }

    /// Whether the coordinate of an index, from 0, belongs to a [`translation`](LieGroup::translation).
    fn is_place(&self, at: usize) -> bool {
        let _ = at;
        false
    }

    /// Whether projection methods serve: [`LieGroup::restored`] takes any point near the group to an element.
    fn has_projection(&self) -> bool {
        true
    }
}
