//! Groups as configuration spaces of motions.

use super::snapshot::Saved;
use crate::group::{
    AnyGroup, Embedded, MatrixGroup, Nilpotent, Opposite, Se2, Se3, Sl2, So2, So3, Written,
};
use std::fmt::Debug;

/// A group whose elements are the configurations of a motion.
pub trait ConfigurationGroup:
    Written<Element: Saved + Send + Sync, Vector: Saved + Send + Sync>
    + Clone
    + Debug
    + Send
    + Sync
    + 'static
{
    /// Whether its left-invariant frame is the right-invariant frame of the group it is the [`Opposite`] of.
    const RIGHT: bool = false;

    /// Whether an element that was read has the shape of an element of this group.
    fn has_shape(&self, g: &Self::Element) -> bool {
        self.write(g).shape() == self.write(&self.identity()).shape()
    }
}

impl ConfigurationGroup for So2 {}
impl ConfigurationGroup for So3 {}
impl ConfigurationGroup for Se2 {}
impl ConfigurationGroup for Se3 {}
impl ConfigurationGroup for Sl2 {}
impl ConfigurationGroup for MatrixGroup {}
impl ConfigurationGroup for Nilpotent<f64> {}

impl ConfigurationGroup for AnyGroup {
    fn has_shape(&self, g: &Self::Element) -> bool {
        g.len() == self.number_count()
    }
}

impl<G: ConfigurationGroup> ConfigurationGroup for Opposite<G> {
    const RIGHT: bool = true;

    fn has_shape(&self, g: &Self::Element) -> bool {
        self.0.has_shape(g)
    }
}
