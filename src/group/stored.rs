//! Elements as the numbers that are stored of them.

use super::{Coordinates, LieGroup};

/// A group whose elements are a surface in a space of numbers, to which [`LieGroup::restored`] brings back what is near it.
///
/// ```
/// use affinor::group::{LieGroup, So3, Stored};
/// use nalgebra::Vector3;
/// let g = So3.exp(&Vector3::new(0.3, 1.0, -0.2));
/// let omega = Vector3::new(0.5, 0.1, 0.7);
/// let [after, before] = [1e-5, -1e-5].map(|t| So3.numbers(&So3.compose(&g, &So3.exp(&(omega * t)))));
/// assert!(((after - before) / 2e-5 - So3.rate(&g, &omega)).amax() < 1e-10);
/// ```
pub trait Stored: LieGroup {
    /// The numbers.
    type Numbers: Coordinates;

    /// Those of an element.
    fn numbers(&self, g: &Self::Element) -> Self::Numbers;

    /// What has these numbers: an element only if they are on the surface.
    #[allow(clippy::wrong_self_convention, reason = "the group makes its elements")]
    fn from_numbers(&self, y: &Self::Numbers) -> Self::Element;

    /// Their rate of change for `g' = g v`, smooth around the surface as well.
    fn rate(&self, g: &Self::Element, v: &Self::Vector) -> Self::Numbers;

    /// How many numbers, at the end, are those of a [`translation`](LieGroup::translation).
    fn places(&self) -> usize {
        0
    }
}
