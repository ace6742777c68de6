//! Invariant vector fields of a group: their values, flows, brackets and translations.
//!
//! Left translation preserves left components (equation (24)). Let `v` be the left components of a
//! vector at `g`. Its right components are `Ad_g v`. Right translation by `h` maps the vector to a
//! vector at `g h` with the left components `Ad_{h^-1} v`.

use super::{Coordinates, LieGroup};
pub use crate::geometry::chart::Side;

/// An invariant field, given by its value `x` at the identity.
///
/// ```
/// use affinor::group::fields::{InvariantField, Side};
/// use affinor::group::{LieGroup, So3};
/// use nalgebra::Vector3;
/// let right = |x| InvariantField { side: Side::Right, vector: x };
/// let (x, y) = (Vector3::x(), Vector3::y());
/// assert_eq!(right(x).bracket(&So3, &right(y)), right(-Vector3::z()));
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct InvariantField<V> {
    /// The side of the translations under which the field is invariant.
    pub side: Side,
    /// The value of the field at the identity.
    pub vector: V,
}

impl<V: Coordinates> InvariantField<V> {
    /// The value at `g` in left components: `x` for a left-invariant field, and `Ad_{g^-1} x` for a
    /// right-invariant field.
    pub fn at<G: LieGroup<Vector = V>>(&self, group: &G, g: &G::Element) -> V {
        match self.side {
            Side::Left => self.vector.clone(),
            Side::Right => right_translate(group, &self.vector, g),
        }
    }

    /// The flow from `g` for the time `t`. The flow of a left-invariant field is a right
    /// translation, `g exp(t x)`; the flow of a right-invariant field is a left translation,
    /// `exp(t x) g`.
    pub fn flow<G: LieGroup<Vector = V>>(&self, group: &G, g: &G::Element, t: f64) -> G::Element {
        let step = group.exp(&(self.vector.clone() * t));
        match self.side {
            Side::Left => group.compose(g, &step),
            Side::Right => group.compose(&step, g),
        }
    }

    /// The bracket of two fields, which is an invariant field. The bracket is `[x,y]` for
    /// left-invariant fields (34), `-[x,y]` for right-invariant fields, and 0 for a left-invariant
    /// and a right-invariant field (35).
    #[must_use]
    pub fn bracket<G: LieGroup<Vector = V>>(&self, group: &G, other: &Self) -> Self {
        let bracket = group.bracket(&self.vector, &other.vector);
        match (self.side, other.side) {
            (Side::Left, Side::Left) => InvariantField { side: Side::Left, vector: bracket },
            (Side::Right, Side::Right) => InvariantField { side: Side::Right, vector: -bracket },
            _ => InvariantField { side: Side::Left, vector: bracket * 0.0 },
        }
    }
}

/// The right translation `R_h*` of a vector in left components, which is `Ad_{h^-1} v`.
pub fn right_translate<G: LieGroup>(group: &G, v: &G::Vector, h: &G::Element) -> G::Vector {
    group.adjoint(&group.inverse(h), v)
}
