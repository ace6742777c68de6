//! Invariant vector fields of a group: values, flows, brackets and translations.
//!
//! Left translation preserves left components (24). Right translation by `h` maps a vector with
//! left components `v` at `g` to one with left components `Ad_{h^-1} v` at `g h`. The right
//! components of `v` at `g` are `Ad_g v`.

use super::{Coordinates, LieGroup};
pub use crate::geometry::chart::Side;

/// The invariant field with the value `x` at the identity.
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
    /// Its value at the identity.
    pub vector: V,
}

impl<V: Coordinates> InvariantField<V> {
    /// The value at `g` in left components: `x` for a left-invariant field, `Ad_{g^-1} x` for a
    /// right-invariant one.
    pub fn at<G: LieGroup<Vector = V>>(&self, group: &G, g: &G::Element) -> V {
        match self.side {
            Side::Left => self.vector.clone(),
            Side::Right => right_translate(group, &self.vector, g),
        }
    }

    /// The flow from `g` for the time `t`. The flow of a left-invariant field is a right
    /// translation, `g exp(t x)`; the flow of a right-invariant one is a left translation, `exp(t
    /// x) g`.
    pub fn flow<G: LieGroup<Vector = V>>(&self, group: &G, g: &G::Element, t: f64) -> G::Element {
        let step = group.exp(&(self.vector.clone() * t));
        match self.side {
            Side::Left => group.compose(g, &step),
            Side::Right => group.compose(&step, g),
        }
    }

    /// The bracket of two fields, which is an invariant field: `[x,y]` for left-invariant fields
    /// (34), `-[x,y]` for right-invariant ones, and 0 for a left- and a right-invariant field (35).
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

/// Right translation `R_h*` of a vector in left components: `Ad_{h^-1} v`.
pub fn right_translate<G: LieGroup>(group: &G, v: &G::Vector, h: &G::Element) -> G::Vector {
    group.adjoint(&group.inverse(h), v)
}
