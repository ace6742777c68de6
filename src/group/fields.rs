//! Invariant vector fields of a group: values, flows, brackets; translated vectors.
//!
//! Left translation keeps left components (24). Right translation by `h` takes left components `v` at `g` to
//! `Ad_{h^-1} v` at `g h`; the right components of `v` at `g` are `Ad_g v`.

use super::{Coordinates, LieGroup};
pub use crate::geometry::chart::Side;

/// The invariant field through a vector `x` at the identity.
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
    /// The side of the translations that leave it invariant.
    pub side: Side,
    /// Its value at the identity.
    pub vector: V,
}

impl<V: Coordinates> InvariantField<V> {
    /// The value at `g` in left components: `x`, or `Ad_{g^-1} x` for a right-invariant field.
    pub fn at<G: LieGroup<Vector = V>>(&self, group: &G, g: &G::Element) -> V {
        match self.side {
            Side::Left => self.vector.clone(),
            Side::Right => right_translate(group, &self.vector, g),
        }
    }

    /// The flow from `g` over the time `t`: a left-invariant field moves by right translations,
    /// `g exp(t x)`, a right-invariant one by left translations, `exp(t x) g`.
    pub fn flow<G: LieGroup<Vector = V>>(&self, group: &G, g: &G::Element, t: f64) -> G::Element {
        let step = group.exp(&(self.vector.clone() * t));
        match self.side {
            Side::Left => group.compose(g, &step),
            Side::Right => group.compose(&step, g),
        }
    }

    /// The bracket of two fields, an invariant field: `[x,y]` on the left (34), `-[x,y]` on the right, and 0
    /// for a left- and a right-invariant field (35).
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

/// `R_h*` of a vector in left components: `Ad_{h^-1} v`.
pub fn right_translate<G: LieGroup>(group: &G, v: &G::Vector, h: &G::Element) -> G::Vector {
    group.adjoint(&group.inverse(h), v)
}
